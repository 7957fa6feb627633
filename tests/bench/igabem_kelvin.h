/* What the programs on the Kelvin Green function share. */
#ifndef IGABEM_BENCH_KELVIN_H
#define IGABEM_BENCH_KELVIN_H

/* Errors of N (relative), grad N (of max(|grad N|, 1/R^2)), W (of max(1, |W|)) and grad W (of
 * max(1, |grad W|)) against the oracle at P, Y > 0, Z < 0. */
void kelvin_errors(const double P[3], double error[4]);

/* A map of these errors as SVG on standard output. */
void print_map(void);

#endif
