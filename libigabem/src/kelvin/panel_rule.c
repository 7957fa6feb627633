#include "kelvin/panel_rule.h"

#include "core/error.h"
#include "kelvin/kelvin_green.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Radon's rule of degree 5: the centroid and two orbits (a, a, 1 - 2a) of three nodes. The centroid
 * and the second orbit alone, with other weights, have degree 2: the difference estimates the
 * error. A triangle that is not settled is divided in four. */
enum {
    NODES = 7,
    BATCH = 36, /* triangles evaluated at once */
    DEEPEST = 14,
    /* A batch leaves at most three triangles more for each of its own, level by level. */
    MOST = 3 * BATCH * (DEEPEST + 1) + 64,
    /* What a row may cost: triangles for each panel, and beside that. */
    MOST_EACH = 500,
    MOST_MORE = 20000
};
static const double orbit[2] = {0.10128650732345633880, 0.47014206410511508977};
static const double weight[3] = {0.225, 0.12593918054482715260, 0.13239415278850618074};

struct triangle {
    size_t panel;
    int level;
    double corner[3][3];
};

struct panel_rule {
    size_t n, spent; /* triangles on the stack, and evaluated for this row */
    struct triangle stack[MOST];
    double at[3][NODES * BATCH], from[3][NODES * BATCH], g[4][NODES * BATCH];
};

struct panel_rule *panel_rule_create(void)
{
    return malloc(sizeof(struct panel_rule));
}

void panel_rule_free(struct panel_rule *rule)
{
    free(rule);
}

static void push(struct panel_rule *rule, size_t panel, int level, const double *a, const double *b,
                 const double *c)
{
    struct triangle *t = &rule->stack[rule->n++];
    t->panel = panel;
    t->level = level;
    memcpy(t->corner[0], a, sizeof t->corner[0]);
    memcpy(t->corner[1], b, sizeof t->corner[1]);
    memcpy(t->corner[2], c, sizeof t->corner[2]);
}

/* The point of edge ab in the plane x = cut. */
static void edge_point(const double *a, const double *b, double cut, double *at)
{
    double s = (cut - a[0]) / (b[0] - a[0]);
    for (int k = 0; k < 3; k++)
        at[k] = a[k] + s * (b[k] - a[k]);
    at[0] = cut;
}

/* Each of N and W has a kink in the plane x = x_P: no triangle crosses it. */
static void push_cut(struct panel_rule *rule, size_t panel, const double *corner[3], double cut)
{
    int ahead = 0, lonely = 0;
    for (int c = 0; c < 3; c++)
        ahead += corner[c][0] > cut;
    double least = fmin(fmin(corner[0][0], corner[1][0]), corner[2][0]);
    if (ahead == 0 || least >= cut) {
        push(rule, panel, 0, corner[0], corner[1], corner[2]);
        return;
    }
    for (int c = 0; c < 3; c++)
        if ((corner[c][0] > cut) == (ahead == 1))
            lonely = c;
    const double *a = corner[lonely], *b = corner[(lonely + 1) % 3], *c = corner[(lonely + 2) % 3];
    double ab[3], ac[3];
    edge_point(a, b, cut, ab);
    edge_point(a, c, cut, ac);
    push(rule, panel, 0, a, ab, ac);
    push(rule, panel, 0, ab, b, c);
    push(rule, panel, 0, ab, c, ac);
}

static double area(const struct triangle *t)
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = t->corner[1][k] - t->corner[0][k];
        b[k] = t->corner[2][k] - t->corner[0][k];
    }
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    return 0.5 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static void place_nodes(struct panel_rule *rule, size_t first, const struct triangle *t)
{
    for (size_t node = 0; node < NODES; node++) {
        double share[3] = {1.0 / 3, 1.0 / 3, 1.0 / 3};
        if (node > 0) {
            double a = orbit[(node - 1) / 3];
            share[0] = share[1] = share[2] = a;
            share[(node - 1) % 3] = 1 - 2 * a;
        }
        for (int k = 0; k < 3; k++)
            rule->from[k][first + node] = share[0] * t->corner[0][k] + share[1] * t->corner[1][k] +
                                          share[2] * t->corner[2][k];
        /* Corners of a warped panel may have been moved above the water. */
        rule->from[2][first + node] = fmin(rule->from[2][first + node], 0);
    }
}

/* As in QUADPACK: the error falls faster with the size than the difference of the two rules. */
static double judge(double difference, double modulus)
{
    double share = 5 * difference / modulus;
    return share < 1 ? modulus * share * sqrt(share) : difference;
}

/* The integral over a triangle whose nodes start at first, and whether it is settled. */
static bool integrate(const struct panel_rule *rule, size_t first, const struct triangle *t,
                      double tolerance, double sum[4])
{
    const double a = orbit[1], spread = (6 * a * a - 4 * a + 1) / 3 - 1.0 / 9;
    const double outer = 1.0 / 18 / spread, size = area(t);
    double error[4], modulus[4];
    for (int k = 0; k < 4; k++) {
        const double *g = rule->g[k] + first;
        double inner = g[1] + g[2] + g[3], rest = g[4] + g[5] + g[6];
        sum[k] = size * (weight[0] * g[0] + weight[1] * inner + weight[2] * rest);
        error[k] = fabs(sum[k] - size * ((1 - outer) * g[0] + outer / 3 * rest));
        modulus[k] =
            size * (weight[0] * fabs(g[0]) + weight[1] * (fabs(g[1]) + fabs(g[2]) + fabs(g[3])) +
                    weight[2] * (fabs(g[4]) + fabs(g[5]) + fabs(g[6])));
    }
    double slope = modulus[1] + modulus[2] + modulus[3];
    bool settled = judge(error[0], modulus[0]) <= tolerance * modulus[0];
    for (int k = 1; k < 4; k++)
        settled = settled && judge(error[k], slope) <= tolerance * slope;
    return settled;
}

static void push_quarters(struct panel_rule *rule, const struct triangle *t)
{
    double middle[3][3]; /* of the edge opposite to a corner */
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < 3; k++)
            middle[c][k] = 0.5 * (t->corner[(c + 1) % 3][k] + t->corner[(c + 2) % 3][k]);
    for (int c = 0; c < 3; c++)
        push(rule, t->panel, t->level + 1, t->corner[c], middle[(c + 2) % 3], middle[(c + 1) % 3]);
    push(rule, t->panel, t->level + 1, middle[0], middle[1], middle[2]);
}

/* Evaluates the last triangles of the stack; adds those that are settled, divides the others. */
static igabem_status settle(struct panel_rule *rule, double k0, size_t i, const double P[3],
                            const igabem_matrix_options *options, size_t limit, double (*out)[4])
{
    struct triangle batch[BATCH];
    size_t n = rule->n < BATCH ? rule->n : BATCH;
    rule->n -= n;
    rule->spent += n;
    memcpy(batch, rule->stack + rule->n, n * sizeof *batch);
    for (size_t t = 0; t < n; t++)
        place_nodes(rule, NODES * t, &batch[t]);
    for (int k = 0; k < 3; k++)
        for (size_t node = 0; node < NODES * n; node++)
            rule->at[k][node] = P[k];
    igabem_status status = kelvin_green_filtered(
        k0, NODES * n, rule->at[0], rule->at[1], rule->at[2], rule->from[0], rule->from[1],
        rule->from[2], options->parts & (IGABEM_LOCAL | IGABEM_WAVE), &options->filter, rule->g[0],
        rule->g[1], rule->g[2], rule->g[3]);
    for (size_t t = 0; status == IGABEM_OK && t < n; t++) {
        double sum[4];
        bool settled = integrate(rule, NODES * t, &batch[t], options->tolerance, sum);
        if (settled)
            for (int k = 0; k < 4; k++)
                out[batch[t].panel][k] += sum[k];
        else if (batch[t].level < DEEPEST && rule->spent <= limit)
            push_quarters(rule, &batch[t]);
        else
            status = igabem_fail(IGABEM_ERROR_NUMERIC,
                                 "panel %zu seen from point %zu: waves of z + zeta = %g are too "
                                 "short for the rule; a filter or a larger tolerance is needed",
                                 batch[t].panel, i, P[2] + batch[t].corner[0][2]);
    }
    return status;
}

igabem_status panel_rule_add(struct panel_rule *rule, double k0, size_t i, const double P[3],
                             size_t m, const struct panel *panels,
                             const igabem_matrix_options *options, double (*out)[4])
{
    igabem_status status = IGABEM_OK;
    rule->n = rule->spent = 0;
    for (size_t j = 0; j < m && status == IGABEM_OK; j++) {
        for (int t = 0; t < panels[j].corners - 2; t++) {
            int c[3];
            panel_triangle(&panels[j], t, c);
            const double *corner[3] = {panels[j].corner[c[0]], panels[j].corner[c[1]],
                                       panels[j].corner[c[2]]};
            push_cut(rule, j, corner, P[0]);
        }
        while (status == IGABEM_OK && (rule->n >= BATCH || (j + 1 == m && rule->n > 0)))
            status = settle(rule, k0, i, P, options, MOST_EACH * m + MOST_MORE, out);
    }
    return status;
}
