/* The latent space as the run keeps it: what libgalv found, held in plain arrays so that it can be
 * stored with the run. A resumed run then moves points by the same bits, whatever the number of
 * threads or the BLAS of the later session. */
#ifndef HULLOPT_LATENT_H
#define HULLOPT_LATENT_H

#include <galv/galv.h>

#include <stdbool.h>
#include <stddef.h>

struct latent {
    size_t modes, coordinates, spectrum, samples, parameters, active;
    double retained, trace;
    double *eigenvalues, *mse; /* spectrum each */
    double *vectors;           /* modes x coordinates, as galv_model_vectors() */
    double *mean;              /* coordinates */
    double *lower, *upper;     /* modes each: box of the projected samples */
};

/* Sizes must be set; allocates the arrays. */
bool latent_allocate(struct latent *latent);
bool latent_copy_model(const galv_model *model, struct latent *latent);
void latent_free(struct latent *latent);

/* d = mean + W1 u, coordinates numbers. */
void latent_displace(const struct latent *latent, const double *u, double *d);

#endif
