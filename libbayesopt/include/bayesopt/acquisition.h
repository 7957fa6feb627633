/**
 * @file acquisition.h
 * What a point promises: expected improvement and its relatives, for minimisation, without
 * overflow, underflow or cancellation anywhere.
 *
 * With z = (best - mean)/sd, EI = sd h(z), h(z) = phi(z) + z Phi(z). Ament et al., NeurIPS 2023.
 */
#ifndef BAYESOPT_ACQUISITION_H
#define BAYESOPT_ACQUISITION_H

#include <bayesopt/status.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/** log h(z), to 1e-13 relative for all finite z (z = -1e10 gives -5e19). */
BAYESOPT_API double bayesopt_log_h(double z);

/** h'(z)/h(z) = Phi(z)/h(z), the derivative of log h. */
BAYESOPT_API double bayesopt_log_h_derivative(double z);

/** log Phi(z), the normal distribution's logarithm, and its derivative phi(z)/Phi(z). */
BAYESOPT_API double bayesopt_log_cdf(double z);
/** Its derivative, the inverse Mills ratio. */
BAYESOPT_API double bayesopt_log_cdf_derivative(double z);

/** log(Phi(b) - Phi(a)) for a < b, infinite ends allowed. */
BAYESOPT_API double bayesopt_log_interval(double a, double b);

/** Expected improvement below @p best of a normal value; sd = 0 gives max(best - mean, 0). */
BAYESOPT_API double bayesopt_ei(double mean, double sd, double best);

/**
 * Logarithm of the expected improvement; -INFINITY if sd = 0 and mean >= best.
 * @param dmean  filled with its derivative in mean; NULL allowed
 * @param dsd    filled with its derivative in sd; NULL allowed
 */
BAYESOPT_API double bayesopt_log_ei(double mean, double sd, double best, double *dmean,
                                    double *dsd);

/** Logarithm of the probability lower < c < upper of a normal outcome, derivatives as above. */
BAYESOPT_API double bayesopt_log_feasibility(double mean, double sd, double lower, double upper,
                                             double *dmean, double *dsd);

/** Lower confidence bound mean - k sd; small is promising. */
BAYESOPT_API double bayesopt_lcb(double mean, double sd, double k);

#ifdef __cplusplus
}
#endif

#endif
