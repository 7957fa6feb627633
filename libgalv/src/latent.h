/* The second pass over the samples: their latent coordinates and what follows from these. */
#ifndef GALV_LATENT_H
#define GALV_LATENT_H

#include "model.h"
#include "spectrum.h"

/* Fills latent, lower, upper, regression and confidence of the model from `pairs` <=
 * spectrum->known leading eigenvectors. parameters: gives the parameters of sample r, or NULL when
 * there are none. */
galv_status galv_latent_pass(galv_stream *stream, const galv_spectrum *spectrum,
                             const galv_shape_source *parameters, galv_model *model);

/* Least and greatest latent coordinates over all samples. */
void galv_latent_box(galv_model *model);

/* The active coordinates that are appended quantities: allocates *places, *count of them. */
galv_status galv_latent_appended(const galv_stream *stream, size_t points, size_t **places,
                                 size_t *count);

/* trace_geometry and retained_geometry, given the trace that is due to the appended quantities. */
void galv_latent_geometry(const galv_spectrum *spectrum, size_t count, const size_t *places,
                          double trace_appended, galv_model *model);

#endif
