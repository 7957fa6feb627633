/* Where latent points lie with respect to the samples. */
#include "error.h"
#include "model.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Linear interpolation between order statistics. */
static double quantile(size_t n, const double *sorted, double q)
{
    double place = q * (double)(n - 1);
    size_t k = (size_t)place;
    if (k + 1 >= n)
        return sorted[n - 1];
    return sorted[k] + (place - (double)k) * (sorted[k + 1] - sorted[k]);
}

static galv_status check_coverage(double coverage)
{
    if (coverage > 0 && coverage <= 1)
        return GALV_OK;
    return galv_fail(GALV_ERROR_ARGUMENT, "coverage %g, expected more than 0, at most 1", coverage);
}

galv_status galv_latent_bounds(const galv_model *model, double coverage, double *lower,
                               double *upper)
{
    if (!model || !lower || !upper)
        return galv_fail(GALV_ERROR_ARGUMENT, "model and bounds must be given");
    galv_status status = check_coverage(coverage);
    if (status)
        return status;
    size_t n = model->samples, m = model->modes;
    double *sorted = malloc(n * sizeof *sorted);
    if (!sorted)
        return galv_fail(GALV_ERROR_MEMORY, "quantiles of %zu samples", n);
    for (size_t k = 0; k < m; k++) {
        for (size_t r = 0; r < n; r++)
            sorted[r] = model->latent[r * m + k];
        qsort(sorted, n, sizeof *sorted, ascending);
        lower[k] = quantile(n, sorted, (1 - coverage) / 2);
        upper[k] = quantile(n, sorted, (1 + coverage) / 2);
    }
    free(sorted);
    return GALV_OK;
}

/* sum (u_k - v_k)^2 / lambda_k; v NULL: the origin. */
static double square_distance(const galv_model *model, const double *u, const double *v)
{
    double sum = 0;
    for (size_t k = 0; k < model->modes; k++) {
        double difference = u[k] - (v ? v[k] : 0);
        sum += difference * difference / model->eigenvalues[k];
    }
    return sum;
}

galv_status galv_latent_ellipsoid(const galv_model *model, double coverage, double *radius)
{
    if (!model || !radius)
        return galv_fail(GALV_ERROR_ARGUMENT, "model and radius must be given");
    galv_status status = check_coverage(coverage);
    if (status)
        return status;
    double *sorted = malloc(model->samples * sizeof *sorted);
    if (!sorted)
        return galv_fail(GALV_ERROR_MEMORY, "radii of %zu samples", model->samples);
    for (size_t r = 0; r < model->samples; r++)
        sorted[r] = sqrt(square_distance(model, model->latent + r * model->modes, NULL));
    qsort(sorted, model->samples, sizeof *sorted, ascending);
    *radius = quantile(model->samples, sorted, coverage);
    free(sorted);
    return GALV_OK;
}

galv_status galv_latent_distance(const galv_model *model, const double *u, double *radius,
                                 double *nearest)
{
    if (!model || !u)
        return galv_fail(GALV_ERROR_ARGUMENT, "model and latent point must be given");
    for (size_t k = 0; k < model->modes; k++)
        if (!isfinite(u[k]))
            return galv_fail(GALV_ERROR_ARGUMENT, "latent coordinate %zu is %g", k, u[k]);
    if (radius)
        *radius = sqrt(square_distance(model, u, NULL));
    if (nearest) {
        double least = INFINITY;
        for (size_t r = 0; r < model->samples; r++)
            least = fmin(least, square_distance(model, u, model->latent + r * model->modes));
        *nearest = sqrt(least);
    }
    if ((radius && !isfinite(*radius)) || (nearest && model->samples && !isfinite(*nearest)))
        return galv_fail(GALV_ERROR_NUMERIC, "a distance in the latent space overflows");
    return GALV_OK;
}
