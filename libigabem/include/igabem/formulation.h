/**
 * @file formulation.h
 * The formulations of the wave resistance problem and what sets them apart: the one table that the
 * solver, its results and its callers ask. docs/theory.md has the equations.
 */
#ifndef IGABEM_FORMULATION_H
#define IGABEM_FORMULATION_H

#include <igabem/status.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What is solved, and what radiates: igabem_formulation_info() tells. */
typedef enum igabem_formulation {
    IGABEM_FORMULATION_AUTO, /**< by the hull: igabem_options_freeze() chooses */
    IGABEM_FORMULATION_NEUMANN_KELVIN,
    IGABEM_FORMULATION_NEUMANN_KELVIN_STERN,
    IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN,
    IGABEM_FORMULATION_HOGNER,
    IGABEM_FORMULATION_MICHELL,
    IGABEM_FORMULATION_EXTERIOR,
    IGABEM_FORMULATION_DOUBLE_MODEL
} igabem_formulation;

/** A formulation, with the Kelvin kernel. Of IGABEM_FORMULATION_AUTO: what holds whichever it
 * chooses. */
typedef struct igabem_formulation_row {
    const char *name;     /**< on the command line */
    const char *sentence; /**< what it is, in one line */
    bool solves;          /**< its density solves a linear system, and the hull has a velocity; else
                             sigma = U n_x and neither velocity nor pressure */
    bool kelvin_rows;  /**< the system holds N and W: the waves act on the hull, and the short-wave
                          filter changes the density */
    bool stern_rows;   /**< the same ahead of x_s only, the double body aft of it */
    bool line_term;    /**< Brard's waterline integral radiates, where it is asked for */
    bool pressure;     /**< the pressure on the hull gives a wave resistance */
    bool centre_plane; /**< the sources radiate from the centre plane */
    bool potential; /**< the unknown is the potential on hull and free surface, by Green's identity
                       in the water outside; else a source density on the hull alone */
    bool double_model; /**< of a potential: the free surface is linearised about the double-body
                          flow, which runs along the hull, else about the free stream */
    bool tangents;     /**< it has derivatives along moves of the hull: igabem_tangent_create() */
} igabem_formulation_row;

/** The row of a formulation; NULL if there is no such one, so that counting up from
 * IGABEM_FORMULATION_AUTO meets every one. */
IGABEM_API const igabem_formulation_row *igabem_formulation_info(igabem_formulation formulation);

/** Name of a formulation, NULL if unknown; and back (returns false if there is no such name). */
IGABEM_API const char *igabem_formulation_name(igabem_formulation formulation);
/** Finds the formulation of a name as on the command line; IGABEM_ERROR_ARGUMENT for others. */
IGABEM_API bool igabem_formulation_parse(const char *name, igabem_formulation *formulation);

#ifdef __cplusplus
}
#endif

#endif
