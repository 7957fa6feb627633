/* Particulars, sectional areas and perpendiculars against closed forms of the Wigley hull; ship
 * forms at the corners and edges that their numbers fix. */
#include "check.h"
#include "hulls.h"

#include <nurbs/particulars.h>

#include <string.h>

static const double L = 10, B = 1, T = 0.625, DENSITY = 1025;

/* lpp 0: none kept. */
static nurbs_hull *wigley(double lpp, double shift)
{
    const double along[3] = {shift, 0, 0};
    nurbs_surface *surface = NULL, *moved = NULL;
    nurbs_patches *patches = NULL;
    nurbs_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(L, B, T, &surface), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(surface, NULL, along, &moved), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, moved), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_set_length(patches, lpp), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, NULL, &hull), NURBS_OK);
    nurbs_patches_free(patches);
    nurbs_surface_free(surface);
    nurbs_surface_free(moved);
    return hull;
}

static double wigley_section(double x)
{
    double s = 2 * x / L;
    return fabs(s) < 1 ? 2.0 / 3 * B * T * (1 - s * s) : 0;
}

static void particulars_of_the_wigley_hull(void)
{
    nurbs_hull *hull = wigley(0, 0);
    nurbs_particulars p;
    const double kg = 0.4, volume = 4.0 / 9 * L * B * T, plane = 2.0 / 3 * L * B;
    /* int (1 - s^2)^3 ds and int s^2 (1 - s^2) ds over -1 ... 1 */
    const double bmt = 2.0 / 3 * pow(B / 2, 3) * L / 2 * 32 / 35 / volume;
    const double bml = B * pow(L / 2, 3) * 4 / 15 / volume, kb = 5.0 / 8 * T;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_particulars(hull, DENSITY, kg, &p), NURBS_OK);
    CHECK_RELATIVE(p.length, L, 1e-12);
    CHECK_RELATIVE(p.waterline_length, L, 1e-12);
    CHECK_RELATIVE(p.hydrostatics.volume, volume, 1e-10);
    CHECK_RELATIVE(p.mass, DENSITY * volume, 1e-10);
    CHECK_RELATIVE(p.lcb_from_fore, L / 2, 1e-10);
    CHECK_CLOSE(p.lcb_percent, 0, 1e-8);
    CHECK_CLOSE(p.lcf, 0, 1e-8);
    CHECK_RELATIVE(p.lcf_from_fore, L / 2, 1e-10);
    CHECK_RELATIVE(p.kb, kb, 1e-10);
    CHECK_RELATIVE(p.bmt, bmt, 1e-10);
    CHECK_RELATIVE(p.bml, bml, 1e-10);
    CHECK_RELATIVE(p.kmt, kb + bmt, 1e-10);
    CHECK_RELATIVE(p.gmt, kb + bmt - kg, 1e-9);
    CHECK_RELATIVE(p.tpc, DENSITY * plane / 1000 / 100, 1e-10);
    CHECK_RELATIVE(p.mtc, DENSITY * volume * (kb + bml - kg) / 1000 / (100 * L), 1e-10);
    CHECK_RELATIVE(p.cb, 4.0 / 9, 1e-8);
    CHECK_RELATIVE(p.cm, 2.0 / 3, 1e-8);
    CHECK_RELATIVE(p.cp, 2.0 / 3, 1e-8);
    CHECK_RELATIVE(p.cwp, 2.0 / 3, 1e-8);
    CHECK_RELATIVE(p.cvp, 2.0 / 3, 1e-8);
    CHECK_CLOSE(p.transom_ratio, 0, 0);
    CHECK_CLOSE(p.bulb_ratio, 0, 1e-12);
    CU_ASSERT_EQUAL(nurbs_hull_particulars(hull, DENSITY, NAN, &p), NURBS_OK);
    CU_ASSERT_TRUE(isnan(p.gmt));
    nurbs_hull_free(hull);
}

/* Below the water there is neither a waterplane nor what is counted from it. */
static void body_without_a_waterline_has_none_of_its_figures(void)
{
    nurbs_surface *surface = NULL;
    nurbs_hull *hull = NULL;
    nurbs_particulars p;
    double end[2];
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(6, 1, 0.8, 2, &surface), NURBS_OK);
    const nurbs_surface *one = surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create_surfaces(1, &one, NULL, &hull), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_hull_particulars(hull, DENSITY, NAN, &p), NURBS_OK);
    CU_ASSERT_TRUE(isnan(p.waterline_length) && isnan(p.bmt) && isnan(p.cb) && isnan(p.lcf));
    CHECK_RELATIVE(p.mass, DENSITY * 3.14159265358979323846 / 6 * 6 * 1 * 0.8, 1e-9);
    CU_ASSERT_EQUAL(nurbs_hull_perpendiculars(hull, end), NURBS_OK);
    CHECK_CLOSE(end[0], -3, 1e-9);
    CHECK_CLOSE(end[1], 3, 1e-9);
    nurbs_hull_free(hull);
    nurbs_surface_free(surface);
}

static void sectional_areas_are_the_hulls(void)
{
    enum { N = 9 };
    nurbs_hull *hull = wigley(0, 0);
    double x[N + 2], area[N + 2];
    for (int k = 0; k < N; k++)
        x[k] = 0.11 * L * (k - N / 2);
    x[N] = 0.6 * L;
    x[N + 1] = -0.6 * L;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_section_areas(hull, N + 2, x, area), NURBS_OK);
    for (int k = 0; k < N; k++)
        /* chords of parabolas over 256 parts of both directions */
        CHECK_CLOSE(area[k], wigley_section(x[k]), 5e-5 * wigley_section(0));
    CHECK_CLOSE(area[N], 0, 0);
    CHECK_CLOSE(area[N + 1], 0, 0);
    nurbs_hull_free(hull);
}

static void perpendiculars_go_by_the_length_kept(void)
{
    static const struct {
        double lpp, shift, aft, fore;
    } rows[] = {{0, 0, -5, 5},      {10, 0, -5, 5},        {9.8, 5, 0, 9.8},    {9.8, 4.9, 0, 9.8},
                {9.8, 5.2, 0, 9.8}, {9.6, 0.1, -4.8, 4.8}, {9.8, 20, 15, 24.8}, {20, 5, 0, 10}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
        nurbs_hull *hull = wigley(rows[k].lpp, rows[k].shift);
        double x[2];
        CU_ASSERT_EQUAL(nurbs_hull_perpendiculars(hull, x), NURBS_OK);
        CHECK_CLOSE(x[0], rows[k].aft, 1e-12);
        CHECK_CLOSE(x[1], rows[k].fore, 1e-12);
        nurbs_hull_free(hull);
    }
}

/* The option counts like the length that a file keeps. */
static void perpendiculars_go_by_the_length_given(void)
{
    nurbs_surface *surface = NULL;
    nurbs_hull *hull = NULL;
    nurbs_hull_options options;
    nurbs_particulars p;
    nurbs_hull_options_init(&options);
    options.length = 9.7;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(L, B, T, &surface), NURBS_OK);
    const nurbs_surface *one = surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create_surfaces(1, &one, &options, &hull), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_hull_particulars(hull, DENSITY, NAN, &p), NURBS_OK);
    CHECK_CLOSE(p.perpendicular[0], -4.85, 1e-12);
    CHECK_CLOSE(p.lcb_from_fore, 4.85, 1e-9);
    nurbs_hull_free(hull);
    nurbs_surface_free(surface);
}

/* Of a body given whole each side counts once, whichever way its patches face; the inner sides of
 * a catamaran subtract. */
static void sectional_areas_of_both_sides_and_of_twin_hulls(void)
{
    static const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1}, apart[3] = {0, 2 * B, 0};
    nurbs_surface *port = NULL, *starboard = NULL, *outer = NULL, *inner = NULL;
    nurbs_hull *whole = NULL, *twin = NULL;
    const double x[2] = {0.1, 3.3};
    double area[2];
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(L, B, T, &port), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(port, mirror, NULL, &starboard), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(port, NULL, apart, &outer), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(starboard, NULL, apart, &inner), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hull_create_surfaces(2, (const nurbs_surface *[]){port, starboard}, NULL, &whole),
        NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hull_create_surfaces(2, (const nurbs_surface *[]){outer, inner}, NULL, &twin),
        NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_hull_section_areas(whole, 2, x, area), NURBS_OK);
    for (int k = 0; k < 2; k++)
        CHECK_CLOSE(area[k], wigley_section(x[k]), 5e-5 * wigley_section(0));
    CU_ASSERT_EQUAL(nurbs_hull_section_areas(twin, 2, x, area), NURBS_OK);
    for (int k = 0; k < 2; k++)
        CHECK_CLOSE(area[k], 2 * wigley_section(x[k]), 1e-4 * wigley_section(0));
    nurbs_hull_free(whole);
    nurbs_hull_free(twin);
    nurbs_surface_free(port);
    nurbs_surface_free(starboard);
    nurbs_surface_free(outer);
    nurbs_surface_free(inner);
}

static void waterline_is_the_hulls(void)
{
    nurbs_hull *hull = wigley(0, 0);
    double *xy = NULL;
    size_t n = 0;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_waterline(hull, &n, &xy), NURBS_OK);
    CU_ASSERT_TRUE(n > 20);
    for (size_t k = 0; k < n; k++) {
        double x = xy[2 * k], s = 2 * x / L;
        CU_ASSERT_TRUE(k == 0 || x >= xy[2 * k - 2]);
        CHECK_CLOSE(xy[2 * k + 1], B / 2 * (1 - s * s), 1e-6);
    }
    free(xy);
    CU_ASSERT_EQUAL(nurbs_hull_waterline(NULL, &n, &xy), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_waterline(hull, NULL, &xy), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_waterline(hull, &n, NULL), NURBS_ERROR_ARGUMENT);
    nurbs_hull_free(hull);
}

static void point_at(const nurbs_surface *surface, double u, double v, double p[3])
{
    const double uv[2] = {u, v};
    CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, p), NURBS_OK);
}

/* A clamped spline passes through its corners and, along an edge, stays within its control points.
 */
static void ship_forms_keep_their_numbers(void)
{
    static const double length = 7, beam = 1.1, draft = 0.3;
    nurbs_status (*const fill[2])(double, double, double,
                                  nurbs_ship_form *) = {nurbs_ship_form_fast, nurbs_ship_form_bulb};
    for (int f = 0; f < 2; f++) {
        nurbs_ship_form form;
        nurbs_surface *ship = NULL;
        double p[3], widest = 0, deepest = 0, foremost = 0;
        CU_ASSERT_EQUAL(fill[f](length, beam, draft, &form), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_make_ship(&form, &ship), NURBS_OK);
        point_at(ship, 0, 0, p);
        CHECK_CLOSE(p[0], 0, 1e-14);
        CHECK_RELATIVE(p[1], form.transom_beam * beam / 2, 1e-14);
        CHECK_CLOSE(p[2], 0, 0);
        point_at(ship, 0, 1, p);
        CHECK_CLOSE(p[1], 0, 1e-14);
        CHECK_RELATIVE(p[2], -form.transom_draft * draft, 1e-14);
        point_at(ship, 1, 0, p);
        CHECK_RELATIVE(p[0], length, 1e-14);
        CHECK_CLOSE(p[1], 0, 1e-14);
        point_at(ship, 1, 1, p);
        CHECK_RELATIVE(p[0], length * (1 - form.rake), 1e-14);
        for (int i = 0; i <= 200; i++)
            for (int j = 0; j <= 100; j++) {
                point_at(ship, i / 200.0, j / 100.0, p);
                CU_ASSERT_TRUE(p[1] >= 0 && p[2] <= 0);
                widest = j == 0 ? fmax(widest, p[1]) : widest;
                deepest = fmin(deepest, p[2]);
                foremost = fmax(foremost, p[0]);
            }
        CHECK_RELATIVE(widest, beam / 2, 0.01);
        CHECK_RELATIVE(deepest, -draft, 0.01);
        CU_ASSERT_TRUE(f == 0 ? foremost <= length * (1 + 1e-14)
                              : foremost > length * (1 + 0.5 * form.bulb_length));
        nurbs_surface_free(ship);
    }
}

static void refuses_what_is_no_ship_and_no_question(void)
{
    nurbs_hull *hull = wigley(0, 0);
    nurbs_particulars p;
    nurbs_ship_form good, bad;
    nurbs_surface *ship = NULL;
    double x[2] = {0, NAN}, area[2];
    CU_ASSERT_EQUAL(nurbs_hull_particulars(NULL, 1000, NAN, &p), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_particulars(hull, 1000, NAN, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_particulars(hull, 0, NAN, &p), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_particulars(hull, 1000, INFINITY, &p), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_perpendiculars(NULL, x), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_perpendiculars(hull, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_section_areas(NULL, 1, x, area), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_section_areas(hull, 1, NULL, area), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_section_areas(hull, 1, x, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_section_areas(hull, 2, x, area), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_hull_section_areas(hull, 0, NULL, NULL), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_ship_form_fast(1, 1, 1, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_ship_form_bulb(1, 1, 1, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_make_ship(NULL, &ship), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_ship_form_fast(1, 0.13, 0.04, &good), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_make_ship(&good, NULL), NURBS_ERROR_ARGUMENT);
    for (int k = 0; k < 4; k++) {
        bad = good;
        *(double *[]){&bad.length, &bad.fullest, &bad.run, &bad.section[1]}[k] = k == 1 ? 1 : 0;
        CU_ASSERT_EQUAL(nurbs_make_ship(&bad, &ship), NURBS_ERROR_ARGUMENT);
        CU_ASSERT_PTR_NULL(ship);
    }
    bad = good;
    bad.rake = NAN;
    CU_ASSERT_EQUAL(nurbs_make_ship(&bad, &ship), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "rake"));
    nurbs_hull_free(hull);
}

static const struct check_case cases[] = {
    {"particulars of the Wigley hull", particulars_of_the_wigley_hull},
    {"body without a waterline has none of its figures",
     body_without_a_waterline_has_none_of_its_figures},
    {"sectional areas are the hull's", sectional_areas_are_the_hulls},
    {"perpendiculars go by the length kept", perpendiculars_go_by_the_length_kept},
    {"perpendiculars go by the length given", perpendiculars_go_by_the_length_given},
    {"sectional areas of both sides and of twin hulls",
     sectional_areas_of_both_sides_and_of_twin_hulls},
    {"waterline is the hull's", waterline_is_the_hulls},
    {"ship forms keep their numbers", ship_forms_keep_their_numbers},
    {"refuses what is no ship and no question", refuses_what_is_no_ship_and_no_question},
};

CHECK_MAIN("nurbs particulars", cases)
