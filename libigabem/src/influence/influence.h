/* Velocity that unit density coefficients induce at the collocation points, part by part of the
 * Green function. A part is an array v[n][3][n]: collocation point, component, unknown; principal
 * values, without the jump sigma/2 n. Velocities are grad of the part divided by 4 pi:
 *     rankine   -1/r,    image   +1/r'    (both with the mirror images in y),
 *     local     k0 N,    wave    k0 W. */
#ifndef INFLUENCE_H
#define INFLUENCE_H

#include "core/progress.h"
#include "influence/filter_change.h"
#include "space/line.h"

enum { REGULAR_CLASSES = 4, REGULAR_MOST = 6 + ELEMENT_SIDE / 2 };

/* A tensor Gauss rule on one panel with the basis folded in: f[node][function]. */
struct regular_rule {
    size_t n;
    double *x, *y, *z, *f;
    double *normal[3], *area; /* outward unit normals and area of the nodes */
};

struct influence {
    const struct density *density;
    const struct mesh *mesh;
    struct gauss gauss;
    double tolerance; /* absolute, of one panel's influence; relative, of the wave part */
    double (*centre)[3], (*half)[2], (*box)[2]; /* of the panels; box: bounds of x */
    struct regular_rule *regular;               /* [panel][class along u][class along v] */
    double (*shape_error)[2][REGULAR_CLASSES]; /* of the panels: largest error, m^2, of the integral
                                                  of a basis function by the rule of a class along
                                                  one direction */
    double *storage;
    int threads;
    struct igabem_cost *cost;  /* where the integrals add their work; NULL: nowhere */
    struct progress *progress; /* told of each row of the stage at work; NULL: nobody listens */
};

igabem_status influence_create(const struct density *density, const struct mesh *mesh,
                               double tolerance, int threads, struct influence **influence);
void influence_free(struct influence *influence);

/* Adds the work of one thread; not to be called by two at once. */
void influence_count(const struct influence *influence, const struct igabem_cost *cost);

/* Raises class[2] to the rules that a panel needs to be seen from the rule's point, or returns 0 if
 * none is fine enough: the kernel is too close to its singularity, or the panel's shape too uneven.
 */
bool regular_class(const struct influence *influence, size_t panel, const struct near_rule *rule,
                   int class[2]);

const struct regular_rule *regular_rule_of(const struct influence *influence, size_t panel,
                                           const int class[2]);

/* Appends the nodes of that rule, element by element. */
void regular_nodes(const struct influence *influence, size_t panel, const int class[2],
                   struct nodes *nodes);

/* Adds sum_node k[c * stride + node] f[node][.] to rows[c * row_stride + unknown], c < fields. */
void regular_scatter(const struct element *element, const struct regular_rule *rule, size_t fields,
                     const double *k, size_t stride, double *rows, size_t row_stride);

/* Whether the element's closure contains a collocation point; its local parameters there. */
bool element_contains(const struct density *density, const struct element *element, size_t point,
                      double local[2]);

/* Fills rankine and image; without image (NULL), adds image_weight[i] times its row i to rankine
 * (both NULL: not wanted). */
igabem_status influence_rankine(const struct influence *influence, double *rankine, double *image,
                                const double *image_weight);

/* Adds weight[i] (NULL: 1) times row i of the local part of surface sources; rows with weight 0
 * cost nothing. */
igabem_status influence_local(const struct influence *influence, double k0, const double *weight,
                              double *rows);

/* Adds the local part of the waterline sources. */
igabem_status influence_local_line(const struct influence *influence, const struct line *line,
                                   double k0, const double *weight, double *rows);

/* Adds the wave part of surface sources and, unless line is NULL, of waterline sources, with the
 * filter of cutoff[0] (INFINITY: none). Creates the operator of what the further filters, two at
 * most, change in the component along the normal of the point (filters 1: NULL). */
igabem_status influence_wave(const struct influence *influence, const struct line *line, double k0,
                             size_t filters, const double *cutoff, const double *weight,
                             double *rows, struct filter_change **change);

#endif
