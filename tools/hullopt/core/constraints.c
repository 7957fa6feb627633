#include "core/constraints.h"

#include "core/particulars.h"
#include "core/snapshots.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

/* What is known of a latent point by its grid: half breadths, which two of the limits need, and the
 * particulars where one is bounded. */
struct known {
    const struct problem *problem;
    const double *u;
    double least, share;
    double particular[PARTICULARS][2];
};

/* What is bounded is the ratio of a figure to that of the parent, or a particular's change:
 * |ratio - 1| <= limit, ratio >= limit, ratio <= limit, least <= ratio <= most, or 1 - ratio at
 * least that share of what the solver's own formulation gains. */
enum bound { CHANGE, LEAST, MOST, RANGE, SHARE };

struct constraint {
    const char *name, *label, *unit;
    double scale; /* of the figure in that unit */
    int decimals;
    size_t limit; /* offset in the configuration; NAN stands there for none */
    enum bound bound;
    double margin; /* what is known is that far off: the search stays inside, */
    double slack;  /* or what is built may exceed the limit by this factor */
    /* The least and the greatest of its ratios; NULL: only the solve tells. */
    bool (*known)(const struct known *known, const struct constraint *c, double ratio[2]);
    bool decides; /* a built design outside has failed */
    bool speeds;  /* at each of verification.froude, when it is asked for */
    double (*figure)(const struct evaluation *e, size_t speed);
    enum particular particular; /* of a RANGE */
};

static bool both(double ratio[2])
{
    ratio[1] = ratio[0];
    return true;
}

static bool known_breadth(const struct known *known, const struct constraint *c, double ratio[2])
{
    (void)c;
    ratio[0] = known->share;
    return both(ratio);
}

static bool known_entrance(const struct known *known, const struct constraint *c, double ratio[2])
{
    (void)c;
    return galv_limits_entrance(known->problem->limits, known->u, ratio) == GALV_OK && both(ratio);
}

static bool known_volume(const struct known *known, const struct constraint *c, double ratio[2])
{
    (void)c;
    return galv_limits_volume(known->problem->limits, known->u, ratio) == GALV_OK && both(ratio);
}

static double relate(const struct constraint *c, double after, double before);

static bool known_particular(const struct known *known, const struct constraint *c, double ratio[2])
{
    for (int end = 0; end < 2; end++)
        ratio[end] = relate(c, known->particular[c->particular][end],
                            known->problem->particular[c->particular][end]);
    return true;
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
FIGURE(by_model, speed < e->models ? e->cw_model[speed] : NAN)
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
    {"confirm", "C_w by the model that confirms least", "10⁻³", 1e3, 4, AT(confirm), .bound = SHARE,
     .figure = by_model},
};
enum { OWN = sizeof TABLE / sizeof *TABLE, ROWS = OWN + PARTICULARS };

/* What a step that ends on a limit may be outside. */
static const double ROUNDING = 2e-5;
/* Of the cosine by which a cell of the grid has turned: at 0 it stands on its edge. */
static const double LEAST_TURN = 0.05;
/* Grids are allowed to touch the centre plane. */
static const double TOUCH = 1e-9;

/* The rows of the table, then one for each particular. */
static struct constraint row(size_t k)
{
    if (k < OWN)
        return TABLE[k];
    enum particular p = (enum particular)(k - OWN);
    const struct particular_row *named = particular_row(p);
    return (struct constraint){
        named->key,      named->label,
        named->unit,     1,
        named->decimals, offsetof(struct config, particular) + 2 * (size_t)p * sizeof(double),
        .bound = RANGE,  .known = known_particular,
        .particular = p};
}

/* The first of the two of a range, which are given together. */
static double limit_of(const struct constraint *c, const struct config *config)
{
    return *(const double *)(const void *)((const char *)config + c->limit);
}

/* Between what a ratio may be; margin: how far inside. */
static void bounds_of(const struct constraint *c, const struct config *config, double margin,
                      double bound[2])
{
    const double *limit = (const double *)(const void *)((const char *)config + c->limit);
    double band = fmax(*limit - margin, 0);
    bound[0] = c->bound == CHANGE  ? 1 - band
               : c->bound == LEAST ? *limit
               : c->bound == RANGE ? limit[0]
                                   : -INFINITY;
    bound[1] = c->bound == CHANGE  ? 1 + band
               : c->bound == MOST  ? *limit
               : c->bound == RANGE ? limit[1]
               : c->bound == SHARE ? 1 - *limit
                                   : INFINITY;
}

/* Of the ratio of a built design: <= 0 where it is allowed. */
static double excess_of(const struct constraint *c, const struct config *config, double ratio)
{
    double bound[2];
    bounds_of(c, config, 0, bound);
    return isnan(limit_of(c, config))
               ? NAN
               : fmax(bound[0] - ratio, ratio - (c->slack > 0 ? c->slack : 1) * bound[1]);
}

/* A ratio, or a change. */
static double relate(const struct constraint *c, double after, double before)
{
    if (c->bound != RANGE || c->particular < PARTICULAR_STATIONS)
        return c->bound == RANGE && particular_row(c->particular)->shift ? after - before
                                                                         : after / before;
    return after; /* of several places: ratios already */
}

/* The values of a ratio known between ratio[0] and ratio[1], <= 0 where allowed; returns how many
 * there are. */
static size_t write_values(const struct constraint *c, const struct config *config,
                           const double ratio[2], double value[2])
{
    double bound[2];
    size_t n = 0;
    bounds_of(c, config, c->margin, bound);
    if (isfinite(bound[1]))
        value[n++] = ratio[1] - bound[1];
    if (isfinite(bound[0]))
        value[n++] = bound[0] - ratio[0];
    return n;
}

static bool asks_particulars(const struct config *config)
{
    for (size_t k = 0; k < PARTICULARS; k++)
        if (!isnan(config->particular[k][0]))
            return true;
    return false;
}

size_t limits_count(const struct config *config)
{
    double value[2];
    if (config_by_command(config))
        return 0;
    /* The centre plane, and the bounds of a command's parameters. */
    size_t n = 1 + (config->snapshots ? 2 * config->n_parameters : 0);
    for (size_t k = 0; k < ROWS; k++) {
        const struct constraint c = row(k);
        if (c.known && !isnan(limit_of(&c, config)))
            n += write_values(&c, config, (const double[2]){1, 1}, value);
    }
    return n;
}

static bool know_particulars(struct known *known)
{
    const galv_model *model = known->problem->model;
    double *points = malloc(3 * galv_model_points(model) * sizeof *points);
    bool ok = points && galv_displace(model, known->u, points) == GALV_OK &&
              particulars_of(known->problem, points, false, known->particular);
    free(points);
    return ok;
}

/* How far the original itself reaches across the centre plane: a profile that swings about it. */
static double parent_least(const struct problem *problem)
{
    const double *points = nurbs_grid_points(problem->grid);
    size_t n = nurbs_grid_rows(problem->grid) * nurbs_grid_columns(problem->grid);
    double least = 0;
    for (size_t k = 0; k < n; k++)
        least = fmin(least, points[3 * k + 1]);
    return least;
}

int limits_evaluate(void *user_data, size_t d, const double *u, double *value)
{
    const struct problem *problem = user_data;
    struct known known = {.problem = problem, .u = u};
    double turn;
    (void)d;
    if (config_by_command(problem->config))
        return 0;
    if (galv_limits_breadth(problem->limits, u, &known.least, &known.share) != GALV_OK ||
        galv_limits_turn(problem->limits, u, &turn) != GALV_OK)
        return 1;
    if (asks_particulars(problem->config) && !know_particulars(&known))
        return 1;
    value += snapshots_excess(problem, u, value);
    double across = (parent_least(problem) - known.least) / problem_length(problem) - TOUCH;
    *value++ = fmax(across, LEAST_TURN - turn);
    for (size_t k = 0; k < ROWS; k++) {
        const struct constraint c = row(k);
        double ratio[2];
        if (!c.known || isnan(limit_of(&c, problem->config)))
            continue;
        if (!c.known(&known, &c, ratio) || isnan(ratio[0]) || isnan(ratio[1]))
            return 1;
        value += write_values(&c, problem->config, ratio, value);
    }
    return 0;
}

double limits_excess(struct problem *problem, const double *u)
{
    double value[2 * ROWS + 1 + 2 * CONFIG_PARAMETERS_MOST], most = -INFINITY;
    size_t n = limits_count(problem->config);
    if (limits_evaluate(problem, galv_model_modes(problem->model), u, value) != 0)
        return INFINITY;
    if (n == 0)
        return 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, value[i]);
    return most;
}

/* The limit as it is read: changes in per cent, shares as they are. */
static void print_limit(const struct constraint *c, const struct config *config, char text[32])
{
    double limit = limit_of(c, config), bound[2];
    bounds_of(c, config, 0, bound);
    if (isnan(limit))
        snprintf(text, 32, "none");
    else if (c->bound == RANGE)
        snprintf(text, 32, "%g to %g", bound[0], bound[1]);
    else if (c->bound == SHARE)
        snprintf(text, 32, "≥ %g of the gain", limit);
    else if (c->bound == LEAST)
        snprintf(text, 32, "≥ %g", limit);
    else
        snprintf(text, 32, c->bound == CHANGE ? "±%g %%" : "≤ %+g %%",
                 100 * (c->bound == CHANGE ? limit : limit - 1));
}

bool limits_kept(const struct config *config, const struct evaluation *e,
                 const struct evaluation *parent)
{
    for (size_t k = 0; k < OWN; k++) {
        const struct constraint *c = &TABLE[k];
        double ratio = c->figure(e, 0) / c->figure(parent, 0);
        char text[32];
        if (!c->decides || config_by_command(config) || isnan(limit_of(c, config)) ||
            excess_of(c, config, ratio) <= 0)
            continue;
        print_limit(c, config, text);
        return core_fail("%s: %s differs by %+.2f %% from the parent's, allowed %s", c->name,
                         c->name, 100 * (ratio - 1), text);
    }
    return true;
}

/* Whether it has to be built to be known, in this configuration. */
static bool is_outcome(const struct constraint *c, const struct config *config)
{
    return (!c->known || config_by_command(config)) && !isnan(limit_of(c, config));
}

static size_t count_ratios(const struct constraint *c, const struct config *config)
{
    return c->speeds           ? config->verify_froudes * (1 + config->models)
           : c->bound == SHARE ? config->models
           : c->bound == RANGE ? 2
                               : 1;
}

/* What is bounded of outcome i. */
static double outcome(const struct constraint *c, const struct config *config,
                      const struct evaluation *e, const struct evaluation *parent, size_t i)
{
    if (c->bound == RANGE)
        return relate(c, e->particular[c->particular][i], parent->particular[c->particular][i]);
    double ratio = c->figure(e, i) / c->figure(parent, i);
    return c->bound == SHARE ? ratio - config->confirm * e->cw / parent->cw : ratio;
}

size_t outcome_bounds(const struct config *config, double lower[OUTCOME_MOST],
                      double upper[OUTCOME_MOST])
{
    size_t n = 0;
    for (size_t k = 0; k < ROWS; k++) {
        const struct constraint c = row(k);
        size_t count = is_outcome(&c, config) ? count_ratios(&c, config) : 0;
        double bound[2];
        bounds_of(&c, config, 0, bound);
        for (size_t i = 0; i < count; i++, n++) {
            lower[n] = bound[0];
            upper[n] = bound[1];
        }
    }
    return n;
}

size_t outcome_ratios(const struct config *config, const struct evaluation *e,
                      const struct evaluation *parent, double ratio[OUTCOME_MOST])
{
    size_t n = 0;
    for (size_t k = 0; k < ROWS; k++) {
        const struct constraint c = row(k);
        size_t count = is_outcome(&c, config) ? count_ratios(&c, config) : 0;
        for (size_t i = 0; i < count; i++)
            ratio[n++] = outcome(&c, config, e, parent, i);
    }
    return n;
}

bool outcome_allowed(const struct config *config, const struct evaluation *e,
                     const struct evaluation *parent)
{
    double lower[OUTCOME_MOST], upper[OUTCOME_MOST], ratio[OUTCOME_MOST];
    if (e->failed || e->id == parent->id || e->outside > OUTSIDE)
        return !e->failed && e->id == parent->id;
    size_t n = outcome_bounds(config, lower, upper);
    outcome_ratios(config, e, parent, ratio);
    for (size_t i = 0; i < n; i++)
        if (!(ratio[i] >= lower[i] && ratio[i] <= upper[i]))
            return false;
    return true;
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

const char *constraints_name(size_t k)
{
    return row(k).name;
}

bool constraints_drop(struct config *config, size_t k)
{
    const struct constraint c = row(k);
    double *limit = (double *)(void *)((char *)config + c.limit);
    bool had = !isnan(*limit);
    *limit = NAN;
    return had;
}

/* Of the worse end, where a particular has several places. */
static void range_figures(const struct constraint *c, const struct config *config,
                          const struct evaluation *parent, const struct evaluation *e,
                          struct constraint_figures *f)
{
    const double *before = parent->particular[c->particular], *after = e->particular[c->particular];
    double bound[2];
    bounds_of(c, config, 0, bound);
    double low = relate(c, after[0], before[0]), high = relate(c, after[1], before[1]);
    int end = high - bound[1] > bound[0] - low;
    f->before = before[end];
    f->after = after[end];
    f->ratio = end ? high : low;
    f->excess = fmax(bound[0] - low, high - bound[1]) - ROUNDING;
    bool shift = particular_row(c->particular)->shift;
    f->change = shift ? f->ratio : f->ratio - 1;
}

void constraints_figures(const struct config *config, size_t k, const struct evaluation *parent,
                         const struct evaluation *e, struct constraint_figures *f)
{
    const struct constraint own = row(k), *c = &own;
    size_t most = 0;
    for (size_t i = 1; c->figure && i < count_ratios(c, config); i++)
        if (outcome(c, config, e, parent, i) > outcome(c, config, e, parent, most))
            most = i;
    *f = (struct constraint_figures){.name = c->name,
                                     .label = c->label,
                                     .unit = c->unit,
                                     .decimals = c->decimals,
                                     .scale = c->scale,
                                     .allowed = limit_of(c, config),
                                     .is_optional = k >= OWN || c->bound == SHARE};
    if (c->bound == RANGE) {
        range_figures(c, config, parent, e, f);
    } else {
        f->before = c->figure(parent, most);
        f->after = c->figure(e, most);
        f->ratio = f->after / f->before;
        f->change = f->ratio - 1;
        f->excess = excess_of(c, config, c->known ? f->ratio : outcome(c, config, e, parent, most));
    }
    double rounding = c->known && c->bound != RANGE ? ROUNDING : 0;
    f->kept = isnan(f->allowed) || f->excess <= rounding;
    print_limit(c, config, f->limit);
}

size_t constraints_violations(const struct config *config, size_t k, size_t n,
                              const struct evaluation *list)
{
    size_t count = 0;
    for (size_t i = 1; i < n; i++) {
        struct constraint_figures f;
        constraints_figures(config, k, list, &list[i], &f);
        count += !list[i].failed && !f.kept;
    }
    return count;
}
