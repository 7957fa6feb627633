/* Public test functions of global optimisation, on the unit box, and the Latin hypercubes that the
 * peers' figures in tests/data/bayesopt_peer_regret.csv started from. */
#ifndef BAYESOPT_FUNCTIONS_H
#define BAYESOPT_FUNCTIONS_H

#include <stddef.h>

struct test_function {
    const char *name;
    size_t d, n_init, n_total;
    double minimum;
    double (*value)(size_t d, const double *u);
    double check; /* value at (0.3, ..., 0.3) */
};

extern const struct test_function test_functions[];
extern const size_t n_test_functions;

/* Others, on which NLopt's methods run along. */
extern const struct test_function held_out_functions[];
extern const size_t n_held_out_functions;

/* Rugged or narrow ones. */
extern const struct test_function stated_functions[];
extern const size_t n_stated_functions;

/* Levy's function over a box from `low` to low + 20 in every direction. */
double levy_from(double low, size_t d, const double *u);

/* u [n x d] filled; splitmix64 and Fisher-Yates as the peers' runs did. */
void peer_latin_hypercube(unsigned seed, size_t n, size_t d, double *u);

#endif
