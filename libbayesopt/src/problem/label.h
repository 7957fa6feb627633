/* Where evaluations are likely to succeed, learnt from those that did and those that failed. */
#ifndef BAYESOPT_LABEL_H
#define BAYESOPT_LABEL_H

#include <bayesopt/gp.h>

/* Creates a regression of labels 1 (success) and -1 (failure), x [n x d] in [0,1]^d. choose: pick
 * *lengthscale by the likelihood, else take it as given. */
bayesopt_status label_fit(size_t n, size_t d, const bool *categorical, const double *x,
                          const double *label, bool choose, double *lengthscale, bayesopt_gp **gp);

/* Logarithm of the trust in success where the regression's mean is as given, and its derivative. */
double label_log_trust(double mean, double *derivative);

#endif
