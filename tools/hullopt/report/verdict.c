#include "report/verdict.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Half of the claimed gain confirms it; a finer mesh must keep more, because it is the same model.
 */
static const double CONFIRM_SHARE = 0.5, RESOLUTION_SHARE = 0.8;
/* Changes below this are within what the mesh decides. */
static const double NO_CHANGE = 0.01;

static double reduction(const struct verification *row)
{
    return 1 - row->cw_best / row->cw_parent;
}

__attribute__((format(printf, 2, 3))) static void say(struct verdict *v, const char *format, ...)
{
    size_t length = strlen(v->statement);
    va_list args;
    va_start(args, format);
    vsnprintf(v->statement + length, sizeof v->statement - length, format, args);
    va_end(args);
}

static void count_model(double gain, struct verdict *v)
{
    v->models++;
    if (gain >= CONFIRM_SHARE * v->claimed)
        v->confirm++;
    else if (gain > NO_CHANGE)
        v->partly++;
    else
        v->deny++;
}

static void count(const struct verification *row, struct verdict *v)
{
    double gain = reduction(row);
    switch (row->group) {
    case GROUP_OBJECTIVE:
        v->claimed = gain;
        v->pressure = 1 - row->cw_pressure_best / row->cw_pressure_parent;
        break;
    case GROUP_FORMULATION:
        count_model(gain, v);
        break;
    case GROUP_STERN:
        v->sterns = (!v->has_sterns || v->sterns) && gain >= CONFIRM_SHARE * v->claimed;
        v->has_sterns = true;
        break;
    case GROUP_RESOLUTION:
        v->has_resolution = true;
        v->resolution = gain >= RESOLUTION_SHARE * v->claimed;
        break;
    case GROUP_FILTER:
        v->has_filter = true;
        v->filter = gain >= CONFIRM_SHARE * v->claimed;
        break;
    case GROUP_SPEED:
        v->speeds = (!v->has_speeds || v->speeds) && gain >= -NO_CHANGE;
        v->has_speeds = true;
        break;
    case GROUP_COARSER:
    case GROUPS:
        break;
    }
}

static void state_models(struct verdict *v)
{
    if (!v->asked)
        say(v, "No other formulation was asked, so the gain is unconfirmed.");
    else if (v->models == 0)
        say(v, "No other formulation gave a result, so the gain is unconfirmed.");
    else if (v->only_objective)
        say(v,
            "Only the model of the search sees this gain: none of the %zu other models finds even "
            "half of it (%zu find less, %zu none). Take it as a property of that model.",
            v->models, v->partly, v->deny);
    else if (v->formulations)
        say(v, "%zu of %zu other models find at least half of the gain, and none contradicts it.",
            v->confirm, v->models);
    else
        say(v,
            "The models disagree: of %zu others %zu find at least half of the gain, %zu less, %zu "
            "none.",
            v->models, v->confirm, v->partly, v->deny);
}

static void state(struct verdict *v)
{
    if (!(v->claimed > NO_CHANGE)) {
        say(v, "The search found no hull of less wave resistance than the parent.");
        return;
    }
    say(v, "The objective sees C_w fall by %.1f %%. ", 100 * v->claimed);
    state_models(v);
    if (v->pressure < CONFIRM_SHARE * v->claimed)
        say(v,
            " The pressure integral of the same solutions does not see it: it changes by %+.1f %%.",
            -100 * v->pressure);
    if (v->has_sterns && !v->sterns)
        say(v, " With the stern treated over another length more than half of the gain is lost.");
    if (v->has_resolution)
        say(v, v->resolution ? " A finer solve keeps the gain."
                             : " A finer solve does not keep the gain.");
    if (v->has_filter && !v->filter)
        say(v, " With a filter for its own entrance angle the optimum loses more than half of the "
               "gain: its waterline is too full for the filter of the search.");
    if (v->has_speeds)
        say(v, v->speeds ? " At the other speeds resistance does not rise."
                         : " At another speed the resistance rises.");
}

void verdict_reach(const struct verification *rows, size_t n, struct verdict *v)
{
    *v = (struct verdict){.claimed = NAN, .pressure = NAN};
    for (size_t i = 0; i < n; i++)
        v->asked = v->asked || rows[i].group == GROUP_FORMULATION;
    for (size_t i = 0; i < n; i++)
        if (isfinite(rows[i].cw_parent) && isfinite(rows[i].cw_best))
            count(&rows[i], v);
    bool gain = v->claimed > NO_CHANGE;
    v->formulations = gain && v->models > 0 && v->deny == 0 && 2 * v->confirm > v->models;
    v->only_objective = gain && v->models > 0 && v->confirm == 0;
    v->resolution = v->resolution && gain;
    v->filter = v->filter && gain;
    v->sterns = v->sterns && gain;
    v->speeds = v->speeds && gain;
    state(v);
}
