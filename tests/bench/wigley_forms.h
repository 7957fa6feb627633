/* Relatives of the Wigley hull, of unit length, with what it lacks: a rounded stem, flare, trim, a
 * full bow. Each maker creates a hull whose density wants options.elements_u and elements_v. */
#ifndef WIGLEY_FORMS_H
#define WIGLEY_FORMS_H

#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

/* y = (B/2) sqrt(f^2 + 2 e f) (1 - zeta^2), f = 1 - 4 x^2, zeta = z/T: stem arcs of radius B^2 e;
 * e = 0 is the Wigley hull. The parameter u is the angle arccos(-2x). */
nurbs_status rounded_wigley(double beam, double draft, double radius, nurbs_surface **surface);

/* y = (B/2) f (1 - zeta^2) (1 + c zeta): the side leans outwards by atan(c B/(2T)) at midships. */
nurbs_status flared_wigley(double beam, double draft, double c, nurbs_surface **surface);

/* The Wigley hull turned bow up by an angle about midships and sunk, cut at z = 0. Above the water
 * at rest it goes on with the same equation. */
nurbs_status trimmed_wigley(double beam, double draft, double bow_up, double sinkage,
                            nurbs_surface **surface);

#endif
