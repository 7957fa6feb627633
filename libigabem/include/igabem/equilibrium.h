/**
 * @file equilibrium.h
 * Sinkage and trim at which a hull under way floats freely.
 */
#ifndef IGABEM_EQUILIBRIUM_H
#define IGABEM_EQUILIBRIUM_H

#include <igabem/solve.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What igabem_equilibrium_find() found. */
typedef struct igabem_equilibrium {
    double sinkage; /**< m, positive down */
    double trim;    /**< radians, positive bow up */
    double pivot;   /**< x of the transverse axis in the still water that the hull turns about, m */
    double change;  /**< draft at the worse end by which a further step would change, m */
    int solves;     /**< how many it took */
    double reserved[8]; /**< 0: room for members of later releases */
} igabem_equilibrium;

/** Finds the attitude in which buoyancy, weight and the dynamic pressure are in equilibrium: the
 * hull is placed, cut at the still water and solved until the draft changes by less than 1e-5 of
 * the length. The weight and its place are those of the hull at rest, the centre of gravity in the
 * still water plane: its height would add (KB - KG)/BM_L, about a per cent, to the stiffness in
 * trim.
 *
 * @param patches      surfaces that reach above the water (borrows)
 * @param placement    as for nurbs_hull_create(), NULL for its defaults: water level, length and
 *                     tolerances; its sinkage, trim and pivot are not read
 * @param options      one setting with the Kelvin kernel and a formulation that solves; frozen on
 *                     the hull at rest (igabem_options_freeze())
 * @param equilibrium  fills
 * @param hull         creates the hull in that attitude; NULL: not wanted
 * Errors: those of nurbs_hull_create() and igabem_solve() in some attitude; IGABEM_ERROR_ARGUMENT:
 * a submerged hull, or no pressure to float in; IGABEM_ERROR_NUMERIC: no equilibrium after 20
 * solves. */
IGABEM_API igabem_status igabem_equilibrium_find(const nurbs_patches *patches,
                                                 const nurbs_hull_options *placement,
                                                 igabem_options *options,
                                                 igabem_equilibrium *equilibrium,
                                                 nurbs_hull **hull);

#ifdef __cplusplus
}
#endif

#endif
