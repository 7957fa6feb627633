/* Sums of the local part of the Green function, Sum q N_X, over many sources for many points of the
 * still water: a binary tree of pieces whose far nodes are replaced by a few equivalent sources
 * (Lagrange interpolation in the source point on Chebyshev nodes; Wang, Krasny and Tlupova 2020).
 */
#ifndef WAVE_TREE_H
#define WAVE_TREE_H

#include "result/wave_pieces.h"

struct wave_tree;

/* Borrows pieces; their sources at the resolution of the waves are in set, piece i from first[i] to
 * first[i+1]. */
igabem_status wave_tree_create(const struct wave_pieces *pieces, const struct point_set *set,
                               const size_t *first, struct wave_tree **tree);
void wave_tree_free(struct wave_tree *tree);

/* The pieces that a line x cuts, with their sources divided there; shared by all points of the
 * line.
 */
struct wave_cut {
    struct point_set set;
    size_t *first, *last; /* [pieces] range in the set; empty where the line does not cut */
};

/* Makes room for the pieces; frees. */
igabem_status wave_cut_create(size_t pieces, struct wave_cut *cut);
void wave_cut_free(struct wave_cut *cut);

/* Fills the cut of the line x; returns 0 when out of memory. */
int wave_cut_line(const struct wave_pieces *pieces, double x, struct wave_cut *cut);

/* Sum q N_X(k0 (x - xi), k0 (y - eta), k0 zeta) over all sources and, when symmetric, their mirror
 * images. Pieces that x cuts come from cut, those near the point are integrated anew; scratch is
 * reused between calls of one thread. */
igabem_status wave_tree_local(const struct wave_tree *tree, const struct wave_cut *cut, double k0,
                              int symmetric, double x, double y, struct point_set *scratch,
                              double *sum);

#endif
