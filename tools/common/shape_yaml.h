/* The definition of a shape modification in a YAML file (docs/galv.md describes its fields) or in a
 * model file, and the galv_shape made from it. */
#ifndef TOOLS_SHAPE_YAML_H
#define TOOLS_SHAPE_YAML_H

#include <galv/galv.h>

#include <stdbool.h>
#include <stddef.h>

enum shape_kind { SHAPE_SINES, SHAPE_LATTICE };

struct shape_definition {
    enum shape_kind kind;
    size_t n;              /* parameters */
    double *lower, *upper; /* n each, metres or shares */
    galv_box box;
    galv_combination combination; /* of sines */
    galv_sine *functions;         /* n, of sines */
    size_t count[3];              /* of a lattice */
    int degree[3];
    galv_lattice_move *moves; /* n, of a lattice */
};

/* "recursive", "linear", "scaled"; and back, false for any other word. */
const char *shape_combination_name(galv_combination combination);
bool shape_combination_find(const char *name, galv_combination *combination);

/* Reads PATH. Entries "auto" of the box become the extents of the points. On failure prints the
 * sentence with file, line and field and returns false. */
bool shape_definition_read(const char *path, size_t npoints, const double *xyz,
                           struct shape_definition *definition);
bool shape_definition_allocate(enum shape_kind kind, size_t n, struct shape_definition *definition);
void shape_definition_free(struct shape_definition *definition);

galv_status shape_definition_create(const struct shape_definition *definition, galv_shape **shape);

/* Both steps: the shape of a YAML file for these points, or NULL after printing why. */
galv_shape *shape_yaml_read(const char *path, size_t npoints, const double *xyz);

#endif
