#include "core/constraints.h"
#include "core/conventional.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In ratios to the parent: designs that have no value are worse than any that has one, by how far
 * outside they are; an excess of an outcome weighs as in gauss_newton.c. */
static const double NO_VALUE = 2, PENALTY = 3;
/* Designs outside of the known limits cost nothing: a method that asks for nothing else ends. */
enum { CALLS_EACH = 1000 };

static bool keep(struct ledger *l, const struct evaluation *e)
{
    const struct search *s = l->search;
    size_t width = 1 + l->outcomes;
    double *u = realloc(l->u, (l->count + 1) * l->n * sizeof *u);
    l->u = u ? u : l->u;
    double *value = realloc(l->value, (l->count + 1) * width * sizeof *value);
    l->value = value ? value : l->value;
    if (!u || !value)
        return core_no_memory();
    memcpy(u + l->count * l->n, e->u, l->n * sizeof *u);
    value += l->count++ * width;
    value[0] = e->failed ? NAN : e->objective / s->parent.objective;
    outcome_ratios(s->problem->config, e, &s->parent, value + 1);
    for (size_t i = 0; i < l->outcomes; i++)
        value[1 + i] = fmax(l->lower[i] - value[1 + i], value[1 + i] - l->upper[i]);
    return true;
}

bool ledger_open(struct search *search, const struct method_row *method, struct ledger *l)
{
    const struct config *config = search->problem->config;
    struct evaluation *list;
    size_t n;
    *l = (struct ledger){.search = search,
                         .method = method,
                         .n = galv_model_modes(search->problem->model),
                         .most = 1 + config->initial + config->iterations,
                         .limits = limits_count(config),
                         .ok = true};
    l->lower = malloc(2 * OUTCOME_MOST * sizeof *l->lower);
    l->room = malloc((l->limits + OUTCOME_MOST) * sizeof *l->room);
    if (!l->lower || !l->room)
        return core_no_memory();
    l->upper = l->lower + OUTCOME_MOST;
    l->outcomes = outcome_bounds(config, l->lower, l->upper);
    if (!record_evaluations(search->record, &list, &n))
        return false;
    bool ok = true;
    for (size_t i = 0; i < n && ok; i++)
        ok = keep(l, &list[i]);
    free(list);
    return ok;
}

void ledger_close(struct ledger *l)
{
    free(l->lower);
    free(l->u);
    free(l->value);
    free(l->room);
}

static const double *find(const struct ledger *l, const double *u)
{
    for (size_t i = l->count; i-- > 0;)
        if (memcmp(l->u + i * l->n, u, l->n * sizeof *u) == 0)
            return l->value + i * (1 + l->outcomes);
    return NULL;
}

static bool evaluate_new(struct ledger *l, const double *u)
{
    struct evaluation e;
    if (l->count >= l->most) {
        l->spent = true;
        return false;
    }
    search_show(l->search, l->method->name);
    evaluation_start(0, "external", u, &e);
    l->ok = search_step(l->search, &e, NULL, NULL) && keep(l, &e);
    return l->ok;
}

bool ledger_look(struct ledger *l, const double *u, struct seen *seen)
{
    *seen = (struct seen){.limit = l->room, .outcome = l->room + l->limits};
    bool known = limits_evaluate(l->search->problem, l->n, u, seen->limit) == 0;
    double most = -INFINITY;
    for (size_t i = 0; i < l->limits; i++) {
        seen->limit[i] = known ? seen->limit[i] : 1;
        most = fmax(most, seen->limit[i]);
    }
    for (size_t i = 0; i < l->outcomes; i++)
        seen->outcome[i] = 1;
    seen->objective = NO_VALUE;
    if (++l->calls > CALLS_EACH * l->most)
        return false;
    if (most > l->method->outside + OUTSIDE)
        return true;
    const double *value = find(l, u);
    if (!value && !evaluate_new(l, u))
        return false;
    value = value ? value : find(l, u);
    seen->valued = value && !isnan(value[0]);
    if (!seen->valued)
        return true;
    seen->objective = value[0];
    memcpy(seen->outcome, value + 1, l->outcomes * sizeof *value);
    return true;
}

bool ledger_penalised(struct ledger *l, const double *u, double *value)
{
    struct seen seen;
    bool ok = ledger_look(l, u, &seen);
    *value = seen.objective;
    for (size_t i = 0; i < l->limits && !seen.valued; i++)
        *value += fmax(seen.limit[i], 0);
    for (size_t i = 0; i < l->outcomes && seen.valued; i++)
        *value += PENALTY * fmax(seen.outcome[i], 0);
    return ok;
}

bool ledger_stop(struct ledger *l, const char *reason)
{
    return l->ok && record_put_text(l->search->record, "stop",
                                    l->spent                          ? "budget spent"
                                    : l->calls > CALLS_EACH * l->most ? "no design inside the "
                                                                        "limits any more"
                                                                      : reason);
}
