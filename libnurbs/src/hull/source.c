/* Hulls that are no patches yet: triangles, offset tables, station files; and many patches made one
 * surface. */
#include "hull/source.h"

#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/fit.h>
#include <nurbs/io.h>
#include <nurbs/offsets.h>
#include <nurbs/sections.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Of the extent: facets are no smoother. */
static const double facets = 6e-4;

/* Of the extent; of the volume: a hundredth is more than a tolerance of sections makes. */
static const double fineness = 2e-5, volume_share = 0.01;

static bool ends_with(const char *path, const char *end)
{
    size_t length = strlen(path), n = strlen(end);
    return length > n && strcasecmp(path + length - n, end) == 0;
}

hull_source hull_source_of(const char *path)
{
    if (ends_with(path, ".stl") || ends_with(path, ".obj"))
        return HULL_SOURCE_MESH;
    if (ends_with(path, ".offsets.csv"))
        return HULL_SOURCE_TABLE;
    if (ends_with(path, ".stations"))
        return HULL_SOURCE_STATIONS;
    return ends_with(path, ".csv") ? HULL_SOURCE_GRID : HULL_SOURCE_PATCHES;
}

/* One surface with the parameters of its grid. */
static nurbs_status wrap(const nurbs_surface *surface, const nurbs_grid *grid, const double *u,
                         const double *v, double length, nurbs_patches **patches)
{
    nurbs_patches *one = NULL;
    nurbs_status status = nurbs_patches_create(&one);
    if (!status)
        status = nurbs_patches_add(one, surface);
    if (!status)
        status = nurbs_patches_set_parameters(one, 0, nurbs_grid_rows(grid), u,
                                              nurbs_grid_columns(grid), v);
    if (!status)
        status = nurbs_patches_set_length(one, length);
    if (status)
        nurbs_patches_free(one);
    else
        *patches = one;
    return status;
}

static double length_of(const nurbs_mesh *mesh)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < nurbs_mesh_vertices(mesh); k++) {
        low = fmin(low, nurbs_mesh_points(mesh)[3 * k]);
        high = fmax(high, nurbs_mesh_points(mesh)[3 * k]);
    }
    return high - low;
}

/* A starboard half is mirrored: sections lie at y >= 0. */
static nurbs_status to_port(nurbs_mesh **mesh)
{
    size_t n = nurbs_mesh_vertices(*mesh), triangles = nurbs_mesh_triangles(*mesh);
    const double *p = nurbs_mesh_points(*mesh);
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < n; k++) {
        low = fmin(low, p[3 * k + 1]);
        high = fmax(high, p[3 * k + 1]);
    }
    if (high > -0.01 * low)
        return NURBS_OK;
    nurbs_mesh *turned = NULL;
    double *points = malloc(3 * n * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu vertices", n);
    for (size_t k = 0; k < 3 * n; k++)
        points[k] = k % 3 == 1 ? -p[k] : p[k];
    nurbs_status status =
        nurbs_mesh_create(n, points, triangles, nurbs_mesh_corners(*mesh), &turned);
    free(points);
    if (status)
        return status;
    nurbs_mesh_free(*mesh);
    *mesh = turned;
    return NURBS_OK;
}

static nurbs_status read_mesh(const char *path, double tolerance, double level,
                              nurbs_patches **patches, double *volume, char *report,
                              size_t report_size)
{
    nurbs_hydrostatics h;
    nurbs_mesh *mesh = NULL;
    nurbs_sections s = {0};
    nurbs_sections_options options;
    nurbs_sections_options_init(&options);
    nurbs_status status = nurbs_mesh_read(path, 1, &mesh);
    if (status)
        return status;
    options.tolerance = isnan(tolerance) ? facets * length_of(mesh) : tolerance;
    status = to_port(&mesh);
    if (!status)
        status = nurbs_mesh_sections(mesh, &options, &s);
    if (!status)
        status = wrap(s.surface, s.grid, s.u, s.v, 0, patches);
    if (!status)
        snprintf(report, report_size,
                 "%zu triangles, lengths taken as metres: a surface through %zu sections of %zu "
                 "points, at most %.2g m off",
                 nurbs_mesh_triangles(mesh), nurbs_grid_rows(s.grid), nurbs_grid_columns(s.grid),
                 s.deviation);
    if (!status && nurbs_mesh_hydrostatics(mesh, level, &h) == NURBS_OK)
        *volume = h.volume;
    nurbs_sections_free(&s);
    nurbs_mesh_free(mesh);
    return status ? nurbs_fail_in(status, path) : NURBS_OK;
}

static nurbs_status read_table(const char *path, hull_source source, nurbs_patches **patches,
                               char *report, size_t report_size)
{
    nurbs_grid *grid = NULL;
    nurbs_surface *surface = NULL;
    nurbs_offsets_info info = {0};
    nurbs_skin_options options;
    double *u = NULL;
    nurbs_skin_options_init(&options);
    nurbs_status status = source == HULL_SOURCE_TABLE ? nurbs_offsets_read(path, 0, &grid, &info)
                          : source == HULL_SOURCE_STATIONS ? nurbs_stations_read(path, 0, &grid)
                                                           : nurbs_grid_read(path, &grid);
    if (status)
        return status;
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    options.chine_count = info.chine > 0;
    options.chine = &info.chine;
    u = malloc((rows + columns) * sizeof *u);
    status = u ? nurbs_skin(grid, &options, &surface)
               : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", rows + columns);
    if (!status)
        status = nurbs_skin_parameters(grid, &options, u, u + rows);
    if (!status)
        status = wrap(surface, grid, u, u + rows, info.length, patches);
    if (!status)
        snprintf(report, report_size, "a surface through %zu sections of %zu points", rows,
                 columns);
    nurbs_surface_free(surface);
    nurbs_grid_free(grid);
    free(u);
    return status ? nurbs_fail_in(status, path) : NURBS_OK;
}

nurbs_status hull_source_read(const char *path, double tolerance, double level,
                              nurbs_patches **patches, double *volume, char *report,
                              size_t report_size)
{
    hull_source source = hull_source_of(path);
    *patches = NULL;
    *volume = 0;
    report[0] = '\0';
    return source == HULL_SOURCE_MESH
               ? read_mesh(path, tolerance, level, patches, volume, report, report_size)
               : read_table(path, source, patches, report, report_size);
}

/* Of the patches below the water, by triangles: what the one surface is held against. */
static void note_volume(nurbs_hull *hull)
{
    nurbs_mesh *mesh = NULL;
    nurbs_hydrostatics h;
    if (!hull->options.unbounded &&
        nurbs_patches_mesh(hull->full, fineness * hull->extent, &mesh) == NURBS_OK &&
        nurbs_mesh_hydrostatics(mesh, hull->level, &h) == NURBS_OK)
        hull->triangles = h.volume;
    nurbs_mesh_free(mesh);
}

/* Sections may miss what no sheet shows, as inner faces or parts beside the hull. */
nurbs_status hull_check_volume(const nurbs_hull *hull)
{
    double volume = hull->hydrostatics.volume;
    bool placed = hull->options.sinkage != 0 || hull->options.trim != 0;
    if (!(hull->triangles > 0) || placed ||
        fabs(volume - hull->triangles) <= volume_share * hull->triangles)
        return NURBS_OK;
    return nurbs_fail(NURBS_ERROR_GEOMETRY,
                      "the surface through the sections displaces %.6g m^3, what it was made of "
                      "%.6g m^3: are parts missing, or more than one hull there?",
                      volume, hull->triangles);
}

/* A hull that ends at the water goes on doing so: upper control points near the level are put
 * there.
 */
static nurbs_status settle_top(const nurbs_hull *hull, nurbs_surface **surface)
{
    const size_t n[2] = {nurbs_surface_size(*surface, 0), nurbs_surface_size(*surface, 1)};
    const int degree[2] = {nurbs_surface_degree(*surface, 0), nurbs_surface_degree(*surface, 1)};
    nurbs_surface *settled = NULL;
    double *points = malloc(3 * n[0] * n[1] * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n[0] * n[1]);
    memcpy(points, nurbs_surface_points(*surface), 3 * n[0] * n[1] * sizeof *points);
    for (size_t i = 0; i < n[0]; i++)
        if (fabs(points[3 * i * n[1] + 2] - hull->level) <= fineness * hull->extent)
            points[3 * i * n[1] + 2] = hull->level;
    nurbs_status status =
        nurbs_surface_create(degree, n, nurbs_surface_knots(*surface, 0),
                             nurbs_surface_knots(*surface, 1), points, NULL, &settled);
    free(points);
    if (status)
        return status;
    nurbs_surface_free(*surface);
    *surface = settled;
    return NURBS_OK;
}

nurbs_status hull_join(nurbs_hull *hull)
{
    nurbs_sections s = {0};
    nurbs_sections_options options;
    nurbs_patches *one = NULL;
    size_t n = nurbs_patches_count(hull->full);
    nurbs_sections_options_init(&options);
    options.tolerance = hull->options.sections;
    nurbs_status status = nurbs_patches_sections(hull->full, &options, &s);
    if (!status)
        status = settle_top(hull, &s.surface);
    if (!status)
        status = wrap(s.surface, s.grid, s.u, s.v, hull->lpp, &one);
    if (!status)
        status = nurbs_patches_set_note(one, nurbs_patches_note(hull->full));
    if (status) {
        nurbs_patches_free(one);
        nurbs_sections_free(&s);
        return nurbs_fail_in(status, "one surface");
    }
    note_volume(hull);
    hull_replace_full(hull, one);
    hull->number[0] = 0;
    status = hull_tell(hull,
                       "%zu patches made one surface through %zu sections of %zu points, at most "
                       "%.2g m off",
                       n, nurbs_grid_rows(s.grid), nurbs_grid_columns(s.grid), s.deviation);
    if (!status && s.left_out > 0.01 * s.deviation + HULL_CLEARANCE * hull->extent)
        status = hull_tell(hull,
                           "fins or inner faces beside the sections, up to %.3g m in one, "
                           "left out",
                           s.left_out);
    nurbs_sections_free(&s);
    return status;
}
