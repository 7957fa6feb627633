/* Monotone maps of the outputs, and the affine standardisation after them. */
#ifndef BAYESOPT_TRANSFORM_H
#define BAYESOPT_TRANSFORM_H

#include <bayesopt/gp.h>

struct transform {
    bayesopt_transform kind; /* never AUTO */
    double shift;            /* LOG: subtracted before the logarithm; YEO_JOHNSON: the median */
    double unit;             /* YEO_JOHNSON: the interquartile range */
    double lambda;           /* YEO_JOHNSON: exponent; WINSORISED: the ceiling */
    size_t n;                /* RANK: knots */
    double *knots, *scores;  /* RANK: increasing values and their normal scores */
    double offset, scale;    /* modelled = (T(y) - offset)/scale */
};

/* The identity. */
void transform_reset(struct transform *transform);
void transform_free(struct transform *transform);
/* Estimates the map from the data (lambda of Yeo-Johnson by the normal profile likelihood), then
 * standardises to mean 0 and standard deviation 1. false: out of memory. Data that do not vary get
 * scale 1. */
bool transform_estimate(struct transform *transform, bayesopt_transform kind, size_t n,
                        const double *y);
double transform_apply(const struct transform *transform, double y);
double transform_invert(const struct transform *transform, double value);
/* Inverse of the standard normal distribution, 0 < p < 1. */
double transform_normal_score(double p);
/* d modelled/dy. */
double transform_slope(const struct transform *transform, double y);

#endif
