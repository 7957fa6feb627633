/* Wave resistance of a solution from its far field. */
#ifndef KOCHIN_H
#define KOCHIN_H

#include "solve/solution.h"

struct kochin_resistance {
    double cw;                  /* NAN where nothing radiates */
    double share_beyond_cutoff; /* part of cw from |t| > t_c; 0 without a cut-off */
    double cw_error;            /* its discretisation error, estimated; NAN where it is not */
    double cw_lower, cw_upper;  /* with the densities of 0.85 and 1.15 t_c, NAN if not solved for */
};

igabem_status kochin_resistance(const igabem_solution *solution, struct kochin_resistance *result);

/* What turns the resistance integral, over both signs of t, into C_w. */
double kochin_coefficient(const igabem_solution *solution);

/* Refuses angles that are no numbers or whose waves are not resolved, and a solution without waves;
 * fills *largest, their magnitude. */
igabem_status kochin_check_angles(const igabem_solution *solution, size_t n, const double *t,
                                  double *largest);

#endif
