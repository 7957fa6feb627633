/* A solution cut into pieces that radiate: the elements of its surface and those of its waterline,
 * each with rules that put point sources on it. Rules can refine towards a point and can cut a
 * piece along x = x_P, where the local and the wave part of the Green function jump. */
#ifndef ELEVATION_PIECES_H
#define ELEVATION_PIECES_H

#include "solve/solution.h"
#include "space/element.h"

/* Point sources: strength q, m^3/s. */
struct point_set {
    size_t n, room;
    double *x, *y, *z, *q;
};

bool point_set_add(struct point_set *set, double x, double y, double z, double q);
void point_set_clear(struct point_set *set);
void point_set_free(struct point_set *set);

struct elevation_piece {
    const struct element *element;
    int edge;                            /* -1: surface; else the HULL_ edge that is a waterline */
    double sigma[ELEMENT_FUNCTIONS];     /* Bernstein coefficients of the density */
    double lower[3], upper[3], diagonal; /* bounds of the sources */
    int parts[2];                        /* divisions that resolve the waves */
};

struct elevation_pieces {
    const igabem_solution *solution;
    struct mesh *mesh;
    size_t n;
    struct elevation_piece *piece;
    double t_max; /* largest wave angle that the rules resolve */
};

igabem_status elevation_pieces_create(const igabem_solution *solution, double t_max,
                                      struct elevation_pieces **pieces);
void elevation_pieces_free(struct elevation_pieces *pieces);

/* Adds the sources of a piece at the resolution of the waves. x_cut inside the piece divides every
 * rule there; NAN: no cut. Returns 0 when out of memory. */
bool elevation_piece_sources(const struct elevation_pieces *pieces, size_t index, double x_cut,
                             struct point_set *set);

/* The same, refined until every rule is far from the point (x, y, 0) for its size, and cut at x. */
bool elevation_piece_near_sources(const struct elevation_pieces *pieces, size_t index, double x,
                                  double y, struct point_set *set);

/* Distance from (x, y, 0) to the bounds of a piece. */
double elevation_piece_distance(const struct elevation_piece *piece, double x, double y);

#endif
