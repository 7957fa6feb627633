#include "core/waves.h"

#include "core/attitude.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The pictured field in lengths: ahead, astern and abeam of the hull. */
static const double AHEAD = 0.2, ASTERN = 1.0, ABEAM = 0.65;

/* A free surface that was solved on a grid of its own bounds the picture; its lines run along the
 * hull, so that the outermost is straight. */
static bool keep_within_surface(const igabem_solution *solution, double x[2], double *side)
{
    size_t size[2];
    if (igabem_free_surface_grid(solution, size, NULL, NULL) != IGABEM_OK)
        return true;
    size_t n = size[0] * size[1];
    double *at = malloc(2 * n * sizeof *at);
    if (!at)
        return core_no_memory();
    bool ok = igabem_free_surface_grid(solution, size, at, at + n) == IGABEM_OK ||
              core_fail("waves: %s", igabem_last_error());
    if (ok) {
        x[0] = fmax(x[0], at[n - 1]);
        x[1] = fmin(x[1], at[0]);
        *side = fmin(*side, at[2 * n - 1]);
    }
    free(at);
    return ok;
}

static bool make_field(const struct problem *problem, const struct design *design,
                       const igabem_solution *solution, struct waves *w)
{
    const struct config *config = problem->config;
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(design->hull);
    double length = problem_length(problem), side = ABEAM * length;
    double x[2] = {h->x_aft - ASTERN * length, h->x_fore + AHEAD * length};
    if (!keep_within_surface(solution, x, &side))
        return false;
    *w = (struct waves){.nx = config->waves_along, .ny = config->waves_across, .x0 = x[0]};
    w->dx = (x[1] - x[0]) / (double)(w->nx - 1);
    w->dy = side / (double)(w->ny - 1);
    w->elevation = malloc(w->nx * w->ny * sizeof *w->elevation);
    return w->elevation || core_no_memory();
}

/* All points in one call: the solver sums their waves in order from bow to stern. */
static bool elevations(const igabem_solution *solution, struct waves *w)
{
    size_t n = w->nx * w->ny;
    double *x = malloc(2 * n * sizeof *x);
    if (!x)
        return core_no_memory();
    double *y = x + n;
    for (size_t k = 0; k < n; k++) {
        x[k] = w->x0 + (double)(k / w->ny) * w->dx;
        y[k] = w->y0 + (double)(k % w->ny) * w->dy;
    }
    bool ok = igabem_wave_elevation(solution, n, x, y, w->elevation) == IGABEM_OK ||
              core_fail("waves: %s", igabem_last_error());
    free(x);
    return ok;
}

/* Names of the arrays of a pattern: its frame and its elevations. */
static const char *const NAMES[2][2] = {{"waves.parent.frame", "waves.parent"},
                                        {"waves.best.frame", "waves.best"}};

static bool compute(const struct problem *problem, bool best, struct record *record)
{
    const struct design *design = best ? &problem->best : &problem->parent;
    igabem_solution *solution = NULL;
    struct waves w = {.elevation = NULL};
    struct attitude attitude;
    bool ok = attitude_find(problem, design, problem->solver.froude, &attitude) &&
              (igabem_solve(attitude.body, &problem->solver, &solution) == IGABEM_OK ||
               core_fail("waves: %s", igabem_last_error()));
    ok = ok && make_field(problem, design, solution, &w) && elevations(solution, &w);
    const double frame[] = {w.x0, w.dx, w.y0, w.dy};
    ok = ok && record_put_array(record, NAMES[best][0], 1, 4, frame) &&
         record_put_array(record, NAMES[best][1], w.nx, w.ny, w.elevation);
    free(w.elevation);
    igabem_solution_free(solution);
    attitude_free(&attitude);
    return ok;
}

bool waves_run(const struct problem *problem, struct record *record, const struct core_watch *watch)
{
    bool ok = true;
    for (int best = 0; best < (problem->best.hull ? 2 : 1) && ok; best++) {
        struct waves w;
        core_show(watch, "wave patterns", best / 2.0, NULL);
        ok = core_goes_on(watch) && waves_read(record, best, &w) &&
             (w.elevation || compute(problem, best, record));
        free(w.elevation);
    }
    return ok && record_update_session(record);
}

bool waves_read(const struct record *record, bool best, struct waves *w)
{
    size_t rows, columns;
    double *frame;
    *w = (struct waves){0};
    if (!record_get_array(record, NAMES[best][0], &rows, &columns, &frame))
        return false;
    bool ok = true;
    if (frame && rows * columns == 4) {
        *w = (struct waves){.x0 = frame[0], .dx = frame[1], .y0 = frame[2], .dy = frame[3]};
        ok = record_get_array(record, NAMES[best][1], &w->nx, &w->ny, &w->elevation);
    }
    free(frame);
    return ok;
}
