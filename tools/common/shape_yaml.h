/* The definition of a shape modification in a YAML file (docs/galv.md describes its fields) or in a
 * model file, and the galv_shape made from it. */
#ifndef TOOLS_SHAPE_YAML_H
#define TOOLS_SHAPE_YAML_H

#include <galv/galv.h>
#include <stdbool.h>
#include <stddef.h>

struct shape_definition {
    galv_combination combination;
    size_t n;              /* functions and parameters */
    galv_sine *functions;  /* n */
    double *lower, *upper; /* n each, metres */
    galv_box box;
};

/* Reads PATH. Entries "auto" of the box become the extents of the points. On failure prints the
 * sentence with file, line and field and returns false. */
bool shape_definition_read(const char *path, size_t npoints, const double *xyz,
                           struct shape_definition *definition);
bool shape_definition_allocate(size_t n, struct shape_definition *definition);
void shape_definition_free(struct shape_definition *definition);

galv_status shape_definition_create(const struct shape_definition *definition, galv_shape **shape);

/* Both steps: the shape of a YAML file for these points, or NULL after printing why. */
galv_shape *shape_yaml_read(const char *path, size_t npoints, const double *xyz);

/* Reads a hull grid, CSV with the columns x,y,z (and i,j, when present, section by section), into a
 * new array of npoints triples. sections and girth are 0 when the file has no i,j. Prints why on
 * failure. */
bool hull_grid_read(const char *path, double **xyz, size_t *npoints, size_t *sections,
                    size_t *girth);

#endif
