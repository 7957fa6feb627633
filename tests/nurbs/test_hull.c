/* nurbs_hull against closed forms of the Wigley hull and of ellipsoids. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static const double L = 10, B = 1, T = 0.625;
static const double pi = 3.14159265358979323846;

/* A Wigley hull of draft T whose own waterline is at z = top, so that its sides reach above z = 0.
 */
static nurbs_patches *raised_wigley(double top)
{
    nurbs_surface *surface = NULL, *raised = NULL;
    nurbs_patches *patches = NULL;
    const double shift[3] = {0, 0, top};
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(L, B, T, &surface), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(surface, NULL, shift, &raised), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, raised), NURBS_OK);
    nurbs_surface_free(surface);
    nurbs_surface_free(raised);
    return patches;
}

/* Volume of the Wigley hull below the depth h: y = B/2 (1 - (2x/L)^2) (1 - (z/T)^2). */
static double volume_below(double h)
{
    double t = h / T;
    return 2.0 / 3.0 * L * B * T * (2.0 / 3.0 - t + t * t * t / 3);
}

static void cuts_at_the_level_and_says_so(void)
{
    nurbs_patches *patches = raised_wigley(0.1);
    nurbs_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, NULL, &hull), NURBS_OK);
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(hull);
    CHECK_CLOSE(h->volume, volume_below(0.1), 1e-4 * h->volume);
    CHECK_CLOSE(h->beam, B * (1 - 0.1 * 0.1 / T / T), 1e-6);
    CHECK_CLOSE(h->waterplane_area, 2.0 / 3.0 * L * h->beam, 1e-5);
    CHECK_CLOSE(nurbs_hull_length(hull), L, 1e-9);
    CU_ASSERT(nurbs_hull_is_half(hull) && nurbs_hull_is_cut(hull) &&
              nurbs_hull_has_waterline(hull));
    CU_ASSERT(nurbs_hull_bound(hull) <= 1e-4 * L);
    CU_ASSERT_PTR_NOT_NULL_FATAL(nurbs_hull_step(hull, 0));
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_hull_step(hull, 0), "cut at z = 0 m"));
    CU_ASSERT_PTR_NULL(nurbs_hull_step(hull, 1));
    nurbs_hull_free(hull);
    nurbs_patches_free(patches);
}

static void draft_sets_the_level(void)
{
    nurbs_patches *patches = raised_wigley(0.1);
    nurbs_hull_options options;
    nurbs_hull *hull = NULL;
    nurbs_hull_options_init(&options);
    options.draft = 0.5;
    options.simplify = 0;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, &options, &hull), NURBS_OK);
    CHECK_CLOSE(nurbs_hull_level(hull), 0.5 - (T - 0.1), 1e-6);
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume, volume_below(T - 0.5), 1e-4);
    nurbs_hull_free(hull);
    nurbs_patches_free(patches);
}

static void sinkage_and_trim_place_the_hull(void)
{
    nurbs_patches *patches = raised_wigley(0.2);
    nurbs_hull_options options;
    nurbs_hull *hull = NULL;
    nurbs_hull_options_init(&options);
    options.sinkage = 0.1;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, &options, &hull), NURBS_OK);
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume, volume_below(0.1), 1e-3);
    CU_ASSERT_PTR_NOT_NULL(nurbs_hull_step(hull, 1));
    nurbs_hull_free(hull);
    /* To first order a trim adds nothing to the volume of a hull that is symmetric about x = 0. */
    options.trim = 1e-3;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, &options, &hull), NURBS_OK);
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume, volume_below(0.1), 1e-3);
    CU_ASSERT(nurbs_hull_hydrostatics(hull)->centroid[0] < -0.005); /* bow up: aft */
    nurbs_hull_free(hull);
    nurbs_patches_free(patches);
}

/* Both sides, in two patches. */
static void whole_body_counts_each_side_once(void)
{
    nurbs_surface *half = NULL;
    nurbs_patches *patches = NULL, *both = NULL;
    nurbs_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(4, 2, 1, 1, &half), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, half), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_mirror(patches, 1, &both), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(both, NULL, &hull), NURBS_OK);
    CU_ASSERT(!nurbs_hull_is_half(hull) && !nurbs_hull_has_waterline(hull));
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume, pi / 6 * 4 * 2 * 1, 1e-9);
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->beam, 2, 1e-9);
    nurbs_hull_free(hull);
    nurbs_surface_free(half);
    nurbs_patches_free(patches);
    nurbs_patches_free(both);
}

/* The points of the grid are those of the surface at its parameters. */
static void check_parameters(const nurbs_patches *patches, const nurbs_grid *grid)
{
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    double u[41], v[17], point[3];
    CU_ASSERT_FATAL(rows == 41 && columns == 17);
    CU_ASSERT_EQUAL(nurbs_patches_design_parameters(patches, 0, 0, rows, u), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_design_parameters(patches, 0, 1, columns, v), NURBS_OK);
    for (size_t k = 0; k < rows * columns; k++) {
        const double uv[2] = {u[k / columns], v[k % columns]};
        nurbs_surface_eval(nurbs_patches_get(patches, 0), 0, 1, uv, point);
        for (size_t a = 0; a < 3; a++)
            CHECK_CLOSE(point[a], nurbs_grid_points(grid)[3 * k + a], 1e-15);
    }
    CU_ASSERT_EQUAL(nurbs_patches_design_parameters(patches, 0, 2, 5, u), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_design_parameters(patches, 0, 1, 1, u), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_design_parameters(patches, 1, 0, 5, u), NURBS_ERROR_ARGUMENT);
}

static void rebuilds_from_its_design_grid(void)
{
    nurbs_patches *patches = raised_wigley(0.1);
    nurbs_hull *parent = NULL, *hull = NULL;
    nurbs_grid *grid = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, NULL, &parent), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(parent, 0, 0, &grid), NURBS_OK);
    CU_ASSERT(nurbs_grid_rows(grid) == 3 && nurbs_grid_columns(grid) == 3); /* control points */
    nurbs_grid_free(grid);
    CU_ASSERT_EQUAL(nurbs_hull_design_grid(parent, 1, 0, &grid), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_design_grid(patches, 1, 0, 0, &grid), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(parent, 41, 17, &grid), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_grid_rows(grid), 41);
    check_parameters(nurbs_hull_full(parent), grid);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_rebuild(parent, grid, &hull), NURBS_OK);
    double volume = nurbs_hull_hydrostatics(hull)->volume;
    CHECK_CLOSE(volume, volume_below(0.1), 1e-4 * volume);
    CU_ASSERT(nurbs_hull_bound(hull) > 0 && nurbs_hull_bound(hull) <= 1e-4 * L);
    CU_ASSERT_EQUAL(nurbs_patches_count(nurbs_hull_light(hull)), 1);
    nurbs_hull_free(hull);
    double *points = nurbs_grid_edit(grid);
    for (size_t k = 0; k < 41 * 17; k++)
        points[3 * k + 1] *= 1.1;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_rebuild(parent, grid, &hull), NURBS_OK);
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume, 1.1 * volume, 1e-5 * volume);
    nurbs_hull_free(hull);
    for (size_t k = 0; k < 41 * 17; k++)
        points[3 * k + 2] += 5;
    CU_ASSERT_EQUAL(nurbs_hull_rebuild(parent, grid, &hull), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_EQUAL(strncmp(nurbs_last_error(), "waterline: ", 11), 0);
    CU_ASSERT_PTR_NULL(hull);
    nurbs_grid_free(grid);
    nurbs_hull_free(parent);
    nurbs_patches_free(patches);
}

/* A bulge of the side that no power of x and z follows; its amplitude is linear in a. */
static void bulge(const nurbs_grid *from, double a, nurbs_grid *to)
{
    size_t n = nurbs_grid_rows(from) * nurbs_grid_columns(from);
    const double *p = nurbs_grid_points(from);
    double *q = nurbs_grid_edit(to);
    for (size_t k = 0; k < n; k++)
        q[3 * k + 1] =
            p[3 * k + 1] * (1 + a * sin(4 * pi * p[3 * k] / L) * cos(pi * p[3 * k + 2] / T));
}

/* The largest second difference of the control points of three designs a - h, a, a + h, over h^2;
 * infinite if they are on different knots. */
static double second_difference(const nurbs_hull *parent, const nurbs_grid *grid, double h)
{
    nurbs_hull *hull[3] = {NULL, NULL, NULL};
    nurbs_grid *moved = NULL;
    double worst = 0;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hull_design_grid(parent, nurbs_grid_rows(grid), nurbs_grid_columns(grid), &moved),
        NURBS_OK);
    const double *p[3];
    size_t n[3];
    for (int i = 0; i < 3; i++) {
        bulge(grid, 0.03 + (i - 1) * h, moved);
        CU_ASSERT_EQUAL_FATAL(nurbs_hull_rebuild(parent, moved, &hull[i]), NURBS_OK);
        const nurbs_surface *light = nurbs_patches_get(nurbs_hull_light(hull[i]), 0);
        p[i] = nurbs_surface_points(light);
        n[i] = nurbs_surface_size(light, 0) * nurbs_surface_size(light, 1);
    }
    if (n[0] != n[1] || n[1] != n[2])
        worst = INFINITY;
    for (size_t k = 0; k < 3 * n[0] && worst < INFINITY; k++)
        worst = fmax(worst, fabs(p[0][k] - 2 * p[1][k] + p[2][k]) / (h * h));
    for (int i = 0; i < 3; i++)
        nurbs_hull_free(hull[i]);
    nurbs_grid_free(moved);
    return worst;
}

/* Moves of the control points of the light surface of `hull` on the way to `moved`, as a surface.
 */
static nurbs_surface *moves_of(const nurbs_hull *hull, const nurbs_hull *moved)
{
    const nurbs_surface *light = nurbs_patches_get(nurbs_hull_light(hull), 0);
    const int degree[2] = {nurbs_surface_degree(light, 0), nurbs_surface_degree(light, 1)};
    const size_t size[2] = {nurbs_surface_size(light, 0), nurbs_surface_size(light, 1)};
    double *move = malloc(3 * size[0] * size[1] * sizeof *move);
    nurbs_surface *field = NULL;
    CU_ASSERT_PTR_NOT_NULL_FATAL(move);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_moves(hull, moved, move), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(light, 0),
                                               nurbs_surface_knots(light, 1), move, NULL, &field),
                          NURBS_OK);
    free(move);
    return field;
}

/* The move of a hull by a bulge more: what control points make of it is the difference of the cut
 * surfaces at equal parameters, and where these are smooth y0 sin(4 pi x/L) cos(pi z/T). */
static void check_moves(const nurbs_hull *parent, const nurbs_grid *grid, double amount,
                        double kink, bool shared)
{
    const double h = 0.01;
    nurbs_hull *hull[2] = {NULL, NULL};
    nurbs_grid *moved = NULL;
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hull_design_grid(parent, nurbs_grid_rows(grid), nurbs_grid_columns(grid), &moved),
        NURBS_OK);
    for (int i = 0; i < 2; i++) {
        bulge(grid, amount + i * h, moved);
        nurbs_grid_edit(moved)[3 * (12 * 15 + 6) + 1] *= kink;
        CU_ASSERT_EQUAL_FATAL(nurbs_hull_rebuild(parent, moved, &hull[i]), NURBS_OK);
    }
    CU_ASSERT_EQUAL(nurbs_hull_shares_space(hull[0]), shared);
    nurbs_surface *field = moves_of(hull[0], hull[1]);
    double worst = 0, far = 0, astray = 0;
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j <= 10; j++) {
            double at[2][3], move[3];
            const double uv[2] = {i / 40.0, j / 10.0};
            for (int k = 0; k < 2; k++) {
                const nurbs_surface *wetted = nurbs_patches_get(nurbs_hull_wetted(hull[k]), 0);
                CU_ASSERT_EQUAL_FATAL(nurbs_surface_eval(wetted, 0, 1, uv, at[k]), NURBS_OK);
            }
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_eval(field, 0, 1, uv, move), NURBS_OK);
            double f = sin(4 * pi * at[0][0] / L) * cos(pi * at[0][2] / T);
            double expected = at[0][1] / (1 + amount * f) * f;
            worst = fmax(worst, fabs(move[1] - (at[1][1] - at[0][1])) / h);
            if (kink == 1)
                far = fmax(far, fabs(move[1] / h - expected));
            astray = fmax(astray, fmax(fabs(move[0]), fabs(move[2])));
        }
    CHECK_CLOSE(worst, 0, 1e-2 * B); /* of 0.5 B at most */
    CHECK_CLOSE(far, 0, 1e-2 * B);   /* the grid is not the bulge */
    CHECK_CLOSE(astray, 0, 1e-12 * L);
    nurbs_surface_free(field);
    nurbs_hull_free(hull[0]);
    nurbs_hull_free(hull[1]);
    nurbs_grid_free(moved);
}

static void rebuilds_smoothly_in_a_shared_space(void)
{
    nurbs_patches *patches = raised_wigley(0.1);
    nurbs_hull *parent = NULL, *hull = NULL;
    nurbs_grid *grid = NULL, *extreme[2] = {NULL, NULL};
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, NULL, &parent), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(parent, 31, 12, &grid), NURBS_OK);
    for (int i = 0; i < 2; i++) {
        CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(parent, 31, 12, &extreme[i]), NURBS_OK);
        bulge(grid, i ? 0.1 : -0.1, extreme[i]);
    }
    const nurbs_grid *const designs[2] = {extreme[0], extreme[1]};
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_share_space(parent, grid, 2, designs), NURBS_OK);
    for (int i = 0; i < 2; i++) {
        CU_ASSERT_EQUAL_FATAL(nurbs_hull_rebuild(parent, designs[i], &hull), NURBS_OK);
        CU_ASSERT(nurbs_hull_shares_space(hull));
        CU_ASSERT(nurbs_hull_bound(hull) <= 1e-4 * L);
        nurbs_hull_free(hull);
    }
    /* Smooth: the same second derivative from steps a hundred times apart, but for rounding. */
    double wide = second_difference(parent, grid, 1e-2),
           narrow = second_difference(parent, grid, 1e-4);
    CU_ASSERT(wide < 1);
    CU_ASSERT(narrow < 1);
    check_moves(parent, grid, 0.03, 1, true);
    /* Twenty times the bulge is not in the space: the design takes its own knots and says so. */
    bulge(grid, 0.9, extreme[0]);
    nurbs_grid_edit(extreme[0])[3 * (12 * 15 + 6) + 1] *= 1.2;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_rebuild(parent, extreme[0], &hull), NURBS_OK);
    CU_ASSERT(!nurbs_hull_shares_space(hull));
    CU_ASSERT(nurbs_hull_bound(hull) <= 1e-4 * L);
    CU_ASSERT_PTR_NOT_NULL_FATAL(nurbs_hull_step(hull, 0));
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_hull_step(hull, 0), "knots of its own"));
    nurbs_hull_free(hull);
    check_moves(parent, grid, 0.9, 1.2, false);
    nurbs_grid_free(extreme[0]);
    nurbs_grid_free(extreme[1]);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(parent, 21, 12, &extreme[0]), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_hull_rebuild(parent, extreme[0], &hull), NURBS_ERROR_ARGUMENT);
    nurbs_grid_free(extreme[0]);
    nurbs_grid_free(grid);
    nurbs_hull_free(parent);
    nurbs_patches_free(patches);
}

/* A line of the grid lies on a kink, however many lines there are. */
static void lays_grid_lines_on_kinks(void)
{
    const double kink[3] = {0.3, 0.3, 0.3};
    nurbs_surface *smooth = NULL, *raised = NULL, *cubic = NULL, *kinked = NULL;
    nurbs_hull *hull = NULL;
    const double shift[3] = {0, 0, 0.1};
    double at[3];
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(L, B, T, &smooth), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(smooth, NULL, shift, &raised), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_elevate(raised, 0, 3 - nurbs_surface_degree(raised, 0), &cubic), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_insert(cubic, 0, 3, kink, &kinked), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_hull_create_surfaces(1, (const nurbs_surface *const[]){kinked}, NULL, &hull),
        NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_eval(kinked, 0, 1, (double[]){0.3, 0}, at), NURBS_OK);
    for (size_t n = 5; n <= 40; n += 7) {
        nurbs_grid *grid = NULL;
        size_t kinks = 0;
        CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(hull, n, 4, &grid), NURBS_OK);
        for (size_t i = 0; i < n; i++)
            kinks += fabs(nurbs_grid_points(grid)[3 * 4 * i] - at[0]) < 1e-12;
        CU_ASSERT_EQUAL(kinks, 1);
        nurbs_grid_free(grid);
    }
    nurbs_hull_free(hull);
    nurbs_surface_free(smooth);
    nurbs_surface_free(raised);
    nurbs_surface_free(cubic);
    nurbs_surface_free(kinked);
}

static void keeps_the_design_grid_of_its_file(void)
{
    struct hull5415 shipped;
    nurbs_hull *hull = NULL, *again = NULL;
    nurbs_grid *grid = NULL;
    CU_ASSERT_FATAL(hull5415_load(&shipped));
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(shipped.file, NULL, &hull), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(hull, 0, 0, &grid), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_grid_rows(grid), 90);
    CU_ASSERT_EQUAL(memcmp(nurbs_grid_points(grid), nurbs_grid_points(shipped.grid),
                           3 * sizeof(double) * 90 * 25),
                    0);
    const char *path = scratch_file("hull5415_again.json");
    CU_ASSERT_EQUAL(nurbs_hull_write(hull, "copied", path), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_read(path, NULL, &again), NURBS_OK);
    remove(path);
    CHECK_CLOSE(nurbs_hull_lpp(again), 5.72, 0);
    CHECK_CLOSE(nurbs_hull_hydrostatics(again)->volume, nurbs_hull_hydrostatics(hull)->volume, 0);
    nurbs_grid_free(grid);
    nurbs_hull_free(hull);
    nurbs_hull_free(again);
    hull5415_free(&shipped);
}

static void refuses_with_the_file_and_the_reason(void)
{
    nurbs_hull *hull = NULL;
    nurbs_patches *patches = raised_wigley(0.7);
    const char *path = scratch_file("dry_wigley.json");
    CU_ASSERT_EQUAL(nurbs_patches_write(patches, path), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_hull_read(path, NULL, &hull), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "dry_wigley.json: nothing lies below"));
    remove(path);
    CU_ASSERT_EQUAL(nurbs_hull_read("no_such_file.json", NULL, &hull), NURBS_ERROR_FILE);
    nurbs_hull_options options;
    nurbs_hull_options_init(&options);
    options.length = -1;
    CU_ASSERT_EQUAL(nurbs_hull_create(patches, &options, &hull), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(hull);
    nurbs_patches_free(patches);
}

/* The surface through the offsets swings about the centre plane at the profile of the counter: no
 * open edge is left there. */
static void closes_a_counter_at_the_centre_plane(void)
{
    nurbs_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_read(EXAMPLES_DIR "/hulls/series60.offsets.csv", NULL, &hull),
                          NURBS_OK);
    const nurbs_surface *wetted = nurbs_patches_get(nurbs_hull_wetted(hull), 0);
    const double *points = nurbs_surface_points(wetted);
    size_t n[2] = {nurbs_surface_size(wetted, 0), nurbs_surface_size(wetted, 1)};
    CU_ASSERT_EQUAL(nurbs_patches_count(nurbs_hull_wetted(hull)), 1);
    for (size_t j = 0; j < n[1]; j++) {
        CU_ASSERT_EQUAL(points[3 * j + 1], 0);
        CU_ASSERT_EQUAL(points[3 * ((n[0] - 1) * n[1] + j) + 1], 0);
    }
    nurbs_hull_free(hull);
}

static const struct check_case cases[] = {
    {"closes a counter at the centre plane", closes_a_counter_at_the_centre_plane},
    {"cuts at the level and says so", cuts_at_the_level_and_says_so},
    {"draft sets the level", draft_sets_the_level},
    {"sinkage and trim place the hull", sinkage_and_trim_place_the_hull},
    {"whole body counts each side once", whole_body_counts_each_side_once},
    {"rebuilds from its design grid", rebuilds_from_its_design_grid},
    {"rebuilds smoothly in a shared space", rebuilds_smoothly_in_a_shared_space},
    {"lays grid lines on kinks", lays_grid_lines_on_kinks},
    {"keeps the design grid of its file", keeps_the_design_grid_of_its_file},
    {"refuses with the file and the reason", refuses_with_the_file_and_the_reason},
};

CHECK_MAIN("nurbs hull", cases)
