#include "check.h"
#include "hulls.h"

#include <string.h>

static double through_points(const nurbs_surface *surface, const nurbs_grid *grid,
                             const nurbs_skin_options *options)
{
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    double *u = malloc((rows + columns) * sizeof *u), worst = INFINITY;
    nurbs_grid *sampled = NULL;
    if (nurbs_skin_parameters(grid, options, u, u + rows) == NURBS_OK &&
        nurbs_grid_sample(surface, rows, u, columns, u + rows, &sampled) == NURBS_OK) {
        worst = 0;
        for (size_t k = 0; k < 3 * rows * columns; k++)
            worst = fmax(worst, fabs(nurbs_grid_points(sampled)[k] - nurbs_grid_points(grid)[k]));
    }
    nurbs_grid_free(sampled);
    free(u);
    return worst;
}

static void passes_through_every_point(void)
{
    struct hull5415 hull;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    for (int degree = 1; degree <= 5; degree++)
        for (int kind = NURBS_PARAMETRIZATION_UNIFORM; kind <= NURBS_PARAMETRIZATION_FOLEY;
             kind++) {
            nurbs_skin_options options;
            nurbs_surface *surface;
            nurbs_skin_options_init(&options);
            options.degree = degree;
            options.parametrize = (nurbs_parametrization)kind;
            CU_ASSERT_EQUAL_FATAL(nurbs_skin(hull.grid, &options, &surface), NURBS_OK);
            CHECK_CLOSE(through_points(surface, hull.grid, &options), 0, 1e-13 * 6);
            nurbs_surface_free(surface);
        }
    hull5415_free(&hull);
}

/* Angle between the one-sided tangents in u at (u,v). */
static double tangent_jump(const nurbs_surface *surface, double u, double v)
{
    nurbs_surface *before = NULL, *after = NULL;
    double p[9], q[9], dot = 0, np = 0, nq = 0;
    const double uv[2] = {u, v};
    CU_ASSERT_EQUAL(nurbs_surface_part(surface, 0, 0, u, &before), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_part(surface, 0, u, 1, &after), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_eval(before, 1, 1, uv, p), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_eval(after, 1, 1, uv, q), NURBS_OK);
    for (int c = 3; c < 6; c++) {
        dot += p[c] * q[c];
        np += p[c] * p[c];
        nq += q[c] * q[c];
    }
    nurbs_surface_free(before);
    nurbs_surface_free(after);
    return acos(fmin(1, dot / sqrt(np * nq)));
}

static void keeps_the_kink_only_where_it_is(void)
{
    enum { ROWS = 31, COLUMNS = 15, KINK = 18 };
    nurbs_grid *grid = kinked_grid(ROWS, COLUMNS, KINK);
    CU_ASSERT_PTR_NOT_NULL_FATAL(grid);
    nurbs_surface *surface;
    double u[ROWS], v[COLUMNS];
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &surface), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_skin_parameters(grid, NULL, u, v), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_size(surface, 0), ROWS + 2);
    /* The keel rises at 1.2 behind the kink: it turns by atan 1.2. */
    CHECK_CLOSE(tangent_jump(surface, u[KINK], 1), atan(1.2), 0.01);
    CHECK_CLOSE(tangent_jump(surface, u[KINK], 0.2), 0, 1e-7);
    CHECK_CLOSE(tangent_jump(surface, u[KINK - 5], 1), 0, 1e-7);
    nurbs_surface_free(surface);

    nurbs_skin_options smooth;
    nurbs_skin_options_init(&smooth);
    smooth.kink_angle = 0;
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, &smooth, &surface), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_size(surface, 0), ROWS);
    CHECK_CLOSE(tangent_jump(surface, u[KINK], 1), 0, 1e-7);
    nurbs_surface_free(surface);
    nurbs_grid_free(grid);
}

/* How far the keel line leaves the band of heights between its neighbouring points, metres: zero
 * for a line that does not overshoot where the points are monotone. */
static double keel_overshoot(const nurbs_surface *surface, size_t rows, const double *u,
                             const nurbs_grid *grid)
{
    size_t columns = nurbs_grid_columns(grid);
    double worst = 0;
    for (size_t i = 0; i + 1 < rows; i++) {
        double a = nurbs_grid_points(grid)[3 * (i * columns + columns - 1) + 2],
               b = nurbs_grid_points(grid)[3 * ((i + 1) * columns + columns - 1) + 2];
        for (int k = 1; k < 16; k++) {
            double uv[2] = {u[i] + (u[i + 1] - u[i]) * k / 16, 1}, p[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, p), NURBS_OK);
            worst = fmax(worst, fmax(fmin(a, b) - p[2], p[2] - fmax(a, b)));
        }
    }
    return worst;
}

static void keel_does_not_overshoot(void)
{
    enum { ROWS = 31, COLUMNS = 15, KINK = 18 };
    nurbs_grid *grid = kinked_grid(ROWS, COLUMNS, KINK);
    CU_ASSERT_PTR_NOT_NULL_FATAL(grid);
    nurbs_surface *kept, *rounded;
    nurbs_skin_options smooth;
    double u[ROWS], v[COLUMNS];
    nurbs_skin_options_init(&smooth);
    smooth.kink_angle = 0;
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &kept), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, &smooth, &rounded), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_skin_parameters(grid, NULL, u, v), NURBS_OK);
    /* A level keel stays level to rounding; without the kink it dips by millimetres. */
    CHECK_CLOSE(keel_overshoot(kept, ROWS, u, grid), 0, 1e-14);
    CU_ASSERT(keel_overshoot(rounded, ROWS, u, grid) > 1e-3);
    nurbs_surface_free(kept);
    nurbs_surface_free(rounded);
    nurbs_grid_free(grid);
}

static void hull_edges_stay_in_the_centre_plane(void)
{
    struct hull5415 hull;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(hull.grid, NULL, &surface), NURBS_OK);
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    const double *p = nurbs_surface_points(surface);
    for (size_t j = 0; j < nv; j++)
        CHECK_CLOSE(p[3 * j + 1], 0, 0);
    for (size_t i = 0; i < nu; i++)
        CHECK_CLOSE(p[3 * (i * nv + nv - 1) + 1], 0, 0);
    CU_ASSERT(lowest_y(surface, 401) >= 0);
    /* Kinks of the keel at stations 20, 23 and 73: two more rows each. */
    CU_ASSERT_EQUAL(nu, 96);
    CU_ASSERT_EQUAL(nv, 25);
    nurbs_surface_free(surface);
    hull5415_free(&hull);
}

/* Kinks so close that a piece has fewer points than degree + 1. */
static void neighbouring_kinks(void)
{
    enum { ROWS = 12, COLUMNS = 5 };
    nurbs_grid *grid;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, NULL, &grid), NURBS_OK);
    double *p = nurbs_grid_edit(grid);
    for (size_t i = 0; i < ROWS; i++)
        for (size_t j = 0; j < COLUMNS; j++, p += 3) {
            p[0] = (double)i;
            p[1] = (double)j;
            p[2] = i == 5 || i == 6 ? 1 : 0; /* kinks at 4, 5, 6 and 7 */
        }
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &surface), NURBS_OK);
    CHECK_CLOSE(through_points(surface, grid, NULL), 0, 1e-13);
    double u[ROWS], v[COLUMNS], q[3];
    CU_ASSERT_EQUAL(nurbs_skin_parameters(grid, NULL, u, v), NURBS_OK);
    const double middle[2] = {0.5 * (u[4] + u[5]), 0.3};
    CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, middle, q), NURBS_OK);
    CHECK_CLOSE(q[2], 0.5, 1e-13); /* a straight piece between two kinks */
    nurbs_surface_free(surface);
    nurbs_grid_free(grid);
}

static void refuses_bad_grids(void)
{
    nurbs_grid *grid = kinked_grid(6, 5, 3);
    nurbs_skin_options options;
    nurbs_surface *surface;
    nurbs_skin_options_init(&options);
    options.degree = 6;
    CU_ASSERT_EQUAL(nurbs_skin(grid, &options, &surface), NURBS_ERROR_ARGUMENT);
    options.degree = 5;
    CU_ASSERT_EQUAL(nurbs_skin(grid, &options, &surface), NURBS_ERROR_ARGUMENT);
    nurbs_grid_edit(grid)[4] = NAN;
    CU_ASSERT_EQUAL(nurbs_skin(grid, NULL, &surface), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(surface);
    nurbs_grid_free(grid);
    grid = kinked_grid(6, 5, 3);
    double *p = nurbs_grid_edit(grid);
    memcpy(p + 15, p, 15 * sizeof *p); /* row 2 = row 1 */
    CU_ASSERT_EQUAL(nurbs_skin(grid, NULL, &surface), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "lines 1 and 2"));
    nurbs_grid_free(grid);
}

/* A sphere octant's arcs as sections: rational, exact union. */
static void skins_curves_exactly(void)
{
    const double knots[6] = {0, 0, 0, 1, 1, 1}, weights[3] = {1, sqrt(0.5), 1};
    nurbs_curve *sections[4];
    for (size_t k = 0; k < 4; k++) {
        double r = 1 + 0.3 * (double)k, x = (double)k, points[9] = {x, r, 0, x, r, r, x, 0, r};
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(2, 3, knots, points, weights, &sections[k]),
                              NURBS_OK);
    }
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_skin_curves(4, (const nurbs_curve *const *)sections, NULL, 3, 0, &surface), NURBS_OK);
    CU_ASSERT_PTR_NOT_NULL(nurbs_surface_weights(surface));
    for (int k = 0; k <= 20; k++) {
        double uv[2] = {k / 20.0, 0.05 * k}, p[3]; /* a cone: radius 1 + 0.3 x */
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, p), NURBS_OK);
        CHECK_CLOSE(hypot(p[1], p[2]), 1 + 0.3 * p[0], 1e-14);
    }
    nurbs_surface_free(surface);
    for (size_t k = 0; k < 4; k++)
        nurbs_curve_free(sections[k]);
}

/* Sections of the hull, each interpolated on its own chord lengths and so with its own knots. */
static size_t own_sections(const struct hull5415 *hull, nurbs_curve **sections)
{
    size_t rows = nurbs_grid_rows(hull->grid), columns = nurbs_grid_columns(hull->grid);
    double u[64];
    for (size_t i = 0; i < rows; i++) {
        const double *p = nurbs_grid_points(hull->grid) + 3 * columns * i;
        CU_ASSERT_EQUAL_FATAL(nurbs_parametrize(NURBS_PARAMETRIZATION_CHORD, columns, p, u),
                              NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_interpolate(3, columns, p, u, &sections[i]), NURBS_OK);
    }
    return rows;
}

static void own_knots_do_not_explode(void)
{
    struct hull5415 hull;
    nurbs_curve *sections[90];
    nurbs_surface *surface;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    size_t n = own_sections(&hull, sections);
    double tolerance = 1e-5 * 5.72, worst = 0, u[90];
    for (size_t k = 0; k < n; k++)
        u[k] = (double)k / (double)(n - 1);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_skin_curves(n, (const nurbs_curve *const *)sections, u, 3, tolerance, &surface),
        NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_size(surface, 0), 90);
    CU_ASSERT(nurbs_surface_size(surface, 1) <= 45);
    for (size_t k = 0; k < n; k++)
        for (int t = 0; t <= 500; t++) {
            double uv[2] = {u[k], t / 500.0}, p[3], q[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, p), NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_curve_eval(sections[k], 0, 1, &uv[1], q), NURBS_OK);
            worst = fmax(worst, hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]));
        }
    CHECK_CLOSE(worst, 0, 1.02 * tolerance);
    nurbs_surface_free(surface);
    for (size_t k = 0; k < n; k++)
        nurbs_curve_free(sections[k]);
    hull5415_free(&hull);
}

/* Knots that differ in the last digit are one knot. */
static void rounding_does_not_double_knots(void)
{
    nurbs_curve *sections[2];
    const double points[15] = {0, 0, 0, 1, 0, 0, 2, 1, 0, 3, 1, 0, 4, 0, 0};
    double lifted[15];
    for (size_t k = 0; k < 2; k++) {
        double knots[9] = {0, 0, 0, 0, k ? 1.0 / 3 : 0.33333333333333326, 1, 1, 1, 1};
        for (size_t i = 0; i < 15; i++)
            lifted[i] = points[i] + (i % 3 == 2 ? (double)k : 0);
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(3, 5, knots, lifted, NULL, &sections[k]),
                              NURBS_OK);
    }
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_skin_curves(2, (const nurbs_curve *const *)sections, NULL, 1, 0, &surface), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_size(surface, 1), 5);
    nurbs_surface_free(surface);
    CU_ASSERT_EQUAL(
        nurbs_skin_curves(2, (const nurbs_curve *const *)sections, NULL, 2, 0, &surface),
        NURBS_ERROR_ARGUMENT);
    for (size_t k = 0; k < 2; k++)
        nurbs_curve_free(sections[k]);
}

/* A hard-chine hull: straight bottom from the keel to the chine (column CHINE), a straight side
 * above. Forward of half its length the chine fades into a round section. */
enum { HARD_ROWS = 21, HARD_COLUMNS = 13, CHINE = 7 };

static nurbs_grid *hard_chine_grid(int fades)
{
    nurbs_grid *grid;
    if (nurbs_grid_create(HARD_ROWS, HARD_COLUMNS, NULL, &grid) != NURBS_OK)
        return NULL;
    for (size_t i = 0; i < HARD_ROWS; i++)
        for (size_t j = 0; j < HARD_COLUMNS; j++) {
            double *p = nurbs_grid_edit(grid) + 3 * (i * HARD_COLUMNS + j);
            const double x = (double)i / (HARD_ROWS - 1);
            const double side = (double)j / CHINE;
            const double bottom = ((double)j - CHINE) / (HARD_COLUMNS - 1 - CHINE);
            const double hard[2] = {j <= CHINE ? 1.2 - 0.2 * side : 1.0 - bottom,
                                    j <= CHINE ? 0.8 - side : -0.2 - 0.3 * bottom};
            const double angle = 1.5707963267948966 * (double)j / (HARD_COLUMNS - 1);
            const double around[2] = {1.2 * cos(angle), 0.8 - 1.3 * sin(angle)};
            const double share = fades && x > 0.5 ? fmin(1.0, 4.0 * (x - 0.5)) : 0.0;
            p[0] = 10.0 * x;
            for (size_t c = 0; c < 2; c++)
                p[1 + c] = (1.0 - share) * hard[c] + share * around[c];
            if (j == HARD_COLUMNS - 1)
                p[1] = 0.0;
        }
    return grid;
}

/* Angle between the one-sided tangents in v. */
static double girth_jump(const nurbs_surface *surface, double u, double v)
{
    const double uv[2] = {u, v};
    double left[9], right[9], dot = 0, nl = 0, nr = 0;
    CU_ASSERT_EQUAL(nurbs_surface_eval_sided(surface, 1, 2, 1, uv, left), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_eval_sided(surface, 1, 0, 1, uv, right), NURBS_OK);
    for (int c = 6; c < 9; c++) {
        dot += left[c] * right[c];
        nl += left[c] * left[c];
        nr += right[c] * right[c];
    }
    return acos(fmin(1, dot / sqrt(nl * nr)));
}

/* With its chine named a prismatic hull is its two flat panels, and without it is not. */
static void chine_of_a_prism(void)
{
    const size_t chine = CHINE;
    nurbs_grid *grid = hard_chine_grid(0);
    CU_ASSERT_PTR_NOT_NULL_FATAL(grid);
    double u[HARD_ROWS], v[HARD_COLUMNS];
    for (int named = 0; named < 2; named++) {
        nurbs_skin_options options;
        nurbs_surface *surface;
        nurbs_skin_options_init(&options);
        options.parametrize = NURBS_PARAMETRIZATION_CHORD;
        options.chine_count = (size_t)named;
        options.chine = &chine;
        CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, &options, &surface), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_skin_parameters(grid, &options, u, v), NURBS_OK);
        CHECK_CLOSE(through_points(surface, grid, &options), 0, 1e-12);
        double worst = 0;
        for (int k = 0; k <= 400; k++) {
            const double uv[2] = {0.37, k / 400.0};
            double p[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, p), NURBS_OK);
            const double on = p[2] > -0.2 ? p[1] - (1.0 + 0.2 * (p[2] + 0.2)) /* side */
                                          : p[2] - (-0.5 + 0.3 * p[1]);       /* bottom */
            worst = fmax(worst, fabs(on));
        }
        if (named) {
            CU_ASSERT_EQUAL(nurbs_surface_size(surface, 1), HARD_COLUMNS + 2);
            CU_ASSERT(worst < 1e-12);
            CHECK_CLOSE(girth_jump(surface, 0.37, v[CHINE]), atan2(1.0, 0.2) - atan2(0.3, 1.0),
                        1e-10);
        } else {
            CU_ASSERT(worst > 1e-3);
        }
        nurbs_surface_free(surface);
    }
    nurbs_grid_free(grid);
}

/* The kink stays as far as the sections turn, and simplification keeps it. */
static void chine_that_fades(void)
{
    const size_t chine = CHINE;
    nurbs_grid *grid = hard_chine_grid(1);
    CU_ASSERT_PTR_NOT_NULL_FATAL(grid);
    double u[HARD_ROWS], v[HARD_COLUMNS], bound;
    nurbs_skin_options options;
    nurbs_surface *surface, *light;
    nurbs_skin_options_init(&options);
    options.chine_count = 1;
    options.chine = &chine;
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, &options, &surface), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_skin_parameters(grid, &options, u, v), NURBS_OK);
    CHECK_CLOSE(through_points(surface, grid, &options), 0, 1e-12);
    const double turn = atan2(1.0, 0.2) - atan2(0.3, 1.0);
    for (size_t i = 0; i <= 8; i++)
        CHECK_CLOSE(girth_jump(surface, u[i], v[CHINE]), turn, 0.1);
    for (size_t i = 16; i < HARD_ROWS; i++)
        CU_ASSERT(girth_jump(surface, u[i], v[CHINE]) < 1e-6);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_simplify(surface, 1e-3, NURBS_SIMPLIFY_KEEP_KINKS, &light, &bound), NURBS_OK);
    CU_ASSERT(bound <= 1e-3);
    CHECK_CLOSE(girth_jump(light, 0.2, v[CHINE]), turn, 0.15);
    nurbs_surface_free(light);
    nurbs_surface_free(surface);

    const size_t bad[2] = {CHINE, CHINE};
    options.chine = bad;
    options.chine_count = 2;
    CU_ASSERT_EQUAL(nurbs_skin(grid, &options, &surface), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(surface);
    options.chine = NULL;
    CU_ASSERT_EQUAL(nurbs_skin(grid, &options, &surface), NURBS_ERROR_ARGUMENT);
    nurbs_grid_free(grid);
}

/* Sections given as curves with a corner of their own: the union keeps it. */
static void chine_of_section_curves(void)
{
    enum { SECTIONS = 5 };
    nurbs_curve *sections[SECTIONS];
    nurbs_surface *surface;
    for (size_t i = 0; i < SECTIONS; i++) {
        const double knots[11] = {0, 0, 0, 0, 0.4, 0.4, 0.4, 1, 1, 1, 1};
        double p[21];
        for (int k = 0; k < 7; k++) {
            const double side = k / 3.0, bottom = (k - 3) / 3.0, f = 1.0 + 0.1 * (double)i;
            p[3 * k] = 2.0 * (double)i;
            p[3 * k + 1] = f * (k <= 3 ? 1.2 - 0.2 * side : 1.0 - bottom);
            p[3 * k + 2] = k <= 3 ? 0.8 - side : -0.2 - 0.3 * bottom;
        }
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(3, 7, knots, p, NULL, &sections[i]), NURBS_OK);
    }
    CU_ASSERT_EQUAL_FATAL(
        nurbs_skin_curves(SECTIONS, (const nurbs_curve *const *)sections, NULL, 3, 0, &surface),
        NURBS_OK);
    CHECK_CLOSE(girth_jump(surface, 0, 0.4), atan2(1.0, 0.2) - atan2(0.3, 1.0), 1e-12);
    CHECK_CLOSE(girth_jump(surface, 0.3, 0.7), 0, 1e-7);
    CU_ASSERT(girth_jump(surface, 0.61, 0.4) > 1.0);
    nurbs_surface_free(surface);
    for (size_t i = 0; i < SECTIONS; i++)
        nurbs_curve_free(sections[i]);
}

/* Plane sections at x = 0 ... 5 of two straight lines each, deck edge to chine to keel, whose
 * corner wanders along the parameter. */
static void corners_that_wander(void)
{
    enum { N = 6 };
    nurbs_curve *section[N];
    for (int k = 0; k < N; k++) {
        const double t = 0.4 + 0.01 * k, knots[11] = {0, 0, 0, 0, t, t, t, 1, 1, 1, 1},
                     corner[3][3] = {{k, 3 + 0.1 * k, 2}, {k, 3, -1}, {k, 0, -2}};
        double points[21];
        for (int i = 0; i < 7; i++)
            for (int d = 0; d < 3; d++) {
                const double *a = corner[i / 3 < 2 ? i / 3 : 1], *b = a + 3;
                points[3 * i + d] = a[d] + (b[d] - a[d]) * (i - (i < 6 ? i / 3 * 3 : 3)) / 3.0;
            }
        CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(3, 7, knots, points, NULL, &section[k]), NURBS_OK);
    }
    for (double tolerance = 1e-2; tolerance > 5e-6; tolerance /= 10) {
        nurbs_surface *surface = NULL;
        double area, worst = 0;
        CU_ASSERT_EQUAL_FATAL(
            nurbs_skin_curves(N, (const nurbs_curve *const *)section, NULL, 3, tolerance, &surface),
            NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_surface_area(surface, &area, NULL), NURBS_OK);
        CHECK_RELATIVE(area, 30.9, 1e-2);
        const double *net = nurbs_surface_points(surface);
        for (size_t i = 0; i < nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1); i++)
            CU_ASSERT(net[3 * i] > -0.5 && net[3 * i] < 5.5 && net[3 * i + 1] > -0.5 &&
                      net[3 * i + 1] < 4 && fabs(net[3 * i + 2]) < 2.5);
        for (int k = 0; k < N; k++)
            for (int i = 0; i <= 97; i++) {
                double u = i / 97.0, p[3], uv[2], away;
                CU_ASSERT_EQUAL(nurbs_curve_eval(section[k], 0, 1, &u, p), NURBS_OK);
                CU_ASSERT_EQUAL(nurbs_surface_closest(surface, 1, p, uv, &away), NURBS_OK);
                worst = fmax(worst, away);
            }
        CHECK_CLOSE(worst, 0, tolerance);
        nurbs_surface_free(surface);
    }
    for (int k = 0; k < N; k++)
        nurbs_curve_free(section[k]);
}

/* Sections with a thin skeg below a broad body: the cubic through them reaches far across the
 * centre plane, unless the corners are named. */
static void light_skin_keeps_its_tolerance(void)
{
    enum { ROWS = 7, COLUMNS = 9 };
    nurbs_grid *grid;
    nurbs_surface *surface = NULL;
    double bound, worst = 0;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, NULL, &grid), NURBS_OK);
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double s = i / (ROWS - 1.0), *p = nurbs_grid_edit(grid) + 3 * (i * COLUMNS + j);
            p[0] = 40 * s;
            p[1] = j < 4 ? 4 * sin(s * 3.14159265358979323846) : j == COLUMNS - 1 ? 0 : 0.01;
            p[2] = 4 - 0.5 * j;
        }
    CU_ASSERT_EQUAL(nurbs_skin_light(grid, NULL, 1e-3, &surface, &bound), NURBS_ERROR_NUMERIC);
    CU_ASSERT_PTR_NULL(surface);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "overshoots the centre plane"));
    CU_ASSERT_EQUAL_FATAL(nurbs_skin_light(grid, NULL, 2, &surface, &bound), NURBS_OK);
    const double *points = nurbs_grid_points(grid);
    for (size_t k = 0; k < ROWS * COLUMNS; k++) {
        double uv[2], away;
        CU_ASSERT_EQUAL(nurbs_surface_closest(surface, 1, points + 3 * k, uv, &away), NURBS_OK);
        worst = fmax(worst, away);
    }
    CU_ASSERT(worst > 1e-3 && worst <= bound && bound <= 2 && lowest_y(surface, 101) > -1e-9);
    nurbs_surface_free(surface);
    nurbs_grid_free(grid);
}

static const struct check_case cases[] = {
    {"light skin keeps its tolerance", light_skin_keeps_its_tolerance},
    {"corners that wander", corners_that_wander},
    {"chine of a prism", chine_of_a_prism},
    {"chine that fades", chine_that_fades},
    {"chine of section curves", chine_of_section_curves},
    {"passes through every point", passes_through_every_point},
    {"keeps the kink only where it is", keeps_the_kink_only_where_it_is},
    {"keel does not overshoot", keel_does_not_overshoot},
    {"hull edges stay in the centre plane", hull_edges_stay_in_the_centre_plane},
    {"neighbouring kinks", neighbouring_kinks},
    {"refuses bad grids", refuses_bad_grids},
    {"skins curves exactly", skins_curves_exactly},
    {"own knots do not explode", own_knots_do_not_explode},
    {"rounding does not double knots", rounding_does_not_double_knots},
};

CHECK_MAIN("nurbs skin", cases)
