/* Hulls that are meant otherwise: another unit, other axes, off their place, two of them. Each is
 * told or refused with the call that mends it, and the mended one is silent. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

/* The shipped DTMB 5415, without its reference length unless it is given, moved. */
static nurbs_patches *moved(const double matrix[9], const double shift[3], double length)
{
    struct hull5415 hull;
    nurbs_patches *result = NULL;
    CU_ASSERT_EQUAL_FATAL(hull5415_load(&hull), 1);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_transform(hull.file, matrix, shift, &result), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_set_length(result, length), NURBS_OK);
    hull5415_free(&hull);
    return result;
}

/* Takes the patches. The words are told, or (refused) in the sentence; NULL: nothing is told. */
static void says(nurbs_patches *patches, double draft, bool refused, const char *words)
{
    nurbs_hull_options options;
    nurbs_hull *hull = NULL;
    bool found = false;
    const char *step;
    nurbs_hull_options_init(&options);
    options.simplify = 0;
    options.draft = draft;
    nurbs_status status = nurbs_hull_create(patches, &options, &hull);
    CU_ASSERT_EQUAL(status, refused ? NURBS_ERROR_GEOMETRY : NURBS_OK);
    if (status)
        found = words && strstr(nurbs_last_error(), words);
    for (size_t k = 1; !status && (step = nurbs_hull_step(hull, k)); k++)
        found |= !words || strstr(step, words);
    CU_ASSERT_EQUAL(found, words != NULL);
    if (found != (words != NULL))
        fprintf(stderr, "expected '%s', last: '%s'\n", words ? words : "nothing",
                status ? nurbs_last_error() : "");
    nurbs_hull_free(hull);
    nurbs_patches_free(patches);
}

static void finds_other_units(void)
{
    static const double thousand[9] = {1000, 0, 0, 0, 1000, 0, 0, 0, 1000},
                        thousandth[9] = {1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3};
    says(moved(thousand, NULL, 0), NAN, false, "nurbs clean --scale 0.001");
    says(moved(thousandth, NULL, 0), NAN, false, "nurbs clean --scale 1000");
    says(moved(unit, NULL, 0), NAN, false, NULL);
}

static void finds_another_length(void)
{
    says(moved(unit, NULL, 5.72e6), NAN, true, "nurbs clean --lpp");
    says(moved(unit, NULL, 1), NAN, true, "nurbs clean --lpp");
    says(moved(unit, NULL, 8), NAN, false, "the waterline 5.69");
    says(moved(unit, NULL, 5.72), NAN, false, NULL);
}

static void finds_other_axes(void)
{
    static const double crosswise[9] = {0, 1, 0, 1, 0, 0, 0, 0, 1},
                        upright[9] = {0, 0, 1, 0, 1, 0, 1, 0, 0};
    says(moved(crosswise, NULL, 0), NAN, true, "nurbs clean --axes yxz");
    says(moved(upright, NULL, 0), NAN, true, "nurbs clean --axes");
}

static void finds_other_places(void)
{
    says(moved(unit, (const double[3]){0, 0.01, 0}, 0), NAN, true, "--shift 0,-0.01,0");
    says(moved(unit, (const double[3]){0, -0.015, 0}, 0), NAN, true, "--shift 0,0.015,0");
    says(moved(unit, (const double[3]){0, 0, 3}, 0), NAN, true, "--level");
    says(moved(unit, (const double[3]){0, 0, -3}, 0), NAN, true, "--level");
    /* The body is 0.77 m deep. */
    says(moved(unit, NULL, 0), 0.9, true, "is the draft right");
}

static void finds_two_hulls(void)
{
    nurbs_surface *wigley;
    nurbs_patches *two;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(10, 1, 0.625, &wigley), NURBS_OK);
    const double shift[3] = {30, 0, 0};
    nurbs_surface *other;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&two), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(two, wigley), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(wigley, NULL, shift, &other), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(two, other), NURBS_OK);
    says(two, NAN, false, "two bodies one behind the other");
    nurbs_surface_free(other);
    nurbs_surface_free(wigley);
}

/* Closed at both ends, so that no opening tells them apart. */
static void finds_the_bow_aft(void)
{
    static const double reversed[9] = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
    nurbs_grid *grid;
    nurbs_surface *side = NULL;
    nurbs_patches *patches, *turned;
    enum { ROWS = 61, COLUMNS = 21 };
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, NULL, &grid), NURBS_OK);
    /* The stem leans ahead below the water, the stern is upright, the waterplane fuller aft. */
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double s = i / (ROWS - 1.0), depth = j / (COLUMNS - 1.0),
                   *p = nurbs_grid_edit(grid) + 3 * (i * COLUMNS + j);
            p[0] = 10 * s + 0.3 * s * s * depth;
            p[1] = 0.8 * s * (1 - s) * (2 - s) * (1 - depth * depth);
            p[2] = -0.6 * depth;
        }
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &side), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, side), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_transform(patches, reversed, NULL, &turned), NURBS_OK);
    says(patches, NAN, false, NULL);
    says(turned, NAN, false, "nurbs clean --flip x");
    nurbs_surface_free(side);
    nurbs_grid_free(grid);
}

static const struct check_case cases[] = {
    {"finds other units", finds_other_units}, {"finds another length", finds_another_length},
    {"finds other axes", finds_other_axes},   {"finds other places", finds_other_places},
    {"finds two hulls", finds_two_hulls},     {"finds the bow aft", finds_the_bow_aft},
};

CHECK_MAIN("nurbs hull doubts", cases)
