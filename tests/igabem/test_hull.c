/* igabem_hull: orientation, edges, particulars of bodies with known values, refusals. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static igabem_status create(const nurbs_surface *surface, igabem_hull **hull)
{
    return igabem_hull_create(&surface, 1, IGABEM_SYMMETRIC, hull);
}

/* Wigley: V = 4BLT/9, A_wp = 2BL/3, nu_x = 2B/L / sqrt(1 + (2B/L)^2) at the stem; wetted area of
 * the standard hull by exact integration. */
static void wigley_particulars(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 3, 2);
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    CHECK_RELATIVE(info.hydrostatics.volume, 4 * 0.1 * 0.0625 / 9, 1e-12);
    CHECK_RELATIVE(info.hydrostatics.wetted_area, 0.1487906310, 1e-9);
    CHECK_RELATIVE(info.hydrostatics.waterplane_area, 2 * 0.1 / 3, 1e-12);
    CHECK_RELATIVE(info.hydrostatics.centroid[2], -3 * 0.0625 / 8, 1e-12);
    CHECK_RELATIVE(info.nu_s, 0.2 / sqrt(1.04), 1e-9);
    CHECK_RELATIVE(info.length, 1.0, 1e-12);
    CU_ASSERT_EQUAL(info.surface_piercing, 1);
    CU_ASSERT_EQUAL(info.transom, 0);
    CU_ASSERT_EQUAL(igabem_hull_set_length(hull, 2.0), IGABEM_OK);
    igabem_hull_get_info(hull, &info);
    CHECK_CLOSE(info.length, 2.0, 0.0);
    CU_ASSERT_EQUAL(igabem_hull_set_length(hull, NAN), IGABEM_ERROR_ARGUMENT);
    igabem_hull_free(hull);
}

static void submerged_body(void)
{
    igabem_hull *hull = ellipsoid_hull(1.0, 0.2, 0.2, 0.2, 1, 1);
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    CHECK_RELATIVE(info.hydrostatics.volume, 3.14159265358979 / 6 * 0.04, 1e-9);
    CHECK_RELATIVE(info.length, 1.0, 1e-9);
    CU_ASSERT_EQUAL(info.surface_piercing, 0);
    CHECK_CLOSE(info.nu_s, 0.0, 0.0);
    igabem_hull_free(hull);
}

/* The orientation of the patch must not matter. */
static void either_orientation(void)
{
    nurbs_surface *surface = wigley_surface(0.1, 0.0625, 2, 1), *swapped, *reversed;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_swap(surface, &swapped), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_reverse(surface, 0, &reversed), NURBS_OK);
    const nurbs_surface *forms[2] = {swapped, reversed};
    for (int k = 0; k < 2; k++) {
        igabem_hull *hull;
        igabem_hull_info info;
        CU_ASSERT_EQUAL_FATAL(create(forms[k], &hull), IGABEM_OK);
        igabem_hull_get_info(hull, &info);
        CHECK_RELATIVE(info.hydrostatics.volume, 4 * 0.1 * 0.0625 / 9, 1e-12);
        CHECK_RELATIVE(info.nu_s, 0.2 / sqrt(1.04), 1e-9);
        igabem_hull_free(hull);
    }
    nurbs_surface_free(surface);
    nurbs_surface_free(swapped);
    nurbs_surface_free(reversed);
}

static void open_transom(void)
{
    nurbs_surface *surface = wedge_surface(0.05, 0.05);
    igabem_hull *hull;
    igabem_hull_info info;
    CU_ASSERT_EQUAL_FATAL(create(surface, &hull), IGABEM_OK);
    igabem_hull_get_info(hull, &info);
    CU_ASSERT_EQUAL(info.transom, 1);
    CHECK_RELATIVE(info.hydrostatics.transom_area, 0.05 * 0.05, 1e-6);
    CHECK_RELATIVE(info.nu_s, 0.05 / sqrt(1 + 0.05 * 0.05), 1e-9);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
}

/* y = sqrt(f^2 + 2 e f) B/2, f = 1 - 4 x^2: a stem arc of radius B^2 e on the Wigley waterline. The
 * entrance angle is that of the waterline behind the arc. */
static void stem_arc_is_left_out(void)
{
    enum { N = 161 };
    const double beam = 0.1, eps = 0.02;
    double points[3 * N], angle[N];
    for (int i = 0; i < N; i++) {
        angle[i] = 3.14159265358979 * i / (N - 1);
        double x = -0.5 * cos(angle[i]), f = 1 - 4 * x * x;
        points[3 * i] = x;
        points[3 * i + 1] = 0.5 * beam * sqrt(fmax(0, f * f + 2 * eps * f));
        points[3 * i + 2] = 0;
    }
    nurbs_curve *top, *bottom;
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_interpolate(3, N, points, angle, &top), NURBS_OK);
    for (int i = 0; i < N; i++) {
        points[3 * i + 1] = 0;
        points[3 * i + 2] = -0.1;
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_curve_interpolate(3, N, points, angle, &bottom), NURBS_OK);
    const int degree[2] = {3, 1};
    const size_t size[2] = {N, 2};
    const double knots_v[4] = {0, 0, 1, 1};
    double net[6 * N];
    for (int i = 0; i < N; i++) {
        memcpy(net + 6 * i, nurbs_curve_points(top) + 3 * i, 3 * sizeof(double));
        memcpy(net + 6 * i + 3, nurbs_curve_points(bottom) + 3 * i, 3 * sizeof(double));
    }
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_create(degree, size, nurbs_curve_knots(top), knots_v, net, NULL, &surface),
        NURBS_OK);
    igabem_hull *hull;
    igabem_status status = create(surface, &hull);
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    CU_ASSERT(info.nu_s > 0.19 && info.nu_s < 0.21);
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
    nurbs_curve_free(top);
    nurbs_curve_free(bottom);
}

static void expect_refusal(const nurbs_surface *surface, const char *words)
{
    igabem_hull *hull = (igabem_hull *)1;
    CU_ASSERT_EQUAL(create(surface, &hull), IGABEM_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NULL(hull);
    if (!strstr(igabem_last_error(), words))
        fprintf(stderr, "expected '%s' in: %s\n", words, igabem_last_error());
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), words));
}

static nurbs_surface *moved(const nurbs_surface *surface, double dy, double dz)
{
    const double shift[3] = {0, dy, dz};
    nurbs_surface *result = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(surface, NULL, shift, &result), NURBS_OK);
    return result;
}

static void refuses_bad_geometry(void)
{
    nurbs_surface *wigley = wigley_surface(0.1, 0.0625, 2, 2);
    nurbs_surface *high = moved(wigley, 0, 0.01), *low = moved(wigley, 0, -0.01),
                  *across = moved(wigley, -0.01, 0);
    expect_refusal(high, "above the still water");
    expect_refusal(low, "open at");
    expect_refusal(across, "across the centre plane");
    nurbs_surface_free(high);
    nurbs_surface_free(low);
    nurbs_surface_free(across);
    nurbs_surface_free(wigley);

    nurbs_surface *shallow;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(1, 0.2, 0.2, 0.10001, &shallow), NURBS_OK);
    expect_refusal(shallow, "no edge lies on it");
    nurbs_surface_free(shallow);
}

/* A control point pulled far along the hull folds the surface. */
static void refuses_fold(void)
{
    nurbs_surface *wigley = wigley_surface(0.1, 0.0625, 8, 2), *folded;
    size_t size[2] = {nurbs_surface_size(wigley, 0), nurbs_surface_size(wigley, 1)};
    double *points = malloc(3 * size[0] * size[1] * sizeof(double));
    const int degree[2] = {nurbs_surface_degree(wigley, 0), nurbs_surface_degree(wigley, 1)};
    memcpy(points, nurbs_surface_points(wigley), 3 * size[0] * size[1] * sizeof(double));
    points[3 * (size[1] * (size[0] / 2) + size[1] / 2)] += 0.6;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(wigley, 0),
                                               nurbs_surface_knots(wigley, 1), points, NULL,
                                               &folded),
                          NURBS_OK);
    expect_refusal(folded, "fold");
    free(points);
    nurbs_surface_free(folded);
    nurbs_surface_free(wigley);
}

static void refuses_bad_arguments(void)
{
    igabem_hull *hull = NULL;
    CU_ASSERT_EQUAL(igabem_hull_create(NULL, 0, 0, &hull), IGABEM_ERROR_ARGUMENT);
    const nurbs_surface *nothing = NULL;
    CU_ASSERT_EQUAL(igabem_hull_create(&nothing, 1, 0, &hull), IGABEM_ERROR_ARGUMENT);
    nurbs_surface *wigley = wigley_surface(0.1, 0.0625, 1, 1);
    const nurbs_surface *list[1] = {wigley};
    CU_ASSERT_EQUAL(igabem_hull_create(list, 1, 64, &hull), IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(igabem_hull_create(list, 1, 0, NULL), IGABEM_ERROR_ARGUMENT);
    nurbs_surface_free(wigley);
    igabem_hull_free(NULL);
}

/* Both halves as two patches: the same particulars as the symmetric half. */
static void whole_hull(void)
{
    nurbs_surface *port = wigley_surface(0.1, 0.0625, 2, 2), *starboard;
    const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1}, shift[3] = {0, 0, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(port, mirror, shift, &starboard), NURBS_OK);
    const nurbs_surface *list[2] = {port, starboard};
    igabem_hull *hull = NULL;
    igabem_status status = igabem_hull_create(list, 2, 0, &hull);
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL(status, IGABEM_OK);
    if (hull) {
        igabem_hull_info info;
        igabem_hull_get_info(hull, &info);
        CHECK_RELATIVE(info.hydrostatics.volume, 4 * 0.1 * 0.0625 / 9, 1e-9);
        CHECK_RELATIVE(info.hydrostatics.wetted_area, 0.1487906310, 1e-9);
        CHECK_RELATIVE(info.hydrostatics.waterplane_area, 2 * 0.1 / 3, 1e-9);
        CU_ASSERT_EQUAL(info.transom, 0);
    }
    igabem_hull_free(hull);
    nurbs_surface_free(port);
    nurbs_surface_free(starboard);
}

static const struct check_case cases[] = {
    {"particulars of the Wigley hull", wigley_particulars},
    {"submerged body", submerged_body},
    {"either orientation of a patch", either_orientation},
    {"open transom", open_transom},
    {"stem arc left out of the entrance angle", stem_arc_is_left_out},
    {"hull given whole", whole_hull},
    {"refuses bad geometry with the place", refuses_bad_geometry},
    {"refuses a folded patch", refuses_fold},
    {"refuses bad arguments", refuses_bad_arguments},
};

CHECK_MAIN("hull", cases)
