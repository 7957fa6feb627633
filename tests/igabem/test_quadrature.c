/* Counts of points for smooth kernels and shapes, and elements cut at a plane. */
#include "check.h"
#include "quadrature_reference.h"
#include "space/quadrature_regular.h"

#include <nurbs/basis.h>

#include <limits.h>

enum { MOST = 64 };

/* A double pole at a distance z times a cubic basis function of the length [-1,1], by n points and
 * by so many that the rest is rounding. */
static double pole_integral(double z, int n)
{
    double node[MOST], weight[MOST], sum = 0.0;
    CU_ASSERT_EQUAL_FATAL(nurbs_gauss_legendre((size_t)n, node, weight), NURBS_OK);
    for (int i = 0; i < n; i++) {
        double s = node[i], distance = z - (2.0 * s - 1.0);
        sum += weight[i] * z * z * 3.0 * s * s * (1.0 - s) / (distance * distance);
    }
    return sum;
}

static void test_regular(void)
{
    const struct factor cubic = {3, 1.0};
    int used = 0;
    for (double z = 1.2; z < 300.0; z *= 1.3) {
        int previous = 0;
        for (double tolerance = 1e-3; tolerance > 5e-13; tolerance *= 0.1) {
            int n = regular_points(z, 1.0, &cubic, 1.0, tolerance);
            CU_ASSERT(n >= previous);
            previous = n;
            if (n > 40)
                continue;
            used++;
            CHECK_CLOSE(pole_integral(z, n), pole_integral(z, MOST), 10.0 * tolerance);
            if (tolerance < 5e-12)
                CHECK_CLOSE(pole_integral(z, n), pole_integral(z, MOST), 1e-10);
        }
    }
    CU_ASSERT(used > 180);
    CU_ASSERT_EQUAL(regular_points(0.9, 1.0, &cubic, 1.0, 1e-10), INT_MAX);
    CU_ASSERT_EQUAL(regular_points(3.0, 1.0, &cubic, 1e-12, 1e-10), 1);
}

/* Length of an arc of a parabola: its speed has a branch point where the rule says. */
static void test_shape(void)
{
    const struct factor constant = {0, 1.0};
    CU_ASSERT_EQUAL(shape_points(1.0, 0.0, &constant, 1.0, 1e-10), 1);
    for (double bend = 0.01; bend < 1.5; bend *= 1.7)
        for (double tolerance = 1e-3; tolerance > 5e-12; tolerance *= 0.1) {
            double node[MOST], weight[MOST], sum = 0.0;
            int n = shape_points(1.0, bend, &constant, 1.0, tolerance);
            if (n > 40)
                continue;
            CU_ASSERT_EQUAL_FATAL(nurbs_gauss_legendre((size_t)n, node, weight), NURBS_OK);
            for (int i = 0; i < n; i++) /* y = x - x^2 times 2 bend, 0 <= x <= 1 */
                sum += weight[i] * hypot(1.0, 2.0 * bend * (1.0 - 2.0 * node[i]));
            double k = 2.0 * bend;
            double exact = 0.5 * (hypot(1.0, k) + asinh(k) / k);
            CHECK_CLOSE(sum, exact, 10.0 * tolerance);
        }
}

/* A rectangle sheared along x, in one element: x from 0.3 y to 1 + 0.3 y. */
static void test_cut(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    struct plate plate;
    plate_make(PLATE_BENT, &plate);
    for (int k = 0; k < PLATE_NET; k++) {
        double *h = plate.net + 4 * k;
        h[1] = k % PLATE_SIDE / 3.0;
        h[0] = k / PLATE_SIDE / 3.0 + 0.3 * h[1];
    }
    const double planes[5] = {0.1, 0.5, 1.1, 1e-9, 2.0};
    const double ahead[5] = {59.0 / 60.0, 0.65, 4.0 / 60.0, 1.0, 0.0};
    for (int k = 0; k < 5; k++) {
        struct domain pieces[DOMAIN_PIECES];
        size_t n = domain_cut(&plate.element, planes[k], pieces);
        double area[2] = {0.0, 0.0}, first_moment = 0.0;
        for (size_t i = 0; i < n; i++) {
            const double whole[4] = {0.0, 1.0, 0.0, 1.0};
            const int points[2] = {4, 4};
            struct nodes nodes;
            nodes_init(&nodes, &plate.mesh);
            cell_nodes(&pieces[i], whole, points, &gauss, &nodes);
            for (size_t m = 0; m < nodes.n; m++) {
                area[pieces[i].ahead] += nodes.g[m];
                first_moment += nodes.g[m] * nodes.x[m];
                CU_ASSERT(pieces[i].ahead == (nodes.x[m] > planes[k]));
            }
            nodes_free(&nodes);
        }
        CHECK_CLOSE(area[1], ahead[k], 1e-10);
        CHECK_CLOSE(area[0] + area[1], 1.0, 1e-10);
        CHECK_CLOSE(first_moment, 0.65, 1e-10);
    }
}

static const struct check_case cases[] = {
    {"points for a distance and a tolerance", test_regular},
    {"points for a curved line", test_shape},
    {"cut at a plane", test_cut},
};

CHECK_MAIN("quadrature", cases)
