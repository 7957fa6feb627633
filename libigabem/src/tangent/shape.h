/* What a hull enters the system of a potential by besides the control values of its elements: the
 * lines of the free surface follow its waterline, the strip and the face of a dry transom its rim,
 * and with the lines changes what the layers on them carry while phi stays (docs/theory.md,
 * section 15). */
#ifndef SHAPE_H
#define SHAPE_H

#include "exterior/free_surface.h"
#include "exterior/transom.h"
#include "tangent/tangent.h"

/* Where these numbers stand, one behind the other. */
struct shape {
    const struct free_surface *surface;
    const struct transom *transom; /* NULL: nothing of it */
    size_t parts;                  /* elements of the face */
    size_t station; /* half breadth of the surface's inner edge at thirds of its cells, 3 nx + 1 */
    size_t breadth; /* of the transom */
    size_t corner;  /* x of the rim at the ends of the face's elements, then z, parts + 1 each */
    size_t wave;    /* phi_xx/k0, damping included, at the middles of the cells */
    size_t strip;   /* the same of the strip */
    size_t rim;     /* phi of the rim at the columns */
    size_t flux;    /* phi_n of the face there */
    size_t point;   /* phi of the rim where the face radiates, FACE_ACROSS an element, then phi_x */
    size_t size;
};

void shape_place(const igabem_solution *solution, struct shape *shape);

/* Their changes along the fields of a tangent while phi stays: creates change[size][fields], and
 * row[cells of surface and strip][fields], what the fields take from the rows of the system there
 * outside of its integrals. base[cells][5][fields]: of the base flow of a double model. */
igabem_status shape_change(const igabem_tangent *tangent, const struct shape *shape,
                           const double *base, double **change, double **row);

/* Of these: stations, breadth and corners; and phi of the rim, given that on the hull. */
igabem_status shape_lines(const igabem_tangent *tangent, const struct shape *shape, double *change);
igabem_status shape_rim_change(const igabem_tangent *tangent, const struct shape *shape,
                               const double *phi, double *change);

/* What the cells of a double model radiate changes with the surface's phi, [unknowns and
 * edge][fields], with its base flow and with its lines: creates change[parts][SHAPE_CELL][width of
 * the field], of y, of the source and of the dipole along x and y, by differences of
 * base_flow_radiate(). */
enum { SHAPE_CELL = 4 };
igabem_status shape_cells(const igabem_tangent *tangent, const double *phi, const double *base,
                          double **change);

/* Factors of the columns of the hull's phi in that of the rim at a point where the face radiates:
 * adds them to row[unknowns of the hull]. */
igabem_status shape_rim(const igabem_tangent *tangent, const struct shape *shape, size_t part,
                        size_t across, double *row);

/* Half breadth at which it does so. */
double shape_across(const struct shape *shape, const struct gauss *gauss, size_t part,
                    size_t across);

#endif
