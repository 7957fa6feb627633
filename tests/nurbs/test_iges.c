#include "check.h"
#include "hulls.h"

#include <string.h>
#include <unistd.h>

#define DATA(name) TEST_DATA_DIR "/iges_" name ".igs"
/* Written by Open CASCADE 7.6.3: tests/data/occt_samples.cpp. */
#define OCCT(name) TEST_DATA_DIR "/occt_" name ".igs"

/* The patch that most of the files hold: bicubic, 6 x 5 poles. */
static nurbs_surface *expected_patch(void)
{
    const double u[10] = {0, 0, 0, 0, 0.4, 0.7, 1, 1, 1, 1}, v[9] = {0, 0, 0, 0, 0.5, 1, 1, 1, 1};
    double points[90];
    for (size_t i = 0; i < 6; i++)
        for (size_t j = 0; j < 5; j++) {
            double *p = points + 3 * (5 * i + j);
            p[0] = 2.0 * (double)i;
            p[1] = 0.25 + (i > 0 && i < 5 ? 0.25 * (double)j : 0);
            p[2] = 0.375 * (double)j + 0.0625 * (double)(i * i);
        }
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){3, 3}, (const size_t[]){6, 5}, u, v,
                                               points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

static nurbs_patches *read_file(const char *path, char report[1000])
{
    nurbs_patches *patches = NULL;
    if (nurbs_patches_read_iges(path, &patches, report, 1000) != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_PTR_NOT_NULL_FATAL(patches);
    return patches;
}

/* Files that say the same in different ways, and what their reports must mention. */
static void pitfalls_give_the_same_patch(void)
{
    static const struct {
        const char *path, *mentioned;
        double tolerance;
    } files[] = {
        {DATA("plain"), "128 B-spline surface x 1", 0},
        {DATA("crlf"), "1 surfaces kept", 0},
        {DATA("no_range"), "1 surfaces kept", 0},
        {DATA("empty_range"), "1 surfaces kept", 0},
        {DATA("wrong_flags"), "1 surfaces kept", 0},
        {DATA("last_knot"), "surface D1: end knots", 0},
        {DATA("d_exponents"), "1 surfaces kept", 0},
        {DATA("millimetres"), "1 surfaces kept", 1e-15},
        {DATA("inches"), "1 surfaces kept", 1e-14},
        {DATA("unit_by_name"), "1 surfaces kept", 1e-15},
        {DATA("model_scale"), "model space scale 0.125", 0},
        {DATA("delimiters"), "1 surfaces kept", 0},
        {DATA("equal_weights"), "1 surfaces kept", 1e-15},
        {DATA("trimmed"), "face D1 trims surface D3", 0},
        {DATA("untrimmed_face"), "0 of them trimmed", 0},
        {DATA("brep_face"), "510 face x 1", 0},
        {OCCT("bspline"), "0 of them trimmed", 1e-15},
        {OCCT("bspline_brep"), "502 vertex list x 1", 1e-15},
        {OCCT("trimmed"), "face D1 trims surface D3", 1e-15},
        {OCCT("trimmed_brep"), "face D1 trims surface D3", 1e-15},
    };
    nurbs_surface *expected = expected_patch();
    for (size_t k = 0; k < sizeof files / sizeof files[0]; k++) {
        char report[1000];
        nurbs_patches *patches = read_file(files[k].path, report);
        const nurbs_surface *surface = nurbs_patches_get(patches, 0);
        CU_ASSERT_EQUAL(nurbs_patches_count(patches), 1);
        CU_ASSERT_PTR_NULL(nurbs_surface_weights(surface));
        CU_ASSERT_EQUAL(nurbs_surface_size(surface, 0), 6);
        CU_ASSERT_EQUAL(nurbs_surface_size(surface, 1), 5);
        for (size_t i = 0; i < 10; i++)
            CHECK_CLOSE(nurbs_surface_knots(surface, 0)[i], nurbs_surface_knots(expected, 0)[i], 0);
        for (size_t i = 0; i < 90; i++)
            CHECK_CLOSE(nurbs_surface_points(surface)[i], nurbs_surface_points(expected)[i],
                        10 * files[k].tolerance);
        if (!strstr(report, files[k].mentioned)) {
            fprintf(stderr, "%s: %s\n", files[k].path, report);
            CU_FAIL("the report does not mention what it must");
        }
        nurbs_patches_free(patches);
    }
    nurbs_surface_free(expected);
}

static void cuts_to_the_stated_range(void)
{
    char report[1000];
    nurbs_patches *patches = read_file(DATA("sub_range"), report);
    const nurbs_surface *surface = nurbs_patches_get(patches, 0);
    nurbs_surface *expected = expected_patch();
    CHECK_CLOSE(nurbs_surface_knots(surface, 0)[0], 0.2, 0);
    CHECK_CLOSE(nurbs_surface_knots(surface, 0)[nurbs_surface_size(surface, 0)], 0.9, 0);
    CHECK_CLOSE(nurbs_surface_knots(surface, 1)[nurbs_surface_size(surface, 1)], 0.75, 0);
    for (int k = 0; k <= 20; k++) {
        double uv[2] = {0.2 + 0.7 * k / 20, 0.75 - 0.75 * k / 20}, p[3], q[3];
        uv[0] = fmin(uv[0], 0.9);
        CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, p), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_surface_eval(expected, 0, 1, uv, q), NURBS_OK);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(p[c], q[c], 1e-14);
    }
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "cut to its stated range 0.2 to 0.9"));
    nurbs_surface_free(expected);
    nurbs_patches_free(patches);
}

/* D3 turns by a right angle and moves by (1,2,3); its own transformation mirrors y and moves x
 * by 10.
 */
static void applies_chains_of_transformations(void)
{
    char report[1000];
    nurbs_patches *patches = read_file(DATA("transformed"), report);
    nurbs_surface *expected = expected_patch();
    const double *p = nurbs_surface_points(nurbs_patches_get(patches, 0)),
                 *q = nurbs_surface_points(expected);
    for (size_t k = 0; k < 90; k += 3) {
        CHECK_CLOSE(p[k], 11 - q[k + 1], 1e-15);
        CHECK_CLOSE(p[k + 1], -(q[k] + 2), 1e-15);
        CHECK_CLOSE(p[k + 2], q[k + 2] + 3, 1e-15);
    }
    nurbs_surface_free(expected);
    nurbs_patches_free(patches);
}

/* Uniform cubic with knots -3 ... 5: blending functions (1,4,1)/6 at the knots. */
static void clamps_periodic_knots(void)
{
    char report[1000];
    nurbs_patches *patches = read_file(DATA("unclamped"), report);
    const nurbs_surface *surface = nurbs_patches_get(patches, 0);
    CHECK_CLOSE(nurbs_surface_knots(surface, 0)[0], 0, 0);
    CHECK_CLOSE(nurbs_surface_knots(surface, 0)[5], 2, 0);
    for (int i = 0; i <= 2; i++)
        for (int j = 0; j <= 2; j++) {
            /* z = 0.1 i^2 - 0.2 j on poles: the spline of i^2 is (i+1)^2 + 1/3 at u = i. */
            double uv[2] = {i, j}, p[3];
            CU_ASSERT_EQUAL(nurbs_surface_eval(surface, 0, 1, uv, p), NURBS_OK);
            CHECK_CLOSE(p[0], i + 1, 1e-14);
            CHECK_CLOSE(p[1], j + 1, 1e-14);
            CHECK_CLOSE(p[2], 0.1 * ((i + 1) * (i + 1) + 1.0 / 3) - 0.2 * (j + 1), 1e-14);
        }
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "clamped"));
    nurbs_patches_free(patches);
}

static void writing_and_reading_restores_every_bit(void)
{
    nurbs_surface *body, *patch = expected_patch();
    nurbs_patches *patches, *back;
    char report[1000];
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(3, 0.7, 1.0 / 3, 0.1, &body), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_add(patches, body), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_add(patches, patch), NURBS_OK);
    const char *path = scratch_file("both.igs");
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_write(patches, path), NURBS_OK);
    back = read_file(path, report);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_count(back), 2);
    for (size_t k = 0; k < 2; k++) {
        const nurbs_surface *a = nurbs_patches_get(patches, k), *b = nurbs_patches_get(back, k);
        size_t n = nurbs_surface_size(a, 0) * nurbs_surface_size(a, 1);
        for (int d = 0; d < 2; d++) {
            CU_ASSERT_EQUAL(nurbs_surface_degree(a, d), nurbs_surface_degree(b, d));
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_size(a, d), nurbs_surface_size(b, d));
            CU_ASSERT_EQUAL(memcmp(nurbs_surface_knots(a, d), nurbs_surface_knots(b, d),
                                   (nurbs_surface_size(a, d) + 3) * sizeof(double)),
                            0);
        }
        CU_ASSERT_EQUAL((nurbs_surface_weights(a) == NULL), (nurbs_surface_weights(b) == NULL));
        /* Rational points pass through w p / w: one rounding. */
        for (size_t i = 0; i < 3 * n; i++)
            CHECK_CLOSE(nurbs_surface_points(b)[i], nurbs_surface_points(a)[i], k ? 0 : 3e-16);
    }
    unlink(path);
    nurbs_patches_free(back);
    nurbs_patches_free(patches);
    nurbs_surface_free(body);
    nurbs_surface_free(patch);
}

/* The surface of all trimmed files is the plain patch S; what lies inside the loops is known. */
static void untrims_faces_of_four_sides(void)
{
    static const struct {
        const char *path, *mentioned;
        size_t patches;
        int curved; /* v = t (1 - 0.4 s (1 - s)) */
        double u[2], v[2];
    } files[] = {
        {DATA("trimmed"), "deviation", 1, 0, {0.1, 0.9}, {0.1, 0.8}},
        {DATA("trimmed_curved"), "deviation", 1, 1, {0, 1}, {0, 1}},
        {DATA("trimmed_face"), "deviation", 1, 1, {0, 1}, {0, 1}},
        {OCCT("trimmed"), "deviation", 1, 1, {0, 1}, {0, 1}},
        {OCCT("trimmed_brep"), "deviation", 1, 1, {0, 1}, {0, 1}},
        {OCCT("bspline_brep"), "0 of them trimmed", 1, 0, {0, 1}, {0, 1}},
        {DATA("trimmed_twice"), "1 of these resampled", 2, 0, {0, 0.5}, {0, 1}},
        {DATA("untrimmed_face"), "0 of them trimmed", 1, 0, {0, 1}, {0, 1}},
        {DATA("plain"), "0 of them trimmed", 1, 0, {0, 1}, {0, 1}},
    };
    nurbs_surface *expected = expected_patch();
    for (size_t f = 0; f < sizeof files / sizeof files[0]; f++) {
        char report[1000];
        nurbs_patches *patches = NULL;
        nurbs_status status =
            nurbs_patches_read_iges_untrimmed(files[f].path, 1e-6, &patches, report, sizeof report);
        CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_patches_count(patches), files[f].patches);
        if (!strstr(report, files[f].mentioned)) {
            fprintf(stderr, "%s: %s\n", files[f].path, report);
            CU_FAIL("the report does not mention what it must");
        }
        for (int k = 0; k <= 60; k++) {
            double st[2] = {(k % 8) / 7.0, (k % 9) / 8.0}, p[3], q[3];
            double share = files[f].curved ? st[1] * (1 - 0.4 * st[0] * (1 - st[0])) : st[1];
            double uv[2] = {files[f].u[0] + (files[f].u[1] - files[f].u[0]) * st[0],
                            files[f].v[0] + (files[f].v[1] - files[f].v[0]) * share};
            CU_ASSERT_EQUAL(nurbs_surface_eval(nurbs_patches_get(patches, 0), 0, 1, st, p),
                            NURBS_OK);
            CU_ASSERT_EQUAL(nurbs_surface_eval(expected, 0, 1, uv, q), NURBS_OK);
            for (int c = 0; c < 3; c++)
                CHECK_CLOSE(p[c], q[c], 1e-6);
        }
        nurbs_patches_free(patches);
    }
    nurbs_patches *none;
    CU_ASSERT_EQUAL(nurbs_patches_read_iges_untrimmed(DATA("trimmed"), NAN, &none, NULL, 0),
                    NURBS_ERROR_ARGUMENT);
    nurbs_surface_free(expected);
}

static int inside_curved_with_hole(double u, double v)
{
    return v < 1 - 0.4 * u * (1 - u) && hypot(u - 0.5, v - 0.5) > 0.1;
}

static int inside_triangle(double u, double v)
{
    return v < 2 * u && v < 2 * (1 - u);
}

/* Midpoint rule over the part of the parameter plane inside the loops. */
static double area_inside(const nurbs_surface *surface, int (*inside)(double, double))
{
    enum { N = 1000 };
    double sum = 0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double uv[2] = {(i + 0.5) / N, (j + 0.5) / N}, s[9];
            if (!inside(uv[0], uv[1]))
                continue;
            nurbs_surface_eval(surface, 1, 1, uv, s);
            const double *a = s + 3, *b = s + 6;
            sum += sqrt(pow(a[1] * b[2] - a[2] * b[1], 2) + pow(a[2] * b[0] - a[0] * b[2], 2) +
                        pow(a[0] * b[1] - a[1] * b[0], 2));
        }
    return sum / (N * N);
}

/* Three corners, and a hole: several pieces that have the area inside the loops. */
static void divides_other_loops(void)
{
    static const struct {
        const char *path;
        int (*inside)(double, double);
    } files[] = {{DATA("trimmed_hole"), inside_curved_with_hole},
                 {DATA("trimmed_triangle"), inside_triangle}};
    nurbs_surface *surface = expected_patch();
    for (size_t f = 0; f < sizeof files / sizeof files[0]; f++) {
        char report[1000];
        nurbs_patches *patches = NULL;
        nurbs_moments moments;
        CU_ASSERT_EQUAL_FATAL(
            nurbs_patches_read_iges_untrimmed(files[f].path, 1e-6, &patches, report, sizeof report),
            NURBS_OK);
        CU_ASSERT_PTR_NOT_NULL(strstr(report, "1 of these resampled"));
        CU_ASSERT_EQUAL(nurbs_patches_moments(patches, &moments, NULL), NURBS_OK);
        CHECK_RELATIVE(moments.area, area_inside(surface, files[f].inside), 2e-4);
        nurbs_patches_free(patches);
    }
    nurbs_surface_free(surface);
}

static char *read_text(const char *path, size_t *length)
{
    FILE *stream = fopen(path, "rb");
    char *text = calloc(1, 20000);
    if (stream && text)
        *length = fread(text, 1, 19999, stream);
    if (stream)
        fclose(stream);
    return text;
}

/* Columns 49 to 56 of the face's directory line. */
static void tells_transformations_of_faces(void)
{
    size_t length = 0;
    char *text = read_text(DATA("trimmed"), &length), *line = strstr(text, "     144"),
         report[1000];
    CU_ASSERT_PTR_NOT_NULL_FATAL(line);
    memcpy(line + 48, "       3", 8);
    const char *path = write_scratch("moved_face.igs", text);
    nurbs_patches *patches = read_file(path, report);
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "face D1 has a transformation of its own"));
    nurbs_patches_free(patches);
    unlink(path);
    free(text);
}

/* A quarter of a cylinder of radius 2 m and length 5 m, written by Open CASCADE in millimetres. */
static void reads_rational_surfaces_of_open_cascade(void)
{
    char report[1000];
    nurbs_patches *patches = read_file(OCCT("rational"), report);
    const nurbs_surface *surface = nurbs_patches_get(patches, 0);
    const double *w = nurbs_surface_weights(surface), *p = nurbs_surface_points(surface);
    const double x[3] = {2, 2, 0}, y[3] = {0, 2, 2};
    CU_ASSERT_EQUAL(nurbs_surface_degree(surface, 0), 2);
    CU_ASSERT_EQUAL(nurbs_surface_degree(surface, 1), 1);
    CU_ASSERT_PTR_NOT_NULL_FATAL(w);
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 2; j++, p += 3) {
            CHECK_CLOSE(w[2 * i + j], i == 1 ? sqrt(0.5) : 1, 5e-10); /* it writes nine digits */
            CHECK_CLOSE(p[0], x[i], 1e-15);
            CHECK_CLOSE(p[1], y[i], 1e-15);
            CHECK_CLOSE(p[2], 5.0 * (double)j, 1e-14);
        }
    nurbs_patches_free(patches);
}

/* Every line of 80 columns, sections numbered from 1. */
static void written_records_are_well_formed(void)
{
    nurbs_surface *patch = expected_patch();
    const char *path = scratch_file("form.igs");
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_write_iges(patch, path), NURBS_OK);
    FILE *stream = fopen(path, "r");
    char line[200], last = 'S';
    long number = 0;
    while (fgets(line, sizeof line, stream)) {
        CU_ASSERT_EQUAL(strlen(line), 81);
        CU_ASSERT_PTR_NOT_NULL(strchr("SGDPT", line[72]));
        number = line[72] == last ? number + 1 : 1;
        last = line[72];
        CU_ASSERT_EQUAL(strtol(line + 73, NULL, 10), number);
    }
    CU_ASSERT_EQUAL(last, 'T');
    fclose(stream);
    unlink(path);
    nurbs_surface_free(patch);
}

static void refuses_damaged_files(void)
{
    static const struct {
        const char *find, *replace, *expected;
    } damage[] = {
        {"128,5,4,3,3", "128,5,9,3,3", "fewer parameters"},
        {"128,5,4,3,3", "128,5,4,9,3", "out of range"},
        {"128,5,4,3,3", "128,5,4,3,x", "expected a number"},
        {"128,5,4,3,3", "126,5,4,3,3", "begin with '126'"},
        {"0.4,0.7", "0.7,0.4", "decrease"},
        {"1.0,1.0,1.0,1.0,1.0,1.0,1.0,1.0,1.0", "1.0,1.0,1.0,1.0,1.0,1.0,1.0,0.0,1.0", NULL},
        {",6,1HM,", ",9,1HM,", NULL},
        {",6,1HM,", ",12,1H,", "unknown unit"},
        {"T      1", "X      1", "column 73"},
        {"     128       1", "     128      77", "begin at P77"},
    };
    size_t length = 0;
    char *text = read_text(DATA("plain"), &length);
    for (size_t k = 0; k < sizeof damage / sizeof damage[0]; k++) {
        char *copy = malloc(length + 1), *at;
        memcpy(copy, text, length + 1);
        at = strstr(copy, damage[k].find);
        CU_ASSERT_PTR_NOT_NULL_FATAL(at);
        memcpy(at, damage[k].replace, strlen(damage[k].replace));
        const char *path = write_scratch("damaged.igs", copy);
        nurbs_patches *patches = NULL;
        nurbs_status status = nurbs_patches_read_iges(path, &patches, NULL, 0);
        if (damage[k].expected &&
            (status >= 0 || !strstr(nurbs_last_error(), damage[k].expected))) {
            fprintf(stderr, "damage %zu: %s\n", k, status < 0 ? nurbs_last_error() : "read");
            CU_FAIL("not refused as expected");
        }
        nurbs_patches_free(patches);
        unlink(path);
        free(copy);
    }
    free(text);
}

/* A composite curve that contains itself, twice: refused, and at once. */
static void refuses_endless_composites(void)
{
    size_t length = 0, n;
    char *text = read_text(DATA("curves"), &length), *at = strstr(text, "102,2,9,11;");
    nurbs_curve **curves;
    CU_ASSERT_PTR_NOT_NULL_FATAL(at);
    memcpy(at, "102,2,7,07;", 11);
    const char *path = write_scratch("endless.igs", text);
    CU_ASSERT_EQUAL(nurbs_curves_read_iges(path, &n, &curves), NURBS_ERROR_FORMAT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "without end"));
    unlink(path);
    free(text);
    text = read_text(DATA("trimmed"), &length);
    at = strstr(text, "102,4,9,11,13,15;");
    CU_ASSERT_PTR_NOT_NULL_FATAL(at);
    memcpy(at, "102,4,7,07,07,07;", 17);
    nurbs_patches *patches;
    path = write_scratch("endless.igs", text);
    CU_ASSERT_EQUAL(nurbs_patches_read_iges(path, &patches, NULL, 0), NURBS_ERROR_FORMAT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "without end"));
    unlink(path);
    free(text);
}

/* Whatever is cut off or overwritten: a status, never a crash. */
static void survives_cuts_and_noise(void)
{
    size_t length = 0;
    char *text = read_text(DATA("trimmed"), &length), *copy = malloc(length + 1);
    unsigned seed = 12345;
    size_t refused = 0, tries = 0;
    for (size_t cut = 0; cut < length; cut += 41, tries++) {
        memcpy(copy, text, cut);
        copy[cut] = '\0';
        nurbs_patches *patches;
        const char *path = write_scratch("cut.igs", copy);
        refused += nurbs_patches_read_iges(path, &patches, NULL, 0) != NURBS_OK;
        nurbs_patches_free(patches);
        unlink(path);
    }
    CU_ASSERT(refused >= tries - 2); /* the last line may be cut without loss */
    for (int round = 0; round < 300; round++) {
        memcpy(copy, text, length + 1);
        for (int k = 0; k < 3; k++) {
            seed = seed * 1664525u + 1013904223u;
            copy[(seed >> 8) % length] = (char)(32 + (seed >> 4) % 95);
        }
        nurbs_patches *patches = NULL;
        char report[50];
        const char *path = write_scratch("noise.igs", copy);
        nurbs_status status = nurbs_patches_read_iges(path, &patches, report, sizeof report);
        CU_ASSERT((status == NURBS_OK) == (patches != NULL));
        CU_ASSERT(strlen(report) < sizeof report);
        nurbs_patches_free(patches);
        unlink(path);
    }
    free(copy);
    free(text);
}

/* Centimetres: a transformed quarter circle, a full circle, and a chain of a line and a parabola;
 * the line that only helps is left out. */
static void reads_curves(void)
{
    size_t n;
    nurbs_curve **curves;
    nurbs_status status = nurbs_curves_read_iges(DATA("curves"), &n, &curves);
    if (status != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(n, 4);
    for (int k = 0; k <= 40; k++) {
        double t = k / 40.0, p[3];
        /* In its plane z = 0.5: centre (1,2), radius 3; turned so that (x,y,z) -> (x,-z,y+7). */
        CU_ASSERT_EQUAL(nurbs_curve_eval(curves[0], 0, 1, &t, p), NURBS_OK);
        CHECK_CLOSE(hypot(p[0] - 0.01, p[2] - 0.09), 0.03, 1e-16);
        CHECK_CLOSE(p[1], -0.005, 1e-17);
        CU_ASSERT(p[0] >= 0.01 - 1e-15 && p[2] >= 0.09 - 1e-15); /* the first quarter */
        CU_ASSERT_EQUAL(nurbs_curve_eval(curves[1], 0, 1, &t, p), NURBS_OK);
        CHECK_CLOSE(hypot(p[0], p[1]), 0.02, 1e-16);
    }
    double ends[2] = {0, 1}, half = 0.5, p[6];
    CU_ASSERT_EQUAL(nurbs_curve_eval(curves[1], 0, 2, ends, p), NURBS_OK);
    CHECK_CLOSE(p[0], p[3], 1e-16);
    CU_ASSERT_EQUAL(nurbs_curve_eval(curves[1], 0, 1, &half, p), NURBS_OK);
    CHECK_CLOSE(p[0], -0.02, 1e-16);
    CU_ASSERT_EQUAL(nurbs_curve_degree(curves[2]), 1);
    CU_ASSERT_EQUAL(nurbs_curve_eval(curves[3], 0, 1, &half, p), NURBS_OK);
    CHECK_CLOSE(p[0], 0.02, 1e-16);
    CHECK_CLOSE(p[1], 0.005, 1e-16);
    nurbs_curves_free(n, curves);
    CU_ASSERT_EQUAL(nurbs_curves_read_iges(DATA("plain"), &n, &curves), NURBS_OK);
    CU_ASSERT_EQUAL(n, 0);
    nurbs_curves_free(n, curves);
    CU_ASSERT_EQUAL(nurbs_curves_read_iges("nothing.igs", &n, &curves), NURBS_ERROR_FILE);
    CU_ASSERT_PTR_NULL(curves);
}

static const struct check_case cases[] = {
    {"pitfalls give the same patch", pitfalls_give_the_same_patch},
    {"cuts to the stated range", cuts_to_the_stated_range},
    {"applies chains of transformations", applies_chains_of_transformations},
    {"clamps periodic knots", clamps_periodic_knots},
    {"writing and reading restores every bit", writing_and_reading_restores_every_bit},
    {"written records are well formed", written_records_are_well_formed},
    {"reads rational surfaces of open cascade", reads_rational_surfaces_of_open_cascade},
    {"tells transformations of faces", tells_transformations_of_faces},
    {"untrims faces of four sides", untrims_faces_of_four_sides},
    {"divides other loops", divides_other_loops},
    {"reads curves", reads_curves},
    {"refuses damaged files", refuses_damaged_files},
    {"refuses endless composites", refuses_endless_composites},
    {"survives cuts and noise", survives_cuts_and_noise},
};

CHECK_MAIN("nurbs iges", cases)
