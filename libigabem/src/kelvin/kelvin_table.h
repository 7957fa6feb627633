/* Piecewise polynomials of the local part N, made at build time by tables/kelvin_tables.c.
 *
 * The octant X >= 0, Y >= 0, Z <= 0 is cut into three faces by the greatest of X, Y, |Z|, which is
 * called M; r = 1/M. On a face N/r is a function F(r, a, b) of
 *
 *     face 0 (M = X):    a = (Y/M)^2,  b = |Z|/M
 *     face 1 (M = Y):    a = X/M,      b = |Z|/M
 *     face 2 (M = |Z|):  a = (Y/M)^2,  b = X/M
 *
 * analytic on [0,1]^2 because N is analytic off the origin for X >= 0 and even in Y. a and b are
 * cut into KELVIN_CUTS equal parts, r at 2^e and 1.5 2^e between KELVIN_R_FAR and KELVIN_R_NEAR;
 * one zone reaches from r = 0 to KELVIN_R_FAR. Closer to the origin than M = 1/KELVIN_R_NEAR
 *
 *     N = -2 (1 + |Z|/(R+X)) - ln(M) L + K
 *
 * with tables of L and K in (M, a, b) instead; both are analytic at M = 0.
 *
 * A cell holds a polynomial of total degree D in its own coordinates x, y, z in [-1,1] of r (or M),
 * a, b: for i = D..0, for j = D-i..0, eight coefficients of x^i y^j z^k, k = 0..7; then, in the
 * same order with D-8 for D, those of z^8, z^9, ... */
#ifndef IGABEM_KELVIN_TABLE_H
#define IGABEM_KELVIN_TABLE_H

#include <stdint.h>

enum {
    KELVIN_CUTS = 3,
    KELVIN_CELLS_PER_ZONE =
        3 * KELVIN_CUTS * KELVIN_CUTS, /* (face * CUTS + cut of a) * CUTS + cut of b */
    KELVIN_R_FAR_EXPONENT = -6,
    KELVIN_R_NEAR_EXPONENT = 3,
    KELVIN_SHELLS = 2 * (KELVIN_R_NEAR_EXPONENT - KELVIN_R_FAR_EXPONENT),
    KELVIN_ZONE_FAR = KELVIN_SHELLS,
    KELVIN_ZONE_LOG_L,
    KELVIN_ZONE_LOG_K,
    KELVIN_ZONES,
    KELVIN_MOST_DEGREE = 20
};

#define KELVIN_R_FAR  0x1p-6
#define KELVIN_R_NEAR 0x1p3

typedef struct kelvin_cell {
    uint32_t offset; /* of the first coefficient, in doubles, a multiple of 8 */
    uint32_t degree;
} kelvin_cell;

extern const kelvin_cell kelvin_cells[KELVIN_ZONES * KELVIN_CELLS_PER_ZONE];
extern const double kelvin_coefficients[];

#endif
