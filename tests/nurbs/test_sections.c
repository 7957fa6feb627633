/* One surface through the sections of many patches or of triangles, against the surfaces that these
 * were made of and against closed forms. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static const double L = 10, B = 1, T = 0.625;
static const double volume = 2.7777777777777778, area = 14.879063; /* 4/9 L B T; quadrature */

/* Sides y = B/2 (1 - (2x/L)^2) (1 - (z/T)^2), upright above z = 0, as triangles n x m, both sides
 * on demand; without those whose middle lies in the box of x. */
static nurbs_mesh *wigley_mesh(size_t n, size_t m, bool both, double from, double to)
{
    size_t nodes = (n + 1) * (m + 1), triangles = 0;
    double *p = malloc(2 * 3 * nodes * sizeof *p);
    size_t *corner = malloc(2 * 6 * n * m * sizeof *corner);
    nurbs_mesh *mesh = NULL;
    CU_ASSERT_FATAL(p && corner);
    for (size_t s = 0; s < (both ? 2u : 1u); s++)
        for (size_t i = 0; i <= n; i++)
            for (size_t j = 0; j <= m; j++) {
                double x = L * ((double)i / (double)n - 0.5), z = -T + 0.9 * (double)j / (double)m,
                       depth = fmin(z, 0) / T, *q = p + 3 * (s * nodes + i * (m + 1) + j);
                q[0] = x;
                q[1] = (s ? -0.5 : 0.5) * B * (1 - 4 * x * x / L / L) * (1 - depth * depth);
                q[2] = z;
                size_t a = s * nodes + i * (m + 1) + j, b = a + m + 1;
                if (i == n || j == m || (x > from && x < to))
                    continue;
                memcpy(corner + 3 * triangles, (size_t[]){a, b, b + 1, a, b + 1, a + 1},
                       6 * sizeof *corner);
                triangles += 2;
            }
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_create((both ? 2 : 1) * nodes, p, triangles, corner, &mesh),
                          NURBS_OK);
    free(p);
    free(corner);
    return mesh;
}

static void is_wigley(nurbs_sections *s, double within)
{
    nurbs_hull *hull = NULL;
    CU_ASSERT_PTR_NOT_NULL_FATAL(s->surface);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hull_create_surfaces(1, (const nurbs_surface *const[]){s->surface}, NULL, &hull),
        NURBS_OK);
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(hull);
    CHECK_RELATIVE(h->volume, volume, within);
    CHECK_RELATIVE(h->wetted_area, area, within);
    nurbs_hull_free(hull);
}

/* The formula tells how far the surface is off. */
static double distance_from_wigley(const nurbs_surface *surface)
{
    enum { N = 60 };
    double worst = 0;
    for (int i = 0; i <= N; i++)
        for (int j = 0; j <= N; j++) {
            double p[3];
            CU_ASSERT_EQUAL_FATAL(
                nurbs_surface_eval(surface, 0, 1, (double[]){i / (N + 0.0), j / (N + 0.0)}, p),
                NURBS_OK);
            double depth = fmin(p[2], 0) / T,
                   y = 0.5 * B * (1 - 4 * p[0] * p[0] / L / L) * (1 - depth * depth);
            worst = fmax(worst, fabs(p[1] - y));
        }
    return worst;
}

static void triangles_of_one_side_or_both(void)
{
    for (int both = 0; both < 2; both++) {
        nurbs_sections s;
        nurbs_mesh *mesh = wigley_mesh(80, 30, both, 1, -1);
        CU_ASSERT_EQUAL_FATAL(nurbs_mesh_sections(mesh, NULL, &s), NURBS_OK);
        CU_ASSERT(s.deviation <= 5e-4 * L);
        /* Facets of 80 x 30 sag by 4e-4 m; along y the distance is up to 1.9 times as large. */
        CU_ASSERT(distance_from_wigley(s.surface) <= 1.9 * (s.deviation + 4e-4));
        is_wigley(&s, 1e-3);
        nurbs_sections_free(&s);
        nurbs_mesh_free(mesh);
    }
}

static void a_tolerance_is_kept_or_refused(void)
{
    nurbs_sections_options o;
    nurbs_sections s;
    nurbs_mesh *mesh = wigley_mesh(80, 30, false, 1, -1);
    nurbs_sections_options_init(&o);
    o.rows = o.columns = 8;
    o.tolerance = 1e-5;
    CU_ASSERT_EQUAL(nurbs_mesh_sections(mesh, &o, &s), NURBS_ERROR_NUMERIC);
    CU_ASSERT_PTR_NULL(s.surface);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "expected at most"));
    o.rows = 7;
    CU_ASSERT_EQUAL(nurbs_mesh_sections(mesh, &o, &s), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_mesh_sections(NULL, NULL, &s), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_sections(NULL, NULL, &s), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_mesh(NULL, 1, &mesh), NURBS_ERROR_ARGUMENT);
    nurbs_mesh_free(mesh);
}

/* Where triangles are missing no section can be had. */
static void a_gap_is_refused(void)
{
    nurbs_sections s;
    nurbs_mesh *mesh = wigley_mesh(80, 30, false, 1, 3);
    nurbs_status status = nurbs_mesh_sections(mesh, NULL, &s);
    CU_ASSERT(status == NURBS_ERROR_GEOMETRY || status == NURBS_ERROR_NUMERIC);
    CU_ASSERT_PTR_NULL(s.surface);
    nurbs_mesh_free(mesh);
}

/* A barge with a bilge corner and a deck, both sides closed: corners become columns, the deck goes.
 */
static void corners_and_decks(void)
{
    static const double box[8][3] = {{0, -1, -1}, {0, 1, -1}, {0, 1, 0.5}, {0, -1, 0.5},
                                     {8, -1, -1}, {8, 1, -1}, {8, 1, 0.5}, {8, -1, 0.5}};
    static const size_t corner[24] = {0, 4, 5, 0, 5, 1, 1, 5, 6, 1, 6, 2,
                                      2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0};
    nurbs_mesh *mesh = NULL;
    nurbs_sections s;
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_create(8, box[0], 8, corner, &mesh), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_sections(mesh, NULL, &s), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(s.corners, 1);
    const double *row = nurbs_grid_points(s.grid) + 3 * 5 * nurbs_grid_columns(s.grid);
    CHECK_CLOSE(row[1], 1, 1e-9);
    CHECK_CLOSE(row[2], 0.5, 1e-9);
    CHECK_CLOSE(row[3 * s.corner[0] + 1], 1, 1e-9);
    CHECK_CLOSE(row[3 * s.corner[0] + 2], -1, 1e-9);
    CHECK_CLOSE(s.deviation, 0, 1e-3);
    nurbs_sections_free(&s);
    nurbs_mesh_free(mesh);
}

/* The shipped hull, bulb ahead of the stem and transom included, cut into four patches and given by
 * these: as one surface it displaces what it did. */
static void many_patches_become_one(void)
{
    struct hull5415 hull;
    nurbs_patches *four = NULL;
    nurbs_hull_options options;
    nurbs_hull *one = NULL, *whole = NULL;
    nurbs_grid *grid = NULL;
    CU_ASSERT_FATAL(hull5415_load(&hull));
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&four), NURBS_OK);
    for (int k = 0; k < 4; k++) {
        nurbs_surface *half = NULL, *part = NULL;
        CU_ASSERT_EQUAL_FATAL(
            nurbs_surface_part(hull.surface, 0, k / 2 ? 0.6 : 0, k / 2 ? 1 : 0.6, &half), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(
            nurbs_surface_part(half, 1, k % 2 ? 0.45 : 0, k % 2 ? 1 : 0.45, &part), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(four, part), NURBS_OK);
        nurbs_surface_free(half);
        nurbs_surface_free(part);
    }
    nurbs_hull_options_init(&options);
    options.simplify = 0;
    options.cut = 1e-4;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(hull.file, &options, &whole), NURBS_OK);
    options.single = true;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(four, &options, &one), NURBS_OK);
    CHECK_RELATIVE(nurbs_hull_hydrostatics(one)->volume, nurbs_hull_hydrostatics(whole)->volume,
                   3e-4);
    CHECK_RELATIVE(nurbs_hull_hydrostatics(one)->wetted_area,
                   nurbs_hull_hydrostatics(whole)->wetted_area, 1e-3);
    CU_ASSERT_EQUAL(nurbs_hull_design_grid(one, 0, 0, &grid), NURBS_OK);
    CU_ASSERT_PTR_NOT_NULL_FATAL(nurbs_hull_step(one, 1));
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_hull_step(one, 1), "4 patches made one surface"));
    nurbs_grid_free(grid);
    nurbs_hull_free(one);
    nurbs_hull_free(whole);
    nurbs_patches_free(four);
    hull5415_free(&hull);
}

/* STL files of ours, and the offset table that is shipped: coefficients of its builders. */
static void files_that_are_no_patches(void)
{
    nurbs_patches *patches = NULL;
    nurbs_hull *hull = NULL;
    nurbs_hydrostatics h;
    nurbs_mesh *mesh = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(EXAMPLES_DIR "/hulls/bulb.json", &patches), NURBS_OK);
    const char *path = scratch_file("bulb.stl");
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_write(patches, path), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_read(path, NULL, &hull), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_read(path, 1, &mesh), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_mesh_hydrostatics(mesh, 0, &h), NURBS_OK);
    CHECK_RELATIVE(nurbs_hull_hydrostatics(hull)->volume, h.volume, 1e-3);
    remove(path);
    nurbs_hull_free(hull);
    nurbs_mesh_free(mesh);
    nurbs_patches_free(patches);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_read(EXAMPLES_DIR "/hulls/series60.offsets.csv", NULL, &hull),
                          NURBS_OK);
    /* Todd (1963): L/B 7.5, B/T 2.5, Cb 0.60. */
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume / (1 / 7.5 / 7.5 / 2.5), 0.60, 3e-3);
    nurbs_hull_free(hull);
}

/* A stern that is open above the water and closed below it, and a dome with a notch behind it:
 * volumes of the surfaces that the triangles were made of. Facets are coarse, and cross the corners
 * of both. */
static void ends_of_coarse_facets(void)
{
    static const struct {
        const char *name;
        int parts;
        double volume;
    } hulls[] = {{"series60.offsets.csv", 2, 3e-3}, {"dtmb5415.json", 5, 1e-3}};
    for (size_t k = 0; k < sizeof hulls / sizeof *hulls; k++) {
        nurbs_hull *hull = NULL, *facets = NULL;
        nurbs_hull_options options;
        char source[256];
        const char *path = scratch_file("ends.stl");
        snprintf(source, sizeof source, "%s/hulls/%s", EXAMPLES_DIR, hulls[k].name);
        nurbs_hull_options_init(&options);
        options.simplify = 0;
        options.cut = k ? 1e-3 : 1e-4;
        CU_ASSERT_EQUAL_FATAL(nurbs_hull_read(source, &options, &hull), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_patches_write_stl(nurbs_hull_full(hull), hulls[k].parts, path),
                              NURBS_OK);
        nurbs_status status = nurbs_hull_read(path, &options, &facets);
        remove(path);
        if (status)
            fprintf(stderr, "%s: %s\n", hulls[k].name, nurbs_last_error());
        CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
        const nurbs_hydrostatics *exact = nurbs_hull_hydrostatics(hull),
                                 *made = nurbs_hull_hydrostatics(facets);
        CHECK_RELATIVE(made->volume, exact->volume, hulls[k].volume);
        CHECK_CLOSE(made->centroid[0], exact->centroid[0], 1e-3 * (exact->x_fore - exact->x_aft));
        CHECK_CLOSE(made->transom_area, exact->transom_area, 1e-3 * exact->section_area_max);
        if (exact->transom_area == 0)
            CU_ASSERT_EQUAL(made->transom_area, 0);
        nurbs_hull_free(facets);
        nurbs_hull_free(hull);
    }
}

static const struct check_case cases[] = {
    {"triangles of one side or both", triangles_of_one_side_or_both},
    {"a tolerance is kept or refused", a_tolerance_is_kept_or_refused},
    {"a gap is refused", a_gap_is_refused},
    {"corners and decks", corners_and_decks},
    {"many patches become one", many_patches_become_one},
    {"files that are no patches", files_that_are_no_patches},
    {"ends of coarse facets", ends_of_coarse_facets},
};

CHECK_MAIN("nurbs sections", cases)
