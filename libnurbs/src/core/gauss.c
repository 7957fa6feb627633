#include "core/error.h"

#include <nurbs/basis.h>

#include <math.h>

/* P_n and its derivative at x by the three-term recurrence, in long double so that the rounded
 * nodes and weights are good to the last digit. */
static long double legendre(size_t n, long double x, long double *derivative)
{
    long double previous = 1.0L, current = x;
    for (size_t k = 2; k <= n; k++) {
        const long double next =
            ((long double)(2 * k - 1) * x * current - (long double)(k - 1) * previous) /
            (long double)k;
        previous = current;
        current = next;
    }
    *derivative = (long double)n * (previous - x * current) / (1.0L - x * x);
    return current;
}

nurbs_status nurbs_gauss_legendre(size_t n, double *nodes, double *weights)
{
    if (n < 1 || n > 64)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "Gauss rule of %zu points, expected 1 to 64", n);
    if (!nodes || !weights)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL, expected an array of %zu",
                          nodes ? "weights" : "nodes", n);
    const long double pi = 3.141592653589793238462643383279502884L;
    for (size_t i = 0; i < (n + 1) / 2; i++) {
        /* Newton from Tricomi's estimate of the i-th largest root (Abramowitz and Stegun 22.16.6);
         * it converges quadratically, five steps reach long double for n <= 64. */
        long double x = n % 2 == 1 && i == n / 2
                            ? 0.0L
                            : cosl(pi * ((long double)i + 0.75L) / ((long double)n + 0.5L));
        long double slope = 1.0L;
        for (int step = 0; step < 6; step++)
            x -= legendre(n, x, &slope) / slope;
        legendre(n, x, &slope);
        const long double weight = 1.0L / ((1.0L - x * x) * slope * slope);
        nodes[i] = (double)(0.5L * (1.0L - x));
        nodes[n - 1 - i] = (double)(0.5L * (1.0L + x));
        weights[i] = weights[n - 1 - i] = (double)weight;
    }
    return NURBS_OK;
}
