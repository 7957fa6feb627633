#include "space/quadrature_wave.h"

#include "space/quadrature_regular.h"

#include <math.h>

enum {
    WAVE_POINTS = 12,
    WAVE_LINE_LEAST = 3, /* the strength along the line turns with the normal */
    WAVE_PARTS = 4,
    WAVE_DEPTH = 40
};

double wave_reach(const struct wave_rule *rule, double depth)
{
    /* On the waterline the depth is zero to rounding, of either sign. */
    double below = fmax(depth + rule->clearance, 0.0);
    double square = -log(rule->tolerance) / (rule->k0 * below) - 1.0;
    if (!(square < rule->t_max * rule->t_max))
        return rule->t_max;
    return sqrt(fmax(square, 0.0));
}

static double power(double x, int n)
{
    double product = 1.0;
    for (int k = 0; k < n; k++)
        product *= x;
    return product;
}

/* Gauss points for exp(i phase s) times one basis function, 0 <= s <= 1: the remainder is about
 * q^2n, q = e phase/(8 n), and a polynomial of degree p with the Chebyshev coefficient share^p/4
 * takes p of the 2n degrees. */
static int points(double phase, const struct factor *factor, double tolerance)
{
    for (int n = 1; n <= WAVE_POINTS; n++) {
        double q = 2.718281828459045 * fmax(phase, 1e-6) / (8.0 * n);
        double basis = 0.25 * power(factor->share / q, factor->degree);
        if (power(q * q, n) * fmax(1.0, basis) <= tolerance)
            return n;
    }
    return WAVE_POINTS + 1;
}

/* A stretch of surface or line: sums of |dx|, |dy| and |dz| along it. */
struct stretch {
    double d[3];
};

/* Change of the exponent along it at angle t. */
static double exponent(const struct wave_rule *rule, double t, const struct stretch *stretch)
{
    double s2 = 1.0 + t * t;
    return rule->k0 * hypot(sqrt(s2) * (stretch->d[0] + t * stretch->d[1]), s2 * stretch->d[2]);
}

/* Points that the angles up to the reach ask for on any of the stretches. The waves that vary
 * fastest have decayed most, and their relative error may be greater by as much: over each part of
 * the range the decay at its beginning and the exponent at its end count. */
static int wave_points(const struct wave_rule *rule, double depth, size_t n,
                       const struct stretch *stretch, const struct factor *factor)
{
    double reach = wave_reach(rule, depth), decay = rule->k0 * (rule->clearance + depth);
    int most = 1;
    for (int part = 0; part < WAVE_PARTS; part++) {
        double from = reach * sqrt((double)part / WAVE_PARTS);
        double to = reach * sqrt((part + 1.0) / WAVE_PARTS), change = 0.0;
        for (size_t i = 0; i < n; i++)
            change = fmax(change, exponent(rule, to, &stretch[i]));
        int m =
            points(change, factor, rule->tolerance * exp((1.0 + from * from) * fmax(decay, 0.0)));
        most = m > most ? m : most;
    }
    return most;
}

/* The edges and the middle line of a cell along direction d; chord and second difference of the
 * latter. */
static void lines(const double p[3][3][3], int d, struct stretch stretch[3], double *chord,
                  double *bend)
{
    for (int i = 0; i < 3; i++) {
        const double *a = d == 0 ? p[0][i] : p[i][0], *b = p[d == 0 ? 1 : i][d == 0 ? i : 1],
                     *c = d == 0 ? p[2][i] : p[i][2];
        double first = 0.0, second = 0.0;
        for (int k = 0; k < 3; k++) {
            stretch[i].d[k] = fabs(b[k] - a[k]) + fabs(c[k] - b[k]);
            first += (c[k] - a[k]) * (c[k] - a[k]);
            second += (a[k] - 2.0 * b[k] + c[k]) * (a[k] - 2.0 * b[k] + c[k]);
        }
        if (i == 1) {
            *chord = sqrt(first);
            *bend = sqrt(second);
        }
    }
}

static void divide(const struct wave_rule *rule, const struct domain *domain, const double rect[4],
                   int depth, struct nodes *nodes)
{
    const double a[3] = {rect[0], 0.5 * (rect[0] + rect[1]), rect[1]};
    const double b[3] = {rect[2], 0.5 * (rect[2] + rect[3]), rect[3]};
    double p[3][3][3], top = -INFINITY, share = (rect[1] - rect[0]) * (rect[3] - rect[2]);
    int n[2];
    domain_grid(domain, 3, a, 3, b, p[0]);
    for (int i = 0; i < 9; i++)
        top = fmax(top, p[i / 3][i % 3][2]);
    for (int d = 0; d < 2; d++) {
        int degree = domain->element->degree[d == 0 ? domain->along : 1 - domain->along];
        const struct factor factor = {degree, rect[2 * d + 1] - rect[2 * d]};
        struct stretch stretch[3];
        double chord, bend;
        lines((const double(*)[3][3])p, d, stretch, &chord, &bend);
        int wave = wave_points(rule, -top, 3, stretch, &factor);
        int shape = shape_points(chord, bend, &factor, share, rule->tolerance);
        if (shape > WAVE_POINTS && domain->part != DOMAIN_WHOLE)
            shape = WAVE_POINTS;
        n[d] = wave > shape ? wave : shape;
    }
    if (depth == WAVE_DEPTH || (n[0] <= WAVE_POINTS && n[1] <= WAVE_POINTS)) {
        for (int d = 0; d < 2; d++)
            n[d] = n[d] > WAVE_POINTS ? WAVE_POINTS : n[d];
        cell_nodes(domain, rect, n, rule->gauss, nodes);
        return;
    }
    int d = n[1] > n[0];
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
    struct stretch stretch = {{0.0, 0.0, 0.0}};
    struct line_point point[5];
    for (int k = 0; k < 5; k++)
        line_evaluate(line, segment, range[0] + 0.25 * k * (range[1] - range[0]), &point[k]);
    for (int k = 0; k < 4; k++) {
        stretch.d[0] += fabs(point[k + 1].x - point[k].x);
        stretch.d[1] += fabs(point[k + 1].y - point[k].y);
    }
    struct factor factor = {segment->element->degree[1 - segment->fixed], range[1] - range[0]};
    int n = wave_points(rule, 0.0, 1, &stretch, &factor), pieces = 1;
    while (n > WAVE_POINTS) {
        pieces *= 2;
        stretch.d[0] *= 0.5;
        stretch.d[1] *= 0.5;
        factor.share *= 0.5;
        n = wave_points(rule, 0.0, 1, &stretch, &factor);
    }
    n = n < WAVE_LINE_LEAST ? WAVE_LINE_LEAST : n;
    for (int k = 0; k < pieces; k++) {
        double step = (range[1] - range[0]) / pieces;
        const double part[2] = {range[0] + k * step, range[0] + (k + 1) * step};
        line_nodes(line, segment, part, n, rule->gauss, nodes);
    }
}
