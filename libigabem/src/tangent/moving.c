#include "tangent/moving.h"

#include "core/vector_math.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

igabem_status moving_density(const igabem_tangent *tangent, double **bernstein)
{
    const struct field *field = tangent->field;
    const struct mesh *mesh = tangent->mesh;
    const struct element *last = &mesh->element[mesh->n - 1];
    size_t total =
        field->offset[mesh->n - 1] + (size_t)(last->degree[0] + 1) * (size_t)(last->degree[1] + 1);
    *bernstein = malloc(total * sizeof **bernstein);
    if (!*bernstein)
        return tangent_no_memory(field->n);
    for (size_t e = 0; e < mesh->n; e++)
        element_gather(&mesh->element[e], tangent->solution->sigma, *bernstein + field->offset[e]);
    return IGABEM_OK;
}

static bool reserve(struct moving *moving, const struct nodes *nodes)
{
    enum { COLUMNS = 5 };
    moving->n = nodes->n;
    memcpy(moving->side, nodes->side, sizeof moving->side);
    size_t width = COLUMNS + nodes->side[0] + nodes->side[1];
    if (nodes->n > moving->capacity) {
        free(moving->strength);
        moving->capacity = nodes->n + nodes->n / 2;
        moving->strength = malloc(moving->capacity * width * sizeof *moving->strength);
    }
    double *at = moving->strength;
    if (!at) {
        moving->capacity = 0;
        return nodes->n == 0;
    }
    moving->place = at + nodes->n;
    moving->along = at + 2 * nodes->n;
    moving->across = at + 3 * nodes->n;
    moving->stretch = at + 4 * nodes->n;
    moving->du = at + COLUMNS * nodes->n;
    moving->dv = moving->du + nodes->side[0] * nodes->n;
    return true;
}

/* Density and weight at a node; derivatives of the Bernstein polynomials there are stored. */
struct place {
    double local[2], sigma, w, ws, wt;
};

static void find_place(const struct element *element, const double *density,
                       const struct nodes *nodes, size_t i, struct moving *moving,
                       struct place *place)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
    double *du = moving->du + i * nodes->side[0], *dv = moving->dv + i * nodes->side[1];
    double basis[ELEMENT_SIDE];
    *place = (struct place){.sigma = 0.0};
    nodes_local(nodes, element, i, place->local);
    bernstein(element->degree[0], place->local[0], basis, du);
    bernstein(element->degree[1], place->local[1], basis, dv);
    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < n; b++) {
            double weight = element->net[4 * (a * n + b) + 3];
            place->sigma += bu[a] * bv[b] * density[a * n + b];
            place->w += bu[a] * bv[b] * weight;
            place->ws += du[a] * bv[b] * weight;
            place->wt += bu[a] * dv[b] * weight;
        }
}

/* A node of strength q that V_s and V_t change by these. */
static void store(const struct place *place, size_t i, double q, const double change[2],
                  struct moving *moving)
{
    moving->strength[i] = q;
    moving->place[i] = q / place->w;
    moving->along[i] = change[0] / place->w;
    moving->across[i] = change[1] / place->w;
    moving->stretch[i] = (change[0] * place->ws + change[1] * place->wt) / (place->w * place->w);
}

static void fill_node(const struct element *element, const double *density,
                      const struct nodes *nodes, size_t i, struct moving *moving)
{
    struct place place;
    struct area_change area;
    find_place(element, density, nodes, i, moving, &place);
    area_change(nodes->jet + 6 * i, nodes->jet + 6 * i + 3, element->sign, &area);
    double q = place.sigma * nodes->g[i];
    const double change[2] = {q * area.length[0] / area.size, q * area.length[1] / area.size};
    store(&place, i, q, change, moving);
}

bool moving_fill(const igabem_tangent *tangent, const double *bernstein, const struct nodes *nodes,
                 struct moving *moving)
{
    const struct field *field = tangent->field;
    if (nodes->failed || !reserve(moving, nodes))
        return false;
    for (size_t b = 0; b < nodes->blocks; b++) {
        const struct block *block = &nodes->block[b];
        const double *density = bernstein + field->offset[block->element - field->mesh->element];
        for (size_t i = block->begin; i < block->end; i++)
            fill_node(block->element, density, nodes, i, moving);
    }
    return true;
}

bool moving_fill_line(const igabem_tangent *tangent, const double *bernstein,
                      const struct line *line, const struct line_segment *segment, double scale,
                      const struct nodes *nodes, struct moving *moving)
{
    const struct field *field = tangent->field;
    const struct element *element = segment->element;
    const double *density = bernstein + field->offset[element - field->mesh->element];
    if (nodes->failed || !reserve(moving, nodes))
        return false;
    for (size_t i = 0; i < nodes->n; i++) {
        struct place place;
        struct line_change at;
        find_place(element, density, nodes, i, moving, &place);
        line_change(line, segment, place.local, &at);
        /* normal[1] is the length of the node */
        double length = at.dl > 0 ? nodes->normal[3 * i + 1] / at.dl : 0.0;
        double part = scale * place.sigma * length / (element->rational ? place.w : 1.0);
        const double change[2] = {part * at.change[0], part * at.change[1]};
        store(&place, i, part * at.strength, change, moving);
    }
    return true;
}

void line_change(const struct line *line, const struct line_segment *segment, const double local[2],
                 struct line_change *change)
{
    const struct element *element = segment->element;
    int run = 1 - segment->fixed;
    struct jet jet;
    struct area_change area;
    element_jet(element, local[0], local[1], &jet);
    area_change(jet.ds, jet.dt, element->sign, &area);
    const double *tangent = run ? jet.dt : jet.ds;
    double dl = hypot(tangent[0], tangent[1]);
    *change = (struct line_change){.dl = dl};
    if (!(dl > 0) || !(area.size > 0))
        return;
    double outward = tangent[1] * area.area[0] - tangent[0] * area.area[1] < 0 ? -1.0 : 1.0;
    double nx = area.area[0] / area.size, nu = outward * tangent[1] / dl;
    double ratio = fabs(nu) / line->limit, fourth = ratio * ratio * ratio * ratio;
    double chi = 1.0 / (1.0 + fourth);
    double slope = chi - 4.0 * fourth * chi * chi; /* of chi nu with nu */
    double dnu = outward * tangent[0] * tangent[0] / (dl * dl * dl), stretch = tangent[1] / dl;
    change->strength = -nx * chi * nu * dl;
    for (int d = 0; d < 2; d++) {
        double dnx = (area.inflow[d] - nx * area.length[d]) / area.size;
        change->change[d] = -dnx * chi * nu * dl;
    }
    change->change[run] -= nx * (slope * dnu * dl + chi * nu * stretch);
}

void moving_free(struct moving *moving)
{
    free(moving->strength);
    moving->strength = NULL;
    moving->capacity = 0;
}

void moving_changes(const struct field *field, const struct nodes *nodes,
                    const struct moving *moving, const struct element *element, size_t i,
                    double *change)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
    const double *du = moving->du + i * nodes->side[0], *dv = moving->dv + i * nodes->side[1];
    double factor[2 * ELEMENT_FUNCTIONS];
    for (size_t k = 0; k < m * n; k++) {
        size_t a = k / n, b = k % n;
        factor[k] = moving->along[i] * du[a] * bv[b] + moving->across[i] * bu[a] * dv[b] -
                    moving->stretch[i] * bu[a] * bv[b];
        factor[m * n + k] = moving->place[i] * bu[a] * bv[b];
    }
    memset(change, 0, 2 * field->n * sizeof *change);
    field_contract(field, element, 2, factor, change);
}

VECTOR_MULTIVERSION
static void moments(const struct nodes *nodes, const struct moving *moving,
                    const struct block *block, const double *k, const double *slope, double *moment)
{
    size_t m = (size_t)block->element->degree[0] + 1, n = (size_t)block->element->degree[1] + 1;
    for (size_t i = block->begin; i < block->end; i++) {
        const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
        const double *du = moving->du + i * nodes->side[0], *dv = moving->dv + i * nodes->side[1];
        double *to = moment;
        for (size_t c = 0; c < 3; c++) {
            double kernel = k[c * nodes->n + i];
            double still =
                -slope[c * nodes->n + i] * moving->place[i] - kernel * moving->stretch[i];
            double along = kernel * moving->along[i], across = kernel * moving->across[i];
            for (size_t a = 0; a < m; a++, to += n) {
                double x = still * bu[a] + along * du[a], y = across * bu[a];
                for (size_t b = 0; b < n; b++)
                    to[b] += x * bv[b] + y * dv[b];
            }
        }
    }
}

void moving_add(const struct field *field, const struct nodes *nodes, const struct moving *moving,
                const double *k, const double *slope, double *out)
{
    for (size_t b = 0; b < nodes->blocks; b++) {
        const struct element *element = nodes->block[b].element;
        size_t count = (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
        double moment[3 * ELEMENT_FUNCTIONS];
        memset(moment, 0, 3 * count * sizeof *moment);
        moments(nodes, moving, &nodes->block[b], k, slope, moment);
        field_contract(field, element, 3, moment, out);
    }
}
