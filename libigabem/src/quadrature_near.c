#include "quadrature_near.h"

#include "constants.h"
#include "quadrature_regular.h"

#include <math.h>

enum {
    NEAR_POINTS = 6, /* dividing is cheaper than more points */
    NEAR_LEAST = 2,
    NEAR_DEPTH = 60 /* cells below 2^-30 of the element each way */
};

double near_scale(const struct near_rule *rule, double area, double distance)
{
    double decay = area / (4.0 * PI * distance * distance);
    return rule->k0 > 0 ? 2.0 * decay * fmin(1.0, rule->k0 * distance) : decay;
}

/* Points that density and shape ask for on a part of an element: they vary as if they were singular
 * one element away, until the rule integrates them exactly. */
static int least_points(const struct domain *domain, const double rect[4], int d, double scale,
                        double tolerance)
{
    int degree = domain->element->degree[d == 0 ? domain->along : 1 - domain->along];
    double half = 0.5 * (rect[2 * d + 1] - rect[2 * d]);
    int n = regular_points(1.0, half, scale, tolerance), exact = degree / 2 + 2;
    return n < NEAR_LEAST ? NEAR_LEAST : n > exact ? exact : n;
}

static void divide(const struct near_rule *rule, const struct domain *domain, const double rect[4],
                   int depth, struct nodes *nodes)
{
    double centre[3], half[2], square = 0.0;
    cell_extent(domain, rect, centre, half);
    for (int c = 0; c < 3; c++)
        square += (centre[c] - rule->point[c]) * (centre[c] - rule->point[c]);
    double distance = sqrt(square);
    int longer = half[1] > half[0], n[2];
    double scale = near_scale(rule, 4.0 * half[0] * half[1], distance);
    for (int d = 0; d < 2; d++)
        n[d] = regular_points(distance - half[1 - d], half[d], scale, rule->tolerance);
    if (depth == NEAR_DEPTH || (n[0] <= NEAR_POINTS && n[1] <= NEAR_POINTS)) {
        for (int d = 0; d < 2; d++) {
            int least = least_points(domain, rect, d, scale, rule->tolerance);
            n[d] = n[d] < least ? least : n[d] > NEAR_POINTS ? NEAR_POINTS : n[d];
        }
        cell_nodes(domain, rect, n, rule->gauss, nodes);
        return;
    }
    double part[4] = {rect[0], rect[1], rect[2], rect[3]};
    double middle = 0.5 * (rect[2 * longer] + rect[2 * longer + 1]);
    part[2 * longer + 1] = middle;
    divide(rule, domain, part, depth + 1, nodes);
    part[2 * longer] = middle;
    part[2 * longer + 1] = rect[2 * longer + 1];
    divide(rule, domain, part, depth + 1, nodes);
}

void near_nodes(const struct near_rule *rule, const struct domain *domain, struct nodes *nodes)
{
    const double whole[4] = {0.0, 1.0, 0.0, 1.0};
    divide(rule, domain, whole, 0, nodes);
}
