#include "tangent/fold.h"

#include "core/vector_math.h"

#include <stdlib.h>
#include <string.h>

static bool reserve(const struct nodes *nodes, struct hull_nodes *hull)
{
    size_t width = 3 + nodes->side[0] + nodes->side[1];
    if (nodes->failed)
        return false;
    if (nodes->n > hull->capacity) {
        free(hull->w);
        hull->capacity = nodes->n + nodes->n / 2;
        hull->w = malloc(hull->capacity * width * sizeof *hull->w);
    }
    if (!hull->w) {
        hull->capacity = 0;
        return nodes->n == 0;
    }
    hull->nodes = nodes;
    hull->ws = hull->w + nodes->n;
    hull->wt = hull->w + 2 * nodes->n;
    hull->du = hull->w + 3 * nodes->n;
    hull->dv = hull->du + nodes->side[0] * nodes->n;
    return true;
}

bool hull_nodes_fill(const struct nodes *nodes, struct hull_nodes *hull)
{
    if (!reserve(nodes, hull))
        return false;
    for (size_t k = 0; k < nodes->blocks; k++) {
        const struct element *element = nodes->block[k].element;
        size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
        for (size_t i = nodes->block[k].begin; i < nodes->block[k].end; i++) {
            const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
            double *du = hull->du + i * nodes->side[0], *dv = hull->dv + i * nodes->side[1];
            double local[2], unused[ELEMENT_SIDE], w[3] = {0.0, 0.0, 0.0};
            nodes_local(nodes, element, i, local);
            bernstein(element->degree[0], local[0], unused, du);
            bernstein(element->degree[1], local[1], unused, dv);
            for (size_t a = 0; a < m; a++)
                for (size_t b = 0; b < n; b++) {
                    double weight = element->net[4 * (a * n + b) + 3];
                    w[0] += bu[a] * bv[b] * weight;
                    w[1] += du[a] * bv[b] * weight;
                    w[2] += bu[a] * dv[b] * weight;
                }
            hull->w[i] = w[0];
            hull->ws[i] = w[1];
            hull->wt[i] = w[2];
        }
    }
    return true;
}

void hull_nodes_free(struct hull_nodes *hull)
{
    free(hull->w);
    *hull = (struct hull_nodes){.nodes = NULL};
}

VECTOR_MULTIVERSION
void fold_hull(const struct hull_nodes *hull, const struct block *block, size_t first,
               const double *place, const double *hx, const double *hz, double *moment)
{
    const struct nodes *nodes = hull->nodes;
    const struct element *element = block->element;
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    for (size_t i = block->begin; i < block->end; i++) {
        const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
        const double *du = hull->du + i * nodes->side[0], *dv = hull->dv + i * nodes->side[1];
        const double *ds = nodes->jet + 6 * i, *dt = ds + 3;
        double inverse = 1.0 / hull->w[i], sign = element->sign * inverse, *to = moment;
        double x_turn = hx[i - first], z_turn = hz[i - first];
        double along = sign * (x_turn * dt[2] - z_turn * dt[0]);
        double across = sign * (z_turn * ds[0] - x_turn * ds[2]);
        double still = inverse * (place[i - first] - along * hull->ws[i] - across * hull->wt[i]);
        for (size_t a = 0; a < m; a++, to += n) {
            double x = still * bu[a] + along * du[a], y = across * bu[a];
            for (size_t b = 0; b < n; b++)
                to[b] += x * bv[b] + y * dv[b];
        }
    }
}

void fold_point(const struct element *element, const double local[2], double place,
                const double slope[2], double *moment)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double bu[ELEMENT_SIDE], du[ELEMENT_SIDE], bv[ELEMENT_SIDE], dv[ELEMENT_SIDE];
    double w[3] = {0.0, 0.0, 0.0};
    bernstein(element->degree[0], local[0], bu, du);
    bernstein(element->degree[1], local[1], bv, dv);
    for (size_t k = 0; k < m * n; k++) {
        double weight = element->net[4 * k + 3];
        w[0] += bu[k / n] * bv[k % n] * weight;
        w[1] += du[k / n] * bv[k % n] * weight;
        w[2] += bu[k / n] * dv[k % n] * weight;
    }
    double still = (place - (slope[0] * w[1] + slope[1] * w[2]) / w[0]) / w[0];
    for (size_t k = 0; k < m * n; k++)
        moment[k] += still * bu[k / n] * bv[k % n] +
                     (slope[0] * du[k / n] * bv[k % n] + slope[1] * bu[k / n] * dv[k % n]) / w[0];
}

void fold_face(const struct shape *shape, size_t part, const double local[2], const double jet[6],
               double sign, const double place[3], const double h[3], double *numbers)
{
    const double *ds = jet, *dt = jet + 3;
    double s = local[0], t = local[1];
    for (int c = 0; c < 3; c++) {
        int a = (c + 1) % 3, b = (c + 2) % 3;
        double along = sign * (dt[a] * h[b] - dt[b] * h[a]); /* of v_s */
        double across = sign * (h[a] * ds[b] - h[b] * ds[a]);
        if (c == 1) {
            numbers[shape->breadth] +=
                (place[1] * ((double)part + s) + along) / (double)shape->parts;
            continue;
        }
        /* The move of the rim falls to nothing at the still water. */
        double *corner = numbers + shape->corner + part + (c == 2 ? shape->parts + 1 : 0);
        double still = place[c] * (1.0 - t) - across;
        corner[0] += still * (1.0 - s) - along * (1.0 - t);
        corner[1] += still * s + along * (1.0 - t);
    }
}
