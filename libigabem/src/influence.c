#include "influence.h"

#include "error.h"

#include <stdlib.h>
#include <string.h>

/* Points of the classes above the least number that integrates the basis itself. */
static const int class_points[REGULAR_CLASSES] = {0, 1, 2, 4};

static int least_points(const struct element *element, int direction)
{
    return element->degree[direction] / 2 + 1;
}

int regular_class(const struct element *element, int direction, int points)
{
    int least = least_points(element, direction), k = 0;
    while (k < REGULAR_CLASSES && least + class_points[k] < points)
        k++;
    return k;
}

const struct regular_rule *regular_rule_of(const struct influence *influence, size_t element,
                                           const int class[2])
{
    size_t k = element * REGULAR_CLASSES + (size_t) class[0];
    return &influence->regular[k * REGULAR_CLASSES + (size_t) class[1]];
}

static size_t class_nodes(const struct element *element)
{
    size_t sum[2] = {0, 0};
    for (int d = 0; d < 2; d++)
        for (int k = 0; k < REGULAR_CLASSES; k++)
            sum[d] += (size_t)(least_points(element, d) + class_points[k]);
    return sum[0] * sum[1];
}

static size_t functions(const struct element *element)
{
    return (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
}

static igabem_status fill_regular(struct influence *influence)
{
    const struct mesh *mesh = influence->mesh;
    const double whole[4] = {0.0, 1.0, 0.0, 1.0};
    struct nodes nodes;
    nodes_init(&nodes, mesh);
    double *at = influence->storage;
    for (size_t e = 0; e < mesh->n; e++) {
        const struct element *element = &mesh->element[e];
        struct domain domain;
        domain_whole(element, &domain);
        cell_extent(&domain, whole, influence->centre[e], influence->half[e]);
        for (int k = 0; k < REGULAR_CLASSES * REGULAR_CLASSES; k++) {
            struct regular_rule *rule =
                &influence->regular[e * REGULAR_CLASSES * REGULAR_CLASSES + (size_t)k];
            const int points[2] = {least_points(element, 0) + class_points[k / REGULAR_CLASSES],
                                   least_points(element, 1) + class_points[k % REGULAR_CLASSES]};
            nodes_clear(&nodes);
            cell_nodes(&domain, whole, points, &influence->gauss, &nodes);
            if (nodes.failed) {
                nodes_free(&nodes);
                return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes");
            }
            size_t n = nodes.n;
            *rule = (struct regular_rule){n, at, at + n, at + 2 * n, at + 3 * n};
            memcpy(rule->x, nodes.x, n * sizeof *at);
            memcpy(rule->y, nodes.y, n * sizeof *at);
            memcpy(rule->z, nodes.z, n * sizeof *at);
            nodes_fold(&nodes, element, rule->f);
            at += n * (3 + functions(element));
        }
    }
    nodes_free(&nodes);
    return IGABEM_OK;
}

igabem_status influence_create(const struct density *density, const struct mesh *mesh,
                               double tolerance, int threads, struct influence **result)
{
    *result = NULL;
    struct influence *influence = calloc(1, sizeof *influence);
    if (!influence)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes");
    influence->density = density;
    influence->mesh = mesh;
    influence->tolerance = 0.1 * tolerance;
    influence->wave_tolerance = tolerance;
    influence->threads = threads;
    size_t doubles = 0;
    for (size_t e = 0; e < mesh->n; e++)
        doubles += class_nodes(&mesh->element[e]) * (3 + functions(&mesh->element[e]));
    influence->centre = malloc(mesh->n * sizeof *influence->centre);
    influence->half = malloc(mesh->n * sizeof *influence->half);
    influence->regular =
        malloc(mesh->n * REGULAR_CLASSES * REGULAR_CLASSES * sizeof *influence->regular);
    influence->storage = malloc(doubles * sizeof *influence->storage);
    igabem_status status = gauss_fill(&influence->gauss);
    if (!influence->centre || !influence->half || !influence->regular || !influence->storage)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes of %zu elements",
                             mesh->n);
    if (status == IGABEM_OK)
        status = fill_regular(influence);
    if (status != IGABEM_OK) {
        influence_free(influence);
        return status;
    }
    *result = influence;
    return IGABEM_OK;
}

void influence_free(struct influence *influence)
{
    if (!influence)
        return;
    free(influence->centre);
    free(influence->half);
    free(influence->regular);
    free(influence->storage);
    free(influence);
}

void regular_scatter(const struct element *element, const struct regular_rule *rule, size_t fields,
                     const double *k, size_t stride, double *rows, size_t row_stride)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1, mn = m * n;
    for (size_t c = 0; c < fields; c++) {
        double sum[ELEMENT_FUNCTIONS] = {0};
        const double *f = rule->f;
        for (size_t i = 0; i < rule->n; i++, f += mn) {
            double strength = k[c * stride + i];
            for (size_t a = 0; a < mn; a++)
                sum[a] += strength * f[a];
        }
        for (size_t a = 0; a < m; a++) {
            double *row = rows + c * row_stride + element->first + a * element->stride;
            for (size_t b = 0; b < n; b++)
                row[b] += sum[a * n + b];
        }
    }
}

int element_contains(const struct density *density, const struct element *element, size_t point,
                     double local[2])
{
    if (density->owner[point] != element->patch)
        return 0;
    for (int d = 0; d < 2; d++) {
        double width = element->upper[d] - element->lower[d];
        local[d] = (density->uv[point][d] - element->lower[d]) / width;
        if (local[d] < -1e-10 || local[d] > 1.0 + 1e-10)
            return 0;
        local[d] = local[d] < 0 ? 0 : local[d] > 1 ? 1 : local[d];
    }
    return 1;
}
