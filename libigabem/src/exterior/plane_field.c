#include "exterior/plane_field.h"

#include "core/constants.h"
#include "core/error.h"
#include "core/vector_math.h"
#include "space/quadrature_near.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Second derivatives of the kernel fall by two more powers of the distance than it does: rules for
 * so much of the tolerance keep them as close. */
static const double finer = 1e-3;

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a flow along the still water");
}

static const size_t rules_each = (size_t)REGULAR_CLASSES * REGULAR_CLASSES;

/* The transpose of regular_scatter(). */
static void gather(const struct element *element, const struct regular_rule *rule,
                   const double *coefficients, double *out)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *f = rule->f;
    for (size_t i = 0; i < rule->n; i++) {
        out[i] = 0.0;
        for (size_t a = 0; a < m; a++, f += n) {
            const double *row = coefficients + element->first + a * element->stride;
            for (size_t b = 0; b < n; b++)
                out[i] += f[b] * row[b];
        }
    }
}

igabem_status plane_layer_create(const struct influence *influence, const double *phi, bool flux,
                                 struct plane_layer *layer)
{
    const struct mesh *mesh = influence->mesh;
    size_t rules = rules_each * mesh->panels, nodes = 0;
    *layer = (struct plane_layer){influence, phi, flux, NULL,
                                  malloc((rules + 1) * sizeof *layer->offset)};
    for (size_t r = 0; r < rules && layer->offset; r++) {
        layer->offset[r] = nodes;
        nodes += influence->regular[r].n;
    }
    layer->strength = malloc((nodes + 1) * sizeof *layer->strength);
    if (!layer->offset || !layer->strength)
        return no_memory();
    for (size_t r = 0; r < rules; r++)
        gather(&mesh->element[mesh->panel[r / rules_each].first], &influence->regular[r], phi,
               layer->strength + layer->offset[r]);
    return IGABEM_OK;
}

void plane_layer_free(struct plane_layer *layer)
{
    free(layer->offset);
    free(layer->strength);
}

/* With R = P - Q, f = 1/r and g = (R.n)/r^3: sums of the derivatives of -source f + dipole g. */
VECTOR_INLINE void sums(const double p[2], size_t n, const double *x, const double *y,
                        const double *z, const double *const normal[3], size_t step,
                        const double *source, const double *dipole, double sum[5])
{
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0, s4 = 0.0;
#pragma omp simd reduction(+ : s0, s1, s2, s3, s4)
    for (size_t i = 0; i < n; i++) {
        double dx = p[0] - x[i], dy = p[1] - y[i], dz = -z[i];
        double nx = normal[0][step * i], ny = normal[1][step * i], nz = normal[2][step * i];
        double q = 1.0 / (dx * dx + dy * dy + dz * dz), q3 = q * sqrt(q), q5 = q3 * q;
        double m = dipole[i], rn = dx * nx + dy * ny + dz * nz;
        double along = source[i] * q3 - 3.0 * m * rn * q5; /* of R_i */
        double twice = -3.0 * source[i] * q5 + 15.0 * m * rn * q5 * q, mixed = -3.0 * m * q5;
        s0 += along * dx + m * q3 * nx;
        s1 += along * dy + m * q3 * ny;
        s2 += along + twice * dx * dx + 2.0 * mixed * nx * dx;
        s3 += twice * dx * dy + mixed * (nx * dy + ny * dx);
        s4 += along + twice * dy * dy + 2.0 * mixed * ny * dy;
    }
    sum[0] = s0;
    sum[1] = s1;
    sum[2] = s2;
    sum[3] = s3;
    sum[4] = s4;
}

VECTOR_MULTIVERSION
static void far_sums(const double p[2], const struct regular_rule *rule, const double *source,
                     const double *dipole, double sum[5])
{
    const double *const normal[3] = {rule->normal[0], rule->normal[1], rule->normal[2]};
    sums(p, rule->n, rule->x, rule->y, rule->z, normal, 1, source, dipole, sum);
}

VECTOR_MULTIVERSION
static void near_sums(const double p[2], const struct nodes *nodes, const double *source,
                      const double *dipole, double sum[5])
{
    const double *const normal[3] = {nodes->normal, nodes->normal + 1, nodes->normal + 2};
    sums(p, nodes->n, nodes->x, nodes->y, nodes->z, normal, 3, source, dipole, sum);
}

/* Image and still water: twice, over 4 pi. mirror: -1 for the point's reflection in y. */
static void take(const double sum[5], double mirror, double derivative[5])
{
    const double sign[5] = {1.0, mirror, 1.0, mirror, 1.0};
    for (int k = 0; k < 5; k++)
        derivative[k] += sign[k] * sum[k] / (2.0 * PI);
}

static void add_far(const struct plane_layer *layer, size_t panel, const int class[2],
                    const double p[2], double mirror, double derivative[5])
{
    const struct regular_rule *rule = regular_rule_of(layer->influence, panel, class);
    double source[REGULAR_MOST * REGULAR_MOST], sum[5];
    for (size_t i = 0; i < rule->n; i++)
        source[i] = layer->flux ? rule->normal[0][i] * rule->area[i] : 0.0;
    far_sums(p, rule, source, layer->strength + layer->offset[rule - layer->influence->regular],
             sum);
    take(sum, mirror, derivative);
}

static igabem_status add_near(const struct plane_layer *layer, const double p[2], double mirror,
                              struct layer_work *work, double derivative[5])
{
    struct nodes *nodes = &work->nodes;
    if (!nodes->failed && nodes->n == 0)
        return IGABEM_OK;
    if (!layer_work_reserve(work, nodes))
        return no_memory();
    double *source = work->kernel, *dipole = source + nodes->n, sum[5];
    for (size_t b = 0; b < nodes->blocks; b++) {
        const struct element *element = nodes->block[b].element;
        double phi[ELEMENT_FUNCTIONS];
        element_gather(element, layer->phi, phi);
        for (size_t i = nodes->block[b].begin; i < nodes->block[b].end; i++) {
            double weight = nodes_weight(nodes, element, i);
            source[i] = layer->flux ? nodes->normal[3 * i] * nodes->g[i] * weight : 0.0;
            dipole[i] = nodes->g[i] * nodes_value(nodes, element, i, phi, 1);
        }
    }
    near_sums(p, nodes, source, dipole, sum);
    take(sum, mirror, derivative);
    nodes_clear(nodes);
    return IGABEM_OK;
}

igabem_status plane_layer_add(const struct plane_layer *layer, const double at[2],
                              struct layer_work *work, double derivative[5])
{
    const struct influence *influence = layer->influence;
    const struct mesh *mesh = influence->mesh;
    igabem_status status = IGABEM_OK;
    for (int side = 0; side < 2 && status == IGABEM_OK; side++) {
        const double mirror = side ? -1.0 : 1.0, p[2] = {at[0], mirror * at[1]};
        const struct near_rule rule = {.point = {p[0], p[1], 0.0},
                                       .tolerance = finer * influence->tolerance,
                                       .gauss = &influence->gauss};
        for (size_t k = 0; k < mesh->panels; k++) {
            int class[2] = {0, 0};
            if (regular_class(influence, k, &rule, class)) {
                add_far(layer, k, class, p, mirror, derivative);
                continue;
            }
            size_t end = mesh->panel[k].first + mesh->panel[k].count;
            for (size_t e = mesh->panel[k].first; e < end; e++) {
                struct domain domain;
                domain_whole(&mesh->element[e], &domain);
                near_nodes(&rule, &domain, &work->nodes);
            }
        }
        status = add_near(layer, p, mirror, work, derivative);
    }
    return status;
}
