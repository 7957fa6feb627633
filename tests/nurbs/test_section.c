#include "check.h"
#include "hulls.h"

#include <string.h>

/* Parameter at which section u of the hull crosses the level, by bisection. */
static double crossing(const nurbs_surface *hull, double u, double level)
{
    double low = 0, high = 1, p[3];
    for (int k = 0; k < 60; k++) {
        double uv[2] = {u, 0.5 * (low + high)};
        CU_ASSERT_EQUAL(nurbs_surface_eval(hull, 0, 1, uv, p), NURBS_OK);
        *(p[2] > level ? &low : &high) = uv[1];
    }
    return low;
}

/* Largest distance between the wetted surface and the hull cut and re-parametrised the same way. */
static double deviation(const nurbs_surface *hull, const nurbs_surface *wet, double level, int n)
{
    double worst = 0;
    for (int i = 0; i <= n; i++) {
        double u = (double)i / n, v = crossing(hull, u, level);
        for (int j = 0; j <= 40; j++) {
            double w = j / 40.0, uw[2] = {u, w}, uv[2] = {u, v + w * (1 - v)}, p[3], q[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(hull, 0, 1, uv, p), NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_surface_eval(wet, 0, 1, uw, q), NURBS_OK);
            worst = fmax(worst, hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]));
        }
    }
    return worst;
}

static void check_edges(const nurbs_surface *wet, double level)
{
    size_t nu = nurbs_surface_size(wet, 0), nv = nurbs_surface_size(wet, 1);
    const double *p = nurbs_surface_points(wet);
    for (size_t i = 0; i < nu; i++) {
        CHECK_CLOSE(p[3 * i * nv + 2], level, 0);        /* waterline */
        CHECK_CLOSE(p[3 * (i * nv + nv - 1) + 1], 0, 0); /* keel */
    }
    for (size_t j = 0; j < nv; j++)
        CHECK_CLOSE(p[3 * j + 1], 0, 0); /* stem */
    for (size_t k = 0; k < nu * nv; k++)
        CU_ASSERT(p[3 * k + 1] >= 0);
}

static void dtmb5415_within_its_tolerance(void)
{
    struct hull5415 hull;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    const double tolerances[2] = {1e-5 * 5.72, 1e-4 * 5.72}, levels[2] = {0, -0.004};
    for (int k = 0; k < 2; k++)
        for (int l = 0; l < 2; l++) {
            nurbs_surface *wet;
            nurbs_status status =
                nurbs_surface_wetted(hull.surface, levels[l], tolerances[k], &wet);
            if (status != NURBS_OK)
                fprintf(stderr, "%s\n", nurbs_last_error());
            CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
            CHECK_CLOSE(deviation(hull.surface, wet, levels[l], 400), 0, tolerances[k]);
            check_edges(wet, levels[l]);
            nurbs_surface_free(wet);
        }
    hull5415_free(&hull);
}

/* A skin of offsets overshoots the centre plane at the stem. Its own reach across is mended first,
 * so that the cut is as near to the mended hull as it was asked to be, and ends at the keel with y
 * >= 0. */
static void offsets_across_the_centre_plane(void)
{
    nurbs_grid *grid = NULL;
    nurbs_surface *hull = NULL, *mended = NULL, *wet = NULL;
    double moved;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_offsets_read(EXAMPLES_DIR "/hulls/series60.offsets.csv", 0, &grid, NULL), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &hull), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_raise_side(hull, &mended, &moved), NURBS_OK);
    CU_ASSERT(moved > 1e-4);
    for (double tolerance = 1e-3; tolerance > 1e-6; tolerance /= 10) {
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(hull, -0.01, tolerance, &wet), NURBS_OK);
        CHECK_CLOSE(deviation(mended, wet, -0.01, 400), 0, tolerance);
        const double *p = nurbs_surface_points(wet);
        for (size_t k = 0; k < nurbs_surface_size(wet, 0) * nurbs_surface_size(wet, 1); k++)
            CU_ASSERT(p[3 * k + 1] >= 0 && p[3 * k + 2] <= -0.01);
        nurbs_surface_free(wet);
    }
    nurbs_surface_free(hull);
    nurbs_surface_free(mended);
    nurbs_grid_free(grid);
}

static void keeps_the_knots_along_the_hull(void)
{
    struct hull5415 hull;
    nurbs_surface *wet;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(hull.surface, 0, 1e-4, &wet), NURBS_OK);
    size_t n = nurbs_surface_size(hull.surface, 0) + 4, m = nurbs_surface_size(wet, 0) + 4, at = 0;
    const double *t = nurbs_surface_knots(hull.surface, 0), *s = nurbs_surface_knots(wet, 0);
    for (size_t k = 0; k < n; k++) {
        while (at < m && s[at] != t[k])
            at++;
        CU_ASSERT(at < m);
        at++;
    }
    nurbs_surface_free(wet);
    hull5415_free(&hull);
}

/* Sine bumps of the public 27-function family, large enough to bend every part of the hull. */
static void bend(nurbs_grid *grid, double amplitude, unsigned seed)
{
    double *p = nurbs_grid_edit(grid), pi = 3.14159265358979;
    size_t n = nurbs_grid_rows(grid) * nurbs_grid_columns(grid);
    for (int t = 0; t < 27; t++) {
        seed = seed * 1664525u + 1013904223u;
        double a = amplitude * ((double)(seed >> 8) / 8388608.0 - 1);
        for (size_t k = 0; k < n; k++) {
            double x = (p[3 * k] + 0.0042) / 6.12, y = p[3 * k + 1] / 0.4137,
                   z = (p[3 * k + 2] + 0.37) / 0.7732;
            p[3 * k + 1] += a * sin((1 + t % 3) * pi * x) * sin((1 + t / 3 % 3) * pi * y) *
                            sin((1 + t / 9) * pi * z);
        }
    }
}

static void modified_hulls_stay_on_their_side(void)
{
    struct hull5415 hull;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    for (unsigned seed = 1; seed <= 12; seed++) {
        nurbs_grid *grid;
        nurbs_surface *skin, *wet, *light;
        double bound;
        CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(90, 25, nurbs_grid_points(hull.grid), &grid),
                              NURBS_OK);
        bend(grid, 0.019, seed);
        CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &skin), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(skin, 0, 1.144e-4, &wet), NURBS_OK);
        check_edges(wet, 0);
        CU_ASSERT_EQUAL_FATAL(
            nurbs_surface_simplify(wet, 5.72e-4, NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY,
                                   &light, &bound),
            NURBS_OK);
        CU_ASSERT(lowest_y(light, 301) >= 0);
        CU_ASSERT_EQUAL(nurbs_surface_check_fold(light, NULL), NURBS_OK);
        nurbs_surface_free(light);
        nurbs_surface_free(wet);
        nurbs_surface_free(skin);
        nurbs_grid_free(grid);
    }
    hull5415_free(&hull);
}

static void wigley_is_its_own_wetted_part(void)
{
    nurbs_surface *hull, *wet;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1, 0.1, 0.0625, &hull), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(hull, 0, 1e-6, &wet), NURBS_OK);
    CHECK_CLOSE(surface_distance(hull, wet, 51), 0, 1e-15);
    CU_ASSERT_EQUAL(nurbs_surface_size(wet, 0), 3);
    CU_ASSERT_EQUAL(nurbs_surface_size(wet, 1), 3);
    nurbs_surface_free(wet);
    /* Cut lower: still exact, sections are parabolas. */
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(hull, -0.02, 1e-6, &wet), NURBS_OK);
    for (int k = 0; k <= 30; k++) {
        double uv[2] = {k / 30.0, 0.37}, p[3];
        CU_ASSERT_EQUAL(nurbs_surface_eval(wet, 0, 1, uv, p), NURBS_OK);
        double x = 2 * p[0], z = p[2] / 0.0625;
        CHECK_CLOSE(p[1], 0.05 * (1 - x * x) * (1 - z * z), 1e-14);
    }
    nurbs_surface_free(wet);
    nurbs_surface_free(hull);
}

/* A hull whose keel rises out of the water towards both ends: y = 0.1 (1 - v) s(u), z between the
 * deck at 0.1 and the keel -0.1 + 0.5 (2u - 1)^4. */
static nurbs_surface *overhanging_hull(int upwards)
{
    enum { ROWS = 31, COLUMNS = 9 };
    nurbs_grid *grid;
    nurbs_surface *hull;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, NULL, &grid), NURBS_OK);
    double *p = nurbs_grid_edit(grid);
    for (size_t i = 0; i < ROWS; i++)
        for (size_t j = 0; j < COLUMNS; j++, p += 3) {
            double s = 2.0 * (double)i / (ROWS - 1) - 1, t = (double)j / (COLUMNS - 1);
            t = upwards ? 1 - t : t;
            double keel = -0.1 + 0.5 * s * s * s * s;
            p[0] = -s;
            p[1] = 0.2 * (1 - t) * (1 - 0.8 * s * s);
            p[2] = 0.45 + t * (keel - 0.45);
        }
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &hull), NURBS_OK);
    nurbs_grid_free(grid);
    return hull;
}

static void leaves_overhangs_out(void)
{
    for (int upwards = 0; upwards < 2; upwards++) {
        nurbs_surface *hull = overhanging_hull(upwards), *wet;
        nurbs_status status = nurbs_surface_wetted(hull, 0, 1e-5, &wet);
        if (status != NURBS_OK)
            fprintf(stderr, "%s\n", nurbs_last_error());
        CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
        const double *t = nurbs_surface_knots(wet, 0);
        size_t n = nurbs_surface_size(wet, 0);
        CU_ASSERT(t[0] > 0.05 && t[n] < 0.95);
        /* The profile meets z = 0 where s^4 = 0.2. */
        double uv[4] = {t[0], 0.4, t[n], 0.4}, p[6];
        CU_ASSERT_EQUAL(nurbs_surface_eval(wet, 0, 2, uv, p), NURBS_OK);
        CHECK_CLOSE(p[0], pow(0.2, 0.25), 1e-4);
        CHECK_CLOSE(p[3], -pow(0.2, 0.25), 1e-4);
        CHECK_CLOSE(p[1], 0, 1e-12);
        CHECK_CLOSE(p[2], 0, 1e-12);
        CHECK_CLOSE(p[5], 0, 1e-12);
        const double *q = nurbs_surface_points(wet);
        size_t nv = nurbs_surface_size(wet, 1);
        for (size_t i = 0; i < n; i++) {
            CHECK_CLOSE(q[3 * i * nv + 2], 0, 0);
            CHECK_CLOSE(q[3 * (i * nv + nv - 1) + 1], 0, 0);
        }
        nurbs_surface_free(wet);
        nurbs_surface_free(hull);
    }
}

static void refuses_with_the_place(void)
{
    nurbs_surface *hull, *wet;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1, 0.1, 0.0625, &hull), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_wetted(hull, 0.5, 1e-5, &wet), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NULL(wet);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "wholly below"));
    CU_ASSERT_EQUAL(nurbs_surface_wetted(hull, -0.5, 1e-5, &wet), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "does not cross"));
    CU_ASSERT_EQUAL(nurbs_surface_wetted(hull, 0, 0, &wet), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_surface_wetted(hull, NAN, 1e-5, &wet), NURBS_ERROR_ARGUMENT);
    nurbs_surface_free(hull);

    /* A section that dives, comes up and dives again. */
    double knots[10] = {0, 0, 0, 0, 0.5, 0.5, 1, 1, 1, 1}, line[4] = {0, 0, 1, 1}, points[36];
    const double z[6] = {0.2, -0.6, -0.2, 0.5, 0.2, -0.3};
    for (size_t i = 0; i < 2; i++)
        for (size_t j = 0; j < 6; j++) {
            points[3 * (6 * i + j)] = (double)i;
            points[3 * (6 * i + j) + 1] = 1 - 0.2 * (double)j;
            points[3 * (6 * i + j) + 2] = z[j];
        }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 3}, (const size_t[]){2, 6}, line,
                                               knots, points, NULL, &hull),
                          NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_wetted(hull, 0, 1e-5, &wet), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "more than once"));
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "u = 0"));
    nurbs_surface_free(hull);
}

static void finds_folds(void)
{
    struct hull5415 hull;
    nurbs_surface *folded;
    double uv[2] = {-1, -1};
    CU_ASSERT_FATAL(hull5415_load(&hull));
    CU_ASSERT_EQUAL(nurbs_surface_check_fold(hull.surface, NULL), NURBS_OK);
    /* Rows 20 and 23 of control points exchanged: the surface runs back between them. */
    size_t nu = nurbs_surface_size(hull.surface, 0), nv = nurbs_surface_size(hull.surface, 1);
    const double *t = nurbs_surface_knots(hull.surface, 0);
    double *p = malloc(3 * nu * nv * sizeof *p);
    memcpy(p, nurbs_surface_points(hull.surface), 3 * nu * nv * sizeof *p);
    for (size_t k = 0; k < 3 * nv; k++) {
        double other = p[3 * nv * 20 + k];
        p[3 * nv * 20 + k] = p[3 * nv * 23 + k];
        p[3 * nv * 23 + k] = other;
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){3, 3}, (const size_t[]){nu, nv}, t,
                                               nurbs_surface_knots(hull.surface, 1), p, NULL,
                                               &folded),
                          NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_check_fold(folded, uv), NURBS_ERROR_GEOMETRY);
    CU_ASSERT(uv[0] > t[18] && uv[0] < t[29]);
    nurbs_surface_free(folded);
    free(p);
    /* Stations 40 and 43 of the grid exchanged: no skin. */
    p = nurbs_grid_edit(hull.grid);
    for (size_t k = 0; k < 75; k++) {
        double other = p[75 * 40 + k];
        p[75 * 40 + k] = p[75 * 43 + k];
        p[75 * 43 + k] = other;
    }
    CU_ASSERT_EQUAL(nurbs_skin(hull.grid, NULL, &folded), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NULL(folded);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "folded at u"));
    hull5415_free(&hull);
    nurbs_surface *sphere; /* degenerate ends are no folds */
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(1, 1, 1, 0, &sphere), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_check_fold(sphere, NULL), NURBS_OK);
    nurbs_surface_free(sphere);
}

static void raises_to_the_side(void)
{
    struct hull5415 hull;
    nurbs_surface *sunk, *raised, *same;
    double moved;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    size_t nu = nurbs_surface_size(hull.surface, 0), nv = nurbs_surface_size(hull.surface, 1),
           n = nu * nv;
    double *p = malloc(3 * n * sizeof *p);
    memcpy(p, nurbs_surface_points(hull.surface), 3 * n * sizeof *p);
    /* A dent just off the keel, 2 mm across the centre plane. */
    p[3 * (30 * nv + nv - 2) + 1] = -0.01;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){3, 3}, (const size_t[]){nu, nv},
                                               nurbs_surface_knots(hull.surface, 0),
                                               nurbs_surface_knots(hull.surface, 1), p, NULL,
                                               &sunk),
                          NURBS_OK);
    double low = lowest_y(sunk, 801);
    CU_ASSERT(low < -1e-4);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_raise_side(sunk, &raised, &moved), NURBS_OK);
    CU_ASSERT(lowest_y(raised, 801) >= -1e-12);
    CU_ASSERT(moved > 0 && moved < 0.02);
    CU_ASSERT(surface_distance(sunk, raised, 801) <= moved);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_raise_side(raised, &same, &moved), NURBS_OK);
    CHECK_CLOSE(moved, 0, 0);
    const double *q = nurbs_surface_points(raised);
    for (size_t i = 0; i < nu; i++)
        CHECK_CLOSE(q[3 * (i * nv + nv - 1) + 1], 0, 0);
    free(p);
    nurbs_surface_free(sunk);
    nurbs_surface_free(raised);
    nurbs_surface_free(same);
    hull5415_free(&hull);
}

/* Sections of an ellipsoid are ellipses; half bodies give half ellipses, from plane to plane. */
static void contours_of_an_ellipsoid(void)
{
    nurbs_surface *body;
    nurbs_contour contour;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(4, 2, 1, 0.2, &body), NURBS_OK);
    const double normal[3] = {1, 0, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_contour(body, normal, 0.5, 8, &contour), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(contour.lines, 1);
    size_t n = contour.first[1];
    CU_ASSERT(n > 16);
    double length = 0, r = sqrt(1 - 0.25 * 0.25);
    for (size_t k = 0; k < n; k++) {
        const double *p = contour.points + 3 * k;
        double q[3], y = p[1] / r, z = (p[2] + 0.2) / (0.5 * r);
        CHECK_CLOSE(p[0], 0.5, 1e-14);
        CHECK_CLOSE(y * y + z * z, 1, 1e-13);
        CU_ASSERT_EQUAL(nurbs_surface_eval(body, 0, 1, contour.uv + 2 * k, q), NURBS_OK);
        CHECK_CLOSE(q[2], p[2], 1e-15);
        if (k > 0)
            length += hypot(p[1] - p[-2], p[2] - p[-1]);
    }
    /* Half the circumference of the ellipse with axes r and r/2: 2.42211 r. */
    CHECK_CLOSE(length, 2.42211 * r, 0.01 * r);
    nurbs_contour_free(&contour);
    /* y = 0.9 cuts a closed line on the half body. */
    const double across[3] = {0, 1, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_contour(body, across, 0.9, 16, &contour), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(contour.lines, 1);
    n = contour.first[1];
    for (size_t c = 0; c < 3; c++)
        CHECK_CLOSE(contour.points[c], contour.points[3 * (n - 1) + c], 0);
    nurbs_contour_free(&contour);
    CU_ASSERT_EQUAL(nurbs_surface_contour(body, across, 1.1, 16, &contour), NURBS_OK);
    CU_ASSERT_EQUAL(contour.lines, 0);
    nurbs_contour_free(&contour);
    CU_ASSERT_EQUAL(nurbs_surface_contour(body, across, NAN, 16, &contour), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_surface_contour(body, across, 0, -1, &contour), NURBS_ERROR_ARGUMENT);
    nurbs_surface_free(body);
}

/* The waterline of the hull is one line from transom to stem. */
static void contour_is_the_waterline(void)
{
    struct hull5415 hull;
    nurbs_contour contour;
    const double up[3] = {0, 0, 1};
    CU_ASSERT_FATAL(hull5415_load(&hull));
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_contour(hull.surface, up, 0, 4, &contour), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(contour.lines, 1);
    const double *first = contour.points, *last = first + 3 * (contour.first[1] - 1);
    CHECK_CLOSE(fmax(first[0], last[0]), 5.7227, 1e-3);
    CHECK_CLOSE(fmin(first[0], last[0]), 0.0236, 1e-3);
    double area = 0;
    for (size_t k = 1; k < contour.first[1]; k++)
        area += (first[3 * k] - first[3 * k - 3]) * (first[3 * k + 1] + first[3 * k - 2]);
    CHECK_RELATIVE(fabs(area), 3.4003, 1e-3);
    nurbs_contour_free(&contour);
    hull5415_free(&hull);
}

static const struct check_case cases[] = {
    {"DTMB 5415 within its tolerance", dtmb5415_within_its_tolerance},
    {"offsets across the centre plane", offsets_across_the_centre_plane},
    {"keeps the knots along the hull", keeps_the_knots_along_the_hull},
    {"modified hulls stay on their side", modified_hulls_stay_on_their_side},
    {"wigley is its own wetted part", wigley_is_its_own_wetted_part},
    {"leaves overhangs out", leaves_overhangs_out},
    {"refuses with the place", refuses_with_the_place},
    {"finds folds", finds_folds},
    {"raises to the side", raises_to_the_side},
    {"contours of an ellipsoid", contours_of_an_ellipsoid},
    {"contour is the waterline", contour_is_the_waterline},
};

CHECK_MAIN("nurbs section", cases)
