/* Variants of a hull from anywhere: a row of coordinates for each. */
#ifndef GALV_TOOL_SNAPSHOTS_H
#define GALV_TOOL_SNAPSHOTS_H

#include "arguments.h"
#include "hull.h"

/* rows: displacements from the parent, count x 3 npoints, owned. */
struct snapshots {
    size_t count;
    double *values;
};

/* Reads --snapshots, and the parent: --hull, or the mean of the variants. Prints why on failure. */
bool snapshots_read(const struct arguments *arguments, struct hull *parent,
                    struct snapshots *snapshots);
void snapshots_free(struct snapshots *snapshots);

#endif
