/* One surface's part in rows of derivatives (tangent/row.h). Of F = Int G c.n - phi dG/dn dS, c
 * what the surface carries as sources, the nodes give what their moves and turns count for. */
#ifndef ROW_LAYER_H
#define ROW_LAYER_H

#include "exterior/layers.h"
#include "tangent/fold.h"

enum row_layer_kind {
    ROW_HULL,    /* phi, and U e_x.n */
    ROW_SURFACE, /* sources alone, as on the strip */
    ROW_STRIP,
    ROW_FACE /* phi and phi_n, both one number a column */
};

/* Nodes with what they carry: columns of one block of memory. */
struct row_nodes {
    struct nodes *nodes; /* borrowed */
    struct hull_nodes hull;
    double *column; /* [ROW_COLUMNS][capacity] */
    size_t capacity;
};

void row_nodes_free(struct row_nodes *row);

/* Columns of nodes that carry phi: the area vector A, c and phi times the area over |A| (of unit
 * parameters), c.A and phi. */
enum row_column {
    ROW_AX,
    ROW_AY,
    ROW_AZ,
    ROW_CX,
    ROW_CY,
    ROW_CZ,
    ROW_Q,
    ROW_PHI,
    ROW_PHI_PART,
    ROW_GENERAL_COLUMNS
};

/* What kernels leave at such a node: G, A.dG, and what its move and h count for (tangent/fold.h).
 */
enum row_kernel { ROW_G, ROW_D, ROW_PLACE, ROW_TURN = ROW_PLACE + 3, ROW_KERNELS = ROW_TURN + 3 };

/* Nodes first to end, from block on, and their columns, [columns][n]: the rules of a panel lie
 * together. */
struct row_stretch {
    const struct nodes *nodes;
    const struct hull_nodes *hull;
    size_t first, end, n, block;
    double *column;
};

struct row_layer {
    enum row_layer_kind kind;
    double speed; /* of the stream through the layer */
    const igabem_tangent *tangent;
    const struct shape *shape;
    struct layer_surface surface;
    double *strength;   /* coefficients of phi or, on the free surface, of what it carries */
    struct nodes nodes; /* of all far rules */
    struct row_nodes far;
    size_t *node, *block; /* first of each rule, and their number */
};

/* strength: taken over, also after an error. */
igabem_status row_layer_create(const igabem_tangent *tangent, const struct shape *shape,
                               enum row_layer_kind kind, const struct influence *influence,
                               double speed, double *strength, struct row_layer *layer);
void row_layer_free(struct row_layer *layer);

/* The nodes of a far rule; of nodes of one's own, whose columns are filled (false: no memory). */
struct row_stretch row_layer_rule(const struct row_layer *layer, size_t rule);
bool row_layer_own(const struct row_layer *layer, struct nodes *nodes, struct row_nodes *row,
                   struct row_stretch *stretch);
/* Turns the kernels of nodes, [kernels][n], into what the numbers count for. */
void row_layer_fold(const struct row_layer *layer, const struct row_stretch *stretch,
                    const double *kernel, double *numbers);

struct row_layer_work {
    struct layer_work layer;
    struct row_nodes near;
    double *kernel;
    size_t capacity;
};

bool row_layer_work_create(const struct row_layer *layer, struct row_layer_work *work);
void row_layer_work_free(struct row_layer_work *work);

/* Adds the layer to the row of a point: to the control values of the hull's elements, of other
 * surfaces to the numbers of struct shape; single (free surface and strip): Int G B_j dS; *turn:
 * what the point's own move along y counts for. false: no memory. */
bool row_layer_add(const struct row_layer *layer, const struct layer_point *point,
                   struct row_layer_work *work, double *single, double *numbers, double *turn);

/* What the move of a place of a cell of free surface or strip counts for. */
void row_layer_place(const struct row_layer *layer, size_t cell, const double local[2],
                     double place, double *numbers);

#endif
