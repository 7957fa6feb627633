#include "gp/transform.h"

#include <bayesopt/acquisition.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

void transform_reset(struct transform *transform)
{
    *transform = (struct transform){.kind = BAYESOPT_TRANSFORM_NONE, .unit = 1, .scale = 1};
}

void transform_free(struct transform *transform)
{
    free(transform->knots);
    free(transform->scores);
    transform_reset(transform);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Quantile of sorted data, linear between order statistics. */
static double quantile(size_t n, const double *sorted, double q)
{
    double position = q * (double)(n - 1);
    size_t i = (size_t)position;
    if (i + 1 >= n)
        return sorted[n - 1];
    double share = position - (double)i;
    return (1 - share) * sorted[i] + share * sorted[i + 1];
}

/* Yeo and Johnson, Biometrika 87 (2000) 954, eq. 2.1. */
static double yeo_johnson(double u, double lambda)
{
    if (u >= 0)
        return fabs(lambda) < 1e-8 ? log1p(u) : expm1(lambda * log1p(u)) / lambda;
    double mu = 2 - lambda;
    return fabs(mu) < 1e-8 ? -log1p(-u) : -expm1(mu * log1p(-u)) / mu;
}

static double yeo_johnson_inverse(double v, double lambda)
{
    if (v >= 0) {
        if (fabs(lambda) < 1e-8)
            return expm1(v);
        double inner = lambda * v;
        return inner <= -1 ? INFINITY : expm1(log1p(inner) / lambda);
    }
    double mu = 2 - lambda;
    if (fabs(mu) < 1e-8)
        return -expm1(-v);
    double inner = -mu * v;
    return inner <= -1 ? -INFINITY : -expm1(log1p(inner) / mu);
}

static double log_slope(double u, double lambda)
{
    return (u >= 0 ? lambda - 1 : 1 - lambda) * log1p(fabs(u));
}

/* Normal profile log likelihood of lambda: -n/2 log var + sum log slope. */
static double profile(size_t n, const double *u, double lambda)
{
    double mean = 0, square = 0, slopes = 0;
    for (size_t i = 0; i < n; i++) {
        mean += yeo_johnson(u[i], lambda) / (double)n;
        slopes += log_slope(u[i], lambda);
    }
    for (size_t i = 0; i < n; i++) {
        double deviation = yeo_johnson(u[i], lambda) - mean;
        square += deviation * deviation;
    }
    return square > 0 ? slopes - 0.5 * (double)n * log(square / (double)n) : -INFINITY;
}

/* Golden section over [-2, 2]; the profile is unimodal in practice and any lambda is admissible. */
static double best_lambda(size_t n, const double *u)
{
    const double golden = 0.6180339887498949;
    double a = -2, b = 2, c = b - golden * (b - a), e = a + golden * (b - a);
    double at_c = profile(n, u, c), at_e = profile(n, u, e);
    while (b - a > 1e-3) {
        if (at_c > at_e) {
            b = e, e = c, at_e = at_c;
            c = b - golden * (b - a);
            at_c = profile(n, u, c);
        } else {
            a = c, c = e, at_c = at_e;
            e = a + golden * (b - a);
            at_e = profile(n, u, e);
        }
    }
    return (a + b) / 2;
}

/* Newton's iteration for log Phi(z) = log p, which is concave: from the left of the root, where
 * Phi(z) < exp(-z^2/2)/2 puts the start, it ascends to it. */
double transform_normal_score(double p)
{
    if (p > 0.5)
        return -transform_normal_score(1 - p);
    double z = -sqrt(-2 * log(p));
    for (int i = 0; i < 20; i++)
        z -= (bayesopt_log_cdf(z) - log(p)) / bayesopt_log_cdf_derivative(z);
    return z;
}

static bool estimate_ranks(struct transform *transform, size_t n, const double *sorted)
{
    transform->knots = malloc(n * sizeof(double));
    transform->scores = malloc(n * sizeof(double));
    if (!transform->knots || !transform->scores)
        return false;
    size_t m = 0;
    for (size_t i = 0; i < n;) {
        size_t end = i + 1;
        while (end < n && sorted[end] == sorted[i])
            end++;
        transform->knots[m] = sorted[i];
        transform->scores[m++] = transform_normal_score((double)(i + end) / 2 / (double)n);
        i = end;
    }
    transform->n = m;
    return true;
}

/* Linear between the knots, continued with the mean slope outside. */
static double interpolate(size_t n, const double *from, const double *to, double value)
{
    if (n < 2)
        return n ? to[0] + value - from[0] : value;
    double slope = (to[n - 1] - to[0]) / (from[n - 1] - from[0]);
    if (value <= from[0])
        return to[0] + slope * (value - from[0]);
    if (value >= from[n - 1])
        return to[n - 1] + slope * (value - from[n - 1]);
    size_t low = 0, high = n - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (from[middle] <= value)
            low = middle;
        else
            high = middle;
    }
    return to[low] + (to[high] - to[low]) * ((value - from[low]) / (from[high] - from[low]));
}

static double map(const struct transform *transform, double y)
{
    switch (transform->kind) {
    case BAYESOPT_TRANSFORM_LOG:
        return log(fmax(y - transform->shift, 1e-300));
    case BAYESOPT_TRANSFORM_YEO_JOHNSON:
        return yeo_johnson((y - transform->shift) / transform->unit, transform->lambda);
    case BAYESOPT_TRANSFORM_RANK:
        return interpolate(transform->n, transform->knots, transform->scores, y);
    case BAYESOPT_TRANSFORM_WINSORISED:
        return fmin(y, transform->lambda);
    default:
        return y;
    }
}

static void estimate_map(struct transform *transform, size_t n, const double *sorted,
                         const double *y, double *scratch)
{
    double middle = quantile(n, sorted, 0.5);
    double low = quantile(n, sorted, 0.25), high = quantile(n, sorted, 0.75);
    switch (transform->kind) {
    case BAYESOPT_TRANSFORM_LOG:
        transform->shift = sorted[0] - 0.01 * (middle - sorted[0]);
        if (!(middle > sorted[0]))
            transform->kind = BAYESOPT_TRANSFORM_NONE;
        break;
    case BAYESOPT_TRANSFORM_YEO_JOHNSON:
        transform->shift = middle;
        transform->unit = high > low ? high - low : 1;
        for (size_t i = 0; i < n; i++)
            scratch[i] = (y[i] - transform->shift) / transform->unit;
        transform->lambda = best_lambda(n, scratch);
        break;
    case BAYESOPT_TRANSFORM_WINSORISED:
        transform->lambda = high + 5 * (high - low);
        break;
    default:
        break;
    }
}

/* Mean and standard deviation with the largest magnitude taken out first, so that values near the
 * limits of the format neither overflow nor vanish. */
static void standardise(struct transform *transform, size_t n, const double *values)
{
    double low = values[0], high = values[0];
    for (size_t i = 1; i < n; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    double unit = high / 2 - low / 2, mean = 0, square = 0;
    if (!(unit > 0)) {
        transform->offset = low;
        transform->scale = 1;
        return;
    }
    for (size_t i = 0; i < n; i++)
        mean += (values[i] / 2 - low / 2) / unit / (double)n;
    for (size_t i = 0; i < n; i++) {
        double deviation = (values[i] / 2 - low / 2) / unit - mean;
        square += deviation * deviation;
    }
    transform->offset = low + 2 * (mean * unit);
    transform->scale = fmax(2 * unit * sqrt(square / (double)n), 1e-300);
    if (isinf(transform->scale))
        transform->scale = unit;
}

bool transform_estimate(struct transform *transform, bayesopt_transform kind, size_t n,
                        const double *y)
{
    transform_free(transform);
    double *sorted = malloc(2 * (n ? n : 1) * sizeof *sorted);
    if (!sorted)
        return false;
    double *values = sorted + n;
    memcpy(sorted, y, n * sizeof *sorted);
    qsort(sorted, n, sizeof *sorted, compare);
    transform->kind = n > 2 && kind != BAYESOPT_TRANSFORM_AUTO ? kind : BAYESOPT_TRANSFORM_NONE;
    bool ok = true;
    if (transform->kind == BAYESOPT_TRANSFORM_RANK)
        ok = estimate_ranks(transform, n, sorted);
    else if (n)
        estimate_map(transform, n, sorted, y, values);
    for (size_t i = 0; i < n && ok; i++)
        values[i] = map(transform, y[i]);
    if (n && ok)
        standardise(transform, n, values);
    free(sorted);
    return ok;
}

double transform_apply(const struct transform *transform, double y)
{
    double value = map(transform, y);
    /* Halves: the difference of two values of opposite sign near the limits stays finite. */
    return 2 * ((value / 2 - transform->offset / 2) / transform->scale);
}

double transform_invert(const struct transform *transform, double value)
{
    double mapped = transform->offset + transform->scale * value;
    switch (transform->kind) {
    case BAYESOPT_TRANSFORM_LOG:
        return transform->shift + exp(mapped);
    case BAYESOPT_TRANSFORM_YEO_JOHNSON:
        return transform->shift + transform->unit * yeo_johnson_inverse(mapped, transform->lambda);
    case BAYESOPT_TRANSFORM_RANK:
        return interpolate(transform->n, transform->scores, transform->knots, mapped);
    default:
        return mapped;
    }
}

double transform_slope(const struct transform *transform, double y)
{
    double slope = 1;
    switch (transform->kind) {
    case BAYESOPT_TRANSFORM_LOG:
        slope = 1 / fmax(y - transform->shift, 1e-300);
        break;
    case BAYESOPT_TRANSFORM_YEO_JOHNSON:
        slope = exp(log_slope((y - transform->shift) / transform->unit, transform->lambda)) /
                transform->unit;
        break;
    case BAYESOPT_TRANSFORM_RANK:
        if (transform->n > 1)
            slope = (transform->scores[transform->n - 1] - transform->scores[0]) /
                    (transform->knots[transform->n - 1] - transform->knots[0]);
        break;
    case BAYESOPT_TRANSFORM_WINSORISED:
        slope = y <= transform->lambda;
        break;
    default:
        break;
    }
    return slope / transform->scale;
}
