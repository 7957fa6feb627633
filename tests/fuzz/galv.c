/* Files that galv reads. */
#include "arguments.h"
#include "hull.h"
#include "model_file.h"
#include "shape_yaml.h"
#include "target.h"

#include <galv/galv.h>
#include <nurbs/nurbs.h>

#include <stdlib.h>

/* A model that was read moves its parent somewhere, or says why not. */
static void use_model(const galv_model *model)
{
    size_t modes = galv_model_modes(model), l = galv_model_coordinates(model);
    double *u = calloc(modes + 1, sizeof *u), *d = calloc(l + 1, sizeof *d);
    demand(u && d, "there is memory");
    demand_finite(galv_model_spectrum(model), galv_model_eigenvalues(model), "eigenvalues");
    demand_finite(3 * galv_model_points(model), galv_model_parent(model), "points of the parent");
    for (size_t k = 0; k < modes; k++)
        u[k] = 0.5 * galv_model_lower(model)[k] + 0.5 * galv_model_upper(model)[k];
    if (galv_reconstruct(model, u, d) == GALV_OK) {
        demand_finite(l, d, "a displacement");
        if (galv_project(model, d, u) == GALV_OK)
            demand_finite(modes, u, "latent coordinates");
    }
    free(u);
    free(d);
}

static void read_model(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    struct model_file file;
    if (!model_file_read(path, &file))
        return;
    use_model(file.model);
    if (file.shape.n) {
        galv_shape *shape = NULL;
        if (shape_definition_create(&file.shape, &shape) == GALV_OK)
            demand_finite(galv_shape_parameters(shape), galv_shape_lower(shape), "bounds");
        galv_shape_free(shape);
    }
    model_file_free(&file);
}

/* For points alone, and for those of a grid on a bilinear patch, whose control points may be moved.
 */
static void read_shape(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    enum { POINTS = 4 };
    static const double xyz[3 * POINTS] = {0, 0.1, 0, 0, 0.1, -0.1, 1, 0.1, 0, 1, 0.1, -0.1};
    static const double knots[] = {0, 0, 1, 1}, ends[] = {0, 1};
    nurbs_surface *surface = NULL;
    demand(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots, knots, xyz,
                                NULL, &surface) == NURBS_OK,
           "a surface can be made");
    const struct shape_points points[] = {{.n = POINTS, .xyz = xyz},
                                          {POINTS, xyz, surface, 2, 2, ends, ends}};
    for (size_t i = 0; i < 2; i++) {
        double d[3 * POINTS];
        galv_shape *shape = shape_yaml_read(path, &points[i]);
        if (shape && galv_shape_displace(shape, POINTS, xyz, galv_shape_upper(shape), d) == GALV_OK)
            demand_finite(3 * POINTS, d, "a displacement");
        galv_shape_free(shape);
    }
    nurbs_surface_free(surface);
}

static void read_hull(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    struct hull hull;
    if (hull_read(path, 0, 0, &hull)) {
        demand_finite(3 * hull.npoints, hull.xyz, "points of a hull");
        demand(hull.sections * hull.girth == hull.npoints || !hull.sections, "a grid is whole");
        hull_free(&hull);
    }
}

static void read_samples(const char *path, size_t n, const uint8_t *bytes)
{
    (void)n, (void)bytes;
    struct rows rows;
    if (rows_read(path, 4, "x", &rows)) {
        demand_finite(rows.count * rows.width, rows.values, "samples");
        rows_free(&rows);
    }
}

const struct reader READERS[] = {
    {"model_h5", ".h5", read_model},       {"shape_yaml", ".yaml", read_shape},
    {"hull_csv", ".csv", read_hull},       {"hull_json", ".json", read_hull},
    {"samples_csv", ".csv", read_samples}, {NULL, NULL, NULL},
};
