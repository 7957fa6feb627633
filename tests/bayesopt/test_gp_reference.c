/* Every quantity of the regression against 70-digit values, within the accuracy that the condition
 * number leaves to double precision. */
#include "check.h"

#include <bayesopt/acquisition.h>
#include <bayesopt/gp.h>

#include <stdbool.h>
#include <string.h>

enum { MOST_POINTS = 64, MOST_VARIABLES = 8, MOST_LINE = 4096 };

struct dataset {
    char name[64];
    bayesopt_gp_parameters parameters;
    bayesopt_kernel kernel;
    size_t n, d;
    double condition, lengthscale[MOST_VARIABLES];
    double x[MOST_POINTS * MOST_VARIABLES], y[MOST_POINTS];
    double loo_mean[MOST_POINTS], loo_var[MOST_POINTS];
    bayesopt_gp *gp;
    double tolerance, spread;
    double mean, sd, dmean[MOST_VARIABLES], dsd[MOST_VARIABLES];
};

static size_t numbers(const char *text, double *out)
{
    size_t n = 0;
    for (char *end; n < 64; text = end) {
        out[n] = strtod(text, &end);
        if (end == text)
            break;
        n++;
    }
    return n;
}

static bayesopt_gp *make(const struct dataset *set, bayesopt_mean mean)
{
    bayesopt_gp_options options;
    bayesopt_gp *gp = NULL;
    bayesopt_gp_options_init(&options);
    options.kernel = set->kernel;
    options.mean = mean;
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_create(set->d, &options, &gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_set_data(gp, set->n, set->x, set->y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_set_parameters(gp, &set->parameters), BAYESOPT_OK);
    return gp;
}

static void begin(struct dataset *set, const char *line)
{
    char kernel[32];
    bayesopt_gp_free(set->gp);
    memset(set, 0, sizeof *set);
    CU_ASSERT_EQUAL_FATAL(sscanf(line, "dataset %63s %31s %zu %zu %lf %lf %lf %lf", set->name,
                                 kernel, &set->n, &set->d, &set->parameters.mean,
                                 &set->parameters.signal, &set->parameters.noise, &set->condition),
                          8);
    while (strcmp(bayesopt_kernel_name(set->kernel), kernel) != 0 && set->kernel < 3)
        set->kernel++;
    set->parameters.lengthscale = set->lengthscale;
    set->n = 0;
    set->tolerance = 1e-15 * set->condition + 1e-12;
}

static void check_likelihood(struct dataset *set, const double *expected)
{
    double value, gradient[MOST_VARIABLES + 2], mean[MOST_POINTS], var[MOST_POINTS];
    set->gp = make(set, BAYESOPT_MEAN_FIXED);
    for (size_t i = 0; i < set->n; i++)
        set->spread = fmax(set->spread, fabs(set->y[i] - set->parameters.mean));
    CU_ASSERT_EQUAL(bayesopt_gp_log_likelihood(set->gp, &value, gradient), BAYESOPT_OK);
    CHECK_RELATIVE(value, expected[0], set->tolerance);
    double size = 0;
    for (size_t j = 0; j < set->d + 2; j++)
        size = fmax(size, fabs(expected[1 + j]));
    for (size_t j = 0; j < set->d + 2; j++)
        CHECK_CLOSE(gradient[j], expected[1 + j], set->tolerance * size);
    CU_ASSERT_EQUAL(bayesopt_gp_loo(set->gp, mean, var), BAYESOPT_OK);
    for (size_t i = 0; i < set->n; i++) {
        CHECK_CLOSE(mean[i], set->loo_mean[i], set->tolerance * set->spread);
        CHECK_RELATIVE(var[i], set->loo_var[i], set->tolerance);
    }
}

static void check_gls(const struct dataset *set, double expected)
{
    bayesopt_gp *gp = make(set, BAYESOPT_MEAN_CONSTANT);
    bayesopt_gp_info info;
    CU_ASSERT_EQUAL(bayesopt_gp_get_info(gp, &info), BAYESOPT_OK);
    CHECK_CLOSE(info.mean, expected, set->tolerance * set->spread);
    bayesopt_gp_free(gp);
}

/* Errors of mean and variance are relative to the spread of the data and the signal variance: close
 * to the data both are small differences of those. */
static void check_test_point(struct dataset *set, const double *expected)
{
    size_t d = set->d;
    double mean, var, dmean[MOST_VARIABLES], dvar[MOST_VARIABLES], work[2 * MOST_POINTS], size = 0;
    const double *x = expected, *dm = expected + d + 2, *dv = dm + d;
    CU_ASSERT_EQUAL(bayesopt_gp_predict_gradient(set->gp, x, &mean, &var, dmean, dvar, work),
                    BAYESOPT_OK);
    CHECK_CLOSE(mean, expected[d], set->tolerance * set->spread);
    CHECK_CLOSE(var, expected[d + 1], set->tolerance * set->parameters.signal);
    for (size_t j = 0; j < d; j++)
        size = fmax(size, 1 / set->lengthscale[j]);
    for (size_t j = 0; j < d; j++) {
        CHECK_CLOSE(dmean[j], dm[j], 10 * set->tolerance * set->spread * size);
        CHECK_CLOSE(dvar[j], dv[j], 10 * set->tolerance * set->parameters.signal * size);
    }
    double batch_mean, batch_var;
    CU_ASSERT_EQUAL(bayesopt_gp_predict(set->gp, 1, x, &batch_mean, &batch_var), BAYESOPT_OK);
    CHECK_CLOSE(batch_mean, mean, set->tolerance * set->spread);
    CHECK_CLOSE(batch_var, var, set->tolerance * set->parameters.signal);
    set->mean = expected[d];
    set->sd = sqrt(expected[d + 1]);
    for (size_t j = 0; j < d; j++) {
        set->dmean[j] = dm[j];
        set->dsd[j] = dv[j] / (2 * set->sd);
    }
}

static void check_acquisition(const struct dataset *set, const double *expected)
{
    double by_mean, by_sd, size = 0;
    double value = bayesopt_log_ei(set->mean, set->sd, expected[0], &by_mean, &by_sd);
    CHECK_CLOSE(value, expected[2], 1e-12 * (1 + fabs(expected[2])));
    for (size_t j = 0; j < set->d; j++)
        size = fmax(size, fabs(by_mean * set->dmean[j]) + fabs(by_sd * set->dsd[j]));
    for (size_t j = 0; j < set->d; j++)
        CHECK_CLOSE(by_mean * set->dmean[j] + by_sd * set->dsd[j], expected[3 + j], 2e-12 * size);
}

static void reference(void)
{
    FILE *file = fopen(TEST_DATA_DIR "/bayesopt_gp_reference.txt", "r");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    static struct dataset set;
    char line[MOST_LINE];
    double v[64];
    size_t sets = 0, tests = 0, acquisitions = 0, table = 0;
    while (fgets(line, sizeof line, file)) {
        char *space = strchr(line, ' ');
        size_t count = space ? numbers(space, v) : 0;
        if (strncmp(line, "dataset ", 8) == 0) {
            begin(&set, line);
            sets++;
        } else if (strncmp(line, "l ", 2) == 0) {
            CU_ASSERT_EQUAL_FATAL(count, set.d);
            memcpy(set.lengthscale, v, count * sizeof *v);
        } else if (strncmp(line, "point ", 6) == 0) {
            CU_ASSERT_EQUAL_FATAL(count, set.d + 3);
            memcpy(set.x + set.n * set.d, v, set.d * sizeof *v);
            set.y[set.n] = v[set.d];
            set.loo_mean[set.n] = v[set.d + 1];
            set.loo_var[set.n++] = v[set.d + 2];
        } else if (strncmp(line, "lml ", 4) == 0) {
            check_likelihood(&set, v);
        } else if (strncmp(line, "gls ", 4) == 0) {
            check_gls(&set, v[0]);
        } else if (strncmp(line, "test ", 5) == 0) {
            CU_ASSERT_EQUAL_FATAL(count, 3 * set.d + 2);
            check_test_point(&set, v);
            tests++;
        } else if (strncmp(line, "acq ", 4) == 0) {
            CU_ASSERT_EQUAL_FATAL(count, set.d + 3);
            check_acquisition(&set, v);
            acquisitions++;
        } else if (strncmp(line, "logh ", 5) == 0) {
            CHECK_CLOSE(bayesopt_log_h(v[0]), v[1], 1e-12 * (fabs(v[1]) + 1e-3));
            CHECK_RELATIVE(bayesopt_log_h_derivative(v[0]), v[2], 1e-12);
            table++;
        }
    }
    fclose(file);
    bayesopt_gp_free(set.gp);
    set.gp = NULL;
    CU_ASSERT_EQUAL(sets, 12);
    CU_ASSERT_EQUAL(tests, 60);
    CU_ASSERT_EQUAL(acquisitions, 180);
    CU_ASSERT(table > 20);
}

static const struct check_case cases[] = {
    {"regression and acquisition against 70-digit values", reference},
};

CHECK_MAIN("bayesopt gp reference", cases)
