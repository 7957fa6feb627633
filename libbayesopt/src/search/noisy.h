/* Expected improvement when the evaluated points are known with noise only: its expectation over
 * what their true values may be. Letham, Karrer, Ottoni, Bakshy, Bayesian Analysis 14 (2019) 495.
 */
#ifndef BAYESOPT_NOISY_H
#define BAYESOPT_NOISY_H

#include <bayesopt/gp.h>

#include <stdbool.h>
#include <stddef.h>

struct noisy;

/* Draws true values at the data of a conditioned regression; eligible [n] marks the points whose
 * value counts as the one to improve on, at least one. */
bayesopt_status noisy_create(const bayesopt_gp *gp, const bool *eligible, uint64_t seed,
                             struct noisy **noisy);
void noisy_free(struct noisy *noisy);

/* Log noisy expected improvement at x, modelled units; gradient [d] filled unless NULL. work [2 n].
 * -INFINITY on failure. */
double noisy_log_ei(struct noisy *noisy, const double *x, double *gradient, double *work);

#endif
