/* Pieces of elements and the quadrature nodes on them.
 *
 * A domain is a part of an element with its own coordinates (a, b) in [0,1]^2: the whole element,
 * or, for kernels that are only smooth on either side of the plane x = x_P, the part ahead of or
 * behind that plane. A cell is a rectangle of a domain. */
#ifndef CELL_H
#define CELL_H

#include "space/element.h"

enum { GAUSS_MAX = 16 };

/* Gauss-Legendre rules on [0,1] of 1 to GAUSS_MAX points, row n for n points. */
struct gauss {
    double node[GAUSS_MAX + 1][GAUSS_MAX], weight[GAUSS_MAX + 1][GAUSS_MAX];
};

igabem_status gauss_fill(struct gauss *gauss);

enum domain_part { DOMAIN_WHOLE, DOMAIN_LOW, DOMAIN_HIGH };

struct domain {
    const struct element *element;
    int along;             /* coordinate a runs along this direction of the element, b across */
    double across[2];      /* range of the other local parameter */
    enum domain_part part; /* along: all of [0,1], [0, root] or [root, 1] where x(root) = x */
    double x;
    bool ahead; /* lies at larger x than the plane (set by domain_cut) */
};

void domain_whole(const struct element *element, struct domain *domain);

enum { DOMAIN_PIECES = 4 * ELEMENT_SIDE + 2 };

/* Divides an element along the plane x = const; returns the number of pieces. x must be monotone
 * along one direction of the element, as it is on a hull. */
size_t domain_cut(const struct element *element, double x, struct domain pieces[DOMAIN_PIECES]);

/* Parameters in (0,1) where the edge of an element at which local parameter `fixed` is 0 (end 0) or
 * 1 (end 1) crosses the plane; fills roots (increasing), returns their number. */
size_t edge_roots(const struct element *element, int fixed, int end, double x,
                  double roots[ELEMENT_SIDE]);

/* Points of the domain on the grid a x b of its coordinates: fills points[na * nb], a slow. */
void domain_grid(const struct domain *domain, size_t na, const double *a, size_t nb,
                 const double *b, double (*points)[3]);

/* Quadrature nodes with everything that an integral against the basis needs; nodes of one element
 * are consecutive and make a block. */
struct block {
    const struct element *element;
    size_t begin, end;
};

struct nodes {
    size_t n, capacity, blocks, block_capacity;
    size_t side[2];    /* row lengths of bu and bv */
    double *x, *y, *z; /* positions, m */
    double *g;         /* weight times area element over the homogeneous weight, m^2 */
    double *bu, *bv;   /* Bernstein polynomials in the two local parameters */
    bool with_normals; /* set before the first node: fill the next array */
    double *normal;    /* [n][3] outward unit normals; on a waterline nu_x, length, 0 */
    bool with_jets;    /* likewise */
    double *jet;       /* [n][6] derivatives of the position along the two local parameters */
    struct block *block;
    bool failed; /* memory ran out: contents incomplete */
};

void nodes_init(struct nodes *nodes, const struct mesh *mesh);
void nodes_clear(struct nodes *nodes);
void nodes_free(struct nodes *nodes);

/* Makes room for m nodes of an element and returns the index of the first, or SIZE_MAX. */
size_t nodes_append(struct nodes *nodes, const struct element *element, size_t m);

/* Tensor Gauss rule n[0] (along a) x n[1] (along b) on the rectangle rect[0..1] x rect[2..3]. */
void cell_nodes(const struct domain *domain, const double rect[4], const int n[2],
                const struct gauss *gauss, struct nodes *nodes);

/* One node at the local parameters (s, t) with the weight given there (of ds dt). */
void point_node(const struct element *element, double s, double t, double weight,
                struct nodes *nodes);

/* Centre of a cell, and of its middle lines along a and b half the length, the chord and the second
 * difference of ends and centre. */
struct cell_extent {
    double centre[3], half[2], chord[2], bend[2];
};

void cell_extent(const struct domain *domain, const double rect[4], struct cell_extent *extent);

/* Strength of every node for a unit coefficient of each spline function of its element: fills
 * f[node][function], one row length for all, so the elements must have equal degrees. */
void nodes_fold(const struct nodes *nodes, double *f);

/* Stores the derivatives of a jet, where they are wanted. */
void nodes_jet(struct nodes *nodes, size_t node, const struct jet *jet);

/* Local parameters of a node, by the linear precision of Bernstein polynomials. */
void nodes_local(const struct nodes *nodes, const struct element *element, size_t node,
                 double local[2]);

/* Sum of Bernstein coefficients of its element, `step` apart, at a node; the homogeneous weight. */
double nodes_value(const struct nodes *nodes, const struct element *element, size_t node,
                   const double *coefficients, size_t step);
double nodes_weight(const struct nodes *nodes, const struct element *element, size_t node);

/* Integrals of `fields` kernels (values k[f * stride + node]) over the blocks against the spline
 * basis, added to rows[f * row_stride + unknown]. */
void nodes_scatter(const struct nodes *nodes, size_t fields, const double *k, size_t stride,
                   double *rows, size_t row_stride);

#endif
