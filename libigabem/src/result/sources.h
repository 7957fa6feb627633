/* A solved density as point sources: the nodes of a quadrature rule fine enough for the amplitudes
 * of waves up to a given angle. Shallow elements are divided until one piece sees at most a few
 * radians of phase and a few units of decay at every angle that still counts at its depth. */
#ifndef SOURCES_H
#define SOURCES_H

#include <igabem/solve.h>

struct sources {
    bool symmetric; /* every source has a mirror image in y that is not listed */
    size_t n;       /* surface sources, ordered by increasing depth */
    double *x, *y, *z;
    double *strength;        /* sigma times area, m^3/s */
    double *dipole[3];       /* of a potential: phi n times area, m^4/s, and strength is U n_x times
                                area; else NULL */
    double *area;            /* weight times area element, m^2: sum is the wetted area */
    double *normal[3];       /* outward unit normal */
    double *velocity[3];     /* grad phi there, m/s; NULL if the formulation has none */
    size_t n_line;           /* waterline sources, z = 0 */
    double *line_x, *line_y; /* m */
    double *line_strength;   /* -(1/k0) chi sigma n_x nu_x times length, m^3/s */
    double *line_dipole;     /* of a potential: phi nu_x length/k0, m^4/s, and line_strength is
                                -phi_x nu_x length/k0; else NULL */
    double *line_length;     /* weight times length, m */
    double *line_nu_x;       /* x component of the horizontal normal of the waterline */
    double *line_velocity[3]; /* grad phi on the waterline, m/s, or NULL */
};

/* Wave angles up to t_max at wave number k0 (k0 = 0: no waves, plain rule). No element lies on both
 * sides of a plane x = cut[i] unless an earlier one crosses it too. */
struct source_rule {
    double k0, t_max;
    size_t cuts;
    const double *cut;
};

/* sigma: coefficients of the density, NULL for those of the solution. */
igabem_status sources_create(const igabem_solution *solution, const struct source_rule *wanted,
                             const double *sigma, struct sources **sources);
/* Adds m surface sources of a potential, and l of its waterline: columns of x, y, z, strength and
 * dipole[3], and of x, y, strength and dipole; the surface stays ordered by depth. Only what
 * radiates is filled. */
igabem_status sources_append(struct sources *sources, size_t m, const double (*surface)[7],
                             size_t l, const double (*line)[4]);

void sources_free(struct sources *sources);

#endif
