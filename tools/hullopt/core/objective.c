#include "core/objective.h"

#include <math.h>
#include <stdio.h>

/* 1 for C_w itself, else 1/2 rho U^2 S, N. */
static double force(const struct config *config, double length, double froude,
                    const struct evaluation *e)
{
    double u2 = froude * froude * config->solver.gravity * length;
    return config->quantity == QUANTITY_CW ? 1 : config->solver.density * u2 * e->wetted_area / 2;
}

/* (1 + k) C_f at that speed, where the objective counts it. */
static double friction(const struct config *config, double length, double froude)
{
    double speed = froude * sqrt(config->solver.gravity * length);
    return config->quantity == QUANTITY_TOTAL
               ? (1 + config->form_factor) *
                     igabem_friction_ittc57(speed * length / config->viscosity)
               : 0;
}

double objective_friction(const struct config *config, double length)
{
    return friction(config, length, config->solver.froude);
}

/* The quantity by model m: 0, that of the solver. */
static double quantity(const struct config *config, double length, const struct evaluation *e,
                       size_t m)
{
    double sum = 0;
    for (size_t j = 0; j == 0 || j < config->weights; j++) {
        double froude = j ? config->verify_froude[j - 1] : config->solver.froude;
        double cw = j ? e->cw_speed[(j - 1) * (1 + e->models) + m] : m ? e->cw_model[m - 1] : e->cw;
        double weight = config->weights ? config->weight[j] : 1;
        if (weight > 0)
            sum +=
                weight * force(config, length, froude, e) * (cw + friction(config, length, froude));
    }
    return sum;
}

double objective_total_resistance(const struct config *config, double length,
                                  const struct evaluation *e)
{
    struct config total = *config;
    total.quantity = QUANTITY_TOTAL;
    total.weights = 0;
    return quantity(&total, length, e, 0);
}

double objective_of(const struct config *config, double length, const struct evaluation *e,
                    const struct evaluation *parent)
{
    if (config->judge.command)
        return e->value / parent->value * parent->cw;
    size_t models = isnan(config->confirm) ? e->models : 0;
    double worst = 0;
    for (size_t m = 0; m <= models; m++) {
        double ratio = quantity(config, length, e, m) / quantity(config, length, parent, m);
        worst = ratio > worst || isnan(ratio) ? ratio : worst;
    }
    return worst * parent->cw;
}

void objective_print(const struct config *config, double length, double value,
                     const struct evaluation *parent, char *text, size_t size)
{
    if (config->judge.command) {
        snprintf(text, size, "objective %.6g", value / parent->cw * parent->value);
        return;
    }
    double shown = value / parent->cw * quantity(config, length, parent, 0);
    const char *weighted = config->weights ? "weighted " : "";
    if (config->quantity == QUANTITY_CW)
        snprintf(text, size, "%sC_w %.4e", weighted, shown);
    else
        snprintf(text, size, "%s%s %.4g N", weighted,
                 config->quantity == QUANTITY_WAVE ? "R_w" : "R_t", shown);
}
