/* How the velocities of given sources change at the collocation points while the hull moves, part
 * by part of the Green function (influence.h). */
#ifndef CHANGE_H
#define CHANGE_H

#include "influence/influence.h"
#include "tangent/moving.h"

/* The regular rules of the panels as moving nodes, filled where they are in use. They are shared by
 * points and have few nodes, which keep their changes along the fields for themselves. */
struct rule {
    bool used;
    size_t n;
    double *x, *y, *z; /* owned as one; NULL: not filled */
    double *strength;
    double *change; /* [n][2][width]: of the strength; the strength times the move */
};

struct rules {
    size_t n;
    struct rule *rule; /* [panel][class along u][class along v] */
};

/* What the parts have in common. Velocities are [unknowns][3][fields]. */
struct change {
    const igabem_tangent *tangent;
    const struct influence *influence;
    const double *bernstein; /* of moving_density() */
    struct rules *rules;
};

/* Adds the change of the principal value of -1/r and, image[i] times in row i, of +1/r'. */
igabem_status change_rankine(const struct change *change, const double *image, double *velocity);

/* Adds that of k0 N, of surface sources and of the waterline (NULL: none), weight[i] times in row
 * i. */
igabem_status change_local(const struct change *change, const struct line *line,
                           const double *weight, double *velocity);

/* The same of k0 W with the filter of the solution. */
igabem_status change_wave(const struct change *change, const struct line *line,
                          const double *weight, double *velocity);

igabem_status rules_create(const struct influence *influence, struct rules **rules);
void rules_free(struct rules *rules);
struct rule *rules_of(const struct rules *rules, size_t panel, const int class[2]);
/* Fills those in use; false: no memory. */
bool rules_fill(const struct change *change, struct rules *rules);

/* Kernels at nodes, [3][n] each: k, its derivative with respect to y of the place that the source
 * is seen from, and with respect to y of the point itself, which an image turns round. */
struct kernels {
    double *k, *slope, *turned;
    size_t n, capacity;
};

/* Room for n nodes, all 0; false: no memory. */
bool kernels_clear(struct kernels *kernels, size_t n);
void kernels_free(struct kernels *kernels);

/* Adds to out[3][fields] what the moves of the nodes change, and to turn[3] what the point's own
 * move is to be multiplied by. */
void kernels_sum(const struct kernels *kernels, const struct field *field,
                 const struct nodes *nodes, const struct moving *moving, double *out,
                 double turn[3]);
/* The same over the nodes of a rule. */
void kernels_sum_rule(const struct kernels *kernels, const struct field *field,
                      const struct rule *rule, double *out, double turn[3]);

#endif
