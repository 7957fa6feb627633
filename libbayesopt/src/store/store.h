/* The history on disk. Without an open store every call succeeds and does nothing. */
#ifndef BAYESOPT_STORE_CALLS_H
#define BAYESOPT_STORE_CALLS_H

#include "problem/internal.h"

/* Takes the write lock and reads what other sessions have written since. */
bayesopt_status store_begin(struct bayesopt *bo);
/* On disk when it returns. */
bayesopt_status store_commit(struct bayesopt *bo);
/* Keeps the last error message. */
void store_rollback(struct bayesopt *bo);
bayesopt_status store_insert(struct bayesopt *bo, const struct point *point);
bayesopt_status store_update(struct bayesopt *bo, const struct point *point);
/* The warm starts of the models and the budget. */
bayesopt_status store_put_state(struct bayesopt *bo);
bayesopt_status store_put_budget(struct bayesopt *bo);
/* The initial design, once made. */
bayesopt_status store_put_design(struct bayesopt *bo);
/* Marks pending points of dead sessions as to be asked again (session 0). reclaim: detached ones
 * too. */
bayesopt_status store_release_orphans(struct bayesopt *bo, bool reclaim, double age);
/* Notes that a point is asked now. */
bayesopt_status store_touch(struct bayesopt *bo, const struct point *point);
bayesopt_status store_detach(struct bayesopt *bo);
void store_close(struct bayesopt *bo);

#endif
