#include "solve/coarsened.h"

#include "core/error.h"
#include "space/coarse.h"

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>

enum { BLOCK = 64 };

/* The normal equations: their condition is the square of one of 1e2 to 1e4, harmless for an
 * estimate, and they are summed block by block, so that they can be cancelled. */
struct normal {
    double *square, *right; /* [m][m] upper triangle, [m] */
    double *rows;           /* [BLOCK][m] */
    double *flow;           /* [n] */
    double *work;           /* one piece for each of BLOCK rows, so that threads may share them */
};

static igabem_status sum_up(const struct matrix *matrix, const struct coarse *coarse,
                            const struct normal *normal)
{
    size_t n = matrix->n, m = coarse_size(coarse), work = coarse_work(coarse);
    blasint order = (blasint)m;
    for (size_t first = 0; first < n; first += BLOCK) {
        size_t count = n - first < BLOCK ? n - first : BLOCK;
#pragma omp parallel for num_threads(matrix->threads) schedule(static)
        for (size_t i = 0; i < count; i++)
            coarse_row(coarse, matrix->rows + (first + i) * matrix->stride, normal->work + i * work,
                       normal->rows + i * m);
        cblas_dsyrk(CblasRowMajor, CblasUpper, CblasTrans, order, (blasint)count, 1.0, normal->rows,
                    order, 1.0, normal->square, order);
        cblas_dgemv(CblasRowMajor, CblasTrans, (blasint)count, order, 1.0, normal->rows, order,
                    normal->flow + first, 1, 1.0, normal->right, 1);
        if (progress_step(matrix->progress))
            return progress_status(matrix->progress);
    }
    return IGABEM_OK;
}

static igabem_status solve(const struct matrix *matrix, const igabem_solution *solution,
                           const struct coarse *coarse, const struct normal *normal, double **sigma)
{
    lapack_int order = (lapack_int)coarse_size(coarse);
    solution_normal_flow(solution, normal->flow);
    igabem_status status = sum_up(matrix, coarse, normal);
    if (status != IGABEM_OK)
        return status;
    /* Row by row the upper triangle is LAPACK's lower one. */
    lapack_int info =
        LAPACKE_dposv(LAPACK_COL_MAJOR, 'L', order, 1, normal->square, order, normal->right, order);
    if (info < 0)
        return igabem_fail_lapack("density on half the knots", info);
    if (info > 0) /* not definite: the estimate is not known, which is no reason to fail */
        return IGABEM_OK;
    *sigma = malloc(matrix->n * sizeof **sigma);
    if (!*sigma)
        return solution_no_memory(matrix->n);
    coarse_expand(coarse, normal->right, normal->work, *sigma);
    return IGABEM_OK;
}

igabem_status coarsened_density(const struct matrix *matrix, const igabem_solution *solution,
                                double **sigma)
{
    struct coarse *coarse;
    *sigma = NULL;
    igabem_status status = coarse_create(solution->density, &coarse);
    if (status != IGABEM_OK || !coarse)
        return status;
    size_t m = coarse_size(coarse), n = matrix->n;
    struct normal normal = {.square = calloc(m * m, sizeof(double)),
                            .right = calloc(m, sizeof(double)),
                            .rows = malloc(BLOCK * m * sizeof(double)),
                            .flow = malloc(n * sizeof(double)),
                            .work = malloc(BLOCK * coarse_work(coarse) * sizeof(double))};
    status = normal.square && normal.right && normal.rows && normal.flow && normal.work
                 ? solve(matrix, solution, coarse, &normal, sigma)
                 : solution_no_memory(n);
    free(normal.square);
    free(normal.right);
    free(normal.rows);
    free(normal.flow);
    free(normal.work);
    coarse_free(coarse);
    return status;
}
