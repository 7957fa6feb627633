/* What a latent-space model holds. */
#ifndef GALV_SRC_MODEL_H
#define GALV_SRC_MODEL_H

#include <galv/model.h>

struct galv_model {
    size_t samples, points, coordinates, active, parameters, modes, spectrum;
    size_t kept; /* vectors, modes <= kept <= spectrum: those after the modes let galv_extend() go
                    on */
    bool centred;
    galv_method method;
    size_t passes;
    double retained, retained_geometry, trace, trace_geometry, truncation;
    double *eigenvalues;   /* spectrum */
    double *residuals;     /* spectrum */
    double *mse;           /* spectrum */
    double *vectors;       /* kept x coordinates: mode after mode */
    double *mean;          /* coordinates */
    double *parent;        /* 3 points */
    double *weights;       /* coordinates, or NULL: 1 */
    double *latent;        /* samples x modes: projected samples */
    double *lower, *upper; /* modes; one block */
    double *regression;    /* parameters x (1 + modes): x ~ first column + rest u; NULL without
                              parameters */
    galv_confidence confidence;
};

/* Arrays of the sizes set in `sizes`, zero; weights when `weighted`. NULL when memory is short. */
galv_model *galv_model_new(const galv_model *sizes, bool weighted);

#endif
