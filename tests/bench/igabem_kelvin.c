/* The Kelvin Green function: nanoseconds per point, and the worst errors by region against Bessho's
 * representation. Usage: igabem_bench_kelvin [POINTS PER REGION] (default 200), or
 * igabem_bench_kelvin map for the errors as an SVG map. */
#include "igabem_kelvin.h"

#include "../igabem/kelvin_oracle.h"

#include <igabem/kelvin.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BATCH = 4000, PASSES = 15 };

static double column[9][BATCH];

static double uniform(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-53;
}

static double processor_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

enum call { LOCAL, WAVE, FILTERED, LOCAL_SECOND, WAVE_SECOND, CALLS };
static const char *const call_names[CALLS] = {"N, gradient", "W, gradient", "W filtered, t_c 6",
                                              "N second derivatives", "W second derivatives"};

static igabem_status run(enum call what, size_t first, size_t n)
{
    const igabem_kelvin_filter filter = {.cut_off = 6};
    double *c[9];
    for (int k = 0; k < 9; k++)
        c[k] = column[k] + first;
    switch (what) {
    case LOCAL:
        return igabem_kelvin_local(n, c[0], c[1], c[2], c[3], c[4], c[5], c[6]);
    case WAVE:
        return igabem_kelvin_wave(n, c[0], c[1], c[2], c[3], c[4], c[5], c[6]);
    case FILTERED:
        return igabem_kelvin_wave_filtered(n, c[0], c[1], c[2], &filter, c[3], c[4], c[5], c[6]);
    case LOCAL_SECOND:
        return igabem_kelvin_local_second(n, c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]);
    default:
        return igabem_kelvin_wave_second(n, c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]);
    }
}

/* Least of several passes, in calls of `size` points. */
static double nanoseconds(enum call what, size_t size)
{
    double best = INFINITY;
    for (int pass = 0; pass < PASSES; pass++) {
        double start = processor_seconds();
        for (size_t i = 0; i + size <= BATCH; i += size)
            if (run(what, i, size) != IGABEM_OK) {
                fprintf(stderr, "%s\n", igabem_last_error());
                exit(EXIT_FAILURE);
            }
        best = fmin(best, 1e9 * (processor_seconds() - start) / BATCH);
    }
    return best;
}

/* Field points behind and abreast of a hull of k0 L = 16, k0 B = 1.6, k0 T = 0.8. */
static void place_behind_hull(void)
{
    unsigned long long state = 1;
    for (int i = 0; i < BATCH; i++) {
        column[0][i] = -16 * uniform(&state);
        column[1][i] = 1.6 * (uniform(&state) - 0.5);
        column[2][i] = -0.01 - 0.8 * uniform(&state);
    }
}

static void print_speed(void)
{
    place_behind_hull();
    /* A core that has idled runs slower for its first seconds. */
    for (double start = processor_seconds(); processor_seconds() - start < 4.0;)
        nanoseconds(WAVE, BATCH);
    printf("ns of processor time per point, one thread; -16 < X < 0, |Y| < 0.8, -0.81 < Z < -0.01\n"
           "%-22s %10s %10s\n",
           "", "batch 4000", "single");
    for (int what = 0; what < CALLS; what++)
        printf("%-22s %10.0f %10.0f\n", call_names[what], nanoseconds((enum call)what, BATCH),
               nanoseconds((enum call)what, 1));
}

static double largest(const double *v)
{
    return fmax(fabs(v[1]), fmax(fabs(v[2]), fabs(v[3])));
}

/* Directions: uniform on the sphere, or next to the surface and the track. */
static void place(unsigned long long *state, int close, double R, double *P)
{
    double a = uniform(state), b = uniform(state);
    if (close) {
        double z = pow(1e-4, a), y = pow(1e-3, b), m = R / sqrt(1 + z * z + y * y);
        P[0] = -m;
        P[1] = y * m;
        P[2] = -z * m;
    } else {
        double along = 2 * a - 1, across = sqrt(1 - along * along), angle = 1.5707963267948966 * b;
        P[0] = R * along;
        P[1] = R * across * cos(angle);
        P[2] = -R * across * sin(angle);
    }
}

struct worst {
    double error[4], at[4][3];
};

void kelvin_errors(const double P[3], double error[4])
{
    double N[4], W[4], local[4], wave[4], square = P[0] * P[0] + P[1] * P[1] + P[2] * P[2];
    kelvin_oracle_parts(P[0], P[1], P[2], local, wave);
    igabem_kelvin_local(1, P, P + 1, P + 2, N, N + 1, N + 2, N + 3);
    igabem_kelvin_wave(1, P, P + 1, P + 2, W, W + 1, W + 2, W + 3);
    error[0] = fabs(N[0] - local[0]) / fabs(local[0]);
    error[2] = fabs(W[0] - wave[0]) / fmax(1, fabs(wave[0]));
    error[1] = error[3] = 0;
    for (int k = 1; k < 4; k++) {
        error[1] = fmax(error[1], fabs(N[k] - local[k]) / fmax(largest(local), 1 / square));
        error[3] = fmax(error[3], fabs(W[k] - wave[k]) / fmax(1, largest(wave)));
    }
}

static void compare(const double *P, struct worst *worst)
{
    double error[4];
    kelvin_errors(P, error);
    for (int k = 0; k < 4; k++)
        if (!(error[k] <= worst->error[k])) {
            worst->error[k] = error[k];
            for (int c = 0; c < 3; c++)
                worst->at[k][c] = P[c];
        }
}

static void print_accuracy(int points)
{
    static const double edge[] = {1e-6, 1e-4, 1e-2, 0.125, 1, 10, 64, 1e3, 1e4};
    static const char *const name[] = {"N", "grad N", "W", "grad W"};
    struct worst all = {{0}, {{0}}};
    unsigned long long state = 7;
    printf("\nworst errors of %d points a row; N relative, grad N of max(|grad N|, 1/R^2), W of "
           "max(1, |W|),\n"
           "grad W of max(1, |grad W|)\n%-20s %-10s %8s %8s %8s %8s\n",
           points, "R", "direction", "N", "grad N", "W", "grad W");
    for (size_t r = 0; r + 1 < sizeof edge / sizeof edge[0]; r++)
        for (int close = 0; close < 2; close++) {
            struct worst row = {{0}, {{0}}};
            for (int i = 0; i < points; i++) {
                double P[3];
                place(&state, close, edge[r] * pow(edge[r + 1] / edge[r], uniform(&state)), P);
                compare(P, &row);
            }
            printf("%-8g .. %-8g %-10s %8.1e %8.1e %8.1e %8.1e\n", edge[r], edge[r + 1],
                   close ? "track" : "any", row.error[0], row.error[1], row.error[2], row.error[3]);
            for (int k = 0; k < 4; k++)
                if (row.error[k] > all.error[k]) {
                    all.error[k] = row.error[k];
                    for (int c = 0; c < 3; c++)
                        all.at[k][c] = row.at[k][c];
                }
        }
    for (int k = 0; k < 4; k++)
        printf("worst %-6s %.1e at (%.9g, %.9g, %.9g)\n", name[k], all.error[k], all.at[k][0],
               all.at[k][1], all.at[k][2]);
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "map") == 0) {
        print_map();
        return EXIT_SUCCESS;
    }
    int points = argc > 1 ? atoi(argv[1]) : 200;
    print_speed();
    if (points > 0)
        print_accuracy(points);
    return EXIT_SUCCESS;
}
