/* What is known of a latent point before it is built: its displacement, and whether it crosses the
 * centre plane. Cheap enough to be asked thousands of times per proposal. */
#ifndef HULLOPT_LIMITS_H
#define HULLOPT_LIMITS_H

#include "design.h"
#include "latent.h"

#include <stdbool.h>
#include <stddef.h>

struct limits {
    const struct latent *latent;
    const nurbs_grid *parent;
    double *gradient;     /* of the volume ratio in u when the displacements are along y alone; else
                             NULL     and the volume of the moved grid is taken */
    double parent_volume; /* of the grid, when gradient is NULL */
};

/* gradient: as limits_gradient() found it earlier, copied; NULL: not linear. */
bool limits_create(const struct latent *latent, const nurbs_grid *parent, const double *gradient,
                   struct limits *limits);
void limits_free(struct limits *limits);

/* Points that move along y alone leave the projection of the hull on the centre plane as it is, so
 * the volume is linear in u but for the parametrisation of the skin. Fills gradient[modes] with the
 * central differences of the volume ratio of built hulls; false when points move in x or z. */
bool limits_gradient(const struct latent *latent, const struct parent *parent, double tolerance,
                     double *gradient);

/* Volume over that of the parent. NAN when memory runs out. */
double limits_volume_ratio(const struct limits *limits, const double *u);

/* What becomes of the half breadths of the grid. */
struct limits_breadth {
    double least_y; /* m; negative: across the centre plane */
    double
        least_share; /* over the points below z = 0 and off the centre plane: y over the parent's */
};
struct limits_breadth limits_breadth(const struct limits *limits, const double *u);

#endif
