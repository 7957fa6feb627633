/* The model of one Gauss-Newton step and its minimum. */
#ifndef BAYESOPT_DESCENT_MODEL_H
#define BAYESOPT_DESCENT_MODEL_H

#include <bayesopt/descent.h>

#include <stdbool.h>

typedef bayesopt_descent_problem descent_problem;
typedef bayesopt_descent_sample descent_sample;

/* By how much a step may break the known limits. */
static const double DESCENT_OUTSIDE = 1e-4;
/* By which every limit is tightened to begin with. */
static const double DESCENT_MARGIN = 2e-3;
/* Of an excess: exact as long as it is above the multipliers of the step's problem, which are of
 * order one. */
static const double DESCENT_PENALTY = 3;

static inline bool setting_is_objective(const bayesopt_descent_setting *setting)
{
    return setting->share == 1 && setting->offset == 0;
}

struct bayesopt_descent_model {
    const descent_problem *problem;
    double *x;            /* [d] the point at d = 0 */
    double *anchor;       /* [d] the radius is about here */
    descent_sample base;  /* fine values at x */
    double *start;        /* [n_settings] values at the start of a search */
    double start_bounded; /* b there */
    double *jacobian;     /* [n_settings][d][n_residuals] */
    double *slope;        /* [d][n_state] of the state */
    double margin;        /* by which the limits that only evaluations tell are tightened */
    double penalty;       /* of the largest excess over them, on the objective's scale */
    double *work;
};
typedef struct bayesopt_descent_model descent_model;

/* descent_problem.c */
bayesopt_status descent_check(const descent_problem *problem, const double *start);
bool sample_create(const descent_problem *problem, descent_sample *sample);
void sample_free(descent_sample *sample);
/* Slopes whose arrays are the model's, but for `known`, which is to be freed; none known. */
bool slopes_create(const descent_problem *problem, const descent_model *model,
                   bayesopt_descent_slopes *slopes);
bool slopes_complete(const descent_problem *problem, const bayesopt_descent_slopes *slopes);
/* Evaluations whose numbers are all finite, and what is known of derivatives that are. */
bayesopt_descent_answer descent_fine(const descent_problem *p, const double *x, descent_sample *s);
bayesopt_descent_answer descent_coarse(const descent_problem *p, const double *x,
                                       const bayesopt_descent_slopes *known, descent_sample *s);
bayesopt_descent_answer descent_slopes(const descent_problem *p, const double *x,
                                       bayesopt_descent_slopes *s);

bool descent_model_init(const descent_problem *problem, descent_model *model);
void descent_model_clear(descent_model *model);

/* Derivatives with respect to x[k] that are not known from two coarse samples, `step` apart. */
void descent_model_difference(descent_model *model, const bayesopt_descent_slopes *known, size_t k,
                              double step, const descent_sample *at, const descent_sample *moved);

/* Broyden's update: the least change by which the model, at model->base, tells what the step d led
 * to. Variables count in half widths of the box. */
void descent_model_update(descent_model *model, const double *d, const descent_sample *moved);

/* Minimises over the box and the radius about the anchor, in half widths of the box. Fills the step
 * d[d], by how much it breaks the tightened limits and the largest ratio of the objective that it
 * promises, NAN when no step keeps the known limits.
 * @return BAYESOPT_ERROR_MEMORY */
bayesopt_status descent_model_step(const descent_model *model, double radius, double *d,
                                   double *broken, double *promised);

/* By how much model->x breaks the known limits; HUGE_VAL where they are not known.
 * @return BAYESOPT_ERROR_MEMORY */
bayesopt_status descent_model_trespass(const descent_model *model, double *most);

/* descent.c: the fine values at start (NULL: 0), at which every ratio is one; all derivatives
 * there, BAYESOPT_STOP_BUDGET where an evaluation says stop. */
bayesopt_status descent_start(descent_model *model, const double *start);
bayesopt_status descent_differentiate(descent_model *model);

#endif
