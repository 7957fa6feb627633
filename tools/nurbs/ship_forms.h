/* Parametric ship forms, wetted half (y >= 0) as one bicubic patch: x from the transom (0) to the
 * stem (length), u from stern to bow, v from the waterline to the keel. */
#ifndef SHIP_FORMS_H
#define SHIP_FORMS_H

#include <nurbs/surface.h>

struct ship_form {
    double length, beam, draft; /* m */
    double fullest;             /* place of the greatest beam, share of the length from aft */
    double transom_beam;        /* share of the beam */
    double transom_draft;       /* share of the draft */
    double run;                 /* the keel rises aft of this share of the length */
    double entrance;            /* exponent of the waterline forward of the greatest beam */
    double section[3];          /* superellipse exponents of the sections: aft, middle, bow */
    double rake;                /* forefoot behind the stem, share of the length */
    double bulb_length;         /* reach ahead of the stem at the waterline, share of the length */
    double bulb_beam;           /* half breadth of the bulb, share of the beam */
};

/* A fast round-bilge form with a wide immersed transom, and a bulbous bow over a narrow one. */
struct ship_form ship_form_fast(double length, double beam, double draft);
struct ship_form ship_form_bulb(double length, double beam, double draft);

/* Creates the patch: control points are the form at the Greville abscissae (Schoenberg's
 * variation-diminishing spline), so that no side of the form overshoots y = 0 or z = 0. */
nurbs_status ship_form_make(const struct ship_form *form, nurbs_surface **surface);

#endif
