#include "influence/influence.h"

#include "core/error.h"
#include "core/vector_math.h"
#include "space/quadrature_regular.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHAPE_POINTS = 10 };
enum { RULE_COLUMNS = 7 }; /* of a regular rule besides the basis: position, normal, area */

/* Points of the classes above the least number that integrates the basis itself. */
static const int class_points[REGULAR_CLASSES] = {0, 1, 2, 4};

static int least_points(const struct element *element, int direction)
{
    return element->degree[direction] / 2 + 1;
}

bool regular_class(const struct influence *influence, size_t panel, const struct near_rule *rule,
                   int class[2])
{
    const struct element *element = &influence->mesh->element[influence->mesh->panel[panel].first];
    const double *centre = influence->centre[panel], *half = influence->half[panel];
    double dx = centre[0] - rule->point[0], dy = centre[1] - rule->point[1],
           dz = centre[2] - rule->point[2], distance = sqrt(dx * dx + dy * dy + dz * dz);
    double kernel = near_scale(rule, 1.0, distance), scale = kernel * 4.0 * half[0] * half[1];
    for (int d = 0; d < 2; d++) {
        const struct factor factor = {element->degree[d], 1.0};
        int points =
            regular_points(distance - half[1 - d], half[d], &factor, scale, rule->tolerance);
        int least = least_points(element, d), k = class[d];
        const double *error = influence->shape_error[panel][d];
        while (k < REGULAR_CLASSES &&
               (least + class_points[k] < points || error[k] * kernel > rule->tolerance))
            k++;
        class[d] = k;
    }
    return class[0] < REGULAR_CLASSES && class[1] < REGULAR_CLASSES;
}

const struct regular_rule *regular_rule_of(const struct influence *influence, size_t panel,
                                           const int class[2])
{
    size_t k = panel * REGULAR_CLASSES + (size_t) class[0];
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

/* The element of a panel at parameters relative to the panel, and its local parameters. */
static const struct element *locate(const struct mesh *mesh, const struct panel *panel,
                                    const double at[2], double local[2])
{
    const struct element *element = NULL;
    for (size_t e = 0; e < panel->count; e++) {
        element = &mesh->element[panel->first + e];
        int inside = 1;
        for (int d = 0; d < 2; d++) {
            double x = panel->lower[d] + at[d] * (panel->upper[d] - panel->lower[d]);
            local[d] = (x - element->lower[d]) / (element->upper[d] - element->lower[d]);
            inside &= local[d] >= -1e-12 && local[d] <= 1.0 + 1e-12;
        }
        if (inside)
            break;
    }
    return element;
}

static void panel_point(const struct mesh *mesh, const struct panel *panel, double a, double b,
                        double point[3])
{
    const double at[2] = {a, b};
    double local[2];
    struct jet jet;
    const struct element *element = locate(mesh, panel, at, local);
    element_jet(element, local[0], local[1], &jet);
    memcpy(point, jet.s, sizeof jet.s);
}

static void panel_extent(struct influence *influence, size_t p)
{
    const struct mesh *mesh = influence->mesh;
    const struct panel *panel = &mesh->panel[p];
    double *centre = influence->centre[p];
    panel_point(mesh, panel, 0.5, 0.5, centre);
    for (int d = 0; d < 2; d++) {
        influence->half[p][d] = 0.0;
        for (int end = 0; end < 2; end++) {
            double point[3], square = 0.0;
            panel_point(mesh, panel, d == 0 ? end : 0.5, d == 0 ? 0.5 : end, point);
            for (int c = 0; c < 3; c++)
                square += (point[c] - centre[c]) * (point[c] - centre[c]);
            influence->half[p][d] = fmax(influence->half[p][d], sqrt(square));
        }
    }
    influence->box[p][0] = INFINITY;
    influence->box[p][1] = -INFINITY;
    for (size_t e = panel->first; e < panel->first + panel->count; e++) {
        influence->box[p][0] = fmin(influence->box[p][0], mesh->element[e].box[0][0]);
        influence->box[p][1] = fmax(influence->box[p][1], mesh->element[e].box[1][0]);
    }
}

static void panel_nodes(const struct influence *influence, const struct panel *panel,
                        const int points[2], struct nodes *nodes)
{
    const struct gauss *gauss = &influence->gauss;
    for (int i = 0; i < points[0]; i++)
        for (int j = 0; j < points[1]; j++) {
            const double at[2] = {gauss->node[points[0]][i], gauss->node[points[1]][j]};
            double local[2];
            double weight = gauss->weight[points[0]][i] * gauss->weight[points[1]][j];
            const struct element *element = locate(influence->mesh, panel, at, local);
            for (int d = 0; d < 2; d++)
                weight *=
                    (panel->upper[d] - panel->lower[d]) / (element->upper[d] - element->lower[d]);
            point_node(element, local[0], local[1], weight, nodes);
        }
}

/* Integrals of the basis functions by a tensor rule. */
static void basis_integrals(const struct influence *influence, const struct panel *panel,
                            const int points[2], struct nodes *nodes, double *f, double *integral)
{
    size_t m = functions(&influence->mesh->element[panel->first]);
    nodes_clear(nodes);
    panel_nodes(influence, panel, points, nodes);
    memset(integral, 0, m * sizeof *integral);
    if (nodes->failed)
        return;
    nodes_fold(nodes, f);
    for (size_t i = 0; i < nodes->n; i++)
        for (size_t a = 0; a < m; a++)
            integral[a] += f[i * m + a];
}

static void measure_shape(struct influence *influence, size_t p, struct nodes *nodes, double *f)
{
    const struct panel *panel = &influence->mesh->panel[p];
    const struct element *element = &influence->mesh->element[panel->first];
    size_t m = functions(element);
    double reference[ELEMENT_FUNCTIONS], integral[ELEMENT_FUNCTIONS];
    const int fine[2] = {SHAPE_POINTS, SHAPE_POINTS};
    basis_integrals(influence, panel, fine, nodes, f, reference);
    for (int d = 0; d < 2; d++)
        for (int k = 0; k < REGULAR_CLASSES; k++) {
            int points[2] = {SHAPE_POINTS, SHAPE_POINTS};
            points[d] = least_points(element, d) + class_points[k];
            basis_integrals(influence, panel, points, nodes, f, integral);
            double error = 0.0;
            for (size_t a = 0; a < m; a++)
                error = fmax(error, fabs(integral[a] - reference[a]));
            influence->shape_error[p][d][k] = error;
        }
}

/* The functions of the basis add up to one: their strengths to the node's area. */
static void fill_normals(const struct nodes *nodes, size_t functions_here,
                         struct regular_rule *rule)
{
    for (size_t i = 0; i < rule->n; i++) {
        for (size_t c = 0; c < 3; c++)
            rule->normal[c][i] = nodes->normal[3 * i + c];
        rule->area[i] = 0.0;
        for (size_t a = 0; a < functions_here; a++)
            rule->area[i] += rule->f[i * functions_here + a];
    }
}

static void fill_panel(struct influence *influence, size_t p, double *at, struct nodes *nodes)
{
    const struct element *element = &influence->mesh->element[influence->mesh->panel[p].first];
    panel_extent(influence, p);
    for (int k = 0; k < REGULAR_CLASSES * REGULAR_CLASSES; k++) {
        struct regular_rule *rule =
            &influence->regular[p * REGULAR_CLASSES * REGULAR_CLASSES + (size_t)k];
        const int class[2] = {k / REGULAR_CLASSES, k % REGULAR_CLASSES};
        nodes_clear(nodes);
        regular_nodes(influence, p, class, nodes);
        if (nodes->failed)
            return;
        size_t n = nodes->n;
        double *f = at + RULE_COLUMNS * n;
        *rule = (struct regular_rule){
            n, at, at + n, at + 2 * n, f, {at + 3 * n, at + 4 * n, at + 5 * n}, at + 6 * n};
        memcpy(rule->x, nodes->x, n * sizeof *at);
        memcpy(rule->y, nodes->y, n * sizeof *at);
        memcpy(rule->z, nodes->z, n * sizeof *at);
        nodes_fold(nodes, f);
        fill_normals(nodes, functions(element), rule);
        at += n * (RULE_COLUMNS + functions(element));
    }
}

void regular_nodes(const struct influence *influence, size_t p, const int class[2],
                   struct nodes *nodes)
{
    const struct panel *panel = &influence->mesh->panel[p];
    const struct element *element = &influence->mesh->element[panel->first];
    const int points[2] = {least_points(element, 0) + class_points[class[0]],
                           least_points(element, 1) + class_points[class[1]]};
    panel_nodes(influence, panel, points, nodes);
}

static size_t panel_doubles(const struct mesh *mesh, size_t p)
{
    const struct element *element = &mesh->element[mesh->panel[p].first];
    return class_nodes(element) * (RULE_COLUMNS + functions(element));
}

static igabem_status fill_regular(struct influence *influence)
{
    const struct mesh *mesh = influence->mesh;
    size_t *offset = malloc((mesh->panels + 1) * sizeof *offset);
    if (!offset)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes");
    bool failed = false;
    for (size_t p = 0, at = 0; p < mesh->panels; p++) {
        offset[p] = at;
        at += panel_doubles(mesh, p);
    }
#pragma omp parallel num_threads(influence->threads) reduction(| : failed)
    {
        struct nodes nodes;
        nodes_init(&nodes, mesh);
        nodes.with_normals = true;
        size_t most = (size_t)(SHAPE_POINTS * GAUSS_MAX) * ELEMENT_FUNCTIONS;
        double *f = malloc(most * sizeof *f);
        failed |= !f;
#pragma omp for schedule(dynamic, 2)
        for (size_t p = 0; p < mesh->panels; p++) {
            if (failed)
                continue;
            fill_panel(influence, p, influence->storage + offset[p], &nodes);
            measure_shape(influence, p, &nodes, f);
            failed |= nodes.failed;
        }
        nodes_free(&nodes);
        free(f);
    }
    free(offset);
    return failed ? igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes") : IGABEM_OK;
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
    influence->tolerance = tolerance;
    influence->threads = threads;
    size_t doubles = 0;
    for (size_t p = 0; p < mesh->panels; p++)
        doubles += panel_doubles(mesh, p);
    influence->centre = malloc(mesh->panels * sizeof *influence->centre);
    influence->half = malloc(mesh->panels * sizeof *influence->half);
    influence->box = malloc(mesh->panels * sizeof *influence->box);
    influence->shape_error = malloc(mesh->panels * sizeof *influence->shape_error);
    influence->regular =
        malloc(mesh->panels * REGULAR_CLASSES * REGULAR_CLASSES * sizeof *influence->regular);
    influence->storage = malloc(doubles * sizeof *influence->storage);
    igabem_status status = gauss_fill(&influence->gauss);
    if (!influence->centre || !influence->half || !influence->box || !influence->regular ||
        !influence->shape_error || !influence->storage)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes of %zu panels",
                             mesh->panels);
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
    free(influence->box);
    free(influence->shape_error);
    free(influence->regular);
    free(influence->storage);
    free(influence);
}

void influence_count(const struct influence *influence, const struct igabem_cost *cost)
{
    struct igabem_cost *total = influence->cost;
    if (!total)
        return;
    total->singular_pairs += cost->singular_pairs;
    total->near_pairs += cost->near_pairs;
    total->far_pairs += cost->far_pairs;
    total->rankine += cost->rankine;
    total->local += cost->local;
    total->wave += cost->wave;
}

VECTOR_MULTIVERSION
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

bool element_contains(const struct density *density, const struct element *element, size_t point,
                      double local[2])
{
    if (density->owner[point] != element->patch)
        return false;
    for (int d = 0; d < 2; d++) {
        double width = element->upper[d] - element->lower[d];
        local[d] = (density->uv[point][d] - element->lower[d]) / width;
        if (local[d] < -1e-10 || local[d] > 1.0 + 1e-10)
            return false;
        local[d] = local[d] < 0 ? 0 : local[d] > 1 ? 1 : local[d];
    }
    return true;
}
