/* Adaptive subdivision towards a point close to, but not on, a piece of surface or line. */
#ifndef QUADRATURE_NEAR_H
#define QUADRATURE_NEAR_H

#include "space/cell.h"

struct near_rule {
    double point[3];
    double tolerance;
    double k0; /* 0: the kernel grows like 1/r^2; else like k0/r within 1/k0 of the point, 2/r^2
                  beyond (the local part N) */
    const struct gauss *gauss;
};

/* Magnitude of the integral of the kernel over an area, or a length when the kernel is that of the
 * waterline, at a distance. */
double near_scale(const struct near_rule *rule, double area, double distance);

/* Appends the nodes of a rule for the domain: halves cells until regular_points asks for no more
 * than a few points each way. */
void near_nodes(const struct near_rule *rule, const struct domain *domain, struct nodes *nodes);

#endif
