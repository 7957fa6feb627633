#include "core/constraints.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>

/* Half breadths of the grid of a latent point, which two of the limits need. */
struct known {
    const struct problem *problem;
    const double *u;
    double least, share;
};

/* What is bounded is the ratio of a figure to that of the parent. */
enum bound { CHANGE, LEAST, MOST }; /* |ratio - 1| <= limit, ratio >= limit, ratio <= limit */

struct constraint {
    const char *name, *label, *unit;
    double scale; /* of the figure in that unit */
    int decimals;
    size_t limit; /* offset in the configuration; NAN stands there for none */
    enum bound bound;
    double margin; /* what is known is that far off: the search stays inside, */
    double slack;  /* or what is built may exceed the limit by this factor */
    bool (*known)(const struct known *known, double *ratio); /* NULL: only the solve tells */
    bool decides;                                            /* a built design outside has failed */
    bool speeds; /* at each of verification.froude, when it is asked for */
    double (*figure)(const struct evaluation *e, size_t speed);
};

static bool known_breadth(const struct known *known, double *ratio)
{
    *ratio = known->share;
    return true;
}

static bool known_entrance(const struct known *known, double *ratio)
{
    return galv_limits_entrance(known->problem->limits, known->u, ratio) == GALV_OK;
}

static bool known_volume(const struct known *known, double *ratio)
{
    return galv_limits_volume(known->problem->limits, known->u, ratio) == GALV_OK;
}

#define FIGURE(name, expression)                                                                   \
    static double name(const struct evaluation *e, size_t speed)                                   \
    {                                                                                              \
        (void)speed;                                                                               \
        return expression;                                                                         \
    }
FIGURE(volume, e->volume)
FIGURE(breadth, e->breadth)
FIGURE(entrance, e->nu_s)
FIGURE(pressure, e->cw_pressure)
FIGURE(at_speed, speed < e->speeds ? e->cw_speed[speed] : NAN)

#define AT(member) .limit = offsetof(struct config, member)
static const struct constraint TABLE[] = {
    {"breadth", "least share of a half breadth kept", "", 1, 3, AT(breadth), .bound = LEAST,
     .known = known_breadth, .figure = breadth},
    /* The built hull is a spline through the moved points and nu_s is taken between them. */
    {"entrance", "steepest waterline, |ν<sub>x</sub>|", "", 1, 3, AT(entrance), .bound = MOST,
     .slack = 1.05, .known = known_entrance, .figure = entrance},
    /* Volumes of hulls are linear in u to a few 1e-5. */
    {"displacement", "displacement", "m³", 1, 5, AT(displacement), .bound = CHANGE, .margin = 1e-4,
     .known = known_volume, .decides = true, .figure = volume},
    {"pressure", "C_w by pressure", "10⁻³", 1e3, 4, AT(pressure), .bound = MOST,
     .figure = pressure},
    {"speeds", "C_w at other speeds, the one that rises most", "10⁻³", 1e3, 4, AT(speeds),
     .bound = MOST, .speeds = true, .figure = at_speed},
};
enum { ROWS = sizeof TABLE / sizeof *TABLE };

/* Grids are allowed to touch the centre plane. */
static const double TOUCH = 1e-9;

static double limit_of(const struct constraint *c, const struct config *config)
{
    return *(const double *)(const void *)((const char *)config + c->limit);
}

/* Of the ratio of a built design: <= 0 where it is allowed. */
static double excess_of(const struct constraint *c, double limit, double ratio)
{
    return c->bound == CHANGE  ? fabs(ratio - 1) - limit
           : c->bound == LEAST ? limit - ratio
                               : ratio - (c->slack > 0 ? c->slack : 1) * limit;
}

/* The values of a ratio, <= 0 where allowed; returns how many there are. */
static size_t write_values(const struct constraint *c, double limit, double ratio, double value[2])
{
    double band = fmax(limit - c->margin, 0);
    value[0] = c->bound == CHANGE  ? ratio - 1 - band
               : c->bound == LEAST ? limit - ratio
                                   : ratio - limit;
    value[1] = 1 - ratio - band;
    return c->bound == CHANGE ? 2 : 1;
}

size_t limits_count(const struct config *config)
{
    double value[2];
    size_t n = 1; /* the centre plane */
    for (size_t k = 0; k < ROWS; k++)
        if (TABLE[k].known && !isnan(limit_of(&TABLE[k], config)))
            n += write_values(&TABLE[k], 0, 1, value);
    return n;
}

int limits_evaluate(void *user_data, size_t d, const double *u, double *value)
{
    const struct problem *problem = user_data;
    struct known known = {.problem = problem, .u = u};
    (void)d;
    if (galv_limits_breadth(problem->limits, u, &known.least, &known.share) != GALV_OK)
        return 1;
    *value++ = -known.least / problem_length(problem) - TOUCH;
    for (size_t k = 0; k < ROWS; k++) {
        double limit = limit_of(&TABLE[k], problem->config), ratio, values[2];
        if (!TABLE[k].known || isnan(limit))
            continue;
        if (!TABLE[k].known(&known, &ratio) || isnan(ratio))
            return 1;
        size_t n = write_values(&TABLE[k], limit, ratio, values);
        for (size_t i = 0; i < n; i++)
            *value++ = values[i];
    }
    return 0;
}

/* The limit as it is read: changes in per cent, shares as they are. */
static void print_limit(const struct constraint *c, double limit, char text[32])
{
    if (isnan(limit))
        snprintf(text, 32, "none");
    else if (c->bound == LEAST)
        snprintf(text, 32, "≥ %g", limit);
    else
        snprintf(text, 32, c->bound == CHANGE ? "±%g %%" : "≤ %+g %%",
                 100 * (c->bound == CHANGE ? limit : limit - 1));
}

bool limits_kept(const struct config *config, const struct evaluation *e,
                 const struct evaluation *parent)
{
    for (size_t k = 0; k < ROWS; k++) {
        const struct constraint *c = &TABLE[k];
        double limit = limit_of(c, config), ratio = c->figure(e, 0) / c->figure(parent, 0);
        char text[32];
        if (!c->decides || isnan(limit) || excess_of(c, limit, ratio) <= 0)
            continue;
        print_limit(c, limit, text);
        return core_fail("%s: %s differs by %+.2f %% from the parent's, allowed %s", c->name,
                         c->name, 100 * (ratio - 1), text);
    }
    return true;
}

static size_t count_ratios(const struct constraint *c, const struct config *config)
{
    return c->speeds ? config->verify_froudes * (1 + config->models) : 1;
}

size_t outcome_bounds(const struct config *config, double lower[OUTCOME_MOST],
                      double upper[OUTCOME_MOST])
{
    size_t n = 0;
    for (size_t k = 0; k < ROWS; k++) {
        const struct constraint *c = &TABLE[k];
        double limit = limit_of(c, config);
        size_t count = c->known || isnan(limit) ? 0 : count_ratios(c, config);
        for (size_t i = 0; i < count; i++, n++) {
            lower[n] = c->bound == MOST ? -INFINITY : c->bound == LEAST ? limit : 1 - limit;
            upper[n] = c->bound == MOST ? limit : c->bound == LEAST ? INFINITY : 1 + limit;
        }
    }
    return n;
}

void outcome_ratios(const struct config *config, const struct evaluation *e,
                    const struct evaluation *parent, double ratio[OUTCOME_MOST])
{
    for (size_t k = 0; k < ROWS; k++) {
        const struct constraint *c = &TABLE[k];
        size_t count = count_ratios(c, config);
        for (size_t i = 0; !c->known && !isnan(limit_of(c, config)) && i < count; i++)
            *ratio++ = c->figure(e, i) / c->figure(parent, i);
    }
}

bool outcome_allowed(const struct config *config, const struct evaluation *e,
                     const struct evaluation *parent)
{
    double lower[OUTCOME_MOST], upper[OUTCOME_MOST], ratio[OUTCOME_MOST];
    if (e->failed || e->id == parent->id)
        return !e->failed;
    size_t n = outcome_bounds(config, lower, upper);
    outcome_ratios(config, e, parent, ratio);
    for (size_t i = 0; i < n; i++)
        if (!(ratio[i] >= lower[i] && ratio[i] <= upper[i]))
            return false;
    return true;
}

double outcome_objective(const struct evaluation *e, const struct evaluation *parent)
{
    double worst = e->cw / parent->cw;
    for (size_t i = 0; i < e->models; i++)
        worst = fmax(worst, e->cw_model[i] / parent->cw_model[i]);
    return worst * parent->cw;
}

const struct evaluation *outcome_best(const struct config *config, size_t n,
                                      const struct evaluation *list)
{
    const struct evaluation *best = NULL;
    for (size_t i = 0; i < n; i++)
        if (outcome_allowed(config, &list[i], list) &&
            (!best || list[i].objective < best->objective))
            best = &list[i];
    return best;
}

size_t constraints_count(void)
{
    return ROWS;
}

void constraints_figures(const struct config *config, size_t k, const struct evaluation *parent,
                         const struct evaluation *e, struct constraint_figures *f)
{
    const struct constraint *c = &TABLE[k];
    size_t most = 0;
    for (size_t i = 1; c->speeds && i < e->speeds; i++)
        if (c->figure(e, i) / c->figure(parent, i) > c->figure(e, most) / c->figure(parent, most))
            most = i;
    *f = (struct constraint_figures){.name = c->name,
                                     .label = c->label,
                                     .unit = c->unit,
                                     .decimals = c->decimals,
                                     .scale = c->scale,
                                     .allowed = limit_of(c, config),
                                     .before = c->figure(parent, most),
                                     .after = c->figure(e, most)};
    f->ratio = f->after / f->before;
    f->excess = excess_of(c, f->allowed, f->ratio);
    f->kept = isnan(f->allowed) || f->excess <= 0;
    print_limit(c, f->allowed, f->limit);
}
