/* What a solve leaves behind; everything after it (resistance, waves, pressure) reads this. */
#ifndef SOLUTION_H
#define SOLUTION_H

#include "space/density.h"

struct igabem_solution {
    igabem_options options;                    /* as used: no NAN, no automatic */
    const igabem_formulation_row *formulation; /* of options */
    igabem_hull_info info;
    double x_aft, x_fore;
    double speed, k0; /* m/s, 1/m; without a Froude number speed 1 and k0 = 0 */
    bool waves;       /* the sources radiate waves: Kochin function and resistance exist */
    struct density *density;
    double *sigma;  /* [n] coefficients of the density, m/s */
    bool potential; /* sigma holds the coefficients of the potential on the hull, m^2/s */
    struct free_surface *surface; /* of a potential: where it was solved; NULL: none */
    double *surface_phi;          /* its coefficients there, then those of the hull's edge */
    struct base_point *base;      /* of each cell of a double model; else NULL */
    double (*cell_source)[7];     /* what it radiates then, of base_flow_radiate() */
    double *base_velocity;        /* [3][n] grad Phi on the hull, of unit speed; else NULL */
    double surface_momentum;      /* what that returned, m^4/s^2 */
    struct transom *transom;      /* strip and face of a dry one; NULL: none */
    double *strip_phi;            /* coefficients, the rim's phi and its slope */
    double *system;               /* [n][3][n] as assemble_turn() leaves it; of a potential the
                                     factors of all its unknowns; NULL: not kept */
    int *pivots;                  /* of those; else NULL */
    double *velocity;     /* [3][n] coefficients of grad phi on the hull, fluid side; NULL: none */
    double *sigma_lower;  /* [n] with 0.85 of the cut-off, NULL: not asked for */
    double *sigma_upper;  /* [n] with 1.15 */
    double *sigma_change; /* [n] sigma less what it is on half the knots, NULL: not known */
    double condition;     /* 1-norm estimate, NAN without a solve */
    size_t iterations;    /* of GMRES with the cut-off itself, 0 with LU */
    double residual;      /* relative, the largest of its solves; NAN with LU */
    struct igabem_cost cost;
    double seconds;
    double memory; /* bytes of influences and matrix */
};

/* Fills *solution but for what solving finds; to be freed also after an error. */
igabem_status solution_create(const igabem_hull *hull, const igabem_options *options,
                              igabem_solution **solution);

igabem_status solution_no_memory(size_t n);

/* U n_x at the collocation points: the right-hand side, and Hogner's density. */
void solution_normal_flow(const igabem_solution *solution, double *values);

/* Share of the Kelvin kernel in the rows at x: all of it, but ahead of x_s only with the stern
 * variant, with a smooth switch; double body elsewhere. */
double solution_wave_share(const igabem_solution *solution, double x);

/* chi = 1/(1 + (|nu_x|/nu_c)^4), the stem limiter of the line term. */
double solution_stem_limiter(const igabem_options *options, double nu_x);

#endif
