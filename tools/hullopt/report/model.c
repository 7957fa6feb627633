#include "report/model.h"

#include "core/objective.h"

#include <stdlib.h>

enum { SAMPLES = 1024, LEAST_DESIGNS = 5 };

/* Values that are told beside the first objective: constraints, then the other objectives. */
static size_t outcome_of(const bayesopt *bo, size_t objectives, size_t k)
{
    return k ? bayesopt_constraint_count(bo, NULL, NULL) - (objectives - 1) + k : 0;
}

static bayesopt_status fill(bayesopt *bo, double parent, struct search_model *m)
{
    bayesopt_status status = bayesopt_leave_one_out(bo, &m->n, m->told, m->mean, m->sd);
    for (size_t i = 0; i < m->n && !status; i++) {
        m->told[i] /= parent;
        m->mean[i] /= parent;
        m->sd[i] /= parent;
    }
    for (size_t k = 0; k < m->objectives && !status; k++)
        status = bayesopt_sensitivity(bo, outcome_of(bo, m->objectives, k), SAMPLES,
                                      m->first + k * m->d, m->total + k * m->d);
    return status;
}

bool model_read(const struct record *record, const struct config *config, double parent,
                struct search_model *m)
{
    bayesopt *bo = record->bo;
    const enum method_kind kind = method_row(config->method)->kind;
    size_t d = bayesopt_dimension(bo, NULL, NULL), all = bayesopt_count(bo);
    *m = (struct search_model){.d = d, .objectives = objectives_count(config)};
    if ((kind != METHOD_GAUSSIAN_PROCESS && kind != METHOD_DESIGN) || all < LEAST_DESIGNS)
        return true;
    m->scale = malloc((d + 2 * m->objectives * d + 3 * all) * sizeof *m->scale);
    if (!m->scale)
        return core_no_memory();
    m->first = m->scale + d;
    m->total = m->first + m->objectives * d;
    m->told = m->total + m->objectives * d;
    m->mean = m->told + all;
    m->sd = m->mean + all;
    bayesopt_status status = bayesopt_model(bo, &m->info, m->scale);
    if (!status && m->info.n >= LEAST_DESIGNS)
        status = fill(bo, parent, m);
    m->known = !status && m->info.n >= LEAST_DESIGNS;
    return status != BAYESOPT_ERROR_MEMORY || core_fail("%s", bayesopt_last_error());
}

void model_free(struct search_model *m)
{
    free(m->scale);
    *m = (struct search_model){0};
}
