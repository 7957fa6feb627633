/* Displacement of a grid, sections, particulars of sampling, and the chain to the light patch, on
 * the Wigley hull where everything is known: V = 4/9 L B T, A(x) = 2/3 B T (1 - (2x/L)^2). */
#include "check.h"
#include "design.h"
#include "entrance.h"
#include "evaluate.h"
#include "limits.h"
#include "outcome.h"
#include "parent.h"
#include "volume.h"

static const double LENGTH = 1, BEAM = 0.1, DRAFT = 0.0625;

/* The hull with straight sides above the water, rows along x, girth from the deck to the keel. */
static void wigley_grid(size_t rows, size_t columns, double top, double *points)
{
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < columns; j++) {
            double x = LENGTH * ((double)i / (double)(rows - 1) - 0.5);
            double z = top - (top + DRAFT) * (double)j / (double)(columns - 1);
            double wet = z < 0 ? 1 - z * z / (DRAFT * DRAFT) : 1;
            double *p = points + 3 * (i * columns + j);
            p[0] = x;
            p[1] = BEAM / 2 * (1 - 4 * x * x / (LENGTH * LENGTH)) * wet;
            p[2] = z;
        }
    }
}

static void test_volume_converges(void)
{
    double exact = 4.0 / 9 * LENGTH * BEAM * DRAFT, error[3];
    static double points[3 * 129 * 65];
    for (size_t k = 0; k < 3; k++) {
        size_t rows = (32u << k) + 1, columns = (16u << k) + 1;
        wigley_grid(rows, columns, 0.02, points);
        error[k] = fabs(fabs(volume_of_grid(rows, columns, points)) / exact - 1);
    }
    CU_ASSERT_TRUE(error[2] < 1e-3);
    CU_ASSERT_TRUE(error[1] < error[0] / 3);
    CU_ASSERT_TRUE(error[2] < error[1] / 3);
}

/* A wall-sided box is cut exactly wherever the water stands on its sides. */
static void test_volume_cut(void)
{
    double points[3 * 3 * 4];
    static const double z[4] = {0.3, 0.11, -0.07, -0.4};
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 4; j++) {
            double *p = points + 3 * (4 * i + j);
            p[0] = 0.5 * (double)i;
            p[1] = 0.2;
            p[2] = z[j];
        }
    }
    CHECK_RELATIVE(fabs(volume_of_grid(3, 4, points)), 2 * 1.0 * 0.2 * 0.4, 1e-14);
}

static void make_latent(size_t n, bool along_x, struct latent *l)
{
    *l = (struct latent){.modes = 2, .coordinates = n, .spectrum = 2};
    CU_ASSERT_TRUE_FATAL(latent_allocate(l));
    for (size_t k = 0; k < n; k += 3) {
        l->vectors[k + 1] = 0.01 * sin(0.1 * (double)k);
        l->vectors[n + k + 1] = 0.02 * cos(0.03 * (double)k);
        l->vectors[n + k] = along_x ? 0.01 * sin(0.02 * (double)k) : 0;
    }
}

/* Moves along x make the volume nonlinear in u: it is then that of the moved grid. */
static void test_limits_of_grid(void)
{
    enum { ROWS = 21, COLUMNS = 9, N = 3 * ROWS * COLUMNS };
    double points[N], moved[N], gradient[2], least = INFINITY;
    struct latent latent;
    struct limits limits;
    struct parent parent = {.length = LENGTH};
    const double u[2] = {0.4, -0.3};
    wigley_grid(ROWS, COLUMNS, 0.02, points);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, points, &parent.grid), NURBS_OK);
    make_latent(N, true, &latent);
    CU_ASSERT_FALSE(limits_gradient(&latent, &parent, 1e-4, gradient));
    CU_ASSERT_TRUE_FATAL(limits_create(&latent, parent.grid, NULL, &limits));
    latent_displace(&latent, u, moved);
    for (size_t k = 0; k < N; k++)
        moved[k] += points[k];
    for (size_t k = 1; k < N; k += 3)
        least = fmin(least, moved[k]);
    double ratio = volume_of_grid(ROWS, COLUMNS, moved) / volume_of_grid(ROWS, COLUMNS, points);
    CHECK_CLOSE(limits_volume_ratio(&limits, u), ratio, 1e-13);
    CU_ASSERT_TRUE(fabs(ratio - 1) > 1e-3);
    CHECK_CLOSE(limits_breadth(&limits, u).least_y, least, 1e-15);
    CU_ASSERT_TRUE(least < 0);
    limits_free(&limits);
    latent_free(&latent);
    nurbs_grid_free(parent.grid);
}

/* Moves along y: the linear rule gives the volume of the built hull. The mode leaves keel, stem and
 * stern where they are. */
static void test_limits_of_hull(void)
{
    enum { ROWS = 41, COLUMNS = 17, N = 3 * ROWS * COLUMNS };
    double points[N], d[N], gradient[1];
    struct latent latent = {.modes = 1, .coordinates = N, .spectrum = 1};
    struct limits limits;
    struct parent parent = {.length = LENGTH};
    struct design original, moved;
    struct failure failure = {"", ""};
    wigley_grid(ROWS, COLUMNS, 0.02, points);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, points, &parent.grid), NURBS_OK);
    CU_ASSERT_TRUE_FATAL(latent_allocate(&latent));
    for (size_t k = 0; k < N; k += 3)
        latent.vectors[k + 1] = points[k + 1] * (1 + points[k]);
    latent.lower[0] = -0.2;
    latent.upper[0] = 0.2;
    CU_ASSERT_TRUE_FATAL(limits_gradient(&latent, &parent, 1e-4, gradient));
    CU_ASSERT_TRUE_FATAL(limits_create(&latent, parent.grid, gradient, &limits));
    const double u[1] = {0.15};
    latent_displace(&latent, u, d);
    CU_ASSERT_TRUE_FATAL(design_build(&parent, NULL, 1e-4, &original, &failure));
    CU_ASSERT_TRUE_FATAL(design_build(&parent, d, 1e-4, &moved, &failure));
    double ratio = moved.hydrostatics.volume / original.hydrostatics.volume;
    CU_ASSERT_TRUE(fabs(ratio - 1) > 0.1);
    CHECK_CLOSE(limits_volume_ratio(&limits, u), ratio, 1e-4);
    struct limits_breadth breadth = limits_breadth(&limits, u);
    CHECK_CLOSE(breadth.least_y, 0, 1e-15);
    /* The mode widens the fore end by 1.5 x 0.15 and the aft end by 0.5 x 0.15; next to it. */
    CHECK_CLOSE(breadth.least_share, 1 + 0.15 * (1 - 0.475), 1e-12);
    design_free(&original);
    design_free(&moved);
    limits_free(&limits);
    latent_free(&latent);
    nurbs_grid_free(parent.grid);
}

static void test_parameters(void)
{
    /* Cubic, a kink at 0.3 with a triple knot. */
    const double knots[] = {0, 0, 0, 0, 0.1, 0.3, 0.3, 0.3, 0.7, 1, 1, 1, 1};
    double out[40];
    for (size_t n = 5; n <= 40; n += 7) {
        size_t kinks = 0;
        CU_ASSERT_TRUE(parent_parameters(3, 9, knots, n, out));
        CU_ASSERT_EQUAL(out[0], 0);
        CU_ASSERT_EQUAL(out[n - 1], 1);
        for (size_t k = 0; k < n; k++)
            kinks += out[k] == 0.3;
        CU_ASSERT_EQUAL(kinks, 1);
    }
}

static void test_design(void)
{
    enum { ROWS = 41, COLUMNS = 17 };
    double points[3 * ROWS * COLUMNS], d[3 * ROWS * COLUMNS];
    struct parent parent = {.length = LENGTH};
    struct design design, wider;
    struct failure failure = {"", ""};
    wigley_grid(ROWS, COLUMNS, 0.02, points);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, points, &parent.grid), NURBS_OK);
    bool ok = design_build(&parent, NULL, 1e-4, &design, &failure);
    if (!ok)
        fprintf(stderr, "%s: %s\n", failure.stage, failure.reason);
    CU_ASSERT_TRUE_FATAL(ok);
    double volume = 4.0 / 9 * LENGTH * BEAM * DRAFT;
    CHECK_RELATIVE(design.hydrostatics.volume, volume, 2e-3);
    CHECK_RELATIVE(design.hydrostatics.beam, BEAM, 2e-3);
    CHECK_RELATIVE(design.hydrostatics.draft, DRAFT, 2e-3);
    CU_ASSERT_TRUE(design.bound <= 1e-4 * LENGTH);
    CU_ASSERT_TRUE(nurbs_surface_size(design.light, 0) * nurbs_surface_size(design.light, 1) <
                   ROWS * COLUMNS / 2);

    /* Ten percent more beam is ten percent more volume. */
    for (size_t k = 0; k < 3 * ROWS * COLUMNS; k++)
        d[k] = k % 3 == 1 ? 0.1 * points[k] : 0;
    CU_ASSERT_TRUE_FATAL(design_build(&parent, d, 1e-4, &wider, &failure));
    CHECK_RELATIVE(wider.hydrostatics.volume, 1.1 * design.hydrostatics.volume, 2e-3);
    design_free(&wider);

    /* Lifted out of the water there is no design, and the reason names the stage. */
    for (size_t k = 0; k < 3 * ROWS * COLUMNS; k++)
        d[k] = k % 3 == 2 ? 0.1 : 0;
    CU_ASSERT_FALSE(design_build(&parent, d, 1e-4, &wider, &failure));
    CU_ASSERT_STRING_EQUAL(failure.stage, "waterline");
    CU_ASSERT_TRUE(strlen(failure.reason) > 10);
    design_free(&design);
    nurbs_grid_free(parent.grid);
}

/* The waterline y = (B/2)(1 - 4x^2) has the chords dy/dx = -2 B (x_i + x_{i+1}). */
static void test_entrance(void)
{
    enum { ROWS = 41, COLUMNS = 17, N = 3 * ROWS * COLUMNS };
    double points[N];
    struct latent latent = {.modes = 1, .coordinates = N, .spectrum = 1};
    struct entrance entrance;
    nurbs_grid *grid;
    wigley_grid(ROWS, COLUMNS, 0.02, points);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, points, &grid), NURBS_OK);
    CU_ASSERT_TRUE_FATAL(latent_allocate(&latent));
    for (size_t k = 0; k < N; k += 3)
        latent.vectors[k + 1] = points[k + 1];
    const double slope = 2 * BEAM * (1 - 1.0 / (ROWS - 1)), wider = 1.2 * slope;
    CU_ASSERT_TRUE_FATAL(entrance_create(grid, 0.3, &entrance));
    CU_ASSERT_EQUAL(entrance.n, ROWS);
    CHECK_RELATIVE(entrance.largest, slope / sqrt(1 + slope * slope), 1e-3);
    const double u[1] = {0.2}, parent[1] = {0};
    CHECK_CLOSE(entrance_ratio(&entrance, &latent, parent), 1, 1e-12);
    CHECK_RELATIVE(entrance_ratio(&entrance, &latent, u),
                   1.2 * sqrt((1 + slope * slope) / (1 + wider * wider)), 1e-3);
    entrance_free(&entrance);
    /* Steeper pieces than the solver's nu_s are stem arcs and do not count. */
    CU_ASSERT_TRUE_FATAL(entrance_create(grid, 0.1, &entrance));
    CU_ASSERT_TRUE(entrance.largest <= 0.101 && entrance.largest > 0.09);
    entrance_free(&entrance);
    latent_free(&latent);
    nurbs_grid_free(grid);
}

static void test_allowed_designs(void)
{
    struct evaluation parent = {.id = 0, .cw = 2, .cw_pressure = 3};
    struct evaluation better = {.id = 5, .cw = 1, .cw_pressure = 3.2};
    const struct outcome_limits none = {NAN, NAN}, loose = {1.1, NAN}, tight = {1, NAN},
                                speeds = {NAN, 1};
    CU_ASSERT_TRUE(outcome_allowed(&none, &better, &parent));
    CU_ASSERT_TRUE(outcome_allowed(&loose, &better, &parent));
    CU_ASSERT_FALSE(outcome_allowed(&tight, &better, &parent));
    CU_ASSERT_TRUE(outcome_allowed(&tight, &parent, &parent));
    better.failed = true;
    CU_ASSERT_FALSE(outcome_allowed(&none, &better, &parent));
    parent.cw_pressure = better.cw_pressure = NAN;
    better.failed = false;
    CU_ASSERT_FALSE(outcome_allowed(&tight, &better, &parent));
    parent.speeds = better.speeds = 2;
    parent.cw_speed[0] = parent.cw_speed[1] = 1;
    better.cw_speed[0] = 0.5;
    better.cw_speed[1] = 1.01;
    CU_ASSERT_FALSE(outcome_allowed(&speeds, &better, &parent));
    CU_ASSERT_TRUE(outcome_allowed(&none, &better, &parent));
    better.cw_speed[1] = 0.99;
    CU_ASSERT_TRUE(outcome_allowed(&speeds, &better, &parent));
    better.cw_speed[0] = NAN;
    CU_ASSERT_FALSE(outcome_allowed(&speeds, &better, &parent));
    double bound[OUTCOME_MOST], ratio[OUTCOME_MOST];
    const struct outcome_limits both = {1.1, 1};
    better.cw_speed[0] = 0.25;
    parent.cw_pressure = 2;
    better.cw_pressure = 1;
    CU_ASSERT_EQUAL_FATAL(outcome_bounds(&both, 2, bound), 3);
    outcome_ratios(&both, &better, &parent, ratio);
    CU_ASSERT_EQUAL(bound[0], 1.1);
    CU_ASSERT_EQUAL(bound[2], 1);
    CU_ASSERT_EQUAL(ratio[0], 0.5);
    CU_ASSERT_EQUAL(ratio[1], 0.25);
    CU_ASSERT_EQUAL(ratio[2], 0.99);
}

static const struct check_case cases[] = {
    {"displacement of a grid converges", test_volume_converges},
    {"displacement of a box is exact", test_volume_cut},
    {"limits from the grid", test_limits_of_grid},
    {"limits from built hulls", test_limits_of_hull},
    {"steepest waterline", test_entrance},
    {"designs that can be the best", test_allowed_designs},
    {"grid parameters keep kinks", test_parameters},
    {"from a grid to the light patch", test_design},
};

CHECK_MAIN("hullopt geometry", cases)
