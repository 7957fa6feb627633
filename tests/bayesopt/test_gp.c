/* The regression beyond the reference values: fits, gradients, appending, transforms, noise, files,
 * and matrices of many tiles. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>
#include <string.h>
#include <unistd.h>

enum { N = 120, D = 4 };

static double smooth(const double *x)
{
    return sin(3 * x[0]) + x[1] * x[1] - 0.5 * x[0] * x[2] + 0.1 * x[3];
}

static double inputs[N * D], outputs[N], variances[N];

static void make_data(void)
{
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = 5;
    CU_ASSERT_EQUAL_FATAL(bayesopt_design(BAYESOPT_DESIGN_LHS, N, D, &options, inputs),
                          BAYESOPT_OK);
    for (size_t i = 0; i < N; i++) {
        outputs[i] = smooth(inputs + i * D);
        variances[i] = 1e-4 * (1 + (double)(i % 3));
    }
}

static bayesopt_gp *make(bayesopt_gp_options *options, size_t n)
{
    bayesopt_gp *gp = NULL;
    make_data();
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_create(D, options, &gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_set_data(gp, n, inputs, outputs, variances), BAYESOPT_OK);
    return gp;
}

static const double probe[D] = {0.31, 0.62, 0.17, 0.88};

static bayesopt_gp *with_parameters(bayesopt_gp_options *options, size_t n, double *scales,
                                    double signal, double noise)
{
    bayesopt_gp *gp = make(options, n);
    bayesopt_gp_parameters parameters = {scales, signal, noise, 0.2};
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_set_parameters(gp, &parameters), BAYESOPT_OK);
    return gp;
}

/* Gradients of the likelihood and of the posterior against central differences, for every kernel
 * and mean. */
static void gradients(void)
{
    for (int kernel = 0; kernel < 3; kernel++)
        for (int mean = 0; mean < 3; mean++) {
            bayesopt_gp_options options;
            double scales[D] = {0.8, 1.1, 0.9, 1.5}, gradient[D + 2], value;
            bayesopt_gp_options_init(&options);
            options.kernel = (bayesopt_kernel)kernel;
            options.mean = (bayesopt_mean)mean;
            bayesopt_gp *gp = with_parameters(&options, 70, scales, 1.3, 0.01);
            CU_ASSERT_EQUAL(bayesopt_gp_log_likelihood(gp, &value, gradient), BAYESOPT_OK);
            double work[2 * 70], m, v, dm[D], dv[D];
            CU_ASSERT_EQUAL(bayesopt_gp_predict_gradient(gp, probe, &m, &v, dm, dv, work),
                            BAYESOPT_OK);
            for (size_t j = 0; j < D; j++) {
                double at[2][D], means[2], vars[2];
                for (int side = 0; side < 2; side++) {
                    memcpy(at[side], probe, sizeof probe);
                    at[side][j] += side ? 1e-5 : -1e-5;
                    CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, at[side], &means[side], &vars[side]),
                                    BAYESOPT_OK);
                }
                CHECK_CLOSE(dm[j], (means[1] - means[0]) / 2e-5, 1e-7);
                CHECK_CLOSE(dv[j], (vars[1] - vars[0]) / 2e-5, 1e-7);
            }
            for (size_t j = 0; j < D + 2; j++) {
                double sides[2];
                for (int side = 0; side < 2; side++) {
                    double factor = exp(side ? 1e-5 : -1e-5), moved[D];
                    memcpy(moved, scales, sizeof moved);
                    if (j < D)
                        moved[j] *= factor;
                    bayesopt_gp_parameters p = {moved, j == D ? 1.3 * factor : 1.3,
                                                j == D + 1 ? 0.01 * factor : 0.01, 0.2};
                    CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &p), BAYESOPT_OK);
                    CU_ASSERT_EQUAL(bayesopt_gp_log_likelihood(gp, &sides[side], NULL),
                                    BAYESOPT_OK);
                }
                CHECK_CLOSE(gradient[j], (sides[1] - sides[0]) / 2e-5,
                            1e-6 * (1 + fabs(gradient[j])));
            }
            bayesopt_gp_free(gp);
        }
}

/* Points appended one by one give what all at once give, across tiles and storage growth. */
static void appending(void)
{
    bayesopt_gp_options options;
    double scales[D] = {0.8, 1.1, 0.9, 1.5}, mean[2], var[2];
    bayesopt_gp_options_init(&options);
    bayesopt_gp *whole = with_parameters(&options, N, scales, 1, 1e-6);
    bayesopt_gp *grown = with_parameters(&options, 20, scales, 1, 1e-6);
    for (size_t i = 20; i < N; i++)
        CU_ASSERT_EQUAL(bayesopt_gp_append(grown, 1, inputs + i * D, outputs + i, NULL),
                        BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(whole, 1, probe, &mean[0], &var[0]), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(grown, 1, probe, &mean[1], &var[1]), BAYESOPT_OK);
    CHECK_CLOSE(mean[1], mean[0], 1e-9);
    CHECK_CLOSE(var[1], var[0], 1e-10);
    bayesopt_gp_free(whole);
    bayesopt_gp_free(grown);
}

/* Leave-one-out by formula against leaving one out. */
static void leave_one_out(void)
{
    bayesopt_gp_options options;
    double scales[D] = {0.8, 1.1, 0.9, 1.5}, mean[80], var[80], m, v;
    bayesopt_gp_options_init(&options);
    options.mean = BAYESOPT_MEAN_FIXED;
    bayesopt_gp *gp = with_parameters(&options, 80, scales, 1, 1e-3);
    CU_ASSERT_EQUAL(bayesopt_gp_loo(gp, mean, var), BAYESOPT_OK);
    bayesopt_gp_parameters parameters = {scales, 1, 1e-3, 0.2};
    for (size_t out = 0; out < 80; out += 13) {
        double x[79 * D], y[79];
        for (size_t i = 0, k = 0; i < 80; i++) {
            if (i == out)
                continue;
            memcpy(x + k * D, inputs + i * D, D * sizeof *x);
            y[k++] = outputs[i];
        }
        CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, 79, x, y, NULL), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &parameters), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, inputs + out * D, &m, &v), BAYESOPT_OK);
        CHECK_CLOSE(mean[out], m, 1e-9);
        CHECK_CLOSE(var[out], v + 1e-3, 1e-9);
    }
    bayesopt_gp_free(gp);
}

static double prediction_error(const bayesopt_gp *gp)
{
    double x[200 * D], mean[200], square = 0;
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = 77;
    CU_ASSERT_EQUAL(bayesopt_design(BAYESOPT_DESIGN_UNIFORM, 200, D, &options, x), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 200, x, mean, NULL), BAYESOPT_OK);
    for (size_t i = 0; i < 200; i++) {
        double error = bayesopt_gp_from_model(gp, mean[i]) - smooth(x + i * D);
        square += error * error / 200;
    }
    return sqrt(square);
}

/* Every choice of scales, mean, transform and model comparison learns the function (its spread is
 * about 0.5). */
static void fits(void)
{
    static const size_t groups[D] = {0, 1, 0, 2};
    bayesopt_gp_options options;
    for (int scales = 0; scales < 4; scales++)
        for (int mean = 1; mean < 3; mean++)
            for (int choice = 0; choice <= (scales == BAYESOPT_SCALES_AUTO); choice++) {
                bayesopt_gp_options_init(&options);
                options.scales = (bayesopt_scales)scales;
                options.group = groups;
                options.mean = (bayesopt_mean)mean;
                options.choice = (bayesopt_choice)choice;
                bayesopt_gp *gp = make(&options, N);
                CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
                CU_ASSERT(prediction_error(gp) <
                          (scales == BAYESOPT_SCALES_ISOTROPIC ? 2e-2 : 4e-3));
                double scale[D];
                bayesopt_gp_parameters p = {.lengthscale = scale};
                CU_ASSERT_EQUAL(bayesopt_gp_get_parameters(gp, &p), BAYESOPT_OK);
                if (scales == BAYESOPT_SCALES_TIED || scales == BAYESOPT_SCALES_ISOTROPIC)
                    CHECK_CLOSE(scale[0], scale[2], 0);
                bayesopt_gp_free(gp);
            }
    for (int transform = 0; transform <= BAYESOPT_TRANSFORM_AUTO; transform++) {
        bayesopt_gp_options_init(&options);
        options.transform = (bayesopt_transform)transform;
        bayesopt_gp *gp = make(&options, N);
        CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
        CU_ASSERT(prediction_error(gp) < 0.15);
        for (size_t i = 0; i < N; i++)
            CHECK_CLOSE(bayesopt_gp_from_model(gp, bayesopt_gp_to_model(gp, outputs[i])),
                        outputs[i], 1e-9);
        bayesopt_gp_free(gp);
    }
}

/* A quadratic, skewed as its values are, is left alone; its exponential is transformed. */
static void transform_is_chosen_by_the_data(void)
{
    bayesopt_gp_options options;
    bayesopt_gp_info info;
    double y[N];
    bayesopt_gp_options_init(&options);
    options.transform = BAYESOPT_TRANSFORM_AUTO;
    bayesopt_gp *gp = make(&options, N);
    for (int exponential = 0; exponential < 2; exponential++) {
        for (size_t i = 0; i < N; i++) {
            const double *x = inputs + i * D;
            y[i] = (x[0] + x[1] - 1) * (x[0] + x[1] - 1) + 0.3 * (x[2] - x[3]) * (x[2] - x[3]);
            y[i] = exponential ? exp(8 * y[i]) : y[i];
        }
        bayesopt_gp_forget(gp);
        CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, N, inputs, y, NULL), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_get_info(gp, &info), BAYESOPT_OK);
        CU_ASSERT_EQUAL(info.transform != BAYESOPT_TRANSFORM_NONE, exponential);
    }
    bayesopt_gp_free(gp);
}

/* Values that grow without bound to both sides are not straightened by a logarithm or a power;
 * ranks do it, and the leave-one-out error finds out. */
static void ranks_for_two_heavy_tails(void)
{
    bayesopt_gp_options options;
    bayesopt_gp_info info;
    double y[N];
    bayesopt_gp_options_init(&options);
    options.transform = BAYESOPT_TRANSFORM_AUTO;
    bayesopt_gp *gp = make(&options, N);
    for (size_t i = 0; i < N; i++)
        y[i] = sinh(12 * (smooth(inputs + i * D) - 0.75));
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, N, inputs, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_get_info(gp, &info), BAYESOPT_OK);
    CU_ASSERT_EQUAL(info.transform, BAYESOPT_TRANSFORM_RANK);
    bayesopt_gp_free(gp);
}

/* Normal scores of many ranks: symmetric, increasing, the ends where they belong. */
static void scores_of_many_ranks(void)
{
    enum { MANY = 600 };
    static double x[MANY], y[MANY];
    bayesopt_gp_options options;
    bayesopt_gp *gp;
    bayesopt_gp_options_init(&options);
    options.transform = BAYESOPT_TRANSFORM_RANK;
    options.starts = 1;
    options.evaluations = 3;
    for (size_t i = 0; i < MANY; i++) {
        x[i] = ((double)i + 0.5) / MANY;
        y[i] = exp(5 * x[i]);
    }
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_create(1, &options, &gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, MANY, x, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
    /* Phi^-1(1/1200) = -3.1441, over the standard deviation of the scores, which is near 1 */
    CHECK_CLOSE(bayesopt_gp_to_model(gp, y[0]), -3.144, 0.02);
    for (size_t i = 0; i < MANY; i++) {
        CHECK_CLOSE(bayesopt_gp_to_model(gp, y[i]), -bayesopt_gp_to_model(gp, y[MANY - 1 - i]),
                    1e-9);
        CU_ASSERT(!i || bayesopt_gp_to_model(gp, y[i]) > bayesopt_gp_to_model(gp, y[i - 1]));
    }
    bayesopt_gp_free(gp);
}

/* Learned noise finds the variance that was put in; known noise smooths accordingly. */
static void noise_modes(void)
{
    bayesopt_gp_options options;
    bayesopt_gp_options_init(&options);
    options.noise = BAYESOPT_NOISE_LEARNED;
    bayesopt_gp *gp = make(&options, N);
    double y[N];
    uint64_t state = 1;
    for (size_t i = 0; i < N; i++) {
        double sum = -6; /* twelve uniforms less six: nearly normal, variance 1 */
        for (int k = 0; k < 12; k++) {
            state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
            sum += (double)(state >> 11) * 0x1p-53;
        }
        y[i] = outputs[i] + 0.05 * sum;
        variances[i] = 0.0025;
    }
    bayesopt_gp_info info;
    bayesopt_gp_parameters p = {0};
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, N, inputs, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_get_parameters(gp, &p), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_get_info(gp, &info), BAYESOPT_OK);
    double found = sqrt(p.noise) * info.scale;
    CU_ASSERT(found > 0.035 && found < 0.065);
    CU_ASSERT(prediction_error(gp) < 0.05);
    bayesopt_gp_free(gp);

    options.noise = BAYESOPT_NOISE_KNOWN;
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_create(D, &options, &gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, N, inputs, y, NULL), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, N, inputs, y, variances), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
    CU_ASSERT(prediction_error(gp) < 0.05);
    bayesopt_gp_free(gp);
}

static void saving(void)
{
    static const size_t groups[D] = {0, 0, 1, 1};
    char path[300];
    snprintf(path, sizeof path, "%s/bayesopt_gp_%ld.txt", check_scratch(), (long)getpid());
    for (int transform = 0; transform < BAYESOPT_TRANSFORM_AUTO; transform++) {
        bayesopt_gp_options options;
        bayesopt_gp_options_init(&options);
        options.scales = transform % 2 ? BAYESOPT_SCALES_TIED : BAYESOPT_SCALES_ARD;
        options.group = groups;
        options.transform = (bayesopt_transform)transform;
        bayesopt_gp *gp = make(&options, 60), *again = NULL;
        double mean[2], var[2];
        CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_save(gp, path), BAYESOPT_OK);
        CU_ASSERT_EQUAL_FATAL(bayesopt_gp_load(path, &again), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, probe, &mean[0], &var[0]), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_predict(again, 1, probe, &mean[1], &var[1]), BAYESOPT_OK);
        CHECK_CLOSE(mean[1], mean[0], 0);
        CHECK_CLOSE(var[1], var[0], 0);
        bayesopt_gp_free(gp);
        bayesopt_gp_free(again);
    }
    /* Cut anywhere, the file is refused. */
    static char text[1 << 20];
    FILE *file = fopen(path, "r");
    size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    for (size_t cut = 0; cut + 20 < size; cut += size / 40) {
        bayesopt_gp *gp = NULL;
        file = fopen(path, "w");
        fwrite(text, 1, cut, file);
        fclose(file);
        CU_ASSERT_EQUAL(bayesopt_gp_load(path, &gp), BAYESOPT_ERROR_FORMAT);
    }
    text[size] = '\0';
    /* Groups with a gap, a scale without end, and a head that claims more than the file holds. */
    static const char *const lines[][2] = {{"groups", "groups 1 0 0 0"},
                                           {"scales", "scales inf 1 1 1"},
                                           {"head", "head 4 1000000 0 0 0 0 0 0"}};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        const char *line = strstr(text, lines[i][0]);
        bayesopt_gp *gp = NULL;
        CU_ASSERT_PTR_NOT_NULL_FATAL(line);
        file = fopen(path, "w");
        fprintf(file, "%.*s%s%s", (int)(line - text), text, lines[i][1],
                line + strcspn(line, "\n"));
        fclose(file);
        CU_ASSERT_EQUAL(bayesopt_gp_load(path, &gp), BAYESOPT_ERROR_FORMAT);
    }
    remove(path);
    bayesopt_gp *gp;
    CU_ASSERT_EQUAL(bayesopt_gp_load(path, &gp), BAYESOPT_ERROR_FILE);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "No such file"));
}

/* Coincident points, constant outputs, one point: conditioned with jitter, never refused. */
static void degenerate_data(void)
{
    bayesopt_gp_options options;
    bayesopt_gp_info info;
    double x[20 * D], y[20], mean, var;
    bayesopt_gp_options_init(&options);
    bayesopt_gp *gp = make(&options, 20);
    for (size_t i = 0; i < 20; i++) {
        memcpy(x + i * D, probe, sizeof probe);
        y[i] = (double)i;
    }
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, 20, x, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, probe, &mean, &var), BAYESOPT_OK);
    CHECK_CLOSE(bayesopt_gp_from_model(gp, mean), 9.5, 0.1);
    double scales[D] = {1, 1, 1, 1};
    bayesopt_gp_parameters p = {scales, 1, 0, 0};
    CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &p), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_get_info(gp, &info), BAYESOPT_OK);
    CU_ASSERT(info.jitter > 0 && info.jitter <= 1.01e-4);
    for (size_t i = 0; i < 20; i++)
        y[i] = 7;
    bayesopt_gp_forget(gp);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, 20, inputs, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, probe, &mean, &var), BAYESOPT_OK);
    CHECK_CLOSE(bayesopt_gp_from_model(gp, mean), 7, 1e-9);
    bayesopt_gp_forget(gp);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, 1, inputs, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, probe, &mean, &var), BAYESOPT_OK);
    CU_ASSERT(isfinite(mean) && var > 0);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, 0, inputs, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_fit(gp), BAYESOPT_ERROR_ARGUMENT);
    y[0] = NAN;
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, 1, inputs, y, NULL), BAYESOPT_ERROR_ARGUMENT);
    p.signal = -1;
    CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &p), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_gp_free(gp);
}

static const struct check_case cases[] = {
    {"gradients", gradients},
    {"appending", appending},
    {"leave one out", leave_one_out},
    {"fits", fits},
    {"transform is chosen by the data", transform_is_chosen_by_the_data},
    {"ranks for two heavy tails", ranks_for_two_heavy_tails},
    {"scores of many ranks", scores_of_many_ranks},
    {"noise modes", noise_modes},
    {"saving", saving},
    {"degenerate data", degenerate_data},
};

CHECK_MAIN("bayesopt gp", cases)
