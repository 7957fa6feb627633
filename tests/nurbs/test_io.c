#include "check.h"
#include "hulls.h"

#include <locale.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int same_surface(const nurbs_surface *a, const nurbs_surface *b)
{
    size_t n = nurbs_surface_size(a, 0) * nurbs_surface_size(a, 1);
    for (int d = 0; d < 2; d++)
        if (nurbs_surface_size(a, d) != nurbs_surface_size(b, d) ||
            nurbs_surface_degree(a, d) != nurbs_surface_degree(b, d) ||
            memcmp(nurbs_surface_knots(a, d), nurbs_surface_knots(b, d),
                   (nurbs_surface_size(a, d) + (size_t)nurbs_surface_degree(a, d) + 1) *
                       sizeof(double)) != 0)
            return 0;
    if (!nurbs_surface_weights(a) != !nurbs_surface_weights(b))
        return 0;
    return memcmp(nurbs_surface_points(a), nurbs_surface_points(b), 3 * n * sizeof(double)) == 0 &&
           (!nurbs_surface_weights(a) ||
            memcmp(nurbs_surface_weights(a), nurbs_surface_weights(b), n * sizeof(double)) == 0);
}

static nurbs_patches *two_bodies(void)
{
    nurbs_patches *patches;
    nurbs_surface *a, *b;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(1.0 / 3, 0.2, 0.1, 0.7, &a), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1.1, 0.1, 0.0625, &b), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_add(patches, a), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_add(patches, b), NURBS_OK);
    nurbs_surface_free(a);
    nurbs_surface_free(b);
    return patches;
}

static void json_restores_every_bit(void)
{
    nurbs_patches *patches = two_bodies(), *back = NULL;
    const double u[3] = {0, 1.0 / 3, 1}, v[2] = {0.1, 0.2}, *read;
    CU_ASSERT_EQUAL(nurbs_patches_set_length(patches, 1.0 / 7), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_set_note(patches, "a \"note\"\nwith a caf\xc3\xa9"), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_set_parameters(patches, 1, 3, u, 2, v), NURBS_OK);
    const char *path = scratch_file("two.json");
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_write(patches, path), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(path, &back), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_count(back), 2);
    for (size_t k = 0; k < 2; k++)
        CU_ASSERT(same_surface(nurbs_patches_get(patches, k), nurbs_patches_get(back, k)));
    CHECK_CLOSE(nurbs_patches_length(back), 1.0 / 7, 0);
    CU_ASSERT_STRING_EQUAL(nurbs_patches_note(back), nurbs_patches_note(patches));
    CU_ASSERT_EQUAL(nurbs_patches_parameters(back, 0, 0, &read), 0);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_parameters(back, 1, 0, &read), 3);
    CHECK_CLOSE(read[1], 1.0 / 3, 0);
    CU_ASSERT_EQUAL(nurbs_patches_parameters(back, 1, 1, &read), 2);
    unlink(path);
    nurbs_patches_free(back);
    nurbs_patches_free(patches);
}

#define PATCH                                                                                      \
    "{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1,1],[0,0,1,1]],"                            \
    "\"points\":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]]}"
#define HEAD "{\"format\":\"nurbs\",\"version\":1,\"unit\":\"m\","

static void json_names_the_field_at_fault(void)
{
    static const struct {
        const char *text, *expected;
    } cases[] = {
        {"", ":1: "},
        {"{\"format\":\"nurbs\",", ":1: "},
        {"[]", "expected a JSON object"},
        {"{\"format\":\"step\"}", "format: expected"},
        {"{\"format\":\"nurbs\",\"version\":2}", "version"},
        {"{\"format\":\"nurbs\",\"version\":1,\"unit\":\"mm\"}", "unit"},
        {HEAD "\"patches\":[]}", "patches: expected"},
        {HEAD "\"lpp\":-1,\"patches\":[" PATCH "]}", "lpp"},
        {HEAD "\"note\":7,\"patches\":[" PATCH "]}", "note"},
        {HEAD "\"patches\":[7]}", "patch 0: patch"},
        {HEAD "\"patches\":[" PATCH ",{\"degree\":[1]}]}", "patch 1: degree: expected two"},
        {HEAD "\"patches\":[{\"degree\":[0,1],\"size\":[2,2]}]}", "degree[0]"},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,1]}]}", "size[1]"},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[900000,900000],\"points\":[]}]}",
         "found 0"},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1],[0,0,1,1]],"
              "\"points\":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]]}]}",
         "knots[0]: expected a list of 4"},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1,1],[0,0,\"1\",1]],"
              "\"points\":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]]}]}",
         "knots[1][2] is not a number"},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1,1],[0,0,1,1]],"
              "\"points\":[[0,0,0],[0,1],[1,0,0],[1,1,0]]}]}",
         "points[1]: expected a list of 3"},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1,1],[0,1,0,1]],"
              "\"points\":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]]}]}",
         "patch 0: "},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1,1],[0,0,1,1]],"
              "\"points\":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]],\"weights\":[1,1,0,1]}]}",
         "patch 0: "},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1,1],[0,0,1,1]],"
              "\"points\":[[0,0,0],[0,1,0],[1,0,0],[1,1,0]],\"parameters\":[[0,2],[0,1]]}]}",
         "parameters"},
        {HEAD "\"patches\":[{\"degree\":[1,1],\"size\":[2,2],\"knots\":[[0,0,1,1],[0,0,1,1]],"
              "\"points\":[[0,0,0],[0,1,0],[1e400,0,0],[1,1,0]]}]}",
         ":1: "},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        nurbs_patches *patches;
        const char *path = write_scratch("bad.json", cases[k].text);
        CU_ASSERT_EQUAL(nurbs_patches_read(path, &patches), NURBS_ERROR_FORMAT);
        CU_ASSERT_PTR_NULL(patches);
        if (!strstr(nurbs_last_error(), cases[k].expected)) {
            fprintf(stderr, "case %zu: '%s'\n", k, nurbs_last_error());
            CU_FAIL("the message does not name the fault");
        }
        unlink(path);
    }
}

static void json_ignores_the_locale(void)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"};
    for (size_t k = 0; k < 3 && !setlocale(LC_NUMERIC, names[k]); k++)
        ;
    nurbs_patches *patches = two_bodies(), *back = NULL;
    const char *path = scratch_file("locale.json");
    CU_ASSERT_EQUAL(nurbs_patches_write(patches, path), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_read(path, &back), NURBS_OK);
    CU_ASSERT_FATAL(back != NULL);
    CU_ASSERT(same_surface(nurbs_patches_get(patches, 0), nurbs_patches_get(back, 0)));
    setlocale(LC_NUMERIC, "C");
    unlink(path);
    nurbs_patches_free(back);
    nurbs_patches_free(patches);
}

static long file_size(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 ? (long)info.st_size : -1;
}

static void stl_holds_all_triangles(void)
{
    nurbs_patches *patches = two_bodies();
    const char *path = scratch_file("two.stl");
    CU_ASSERT_EQUAL(nurbs_patches_write_stl(patches, 3, path), NURBS_OK);
    /* 2 x 2 and 1 x 1 spans, 3 parts a span, 2 triangles a cell, 50 bytes each. */
    CU_ASSERT_EQUAL(file_size(path), 84 + 50 * 2 * (36 + 9));
    unlink(path);
    CU_ASSERT_EQUAL(nurbs_patches_write_stl(patches, 1001, path), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(file_size(path), -1);
    nurbs_patches_free(patches);
}

static void vtu_and_points_are_complete(void)
{
    nurbs_patches *patches = two_bodies();
    char line[300];
    size_t pieces = 0, closed = 0, rows = 0;
    const char *path = scratch_file("two.vtu");
    CU_ASSERT_EQUAL(nurbs_patches_write_vtu(patches, 2, path), NURBS_OK);
    FILE *stream = fopen(path, "r");
    while (fgets(line, sizeof line, stream)) {
        pieces += strstr(line, "<Piece NumberOfPoints=\"25\" NumberOfCells=\"16\">") != NULL ||
                  strstr(line, "<Piece NumberOfPoints=\"9\" NumberOfCells=\"4\">") != NULL;
        closed += strstr(line, "</VTKFile>") != NULL;
    }
    fclose(stream);
    CU_ASSERT_EQUAL(pieces, 2);
    CU_ASSERT_EQUAL(closed, 1);
    unlink(path);
    path = scratch_file("two.csv");
    CU_ASSERT_EQUAL(nurbs_patches_write(patches, path), NURBS_OK);
    stream = fopen(path, "r");
    while (fgets(line, sizeof line, stream))
        rows++;
    fclose(stream);
    CU_ASSERT_EQUAL(rows, 1 + 36 + 9);
    unlink(path);
    nurbs_patches_free(patches);
}

static void failures_leave_no_files(void)
{
    nurbs_patches *patches = two_bodies(), *empty;
    CU_ASSERT_EQUAL(nurbs_patches_write(patches, "/nonexistent/x.json"), NURBS_ERROR_FILE);
    CU_ASSERT_EQUAL(nurbs_patches_write(patches, "hull.dxf"), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "hull.dxf"));
    CU_ASSERT_EQUAL(nurbs_patches_read("hull.stl", &empty), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_read("nothing.json", &empty), NURBS_ERROR_FILE);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&empty), NURBS_OK);
    const char *path = scratch_file("empty.json");
    CU_ASSERT_EQUAL(nurbs_patches_write(empty, path), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(file_size(path), -1);
    CU_ASSERT_EQUAL(nurbs_patches_set_length(empty, NAN), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_set_parameters(empty, 0, 0, NULL, 0, NULL), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(nurbs_patches_get(empty, 0));
    nurbs_patches_free(empty);
    nurbs_patches_free(patches);
    nurbs_patches_free(NULL);
}

static const struct check_case cases[] = {
    {"json restores every bit", json_restores_every_bit},
    {"json names the field at fault", json_names_the_field_at_fault},
    {"json ignores the locale", json_ignores_the_locale},
    {"stl holds all triangles", stl_holds_all_triangles},
    {"vtu and points are complete", vtu_and_points_are_complete},
    {"failures leave no files", failures_leave_no_files},
};

CHECK_MAIN("nurbs io", cases)
