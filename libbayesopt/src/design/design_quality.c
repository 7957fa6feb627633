/* How well a design fills the box. */
#include "core/error.h"
#include "design/design_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Hickernell, Math. Comp. 67 (1998) 299, eq. 5.1b. */
static double centred_discrepancy(size_t n, size_t d, const double *x)
{
    double single = 0, pairs = 0, count = (double)n;
    for (size_t i = 0; i < n; i++) {
        double product = 1;
        for (size_t j = 0; j < d; j++) {
            double a = fabs(x[i * d + j] - 0.5);
            product *= 1 + 0.5 * a - 0.5 * a * a;
        }
        single += product;
        for (size_t k = 0; k < n; k++) {
            product = 1;
            for (size_t j = 0; j < d; j++) {
                double u = x[i * d + j], v = x[k * d + j];
                product *= 1 + 0.5 * fabs(u - 0.5) + 0.5 * fabs(v - 0.5) - 0.5 * fabs(u - v);
            }
            pairs += product;
        }
    }
    return sqrt(fmax(pow(13.0 / 12, (double)d) - 2 * single / count + pairs / (count * count), 0));
}

static double occupied_share(size_t n, size_t d, const double *x, unsigned char *seen)
{
    size_t occupied = 0;
    for (size_t j = 0; j < d; j++) {
        memset(seen, 0, n);
        for (size_t i = 0; i < n; i++) {
            size_t bin = (size_t)(x[i * d + j] * (double)n);
            seen[bin < n ? bin : n - 1] = 1;
        }
        for (size_t i = 0; i < n; i++)
            occupied += seen[i];
    }
    return (double)occupied / (double)(n * d);
}

bayesopt_status bayesopt_design_measure(size_t n, size_t d, const double *x,
                                        bayesopt_design_quality *quality)
{
    NEED(x);
    NEED(quality);
    if (!n || !d || n > BAYESOPT_MOST_POINTS || d > BAYESOPT_MOST_VARIABLES)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "design of %zu points in %zu variables: expected 1 to %d and 1 to %d",
                             n, d, BAYESOPT_MOST_POINTS, BAYESOPT_MOST_VARIABLES);
    for (size_t i = 0; i < n * d; i++)
        if (!(x[i] >= 0 && x[i] <= 1))
            return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                                 "design: variable %zu of point %zu is %g, expected 0 to 1", i % d,
                                 i / d, x[i]);
    unsigned char *seen = malloc(n ? n : 1);
    if (!seen)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "design: out of memory");
    double least = INFINITY, energy = 0, high = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < i; k++) {
            double d2 = design_distance2(d, x + i * d, x + k * d);
            least = fmin(least, d2);
            energy += 1 / d2;
        }
    /* The largest term is taken out of the sum so that the 50th power cannot overflow. */
    for (size_t i = 0; i < n && least > 0; i++)
        for (size_t k = 0; k < i; k++)
            high += pow(least / design_distance2(d, x + i * d, x + k * d), 25);
    *quality = (bayesopt_design_quality){
        .audze_eglais = energy,
        .min_distance = sqrt(least),
        .phi_p = least > 0 ? pow(high, 0.02) / sqrt(least) : INFINITY,
        .discrepancy = centred_discrepancy(n, d, x),
        .occupied = occupied_share(n, d, x, seen),
    };
    free(seen);
    return BAYESOPT_OK;
}
