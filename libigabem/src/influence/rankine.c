#include "core/constants.h"
#include "core/error.h"
#include "core/vector_math.h"
#include "influence/influence.h"
#include "space/quadrature_near.h"
#include "space/quadrature_singular.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* One of the reflections of the field point that stand for the images of the sources. */
struct reflection {
    double y, z;
};

static const struct reflection reflections[4] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

/* sign (P - Q)/(4 pi r^3), its components multiplied by the reflection, added to k[3][stride]. */
VECTOR_INLINE void kernel(const double p[3], const struct reflection *reflection, double sign,
                          size_t n, const double *x, const double *y, const double *z, double *k,
                          size_t stride)
{
    double sx = sign / (4.0 * PI), sy = sx * reflection->y, sz = sx * reflection->z;
    double *kx = k, *ky = k + stride, *kz = k + 2 * stride;
    for (size_t i = 0; i < n; i++) {
        double dx = p[0] - x[i], dy = p[1] - y[i], dz = p[2] - z[i];
        double r2 = dx * dx + dy * dy + dz * dz, inverse = 1.0 / (r2 * sqrt(r2));
        kx[i] += sx * dx * inverse;
        ky[i] += sy * dy * inverse;
        kz[i] += sz * dz * inverse;
    }
}

VECTOR_MULTIVERSION
static void kernel_batch(const double p[3], const struct reflection *reflection, double sign,
                         const struct nodes *nodes, double *k)
{
    memset(k, 0, 3 * nodes->n * sizeof *k);
    kernel(p, reflection, sign, nodes->n, nodes->x, nodes->y, nodes->z, k, nodes->n);
}

struct rankine_work {
    struct nodes nodes;
    struct nodes singular; /* relative to the point */
    double *k;
    size_t capacity;
    struct igabem_cost cost;
};

static void reflect(const double p[3], const struct reflection *reflection, double out[3])
{
    out[0] = p[0];
    out[1] = reflection->y * p[1];
    out[2] = reflection->z * p[2];
}

static igabem_status flush(struct rankine_work *work, struct nodes *nodes, const double p[3],
                           const struct reflection *reflection, double *rows, size_t stride)
{
    if (!nodes->failed && nodes->n == 0)
        return IGABEM_OK;
    if (!nodes->failed && 3 * nodes->n > work->capacity) {
        free(work->k);
        work->capacity = 3 * nodes->capacity;
        work->k = malloc(work->capacity * sizeof *work->k);
    }
    if (nodes->failed || !work->k)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes");
    work->cost.rankine += nodes->n;
    kernel_batch(p, reflection, reflection->z, nodes, work->k);
    nodes_scatter(nodes, 3, work->k, nodes->n, rows, stride);
    nodes_clear(nodes);
    return IGABEM_OK;
}

/* The correction of the principal value, at the point itself. */
static void add_correction(const struct element *element, const double local[2],
                           const double correction[3], double *rows, size_t stride)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], moments[3 * ELEMENT_FUNCTIONS];
    bernstein(element->degree[0], local[0], bu, NULL);
    bernstein(element->degree[1], local[1], bv, NULL);
    for (size_t c = 0; c < 3; c++)
        for (size_t a = 0; a < m * n; a++)
            moments[c * m * n + a] = correction[c] * bu[a / n] * bv[a % n];
    element_scatter(element, 3, moments, rows, stride);
}

struct far_view {
    int class[2];
    unsigned images; /* bit i: reflection i is far enough */
};

/* Which images a panel is far enough from, and the finest rule that any of them needs. */
static struct far_view look(const struct influence *influence, size_t p, const double image[4][3],
                            int images)
{
    struct far_view view = {{0, 0}, 0};
    for (int i = 0; i < images; i++) {
        const struct near_rule rule = {.point = {image[i][0], image[i][1], image[i][2]},
                                       .tolerance = influence->tolerance};
        int class[2] = {view.class[0], view.class[1]};
        if (!regular_class(influence, p, &rule, class))
            continue;
        view.images |= 1u << i;
        memcpy(view.class, class, sizeof class);
    }
    return view;
}

/* Panels at a distance from the point: shared nodes, all images summed before the basis. */
VECTOR_MULTIVERSION
static void far_rows(const struct influence *influence, const double image[4][3],
                     const struct far_view *views, int images, double *direct, double *mirrored,
                     size_t stride, struct igabem_cost *cost)
{
    const struct mesh *mesh = influence->mesh;
    for (size_t p = 0; p < mesh->panels; p++) {
        const struct far_view *view = &views[p];
        if (!view->images)
            continue;
        const struct regular_rule *rule = regular_rule_of(influence, p, view->class);
        double k[2][3 * REGULAR_MOST * REGULAR_MOST];
        memset(k[0], 0, 3 * rule->n * sizeof(double));
        memset(k[1], 0, 3 * rule->n * sizeof(double));
        for (int i = 0; i < images; i++) {
            if (!(view->images >> i & 1u) || !(i & 1 ? mirrored : direct))
                continue;
            kernel(image[i], &reflections[i], reflections[i].z, rule->n, rule->x, rule->y, rule->z,
                   k[i & 1], rule->n);
            cost->far_pairs++;
            cost->rankine += rule->n;
        }
        const struct element *element = &mesh->element[mesh->panel[p].first];
        if (direct)
            regular_scatter(element, rule, 3, k[0], rule->n, direct, stride);
        if (mirrored)
            regular_scatter(element, rule, 3, k[1], rule->n, mirrored, stride);
    }
}

/* Panels near one image of the point, element by element. */
static igabem_status near_rows(const struct influence *influence, size_t point,
                               const double image[4][3], const struct far_view *views, int i,
                               struct rankine_work *work, double *rows)
{
    const struct density *density = influence->density;
    const struct mesh *mesh = influence->mesh;
    struct near_rule rule = {.point = {image[i][0], image[i][1], image[i][2]},
                             .tolerance = influence->tolerance,
                             .gauss = &influence->gauss};
    for (size_t p = 0; p < mesh->panels; p++) {
        if (views[p].images >> i & 1u)
            continue;
        for (size_t e = mesh->panel[p].first; e < mesh->panel[p].first + mesh->panel[p].count;
             e++) {
            const struct element *element = &mesh->element[e];
            double local[2], correction[3];
            if (i == 0 && element_contains(density, element, point, local)) {
                singular_nodes(element, local[0], local[1], singular_order(influence->tolerance),
                               &influence->gauss, &work->singular, correction, NULL);
                add_correction(element, local, correction, rows, density->n);
                work->cost.singular_pairs++;
                continue;
            }
            struct domain domain;
            domain_whole(element, &domain);
            near_nodes(&rule, &domain, &work->nodes);
            work->cost.near_pairs++;
        }
    }
    static const double origin[3] = {0.0, 0.0, 0.0};
    igabem_status status = flush(work, &work->nodes, image[i], &reflections[i], rows, density->n);
    if (status == IGABEM_OK && i == 0)
        status = flush(work, &work->singular, origin, &reflections[i], rows, density->n);
    return status;
}

/* Whether an element of the panel contains the collocation point. */
static bool panel_contains(const struct influence *influence, const struct panel *panel,
                           size_t point)
{
    double local[2];
    for (size_t e = panel->first; e < panel->first + panel->count; e++)
        if (element_contains(influence->density, &influence->mesh->element[e], point, local))
            return true;
    return false;
}

static igabem_status point_rows(const struct influence *influence, size_t point,
                                struct rankine_work *work, struct far_view *views, double *direct,
                                double *mirrored)
{
    const struct density *density = influence->density;
    int images = density->symmetric ? 4 : 2;
    double image[4][3];
    for (int i = 0; i < images; i++)
        reflect(density->point + 3 * point, &reflections[i], image[i]);
    for (size_t p = 0; p < influence->mesh->panels; p++) {
        views[p] = look(influence, p, (const double(*)[3])image, images);
        if (panel_contains(influence, &influence->mesh->panel[p], point))
            views[p].images &= ~1u;
    }
    far_rows(influence, (const double(*)[3])image, views, images, direct, mirrored, density->n,
             &work->cost);
    igabem_status status = IGABEM_OK;
    for (int i = 0; i < images && status == IGABEM_OK; i++) {
        double *rows = i & 1 ? mirrored : direct;
        if (rows)
            status = near_rows(influence, point, (const double(*)[3])image, views, i, work, rows);
    }
    return status;
}

igabem_status influence_rankine(const struct influence *influence, double *rankine, double *image,
                                const double *image_weight)
{
    size_t n = influence->density->n;
    igabem_status result = IGABEM_OK;
#pragma omp parallel num_threads(influence->threads)
    {
        struct rankine_work work = {0};
        nodes_init(&work.nodes, influence->mesh);
        nodes_init(&work.singular, influence->mesh);
        struct far_view *views = malloc(influence->mesh->panels * sizeof *views);
        double *buffer = malloc(3 * n * sizeof *buffer);
        igabem_status status = views && buffer
                                   ? IGABEM_OK
                                   : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a matrix row");
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < n; i++) {
            if (status != IGABEM_OK)
                continue;
            double *direct = rankine ? rankine + 3 * n * i : NULL;
            double weight = image || !image_weight ? 0.0 : image_weight[i];
            double *mirrored = image ? image + 3 * n * i : weight != 0.0 ? buffer : NULL;
            if (direct)
                memset(direct, 0, 3 * n * sizeof *direct);
            if (mirrored)
                memset(mirrored, 0, 3 * n * sizeof *mirrored);
            status = point_rows(influence, i, &work, views, direct, mirrored);
            for (size_t k = 0; k < 3 * n && direct && mirrored == buffer; k++)
                direct[k] += weight * buffer[k];
            if (progress_step(influence->progress))
                status = IGABEM_ERROR_CANCELLED;
        }
#pragma omp critical
        {
            influence_count(influence, &work.cost);
            if (status != IGABEM_OK)
                result = status;
        }
        nodes_free(&work.nodes);
        nodes_free(&work.singular);
        free(work.k);
        free(views);
        free(buffer);
    }
    if (result == IGABEM_ERROR_CANCELLED)
        return progress_status(influence->progress);
    return result == IGABEM_OK ? result
                               : igabem_fail(result, "no memory for the Rankine integrals");
}
