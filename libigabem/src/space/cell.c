#include "space/cell.h"

#include "core/error.h"
#include "core/vector_math.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

igabem_status gauss_fill(struct gauss *gauss)
{
    for (size_t n = 1; n <= GAUSS_MAX; n++)
        if (nurbs_gauss_legendre(n, gauss->node[n], gauss->weight[n]) != NURBS_OK)
            return igabem_fail(IGABEM_ERROR_NUMERIC, "%s", nurbs_last_error());
    return IGABEM_OK;
}

void nodes_init(struct nodes *nodes, const struct mesh *mesh)
{
    *nodes = (struct nodes){.side = {mesh->degree[0] + 1, mesh->degree[1] + 1}};
}

void nodes_clear(struct nodes *nodes)
{
    nodes->n = nodes->blocks = 0;
}

void nodes_free(struct nodes *nodes)
{
    free(nodes->x);
    free(nodes->block);
    nodes->x = NULL;
    nodes->block = NULL;
    nodes->n = nodes->capacity = nodes->blocks = nodes->block_capacity = 0;
}

/* All arrays live in one allocation, each with room for `capacity` nodes. */
static int nodes_grow(struct nodes *nodes, size_t needed)
{
    size_t capacity = nodes->capacity ? nodes->capacity : 1024;
    while (capacity < needed)
        capacity *= 2;
    size_t normal = nodes->with_normals ? 3 : 0, jet = nodes->with_jets ? 6 : 0;
    size_t per_node = 4 + nodes->side[0] + nodes->side[1] + normal + jet;
    double *all = malloc(capacity * per_node * sizeof *all);
    if (!all)
        return 0;
    enum { ARRAYS = 8 };
    double *old[ARRAYS] = {nodes->x,  nodes->y,  nodes->z,      nodes->g,
                           nodes->bu, nodes->bv, nodes->normal, nodes->jet};
    size_t width[ARRAYS] = {1, 1, 1, 1, nodes->side[0], nodes->side[1], normal, jet};
    double *at = all, *fresh[ARRAYS];
    for (int k = 0; k < ARRAYS; k++) {
        fresh[k] = at;
        if (nodes->n && width[k])
            memcpy(at, old[k], nodes->n * width[k] * sizeof *at);
        at += capacity * width[k];
    }
    free(nodes->x);
    nodes->x = fresh[0];
    nodes->y = fresh[1];
    nodes->z = fresh[2];
    nodes->g = fresh[3];
    nodes->bu = fresh[4];
    nodes->bv = fresh[5];
    nodes->normal = fresh[6];
    nodes->jet = fresh[7];
    nodes->capacity = capacity;
    return 1;
}

size_t nodes_append(struct nodes *nodes, const struct element *element, size_t m)
{
    if (nodes->failed)
        return SIZE_MAX;
    if (nodes->n + m > nodes->capacity && !nodes_grow(nodes, nodes->n + m)) {
        nodes->failed = true;
        return SIZE_MAX;
    }
    struct block *last = nodes->blocks ? &nodes->block[nodes->blocks - 1] : NULL;
    if (!last || last->element != element) {
        if (nodes->blocks == nodes->block_capacity) {
            size_t capacity = nodes->block_capacity ? 2 * nodes->block_capacity : 64;
            struct block *block = realloc(nodes->block, capacity * sizeof *block);
            if (!block) {
                nodes->failed = true;
                return SIZE_MAX;
            }
            nodes->block = block;
            nodes->block_capacity = capacity;
        }
        last = &nodes->block[nodes->blocks++];
        *last = (struct block){element, nodes->n, nodes->n};
    }
    size_t first = nodes->n;
    nodes->n += m;
    last->end = nodes->n;
    return first;
}

/* The curve of constant `across` parameter: homogeneous Bezier points and their derivatives across,
 * [degree along + 1][4] each. */
static void element_line(const struct element *element, int along, const double *b,
                         const double *db, double (*line)[4], double (*derivative)[4])
{
    size_t m = (size_t)element->degree[along] + 1, n = (size_t)element->degree[1 - along] + 1;
    size_t columns = (size_t)element->degree[1] + 1;
    size_t step_along = 4 * (along == 0 ? columns : 1),
           step_across = 4 * (along == 0 ? 1 : columns);
    for (size_t i = 0; i < m; i++) {
        const double *net = element->net + i * step_along;
        double h[4] = {0}, d[4] = {0};
        for (size_t j = 0; j < n; j++, net += step_across)
            for (size_t c = 0; c < 4; c++) {
                h[c] += b[j] * net[c];
                d[c] += db[j] * net[c];
            }
        memcpy(line[i], h, sizeof h);
        memcpy(derivative[i], d, sizeof d);
    }
}

static double bernstein_sum(int p, const double *coefficient, double s)
{
    double b[ELEMENT_SIDE], sum = 0.0;
    bernstein(p, s, b, NULL);
    for (int i = 0; i <= p; i++)
        sum += b[i] * coefficient[i];
    return sum;
}

/* Root of a polynomial that changes sign once over [lower, upper]: Newton steps kept inside a
 * shrinking bracket. */
static double bracketed_root(int p, const double *coefficient, double lower, double upper)
{
    double b[ELEMENT_SIDE], d[ELEMENT_SIDE];
    double f0 = bernstein_sum(p, coefficient, lower), f1 = bernstein_sum(p, coefficient, upper);
    double rising = f1 >= f0 ? 1.0 : -1.0, s = lower + (upper - lower) * f0 / (f0 - f1);
    if (!(s > lower && s < upper)) /* both ends zero to rounding */
        s = 0.5 * (lower + upper);
    for (int k = 0; k < 100; k++) {
        double f = 0.0, slope = 0.0;
        bernstein(p, s, b, d);
        for (int i = 0; i <= p; i++) {
            f += b[i] * coefficient[i];
            slope += d[i] * coefficient[i];
        }
        if (rising * f > 0)
            upper = s;
        else
            lower = s;
        double next = s - f / slope;
        if (!(next > lower && next < upper))
            next = 0.5 * (lower + upper);
        if (fabs(next - s) < 1e-14)
            return next;
        s = next;
    }
    return s;
}

/* Roots in (0,1) by subdivision of the control polygon (it varies at least as often as the
 * polynomial). Appends to roots in increasing order; returns the new count. */
static size_t bernstein_roots(int p, const double *coefficient, double lower, double upper,
                              int depth, double *roots, size_t count)
{
    double scale = 0.0;
    int changes = 0;
    double last = 0.0;
    for (int i = 0; i <= p; i++)
        scale = fmax(scale, fabs(coefficient[i]));
    for (int i = 0; i <= p; i++) {
        if (fabs(coefficient[i]) <= 1e-13 * scale)
            continue;
        changes += last * coefficient[i] < 0;
        last = coefficient[i];
    }
    if (changes == 0 || count >= ELEMENT_SIDE)
        return count;
    if (changes == 1 || depth == 40) {
        roots[count++] = lower + (upper - lower) * bracketed_root(p, coefficient, 0.0, 1.0);
        return count;
    }
    double left[ELEMENT_SIDE], right[ELEMENT_SIDE]; /* de Casteljau at the middle */
    memcpy(right, coefficient, ((size_t)p + 1) * sizeof *right);
    for (int k = 0; k <= p; k++) {
        left[k] = right[0];
        for (int i = 0; i < p - k; i++)
            right[i] = 0.5 * (right[i] + right[i + 1]);
    }
    double middle = 0.5 * (lower + upper);
    count = bernstein_roots(p, left, lower, middle, depth + 1, roots, count);
    return bernstein_roots(p, right, middle, upper, depth + 1, roots, count);
}

/* Bernstein coefficients of (x(s) - x) w(s) on a line of the element. */
static void line_distance(int p, const double (*line)[4], double x, double *coefficient)
{
    for (int i = 0; i <= p; i++)
        coefficient[i] = line[i][0] - x * line[i][3];
}

static void edge_distance(const struct element *element, int along, int end, double x,
                          double *coefficient)
{
    size_t columns = (size_t)element->degree[1] + 1;
    size_t n = (size_t)element->degree[1 - along] + 1;
    size_t fixed = end ? (size_t)element->degree[along] : 0;
    for (size_t j = 0; j < n; j++) {
        const double *h =
            element->net + 4 * (along == 0 ? fixed * columns + j : j * columns + fixed);
        coefficient[j] = h[0] - x * h[3];
    }
}

size_t edge_roots(const struct element *element, int fixed, int end, double x,
                  double roots[ELEMENT_SIDE])
{
    double distance[ELEMENT_SIDE];
    edge_distance(element, fixed, end, x, distance);
    return bernstein_roots(element->degree[1 - fixed], distance, 0.0, 1.0, 0, roots, 0);
}

void domain_whole(const struct element *element, struct domain *domain)
{
    *domain = (struct domain){.element = element, .across = {0.0, 1.0}, .part = DOMAIN_WHOLE};
}

static void line_at(const struct domain *domain, double across, double (*line)[4],
                    double (*derivative)[4])
{
    double b[ELEMENT_SIDE], d[ELEMENT_SIDE];
    bernstein(domain->element->degree[1 - domain->along], across, b, d);
    element_line(domain->element, domain->along, b, d, line, derivative);
}

/* Range of the parameter along the line that belongs to the domain. */
static void line_range(const struct domain *domain, const double (*line)[4], double range[2])
{
    range[0] = 0.0;
    range[1] = 1.0;
    if (domain->part == DOMAIN_WHOLE)
        return;
    int p = domain->element->degree[domain->along];
    double f[ELEMENT_SIDE];
    line_distance(p, line, domain->x, f);
    double root =
        f[0] * f[p] < 0 ? bracketed_root(p, f, 0.0, 1.0) : (fabs(f[0]) < fabs(f[p]) ? 0.0 : 1.0);
    range[domain->part == DOMAIN_LOW] = root;
}

static int x_direction(const struct element *element)
{
    size_t p = (size_t)element->degree[0], q = (size_t)element->degree[1];
    const double *net = element->net;
    double c[4];
    const size_t corner[4] = {0, q, p * (q + 1), p * (q + 1) + q};
    for (int k = 0; k < 4; k++)
        c[k] = net[4 * corner[k]] / net[4 * corner[k] + 3];
    return fabs(c[2] - c[0]) + fabs(c[3] - c[1]) >= fabs(c[1] - c[0]) + fabs(c[3] - c[2]) ? 0 : 1;
}

static int increasing(const void *a, const void *b)
{
    double d = *(const double *)a - *(const double *)b;
    return (d > 0) - (d < 0);
}

size_t domain_cut(const struct element *element, double x, struct domain pieces[DOMAIN_PIECES])
{
    int along = x_direction(element), q = element->degree[1 - along];
    double stops[2 * ELEMENT_SIDE + 2] = {0.0}, edge[2][ELEMENT_SIDE];
    size_t count = 1, n = 0;
    for (int end = 0; end < 2; end++) {
        edge_distance(element, along, end, x, edge[end]);
        count += edge_roots(element, along, end, x, stops + count);
    }
    stops[count++] = 1.0;
    qsort(stops, count, sizeof *stops, increasing);
    for (size_t k = 0; k + 1 < count; k++) {
        if (stops[k + 1] - stops[k] < 1e-12)
            continue;
        double middle = 0.5 * (stops[k] + stops[k + 1]);
        double f0 = bernstein_sum(q, edge[0], middle), f1 = bernstein_sum(q, edge[1], middle);
        struct domain piece = {
            .element = element, .along = along, .across = {stops[k], stops[k + 1]}, .x = x};
        if (f0 * f1 < 0) {
            piece.part = DOMAIN_LOW;
            piece.ahead = f0 > 0;
            pieces[n++] = piece;
            piece.part = DOMAIN_HIGH;
            piece.ahead = f1 > 0;
        } else {
            piece.part = DOMAIN_WHOLE;
            piece.ahead = f0 + f1 > 0;
        }
        pieces[n++] = piece;
    }
    return n;
}

void cell_nodes(const struct domain *domain, const double rect[4], const int n[2],
                const struct gauss *gauss, struct nodes *nodes)
{
    const struct element *element = domain->element;
    int along = domain->along, p = element->degree[along], q = element->degree[1 - along];
    size_t at = nodes_append(nodes, element, (size_t)(n[0] * n[1]));
    if (nodes->failed)
        return;
    double *basis_along = along == 0 ? nodes->bu : nodes->bv;
    double *basis_across = along == 0 ? nodes->bv : nodes->bu;
    size_t side_along = nodes->side[along], side_across = nodes->side[1 - along];
    double width = domain->across[1] - domain->across[0];
    for (int j = 0; j < n[1]; j++) {
        double b = rect[2] + (rect[3] - rect[2]) * gauss->node[n[1]][j];
        double across = domain->across[0] + b * width, range[2];
        double bern[ELEMENT_SIDE], bern_d[ELEMENT_SIDE], line[ELEMENT_SIDE][4],
            across_d[ELEMENT_SIDE][4];
        bernstein(q, across, bern, bern_d);
        element_line(element, along, bern, bern_d, line, across_d);
        line_range(domain, (const double(*)[4])line, range);
        double jacobian = gauss->weight[n[1]][j] * width * (range[1] - range[0]) *
                          (rect[1] - rect[0]) * (rect[3] - rect[2]);
        for (int i = 0; i < n[0]; i++, at++) {
            double a = rect[0] + (rect[1] - rect[0]) * gauss->node[n[0]][i];
            double s = range[0] + a * (range[1] - range[0]);
            double *bs = basis_along + at * side_along, ds[ELEMENT_SIDE];
            bernstein(p, s, bs, ds);
            double h[4] = {0}, ha[4] = {0}, hb[4] = {0};
            for (int k = 0; k <= p; k++)
                for (int c = 0; c < 4; c++) {
                    h[c] += bs[k] * line[k][c];
                    ha[c] += ds[k] * line[k][c];
                    hb[c] += bs[k] * across_d[k][c];
                }
            double inverse = 1.0 / h[3], point[3], da[3], db[3];
            for (int c = 0; c < 3; c++) {
                point[c] = h[c] * inverse;
                da[c] = (ha[c] - point[c] * ha[3]) * inverse;
                db[c] = (hb[c] - point[c] * hb[3]) * inverse;
            }
            double ax = da[1] * db[2] - da[2] * db[1], ay = da[2] * db[0] - da[0] * db[2],
                   az = da[0] * db[1] - da[1] * db[0];
            nodes->x[at] = point[0];
            nodes->y[at] = point[1];
            nodes->z[at] = point[2];
            double size = sqrt(ax * ax + ay * ay + az * az);
            nodes->g[at] = jacobian * gauss->weight[n[0]][i] * size;
            if (element->rational)
                nodes->g[at] *= inverse;
            if (nodes->with_normals) {
                double turn = (along == 0 ? element->sign : -element->sign) / size;
                const double normal[3] = {turn * ax, turn * ay, turn * az};
                memcpy(nodes->normal + 3 * at, normal, sizeof normal);
            }
            if (nodes->with_jets) {
                memcpy(nodes->jet + 6 * at, along == 0 ? da : db, sizeof da);
                memcpy(nodes->jet + 6 * at + 3, along == 0 ? db : da, sizeof da);
            }
            memcpy(basis_across + at * side_across, bern, ((size_t)q + 1) * sizeof *bern);
        }
    }
}

void nodes_jet(struct nodes *nodes, size_t node, const struct jet *jet)
{
    if (!nodes->with_jets)
        return;
    memcpy(nodes->jet + 6 * node, jet->ds, sizeof jet->ds);
    memcpy(nodes->jet + 6 * node + 3, jet->dt, sizeof jet->dt);
}

void nodes_local(const struct nodes *nodes, const struct element *element, size_t node,
                 double local[2])
{
    for (int d = 0; d < 2; d++) {
        int p = element->degree[d];
        const double *basis = (d == 0 ? nodes->bu : nodes->bv) + node * nodes->side[d];
        local[d] = 0.0;
        for (int k = 1; k <= p; k++)
            local[d] += basis[k] * k / p;
    }
}

void point_node(const struct element *element, double s, double t, double weight,
                struct nodes *nodes)
{
    size_t at = nodes_append(nodes, element, 1);
    if (nodes->failed)
        return;
    struct jet jet;
    double area[3];
    element_jet(element, s, t, &jet);
    nodes->x[at] = jet.s[0];
    nodes->y[at] = jet.s[1];
    nodes->z[at] = jet.s[2];
    double size = jet_area(&jet, element->sign, area);
    nodes->g[at] = weight * size / jet.weight;
    nodes_jet(nodes, at, &jet);
    for (size_t c = 0; c < 3 && nodes->with_normals; c++)
        nodes->normal[3 * at + c] = area[c] / size;
    bernstein(element->degree[0], s, nodes->bu + at * nodes->side[0], NULL);
    bernstein(element->degree[1], t, nodes->bv + at * nodes->side[1], NULL);
}

void domain_grid(const struct domain *domain, size_t na, const double *a, size_t nb,
                 const double *b, double (*points)[3])
{
    int p = domain->element->degree[domain->along];
    double width = domain->across[1] - domain->across[0];
    for (size_t j = 0; j < nb; j++) {
        double line[ELEMENT_SIDE][4], derivative[ELEMENT_SIDE][4], range[2];
        line_at(domain, domain->across[0] + b[j] * width, line, derivative);
        line_range(domain, (const double(*)[4])line, range);
        for (size_t i = 0; i < na; i++) {
            double basis[ELEMENT_SIDE], h[4] = {0}, *point = points[i * nb + j];
            bernstein(p, range[0] + a[i] * (range[1] - range[0]), basis, NULL);
            for (int k = 0; k <= p; k++)
                for (int c = 0; c < 4; c++)
                    h[c] += basis[k] * line[k][c];
            for (int c = 0; c < 3; c++)
                point[c] = h[c] / h[3];
        }
    }
}

void cell_extent(const struct domain *domain, const double rect[4], struct cell_extent *extent)
{
    const double a[3] = {rect[0], 0.5 * (rect[0] + rect[1]), rect[1]};
    const double b[3] = {rect[2], 0.5 * (rect[2] + rect[3]), rect[3]};
    double row[3][3], column[2][3];
    domain_grid(domain, 3, a, 1, b + 1, row);
    domain_grid(domain, 1, a + 1, 1, b, column);
    domain_grid(domain, 1, a + 1, 1, b + 2, column + 1);
    memcpy(extent->centre, row[1], sizeof row[1]);
    const double *end[2][2] = {{row[0], row[2]}, {column[0], column[1]}};
    for (int d = 0; d < 2; d++) {
        double square[2] = {0.0, 0.0}, chord = 0.0, bend = 0.0;
        for (int c = 0; c < 3; c++) {
            double back = end[d][0][c] - row[1][c], front = end[d][1][c] - row[1][c];
            square[0] += back * back;
            square[1] += front * front;
            chord += (front - back) * (front - back);
            bend += (front + back) * (front + back);
        }
        extent->half[d] = sqrt(fmax(square[0], square[1]));
        extent->chord[d] = sqrt(chord);
        extent->bend[d] = sqrt(bend);
    }
}

/* Spline functions of one direction from Bernstein polynomials. */
static void extract(const double *extraction, size_t n, const double *values, double *out)
{
    for (size_t a = 0; a < n; a++) {
        out[a] = 0.0;
        for (size_t k = 0; k < n; k++)
            out[a] += extraction[a * n + k] * values[k];
    }
}

void nodes_fold(const struct nodes *nodes, double *f)
{
    for (size_t e = 0; e < nodes->blocks; e++) {
        const struct element *element = nodes->block[e].element;
        size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
        for (size_t i = nodes->block[e].begin; i < nodes->block[e].end; i++, f += m * n) {
            double u[ELEMENT_SIDE], v[ELEMENT_SIDE];
            extract(element->extraction[0], m, nodes->bu + i * nodes->side[0], u);
            extract(element->extraction[1], n, nodes->bv + i * nodes->side[1], v);
            for (size_t a = 0; a < m; a++)
                for (size_t b = 0; b < n; b++) {
                    double w = element->weight ? element->weight[a * element->stride + b] : 1.0;
                    f[a * n + b] = w * u[a] * v[b] * nodes->g[i];
                }
        }
    }
}

double nodes_value(const struct nodes *nodes, const struct element *element, size_t node,
                   const double *coefficients, size_t step)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *bu = nodes->bu + node * nodes->side[0], *bv = nodes->bv + node * nodes->side[1];
    double sum = 0.0;
    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < n; b++)
            sum += bu[a] * bv[b] * coefficients[(a * n + b) * step];
    return sum;
}

double nodes_weight(const struct nodes *nodes, const struct element *element, size_t node)
{
    return element->rational ? nodes_value(nodes, element, node, element->net + 3, 4) : 1.0;
}

VECTOR_MULTIVERSION
void nodes_scatter(const struct nodes *nodes, size_t fields, const double *k, size_t stride,
                   double *rows, size_t row_stride)
{
    for (size_t e = 0; e < nodes->blocks; e++) {
        const struct block *block = &nodes->block[e];
        size_t m = (size_t)block->element->degree[0] + 1, n = (size_t)block->element->degree[1] + 1;
        for (size_t f = 0; f < fields; f++) {
            double moments[ELEMENT_FUNCTIONS] = {0};
            for (size_t i = block->begin; i < block->end; i++) {
                double strength = k[f * stride + i] * nodes->g[i];
                const double *bu = nodes->bu + i * nodes->side[0];
                const double *bv = nodes->bv + i * nodes->side[1];
                for (size_t a = 0; a < m; a++) {
                    double sa = strength * bu[a];
                    for (size_t b = 0; b < n; b++)
                        moments[a * n + b] += sa * bv[b];
                }
            }
            element_scatter(block->element, 1, moments, rows + f * row_stride, row_stride);
        }
    }
}
