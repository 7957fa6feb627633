#include "core/descent.h"

#include "core/residuals.h"

#include <stdlib.h>
#include <string.h>

static bool is_parent(const struct descent *d, const double *u)
{
    for (size_t k = 0; k < d->problem.d; k++)
        if (u[k] != 0)
            return false;
    return true;
}

/* Whether the design is on record already: 1, 0, or -1 after a failure. */
static int is_recorded(const struct descent *d, const double *u)
{
    struct evaluation *list;
    size_t n;
    int found = 0;
    if (!record_evaluations(d->search->record, &list, &n))
        return -1;
    for (size_t i = 0; i < n && !found; i++)
        found = memcmp(list[i].u, u, d->problem.d * sizeof *u) == 0;
    free(list);
    return found;
}

static bayesopt_descent_answer fine(void *user_data, const double *u,
                                    bayesopt_descent_sample *sample)
{
    struct descent *d = user_data;
    struct search *search = d->search;
    struct evaluation e;
    bool parent = is_parent(d, u);
    if (!parent && d->valued == search->problem->config->iterations)
        return BAYESOPT_DESCENT_STOP;
    d->sample = sample;
    d->at = u;
    evaluation_start(0, "descent", u, &e);
    int recorded = parent ? 1 : is_recorded(d, u);
    if (parent)
        evaluate_parent(search->problem, &e, descent_look, d);
    else if (recorded == 1)
        evaluate(search->problem, &e, descent_look, d);
    if (recorded < 0 || (recorded == 0 && !search_step(search, &e, descent_look, d))) {
        d->ok = false;
        return BAYESOPT_DESCENT_STOP;
    }
    if (e.no_memory) { /* of a design on record: others are never told */
        d->ok = core_fail("%s", e.reason);
        return BAYESOPT_DESCENT_STOP;
    }
    d->valued += !parent;
    if (e.failed)
        return BAYESOPT_DESCENT_FAILED;
    descent_keep(d, &e, sample);
    return BAYESOPT_DESCENT_VALUED;
}

bool descent_run(struct search *search, double *u)
{
    char *stop;
    if (!record_get_text(search->record, "stop", &stop))
        return false;
    bool stopped = stop != NULL;
    free(stop);
    if (stopped)
        return true;
    struct descent d;
    bool ok = descent_start(search->problem, search, &d);
    d.problem.fine = fine;
    memset(u, 0, d.problem.d * sizeof *u);
    if (ok && bayesopt_descend(&d.problem, u, NULL) < 0)
        ok = d.ok && core_fail("%s: %s", search->problem->config->path, bayesopt_last_error());
    bool spent = d.valued == search->problem->config->iterations;
    descent_end(&d);
    return ok && d.ok &&
           record_put_text(search->record, "stop", spent ? "budget spent" : "no step gains more");
}
