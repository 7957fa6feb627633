/* The object behind nurbs_mesh. */
#ifndef NURBS_MESH_OBJECT_H
#define NURBS_MESH_OBJECT_H

#include <nurbs/mesh.h>

/* Edge from the smaller to the larger vertex, with up to two triangles beside it. */
typedef struct mesh_edge {
    size_t vertex[2];
    size_t triangle[2];
    size_t count; /* of triangles; may be more than two */
} mesh_edge;

struct nurbs_mesh {
    size_t vertices, triangles, edges;
    double *points;
    size_t *corner; /* 3 a triangle */
    size_t *side;   /* 3 a triangle: the edge from corner k to k + 1 */
    mesh_edge *edge;
    double extent; /* diagonal of the bounding box */
};

/* Fills edges and sides, turns neighbours alike and pieces outwards. */
nurbs_status mesh_connect(nurbs_mesh *mesh);

/* As nurbs_mesh_section(), where a function with these values at the vertices is zero: a curved
 * sheet. */
nurbs_status mesh_section_at(const nurbs_mesh *mesh, const double *height, nurbs_contour *contour);

#endif
