/* NaN, Inf, empty, decreasing and too few: every public function that takes numbers answers with a
 * status and a sentence, and leaves its result NULL. */
#include "check.h"

#include <nurbs/nurbs.h>

#include <string.h>
#include <unistd.h>

static void refused(nurbs_status status, const void *result, const char *call, unsigned line)
{
    int good = status < 0 && strlen(nurbs_last_error()) > 10 && !result;
    if (!good)
        fprintf(stderr, "%s:%u: %s: status %d%s\n", __FILE__, line, call, (int)status,
                result ? ", with a result" : "");
    CU_assertImplementation(good ? CU_TRUE : CU_FALSE, line, call, __FILE__, "", CU_FALSE);
}

/* `result` is read after the call and set back. */
#define REFUSED(call, result)                                                                      \
    do {                                                                                           \
        nurbs_status status_ = (call);                                                             \
        refused(status_, (const void *)(result), #call, __LINE__);                                 \
    } while (0)

static const double knots[8] = {0, 0, 0, 0, 1, 1, 1, 1};
static const int cubic[2] = {3, 3};
static const size_t four[2] = {4, 4};

static void fill(double *points)
{
    for (int k = 0; k < 16; k++) {
        points[3 * k] = k / 4;
        points[3 * k + 1] = 0.2 * (k % 4);
        points[3 * k + 2] = -0.3 * (k % 4);
    }
}

static nurbs_surface *good_surface(void)
{
    double points[48];
    nurbs_surface *surface = NULL;
    fill(points);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(cubic, four, knots, knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

static nurbs_curve *good_curve(void)
{
    double points[48];
    nurbs_curve *curve = NULL;
    fill(points);
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_create(3, 4, knots, points, NULL, &curve), NURBS_OK);
    return curve;
}

static void creation(void)
{
    const double wrong[] = {NAN, INFINITY, -INFINITY};
    static const double bad_knots[][8] = {
        {0, 0, 0, 0, 0, 0, 0, 0},   {1, 1, 1, 1, 0, 0, 0, 0},         {0, 0, 0, 0.5, 0.4, 1, 1, 1},
        {0, 0, 0, 0, 1, 1, 1, NAN}, {-INFINITY, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 1, 1, 1},
        {0, 0, 0, 0, 1, 1, 1, 2},
    };
    double points[48], weights[16];
    nurbs_surface *surface = NULL;
    nurbs_curve *curve = NULL;
    fill(points);
    for (int k = 0; k < 16; k++)
        weights[k] = 1;
    for (size_t k = 0; k < sizeof bad_knots / sizeof bad_knots[0]; k++) {
        REFUSED(nurbs_curve_create(3, 4, bad_knots[k], points, NULL, &curve), curve);
        REFUSED(nurbs_surface_create(cubic, four, bad_knots[k], knots, points, NULL, &surface),
                surface);
        REFUSED(nurbs_surface_create(cubic, four, knots, bad_knots[k], points, NULL, &surface),
                surface);
    }
    const int degrees[] = {0, -1, 26, 1000000};
    for (int k = 0; k < 4; k++) {
        REFUSED(nurbs_curve_create(degrees[k], 4, knots, points, NULL, &curve), curve);
        REFUSED(nurbs_surface_create((const int[]){3, degrees[k]}, four, knots, knots, points, NULL,
                                     &surface),
                surface);
    }
    const size_t sizes[] = {0, 1, 3, (size_t)-1, (size_t)1 << 62};
    for (int k = 0; k < 5; k++) {
        REFUSED(nurbs_curve_create(3, sizes[k], knots, points, NULL, &curve), curve);
        REFUSED(nurbs_surface_create(cubic, (const size_t[]){sizes[k], 4}, knots, knots, points,
                                     NULL, &surface),
                surface);
    }
    for (int k = 0; k < 3; k++) {
        points[7] = wrong[k];
        REFUSED(nurbs_curve_create(3, 4, knots, points, NULL, &curve), curve);
        REFUSED(nurbs_surface_create(cubic, four, knots, knots, points, NULL, &surface), surface);
    }
    fill(points);
    const double bad_weights[] = {0, -1, NAN, INFINITY};
    for (int k = 0; k < 4; k++) {
        weights[2] = bad_weights[k];
        REFUSED(nurbs_curve_create(3, 4, knots, points, weights, &curve), curve);
        REFUSED(nurbs_surface_create(cubic, four, knots, knots, points, weights, &surface),
                surface);
    }
}

static void changes(void)
{
    nurbs_surface *surface = good_surface(), *out = NULL, *other = NULL;
    nurbs_curve *curve = good_curve(), *cut = NULL, *rest = NULL;
    const double wrong[] = {NAN, INFINITY, -1, 2};
    for (int k = 0; k < 4; k++) {
        double t = wrong[k];
        REFUSED(nurbs_curve_insert(curve, 1, &t, &cut), cut);
        REFUSED(nurbs_surface_insert(surface, 1, 1, &t, &out), out);
        REFUSED(nurbs_curve_split(curve, t, &cut, &rest), cut);
        REFUSED(nurbs_surface_split(surface, 0, t, &out, &other), out);
        REFUSED(nurbs_curve_part(curve, t, 1, &cut), cut);
        REFUSED(nurbs_surface_part(surface, 0, 0.5, t, &out), out);
        REFUSED(nurbs_surface_iso_curve(surface, 0, t, &cut), cut);
        REFUSED(nurbs_curve_remove(curve, t, 1, &cut, NULL), cut);
        REFUSED(nurbs_surface_remove(surface, 0, t, 1, &out, NULL), out);
    }
    REFUSED(nurbs_curve_insert(curve, 2, (const double[]){0.6, 0.4}, &cut), cut);
    REFUSED(nurbs_curve_insert(curve, 4, (const double[]){0.5, 0.5, 0.5, 0.5}, &cut), cut);
    REFUSED(nurbs_curve_part(curve, 0.7, 0.3, &cut), cut);
    REFUSED(nurbs_surface_part(surface, 0, 0.5, 0.5, &out), out);
    REFUSED(nurbs_curve_elevate(curve, -1, &cut), cut);
    REFUSED(nurbs_curve_elevate(curve, 1000, &cut), cut);
    REFUSED(nurbs_surface_elevate(surface, 2, 1, &out), out);
    REFUSED(nurbs_surface_elevate(surface, 0, -1, &out), out);
    REFUSED(nurbs_surface_refine(surface, 0, &out), out);
    REFUSED(nurbs_surface_reverse(surface, -1, &out), out);
    double matrix[9] = {1, 0, 0, 0, NAN, 0, 0, 0, 1};
    REFUSED(nurbs_surface_transform(surface, matrix, NULL, &out), out);
    REFUSED(nurbs_surface_transform(surface, NULL, (const double[]){0, INFINITY, 0}, &out), out);
    const double tolerances[] = {NAN, 0, -1, INFINITY};
    for (int k = 0; k < 4; k++) {
        REFUSED(nurbs_curve_simplify(curve, tolerances[k], &cut, NULL), cut);
        REFUSED(nurbs_surface_simplify(surface, tolerances[k], 0, &out, NULL), out);
        REFUSED(nurbs_surface_simplify_geometric(surface, tolerances[k], 0, &out, NULL), out);
        REFUSED(nurbs_surface_wetted(surface, -0.2, tolerances[k], &out), out);
    }
    REFUSED(nurbs_surface_wetted(surface, NAN, 1e-3, &out), out);
    nurbs_surface_free(surface);
    nurbs_curve_free(curve);
}

static void questions(void)
{
    nurbs_surface *surface = good_surface();
    nurbs_curve *curve = good_curve();
    const double wrong[] = {NAN, INFINITY, -0.1, 1.1};
    double out[90], uv[2];
    size_t columns[16], span[2];
    for (int k = 0; k < 4; k++)
        for (int d = 0; d < 2; d++) {
            uv[d] = wrong[k];
            uv[!d] = 0.5;
            REFUSED(nurbs_surface_eval(surface, 1, 1, uv, out), NULL);
            REFUSED(nurbs_surface_eval_grid(surface, 0, 1, &uv[0], 1, &uv[1], out), NULL);
            REFUSED(nurbs_surface_basis(surface, 1, uv[0], uv[1], span, out), NULL);
            REFUSED(nurbs_surface_rows(surface, 0, 1, uv, columns, out), NULL);
            REFUSED(nurbs_surface_normals(surface, 1, uv, out), NULL);
            REFUSED(nurbs_surface_curvatures(surface, 1, uv, out), NULL);
            REFUSED(nurbs_curve_eval(curve, 0, 1, &wrong[k], out), NULL);
            REFUSED(nurbs_curve_curvatures(curve, 1, &wrong[k], out), NULL);
            REFUSED(nurbs_surface_closest_near(surface, 1, (const double[]){0, 0, 0}, uv, NULL),
                    NULL);
        }
    uv[0] = uv[1] = 0.5;
    REFUSED(nurbs_surface_eval(surface, 51, 1, uv, out), NULL);
    REFUSED(nurbs_surface_eval(surface, -1, 1, uv, out), NULL);
    REFUSED(nurbs_curve_eval(curve, -1, 1, uv, out), NULL);
    REFUSED(nurbs_curve_eval(curve, 51, 1, uv, out), NULL);
    REFUSED(nurbs_surface_eval_grid(surface, 0, 2, (const double[]){0.6, 0.4}, 1, uv, out), NULL);
    const double far[3] = {0, NAN, 0};
    REFUSED(nurbs_surface_closest(surface, 1, far, uv, NULL), NULL);
    REFUSED(nurbs_curve_closest(curve, 1, far, uv, NULL), NULL);
    nurbs_contour contour;
    REFUSED(nurbs_surface_contour(surface, (const double[]){0, 0, 0}, 0, 4, &contour), NULL);
    REFUSED(nurbs_surface_contour(surface, (const double[]){0, NAN, 0}, 0, 4, &contour), NULL);
    REFUSED(nurbs_surface_contour(surface, (const double[]){0, 0, 1}, INFINITY, 4, &contour), NULL);
    REFUSED(nurbs_surface_contour(surface, (const double[]){0, 0, 1}, 0, -1, &contour), NULL);
    REFUSED(nurbs_surface_contour(surface, (const double[]){0, 0, 1}, 0, 65, &contour), NULL);
    nurbs_surface_free(surface);
    nurbs_curve_free(curve);
}

static void fits(void)
{
    double points[48], u[4] = {0, 0.3, 0.6, 1}, v[4] = {0, 0.2, 0.7, 1};
    nurbs_curve *curve = NULL;
    nurbs_surface *surface = NULL;
    nurbs_grid *grid = NULL, *none = NULL;
    fill(points);
    REFUSED(nurbs_curve_interpolate(3, 3, points, u, &curve), curve);
    REFUSED(nurbs_curve_interpolate(0, 4, points, u, &curve), curve);
    REFUSED(nurbs_curve_interpolate(3, 4, points, (const double[]){0, 0.5, 0.5, 1}, &curve), curve);
    REFUSED(nurbs_curve_interpolate(3, 4, points, (const double[]){0, NAN, 0.5, 1}, &curve), curve);
    REFUSED(nurbs_curve_fit(3, 4, knots, 3, points, u, &curve), curve);
    REFUSED(nurbs_curve_fit(3, 4, knots, 4, points, (const double[]){0, 0.5, 0.6, 2}, &curve),
            curve);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(4, 4, points, &grid), NURBS_OK);
    REFUSED(nurbs_grid_create(1, 4, points, &none), none);
    REFUSED(nurbs_grid_create(0, 0, points, &none), none);
    REFUSED(nurbs_surface_fit(cubic, (const size_t[]){3, 4}, knots, knots, grid, u, v, &surface),
            surface);
    points[4] = NAN;
    REFUSED(nurbs_grid_create(4, 4, points, &none), none);
    REFUSED(nurbs_curve_interpolate(3, 4, points, u, &curve), curve);
    REFUSED(nurbs_curve_fit(3, 4, knots, 4, points, u, &curve), curve);
    nurbs_grid_edit(grid)[5] = INFINITY;
    REFUSED(nurbs_skin(grid, NULL, &surface), surface);
    REFUSED(nurbs_surface_fit(cubic, four, knots, knots, grid, u, v, &surface), surface);
    fill(points);
    double uv[8] = {0, 0, 1, 0, 0, 1, 1, 1};
    REFUSED(nurbs_surface_fit_points(cubic, four, knots, knots, 4, points, uv, -1, &surface),
            surface);
    REFUSED(nurbs_surface_fit_points(cubic, four, knots, knots, 4, points, uv, NAN, &surface),
            surface);
    REFUSED(nurbs_surface_fit_points(cubic, four, knots, knots, 0, points, uv, 1e-8, &surface),
            surface);
    uv[3] = 1.5;
    REFUSED(nurbs_surface_fit_points(cubic, four, knots, knots, 4, points, uv, 1e-8, &surface),
            surface);
    REFUSED(nurbs_skin_curves(0, NULL, NULL, 3, 0, &surface), surface);
    nurbs_curve *section = good_curve();
    const nurbs_curve *sections[2] = {section, section};
    REFUSED(nurbs_skin_curves(1, sections, NULL, 1, 0, &surface), surface);
    REFUSED(nurbs_skin_curves(2, sections, (const double[]){0, NAN}, 1, 0, &surface), surface);
    REFUSED(nurbs_skin_curves(2, sections, (const double[]){1, 0}, 1, 0, &surface), surface);
    REFUSED(nurbs_skin_curves(2, sections, NULL, 1, NAN, &surface), surface);
    nurbs_curve_free(section);
    nurbs_grid_free(grid);
}

static void bodies_and_files(void)
{
    nurbs_surface *surface = NULL;
    nurbs_patches *patches = NULL, *read = NULL;
    const double lengths[] = {NAN, 0, -1, INFINITY};
    for (int k = 0; k < 4; k++) {
        REFUSED(nurbs_make_wigley(1, lengths[k], 1, &surface), surface);
        REFUSED(nurbs_make_ellipsoid(lengths[k], 1, 1, 0, &surface), surface);
    }
    REFUSED(nurbs_make_ellipsoid(1, 1, 1, NAN, &surface), surface);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    REFUSED(nurbs_patches_set_length(patches, NAN), NULL);
    REFUSED(nurbs_patches_set_length(patches, -1), NULL);
    REFUSED(nurbs_patches_set_parameters(patches, 0, 2, knots, 2, knots), NULL);
    REFUSED(nurbs_patches_write_iges(patches, "nothing.igs"), NULL);
    REFUSED(nurbs_patches_write(patches, "/nonexistent/x.json"), NULL);
    REFUSED(nurbs_patches_write(patches, "x.step"), NULL);
    REFUSED(nurbs_patches_write_stl(patches, -1, "x.stl"), NULL);
    REFUSED(nurbs_patches_write_vtu(patches, -1, "x.vtu"), NULL);
    REFUSED(nurbs_patches_read("/nonexistent/x.json", &read), read);
    REFUSED(nurbs_patches_read("/nonexistent/x.igs", &read), read);
    REFUSED(nurbs_patches_read("x.dwg", &read), read);
    REFUSED(nurbs_patches_read(".", &read), read);
    CU_ASSERT_PTR_NULL(nurbs_patches_get(patches, 0));
    nurbs_patches_free(patches);
}

static const struct check_case cases[] = {
    {"creation", creation},
    {"changes", changes},
    {"questions", questions},
    {"fits", fits},
    {"bodies and files", bodies_and_files},
};

CHECK_MAIN("nurbs bad input", cases)
