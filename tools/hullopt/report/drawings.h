/* The drawings of the report, each one <svg>. */
#ifndef HULLOPT_DRAWINGS_H
#define HULLOPT_DRAWINGS_H

#include "results.h"

#include <stdio.h>

/* Fig. 4 of the paper: retained variance, and the mean square error of eq. 10. */
void draw_variance(FILE *out, const struct latent *latent, double wanted);
void draw_error(FILE *out, const struct latent *latent);

/* Fig. 6: every evaluation and the best so far. */
void draw_history(FILE *out, const struct results *results);

/* A hull seen from the port bow, coloured by a value per grid point; both sides, port in front.
 * low and high are the values at the ends of the map. */
struct hull_view {
    size_t rows, columns;
    const double *points; /* rows x columns triples */
    const double *values; /* rows x columns, or NULL: plain grey */
    double low, high;
    bool diverging;
    const char *title, *low_label, *high_label, *bar_title;
};
void draw_hull(FILE *out, const struct hull_view *view);

/* Body plan of both hulls: aft half left, fore half right; Fig. 7. */
void draw_body_plan(FILE *out, const struct results *results);
void draw_section_areas(FILE *out, const struct results *results);

/* Wave patterns: the parent's above the centre line, the optimum's below. */
void draw_waves(FILE *out, const struct results *results);
/* Elevation along y = share x length. */
void draw_wave_cut(FILE *out, const struct results *results, double share);

#endif
