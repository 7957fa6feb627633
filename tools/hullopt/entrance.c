#include "entrance.h"

#include <math.h>
#include <stdlib.h>

/* Coordinate c of a grid point, moved by the latent point u (NULL: of the parent). */
static double coordinate(const struct entrance *e, const struct latent *latent, const double *u,
                         size_t point, size_t c)
{
    size_t k = 3 * point + c;
    double at = nurbs_grid_points(e->grid)[k];
    if (!u)
        return at;
    at += latent->mean[k];
    for (size_t m = 0; m < latent->modes; m++)
        at += u[m] * latent->vectors[m * latent->coordinates + k];
    return at;
}

/* x and y of the waterline at section i. */
static void waterline(const struct entrance *e, const struct latent *latent, const double *u,
                      size_t i, double xy[2])
{
    for (size_t c = 0; c < 2; c++)
        xy[c] = (1 - e->share[i]) * coordinate(e, latent, u, e->above[i], c) +
                e->share[i] * coordinate(e, latent, u, e->below[i], c);
}

/* Largest |nu_x| over the pieces that count. */
static double largest(const struct entrance *e, const struct latent *latent, const double *u)
{
    double most = 0, a[2], b[2];
    for (size_t i = 0; i + 1 < e->n; i++) {
        waterline(e, latent, u, i, a);
        waterline(e, latent, u, i + 1, b);
        double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
        if (e->counts[i] && length > 0)
            most = fmax(most, fabs(dy) / length);
    }
    return most;
}

/* Sections of the grid that cross z = 0, from either end of the girth. */
static void find_crossings(struct entrance *e)
{
    size_t rows = nurbs_grid_rows(e->grid), columns = nurbs_grid_columns(e->grid);
    const double *points = nurbs_grid_points(e->grid);
    for (size_t r = 0; r < rows; r++)
        for (size_t c = 0; c + 1 < columns; c++) {
            size_t p = r * columns + c, q = p + 1;
            double zp = points[3 * p + 2], zq = points[3 * q + 2];
            if ((zp >= 0) == (zq >= 0))
                continue;
            e->above[e->n] = p;
            e->below[e->n] = q;
            e->share[e->n++] = zp / (zp - zq);
            break;
        }
}

bool entrance_create(const nurbs_grid *grid, double nu_s, struct entrance *entrance)
{
    size_t rows = nurbs_grid_rows(grid);
    *entrance = (struct entrance){.grid = grid};
    entrance->above = malloc(2 * rows * sizeof *entrance->above);
    entrance->share = malloc(rows * sizeof *entrance->share);
    entrance->counts = malloc(rows * sizeof *entrance->counts);
    if (!entrance->above || !entrance->share || !entrance->counts) {
        entrance_free(entrance);
        return false;
    }
    entrance->below = entrance->above + rows;
    find_crossings(entrance);
    for (size_t i = 0; i + 1 < entrance->n; i++) {
        double a[2], b[2];
        waterline(entrance, NULL, NULL, i, a);
        waterline(entrance, NULL, NULL, i + 1, b);
        entrance->counts[i] = fabs(b[1] - a[1]) <= 1.01 * nu_s * hypot(b[0] - a[0], b[1] - a[1]);
    }
    entrance->largest = largest(entrance, NULL, NULL);
    return true;
}

void entrance_free(struct entrance *entrance)
{
    free(entrance->above);
    free(entrance->share);
    free(entrance->counts);
    *entrance = (struct entrance){0};
}

double entrance_ratio(const struct entrance *entrance, const struct latent *latent, const double *u)
{
    return entrance->largest > 0 ? largest(entrance, latent, u) / entrance->largest : 1;
}
