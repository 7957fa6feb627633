/* The space of the source density on the patches of a hull, unknowns numbered patch by patch, u
 * slow and v fast, one collocation point per unknown. By default the basis is the hull's own: its
 * NURBS, elevated to the least degree asked for and refined. Alternatively it is a polynomial
 * spline of the same degree on uniform knots (graded where they would crowd at the waterline), over
 * the parameters of the hull but free of its knots: knots that follow the shape from one design to
 * the next make the error of the resistance follow too. */
#ifndef DENSITY_H
#define DENSITY_H

#include "hull/hull.h"

#include <igabem/solve.h>

struct density_patch {
    nurbs_surface *surface; /* owned; the hull's patch with all breaks below among its knots */
    struct hull_patch hull; /* sign, domain and edges; its surface is the one above */
    int degree[2];          /* of shape and density */
    size_t size[2];         /* functions of the density */
    double *knots[2];       /* of the density, size[d] + degree[d] + 1 each */
    const double *weights;  /* of the density's functions, borrowed; NULL: polynomial */
    size_t offset;          /* first unknown */
    double *breaks[2];      /* ends of the elements: knots of shape or density, spans[d] + 1 each */
    size_t spans[2];
    double *panel_breaks[2]; /* ends of the panels: knots of the density, and lines of C0 shape */
    size_t panels[2];
    double *abscissa[2]; /* collocation parameters, size[d] each */
};

struct density {
    size_t patches;
    struct density_patch *patch;
    size_t n;         /* unknowns = collocation points */
    bool symmetric;   /* the mirror image in y radiates too */
    double *point;    /* [n][3] collocation points */
    double *normal;   /* [n][3] outward unit normals there */
    size_t *owner;    /* [n] patch of a collocation point */
    double (*uv)[2];  /* [n] its parameters */
    double (*jet)[6]; /* [n] Su, Sv there */
};

/* Pairs: along the hull and around it; a patch takes its share, whatever its u and v are. */
struct density_rule {
    int degree;      /* least */
    int refine[2];   /* parts of each span of the hull's knots, >= 1 */
    int elements[2]; /* uniform spans, 0: the hull's own, refined; both 0: the hull's own basis */
    double waterline_span; /* least width of own spans at the waterline, share of the girth */
};

/* Creates the space; copies what it needs of the hull. */
igabem_status density_create(const igabem_hull *hull, const struct density_rule *rule,
                             struct density **density);
void density_free(struct density *density);

/* A surface with the degrees and knots of the hull's patch, its control points any others, in the
 * representation of the density's surface of that patch. */
igabem_status density_conform(const struct density *density, size_t patch,
                              const nurbs_surface *surface, nurbs_surface **result);

/* Coefficients of the fields (fields x n values at the collocation points, each field contiguous)
 * in the basis: replaces values by coefficients. */
igabem_status density_interpolate(const struct density *density, size_t fields, double *values);

/* Values of `fields` fields given by coefficients (each field contiguous, n values) at m parameters
 * of a patch: fills out[m][fields]. */
igabem_status density_evaluate(const struct density *density, size_t patch, size_t fields,
                               const double *coefficients, size_t m, const double *uv, double *out);

#endif
