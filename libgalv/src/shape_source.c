/* Samples of a shape as a source of rows. */
#include "error.h"
#include "shape.h"
#include "source.h"

#include <stdlib.h>
#include <string.h>

/* Rows per task: enough to amortise a task, few enough to balance two threads on one block. */
enum { TASK_ROWS = 16 };

void galv_shape_source_parameters(const galv_shape_source *source, size_t r, double *x)
{
    size_t n = galv_shape_parameters(source->shape);
    if (source->sampling.x)
        memcpy(x, source->sampling.x + r * n, n * sizeof *x);
    else
        galv_uniform_sample(source->sampling.seed, r, n, galv_shape_lower(source->shape),
                            galv_shape_upper(source->shape), x);
}

/* The first failure among the tasks of a block, by sample, so that the message does not depend on
 * which thread came first. */
struct failure {
    galv_status status;
    size_t row;
    char message[400];
};

static void keep_first(struct failure *failure, galv_status status, size_t row)
{
    if (failure->status && failure->row <= row)
        return;
    failure->status = status;
    failure->row = row;
    strncpy(failure->message, galv_last_error(), sizeof failure->message - 1);
}

static galv_status shape_rows(galv_source *head, size_t first, size_t count, double *rows)
{
    galv_shape_source *source = (galv_shape_source *)head;
    const galv_plan *plan = source->plan;
    size_t n = galv_shape_parameters(source->shape), stored = head->stored;
    struct failure failure = {.status = GALV_OK};
    for (size_t r = 0; r < count; r++)
        galv_shape_source_parameters(source, first + r, source->x + r * n);
    size_t task = plan->concurrent ? TASK_ROWS : count;
#pragma omp parallel for schedule(dynamic) if (plan->concurrent)
    for (size_t begin = 0; begin < count; begin += task) {
        size_t rest = count - begin, bad = 0;
        galv_status status = plan->rows(plan, rest < task ? rest : task, source->x + begin * n,
                                        rows + begin * stored, stored, &bad);
        if (status) {
#pragma omp critical(galv_shape_rows)
            keep_first(&failure, status, first + begin + bad);
        }
    }
    if (failure.status)
        return galv_fail(failure.status, "sample %zu: %s", failure.row, failure.message);
    return GALV_OK;
}

galv_status galv_shape_source_start(galv_shape_source *source, const galv_shape *shape,
                                    size_t npoints, const double *xyz, galv_sampling sampling,
                                    size_t block)
{
    *source = (galv_shape_source){.shape = shape, .sampling = sampling, .room = block};
    galv_status status = galv_plan_create(shape, npoints, xyz, &source->plan);
    if (status)
        return status;
    source->x = malloc(block * galv_shape_parameters(shape) * sizeof *source->x);
    if (!source->x) {
        galv_shape_source_end(source);
        return galv_fail(GALV_ERROR_MEMORY, "parameters of %zu samples", block);
    }
    source->head = (galv_source){.samples = sampling.count,
                                 .coordinates = 3 * npoints,
                                 .stored = source->plan->stored,
                                 .index = source->plan->index,
                                 .rows = shape_rows};
    return GALV_OK;
}

void galv_shape_source_end(galv_shape_source *source)
{
    galv_plan_free(source->plan);
    free(source->x);
    source->plan = NULL;
    source->x = NULL;
}
