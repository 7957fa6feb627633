#include "space/quadrature_near.h"

#include "core/constants.h"
#include "space/quadrature_regular.h"

#include <math.h>

enum {
    NEAR_LEAST = 2,
    NEAR_DEPTH = 60 /* cells below 2^-30 of the element each way */
};

/* Points a direction beyond which dividing is cheaper: more for more digits. */
static int near_most(double tolerance)
{
    double n = 1.0 - log10(tolerance);
    return n < 6 ? 6 : n > 12 ? 12 : (int)n;
}

double near_scale(const struct near_rule *rule, double area, double distance)
{
    double decay = area / (4.0 * PI * distance * distance);
    return rule->k0 > 0 ? 2.0 * decay * fmin(1.0, rule->k0 * distance) : decay;
}

static void divide(const struct near_rule *rule, const struct domain *domain, const double rect[4],
                   int depth, struct nodes *nodes)
{
    struct cell_extent extent;
    double square = 0.0;
    cell_extent(domain, rect, &extent);
    for (int c = 0; c < 3; c++)
        square += (extent.centre[c] - rule->point[c]) * (extent.centre[c] - rule->point[c]);
    double distance = sqrt(square);
    const double *half = extent.half;
    double scale = near_scale(rule, 4.0 * half[0] * half[1], distance);
    int n[2], most = near_most(rule->tolerance);
    for (int d = 0; d < 2; d++) {
        int degree = domain->element->degree[d == 0 ? domain->along : 1 - domain->along];
        const struct factor factor = {degree, rect[2 * d + 1] - rect[2 * d]};
        int kernel =
            regular_points(distance - half[1 - d], half[d], &factor, scale, rule->tolerance);
        int shape = shape_points(extent.chord[d], extent.bend[d], &factor, scale, rule->tolerance);
        if (shape > most && domain->part != DOMAIN_WHOLE)
            shape = most;
        n[d] = kernel > shape ? kernel : shape;
        n[d] = n[d] < NEAR_LEAST ? NEAR_LEAST : n[d];
    }
    if (depth == NEAR_DEPTH || (n[0] <= most && n[1] <= most)) {
        for (int d = 0; d < 2; d++)
            n[d] = n[d] > most ? most : n[d];
        cell_nodes(domain, rect, n, rule->gauss, nodes);
        return;
    }
    int split = n[0] > most && n[1] > most ? half[1] > half[0] : n[1] > most;
    double part[4] = {rect[0], rect[1], rect[2], rect[3]};
    double middle = 0.5 * (rect[2 * split] + rect[2 * split + 1]);
    part[2 * split + 1] = middle;
    divide(rule, domain, part, depth + 1, nodes);
    part[2 * split] = middle;
    part[2 * split + 1] = rect[2 * split + 1];
    divide(rule, domain, part, depth + 1, nodes);
}

void near_nodes(const struct near_rule *rule, const struct domain *domain, struct nodes *nodes)
{
    const double whole[4] = {0.0, 1.0, 0.0, 1.0};
    divide(rule, domain, whole, 0, nodes);
}
