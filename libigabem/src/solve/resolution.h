/* How fine the waves are that a result asks for, against what is summed in bounded time: the work
 * grows with the square of the phase of the shortest wave along the hull. */
#ifndef RESOLUTION_H
#define RESOLUTION_H

#include "hull/hull.h"

#include <igabem/solve.h>

/* Refuses settings, frozen, whose waves are too short for the hull. */
igabem_status resolution_check(const igabem_hull *hull, const igabem_options *options);

/* Refuses a wave angle t of that k0 on a hull of that length and beam; what names the setting. */
igabem_status resolution_check_angle(double k0, double length, double beam, double t,
                                     const char *what);

/* Refuses waves of that k0 followed so far from the bow, m. */
igabem_status resolution_check_distance(double k0, double distance);

#endif
