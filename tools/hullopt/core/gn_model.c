#include "core/gn_model.h"

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

enum { R = GN_RESIDUALS, POINT = sizeof(igabem_pressure_sample) / sizeof(double) };
static const double LIMIT_STEP = 1e-5; /* of the differences of the known limits, half widths */

bool gn_model_create(const struct gn_problem *problem, struct gn_model *model)
{
    size_t n = problem->n, pressure = POINT * problem->points;
    size_t work = R + 2 * pressure + n + 2 * problem->limits;
    *model = (struct gn_model){.problem = problem};
    model->jacobian = malloc(problem->settings * n * R * sizeof(double));
    model->pressure = malloc((n * pressure + 1) * sizeof(double));
    model->parent = malloc(problem->settings * sizeof(double));
    model->anchor = calloc(n, sizeof(double));
    model->work = malloc(work * sizeof(double));
    if (model->jacobian && model->pressure && model->parent && model->anchor && model->work)
        return true;
    gn_model_free(model);
    return false;
}

void gn_model_free(struct gn_model *model)
{
    free(model->jacobian);
    free(model->pressure);
    free(model->parent);
    free(model->anchor);
    free(model->work);
    *model = (struct gn_model){0};
}

void gn_model_differentiate(struct gn_model *model, size_t k, double step,
                            const struct gn_sample *at, const struct gn_sample *moved)
{
    const struct gn_problem *p = model->problem;
    for (size_t m = 0; m < p->settings; m++)
        for (size_t i = 0; i < R; i++)
            model->jacobian[(m * p->n + k) * R + i] =
                (moved->residual[m * R + i] - at->residual[m * R + i]) / step;
    const double *a = (const double *)at->point, *b = (const double *)moved->point;
    for (size_t i = 0; i < POINT * p->points; i++)
        model->pressure[k * POINT * p->points + i] = (b[i] - a[i]) / step;
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

void gn_model_update(struct gn_model *model, const double *d, const struct gn_sample *moved)
{
    const struct gn_problem *p = model->problem;
    size_t n = p->n, pressure = POINT * p->points;
    double *error = model->work, *weight = error + R + 2 * pressure, square = 0;
    for (size_t k = 0; k < n; k++) {
        double half = (p->upper[k] - p->lower[k]) / 2;
        weight[k] = d[k] / (half * half);
        square += d[k] * weight[k];
    }
    for (size_t k = 0; k < n; k++)
        weight[k] /= square;
    for (size_t m = 0; m < p->settings && square > 0; m++)
        secant(n, R, model->jacobian + m * n * R, model->base.residual + m * R,
               moved->residual + m * R, d, weight, error);
    if (pressure && square > 0)
        secant(n, pressure, model->pressure, (const double *)model->base.point,
               (const double *)moved->point, d, weight, error);
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

/* C_w of setting m over that of the parent: the fine value, changed by what the model says. */
static double ratio(const struct gn_model *model, size_t m, const double *d, double *gradient)
{
    size_t n = model->problem->n;
    const double *base = model->base.residual + m * R, *jacobian = model->jacobian + m * n * R;
    double *r = model->work, change = 0;
    memcpy(r, base, R * sizeof *r);
    add_columns(n, R, jacobian, d, r);
    for (size_t i = 0; i < R; i++)
        change += r[i] * r[i] - base[i] * base[i];
    if (gradient)
        project(n, R, jacobian, r, 2 / model->parent[m], gradient);
    return (model->base.value[m] + change) / model->parent[m];
}

static double pressure_ratio(const struct gn_model *model, const double *d, double *gradient)
{
    const struct gn_problem *p = model->problem;
    size_t size = POINT * p->points;
    double *z = model->work + R, *slope = z + size;
    memcpy(z, model->base.point, size * sizeof *z);
    double before = igabem_pressure_sum(p->points, model->base.point, NULL);
    add_columns(p->n, size, model->pressure, d, z);
    double after = igabem_pressure_sum(p->points, (const igabem_pressure_sample *)z,
                                       (igabem_pressure_sample *)slope);
    if (gradient)
        project(p->n, size, model->pressure, slope, 1 / model->parent_pressure, gradient);
    return (model->base.pressure + after - before) / model->parent_pressure;
}

/* The variables of the step are d, tau and, last, by how much the worst of the limits that only
 * solves tell is broken: there is a step whatever the limits are, and the l1 penalty is exact. */
struct row {
    const struct gn_model *model;
    size_t setting;
};

static double objective(unsigned n, const double *x, double *gradient, void *data)
{
    const struct gn_model *model = data;
    for (unsigned k = 0; gradient && k < n; k++)
        gradient[k] = k + 1 == n ? model->penalty : k + 2 == n;
    return x[n - 2] + model->penalty * x[n - 1];
}

static double setting_limit(unsigned n, const double *x, double *gradient, void *data)
{
    const struct row *row = data;
    const struct gn_setting *setting = &row->model->problem->setting[row->setting];
    double elastic = !gn_is_objective(setting);
    if (gradient) {
        gradient[n - 2] = -setting->share;
        gradient[n - 1] = -elastic;
    }
    return ratio(row->model, row->setting, x, gradient) +
           elastic * (row->model->margin - x[n - 1]) - setting->offset - setting->share * x[n - 2];
}

static double pressure_limit(unsigned n, const double *x, double *gradient, void *data)
{
    const struct gn_model *model = data;
    if (gradient) {
        gradient[n - 2] = 0;
        gradient[n - 1] = -1;
    }
    return pressure_ratio(model, x, gradient) + model->margin - model->problem->pressure - x[n - 1];
}

static void known_limits(unsigned limits, double *value, unsigned n, const double *x,
                         double *gradient, void *data)
{
    const struct gn_model *model = data;
    const struct gn_problem *p = model->problem;
    double *at = model->work + R + 2 * POINT * p->points, *side = at + p->n;
    for (size_t k = 0; k < p->n; k++)
        at[k] = model->x[k] + x[k];
    bool known = p->limit(p->user_data, at, value);
    for (unsigned i = 0; gradient && i < limits; i++)
        gradient[i * n + n - 2] = gradient[i * n + n - 1] = 0;
    for (size_t k = 0; k < p->n && gradient; k++) {
        double keep = at[k], step = LIMIT_STEP * (p->upper[k] - p->lower[k]) / 2;
        for (int s = 0; s < 2; s++) {
            at[k] = s ? keep + step : keep - step;
            known = p->limit(p->user_data, at, side + (size_t)s * limits) && known;
        }
        at[k] = keep;
        for (unsigned i = 0; i < limits; i++)
            gradient[i * n + k] = (side[limits + i] - side[i]) / (2 * step);
    }
    for (unsigned i = 0; i < limits && !known; i++)
        value[i] = HUGE_VAL;
}

static void set_box(const struct gn_model *model, double radius, nlopt_opt step, double *bound)
{
    const struct gn_problem *p = model->problem;
    for (int side = 0; side < 2; side++) {
        for (size_t k = 0; k < p->n; k++) {
            double reach = radius * (p->upper[k] - p->lower[k]) / 2;
            double low = fmax(p->lower[k], model->anchor[k] - reach),
                   high = fmin(p->upper[k], model->anchor[k] + reach);
            bound[k] = side ? fmax(0, high - model->x[k]) : fmin(0, low - model->x[k]);
        }
        bound[p->n] = bound[p->n + 1] = side ? HUGE_VAL : 0;
        if (side)
            nlopt_set_upper_bounds(step, bound);
        else
            nlopt_set_lower_bounds(step, bound);
    }
}

/* The largest ratio of the settings that make the objective. */
static double worst(const struct gn_model *model, const double *d)
{
    const struct gn_problem *p = model->problem;
    double most = 0;
    for (size_t m = 0; m < p->settings; m++)
        if (gn_is_objective(&p->setting[m]))
            most = fmax(most, ratio(model, m, d, NULL));
    return most;
}

static bool add_rows(const struct gn_model *model, nlopt_opt step, struct row *rows)
{
    enum { LIMITS = 64 };
    const struct gn_problem *p = model->problem;
    /* NLopt returns the best of the points that keep their limits to this: one that is tighter than
     * what SLSQP meets on bent limits gives the start back. */
    const double tolerance = 1e-5;
    double each[LIMITS];
    bool ok = p->limits <= LIMITS;
    for (size_t m = 0; m < p->settings && ok; m++) {
        rows[m] = (struct row){model, m};
        ok = nlopt_add_inequality_constraint(step, setting_limit, &rows[m], tolerance) > 0;
    }
    if (ok && !isnan(p->pressure))
        ok = nlopt_add_inequality_constraint(step, pressure_limit, (void *)model, tolerance) > 0;
    for (size_t i = 0; i < p->limits && ok; i++)
        each[i] = tolerance;
    if (ok && p->limits)
        ok = nlopt_add_inequality_mconstraint(step, (unsigned)p->limits, known_limits,
                                              (void *)model, each) > 0;
    return ok;
}

/* By how much the step breaks the limits that are known beforehand. */
static double trespass(const struct gn_model *model, const double *x, double *limits)
{
    const struct gn_problem *p = model->problem;
    double most = 0;
    if (p->limits)
        known_limits((unsigned)p->limits, limits, (unsigned)p->n + 2, x, NULL, (void *)model);
    for (size_t i = 0; i < p->limits; i++)
        most = fmax(most, limits[i]);
    return most;
}

/* By how much it breaks the others, at the tau that its settings make. */
static double excess(const struct gn_model *model, double *x, double tau)
{
    const struct gn_problem *p = model->problem;
    unsigned n = (unsigned)p->n + 2;
    double most = 0;
    x[n - 2] = tau;
    x[n - 1] = 0;
    for (size_t m = 0; m < p->settings; m++)
        if (!gn_is_objective(&p->setting[m]))
            most = fmax(most, setting_limit(n, x, NULL, &(struct row){model, m}));
    return isnan(p->pressure) ? most : fmax(most, pressure_limit(n, x, NULL, (void *)model));
}

/* One try of SLSQP from d, which becomes a step that keeps the known limits and lowers the
 * penalised objective below *least, if one is found. */
static void descend(const struct gn_model *model, nlopt_opt step, double clear, double *least,
                    double *x, double *limits, double *d)
{
    const double outside = 1e-4; /* a step that is no solution */
    size_t n = model->problem->n;
    double unused;
    memcpy(x, d, n * sizeof *d);
    double tau = worst(model, x), over = excess(model, x, tau);
    x[n] = clear * tau;
    x[n + 1] = over + clear - 1;
    nlopt_optimize(step, x, &unused);
    tau = worst(model, x);
    over = excess(model, x, tau);
    if (trespass(model, x, limits) > outside || !(tau + model->penalty * over < *least))
        return;
    *least = tau + model->penalty * over;
    memcpy(d, x, n * sizeof *d);
}

double gn_model_minimise(const struct gn_model *model, double radius, double *d, double *broken)
{
    enum { EVALUATIONS = 400, TRIES = 2 };
    /* tau starts clear of its rows: on them SLSQP may take its first step for its last. It also
     * stops early, and goes on when it is started again. */
    static const double clear[TRIES] = {1.5, 1.05};
    const struct gn_problem *p = model->problem;
    size_t n = p->n + 2;
    nlopt_opt step = nlopt_create(NLOPT_LD_SLSQP, (unsigned)n);
    struct row *rows = malloc(p->settings * sizeof *rows);
    double *x = calloc(2 * n + p->limits, sizeof *x), promised = NAN, least = HUGE_VAL;
    memset(d, 0, p->n * sizeof *d);
    if (step && rows && x && add_rows(model, step, rows)) {
        set_box(model, radius, step, x + n);
        nlopt_set_min_objective(step, objective, (void *)model);
        nlopt_set_xtol_rel(step, 1e-7);
        nlopt_set_maxeval(step, EVALUATIONS);
        for (int k = 0; k < TRIES; k++)
            descend(model, step, clear[k], &least, x, x + 2 * n, d);
        if (least < HUGE_VAL) {
            memcpy(x, d, p->n * sizeof *d);
            promised = worst(model, x);
            *broken = excess(model, x, promised);
        }
    }
    nlopt_destroy(step);
    free(rows);
    free(x);
    return promised;
}
