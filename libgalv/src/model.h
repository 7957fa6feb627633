/* What a latent-space model holds. */
#ifndef GALV_SRC_MODEL_H
#define GALV_SRC_MODEL_H

#include <galv/model.h>

struct galv_model {
    size_t samples, points, coordinates, active, parameters, modes, spectrum;
    bool centred;
    galv_method method;
    size_t passes;
    double retained, trace;
    double *eigenvalues;   /* spectrum */
    double *residuals;     /* spectrum */
    double *mse;           /* spectrum */
    double *vectors;       /* modes x coordinates: mode after mode */
    double *mean;          /* coordinates */
    double *parent;        /* 3 points */
    double *weights;       /* coordinates, or NULL: 1 */
    double *latent;        /* samples x modes: projected samples */
    double *lower, *upper; /* modes; one block */
    double *regression;    /* parameters x (1 + modes): x ~ first column + rest u; NULL without
                              parameters */
    galv_confidence confidence;
};

galv_model *galv_model_new(size_t samples, size_t points, size_t coordinates, size_t parameters,
                           size_t modes, size_t spectrum, bool weighted);

#endif
