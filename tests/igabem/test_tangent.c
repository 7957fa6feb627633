/* Tangents against central differences of whole solves on moved hulls: small ones, and with
 * TANGENT_SLOW those of docs/theory.md, section 15. */
#include "check.h"
#include "hulls.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { FIELDS = 3, ANGLES = 7, PARTS = 5 };
static const double angles[ANGLES] = {0.0, 0.3, 0.7, 1.1, 1.9, 3.0, 5.0};

struct body {
    nurbs_surface *surface[2]; /* the second may be NULL */
    size_t patches;
    igabem_hull *hull;
    igabem_options options; /* frozen on it */
    size_t points;          /* of both */
    double *move;           /* [FIELDS][points][3] */
};

static size_t points_of(const nurbs_surface *surface)
{
    return nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
}

/* y times smooth functions of the place: keel, stem and centre plane stay. */
static void fill_moves(struct body *body)
{
    for (size_t p = 0; p < body->patches; p++)
        body->points += points_of(body->surface[p]);
    body->move = calloc(3 * FIELDS * body->points, sizeof *body->move);
    CU_ASSERT_FATAL(body->move != NULL);
    size_t at = 0;
    for (size_t p = 0; p < body->patches; p++) {
        const double *point = nurbs_surface_points(body->surface[p]);
        for (size_t k = 0; k < points_of(body->surface[p]); k++, at++) {
            double x = point[3 * k], y = point[3 * k + 1], z = point[3 * k + 2];
            const double factor[FIELDS] = {1.0, sin(5.0 * x + 0.3) + 3.0 * z,
                                           cos(9.0 * x) * (1.0 + 20.0 * z * z)};
            for (size_t f = 0; f < FIELDS; f++)
                body->move[3 * (f * body->points + at) + 1] = y * factor[f];
        }
    }
}

static void make_body(nurbs_surface *surface, nurbs_surface *second, igabem_formulation formulation,
                      double tolerance, struct body *body)
{
    CU_ASSERT_FATAL(surface != NULL);
    *body = (struct body){.surface = {surface, second}, .patches = second ? 2 : 1};
    CU_ASSERT_EQUAL_FATAL(igabem_hull_create((const nurbs_surface *const *)body->surface,
                                             body->patches, IGABEM_SYMMETRIC, &body->hull),
                          IGABEM_OK);
    igabem_options_init(&body->options);
    body->options.froude = 0.35;
    body->options.formulation = formulation;
    body->options.tolerance = tolerance;
    body->options.refine = 1;
    if (nurbs_surface_weights(surface)) { /* a rational shape under a density of its own */
        body->options.elements_u = 5;
        body->options.elements_v = 3;
    }
    body->options.spectrum_limit = 5.0; /* shorter waves would want shorter steps */
    body->options.surface_cells = 12.0; /* of exterior */
    body->options.surface_rows = 6.0;
    body->options.surface_columns = 3.0;
    CU_ASSERT_EQUAL_FATAL(igabem_options_freeze(body->hull, &body->options), IGABEM_OK);
    fill_moves(body);
}

static void free_body(struct body *body)
{
    igabem_hull_free(body->hull);
    nurbs_surface_free(body->surface[0]);
    nurbs_surface_free(body->surface[1]);
    free(body->move);
}

static igabem_solution *solve(const struct body *body, const igabem_hull *hull)
{
    igabem_solution *solution = NULL;
    igabem_status status = igabem_solve(hull, &body->options, &solution);
    if (status != IGABEM_OK)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return solution;
}

/* A patch moved by step times the sum of the fields with these weights; its points begin at `base`.
 */
static nurbs_surface *move_patch(const struct body *body, size_t p, size_t base,
                                 const double weight[FIELDS], double step)
{
    const nurbs_surface *own = body->surface[p];
    const int degree[2] = {nurbs_surface_degree(own, 0), nurbs_surface_degree(own, 1)};
    const size_t size[2] = {nurbs_surface_size(own, 0), nurbs_surface_size(own, 1)};
    size_t n = 3 * points_of(own);
    double *point = malloc(n * sizeof *point);
    CU_ASSERT_FATAL(point != NULL);
    memcpy(point, nurbs_surface_points(own), n * sizeof *point);
    for (size_t f = 0; f < FIELDS; f++)
        for (size_t k = 0; k < n; k++)
            point[k] += step * weight[f] * body->move[3 * (f * body->points + base) + k];
    nurbs_surface *moved = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(own, 0),
                                               nurbs_surface_knots(own, 1), point,
                                               nurbs_surface_weights(own), &moved),
                          NURBS_OK);
    free(point);
    return moved;
}

static igabem_solution *solve_moved(const struct body *body, const double weight[FIELDS],
                                    double step)
{
    nurbs_surface *moved[2] = {NULL, NULL};
    igabem_hull *hull = NULL;
    for (size_t p = 0, base = 0; p < body->patches; base += points_of(body->surface[p++]))
        moved[p] = move_patch(body, p, base, weight, step);
    CU_ASSERT_EQUAL_FATAL(igabem_hull_create((const nurbs_surface *const *)moved, body->patches,
                                             IGABEM_SYMMETRIC, &hull),
                          IGABEM_OK);
    igabem_solution *solution = solve(body, hull);
    igabem_hull_free(hull);
    nurbs_surface_free(moved[0]);
    nurbs_surface_free(moved[1]);
    return solution;
}

enum {
    SAMPLES_U = 9,
    SAMPLES_V = 5,
    SAMPLE = sizeof(igabem_pressure_sample) / sizeof(double),
    RESIDUALS_AT = 2 * ANGLES,
    CW_AT = RESIDUALS_AT + IGABEM_WAVE_RESIDUALS,
    AREA_AT = CW_AT + 1,
    SAMPLES_AT = AREA_AT + 1,
    NUMBERS = SAMPLES_AT + 2 * SAMPLE * (SAMPLES_U * SAMPLES_V + 2 * SAMPLES_U)
};

static bool has_velocity(const igabem_solution *solution)
{
    return igabem_formulation_info(igabem_solution_options(solution)->formulation)->solves;
}

/* H, residuals, C_w, wetted area, samples of the pressure. */
static void results(const igabem_solution *solution, double *number)
{
    igabem_forces forces;
    CU_ASSERT_EQUAL_FATAL(
        igabem_kochin(solution, ANGLES, angles, (double(*)[2])(void *)number, NULL), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_wave_residuals(solution, number + RESIDUALS_AT), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    number[CW_AT] = forces.cw;
    number[AREA_AT] = forces.wetted_area;
    memset(number + SAMPLES_AT, 0, (NUMBERS - SAMPLES_AT) * sizeof *number);
    if (!has_velocity(solution))
        return;
    size_t n;
    igabem_pressure_sample *sample;
    CU_ASSERT_EQUAL_FATAL(igabem_pressure_samples(solution, SAMPLES_U, SAMPLES_V, &n, &sample),
                          IGABEM_OK);
    CU_ASSERT_FATAL(SAMPLES_AT + SAMPLE * n <= NUMBERS);
    memcpy(number + SAMPLES_AT, sample, n * sizeof *sample);
    free(sample);
}

static void tangents(const igabem_solution *solution, const igabem_tangent *tangent, double *number)
{
    double h[FIELDS * ANGLES][2], r[FIELDS * IGABEM_WAVE_RESIDUALS], cw[FIELDS], area[FIELDS];
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_kochin(tangent, ANGLES, angles, h), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_residuals(tangent, r), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_cw(tangent, cw), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_wetted_area(tangent, area), IGABEM_OK);
    size_t n = 0;
    igabem_pressure_sample *sample = NULL;
    if (has_velocity(solution)) {
        CU_ASSERT_EQUAL_FATAL(igabem_pressure_samples(solution, SAMPLES_U, SAMPLES_V, &n, NULL),
                              IGABEM_OK);
        sample = malloc(FIELDS * n * sizeof *sample);
        CU_ASSERT_FATAL(sample != NULL);
        CU_ASSERT_EQUAL_FATAL(igabem_tangent_samples(tangent, SAMPLES_U, SAMPLES_V, sample),
                              IGABEM_OK);
    }
    for (size_t f = 0; f < FIELDS; f++, number += NUMBERS) {
        memcpy(number, h[f * ANGLES], 2 * ANGLES * sizeof *number);
        memcpy(number + RESIDUALS_AT, r + f * IGABEM_WAVE_RESIDUALS,
               IGABEM_WAVE_RESIDUALS * sizeof *number);
        number[CW_AT] = cw[f];
        number[AREA_AT] = area[f];
        memset(number + SAMPLES_AT, 0, (NUMBERS - SAMPLES_AT) * sizeof *number);
        for (size_t k = 0; k < n; k++)
            memcpy(number + SAMPLES_AT + SAMPLE * k, &sample[f * n + k], sizeof *sample);
    }
    free(sample);
}

/* Along the sum of the fields with these weights. */
static const double blend[FIELDS] = {0.8, 1.0, -0.7};

/* Central differences, of fourth order: error of H, residuals, C_w, area and samples against the
 * largest of each. */
static void compare_patches(nurbs_surface *surface, nurbs_surface *second,
                            igabem_formulation formulation, double tolerance, double step,
                            const double most[PARTS])
{
    static const size_t begin[PARTS + 1] = {0, RESIDUALS_AT, CW_AT, AREA_AT, SAMPLES_AT, NUMBERS};
    static const double steps[4] = {-2.0, -1.0, 1.0, 2.0};
    struct body body;
    make_body(surface, second, formulation, tolerance, &body);
    igabem_solution *solution = solve(&body, body.hull);
    igabem_tangent *tangent = NULL;
    igabem_status status = igabem_tangent_create(body.hull, solution, FIELDS, body.move, &tangent);
    if (status != IGABEM_OK)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    double exact[FIELDS][NUMBERS], at[4][NUMBERS];
    tangents(solution, tangent, exact[0]);
    for (int k = 0; k < 4; k++) {
        igabem_solution *moved = solve_moved(&body, blend, steps[k] * step);
        results(moved, at[k]);
        igabem_solution_free(moved);
    }
    for (int part = 0; part < PARTS; part++) {
        double error = 0.0, scale = 0.0;
        for (size_t i = begin[part]; i < begin[part + 1]; i++) {
            double difference =
                (8.0 * (at[2][i] - at[1][i]) - (at[3][i] - at[0][i])) / (12.0 * step);
            double sum = 0.0;
            for (size_t f = 0; f < FIELDS; f++)
                sum += blend[f] * exact[f][i];
            error = fmax(error, fabs(difference - sum));
            scale = fmax(scale, fabs(difference));
            if (i == CW_AT) /* which has extrema; the fields are as wide as the hull */
                scale = fmax(scale, fabs(at[1][i]));
        }
        if (!(error <= most[part] * scale))
            fprintf(stderr, "%s: part %d is off by %.2e of its largest\n",
                    igabem_formulation_name(formulation), part, error / scale);
        CU_ASSERT(error <= most[part] * scale);
    }
    igabem_tangent_free(tangent);
    igabem_solution_free(solution);
    free_body(&body);
}

static void compare(nurbs_surface *surface, igabem_formulation formulation, double tolerance,
                    double step, const double most[PARTS])
{
    compare_patches(surface, NULL, formulation, tolerance, step, most);
}

/* H(h) - H(0) - h H' falls four-fold as h is halved. */
static void remainder_of(nurbs_surface *surface, igabem_formulation formulation)
{
    enum { HALVINGS = 4 };
    struct body body;
    make_body(surface, NULL, formulation, 1e-5, &body);
    igabem_solution *solution = solve(&body, body.hull);
    igabem_tangent *tangent = NULL;
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_create(body.hull, solution, FIELDS, body.move, &tangent),
                          IGABEM_OK);
    double exact[FIELDS][NUMBERS], at[NUMBERS], moved[NUMBERS], error[HALVINGS];
    const double weight[FIELDS] = {0.0, 1.0, 0.0};
    tangents(solution, tangent, exact[0]);
    results(solution, at);
    for (int k = 0; k < HALVINGS; k++) {
        double step = 0.08 / (1 << k);
        igabem_solution *other = solve_moved(&body, weight, step);
        results(other, moved);
        error[k] = 0.0;
        for (size_t i = 0; i < 2 * ANGLES; i++)
            error[k] = fmax(error[k], fabs(moved[i] - at[i] - step * exact[1][i]));
        igabem_solution_free(other);
    }
    for (int k = 1; k < HALVINGS; k++)
        CU_ASSERT(fabs(error[k - 1] / error[k] - 4.0) < 0.4);
    igabem_tangent_free(tangent);
    igabem_solution_free(solution);
    free_body(&body);
}

/* Along a sum of fields the tangents are sums. */
static void sum_of(nurbs_surface *surface, igabem_formulation formulation)
{
    static const double weight[FIELDS] = {0.4, -1.3, 0.7};
    struct body body;
    make_body(surface, NULL, formulation, 1e-5, &body);
    igabem_solution *solution = solve(&body, body.hull);
    igabem_tangent *each = NULL, *together = NULL;
    double *move = calloc(3 * FIELDS * body.points, sizeof *move);
    CU_ASSERT_FATAL(move != NULL);
    for (size_t f = 0; f < FIELDS; f++)
        for (size_t k = 0; k < 3 * body.points; k++)
            move[k] += weight[f] * body.move[3 * f * body.points + k];
    /* of the others only the first counts: they stay 0 */
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_create(body.hull, solution, FIELDS, body.move, &each),
                          IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_create(body.hull, solution, FIELDS, move, &together),
                          IGABEM_OK);
    double one[FIELDS][NUMBERS], all[FIELDS][NUMBERS];
    tangents(solution, each, one[0]);
    tangents(solution, together, all[0]);
    for (size_t i = 0; i < NUMBERS; i++) {
        double sum = 0.0, scale = 0.0;
        for (size_t f = 0; f < FIELDS; f++) {
            sum += weight[f] * one[f][i];
            scale += fabs(weight[f] * one[f][i]);
        }
        CHECK_CLOSE(all[0][i], sum, 1e-10 * scale + 1e-16);
        CU_ASSERT(all[1][i] == 0.0);
    }
    free(move);
    igabem_tangent_free(each);
    igabem_tangent_free(together);
    igabem_solution_free(solution);
    free_body(&body);
}

/* The Wigley hull without its last part: an open transom. */
static nurbs_surface *cut_hull(int parts_u, int parts_v)
{
    nurbs_surface *whole = wigley_surface(0.1, 0.0625, parts_u, parts_v), *aft = NULL, *fore = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(whole, 0, 0.2, &aft, &fore), NURBS_OK);
    nurbs_surface_free(whole);
    double x = nurbs_surface_points(aft)[0] - nurbs_surface_points(fore)[0];
    nurbs_surface_free(x < 0 ? aft : fore);
    return x < 0 ? fore : aft;
}

/* The same with sections that narrow downwards: a parabola's rim would have one of the points that
 * it is divided by where the face has a corner, and a difference sees both sides of it. */
static nurbs_surface *flared_hull(int parts_u, int parts_v)
{
    nurbs_surface *own = cut_hull(parts_u, parts_v), *flared = NULL;
    const int degree[2] = {nurbs_surface_degree(own, 0), nurbs_surface_degree(own, 1)};
    const size_t size[2] = {nurbs_surface_size(own, 0), nurbs_surface_size(own, 1)};
    double *point = malloc(3 * points_of(own) * sizeof *point);
    CU_ASSERT_FATAL(point != NULL);
    memcpy(point, nurbs_surface_points(own), 3 * points_of(own) * sizeof *point);
    for (size_t k = 0; k < points_of(own); k++)
        point[3 * k + 1] *= 1.0 + 3.0 * point[3 * k + 2];
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(own, 0),
                                               nurbs_surface_knots(own, 1), point,
                                               nurbs_surface_weights(own), &flared),
                          NURBS_OK);
    free(point);
    nurbs_surface_free(own);
    return flared;
}

static const double explicit_most[PARTS] = {1e-9, 3e-9, 1e-9, 1e-9, 0.0};
static const double solved_most[PARTS] = {1e-7, 1e-7, 1e-7, 1e-9, 1e-6};
/* A step too short for the quadrature to choose another rule, whatever its tolerance. */
static const double short_step = 1e-6, short_most[PARTS] = {5e-8, 5e-8, 5e-8, 1e-8, 5e-7};

static void explicit_densities(void)
{
    compare(wigley_surface(0.1, 0.0625, 8, 4), IGABEM_FORMULATION_MICHELL, 1e-9, 1e-3,
            explicit_most);
    compare(wigley_surface(0.1, 0.0625, 8, 4), IGABEM_FORMULATION_HOGNER, 1e-9, 1e-3,
            explicit_most);
    compare(ellipsoid_surface(1.0, 0.2, 0.15, 0.2, 4, 4), IGABEM_FORMULATION_HOGNER, 1e-9, 1e-3,
            explicit_most);
}

static void double_body(void)
{
    compare(wigley_surface(0.1, 0.0625, 3, 2), IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 1e-5,
            short_step, short_most);
    compare(wigley_surface(0.1, 0.0625, 3, 2), IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 1e-9, 4e-3,
            solved_most);
}

/* A hull of two patches. */
static void two_patches(void)
{
    nurbs_surface *whole = wigley_surface(0.1, 0.0625, 2, 2), *aft = NULL, *fore = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(whole, 0, 0.5, &aft, &fore), NURBS_OK);
    nurbs_surface_free(whole);
    compare_patches(aft, fore, IGABEM_FORMULATION_NEUMANN_KELVIN, 1e-5, short_step, short_most);
}

/* Rows with and without waves. */
static void stern_rows(void)
{
    compare(cut_hull(3, 2), IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1e-5, short_step, short_most);
}

/* The potential on hull and free surface, whose grid follows the waterline. */
static const double surface_most[PARTS] = {2e-7, 2e-7, 1e-7, 1e-8, 5e-7};

static void exterior(void)
{
    compare(ellipsoid_surface(1.0, 0.2, 0.15, 0.2, 2, 2), IGABEM_FORMULATION_EXTERIOR, 1e-5,
            short_step, surface_most);
    compare(wigley_surface(0.1, 0.0625, 3, 2), IGABEM_FORMULATION_EXTERIOR, 1e-5, short_step,
            surface_most);
    compare(flared_hull(3, 2), IGABEM_FORMULATION_EXTERIOR, 1e-5, short_step, surface_most);
    nurbs_surface *whole = wigley_surface(0.1, 0.0625, 2, 2), *aft = NULL, *fore = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(whole, 0, 0.5, &aft, &fore), NURBS_OK);
    nurbs_surface_free(whole);
    compare_patches(aft, fore, IGABEM_FORMULATION_EXTERIOR, 1e-5, short_step, surface_most);
}

/* The same about the double-body flow. C_w is integrated by a rule whose angles follow the hull's
 * beam, and the far cells turn H too fast for it: its error moves with the angles. */
static const double double_model_most[PARTS] = {2e-7, 2e-7, 1e-3, 1e-8, 5e-7};

static void double_model(void)
{
    compare(ellipsoid_surface(1.0, 0.2, 0.15, 0.2, 2, 2), IGABEM_FORMULATION_DOUBLE_MODEL, 1e-5,
            short_step, double_model_most);
    compare(wigley_surface(0.1, 0.0625, 3, 2), IGABEM_FORMULATION_DOUBLE_MODEL, 1e-5, short_step,
            double_model_most);
    compare(flared_hull(3, 2), IGABEM_FORMULATION_DOUBLE_MODEL, 1e-5, short_step,
            double_model_most);
}

#ifdef TANGENT_SLOW
static void larger(void)
{
    compare(wigley_surface(0.1, 0.0625, 6, 3), IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 1e-10, 2e-3,
            solved_most);
    compare(ellipsoid_surface(1.0, 0.2, 0.15, 0.2, 2, 2), IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN,
            1e-10, 4e-3, solved_most);
    compare(wigley_surface(0.1, 0.0625, 6, 3), IGABEM_FORMULATION_NEUMANN_KELVIN, 1e-10, 1e-3,
            solved_most);
    compare(cut_hull(5, 3), IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1e-10, 2e-3, solved_most);
}
#endif

/* The gradient by one transposed solve against tangents of its fields. */
static void gradient_of(nurbs_surface *surface, nurbs_surface *second)
{
    struct body body;
    make_body(surface, second, IGABEM_FORMULATION_EXTERIOR, 1e-5, &body);
    double *gradient = malloc(body.points * sizeof *gradient), cw[FIELDS];
    igabem_tangent *tangent = NULL;
    CU_ASSERT_FATAL(gradient != NULL);
    for (int kept = 0; kept < 2; kept++) {
        body.options.keep_system = kept;
        igabem_solution *solution = solve(&body, body.hull);
        CU_ASSERT_EQUAL_FATAL(
            igabem_tangent_create(body.hull, solution, FIELDS, body.move, &tangent), IGABEM_OK);
        CU_ASSERT_EQUAL_FATAL(igabem_tangent_cw(tangent, cw), IGABEM_OK);
        CU_ASSERT_EQUAL_FATAL(igabem_cw_gradient(body.hull, solution, gradient), IGABEM_OK);
        for (size_t f = 0; f < FIELDS; f++) {
            double sum = 0.0, scale = 0.0;
            for (size_t k = 0; k < body.points; k++) {
                double part = gradient[k] * body.move[3 * (f * body.points + k) + 1];
                sum += part;
                scale += fabs(part);
            }
            if (!(fabs(sum - cw[f]) <= 1e-11 * scale))
                fprintf(stderr, "field %zu: %.12g by gradient, %.12g by tangent, parts %.3g\n", f,
                        sum, cw[f], scale);
            CHECK_CLOSE(sum, cw[f], 1e-11 * scale);
        }
        igabem_tangent_free(tangent);
        igabem_solution_free(solution);
    }
    free(gradient);
    free_body(&body);
}

static void gradients(void)
{
    gradient_of(ellipsoid_surface(1.0, 0.2, 0.15, 0.2, 2, 2), NULL);
    gradient_of(wigley_surface(0.1, 0.0625, 3, 2), NULL);
    gradient_of(flared_hull(3, 2), NULL);
    nurbs_surface *whole = wigley_surface(0.1, 0.0625, 2, 2), *aft = NULL, *fore = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(whole, 0, 0.5, &aft, &fore), NURBS_OK);
    nurbs_surface_free(whole);
    gradient_of(aft, fore);
}

/* A system that is kept is the one that is assembled again. */
static void kept_system_of(igabem_formulation formulation)
{
    struct body body;
    make_body(wigley_surface(0.1, 0.0625, 2, 1), NULL, formulation, 1e-5, &body);
    static double number[2][FIELDS][NUMBERS];
    for (int kept = 0; kept < 2; kept++) {
        body.options.keep_system = kept;
        igabem_solution *solution = solve(&body, body.hull);
        igabem_tangent *tangent = NULL;
        CU_ASSERT_EQUAL_FATAL(
            igabem_tangent_create(body.hull, solution, FIELDS, body.move, &tangent), IGABEM_OK);
        tangents(solution, tangent, number[kept][0]);
        igabem_tangent_free(tangent);
        igabem_solution_free(solution);
    }
    CU_ASSERT(memcmp(number[0], number[1], sizeof number[0]) == 0);
    free_body(&body);
}

static void kept_system(void)
{
    kept_system_of(IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN);
    kept_system_of(IGABEM_FORMULATION_EXTERIOR);
    kept_system_of(IGABEM_FORMULATION_DOUBLE_MODEL);
}

static void remainders(void)
{
    remainder_of(wigley_surface(0.1, 0.0625, 4, 2), IGABEM_FORMULATION_HOGNER);
    remainder_of(cut_hull(3, 2), IGABEM_FORMULATION_NEUMANN_KELVIN_STERN);
    remainder_of(wigley_surface(0.1, 0.0625, 3, 2), IGABEM_FORMULATION_EXTERIOR);
    remainder_of(flared_hull(3, 2), IGABEM_FORMULATION_EXTERIOR);
}

static void sums(void)
{
    sum_of(wigley_surface(0.1, 0.0625, 4, 2), IGABEM_FORMULATION_HOGNER);
    sum_of(cut_hull(2, 1), IGABEM_FORMULATION_NEUMANN_KELVIN_STERN);
    sum_of(flared_hull(2, 1), IGABEM_FORMULATION_EXTERIOR);
}

static void expect_refusal(const struct body *body, const igabem_hull *hull,
                           const igabem_solution *solution, const char *sentence)
{
    igabem_tangent *tangent = NULL;
    CU_ASSERT_EQUAL(igabem_tangent_create(hull, solution, FIELDS, body->move, &tangent),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT(tangent == NULL);
    if (!strstr(igabem_last_error(), sentence))
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT(strstr(igabem_last_error(), sentence) != NULL);
}

static void refusals(void)
{
    struct body body;
    make_body(wigley_surface(0.1, 0.0625, 2, 1), NULL, IGABEM_FORMULATION_HOGNER, 1e-5, &body);
    igabem_solution *solution = solve(&body, body.hull);
    size_t columns = nurbs_surface_size(body.surface[0], 1), inner = columns + 1;
    double kept = body.move[3 * inner];
    body.move[3 * inner] = 0.01;
    expect_refusal(&body, body.hull, solution, "moves by 0.01 m along x, expected 0");
    body.move[3 * inner] = kept;
    kept = body.move[3 * inner + 1];
    body.move[3 * inner + 1] = NAN;
    expect_refusal(&body, body.hull, solution, "along y, expected a number");
    body.move[3 * inner + 1] = kept;
    body.move[1] = 0.01;
    expect_refusal(&body, body.hull, solution, "lies in the centre plane and moves by 0.01 m");
    body.move[1] = 0.0;
    igabem_hull *other = wigley_hull(0.11, 0.0625, 2, 1);
    expect_refusal(&body, other, solution, "away from that of the solution's hull");
    igabem_hull_free(other);
    igabem_solution_free(solution);
    body.options.kernel = IGABEM_KERNEL_RANKINE;
    solution = solve(&body, body.hull);
    expect_refusal(&body, body.hull, solution, "has no free surface, expected the Kelvin kernel");
    igabem_solution_free(solution);
    body.options.kernel = IGABEM_KERNEL_KELVIN;
    body.options.surface_cells = 8.0;
    body.options.surface_rows = 4.0;
    body.options.formulation = IGABEM_FORMULATION_DOUBLE_MODEL;
    solution = solve(&body, body.hull);
    double gradient;
    CU_ASSERT_EQUAL(igabem_cw_gradient(body.hull, solution, &gradient), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT(strstr(igabem_last_error(), "formulation double-model has no gradient") != NULL);
    igabem_solution_free(solution);
    free_body(&body);
}

static const struct check_case cases[] = {
#ifdef TANGENT_SLOW
    {"larger hulls against differences", larger},
#endif
    {"explicit densities against differences", explicit_densities},
    {"double body against differences", double_body},
    {"two patches against differences", two_patches},
    {"stern rows against differences", stern_rows},
    {"exterior against differences", exterior},
    {"double-model against differences", double_model},
    {"gradients", gradients},
    {"kept system", kept_system},
    {"remainders", remainders},
    {"sums of fields", sums},
    {"refusals", refusals},
};

CHECK_MAIN("igabem_tangent", cases)
