#include "core/front.h"

#include "core/constraints.h"
#include "core/objective.h"

#include <math.h>
#include <stdlib.h>

/* The parent has row 0 of the history, and 0 for its id in a list. */
static bool find_place(const struct record *record, size_t row, size_t n,
                       const struct evaluation *list, size_t *place)
{
    bayesopt_point point;
    if (bayesopt_get(record->bo, row, &point) != BAYESOPT_OK)
        return core_fail("%s", bayesopt_last_error());
    for (*place = 0; *place < n; ++*place)
        if (list[*place].id == (row ? point.id : 0))
            return true;
    return core_fail("design %llu is not in the list", (unsigned long long)point.id);
}

bool front_of(const struct record *record, size_t n, const struct evaluation *list, size_t *count,
              size_t *places)
{
    size_t *rows = malloc((bayesopt_count(record->bo) + 1) * sizeof *rows);
    bool ok = rows || core_no_memory();
    if (ok && bayesopt_pareto(record->bo, count, rows) != BAYESOPT_OK)
        ok = core_fail("%s", bayesopt_last_error());
    for (size_t i = 0; ok && i < *count; i++)
        ok = find_place(record, rows[i], n, list, &places[i]);
    free(rows);
    return ok;
}

/* Square of the distance from the best of each objective, where it ranges from low to high. */
static double distance(const struct config *config, double length, const struct evaluation *list,
                       const struct evaluation *e, const double *low, const double *high)
{
    struct objective o;
    double sum = 0;
    for (size_t k = 0; k < objectives_count(config); k++) {
        objectives_describe(config, k, &o);
        double value = objectives_value(config, k, length, e, list), range = high[k] - low[k];
        double share = (o.maximise ? high[k] - value : value - low[k]) / (range > 0 ? range : 1);
        sum += share * share;
    }
    return sum;
}

static const struct evaluation *pick(const struct config *config, double length,
                                     const struct evaluation *list, size_t count,
                                     const size_t *places)
{
    double low[OBJECTIVES_MOST], high[OBJECTIVES_MOST], least = INFINITY;
    const struct evaluation *best = count ? &list[places[0]] : NULL;
    for (size_t k = 0; k < OBJECTIVES_MOST; k++) {
        low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < objectives_count(config); k++) {
            double value = objectives_value(config, k, length, &list[places[i]], list);
            low[k] = fmin(low[k], value);
            high[k] = fmax(high[k], value);
        }
    for (size_t i = 0; i < count; i++) {
        double d = distance(config, length, list, &list[places[i]], low, high);
        if (!(d < least) || (places[i] == 0 && count > 1))
            continue;
        least = d;
        best = &list[places[i]];
    }
    return best;
}

bool front_best(const struct record *record, const struct config *config, double length, size_t n,
                const struct evaluation *list, const struct evaluation **best)
{
    *best = outcome_best(config, n, list);
    if (objectives_count(config) == 1 || !*best)
        return true;
    size_t count = 0, *places = malloc((n + 1) * sizeof *places);
    bool ok = (places || core_no_memory()) && front_of(record, n, list, &count, places);
    if (ok && count)
        *best = pick(config, length, list, count, places);
    free(places);
    return ok;
}
