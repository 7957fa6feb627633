/* Several objectives: which points are of the Pareto set, and the volume that points dominate. */
#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIMENSIONS = 8 };

size_t objective_model(const struct bayesopt *bo, size_t k)
{
    return k ? bo->options.n_constraints - bo->options.n_objectives + 1 + k : 0;
}

double objective_sign(const struct bayesopt *bo, size_t k)
{
    return bo->maximise[k] ? -1 : 1;
}

void objectives_of(const struct bayesopt *bo, const struct point *p, double *values)
{
    values[0] = p->f;
    for (size_t k = 1; k < bo->options.n_objectives; k++)
        values[k] = objective_sign(bo, k) * p->constraints[objective_model(bo, k) - 1];
}

bool pareto_rows(const struct bayesopt *bo, size_t *n, size_t *rows)
{
    size_t m = bo->options.n_objectives, count = 0, kept = 0;
    double *values = malloc((bo->n_points + 1) * m * sizeof *values);
    if (!values)
        return false;
    for (size_t i = 0; i < bo->n_points; i++)
        if (point_feasible(bo, &bo->points[i])) {
            objectives_of(bo, &bo->points[i], values + count * m);
            rows[count++] = i;
        }
    for (size_t i = 0; i < count; i++)
        if (!front_dominated(m, count, values, i))
            rows[kept++] = rows[i];
    free(values);
    *n = kept;
    return true;
}

bayesopt_status bayesopt_pareto(const bayesopt *bo, size_t *n, size_t *rows)
{
    NEED(bo);
    NEED(n);
    size_t *own = malloc((bo->n_points + 1) * sizeof *own);
    if (!own || !pareto_rows(bo, n, own)) {
        free(own);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    double sign = problem_sign(bo);
    for (size_t i = 1; i < *n; i++)
        for (size_t k = i; k > 0 && sign * bo->points[own[k]].f < sign * bo->points[own[k - 1]].f;
             k--) {
            size_t kept = own[k];
            own[k] = own[k - 1];
            own[k - 1] = kept;
        }
    if (rows)
        memcpy(rows, own, *n * sizeof *rows);
    free(own);
    return BAYESOPT_OK;
}

static int compare_last(const void *a, const void *b)
{
    double x = **(const double *const *)a, y = **(const double *const *)b;
    return (x > y) - (x < y);
}

/* Slices across the last objective; points [n] are pointers to it, the others stand before it.
 * scratch has room for n (m - 1) pointers. */
static double volume(size_t m, size_t n, const double **points, const double *reference,
                     const double **scratch)
{
    double sum = 0;
    if (m == 1) {
        double least = reference[0];
        for (size_t i = 0; i < n; i++)
            least = fmin(least, *points[i]);
        return reference[0] - least;
    }
    qsort(points, n, sizeof *points, compare_last);
    for (size_t i = 0; i < n; i++) {
        double end = i + 1 < n ? *points[i + 1] : reference[m - 1];
        if (!(end > *points[i]))
            continue;
        for (size_t k = 0; k <= i; k++)
            scratch[k] = points[k] - 1;
        sum += (end - *points[i]) * volume(m - 1, i + 1, scratch, reference, scratch + n);
    }
    return sum;
}

bayesopt_status bayesopt_hypervolume(size_t m, size_t n, const double *points,
                                     const double *reference, double *out)
{
    NEED(points);
    NEED(reference);
    NEED(out);
    NEED_MOST(n, BAYESOPT_MOST_POINTS);
    if (m < 1 || m > MOST_DIMENSIONS)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%zu objectives, expected 1 to %d", m,
                             MOST_DIMENSIONS);
    const double **below = malloc((m * n + 1) * sizeof *below);
    size_t count = 0;
    if (!below)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < n; i++) {
        bool inside = true;
        for (size_t c = 0; c < m; c++)
            inside = inside && points[i * m + c] < reference[c];
        if (inside)
            below[count++] = points + i * m + m - 1;
    }
    *out = count ? volume(m, count, below, reference, below + n) : 0;
    free(below);
    return BAYESOPT_OK;
}
