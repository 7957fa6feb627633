/* The commands of a configuration: one that makes the hull of the parameters, one that tells what a
 * hull is worth. Each runs in a numbered folder that did not exist before, which is kept. */
#ifndef HULLOPT_EXTERNAL_H
#define HULLOPT_EXTERNAL_H

#include "config.h"
#include "core/sentence.h"

#include <nurbs/nurbs.h>

/* Makes the hull of the original moved by u (NULL: the original) and tells its file. */
bool external_make(const struct config *config, const double *u, char path[CONFIG_PATH]);
/* The number that the hull is worth, and those of the other objectives. u: as above, for commands
 * that ask for parameters too. */
bool external_judge(const struct config *config, const double *u, const nurbs_hull *hull,
                    double *value, double others[OBJECTIVES_MOST - 1]);

#endif
