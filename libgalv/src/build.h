/* From a source of rows to a model. */
#ifndef GALV_BUILD_H
#define GALV_BUILD_H

#include "model.h"
#include "spectrum.h"

#include <galv/model.h>

typedef struct galv_job {
    galv_source *source;
    const galv_shape_source *shape; /* when the rows are samples of a shape, else NULL */
    size_t points;                  /* 0 without */
    const double *xyz;
    const double *weights; /* per coordinate, or NULL */
    size_t block;
    const galv_options *options;
} galv_job;

galv_status galv_options_check(const galv_options *options);
galv_status galv_sampling_check(const galv_sampling *sampling, size_t n);

/* Rows per block: enough for matrix products to run at speed, within a quarter of the workspace. */
size_t galv_block_rows(size_t samples, size_t coordinates, size_t workspace);

galv_goal galv_goal_from(const galv_options *options, bool centre);

/* The method to use for AUTO, and a refusal of what the source does not allow. */
galv_status galv_method_choose(const galv_job *job, galv_method *method);
galv_status galv_spectrum_find(galv_stream *stream, const galv_job *job, galv_method method,
                               const galv_goal *goal, galv_spectrum *spectrum);

/* One weight per coordinate from those of the points and of the appended quantities; *out is NULL
 * when neither is given. */
galv_status galv_weights_spread(size_t npoints, const double *weights, const galv_extra *extra,
                                double **out);

/* A model with everything that follows from the spectrum: all but the latent samples. */
galv_status galv_model_assemble(const galv_stream *stream, galv_spectrum *spectrum,
                                const galv_goal *goal, const galv_job *job, size_t samples,
                                size_t parameters, galv_model **model);

#endif
