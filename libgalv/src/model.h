/* What a latent-space model holds. fields.c has the table of it that allocates, frees, stores and
 * restores: a new member is a new row there. */
#ifndef GALV_SRC_MODEL_H
#define GALV_SRC_MODEL_H

#include <galv/model.h>

struct galv_model {
    size_t samples, points, coordinates, active, parameters, modes, spectrum;
    size_t kept; /* vectors, modes <= kept <= spectrum: those after the modes let galv_extend() go
                    on */
    size_t passes;
    size_t method; /* a galv_method */
    bool centred;
    double retained, retained_geometry, trace, trace_geometry, truncation;
    galv_confidence confidence;
    double *eigenvalues;   /* spectrum */
    double *residuals;     /* spectrum */
    double *mse;           /* spectrum */
    double *vectors;       /* kept x coordinates: mode after mode */
    double *mean;          /* coordinates */
    double *parent;        /* points x 3, NULL without points */
    double *weights;       /* coordinates, or NULL: 1 */
    double *latent;        /* samples x modes: projected samples */
    double *lower, *upper; /* modes */
    double *regression;    /* parameters x (1 + modes): x ~ first column + rest u; NULL without
                              parameters */
};

/* Arrays of the sizes set in `sizes`, zero; weights when `weighted`. NULL when memory is short. */
galv_model *galv_model_new(const galv_model *sizes, bool weighted);

/* d += W u for n coordinates of m modes that lie `stride` apart. A plain loop over the modes, in
 * their order and without fused operations: the same bits whatever the threads, the BLAS and the
 * processor, so that a run resumed elsewhere has the same hulls. */
void galv_add_modes(size_t m, const double *modes, size_t stride, const double *u, size_t n,
                    double *d);

/* Coordinates first..first+n-1 of d = mean + W1 u. */
void galv_model_displacement(const galv_model *model, const double *u, size_t first, size_t n,
                             double *d);

/* Whether the latent point is finite; the failure names the coordinate. */
galv_status galv_latent_check(const galv_model *model, const double *u);

#endif
