/* Plane waves over every element of the reference set, from a fraction of a wave length to several,
 * at all angles up to the limit at once. The scale of an integral is the area. */
#include "check.h"
#include "quadrature_reference.h"
#include "space/quadrature_wave.h"

#include <complex.h>

enum { ANGLES = 5, CELLS = 16, CELL_POINTS = 16 };
static const double t_max = 8.0;

/* Of the density 1 and of a Bernstein polynomial. */
static void wave_sums(const struct nodes *nodes, double k0, double t, double complex sum[MOMENTS])
{
    double s = sqrt(1.0 + t * t);
    sum[0] = sum[1] = 0.0;
    for (size_t i = 0; i < nodes->n; i++) {
        double complex exponent =
            k0 * (s * s * nodes->z[i] + I * s * (nodes->x[i] + t * nodes->y[i]));
        double complex value = nodes->g[i] * cexp(exponent);
        sum[0] += value;
        sum[1] += value * node_polynomial(nodes, i);
    }
}

static double fine_sums(const struct plate *plate, const struct gauss *gauss, double k0,
                        double complex exact[ANGLES][MOMENTS])
{
    struct domain domain;
    struct nodes nodes;
    const int points[2] = {CELL_POINTS, CELL_POINTS};
    double area = 0.0;
    domain_whole(&plate->element, &domain);
    nodes_init(&nodes, &plate->mesh);
    for (int k = 0; k < CELLS * CELLS; k++) {
        double a = (double)(k / CELLS) / CELLS, b = (double)(k % CELLS) / CELLS;
        const double rect[4] = {a, a + 1.0 / CELLS, b, b + 1.0 / CELLS};
        cell_nodes(&domain, rect, points, gauss, &nodes);
    }
    for (size_t i = 0; i < nodes.n; i++)
        area += nodes.g[i];
    for (int k = 0; k < ANGLES; k++)
        wave_sums(&nodes, k0, k * t_max / (ANGLES - 1), exact[k]);
    nodes_free(&nodes);
    return area;
}

/* Greatest error over angles and moments. */
static double wave_error(const struct plate *plate, const struct wave_rule *rule,
                         double complex exact[ANGLES][MOMENTS])
{
    struct domain domain;
    struct nodes nodes;
    double error = 0.0;
    domain_whole(&plate->element, &domain);
    nodes_init(&nodes, &plate->mesh);
    wave_nodes(rule, &domain, &nodes);
    CU_ASSERT_FALSE_FATAL(nodes.failed);
    for (int k = 0; k < ANGLES; k++) {
        double complex sum[MOMENTS];
        double t = k * t_max / (ANGLES - 1);
        wave_sums(&nodes, rule->k0, t, sum);
        for (int m = 0; m < MOMENTS; m++) /* the other end of the path decays besides */
            error = fmax(error, cabs(sum[m] - exact[k][m]) *
                                    exp(-rule->k0 * (1.0 + t * t) * rule->clearance));
    }
    nodes_free(&nodes);
    return error;
}

static void test_waves(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    const double lengths[3] = {0.1, 0.7, 5.0}; /* k0 times the diagonal */
    for (int shape = 0; shape < PLATE_SHAPES; shape++)
        for (int k = 0; k < 3; k++) {
            struct plate plate;
            double top = -INFINITY;
            plate_make((enum plate_shape)shape, &plate);
            for (int i = 0; i < PLATE_NET; i++)
                top = fmax(top, plate.net[4 * i + 2]);
            for (int i = 0; i < PLATE_NET; i++)
                plate.net[4 * i + 2] -= top;
            struct wave_rule rule = {
                .k0 = lengths[k] / plate.diagonal, .t_max = t_max, .gauss = &gauss};
            double complex exact[ANGLES][MOMENTS];
            double area = fine_sums(&plate, &gauss, rule.k0, exact);
            for (int deep = 0; deep < 2; deep++) {
                rule.clearance = deep * 0.05 * plate.diagonal;
                for (rule.tolerance = 1e-3; rule.tolerance > 5e-12; rule.tolerance *= 1e-2)
                    CHECK_CLOSE(wave_error(&plate, &rule, exact) / area, 0.0,
                                10.0 * rule.tolerance);
                rule.tolerance = 1e-12;
                CHECK_CLOSE(wave_error(&plate, &rule, exact) / area, 0.0, 1e-10);
            }
        }
}

static const struct check_case cases[] = {
    {"graded wave lengths", test_waves},
};

CHECK_MAIN("quadrature wave", cases)
