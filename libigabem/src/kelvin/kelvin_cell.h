/* Where a point of the octant falls in the tables of N, and the chain rule back from the tables'
 * coordinates; shared by the gradient and the second derivatives. Notation of kelvin_table.h. */
#ifndef IGABEM_KELVIN_CELL_H
#define IGABEM_KELVIN_CELL_H

#include "kelvin/kelvin_simd.h"
#include "kelvin/kelvin_table.h"

#include <math.h>
#include <stdbool.h>

/* M, 1/M, the face and its coordinates; kappa is the power in a = (.../M)^kappa, ratio = Y/M where
 * it is 2. */
struct kelvin_place {
    int face;
    double M, r, a, b, kappa, ratio;
};

/* A cell's polynomial coordinates at the point, and d(coordinate)/d(r or M) and d/da = d/db. */
struct kelvin_coordinates {
    const kelvin_cell *cell;
    double x, y, z, dx;
};
#define KELVIN_DY (2.0 * KELVIN_CUTS)

KELVIN_INLINE void kelvin_place_point(double X, double Y, double U, struct kelvin_place *place)
{
    if (X >= Y && X >= U) {
        double r = 1 / X, ratio = Y * r;
        *place = (struct kelvin_place){0, X, r, ratio * ratio, U * r, 2, ratio};
    } else if (Y >= U) {
        double r = 1 / Y;
        *place = (struct kelvin_place){1, Y, r, X * r, U * r, 1, 0.5};
    } else {
        double r = 1 / U, ratio = Y * r;
        *place = (struct kelvin_place){2, U, r, ratio * ratio, X * r, 2, ratio};
    }
}

KELVIN_INLINE void kelvin_cell_coordinates(const struct kelvin_place *place, int zone,
                                           struct kelvin_coordinates *at)
{
    double a = place->a * KELVIN_CUTS, b = place->b * KELVIN_CUTS;
    int i = (int)a, j = (int)b;
    i = i < KELVIN_CUTS ? i : KELVIN_CUTS - 1;
    j = j < KELVIN_CUTS ? j : KELVIN_CUTS - 1;
    at->y = 2 * (a - i) - 1;
    at->z = 2 * (b - j) - 1;
    at->cell = &kelvin_cells[zone * KELVIN_CELLS_PER_ZONE +
                             (place->face * KELVIN_CUTS + i) * KELVIN_CUTS + j];
}

/* The zone of r < KELVIN_R_NEAR and the coordinate x in it. Two zones per octave: the first
 * mantissa bit tells them apart. */
KELVIN_INLINE void kelvin_shell_coordinates(const struct kelvin_place *place,
                                            struct kelvin_coordinates *at)
{
    if (place->r < KELVIN_R_FAR) {
        at->dx = 2 / KELVIN_R_FAR;
        at->x = at->dx * place->r - 1;
        kelvin_cell_coordinates(place, KELVIN_ZONE_FAR, at);
        return;
    }
    uint64_t bits, power_bits;
    memcpy(&bits, &place->r, sizeof bits);
    int zone = (int)(bits >> 51) - 2 * (1023 + KELVIN_R_FAR_EXPONENT);
    power_bits = (UINT64_C(2046) << 52) - (bits & UINT64_C(0x7ff0000000000000));
    memcpy(&at->dx, &power_bits, sizeof at->dx);
    at->dx *= 4;
    at->x = at->dx * place->r - (zone & 1 ? 7 : 5);
    kelvin_cell_coordinates(place, zone, at);
}

/* The closed part C = -2 (1 + U/(R+X)) of N next to the origin, per unit M, at X, Y, U divided by
 * M. */
struct kelvin_pole {
    double value, dX, dY, dU;
};

KELVIN_INLINE void kelvin_pole_at(double X, double Y, double U, struct kelvin_pole *pole)
{
    double R = sqrt(X * X + Y * Y + U * U), s = 1 / (R + X), u = U * s / R;
    pole->value = -2 * (1 + U * s);
    pole->dX = 2 * u;
    pole->dY = 2 * u * Y * s;
    pole->dU = -2 * (s - u * U * s);
}

#endif
