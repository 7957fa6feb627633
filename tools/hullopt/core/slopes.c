#include "core/slopes.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Half widths of the box, one after the other to both sides: the points of a hull are linear in u,
 * but the cut at the water line may have other knots on the hull beside it, which shifts points
 * along the surface. */
static const double STEP[] = {0.05, 0.25, 0.01};
enum { STEPS = sizeof STEP / sizeof *STEP };
/* How far points move along x and z, of the largest move, from that: no other step is tried; more
 * is no move athwartships. In the centre plane: from rounding. */
static const double CALM = 1e-3, ASTRAY = 1e-2, ROUNDING = 1e-6;
static const double CENTRE = 1e-9; /* of the length: such points lie in the centre plane */

static void keep_systems(struct problem *problem, bool keep)
{
    problem->solver.keep_system = keep;
    for (size_t i = 0; i < problem->speeds; i++)
        problem->speed[i].keep_system = keep;
}

bool slopes_has(const struct problem *problem, const igabem_options *setting)
{
    return igabem_formulation_info(setting->formulation)->tangents &&
           nurbs_hull_is_half(problem->parent.hull);
}

void slopes_start(struct problem *problem, struct slopes *s)
{
    *s = (struct slopes){.problem = problem};
    keep_systems(problem, true);
    s->n = evaluate_settings(problem, s->setting);
    for (size_t m = 0; m < s->n; m++)
        s->has[m] = slopes_has(problem, &s->setting[m]);
    if (!slopes_any(s))
        keep_systems(problem, false);
}

static void let_go(struct slopes_held *held)
{
    for (size_t m = 0; m < SETTINGS_MOST; m++)
        igabem_solution_free(held->solution[m]);
    free(held->u);
    *held = (struct slopes_held){0};
}

void slopes_end(struct slopes *s)
{
    if (!s->problem)
        return;
    keep_systems(s->problem, false);
    for (int i = 0; i < SLOPES_HELD; i++)
        let_go(&s->held[i]);
    slopes_close(s);
}

bool slopes_any(const struct slopes *s)
{
    bool any = false;
    for (size_t m = 0; m < s->n; m++)
        any = any || s->has[m];
    return any;
}

/* Puts what is held at the place `from` first. */
static void bring_forward(struct slopes *s, int from)
{
    struct slopes_held first = s->held[from];
    for (int i = from; i > 0; i--)
        s->held[i] = s->held[i - 1];
    s->held[0] = first;
}

void slopes_keep(struct slopes *s, const double *u, igabem_solution **solutions)
{
    size_t modes = galv_model_modes(s->problem->model);
    if (!slopes_any(s))
        return;
    bring_forward(s, SLOPES_HELD - 1);
    let_go(&s->held[0]);
    s->held[0].u = calloc(modes, sizeof *u);
    if (!s->held[0].u)
        return; /* solved again when it is asked for */
    if (u)
        memcpy(s->held[0].u, u, modes * sizeof *u);
    for (size_t m = 0; m < s->n; m++)
        if (s->has[m]) {
            s->held[0].solution[m] = solutions[m];
            solutions[m] = NULL;
        }
}

static bool hold(struct slopes *s, const double *u)
{
    size_t modes = galv_model_modes(s->problem->model), n = 0;
    for (int i = 0; i < SLOPES_HELD; i++)
        if (s->held[i].u && memcmp(s->held[i].u, u, modes * sizeof *u) == 0) {
            bring_forward(s, i);
            return true;
        }
    igabem_options setting[SETTINGS_MOST];
    igabem_solution *found[SETTINGS_MOST], *solutions[SETTINGS_MOST] = {NULL};
    for (size_t m = 0; m < s->n; m++)
        if (s->has[m])
            setting[n++] = s->setting[m];
    if (!core_ok(igabem_solve_many(s->design.body, n, setting, found), "solve: %s",
                 igabem_last_error()))
        return false;
    n = 0;
    for (size_t m = 0; m < s->n; m++)
        if (s->has[m])
            solutions[m] = found[n++];
    slopes_keep(s, u, solutions);
    for (size_t m = 0; m < s->n; m++)
        igabem_solution_free(solutions[m]);
    return s->held[0].u || core_no_memory();
}

static size_t surface_points(const nurbs_surface *surface)
{
    return nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
}

static size_t count_points(const nurbs_patches *patches)
{
    size_t points = 0;
    for (size_t p = 0; p < nurbs_patches_count(patches); p++)
        points += surface_points(nurbs_patches_get(patches, p));
    return points;
}

/* Moves of n control points for a unit of a variable, athwartships. Returns how far they were along
 * x and z, of the largest. */
static double clean(size_t n, const nurbs_patches *at, double step, double length, double *move)
{
    double largest = 0, astray = 0;
    for (size_t i = 0; i < n; i++) {
        largest = fmax(largest, fabs(move[3 * i + 1]));
        astray = fmax(astray, fmax(fabs(move[3 * i]), fabs(move[3 * i + 2])));
    }
    for (size_t p = 0; p < nurbs_patches_count(at); p++) {
        const nurbs_surface *surface = nurbs_patches_get(at, p);
        const double *point = nurbs_surface_points(surface);
        for (size_t i = 0; i < surface_points(surface); i++, move += 3) {
            bool centre = fabs(point[3 * i + 1]) <= CENTRE * length;
            move[1] = centre && fabs(move[1]) <= ROUNDING * largest ? 0 : move[1] / step;
            move[0] = move[2] = 0;
        }
    }
    return largest > 0 ? astray / largest : astray > 0 ? DBL_MAX : 0;
}

/* By the hull a step away; INFINITY where none can be built. */
static double try_step(struct slopes *s, double *u, size_t k, double step, size_t n, double *move)
{
    double keep = u[k], astray = INFINITY;
    nurbs_hull *hull;
    u[k] = keep + step;
    if (problem_build_hull(s->problem, u, &hull)) {
        if (core_ok(nurbs_hull_moves(s->design.hull, hull, move), "moves: %s", nurbs_last_error()))
            astray =
                clean(n, nurbs_hull_light(s->design.hull), step, problem_length(s->problem), move);
    }
    nurbs_hull_free(hull);
    u[k] = keep;
    return astray;
}

/* Moves of n control points by variable k: of the steps within the box the calmest. */
static bool move_along(struct slopes *s, double *u, size_t k, size_t n, double *spare, double *move)
{
    double low = galv_model_lower(s->problem->model)[k],
           high = galv_model_upper(s->problem->model)[k];
    double least = INFINITY;
    for (int i = 0; i < 2 * STEPS && !(least <= CALM); i++) {
        double step = (i % 2 ? -1 : 1) * STEP[i / 2] * (high - low) / 2;
        if (u[k] + step < low || u[k] + step > high)
            continue;
        double astray = try_step(s, u, k, step, n, spare);
        if (astray < least)
            memcpy(move, spare, 3 * n * sizeof *move);
        least = fmin(least, astray);
    }
    if (isfinite(least) && !(least <= ASTRAY))
        core_fail("variable %zu moves points along x or z too", k);
    return least <= ASTRAY;
}

bool slopes_moves(struct slopes *s, const double *u)
{
    size_t modes = galv_model_modes(s->problem->model);
    size_t points = count_points(nurbs_hull_light(s->design.hull));
    double *at = malloc((modes + 3 * points) * sizeof *at);
    free(s->move);
    s->move = malloc(3 * modes * points * sizeof *s->move);
    bool ok = (at && s->move) || core_no_memory();
    if (ok)
        memcpy(at, u, modes * sizeof *at);
    for (size_t k = 0; k < modes && ok; k++)
        ok = move_along(s, at, k, points, at + modes, s->move + 3 * points * k);
    free(at);
    return ok;
}

bool slopes_open(struct slopes *s, const double *u)
{
    slopes_close(s);
    return problem_build(s->problem, u, &s->design) && slopes_moves(s, u) && hold(s, u);
}

void slopes_close(struct slopes *s)
{
    design_free(&s->design);
    free(s->move);
    s->move = NULL;
}

bool slopes_setting(const struct slopes *s, size_t m, const size_t parts[2], double *dr,
                    double *darea, igabem_pressure_sample *dsample,
                    const igabem_solution **solution)
{
    igabem_tangent *tangent;
    *solution = s->held[0].solution[m];
    igabem_status status = igabem_tangent_create(
        s->design.body, *solution, galv_model_modes(s->problem->model), s->move, &tangent);
    if (status == IGABEM_OK)
        status = igabem_tangent_residuals(tangent, dr);
    if (status == IGABEM_OK)
        status = igabem_tangent_wetted_area(tangent, darea);
    if (status == IGABEM_OK && dsample)
        status = igabem_tangent_samples(tangent, parts[0], parts[1], dsample);
    igabem_tangent_free(tangent);
    return core_ok(status, "tangents: %s", igabem_last_error());
}

bool slopes_cw(const struct slopes *s, size_t m, double *dcw)
{
    igabem_tangent *tangent;
    igabem_status status =
        igabem_tangent_create(s->design.body, s->held[0].solution[m],
                              galv_model_modes(s->problem->model), s->move, &tangent);
    if (status == IGABEM_OK)
        status = igabem_tangent_cw(tangent, dcw);
    igabem_tangent_free(tangent);
    return core_ok(status, "tangents: %s", igabem_last_error());
}
