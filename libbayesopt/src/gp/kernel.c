#include "gp/kernel.h"

#include "core/clones.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* exp(-s) for s >= 0 to about one unit in the last place, without branches so that loops over it
 * vectorise: 2^k by the exponent field, the rest by Taylor's series on |r| <= log(2)/2. */
static inline double exp_negative(double s)
{
    const double shifter = 0x1.8p52, log2e = 1.4426950408889634074;
    const double ln2_high = 0x1.62e42fefa3800p-1, ln2_low = 0x1.ef35793c76730p-45;
    double x = s > 230.0 ? -230.0 : -s;
    double shifted = x * log2e + shifter, k = shifted - shifter;
    double r = (x - k * ln2_high) - k * ln2_low;
    double p = 1.0 / 6227020800.0;
    p = p * r + 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = p * r + 1.0;
    p = p * r + 1.0;
    int64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (int64_t)((uint64_t)(bits + 1023) << 52);
    double power;
    memcpy(&power, &bits, sizeof power);
    /* 1e-100 and less is nothing beside 1, and its products would be subnormal: slow. */
    return s > 230.0 ? 0 : p * power;
}

BAYESOPT_CLONES
static void squared_exponential(size_t n, const double *r2, double *g)
{
    for (size_t k = 0; k < n; k++)
        g[k] = exp_negative(r2[k] / 2);
}

BAYESOPT_CLONES
static void matern32(size_t n, const double *r2, double *g, double *w)
{
    for (size_t k = 0; k < n; k++) {
        double s = sqrt(3 * r2[k]), e = exp_negative(s);
        g[k] = (1 + s) * e;
        w[k] = 3 * e;
    }
}

BAYESOPT_CLONES
static void matern52(size_t n, const double *r2, double *g, double *w)
{
    for (size_t k = 0; k < n; k++) {
        double s = sqrt(5 * r2[k]), e = exp_negative(s);
        g[k] = (1 + s + s * s / 3) * e;
        w[k] = 5.0 / 3 * (1 + s) * e;
    }
}

void kernel_values(bayesopt_kernel kernel, size_t n, const double *r2, double *g, double *w)
{
    double unused[64];
    size_t block = w ? n : 64;
    for (size_t k = 0; k < n; k += block) {
        size_t m = n - k < block ? n - k : block;
        double *slope = w ? w + k : unused;
        if (kernel == BAYESOPT_KERNEL_SE) {
            squared_exponential(m, r2 + k, g + k);
            if (w)
                memcpy(slope, g + k, m * sizeof *slope);
        } else if (kernel == BAYESOPT_KERNEL_MATERN32) {
            matern32(m, r2 + k, g + k, slope);
        } else {
            matern52(m, r2 + k, g + k, slope);
        }
    }
}

/* Codes of categories are computed alike wherever they come from, but for rounding. */
static const double same_category = 1e-9;

BAYESOPT_CLONES
void kernel_distances(size_t n, size_t d, const double *columns, size_t ld, const double *point,
                      const double *jump, double *restrict r2)
{
    memset(r2, 0, n * sizeof *r2);
    for (size_t j = 0; j < d; j++) {
        const double *column = columns + j * ld;
        double at = point[j];
        for (size_t k = 0; k < n && jump && jump[j] > 0; k++)
            r2[k] += fabs(column[k] - at) > same_category ? jump[j] : 0;
        if (jump && jump[j] > 0)
            continue;
        for (size_t k = 0; k < n; k++) {
            double difference = column[k] - at;
            r2[k] += difference * difference;
        }
    }
}

BAYESOPT_CLONES
void kernel_weighted_squares(size_t n, size_t d, const double *columns, size_t ld,
                             const double *point, const double *jump, const double *weight,
                             double *sum)
{
    for (size_t j = 0; j < d; j++) {
        const double *column = columns + j * ld;
        double at = point[j], total = 0;
        if (jump && jump[j] > 0) {
            for (size_t k = 0; k < n; k++)
                total += fabs(column[k] - at) > same_category ? weight[k] * jump[j] : 0;
            sum[j] += total;
            continue;
        }
#pragma omp simd reduction(+ : total)
        for (size_t k = 0; k < n; k++) {
            double difference = column[k] - at;
            total += weight[k] * (difference * difference);
        }
        sum[j] += total;
    }
}
