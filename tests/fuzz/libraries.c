/* Files that libnurbs and libbayesopt read. */
#include "store_edits.h"
#include "target.h"

#include <bayesopt/bayesopt.h>
#include <bayesopt/gp.h>
#include <bayesopt/store.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A status and a sentence, or a result. */
static bool is_read(nurbs_status status, const void *result)
{
    demand(status != NURBS_OK || result, "success has a result");
    demand(status == NURBS_OK || (!result && strlen(nurbs_last_error()) > 10),
           "a failure has a sentence and no result");
    return status == NURBS_OK;
}

static void use_patches(nurbs_status status, nurbs_patches *patches)
{
    for (size_t i = 0; is_read(status, patches) && i < nurbs_patches_count(patches); i++) {
        const nurbs_surface *s = nurbs_patches_get(patches, i);
        size_t n[2] = {nurbs_surface_size(s, 0), nurbs_surface_size(s, 1)};
        double first[2], last[2], point[3];
        for (int k = 0; k < 2; k++) {
            const double *knots = nurbs_surface_knots(s, k);
            demand_finite(n[k] + (size_t)nurbs_surface_degree(s, k) + 1, knots, "knots");
            first[k] = knots[nurbs_surface_degree(s, k)];
            last[k] = knots[n[k]];
        }
        demand_finite(3 * n[0] * n[1], nurbs_surface_points(s), "control points");
        demand_finite(n[0] * n[1], nurbs_surface_weights(s), "weights");
        const double middle[2] = {first[0] + 0.5 * (last[0] - first[0]),
                                  first[1] + 0.5 * (last[1] - first[1])};
        if (nurbs_surface_eval(s, 0, 1, middle, point) == NURBS_OK)
            demand_finite(3, point, "a point of a surface");
    }
    nurbs_patches_free(patches);
}

static void read_patches(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    nurbs_patches *patches = NULL;
    char report[512];
    use_patches(nurbs_patches_read_reported(path, 1e-2, &patches, report, sizeof report), patches);
}

static void read_curves(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    size_t curves = 0;
    nurbs_curve **list = NULL;
    nurbs_grid *grid = NULL;
    nurbs_status status = nurbs_curves_read_iges(path, &curves, &list);
    if (status != NURBS_OK || curves > 0) /* a file without curves is read as well */
        is_read(status, list);
    nurbs_curves_free(curves, list);
    is_read(nurbs_sections_read_iges(path, 0, &grid, &curves), grid);
    nurbs_grid_free(grid);
}

static void read_hull(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    nurbs_hull *hull = NULL;
    is_read(nurbs_hull_read(path, NULL, &hull), hull);
    nurbs_hull_free(hull);
}

static void use_grid(nurbs_status status, nurbs_grid *grid)
{
    if (is_read(status, grid))
        demand_finite(3 * nurbs_grid_rows(grid) * nurbs_grid_columns(grid), nurbs_grid_points(grid),
                      "points of a grid");
    nurbs_grid_free(grid);
}

static void read_grid(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    nurbs_grid *grid = NULL;
    nurbs_status status = nurbs_grid_read(path, &grid);
    use_grid(status, grid);
}

static void read_offsets(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    nurbs_grid *grid = NULL;
    nurbs_offsets_info info;
    nurbs_status status = nurbs_offsets_read(path, 0, &grid, &info);
    use_grid(status, grid);
}

static void read_stations(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    nurbs_grid *grid = NULL;
    nurbs_status status = nurbs_stations_read(path, 0, &grid);
    use_grid(status, grid);
}

static void read_mesh(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    nurbs_mesh *mesh = NULL;
    nurbs_hydrostatics result;
    nurbs_contour contour;
    if (is_read(nurbs_mesh_read(path, 1, &mesh), mesh)) {
        demand_finite(3 * nurbs_mesh_vertices(mesh), nurbs_mesh_points(mesh), "vertices");
        for (size_t i = 0; i < 3 * nurbs_mesh_triangles(mesh); i++)
            demand(nurbs_mesh_corners(mesh)[i] < nurbs_mesh_vertices(mesh), "a corner is a vertex");
        if (nurbs_mesh_hydrostatics(mesh, 0, &result) == NURBS_OK)
            demand_finite(1, &result.volume, "a volume");
        if (nurbs_mesh_section(mesh, (const double[]){1, 0, 0}, 0.1, &contour) == NURBS_OK)
            nurbs_contour_free(&contour);
    }
    nurbs_mesh_free(mesh);
}

static void read_gp(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    bayesopt_gp *gp = NULL;
    bayesopt_status status = bayesopt_gp_load(path, &gp);
    demand(status ? !gp && strlen(bayesopt_last_error()) > 10 : gp != NULL,
           "a failure has a sentence and no result");
    if (status)
        return;
    double x[BAYESOPT_MOST_VARIABLES] = {0}, mean, variance;
    if (!bayesopt_gp_predict(gp, 1, x, &mean, &variance))
        demand(isfinite(mean) && isfinite(variance) && variance >= 0, "a prediction is finite");
    bayesopt_gp_free(gp);
}

static void use_store(const char *path)
{
    bayesopt *bo = NULL;
    bayesopt_status status = bayesopt_open_read(path, &bo);
    demand(status ? !bo && strlen(bayesopt_last_error()) > 10 : bo != NULL,
           "a failure has a sentence and no result");
    if (status)
        return;
    size_t d = bayesopt_dimension(bo, NULL, NULL), front;
    bayesopt_point p;
    for (size_t i = 0; i < bayesopt_count(bo); i++) {
        demand(!bayesopt_get(bo, i, &p), "every row can be had");
        demand_finite(d, p.x, "a point");
        demand(p.state != BAYESOPT_STATE_DONE || isfinite(p.f), "what is done has a value");
    }
    double f;
    if (bayesopt_best_told(bo, NULL, &f, NULL) >= 0)
        demand(isfinite(f), "the best is finite");
    bayesopt_pareto(bo, &front, NULL);
    char *text = NULL;
    bayesopt_table *table = NULL;
    if (!bayesopt_store_get_text(bo, "configuration", &text))
        free(text);
    if (!bayesopt_store_get_table(bo, "sessions", &table))
        bayesopt_table_free(table);
    bayesopt_free(bo);
}

static void read_store(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    use_store(path);
}

static void read_store_values(const char *path, size_t n, const uint8_t *bytes)
{
    store_edit(path, n, bytes);
    use_store(path);
}

const struct reader READERS[] = {
    {"iges", ".igs", read_patches},
    {"iges_curves", ".igs", read_curves},
    {"step", ".step", read_patches},
    {"json", ".json", read_patches},
    {"hull", ".json", read_hull},
    {"offsets", ".offsets.csv", read_offsets},
    {"stations", ".stations", read_stations},
    {"stl", ".stl", read_mesh},
    {"obj", ".obj", read_mesh},
    {"grid", ".csv", read_grid},
    {"gp", ".gp", read_gp},
    {"store", ".db", read_store},
    {"store_values", NULL, read_store_values},
    {NULL, NULL, NULL},
};
