/* The model of one Gauss-Newton step and its minimum. */
#ifndef HULLOPT_GN_MODEL_H
#define HULLOPT_GN_MODEL_H

#include "core/gauss_newton.h"

struct gn_model {
    const struct gn_problem *problem;
    const double *x;       /* the design at d = 0 */
    struct gn_sample base; /* its fine values, borrowed */
    const double *parent;  /* [settings] C_w of the parent */
    double parent_pressure;
    double *jacobian; /* [settings][n][IGABEM_WAVE_RESIDUALS] */
    double *pressure; /* [n][5 points] */
    double *shift;    /* [settings + 1] by which the bounds are tightened, pressure last */
    double *work;
};

bool gn_model_create(const struct gn_problem *problem, struct gn_model *model);
void gn_model_free(struct gn_model *model);

/* Derivatives with respect to x[k] from two coarse samples, `step` apart. */
void gn_model_differentiate(struct gn_model *model, size_t k, double step,
                            const struct gn_sample *at, const struct gn_sample *moved);

/* Minimises over the box and the radius, in half widths of the box. Fills the step d[n]; returns
 * the largest ratio of the objective that it promises, NAN when there is no feasible step. */
double gn_model_minimise(const struct gn_model *model, double radius, double *d);

/* A model at x = 0, the parent, with everything it borrows: for questions without a search. */
bool gn_at_parent(const struct gn_problem *problem, struct gn_model *model);
void gn_leave(struct gn_model *model);

#endif
