#include "fixture.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const galv_box fixture_box = {.origin = {0, 0, -0.3}, .length = {6, 0.4, 0.3}};

void fixture_grid(double *xyz)
{
    for (size_t i = 0; i < SECTIONS; i++)
        for (size_t j = 0; j < GIRTH; j++) {
            double s = (double)i / (SECTIONS - 1), t = (double)j / (GIRTH - 1);
            double *p = xyz + 3 * (i * GIRTH + j);
            p[0] = 6 * s;
            p[1] = 0.4 * 4 * s * (1 - s) * (1 - t * t);
            p[2] = -0.3 * t;
        }
}

void fixture_functions(galv_sine *functions)
{
    for (int i = 0; i < FUNCTIONS; i++)
        functions[i] = (galv_sine){.order = {1 + i / 9, 1 + i / 3 % 3, 1 + i % 3}, .direction = 1};
}

galv_shape *fixture_shape(galv_combination combination, double bound)
{
    galv_sine functions[FUNCTIONS];
    double lower[FUNCTIONS], upper[FUNCTIONS];
    galv_shape *shape = NULL;
    fixture_functions(functions);
    for (int i = 0; i < FUNCTIONS; i++) {
        lower[i] = -bound;
        upper[i] = bound;
    }
    galv_shape_sine(FUNCTIONS, functions, &fixture_box, lower, upper, combination, &shape);
    return shape;
}

double *fixture_samples(const galv_shape *shape, size_t count, uint64_t seed)
{
    size_t n = galv_shape_parameters(shape);
    double *x = malloc(count * n * sizeof *x);
    for (size_t r = 0; x && r < count; r++)
        galv_uniform_sample(seed, r, n, galv_shape_lower(shape), galv_shape_upper(shape),
                            x + r * n);
    return x;
}

double *fixture_rows(const galv_shape *shape, size_t npoints, const double *xyz, size_t count,
                     const double *x)
{
    size_t n = galv_shape_parameters(shape), length = 3 * npoints;
    double *rows = malloc(count * length * sizeof *rows);
    for (size_t r = 0; rows && r < count; r++)
        if (galv_shape_displace(shape, npoints, xyz, x + r * n, rows + r * length)) {
            free(rows);
            return NULL;
        }
    return rows;
}

static void centre_columns(size_t count, size_t length, double *rows)
{
    for (size_t i = 0; i < length; i++) {
        double mean = 0;
        for (size_t r = 0; r < count; r++)
            mean += rows[r * length + i] / (double)count;
        for (size_t r = 0; r < count; r++)
            rows[r * length + i] -= mean;
    }
}

double *fixture_spectrum(size_t count, size_t length, const double *rows, bool centre,
                         const double *weights, size_t keep, double *modes)
{
    size_t least = count < length ? count : length;
    double *copy = malloc(count * length * sizeof *copy), *values = malloc(least * sizeof *values);
    double *u = modes ? malloc(least * length * sizeof *u) : NULL;
    double *vt = modes ? malloc(least * count * sizeof *vt) : NULL;
    memcpy(copy, rows, count * length * sizeof *copy);
    if (centre)
        centre_columns(count, length, copy);
    for (size_t i = 0; weights && i < length; i++)
        for (size_t r = 0; r < count; r++)
            copy[r * length + i] *= sqrt(weights[i]);
    /* Row-major rows are the columns of a length x count matrix: its left vectors are the modes. */
    lapack_int info = LAPACKE_dgesdd(LAPACK_COL_MAJOR, modes ? 'S' : 'N', (lapack_int)length,
                                     (lapack_int)count, copy, (lapack_int)length, values, u,
                                     (lapack_int)length, vt, (lapack_int)least);
    for (size_t k = 0; k < least; k++)
        values[k] = info ? NAN : values[k] * values[k] / (double)count;
    if (modes)
        memcpy(modes, u, keep * length * sizeof *modes);
    free(copy);
    free(u);
    free(vt);
    return values;
}
