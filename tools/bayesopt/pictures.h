/* Pictures of a study. Each opens the sheet, or prints the sentence and returns false. */
#ifndef BAYESOPT_TOOL_PICTURES_H
#define BAYESOPT_TOOL_PICTURES_H

#include "names.h"
#include "plot/plot.h"

enum { PICTURE_WIDTH = 1000 };

typedef bool picture(struct plot *plot, bayesopt *bo, const struct names *names);

picture picture_history;  /* every value, and the best so far */
picture picture_front;    /* the objectives against each other */
picture picture_slices;   /* the model along each variable, through the best point */
picture picture_contours; /* the same along two, of the variables that matter most */
picture picture_loo;      /* what the model expects of each value from the others */
picture picture_parallel; /* the points as lines across one axis per variable */
picture picture_indices;  /* which variables matter */

#endif
