/* How far a call has come, as its caller hears it. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <igabem/solve.h>

#include <stdatomic.h>
#include <stdbool.h>

struct progress {
    igabem_progress tell; /* NULL: nobody listens */
    void *user_data;
    double done; /* fraction told */
    double told; /* when, s */
    /* The stage at work: from `from` to `to` of the call in so many steps. */
    double from, to;
    size_t steps;
    atomic_size_t step;
    atomic_bool cancelled;
};

double wall_seconds(void); /* from some time on */

/* IGABEM_ERROR_CANCELLED when the caller wants to stop. */
igabem_status progress_report(struct progress *progress, double fraction);

/* The next stage ends at the fraction `to`. All of these take NULL. */
void progress_stage(struct progress *progress, double to, size_t steps);

/* One step of the stage is done, by any thread of a team: the first thread, which is the caller's,
 * tells after every hundredth and twice a second. true: the caller wants to stop. */
bool progress_step(struct progress *progress);

/* IGABEM_ERROR_CANCELLED when that has been said in a stage. */
igabem_status progress_status(const struct progress *progress);

#endif
