#include "core/progress.h"

#include "core/error.h"
#include "threads.h"

#include <math.h>
#include <time.h>

static const double PART = 0.01, SECONDS = 0.5;

double wall_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

igabem_status progress_report(struct progress *progress, double fraction)
{
    progress->done = fmax(progress->done, fmin(fraction, 1.0));
    progress->told = wall_seconds();
    if (progress->tell && progress->tell(progress->user_data, progress->done))
        atomic_store(&progress->cancelled, true);
    return progress_status(progress);
}

void progress_stage(struct progress *progress, double to, size_t steps)
{
    if (!progress)
        return;
    progress->from = progress->done;
    progress->to = to;
    progress->steps = steps;
    atomic_store(&progress->step, 0);
}

bool progress_step(struct progress *progress)
{
    if (!progress || !progress->tell)
        return false;
    size_t step = atomic_fetch_add(&progress->step, 1) + 1;
    if (threads_first() && !atomic_load(&progress->cancelled)) {
        double share = fmin((double)step / (double)progress->steps, 1.0);
        double fraction = progress->from + (progress->to - progress->from) * share;
        if (fraction >= progress->done + PART || wall_seconds() >= progress->told + SECONDS)
            progress_report(progress, fraction);
    }
    return atomic_load(&progress->cancelled);
}

igabem_status progress_status(const struct progress *progress)
{
    if (!progress || !atomic_load(&progress->cancelled))
        return IGABEM_OK;
    return igabem_fail(IGABEM_ERROR_CANCELLED, "cancelled by the caller");
}
