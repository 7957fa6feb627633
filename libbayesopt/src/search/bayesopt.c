/* The optimisation as its caller holds it, with its store: freed, its budget changed. */
#include "core/error.h"
#include "problem/internal.h"
#include "store/store.h"

void bayesopt_free(bayesopt *bo)
{
    if (!bo)
        return;
    store_close(bo);
    problem_free(bo);
}

bayesopt_status bayesopt_set_budget(bayesopt *bo, size_t max_evaluations)
{
    NEED(bo);
    size_t before = bo->options.max_evaluations;
    bayesopt_status status = store_begin(bo);
    if (status)
        return status;
    bo->options.max_evaluations = max_evaluations;
    status = store_put_budget(bo);
    if (!status)
        status = store_commit(bo);
    if (status) {
        store_rollback(bo);
        bo->options.max_evaluations = before;
    }
    return status;
}
