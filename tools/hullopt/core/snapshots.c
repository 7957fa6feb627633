#include "core/snapshots.h"

#include <bayesopt/design.h>

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char STAGE[] = "hulls of the command";
enum { STEPS = 4 };
/* A step that brings the hull less nearer than that is the last; singular values below that share
 * of the largest belong to parameters without an effect. */
static const double WORTH = 0.95, RANK = 1e-6;

static size_t count_points(const struct problem *p)
{
    return nurbs_grid_rows(p->grid) * nurbs_grid_columns(p->grid);
}

/* Of parameter k as the map has it: 1 is half of its range. */
static double unit_of(const struct config *c, size_t k)
{
    return (c->upper[k] - c->lower[k]) / 2;
}

/* Least norm of the least squares of a x = b, a [m x n] and b [max(m, n) x count], which are
 * overwritten, the solution in b. */
static bool solve(size_t m, size_t n, size_t count, double *a, double *b)
{
    lapack_int rank, least = (lapack_int)(m < n ? m : n);
    double *singular = malloc((size_t)least * sizeof *singular);
    if (!singular)
        return core_no_memory();
    lapack_int info =
        LAPACKE_dgelsd(LAPACK_ROW_MAJOR, (lapack_int)m, (lapack_int)n, (lapack_int)count, a,
                       (lapack_int)n, b, (lapack_int)count, singular, RANK, &rank);
    free(singular);
    if (info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR)
        return core_no_memory();
    return info == 0 || core_fail("parameters.snapshots: their linear map cannot be found");
}

/* The change of the latent coordinates by each parameter, [modes x parameters], by least squares
 * over n snapshots: x [n x parameters], d [n x coordinates]. */
static bool find_map(struct problem *p, const galv_model *model, size_t n, const double *x,
                     const double *d)
{
    size_t modes = galv_model_modes(model), params = p->config->n_parameters,
           length = 3 * count_points(p), rows = n > params ? n : params;
    double *a = malloc(n * params * sizeof *a), *b = calloc(rows * modes, sizeof *b);
    p->map = malloc(modes * params * sizeof *p->map);
    bool ok = (a && b && p->map) || core_no_memory();
    for (size_t i = 0; i < n && ok; i++) {
        for (size_t k = 0; k < params; k++)
            a[i * params + k] = x[i * params + k] / unit_of(p->config, k);
        ok = galv_project(model, d + i * length, b + i * modes) == GALV_OK ||
             core_fail("%s", galv_last_error());
    }
    ok = ok && solve(n, params, modes, a, b);
    for (size_t k = 0; k < params && ok; k++)
        for (size_t j = 0; j < modes; j++)
            p->map[j * params + k] = b[k * modes + j];
    free(a);
    free(b);
    return ok;
}

/* Changes of the parameters, [n x parameters]. */
static bool draw(const struct config *c, double *x)
{
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = c->latent_seed;
    size_t n = c->snapshots, d = c->n_parameters;
    if (bayesopt_design(BAYESOPT_DESIGN_LHS, n, d, &options, x) != BAYESOPT_OK)
        return core_fail("%s", bayesopt_last_error());
    for (size_t i = 0; i < n * d; i++) {
        size_t k = i % d;
        x[i] = c->lower[k] + x[i] * (c->upper[k] - c->lower[k]) - c->original[k];
    }
    return true;
}

/* Those that can be made take the first places. */
static bool make_all(struct problem *p, const struct core_watch *watch, double *x, double *d,
                     size_t *made)
{
    const struct config *c = p->config;
    size_t params = c->n_parameters, length = 3 * count_points(p);
    const double *parent = nurbs_grid_points(p->grid);
    *made = 0;
    for (size_t i = 0; i < c->snapshots; i++) {
        double *row = d + *made * length;
        if (!core_goes_on(watch))
            return false;
        core_show(watch, STAGE, (double)i / (double)c->snapshots, NULL);
        if (!problem_make_points(p, x + i * params, row)) {
            core_tell(watch, "snapshot %zu failed: %s", i + 1, core_sentence());
            continue;
        }
        for (size_t k = 0; k < length; k++)
            row[k] -= parent[k];
        memmove(x + *made * params, x + i * params, params * sizeof *x);
        ++*made;
    }
    return *made > params ||
           core_fail("%s: the command made %zu hulls of %zu, expected more than the %zu parameters",
                     c->path, *made, c->snapshots, params);
}

bool snapshots_reduce(struct problem *p, const galv_options *options,
                      const struct core_watch *watch, galv_model **model)
{
    const struct config *c = p->config;
    size_t length = 3 * count_points(p), made;
    double *x = malloc(c->snapshots * c->n_parameters * sizeof *x);
    double *d = malloc(c->snapshots * length * sizeof *d);
    *model = NULL;
    bool ok = ((x && d) || core_no_memory()) && draw(c, x) && make_all(p, watch, x, d, &made);
    if (ok) {
        const galv_data data = {.count = made,
                                .coordinates = length,
                                .values = d,
                                .npoints = count_points(p),
                                .xyz = nurbs_grid_points(p->grid)};
        ok = (galv_build_data(&data, options, model) == GALV_OK ||
              core_fail("%s: %s", c->path, galv_last_error())) &&
             find_map(p, *model, made, x, d);
    }
    free(x);
    free(d);
    if (!ok)
        galv_model_free(*model);
    return ok;
}

bool snapshots_invert(struct problem *p)
{
    size_t modes = galv_model_modes(p->model), params = p->config->n_parameters,
           rows = modes > params ? modes : params;
    double *a = malloc(modes * params * sizeof *a), *b = calloc(rows * modes, sizeof *b);
    bool ok = (a && b) || core_no_memory();
    for (size_t j = 0; j < modes && ok; j++)
        b[j * modes + j] = 1;
    if (ok)
        memcpy(a, p->map, modes * params * sizeof *a);
    ok = ok && solve(modes, params, modes, a, b);
    free(a);
    free(p->back);
    p->back = ok ? b : NULL;
    if (!ok)
        free(b);
    return ok;
}

size_t snapshots_excess(const struct problem *p, const double *u, double *value)
{
    const struct config *c = p->config;
    size_t modes = galv_model_modes(p->model);
    size_t n = c->snapshots ? c->n_parameters : 0;
    for (size_t k = 0; k < n; k++) {
        double x = 0, unit = unit_of(c, k);
        for (size_t j = 0; p->back && j < modes; j++)
            x += p->back[k * modes + j] * u[j];
        value[2 * k] = x - (c->upper[k] - c->original[k]) / unit;
        value[2 * k + 1] = (c->lower[k] - c->original[k]) / unit - x;
    }
    return 2 * n;
}

/* Where the way back stands: the parameters as the map has them, the grid of their hull, what is
 * missing of the latent point. */
struct way {
    size_t modes, params, points;
    double *map, *at, *grid, *target, *missing, *work;
};

static void way_free(struct way *w)
{
    free(w->map);
    free(w->at);
    free(w->grid);
    free(w->target);
    free(w->missing);
    free(w->work);
}

static bool way_start(const struct problem *p, const double *u, struct way *w)
{
    size_t modes = galv_model_modes(p->model), params = p->config->n_parameters,
           points = count_points(p);
    *w =
        (struct way){modes,
                     params,
                     points,
                     malloc(modes * params * sizeof(double)),
                     calloc(params, sizeof(double)),
                     malloc(3 * points * sizeof(double)),
                     malloc(3 * points * sizeof(double)),
                     malloc(modes * sizeof(double)),
                     malloc((modes * params + 3 * points + 2 * (modes + params)) * sizeof(double))};
    if (!w->map || !w->at || !w->grid || !w->target || !w->missing || !w->work)
        return core_no_memory();
    memcpy(w->map, p->map, modes * params * sizeof *w->map);
    memcpy(w->missing, u, modes * sizeof *u);
    return core_ok(galv_displace(p->model, u, w->target), "%s", galv_last_error());
}

/* Moves `at` by the least change that the map needs for what is missing, within the bounds. */
static bool step(const struct config *c, struct way *w, double *change)
{
    double *a = w->work, *b = a + w->modes * w->params;
    memcpy(a, w->map, w->modes * w->params * sizeof *a);
    memcpy(b, w->missing, w->modes * sizeof *b);
    if (!solve(w->modes, w->params, 1, a, b))
        return false;
    for (size_t k = 0; k < w->params; k++) {
        double unit = unit_of(c, k), before = w->at[k];
        double x = c->original[k] + unit * (before + b[k]);
        w->at[k] = (fmin(fmax(x, c->lower[k]), c->upper[k]) - c->original[k]) / unit;
        change[k] = w->at[k] - before;
    }
    return true;
}

/* Broyden's update of the map by a step and what it changed. */
static void learn(struct way *w, const double *change, const double *gained)
{
    double square = 0;
    for (size_t k = 0; k < w->params; k++)
        square += change[k] * change[k];
    for (size_t j = 0; j < w->modes && square > 0; j++) {
        double excess = gained[j];
        for (size_t k = 0; k < w->params; k++)
            excess -= w->map[j * w->params + k] * change[k];
        for (size_t k = 0; k < w->params; k++)
            w->map[j * w->params + k] += excess * change[k] / square;
    }
}

/* The command's hull there: its distance, and what is still missing in the latent space. */
static bool look(struct problem *p, const double *u, struct way *w, double *gained,
                 double *distance)
{
    double *d = w->work + w->modes * w->params, *x = d + 3 * w->points, sum = 0;
    const double *parent = nurbs_grid_points(p->grid);
    for (size_t k = 0; k < w->params; k++)
        x[k] = unit_of(p->config, k) * w->at[k];
    if (!problem_make_points(p, x, w->grid))
        return false;
    for (size_t k = 0; k < 3 * w->points; k++) {
        d[k] = w->grid[k] - parent[k];
        sum += (w->grid[k] - w->target[k]) * (w->grid[k] - w->target[k]);
    }
    if (!core_ok(galv_project(p->model, d, gained), "%s", galv_last_error()))
        return false;
    for (size_t j = 0; j < w->modes; j++) {
        double missing = u[j] - gained[j];
        gained[j] = w->missing[j] - missing;
        w->missing[j] = missing;
    }
    *distance = sqrt(sum / (double)w->points);
    return true;
}

bool snapshots_match(struct problem *p, const double *u, struct snapshots_match *m)
{
    const struct config *c = p->config;
    struct way w = {0};
    struct evaluation e;
    double *best = malloc(3 * count_points(p) * sizeof *best), distance = INFINITY;
    double *change = malloc((c->n_parameters + galv_model_modes(p->model)) * sizeof *change);
    m->residual = INFINITY;
    bool ok = ((best && change) || core_no_memory()) && way_start(p, u, &w);
    for (int n = 0; n < STEPS && ok; n++) {
        ok = step(c, &w, change) && look(p, u, &w, change + w.params, &distance);
        if (!ok || !(distance < WORTH * m->residual))
            break;
        m->residual = distance;
        memcpy(best, w.grid, 3 * w.points * sizeof *best);
        snprintf(m->made, sizeof m->made, "%s", p->made);
        for (size_t k = 0; k < w.params; k++)
            m->x[k] = c->original[k] + unit_of(c, k) * w.at[k];
        learn(&w, change, change + w.params);
    }
    ok = isfinite(m->residual); /* a later step that fails is not needed */
    if (ok) {
        evaluation_start(1, "command", NULL, &e);
        evaluate_points(p, best, &e);
        m->cw = e.failed ? NAN : e.cw;
    }
    way_free(&w);
    free(change);
    free(best);
    return ok;
}
