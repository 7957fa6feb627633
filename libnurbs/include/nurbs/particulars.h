/**
 * @file particulars.h
 * The figures by which a naval architect knows a hull at rest: perpendiculars, sectional areas,
 * form coefficients, stability. Axes and still water are those of nurbs_hull.
 */
#ifndef NURBS_PARTICULARS_H
#define NURBS_PARTICULARS_H

#include <nurbs/hull.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Of the light surfaces, what a solver takes. NAN: has no meaning for this hull (no waterline, no
 * height of the centre of gravity). */
typedef struct nurbs_particulars {
    nurbs_hydrostatics hydrostatics;
    double length;             /**< reference length, m */
    double perpendicular[2];   /**< x of the aft and of the fore one, m */
    double waterline_length;   /**< m */
    double mass;               /**< kg */
    double lcb_from_fore;      /**< centre of buoyancy aft of the fore perpendicular, m */
    double lcb_percent;        /**< the same in per cent of the length, forward of midship */
    double kb;                 /**< centre of buoyancy above the keel amidships, m */
    double lcf, lcf_from_fore; /**< x of the centre of flotation; aft of the fore one, m */
    double bmt, bml;           /**< metacentric radii, transverse and longitudinal, m */
    double kmt, gmt;           /**< metacentric heights above keel and centre of gravity, m */
    double tpc;                /**< tonnes per centimetre of immersion */
    double mtc;                /**< moment to change trim by one centimetre, t m/cm */
    double cb, cm, cp, cwp,
        cvp;              /**< block, largest section, prismatic, waterplane and vertical
                               prismatic coefficient, on waterline length, beam and keel draft */
    double transom_ratio; /**< immersed transom over the largest section */
    double bulb_ratio;    /**< section at the fore perpendicular over the largest */
    double reserved[8];   /**< 0: room for members of later releases */
} nurbs_particulars;

/** @param density  of the water, kg/m^3, > 0
 * @param kg       height of the centre of gravity above the keel, m; NAN: not known
 * Errors: NURBS_ERROR_ARGUMENT, and those of nurbs_hydrostatics_compute(). */
NURBS_API nurbs_status nurbs_hull_particulars(const nurbs_hull *hull, double density, double kg,
                                              nurbs_particulars *particulars);

/** Fills x of the aft and the fore perpendicular, stations 0 and 20 of a lines plan, a reference
 * length (the option's or the file's) apart: from x = 0 or half of it to both sides where these
 * ends lie within 5 % of the waterline's, else from the aft end of the waterline. Without a
 * reference length, or with one of more than 1.05 times the waterline: the ends of the waterline;
 * of the body if it has none. */
NURBS_API nurbs_status nurbs_hull_perpendiculars(const nurbs_hull *hull, double x[2]);

/** Fills areas of the sections x = constant of both sides of the light surfaces, m^2; 0 beside the
 * hull. Overhangs and inner sides subtract. By triangles, 256 x 256 pairs a patch at least: within
 * 1e-4 of the largest section.
 * @param x  [n] m, ascending or not */
NURBS_API nurbs_status nurbs_hull_section_areas(const nurbs_hull *hull, size_t n, const double *x,
                                                double *area);

/** Creates the waterline of the wetted surfaces at y >= 0: points x,y, just below the still water
 * (1e-4 of the draft), from aft. For drawing.
 * @param n   fills how many, 0 if there is none
 * @param xy  free() */
NURBS_API nurbs_status nurbs_hull_waterline(const nurbs_hull *hull, size_t *n, double **xy);

#ifdef __cplusplus
}
#endif

#endif
