/* Plans of shapes that have no faster way than their displace function, and of linear shapes. */
#include "error.h"
#include "shape.h"

#include <cblas.h>
#include <stdlib.h>
#include <string.h>

typedef struct general_plan {
    galv_plan head;
    const galv_shape *shape;
    size_t npoints;
    const double *xyz;
} general_plan;

static galv_status general_rows(const galv_plan *head, size_t count, const double *x, double *rows,
                                size_t ld, size_t *bad)
{
    const general_plan *plan = (const general_plan *)head;
    const galv_shape *shape = plan->shape;
    for (size_t r = 0; r < count; r++) {
        galv_status status = shape->class->displace(shape, plan->npoints, plan->xyz,
                                                    x + r * shape->n, rows + r * ld);
        if (status) {
            *bad = r;
            return status;
        }
    }
    return GALV_OK;
}

static void destroy_plain(galv_plan *plan)
{
    free(plan);
}

static galv_status general_create(const galv_shape *shape, size_t npoints, const double *xyz,
                                  galv_plan **out)
{
    general_plan *plan = malloc(sizeof *plan);
    size_t *index = malloc(3 * npoints * sizeof *index);
    if (!plan || !index) {
        free(plan);
        free(index);
        return galv_fail(GALV_ERROR_MEMORY, "plan of %zu points", npoints);
    }
    for (size_t i = 0; i < 3 * npoints; i++)
        index[i] = i;
    *plan = (general_plan){.head = {.stored = 3 * npoints,
                                    .index = index,
                                    .concurrent = shape->class->concurrent,
                                    .rows = general_rows,
                                    .destroy = destroy_plain},
                           .shape = shape,
                           .npoints = npoints,
                           .xyz = xyz};
    *out = &plan->head;
    return GALV_OK;
}

galv_status galv_plan_create(const galv_shape *shape, size_t npoints, const double *xyz,
                             galv_plan **plan)
{
    return (shape->class->plan ? shape->class->plan : general_create)(shape, npoints, xyz, plan);
}

void galv_plan_free(galv_plan *plan)
{
    if (!plan)
        return;
    free(plan->index);
    plan->destroy(plan);
}

typedef struct linear_plan {
    galv_plan head;
    size_t n;
    double *basis;
} linear_plan;

/* Not marked concurrent: BLAS threads the product itself. */
static galv_status linear_rows(const galv_plan *head, size_t count, const double *x, double *rows,
                               size_t ld, size_t *bad)
{
    (void)bad;
    const linear_plan *plan = (const linear_plan *)head;
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, (blasint)count, (blasint)head->stored,
                (blasint)plan->n, 1, x, (blasint)plan->n, plan->basis, (blasint)head->stored, 0,
                rows, (blasint)ld);
    return GALV_OK;
}

static void linear_destroy(galv_plan *head)
{
    linear_plan *plan = (linear_plan *)head;
    free(plan->basis);
    free(plan);
}

galv_status galv_plan_linear(size_t n, size_t stored, size_t *index, double *basis, galv_plan **out)
{
    linear_plan *plan = malloc(sizeof *plan);
    if (!plan) {
        free(index);
        free(basis);
        return galv_fail(GALV_ERROR_MEMORY, "plan of a linear shape");
    }
    *plan = (linear_plan){
        .head = {.stored = stored, .index = index, .rows = linear_rows, .destroy = linear_destroy},
        .n = n,
        .basis = basis};
    *out = &plan->head;
    return GALV_OK;
}

const double *galv_plan_basis(const galv_plan *plan)
{
    return plan->rows == linear_rows ? ((const linear_plan *)plan)->basis : NULL;
}
