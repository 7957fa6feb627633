/* Points close to an element: every element of the reference set at distances of 1e-6 to 10
 * diagonals above its inside, beside its edges and beyond its corner. */
#include "check.h"
#include "quadrature_reference.h"
#include "space/quadrature_near.h"

static struct gauss rules(void)
{
    struct gauss gauss;
    CU_ASSERT_EQUAL_FATAL(gauss_fill(&gauss), IGABEM_OK);
    return gauss;
}

static size_t near_moments(const struct plate *plate, const struct gauss *gauss,
                           const double point[3], double tolerance, double v[FIELDS])
{
    const struct near_rule rule = {
        .point = {point[0], point[1], point[2]}, .tolerance = tolerance, .gauss = gauss};
    struct domain domain;
    struct nodes nodes;
    domain_whole(&plate->element, &domain);
    nodes_init(&nodes, &plate->mesh);
    near_nodes(&rule, &domain, &nodes);
    CU_ASSERT_FALSE_FATAL(nodes.failed);
    for (int k = 0; k < FIELDS; k++)
        v[k] = 0.0;
    nodes_velocity(&nodes, point, v);
    size_t n = nodes.n;
    nodes_free(&nodes);
    return n;
}

/* Off the foot by the normal and, at an edge, outwards along the surface. */
static void off(const struct plate *plate, const double foot[2], double distance, double point[3])
{
    struct jet jet;
    double normal[3], size;
    element_jet(&plate->element, foot[0], foot[1], &jet);
    size = jet_area(&jet, 1.0, normal);
    for (int c = 0; c < 3; c++)
        point[c] = jet.s[c] + distance * normal[c] / size;
    if (foot[0] != 1.0)
        return;
    double length = sqrt(jet.ds[0] * jet.ds[0] + jet.ds[1] * jet.ds[1] + jet.ds[2] * jet.ds[2]);
    for (int c = 0; c < 3; c++)
        point[c] += distance * (jet.ds[c] / length - 0.5 * normal[c] / size);
}

static void test_graded(enum plate_shape shape)
{
    const struct gauss gauss = rules();
    const double feet[3][2] = {{0.43, 0.57}, {0.003, 0.4}, {1.0, 1.0}};
    const double distances[6] = {1e-6, 1e-4, 1e-2, 0.1, 1.0, 10.0};
    struct plate plate;
    plate_make(shape, &plate);
    for (int f = 0; f < 3; f++)
        for (int k = 0; k < 6; k++) {
            double point[3], exact[FIELDS], v[FIELDS];
            off(&plate, feet[f], distances[k] * plate.diagonal, point);
            reference_near(&plate, point, exact);
            size_t previous = 0;
            for (double tolerance = 1e-3; tolerance > 5e-12; tolerance *= 1e-2) {
                size_t n = near_moments(&plate, &gauss, point, tolerance, v);
                CHECK_CLOSE(moments_difference(v, exact), 0.0, 10.0 * tolerance);
                CU_ASSERT(n >= previous);
                previous = n;
            }
            near_moments(&plate, &gauss, point, 1e-12, v);
            CHECK_CLOSE(moments_difference(v, exact), 0.0, 1e-10);
        }
}

static void test_bent(void)
{
    test_graded(PLATE_BENT);
}

static void test_long(void)
{
    test_graded(PLATE_LONG);
}

static void test_curved(void)
{
    test_graded(PLATE_CURVED);
}

static void test_collapsed(void)
{
    test_graded(PLATE_COLLAPSED);
}

static void test_strip(void)
{
    test_graded(PLATE_STRIP);
}

/* The flat elements once more, and the reference with them, beside the closed form. */
static void test_closed_form(void)
{
    const struct gauss gauss = rules();
    const double feet[4][2] = {{0.31, 0.17}, {1.0, 0.13}, {1.0, 0.4}, {-0.2, 0.39}};
    struct plate plate;
    plate_make(PLATE_BENT, &plate);
    for (int f = 0; f < 4; f++)
        for (double height = 3.0; height > 1e-6; height *= 0.1) {
            const double point[3] = {feet[f][0], feet[f][1], height};
            double v[FIELDS], slow[FIELDS], exact[3];
            near_moments(&plate, &gauss, point, 1e-13, v);
            reference_near(&plate, point, slow);
            rectangle_velocity(point, -0.2, 1.0, 0.0, 0.4, exact);
            for (int c = 0; c < 3; c++) {
                CHECK_CLOSE(v[c], exact[c], 1e-10);
                CHECK_CLOSE(slow[c], exact[c], 1e-10);
            }
        }
}

static const struct check_case cases[] = {
    {"flat element", test_bent},      {"flat, 100:1", test_long},
    {"strongly curved", test_curved}, {"collapsed edge", test_collapsed},
    {"curved, 100:1", test_strip},    {"closed form of a rectangle", test_closed_form},
};

CHECK_MAIN("quadrature near", cases)
