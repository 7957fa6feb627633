/* Cross sections x = constant of a hull side, as naval architects draw them. */
#ifndef HULLOPT_STATIONS_H
#define HULLOPT_STATIONS_H

#include <nurbs/nurbs.h>

#include <stdbool.h>
#include <stddef.h>

/* Points of a surface on a fine parameter grid, from which any number of sections is cut. */
struct stations {
    size_t nu, nv;
    double *points; /* nu x nv triples */
};
bool stations_create(const nurbs_surface *surface, struct stations *stations);
void stations_free(struct stations *stations);

/* Fills yz[nv][2] with the section at x, girth line by girth line; NAN where a line does not reach
 * x. Returns how many do. */
size_t stations_section(const struct stations *stations, double x, double (*yz)[2]);

/* Area of both sides of the section below z = 0, m^2. */
double stations_area(size_t n, const double (*yz)[2]);

#endif
