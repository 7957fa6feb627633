/* Distances from a mesh: its triangles in cells over x and z. */
#include "core/error.h"
#include "core/vector.h"
#include "lines/lines.h"
#include "mesh/mesh.h"

#include <math.h>
#include <stdlib.h>

enum { CELLS_X = 256, CELLS_Z = 48 };

struct mesh_distance {
    const nurbs_mesh *mesh;
    double low[2], step[2]; /* x and z */
    size_t first[CELLS_X * CELLS_Z + 1];
    size_t *list;
};

static size_t cell_of(const mesh_distance *d, int axis, double value)
{
    double k = floor((value - d->low[axis]) / d->step[axis]);
    return (size_t)fmin(fmax(k, 0), (axis ? CELLS_Z : CELLS_X) - 1);
}

/* Counts the triangles of every cell; with a list, puts them there. */
static void fill_cells(mesh_distance *d)
{
    const nurbs_mesh *m = d->mesh;
    for (size_t t = 0; t < m->triangles; t++) {
        double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
        for (size_t k = 0; k < 3; k++)
            for (int a = 0; a < 2; a++) {
                double x = m->points[3 * m->corner[3 * t + k] + (a ? 2 : 0)];
                low[a] = fmin(low[a], x);
                high[a] = fmax(high[a], x);
            }
        for (size_t i = cell_of(d, 0, low[0]); i <= cell_of(d, 0, high[0]); i++)
            for (size_t j = cell_of(d, 1, low[1]); j <= cell_of(d, 1, high[1]); j++) {
                size_t *at = &d->first[i * CELLS_Z + j];
                if (d->list)
                    d->list[--*at] = t;
                else
                    ++*at;
            }
    }
}

nurbs_status mesh_distance_create(const nurbs_mesh *mesh, mesh_distance **result)
{
    mesh_distance *d = calloc(1, sizeof *d);
    *result = NULL;
    if (!d)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the cells of a mesh");
    d->mesh = mesh;
    double high[2] = {-INFINITY, -INFINITY};
    d->low[0] = d->low[1] = INFINITY;
    for (size_t k = 0; k < mesh->vertices; k++)
        for (int a = 0; a < 2; a++) {
            double x = mesh->points[3 * k + (a ? 2 : 0)];
            d->low[a] = fmin(d->low[a], x);
            high[a] = fmax(high[a], x);
        }
    for (int a = 0; a < 2; a++) {
        d->step[a] = (high[a] - d->low[a]) / (a ? CELLS_Z : CELLS_X);
        d->step[a] = d->step[a] > 0 ? d->step[a] : 1;
    }
    fill_cells(d);
    size_t total = 0;
    for (size_t k = 0; k < CELLS_X * CELLS_Z; k++) {
        total += d->first[k];
        d->first[k] = total;
    }
    d->first[CELLS_X * CELLS_Z] = total;
    d->list = malloc((total + 1) * sizeof *d->list);
    if (!d->list) {
        mesh_distance_free(d);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for the cells of a mesh");
    }
    fill_cells(d);
    *result = d;
    return NURBS_OK;
}

void mesh_distance_free(mesh_distance *distance)
{
    if (distance)
        free(distance->list);
    free(distance);
}

/* Ericson, Real-Time Collision Detection (2005), 5.1.5: the closest point of a triangle by the
 * region of its plane. */
static double to_triangle(const double p[3], const double *a, const double *b, const double *c)
{
    double ab[3], ac[3], ap[3], bp[3], cp[3], q[3];
    minus3(b, a, ab);
    minus3(c, a, ac);
    minus3(p, a, ap);
    double d1 = dot3(ab, ap), d2 = dot3(ac, ap);
    if (d1 <= 0 && d2 <= 0)
        return norm3(ap);
    minus3(p, b, bp);
    double d3 = dot3(ab, bp), d4 = dot3(ac, bp);
    if (d3 >= 0 && d4 <= d3)
        return norm3(bp);
    double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
        along3(a, d1 / (d1 - d3), ab, q);
        return distance3(p, q);
    }
    minus3(p, c, cp);
    double d5 = dot3(ab, cp), d6 = dot3(ac, cp);
    if (d6 >= 0 && d5 <= d6)
        return norm3(cp);
    double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
        along3(a, d2 / (d2 - d6), ac, q);
        return distance3(p, q);
    }
    double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
        double bc[3], w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        minus3(c, b, bc);
        along3(b, w, bc, q);
        return distance3(p, q);
    }
    double sum = va + vb + vc;
    along3(a, vb / sum, ab, q);
    along3(q, vc / sum, ac, q);
    return distance3(p, q);
}

static double in_cell(const mesh_distance *d, size_t i, size_t j, const double p[3], double best)
{
    const nurbs_mesh *m = d->mesh;
    for (size_t k = d->first[i * CELLS_Z + j]; k < d->first[i * CELLS_Z + j + 1]; k++) {
        const size_t *c = m->corner + 3 * d->list[k];
        best = fmin(
            best, to_triangle(p, m->points + 3 * c[0], m->points + 3 * c[1], m->points + 3 * c[2]));
    }
    return best;
}

double mesh_distance_of(const mesh_distance *d, const double p[3])
{
    size_t i = cell_of(d, 0, p[0]), j = cell_of(d, 1, p[2]);
    double best = INFINITY, least = fmin(d->step[0], d->step[1]);
    /* Rings of cells about that of p; ring r is at least (r - 1) steps away. */
    for (size_t r = 0; r < CELLS_X && (double)(r ? r - 1 : 0) * least <= best; r++) {
        size_t i0 = i > r ? i - r : 0, i1 = i + r < CELLS_X ? i + r : CELLS_X - 1,
               j0 = j > r ? j - r : 0, j1 = j + r < CELLS_Z ? j + r : CELLS_Z - 1;
        for (size_t a = i0; a <= i1; a++)
            for (size_t b = j0; b <= j1; b++)
                if (a + r == i || a == i + r || b + r == j || b == j + r)
                    best = in_cell(d, a, b, p, best);
    }
    return best;
}
