/* The space of the source density: every patch of the hull elevated to the least degree asked for
 * and refined, so that shape and density share one (rational) basis. Unknowns are numbered patch by
 * patch, u slow and v fast; one collocation point per unknown. */
#ifndef DENSITY_H
#define DENSITY_H

#include "hull.h"

#include <igabem/solve.h>

struct density_patch {
    nurbs_surface *surface; /* owned; same shape and parameters as the hull's patch */
    struct hull_patch hull; /* sign, domain and edges; its surface is the one above */
    int degree[2];
    size_t size[2];
    size_t offset;       /* first unknown */
    double *breaks[2];   /* distinct knots, spans[d] + 1 each */
    size_t spans[2];     /* knot spans of positive length */
    double *abscissa[2]; /* collocation parameters, size[d] each */
};

struct density {
    size_t patches;
    struct density_patch *patch;
    size_t n;         /* unknowns = collocation points */
    int symmetric;    /* the mirror image in y radiates too */
    double *point;    /* [n][3] collocation points */
    double *normal;   /* [n][3] outward unit normals there */
    size_t *owner;    /* [n] patch of a collocation point */
    double (*uv)[2];  /* [n] its parameters */
    double (*jet)[6]; /* [n] Su, Sv there */
};

/* Creates the space; copies what it needs of the hull. refine[2] >= 1 parts per span. */
igabem_status density_create(const igabem_hull *hull, int degree, const int refine[2],
                             struct density **density);
void density_free(struct density *density);

/* Coefficients of the fields (fields x n values at the collocation points, each field contiguous)
 * in the basis: replaces values by coefficients. */
igabem_status density_interpolate(const struct density *density, size_t fields, double *values);

/* Values of `fields` fields given by coefficients (each field contiguous, n values) at m parameters
 * of a patch: fills out[m][fields]. */
igabem_status density_evaluate(const struct density *density, size_t patch, size_t fields,
                               const double *coefficients, size_t m, const double *uv, double *out);

#endif
