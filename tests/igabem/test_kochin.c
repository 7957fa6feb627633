/* Wave amplitudes of point sources and the resistance integral against closed forms, internal sums
 * against the public ones. */
#include "check.h"
#include "result/amplitude.h"

#include <igabem/kelvin.h>

#include <string.h>

static const double RHO = 1000.0, PI = 3.14159265358979323846;

static double resistance(const struct sources *sources, double k0, double length, double beam,
                         double t_max)
{
    struct amplitude_sum sum = {NAN, NAN};
    CU_ASSERT_EQUAL(amplitude_integrate(1, &sources, k0, length, beam, t_max, 0.0, &sum),
                    IGABEM_OK);
    return RHO * k0 * k0 / (2 * PI) * sum.total;
}

/* R = (rho s^2 k0^2 / 4 pi) e^-a (K0(a) + K1(a)), a = k0 h. */
static void single_source(void)
{
    for (double depth = 0.05; depth < 2.0; depth *= 2.5) {
        double x[1] = {0.3}, y[1] = {0.1}, z[1] = {-depth}, q[1] = {0.7}, k0 = 4.0, exact;
        struct sources sources = {.n = 1, .x = x, .y = y, .z = z, .strength = q};
        CU_ASSERT_EQUAL(igabem_kelvin_source_resistance(RHO, k0, depth, 0.7, &exact), IGABEM_OK);
        CHECK_RELATIVE(resistance(&sources, k0, 1.0, 1.0, sqrt(20.0 / (k0 * depth))), exact, 1e-9);
    }
}

/* A source and a sink close together are an x-dipole of moment s d. */
static void dipole(void)
{
    const double k0 = 3.0, depth = 0.4, d = 1e-4;
    double x[2] = {0.5 * d, -0.5 * d}, y[2] = {0, 0}, z[2] = {-depth, -depth};
    double q[2] = {1 / d, -1 / d}, exact;
    struct sources sources = {.n = 2, .x = x, .y = y, .z = z, .strength = q};
    CU_ASSERT_EQUAL(igabem_kelvin_dipole_resistance(RHO, k0, depth, 1.0, &exact), IGABEM_OK);
    CHECK_RELATIVE(resistance(&sources, k0, 1.0, 1.0, 5.0), exact, 1e-6);
}

/* Lagally: the force on each source is -rho s grad(phi of the other and its own images); summed
 * over the pair, R = rho Sum s_i s_j dG/dx(P_i, Q_j), regular parts only. N cancels in the sum. */
static void lagally_of_two_sources(void)
{
    const double k0 = 2.5;
    double x[2] = {0.0, -1.1}, y[2] = {0.2, 0.25}, z[2] = {-0.3, -0.5}, q[2] = {0.8, -0.5};
    struct sources sources = {.n = 2, .x = x, .y = y, .z = z, .strength = q};
    double total = 0.0, gx, self;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            if (i == j)
                continue;
            CU_ASSERT_EQUAL(igabem_kelvin_green(k0, 1, &x[i], &y[i], &z[i], &x[j], &y[j], &z[j],
                                                IGABEM_LOCAL | IGABEM_WAVE, NULL, &gx, NULL, NULL),
                            IGABEM_OK);
            total += RHO * q[i] * q[j] * gx;
        }
    for (int i = 0; i < 2; i++) {
        CU_ASSERT_EQUAL(igabem_kelvin_source_resistance(RHO, k0, -z[i], q[i], &self), IGABEM_OK);
        total += self;
    }
    CHECK_RELATIVE(resistance(&sources, k0, 1.1, 0.1, 6.0), total, 1e-8);
}

/* Mirror images that are implied must count like images that are listed. */
static void implied_images(void)
{
    const double k0 = 6.0;
    double x[4] = {0.1, -0.3, 0.1, -0.3}, y[4] = {0.05, 0.2, -0.05, -0.2},
           z[4] = {-0.1, -0.25, -0.1, -0.25}, q[4] = {1.0, -0.6, 1.0, -0.6};
    double lx[2] = {0.2, 0.2}, ly[2] = {0.1, -0.1}, lq[2] = {0.05, 0.05};
    struct sources half = {.symmetric = 1,
                           .n = 2,
                           .x = x,
                           .y = y,
                           .z = z,
                           .strength = q,
                           .n_line = 1,
                           .line_x = lx,
                           .line_y = ly,
                           .line_strength = lq};
    double order_x[4] = {x[0], x[2], x[1], x[3]}, order_y[4] = {y[0], y[2], y[1], y[3]};
    double order_z[4] = {z[0], z[2], z[1], z[3]}, order_q[4] = {q[0], q[2], q[1], q[3]};
    struct sources full = {.n = 4,
                           .x = order_x,
                           .y = order_y,
                           .z = order_z,
                           .strength = order_q,
                           .n_line = 2,
                           .line_x = lx,
                           .line_y = ly,
                           .line_strength = lq};
    for (double t = 0; t < 5; t += 0.37) {
        double a[2], b[2];
        amplitude(&half, k0, t, a);
        amplitude(&full, k0, t, b);
        CHECK_CLOSE(a[0], b[0], 1e-13);
        CHECK_CLOSE(a[1], b[1], 1e-13);
    }
}

/* The public sum over points is the same function. */
static void agrees_with_public_points(void)
{
    const double k0 = 5.0;
    double x[3] = {0.1, -0.4, 0.45}, y[3] = {0.0, 0.1, -0.07}, z[3] = {-0.02, -0.1, -0.3};
    double q[3] = {1.0, -2.0, 0.4}, t[5] = {-3.0, -0.5, 0.0, 1.0, 7.0}, hr[5], hi[5];
    struct sources sources = {.n = 3, .x = x, .y = y, .z = z, .strength = q};
    CU_ASSERT_EQUAL(igabem_kochin_points(k0, 5, t, 3, x, y, z, q, hr, hi), IGABEM_OK);
    for (int i = 0; i < 5; i++) {
        double h[2];
        amplitude(&sources, k0, t[i], h);
        CHECK_CLOSE(h[0], hr[i], 1e-12);
        CHECK_CLOSE(h[1], hi[i], 1e-12);
    }
}

/* The rule integrates products of oscillating amplitudes and counts what lies beyond an angle. */
static void rule_and_share(void)
{
    size_t n;
    double *t, *w, sum = 0.0;
    CU_ASSERT_EQUAL_FATAL(amplitude_rule(10.0, 1.0, 0.1, 8.0, 2.0, &n, &t, &w), IGABEM_OK);
    for (size_t i = 0; i < n; i++)
        sum += w[i] * cos(10.0 * sqrt(1 + t[i] * t[i])) * t[i] / sqrt(1 + t[i] * t[i]);
    CHECK_CLOSE(sum, (sin(10.0 * sqrt(65.0)) - sin(10.0)) / 10.0, 1e-9);
    free(t);
    free(w);
    double x[1] = {0}, y[1] = {0}, z[1] = {-0.2}, q[1] = {1};
    const struct sources sources = {.n = 1, .x = x, .y = y, .z = z, .strength = q};
    const struct sources *const list = &sources;
    struct amplitude_sum sum_all, sum_low;
    CU_ASSERT_EQUAL(amplitude_integrate(1, &list, 2, 1, 1, 9, 1.5, &sum_all), IGABEM_OK);
    CU_ASSERT_EQUAL(amplitude_integrate(1, &list, 2, 1, 1, 1.5, 0, &sum_low), IGABEM_OK);
    CHECK_RELATIVE(sum_all.total - sum_all.beyond, sum_low.total, 1e-12);
    CU_ASSERT_EQUAL(amplitude_integrate(1, &list, 2, 1, 1, NAN, 0, &sum_low), IGABEM_ERROR_NUMERIC);
}

/* Sets of strengths at common places radiate what each radiates alone; more sources than a block.
 */
static void sets_of_strengths(void)
{
    enum { N = 700, LINE = 300 };
    static double x[N], y[N], z[N], q[3][N], line[3][LINE];
    for (int i = 0; i < N; i++) {
        x[i] = cos(1.3 * i);
        y[i] = 0.1 * sin(0.7 * i);
        z[i] = -0.4 * i / N;
        for (int l = 0; l < 3; l++)
            q[l][i] = cos(0.11 * i * (l + 1));
    }
    for (int i = 0; i < 3 * LINE; i++)
        line[i / LINE][i % LINE] = sin(0.05 * i);
    for (int symmetric = 0; symmetric < 2; symmetric++) {
        struct sources sources[3];
        const struct sources *const list[3] = {&sources[0], &sources[1], &sources[2]};
        struct amplitude_sum all[3], one;
        for (int l = 0; l < 3; l++)
            sources[l] = (struct sources){.symmetric = symmetric,
                                          .n = N,
                                          .x = x,
                                          .y = y,
                                          .z = z,
                                          .strength = q[l],
                                          .n_line = LINE,
                                          .line_x = x,
                                          .line_y = y,
                                          .line_strength = line[l]};
        CU_ASSERT_EQUAL(amplitude_integrate(3, list, 6.0, 2.0, 0.2, 4.0, 2.0, all), IGABEM_OK);
        for (int l = 0; l < 3; l++) {
            CU_ASSERT_EQUAL(amplitude_integrate(1, &list[l], 6.0, 2.0, 0.2, 4.0, 2.0, &one),
                            IGABEM_OK);
            CHECK_RELATIVE(all[l].total, one.total, 1e-13);
            CHECK_RELATIVE(all[l].beyond, one.beyond, 1e-13);
        }
        CU_ASSERT(fabs(all[0].total / all[1].total - 1.0) > 1e-3);
    }
}

static const struct check_case cases[] = {
    {"single source", single_source},
    {"dipole", dipole},
    {"Lagally of two sources", lagally_of_two_sources},
    {"implied mirror images", implied_images},
    {"public amplitudes of points", agrees_with_public_points},
    {"quadrature of the spectrum", rule_and_share},
    {"several sets of strengths", sets_of_strengths},
};

CHECK_MAIN("kochin", cases)
