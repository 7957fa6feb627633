#include "problem/label.h"

#include <bayesopt/acquisition.h>

#include <math.h>

/* The regression interpolates the labels (a simulation that failed fails again) and expects success
 * where nothing is known. A classifier that averages over its uncertainty leaves a failing region a
 * chance of some per cent however often it was tried, and the improvement promised there outweighs
 * that; so the trust falls steeply with the mean alone, on the successful side of the middle. */
static const double label_noise = 1e-3, expected_label = 1, threshold = 0.5, width = 0.1;

bayesopt_status label_fit(size_t n, size_t d, const bool *categorical, const double *x,
                          const double *label, bool choose, double *lengthscale, bayesopt_gp **gp)
{
    /* Not shorter than a fifth of the box's diagonal: failures close to successes, as a boundary
     * has them, would else make every point an island. */
    static const double candidates[] = {0.2, 0.3, 0.45, 0.7, 1};
    bayesopt_gp_options options;
    double scales[BAYESOPT_MOST_VARIABLES], most = -INFINITY;
    bayesopt_gp_options_init(&options);
    options.kernel = BAYESOPT_KERNEL_MATERN32;
    options.mean = BAYESOPT_MEAN_FIXED;
    options.categorical = categorical;
    bayesopt_status status = bayesopt_gp_create(d, &options, gp);
    if (!status)
        status = bayesopt_gp_set_data(*gp, n, x, label, NULL);
    bayesopt_gp_parameters parameters = {
        .lengthscale = scales, .signal = 1, .noise = label_noise, .mean = expected_label};
    size_t count = choose ? sizeof candidates / sizeof *candidates : 0;
    for (size_t c = 0; c <= count && !status; c++) {
        double scale = c < count ? candidates[c] * sqrt((double)d) : *lengthscale, value;
        for (size_t j = 0; j < d; j++)
            scales[j] = scale;
        status = bayesopt_gp_set_parameters(*gp, &parameters);
        if (!status && c < count)
            status = bayesopt_gp_log_likelihood(*gp, &value, NULL);
        if (!status && c < count && value > most) {
            most = value;
            *lengthscale = scale;
        }
    }
    if (status) {
        bayesopt_gp_free(*gp);
        *gp = NULL;
    }
    return status;
}

double label_log_trust(double mean, double *derivative)
{
    *derivative = bayesopt_log_cdf_derivative((mean - threshold) / width) / width;
    return bayesopt_log_cdf((mean - threshold) / width);
}
