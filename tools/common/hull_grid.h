/* Hull grids in CSV files. */
#ifndef TOOLS_HULL_GRID_H
#define TOOLS_HULL_GRID_H

#include <stdbool.h>
#include <stddef.h>

/* Reads a hull grid, CSV with the columns x,y,z (and i,j, when present, section by section), into a
 * new array of npoints triples. sections and girth are 0 when the file has no i,j. Prints why on
 * failure. */
bool hull_grid_read(const char *path, double **xyz, size_t *npoints, size_t *sections,
                    size_t *girth);

#endif
