/* Streamed data of any size: N samples of L coordinates, rank 20 with falling variances plus noise,
 * never stored. usage: galv_scale N L [covariance|gram|randomised] Prints seconds, those spent on
 * producing the data, peak memory, passes and the error of the leading eigenvalues against those of
 * the model. */
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
    double *factor;       /* RANK x length, orthogonal rows: discrete sines */
    double wall, seconds; /* spent in make_rows(): of the clock, of the processor */
};

#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__)
#define CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CLONES
#endif

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

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double processor_seconds(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
           1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

/* Vector registers' worth of numbers, and coordinates whose factors stay in cache. */
enum { LANE = 8, WIDE = 4 * LANE, PIECE = 1024 };

typedef double lane __attribute__((vector_size(LANE * sizeof(double)), aligned(sizeof(double))));

/* Numbers first..last-1 of one sample: noise, and RANK coefficients times the factors. */
CLONES static void fill(const struct low_rank *data, uint32_t sample, const double *c, size_t first,
                        size_t last, double *restrict row)
{
    size_t i = first;
    for (size_t j = first; j < last; j++)
        row[j] = noise * uniform(hash(sample + (uint32_t)j));
    for (; i + WIDE <= last; i += WIDE) {
        lane sum[4];
        for (int l = 0; l < 4; l++)
            sum[l] = *(lane *)(row + i + l * LANE);
        for (size_t k = 0; k < RANK; k++)
            for (int l = 0; l < 4; l++)
                sum[l] += c[k] * *(const lane *)(data->factor + k * data->length + i + l * LANE);
        for (int l = 0; l < 4; l++)
            *(lane *)(row + i + l * LANE) = sum[l];
    }
    for (; i < last; i++)
        for (size_t k = 0; k < RANK; k++)
            row[i] += c[k] * data->factor[k * data->length + i];
}

static void coefficients(uint32_t sample, double c[RANK])
{
    double scale = 1;
    for (size_t k = 0; k < RANK; k++, scale *= 0.8)
        c[k] = scale * uniform(hash(hash(sample) + (uint32_t)k));
}

static int make_rows(void *user_data, size_t first, size_t count, double *rows)
{
    struct low_rank *data = user_data;
    size_t length = data->length;
    double wall = seconds(), processor = processor_seconds();
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < length; i += PIECE)
        for (size_t r = 0; r < count; r++) {
            double c[RANK];
            uint32_t sample = (uint32_t)(first + r);
            coefficients(sample, c);
            fill(data, hash(sample ^ UINT32_C(0x55555555)), c, i,
                 i + PIECE < length ? i + PIECE : length, rows + r * length);
        }
    data->wall += seconds() - wall;
    data->seconds += processor_seconds() - processor;
    return 0;
}

static galv_method parse_method(const char *text)
{
    return strcmp(text, "covariance") == 0   ? GALV_METHOD_COVARIANCE
           : strcmp(text, "gram") == 0       ? GALV_METHOD_GRAM
           : strcmp(text, "randomised") == 0 ? GALV_METHOD_RANDOMISED
                                             : GALV_METHOD_AUTO;
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
    struct low_rank user_data = {.length = length,
                                 .factor = malloc(RANK * length * sizeof(double))};
    if (!user_data.factor)
        return 1;
    for (size_t k = 0; k < RANK; k++)
        for (size_t i = 0; i < length; i++)
            user_data.factor[k * length + i] =
                sqrt(2 / (double)length) *
                sin(3.14159265358979323846 * (double)(k + 1) * ((double)i + 0.5) / (double)length);
    galv_options options;
    galv_options_init(&options);
    options.method = parse_method(argc > 3 ? argv[3] : "auto");
    options.modes = 10;
    options.spectrum = RANK;
    galv_data data = {
        .count = count, .coordinates = length, .rows = make_rows, .user_data = &user_data};
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
        "N %zu, L %zu: %.1f s wall, %.1f s processor, of these for the data %.1f and %.1f, %ld MB, "
        "%zu passes, method %d, relative to population %.1e (expected scatter %.1e), residual "
        "%.1e\n",
        count, length, wall, processor_seconds(), user_data.wall, user_data.seconds,
        usage.ru_maxrss / 1024, galv_model_passes(model), (int)galv_model_method(model), worst,
        sqrt(0.8 / (double)count), residual);
    galv_model_free(model);
    free(user_data.factor);
    return 0;
}
