#include "core/random.h"

#include "core/constants.h"

#include <math.h>

uint64_t random_hash(uint64_t bits)
{
    bits += UINT64_C(0x9E3779B97F4A7C15);
    bits = (bits ^ (bits >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
    bits = (bits ^ (bits >> 27)) * UINT64_C(0x94D049BB133111EB);
    return bits ^ (bits >> 31);
}

void random_start(struct random_stream *stream, uint64_t seed, uint64_t purpose, uint64_t index)
{
    uint64_t key = random_hash(random_hash(random_hash(seed) ^ purpose) ^ index);
    for (int i = 0; i < 4; i++)
        stream->state[i] = key = random_hash(key);
}

static uint64_t rotate(uint64_t bits, int by)
{
    return (bits << by) | (bits >> (64 - by));
}

/* xoshiro256++, Blackman and Vigna, ACM TOMS 47 (2021) 36. */
uint64_t random_bits(struct random_stream *stream)
{
    uint64_t *s = stream->state;
    uint64_t result = rotate(s[0] + s[3], 23) + s[0];
    uint64_t shifted = s[1] << 17;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= shifted;
    s[3] = rotate(s[3], 45);
    return result;
}

double random_uniform(struct random_stream *stream)
{
    return ((double)(random_bits(stream) >> 11) + 0.5) * 0x1p-53;
}

double random_normal(struct random_stream *stream)
{
    /* Box and Muller; the sine half is thrown away to keep the stream without memory. */
    double radius = sqrt(-2 * log(random_uniform(stream)));
    return radius * cos(2 * PI * random_uniform(stream));
}

size_t random_below(struct random_stream *stream, size_t n)
{
    size_t i = (size_t)(random_uniform(stream) * (double)n);
    return i < n ? i : n - 1;
}

void random_permutation(struct random_stream *stream, size_t n, size_t *permutation)
{
    for (size_t i = 0; i < n; i++)
        permutation[i] = i;
    for (size_t i = n; i-- > 1;) {
        size_t k = random_below(stream, i + 1), kept = permutation[i];
        permutation[i] = permutation[k];
        permutation[k] = kept;
    }
}
