/* The space of the density: numbering, collocation points, interpolation. */
#include "check.h"
#include "hulls.h"
#include "space/density.h"

static const struct density_rule hull_basis = {.degree = 3, .refine = {1, 1}};
static const struct density_rule own_basis = {.degree = 3, .refine = {1, 1}, .elements = {7, 4}};

static struct density *make(const igabem_hull *hull, const struct density_rule *rule)
{
    struct density *density = NULL;
    igabem_status status = density_create(hull, rule, &density);
    if (status != IGABEM_OK)
        fprintf(stderr, "density: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return density;
}

static void test_sizes(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 6, 3);
    struct density *density = make(hull, &hull_basis);
    /* raised to degree 3; the knots are simple because the shape is one polynomial */
    CU_ASSERT_EQUAL(density->patch[0].size[0], 6 + 3);
    CU_ASSERT_EQUAL(density->patch[0].size[1], 3 + 3);
    CU_ASSERT_EQUAL(density->n, 9 * 6);
    density_free(density);
    density = make(hull, &own_basis);
    CU_ASSERT_EQUAL(density->n, (7 + 3) * (4 + 3));
    CU_ASSERT_EQUAL(density->patch[0].panels[0], 7);
    CU_ASSERT_EQUAL(density->patch[0].panels[1], 4);
    /* elements end at the knots of both: sixths and sevenths, thirds and quarters */
    CU_ASSERT_EQUAL(density->patch[0].spans[0], 12);
    CU_ASSERT_EQUAL(density->patch[0].spans[1], 6);
    density_free(density);
    igabem_hull_free(hull);
}

static void test_collocation_points(void)
{
    igabem_hull *hulls[2] = {wigley_hull(0.1, 0.0625, 6, 3),
                             ellipsoid_hull(1.0, 0.2, 0.2, 0.3, 3, 2)};
    const struct density_rule *rules[2] = {&hull_basis, &own_basis};
    for (int h = 0; h < 2; h++)
        for (int r = 0; r < 2; r++) {
            struct density *density = make(hulls[h], rules[r]);
            const struct density_patch *patch = &density->patch[0];
            for (int d = 0; d < 2; d++)
                for (size_t i = 0; i + 1 < patch->size[d]; i++)
                    CU_ASSERT(patch->abscissa[d][i] < patch->abscissa[d][i + 1]);
            for (size_t i = 0; i < density->n; i++) {
                const double *p = density->point + 3 * i, *n = density->normal + 3 * i;
                CU_ASSERT(p[2] < -1e-4);
                CU_ASSERT(p[1] > 1e-6);
                CHECK_CLOSE(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1.0, 1e-14);
                CU_ASSERT(n[1] > 0);
            }
            density_free(density);
        }
    igabem_hull_free(hulls[0]);
    igabem_hull_free(hulls[1]);
}

/* Spans along the waterline stay as wide as asked, and grow narrower from there. */
static void test_waterline_span(void)
{
    igabem_hull *hulls[2] = {wigley_hull(0.1, 0.0625, 2, 2),
                             ellipsoid_hull(1, 0.2, 0.2, 0.3, 1, 1)};
    for (int elements = 8; elements <= 24; elements += 8)
        for (int k = 0; k < 2; k++) {
            const struct density_rule rule = {
                .degree = 3, .refine = {1, 1}, .elements = {6, elements}, .waterline_span = 0.1};
            struct density *density = make(hulls[k], &rule);
            const struct density_patch *patch = &density->patch[0];
            const double *knots = patch->knots[1] + patch->degree[1];
            int graded = k == 0 && elements > 10;
            CHECK_CLOSE(knots[1], graded ? 0.1 : 1.0 / elements, 1e-14);
            CHECK_CLOSE(knots[elements], 1.0, 0);
            for (int i = 1; i < elements && graded; i++)
                CU_ASSERT(knots[i + 1] - knots[i] < knots[i] - knots[i - 1]);
            CHECK_CLOSE(patch->knots[0][patch->degree[0] + 1], 1.0 / 6, 1e-15);
            density_free(density);
        }
    igabem_hull_free(hulls[0]);
    igabem_hull_free(hulls[1]);
}

/* The shape's own coordinates lie in its space, so interpolation gives them back everywhere. */
static void check_coordinates(const igabem_hull *hull, const struct density_rule *rule, double tol)
{
    struct density *density = make(hull, rule);
    double *field = malloc(3 * density->n * sizeof *field);
    CU_ASSERT_PTR_NOT_NULL_FATAL(field);
    for (size_t i = 0; i < density->n; i++)
        for (size_t c = 0; c < 3; c++)
            field[c * density->n + i] = density->point[3 * i + c];
    CU_ASSERT_EQUAL(density_interpolate(density, 3, field), IGABEM_OK);
    for (int k = 0; k < 50; k++) {
        double uv[2], value[3], point[3];
        for (int d = 0; d < 2; d++) {
            const double *range = density->patch[0].hull.domain[d];
            uv[d] = range[0] + (range[1] - range[0]) * fmod(0.37 * k * (d + 1.3), 1.0);
        }
        CU_ASSERT_EQUAL(density_evaluate(density, 0, 3, field, 1, uv, value), IGABEM_OK);
        CU_ASSERT_EQUAL(nurbs_surface_eval(density->patch[0].surface, 0, 1, uv, point), NURBS_OK);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(value[c], point[c], tol);
    }
    free(field);
    density_free(density);
}

static void test_interpolation(void)
{
    igabem_hull *wigley = wigley_hull(0.1, 0.0625, 6, 3);
    igabem_hull *ellipsoid = ellipsoid_hull(1.0, 0.2, 0.3, 0.3, 3, 2);
    check_coordinates(wigley, &hull_basis, 1e-14);
    check_coordinates(wigley, &own_basis, 1e-14); /* one polynomial per direction */
    check_coordinates(ellipsoid, &hull_basis, 1e-14);
    const struct density_rule fine = {.degree = 3, .refine = {1, 1}, .elements = {40, 30}};
    check_coordinates(ellipsoid, &fine, 1e-6); /* not a spline */
    igabem_hull_free(wigley);
    igabem_hull_free(ellipsoid);
}

static void test_refusals(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 2, 2);
    struct density *density = NULL;
    const struct density_rule high = {.degree = 10, .refine = {1, 1}};
    CU_ASSERT_EQUAL(density_create(hull, &high, &density), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(density);
    density = make(hull, &hull_basis);
    double field = 0.0, uv[2] = {-1.0, 0.5};
    CU_ASSERT_EQUAL(density_evaluate(density, 0, 0, &field, 1, uv, &field), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(density_evaluate(density, 1, 0, &field, 1, uv, &field), IGABEM_ERROR_ARGUMENT);
    density_free(density);
    igabem_hull_free(hull);
}

static const struct check_case cases[] = {
    {"sizes of hull and own basis", test_sizes},
    {"collocation points", test_collocation_points},
    {"spans at the waterline", test_waterline_span},
    {"interpolation gives the shape back", test_interpolation},
    {"refusals", test_refusals},
};

CHECK_MAIN("density", cases)
