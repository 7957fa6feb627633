/* From a latent point back to the parameters of the shape: bounded Levenberg-Marquardt on the
 * displacement. */
#include "error.h"
#include "model.h"
#include "shape.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ITERATIONS = 100 };

/* Difference step, relative to the range of a parameter. */
static const double relative_step = 1e-6;

/* Residuals are weighted differences of the stored coordinates of the plan; `rest` is the squared
 * norm of the target on all others, which no parameters change. */
typedef struct search {
    const galv_model *model;
    const galv_shape *shape;
    galv_plan *plan;
    size_t n, stored;
    double rest;
    double *target;     /* stored */
    double *scale;      /* stored: square roots of the weights */
    double *x;          /* (n + 1) x n: the point and its neighbours */
    double *rows;       /* (n + 1) x stored */
    double *trial_row;  /* stored */
    double *step, *try; /* n */
    double *gradient;   /* n */
    double *normal;     /* n x n: J^T J */
    double *system;     /* n x n */
    double *right;      /* n */
    size_t *free_of;    /* n: indices of the free parameters */
    int *pinned;        /* n */
} search;

static void search_free(search *s)
{
    galv_plan_free(s->plan);
    free(s->target);
    free(s->scale);
    free(s->x);
    free(s->rows);
    free(s->trial_row);
    free(s->step);
    free(s->try);
    free(s->gradient);
    free(s->normal);
    free(s->system);
    free(s->right);
    free(s->free_of);
    free(s->pinned);
}

static galv_status search_start(search *s, const galv_model *model, const galv_shape *shape)
{
    size_t n = galv_shape_parameters(shape);
    *s = (search){.model = model, .shape = shape, .n = n};
    galv_status status = galv_plan_create(shape, model->points, model->parent, &s->plan);
    if (status)
        return status;
    size_t stored = s->stored = s->plan->stored;
    s->target = malloc(stored * sizeof(double));
    s->scale = malloc(stored * sizeof(double));
    s->x = malloc((n + 1) * n * sizeof(double));
    s->rows = malloc((n + 1) * stored * sizeof(double));
    s->trial_row = malloc(stored * sizeof(double));
    s->step = malloc(n * sizeof(double));
    s->try = malloc(n * sizeof(double));
    s->gradient = malloc(n * sizeof(double));
    s->normal = malloc(n * n * sizeof(double));
    s->system = malloc(n * n * sizeof(double));
    s->right = malloc(n * sizeof(double));
    s->free_of = malloc(n * sizeof(size_t));
    s->pinned = malloc(n * sizeof(int));
    if (s->target && s->scale && s->x && s->rows && s->trial_row && s->step && s->try &&
        s->gradient && s->normal && s->system && s->right && s->free_of && s->pinned)
        return GALV_OK;
    search_free(s);
    return galv_fail(GALV_ERROR_MEMORY, "search over %zu parameters", n);
}

static galv_status set_target(search *s, const double *u)
{
    const galv_model *model = s->model;
    double *d = malloc(model->coordinates * sizeof *d);
    if (!d)
        return galv_fail(GALV_ERROR_MEMORY, "displacement of %zu points", model->points);
    galv_status status = galv_reconstruct(model, u, d);
    double whole = 0, part = 0;
    for (size_t i = 0; i < 3 * model->points && !status; i++)
        whole += (model->weights ? model->weights[i] : 1) * d[i] * d[i];
    for (size_t k = 0; k < s->stored && !status; k++) {
        size_t i = s->plan->index[k];
        s->scale[k] = model->weights ? sqrt(model->weights[i]) : 1;
        s->target[k] = s->scale[k] * d[i];
        part += s->target[k] * s->target[k];
    }
    s->rest = fmax(whole - part, 0);
    free(d);
    return status;
}

/* Weighted residual of the row; returns its squared norm. */
static double make_residual(const search *s, double *row)
{
    double sum = 0;
    for (size_t k = 0; k < s->stored; k++) {
        row[k] = s->scale[k] * row[k] - s->target[k];
        sum += row[k] * row[k];
    }
    return sum;
}

static galv_status evaluate(const search *s, size_t count, const double *x, double *rows)
{
    size_t bad = 0;
    return s->plan->rows(s->plan, count, x, rows, s->stored, &bad);
}

/* Residual and Jacobian at the first row of x, by differences towards the farther bound. Leaves the
 * residual in the first of `rows` and J^T J, J^T r behind. */
static galv_status linearise(search *s, double *square)
{
    size_t n = s->n, stored = s->stored;
    const double *lower = galv_shape_lower(s->shape), *upper = galv_shape_upper(s->shape);
    for (size_t i = 0; i < n; i++) {
        double *neighbour = s->x + (i + 1) * n, range = upper[i] - lower[i];
        memcpy(neighbour, s->x, n * sizeof *neighbour);
        s->step[i] = relative_step * (s->x[i] - lower[i] > range / 2 ? -range : range);
        neighbour[i] += s->step[i];
        s->step[i] = neighbour[i] - s->x[i];
    }
    galv_status status = evaluate(s, n + 1, s->x, s->rows);
    if (status)
        return status;
    *square = make_residual(s, s->rows);
    for (size_t i = 0; i < n; i++) {
        double *column = s->rows + (i + 1) * stored;
        for (size_t k = 0; k < stored; k++)
            column[k] = s->step[i] != 0
                            ? (s->scale[k] * column[k] - s->target[k] - s->rows[k]) / s->step[i]
                            : 0;
    }
    cblas_dsyrk(CblasColMajor, CblasLower, CblasTrans, (blasint)n, (blasint)stored, 1,
                s->rows + stored, (blasint)stored, 0, s->normal, (blasint)n);
    cblas_dgemv(CblasColMajor, CblasTrans, (blasint)stored, (blasint)n, 1, s->rows + stored,
                (blasint)stored, s->rows, 1, 0, s->gradient, 1);
    return GALV_OK;
}

/* Minimises the damped quadratic model within the bounds: parameters that the free solution takes
 * beyond a bound are pinned there and the rest solved again. s->try is the minimiser; *solved is
 * false when the matrix is not positive definite and wants more damping. */
static galv_status solve_bounded(search *s, double damping, bool *solved)
{
    size_t n = s->n;
    const double *lower = galv_shape_lower(s->shape), *upper = galv_shape_upper(s->shape);
    for (size_t i = 0; i < n; i++) {
        bool outward = (s->x[i] <= lower[i] && s->gradient[i] >= 0) ||
                       (s->x[i] >= upper[i] && s->gradient[i] <= 0);
        s->pinned[i] = outward;
        s->try[i] = s->x[i];
    }
    for (;;) {
        size_t nfree = 0;
        for (size_t i = 0; i < n; i++)
            if (!s->pinned[i])
                s->free_of[nfree++] = i;
        if (nfree == 0)
            return GALV_OK;
        for (size_t c = 0; c < nfree; c++) {
            size_t j = s->free_of[c];
            double g = s->gradient[j];
            for (size_t i = 0; i < n; i++)
                if (s->pinned[i])
                    g += s->normal[i < j ? i * n + j : j * n + i] * (s->try[i] - s->x[i]);
            s->right[c] = -g;
            for (size_t r = c; r < nfree; r++)
                s->system[c * nfree + r] = s->normal[j * n + s->free_of[r]];
            s->system[c * nfree + c] += damping;
        }
        lapack_int info = LAPACKE_dposv(LAPACK_COL_MAJOR, 'L', (lapack_int)nfree, 1, s->system,
                                        (lapack_int)nfree, s->right, (lapack_int)nfree);
        *solved = info == 0;
        if (info)
            return info > 0 ? GALV_OK : galv_lapack(info, "step of the back-mapping");
        bool beyond = false;
        for (size_t c = 0; c < nfree; c++) {
            size_t j = s->free_of[c];
            double value = s->x[j] + s->right[c];
            s->try[j] = fmin(fmax(value, lower[j]), upper[j]);
            if (value != s->try[j])
                s->pinned[j] = beyond = true;
        }
        if (!beyond)
            return GALV_OK;
    }
}

static galv_status minimise(search *s, double *square)
{
    size_t n = s->n;
    double damping = 0, largest = 0;
    for (int iteration = 0; iteration < MOST_ITERATIONS; iteration++) {
        galv_status status = linearise(s, square);
        if (status)
            return status;
        for (size_t i = 0; i < n; i++)
            largest = fmax(largest, s->normal[i * n + i]);
        if (iteration == 0)
            damping = 1e-6 * largest;
        double trial = INFINITY;
        while (damping <= 1e12 * largest) {
            bool solved = true;
            status = solve_bounded(s, damping, &solved);
            if (status)
                return status;
            if (solved) {
                status = evaluate(s, 1, s->try, s->trial_row);
                if (status)
                    return status;
                trial = make_residual(s, s->trial_row);
                if (trial < *square)
                    break;
            }
            damping = fmax(4 * damping, 1e-15 * largest);
        }
        if (!(trial < *square))
            return GALV_OK;
        double gain = *square - trial;
        memcpy(s->x, s->try, n * sizeof *s->x);
        *square = trial;
        damping /= 8;
        if (gain <= 1e-13 * (trial + s->rest) || trial <= 1e-30 * largest)
            return GALV_OK;
    }
    return GALV_OK;
}

/* The embedded linear map, moved into the bounds. */
static void start_point(search *s, const double *u)
{
    const galv_model *model = s->model;
    const double *lower = galv_shape_lower(s->shape), *upper = galv_shape_upper(s->shape);
    for (size_t i = 0; i < s->n; i++) {
        const double *row = model->regression + i * (1 + model->modes);
        double value = row[0];
        for (size_t k = 0; k < model->modes; k++)
            value += row[1 + k] * u[k];
        s->x[i] = fmin(fmax(value, lower[i]), upper[i]);
    }
}

galv_status galv_backmap(const galv_model *model, const galv_shape *shape, const double *u,
                         double *x, double *residual)
{
    if (!model || !shape || !u || !x)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "model, shape, latent point and result must be given");
    if (galv_shape_parameters(shape) != model->parameters)
        return galv_fail(GALV_ERROR_ARGUMENT,
                         "the shape has %zu parameters, the model was built from %zu",
                         galv_shape_parameters(shape), model->parameters);
    if (model->method == GALV_METHOD_PARAMETERS)
        return galv_fail(GALV_ERROR_ARGUMENT, "the modes of this model are the parameters");
    if (model->parameters == 0)
        return galv_fail(GALV_ERROR_ARGUMENT, "the model was built from data without parameters");
    search s;
    galv_status status = search_start(&s, model, shape);
    if (status)
        return status;
    double square = 0;
    status = set_target(&s, u);
    if (!status) {
        start_point(&s, u);
        status = minimise(&s, &square);
    }
    if (!status) {
        memcpy(x, s.x, s.n * sizeof *x);
        double weight = 0;
        for (size_t p = 0; p < model->points; p++)
            weight += model->weights ? model->weights[3 * p] : 1;
        if (residual)
            *residual = sqrt((square + s.rest) / weight);
    }
    search_free(&s);
    return status;
}
