/**
 * @file grid.h
 * Rectangular grids of points: rows i are the sections of a hull (bow to stern or stern to bow),
 * columns j run along the girth. File form: CSV with header i,j,x,y,z (1-based, any order, every
 * point once) and # comments.
 */
#ifndef NURBS_GRID_H
#define NURBS_GRID_H

#include <nurbs/status.h>
#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nurbs_grid nurbs_grid;

/** Creates a grid of rows x columns points, copies points (NULL: all zero); at least 2 x 2, finite.
 */
NURBS_API nurbs_status nurbs_grid_create(size_t rows, size_t columns, const double *points,
                                         nurbs_grid **grid);
/** Frees a grid; takes NULL. */
NURBS_API void nurbs_grid_free(nurbs_grid *grid);
/** Rows (sections); 0 of NULL. */
NURBS_API size_t nurbs_grid_rows(const nurbs_grid *grid);
/** Columns (points of a section); 0 of NULL. */
NURBS_API size_t nurbs_grid_columns(const nurbs_grid *grid);
/** Borrowed, x,y,z triples, rows slow: 3 * rows * columns; the second form may be written to. */
NURBS_API const double *nurbs_grid_points(const nurbs_grid *grid);
/** The same to be changed. Borrowed; NULL of NULL. */
NURBS_API double *nurbs_grid_edit(nurbs_grid *grid);

/** Creates a grid from a file `i,j,x,y,z` (docs/conventions.md, Files). */
NURBS_API nurbs_status nurbs_grid_read(const char *path, nurbs_grid **grid);
/** Writes such a file with 17 digits. */
NURBS_API nurbs_status nurbs_grid_write(const nurbs_grid *grid, const char *path);

/** Samples a surface at u[rows] x v[columns]. */
NURBS_API nurbs_status nurbs_grid_sample(const nurbs_surface *surface, size_t rows, const double *u,
                                         size_t columns, const double *v, nurbs_grid **grid);

#ifdef __cplusplus
}
#endif

#endif
