/* The Kochin function of a potential as a function of what the shape and the solution enter it by:
 * the places that radiate, and rows of derivatives at a wave angle. */
#ifndef POTENTIAL_WAVE_H
#define POTENTIAL_WAVE_H

#include "tangent/shape.h"

struct waves;

/* Places fine enough for wave angles up to t_max. */
igabem_status waves_create(const igabem_tangent *tangent, double t_max, struct waves **waves);
void waves_free(struct waves *waves);

/* Numbers of a row: coefficients of phi on the hull, those of phi_x there, the control values of
 * the hull's elements, those of struct shape. */
size_t waves_width(const struct waves *waves);

struct waves_work;
struct waves_work *waves_work_create(const struct waves *waves);
void waves_work_free(struct waves_work *work);

/* The Kochin function at wave angle t and its derivatives: fills h[2] and row[2][width]. */
void waves_row(const struct waves *waves, double t, struct waves_work *work, double h[2],
               double *row);

#endif
