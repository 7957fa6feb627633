/* From a stream of rows to the leading eigenpairs of its covariance, in three ways. */
#ifndef GALV_SPECTRUM_H
#define GALV_SPECTRUM_H

#include "source.h"

#include <stdbool.h>
#include <stdint.h>

/* How many eigenpairs are wanted. */
typedef struct galv_goal {
    double variance; /* share of the trace, used when modes == 0 */
    size_t modes;
    size_t spectrum; /* pairs to find at least */
    bool centre;
    uint64_t seed;
} galv_goal;

/* Relative to the trace: what rounding may take from the sum of all eigenvalues. */
#define GALV_TRACE_ROUNDING 1e-12

typedef struct galv_spectrum {
    size_t active;     /* coordinates, in the order of the stream's `place` */
    size_t known;      /* pairs */
    double trace;      /* of the (centred) covariance */
    double *values;    /* known, descending, > 0 */
    double *vectors;   /* active x known, orthonormal columns */
    double *residuals; /* known: |C w - value w| */
    double
        *mean; /* active: mean of the stream's rows; subtracted from the covariance when centring */
    size_t passes; /* over the samples */
} galv_spectrum;

void galv_spectrum_free(galv_spectrum *spectrum);

galv_status galv_spectrum_covariance(galv_stream *stream, const galv_goal *goal,
                                     galv_spectrum *spectrum);
galv_status galv_spectrum_gram(galv_stream *stream, const galv_goal *goal, galv_spectrum *spectrum);
galv_status galv_spectrum_randomised(galv_stream *stream, const galv_goal *goal,
                                     galv_spectrum *spectrum);

/* For linear shapes; a shape with fewer moving coordinates than parameters goes to the covariance
 * side. */
galv_status galv_spectrum_factored(galv_stream *stream, const galv_shape_source *source,
                                   const galv_goal *goal, galv_spectrum *spectrum);

/* Modes that meet the goal, or 0 when `known` values do not reach it. */
size_t galv_goal_modes(const galv_goal *goal, size_t known, const double *values, double trace);

/* Leading eigenpairs of the dense matrix a (order n, lower triangle, destroyed) that meet the goal;
 * only those above rounding are returned. Allocates values, vectors and residuals. */
galv_status galv_spectrum_matrix(size_t n, double *a, double trace, const galv_goal *goal,
                                 size_t *known, double **values, double **vectors,
                                 double **residuals, galv_stage *stage);

/* Sums over one pass of the stream that every method needs. */
typedef struct galv_sums {
    double energy; /* of squared norms */
    double *sum;   /* stored: of rows, in the order of `place` */
} galv_sums;

galv_status galv_sums_start(galv_sums *sums, size_t stored);
void galv_sums_add(galv_sums *sums, const galv_stream *stream, size_t count);
/* Moves the mean and the trace into the spectrum and frees the sums; fails when there is no
 * variance. */
galv_status galv_sums_finish(galv_sums *sums, const galv_stream *stream, bool centre,
                             galv_spectrum *spectrum);

#endif
