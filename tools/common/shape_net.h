/* Control points of a NURBS surface as a shape modification: each moves the points of the surface
 * by its basis function. They are the surface's own, or those of a spline with few uniform spans
 * over the same parameters, whose values are added. */
#ifndef TOOLS_SHAPE_NET_H
#define TOOLS_SHAPE_NET_H

#include "shape_yaml.h"

/* A block of control points, from first to last, both included. */
struct shape_net_part {
    size_t first[2], last[2]; /* along u and v, from 0 */
    int directions[3];
    size_t n_directions;
    bool together; /* all by one parameter a direction */
    double bounds[2];
    bool has_bounds;
};

struct shape_net {
    size_t count[2], degree[2];
    size_t n_count, n_degree; /* 2, or 0 where it is not given */
    struct shape_net_part *parts;
    size_t n_parts;
};

/* Fills what is not given: the surface's own numbers, or the degree. */
void shape_net_complete(struct shape_net *net, const nurbs_surface *surface);

size_t shape_net_parameters(const struct shape_net_part *part);

/* The functions of all control points at all points, [points][count[0] count[1]], created; prints
 * why on failure. */
bool shape_net_basis(const struct shape_net *net, const struct shape_points *points,
                     double **basis);

/* Fills the displacement (3 npoints, zero before) by parameter k of the block; returns its
 * direction. */
int shape_net_field(const struct shape_net *net, const struct shape_net_part *part, size_t k,
                    size_t npoints, const double *basis, double *field);

#endif
