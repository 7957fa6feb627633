/* Designs of a run, evaluated for whoever asks: workers in threads, each with a problem of its own,
 * because a problem builds one design at a time. */
#ifndef HULLOPT_DESIGNS_H
#define HULLOPT_DESIGNS_H

#include "serve/variant.h"

struct designs;

/* Starts n workers, each with as many threads for its solver. Borrows the configuration. NULL with
 * core_sentence() when the problem cannot be read. */
struct designs *designs_start(const struct config *config, size_t n, int threads);
/* Abandons what is being evaluated; what waits is refused. Then designs_free(). */
void designs_stop(struct designs *designs);
void designs_free(struct designs *designs);

/* That of one worker, as far as no evaluation changes it: grid and latent space. */
const struct problem *designs_problem(const struct designs *designs);
/* Latent variables and their box. */
size_t designs_modes(const struct designs *designs);
const double *designs_lower(const struct designs *designs);
const double *designs_upper(const struct designs *designs);

/* Whether C_w of the run's own formulation has derivatives by the latent variables. */
bool designs_have_derivatives(const struct designs *designs);

/* Waits for a worker and for what it says of the design at u. From any thread. */
bool designs_evaluate(struct designs *designs, const double *u, const struct variant *variant,
                      double *output, struct served_error *error);
/* The same for the derivatives of C_w at each speed of the variant by each latent variable: fills
 * jacobian [speeds][modes]. */
bool designs_differentiate(struct designs *designs, const double *u, const struct variant *variant,
                           double *jacobian, struct served_error *error);

#endif
