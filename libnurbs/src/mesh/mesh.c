#include "mesh/mesh.h"

#include "core/error.h"
#include "core/vector.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Vertices within this share of the extent are one: files hold single precision. */
static const double weld_share = 1e-6;

/* Vertices by the cell of a grid in which they lie; chains of equal hash. */
typedef struct weld {
    double cell, low[3];
    size_t buckets;
    size_t *head, *next; /* index plus 1; 0 ends */
    size_t *kept;        /* [vertices] new index */
} weld;

static size_t bucket_of(const weld *w, const int64_t cell[3])
{
    uint64_t h = (uint64_t)cell[0] * 0x9E3779B97F4A7C15u;
    h = (h ^ (uint64_t)cell[1]) * 0xBF58476D1CE4E5B9u;
    h = (h ^ (uint64_t)cell[2]) * 0x94D049BB133111EBu;
    return (size_t)((h ^ (h >> 31)) % w->buckets);
}

/* A vertex that was kept and is near p; none: SIZE_MAX. */
static size_t find_near(const weld *w, const nurbs_mesh *mesh, const double p[3],
                        const int64_t cell[3])
{
    for (int k = 0; k < 27; k++) {
        const int64_t near[3] = {cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1};
        for (size_t i = w->head[bucket_of(w, near)]; i; i = w->next[i - 1])
            if (distance3(mesh->points + 3 * (i - 1), p) <= w->cell)
                return i - 1;
    }
    return SIZE_MAX;
}

static void weld_vertices(nurbs_mesh *mesh, size_t n, const double *points, weld *w)
{
    for (size_t k = 0; k < n; k++) {
        int64_t cell[3];
        const double *p = points + 3 * k;
        for (int c = 0; c < 3; c++)
            cell[c] = (int64_t)floor((p[c] - w->low[c]) / w->cell);
        size_t found = find_near(w, mesh, p, cell);
        if (found == SIZE_MAX) {
            size_t b = bucket_of(w, cell);
            found = mesh->vertices++;
            memcpy(mesh->points + 3 * found, p, 3 * sizeof *p);
            w->next[found] = w->head[b];
            w->head[b] = found + 1;
        }
        w->kept[k] = found;
    }
}

static nurbs_status merge_vertices(nurbs_mesh *mesh, size_t n, const double *points, size_t *kept)
{
    weld w = {.low = {INFINITY, INFINITY, INFINITY}, .buckets = 2 * n + 1, .kept = kept};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < 3 * n; k++) {
        w.low[k % 3] = fmin(w.low[k % 3], points[k]);
        high[k % 3] = fmax(high[k % 3], points[k]);
    }
    mesh->extent = distance3(w.low, high);
    if (!(mesh->extent > 0))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "all vertices coincide");
    w.cell = weld_share * mesh->extent;
    w.head = calloc(w.buckets, sizeof *w.head);
    w.next = malloc(n * sizeof *w.next);
    nurbs_status status = w.head && w.next
                              ? NURBS_OK
                              : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu vertices", n);
    if (status == NURBS_OK)
        weld_vertices(mesh, n, points, &w);
    free(w.head);
    free(w.next);
    return status;
}

static void keep_triangles(nurbs_mesh *mesh, size_t triangles, const size_t *corner,
                           const size_t *kept)
{
    for (size_t k = 0; k < triangles; k++) {
        size_t a = kept[corner[3 * k]], b = kept[corner[3 * k + 1]], c = kept[corner[3 * k + 2]];
        if (a == b || b == c || c == a)
            continue;
        size_t *to = mesh->corner + 3 * mesh->triangles++;
        to[0] = a;
        to[1] = b;
        to[2] = c;
    }
}

static nurbs_status check(size_t vertices, const double *points, size_t triangles,
                          const size_t *corner)
{
    if (!points || !corner || vertices == 0 || triangles == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "a mesh of %zu vertices and %zu triangles",
                          vertices, triangles);
    for (size_t k = 0; k < 3 * vertices; k++)
        if (!isfinite(points[k]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "vertex %zu has a coordinate %g", k / 3,
                              points[k]);
    for (size_t k = 0; k < 3 * triangles; k++)
        if (corner[k] >= vertices)
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "triangle %zu has vertex %zu of %zu", k / 3,
                              corner[k], vertices);
    return NURBS_OK;
}

nurbs_status nurbs_mesh_create(size_t vertices, const double *points, size_t triangles,
                               const size_t *corner, nurbs_mesh **mesh)
{
    if (!mesh)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "mesh is NULL");
    *mesh = NULL;
    nurbs_status status = check(vertices, points, triangles, corner);
    if (status != NURBS_OK)
        return status;
    nurbs_mesh *made = calloc(1, sizeof *made);
    size_t *kept = malloc(vertices * sizeof *kept);
    if (made) {
        made->points = malloc(3 * vertices * sizeof *made->points);
        made->corner = malloc(3 * triangles * sizeof *made->corner);
    }
    if (!made || !kept || !made->points || !made->corner)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu triangles", triangles);
    if (status == NURBS_OK)
        status = merge_vertices(made, vertices, points, kept);
    if (status == NURBS_OK) {
        keep_triangles(made, triangles, corner, kept);
        status = made->triangles ? mesh_connect(made)
                                 : nurbs_fail(NURBS_ERROR_GEOMETRY, "all triangles collapse");
    }
    free(kept);
    if (status == NURBS_OK)
        *mesh = made;
    else
        nurbs_mesh_free(made);
    return status;
}

void nurbs_mesh_free(nurbs_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->points);
    free(mesh->corner);
    free(mesh->side);
    free(mesh->edge);
    free(mesh);
}

size_t nurbs_mesh_vertices(const nurbs_mesh *mesh)
{
    return mesh ? mesh->vertices : 0;
}

size_t nurbs_mesh_triangles(const nurbs_mesh *mesh)
{
    return mesh ? mesh->triangles : 0;
}

const double *nurbs_mesh_points(const nurbs_mesh *mesh)
{
    return mesh ? mesh->points : NULL;
}

const size_t *nurbs_mesh_corners(const nurbs_mesh *mesh)
{
    return mesh ? mesh->corner : NULL;
}
