/**
 * @file shape.h
 * Shape modifications: maps from n parameters to the displacement of any set of points (eq. 1).
 *
 * A galv_shape is immutable once made, so several threads may use one.
 */
#ifndef GALV_SHAPE_H
#define GALV_SHAPE_H

#include <galv/status.h>

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct galv_shape galv_shape;

/** A hyper-rectangle aligned with the axes: corner of least coordinates and edge lengths, metres.
 */
typedef struct galv_box {
    double origin[3];
    double length[3]; /**< > 0 */
} galv_box;

/** Fills the smallest box around npoints triples. Error: GALV_ERROR_GEOMETRY where it has no extent
 * along an axis. */
GALV_API galv_status galv_box_around(size_t npoints, const double *xyz, galv_box *box);

/** One function of eq. 17: psi = prod_j sin(order[j] pi zeta_j / L_j + phase[j]) e_direction, with
 * zeta = point - box origin and L the box lengths. */
typedef struct galv_sine {
    double order[3]; /**< a_ij, any finite number */
    double phase[3]; /**< r_ij, radians */
    int direction;   /**< q(i): 0, 1 or 2 for x, y or z */
} galv_sine;

/** How the terms x_i psi_i of a set are combined. */
typedef enum galv_combination {
    GALV_COMBINATION_LINEAR,    /**< all functions evaluated at the undisturbed point, d = sum x_i
                                   psi_i */
    GALV_COMBINATION_RECURSIVE, /**< eq. 16: function i is evaluated at the point as moved by
                                 * functions 0..i-1
                                 */
    GALV_COMBINATION_SCALED,    /**< all functions evaluated at the undisturbed point and multiplied
                                   with its zeta along their direction: d_q = zeta_q sum x_i psi_i.
                                   The parameters are shares, not metres, and points on the face
                                   zeta_q = 0, such as the centre plane, stay there */
} galv_combination;

/**
 * A set of sine products, eqs. 15-17.
 * @param n          number of functions and of parameters, >= 1
 * @param functions  n functions in the order in which the recursion applies them; copied
 * @param box        the box of eq. 15; points outside it are not refused (psi is defined
 * everywhere)
 * @param lower,upper n bounds of the parameters, metres (shares where the combination says so),
 * lower <= upper; copied
 * @param[out] shape created
 * @return GALV_ERROR_ARGUMENT names the function or the bound at fault.
 */
GALV_API galv_status galv_shape_sine(size_t n, const galv_sine *functions, const galv_box *box,
                                     const double *lower, const double *upper,
                                     galv_combination combination, galv_shape **shape);

/** The caller's own modification: fills d (3 npoints) for the parameters x (n). Returns 0, or
 * non-zero to report that these parameters give no shape. */
typedef int (*galv_displacement)(void *user_data, size_t npoints, const double *xyz,
                                 const double *x, double *d);

/**
 * A user-supplied modification.
 * @param user_data    handed to displace; borrowed, must outlive the shape
 * @param concurrent true when displace may run in several threads at once
 */
GALV_API galv_status galv_shape_callback(size_t n, const double *lower, const double *upper,
                                         galv_displacement displace, void *user_data,
                                         bool concurrent, galv_shape **shape);

/** A lattice of control points over a box, for free-form deformation (Sederberg and Parry 1986). */
typedef struct galv_lattice {
    galv_box box;
    size_t count[3]; /**< control points along x, y, z, each >= 2 */
    int degree[3];   /**< of clamped uniform B-splines, 1..count-1; count-1 is Bernstein */
} galv_lattice;

/** One parameter of a free-form deformation: the displacement of one control point along one axis.
 */
typedef struct galv_lattice_move {
    size_t index[3]; /**< which control point */
    int direction;   /**< 0, 1 or 2 */
} galv_lattice_move;

/**
 * Free-form deformation: d = sum_i x_i B_i(point) e_direction(i), B_i the tensor product of
 * B-splines of control point i. Linear in x. Points outside the box stay. Control points without a
 * move are fixed: leaving out the outer layer(s) fixes the faces of the box (and, with degree k >=
 * 2 and k layers left out, derivatives there); leaving out direction 1 on the layer index[1] = 0 of
 * a box that starts at y = 0 keeps the centre plane.
 * @param n      number of moves and of parameters
 * @param moves  n moves; copied
 */
GALV_API galv_status galv_shape_ffd(const galv_lattice *lattice, size_t n,
                                    const galv_lattice_move *moves, const double *lower,
                                    const double *upper, galv_shape **shape);

/**
 * Given displacement fields on given points: d = sum_i x_i field_i. With the values of the basis
 * functions of a NURBS hull at its grid points these are moves of its control points.
 * @param n        number of fields and of parameters
 * @param npoints  points the fields are given on; the shape displaces no other number of points
 * @param fields   n rows of 3 npoints numbers; copied
 */
GALV_API galv_status galv_shape_fields(size_t n, size_t npoints, const double *fields,
                                       const double *lower, const double *upper,
                                       galv_shape **shape);

/** NULL is allowed. */
GALV_API void galv_shape_free(galv_shape *shape);

/** Number of parameters n; 0 for NULL. */
GALV_API size_t galv_shape_parameters(const galv_shape *shape);

/** The n lower (upper) bounds of the parameters. Borrowed from the shape; NULL for NULL. */
GALV_API const double *galv_shape_lower(const galv_shape *shape);
/** Upper bounds of the parameters. Borrowed; NULL of NULL. */
GALV_API const double *galv_shape_upper(const galv_shape *shape);

/** Whether d is linear in x by construction: then the spectrum is the eigenproblem of an n x n
 * matrix. False for callbacks. */
GALV_API bool galv_shape_is_linear(const galv_shape *shape);

/**
 * The displacement of points for one set of parameters.
 * @param xyz  npoints triples, metres
 * @param x    n parameters; not forced to lie within the bounds, must be finite
 * @param[out] d npoints triples, filled
 * @return GALV_ERROR_NUMERIC names the first point whose displacement is not finite.
 * Complexity O(npoints n); no allocation.
 */
GALV_API galv_status galv_shape_displace(const galv_shape *shape, size_t npoints, const double *xyz,
                                         const double *x, double *d);

/**
 * The largest parameters under which a sine set cannot fold space or push a point through a face of
 * its box. Step i of the recursion maps zeta_q -> zeta_q + x_i psi_i(zeta), whose slope is at least
 * 1 - |x_i| |a_iq| pi / L_q: it is a strictly increasing map of [0, L_q] for |x_i| < L_q / (|a_iq|
 * pi). When sin(a_iq pi s + r_iq) vanishes at s = 0 and s = 1 both ends are fixed points, so the
 * interval is mapped onto itself, step after step, whatever the other parameters are: no point
 * crosses the centre plane.
 * @param[out] bound  n values, filled: L_q / (|a_iq| pi), or infinity where a_iq = 0
 * @param[out] fixed  true when every function vanishes on both faces normal to its direction
 * @return GALV_ERROR_ARGUMENT for any other kind of shape or for a linear combination of more than
 * one function, for which no such bound holds.
 */
GALV_API galv_status galv_shape_fold_bound(const galv_shape *shape, double *bound, bool *fixed);

#ifdef __cplusplus
}
#endif

#endif
