/* Files of hulls that are no patches. */
#ifndef NURBS_HULL_SOURCE_H
#define NURBS_HULL_SOURCE_H

#include <nurbs/patches.h>

typedef enum hull_source {
    HULL_SOURCE_PATCHES,
    HULL_SOURCE_MESH,
    HULL_SOURCE_TABLE,
    HULL_SOURCE_STATIONS,
    HULL_SOURCE_GRID
} hull_source;

/* By extension. */
hull_source hull_source_of(const char *path);

/* One surface from a file that holds none; the report says from what. tolerance: of the surface
 * through sections of a mesh, m; NAN: 6e-4 of the extent. *volume fills that of
 * a mesh below level, m^3; 0: no mesh, or open there. */
nurbs_status hull_source_read(const char *path, double tolerance, double level,
                              nurbs_patches **patches, double *volume, char *report,
                              size_t report_size);

#endif
