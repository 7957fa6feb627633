/* Principal values at points inside, close to the edges, on an edge and close to a corner of every
 * element of the reference set. */
#include "check.h"
#include "quadrature_reference.h"
#include "space/quadrature_near.h"
#include "space/quadrature_singular.h"

static struct gauss rules(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    return gauss;
}

/* Adds the moments at the parameters (s, t), returns the number of nodes. */
static size_t singular_moments(const struct plate *plate, const struct gauss *gauss, double s,
                               double t, double tolerance, double v[FIELDS])
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    struct nodes nodes;
    double correction[3];
    nodes_init(&nodes, &plate->mesh);
    singular_nodes(&plate->element, s, t, singular_order(tolerance), gauss, &nodes, correction,
                   NULL);
    CU_ASSERT_FALSE_FATAL(nodes.failed);
    nodes_velocity(&nodes, origin, v);
    for (int c = 0; c < 3; c++) {
        v[c] += correction[c];
        v[3 + c] += correction[c] * reference_polynomial(s, t);
    }
    size_t n = nodes.n;
    nodes_free(&nodes);
    return n;
}

static void test_places(enum plate_shape shape)
{
    const struct gauss gauss = rules();
    const double places[6][2] = {{0.43, 0.57}, {0.02, 0.4},   {1e-5, 0.3},
                                 {0.0, 0.6},   {0.999, 0.03}, {1e-3, 1e-3}};
    struct plate plate;
    plate_make(shape, &plate);
    for (int k = 0; k < 6; k++) {
        double s = places[k][0], t = places[k][1], exact[FIELDS];
        reference_singular(&plate, s, t, exact);
        size_t previous = 0;
        for (double tolerance = 1e-3; tolerance > 5e-12; tolerance *= 1e-2) {
            double v[FIELDS] = {0};
            size_t n = singular_moments(&plate, &gauss, s, t, tolerance, v);
            CHECK_CLOSE(moments_difference(v, exact), 0.0, 10.0 * tolerance);
            CU_ASSERT(n > previous);
            previous = n;
        }
        double v[FIELDS] = {0};
        singular_moments(&plate, &gauss, s, t, 1e-12, v);
        CHECK_CLOSE(moments_difference(v, exact), 0.0, 1e-10);
    }
}

static void test_bent(void)
{
    test_places(PLATE_BENT);
}

static void test_long(void)
{
    test_places(PLATE_LONG);
}

static void test_curved(void)
{
    test_places(PLATE_CURVED);
}

static void test_collapsed(void)
{
    test_places(PLATE_COLLAPSED);
}

static void test_strip(void)
{
    test_places(PLATE_STRIP);
}

/* The bent element over another rectangle. */
static void move_to(struct plate *plate, double x0, double x1, double y0, double y1)
{
    for (int k = 0; k < PLATE_NET; k++) {
        double *h = plate->net + 4 * k;
        h[0] = x0 + (x1 - x0) * (h[0] + 0.2) / 1.2;
        h[1] = y0 + (y1 - y0) * h[1] / 0.4;
    }
}

static void find_parameter(const struct plate *plate, const double p[2], double local[2])
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
    CU_ASSERT(error < 1e-12);
    for (int d = 0; d < 2; d++)
        local[d] = fmin(1.0, fmax(0.0, local[d]));
}

/* Four elements of one rectangle: inside one, close to its edges, and on the edges and the corner
 * that it shares with its neighbours, beside the closed form. */
static void test_closed_form(void)
{
    const struct gauss gauss = rules();
    const double xs[3] = {-0.7, 0.1, 1.0}, ys[3] = {0.0, 0.25, 0.9};
    struct plate plates[4];
    for (int k = 0; k < 4; k++) {
        plate_make(PLATE_BENT, &plates[k]);
        move_to(&plates[k], xs[k / 2], xs[k / 2 + 1], ys[k % 2], ys[k % 2 + 1]);
    }
    const double points[6][2] = {{0.5, 0.5},  {0.1, 0.25},  {0.1, 0.6},
                                 {0.4, 0.25}, {0.101, 0.5}, {-0.3, 0.24999}};
    for (int i = 0; i < 6; i++) {
        const double p[3] = {points[i][0], points[i][1], 0.0};
        double v[FIELDS] = {0}, exact[3];
        for (int k = 0; k < 4; k++) {
            if (p[0] >= xs[k / 2] && p[0] <= xs[k / 2 + 1] && p[1] >= ys[k % 2] &&
                p[1] <= ys[k % 2 + 1]) {
                double local[2];
                find_parameter(&plates[k], p, local);
                singular_moments(&plates[k], &gauss, local[0], local[1], 1e-12, v);
                continue;
            }
            const struct near_rule rule = {
                .point = {p[0], p[1], p[2]}, .tolerance = 1e-13, .gauss = &gauss};
            struct domain domain;
            struct nodes nodes;
            domain_whole(&plates[k].element, &domain);
            nodes_init(&nodes, &plates[k].mesh);
            near_nodes(&rule, &domain, &nodes);
            nodes_velocity(&nodes, p, v);
            nodes_free(&nodes);
        }
        rectangle_velocity(p, xs[0], xs[2], ys[0], ys[2], exact);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(v[c], exact[c], 1e-10);
    }
}

static const struct check_case cases[] = {
    {"flat element", test_bent},      {"flat, 100:1", test_long},
    {"strongly curved", test_curved}, {"collapsed edge", test_collapsed},
    {"curved, 100:1", test_strip},    {"closed form of four rectangles", test_closed_form},
};

CHECK_MAIN("quadrature singular", cases)
