#include "assemble.h"

#include "error.h"

#include <lapacke.h>
#include <limits.h>
#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

void basis_row(const struct influence *influence, size_t point, double *row)
{
    const struct density *density = influence->density;
    const struct mesh *mesh = influence->mesh;
    size_t patch = density->owner[point];
    for (size_t e = mesh->patch_base[patch]; e < mesh->patch_base[patch + 1]; e++) {
        const struct element *element = &mesh->element[e];
        double local[2], bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], value[ELEMENT_FUNCTIONS];
        if (!element_contains(density, element, point, local))
            continue;
        size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
        struct jet jet;
        element_jet(element, local[0], local[1], &jet);
        bernstein(element->degree[0], local[0], bu, NULL);
        bernstein(element->degree[1], local[1], bv, NULL);
        for (size_t k = 0; k < m * n; k++)
            value[k] = bu[k / n] * bv[k % n] / jet.weight;
        element_scatter(element, 1, value, row, density->n);
        return;
    }
}

static void add_scaled(size_t n, double factor, const double *from, double *to)
{
    for (size_t k = 0; k < n; k++)
        to[k] += factor * from[k];
}

/* The three velocity rows of a point, [3][n], principal value. */
static void velocity_rows(const struct system *system, size_t i, double *rows)
{
    size_t n = 3 * system->influence->density->n, at = n * i;
    memcpy(rows, system->rankine + at, n * sizeof *rows);
    if (system->image && system->image_weight[i] != 0.0)
        add_scaled(n, system->image_weight[i], system->image + at, rows);
    if (system->wave_weight[i] == 0.0)
        return;
    if (system->local)
        add_scaled(n, system->wave_weight[i], system->local + at, rows);
    if (system->wave)
        add_scaled(n, system->wave_weight[i], system->wave + at, rows);
}

igabem_status system_matrix(const struct system *system, double *matrix)
{
    const struct density *density = system->influence->density;
    size_t n = density->n;
    int failed = 0;
#pragma omp parallel num_threads(system->influence->threads) reduction(| : failed)
    {
        double *rows = malloc(4 * n * sizeof *rows), *basis = rows + 3 * n;
        failed |= !rows;
#pragma omp for
        for (size_t i = 0; i < n; i++) {
            if (failed)
                continue;
            const double *normal = density->normal + 3 * i;
            double *row = matrix + n * i;
            velocity_rows(system, i, rows);
            memset(basis, 0, n * sizeof *basis);
            basis_row(system->influence, i, basis);
            for (size_t k = 0; k < n; k++)
                row[k] = 0.5 * basis[k] + normal[0] * rows[k] + normal[1] * rows[n + k] +
                         normal[2] * rows[2 * n + k];
        }
        free(rows);
    }
    return failed ? igabem_fail(IGABEM_ERROR_MEMORY, "no memory for matrix rows") : IGABEM_OK;
}

igabem_status system_velocity(const struct system *system, const double *sigma, double *velocity)
{
    const struct density *density = system->influence->density;
    size_t n = density->n;
    int failed = 0;
#pragma omp parallel num_threads(system->influence->threads) reduction(| : failed)
    {
        double *rows = malloc(4 * n * sizeof *rows), *basis = rows + 3 * n;
        failed |= !rows;
#pragma omp for
        for (size_t i = 0; i < n; i++) {
            if (failed)
                continue;
            velocity_rows(system, i, rows);
            memset(basis, 0, n * sizeof *basis);
            basis_row(system->influence, i, basis);
            double here = 0.0;
            for (size_t k = 0; k < n; k++)
                here += basis[k] * sigma[k];
            for (size_t c = 0; c < 3; c++) {
                double sum = 0.5 * here * density->normal[3 * i + c];
                for (size_t k = 0; k < n; k++)
                    sum += rows[c * n + k] * sigma[k];
                velocity[c * n + i] = sum;
            }
        }
        free(rows);
    }
    return failed ? igabem_fail(IGABEM_ERROR_MEMORY, "no memory for matrix rows") : IGABEM_OK;
}

igabem_status system_solve(size_t n, double *matrix, double *right, double *condition)
{
    if (n > INT_MAX)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "%zu unknowns are too many for LAPACK", n);
    lapack_int order = (lapack_int)n;
    lapack_int *pivots = malloc(n * sizeof *pivots);
    if (!pivots)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory to solve for %zu unknowns", n);
    /* Row-major storage is the transpose of LAPACK's, whose inf-norm is our 1-norm. */
    double norm = LAPACKE_dlange(LAPACK_COL_MAJOR, 'I', order, order, matrix, order);
    igabem_status status = IGABEM_OK;
    if (!isfinite(norm))
        status = igabem_fail(IGABEM_ERROR_NUMERIC, "the influence matrix is not finite");
    else if (LAPACKE_dgetrf(LAPACK_COL_MAJOR, order, order, matrix, order, pivots) != 0)
        status = igabem_fail(IGABEM_ERROR_NUMERIC, "the influence matrix is singular");
    if (status == IGABEM_OK) {
        double reciprocal = 0.0;
        if (condition) {
            LAPACKE_dgecon(LAPACK_COL_MAJOR, 'I', order, matrix, order, norm, &reciprocal);
            *condition = 1.0 / reciprocal;
        }
        LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'T', order, 1, matrix, order, pivots, right, order);
        for (size_t i = 0; i < n && status == IGABEM_OK; i++)
            if (!isfinite(right[i]))
                status = igabem_fail(IGABEM_ERROR_NUMERIC, "unknown %zu is not finite", i);
    }
    free(pivots);
    return status;
}
