#include "stage.h"

#include "error.h"

#include <math.h>

void galv_stage_next(galv_stage *stage, double to)
{
    if (!stage)
        return;
    stage->from = stage->told;
    stage->to = fmax(to, stage->told);
}

void galv_stage_share(galv_stage *stage, double share, double to)
{
    if (stage)
        galv_stage_next(stage, stage->told + share * (to - stage->told));
}

galv_status galv_stage_report(galv_stage *stage, double done)
{
    if (!stage || !stage->tell)
        return GALV_OK;
    double fraction = stage->from + (stage->to - stage->from) * fmin(done, 1);
    stage->told = fmax(stage->told, fraction);
    if (stage->tell(stage->user_data, stage->told))
        return galv_fail(GALV_ERROR_CANCELLED, "cancelled at %.0f %% of the work",
                         100 * stage->told);
    return GALV_OK;
}
