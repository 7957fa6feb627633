/* The recursion of eq. 16 on a tile of points. */
#ifndef GALV_SINE_KERNEL_H
#define GALV_SINE_KERNEL_H

#include <stddef.h>

/* Points per tile: the static factors of some tens of functions on one tile stay in the L1 cache.
 */
enum { GALV_TILE = 64 };

/* Arguments |a s + b| below this are reduced exactly. */
#define GALV_SINE_LIMIT 0x1p50

/* One function psi_i. The sine along a live axis is evaluated at the moved point: its argument is
 * pi (order (s + d per_length) + phase). All other factors are in the static product. */
typedef struct galv_sine_step {
    int direction;
    int live;
    int axis[3];
    double order[3], phase[3], per_length[3];
} galv_sine_step;

/* d[3][GALV_TILE] += the displacements of n steps with coefficients x, starting from d. factors:
 * one tile of static products per step. s: three tiles, (point - origin)/length. */
void galv_sine_tile(size_t n, const galv_sine_step *steps, const double *x, const double *factors,
                    const double *s, double *d);

/* v[p] *= sin(pi (order s[p] + phase)) for one tile. */
void galv_sine_factor(double order, double phase, const double *s, double *v);

#endif
