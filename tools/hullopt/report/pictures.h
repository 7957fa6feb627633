/* The pictures of the report, each written as one <svg>. What
 * cannot be drawn is left out; without memory the command ends. */
#ifndef HULLOPT_PICTURES_H
#define HULLOPT_PICTURES_H

#include "report/results.h"

#include <stdio.h>

/* Designs by their objectives. */
void draw_front(FILE *out, const struct results *results);
void draw_history(FILE *out, const struct results *results);
/* Lines plans of both hulls, one over the other. */
void draw_lines(FILE *out, const struct results *results);
void draw_section_areas(FILE *out, const struct results *results);
/* The slope of the waterline along the hull, in which an inflection is an extremum. */
void draw_fairness(FILE *out, const struct results *results);
void draw_original(FILE *out, const struct results *results);
/* Coloured by how far each point moved, outwards positive. */
void draw_optimum(FILE *out, const struct results *results);
void draw_variance(FILE *out, const struct results *results);
void draw_error(FILE *out, const struct results *results);
void draw_mode(FILE *out, const struct results *results, size_t mode);
/* Wave patterns: the parent's above the centre line, the optimum's below. */
void draw_waves(FILE *out, const struct results *results);
/* Elevation along y = share x length. */
void draw_wave_cut(FILE *out, const struct results *results, double share);

#endif
