#include "core/objective.h"

#include "core/particulars.h"

#include <math.h>
#include <stdio.h>

/* 1 for C_w itself, else 1/2 rho U^2 S, N. */
static double force(const struct config *config, int quantity, double length, double froude,
                    const struct evaluation *e)
{
    double u2 = froude * froude * config->solver.gravity * length;
    return quantity == QUANTITY_CW ? 1 : config->solver.density * u2 * e->wetted_area / 2;
}

/* (1 + k) C_f at that speed, where the objective counts it. */
static double friction(const struct config *config, int quantity, double length, double froude)
{
    double speed = froude * sqrt(config->solver.gravity * length);
    return quantity == QUANTITY_TOTAL
               ? (1 + config->form_factor) *
                     igabem_friction_ittc57(speed * length / config->viscosity)
               : 0;
}

double objective_friction(const struct config *config, double length)
{
    return friction(config, config->quantity, length, config->solver.froude);
}

/* A weight times a quantity at speed j by model m; both 0: flow.froude, solver.formulation. */
static double at_speed(const struct config *config, double weight, int quantity, double length,
                       const struct evaluation *e, size_t m, size_t j)
{
    double froude = j ? config->verify_froude[j - 1] : config->solver.froude;
    double cw = j ? e->cw_speed[(j - 1) * (1 + e->models) + m] : m ? e->cw_model[m - 1] : e->cw;
    double surface = config->running_surface && j < e->surfaces ? e->surface[j] : 1;
    return weight * force(config, quantity, length, froude, e) *
           (cw + surface * friction(config, quantity, length, froude));
}

/* The first objective's quantity by model m. */
static double quantity(const struct config *config, double length, const struct evaluation *e,
                       size_t m)
{
    double sum = 0;
    for (size_t j = 0; j == 0 || j < config->weights; j++) {
        double weight = config->weights ? config->weight[j] : 1;
        if (weight > 0)
            sum += at_speed(config, weight, config->quantity, length, e, m, j);
    }
    return sum;
}

static double greater(double worst, double ratio)
{
    return ratio > worst || isnan(ratio) ? ratio : worst;
}

double objective_total_resistance(const struct config *config, double length,
                                  const struct evaluation *e)
{
    return at_speed(config, 1, QUANTITY_TOTAL, length, e, 0, 0);
}

double objective_of(const struct config *config, double length, const struct evaluation *e,
                    const struct evaluation *parent)
{
    if (config->judge.command)
        return e->value / parent->value * parent->cw;
    size_t models = isnan(config->confirm) ? e->models : 0;
    double worst = 0;
    for (size_t m = 0; m <= models; m++)
        worst =
            greater(worst, quantity(config, length, e, m) / quantity(config, length, parent, m));
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

size_t objectives_count(const struct config *config)
{
    size_t n = 1;
    while (n < OBJECTIVES_MOST && config->other[n - 1].quantity != QUANTITY_NONE)
        n++;
    return n;
}

/* Its place among the speeds: 0, flow.froude, then those of the verification. */
static size_t speed_of(const struct config *config, double froude)
{
    size_t j = 0;
    if (!isnan(froude) && froude != config->solver.froude)
        while (j < config->verify_froudes && config->verify_froude[j++] != froude)
            continue;
    return j;
}

bool objectives_ask_speeds(const struct config *config)
{
    for (size_t k = 1; k < objectives_count(config); k++)
        if (speed_of(config, config->other[k - 1].froude))
            return true;
    return false;
}

static void describe_resistance(int quantity, double froude, const char *before,
                                struct objective *o)
{
    static const char *const names[] = {"C_w", "wave resistance, N,", "total resistance, N,"};
    snprintf(o->name, sizeof o->name, "%s%s at Fr %g", before, names[quantity], froude);
}

void objectives_describe(const struct config *config, size_t k, struct objective *o)
{
    const struct config_objective *other = k ? &config->other[k - 1] : NULL;
    int quantity = other ? other->quantity : config->quantity;
    double froude = other && !isnan(other->froude) ? other->froude : config->solver.froude;
    *o = (struct objective){.scale = 1, .maximise = other && other->maximise};
    if (!(k == 0 && config->judge.command) &&
        (quantity == QUANTITY_CW || quantity == QUANTITY_PRESSURE))
        o->scale = 1e3;
    if (!other && config->judge.command)
        snprintf(o->name, sizeof o->name, "%s",
                 config->judge.key ? config->judge.key : "number of the command");
    else if (quantity <= QUANTITY_TOTAL)
        describe_resistance(quantity, froude, !other && config->weights ? "weighted " : "", o);
    else if (quantity == QUANTITY_PRESSURE)
        snprintf(o->name, sizeof o->name, "C_w by pressure");
    else if (quantity == QUANTITY_DISPLACEMENT)
        snprintf(o->name, sizeof o->name, "displacement, m³");
    else if (quantity == QUANTITY_COMMAND)
        snprintf(o->name, sizeof o->name, "%s", other->key);
    else {
        const struct particular_row *row =
            particular_row((enum particular)(quantity - QUANTITY_PARTICULAR));
        snprintf(o->name, sizeof o->name, "%s%s%s", row->label, *row->unit ? ", " : "", row->unit);
    }
    snprintf(o->label, sizeof o->label, "%s%s", o->scale == 1 ? "" : "10³ ", o->name);
}

/* By the model that sees most of it, over what each sees of the parent. */
static double worst_at(const struct config *config, const struct config_objective *o, double length,
                       const struct evaluation *e, const struct evaluation *parent)
{
    size_t models = isnan(config->confirm) ? e->models : 0, j = speed_of(config, o->froude);
    double worst = 0;
    for (size_t m = 0; m <= models; m++)
        worst = greater(worst, at_speed(config, 1, o->quantity, length, e, m, j) /
                                   at_speed(config, 1, o->quantity, length, parent, m, j));
    return worst * at_speed(config, 1, o->quantity, length, parent, 0, j);
}

double objectives_value(const struct config *config, size_t k, double length,
                        const struct evaluation *e, const struct evaluation *parent)
{
    if (e->failed)
        return NAN;
    if (k == 0 && config->judge.command)
        return e->value;
    if (k == 0)
        return objective_of(config, length, e, parent) / parent->cw *
               quantity(config, length, parent, 0);
    const struct config_objective *o = &config->other[k - 1];
    switch (o->quantity) {
    case QUANTITY_CW:
    case QUANTITY_WAVE:
    case QUANTITY_TOTAL:
        return worst_at(config, o, length, e, parent);
    case QUANTITY_PRESSURE:
        return e->cw_pressure;
    case QUANTITY_DISPLACEMENT:
        return e->volume;
    case QUANTITY_COMMAND:
        return e->told[k - 1];
    case QUANTITY_PARTICULAR: /* of the built hull, not of its grid */
        return e->wetted_area;
    default:
        return e->particular[o->quantity - QUANTITY_PARTICULAR][0];
    }
}
