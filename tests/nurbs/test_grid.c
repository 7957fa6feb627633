#include "check.h"
#include "hulls.h"

#include <locale.h>
#include <string.h>
#include <unistd.h>

static const double unit[12] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0.1};

static void creates_and_copies(void)
{
    nurbs_grid *grid;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(2, 2, unit, &grid), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_grid_rows(grid), 2);
    CU_ASSERT_EQUAL(nurbs_grid_columns(grid), 2);
    CU_ASSERT(nurbs_grid_points(grid) != unit);
    CU_ASSERT_EQUAL(memcmp(nurbs_grid_points(grid), unit, sizeof unit), 0);
    nurbs_grid_edit(grid)[2] = 7;
    CHECK_CLOSE(nurbs_grid_points(grid)[2], 7, 0);
    nurbs_grid_free(grid);
    nurbs_grid_free(NULL);
}

static void refuses_bad_sizes_and_points(void)
{
    nurbs_grid *grid;
    double bad[12];
    memcpy(bad, unit, sizeof bad);
    bad[7] = NAN;
    CU_ASSERT_EQUAL(nurbs_grid_create(1, 5, NULL, &grid), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(grid);
    CU_ASSERT_EQUAL(nurbs_grid_create((size_t)1 << 40, (size_t)1 << 40, NULL, &grid),
                    NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_grid_create(2, 2, bad, &grid), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "(2,1)"));
}

static void file_restores_every_bit(void)
{
    nurbs_grid *grid, *back;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(2, 2, unit, &grid), NURBS_OK);
    nurbs_grid_edit(grid)[0] = 1.0 / 3;
    nurbs_grid_edit(grid)[5] = -2.2250738585072014e-308;
    const char *path = scratch_file("grid.csv");
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_write(grid, path), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_read(path, &back), NURBS_OK);
    CU_ASSERT_EQUAL(memcmp(nurbs_grid_points(grid), nurbs_grid_points(back), 12 * sizeof(double)),
                    0);
    unlink(path);
    nurbs_grid_free(grid);
    nurbs_grid_free(back);
}

static void reads_any_order_comments_and_crlf(void)
{
    const char *path = write_scratch("order.csv", "# comment\r\n I , j,X,y,z\r\n2,2,4,0,-1e-3\r\n"
                                                  "\r\n1,2,2,0,0\r\n# more\r\n2, 1 ,3,0,0\r\n"
                                                  "1,1,1,.5,0");
    nurbs_grid *grid;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_read(path, &grid), NURBS_OK);
    const double *p = nurbs_grid_points(grid);
    CHECK_CLOSE(p[0], 1, 0);
    CHECK_CLOSE(p[1], 0.5, 0);
    CHECK_CLOSE(p[3], 2, 0);
    CHECK_CLOSE(p[6], 3, 0);
    CHECK_CLOSE(p[11], -1e-3, 0);
    nurbs_grid_free(grid);
    unlink(path);
}

static void names_the_line_at_fault(void)
{
    static const struct {
        const char *text, *expected;
    } cases[] = {
        {"", "no points"},
        {"x,y,z\n1,2,3\n", ":1: expected the header"},
        {"i,j,x,y,z\n1,1,0,0,0\n1,2,0,nan,0\n", ":3: column y"},
        {"i,j,x,y,z\n1,1,0,0\n", ":2: "},
        {"i,j,x,y,z\n1,1,0,0,0,9\n", ":2: more than"},
        {"i,j,x,y,z\n0,1,0,0,0\n", ":2: column i"},
        {"i,j,x,y,z\n1,1,0,0,0\n1,2,0,0,0\n2,1,0,0,0\n", "3 points"},
        {"i,j,x,y,z\n1,1,0,0,0\n1,2,0,0,0\n2,2,0,0,0\n2,2,1,0,0\n", ":5: point (2,2) is given"},
        {"i,j,x,y,z\n1,1,0,0,0\n1,2,1e999,0,0\n", ":3: column x"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        nurbs_grid *grid;
        const char *path = write_scratch("bad.csv", cases[k].text);
        CU_ASSERT_EQUAL(nurbs_grid_read(path, &grid), NURBS_ERROR_FORMAT);
        CU_ASSERT_PTR_NULL(grid);
        if (!strstr(nurbs_last_error(), cases[k].expected)) {
            fprintf(stderr, "case %zu: '%s'\n", k, nurbs_last_error());
            CU_FAIL("the message does not name the fault");
        }
        unlink(path);
    }
    nurbs_grid *grid;
    CU_ASSERT_EQUAL(nurbs_grid_read("/nonexistent/grid.csv", &grid), NURBS_ERROR_FILE);
}

/* A program in a locale with decimal commas must read and write the same files. */
static void ignores_the_locale(void)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"};
    nurbs_grid *grid;
    for (size_t k = 0; k < 3 && !setlocale(LC_NUMERIC, names[k]); k++)
        ;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(2, 2, unit, &grid), NURBS_OK);
    const char *path = scratch_file("locale.csv");
    CU_ASSERT_EQUAL(nurbs_grid_write(grid, path), NURBS_OK);
    nurbs_grid_free(grid);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_read(path, &grid), NURBS_OK);
    CHECK_CLOSE(nurbs_grid_points(grid)[11], 0.1, 0);
    nurbs_grid_free(grid);
    unlink(path);
    setlocale(LC_NUMERIC, "C");
}

static void samples_the_design_grid(void)
{
    struct hull5415 hull;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    CU_ASSERT_EQUAL(nurbs_grid_rows(hull.grid), 90);
    CU_ASSERT_EQUAL(nurbs_grid_columns(hull.grid), 25);
    const double *p = nurbs_grid_points(hull.grid);
    for (size_t j = 0; j < 25; j++)
        CHECK_CLOSE(p[3 * j + 1], 0, 0); /* stem */
    for (size_t i = 0; i < 90; i++)
        CHECK_CLOSE(p[3 * (25 * i + 24) + 1], 0, 0); /* keel */
    /* Stated coordinates of the public grid at the forward end of the deck and at the dome: model
     * scale, metres; the fit may be off by 2e-5 Lpp. */
    CHECK_CLOSE(p[0], 6.11462361, 1.144e-4);
    CHECK_CLOSE(p[2], 0.40325194, 1.144e-4);
    CHECK_CLOSE(p[3 * 16], 5.68474546, 1.144e-4);
    CHECK_CLOSE(p[3 * 16 + 2], -0.15526009, 1.144e-4);
    hull5415_free(&hull);
}

static const struct check_case cases[] = {
    {"creates and copies", creates_and_copies},
    {"refuses bad sizes and points", refuses_bad_sizes_and_points},
    {"file restores every bit", file_restores_every_bit},
    {"reads any order, comments, CRLF", reads_any_order_comments_and_crlf},
    {"names the line at fault", names_the_line_at_fault},
    {"ignores the locale", ignores_the_locale},
    {"samples the design grid", samples_the_design_grid},
};

CHECK_MAIN("nurbs grid", cases)
