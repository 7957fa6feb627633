/* Observed order and Richardson's value against sequences whose law is known, and the friction line
 * against its closed form. */
#include "check.h"

#include <igabem/friction.h>
#include <igabem/ladder.h>

#include <string.h>

static void known_order(void)
{
    for (double p = 0.5; p < 8.0; p += 0.75) {
        const double h[3] = {1.0 / 3, 1.0 / 5, 1.0 / 8};
        double c[3], order, limit;
        for (int k = 0; k < 3; k++)
            c[k] = 1.25e-3 - 4e-4 * pow(h[k], p);
        CU_ASSERT_EQUAL(igabem_ladder_order(h, c, &order, &limit), IGABEM_OK);
        CHECK_CLOSE(order, p, 1e-5);
        CHECK_RELATIVE(limit, 1.25e-3, 1e-9);
    }
}

/* Differences that change sign, that grow, and that vanish have no order. */
static void no_order(void)
{
    const double h[3] = {0.5, 0.25, 0.125};
    const double c[3][3] = {{1.0, 2.0, 1.5}, {1.0, 1.1, 1.3}, {1.0, 1.0, 1.0}};
    for (int k = 0; k < 3; k++) {
        double order = 0.0, limit = 0.0;
        CU_ASSERT_EQUAL(igabem_ladder_order(h, c[k], &order, &limit), IGABEM_OK);
        CU_ASSERT_TRUE(isnan(order) && isnan(limit));
    }
    const double wrong[3] = {0.25, 0.5, 0.125};
    double order, limit;
    CU_ASSERT_EQUAL(igabem_ladder_order(wrong, c[0], &order, &limit), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), "decreasing"));
}

static void levels(void)
{
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 2;
    igabem_ladder_level(0, &options);
    CU_ASSERT_EQUAL(options.refine, 2);
    igabem_ladder_level(2, &options);
    CU_ASSERT_EQUAL(options.refine, 5); /* 2, 3, 4.5 */
    CU_ASSERT_EQUAL(options.refine_v, 0);
    CU_ASSERT_EQUAL(options.surface_cells, 0); /* by rule */
    options.surface_cells = 24;
    options.surface_rows = 8;
    igabem_ladder_level(2, &options);
    CU_ASSERT_EQUAL(options.surface_cells, 54);
    CU_ASSERT_EQUAL(options.surface_rows, 18);
    options.refine = options.refine_v = 1;
    igabem_ladder_level(2, &options);
    CU_ASSERT_EQUAL(options.refine, 3); /* 1, 2, 3: each finer than the one before */
    CU_ASSERT_EQUAL(options.refine_v, 3);
    CU_ASSERT_EQUAL(igabem_ladder_unknowns(1), 400);
    CU_ASSERT_EQUAL(igabem_ladder_unknowns(2), 400);
    CU_ASSERT_EQUAL(igabem_ladder_unknowns(4), 79); /* 400/1.5^4 */
}

/* Re = 1e7: 0.075/25; Re = 1e9: 0.075/49. */
static void friction_line(void)
{
    CHECK_RELATIVE(igabem_friction_ittc57(1e7), 0.003, 1e-14);
    CHECK_RELATIVE(igabem_friction_ittc57(1e9), 0.075 / 49.0, 1e-14);
    CU_ASSERT_TRUE(isnan(igabem_friction_ittc57(100.0)));
    CU_ASSERT_TRUE(isnan(igabem_friction_ittc57(-1.0)));
    CU_ASSERT_TRUE(isnan(igabem_friction_ittc57(NAN)));
}

static void total_resistance(void)
{
    const igabem_forces forces = {.speed = 2.0, .wetted_area = 4.0, .cw = 1e-3};
    igabem_water water = {.density = 1000.0, .viscosity = 1e-6, .form_factor = 0.1};
    igabem_total total;
    CU_ASSERT_EQUAL(igabem_total_resistance(&forces, 5.0, &water, &total), IGABEM_OK);
    CHECK_RELATIVE(total.reynolds, 1e7, 1e-14);
    CHECK_RELATIVE(total.cf, 0.003, 1e-14);
    CHECK_RELATIVE(total.ct, 1.1 * 0.003 + 1e-3, 1e-14);
    CHECK_RELATIVE(total.rt, 0.5 * 1000.0 * 4.0 * 4.0 * 0.0043, 1e-14);
    water.viscosity = 0.0;
    CU_ASSERT_EQUAL(igabem_total_resistance(&forces, 5.0, &water, &total), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), "viscosity"));
    const igabem_forces none = {.speed = 2.0, .wetted_area = 4.0, .cw = NAN};
    water.viscosity = 1e-6;
    CU_ASSERT_EQUAL(igabem_total_resistance(&none, 5.0, &water, &total), IGABEM_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"order of a known sequence", known_order}, {"sequences without order", no_order},
    {"meshes of the levels", levels},           {"ITTC-57", friction_line},
    {"total resistance", total_resistance},
};
CHECK_MAIN("igabem_ladder", cases)
