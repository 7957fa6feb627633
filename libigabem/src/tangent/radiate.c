#include "tangent/radiate.h"

#include "core/error.h"
#include "core/vector_math.h"
#include "space/quadrature_wave.h"
#include "tangent/moving.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 64 };              /* sources whose waves are kept at a time */
static const double DECAY = 40.0; /* sources beyond e^-40 are left out */

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for moving sources");
}

static igabem_status carriers_create(size_t n, size_t fields, bool deep, struct carriers *carriers)
{
    carriers->n = n;
    carriers->x = malloc((4 * n + 1) * sizeof *carriers->x);
    carriers->change = malloc((2 * n * fields + 1) * sizeof *carriers->change);
    if (!carriers->x || !carriers->change)
        return no_memory();
    carriers->y = carriers->x + n;
    carriers->strength = carriers->x + 2 * n;
    carriers->z = deep ? carriers->x + 3 * n : NULL;
    return IGABEM_OK;
}

void radiators_free(struct radiators *radiators)
{
    if (!radiators)
        return;
    free(radiators->surface.x);
    free(radiators->surface.change);
    free(radiators->line.x);
    free(radiators->line.change);
    free(radiators);
}

/* Density and its changes at local parameters of an element: sigma, the changes in change[fields].
 */
struct densities {
    double *field; /* [fields + 1][ELEMENT_FUNCTIONS]: Bernstein coefficients, the density's last */
    size_t fields;
};

static void gather(const igabem_tangent *tangent, const struct element *element,
                   struct densities *densities)
{
    size_t unknowns = tangent->solution->density->n;
    for (size_t f = 0; f < densities->fields; f++)
        element_gather(element, tangent->sigma + f * unknowns,
                       densities->field + f * ELEMENT_FUNCTIONS);
    element_gather(element, tangent->solution->sigma,
                   densities->field + densities->fields * ELEMENT_FUNCTIONS);
}

/* Values over the homogeneous weight, as nodes hold it in g. */
static double density_at(const struct densities *densities, const struct element *element,
                         const double *bu, const double *bv, double *change)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double sigma = 0.0;
    for (size_t f = 0; f <= densities->fields; f++) {
        const double *field = densities->field + f * ELEMENT_FUNCTIONS;
        double sum = 0.0;
        for (size_t a = 0; a < m; a++)
            for (size_t b = 0; b < n; b++)
                sum += bu[a] * bv[b] * field[a * n + b];
        if (f < densities->fields)
            change[f] = sum;
        else
            sigma = sum;
    }
    return sigma;
}

struct order {
    double z;
    size_t node, block;
};

static int by_depth(const void *a, const void *b)
{
    const struct order *p = a, *q = b;
    if (p->z != q->z)
        return p->z < q->z ? 1 : -1;
    return (p->node > q->node) - (p->node < q->node);
}

/* A surface source: q = g sigma, or U n_x dS where nothing is solved. v[3][fields] is the move.
 * Returns q. */
static double surface_change(const igabem_tangent *tangent, const struct nodes *nodes, size_t node,
                             const struct element *element, const struct densities *densities,
                             const double *v, double *change)
{
    const igabem_solution *solution = tangent->solution;
    size_t fields = densities->fields;
    double *moved = change + fields;
    struct area_change area;
    area_change(nodes->jet + 6 * node, nodes->jet + 6 * node + 3, element->sign, &area);
    if (!solution->formulation->solves) {
        double weight = 0.0, g = nodes->g[node];
        const double *bu = nodes->bu + node * nodes->side[0],
                     *bv = nodes->bv + node * nodes->side[1];
        size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
        for (size_t k = 0; k < m * n && element->rational; k++)
            weight += bu[k / n] * bv[k % n] * element->net[4 * k + 3];
        double part = solution->speed * g * (element->rational ? weight : 1.0) / area.size;
        for (size_t f = 0; f < fields; f++) {
            change[f] =
                part * (area.inflow[0] * v[fields + f] + area.inflow[1] * v[2 * fields + f]);
            moved[f] = part * area.area[0] * v[f];
        }
        return part * area.area[0];
    }
    double sigma = density_at(densities, element, nodes->bu + node * nodes->side[0],
                              nodes->bv + node * nodes->side[1], change);
    double g = nodes->g[node], part = sigma * g / area.size;
    for (size_t f = 0; f < fields; f++) {
        change[f] = g * change[f] +
                    part * (area.length[0] * v[fields + f] + area.length[1] * v[2 * fields + f]);
        moved[f] = sigma * g * v[f];
    }
    return sigma * g;
}

static igabem_status fill_surface(const igabem_tangent *tangent, const struct nodes *nodes,
                                  struct densities *densities, double *v, struct carriers *carriers)
{
    size_t fields = densities->fields, n = nodes->n;
    bool centre = tangent->solution->formulation->centre_plane;
    struct order *order = malloc((n + 1) * sizeof *order);
    size_t *place = malloc((n + 1) * sizeof *place);
    if (!order || !place) {
        free(order);
        free(place);
        return no_memory();
    }
    for (size_t i = 0; i < n; i++)
        order[i] = (struct order){nodes->z[i], i, 0};
    qsort(order, n, sizeof *order, by_depth);
    for (size_t i = 0; i < n; i++)
        place[order[i].node] = i;
    for (size_t b = 0; b < nodes->blocks; b++) {
        const struct block *block = &nodes->block[b];
        if (tangent->solution->formulation->solves)
            gather(tangent, block->element, densities);
        for (size_t i = block->begin; i < block->end; i++) {
            double local[2];
            size_t to = place[i];
            nodes_local(nodes, block->element, i, local);
            field_at(tangent->field, block->element, local, v);
            carriers->x[to] = nodes->x[i];
            carriers->y[to] = centre ? 0.0 : nodes->y[i];
            carriers->z[to] = nodes->z[i];
            carriers->strength[to] = surface_change(tangent, nodes, i, block->element, densities, v,
                                                    carriers->change + 2 * fields * to);
        }
    }
    free(order);
    free(place);
    return IGABEM_OK;
}

/* The sources of one segment, from carrier `first` on. */
static void fill_segment(const igabem_tangent *tangent, const struct line *line,
                         const struct line_segment *segment, const struct nodes *nodes,
                         const struct densities *densities, double *v, size_t first,
                         struct carriers *carriers)
{
    size_t fields = densities->fields;
    const struct element *element = segment->element;
    for (size_t i = 0; i < nodes->n; i++) {
        size_t at = first + i;
        double local[2], *to = carriers->change + 2 * fields * at;
        const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
        struct line_change change;
        struct line_point point;
        nodes_local(nodes, element, i, local);
        line_change(line, segment, local, &change);
        line_evaluate(line, segment, local[1 - segment->fixed], &point);
        field_at(tangent->field, element, local, v);
        /* normal[1] is the length of the node */
        double weight = change.dl > 0 ? nodes->normal[3 * i + 1] / (change.dl * point.weight) : 0.0;
        double part = weight / tangent->solution->k0;
        double sigma = density_at(densities, element, bu, bv, to);
        carriers->x[at] = nodes->x[i];
        carriers->y[at] = nodes->y[i];
        carriers->strength[at] = part * change.strength * sigma;
        for (size_t f = 0; f < fields; f++) {
            double growth = change.change[0] * v[fields + f] + change.change[1] * v[2 * fields + f];
            to[f] = part * (change.strength * to[f] + growth * sigma);
            to[fields + f] = part * change.strength * sigma * v[f];
        }
    }
}

static igabem_status fill_line(const igabem_tangent *tangent, const struct wave_rule *rule,
                               struct densities *densities, double *v, struct carriers *carriers)
{
    const igabem_solution *solution = tangent->solution;
    struct line *line = NULL;
    struct nodes nodes;
    size_t total = 0;
    igabem_status status =
        line_create(solution->density, tangent->mesh, solution->options.stem_limit, &line);
    nodes_init(&nodes, tangent->mesh);
    nodes.with_normals = true;
    for (int pass = 0; pass < 2 && status == IGABEM_OK; pass++) {
        if (pass == 1)
            status = carriers_create(total, densities->fields, false, carriers);
        total = 0;
        for (size_t s = 0; s < line->n && status == IGABEM_OK; s++) {
            const struct line_segment *segment = &line->segment[s];
            nodes_clear(&nodes);
            wave_line_nodes(rule, line, segment, segment->range, &nodes);
            if (nodes.failed)
                status = no_memory();
            else if (pass == 1) {
                gather(tangent, segment->element, densities);
                fill_segment(tangent, line, segment, &nodes, densities, v, total, carriers);
            }
            total += nodes.n;
        }
    }
    nodes_free(&nodes);
    line_free(line);
    return status;
}

igabem_status radiators_create(const igabem_tangent *tangent, double t_max,
                               struct radiators **result)
{
    const igabem_solution *solution = tangent->solution;
    size_t fields = tangent->field->n;
    struct gauss gauss;
    struct radiators *radiators = calloc(1, sizeof *radiators);
    struct densities densities = {
        malloc((fields + 1) * ELEMENT_FUNCTIONS * sizeof *densities.field), fields};
    double *v = malloc(3 * fields * sizeof *v);
    struct nodes nodes;
    nodes_init(&nodes, tangent->mesh);
    nodes.with_jets = true;
    *result = NULL;
    igabem_status status = radiators && densities.field && v ? gauss_fill(&gauss) : no_memory();
    struct wave_rule rule = {.k0 = solution->k0,
                             .t_max = t_max,
                             .tolerance = solution->options.tolerance,
                             .gauss = &gauss};
    for (size_t e = 0; e < tangent->mesh->n && status == IGABEM_OK; e++) {
        struct domain domain;
        domain_whole(&tangent->mesh->element[e], &domain);
        wave_nodes(&rule, &domain, &nodes);
    }
    if (nodes.failed)
        status = no_memory();
    if (status == IGABEM_OK) {
        radiators->fields = fields;
        status = carriers_create(nodes.n, fields, true, &radiators->surface);
    }
    if (status == IGABEM_OK)
        status = fill_surface(tangent, &nodes, &densities, v, &radiators->surface);
    if (status == IGABEM_OK && solution->formulation->line_term && solution->options.line_term)
        status = fill_line(tangent, &rule, &densities, v, &radiators->line);
    nodes_free(&nodes);
    free(densities.field);
    free(v);
    if (status != IGABEM_OK) {
        radiators_free(radiators);
        return status;
    }
    *result = radiators;
    return IGABEM_OK;
}

/* Waves at the places of a block, both sides at once, 2 e^{a z} cos(b y) (cos, sin)(k x): fills
 * wave[2][n], and their derivatives along y wave[4..]. */
VECTOR_MULTIVERSION
static void block_waves(double a, double b, double k, size_t n, const double *restrict x,
                        const double *restrict y, const double *restrict z,
                        double (*restrict wave)[BLOCK])
{
    for (size_t j = 0; j < n; j++)
        wave[0][j] = z ? 2.0 * vector_exp(a * z[j]) : 2.0;
#pragma omp simd
    for (size_t j = 0; j < n; j++) {
        double s, c, sy, cy;
        vector_sincos(k * x[j], &s, &c);
        vector_sincos(b * y[j], &sy, &cy);
        double even = wave[0][j] * cy, odd = -wave[0][j] * b * sy;
        wave[0][j] = even * c;
        wave[1][j] = even * s;
        wave[2][j] = odd * c;
        wave[3][j] = odd * s;
    }
}

enum { FIELDS_AT_ONCE = 32 };

/* Adds the waves of changing strengths and of moves of `count` fields, at most FIELDS_AT_ONCE. */
VECTOR_MULTIVERSION
static void add_changes(size_t n, size_t fields, size_t count, double (*wave)[BLOCK],
                        const double *change, double (*dh)[2])
{
    double re[FIELDS_AT_ONCE] = {0}, im[FIELDS_AT_ONCE] = {0};
    for (size_t j = 0; j < n; j++, change += 2 * fields) {
        const double *moved = change + fields;
        double a = wave[0][j], b = wave[1][j], c = wave[2][j], d = wave[3][j];
        for (size_t f = 0; f < count; f++) {
            re[f] += a * change[f] + c * moved[f];
            im[f] += b * change[f] + d * moved[f];
        }
    }
    for (size_t f = 0; f < count; f++) {
        dh[f][0] += re[f];
        dh[f][1] += im[f];
    }
}

VECTOR_MULTIVERSION
static double dot(size_t n, const double *restrict p, const double *restrict q)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t j = 0; j < n; j++)
        sum += p[j] * q[j];
    return sum;
}

/* The waves of one angle at a block of carriers. */
static void add_block(const struct carriers *carriers, size_t begin, size_t fields, double k0,
                      double t, double h[2], double (*dh)[2])
{
    double wave[4][BLOCK], a = k0 * (1.0 + t * t), k = k0 * sqrt(1.0 + t * t);
    size_t n = carriers->n - begin < BLOCK ? carriers->n - begin : BLOCK;
    if (carriers->z && -a * carriers->z[begin] > DECAY)
        return;
    block_waves(a, k * t, k, n, carriers->x + begin, carriers->y + begin,
                carriers->z ? carriers->z + begin : NULL, wave);
    for (size_t c = 0; c < 2; c++)
        h[c] += dot(n, wave[c], carriers->strength + begin);
    for (size_t first = 0; first < fields; first += FIELDS_AT_ONCE) {
        size_t count = fields - first < FIELDS_AT_ONCE ? fields - first : FIELDS_AT_ONCE;
        add_changes(n, fields, count, wave, carriers->change + 2 * fields * begin + first,
                    dh + first);
    }
}

/* Block by block, so that the changes of one stay near while all angles pass. */
void radiators_sum(const struct radiators *radiators, double k0, size_t m, const double *t,
                   double (*h)[2], double (*dh)[2])
{
    const struct carriers *const kinds[2] = {&radiators->surface, &radiators->line};
    size_t fields = radiators->fields;
    memset(h, 0, m * sizeof *h);
    memset(dh, 0, m * fields * sizeof *dh);
    for (int k = 0; k < 2; k++)
        for (size_t begin = 0; begin < kinds[k]->n; begin += BLOCK)
            for (size_t i = 0; i < m; i++)
                add_block(kinds[k], begin, fields, k0, t[i], h[i], dh + i * fields);
}
