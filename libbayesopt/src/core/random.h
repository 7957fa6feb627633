/* Counter-free random streams: a stream is named by the run's seed and two numbers (what it is for,
 * which proposal), so what a proposal draws does not depend on what was drawn before it. */
#ifndef BAYESOPT_RANDOM_H
#define BAYESOPT_RANDOM_H

#include <stddef.h>
#include <stdint.h>

struct random_stream {
    uint64_t state[4];
};

/* Purposes of streams. */
enum {
    STREAM_DESIGN = 1,
    STREAM_ANNEAL,
    STREAM_SCRAMBLE,
    STREAM_REPAIR,
    STREAM_TEACH,
    STREAM_FIT,
    STREAM_SEARCH,
    STREAM_STRATEGY
};

void random_start(struct random_stream *stream, uint64_t seed, uint64_t purpose, uint64_t index);
uint64_t random_bits(struct random_stream *stream);
/* Uniform in (0,1). */
double random_uniform(struct random_stream *stream);
double random_normal(struct random_stream *stream);
/* Uniform in 0..n-1, n > 0. */
size_t random_below(struct random_stream *stream, size_t n);
/* A permutation of 0..n-1 (Fisher-Yates). */
void random_permutation(struct random_stream *stream, size_t n, size_t *permutation);
/* The finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014): a good hash of 64 bits. */
uint64_t random_hash(uint64_t bits);

#endif
