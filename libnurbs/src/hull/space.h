/* The spline space that the hulls rebuilt from one parent share.
 *
 * Knot removal chooses its knots by the shape, so that a surface jumps by the tolerance when a
 * design moves a little. On fixed parameters and knots the surface depends smoothly on the points
 * of the grid: skin and fit are linear in them, the cut at the water is as smooth as the hull. */
#ifndef NURBS_HULL_SPACE_H
#define NURBS_HULL_SPACE_H

#include <nurbs/grid.h>
#include <nurbs/surface.h>

typedef struct hull_space {
    size_t rows, columns;
    double *parameters[2]; /* of the rows and columns of the design grid */
    int degree[2];
    size_t size[2];
    double *knots[2];
} hull_space;

/* Takes the parameters of the grid and the knots of a surface, which it copies. */
nurbs_status hull_space_create(const nurbs_grid *grid, const nurbs_surface *light,
                               hull_space **space);
void hull_space_free(hull_space *space);

/* The skin of a grid, on the parameters of the space; NULL: on its own. */
nurbs_status hull_space_skin(const hull_space *space, const nurbs_grid *grid, nurbs_surface **skin);

/* Least squares on the space near a wetted surface. bound: a proven one of their distance at equal
 * parameters, m; worst (NULL: not wanted): the parameters where it is attained. */
nurbs_status hull_space_fit(const hull_space *space, const nurbs_surface *wetted,
                            nurbs_surface **light, double *bound, double worst[2]);

/* Adds the knots that the fit of a wetted surface needs to be within the tolerance (bound); none if
 * they do not help, as at a kink that the space has not. */
nurbs_status hull_space_widen(hull_space *space, const nurbs_surface *wetted, double tolerance);

#endif
