#include "report/agreement.h"

#include "cli.h"

#include <math.h>
#include <stdlib.h>

static double cw_of(const struct evaluation *e, size_t speed, size_t model)
{
    if (speed > 0)
        return e->cw_speed[(speed - 1) * (1 + e->models) + model];
    return model > 0 ? e->cw_model[model - 1] : e->cw;
}

/* Equal values share the mean of their ranks. */
static double rank_of(size_t n, const double *value, size_t i)
{
    size_t below = 0, equal = 0;
    for (size_t k = 0; k < n; k++) {
        below += value[k] < value[i];
        equal += value[k] == value[i];
    }
    return (double)below + (double)(equal - 1) / 2;
}

/* Spearman 1904: the correlation of the ranks. */
static double rank_correlation(size_t n, const double *a, const double *b)
{
    double mean = ((double)n - 1) / 2, ab = 0, aa = 0, bb = 0;
    for (size_t i = 0; i < n; i++) {
        double u = rank_of(n, a, i) - mean, v = rank_of(n, b, i) - mean;
        ab += u * v;
        aa += u * u;
        bb += v * v;
    }
    return n > 2 && aa > 0 && bb > 0 ? ab / sqrt(aa * bb) : NAN;
}

static void keep_ratios(const struct results *r, size_t speed, struct agreement *a)
{
    for (size_t i = 0; i < r->n; i++) {
        const struct evaluation *e = &r->evaluations[i];
        if (e == r->baseline || e->failed)
            continue;
        for (size_t k = 0; k < a->models; k++)
            a->ratio[k][a->n] = cw_of(e, speed, k) / cw_of(r->baseline, speed, k);
        a->n++;
    }
}

bool agreement_of(const struct results *r, size_t speed, struct agreement *a)
{
    const struct config *config = r->problem->config;
    *a = (struct agreement){.models = 1 + config->models};
    if (config->models == 0 || speed * a->models > r->baseline->speeds)
        return false;
    a->froude = speed > 0 ? config->verify_froude[speed - 1] : config->solver.froude;
    double *ratios = cli_needed(malloc(a->models * r->n * sizeof *ratios));
    for (size_t k = 0; k < a->models; k++) {
        a->name[k] =
            igabem_formulation_name(k > 0 ? config->model[k - 1] : r->problem->solver.formulation);
        a->ratio[k] = ratios + k * r->n;
    }
    keep_ratios(r, speed, a);
    for (size_t k = 0; k < a->models; k++)
        for (size_t l = 0; l < a->models; l++)
            a->rank[k][l] = rank_correlation(a->n, a->ratio[k], a->ratio[l]);
    return true;
}

void agreement_free(struct agreement *a)
{
    free(a->ratio[0]);
}
