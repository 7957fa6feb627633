/* The definition of a shape modification in a YAML file (docs/galv.md describes its fields) or in a
 * model file, and the galv_shape made from it. */
#ifndef TOOLS_SHAPE_YAML_H
#define TOOLS_SHAPE_YAML_H

#include <galv/galv.h>
#include <nurbs/surface.h>

#include <stdbool.h>
#include <stddef.h>

/* The points that a shape moves and, where they are a grid on a NURBS surface, its parameters. */
struct shape_points {
    size_t n;
    const double *xyz;
    const nurbs_surface *surface; /* NULL: points alone */
    size_t rows, columns;
    const double *u, *v; /* of the rows and of the columns */
};

enum shape_kind { SHAPE_SINES, SHAPE_LATTICE, SHAPE_CONTROL_POINTS, SHAPE_KINDS };

struct shape_definition {
    enum shape_kind kind;
    size_t n;              /* parameters */
    double *lower, *upper; /* n each, metres or shares */
    galv_box box;
    galv_combination combination; /* of sines */
    galv_sine *functions;         /* n, of sines */
    size_t count[3];              /* of a lattice */
    int degree[3];
    galv_lattice_move *moves; /* n, of a lattice; of control points the direction alone */
    size_t npoints;
    double *fields; /* n x 3 npoints, of control points */
};

/* "sines", "lattice", "control points". */
const char *shape_kind_name(enum shape_kind kind);

/* "recursive", "linear", "scaled"; and back, false for any other word. */
const char *shape_combination_name(galv_combination combination);
bool shape_combination_find(const char *name, galv_combination *combination);

/* Reads PATH. Entries "auto" of the box become the extents of the points. On failure prints the
 * sentence with file, line and field and returns false. */
bool shape_definition_read(const char *path, const struct shape_points *points,
                           struct shape_definition *definition);
/* npoints: of control points. */
bool shape_definition_allocate(enum shape_kind kind, size_t n, size_t npoints,
                               struct shape_definition *definition);
void shape_definition_free(struct shape_definition *definition);

galv_status shape_definition_create(const struct shape_definition *definition, galv_shape **shape);

/* Both steps: the shape of a YAML file for these points, or NULL after printing why. */
galv_shape *shape_yaml_read(const char *path, const struct shape_points *points);

#endif
