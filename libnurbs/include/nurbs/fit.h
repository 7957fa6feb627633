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

/** How parameters follow from points. */
typedef enum nurbs_parametrization {
    NURBS_PARAMETRIZATION_UNIFORM,
    NURBS_PARAMETRIZATION_CHORD,
    NURBS_PARAMETRIZATION_CENTRIPETAL,
    NURBS_PARAMETRIZATION_FOLEY
} nurbs_parametrization;

/** Fills u[n], 0 to 1, for n points. Coincident neighbours share a parameter; if all points
 * coincide, the parameters are uniform. */
NURBS_API nurbs_status nurbs_parametrize(nurbs_parametrization kind, size_t n, const double *points,
                                         double *u);

/** Interpolates n points at parameters u[n] (increasing). Degree >= 1, n > degree; knots by
 * averaging (The NURBS Book 9.8). */
NURBS_API nurbs_status nurbs_curve_interpolate(int degree, size_t n, const double *points,
                                               const double *u, nurbs_curve **curve);

/** Interpolates a grid of points at parameters u[rows] x v[columns], both increasing: C^(degree-1),
 * knots at the parameters (odd degrees) or midway, not-a-knot ends. Errors: as for curves, naming
 * the direction or the grid point. */
NURBS_API nurbs_status nurbs_surface_interpolate(const int degree[2], const nurbs_grid *grid,
                                                 const double *u, const double *v,
                                                 nurbs_surface **surface);

/** Least-squares curve on given knots (size control points), both end points kept. */
NURBS_API nurbs_status nurbs_curve_fit(int degree, size_t size, const double *knots, size_t n,
                                       const double *points, const double *u, nurbs_curve **curve);

/** How a grid of sections becomes one surface: u along the rows (sections), v along the columns. */
typedef struct nurbs_skin_options {
    int degree;                        /**< both directions, 1 to 5; 3 */
    nurbs_parametrization parametrize; /**< averaged over rows, respectively columns;
                                          NURBS_PARAMETRIZATION_CENTRIPETAL */
    double kink_angle;   /**< radians: a longitudinal edge line turning by more than this at a
                              station gets a knot of multiplicity `degree` there so that the
                              kink stays; 20 degrees; <= 0: none */
    size_t chine_count;  /**< columns that are chines: 0 */
    const size_t *chine; /**< borrowed: their indices from 0, increasing, not the first or last
                              column; sections that turn there by more than kink_angle (by anything
                              if that is <= 0) keep the kink, others pass smoothly; NULL */
    const double *u, *v; /**< borrowed: parameters of rows and of columns, increasing, instead of
                            parametrize; with those of another grid the surface is linear in the
                            points while the kinks are the same; NULL */
    double reserved[8];  /**< 0: room for members of later releases */
} nurbs_skin_options;

/** Fills the defaults; nothing when NULL. */
NURBS_API void nurbs_skin_options_init(nurbs_skin_options *options);

/** Surface through all points of the grid: a section curve per row, then skinned on common knots.
 * Errors: rows or columns that collapse, folded result (the place is named). options NULL:
 * defaults. */
NURBS_API nurbs_status nurbs_skin(const nurbs_grid *grid, const nurbs_skin_options *options,
                                  nurbs_surface **surface);

/** Creates a surface with fewer control points near the one of nurbs_skin(): knots are removed,
 * edges and kinks kept; where all points have y >= 0 the surface gets it too
 * (nurbs_surface_raise_side()).
 * @param tolerance  metres, > 0
 * @param bound      fills a proven bound of the distance between the two surfaces, and so from the
 *                   points, m; at most the tolerance; NULL allowed
 * Errors: NURBS_ERROR_NUMERIC: y >= 0 takes a larger change. */
NURBS_API nurbs_status nurbs_skin_light(const nurbs_grid *grid, const nurbs_skin_options *options,
                                        double tolerance, nurbs_surface **surface, double *bound);

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

/** Least-squares surface near n scattered points at parameters uv[n] (pairs inside the domain):
 * minimises the mean of |S(uv_k) - p_k|^2 plus smoothing times the integral of |Suu|^2 + 2 |Suv|^2
 * + |Svv|^2 over the parameters. smoothing in units of the parameters (1e-8 is a light touch on the
 * unit square); 0 only if the points determine every control point, else NURBS_ERROR_NUMERIC.
 * Sparse normal equations, solved by Cholesky factors (Davis, Direct Methods for Sparse Linear
 * Systems, 2006). */
NURBS_API nurbs_status nurbs_surface_fit_points(const int degree[2], const size_t size[2],
                                                const double *knots_u, const double *knots_v,
                                                size_t n, const double *points, const double *uv,
                                                double smoothing, nurbs_surface **surface);

/** Ruled surface: straight lines in v between points of equal parameter of two curves; exact, also
 * for rational curves. The curves' domains are scaled to [0,1]. */
NURBS_API nurbs_status nurbs_ruled(const nurbs_curve *first, const nurbs_curve *last,
                                   nurbs_surface **surface);

/** Coons patch (1967): bilinearly blended from its four edges, exact. u_first and u_last run along
 * u at v = 0 and v = 1; v_first and v_last along v at u = 0 and u = 1. Polynomial curves whose ends
 * meet within 1e-9 of their extent, else NURBS_ERROR_GEOMETRY naming the corner. */
NURBS_API nurbs_status nurbs_coons(const nurbs_curve *u_first, const nurbs_curve *u_last,
                                   const nurbs_curve *v_first, const nurbs_curve *v_last,
                                   nurbs_surface **surface);

#ifdef __cplusplus
}
#endif

#endif
