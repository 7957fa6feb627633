#include "tangent/moving.h"

#include "core/vector_math.h"

#include <stdlib.h>
#include <string.h>

igabem_status moving_density(const igabem_tangent *tangent, double **bernstein)
{
    const struct field *field = tangent->field;
    const struct mesh *mesh = tangent->mesh;
    const struct element *last = &mesh->element[mesh->n - 1];
    size_t total = field->offset[mesh->n - 1] / field->n +
                   (size_t)(last->degree[0] + 1) * (size_t)(last->degree[1] + 1);
    *bernstein = malloc(total * sizeof **bernstein);
    if (!*bernstein)
        return tangent_no_memory(field->n);
    for (size_t e = 0; e < mesh->n; e++)
        element_gather(&mesh->element[e], tangent->solution->sigma,
                       *bernstein + field->offset[e] / field->n);
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

static void fill_node(const struct element *element, const double *density,
                      const struct nodes *nodes, size_t i, struct moving *moving)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
    double *du = moving->du + i * nodes->side[0], *dv = moving->dv + i * nodes->side[1];
    double local[2], basis[ELEMENT_SIDE], sigma = 0.0, w = 0.0, ws = 0.0, wt = 0.0;
    struct area_change area;
    nodes_local(nodes, element, i, local);
    bernstein(element->degree[0], local[0], basis, du);
    bernstein(element->degree[1], local[1], basis, dv);
    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < n; b++) {
            double weight = element->net[4 * (a * n + b) + 3];
            sigma += bu[a] * bv[b] * density[a * n + b];
            w += bu[a] * bv[b] * weight;
            ws += du[a] * bv[b] * weight;
            wt += bu[a] * dv[b] * weight;
        }
    area_change(nodes->jet + 6 * i, nodes->jet + 6 * i + 3, element->sign, &area);
    double strength = sigma * nodes->g[i], part = strength / (area.size * w);
    moving->strength[i] = strength;
    moving->place[i] = strength / w;
    moving->along[i] = part * area.length[0];
    moving->across[i] = part * area.length[1];
    moving->stretch[i] = part * (area.length[0] * ws + area.length[1] * wt) / w;
}

bool moving_fill(const igabem_tangent *tangent, const double *bernstein, const struct nodes *nodes,
                 struct moving *moving)
{
    const struct field *field = tangent->field;
    if (nodes->failed || !reserve(moving, nodes))
        return false;
    for (size_t b = 0; b < nodes->blocks; b++) {
        const struct block *block = &nodes->block[b];
        const double *density =
            bernstein + field->offset[block->element - field->mesh->element] / field->n;
        for (size_t i = block->begin; i < block->end; i++)
            fill_node(block->element, density, nodes, i, moving);
    }
    return true;
}

void moving_free(struct moving *moving)
{
    free(moving->strength);
    moving->strength = NULL;
    moving->capacity = 0;
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

VECTOR_MULTIVERSION
static void contract(size_t count, size_t fields, const double *moment, const double *net,
                     double *out)
{
    for (size_t k = 0; k < count; k++, net += fields)
        for (size_t c = 0; c < 3; c++) {
            double factor = moment[c * count + k], *to = out + c * fields;
            for (size_t f = 0; f < fields; f++)
                to[f] += factor * net[f];
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
        contract(count, field->n, moment, field_net(field, element), out);
    }
}
