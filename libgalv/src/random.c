#include "random.h"

#include <galv/model.h>

#include <math.h>

/* splitmix64 of Steele, Lea and Flood, OOPSLA 2014: the recommended filler of xoshiro's state. */
static uint64_t splitmix(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
    return z ^ z >> 31;
}

void galv_random_start(galv_random *random, uint64_t seed, uint64_t index)
{
    /* Hashing the index separately keeps (seed, index) and (seed + 1, index - 1) apart. */
    uint64_t item = index, state = splitmix(&seed) ^ splitmix(&item) * UINT64_C(0xd1342543de82ef95);
    for (int i = 0; i < 4; i++)
        random->state[i] = splitmix(&state);
}

static uint64_t rotate(uint64_t x, int bits)
{
    return x << bits | x >> (64 - bits);
}

uint64_t galv_random_bits(galv_random *random)
{
    uint64_t *s = random->state, result = rotate(s[1] * 5, 7) * 9, t = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= t;
    s[3] = rotate(s[3], 45);
    return result;
}

double galv_random_uniform(galv_random *random)
{
    return (double)(galv_random_bits(random) >> 11) * 0x1p-53;
}

double galv_random_normal(galv_random *random)
{
    for (;;) {
        double a = 2 * galv_random_uniform(random) - 1, b = 2 * galv_random_uniform(random) - 1;
        double s = a * a + b * b;
        if (s > 0 && s < 1)
            return a * sqrt(-2 * log(s) / s);
    }
}

galv_sampling galv_uniform(size_t count, uint64_t seed)
{
    return (galv_sampling){.count = count, .first = 0, .seed = seed, .x = NULL};
}

galv_sampling galv_samples(size_t count, const double *x)
{
    return (galv_sampling){.count = x ? count : 0, .first = 0, .seed = 0, .x = x};
}

void galv_uniform_sample(uint64_t seed, size_t index, size_t n, const double *lower,
                         const double *upper, double *x)
{
    galv_random random;
    if (!lower || !upper || !x)
        return;
    galv_random_start(&random, seed, index);
    for (size_t i = 0; i < n; i++) {
        double t = galv_random_uniform(&random);
        x[i] = (1 - t) * lower[i] + t * upper[i];
    }
}
