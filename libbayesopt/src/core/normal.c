/* The normal distribution's logarithms and the acquisition functions made of them. */
#include <bayesopt/acquisition.h>

#include <math.h>

static const double log_sqrt_2pi = 0.91893853320467274178;
static const double sqrt_half = 0.70710678118654752440;

static double density(double z)
{
    return exp(-z * z / 2 - log_sqrt_2pi);
}

static double distribution(double z)
{
    return erfc(-z * sqrt_half) / 2;
}

/* Laplace's continued fraction of Mills' ratio is Phi(-x)/phi(x) = 1/(x + c), c = 1/(x + 2/(x +
 * 3/...)). Keeping c apart gives h(-x)/phi(x) = 1 - x/(x + c) = c/(x + c) without the cancellation.
 * So many terms reach full double precision for all x >= 2. */
static double mills_tail(double x)
{
    int terms = 12 + (int)(420 / (x * x));
    double c = 0;
    for (int k = terms; k >= 1; k--)
        c = k / (x + c);
    return c;
}

double bayesopt_log_h(double z)
{
    if (z > -2)
        return log(density(z) + z * distribution(z));
    double c = mills_tail(-z);
    return -z * z / 2 - log_sqrt_2pi + log(c / (c - z));
}

double bayesopt_log_h_derivative(double z)
{
    if (z > -2)
        return distribution(z) / (density(z) + z * distribution(z));
    return 1 / mills_tail(-z);
}

double bayesopt_log_cdf(double z)
{
    if (z >= 0)
        return log1p(-erfc(z * sqrt_half) / 2);
    if (z > -2)
        return log(distribution(z));
    return -z * z / 2 - log_sqrt_2pi - log(mills_tail(-z) - z);
}

double bayesopt_log_cdf_derivative(double z)
{
    if (z > -2)
        return density(z) / distribution(z);
    return mills_tail(-z) - z;
}

/* log(Phi(b) - Phi(a)) and the ratios phi(a), phi(b) over that difference; a < b. */
static double interval(double a, double b, double *at_a, double *at_b)
{
    if (a > 0) /* the left tail keeps its digits */
        return interval(-b, -a, at_b, at_a);
    if (b > 0) {
        double outside =
            (a == -INFINITY ? 0 : distribution(a)) + (b == INFINITY ? 0 : distribution(-b));
        *at_a = density(a) / (1 - outside);
        *at_b = density(b) / (1 - outside);
        return log1p(-outside);
    }
    double upper = bayesopt_log_cdf(b);
    *at_b = bayesopt_log_cdf_derivative(b);
    *at_a = 0;
    if (a == -INFINITY)
        return upper;
    double drop = bayesopt_log_cdf(a) - upper; /* log(Phi(a)/Phi(b)) */
    double share = -expm1(drop);
    *at_b /= share;
    *at_a = bayesopt_log_cdf_derivative(a) * exp(drop) / share;
    return upper + (drop > -0.6931471805599453 ? log(share) : log1p(-exp(drop)));
}

double bayesopt_log_interval(double a, double b)
{
    double at_a, at_b;
    if (!(a < b))
        return a >= b ? -INFINITY : NAN;
    return interval(a, b, &at_a, &at_b);
}

double bayesopt_log_ei(double mean, double sd, double best, double *dmean, double *dsd)
{
    if (!(sd > 0)) {
        double gain = best - mean;
        if (dmean)
            *dmean = gain > 0 ? -1 / gain : 0;
        if (dsd)
            *dsd = 0;
        return gain > 0 ? log(gain) : -INFINITY;
    }
    double z = (best - mean) / sd;
    double slope = bayesopt_log_h_derivative(z);
    if (dmean)
        *dmean = -slope / sd;
    if (dsd) /* phi/h = 1 - z Phi/h, a sum of positive terms in the tail */
        *dsd = (z > -2 ? density(z) / (density(z) + z * distribution(z)) : 1 - z * slope) / sd;
    return log(sd) + bayesopt_log_h(z);
}

double bayesopt_ei(double mean, double sd, double best)
{
    double logarithm = bayesopt_log_ei(mean, sd, best, NULL, NULL);
    return exp(logarithm);
}

double bayesopt_log_feasibility(double mean, double sd, double lower, double upper, double *dmean,
                                double *dsd)
{
    if (!(sd > 0)) {
        if (dmean)
            *dmean = 0;
        if (dsd)
            *dsd = 0;
        return mean >= lower && mean <= upper ? 0 : -INFINITY;
    }
    double a = (lower - mean) / sd, b = (upper - mean) / sd;
    double at_a, at_b;
    if (!(a < b))
        return bayesopt_log_feasibility(mean, 0, lower, upper, dmean, dsd);
    double value = interval(a, b, &at_a, &at_b);
    if (dmean)
        *dmean = (at_a - at_b) / sd;
    if (dsd)
        *dsd = ((isinf(a) ? 0 : a * at_a) - (isinf(b) ? 0 : b * at_b)) / sd;
    return value;
}

double bayesopt_lcb(double mean, double sd, double k)
{
    return mean - k * sd;
}
