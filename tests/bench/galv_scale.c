/* Streamed data of any size: N samples of L coordinates, rank 20 with falling variances plus noise,
 * never stored. usage: galv_scale N L [covariance|gram|randomised] Prints seconds, peak memory,
 * passes and the error of the leading eigenvalues against those of the model. */
#include <cblas.h>
#include <galv/galv.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

enum { RANK = 20 };

static const double noise = 1e-3;

struct low_rank {
    size_t length;
    double *factor; /* RANK x length, orthogonal rows: discrete sines */
};

static uint32_t hash(uint32_t x)
{
    x ^= x >> 16;
    x *= UINT32_C(0x7feb352d);
    x ^= x >> 15;
    x *= UINT32_C(0x846ca68b);
    x ^= x >> 16;
    return x;
}

/* Uniform with variance 1. */
static double uniform(uint32_t bits)
{
    return ((double)(int32_t)bits * 0x1p-32) * 3.4641016151377544;
}

static int make_rows(void *context, size_t first, size_t count, double *rows)
{
    const struct low_rank *data = context;
    size_t length = data->length;
    double *c = malloc(count * RANK * sizeof *c);
    if (!c)
        return 1;
    for (size_t r = 0; r < count; r++)
        for (size_t k = 0; k < RANK; k++)
            c[r * RANK + k] =
                uniform(hash(hash((uint32_t)(first + r)) + (uint32_t)k)) * pow(0.8, (double)k);
#pragma omp parallel for schedule(static)
    for (size_t r = 0; r < count; r++) {
        uint32_t sample = hash((uint32_t)(first + r) ^ UINT32_C(0x55555555));
        for (size_t i = 0; i < length; i++)
            rows[r * length + i] = noise * uniform(hash(sample + (uint32_t)i));
    }
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, (blasint)count, (blasint)length, RANK, 1,
                c, RANK, data->factor, (blasint)length, 1, rows, (blasint)length);
    free(c);
    return 0;
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static galv_method parse_method(const char *text)
{
    return strcmp(text, "covariance") == 0   ? GALV_METHOD_COVARIANCE
           : strcmp(text, "gram") == 0       ? GALV_METHOD_GRAM
           : strcmp(text, "randomised") == 0 ? GALV_METHOD_RANDOMISED
                                             : GALV_METHOD_AUTO;
}

static double processor_seconds(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

int main(int argc, char **argv)
{
    if (argc < 3) {
        fprintf(stderr, "usage: %s N L [covariance|gram|randomised]\n", argv[0]);
        return 2;
    }
    size_t count = strtoull(argv[1], NULL, 10), length = strtoull(argv[2], NULL, 10);
    if (count == 0 || length < 2 * RANK)
        return 2;
    struct low_rank context = {length, malloc(RANK * length * sizeof(double))};
    if (!context.factor)
        return 1;
    for (size_t k = 0; k < RANK; k++)
        for (size_t i = 0; i < length; i++)
            context.factor[k * length + i] =
                sqrt(2 / (double)length) *
                sin(3.14159265358979323846 * (double)(k + 1) * ((double)i + 0.5) / (double)length);
    galv_options options;
    galv_options_init(&options);
    options.method = parse_method(argc > 3 ? argv[3] : "auto");
    options.modes = 10;
    options.spectrum = RANK;
    galv_data data = {
        .count = count, .coordinates = length, .rows = make_rows, .context = &context};
    galv_model *model = NULL;
    double start = seconds();
    if (galv_build_data(&data, &options, &model)) {
        fprintf(stderr, "%s\n", galv_last_error());
        return 1;
    }
    double wall = seconds() - start, worst = 0, residual = 0;
    /* The population values; samples scatter about them by sqrt(0.8/N). */
    for (size_t k = 0; k < 10; k++) {
        double expected = pow(0.64, (double)k) + noise * noise;
        worst = fmax(worst, fabs(galv_model_eigenvalues(model)[k] / expected - 1));
        residual = fmax(residual, galv_model_residuals(model)[k]);
    }
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf(
        "N %zu, L %zu: %.1f s wall, %.1f s processor, %ld MB, %zu passes, method %d, relative to "
        "population %.1e (expected scatter %.1e), residual %.1e\n",
        count, length, wall, processor_seconds(), usage.ru_maxrss / 1024,
        galv_model_view(model).passes, (int)galv_model_method(model), worst,
        sqrt(0.8 / (double)count), residual);
    galv_model_free(model);
    free(context.factor);
    return 0;
}
