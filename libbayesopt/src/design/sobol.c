/* Sobol's sequence with Owen's nested uniform scrambling.
 *
 * Any primitive polynomials and odd initial direction numbers m_k < 2^k give a (t,s)-sequence
 * (Sobol, USSR Comput. Math. Math. Phys. 7 (1967) 86). The polynomials are enumerated here; the
 * first initial numbers are those of Joe and Kuo, SIAM J. Sci. Comput. 30 (2008) 2635, later ones
 * are drawn. */
#include "design/design_internal.h"

#include <stdlib.h>

enum { BITS = 32, LISTED = 20, MOST_DEGREE = 7 };

static const unsigned char initial[LISTED][MOST_DEGREE] = {
    {1},
    {1, 3},
    {1, 3, 1},
    {1, 1, 1},
    {1, 1, 3, 3},
    {1, 3, 5, 13},
    {1, 1, 5, 5, 17},
    {1, 1, 5, 5, 5},
    {1, 1, 7, 11, 19},
    {1, 1, 5, 1, 1},
    {1, 1, 1, 3, 11},
    {1, 3, 5, 5, 31},
    {1, 3, 3, 9, 7, 49},
    {1, 1, 1, 15, 21, 21},
    {1, 3, 1, 13, 27, 49},
    {1, 1, 1, 15, 7, 5},
    {1, 3, 1, 15, 13, 25},
    {1, 1, 5, 5, 19, 61},
    {1, 3, 7, 11, 23, 15, 103},
    {1, 3, 7, 13, 13, 15, 69},
};

/* x generates the multiplicative group modulo the polynomial: its order is 2^degree - 1. */
static bool primitive(uint32_t polynomial, unsigned degree)
{
    uint32_t top = UINT32_C(1) << degree, power = 1, order = 0;
    do {
        power <<= 1;
        if (power & top)
            power ^= polynomial;
        order++;
    } while (power != 1 && order < top);
    return order == top - 1;
}

/* The primitive polynomial after this one, by degree and then by value. */
static uint32_t next_polynomial(uint32_t polynomial, unsigned *degree)
{
    for (;;) {
        polynomial += 2;
        if (polynomial >> (*degree + 1)) {
            ++*degree;
            polynomial = (UINT32_C(1) << *degree) + 1;
        }
        if (primitive(polynomial, *degree))
            return polynomial;
    }
}

/* Direction numbers of dimension j >= 1 as binary fractions with BITS digits. */
static void directions(size_t j, uint32_t polynomial, unsigned degree, uint32_t *v)
{
    for (unsigned k = 0; k < BITS; k++) {
        if (k < degree) {
            uint32_t m = 1;
            if (j <= LISTED)
                m = initial[j - 1][k];
            else if (k)
                m = (uint32_t)(random_hash(j * 64 + k) & ((UINT32_C(2) << k) - 1)) | 1;
            v[k] = m << (BITS - 1 - k);
            continue;
        }
        v[k] = v[k - degree] ^ (v[k - degree] >> degree);
        for (unsigned i = 1; i < degree; i++)
            if (polynomial >> (degree - i) & 1)
                v[k] ^= v[k - i];
    }
}

/* Digit b is flipped by a random bit that belongs to the digits before it. Owen, 1995. */
static uint32_t scramble(uint32_t digits, uint64_t key)
{
    uint32_t result = 0;
    for (unsigned b = 0; b < BITS; b++) {
        uint64_t prefix = b ? digits >> (BITS - b) : 0;
        uint32_t flip =
            (uint32_t)(random_hash(key ^ random_hash(prefix + ((uint64_t)b << 40))) & 1);
        uint32_t digit = digits >> (BITS - 1 - b) & 1;
        result |= (digit ^ flip) << (BITS - 1 - b);
    }
    return result;
}

bool design_sobol(size_t n, size_t d, uint64_t seed, double *x)
{
    struct random_stream stream;
    uint32_t v[BITS], polynomial = 3;
    unsigned degree = 1;
    random_start(&stream, seed, STREAM_SCRAMBLE, 0);
    for (size_t j = 0; j < d; j++) {
        if (j == 0)
            for (unsigned k = 0; k < BITS; k++)
                v[k] = UINT32_C(1) << (BITS - 1 - k);
        else
            directions(j, polynomial, degree, v);
        if (j)
            polynomial = next_polynomial(polynomial, &degree);
        uint64_t key = random_bits(&stream);
        for (size_t i = 0; i < n; i++) {
            uint32_t digits = 0;
            size_t gray = i ^ (i >> 1);
            for (unsigned k = 0; gray >> k && k < BITS; k++)
                if (gray >> k & 1)
                    digits ^= v[k];
            x[i * d + j] = ((double)scramble(digits, key) + random_uniform(&stream)) * 0x1p-32;
        }
    }
    return true;
}
