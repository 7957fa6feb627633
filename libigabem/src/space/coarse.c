#include "space/coarse.h"

#include "core/error.h"
#include "space/element.h"

#include <nurbs/basis.h>

#include <cblas.h>
#include <lapacke.h>
#include <stdlib.h>
#include <string.h>

struct coarse_patch {
    size_t size[2], kept[2]; /* functions of the density, and of the part */
    size_t offset, begin;    /* their first unknowns */
    double *map[2];          /* [size][kept]: functions of the part in those of the density */
    const double *weights;   /* of the density, borrowed; NULL: polynomial */
};

struct coarse {
    size_t patches, n, work;
    struct coarse_patch *patch;
};

/* Knots with every second one of a run of simple inner knots left out; returns the functions. */
static size_t thin(int degree, size_t n, const double *knots, double *kept)
{
    size_t p = (size_t)degree, count = 0, run = 0;
    for (size_t k = 0; k < n + p + 1; k++) {
        bool inner = k > p && k < n && knots[k] > knots[k - 1] && knots[k] < knots[k + 1];
        run = inner ? run + 1 : 0;
        if (run % 2 == 0)
            kept[count++] = knots[k];
    }
    return count - p - 1;
}

static void fill_functions(int degree, size_t n, const double *knots, size_t m,
                           const double *abscissa, double *matrix)
{
    size_t span = 0, p = (size_t)degree;
    memset(matrix, 0, m * n * sizeof *matrix);
    for (size_t i = 0; i < m; i++) {
        span = nurbs_basis_span(degree, n, knots, abscissa[i], &span);
        nurbs_basis(degree, knots, span, abscissa[i], matrix + i * n + span - p);
    }
}

/* Values of the part's functions at the collocation abscissae, interpolated there: exact, since
 * the density's space holds them. */
static igabem_status map_direction(const struct density_patch *from, int d,
                                   struct coarse_patch *patch)
{
    size_t n = from->size[d], p = (size_t)from->degree[d];
    double *kept = malloc((n + p + 1) * sizeof *kept), *square = malloc(n * n * sizeof *square);
    lapack_int *pivots = malloc(n * sizeof *pivots);
    patch->map[d] = malloc(n * n * sizeof(double));
    igabem_status status = IGABEM_OK;
    if (kept && square && pivots && patch->map[d]) {
        size_t m = patch->kept[d] = thin(from->degree[d], n, from->knots[d], kept);
        fill_functions(from->degree[d], n, from->knots[d], n, from->abscissa[d], square);
        fill_functions(from->degree[d], m, kept, n, from->abscissa[d], patch->map[d]);
        lapack_int info = LAPACKE_dgesv(LAPACK_ROW_MAJOR, (lapack_int)n, (lapack_int)m, square,
                                        (lapack_int)n, pivots, patch->map[d], (lapack_int)m);
        if (info != 0)
            status = igabem_fail_lapack("functions on half the knots", info);
    } else {
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu functions", n);
    }
    free(kept);
    free(square);
    free(pivots);
    return status;
}

igabem_status coarse_create(const struct density *density, struct coarse **result)
{
    *result = NULL;
    struct coarse *coarse = calloc(1, sizeof *coarse);
    if (coarse)
        coarse->patch = calloc(density->patches, sizeof *coarse->patch);
    igabem_status status = IGABEM_OK;
    if (!coarse || !coarse->patch)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for functions on half the knots");
    else
        coarse->patches = density->patches;
    for (size_t k = 0; k < density->patches && status == IGABEM_OK; k++) {
        struct coarse_patch *patch = &coarse->patch[k];
        const struct density_patch *from = &density->patch[k];
        *patch = (struct coarse_patch){
            .offset = from->offset, .begin = coarse->n, .weights = from->weights};
        for (int d = 0; d < 2 && status == IGABEM_OK; d++) {
            patch->size[d] = from->size[d];
            status = map_direction(from, d, patch);
        }
        coarse->n += patch->kept[0] * patch->kept[1];
        size_t work = patch->size[0] * (patch->size[1] + patch->kept[1]);
        coarse->work = work > coarse->work ? work : coarse->work;
    }
    if (status != IGABEM_OK || coarse->n == density->n) {
        coarse_free(coarse);
        return status;
    }
    *result = coarse;
    return IGABEM_OK;
}

void coarse_free(struct coarse *coarse)
{
    for (size_t k = 0; coarse && k < coarse->patches; k++)
        for (int d = 0; d < 2; d++)
            free(coarse->patch[k].map[d]);
    if (coarse)
        free(coarse->patch);
    free(coarse);
}

size_t coarse_size(const struct coarse *coarse)
{
    return coarse->n;
}

size_t coarse_work(const struct coarse *coarse)
{
    return coarse->work;
}

static void multiply(CBLAS_TRANSPOSE ta, CBLAS_TRANSPOSE tb, size_t m, size_t n, size_t k,
                     const double *a, size_t lda, const double *b, size_t ldb, double *c)
{
    cblas_dgemm(CblasRowMajor, ta, tb, (blasint)m, (blasint)n, (blasint)k, 1.0, a, (blasint)lda, b,
                (blasint)ldb, 0.0, c, (blasint)n);
}

/* The density is (Sum c N)/W with weights w of its own functions: those of the part share W. */
void coarse_row(const struct coarse *coarse, const double *row, double *work, double *part)
{
    for (size_t k = 0; k < coarse->patches; k++) {
        const struct coarse_patch *p = &coarse->patch[k];
        size_t nu = p->size[0], nv = p->size[1], mu = p->kept[0], mv = p->kept[1];
        double *weighted = work, *half = work + nu * nv;
        for (size_t i = 0; i < nu * nv; i++)
            weighted[i] = row[p->offset + i] / (p->weights ? p->weights[i] : 1.0);
        multiply(CblasNoTrans, CblasNoTrans, nu, mv, nv, weighted, nv, p->map[1], mv, half);
        multiply(CblasTrans, CblasNoTrans, mu, mv, nu, p->map[0], mu, half, mv, part + p->begin);
    }
}

void coarse_expand(const struct coarse *coarse, const double *part, double *work, double *density)
{
    for (size_t k = 0; k < coarse->patches; k++) {
        const struct coarse_patch *p = &coarse->patch[k];
        size_t nu = p->size[0], nv = p->size[1], mu = p->kept[0], mv = p->kept[1];
        double *fine = density + p->offset;
        multiply(CblasNoTrans, CblasNoTrans, nu, mv, mu, p->map[0], mu, part + p->begin, mv, work);
        multiply(CblasNoTrans, CblasTrans, nu, nv, mv, work, mv, p->map[1], mv, fine);
        for (size_t i = 0; i < nu * nv && p->weights; i++)
            fine[i] /= p->weights[i];
    }
}
