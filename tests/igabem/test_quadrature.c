/* The quadrature modules one by one, on plates whose integrals have closed forms. */
#include "cell.h"
#include "check.h"
#include "hulls.h"
#include "quadrature_near.h"
#include "quadrature_regular.h"
#include "quadrature_singular.h"
#include "quadrature_wave.h"

#include <complex.h>
#include <limits.h>

enum { DEGREE = 2, SIDE = DEGREE + 1 };
static const double pi = 3.14159265358979323846;

/* A biquadratic element by itself. */
struct plate {
    double net[SIDE * SIDE * 4], extraction[SIDE * SIDE];
    struct element element;
    struct mesh mesh;
};

/* The rectangle [x0,x1] x [y0,y1] of the plane z = 0; `bend` moves the inner parameter lines, not
 * the rectangle. `shear` adds shear * y to x. */
static void make_plate(struct plate *plate, double x0, double x1, double y0, double y1, double bend,
                       double shear)
{
    *plate = (struct plate){.element = {.degree = {DEGREE, DEGREE}, .stride = SIDE, .sign = 1.0}};
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++) {
            double *h = plate->net + 4 * (i * SIDE + j);
            double s = 0.5 * i + (i == 1 ? 0.5 * bend * (0.5 * j - 0.5) : 0.0);
            double t = 0.5 * j + (j == 1 ? 0.5 * bend * (0.5 * i - 0.5) : 0.0);
            h[1] = y0 + (y1 - y0) * t;
            h[0] = x0 + (x1 - x0) * s + shear * h[1];
            h[3] = 1.0;
        }
    for (int i = 0; i < SIDE; i++)
        plate->extraction[i * SIDE + i] = 1.0;
    struct element *element = &plate->element;
    element->net = plate->net;
    element->upper[0] = element->upper[1] = 1.0;
    element->extraction[0] = element->extraction[1] = plate->extraction;
    for (int c = 0; c < 3; c++) {
        element->box[0][c] = element->box[1][c] = plate->net[c];
        for (int k = 0; k < SIDE * SIDE; k++) {
            element->box[0][c] = fmin(element->box[0][c], plate->net[4 * k + c]);
            element->box[1][c] = fmax(element->box[1][c], plate->net[4 * k + c]);
        }
    }
    plate->mesh = (struct mesh){.n = 1, .degree = {DEGREE, DEGREE}};
}

/* Int (P - Q)/(4 pi r^3) dS over the rectangle, principal value in its plane. */
static void plate_velocity(const double p[3], double x0, double x1, double y0, double y1,
                           double v[3])
{
    const double xs[2] = {x0 - p[0], x1 - p[0]}, ys[2] = {y0 - p[1], y1 - p[1]};
    v[0] = v[1] = v[2] = 0.0;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            double sign = i == j ? 1.0 : -1.0, x = xs[i], y = ys[j];
            double r = sqrt(x * x + y * y + p[2] * p[2]);
            /* ln(y + r) without cancellation; the other part is the same at both ends of y */
            double ly = y > 0 ? log(y + r) : log((x * x + p[2] * p[2]) / (r - y));
            double lx = x > 0 ? log(x + r) : log((y * y + p[2] * p[2]) / (r - x));
            v[0] += sign * ly / (4.0 * pi);
            v[1] += sign * lx / (4.0 * pi);
            if (p[2] != 0.0)
                v[2] += sign * atan(x * y / (p[2] * r)) / (4.0 * pi);
        }
}

static void add_velocity(const struct nodes *nodes, const double p[3], double v[3])
{
    for (size_t i = 0; i < nodes->n; i++) {
        double d[3] = {p[0] - nodes->x[i], p[1] - nodes->y[i], p[2] - nodes->z[i]};
        double r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
        for (int c = 0; c < 3; c++)
            v[c] += nodes->g[i] * d[c] / (4.0 * pi * r2 * sqrt(r2));
    }
}

/* The number of points asked for integrates a double pole at the distance stated. */
static void test_regular(void)
{
    int previous = INT_MAX;
    for (double z = 1.05; z < 200.0; z *= 1.3) {
        int n = regular_points(z, 1.0, 1.0, 1e-10);
        CU_ASSERT(n <= previous);
        previous = n;
        if (n > 64)
            continue;
        double node[64], weight[64], sum = 0.0;
        CU_ASSERT_EQUAL_FATAL(nurbs_gauss_legendre((size_t)n, node, weight), NURBS_OK);
        for (int i = 0; i < n; i++) {
            double distance = z - (2.0 * node[i] - 1.0);
            sum += 2.0 * weight[i] / (distance * distance);
        }
        double exact = 1.0 / (z - 1.0) - 1.0 / (z + 1.0);
        CHECK_CLOSE(sum / exact, 1.0, 1e-8);
    }
    CU_ASSERT_EQUAL(previous, 3);
    CU_ASSERT_EQUAL(regular_points(0.9, 1.0, 1.0, 1e-10), INT_MAX);
    CU_ASSERT_EQUAL(regular_points(3.0, 1.0, 1e-12, 1e-10), 1);
}

static void test_near(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    struct plate plate;
    make_plate(&plate, -0.2, 1.0, 0.0, 0.4, 0.3, 0.0);
    const double foot[4][2] = {{0.31, 0.17}, {1.0, 0.13}, {1.0, 0.4}, {-0.2, 0.39}};
    for (int f = 0; f < 4; f++)
        for (double height = 3.0; height > 1e-5; height *= 0.1) {
            struct near_rule rule = {
                .point = {foot[f][0], foot[f][1], height}, .tolerance = 1e-13, .gauss = &gauss};
            struct domain domain;
            struct nodes nodes;
            double v[3] = {0}, exact[3];
            domain_whole(&plate.element, &domain);
            nodes_init(&nodes, &plate.mesh);
            near_nodes(&rule, &domain, &nodes);
            CU_ASSERT_FALSE_FATAL(nodes.failed);
            add_velocity(&nodes, rule.point, v);
            plate_velocity(rule.point, -0.2, 1.0, 0.0, 0.4, exact);
            for (int c = 0; c < 3; c++)
                CHECK_CLOSE(v[c], exact[c], 1e-10);
            nodes_free(&nodes);
        }
}

/* Fewer nodes for a lower accuracy, and the error stays near what was asked. */
static void test_near_tolerance(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    struct plate plate;
    make_plate(&plate, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0);
    size_t previous = 0;
    for (double tolerance = 1e-2; tolerance > 1e-9; tolerance *= 1e-2) {
        struct near_rule rule = {
            .point = {0.4, 0.7, 0.05}, .tolerance = tolerance, .gauss = &gauss};
        struct domain domain;
        struct nodes nodes;
        double v[3] = {0}, exact[3];
        domain_whole(&plate.element, &domain);
        nodes_init(&nodes, &plate.mesh);
        near_nodes(&rule, &domain, &nodes);
        add_velocity(&nodes, rule.point, v);
        plate_velocity(rule.point, 0.0, 1.0, 0.0, 1.0, exact);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(v[c], exact[c], 30.0 * tolerance);
        CU_ASSERT(nodes.n > previous);
        previous = nodes.n;
        nodes_free(&nodes);
    }
}

static double find_parameter(const struct plate *plate, const double p[2], double local[2])
{
    local[0] = local[1] = 0.5;
    double error = 1.0;
    for (int k = 0; k < 60 && error > 1e-15; k++) {
        struct jet jet;
        element_jet(&plate->element, local[0], local[1], &jet);
        double fx = p[0] - jet.s[0], fy = p[1] - jet.s[1];
        double det = jet.ds[0] * jet.dt[1] - jet.ds[1] * jet.dt[0];
        local[0] += (fx * jet.dt[1] - fy * jet.dt[0]) / det;
        local[1] += (fy * jet.ds[0] - fx * jet.ds[1]) / det;
        error = fabs(fx) + fabs(fy);
    }
    for (int d = 0; d < 2; d++)
        local[d] = fmin(1.0, fmax(0.0, local[d]));
    return error;
}

/* Principal values at points inside one element, close to its edges, and on the edges and corners
 * that it shares with its neighbours. */
static void test_singular(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    const double xs[3] = {-0.7, 0.1, 1.0}, ys[3] = {0.0, 0.25, 0.9};
    struct plate plates[2][2];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++)
            make_plate(&plates[i][j], xs[i], xs[i + 1], ys[j], ys[j + 1], 0.25, 0.0);
    const double points[6][2] = {{0.5, 0.5},  {0.1, 0.25},  {0.1, 0.6},
                                 {0.4, 0.25}, {0.101, 0.5}, {-0.3, 0.24999}};
    for (int k = 0; k < 6; k++) {
        const double p[3] = {points[k][0], points[k][1], 0.0};
        double v[3] = {0}, exact[3];
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                struct nodes nodes;
                nodes_init(&nodes, &plates[i][j].mesh);
                int inside =
                    p[0] >= xs[i] && p[0] <= xs[i + 1] && p[1] >= ys[j] && p[1] <= ys[j + 1];
                if (inside) {
                    double local[2], correction[3];
                    CU_ASSERT(find_parameter(&plates[i][j], p, local) < 1e-12);
                    singular_nodes(&plates[i][j].element, local[0], local[1], 16, &gauss, &nodes,
                                   correction);
                    for (int c = 0; c < 3; c++)
                        v[c] += correction[c];
                } else {
                    struct domain domain;
                    const struct near_rule rule = {
                        .point = {p[0], p[1], p[2]}, .tolerance = 1e-13, .gauss = &gauss};
                    domain_whole(&plates[i][j].element, &domain);
                    near_nodes(&rule, &domain, &nodes);
                }
                add_velocity(&nodes, p, v);
                nodes_free(&nodes);
            }
        plate_velocity(p, xs[0], xs[2], ys[0], ys[2], exact);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(v[c], exact[c], 1e-10);
    }
}

/* The order rule: its error follows the tolerance. */
static void test_singular_order(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    struct plate plate;
    make_plate(&plate, 0.0, 3.0, 0.0, 1.0, 0.3, 0.0);
    const double p[3] = {0.8, 0.6, 0.0};
    double local[2], exact[3];
    CU_ASSERT(find_parameter(&plate, p, local) < 1e-12);
    plate_velocity(p, 0.0, 3.0, 0.0, 1.0, exact);
    for (double tolerance = 1e-4; tolerance > 1e-11; tolerance *= 1e-2) {
        struct nodes nodes;
        double v[3];
        nodes_init(&nodes, &plate.mesh);
        singular_nodes(&plate.element, local[0], local[1], singular_order(tolerance), &gauss,
                       &nodes, v);
        add_velocity(&nodes, p, v);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(v[c], exact[c], 10.0 * tolerance);
        nodes_free(&nodes);
    }
}

static void test_cut(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    struct plate plate;
    make_plate(&plate, 0.0, 1.0, 0.0, 1.0, 0.0, 0.3); /* x from 0.3 y to 1 + 0.3 y */
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

/* Plane waves over an element of a hull at every angle up to the limit. */
static void test_wave(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 8, 2);
    struct density *density = NULL;
    struct mesh *mesh = NULL;
    const struct density_rule basis = {.degree = 3, .refine = {1, 1}};
    CU_ASSERT_EQUAL_FATAL(density_create(hull, &basis, &density), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(mesh_create(density, &mesh), IGABEM_OK);
    const struct wave_rule rule = {.k0 = 11.1, .t_max = 15.0, .tolerance = 1e-7, .gauss = &gauss};
    for (size_t e = 0; e < mesh->n; e += 3) {
        struct domain domain;
        struct nodes nodes, fine;
        domain_whole(&mesh->element[e], &domain);
        nodes_init(&nodes, mesh);
        nodes_init(&fine, mesh);
        wave_nodes(&rule, &domain, &nodes);
        const int points[2] = {14, 14};
        for (int k = 0; k < 64; k++) {
            const double rect[4] = {k / 8 / 8.0, (k / 8 + 1) / 8.0, k % 8 / 8.0, (k % 8 + 1) / 8.0};
            cell_nodes(&domain, rect, points, &gauss, &fine);
        }
        for (double t = 0.0; t <= 15.0; t += 1.5) {
            const struct nodes *both[2] = {&nodes, &fine};
            double complex sum[2] = {0.0, 0.0};
            double area = 0.0;
            for (int k = 0; k < 2; k++)
                for (size_t i = 0; i < both[k]->n; i++) {
                    double s = sqrt(1.0 + t * t);
                    double complex z = 11.1 * (s * s * both[k]->z[i] +
                                               I * s * (both[k]->x[i] + t * both[k]->y[i]));
                    sum[k] += both[k]->g[i] * cexp(z);
                    area += k * both[k]->g[i];
                }
            CHECK_CLOSE(cabs(sum[0] - sum[1]) / area, 0.0, 1e-6);
        }
        nodes_free(&nodes);
        nodes_free(&fine);
    }
    mesh_free(mesh);
    density_free(density);
    igabem_hull_free(hull);
}

static const struct check_case cases[] = {
    {"regular: points for a distance", test_regular},
    {"near: graded distances to a plate", test_near},
    {"near: error follows the tolerance", test_near_tolerance},
    {"singular: principal values", test_singular},
    {"singular: order for a tolerance", test_singular_order},
    {"cut at a plane", test_cut},
    {"plane waves over elements", test_wave},
};

CHECK_MAIN("quadrature", cases)
