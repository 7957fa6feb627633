/* The second pass over the samples: their latent coordinates and what follows from these. */
#ifndef GALV_LATENT_H
#define GALV_LATENT_H

#include "model.h"
#include "spectrum.h"

/* Fills latent, lower, upper, regression and confidence of the model from `pairs` <=
 * spectrum->known leading eigenvectors. parameters: gives the parameters of sample r, or NULL when
 * there are none. */
galv_status galv_latent_pass(galv_stream *stream, const galv_spectrum *spectrum, size_t pairs,
                             const galv_shape_source *parameters, galv_model *model);

#endif
