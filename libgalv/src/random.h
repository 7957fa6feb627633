/* Counter-based streams: the generator for item `index` of the run `seed` is made from both numbers
 * and nothing else, so that any thread may produce any item. */
#ifndef GALV_RANDOM_H
#define GALV_RANDOM_H

#include <stdint.h>

/* xoshiro256** 1.0 of Blackman and Vigna, ACM TOMS 47 (2021). */
typedef struct galv_random {
    uint64_t state[4];
} galv_random;

void galv_random_start(galv_random *random, uint64_t seed, uint64_t index);
uint64_t galv_random_bits(galv_random *random);
/* Uniform on [0, 1), a multiple of 2^-53. */
double galv_random_uniform(galv_random *random);
/* Standard normal, by the polar method. */
double galv_random_normal(galv_random *random);

#endif
