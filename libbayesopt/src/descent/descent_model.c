#include "descent/descent_model.h"

#include "core/error.h"

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

static const double LIMIT_STEP = 1e-5; /* of the differences of the known limits, half widths */

bool descent_model_init(const descent_problem *problem, descent_model *model)
{
    size_t d = problem->d, r = problem->n_residuals, state = problem->n_state;
    *model =
        (descent_model){.problem = problem, .margin = DESCENT_MARGIN, .penalty = DESCENT_PENALTY};
    model->x = calloc(d, sizeof(double));
    model->anchor = calloc(d, sizeof(double));
    model->start = malloc(problem->n_settings * sizeof(double));
    model->jacobian = malloc(problem->n_settings * d * r * sizeof(double));
    model->slope = malloc((d * state + 1) * sizeof(double));
    model->work = malloc((r + 2 * state + d) * sizeof(double));
    bool base = sample_create(problem, &model->base);
    return base && model->x && model->anchor && model->start && model->jacobian && model->slope &&
           model->work;
}

void descent_model_clear(descent_model *model)
{
    sample_free(&model->base);
    free(model->x);
    free(model->anchor);
    free(model->start);
    free(model->jacobian);
    free(model->slope);
    free(model->work);
    *model = (descent_model){0};
}

void descent_model_difference(descent_model *model, const bayesopt_descent_slopes *known, size_t k,
                              double step, const descent_sample *at, const descent_sample *moved)
{
    const descent_problem *p = model->problem;
    size_t r = p->n_residuals;
    for (size_t m = 0; m < p->n_settings; m++)
        for (size_t i = 0; i < r && !known->known[m]; i++)
            model->jacobian[(m * p->d + k) * r + i] =
                (moved->residual[m * r + i] - at->residual[m * r + i]) / step;
    for (size_t i = 0; i < p->n_state && !known->state_known; i++)
        model->slope[k * p->n_state + i] = (moved->state[i] - at->state[i]) / step;
}

/* Adds the columns of a Jacobian to a vector of `size` numbers. */
static void add_columns(size_t n, size_t size, const double *jacobian, const double *d,
                        double *vector)
{
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < size && d[k] != 0; i++)
            vector[i] += jacobian[k * size + i] * d[k];
}

/* Broyden's update of one Jacobian: weight' d = 1, and jacobian d becomes after - before. */
static void secant(size_t n, size_t size, double *jacobian, const double *before,
                   const double *after, const double *d, const double *weight, double *error)
{
    for (size_t i = 0; i < size; i++)
        error[i] = before[i] - after[i];
    add_columns(n, size, jacobian, d, error);
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < size; i++)
            jacobian[k * size + i] -= error[i] * weight[k];
}

void descent_model_update(descent_model *model, const double *d, const descent_sample *moved)
{
    const descent_problem *p = model->problem;
    size_t n = p->d, r = p->n_residuals;
    double *error = model->work, *weight = error + r + 2 * p->n_state, square = 0;
    for (size_t k = 0; k < n; k++) {
        double half = (p->upper[k] - p->lower[k]) / 2;
        weight[k] = d[k] / (half * half);
        square += d[k] * weight[k];
    }
    if (!(square > 0))
        return;
    for (size_t k = 0; k < n; k++)
        weight[k] /= square;
    for (size_t m = 0; m < p->n_settings; m++)
        secant(n, r, model->jacobian + m * n * r, model->base.residual + m * r,
               moved->residual + m * r, d, weight, error);
    secant(n, p->n_state, model->slope, model->base.state, moved->state, d, weight, error);
}

static void project(size_t n, size_t size, const double *jacobian, const double *vector,
                    double scale, double *gradient)
{
    for (size_t k = 0; k < n; k++) {
        double sum = 0;
        for (size_t i = 0; i < size; i++)
            sum += vector[i] * jacobian[k * size + i];
        gradient[k] = scale * sum;
    }
}

/* The sum of squares of setting m over that at the start: the fine value, changed by what the model
 * says. */
static double ratio(const descent_model *model, size_t m, const double *d, double *gradient)
{
    size_t n = model->problem->d, size = model->problem->n_residuals;
    const double *base = model->base.residual + m * size,
                 *jacobian = model->jacobian + m * n * size;
    double *r = model->work, change = 0;
    memcpy(r, base, size * sizeof *r);
    add_columns(n, size, jacobian, d, r);
    for (size_t i = 0; i < size; i++)
        change += r[i] * r[i] - base[i] * base[i];
    if (gradient)
        project(n, size, jacobian, r, 2 / model->start[m], gradient);
    return (model->base.value[m] + change) / model->start[m];
}

/* b over that at the start, likewise. */
static double bounded_ratio(const descent_model *model, const double *d, double *gradient)
{
    const descent_problem *p = model->problem;
    size_t size = p->n_state;
    double *state = model->work + p->n_residuals, *slope = state + size;
    memcpy(state, model->base.state, size * sizeof *state);
    double before = p->function(p->user_data, model->base.state, NULL);
    add_columns(p->d, size, model->slope, d, state);
    double after = p->function(p->user_data, state, gradient ? slope : NULL);
    if (gradient)
        project(p->d, size, model->slope, slope, 1 / model->start_bounded, gradient);
    return (model->base.bounded + after - before) / model->start_bounded;
}

/* The variables of the step are d, tau and, last, by how much the worst of the limits that only
 * evaluations tell is broken: there is a step whatever the limits are, and the l1 penalty is exact.
 */
struct row {
    const descent_model *model;
    size_t setting;
};

/* What one minimisation works with. */
struct step {
    const descent_model *model;
    nlopt_opt search;
    struct row *rows;   /* [n_settings] */
    double *x;          /* [d + 2] */
    double *bound;      /* [d + 2] */
    double *tolerance;  /* [n_limits] */
    double *limits;     /* [n_limits] */
    double *at, *sides; /* [d], [2][n_limits] of the differences of the known limits */
    bool lacks_memory;
};

static double objective(unsigned n, const double *x, double *gradient, void *data)
{
    const descent_model *model = data;
    for (unsigned k = 0; gradient && k < n; k++)
        gradient[k] = k + 1 == n ? model->penalty : k + 2 == n;
    return x[n - 2] + model->penalty * x[n - 1];
}

static double setting_limit(unsigned n, const double *x, double *gradient, void *data)
{
    const struct row *row = data;
    const bayesopt_descent_setting *setting = &row->model->problem->setting[row->setting];
    double elastic = !setting_is_objective(setting);
    if (gradient) {
        gradient[n - 2] = -setting->share;
        gradient[n - 1] = -elastic;
    }
    return ratio(row->model, row->setting, x, gradient) +
           elastic * (row->model->margin - x[n - 1]) - setting->offset - setting->share * x[n - 2];
}

static double bounded_limit(unsigned n, const double *x, double *gradient, void *data)
{
    const descent_model *model = data;
    if (gradient) {
        gradient[n - 2] = 0;
        gradient[n - 1] = -1;
    }
    return bounded_ratio(model, x, gradient) + model->margin - model->problem->bound - x[n - 1];
}

static void known_limits(unsigned limits, double *value, unsigned n, const double *x,
                         double *gradient, void *data)
{
    const struct step *s = data;
    const descent_model *model = s->model;
    const descent_problem *p = model->problem;
    for (size_t k = 0; k < p->d; k++)
        s->at[k] = model->x[k] + x[k];
    bool known = p->limit(p->user_data, p->d, s->at, value) == 0;
    for (unsigned i = 0; gradient && i < limits; i++)
        gradient[i * n + n - 2] = gradient[i * n + n - 1] = 0;
    for (size_t k = 0; k < p->d && gradient; k++) {
        double keep = s->at[k], step = LIMIT_STEP * (p->upper[k] - p->lower[k]) / 2;
        for (int side = 0; side < 2; side++) {
            s->at[k] = side ? keep + step : keep - step;
            known =
                p->limit(p->user_data, p->d, s->at, s->sides + (size_t)side * limits) == 0 && known;
        }
        s->at[k] = keep;
        for (unsigned i = 0; i < limits; i++)
            gradient[i * n + k] = (s->sides[limits + i] - s->sides[i]) / (2 * step);
    }
    for (unsigned i = 0; i < limits; i++)
        if (!known || isnan(value[i]))
            value[i] = HUGE_VAL;
}

static void set_box(struct step *s, double radius)
{
    const descent_model *model = s->model;
    const descent_problem *p = model->problem;
    for (int side = 0; side < 2; side++) {
        for (size_t k = 0; k < p->d; k++) {
            double reach = radius * (p->upper[k] - p->lower[k]) / 2;
            double low = fmax(p->lower[k], model->anchor[k] - reach),
                   high = fmin(p->upper[k], model->anchor[k] + reach);
            s->bound[k] = side ? fmax(0, high - model->x[k]) : fmin(0, low - model->x[k]);
        }
        s->bound[p->d] = s->bound[p->d + 1] = side ? HUGE_VAL : 0;
        if (side)
            nlopt_set_upper_bounds(s->search, s->bound);
        else
            nlopt_set_lower_bounds(s->search, s->bound);
    }
}

/* The largest ratio of the settings that make the objective. */
static double worst(const descent_model *model, const double *d)
{
    const descent_problem *p = model->problem;
    double most = 0;
    for (size_t m = 0; m < p->n_settings; m++)
        if (setting_is_objective(&p->setting[m]))
            most = fmax(most, ratio(model, m, d, NULL));
    return most;
}

static bool add_rows(struct step *s)
{
    const descent_model *model = s->model;
    const descent_problem *p = model->problem;
    /* NLopt returns the best of the points that keep their limits to this: one that is tighter than
     * what SLSQP meets on bent limits gives the start back. */
    const double tolerance = 1e-5;
    bool ok = true;
    for (size_t m = 0; m < p->n_settings && ok; m++) {
        s->rows[m] = (struct row){model, m};
        ok = nlopt_add_inequality_constraint(s->search, setting_limit, &s->rows[m], tolerance) > 0;
    }
    if (ok && !isnan(p->bound))
        ok =
            nlopt_add_inequality_constraint(s->search, bounded_limit, (void *)model, tolerance) > 0;
    for (size_t i = 0; i < p->n_limits; i++)
        s->tolerance[i] = tolerance;
    if (ok && p->n_limits)
        ok = nlopt_add_inequality_mconstraint(s->search, (unsigned)p->n_limits, known_limits, s,
                                              s->tolerance) > 0;
    return ok;
}

/* By how much the step s->x breaks the limits that are known beforehand. */
static double trespass(struct step *s)
{
    const descent_problem *p = s->model->problem;
    double most = 0;
    if (p->n_limits)
        known_limits((unsigned)p->n_limits, s->limits, (unsigned)p->d + 2, s->x, NULL, s);
    for (size_t i = 0; i < p->n_limits; i++)
        most = fmax(most, s->limits[i]);
    return most;
}

/* By how much it breaks the others, at the tau that its settings make. */
static double excess(const descent_model *model, double *x, double tau)
{
    const descent_problem *p = model->problem;
    unsigned n = (unsigned)p->d + 2;
    double most = 0;
    x[n - 2] = tau;
    x[n - 1] = 0;
    for (size_t m = 0; m < p->n_settings; m++)
        if (!setting_is_objective(&p->setting[m]))
            most = fmax(most, setting_limit(n, x, NULL, &(struct row){model, m}));
    return isnan(p->bound) ? most : fmax(most, bounded_limit(n, x, NULL, (void *)model));
}

/* One try of SLSQP from d, which becomes a step that keeps the known limits and lowers the
 * penalised objective below *least, if one is found. */
static void descend(struct step *s, double clear, double *least, double *d)
{
    const descent_model *model = s->model;
    size_t n = model->problem->d;
    double unused, *x = s->x;
    memcpy(x, d, n * sizeof *d);
    double tau = worst(model, x), over = excess(model, x, tau);
    x[n] = clear * tau;
    x[n + 1] = over + clear - 1;
    if (nlopt_optimize(s->search, x, &unused) == NLOPT_OUT_OF_MEMORY)
        s->lacks_memory = true;
    tau = worst(model, x);
    over = excess(model, x, tau);
    if (trespass(s) > DESCENT_OUTSIDE || !(tau + model->penalty * over < *least))
        return;
    *least = tau + model->penalty * over;
    memcpy(d, x, n * sizeof *d);
}

static bool step_create(const descent_model *model, struct step *s)
{
    const descent_problem *p = model->problem;
    size_t n = p->d + 2, limits = p->n_limits;
    *s = (struct step){.model = model, .search = nlopt_create(NLOPT_LD_SLSQP, (unsigned)n)};
    s->rows = malloc(p->n_settings * sizeof *s->rows);
    s->x = calloc(2 * n + p->d + 4 * limits, sizeof *s->x);
    if (!s->search || !s->rows || !s->x)
        return false;
    s->bound = s->x + n;
    s->at = s->bound + n;
    s->limits = s->at + p->d;
    s->tolerance = s->limits + limits;
    s->sides = s->tolerance + limits;
    return true;
}

static void step_free(struct step *s)
{
    nlopt_destroy(s->search);
    free(s->rows);
    free(s->x);
}

/* The tries about a radius. Lowers *least below what d had. */
static void descend_within(struct step *s, double radius, double *least, double *d)
{
    enum { TRIES = 2 };
    /* tau starts clear of its rows: on them SLSQP may take its first step for its last. It also
     * stops early, and goes on when it is started again. */
    static const double clear[TRIES] = {1.5, 1.05};
    set_box(s, radius);
    for (int k = 0; k < TRIES; k++)
        descend(s, clear[k], least, d);
}

/* The penalised objective of no step. */
static double of_no_step(const struct step *s)
{
    const descent_model *model = s->model;
    memset(s->x, 0, model->problem->d * sizeof *s->x);
    double tau = worst(model, s->x);
    return tau + model->penalty * excess(model, s->x, tau);
}

static bayesopt_status no_memory(void)
{
    return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "no memory for a step");
}

bayesopt_status descent_model_step(const descent_model *model, double radius, double *d,
                                   double *broken, double *promised)
{
    enum { EVALUATIONS = 400, SHORTER = 3 };
    const double some = 1e-4; /* of the ratio: less is a step that SLSQP did not find */
    size_t n = model->problem->d;
    double least = HUGE_VAL;
    struct step s;
    memset(d, 0, n * sizeof *d);
    *promised = NAN;
    bool ok = step_create(model, &s) && add_rows(&s);
    if (ok) {
        nlopt_set_min_objective(s.search, objective, (void *)model);
        nlopt_set_xtol_rel(s.search, 1e-7);
        nlopt_set_maxeval(s.search, EVALUATIONS);
        double nothing = of_no_step(&s);
        for (int k = 0; k <= SHORTER && !(least < nothing - some); k++) /* within the radius too */
            descend_within(&s, ldexp(radius, -k), &least, d);
        if (least < HUGE_VAL) {
            memcpy(s.x, d, n * sizeof *d);
            *promised = worst(model, s.x);
            *broken = excess(model, s.x, *promised);
        }
    }
    ok = ok && !s.lacks_memory;
    step_free(&s);
    return ok ? BAYESOPT_OK : no_memory();
}

bayesopt_status descent_model_trespass(const descent_model *model, double *most)
{
    struct step s;
    bool ok = step_create(model, &s);
    if (ok)
        *most = trespass(&s);
    step_free(&s);
    return ok ? BAYESOPT_OK : no_memory();
}
