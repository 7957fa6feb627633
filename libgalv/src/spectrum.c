#include "spectrum.h"

#include "eigen.h"
#include "error.h"
#include "products.h"
#include "threads.h"

#include <cblas.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void galv_spectrum_free(galv_spectrum *spectrum)
{
    free(spectrum->values);
    free(spectrum->vectors);
    free(spectrum->residuals);
    free(spectrum->mean);
    *spectrum = (galv_spectrum){.active = 0};
}

size_t galv_goal_modes(const galv_goal *goal, size_t known, const double *values, double trace)
{
    if (goal->modes)
        return goal->modes <= known ? goal->modes : 0;
    double sum = 0, target = (goal->variance - GALV_TRACE_ROUNDING) * trace;
    for (size_t k = 0; k < known; k++) {
        sum += values[k];
        if (sum >= target)
            return k + 1;
    }
    return 0;
}

galv_status galv_sums_start(galv_sums *sums, size_t stored)
{
    sums->energy = 0;
    sums->sum = calloc(stored, sizeof *sums->sum);
    return sums->sum ? GALV_OK : galv_fail(GALV_ERROR_MEMORY, "mean of %zu coordinates", stored);
}

void galv_sums_add(galv_sums *sums, const galv_stream *stream, size_t count)
{
    enum { SLICE = 512, ALONE = 1 << 16 };
    size_t active = stream->active;
    for (size_t r = 0; r < count; r++)
        sums->energy += stream->energy[r];
#pragma omp parallel for num_threads(threads_at_hand()) schedule(static) if (count * active > ALONE)
    for (size_t first = 0; first < active; first += SLICE) {
        size_t last = first + SLICE < active ? first + SLICE : active;
        for (size_t r = 0; r < count; r++)
            for (size_t a = first; a < last; a++)
                sums->sum[a] += stream->rows[r * active + a];
    }
}

galv_status galv_sums_finish(galv_sums *sums, const galv_stream *stream, bool centre,
                             galv_spectrum *spectrum)
{
    double n = (double)stream->source->samples, square = 0;
    spectrum->active = stream->active;
    spectrum->mean = sums->sum;
    sums->sum = NULL;
    for (size_t a = 0; a < stream->active; a++) {
        spectrum->mean[a] /= n;
        square += spectrum->mean[a] * spectrum->mean[a];
    }
    spectrum->trace = sums->energy / n - (centre ? square : 0);
    if (spectrum->trace <= (centre ? 16 * DBL_EPSILON * sums->energy / n : 0))
        return galv_fail(GALV_ERROR_GEOMETRY,
                         centre ? "all %zu samples have the same displacement: nothing varies"
                                : "the displacements of all %zu samples are zero",
                         stream->source->samples);
    return GALV_OK;
}

/* Below this order, or when a third of the spectrum is wanted, all of it costs no more than a part.
 */
enum { DENSE_ORDER = 512, KRYLOV_BLOCK = 32 };

typedef struct matrix {
    size_t n;
    const double *a; /* both triangles */
    double *v, *y;   /* n x KRYLOV_BLOCK, padded */
} matrix;

static galv_status matrix_apply(void *user_data, size_t b, const double *v, double *y)
{
    const matrix *m = user_data;
    galv_pad(m->n, b, v, m->v);
    galv_rows_times(m->n, m->n, 1, m->a, b, m->v, m->y);
    galv_unpad(m->n, b, m->y, y);
    return GALV_OK;
}

static void mirror(size_t n, double *a)
{
    for (size_t j = 0; j < n; j++)
        for (size_t i = j + 1; i < n; i++)
            a[i * n + j] = a[j * n + i];
}

/* Pairs above the rounding of the decomposition: the rank as far as doubles can tell. */
static size_t numerical_rank(size_t n, size_t found, const double *values)
{
    size_t rank = 0;
    double floor = (double)n * DBL_EPSILON * values[0];
    while (rank < found && values[rank] > floor)
        rank++;
    return rank;
}

static galv_status allocate_pairs(size_t n, size_t nev, size_t nvalues, double **values,
                                  double **vectors, double **residuals)
{
    *values = malloc(nvalues * sizeof **values);
    *vectors = malloc(n * nev * sizeof **vectors);
    *residuals = malloc(nvalues * sizeof **residuals);
    if (*values && *vectors && *residuals)
        return GALV_OK;
    return galv_fail(GALV_ERROR_MEMORY, "%zu eigenvectors of order %zu", nev, n);
}

static void free_pairs(double **values, double **vectors, double **residuals)
{
    free(*values);
    free(*vectors);
    free(*residuals);
    *values = *vectors = *residuals = NULL;
}

static galv_status solve_dense(size_t n, double *a, size_t *known, double *values, double *vectors,
                               double *residuals, galv_stage *stage)
{
    galv_status status = galv_eigen_dense(n, a, values, vectors, stage);
    if (status)
        return status;
    *known = numerical_rank(n, n, values);
    for (size_t k = 0; k < *known; k++)
        residuals[k] = (double)n * DBL_EPSILON * values[0];
    return GALV_OK;
}

static galv_status solve_krylov(size_t n, double *a, size_t nev, uint64_t seed, size_t *known,
                                double *values, double *vectors, double *residuals,
                                galv_stage *stage)
{
    size_t room = n * galv_padded(KRYLOV_BLOCK) * sizeof(double);
    matrix m = {.n = n, .a = a, .v = malloc(room), .y = malloc(room)};
    galv_operator op = {.n = n, .apply = matrix_apply, .user_data = &m};
    galv_krylov run = {.nev = nev,
                       .block = KRYLOV_BLOCK,
                       .basis = 3 * nev + 8 * KRYLOV_BLOCK,
                       .most = 400,
                       .tolerance = 1e-12,
                       .seed = seed,
                       .stage = stage};
    galv_status status = GALV_OK;
    if (m.v && m.y) {
        mirror(n, a);
        status = galv_eigen_krylov(&op, &run, NULL, values, vectors, residuals);
    } else {
        status =
            galv_fail(GALV_ERROR_MEMORY, "a block of %d vectors of order %zu", KRYLOV_BLOCK, n);
    }
    free(m.v);
    free(m.y);
    if (status)
        return status;
    *known = numerical_rank(n, run.found, values);
    if (run.converged < *known)
        return galv_fail(GALV_ERROR_NUMERIC,
                         "eigenvalue %zu of order %zu has residual %g after %zu block iterations",
                         run.converged, n, residuals[run.converged], run.applications);
    return GALV_OK;
}

/* Pairs to ask for next: twice as many, or at least what the target needs if all further values
 * were as large as the last one. */
static size_t more_pairs(const galv_goal *goal, size_t nev, const double *values, double trace)
{
    double lacking = goal->variance * trace;
    for (size_t k = 0; k < nev; k++)
        lacking -= values[k];
    double least = (double)nev + ceil(lacking / values[nev - 1]);
    return least > 2 * (double)nev ? (size_t)fmin(least, 0x1p32) : 2 * nev;
}

/* Whether so many pairs of a spectrum that falls slowly cost more by Krylov blocks, whose projected
 * matrices grow by a block to the order 3 nev and are decomposed each time, than all of them. */
static bool slow_in_blocks(size_t n, size_t nev)
{
    double basis = 3 * (double)nev;
    return pow(basis, 4) > 4 * KRYLOV_BLOCK * pow((double)n, 3);
}

galv_status galv_spectrum_matrix(size_t n, double *a, double trace, const galv_goal *goal,
                                 size_t *known, double **values, double **vectors,
                                 double **residuals, galv_stage *stage)
{
    size_t nev = goal->modes > goal->spectrum ? goal->modes : goal->spectrum;
    for (bool again = false;; again = true) {
        galv_stage_next(stage, GALV_STAGE_SOLVED);
        bool dense = n <= DENSE_ORDER || 3 * nev >= n || (again && slow_in_blocks(n, nev));
        size_t wanted = dense ? n : nev;
        galv_status status = allocate_pairs(n, wanted, wanted, values, vectors, residuals);
        if (!status)
            status = dense ? solve_dense(n, a, known, *values, *vectors, *residuals, stage)
                           : solve_krylov(n, a, nev, goal->seed, known, *values, *vectors,
                                          *residuals, stage);
        if (status) {
            free_pairs(values, vectors, residuals);
            return status;
        }
        /* Fewer pairs than asked for: that is the rank. */
        if (dense || *known < nev || galv_goal_modes(goal, *known, *values, trace))
            return GALV_OK;
        nev = more_pairs(goal, nev, *values, trace);
        free_pairs(values, vectors, residuals);
    }
}
