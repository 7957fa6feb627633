/* Sums of the local part of the Green function, Sum q N_X, over many sources for many points of the
 * still water: a binary tree of pieces whose far nodes are replaced by a few equivalent sources
 * (Lagrange interpolation in the source point on Chebyshev nodes; Wang, Krasny and Tlupova 2020).
 */
#ifndef ELEVATION_TREE_H
#define ELEVATION_TREE_H

#include "result/elevation_pieces.h"

struct elevation_tree;

/* Borrows pieces; their sources at the resolution of the waves are in set, piece i from first[i] to
 * first[i+1]. */
igabem_status elevation_tree_create(const struct elevation_pieces *pieces,
                                    const struct point_set *set, const size_t *first,
                                    struct elevation_tree **tree);
void elevation_tree_free(struct elevation_tree *tree);

/* The pieces that a line x cuts, with their sources divided there; shared by all points of the
 * line.
 */
struct elevation_cut {
    struct point_set set;
    size_t *first, *last; /* [pieces] range in the set; empty where the line does not cut */
};

/* Makes room for the pieces; frees. */
igabem_status elevation_cut_create(size_t pieces, struct elevation_cut *cut);
void elevation_cut_free(struct elevation_cut *cut);

/* Fills the cut of the line x; returns 0 when out of memory. */
bool elevation_cut_line(const struct elevation_pieces *pieces, double x, struct elevation_cut *cut);

/* Sum q N_X(k0 (x - xi), k0 (y - eta), k0 zeta) over all sources and, when symmetric, their mirror
 * images. Pieces that x cuts come from cut, those near the point are integrated anew; scratch is
 * reused between calls of one thread. */
igabem_status elevation_tree_local(const struct elevation_tree *tree,
                                   const struct elevation_cut *cut, double k0, bool symmetric,
                                   double x, double y, struct point_set *scratch, double *sum);

#endif
