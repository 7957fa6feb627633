#include "result/free_waves.h"

#include "core/error.h"
#include "result/amplitude.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

enum { ORIGINS = 3, WIDTHS = 7, COLUMNS = 2 * FREE_WAVES_TERMS };
/* From what a transverse wave needs to angles of t = 6; beyond the last the rule ends. */
static const double exponent[WIDTHS] = {1.6, 0.8, 0.4, 0.2, 0.1, 0.05, 0.025};
static const double last_angle = 5.0;
/* Of the largest singular value: directions that the elevations do not tell are left out. */
static const double smallest = 3e-3;

static igabem_status no_memory(size_t n)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the free waves at %zu points", n);
}

static void terms(const struct free_waves *waves, double t, double _Complex value[FREE_WAVES_TERMS])
{
    double k = waves->k0 * sqrt(1.0 + t * t);
    for (int o = 0; o < ORIGINS; o++) {
        double _Complex wave = cexp(-I * k * waves->length * o / (ORIGINS - 1.0));
        for (int w = 0; w < WIDTHS; w++)
            value[o * WIDTHS + w] = wave * exp(-exponent[w] * t * t);
    }
}

double _Complex free_waves_amplitude(const struct free_waves *waves, double t)
{
    double _Complex value[FREE_WAVES_TERMS], sum = 0.0;
    terms(waves, t, value);
    for (int m = 0; m < FREE_WAVES_TERMS; m++)
        sum += waves->c[m] * value[m];
    return sum;
}

/* A rule over 0 <= t for points so far from the ship. */
static igabem_status rule(const struct free_waves *waves, size_t n, const double *x,
                          const double *y, size_t *nodes, double **t, double **weight)
{
    double along = 0.0, aside = 0.0;
    for (size_t i = 0; i < n; i++) {
        along = fmax(along, fabs(x[i] - waves->stern));
        aside = fmax(aside, fabs(y[i]));
    }
    return amplitude_rule(waves->k0, along + waves->length, 2.0 * aside, last_angle, 0.0, nodes, t,
                          weight);
}

/* Both signs of t. */
static double _Complex wave_at(const struct free_waves *waves, double t, double x, double y)
{
    double k = waves->k0 * sqrt(1.0 + t * t);
    return 2.0 * cos(k * t * y) * cexp(I * k * (x - waves->stern));
}

/* Columns of the real and imaginary parts of c. */
static igabem_status fill(const struct free_waves *waves, size_t n, const double *x,
                          const double *y, double *matrix)
{
    size_t nodes;
    double *t, *weight;
    igabem_status status = rule(waves, n, x, y, &nodes, &t, &weight);
    if (status)
        return status;
    double _Complex(*value)[FREE_WAVES_TERMS] = malloc(nodes * sizeof *value);
    for (size_t k = 0; k < nodes && value; k++) {
        terms(waves, t[k], value[k]);
        for (int m = 0; m < FREE_WAVES_TERMS; m++)
            value[k][m] *= weight[k];
    }
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        double _Complex sum[FREE_WAVES_TERMS] = {0.0};
        for (size_t k = 0; k < nodes && value; k++) {
            double _Complex wave = wave_at(waves, t[k], x[i], y[i]);
            for (int m = 0; m < FREE_WAVES_TERMS; m++)
                sum[m] += wave * value[k][m];
        }
        for (int m = 0; m < FREE_WAVES_TERMS; m++) {
            matrix[(size_t)m * n + i] = creal(sum[m]);
            matrix[(size_t)(FREE_WAVES_TERMS + m) * n + i] = -cimag(sum[m]);
        }
    }
    free(t);
    free(weight);
    free(value);
    return value ? IGABEM_OK : no_memory(n);
}

igabem_status free_waves_fit(double k0, double stern, double length, size_t n, const double *x,
                             const double *y, const double *zeta, struct free_waves *waves)
{
    *waves = (struct free_waves){.k0 = k0, .stern = stern, .length = length};
    if (n < COLUMNS)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "free waves from %zu elevations, expected at least %d", n, COLUMNS);
    double *matrix = malloc((COLUMNS + 1) * n * sizeof *matrix), singular[COLUMNS];
    if (!matrix)
        return no_memory(n);
    double *right = matrix + COLUMNS * n, whole = 0.0, left = 0.0;
    for (size_t i = 0; i < n; i++) {
        right[i] = zeta[i];
        whole += zeta[i] * zeta[i];
    }
    lapack_int rank, rows = (lapack_int)n;
    igabem_status status = fill(waves, n, x, y, matrix);
    lapack_int info = status ? 0
                             : LAPACKE_dgelss(LAPACK_COL_MAJOR, rows, COLUMNS, 1, matrix, rows,
                                              right, rows, singular, smallest, &rank);
    if (info != 0)
        status = igabem_fail_lapack("fit of the free waves", info);
    for (int m = 0; m < FREE_WAVES_TERMS && !status; m++)
        waves->c[m] = right[m] + I * right[FREE_WAVES_TERMS + m];
    if (!status)
        status = free_waves_elevation(waves, n, x, y, right);
    for (size_t i = 0; i < n && !status; i++)
        left += (right[i] - zeta[i]) * (right[i] - zeta[i]);
    waves->misfit = whole > 0 ? sqrt(left / whole) : 0.0;
    free(matrix);
    return status;
}

igabem_status free_waves_elevation(const struct free_waves *waves, size_t n, const double *x,
                                   const double *y, double *zeta)
{
    size_t nodes;
    double *t, *weight;
    igabem_status status = rule(waves, n, x, y, &nodes, &t, &weight);
    if (status)
        return status;
    double _Complex *value = malloc(nodes * sizeof *value);
    for (size_t k = 0; k < nodes && value; k++)
        value[k] = weight[k] * free_waves_amplitude(waves, t[k]);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        double sum = 0.0;
        for (size_t k = 0; k < nodes && value; k++)
            sum += creal(value[k] * wave_at(waves, t[k], x[i], y[i]));
        zeta[i] = sum;
    }
    free(t);
    free(weight);
    free(value);
    return value ? IGABEM_OK : no_memory(n);
}
