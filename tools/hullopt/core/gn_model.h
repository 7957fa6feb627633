/* The model of one Gauss-Newton step and its minimum. */
#ifndef HULLOPT_GN_MODEL_H
#define HULLOPT_GN_MODEL_H

#include "core/gauss_newton.h"

struct gn_model {
    const struct gn_problem *problem;
    const double *x;       /* the design at d = 0 */
    double *anchor;        /* [n] where it was differentiated: the radius is about here */
    struct gn_sample base; /* its fine values, borrowed */
    double *parent;        /* [settings] C_w of the parent */
    double parent_pressure;
    double *jacobian; /* [settings][n][GN_RESIDUALS] */
    double *pressure; /* [n][5 points] */
    double margin;    /* by which the limits that only solves tell are tightened */
    double penalty;   /* of the largest excess over them, on the objective's scale */
    double *work;
};

bool gn_model_create(const struct gn_problem *problem, struct gn_model *model);
void gn_model_free(struct gn_model *model);

/* Derivatives with respect to x[k] from two coarse samples, `step` apart. */
void gn_model_differentiate(struct gn_model *model, size_t k, double step,
                            const struct gn_sample *at, const struct gn_sample *moved);

/* Broyden's update: the least change by which the model, at model->base, tells what the step d led
 * to. Variables count in half widths of the box. */
void gn_model_update(struct gn_model *model, const double *d, const struct gn_sample *moved);

/* Minimises over the box and the radius about the anchor, in half widths of the box. Fills the step
 * d[n] and by how much it breaks the tightened limits; returns the largest ratio of the objective
 * that it promises, NAN when no step keeps the known limits. */
double gn_model_minimise(const struct gn_model *model, double radius, double *d, double *broken);

/* A model at x = 0, the parent, with everything it borrows: for questions without a search. */
bool gn_at_parent(const struct gn_problem *problem, struct gn_model *model);
void gn_leave(struct gn_model *model);

#endif
