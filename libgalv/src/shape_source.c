/* Samples of a shape as a source of rows. */
#include "error.h"
#include "shape.h"
#include "source.h"
#include "threads.h"

#include <math.h>
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
        galv_uniform_sample(source->sampling.seed, source->sampling.first + r, n,
                            galv_shape_lower(source->shape), galv_shape_upper(source->shape), x);
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

static galv_status evaluate_extra(const galv_extra *extra, size_t npoints, const double *moved,
                                  double *values)
{
    size_t evaluated = extra->count - extra->given;
    int refused = evaluated ? extra->evaluate(extra->user_data, npoints, moved, values) : 0;
    if (refused)
        return galv_fail(GALV_ERROR_NUMERIC, "the appended quantities gave %d", refused);
    for (size_t i = 0; i < evaluated; i++)
        if (!isfinite(values[i]))
            return galv_fail(GALV_ERROR_NUMERIC, "appended quantity %zu is %g", i, values[i]);
    return GALV_OK;
}

static galv_status copy_given(const galv_extra *extra, size_t sample, double *values)
{
    size_t evaluated = extra->count - extra->given;
    for (size_t i = 0; i < extra->given; i++) {
        double value = extra->values[sample * extra->given + i];
        if (!isfinite(value))
            return galv_fail(GALV_ERROR_NUMERIC, "appended quantity %zu is %g", evaluated + i,
                             value);
        values[evaluated + i] = value;
    }
    return GALV_OK;
}

/* The changes of the appended quantities, behind the stored coordinates of each row; the first row
 * is sample `first`. */
static galv_status append(const galv_shape_source *source, size_t first, size_t count, double *rows,
                          size_t *bad)
{
    const galv_plan *plan = source->plan;
    const galv_extra *extra = source->extra;
    size_t length = 3 * source->npoints, ld = source->head.stored;
    double *moved = malloc(length * sizeof *moved);
    galv_status status = moved ? GALV_OK : galv_fail(GALV_ERROR_MEMORY, "moved points");
    for (size_t r = 0; r < count && !status; r++) {
        double *row = rows + r * ld, *values = row + plan->stored;
        memcpy(moved, source->xyz, length * sizeof *moved);
        for (size_t s = 0; s < plan->stored; s++)
            moved[plan->index[s]] += row[s];
        status = evaluate_extra(extra, source->npoints, moved, values);
        for (size_t i = 0; i < extra->count - extra->given && !status; i++)
            values[i] -= source->parent[i];
        if (!status)
            status = copy_given(extra, first + r, values);
        if (status)
            *bad = r;
    }
    free(moved);
    return status;
}

static galv_status task_rows(const galv_shape_source *source, size_t first, size_t count,
                             const double *x, double *rows, size_t *bad)
{
    galv_status status = source->plan->rows(source->plan, count, x, rows, source->head.stored, bad);
    return status || !source->extra ? status : append(source, first, count, rows, bad);
}

static galv_status shape_rows(galv_source *head, size_t first, size_t count, double *rows)
{
    galv_shape_source *source = (galv_shape_source *)head;
    size_t n = galv_shape_parameters(source->shape), stored = head->stored;
    struct failure failure = {.status = GALV_OK};
    for (size_t r = 0; r < count; r++)
        galv_shape_source_parameters(source, first + r, source->x + r * n);
    bool concurrent = source->plan->concurrent && (!source->extra || source->extra->concurrent);
    size_t task = concurrent ? TASK_ROWS : count;
#pragma omp parallel for num_threads(threads_at_hand()) schedule(dynamic) if (concurrent)
    for (size_t begin = 0; begin < count; begin += task) {
        size_t rest = count - begin, bad = 0;
        galv_status status = task_rows(source, first + begin, rest < task ? rest : task,
                                       source->x + begin * n, rows + begin * stored, &bad);
        if (status) {
#pragma omp critical(galv_shape_rows)
            keep_first(&failure, status, first + begin + bad);
        }
    }
    if (failure.status)
        return galv_fail(failure.status, "sample %zu: %s", failure.row, failure.message);
    return GALV_OK;
}

static galv_status start_extra(galv_shape_source *source)
{
    const galv_extra *extra = source->extra;
    size_t planned = source->plan->stored;
    if (extra->given > extra->count || (extra->given && !extra->values) ||
        (extra->given < extra->count && !extra->evaluate))
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "%zu of %zu appended quantities are given per sample, but their values or "
                         "the function that evaluates the others is missing",
                         extra->given, extra->count);
    source->index = malloc((planned + extra->count) * sizeof *source->index);
    source->parent = malloc((extra->count + 1) * sizeof *source->parent);
    if (!source->index || !source->parent)
        return galv_fail(GALV_ERROR_MEMORY, "%zu appended quantities", extra->count);
    memcpy(source->index, source->plan->index, planned * sizeof *source->index);
    for (size_t i = 0; i < extra->count; i++)
        source->index[planned + i] = 3 * source->npoints + i;
    source->head.coordinates += extra->count;
    source->head.stored += extra->count;
    source->head.index = source->index;
    return evaluate_extra(extra, source->npoints, source->xyz, source->parent);
}

galv_status galv_shape_source_start(galv_shape_source *source, const galv_shape *shape,
                                    size_t npoints, const double *xyz, galv_sampling sampling,
                                    const galv_extra *extra, size_t block)
{
    *source = (galv_shape_source){
        .shape = shape, .sampling = sampling, .extra = extra, .npoints = npoints, .xyz = xyz};
    galv_status status = galv_plan_create(shape, npoints, xyz, &source->plan);
    if (status)
        return status;
    source->head = (galv_source){.samples = sampling.count,
                                 .coordinates = 3 * npoints,
                                 .stored = source->plan->stored,
                                 .index = source->plan->index,
                                 .rows = shape_rows};
    source->x = malloc(block * galv_shape_parameters(shape) * sizeof *source->x);
    if (!source->x)
        status = galv_fail(GALV_ERROR_MEMORY, "parameters of %zu samples", block);
    else if (extra)
        status = start_extra(source);
    if (status)
        galv_shape_source_end(source);
    return status;
}

void galv_shape_source_end(galv_shape_source *source)
{
    galv_plan_free(source->plan);
    free(source->x);
    free(source->index);
    free(source->parent);
    *source = (galv_shape_source){.plan = NULL};
}
