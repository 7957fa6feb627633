/* Bodies as triangles: closed forms, and the shipped hulls through their own STL. */
#include "check.h"
#include "hulls.h"

#include <string.h>
#include <unistd.h>

static const double pi = 3.14159265358979323846;

/* Box 0..4 x -1..1 x -1..1 as twelve triangles, some turned inside. */
static const double box_points[24] = {0, -1, -1, 4, -1, -1, 4, 1, -1, 0, 1, -1,
                                      0, -1, 1,  4, -1, 1,  4, 1, 1,  0, 1, 1};
static const size_t box_corners[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                       2, 3, 7, 7, 2, 6, 1, 2, 6, 6, 5, 1, 0, 4, 7, 0, 3, 7};

static void box_has_its_closed_form(void)
{
    nurbs_mesh *mesh;
    nurbs_hydrostatics h;
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_create(8, box_points, 12, box_corners, &mesh), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_hydrostatics(mesh, 0.5, &h), NURBS_OK);
    CHECK_CLOSE(h.volume, 4 * 2 * 1.5, 1e-14);
    CHECK_CLOSE(h.centroid[0], 2, 1e-14);
    CHECK_CLOSE(h.centroid[1], 0, 1e-14);
    CHECK_CLOSE(h.centroid[2], -0.25, 1e-14);
    CHECK_CLOSE(h.waterplane_area, 8, 1e-14);
    CHECK_CLOSE(h.waterplane_centre, 2, 1e-14);
    CHECK_CLOSE(h.waterplane_inertia_x, 4 * 8 / 12.0, 1e-14);
    CHECK_CLOSE(h.waterplane_inertia_y, 2 * 64 / 12.0, 1e-13);
    /* Bottom, sides and bow; the aft face closes the transom. */
    CHECK_CLOSE(h.wetted_area, 8 + 2 * 4 * 1.5 + 2 * 1.5, 1e-14);
    CHECK_CLOSE(h.transom_area, 3, 1e-14);
    CHECK_CLOSE(h.draft, 1.5, 1e-15);
    CHECK_CLOSE(h.keel_draft, 1.5, 1e-15);
    CHECK_CLOSE(h.beam, 2, 1e-15);
    CHECK_CLOSE(h.section_area_max, 3, 1e-14);
    CHECK_CLOSE(h.x_aft, 0, 0);
    CHECK_CLOSE(h.x_fore, 4, 0);
    CU_ASSERT_EQUAL(nurbs_mesh_hydrostatics(mesh, -2, &h), NURBS_ERROR_GEOMETRY);
    nurbs_mesh_free(mesh);
    /* Without its bottom it is no body. */
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_create(8, box_points, 10, box_corners + 6, &mesh), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_mesh_hydrostatics(mesh, 0.5, &h), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "open below the water"));
    nurbs_mesh_free(mesh);
}

static void sections_are_ordered_lines(void)
{
    nurbs_mesh *mesh;
    nurbs_contour c;
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_create(8, box_points, 12, box_corners, &mesh), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_section(mesh, (const double[]){2, 0, 0}, 3, &c), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(c.lines, 1);
    size_t n = c.first[1];
    double girth = 0, twice = 0;
    for (size_t k = 0; k + 1 < n; k++) {
        const double *a = c.points + 3 * k, *b = a + 3;
        CHECK_CLOSE(a[0], 1.5, 1e-15);
        girth += hypot(b[1] - a[1], b[2] - a[2]);
        twice += a[1] * b[2] - a[2] * b[1];
    }
    CHECK_CLOSE(girth, 8, 1e-14);
    CHECK_CLOSE(fabs(twice), 8, 1e-14);
    for (int k = 0; k < 3; k++) /* closed */
        CHECK_CLOSE(c.points[k], c.points[3 * (n - 1) + (size_t)k], 0);
    nurbs_contour_free(&c);
    CU_ASSERT_EQUAL(nurbs_mesh_section(mesh, (const double[]){0, 0, 1}, 7, &c), NURBS_OK);
    CU_ASSERT_EQUAL(c.lines, 0);
    nurbs_contour_free(&c);
    /* Along the deck's corners: as a plane just below them. */
    CU_ASSERT_EQUAL(nurbs_mesh_section(mesh, (const double[]){0, 0, 1}, 1, &c), NURBS_OK);
    CU_ASSERT_EQUAL(c.lines, 1);
    nurbs_contour_free(&c);
    nurbs_mesh_free(mesh);
}

/* Three texts of one tetrahedron with corners 0, 3 x, 3 y, 3 z, in millimetres. */
static void reads_its_formats(void)
{
    static const char stl[] =
        "solid t\n facet normal 0 0 -1\n  outer loop\n   vertex 0 0 0\n   vertex 0 3E3 0\n   "
        "vertex 3000. 0 0\n  endloop\n endfacet\n facet normal 0 0 0\n  outer loop\n   vertex 0 0 "
        "0\n   vertex 3000 0 0\n   vertex 0 0 3000\n  endloop\n endfacet\n facet normal 0 0 0\n  "
        "outer loop\n   vertex 0 0 0\n   vertex 0 0 3000\n   vertex 0 3000 0\n  endloop\n "
        "endfacet\n facet normal 1 1 1\n  outer loop\n   vertex 3000 0 0\n   vertex 0 3000 0\n   "
        "vertex 0 0 3000\n  endloop\n endfacet\nendsolid t\n";
    static const char obj[] = "# four corners\no tetrahedron\nv 0 0 0\nv 3000 0 0\nv 0 3000 0\n"
                              "vn 0 0 1\nv 0 0 3000 1.0\nf 1/1/1 3//1 2/2\nf 1 2 4\nf -4 -1 -2\n"
                              "f 2 3 4\n";
    const char *names[2] = {"t.stl", "t.obj"}, *texts[2] = {stl, obj};
    for (int k = 0; k < 2; k++) {
        nurbs_mesh *mesh = NULL;
        nurbs_hydrostatics h;
        const char *path = write_scratch(names[k], texts[k]);
        CU_ASSERT_EQUAL_FATAL(nurbs_mesh_read(path, 1e-3, &mesh), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_mesh_vertices(mesh), 4);
        CU_ASSERT_EQUAL(nurbs_mesh_triangles(mesh), 4);
        CU_ASSERT_EQUAL(nurbs_mesh_hydrostatics(mesh, 3, &h), NURBS_OK);
        CHECK_RELATIVE(h.volume, 2 * 4.5, 1e-12); /* on one side of y = 0: a half body */
        /* Below z = 1: the whole less the tip, 27/6 (1 - 8/27). */
        CU_ASSERT_EQUAL(nurbs_mesh_hydrostatics(mesh, 1, &h), NURBS_OK);
        CHECK_RELATIVE(h.volume, 2 * 4.5 * 19 / 27, 1e-12);
        CHECK_RELATIVE(h.waterplane_area, 2 * 2.0, 1e-12);
        nurbs_mesh_free(mesh);
        unlink(path);
    }
}

static void refuses_damaged_files(void)
{
    static const struct {
        const char *name, *text, *expected;
    } files[] = {
        {"d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", ":4: '9"},
        {"d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n", ":4: '-9"},
        {"d.obj", "v 0 0 0\nv 1 x 0\n", ":2: expected 'v x y z'"},
        {"d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "a face of 2 vertices"},
        {"d.obj", "# nothing\n", "no triangles"},
        {"d.stl", "solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n",
         "a facet of 2 vertices"},
        {"d.stl", "solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n", "the file is cut"},
        {"d.stl", "anything", "not an STL file"},
        {"d.stl", "solid x\nfacet\nvertex 0 0 nan\nvertex 1 0 0\nendfacet\nendsolid\n", ":3: "},
        {"d.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "all vertices coincide"},
        {"d.ply", "ply", "from .stl and .obj"},
    };
    for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
        nurbs_mesh *mesh = NULL;
        const char *path = write_scratch(files[k].name, files[k].text);
        CU_ASSERT_NOT_EQUAL(nurbs_mesh_read(path, 1, &mesh), NURBS_OK);
        unlink(path);
        CU_ASSERT_PTR_NULL(mesh);
        if (!strstr(nurbs_last_error(), files[k].expected)) {
            fprintf(stderr, "%s\nexpected: %s\n", nurbs_last_error(), files[k].expected);
            CU_FAIL("the sentence does not say what it must");
        }
    }
    nurbs_mesh *mesh;
    CU_ASSERT_EQUAL(nurbs_mesh_read("x.stl", 0, &mesh), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_mesh_read(NULL, 1, &mesh), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_mesh_create(1, box_points, 1, box_corners, &mesh), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_mesh_triangles(NULL), 0);
    nurbs_mesh_free(NULL);
}

/* A Moebius strip of five quadrangles. */
static void refuses_one_sided_strips(void)
{
    double points[30];
    size_t corner[30];
    for (size_t k = 0; k < 5; k++) {
        double a = 2 * pi * (double)k / 5;
        for (size_t e = 0; e < 2; e++) {
            double r = 3 + (e ? 1 : -1) * cos(a / 2);
            points[6 * k + 3 * e] = r * cos(a);
            points[6 * k + 3 * e + 1] = r * sin(a);
            points[6 * k + 3 * e + 2] = (e ? 1 : -1) * sin(a / 2);
        }
        size_t low = 2 * k, high = 2 * k + 1, next = k < 4 ? low + 2 : 1,
               above = k < 4 ? low + 3 : 0;
        const size_t two[6] = {low, next, high, high, next, above};
        memcpy(corner + 6 * k, two, sizeof two);
    }
    nurbs_mesh *mesh = NULL;
    CU_ASSERT_EQUAL(nurbs_mesh_create(10, points, 10, corner, &mesh), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "cannot be turned alike"));
}

/* The volume that the NURBS themselves have, through STL files of ours. */
static void shipped_hulls_keep_their_volume(void)
{
    static const struct {
        const char *name;
        int parts;
        double level;
    } hulls[] = {{"wigley", 60, 0}, {"dtmb5415", 6, 0}, {"spheroid", 60, 0.2}};
    for (size_t k = 0; k < sizeof hulls / sizeof *hulls; k++) {
        char source[256];
        nurbs_patches *patches;
        nurbs_hull *hull;
        nurbs_mesh *mesh;
        nurbs_hydrostatics h;
        nurbs_hull_options options;
        snprintf(source, sizeof source, "%s/hulls/%s.json", EXAMPLES_DIR, hulls[k].name);
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(source, &patches), NURBS_OK);
        const char *path = scratch_file("hull.stl");
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_write_stl(patches, hulls[k].parts, path), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_mesh_read(path, 1, &mesh), NURBS_OK);
        unlink(path);
        nurbs_hull_options_init(&options);
        options.unbounded = hulls[k].level > 0;
        CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, &options, &hull), NURBS_OK);
        const nurbs_hydrostatics *exact = nurbs_hull_hydrostatics(hull);
        if (nurbs_mesh_hydrostatics(mesh, hulls[k].level, &h) != NURBS_OK)
            fprintf(stderr, "%s: %s\n", hulls[k].name, nurbs_last_error());
        CHECK_RELATIVE(h.volume, exact->volume, 1e-3);
        CHECK_RELATIVE(h.wetted_area, exact->wetted_area, 1e-3);
        if (hulls[k].level == 0) {
            CHECK_RELATIVE(h.waterplane_area, exact->waterplane_area, 1e-3);
            CHECK_CLOSE(h.centroid[0], exact->centroid[0], 1e-3 * (h.x_fore - h.x_aft));
            CHECK_RELATIVE(h.waterplane_inertia_x, exact->waterplane_inertia_x, 2e-3);
            CHECK_RELATIVE(h.waterplane_inertia_y, exact->waterplane_inertia_y, 2e-3);
            CHECK_RELATIVE(h.draft, exact->draft, 1e-3);
            CHECK_RELATIVE(h.section_area_max, exact->section_area_max, 3e-3);
            CHECK_CLOSE(h.transom_area, exact->transom_area, 2e-3 * exact->section_area_max);
        }
        nurbs_mesh_free(mesh);
        nurbs_hull_free(hull);
        nurbs_patches_free(patches);
    }
}

/* The box drawn along another axis, in another unit and turned about. */
static void doubts_what_is_no_ship(void)
{
    static const struct {
        int axis[3];
        double scale;
        const char *says;
    } bodies[] = {{{0, 1, 2}, 1, ""},
                  {{1, 0, 2}, 1, "--axes yxz"},
                  {{1, 2, 0}, 1, "if z is not upward"},
                  {{0, 1, 2}, 1000, "millimetres were taken for metres"},
                  {{0, 1, 2}, 0.001, "metres were taken for millimetres"}};
    for (size_t b = 0; b < sizeof bodies / sizeof *bodies; b++) {
        nurbs_mesh *mesh;
        nurbs_hydrostatics h;
        double points[24];
        char sentence[220] = "unchanged";
        for (size_t k = 0; k < 24; k++)
            points[k] = bodies[b].scale * box_points[k / 3 * 3 + (size_t)bodies[b].axis[k % 3]];
        CU_ASSERT_EQUAL_FATAL(nurbs_mesh_create(8, points, 12, box_corners, &mesh), NURBS_OK);
        double level = 0.5 * bodies[b].scale;
        CU_ASSERT_EQUAL_FATAL(nurbs_mesh_hydrostatics(mesh, level, &h), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_mesh_doubt(mesh, level, &h, sizeof sentence, sentence), NURBS_OK);
        if (*bodies[b].says)
            CU_ASSERT_PTR_NOT_NULL(strstr(sentence, bodies[b].says))
        else
            CU_ASSERT_STRING_EQUAL(sentence, "");
        nurbs_mesh_free(mesh);
    }
}

/* A wedge, sharp at one end: its waterplane is fuller than its volume towards the other only where
 * the keel rises there, so the keel rises to the broad end. */
static void doubts_a_bow_at_small_x(void)
{
    static const double wedge[] = {0, 0, 0, 4, -1, 0, 4, 1, 0, 0, 0, -1, 4, 0, -0.1};
    static const size_t corners[] = {0, 1, 3, 1, 4, 3, 0, 3, 2, 2, 3, 4, 1, 2, 4, 0, 2, 1};
    for (int turned = 0; turned < 2; turned++) {
        nurbs_mesh *mesh;
        nurbs_hydrostatics h;
        double points[15];
        char sentence[220];
        for (size_t k = 0; k < 15; k++)
            points[k] = turned && k % 3 < 2 ? -wedge[k] : wedge[k];
        CU_ASSERT_EQUAL_FATAL(nurbs_mesh_create(5, points, 6, corners, &mesh), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_mesh_hydrostatics(mesh, 0, &h), NURBS_OK);
        CU_ASSERT_EQUAL(nurbs_mesh_doubt(mesh, 0, &h, sizeof sentence, sentence), NURBS_OK);
        CU_ASSERT_EQUAL(strstr(sentence, "--flip x") != NULL, !turned);
        nurbs_mesh_free(mesh);
    }
}

static const struct check_case cases[] = {
    {"box has its closed form", box_has_its_closed_form},
    {"sections are ordered lines", sections_are_ordered_lines},
    {"reads its formats", reads_its_formats},
    {"refuses damaged files", refuses_damaged_files},
    {"refuses one-sided strips", refuses_one_sided_strips},
    {"doubts what is no ship", doubts_what_is_no_ship},
    {"doubts a bow at small x", doubts_a_bow_at_small_x},
    {"shipped hulls keep their volume", shipped_hulls_keep_their_volume},
};

CHECK_MAIN("meshes", cases)
