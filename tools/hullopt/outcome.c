#include "outcome.h"

#include <math.h>

size_t outcome_bounds(const struct outcome_limits *limits, size_t speeds,
                      double bound[OUTCOME_MOST])
{
    size_t n = 0;
    if (!isnan(limits->pressure))
        bound[n++] = limits->pressure;
    for (size_t i = 0; i < speeds && !isnan(limits->speeds); i++)
        bound[n++] = limits->speeds;
    return n;
}

void outcome_ratios(const struct outcome_limits *limits, const struct evaluation *e,
                    const struct evaluation *parent, double ratio[OUTCOME_MOST])
{
    if (!isnan(limits->pressure))
        *ratio++ = e->cw_pressure / parent->cw_pressure;
    for (size_t i = 0; i < parent->speeds && !isnan(limits->speeds); i++)
        *ratio++ = e->cw_speed[i] / parent->cw_speed[i];
}

bool outcome_allowed(const struct outcome_limits *limits, const struct evaluation *e,
                     const struct evaluation *parent)
{
    double bound[OUTCOME_MOST], ratio[OUTCOME_MOST];
    if (e->failed || e->id == parent->id)
        return !e->failed;
    size_t n = outcome_bounds(limits, parent->speeds, bound);
    outcome_ratios(limits, e, parent, ratio);
    for (size_t i = 0; i < n; i++)
        if (!(ratio[i] <= bound[i]))
            return false;
    return true;
}
