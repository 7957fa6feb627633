#include "limits.h"

#include "volume.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Differences are taken over this share of the half box: hulls there are still sound. */
static const double STEP = 0.25;

bool limits_create(const struct latent *latent, const nurbs_grid *parent, const double *gradient,
                   struct limits *limits)
{
    *limits = (struct limits){.latent = latent, .parent = parent};
    if (!gradient) {
        limits->parent_volume = volume_of_grid(nurbs_grid_rows(parent), nurbs_grid_columns(parent),
                                               nurbs_grid_points(parent));
        return true;
    }
    limits->gradient = malloc(latent->modes * sizeof *limits->gradient);
    if (!limits->gradient)
        return false;
    memcpy(limits->gradient, gradient, latent->modes * sizeof *gradient);
    return true;
}

void limits_free(struct limits *limits)
{
    free(limits->gradient);
    *limits = (struct limits){0};
}

static bool moves_only_y(const struct latent *latent)
{
    size_t n = latent->modes * latent->coordinates;
    for (size_t k = 0; k < n; k += 3)
        if (latent->vectors[k] != 0 || latent->vectors[k + 2] != 0)
            return false;
    for (size_t k = 0; k < latent->coordinates; k++)
        if (k % 3 != 1 && latent->mean[k] != 0)
            return false;
    return true;
}

/* Volume of the built hull, or of the grid where it cannot be built; the scale is that of the
 * parent in the same measure. */
struct measure {
    const struct latent *latent;
    const struct parent *parent;
    double tolerance, built, grid;
    double *moved;
};

static double grid_volume(const struct measure *m, const double *displacement)
{
    const nurbs_grid *grid = m->parent->grid;
    const double *points = nurbs_grid_points(grid);
    for (size_t k = 0; k < m->latent->coordinates; k++)
        m->moved[k] = points[k] + displacement[k];
    return volume_of_grid(nurbs_grid_rows(grid), nurbs_grid_columns(grid), m->moved);
}

static double built_volume(const struct measure *m, const double *displacement)
{
    struct design design;
    struct failure failure;
    if (!design_build(m->parent, displacement, m->tolerance, &design, &failure))
        return NAN;
    double volume = design.hydrostatics.volume;
    design_free(&design);
    return volume;
}

static double difference(const struct measure *m, size_t mode, double *u, double *d)
{
    const struct latent *latent = m->latent;
    double step = STEP * (latent->upper[mode] - latent->lower[mode]) / 2, built[2], grid[2];
    for (int side = 0; side < 2; side++) {
        u[mode] = side ? step : -step;
        latent_displace(latent, u, d);
        built[side] = built_volume(m, d);
        grid[side] = grid_volume(m, d);
    }
    u[mode] = 0;
    double slope = (built[1] - built[0]) / (2 * step * m->built);
    return isfinite(slope) ? slope : (grid[1] - grid[0]) / (2 * step * m->grid);
}

bool limits_gradient(const struct latent *latent, const struct parent *parent, double tolerance,
                     double *gradient)
{
    struct measure m = {.latent = latent, .parent = parent, .tolerance = tolerance};
    if (!moves_only_y(latent))
        return false;
    double *u = calloc(latent->modes, sizeof *u), *d = calloc(latent->coordinates, sizeof *d);
    m.moved = malloc(latent->coordinates * sizeof *m.moved);
    bool ok = u && d && m.moved;
    if (ok) {
        latent_displace(latent, u, d);
        m.built = built_volume(&m, d);
        m.grid = grid_volume(&m, d);
        for (size_t k = 0; k < latent->modes; k++)
            gradient[k] = difference(&m, k, u, d);
    }
    free(u);
    free(d);
    free(m.moved);
    return ok;
}

double limits_volume_ratio(const struct limits *limits, const double *u)
{
    const struct latent *latent = limits->latent;
    if (limits->gradient) {
        double ratio = 1;
        for (size_t m = 0; m < latent->modes; m++)
            ratio += limits->gradient[m] * u[m];
        return ratio;
    }
    double *moved = malloc(latent->coordinates * sizeof *moved);
    const double *points = nurbs_grid_points(limits->parent);
    if (!moved)
        return NAN;
    latent_displace(latent, u, moved);
    for (size_t k = 0; k < latent->coordinates; k++)
        moved[k] += points[k];
    double volume =
        volume_of_grid(nurbs_grid_rows(limits->parent), nurbs_grid_columns(limits->parent), moved);
    free(moved);
    return volume / limits->parent_volume;
}

/* Parent points nearer to the centre plane than this, in metres, belong to keel, stem and stern. */
static const double CENTRE = 1e-6;

static void narrow(const double *point, double y, struct limits_breadth *breadth)
{
    breadth->least_y = fmin(breadth->least_y, y);
    if (point[2] <= 0 && point[1] > CENTRE)
        breadth->least_share = fmin(breadth->least_share, y / point[1]);
}

struct limits_breadth limits_breadth(const struct limits *limits, const double *u)
{
    enum { BLOCK = 64 };
    const struct latent *latent = limits->latent;
    const double *points = nurbs_grid_points(limits->parent);
    size_t n = latent->coordinates / 3;
    struct limits_breadth breadth = {INFINITY, INFINITY};
    for (size_t start = 0; start < n; start += BLOCK) {
        size_t end = start + BLOCK < n ? start + BLOCK : n;
        double y[BLOCK];
        for (size_t k = start; k < end; k++)
            y[k - start] = points[3 * k + 1] + latent->mean[3 * k + 1];
        for (size_t m = 0; m < latent->modes; m++) {
            const double *mode = latent->vectors + m * latent->coordinates;
            for (size_t k = start; k < end; k++)
                y[k - start] += u[m] * mode[3 * k + 1];
        }
        for (size_t k = start; k < end; k++)
            narrow(points + 3 * k, y[k - start], &breadth);
    }
    return breadth;
}
