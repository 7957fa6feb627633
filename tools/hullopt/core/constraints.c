#include "core/constraints.h"

#include <math.h>

/* Known volumes of hulls are linear to a few 1e-5, so the search stays this far inside the band,
 * and grids are allowed to touch the centre plane. */
static const double BAND_MARGIN = 1e-4, TOUCH = 1e-9;

size_t limits_count(const struct config *config)
{
    return 1u + (isnan(config->breadth) ? 0u : 1u) + (isnan(config->entrance) ? 0u : 1u) +
           (isnan(config->displacement) ? 0u : 2u);
}

int limits_evaluate(void *user_data, size_t d, const double *u, double *value)
{
    const struct problem *problem = user_data;
    const struct config *config = problem->config;
    double least, share, ratio;
    (void)d;
    if (galv_limits_breadth(problem->limits, u, &least, &share) != GALV_OK)
        return 1;
    *value++ = -least / problem_length(problem) - TOUCH;
    if (!isnan(config->breadth))
        *value++ = config->breadth - share;
    if (!isnan(config->entrance)) {
        if (galv_limits_entrance(problem->limits, u, &ratio) != GALV_OK)
            return 1;
        *value++ = ratio - config->entrance;
    }
    if (isnan(config->displacement))
        return 0;
    if (galv_limits_volume(problem->limits, u, &ratio) != GALV_OK)
        return 1;
    double change = ratio - 1, band = fmax(config->displacement - BAND_MARGIN, 0);
    *value++ = change - band;
    *value++ = -change - band;
    return isnan(change);
}

size_t outcome_bounds(const struct config *config, double bound[OUTCOME_MOST])
{
    size_t n = 0;
    if (!isnan(config->pressure))
        bound[n++] = config->pressure;
    for (size_t i = 0; i < config->verify_froudes && !isnan(config->speeds); i++)
        bound[n++] = config->speeds;
    return n;
}

void outcome_ratios(const struct config *config, const struct evaluation *e,
                    const struct evaluation *parent, double ratio[OUTCOME_MOST])
{
    if (!isnan(config->pressure))
        *ratio++ = e->cw_pressure / parent->cw_pressure;
    for (size_t i = 0; i < config->verify_froudes && !isnan(config->speeds); i++)
        *ratio++ = e->cw_speed[i] / parent->cw_speed[i];
}

bool outcome_allowed(const struct config *config, const struct evaluation *e,
                     const struct evaluation *parent)
{
    double bound[OUTCOME_MOST], ratio[OUTCOME_MOST];
    if (e->failed || e->id == parent->id)
        return !e->failed;
    size_t n = outcome_bounds(config, bound);
    outcome_ratios(config, e, parent, ratio);
    for (size_t i = 0; i < n; i++)
        if (!(ratio[i] <= bound[i]))
            return false;
    return true;
}

const struct evaluation *outcome_best(const struct config *config, size_t n,
                                      const struct evaluation *list)
{
    const struct evaluation *best = NULL;
    for (size_t i = 0; i < n; i++)
        if (outcome_allowed(config, &list[i], list) && (!best || list[i].cw < best->cw))
            best = &list[i];
    return best;
}
