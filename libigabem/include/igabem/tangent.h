/**
 * @file tangent.h
 * Derivatives of a solution along fields of moves of the hull's control points, the density folded
 * in: of the Kochin function, of C_w, of its residuals and of the velocities on the hull. They are
 * those of the solution as it is computed, by the same rules of quadrature, which stay where they
 * are on the hull:
 *
 *     A sigma' = U n_x' - A' sigma,     H' = E sigma' + E' sigma
 *
 * (docs/theory.md, section 15). All fields together cost about as much as a solution (double-model:
 * some three), where differences cost one or two for each field. igabem_cw_gradient() has the
 * derivatives of C_w by all control points.
 */
#ifndef IGABEM_TANGENT_H
#define IGABEM_TANGENT_H

#include <igabem/residual.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The derivatives of one solution along some fields. */
typedef struct igabem_tangent igabem_tangent;

/** Derivatives of a solution along n fields, for the formulations that have them (`tangents` of
 * igabem_formulation_info()), on half hulls.
 *
 * Along a field the hull moves athwartships: its control points by e times the field, e -> 0, while
 * weights, knots and options stay as they are in the solution, also those that
 * igabem_options_freeze() would choose anew on the moved hull. Such moves leave the length, and
 * with it the speed, alone. The wetted area that coefficients divide by moves too. Patches that
 * meet have to move together along their common edge, which is not checked.
 * @param hull     that of the solution, borrowed for the call
 * @param solution borrowed until the tangent is freed; solved with igabem_options.keep_system it
 *                 spares this call from assembling its system again
 * @param n        fields, at least 1
 * @param move     [n][points][3], m for a unit of e: for each field the moves of the control points
 *                 of all patches of the hull, patch by patch, u slow and v fast. x and z are 0, and
 *                 so is y of points in the centre plane; points that coincide on a collapsed edge
 *                 move alike
 * @param[out] tangent created, to be given to igabem_tangent_free()
 *
 * Tells no progress. Threads: options.threads of the solution, in later calls too.
 * Errors: IGABEM_ERROR_ARGUMENT: a formulation without tangents, a hull given whole, another hull
 * than that of the solution, a move that is no number or not allowed. */
IGABEM_API igabem_status igabem_tangent_create(const igabem_hull *hull,
                                               const igabem_solution *solution, size_t n,
                                               const double *move, igabem_tangent **tangent);
/** Frees a tangent; takes NULL. */
IGABEM_API void igabem_tangent_free(igabem_tangent *tangent);

/** Derivatives of igabem_kochin() at m wave angles t = tan(theta): fills dh[n][m][2], m^3/s per
 * unit of e. */
IGABEM_API igabem_status igabem_tangent_kochin(const igabem_tangent *tangent, size_t m,
                                               const double *t, double dh[][2]);

/** Derivatives of igabem_wave_residuals(): fills dr[n][IGABEM_WAVE_RESIDUALS]. */
IGABEM_API igabem_status igabem_tangent_residuals(const igabem_tangent *tangent, double *dr);

/** Derivatives of C_w as igabem_forces_compute() gives it: by the adaptive rule of the Kochin
 * function, not by the residuals. Fills dcw[n]. */
IGABEM_API igabem_status igabem_tangent_cw(const igabem_tangent *tangent, double *dcw);

/** Derivatives of the wetted area of both sides: fills darea[n], m^2. */
IGABEM_API igabem_status igabem_tangent_wetted_area(const igabem_tangent *tangent, double *darea);

/** Derivatives of igabem_pressure_samples(), in the same order: fills dsample[n][samples], where
 * samples is the number that it gives for n_u x n_v parts. With the gradient of
 * igabem_pressure_sum() they make those of C_w by pressure.
 * Errors: IGABEM_ERROR_ARGUMENT: the formulation has no velocity on the hull. */
IGABEM_API igabem_status igabem_tangent_samples(const igabem_tangent *tangent, size_t n_u,
                                                size_t n_v, igabem_pressure_sample *dsample);

/** Derivatives of C_w, as igabem_tangent_cw() has them, with respect to y of every control point of
 * the hull, by one solve with the transposed system: their number costs next to nothing. Along a
 * field of moves the derivative is the sum of moves times these. Formulation exterior, half hulls.
 * @param hull     that of the solution
 * @param solution solved with igabem_options.keep_system it spares this call from assembling its
 *                 system again
 * @param dcw      [points], 1/m: of all patches, patch by patch, u slow and v fast; 0 for points
 *                 that have to stay in the centre plane. Of points that coincide on a collapsed
 *                 edge the sum counts
 *
 * Tells no progress. Errors: IGABEM_ERROR_ARGUMENT: another formulation, a hull given whole,
 * another hull than that of the solution. */
IGABEM_API igabem_status igabem_cw_gradient(const igabem_hull *hull,
                                            const igabem_solution *solution, double *dcw);

#ifdef __cplusplus
}
#endif

#endif
