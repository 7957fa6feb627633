/* Proof that no point of a Bezier patch is nearer to a point than one already found, or a nearer
 * one.
 */
#ifndef NURBS_CLOSEST_PROOF_H
#define NURBS_CLOSEST_PROOF_H

#include "closest/closest.h"

/* Cells looked at for one point before the search settles for the best found. */
enum { CLOSEST_CELLS = 20000 };

/* A Bezier patch in homogeneous form, (order[0] x order[1]) rows of 4, and its parameters. A curve
 * has order[1] = 1. */
struct bezier_patch {
    size_t order[2];
    const double *net;
    size_t stride; /* doubles between rows of the net */
    struct box2 box;
};

/* Local minimum of the squared distance inside a box of parameters, from uv (replaced). */
typedef double (*closest_search)(const void *context, const struct box2 *box, const double point[3],
                                 double uv[2]);

/* Given the best squared distance so far and its place, which include a local minimum of this
 * patch, improves them to the least over the patch. Work is limited by *cells, which is counted
 * down; at 0 the result is the best found. */
double closest_prove(const struct bezier_patch *patch, const double point[3], closest_search search,
                     const void *context, double best, double uv[2], size_t *cells);

#endif
