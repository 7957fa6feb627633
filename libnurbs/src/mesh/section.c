/* Plane sections of a mesh. */
#include "core/error.h"
#include "core/vector.h"
#include "mesh/mesh.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Every triangle that the plane cuts joins two of its edges; an edge has up to two such links. */
typedef struct cut {
    const nurbs_mesh *mesh;
    const double *height;   /* [vertices] over the plane */
    size_t (*link)[2];      /* [edges] the edges next along the line; SIZE_MAX: none */
    unsigned char *visited; /* [edges] */
    nurbs_contour *contour;
    size_t points, point_room, line_room;
} cut;

static bool is_cut(const cut *c, size_t edge)
{
    const mesh_edge *e = &c->mesh->edge[edge];
    return (c->height[e->vertex[0]] >= 0) != (c->height[e->vertex[1]] >= 0);
}

static void join(cut *c, size_t from, size_t to)
{
    size_t *link = c->link[from];
    if (link[0] == SIZE_MAX)
        link[0] = to;
    else if (link[1] == SIZE_MAX)
        link[1] = to;
}

static void find_links(cut *c)
{
    for (size_t t = 0; t < c->mesh->triangles; t++) {
        size_t pair[3], n = 0;
        for (size_t k = 0; k < 3; k++)
            if (is_cut(c, c->mesh->side[3 * t + k]))
                pair[n++] = c->mesh->side[3 * t + k];
        if (n == 2) {
            join(c, pair[0], pair[1]);
            join(c, pair[1], pair[0]);
        }
    }
}

static nurbs_status grow(size_t wanted, size_t *room, size_t size, void **array)
{
    if (wanted <= *room)
        return NURBS_OK;
    size_t more = *room ? 2 * *room : 64;
    void *larger = realloc(*array, more * size);
    if (!larger)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu points", more);
    *array = larger;
    *room = more;
    return NURBS_OK;
}

/* The place where the plane meets an edge; one that repeats the last point is passed over. */
static nurbs_status add_point(cut *c, size_t edge, bool first)
{
    const mesh_edge *e = &c->mesh->edge[edge];
    const double *a = c->mesh->points + 3 * e->vertex[0], *b = c->mesh->points + 3 * e->vertex[1],
                 ha = c->height[e->vertex[0]], hb = c->height[e->vertex[1]];
    double p[3], d[3];
    void *points = c->contour->points;
    nurbs_status status = grow(c->points + 1, &c->point_room, 3 * sizeof *p, &points);
    c->contour->points = points;
    if (status != NURBS_OK)
        return status;
    minus3(b, a, d);
    along3(a, ha / (ha - hb), d, p);
    if (!first && distance3(p, c->contour->points + 3 * (c->points - 1)) <= 1e-12 * c->mesh->extent)
        return NURBS_OK;
    memcpy(c->contour->points + 3 * c->points++, p, sizeof p);
    return NURBS_OK;
}

/* From an edge on, to the end of the line or back to where it began. */
static nurbs_status follow(cut *c, size_t start)
{
    nurbs_contour *contour = c->contour;
    size_t first = c->points, at = start, before = SIZE_MAX;
    void *list = contour->first;
    nurbs_status status = grow(contour->lines + 2, &c->line_room, sizeof *contour->first, &list);
    contour->first = list;
    while (status == NURBS_OK && at != SIZE_MAX && !c->visited[at]) {
        c->visited[at] = 1;
        status = add_point(c, at, at == start);
        size_t next = c->link[at][0] != before || at == start ? c->link[at][0] : c->link[at][1];
        if (next == before && at != start)
            next = SIZE_MAX;
        before = at;
        at = next;
    }
    if (status == NURBS_OK && at == start)
        status = add_point(c, start, false);
    if (status != NURBS_OK)
        return status;
    if (c->points - first < 2) {
        c->points = first; /* a touch */
        return NURBS_OK;
    }
    contour->first[contour->lines++] = first;
    contour->first[contour->lines] = c->points;
    return NURBS_OK;
}

/* Open lines first, from their ends; what is left is closed. */
static nurbs_status follow_all(cut *c)
{
    nurbs_status status = NURBS_OK;
    for (int closed = 0; closed < 2; closed++)
        for (size_t k = 0; k < c->mesh->edges && status == NURBS_OK; k++)
            if (!c->visited[k] && is_cut(c, k) && (closed || c->link[k][1] == SIZE_MAX))
                status = follow(c, k);
    return status;
}

nurbs_status mesh_section_at(const nurbs_mesh *mesh, const double *height, nurbs_contour *contour)
{
    *contour = (nurbs_contour){0};
    cut c = {.mesh = mesh,
             .height = height,
             .link = malloc(mesh->edges * sizeof *c.link),
             .visited = calloc(mesh->edges, 1),
             .contour = contour};
    nurbs_status status = NURBS_OK;
    if (!c.link || !c.visited)
        status =
            nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu edges", mesh->edges);
    if (status == NURBS_OK) {
        memset(c.link, 0xff, mesh->edges * sizeof *c.link);
        find_links(&c);
        status = follow_all(&c);
    }
    if (status == NURBS_OK && !contour->first) {
        contour->first = calloc(1, sizeof *contour->first);
        if (!contour->first)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section");
    }
    free(c.link);
    free(c.visited);
    if (status != NURBS_OK)
        nurbs_contour_free(contour);
    return status;
}

nurbs_status nurbs_mesh_section(const nurbs_mesh *mesh, const double normal[3], double offset,
                                nurbs_contour *contour)
{
    if (!mesh || !normal || !contour)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no mesh, normal or contour");
    *contour = (nurbs_contour){0};
    double n[3] = {normal[0], normal[1], normal[2]}, length = unit3(n);
    if (!(length > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "a plane without normal");
    double *height = malloc((mesh->vertices + 1) * sizeof *height);
    if (!height)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section of %zu vertices",
                          mesh->vertices);
    for (size_t k = 0; k < mesh->vertices; k++)
        height[k] = dot3(mesh->points + 3 * k, n) - offset / length;
    nurbs_status status = mesh_section_at(mesh, height, contour);
    free(height);
    return status;
}
