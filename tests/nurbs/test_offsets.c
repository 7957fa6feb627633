/* Offset tables and station files: forms whose volume is known, and Series 60. */
#include "check.h"
#include "hulls.h"
#include "iges_writer.h"

#include <string.h>
#include <unistd.h>

/* Hydrostatics of the hull that a grid gives. */
static nurbs_hydrostatics hydrostatics_of(const nurbs_grid *grid, const nurbs_offsets_info *info)
{
    nurbs_skin_options skin;
    nurbs_surface *surface;
    nurbs_patches *patches;
    nurbs_hull *hull;
    nurbs_hydrostatics result = {0};
    nurbs_skin_options_init(&skin);
    if (info && info->chine) {
        skin.chine_count = 1;
        skin.chine = &info->chine;
    }
    if (nurbs_skin(grid, &skin, &surface) != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, surface), NURBS_OK);
    if (nurbs_hull_create(patches, NULL, &hull) != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    else
        result = *nurbs_hull_hydrostatics(hull);
    nurbs_hull_free(hull);
    nurbs_patches_free(patches);
    nurbs_surface_free(surface);
    return result;
}

/* The same below z = 0 of one that is open at both ends. */
static nurbs_hydrostatics hydrostatics_of_prism(const nurbs_grid *grid,
                                                const nurbs_offsets_info *info)
{
    nurbs_skin_options skin;
    nurbs_surface *surface = NULL, *wetted = NULL;
    nurbs_hydrostatics result = {0};
    nurbs_skin_options_init(&skin);
    skin.chine_count = 1;
    skin.chine = &info->chine;
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, &skin, &surface), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_wetted(surface, 0, 1e-5, &wetted), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_hydrostatics_compute(1, (const nurbs_surface *[]){wetted}, 0, &result),
                    NURBS_OK);
    nurbs_surface_free(surface);
    nurbs_surface_free(wetted);
    return result;
}

static nurbs_grid *read_text(const char *text, size_t columns, nurbs_offsets_info *info)
{
    nurbs_grid *grid = NULL;
    const char *path = write_scratch("t.offsets.csv", text);
    if (nurbs_offsets_read(path, columns, &grid, info) != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    unlink(path);
    CU_ASSERT_PTR_NOT_NULL_FATAL(grid);
    return grid;
}

/* Todd (1963): Cb 0.60, Cm 0.977, LCB 1.5 % aft; hulls made from the rounded table have Cb 0.597 to
 * 0.600, LCB 1.49 to 1.50 % and Cm 0.970 to 0.977. */
static void series60_has_its_coefficients(void)
{
    nurbs_grid *grid;
    nurbs_offsets_info info;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_offsets_read(EXAMPLES_DIR "/hulls/series60.offsets.csv", 0, &grid, &info), NURBS_OK);
    nurbs_hydrostatics h = hydrostatics_of(grid, &info);
    nurbs_grid_free(grid);
    CHECK_CLOSE(info.length, 1, 0);
    double cb = h.volume / (info.length * info.breadth * info.draft),
           lcb = 100 * (h.centroid[0] - 0.5), cm = h.section_area_max / (info.breadth * info.draft);
    CHECK_CLOSE(cb, 0.5985, 0.0015);
    CHECK_CLOSE(lcb, -1.495, 0.005);
    CHECK_CLOSE(cm, 0.9735, 0.0035);
    CHECK_CLOSE(h.x_aft, -0.0168, 2e-4);
    CHECK_CLOSE(h.x_fore, 1, 1e-6);
}

/* Wigley, y = (1 - x^2) (1 - z^2) / 2 for |x| < 1: waterlines out of order, blanks, millimetres and
 * stations from the bow; V = 2 * 1/2 * 4/3 * 2/3. */
static void reads_a_parabolic_hull(void)
{
    char text[4000] =
        "# a hull\nlength , 2\nx_origin,1\nx_scale,-0.1\n\ny_scale,0.001\nz_scale,0.001\n"
        "station,0,-1000,-500,-250,-750,-900 # waterlines\n";
    static const double z[6] = {0, -1, -0.5, -0.25, -0.75, -0.9};
    for (int k = 20; k >= 0; k--) { /* the stern first */
        double x = 1 - 0.1 * k;
        snprintf(text + strlen(text), sizeof text - strlen(text), "%d", k);
        for (int j = 0; j < 6; j++) {
            /* A reading that was not taken. */
            if (k == 7 && j == 3)
                strcat(text, ", ");
            else
                snprintf(text + strlen(text), sizeof text - strlen(text), ",%.10g",
                         500 * (1 - x * x) * (1 - z[j] * z[j]));
        }
        strcat(text, "\n");
    }
    nurbs_offsets_info info;
    nurbs_grid *grid = read_text(text, 24, &info);
    CU_ASSERT_EQUAL(nurbs_grid_rows(grid), 21);
    CU_ASSERT_EQUAL(nurbs_grid_columns(grid), 24);
    CHECK_CLOSE(info.length, 2, 0);
    CU_ASSERT_EQUAL(info.chine, 0);
    const double *p = nurbs_grid_points(grid);
    CHECK_CLOSE(p[0], -1, 1e-12);
    CHECK_CLOSE(p[3 * (10 * 24)], 0, 1e-12); /* amidships at the deck */
    CHECK_CLOSE(p[3 * (10 * 24) + 1], 0.5, 1e-12);
    CHECK_CLOSE(p[3 * (10 * 24 + 23) + 2], -1, 1e-12); /* and at the keel */
    nurbs_hydrostatics h = hydrostatics_of(grid, NULL);
    CHECK_RELATIVE(h.volume, 8.0 / 9, 4e-3);
    nurbs_grid_free(grid);
}

/* A wedge-shaped barge with deck, knuckle and rising keel: from x = 0 to 10 the half breadth of the
 * knuckle (z = 0.2) is 1, that of the deck (z = 1) 1.5; the keel rises from -1 to -0.5. Below the
 * water straight lines from keel to knuckle: V = 2 int 1/2 * keel depth * breadth at z = 0. */
static void reads_knuckles_decks_and_keels(void)
{
    static const char text[] =
        "station,keel,-0.25,0,knuckle_z,knuckle_y,deck_z,deck_y,0.6\n"
        "0,-1,,,0.2,1,1,1.5,1.25\n5,-0.75,,,0.2,1,1,1.5,\n10,-0.5,,,0.2,1,1,"
        "1.5,1.25\n2.5,-0.875,,,0.2,1,1,1.5,1.25\n7.5,-0.625,,,0.2,1,1,1.5,\n";
    nurbs_offsets_info info;
    nurbs_grid *grid = read_text(text, 41, &info);
    CU_ASSERT_TRUE_FATAL(info.chine > 0 && info.chine < 40);
    const double *p = nurbs_grid_points(grid);
    for (size_t i = 0; i < nurbs_grid_rows(grid); i++) {
        const double *deck = p + 3 * 41 * i, *knuckle = deck + 3 * info.chine, *keel = deck + 120;
        CHECK_CLOSE(deck[1], 1.5, 1e-14);
        CHECK_CLOSE(deck[2], 1, 1e-14);
        CHECK_CLOSE(knuckle[1], 1, 1e-14);
        CHECK_CLOSE(knuckle[2], 0.2, 1e-14);
        CHECK_CLOSE(keel[1], 0, 1e-14);
        CHECK_CLOSE(keel[2], -1 + 0.05 * keel[0], 1e-14);
    }
    nurbs_hydrostatics h = hydrostatics_of_prism(grid, &info);
    double volume = 0; /* d^2 / (d + 0.2) over x, d the draft */
    for (int k = 0; k < 2000; k++) {
        double d = 1 - 0.5 * (k + 0.5) / 2000;
        volume += 10.0 / 2000 * d * d / (d + 0.2);
    }
    CHECK_RELATIVE(h.volume, volume, 1e-6);
    CHECK_RELATIVE(h.beam, 2 * 1 / 1.2, 1e-6);
    nurbs_grid_free(grid);
}

/* Raked stem, open stern: the profile has an entry on every waterline but the lowest is blank. */
static void reads_profiles(void)
{
    static const char text[] = "station,0,-1,1\n0,1,0,1.2\n5,1,0,1.2\n10,0.5,0,0.8\n"
                               "stem,11,10.5,12\n";
    nurbs_grid *grid = read_text(text, 9, NULL);
    CU_ASSERT_EQUAL(nurbs_grid_rows(grid), 4);
    const double *stem = nurbs_grid_points(grid) + 3 * 9 * 3;
    for (int k = 0; k < 9; k++)
        CHECK_CLOSE(stem[3 * k + 1], 0, 0);
    CHECK_CLOSE(stem[0], 12, 1e-14);
    CHECK_CLOSE(stem[2], 1, 1e-14);
    CHECK_CLOSE(stem[24], 10.5, 1e-14);
    CHECK_CLOSE(stem[26], -1, 1e-14);
    nurbs_grid_free(grid);
}

static void reads_station_files(void)
{
    /* Half circles of radius 2 from keel to deck, and one from deck to keel. */
    char text[6000] = "# stations\n";
    for (int i = 0; i < 5; i++) {
        snprintf(text + strlen(text), sizeof text - strlen(text), "%d\n", 3 * i);
        for (int k = 0; k <= 20; k++) {
            double a = 1.5707963267948966 * (i == 2 ? 20 - k : k) / 20;
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     i % 2 ? "%.12f %.12f\n" : "  %.12f, %.12f # y z\n", 2 * sin(a), -2 * cos(a));
        }
        strcat(text, "\n");
    }
    const char *path = write_scratch("t.stations", text);
    nurbs_grid *grid = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_stations_read(path, 0, &grid), NURBS_OK);
    unlink(path);
    CU_ASSERT_EQUAL(nurbs_grid_rows(grid), 5);
    for (size_t k = 0; k < 5 * nurbs_grid_columns(grid); k++) {
        const double *p = nurbs_grid_points(grid) + 3 * k;
        CHECK_CLOSE(hypot(p[1], p[2]), 2, 1e-3);
    }
    CHECK_CLOSE(nurbs_grid_points(grid)[2], 0, 1e-11); /* from the deck */
    nurbs_grid_free(grid);
}

static void refuses_what_makes_no_sense(void)
{
    static const struct {
        const char *text, *expected;
    } tables[] = {
        {"", "no header"},
        {"length,-1\n", ":1: length is -1, expected > 0"},
        {"x_scale,0\n", ":1: x_scale is 0, expected not 0"},
        {"lenght,1\n", ":1: 'lenght', expected a setting"},
        {"station,0\n", "1 waterlines"},
        {"station,0,1,0\n", ":1: waterline 0 is there twice"},
        {"station,0,1,keel,keel\n", "column keel is there twice"},
        {"station,0,1,deck_z\n", "deck_z goes with deck_y"},
        {"station,0,abc\n", ":1: 'abc', expected a number"},
        {"station,0,1\n\n0,1,2,3\n", ":3: more entries than the 2 columns"},
        {"station,0,1\n0,1,-2\n", ":2: half breadth -2"},
        {"station,0,1\n0,1,x\n", ":2: 'x', expected a number"},
        {"station,0,1\n0,1,1\n", "1 stations"},
        {"station,0,1\n0,1,1\n0,1,2\n", "is there twice"},
        {"station,0,1\n0,,\n1,1,1\n", ":2: station 0 has no entries"},
        {"station,0,1\n0,1,1\n1,1,1\nstem,,\n", ":4: a profile without entries"},
        {"station,0,1\n0,1,1\n1,1,1\nstem,2,2\nstem,2,2\n", ":5: a second stem"},
        {"station,0,1\n,1,1\n", ":2: a line without a name"},
        {"station,0,1\nmidship,1,1\n", ":2: 'midship', expected a number"},
    };
    nurbs_grid *grid;
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
        const char *path = write_scratch("t.offsets.csv", tables[k].text);
        CU_ASSERT_EQUAL(nurbs_offsets_read(path, 0, &grid, NULL), NURBS_ERROR_FORMAT);
        unlink(path);
        CU_ASSERT_PTR_NULL(grid);
        if (!strstr(nurbs_last_error(), tables[k].expected)) {
            fprintf(stderr, "%s\nexpected: %s\n", nurbs_last_error(), tables[k].expected);
            CU_FAIL("the sentence does not say what it must");
        }
    }
    static const struct {
        const char *text, *expected;
    } files[] = {
        {"", "0 sections"},
        {"1 2\n", ":1: a point before the first station"},
        {"0\n1 2 3\n", ":2: expected 'x' of a station"},
        {"0\n1 x\n", ":2: expected 'x' of a station"},
        {"0\n1 2\n1\n1 2\n2 3\n", ":1: a station of 1 points"},
    };
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        const char *path = write_scratch("t.stations", files[k].text);
        CU_ASSERT_EQUAL(nurbs_stations_read(path, 0, &grid), NURBS_ERROR_FORMAT);
        unlink(path);
        CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), files[k].expected));
    }
    CU_ASSERT_EQUAL(nurbs_offsets_read(NULL, 0, &grid, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_offsets_read("/nonexistent", 0, &grid, NULL), NURBS_ERROR_FILE);
    CU_ASSERT_EQUAL(nurbs_offsets_read(EXAMPLES_DIR "/hulls/series60.offsets.csv", 2, &grid, NULL),
                    NURBS_ERROR_ARGUMENT);
}

/* Sections of the Wigley hull, 10 m long, as an IGES file has them: exact parabolas (126) from the
 * water down, polylines (106) or lines (110) above it, in either direction; a waterline and a
 * profile beside them. */
static void wigley_curves(iges_writer *w, bool from_side_to_side, double sign)
{
    enum { STATIONS = 21 };
    const double B = 1, T = 0.625;
    w->count = 0;
    iges_add(w, 110, 0, 0, 0, "110,-5.0,0.0,0.0,5.0,0.0,-0.1;");
    for (int k = 0; k < STATIONS; k++) {
        double x = 5 * cos(3.14159265358979 * (k * 8 % STATIONS) / (STATIONS - 1)),
               y = sign * B / 2 * (1 - x * x / 25);
        if (from_side_to_side) {
            iges_add(
                w, 126, 0, 0, 0,
                "126,2,2,1,0,1,0,0.0,0.0,0.0,1.0,1.0,1.0,1.0,1.0,1.0,%.15g,%.15g,0.0,%.15g,0.0,"
                "%.15g,%.15g,%.15g,0.0,0.0,1.0,0.0,0.0,1.0;",
                x, y, x, -2 * T, x, -y);
            continue;
        }
        iges_add(w, 126, 0, 0, 0,
                 "126,2,2,1,0,1,0,0.0,0.0,0.0,1.0,1.0,1.0,1.0,1.0,1.0,%.15g,0.0,%.15g,%.15g,%.15g,"
                 "%.15g,%.15g,%.15g,0.0,0.0,1.0,0.0,0.0,1.0;",
                 x, -T, x, y, -T / 2, x, y);
        if (k % 2)
            iges_add(w, 110, 0, 0, 0, "110,%.15g,%.15g,0.3,%.15g,%.15g,0.0;", x, y, x, y);
        else
            iges_add(w, 106, 12, 0, 0, "106,2,3,%.15g,%.15g,0.0,%.15g,%.15g,0.1,%.15g,%.15g,0.3;",
                     x, y, x, y, x, y);
    }
}

static void sections_of_curves(void)
{
    static iges_writer w;
    for (int k = 0; k < 3; k++) {
        nurbs_grid *grid = NULL;
        size_t others = 0;
        wigley_curves(&w, k == 2, k == 1 ? -1 : 1);
        const char *path = iges_save(&w, "6,1HM");
        nurbs_status status = nurbs_sections_read_iges(path, 0, &grid, &others);
        unlink(path);
        if (status)
            fprintf(stderr, "%s\n", nurbs_last_error());
        CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_grid_rows(grid), 21);
        CU_ASSERT_EQUAL(others, 1);
        nurbs_hydrostatics h = hydrostatics_of(grid, NULL);
        /* From side to side: parabolas y^2 ~ z + T, 2/3 of the box of each section. */
        CHECK_RELATIVE(h.volume, 4. / 9 * 10 * 0.625, 1e-3);
        CHECK_RELATIVE(h.waterplane_area, 2. / 3 * 10, 1e-4);
        nurbs_grid_free(grid);
    }
    nurbs_grid *grid = NULL;
    w.count = 1;
    const char *path = iges_save(&w, "6,1HM");
    CU_ASSERT_EQUAL(nurbs_sections_read_iges(path, 0, &grid, NULL), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "0 sections among them"));
    wigley_curves(&w, false, 1);
    /* A second curve beside a section that does not meet it. */
    iges_add(&w, 110, 0, 0, 0, "110,5.0,0.2,0.3,5.0,0.2,0.1;");
    path = iges_save(&w, "6,1HM");
    CU_ASSERT_EQUAL(nurbs_sections_read_iges(path, 0, &grid, NULL), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "do not meet"));
    unlink(path);
    CU_ASSERT_PTR_NULL(grid);
}

static const struct check_case cases[] = {
    {"Series 60 has its coefficients", series60_has_its_coefficients},
    {"reads a parabolic hull", reads_a_parabolic_hull},
    {"reads knuckles, decks and keels", reads_knuckles_decks_and_keels},
    {"reads profiles", reads_profiles},
    {"reads station files", reads_station_files},
    {"refuses what makes no sense", refuses_what_makes_no_sense},
    {"sections of curves", sections_of_curves},
};

CHECK_MAIN("offset tables", cases)
