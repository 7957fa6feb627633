#include "waves.h"

#include "cli.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The pictured field in lengths: ahead, astern and abeam of the hull. */
static const double AHEAD = 0.2, ASTERN = 1.0, ABEAM = 0.65;

static bool field(const struct config *config, const igabem_hull *hull, double length,
                  struct waves *w)
{
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    double first = info.hydrostatics.x_aft - ASTERN * length;
    double last = info.hydrostatics.x_fore + AHEAD * length;
    *w =
        (struct waves){.nx = config->waves_along, .ny = config->waves_across, .x0 = first, .y0 = 0};
    w->dx = (last - first) / (double)(w->nx - 1);
    w->dy = ABEAM * length / (double)(w->ny - 1);
    w->elevation = malloc(w->nx * w->ny * sizeof *w->elevation);
    return w->elevation != NULL;
}

/* All points in one call: the solver sums their waves in order from bow to stern. */
static bool elevations(const igabem_solution *solution, struct waves *w)
{
    size_t n = w->nx * w->ny;
    double *x = malloc(2 * n * sizeof *x);
    if (!x)
        return cli_fail("out of memory") == CLI_OK;
    double *y = x + n;
    for (size_t k = 0; k < n; k++) {
        x[k] = w->x0 + (double)(k / w->ny) * w->dx;
        y[k] = w->y0 + (double)(k % w->ny) * w->dy;
    }
    bool ok = igabem_wave_elevation(solution, n, x, y, w->elevation) == IGABEM_OK ||
              cli_fail("waves: %s", igabem_last_error()) == CLI_OK;
    free(x);
    return ok;
}

static bool save(struct store *store, const char *which, const struct waves *w)
{
    char name[40];
    const double frame[] = {w->x0, w->dx, w->y0, w->dy};
    snprintf(name, sizeof name, "waves.%s.frame", which);
    if (!store_put_array(store, name, 1, 4, frame))
        return false;
    snprintf(name, sizeof name, "waves.%s", which);
    return store_put_array(store, name, w->nx, w->ny, w->elevation);
}

static bool compute(const struct config *config, struct evaluator *evaluator, const double *u,
                    const char *which, struct store *store)
{
    struct design design;
    struct failure failure;
    struct waves w = {0};
    igabem_hull *hull;
    igabem_solution *solution = NULL;
    if (!evaluate_build(evaluator, u, &design, &hull, &failure))
        return cli_fail("waves: %s: %s", failure.stage, failure.reason) == CLI_OK;
    bool ok = field(config, hull, evaluator->parent->length, &w);
    if (!ok)
        cli_fail("out of memory");
    if (ok && igabem_solve(hull, &evaluator->solver, &solution) != IGABEM_OK)
        ok = cli_fail("waves: %s", igabem_last_error()) == CLI_OK;
    ok = ok && elevations(solution, &w);
    ok = ok && save(store, which, &w);
    free(w.elevation);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    design_free(&design);
    return ok;
}

bool waves_run(const struct config *config, struct evaluator *evaluator, const double *best,
               struct store *store)
{
    static const char *const names[] = {"parent", "best"};
    const double *points[] = {NULL, best};
    struct cli_progress progress;
    bool ok = true;
    cli_progress_start(&progress, "wave patterns");
    for (int k = 0; k < (best ? 2 : 1) && ok; k++) {
        struct waves w;
        if (waves_load(store, names[k], &w))
            free(w.elevation);
        else
            ok = compute(config, evaluator, points[k], names[k], store);
        cli_progress_update(&progress, (k + 1) / 2.0, NULL);
    }
    cli_progress_end(&progress);
    return ok && store_update_session(store);
}

bool waves_load(struct store *store, const char *which, struct waves *w)
{
    char name[40];
    size_t rows = 0, columns = 0;
    *w = (struct waves){0};
    snprintf(name, sizeof name, "waves.%s.frame", which);
    double *frame = store_get_array(store, name, &rows, &columns);
    if (!frame || rows * columns != 4) {
        free(frame);
        return false;
    }
    w->x0 = frame[0];
    w->dx = frame[1];
    w->y0 = frame[2];
    w->dy = frame[3];
    free(frame);
    snprintf(name, sizeof name, "waves.%s", which);
    w->elevation = store_get_array(store, name, &w->nx, &w->ny);
    return w->elevation != NULL;
}
