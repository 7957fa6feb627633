#include "check.h"
#include "hulls.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

static nurbs_hydrostatics compute(const nurbs_surface *surface, double level)
{
    nurbs_hydrostatics h;
    nurbs_status status = nurbs_hydrostatics_compute(1, &surface, level, &h);
    if (status != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
    return h;
}

/* Integrals of y = (B/2)(1 - X^2)(1 - Z^2), X = 2x/L, Z = z/T. */
static void wigley_in_closed_form(void)
{
    const double L = 2.5, B = 0.25, T = 0.16;
    nurbs_surface *hull;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(L, B, T, &hull), NURBS_OK);
    nurbs_hydrostatics h = compute(hull, 0);
    CHECK_RELATIVE(h.volume, 4.0 / 9 * L * B * T, 1e-10);
    CHECK_CLOSE(h.centroid[0], 0, 1e-12);
    CHECK_RELATIVE(h.centroid[2], -3.0 / 8 * T, 1e-10);
    CHECK_RELATIVE(h.waterplane_area, 2.0 / 3 * L * B, 1e-10);
    CHECK_CLOSE(h.waterplane_centre, 0, 1e-12);
    /* 2/3 int y^3 dx with int (1 - X^2)^3 = 32/35, and 2 int x^2 y dx with int X^2 (1 - X^2) =
     * 4/15.
     */
    CHECK_RELATIVE(h.waterplane_inertia_x, 2.0 / 3 * pow(B / 2, 3) * 32.0 / 35 * L / 2, 1e-10);
    CHECK_RELATIVE(h.waterplane_inertia_y, B * pow(L / 2, 3) * 4.0 / 15, 1e-10);
    CHECK_RELATIVE(h.beam, B, 1e-10);
    CHECK_RELATIVE(h.draft, T, 1e-10);
    CHECK_RELATIVE(h.keel_draft, T, 1e-10);
    CHECK_RELATIVE(h.x_fore, L / 2, 1e-12);
    CHECK_RELATIVE(h.x_aft, -L / 2, 1e-12);
    CHECK_CLOSE(h.transom_area, 0, 0);
    CHECK_RELATIVE(h.section_area_max, 2.0 / 3 * B * T, 1e-10);
    CHECK_CLOSE(h.section_area_max_x, 0, 1e-4 * L);
    /* The wetted area has no closed form: sum of sqrt(1 + y_x^2 + y_z^2) by the midpoint rule. */
    double area = 0;
    enum { N = 1500 };
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double X = (i + 0.5) / N, Z = (j + 0.5) / N, yx = -2 * B / L * X * (1 - Z * Z),
                   yz = B / T * Z * (1 - X * X);
            area += sqrt(1 + yx * yx + yz * yz);
        }
    CHECK_RELATIVE(h.wetted_area, 2 * L * T * area / N / N, 1e-7);
    CU_ASSERT(h.error < 1e-11);
    nurbs_surface_free(hull);
}

/* Area of a prolate spheroid: 2 pi b^2 + 2 pi a b asin(e)/e. */
static void spheroid_in_closed_form(void)
{
    const double a = 1.5, b = 0.3, e = sqrt(1 - b * b / (a * a));
    nurbs_surface *body;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(2 * a, 2 * b, 2 * b, 0.4, &body), NURBS_OK);
    nurbs_hydrostatics h = compute(body, 0);
    CHECK_RELATIVE(h.volume, 4.0 / 3 * pi * a * b * b, 1e-10);
    CHECK_RELATIVE(h.wetted_area, 2 * pi * (b * b + a * b * asin(e) / e), 1e-10);
    CHECK_CLOSE(h.centroid[0], 0, 1e-12);
    CHECK_RELATIVE(h.centroid[2], -0.4, 1e-10);
    CHECK_CLOSE(h.waterplane_area, 0, 0);
    CHECK_RELATIVE(h.draft, 0.7, 1e-10);
    CHECK_RELATIVE(h.beam, 0.6, 1e-10);
    CHECK_RELATIVE(h.x_fore, 1.5, 1e-10);
    CHECK_RELATIVE(h.section_area_max, pi * b * b, 1e-10);
    CHECK_CLOSE(h.transom_area, 0, 0);
    double area, error;
    CU_ASSERT_EQUAL(nurbs_surface_area(body, &area, &error), NURBS_OK);
    CHECK_RELATIVE(2 * area, h.wetted_area, 1e-12);
    CU_ASSERT(error < 1e-11);
    nurbs_surface_free(body);
}

static void ellipsoid_volume(void)
{
    nurbs_surface *body;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(2, 0.5, 0.3, 1, &body), NURBS_OK);
    nurbs_hydrostatics h = compute(body, 0.2);
    CHECK_RELATIVE(h.volume, pi / 6 * 2 * 0.5 * 0.3, 1e-10);
    CHECK_RELATIVE(h.draft, 1.35, 1e-10);
    nurbs_surface_free(body);
}

/* The stated error covers the true one on a half-immersed sphere, whose cut is a fit. */
static void sphere_cut_in_halves(void)
{
    nurbs_surface *body, *wet;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(1, 1, 1, 0, &body), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(body, 0, 1e-6, &wet), NURBS_OK);
    nurbs_hydrostatics h = compute(wet, 0);
    CHECK_RELATIVE(h.volume, pi / 12, 1e-6);
    CHECK_RELATIVE(h.wetted_area, pi / 2, 1e-6);
    CHECK_RELATIVE(h.centroid[2], -3.0 / 16, 1e-5);
    CHECK_RELATIVE(h.waterplane_area, pi / 4, 1e-6);
    CHECK_RELATIVE(h.waterplane_inertia_x, pi / 64, 1e-5);
    CHECK_RELATIVE(h.waterplane_inertia_y, pi / 64, 1e-5);
    nurbs_surface_free(wet);
    nurbs_surface_free(body);
}

/* Volume, wetted area and so on of the DTMB 5415 from a bicubic refinement of its public grid,
 * clipped at z = 0 and summed panel by panel; agreement asked: 0.3 %. */
static void dtmb5415_against_panels(void)
{
    struct hull5415 hull;
    nurbs_surface *wet;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(hull.surface, 0, 5.72e-5, &wet), NURBS_OK);
    nurbs_hydrostatics h = compute(wet, 0);
    CHECK_RELATIVE(h.volume, 0.5535, 3e-3);
    CHECK_RELATIVE(h.wetted_area, 4.850, 3e-3);
    CHECK_RELATIVE(h.centroid[0], 2.8304, 3e-3);
    CHECK_RELATIVE(h.centroid[2], -0.1007, 3e-3);
    CHECK_RELATIVE(h.waterplane_area, 3.4003, 3e-3);
    CHECK_RELATIVE(h.waterplane_centre, 5.72 - 3.1315, 3e-3);
    CHECK_RELATIVE(h.beam, 0.7691, 3e-3);
    CHECK_RELATIVE(h.keel_draft, 0.2481, 3e-3);
    CHECK_RELATIVE(h.draft, 0.3700, 3e-3);
    CHECK_CLOSE(h.x_fore, 5.7227, 2e-3);
    CHECK_CLOSE(h.x_aft, 0.0236, 2e-3);
    CHECK_RELATIVE(h.transom_area, 0.0067, 0.05);
    CHECK_RELATIVE(h.section_area_max, 0.1566, 3e-3);
    CU_ASSERT(h.error < 1e-6);
    nurbs_surface_free(wet);
    hull5415_free(&hull);
}

/* Patches add up, whatever their orientation. */
static void two_patches_are_one_hull(void)
{
    nurbs_surface *hull, *part[2], *turned;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1, 0.1, 0.0625, &hull), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(hull, 0, 0, 0.4, &part[0]), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(hull, 0, 0.4, 1, &part[1]), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_swap(part[1], &turned), NURBS_OK);
    nurbs_hydrostatics whole = compute(hull, 0), sum;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hydrostatics_compute(2, (const nurbs_surface *const[]){part[0], turned}, 0, &sum),
        NURBS_OK);
    CHECK_RELATIVE(sum.volume, whole.volume, 1e-12);
    CHECK_RELATIVE(sum.wetted_area, whole.wetted_area, 1e-11);
    CHECK_RELATIVE(sum.waterplane_area, whole.waterplane_area, 1e-12);
    CHECK_RELATIVE(sum.waterplane_inertia_y, whole.waterplane_inertia_y, 1e-12);
    CHECK_CLOSE(sum.centroid[0], 0, 1e-12);
    CHECK_CLOSE(sum.transom_area, 0, 0);
    CHECK_RELATIVE(sum.section_area_max, whole.section_area_max, 1e-10);
    nurbs_surface_free(hull);
    nurbs_surface_free(part[0]);
    nurbs_surface_free(part[1]);
    nurbs_surface_free(turned);
}

/* A submerged body cut along and around: no patch encloses a volume by itself. */
static void quarters_of_a_spheroid(void)
{
    const double a = 0.5, b = 0.1, e = sqrt(1 - b * b / (a * a));
    nurbs_surface *body, *half[2], *part[4], *turned;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(2 * a, 2 * b, 2 * b, 0.4, &body), NURBS_OK);
    const double *u = nurbs_surface_knots(body, 0), *v = nurbs_surface_knots(body, 1);
    double at[2] = {0.6 * u[nurbs_surface_size(body, 0)], 0.3 * v[nurbs_surface_size(body, 1)]};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(body, 0, at[0], &half[0], &half[1]), NURBS_OK);
    for (int k = 0; k < 2; k++) {
        CU_ASSERT_EQUAL_FATAL(
            nurbs_surface_split(half[k], 1, at[1], &part[2 * k], &part[2 * k + 1]), NURBS_OK);
        nurbs_surface_free(half[k]);
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_swap(part[2], &turned), NURBS_OK);
    nurbs_surface_free(part[2]);
    part[2] = turned;
    nurbs_hydrostatics h;
    CU_ASSERT_EQUAL_FATAL(nurbs_hydrostatics_compute(4, (const nurbs_surface *const *)part, 0, &h),
                          NURBS_OK);
    CHECK_RELATIVE(h.volume, 4.0 / 3 * pi * a * b * b, 1e-10);
    CHECK_RELATIVE(h.wetted_area, 2 * pi * (b * b + a * b * asin(e) / e), 1e-10);
    CHECK_RELATIVE(h.centroid[2], -0.4, 1e-10);
    CHECK_RELATIVE(h.section_area_max, pi * b * b, 1e-8);
    CHECK_CLOSE(h.transom_area, 0, 0);
    nurbs_surface_free(body);
    for (int k = 0; k < 4; k++)
        nurbs_surface_free(part[k]);
}

/* A wedge and the face at its stern, given inside out. */
static void face_of_a_transom(void)
{
    const double b = 0.05, t = 0.0625, knots[4] = {0, 0, 1, 1};
    const double points[2][12] = {{0, b, 0, 0, 0, -t, 1, 0, 0, 1, 0, -t},
                                  {0, 0, -t, 0, 0, 0, 0, 0, -t, 0, b, 0}};
    nurbs_surface *patch[2];
    nurbs_hydrostatics open, closed;
    int closes[2] = {-1, -1};
    for (int k = 0; k < 2; k++)
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2},
                                                   knots, knots, points[k], NULL, &patch[k]),
                              NURBS_OK);
    const nurbs_surface *const *list = (const nurbs_surface *const *)patch;
    CU_ASSERT_EQUAL(nurbs_transom_patches(2, list, 0, closes), NURBS_OK);
    CU_ASSERT_EQUAL(closes[0], 0);
    CU_ASSERT_EQUAL(closes[1], 1);
    CU_ASSERT_EQUAL(nurbs_transom_patches(0, list, 0, closes), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(nurbs_hydrostatics_compute(1, list, 0, &open), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hydrostatics_compute(2, list, 0, &closed), NURBS_OK);
    CHECK_RELATIVE(closed.volume, b * t / 2, 1e-12);
    CHECK_RELATIVE(closed.transom_area, b * t, 1e-12);
    CHECK_RELATIVE(open.transom_area, b * t, 1e-12);
    CHECK_RELATIVE(closed.wetted_area, open.wetted_area, 1e-12);
    CHECK_RELATIVE(closed.waterplane_area, b, 1e-12);
    for (int k = 0; k < 2; k++)
        nurbs_surface_free(patch[k]);
}

static void refuses_what_is_no_wetted_half_hull(void)
{
    nurbs_hydrostatics h;
    nurbs_surface *hull, *moved;
    CU_ASSERT_EQUAL(nurbs_hydrostatics_compute(0, NULL, 0, &h), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1, 0.1, 0.0625, &hull), NURBS_OK);
    const nurbs_surface *one = hull;
    CU_ASSERT_EQUAL(nurbs_hydrostatics_compute(1, &one, NAN, &h), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hydrostatics_compute(1, &one, -0.03, &h), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "cut the hull"));
    const double shift[3] = {0, -0.04, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(hull, NULL, shift, &moved), NURBS_OK);
    one = moved;
    CU_ASSERT_EQUAL(nurbs_hydrostatics_compute(1, &one, 0, &h), NURBS_ERROR_GEOMETRY);
    nurbs_surface_free(moved);
    nurbs_surface_free(hull);
}

static void moments_of(const nurbs_surface *surface, double values[NURBS_MOMENTS], double *gradient)
{
    nurbs_moments m;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_moments(surface, &m, gradient), NURBS_OK);
    values[0] = m.area;
    values[1] = m.volume;
    memcpy(values + 2, m.moment, sizeof m.moment);
    memcpy(values + 5, m.second, sizeof m.second);
}

/* Area, volume and moments are homogeneous of degree 2 to 5 in the control points (Euler), and
 * their derivatives agree with central differences. */
static void gradients_of_moments(void)
{
    nurbs_surface *body[2];
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(2, 0.6, 0.5, 0.3, &body[0]), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(2, 0.4, 0.3, &body[1]), NURBS_OK);
    static const double power[NURBS_MOMENTS] = {2, 3, 4, 4, 4, 5, 5, 5, 5, 5, 5};
    for (int k = 0; k < 2; k++) {
        const int degree[2] = {nurbs_surface_degree(body[k], 0), nurbs_surface_degree(body[k], 1)};
        const size_t size[2] = {nurbs_surface_size(body[k], 0), nurbs_surface_size(body[k], 1)};
        size_t n = 3 * size[0] * size[1];
        double *gradient = malloc((NURBS_MOMENTS + 1) * n * sizeof *gradient);
        double *p = gradient + NURBS_MOMENTS * n, values[NURBS_MOMENTS];
        moments_of(body[k], values, gradient);
        memcpy(p, nurbs_surface_points(body[k]), n * sizeof *p);
        for (size_t m = 0; m < NURBS_MOMENTS; m++) {
            double sum = 0, scale = 0;
            for (size_t i = 0; i < n; i++) {
                sum += gradient[m * n + i] * p[i];
                scale += fabs(gradient[m * n + i] * p[i]);
            }
            CHECK_CLOSE(sum, power[m] * values[m], 1e-12 * scale + 1e-14);
        }
        for (size_t i = 1; i < n; i += 7) {
            double low[NURBS_MOMENTS], high[NURBS_MOMENTS], before = p[i], step = 1e-5;
            for (int side = -1; side <= 1; side += 2) {
                nurbs_surface *moved;
                p[i] = before + side * step;
                CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size,
                                                           nurbs_surface_knots(body[k], 0),
                                                           nurbs_surface_knots(body[k], 1), p,
                                                           nurbs_surface_weights(body[k]), &moved),
                                      NURBS_OK);
                moments_of(moved, side < 0 ? low : high, NULL);
                nurbs_surface_free(moved);
            }
            p[i] = before;
            for (size_t m = 1; m < NURBS_MOMENTS; m++) /* polynomials in the points */
                CHECK_CLOSE((high[m] - low[m]) / (2 * step), gradient[m * n + i], 1e-9);
            if (k == 1) /* the area has no derivative where the ellipsoid collapses */
                CHECK_CLOSE((high[0] - low[0]) / (2 * step), gradient[i], 1e-7);
        }
        free(gradient);
        nurbs_surface_free(body[k]);
    }
}

static void check_moment(double value, double error, double exact, double scale)
{
    CU_ASSERT(error >= 0 && error < 1e-3 * scale);
    CHECK_CLOSE(value, exact, error);
}

/* Bodies in closed form, moved off the axes: every true error is at most the stated one. Slender
 * and pointed ones converge slowly; then the estimate must grow. */
static void patch_moments_within_their_error(void)
{
    static const double size[4][3] = {{2, 2, 2}, {5, 0.4, 0.3}, {1, 0.05, 3}, {100, 1, 0.02}};
    const double shift[3] = {0.3, 0.7, -0.4};
    for (int k = 0; k < 4; k++) {
        nurbs_surface *half, *moved;
        nurbs_patches *body;
        nurbs_moments m, e;
        CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(size[k][0], size[k][1], size[k][2], 0, &half),
                              NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&body), NURBS_OK);
        for (int side = -1; side <= 1; side += 2) {
            const double mirror[9] = {side, 0, 0, 0, side, 0, 0, 0, 1}; /* half a turn about z */
            CU_ASSERT_EQUAL(nurbs_surface_transform(half, mirror, shift, &moved), NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_patches_add(body, moved), NURBS_OK);
            nurbs_surface_free(moved);
        }
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_moments(body, &m, &e), NURBS_OK);
        double sign = m.volume > 0 ? 1 : -1,
               volume = sign * pi / 6 * size[k][0] * size[k][1] * size[k][2];
        double reach = fmax(size[k][0], size[k][2]) + 1;
        check_moment(m.volume, e.volume, volume, fabs(volume));
        for (int c = 0; c < 3; c++) {
            int d = (c + 1) % 3;
            double semi = 0.5 * size[k][c];
            check_moment(m.moment[c], e.moment[c], volume * shift[c], fabs(volume) * reach);
            check_moment(m.second[c], e.second[c], volume * (semi * semi / 5 + shift[c] * shift[c]),
                         fabs(volume) * reach * reach);
            check_moment(m.second[3 + c], e.second[3 + c], volume * shift[c] * shift[d],
                         fabs(volume) * reach * reach);
        }
        if (k == 0)
            check_moment(m.area, e.area, 4 * pi, 4 * pi);
        if (k == 1) { /* Legendre's formula needs elliptic integrals; a spheroid does not */
            nurbs_patches_free(body);
            nurbs_surface_free(half);
            CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(5, 0.4, 0.4, 0, &half), NURBS_OK);
            CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&body), NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_patches_add(body, half), NURBS_OK);
            CU_ASSERT_EQUAL_FATAL(nurbs_patches_moments(body, &m, &e), NURBS_OK);
            double ex = sqrt(1 - 0.4 * 0.4 / 25);
            check_moment(m.area, e.area, pi * 0.04 * (1 + 2.5 / (0.2 * ex) * asin(ex)), m.area);
        }
        nurbs_patches_free(body);
        nurbs_surface_free(half);
    }
}

/* A cubic sheet with a crease inside a span and one with a cusp: |n| is not smooth, the area
 * converges slowly, and the estimate covers that. */
static void area_error_of_folded_sheets(void)
{
    const double knots[8] = {0, 0, 0, 0, 1, 1, 1, 1}, line[4] = {0, 0, 1, 1};
    for (int k = 0; k < 8; k++) {
        /* x(u) = u (u - a)^... : dx/du = (u - a)(u - b), the sheet goes back and forth in x. */
        double a = 0.2 + 0.09 * k, b = k % 2 ? a : 0.9, points[24];
        const double x[4] = {0, a * b / 3, a * b / 3 * 2 - (a + b) / 6,
                             a * b - (a + b) / 2 + 1.0 / 3};
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 2; j++) {
                points[6 * i + 3 * j] = x[i];
                points[6 * i + 3 * j + 1] = j;
                points[6 * i + 3 * j + 2] = 0;
            }
        nurbs_surface *sheet;
        nurbs_patches *body;
        nurbs_moments m, e;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){3, 1}, (const size_t[]){4, 2},
                                                   knots, line, points, NULL, &sheet),
                              NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&body), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_patches_add(body, sheet), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_moments(body, &m, &e), NURBS_OK);
        /* Length of the way in x: |x(a) - 0| + |x(b) - x(a)| + |x(1) - x(b)|. */
        double at[4] = {0, a, b, 1}, way = 0;
        for (int i = 1; i < 4; i++) {
            double from = at[i - 1], to = at[i];
            way += fabs(to * to * to / 3 - (a + b) * to * to / 2 + a * b * to -
                        (from * from * from / 3 - (a + b) * from * from / 2 + a * b * from));
        }
        CHECK_CLOSE(m.area, way, e.area);
        CU_ASSERT(e.area < 0.05 * way);
        nurbs_patches_free(body);
        nurbs_surface_free(sheet);
    }
}

/* Moments and hydrostatics are two routes to the same numbers. */
static void moments_agree_with_hydrostatics(void)
{
    nurbs_surface *hull;
    nurbs_moments m;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(2.5, 0.25, 0.16, &hull), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_moments(hull, &m, NULL), NURBS_OK);
    nurbs_hydrostatics h = compute(hull, 0);
    CHECK_RELATIVE(2 * m.volume, h.volume, 1e-13);
    CHECK_RELATIVE(m.moment[2] / m.volume, h.centroid[2], 1e-12);
    /* int y dV over half the hull: int y^2/2 dx dz = B^2/8 L T (8/15)^2. */
    CHECK_RELATIVE(m.moment[1], 0.25 * 0.25 / 8 * 2.5 * 0.16 * 64.0 / 225, 1e-12);
    nurbs_surface_free(hull);
}

static const struct check_case cases[] = {
    {"wigley in closed form", wigley_in_closed_form},
    {"spheroid in closed form", spheroid_in_closed_form},
    {"ellipsoid volume", ellipsoid_volume},
    {"sphere cut in halves", sphere_cut_in_halves},
    {"DTMB 5415 against panels", dtmb5415_against_panels},
    {"two patches are one hull", two_patches_are_one_hull},
    {"quarters of a spheroid", quarters_of_a_spheroid},
    {"face of a transom", face_of_a_transom},
    {"gradients of moments", gradients_of_moments},
    {"patch moments within their error", patch_moments_within_their_error},
    {"area error of folded sheets", area_error_of_folded_sheets},
    {"moments agree with hydrostatics", moments_agree_with_hydrostatics},
    {"refuses what is no wetted half hull", refuses_what_is_no_wetted_half_hull},
};

CHECK_MAIN("nurbs integrals", cases)
