/* Particulars and fairness of grids against closed forms of the Wigley hull, y = b (1 - 4 x^2)(1 -
 * z^2/T^2), and of a wall-sided wave, y = c + a sin(2 pi k x). */
#include "check.h"

#include <galv/galv.h>

static const double PI = 3.14159265358979323846;
static const double HALF_BEAM = 0.05, DRAFT = 0.0625;

enum { ROWS = 161, COLUMNS = 81 };
static double points[3 * ROWS * COLUMNS];

/* Length 1, girth from the keel to a little above the water. */
static void wigley(size_t rows, size_t columns)
{
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            double x = (double)i / (double)(rows - 1) - 0.5;
            double z = -DRAFT + 1.1 * DRAFT * (double)j / (double)(columns - 1);
            double *p = points + 3 * (i * columns + j);
            p[0] = x;
            p[1] = HALF_BEAM * (1 - 4 * x * x) * (z < 0 ? 1 - z * z / (DRAFT * DRAFT) : 1);
            p[2] = z;
        }
}

static galv_particulars measure(size_t rows, size_t columns)
{
    galv_particulars p = {.volume = NAN};
    CU_ASSERT_EQUAL(galv_grid_particulars(rows, columns, points, &p), GALV_OK);
    return p;
}

static void test_wigley(void)
{
    wigley(ROWS, COLUMNS);
    galv_particulars p = measure(ROWS, COLUMNS);
    double volume = 8.0 / 9 * HALF_BEAM * DRAFT;
    CHECK_RELATIVE(p.volume, volume, 1e-3);
    CHECK_CLOSE(p.lcb, 0, 1e-4);
    CHECK_RELATIVE(p.vcb, -3 * DRAFT / 8, 1e-3);
    CHECK_RELATIVE(p.waterplane_area, 4.0 / 3 * HALF_BEAM, 1e-4);
    CHECK_RELATIVE(p.waterplane_inertia, 2.0 / 3 * pow(HALF_BEAM, 3) * 16 / 35, 1e-3);
    CHECK_RELATIVE(p.beam, 2 * HALF_BEAM, 1e-4);
    CHECK_RELATIVE(p.draft, DRAFT, 1e-12);
    CHECK_RELATIVE(p.section_area, 4.0 / 3 * HALF_BEAM * DRAFT, 1e-3);
    CHECK_CLOSE(p.transom_beam, 0, 1e-12);
    CHECK_RELATIVE(p.transom_draft, DRAFT, 1e-12);
}

/* Convex curves turn by the difference of their end slopes: of the waterline at z between +-4 b(z),
 * of the section at x from 0 to 2 b(x)/T. The polygon lacks half an end piece each. */
static void test_convex_curves(void)
{
    double waterlines = 0, sections = 0;
    galv_fairness w, s;
    wigley(ROWS, COLUMNS);
    CU_ASSERT_EQUAL(galv_grid_fairness(ROWS, COLUMNS, points, &w, &s), GALV_OK);
    for (int k = 0; k < 5; k++)
        waterlines += 2 * atan(4 * HALF_BEAM * (1 - 0.04 * k * k));
    for (size_t i = 0; i < ROWS; i++) {
        double x = (double)i / (ROWS - 1) - 0.5;
        sections += atan(2 * HALF_BEAM * (1 - 4 * x * x) / DRAFT);
    }
    CHECK_RELATIVE(w.turning, waterlines, 0.01);
    CHECK_RELATIVE(s.turning, sections, 0.02);
    CU_ASSERT_EQUAL(w.inflections, 0);
    CU_ASSERT_EQUAL(s.inflections, 0);
    CHECK_RELATIVE(w.radius, 1 / (8 * HALF_BEAM), 0.01);
}

/* Wall-sided: five equal waterlines with 2 k - 1 inflections between the ends, a turn of 4 atan(a
 * w) for each of the k waves but half a quarter at the ends, radius 1/(a w^2), w = 2 pi k. */
static void test_wave(void)
{
    const double a = 0.004;
    const int waves = 2;
    double w = 2 * PI * waves;
    for (size_t i = 0; i < ROWS; i++)
        for (size_t j = 0; j < 3; j++) {
            double *p = points + 3 * (3 * i + j);
            p[0] = (double)i / (ROWS - 1) - 0.5;
            p[1] = 0.3 + a * sin(w * p[0]);
            p[2] = -0.2 + 0.15 * (double)j;
        }
    galv_fairness lines, sections;
    CU_ASSERT_EQUAL(galv_grid_fairness(ROWS, 3, points, &lines, &sections), GALV_OK);
    CU_ASSERT_EQUAL(lines.inflections, 5 * (2 * waves - 1));
    CHECK_RELATIVE(lines.turning, 5 * waves * 4 * atan(a * w), 0.01);
    CHECK_RELATIVE(lines.radius, 1 / (a * w * w), 0.01);
    /* The integral of y''^2 for small slopes: a^2 w^4 / 2 a waterline. */
    CHECK_RELATIVE(lines.energy, 5 * a * a * pow(w, 4) / 2, 0.02);
    CHECK_CLOSE(sections.turning, 0, 1e-12);
    for (int k = 0; k < 9; k++) {
        double x = -0.47 + 0.11 * k;
        CHECK_CLOSE(galv_grid_half_breadth(ROWS, 3, points, x, -0.03), 0.3 + a * sin(w * x), 1e-5);
    }
    CU_ASSERT_TRUE(isnan(galv_grid_half_breadth(ROWS, 3, points, 0.6, 0)));
    CU_ASSERT_TRUE(isnan(galv_grid_half_breadth(ROWS, 3, points, 0, -0.3)));
}

/* Wider by a tenth: ratios are exact whatever the grid is. */
static void test_ratios(void)
{
    wigley(21, 9);
    galv_particulars before = measure(21, 9);
    for (size_t k = 0; k < 21 * 9; k++) {
        points[3 * k] += 0.02;
        points[3 * k + 1] *= 1.1;
    }
    galv_particulars after = measure(21, 9);
    CHECK_RELATIVE(after.volume, 1.1 * before.volume, 1e-12);
    CHECK_RELATIVE(after.waterplane_inertia, pow(1.1, 3) * before.waterplane_inertia, 1e-12);
    CHECK_CLOSE(after.lcb - before.lcb, 0.02, 1e-12);
    CHECK_RELATIVE(after.section_area, 1.1 * before.section_area, 1e-12);
}

static void test_refusals(void)
{
    galv_particulars p;
    wigley(21, 9);
    CU_ASSERT_EQUAL(galv_grid_particulars(21, 9, points, NULL), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_grid_particulars(1, 9, points, &p), GALV_ERROR_ARGUMENT);
    for (size_t k = 0; k < 21 * 9; k++)
        points[3 * k + 2] += 1;
    CU_ASSERT_EQUAL(galv_grid_particulars(21, 9, points, &p), GALV_ERROR_GEOMETRY);
}

static const struct check_case cases[] = {
    {"particulars of a Wigley hull", test_wigley},
    {"convex curves", test_convex_curves},
    {"waves", test_wave},
    {"ratios", test_ratios},
    {"refusals", test_refusals},
};

CHECK_MAIN("galv particulars", cases)
