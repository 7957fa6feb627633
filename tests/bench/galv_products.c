/* Prints how the products of a block of samples with a few vectors, which libgalv computes with a
 * kernel of its own, compare with dgemm: processor seconds of one thread, least of five. Run it
 * with OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1 and an OPENBLAS_CORETYPE that fits the processor.
 */
#include "products.h"

#include <cblas.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { REPEATS = 5, COUNT = 512 };

struct problem {
    size_t n, b, ld;
    double *rows, *v, *t, *y;
};

static void own_times(struct problem *p)
{
    galv_rows_times(COUNT, p->n, 1, p->rows, p->b, p->v, p->t);
}

static void blas_times(struct problem *p)
{
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, COUNT, (blasint)p->ld, (blasint)p->n, 1,
                p->rows, (blasint)p->n, p->v, (blasint)p->ld, 0, p->t, (blasint)p->ld);
}

static void own_add(struct problem *p)
{
    galv_rows_add_transposed(COUNT, p->n, p->rows, p->b, p->t, p->y);
}

static void blas_add(struct problem *p)
{
    cblas_dgemm(CblasRowMajor, CblasTrans, CblasNoTrans, (blasint)p->n, (blasint)p->ld, COUNT, 1,
                p->rows, (blasint)p->n, p->t, (blasint)p->ld, 1, p->y, (blasint)p->ld);
}

static double measure(void (*product)(struct problem *), struct problem *p)
{
    double least = 1e9;
    for (int k = 0; k < REPEATS; k++) {
        clock_t start = clock();
        product(p);
        double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
        least = seconds < least ? seconds : least;
    }
    return least;
}

static int compare(size_t n, size_t b)
{
    size_t ld = galv_padded(b);
    struct problem p = {n,
                        b,
                        ld,
                        malloc(COUNT * n * sizeof(double)),
                        malloc(n * ld * sizeof(double)),
                        malloc(COUNT * ld * sizeof(double)),
                        calloc(n * ld, sizeof(double))};
    int ok = p.rows && p.v && p.t && p.y;
    for (size_t i = 0; ok && i < COUNT * n; i++)
        p.rows[i] = (double)(i * 7919 % 1000) / 1000;
    for (size_t i = 0; ok && i < n * ld; i++)
        p.v[i] = (double)(i * 104729 % 1000) / 1000;
    if (ok) {
        memset(p.t, 0, COUNT * ld * sizeof *p.t);
        double times = measure(own_times, &p), times_blas = measure(blas_times, &p);
        double add = measure(own_add, &p), add_blas = measure(blas_add, &p);
        printf("| %zu | %zu | %.2f | %.2f | %.1f | %.2f | %.2f | %.1f |\n", n, b, 1e3 * times,
               1e3 * times_blas, times_blas / times, 1e3 * add, 1e3 * add_blas, add_blas / add);
    }
    free(p.rows);
    free(p.v);
    free(p.t);
    free(p.y);
    return ok;
}

int main(void)
{
    static const size_t coordinates[] = {2135, 6750, 20000}, vectors[] = {16, 32, 64};
    puts("| coordinates | vectors | rows V, ms | dgemm | ratio | rows^T T, ms | dgemm | ratio |\n"
         "|---|---|---|---|---|---|---|---|");
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < 3; k++)
            if (!compare(coordinates[i], vectors[k]))
                return EXIT_FAILURE;
    return EXIT_SUCCESS;
}
