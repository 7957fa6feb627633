/* STEP files: those of Open CASCADE with its own mass properties, and small ones written here. */
#include "check.h"
#include "hulls.h"

#include <stdbool.h>
#include <string.h>
#include <unistd.h>

/* Written by Open CASCADE 7.6.3: tests/data/occt_solids.cpp, which also prints these numbers. */
#define OCCT(name) TEST_DATA_DIR "/occt_" name

static const double pi = 3.14159265358979323846;

static char report[8000];

static nurbs_patches *read_patches(const char *path, double tolerance)
{
    nurbs_patches *patches = NULL;
    if (nurbs_patches_read_reported(path, tolerance, &patches, report, sizeof report) != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_PTR_NOT_NULL_FATAL(patches);
    return patches;
}

/* Closed solids with normals outwards: V within 1e-4 and S within 1e-3 is what is asked; the bounds
 * here are what the resampling allows, save for the swept body, whose area Open CASCADE's
 * quadrature has to 1.2e-4 only. */
static void agrees_with_open_cascade(void)
{
    static const struct {
        const char *path, *mentioned;
        double tolerance, area, volume, centre[3], area_slack, volume_slack;
    } files[] = {
        {OCCT("barge.step"),
         "6 of them exact",
         0,
         1346.56414269,
         2361.37166941,
         {20, 0, 3.043594364},
         1e-8,
         1e-9},
        {OCCT("barge_m.step"),
         "CONFIG_CONTROL_DESIGN",
         0,
         1346.56414269,
         2361.37166941,
         {20, 0, 3.043594364},
         1e-8,
         1e-9},
        {OCCT("barge.igs"),
         "6 of them exact",
         0,
         1346.56414269,
         2361.37166941,
         {20, 0, 3.043594364},
         1e-8,
         1e-9},
        {OCCT("bodies.step"),
         "resampled",
         1e-4,
         207.911995327,
         169.157529748,
         {5.247626589, 0, 0.1098557414},
         1e-4,
         1e-5},
        {OCCT("ship.step"),
         "resampled",
         0,
         751.708734474,
         654.859475893,
         {28.18649959, 1.690210932, -2.340553138},
         1e-6,
         1e-6},
        {OCCT("swept.step"),
         "AP242",
         0,
         145.627566776,
         83.6695689191,
         {4.61835, 0, 2.676253258},
         2e-4,
         1e-6},
        {OCCT("assembly.step"),
         "4 representations placed by an assembly",
         0,
         43.9911485751,
         10.7123889804,
         {4.679058042, 0.5600991535, 5.420694075},
         1e-7,
         1e-9},
    };
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        nurbs_patches *patches = read_patches(files[k].path, files[k].tolerance);
        nurbs_moments m;
        CU_ASSERT_EQUAL(nurbs_patches_moments(patches, &m, NULL), NURBS_OK);
        CHECK_RELATIVE(m.area, files[k].area, files[k].area_slack);
        CHECK_RELATIVE(m.volume, files[k].volume, files[k].volume_slack);
        for (int c = 0; c < 3; c++)
            CHECK_CLOSE(m.moment[c] / m.volume, files[k].centre[c], 1e-5 * sqrt(files[k].area));
        CU_ASSERT_PTR_NOT_NULL(strstr(report, files[k].mentioned));
        CU_ASSERT_PTR_NULL(strstr(report, "left out"));
        nurbs_patches_free(patches);
    }
}

/* Eight trimmed faces that divide one surface have its area. */
static void trimmed_faces_make_the_whole(void)
{
    nurbs_patches *patches = read_patches(OCCT("eight.step"), 1e-4);
    nurbs_moments m;
    CU_ASSERT_EQUAL(nurbs_patches_count(patches), 8);
    CU_ASSERT_EQUAL(nurbs_patches_moments(patches, &m, NULL), NURBS_OK);
    CHECK_RELATIVE(m.area, 428.352720043, 1e-6);
    nurbs_patches_free(patches);
}

static void barge_has_its_closed_form(void)
{
    nurbs_patches *patches = read_patches(OCCT("barge.step"), 0);
    nurbs_moments m;
    double section = 60 - 2 * 1.5 * 1.5 * (1 - pi / 4);
    CU_ASSERT_EQUAL(nurbs_patches_moments(patches, &m, NULL), NURBS_OK);
    CHECK_RELATIVE(m.volume, 40 * section, 1e-12);
    nurbs_patches_free(patches);
}

static void writing_and_reading_restores_every_bit(void)
{
    nurbs_surface *body;
    nurbs_patches *patches, *back;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(EXAMPLES_DIR "/hulls/dtmb5415.json", &patches),
                          NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(3, 0.7, 1.0 / 3, 0.1, &body), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_add(patches, body), NURBS_OK);
    const char *path = scratch_file("both.step");
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_write(patches, path), NURBS_OK);
    back = read_patches(path, 0);
    unlink(path);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_count(back), nurbs_patches_count(patches));
    for (size_t k = 0; k < nurbs_patches_count(back); k++) {
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
            CHECK_CLOSE(nurbs_surface_points(b)[i], nurbs_surface_points(a)[i],
                        nurbs_surface_weights(a) ? 3e-16 : 0);
    }
    nurbs_patches_free(back);
    nurbs_patches_free(patches);
    nurbs_surface_free(body);
}

/* A cone of base radius 3 in (0,0,0) that narrows to a tip 3 ft up, in feet and degrees, and a
 * sheet that a mapped item puts at x + 10, turned a quarter about z. The names use the escapes of
 * Part 21.
 */
static const char cone_text[] =
    "ISO-10303-21;\n/* a comment; with #1 = and 'quotes */\nHEADER;\n"
    "FILE_DESCRIPTION(('it''s; DATA;'),'2;1');\nFILE_NAME('x','',(''),(''),'','','');\n"
    "FILE_SCHEMA(('CONFIG_CONTROL_DESIGN'));\nENDSEC;\nDATA;\n"
    "#1=(CONVERSION_BASED_UNIT('FOOT',#2)LENGTH_UNIT()NAMED_UNIT(#3));\n"
    "#2=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(30.48),#4);\n"
    "#3=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
    "#4=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.CENTI.,.METRE.));\n"
    "#5=(CONVERSION_BASED_UNIT('DEGREE',#6)NAMED_UNIT(#3)PLANE_ANGLE_UNIT());\n"
    "#6=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.017453292519943295),#7);\n"
    "#7=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
    "#8=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#5))"
    "REPRESENTATION_CONTEXT('\\X\\C4nderung \\X2\\03B103B2\\X0\\','3D'));\n"
    "#10=CARTESIAN_POINT('',(0.,0.,0.));\n#11=DIRECTION('',(0.,0.,-1.));\n"
    "#12=DIRECTION('',(1.,0.,0.));\n#13=AXIS2_PLACEMENT_3D('',#10,#11,#12);\n"
    "#14=CONICAL_SURFACE('tip',#13,3.,45.);\n#15=CIRCLE('',#13,3.);\n"
    "#16=CARTESIAN_POINT('',(3.,0.,0.));\n#17=VERTEX_POINT('',#16);\n"
    "#18=EDGE_CURVE('',#17,#17,#15,.T.);\n#19=ORIENTED_EDGE('',*,*,#18,.F.);\n"
    "#20=EDGE_LOOP('',(#19));\n#21=FACE_OUTER_BOUND('',#20,.T.);\n"
    "#22=ADVANCED_FACE('',(#21),#14,.T.);\n#23=OPEN_SHELL('',(#22));\n"
    "#24=SHELL_BASED_SURFACE_MODEL('',(#23));\n"
    "#25=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#24,#40),#8);\n"
    "#30=CARTESIAN_POINT('',(0.,0.,0.));\n#31=CARTESIAN_POINT('',(0.,2.,0.));\n"
    "#32=CARTESIAN_POINT('',(1.,0.,0.));\n#33=CARTESIAN_POINT('',(1.,2.,0.));\n"
    "#34=BEZIER_SURFACE('',1,1,((#30,#31),(#32,#33)),.UNSPECIFIED.,.F.,.F.,.F.);\n"
    "#35=GEOMETRIC_SET('',(#34));\n"
    "#36=GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION('',(#35),#8);\n"
    "#37=AXIS2_PLACEMENT_3D('',#10,$,$);\n#38=REPRESENTATION_MAP(#37,#36);\n"
    "#40=MAPPED_ITEM('',#38,#41);\n#41=AXIS2_PLACEMENT_3D('',#42,$,#43);\n"
    "#42=CARTESIAN_POINT('',(10.,0.,0.));\n#43=DIRECTION('',(0.,1.,0.));\n"
    "ENDSEC;\nEND-ISO-10303-21;\n";

static void reads_units_and_mapped_items(void)
{
    const double foot = 0.3048;
    const char *path = write_scratch("cone.stp", cone_text);
    nurbs_patches *patches = read_patches(path, 0);
    unlink(path);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_count(patches), 2);
    double area, p[3];
    CU_ASSERT_EQUAL(nurbs_surface_area(nurbs_patches_get(patches, 0), &area, NULL), NURBS_OK);
    CHECK_RELATIVE(area, pi * 3 * 3 * sqrt(2) * foot * foot, 1e-9);
    const double uv[2] = {1, 1}, expected[3] = {8 * foot, 1 * foot, 0};
    CU_ASSERT_EQUAL(nurbs_surface_eval(nurbs_patches_get(patches, 1), 0, 1, uv, p), NURBS_OK);
    for (int c = 0; c < 3; c++)
        CHECK_CLOSE(p[c], expected[c], 1e-14);
    nurbs_patches_free(patches);
}

/* Surfaces by themselves: a quarter of a cylinder between parameters, and what is not read. */
static void reads_rectangles_and_tells_the_rest(void)
{
    char text[sizeof cone_text + 300];
    const char *at = strstr(cone_text, "#35=");
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - cone_text), cone_text,
             "#50=CYLINDRICAL_SURFACE('',#37,2.);\n"
             "#51=RECTANGULAR_TRIMMED_SURFACE('',#50,0.,90.,1.,4.,.T.,.T.);\n"
             "#52=RECTANGULAR_TRIMMED_SURFACE('',#34,0.25,0.75,0.,0.5,.T.,.T.);\n"
             "#53=TESSELLATED_SOLID('',(),$);\n"
             "#35=GEOMETRIC_SET('',(#51,#52,#53));\n",
             strchr(at, '\n') + 1);
    const char *path = write_scratch("set.step", text);
    nurbs_patches *patches = read_patches(path, 0);
    unlink(path);
    double area;
    const double foot = 0.3048;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_count(patches), 3);
    CU_ASSERT_EQUAL(nurbs_surface_area(nurbs_patches_get(patches, 1), &area, NULL), NURBS_OK);
    CHECK_RELATIVE(area, pi / 2 * 2 * 3 * foot * foot, 1e-10);
    CU_ASSERT_EQUAL(nurbs_surface_area(nurbs_patches_get(patches, 2), &area, NULL), NURBS_OK);
    CHECK_RELATIVE(area, 0.5 * 1 * foot * foot, 1e-12);
    CU_ASSERT_PTR_NOT_NULL(strstr(report, "TESSELLATED_SOLID #53 is left out: it is not read"));
    nurbs_patches_free(patches);
}

static void refuses_damaged_files(void)
{
    static const struct {
        const char *find, *replace, *expected;
    } damage[] = {
        {"ISO-10303-21;\n/*", "ISO-10303-22;\n/*", "not a STEP file"},
        {"END-ISO-10303-21", "END-ISO-10303-xx", "the file is cut"},
        {"#19=ORIENTED", "#18=ORIENTED", "#18 is there twice"},
        {"(#19));\n#21", "(#99));\n#21", "#20 EDGE_LOOP: it refers to #99, which is not there"},
        {"CIRCLE('',#13,3.)", "CIRCLE('',#13,'r')", "#15 CIRCLE: a value is missing or no number"},
        {"CIRCLE('',#13,3.)", "CIRCLE('',#13,0.)", "a radius or focal distance is not > 0"},
        {"DIRECTION('',(0.,0.,-1.))", "DIRECTION('',(0.,0.,0.))", "#11 DIRECTION: has no length"},
        {"VERTEX_POINT('',#16)", "VERTEX_POINT('',#18)", "#18 EDGE_CURVE: expected a CARTESIAN_PO"},
        {".CENTI.", ".CANTI.", "unknown prefix .CANTI."},
        {"(0.,2.,0.));\n#32", "(0.,2.;0.));\n#32", "expected ',' or ')'"},
        {"'',1,1,((", "'',1,3,((", "degree 3 with 2 points"},
        {"#35=GEOMETRIC_SET('',(#34))", "#35=GEOMETRIC_SET('',(#36))", NULL},
        {"#36=GEOMETRICALLY", "#xy=GEOMETRICALLY", "expected #number"},
        {"'',(#35),#8)", "'',(#40),#8)", "without end"},
    };
    for (size_t k = 0; k < sizeof damage / sizeof *damage; k++) {
        char text[sizeof cone_text + 40];
        nurbs_patches *patches = NULL;
        const char *at = strstr(cone_text, damage[k].find);
        CU_ASSERT_PTR_NOT_NULL_FATAL(at);
        snprintf(text, sizeof text, "%.*s%s%s", (int)(at - cone_text), cone_text, damage[k].replace,
                 at + strlen(damage[k].find));
        const char *path = write_scratch("damaged.step", text);
        nurbs_status status = nurbs_patches_read(path, &patches);
        unlink(path);
        nurbs_patches_free(patches);
        if (!damage[k].expected)
            continue;
        CU_ASSERT_EQUAL(status, NURBS_ERROR_FORMAT);
        if (!strstr(nurbs_last_error(), damage[k].expected)) {
            fprintf(stderr, "%s\nexpected: %s\n", nurbs_last_error(), damage[k].expected);
            CU_FAIL("the sentence does not say what it must");
        }
    }
    nurbs_patches *none;
    CU_ASSERT_EQUAL(nurbs_patches_read_step(OCCT("barge.step"), NAN, &none, NULL, 0),
                    NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_read_step("/nonexistent.step", 0, &none, NULL, 0),
                    NURBS_ERROR_FILE);
    CU_ASSERT_EQUAL(nurbs_patches_write_step(NULL, "x.step"), NURBS_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"agrees with Open CASCADE", agrees_with_open_cascade},
    {"trimmed faces make the whole", trimmed_faces_make_the_whole},
    {"barge has its closed form", barge_has_its_closed_form},
    {"writing and reading restores every bit", writing_and_reading_restores_every_bit},
    {"reads units and mapped items", reads_units_and_mapped_items},
    {"reads rectangles and tells the rest", reads_rectangles_and_tells_the_rest},
    {"refuses damaged files", refuses_damaged_files},
};

CHECK_MAIN("STEP files", cases)
