/* The parent hull: points to displace, section by section. */
#ifndef GALV_TOOL_HULL_H
#define GALV_TOOL_HULL_H

#include "shape_yaml.h"

#include <nurbs/patches.h>

#include <stdbool.h>
#include <stddef.h>

struct hull {
    double *xyz; /* npoints triples */
    size_t npoints, sections,
        girth; /* sections x girth = npoints, or 0 when the points are no grid */
    nurbs_patches
        *patches;  /* where it is a NURBS hull: the first was sampled, NULL: points alone */
    double *u, *v; /* at these parameters of the sections and of the points along them */
};

/* Its points as a shape file is read for. */
struct shape_points hull_points(const struct hull *hull);

/* Reads a grid (CSV) or samples the first patch of a NURBS hull (JSON): at sections x girth equally
 * spaced parameters, or, when these are 0, at the design grid that the file keeps. Prints why on
 * failure. */
bool hull_read(const char *path, size_t sections, size_t girth, struct hull *hull);
void hull_free(struct hull *hull);

/* Writes i,j,x,y,z (x,y,z when the points are no grid) to PATH, "-" for stdout. Prints why on
 * failure. */
bool hull_write(const char *path, const struct hull *hull, const double *xyz);

#endif
