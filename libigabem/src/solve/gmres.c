#include "solve/gmres.h"

#include "core/error.h"

#include <cblas.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cycle that leaves more than this share of the residual has stalled. */
static const double STALLED = 0.5;
/* A vector that keeps less than this share of its length is orthogonalised once more (Giraud et
 * al., Numer. Math. 101, 2005). */
static const double CANCELLED = 0.7;
/* One that keeps no more than this share lies in the space already. */
static const double INVARIANT = 1e-14;

/* One cycle: A M^-1 V_m = V_{m+1} H, and H = Q R by Givens rotations as it grows. */
struct cycle {
    size_t m;
    double *basis;          /* [m+1][n] */
    double *r;              /* [m][m+1]: columns of R */
    double *cosine, *sine;  /* [m] */
    double *g;              /* [m+1] Q^T ||r_0|| e_1: |g[k]| is the residual of k columns */
    double *vector, *image; /* [n] */
    double *storage;
};

static double norm(size_t n, const double *x)
{
    return cblas_dnrm2((int)n, x, 1);
}

static int cycle_create(size_t n, size_t m, struct cycle *cycle)
{
    double *at = malloc(((m + 3) * n + m * (m + 1) + 3 * m + 1) * sizeof *at);
    *cycle = (struct cycle){.m = m, .storage = at, .basis = at};
    if (!at)
        return 0;
    cycle->vector = at + (m + 1) * n;
    cycle->image = cycle->vector + n;
    cycle->r = cycle->image + n;
    cycle->cosine = cycle->r + m * (m + 1);
    cycle->sine = cycle->cosine + m;
    cycle->g = cycle->sine + m;
    return 1;
}

static void preconditioned(const struct gmres *gmres, const double *x, double *y)
{
    if (gmres->precondition)
        gmres->precondition(gmres->data, x, y);
    else
        memcpy(y, x, gmres->n * sizeof *y);
}

/* Fills r = right - A x and returns its length; x = 0 costs no product. */
static double residual(const struct gmres *gmres, const double *right, const double *x, double *r)
{
    if (norm(gmres->n, x) == 0.0) {
        memcpy(r, right, gmres->n * sizeof *r);
        return norm(gmres->n, r);
    }
    gmres->matrix(gmres->data, x, r);
    for (size_t i = 0; i < gmres->n; i++)
        r[i] = right[i] - r[i];
    return norm(gmres->n, r);
}

/* Column k of the Arnoldi process by modified Gram-Schmidt; h[k + 1] = 0 if the new vector lies in
 * the space already. */
static void arnoldi(const struct gmres *gmres, struct cycle *cycle, size_t k)
{
    int n = (int)gmres->n;
    double *v = cycle->basis + (k + 1) * gmres->n, *h = cycle->r + k * (cycle->m + 1);
    preconditioned(gmres, cycle->basis + k * gmres->n, cycle->vector);
    gmres->matrix(gmres->data, cycle->vector, v);
    memset(h, 0, (k + 2) * sizeof *h);
    double before = norm(gmres->n, v), length = before;
    for (int pass = 0; pass < 2; pass++) {
        double start = length;
        for (size_t i = 0; i <= k; i++) {
            const double *u = cycle->basis + i * gmres->n;
            double projection = cblas_ddot(n, v, 1, u, 1);
            cblas_daxpy(n, -projection, u, 1, v, 1);
            h[i] += projection;
        }
        length = norm(gmres->n, v);
        if (length >= CANCELLED * start)
            break;
    }
    h[k + 1] = length <= INVARIANT * before ? 0.0 : length;
    if (h[k + 1] != 0.0)
        cblas_dscal(n, 1.0 / length, v, 1);
}

/* Rotates column k into R; returns 0 if its diagonal vanishes. */
static int rotate(struct cycle *cycle, size_t k)
{
    double *h = cycle->r + k * (cycle->m + 1), scale = fabs(h[k + 1]);
    for (size_t i = 0; i <= k; i++)
        scale = fmax(scale, fabs(h[i]));
    for (size_t i = 0; i < k; i++) {
        double upper = h[i], lower = h[i + 1];
        h[i] = cycle->cosine[i] * upper + cycle->sine[i] * lower;
        h[i + 1] = cycle->cosine[i] * lower - cycle->sine[i] * upper;
    }
    double length = hypot(h[k], h[k + 1]);
    if (!(length > INVARIANT * scale))
        return 0;
    cycle->cosine[k] = h[k] / length;
    cycle->sine[k] = h[k + 1] / length;
    h[k] = length;
    cycle->g[k + 1] = -cycle->sine[k] * cycle->g[k];
    cycle->g[k] *= cycle->cosine[k];
    return 1;
}

/* x += M^-1 V y, R y = g with k columns. */
static void advance(const struct gmres *gmres, struct cycle *cycle, size_t k, double *x)
{
    double *y = cycle->g;
    for (size_t i = k; i-- > 0;) {
        y[i] /= cycle->r[i * (cycle->m + 1) + i];
        for (size_t j = 0; j < i; j++)
            y[j] -= cycle->r[i * (cycle->m + 1) + j] * y[i];
    }
    memset(cycle->vector, 0, gmres->n * sizeof *x);
    for (size_t i = 0; i < k; i++)
        cblas_daxpy((int)gmres->n, y[i], cycle->basis + i * gmres->n, 1, cycle->vector, 1);
    preconditioned(gmres, cycle->vector, cycle->image);
    for (size_t i = 0; i < gmres->n; i++)
        x[i] += cycle->image[i];
}

/* One cycle from the residual in cycle->vector; returns the number of columns that count. */
static size_t run_cycle(const struct gmres *gmres, struct cycle *cycle, double length,
                        double target, struct gmres_result *result)
{
    size_t n = gmres->n, k = 0;
    for (size_t i = 0; i < n; i++)
        cycle->basis[i] = cycle->vector[i] / length;
    cycle->g[0] = length;
    while (k < cycle->m && result->iterations < gmres->most) {
        arnoldi(gmres, cycle, k);
        result->iterations++;
        result->cancelled = gmres->cancelled && gmres->cancelled(gmres->data);
        if (result->cancelled)
            return k;
        int invariant = cycle->r[k * (cycle->m + 1) + k + 1] == 0.0;
        if (!rotate(cycle, k))
            return k;
        k++;
        if (invariant || fabs(cycle->g[k]) <= target)
            break;
    }
    return k;
}

static igabem_status iterate(const struct gmres *gmres, const double *right, double *x,
                             struct cycle *cycle, struct gmres_result *result)
{
    double size = norm(gmres->n, right);
    if (!isfinite(size))
        return igabem_fail(IGABEM_ERROR_NUMERIC, "GMRES: the right-hand side is not finite");
    if (size == 0.0) {
        memset(x, 0, gmres->n * sizeof *x);
        result->residual = 0.0;
        return IGABEM_OK;
    }
    double length = residual(gmres, right, x, cycle->vector);
    for (;;) {
        if (!isfinite(length))
            return igabem_fail(IGABEM_ERROR_NUMERIC, "GMRES: a residual is not finite");
        result->residual = length / size;
        if (result->residual <= gmres->tolerance)
            return IGABEM_OK;
        if (result->iterations >= gmres->most)
            return igabem_fail(
                IGABEM_ERROR_NUMERIC,
                "GMRES has not converged after %zu iterations: residual %.1e, expected %.1e",
                result->iterations, result->residual, gmres->tolerance);
        /* A little below the tolerance: the residual of x itself decides. */
        size_t columns = run_cycle(gmres, cycle, length, 0.5 * gmres->tolerance * size, result);
        if (result->cancelled)
            return IGABEM_ERROR_CANCELLED;
        if (columns > 0)
            advance(gmres, cycle, columns, x);
        double after = residual(gmres, right, x, cycle->vector);
        if (after > STALLED * length && after > gmres->tolerance * size) {
            result->residual = after / size;
            return igabem_fail(
                IGABEM_ERROR_NUMERIC,
                "GMRES stalls after %zu iterations: residual %.1e, expected %.1e; the matrix is "
                "singular or badly conditioned",
                result->iterations, result->residual, gmres->tolerance);
        }
        length = after;
    }
}

igabem_status gmres_solve(const struct gmres *gmres, const double *right, double *x,
                          struct gmres_result *result)
{
    *result = (struct gmres_result){0, NAN, false};
    if (gmres->n > INT_MAX)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "%zu unknowns are too many for BLAS", gmres->n);
    size_t restart = gmres->restart < gmres->n ? gmres->restart : gmres->n;
    struct cycle cycle;
    if (!cycle_create(gmres->n, restart ? restart : 1, &cycle))
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for GMRES with %zu unknowns", gmres->n);
    igabem_status status = iterate(gmres, right, x, &cycle, result);
    free(cycle.storage);
    return status;
}
