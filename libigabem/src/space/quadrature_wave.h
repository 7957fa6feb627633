/* Quadrature of exp(k0 (1+t^2) z + i k0 sqrt(1+t^2) (x +- t y)) over pieces of surface or line, for
 * all wave angles up to a limit at once. */
#ifndef QUADRATURE_WAVE_H
#define QUADRATURE_WAVE_H

#include "space/line.h"

struct wave_rule {
    double k0;
    double t_max;     /* largest angle in use */
    double clearance; /* depth of the other end of the path, >= 0: angles beyond the reach of
                         e^{-k0 (1+t^2) (clearance + depth of the piece)} do not matter */
    double tolerance; /* relative error at the angles that matter */
    const struct gauss *gauss;
};

/* The largest angle that matters at a depth. */
double wave_reach(const struct wave_rule *rule, double depth);

void wave_nodes(const struct wave_rule *rule, const struct domain *domain, struct nodes *nodes);
void wave_line_nodes(const struct wave_rule *rule, const struct line *line,
                     const struct line_segment *segment, const double range[2],
                     struct nodes *nodes);

#endif
