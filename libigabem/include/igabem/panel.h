/**
 * @file panel.h
 * The Green function of kelvin.h for panel codes: matrices of n field points by m sources or m flat
 * panels. Conventions, units and terms are those of kelvin.h; these functions need nothing else of
 * the library and may be called from several threads.
 *
 * Points are x,y,z triples. A matrix is row by row, entry [i m + j] for field point i and source
 * j (in Fortran: an array (m, n)). A panel has 4 corners, counterclockwise seen from the water, so
 * that its normal points into the water; a triangle repeats a corner. Corners of a warped
 * quadrilateral are moved to the plane through their mean with the normal of its diagonals (Hess
 * and Smith 1967), which igabem_panel_frames() tells; convex or not, but not crossing itself.
 */
#ifndef IGABEM_PANEL_H
#define IGABEM_PANEL_H

#include <igabem/kelvin.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Settings of the matrices. */
typedef struct igabem_matrix_options {
    unsigned parts;              /**< sum of igabem_kelvin_part; the four of the Kelvin source */
    igabem_kelvin_filter filter; /**< of the wave part; none */
    double tolerance;   /**< of panels, 1e-12 to 0.1: error of the local and the wave part over the
                           integral of their modulus; 1e-4 */
    int threads;        /**< 0: as OpenMP decides; at most 1024 */
    double reserved[8]; /**< 0: room for members of later releases */
} igabem_matrix_options;

/** Fills the defaults; nothing when NULL. */
IGABEM_API void igabem_matrix_options_init(igabem_matrix_options *options);

/**
 * G of n field points and m sources of strength 1, all n m pairs.
 *
 * @param k0       g/U^2 > 0, 1/m
 * @param n        number of field points
 * @param points   field points, m, z <= 0 (borrows, 3 n)
 * @param normals  unit vectors at the field points (borrows, 3 n); NULL without slope
 * @param m        number of sources
 * @param sources  source points, m, z <= 0 (borrows, 3 m)
 * @param options  borrows; NULL: defaults
 * @param value    G, 1/m (fills, n m) or NULL
 * @param gradient dG/dx, dG/dy, dG/dz at the field point, 1/m^2 (fills, 3 n m) or NULL
 * @param slope    its component along the normal, 1/m^2 (fills, n m) or NULL
 * @return IGABEM_OK; IGABEM_ERROR_ARGUMENT as igabem_kelvin_green(), with the pair
 */
IGABEM_API igabem_status igabem_green_matrix(double k0, size_t n, const double *points,
                                             const double *normals, size_t m, const double *sources,
                                             const igabem_matrix_options *options, double *value,
                                             double *gradient, double *slope);

/**
 * Integrals of G over m panels of density 1: 1/r and 1/r' in closed form (Hess and Smith 1967;
 * Newman 1986), N + W by a rule of degree 5 on triangles that divides until tolerance is met.
 *
 * On a panel itself the Rankine part is the principal value: its gradient has no component along
 * the normal n of the panel. The limit from the side to which n points is the gradient + n/2, from
 * the other side - n/2, hence the equation of a source density, sigma/2 + Sum_j slope_ij sigma_j =
 * U n_x on the hull.
 *
 * @param corners x,y,z of the four corners, m, z <= 0 (borrows, 12 m)
 * @return IGABEM_OK; IGABEM_ERROR_ARGUMENT also for a panel without area, one that crosses itself
 * or is warped by more than a tenth of its diagonal, and a point on an edge, where the gradient is
 * infinite; IGABEM_ERROR_NUMERIC when the rule cannot reach tolerance with 500 triangles a panel,
 * as for unfiltered waves of a panel at z = 0; IGABEM_ERROR_MEMORY Other parameters as in
 * igabem_green_matrix(); value in m, gradient and slope without unit.
 */
IGABEM_API igabem_status igabem_panel_matrix(double k0, size_t n, const double *points,
                                             const double *normals, size_t m, const double *corners,
                                             const igabem_matrix_options *options, double *value,
                                             double *gradient, double *slope);

/**
 * What the matrices take panels for: centroid, normal and area of m panels.
 *
 * @param centroid m, on the panel's plane: the usual field point (fills, 3 m) or NULL
 * @param normal   unit vectors (fills, 3 m) or NULL
 * @param area     m^2 (fills, m) or NULL
 * @return IGABEM_OK, IGABEM_ERROR_ARGUMENT as igabem_panel_matrix()
 */
IGABEM_API igabem_status igabem_panel_frames(size_t m, const double *corners, double *centroid,
                                             double *normal, double *area);

#ifdef __cplusplus
}
#endif

#endif
