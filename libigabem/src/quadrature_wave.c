#include "quadrature_wave.h"

#include <math.h>

enum { WAVE_POINTS = 10, WAVE_DEPTH = 40 };

double wave_reach(const struct wave_rule *rule, double depth)
{
    /* On the waterline the depth is zero to rounding, of either sign. */
    double below = fmax(depth + rule->clearance, 0.0);
    double square = -log(rule->tolerance) / (rule->k0 * below) - 1.0;
    if (!(square < rule->t_max * rule->t_max))
        return rule->t_max;
    return sqrt(fmax(square, 0.0));
}

/* Gauss points for exp(i phase s), 0 <= s <= 1: the error is about (e |phase|/(8 n))^2n, and one
 * point more is for the basis. */
static int points(double phase, double tolerance)
{
    int n = 1;
    while (n <= WAVE_POINTS && pow(2.718281828459045 * phase / (8.0 * n), 2.0 * n) > tolerance)
        n++;
    return n < 2 ? 3 : n + 1;
}

/* Largest change of the exponent between two points at angle t. */
static double exponent(const struct wave_rule *rule, double t, const double a[3], const double b[3])
{
    double s2 = 1.0 + t * t;
    double phase = sqrt(s2) * (fabs(a[0] - b[0]) + t * fabs(a[1] - b[1]));
    return rule->k0 * hypot(phase, s2 * (a[2] - b[2]));
}

static void divide(const struct wave_rule *rule, const struct domain *domain, const double rect[4],
                   int depth, struct nodes *nodes)
{
    const double a[3] = {rect[0], 0.5 * (rect[0] + rect[1]), rect[1]};
    const double b[3] = {rect[2], 0.5 * (rect[2] + rect[3]), rect[3]};
    double p[3][3][3], top = -INFINITY, change[2] = {0.0, 0.0};
    domain_grid(domain, 3, a, 3, b, p[0]);
    for (int i = 0; i < 9; i++)
        top = fmax(top, p[i / 3][i % 3][2]);
    double t = wave_reach(rule, -top);
    for (int i = 0; i < 3; i++) {
        double u = exponent(rule, t, p[0][i], p[1][i]) + exponent(rule, t, p[1][i], p[2][i]);
        double v = exponent(rule, t, p[i][0], p[i][1]) + exponent(rule, t, p[i][1], p[i][2]);
        change[0] = fmax(change[0], u);
        change[1] = fmax(change[1], v);
    }
    int n[2] = {points(change[0], rule->tolerance), points(change[1], rule->tolerance)};
    if (depth == WAVE_DEPTH || (n[0] <= WAVE_POINTS && n[1] <= WAVE_POINTS)) {
        for (int d = 0; d < 2; d++)
            n[d] = n[d] > WAVE_POINTS ? WAVE_POINTS : n[d];
        cell_nodes(domain, rect, n, rule->gauss, nodes);
        return;
    }
    int d = change[1] > change[0];
    double part[4] = {rect[0], rect[1], rect[2], rect[3]};
    double middle = 0.5 * (rect[2 * d] + rect[2 * d + 1]);
    part[2 * d + 1] = middle;
    divide(rule, domain, part, depth + 1, nodes);
    part[2 * d] = middle;
    part[2 * d + 1] = rect[2 * d + 1];
    divide(rule, domain, part, depth + 1, nodes);
}

void wave_nodes(const struct wave_rule *rule, const struct domain *domain, struct nodes *nodes)
{
    const double whole[4] = {0.0, 1.0, 0.0, 1.0};
    divide(rule, domain, whole, 0, nodes);
}

void wave_line_nodes(const struct wave_rule *rule, const struct line *line,
                     const struct line_segment *segment, const double range[2], struct nodes *nodes)
{
    double t = wave_reach(rule, 0.0), change = 0.0;
    struct line_point point[5];
    for (int k = 0; k < 5; k++)
        line_evaluate(line, segment, range[0] + 0.25 * k * (range[1] - range[0]), &point[k]);
    for (int k = 0; k < 4; k++) {
        const double a[3] = {point[k].x, point[k].y, 0.0};
        const double b[3] = {point[k + 1].x, point[k + 1].y, 0.0};
        change += exponent(rule, t, a, b);
    }
    int n = points(change, rule->tolerance), pieces = 1;
    while (n > WAVE_POINTS) {
        pieces *= 2;
        n = points(change / pieces, rule->tolerance);
    }
    for (int k = 0; k < pieces; k++) {
        double step = (range[1] - range[0]) / pieces;
        const double part[2] = {range[0] + k * step, range[0] + (k + 1) * step};
        line_nodes(line, segment, part, n, rule->gauss, nodes);
    }
}
