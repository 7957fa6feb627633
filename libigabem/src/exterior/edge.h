/* Edges of a half hull as functions of one coordinate: the waterline over x, the rim of a transom
 * over y. */
#ifndef EDGE_H
#define EDGE_H

#include "space/density.h"

struct edge_point {
    double at[3]; /* |y| in place of y */
    size_t patch;
    double uv[2];
};

struct edge {
    int key;  /* the coordinate: 0 or 1 */
    size_t n; /* points by increasing coordinate; 0: none of its kind */
    struct edge_point *point;
    double first, last; /* of the coordinate */
};

/* All edges of a kind; length: of the hull, the scale of rounding. Errors:
 * IGABEM_ERROR_GEOMETRY: one turns back in the coordinate. */
igabem_status edge_create(const struct density *density, enum hull_edge kind, int key,
                          double length, struct edge *edge);
void edge_free(struct edge *edge);

/* The point at a coordinate, which is taken into the range; nothing without points. */
void edge_at(const struct edge *edge, double coordinate, double at[3]);

/* The point at or before a coordinate, not the very last, and where the coordinate lies between
 * that and the next: in [0,1]. */
const struct edge_point *edge_before(const struct edge *edge, double coordinate, double *share);

/* Patch and parameters there. */
igabem_status edge_locate(const struct edge *edge, const struct density *density, double coordinate,
                          size_t *patch, double uv[2]);

#endif
