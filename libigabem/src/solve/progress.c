#include "solve/progress.h"

#include "core/error.h"

#include <math.h>

igabem_status progress_report(struct progress *progress, double fraction)
{
    progress->done = fmax(progress->done, fraction);
    if (progress->tell && progress->tell(progress->user_data, progress->done))
        return igabem_fail(IGABEM_ERROR_CANCELLED, "cancelled by the caller");
    return IGABEM_OK;
}
