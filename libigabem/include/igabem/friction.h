/**
 * @file friction.h
 * From wave resistance to total resistance: the friction line of the ITTC and a form factor.
 */
#ifndef IGABEM_FRICTION_H
#define IGABEM_FRICTION_H

#include <igabem/solve.h>

#ifdef __cplusplus
extern "C" {
#endif

/** ITTC-57 model-ship correlation line, C_f = 0.075/(log10 Re - 2)^2 (8th ITTC, Madrid 1957); NAN
 * for Re <= 1000 and for NAN. */
IGABEM_API double igabem_friction_ittc57(double reynolds);

/** The water, and how the hull departs from a plank in it. */
typedef struct igabem_water {
    double density;     /**< kg/m^3 */
    double viscosity;   /**< kinematic, m^2/s */
    double form_factor; /**< k of C_t = (1 + k) C_f + C_w */
} igabem_water;

/** Resistance of a hull in a viscous fluid. */
typedef struct igabem_total {
    double reynolds;    /**< U L/nu */
    double cf;          /**< ITTC-57; NAN for Re <= 1000 */
    double ct;          /**< (1 + k) C_f + C_w, on S as C_w; NAN likewise */
    double rt;          /**< N; NAN likewise */
    double reserved[8]; /**< 0: room for members of later releases */
} igabem_total;

/** Fills total from the speed, wetted area and C_w of forces.
 * @param length of the Reynolds number, m, > 0: igabem_hull_info.length
 * Errors: IGABEM_ERROR_ARGUMENT: density, viscosity or length not positive, a form factor that is
 * not finite, forces without waves (C_w is NAN). */
IGABEM_API igabem_status igabem_total_resistance(const igabem_forces *forces, double length,
                                                 const igabem_water *water, igabem_total *total);

#ifdef __cplusplus
}
#endif

#endif
