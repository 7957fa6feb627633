/* The waterline of a half hull as its half breadth over x. */
#ifndef WATERLINE_H
#define WATERLINE_H

#include "space/density.h"

struct waterline {
    size_t n; /* points by increasing x; 0: the body is submerged */
    struct waterline_point {
        double x, y;
        size_t patch;
        double uv[2];
    } * point;
    double aft, fore; /* its ends, or those of a submerged body */
};

/* Errors: IGABEM_ERROR_GEOMETRY: it turns back on itself. */
igabem_status waterline_create(const struct density *density, double aft, double fore,
                               struct waterline *waterline);
void waterline_free(struct waterline *waterline);

/* Half breadth, 0 beyond its ends. */
double waterline_breadth(const struct waterline *waterline, double x);

/* Patch and parameters of the waterline at x, between its ends. */
igabem_status waterline_locate(const struct waterline *waterline, const struct density *density,
                               double x, size_t *patch, double uv[2]);

#endif
