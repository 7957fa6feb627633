/* N, W and their gradients against values in 34-digit arithmetic, and against Bessho's
 * representation at random points of the whole domain. */
#include "check.h"
#include "kelvin_oracle.h"
#include "kelvin_reference.h"

#include <igabem/kelvin.h>

static double largest(const double *v)
{
    return fmax(fabs(v[1]), fmax(fabs(v[2]), fabs(v[3])));
}

static double gradient_error(const double *actual, const double *expected)
{
    double e = 0;
    for (int k = 1; k < 4; k++)
        e = fmax(e, fabs(actual[k] - expected[k]));
    return e;
}

static void reference_file(void)
{
    static struct kelvin_row row[KELVIN_MOST_ROWS];
    size_t n = kelvin_read_rows(row);
    CU_ASSERT_EQUAL(n, 123);
    for (size_t i = 0; i < n; i++) {
        double N[4], W[4],
            R = sqrt(row[i].X * row[i].X + row[i].Y * row[i].Y + row[i].Z * row[i].Z);
        CU_ASSERT_EQUAL(
            igabem_kelvin_local(1, &row[i].X, &row[i].Y, &row[i].Z, N, N + 1, N + 2, N + 3),
            IGABEM_OK);
        CU_ASSERT_EQUAL(
            igabem_kelvin_wave(1, &row[i].X, &row[i].Y, &row[i].Z, W, W + 1, W + 2, W + 3),
            IGABEM_OK);
        CHECK_RELATIVE(N[0], row[i].local[0], 1e-11);
        CHECK_CLOSE(gradient_error(N, row[i].local), 0,
                    1e-9 * fmax(largest(row[i].local), 1 / (R * R)));
        CHECK_CLOSE(W[0], row[i].wave[0], 1e-10 * fmax(1, fabs(row[i].wave[0])));
        CHECK_CLOSE(gradient_error(W, row[i].wave), 0, 1e-10 * fmax(1, largest(row[i].wave)));
    }
}

/* A batch gives what single calls give, whatever outputs are asked for. */
static void batches(void)
{
    static struct kelvin_row row[KELVIN_MOST_ROWS];
    static double X[KELVIN_MOST_ROWS], Y[KELVIN_MOST_ROWS], Z[KELVIN_MOST_ROWS];
    static double all[4][KELVIN_MOST_ROWS], some[KELVIN_MOST_ROWS];
    size_t n = kelvin_read_rows(row);
    for (size_t i = 0; i < n; i++) {
        X[i] = row[i].X;
        Y[i] = row[i].Y;
        Z[i] = row[i].Z;
    }
    CU_ASSERT_EQUAL(igabem_kelvin_wave(n, X, Y, Z, all[0], all[1], all[2], all[3]), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_kelvin_wave(n, X, Y, Z, NULL, NULL, some, NULL), IGABEM_OK);
    for (size_t i = 0; i < n; i++) {
        double W;
        CU_ASSERT_EQUAL(some[i], all[2][i]);
        igabem_kelvin_wave(1, &X[i], &Y[i], &Z[i], &W, NULL, NULL, NULL);
        CU_ASSERT_EQUAL(W, all[0][i]);
    }
    CU_ASSERT_EQUAL(igabem_kelvin_local(n, X, Y, Z, all[0], all[1], all[2], all[3]), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_kelvin_local(n, X, Y, Z, NULL, NULL, NULL, some), IGABEM_OK);
    for (size_t i = 0; i < n; i++)
        CU_ASSERT_EQUAL(some[i], all[3][i]);
}

/* Uniform in [0, 1), the same on every machine. */
static double uniform(unsigned long long *state)
{
    *state = *state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Every second direction uniform on the sphere, the others close to the free surface and the track.
 */
static void random_point(unsigned long long *state, int i, double *X, double *Y, double *Z)
{
    double R = 1e-6 * pow(1e10, uniform(state)), a = uniform(state), b = uniform(state);
    if (i % 2) {
        double across = sqrt(1 - (2 * a - 1) * (2 * a - 1)), angle = 1.5707963267948966 * b;
        *X = R * (2 * a - 1);
        *Y = R * across * cos(angle);
        *Z = -R * across * sin(angle);
    } else {
        double z = pow(1e-4, a), y = pow(1e-3, b), m = R / sqrt(1 + z * z + y * y);
        *X = uniform(state) < 0.8 ? -m : m;
        *Y = y * m;
        *Z = -z * m;
    }
}

static void random_points(void)
{
    const char *asked = getenv("KELVIN_POINTS");
    int points = asked ? atoi(asked) : 600;
    unsigned long long state = 20240607;
    double worst[4] = {0}, at[4][3] = {{0}};
    for (int i = 0; i < points; i++) {
        double X, Y, Z, N[4], W[4], local[4], wave[4];
        random_point(&state, i, &X, &Y, &Z);
        kelvin_oracle_parts(X, Y, Z, local, wave);
        igabem_kelvin_local(1, &X, &Y, &Z, N, N + 1, N + 2, N + 3);
        igabem_kelvin_wave(1, &X, &Y, &Z, W, W + 1, W + 2, W + 3);
        double square = X * X + Y * Y + Z * Z;
        /* 3e-15: what cancellation between its terms leaves of the oracle far away. */
        double error[4] = {fabs(N[0] - local[0]) / fabs(local[0]),
                           fmax(0, gradient_error(N, local) - 3e-15) /
                               fmax(largest(local), 1 / square),
                           fabs(W[0] - wave[0]) / fmax(1, fabs(wave[0])),
                           gradient_error(W, wave) / fmax(1, largest(wave))};
        for (int k = 0; k < 4; k++)
            if (!(error[k] <= worst[k])) {
                worst[k] = error[k];
                at[k][0] = X;
                at[k][1] = Y;
                at[k][2] = Z;
            }
    }
    static const char *name[] = {"N", "grad N", "W", "grad W"};
    for (int k = 0; k < 4; k++)
        printf("\n    %-6s worst %.1e at %.6g %.6g %.6g", name[k], worst[k], at[k][0], at[k][1],
               at[k][2]);
    putchar('\n');
    CHECK_CLOSE(worst[0], 0, 1e-10);
    CHECK_CLOSE(worst[1], 0, 2e-9);
    CHECK_CLOSE(worst[2], 0, 3e-10);
    CHECK_CLOSE(worst[3], 0, 3e-10);
}

static const struct check_case cases[] = {
    {"reference file", reference_file},
    {"batches", batches},
    {"random points of the whole domain", random_points},
};

CHECK_MAIN("kelvin reference", cases)
