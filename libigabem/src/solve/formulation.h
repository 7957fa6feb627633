/* What the table of formulations says of a hull and of a setting. */
#ifndef FORMULATION_H
#define FORMULATION_H

#include "hull/hull.h"

#include <igabem/solve.h>

/* What IGABEM_FORMULATION_AUTO stands for on a hull. */
igabem_formulation formulation_choose(const igabem_hull *hull);

/* Whether a setting solves for its density, whether its rows hold the mirror image in the still
 * water, and whether they hold waves: the formulation's row as far as the kernel has waves. */
bool formulation_solves(const igabem_options *options);
bool formulation_has_image(const igabem_options *options);
bool formulation_has_waves(const igabem_options *options);

/* Whether it solves for the potential on hull and free surface and not for a density. */
bool formulation_has_potential(const igabem_options *options);

#endif
