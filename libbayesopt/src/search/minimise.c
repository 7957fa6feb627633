/* The loop with a callback. */
#include "core/error.h"
#include "problem/internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

bayesopt_status bayesopt_minimise(bayesopt *bo, bayesopt_objective objective, void *data,
                                  bayesopt_progress progress, void *progress_user_data)
{
    NEED(bo);
    NEED(objective);
    size_t m = bo->options.n_constraints;
    double *x = malloc((bo->d + m + 1) * sizeof *x);
    if (!x)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    double *constraints = x + bo->d;
    bayesopt_status status;
    uint64_t id;
    while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK) {
        double f = NAN;
        int code = objective(data, bo->d, x, &f, constraints);
        if (code) {
            char reason[64];
            snprintf(reason, sizeof reason, "the objective returned %d", code);
            status = bayesopt_tell_failed(bo, id, reason);
        } else {
            status = bayesopt_tell(bo, id, f, m ? constraints : NULL);
        }
        if (!status && progress && progress(progress_user_data, bo))
            status = bayesopt_fail(BAYESOPT_ERROR_CANCELLED, "cancelled after %zu evaluations",
                                   bo->n_points);
        if (status)
            break;
    }
    free(x);
    return status;
}
