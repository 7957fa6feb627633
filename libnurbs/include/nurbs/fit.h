/**
 * @file fit.h
 * Curves and surfaces through or near points: interpolation, least squares, skinning of sections.
 */
#ifndef NURBS_FIT_H
#define NURBS_FIT_H

#include <nurbs/curve.h>
#include <nurbs/grid.h>
#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum nurbs_parametrization {
    NURBS_UNIFORM,
    NURBS_CHORD,
    NURBS_CENTRIPETAL,
    NURBS_FOLEY
} nurbs_parametrization;

/** Fills u[n], 0 to 1, for n points. Coincident neighbours share a parameter; if all points
 * coincide, the parameters are uniform. */
NURBS_API nurbs_status nurbs_parametrize(nurbs_parametrization kind, size_t n, const double *points,
                                         double *u);

/** Interpolates n points at parameters u[n] (increasing). Degree >= 1, n > degree; knots by
 * averaging (The NURBS Book 9.8). */
NURBS_API nurbs_status nurbs_curve_interpolate(int degree, size_t n, const double *points,
                                               const double *u, nurbs_curve **curve);

/** Least-squares curve on given knots (size control points), both end points kept. */
NURBS_API nurbs_status nurbs_curve_fit(int degree, size_t size, const double *knots, size_t n,
                                       const double *points, const double *u, nurbs_curve **curve);

/** How a grid of sections becomes one surface: u along the rows (sections), v along the columns. */
typedef struct nurbs_skin_options {
    int degree; /**< both directions, 1 to 5; 3 */
    nurbs_parametrization
        parametrize;   /**< averaged over rows, respectively columns; NURBS_CENTRIPETAL */
    double kink_angle; /**< radians: a longitudinal edge line turning by more than this at a
                            station gets a knot of multiplicity `degree` there so that the
                            kink stays; 20 degrees; <= 0: none */
} nurbs_skin_options;

NURBS_API void nurbs_skin_options_init(nurbs_skin_options *options);

/** Surface through all points of the grid: a section curve per row, then skinned on common knots.
 * Errors: rows or columns that collapse, folded result (the place is named). options NULL:
 * defaults. */
NURBS_API nurbs_status nurbs_skin(const nurbs_grid *grid, const nurbs_skin_options *options,
                                  nurbs_surface **surface);

/** Fills u[rows] and v[columns]: the parameters of nurbs_skin, where its surface passes through the
 * points of the grid. */
NURBS_API nurbs_status nurbs_skin_parameters(const nurbs_grid *grid,
                                             const nurbs_skin_options *options, double *u,
                                             double *v);

/** Surface through section curves of any degree and knots; they are first brought to one knot
 * vector within `tolerance` (metres; 0: exact union of knots). u[n] increasing section parameters,
 * or NULL for averaged chord lengths. */
NURBS_API nurbs_status nurbs_skin_curves(size_t n, const nurbs_curve *const *sections,
                                         const double *u, int degree, double tolerance,
                                         nurbs_surface **surface);

/** Least-squares surface on given knots near a grid at parameters u[rows] x v[columns]; the four
 * edges are fitted first and kept. */
NURBS_API nurbs_status nurbs_surface_fit(const int degree[2], const size_t size[2],
                                         const double *knots_u, const double *knots_v,
                                         const nurbs_grid *grid, const double *u, const double *v,
                                         nurbs_surface **surface);

#ifdef __cplusplus
}
#endif

#endif
