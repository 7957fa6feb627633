/* Surfaces of IGES files that are given by their form: areas and volumes from closed forms. */
#include "iges_writer.h"

#include <nurbs/nurbs.h>

#include <stdbool.h>

enum { GEOMETRY = 0, DEPENDENT = 10000, BLANK = 1000000 };

static const double pi = 3.14159265358979323846;

static char report[4000];

static nurbs_patches *read_written(const iges_writer *w, const char *unit, double tolerance)
{
    nurbs_patches *patches = NULL;
    const char *path = iges_save(w, unit);
    if (nurbs_patches_read_reported(path, tolerance, &patches, report, sizeof report) != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    unlink(path);
    CU_ASSERT_PTR_NOT_NULL_FATAL(patches);
    return patches;
}

/* Checks area and, if it is not NAN, volume (between surface and y = 0, of either sign). */
static void check_moments(const iges_writer *w, const char *unit, double tolerance, size_t count,
                          double area, double volume, double allowed)
{
    nurbs_moments m;
    nurbs_patches *patches = read_written(w, unit, tolerance);
    if (count > 0)
        CU_ASSERT_EQUAL(nurbs_patches_count(patches), count);
    CU_ASSERT_EQUAL(nurbs_patches_moments(patches, &m, NULL), NURBS_OK);
    CHECK_RELATIVE(m.area, area, allowed);
    if (!isnan(volume))
        CHECK_RELATIVE(fabs(m.volume), volume, allowed);
    nurbs_patches_free(patches);
}

static int line(iges_writer *w, double x0, double y0, double z0, double x1, double y1, double z1)
{
    return iges_add(w, 110, 0, DEPENDENT, 0, "110,%.15g,%.15g,%.15g,%.15g,%.15g,%.15g;", x0, y0, z0,
                    x1, y1, z1);
}

/* Circle of radius r about the z axis at height z, from angle a to b, in steps of whole entities.
 */
static int arc(iges_writer *w, double z, double r, double a, double b)
{
    return iges_add(w, 100, 0, DEPENDENT, 0, "100,%.15g,0,0,%.15g,%.15g,%.15g,%.15g;", z,
                    r * cos(a), r * sin(a), r * cos(b), r * sin(b));
}

static void reads_ruled_surfaces(void)
{
    /* Between two quarter circles: a quarter of a cylinder, or of a frustum of a cone. */
    static iges_writer w;
    w.count = 0;
    int a = arc(&w, 0, 2, 0, pi / 2), b = arc(&w, 5, 2, 0, pi / 2);
    iges_add(&w, 118, 1, GEOMETRY, 0, "118,%d,%d,0,1;", a, b);
    check_moments(&w, "6,1HM", 0, 1, pi * 5, NAN, 1e-12);
    w.count = 0;
    a = arc(&w, 0, 2, 0, pi / 2);
    b = arc(&w, 4, 5, 0, pi / 2);
    iges_add(&w, 118, 1, GEOMETRY, 0, "118,%d,%d,0,1;", a, b);
    check_moments(&w, "6,1HM", 0, 1, pi / 4 * (2 + 5) * 5, NAN, 1e-12);
    /* A rail in the other direction, as a composite of two lines: a plane rectangle. */
    w.count = 0;
    a = line(&w, 0, 0, 0, 6, 0, 0);
    int c = line(&w, 6, 2, 0, 3, 2, 0), d = line(&w, 3, 2, 0, 0, 2, 0);
    b = iges_add(&w, 102, 0, DEPENDENT, 0, "102,2,%d,%d;", c, d);
    iges_add(&w, 118, 0, GEOMETRY, 0, "118,%d,%d,1,0;", a, b);
    check_moments(&w, "6,1HM", 0, 1, 12, NAN, 1e-12);
}

static void reads_surfaces_of_revolution(void)
{
    static iges_writer w;
    w.count = 0;
    int axis = line(&w, 0, 0, 0, 0, 0, 1), cone = line(&w, 1, 0, 0, 4, 0, 4);
    iges_add(&w, 120, 0, GEOMETRY, 0, "120,%d,%d,0,%.16g;", axis, cone, 2 * pi);
    check_moments(&w, "6,1HM", 0, 1, pi * (1 + 4) * 5, NAN, 1e-12);
    w.count = 0;
    axis = line(&w, 0, 0, 0, 0, 0, 1);
    cone = line(&w, 1, 0, 0, 4, 0, 4);
    iges_add(&w, 120, 0, GEOMETRY, 0, "120,%d,%d,0.5,1.25;", axis, cone);
    check_moments(&w, "6,1HM", 0, 1, (1 + 4) * 5 * 0.75 / 2, NAN, 1e-12);
    /* A circle beside the axis, turned upright: torus of radii 3 and 1, in millimetres. */
    w.count = 0;
    axis = line(&w, 0, 0, 0, 0, 0, 1);
    int upright = iges_add(&w, 124, 0, GEOMETRY, 0, "124,1,0,0,3000,0,0,-1,0,0,1,0,0;");
    int circle = iges_add(&w, 100, 0, DEPENDENT, upright, "100,0,0,0,1000,0,1000,0;");
    iges_add(&w, 120, 0, GEOMETRY, 0, "120,%d,%d,0,%.16g;", axis, circle, 2 * pi);
    check_moments(&w, "2,2HMM", 0, 1, 4 * pi * pi * 3, 2 * pi * pi * 3, 1e-10);
}

static void reads_tabulated_cylinders(void)
{
    static iges_writer w;
    w.count = 0;
    int half = arc(&w, 0, 2, 0, pi);
    iges_add(&w, 122, 0, GEOMETRY, 0, "122,%d,2,0,7;", half);
    check_moments(&w, "6,1HM", 0, 1, 2 * pi * 7, pi * 4 / 2 * 7, 1e-10);
    /* An ellipse 104, semi-axes 4 and 2: the volume behind it is that of half an elliptic cylinder.
     */
    w.count = 0;
    half = iges_add(&w, 104, 1, DEPENDENT, 0, "104,0.0625,0,0.25,0,0,-1,0,4,0,-4,0;");
    iges_add(&w, 122, 0, GEOMETRY, 0, "122,%d,4,0,3;", half);
    nurbs_patches *patches = read_written(&w, "6,1HM", 0);
    nurbs_moments m;
    CU_ASSERT_EQUAL(nurbs_patches_moments(patches, &m, NULL), NURBS_OK);
    CHECK_RELATIVE(fabs(m.volume), pi * 4 * 2 / 2 * 3, 1e-10);
    nurbs_patches_free(patches);
    /* Parabola y = x^2 from -1 to 1 as a conic, a parametric cubic and a polyline's chord. */
    w.count = 0;
    half = iges_add(&w, 104, 3, DEPENDENT, 0, "104,1,0,0,0,-1,0,0,-1,1,1,1;");
    iges_add(&w, 122, 0, GEOMETRY, 0, "122,%d,-1,1,1;", half);
    half = iges_add(&w, 112, 0, DEPENDENT, 0, "112,3,3,3,1,0,2,-1,1,0,0,1,-2,1,0,0,0,0,0;");
    iges_add(&w, 122, 0, GEOMETRY, 0, "122,%d,-1,1,1;", half);
    double area = sqrt(5) + 0.5 * asinh(2);
    check_moments(&w, "6,1HM", 0, 2, 2 * area, NAN, 1e-9);
    w.count = 0;
    half = iges_add(&w, 106, 11, DEPENDENT, 0, "106,1,3,0,-1,1,0,0,1,1;");
    iges_add(&w, 122, 0, GEOMETRY, 0, "122,%d,-1,1,1;", half);
    check_moments(&w, "6,1HM", 0, 1, 2 * sqrt(2), NAN, 1e-12);
}

/* A polygon in the plane x + y = 1 (u along (-1, 1, 0) / sqrt 2, v = z), as a composite of lines.
 */
static int polygon(iges_writer *w, size_t n, double uv[][2])
{
    char text[200] = "";
    int number[12];
    for (size_t k = 0; k < n; k++) {
        const double *a = uv[k], *b = uv[(k + 1) % n], s = sqrt(0.5);
        number[k] = line(w, 1 - s * a[0], s * a[0], a[1], 1 - s * b[0], s * b[0], b[1]);
    }
    for (size_t k = 0; k < n; k++)
        snprintf(text + strlen(text), sizeof text - strlen(text), ",%d", number[k]);
    return iges_add(w, 102, 0, DEPENDENT, 0, "102,%zu%s;", n, text);
}

static double polygon_area(size_t n, double uv[][2])
{
    double twice = 0;
    for (size_t k = 0; k < n; k++)
        twice += uv[k][0] * uv[(k + 1) % n][1] - uv[k][1] * uv[(k + 1) % n][0];
    return fabs(twice) / 2;
}

static void reads_planes_inside_their_curves(void)
{
    static double triangle[][2] = {{0, 0}, {4, 1}, {1, 3}},
                  quad[][2] = {{0, 0}, {5, 1}, {4, 3}, {1, 2}},
                  hexagon[][2] = {{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 3}, {0, 3}}, /* an L */
        comb[][2] = {{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1},
                     {3, 1}, {3, 3}, {2, 3}, {2, 1}, {0, 1}};
    static struct {
        size_t n;
        double (*uv)[2];
        bool exact;
    } shapes[] = {{3, triangle, true}, {4, quad, true}, {6, hexagon, false}, {10, comb, false}};
    static iges_writer w;
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++) {
        w.count = 0;
        int loop = polygon(&w, shapes[k].n, shapes[k].uv);
        iges_add(&w, 108, 1, GEOMETRY, 0, "108,1,1,0,1,%d,0,0,0,0;", loop);
        check_moments(&w, "6,1HM", 0, shapes[k].exact ? 1 : 0,
                      polygon_area(shapes[k].n, shapes[k].uv), NAN, shapes[k].exact ? 1e-13 : 1e-5);
        CU_ASSERT_PTR_NOT_NULL(strstr(report, shapes[k].exact ? "1 of them exact" : "resampled"));
    }
    /* A disc, and one with a square hole. */
    w.count = 0;
    int circle = arc(&w, 2, 3, 0, 2 * pi);
    iges_add(&w, 108, 1, GEOMETRY, 0, "108,0,0,1,2,%d,0,0,0,0;", circle);
    check_moments(&w, "6,1HM", 1e-5, 0, pi * 9, NAN, 1e-5);
    w.count = 0;
    circle = arc(&w, 0, 3, 0, 2 * pi);
    int plane = iges_add(&w, 108, 0, DEPENDENT, 0, "108,0,0,1,0,0,0,0,0,0;");
    int outer = iges_add(&w, 142, 0, DEPENDENT, 0, "142,0,%d,0,%d,2;", plane, circle);
    int side[4] = {line(&w, 1, 1, 0, -1, 1, 0), line(&w, -1, 1, 0, -1, -1, 0),
                   line(&w, -1, -1, 0, 1, -1, 0), line(&w, 1, -1, 0, 1, 1, 0)};
    int square = iges_add(&w, 102, 0, DEPENDENT, 0, "102,4,%d,%d,%d,%d;", side[0], side[1], side[2],
                          side[3]);
    int inner = iges_add(&w, 142, 0, DEPENDENT, 0, "142,0,%d,0,%d,2;", plane, square);
    iges_add(&w, 144, 0, GEOMETRY, 0, "144,%d,1,1,%d,%d;", plane, outer, inner);
    check_moments(&w, "6,1HM", 1e-5, 0, pi * 9 - 4, NAN, 1e-5);
}

static int solid_surface(iges_writer *w, int type, double z, const char *rest)
{
    int place = iges_add(w, 116, 0, DEPENDENT, 0, "116,0,0,%.15g,0;", z),
        axis = iges_add(w, 123, 0, DEPENDENT, 0, "123,0,0,1;");
    if (type == 196)
        return iges_add(w, type, 0, DEPENDENT, 0, "196,%d,%s,%d;", place, rest, axis);
    return iges_add(w, type, 0, DEPENDENT, 0, "%d,%d,%d%s;", type, place, axis, rest);
}

/* A face 510 bounded by loops of edges; each loop: curves with their senses. */
typedef struct bounds {
    size_t n;
    int curve[4], agrees[4];
} bounds;

static void add_face(iges_writer *w, int surface, size_t loops, const bounds *b)
{
    char text[200] = "";
    for (size_t k = 0; k < loops; k++) {
        char edges[300] = "", uses[300] = "";
        for (size_t i = 0; i < b[k].n; i++)
            snprintf(edges + strlen(edges), sizeof edges - strlen(edges), ",%d,0,0,0,0",
                     b[k].curve[i]);
        int list = iges_add(w, 504, 1, DEPENDENT, 0, "504,%zu%s;", b[k].n, edges);
        for (size_t i = 0; i < b[k].n; i++)
            snprintf(uses + strlen(uses), sizeof uses - strlen(uses), ",0,%d,%zu,%d,0", list, i + 1,
                     b[k].agrees[i]);
        int loop = iges_add(w, 508, 1, DEPENDENT, 0, "508,%zu%s;", b[k].n, uses);
        snprintf(text + strlen(text), sizeof text - strlen(text), ",%d", loop);
    }
    iges_add(w, 510, 1, DEPENDENT, 0, "510,%d,%zu,1%s;", surface, loops, text);
}

static void reads_quadrics_inside_their_loops(void)
{
    static iges_writer w;
    /* A cylinder with a seam, and without. */
    for (int seam = 0; seam < 2; seam++) {
        w.count = 0;
        int surface = solid_surface(&w, 192, 0, ",2"), low = arc(&w, 1, 2, 0, 2 * pi),
            high = arc(&w, 4, 2, 0, 2 * pi), edge = line(&w, 2, 0, 1, 2, 0, 4);
        if (seam)
            add_face(&w, surface, 1, &(bounds){4, {low, edge, high, edge}, {1, 1, 0, 0}});
        else
            add_face(&w, surface, 2, (bounds[2]){{1, {low}, {1}}, {1, {high}, {0}}});
        check_moments(&w, "6,1HM", 0, 1, 2 * pi * 2 * 3, pi * 4 * 3, 1e-10);
        CU_ASSERT_PTR_NOT_NULL(strstr(report, "1 of them exact"));
    }
    /* The tip of a cone, the cap of a sphere above z = 1, the belt between -1 and 1, all of it. */
    w.count = 0;
    int surface = solid_surface(&w, 194, 0, ",3,45"), rim = arc(&w, 0, 3, 0, 2 * pi);
    add_face(&w, surface, 1, &(bounds){1, {rim}, {0}});
    check_moments(&w, "6,1HM", 0, 1, pi * 9 * sqrt(2), pi * 9, 1e-10);
    w.count = 0;
    surface = solid_surface(&w, 196, 0, "2");
    rim = arc(&w, 1, sqrt(3), 0, 2 * pi);
    add_face(&w, surface, 1, &(bounds){1, {rim}, {1}});
    check_moments(&w, "6,1HM", 0, 1, 2 * pi * 2 * 1, NAN, 1e-10);
    w.count = 0;
    surface = solid_surface(&w, 196, 0, "2");
    rim = arc(&w, -1, sqrt(3), 0, 2 * pi);
    int other = arc(&w, 1, sqrt(3), 0, 2 * pi);
    add_face(&w, surface, 2, (bounds[2]){{1, {rim}, {1}}, {1, {other}, {0}}});
    check_moments(&w, "6,1HM", 0, 1, 2 * pi * 2 * 2, NAN, 1e-10);
    w.count = 0;
    solid_surface(&w, 196, 0, "2");
    check_moments(&w, "6,1HM", 0, 1, 4 * pi * 4, 4 * pi / 3 * 8, 1e-10);
    w.count = 0;
    solid_surface(&w, 198, 1, ",3,1");
    check_moments(&w, "6,1HM", 0, 1, 4 * pi * pi * 3, 2 * pi * pi * 3, 1e-10);
    /* An eighth of a sphere: three edges, one corner in the pole. */
    w.count = 0;
    surface = solid_surface(&w, 196, 0, "2");
    int up = iges_add(&w, 124, 0, GEOMETRY, 0, "124,0,0,1,0,1,0,0,0,0,1,0,0;"),    /* x y -> y z */
        side = iges_add(&w, 124, 0, GEOMETRY, 0, "124,1,0,0,0,0,0,-1,0,0,1,0,0;"); /* x y -> x z */
    int quarter[3] = {arc(&w, 0, 2, 0, pi / 2),
                      iges_add(&w, 100, 0, DEPENDENT, up, "100,0,0,0,2,0,0,2;"),
                      iges_add(&w, 100, 0, DEPENDENT, side, "100,0,0,0,2,0,0,2;")};
    add_face(&w, surface, 1, &(bounds){3, {quarter[0], quarter[1], quarter[2]}, {1, 1, 0}});
    check_moments(&w, "6,1HM", 0, 1, pi * 4 / 2, NAN, 1e-10);
}

/* A cylinder cut off slantwise, z = 3 + x / 2: its mean height is 3. */
static void resamples_what_is_not_exact(void)
{
    static iges_writer w;
    w.count = 0;
    /* The slanted rim: centre (0,0,3), semi-axes (2,0,1) and (0,2,0). */
    double tilt = sqrt(5) / 2;
    int surface = solid_surface(&w, 192, 0, ",2"), low = arc(&w, 0, 2, 0, 2 * pi);
    int frame = iges_add(&w, 124, 0, GEOMETRY, 0, "124,%.16g,0,%.16g,0,0,1,0,0,%.16g,0,%.16g,3;",
                         1 / tilt, -0.5 / tilt, 0.5 / tilt, 1 / tilt);
    int rim = iges_add(&w, 104, 1, DEPENDENT, frame, "104,%.16g,0,%.16g,0,0,-1,0,%.16g,0,%.16g,0;",
                       1 / (4 * tilt * tilt), 0.25, 2 * tilt, 2 * tilt);
    add_face(&w, surface, 2, (bounds[2]){{1, {low}, {1}}, {1, {rim}, {0}}});
    check_moments(&w, "6,1HM", 1e-6, 0, 2 * pi * 2 * 3, pi * 4 * 3, 1e-6);
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "510 face D"));
}

/* A square 128 in which a circle is given in space only: kept whole without a tolerance, and told.
 */
static void follows_curves_in_space(void)
{
    static iges_writer w;
    w.count = 0;
    int square = iges_add(&w, 128, 0, DEPENDENT, 0,
                          "128,1,1,1,1,0,0,1,0,0,0,0,1,1,0,0,1,1,1,1,1,1,-1,-1,0,1,-1,0,-1,1,0,1,1,"
                          "0,0,1,0,1;");
    int circle = arc(&w, 0, 0.5, 0, 2 * pi);
    int loop = iges_add(&w, 142, 0, DEPENDENT, 0, "142,0,%d,0,%d,2;", square, circle);
    iges_add(&w, 144, 0, GEOMETRY, 0, "144,%d,1,0,%d;", square, loop);
    check_moments(&w, "6,1HM", 0, 1, 4, NAN, 1e-12);
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "no curves in parameter space: the whole surface D1"));
    check_moments(&w, "6,1HM", 1e-6, 0, pi / 4, NAN, 1e-5);
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "1 of these resampled"));
}

/* Lengths of a conic arc, a polyline and a parametric cubic, as curves for skinning. */
static void reads_curves_of_other_kinds(void)
{
    static iges_writer w;
    size_t n;
    nurbs_curve **curves;
    w.count = 0;
    iges_add(&w, 104, 1, GEOMETRY, 0, "104,0.0625,0,0.25,0,0,-1,2,4,0,-4,0;");
    iges_add(&w, 106, 12, GEOMETRY, 0, "106,2,3,0,0,0,3,0,4,3,5,4;");
    iges_add(&w, 112, 0, GEOMETRY, 0,
             "112,3,3,3,2,0,1,3,0,1,0,0,0,0,1,0,7,0,0,0,1,1,0,0,1,2,1,0,7,0,0,0;");
    const char *path = iges_save(&w, "6,1HM");
    CU_ASSERT_EQUAL_FATAL(nurbs_curves_read_iges(path, &n, &curves), NURBS_OK);
    unlink(path);
    CU_ASSERT_EQUAL_FATAL(n, 3);
    for (int k = 0; k <= 16; k++) {
        const double *knots = nurbs_curve_knots(curves[0]);
        double u = knots[0] + (knots[nurbs_curve_size(curves[0])] - knots[0]) * k / 16, p[3];
        CU_ASSERT_EQUAL(nurbs_curve_eval(curves[0], 0, 1, &u, p), NURBS_OK);
        CHECK_CLOSE(p[0] * p[0] / 16 + p[1] * p[1] / 4, 1, 1e-14);
        CHECK_CLOSE(p[2], 2, 1e-15);
        double v = 3.0 * k / 16; /* y = x^2 at z = 7 */
        CU_ASSERT_EQUAL(nurbs_curve_eval(curves[2], 0, 1, &v, p), NURBS_OK);
        CHECK_CLOSE(p[0], v, 1e-14);
        CHECK_CLOSE(p[1], v * v, 1e-13);
        CHECK_CLOSE(p[2], 7, 1e-14);
    }
    CU_ASSERT_EQUAL(nurbs_curve_size(curves[1]), 3);
    CHECK_CLOSE(nurbs_curve_points(curves[1])[4], 0, 0);
    CHECK_CLOSE(nurbs_curve_points(curves[1])[7], 5, 0);
    nurbs_curves_free(n, curves);
}

static void reads_offsets(void)
{
    static iges_writer w;
    w.count = 0;
    int base = solid_surface(&w, 196, 0, "2");
    iges_add(&w, 140, 0, GEOMETRY, 0, "140,1,0,0,0.5,%d;", base);
    check_moments(&w, "6,1HM", 0, 1, 4 * pi * 6.25, NAN, 1e-10);
    w.count = 0;
    base = solid_surface(&w, 192, 0, ",2");
    int offset = iges_add(&w, 140, 0, DEPENDENT, 0, "140,-1,0,0,0.5,%d;", base),
        low = arc(&w, 0, 1.5, 0, 2 * pi), high = arc(&w, 1, 1.5, 0, 2 * pi);
    add_face(&w, offset, 2, (bounds[2]){{1, {low}, {1}}, {1, {high}, {0}}});
    check_moments(&w, "6,1HM", 0, 1, 2 * pi * 1.5, NAN, 1e-10);
    /* An offset of a ruled surface is none of these forms: left out, and told. */
    int a = line(&w, 0, 0, 0, 1, 0, 0), b = line(&w, 0, 1, 0, 1, 1, 1);
    base = iges_add(&w, 118, 1, DEPENDENT, 0, "118,%d,%d,0,1;", a, b);
    offset = iges_add(&w, 140, 0, GEOMETRY, 0, "140,0,0,1,0.5,%d;", base);
    check_moments(&w, "6,1HM", 0, 1, 2 * pi * 1.5, NAN, 1e-10);
    char expected[80];
    snprintf(expected, sizeof expected, "140 offset surface D%d is left out: an offset", offset);
    CU_ASSERT_PTR_NOT_NULL(strstr(report, expected));
}

static void places_subfigures(void)
{
    static iges_writer w;
    w.count = 0;
    int a = line(&w, 0, 0, 0, 1, 0, 0), b = line(&w, 0, 1, 0, 1, 1, 0);
    int plate = iges_add(&w, 118, 1, 20000, 0, "118,%d,%d,0,1;", a, b);
    int inner = iges_add(&w, 308, 0, 200, 0, "308,0,5Hplate,1,%d;", plate);
    int twice = iges_add(&w, 408, 0, 20000, 0, "408,%d,10,0,0,2;", inner);
    int outer = iges_add(&w, 308, 0, 200, 0, "308,1,4Hpair,2,%d,%d;", plate, twice);
    int turned = iges_add(&w, 124, 0, GEOMETRY, 0, "124,0,-1,0,0,1,0,0,0,0,0,1,7;");
    iges_add(&w, 408, 0, GEOMETRY, turned, "408,%d,100,0,0;", outer);
    iges_add(&w, 408, 0, BLANK, 0, "408,%d,0,0,0;", outer);
    nurbs_patches *patches = read_written(&w, "6,1HM", 0);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_count(patches), 2);
    /* Corner (1,1,0): of the plate itself, and scaled and moved by (10,0,0); then (100,0,0), then
     * the quarter turn and 7 up. */
    const double expected[2][3] = {{-1, 101, 7}, {-2, 112, 7}};
    for (size_t k = 0; k < 2; k++) {
        const double uv[2] = {1, 1};
        double p[3];
        CU_ASSERT_EQUAL(nurbs_surface_eval(nurbs_patches_get(patches, k), 0, 1, uv, p), NURBS_OK);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(p[c], expected[k][c], 1e-13);
    }
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "1 blank"));
    nurbs_patches_free(patches);
    /* A subfigure inside itself. */
    w.count = 0;
    iges_add(&w, 308, 0, 200, 0, "308,0,4Hloop,1,3;");
    iges_add(&w, 408, 0, 20000, 0, "408,1,1,0,0;");
    iges_add(&w, 408, 0, GEOMETRY, 0, "408,1,1,0,0;");
    const char *path = iges_save(&w, "6,1HM");
    CU_ASSERT_EQUAL(nurbs_patches_read(path, &patches), NURBS_ERROR_FORMAT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "without end"));
    unlink(path);
}

static void leaves_out_what_is_blank(void)
{
    static iges_writer w;
    w.count = 0;
    int a = line(&w, 0, 0, 0, 1, 0, 0), b = line(&w, 0, 1, 0, 1, 1, 0);
    iges_add(&w, 118, 1, GEOMETRY, 0, "118,%d,%d,0,1;", a, b);
    iges_add(&w, 118, 1, BLANK, 0, "118,%d,%d,0,1;", a, b);
    check_moments(&w, "1,2HIN", 0, 1, 0.0254 * 0.0254, NAN, 1e-12);
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "1 blank entities are left out"));
}

/* Nothing bounds the plane: refused, and the sentence tells how much was left out. */
static void refuses_files_without_surfaces(void)
{
    static iges_writer w;
    w.count = 0;
    nurbs_patches *patches;
    iges_add(&w, 108, 0, GEOMETRY, 0, "108,0,0,1,2,0,0,0,0,0;");
    const char *path = iges_save(&w, "6,1HM");
    CU_ASSERT_EQUAL(nurbs_patches_read_reported(path, 0, &patches, report, sizeof report),
                    NURBS_ERROR_FORMAT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "1 faces are left out"));
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "108 plane D1 is left out: nothing limits it"));
    unlink(path);
}

static const struct check_case cases[] = {
    {"reads ruled surfaces", reads_ruled_surfaces},
    {"reads surfaces of revolution", reads_surfaces_of_revolution},
    {"reads tabulated cylinders", reads_tabulated_cylinders},
    {"reads planes inside their curves", reads_planes_inside_their_curves},
    {"reads quadrics inside their loops", reads_quadrics_inside_their_loops},
    {"resamples what is not exact", resamples_what_is_not_exact},
    {"follows curves in space", follows_curves_in_space},
    {"reads curves of other kinds", reads_curves_of_other_kinds},
    {"reads offsets", reads_offsets},
    {"places subfigures", places_subfigures},
    {"leaves out what is blank", leaves_out_what_is_blank},
    {"refuses files without surfaces", refuses_files_without_surfaces},
};

CHECK_MAIN("surfaces of IGES files by their form", cases)
