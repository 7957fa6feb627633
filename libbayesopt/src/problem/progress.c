/* An ask under way, and whether its caller wants no more of it. */
#include "core/error.h"
#include "problem/internal.h"

bool ask_is_cancelled(struct bayesopt *bo)
{
    struct progress *p = &bo->progress;
    if (p->callback && p->wanted && !p->cancelled)
        p->cancelled = p->callback(p->user_data, p->found, p->wanted) != 0;
    return p->cancelled;
}

bayesopt_status ask_cancelled(const struct bayesopt *bo)
{
    return bayesopt_fail(BAYESOPT_ERROR_CANCELLED, "cancelled after %zu of %zu points",
                         bo->progress.found, bo->progress.wanted);
}
