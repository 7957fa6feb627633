#include "exterior/layers.h"

#include "core/constants.h"
#include "core/error.h"
#include "core/vector_math.h"
#include "space/quadrature_near.h"
#include "space/quadrature_singular.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Reflections of the point that stand for the images of the surface: the flat one needs the first
 * two. */
static const double reflection_y[4] = {1, -1, 1, -1}, reflection_z[4] = {1, 1, -1, -1};

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for layer potentials");
}

igabem_status layer_work_create(const struct layer_surface *surface, struct layer_work *work)
{
    const struct mesh *mesh = surface->influence->mesh;
    memset(work, 0, sizeof *work);
    nodes_init(&work->nodes, mesh);
    nodes_init(&work->singular, mesh);
    work->nodes.with_normals = work->singular.with_normals = true;
    work->far = malloc(mesh->panels * sizeof *work->far);
    work->class = malloc(mesh->panels * sizeof *work->class);
    return work->far && work->class ? IGABEM_OK : no_memory();
}

void layer_work_free(struct layer_work *work)
{
    nodes_free(&work->nodes);
    nodes_free(&work->singular);
    free(work->far);
    free(work->class);
    free(work->kernel);
}

bool layer_work_reserve(struct layer_work *work, const struct nodes *nodes)
{
    if (nodes->failed)
        return false;
    if (2 * nodes->n > work->capacity) {
        free(work->kernel);
        work->capacity = 2 * nodes->capacity;
        work->kernel = malloc(work->capacity * sizeof *work->kernel);
    }
    return work->kernel;
}

/* G and dG/dn of nodes, factor included, added. normal: three arrays. */
VECTOR_INLINE void kernels(const double p[3], double factor, size_t n, const double *x,
                           const double *y, const double *z, const double *const normal[3],
                           double *restrict single, double *restrict dipole)
{
    const double *nx = normal[0], *ny = normal[1], *nz = normal[2];
    double scale = -factor / (4.0 * PI);
    for (size_t i = 0; i < n; i++) {
        double dx = p[0] - x[i], dy = p[1] - y[i], dz = p[2] - z[i];
        double square = 1.0 / (dx * dx + dy * dy + dz * dz), inverse = scale * sqrt(square);
        single[i] += inverse;
        dipole[i] += inverse * square * (dx * nx[i] + dy * ny[i] + dz * nz[i]);
    }
}

/* The same with the normals node by node. */
VECTOR_MULTIVERSION
static void node_kernels(const double p[3], double factor, const struct nodes *nodes,
                         double *restrict single, double *restrict dipole)
{
    double scale = -factor / (4.0 * PI);
    for (size_t i = 0; i < nodes->n; i++) {
        const double *normal = nodes->normal + 3 * i;
        double dx = p[0] - nodes->x[i], dy = p[1] - nodes->y[i], dz = p[2] - nodes->z[i];
        double square = 1.0 / (dx * dx + dy * dy + dz * dz), inverse = scale * sqrt(square);
        single[i] = inverse;
        dipole[i] = inverse * square * (dx * normal[0] + dy * normal[1] + dz * normal[2]);
    }
}

/* Nodes near one image of the point, or on the point's own element. */
static igabem_status flush(struct layer_work *work, struct nodes *nodes, const double p[3],
                           double factor, struct layer_rows *rows)
{
    if (!nodes->failed && nodes->n == 0)
        return IGABEM_OK;
    if (!layer_work_reserve(work, nodes))
        return no_memory();
    double *single = work->kernel, *dipole = single + nodes->n;
    node_kernels(p, factor, nodes, single, dipole);
    if (rows->single)
        nodes_scatter(nodes, 1, single, nodes->n, rows->single, 0);
    if (rows->dipole)
        nodes_scatter(nodes, 1, dipole, nodes->n, rows->dipole, 0);
    for (size_t b = 0; b < nodes->blocks && rows->dipole; b++)
        for (size_t i = nodes->block[b].begin; i < nodes->block[b].end; i++) {
            const struct element *element = nodes->block[b].element;
            rows->flow +=
                single[i] * nodes->normal[3 * i] * nodes->g[i] * nodes_weight(nodes, element, i);
        }
    nodes_clear(nodes);
    return IGABEM_OK;
}

static bool is_home(const struct layer_point *point, size_t element)
{
    for (size_t h = 0; h < point->homes; h++)
        if (point->home[h] == element)
            return true;
    return false;
}

void layer_look(const struct layer_surface *surface, const struct layer_point *point, int images,
                const double image[4][3], struct layer_work *work)
{
    const struct influence *influence = surface->influence;
    const struct mesh *mesh = influence->mesh;
    for (size_t p = 0; p < mesh->panels; p++) {
        work->far[p] = 0;
        work->class[p][0] = work->class[p][1] = 0;
        for (int i = 0; i < images; i++) {
            const struct near_rule rule = {.point = {image[i][0], image[i][1], image[i][2]},
                                           .tolerance = influence->tolerance};
            int class[2] = {work->class[p][0], work -> class[p][1]};
            if (!regular_class(influence, p, &rule, class))
                continue;
            work->far[p] |= (unsigned char)(1u << i);
            memcpy(work->class[p], class, sizeof class);
        }
    }
    for (size_t h = 0; h < point->homes; h++)
        for (size_t p = 0; p < mesh->panels; p++)
            if (point->home[h] >= mesh->panel[p].first &&
                point->home[h] < mesh->panel[p].first + mesh->panel[p].count)
                work->far[p] &= (unsigned char)~1u;
}

VECTOR_MULTIVERSION
static void add_far(const struct layer_surface *surface, int images, const double image[4][3],
                    const struct layer_work *work, struct layer_rows *rows)
{
    const struct influence *influence = surface->influence;
    const struct mesh *mesh = influence->mesh;
    double factor = surface->flat ? 2.0 : 1.0;
    for (size_t p = 0; p < mesh->panels; p++) {
        if (!work->far[p])
            continue;
        const struct regular_rule *rule = regular_rule_of(influence, p, work->class[p]);
        const double *const normal[3] = {rule->normal[0], rule->normal[1], rule->normal[2]};
        double single[REGULAR_MOST * REGULAR_MOST], dipole[REGULAR_MOST * REGULAR_MOST];
        memset(single, 0, rule->n * sizeof *single);
        memset(dipole, 0, rule->n * sizeof *dipole);
        for (int i = 0; i < images; i++)
            if (work->far[p] >> i & 1)
                kernels(image[i], factor, rule->n, rule->x, rule->y, rule->z, normal, single,
                        dipole);
        const struct element *element = &mesh->element[mesh->panel[p].first];
        if (rows->single)
            regular_scatter(element, rule, 1, single, rule->n, rows->single, 0);
        if (!rows->dipole)
            continue;
        regular_scatter(element, rule, 1, dipole, rule->n, rows->dipole, 0);
        for (size_t k = 0; k < rule->n; k++)
            rows->flow += single[k] * rule->normal[0][k] * rule->area[k];
    }
}

void layer_near_nodes(const struct layer_surface *surface, const struct layer_point *point, int i,
                      const double image[3], struct layer_work *work)
{
    const struct influence *influence = surface->influence;
    const struct mesh *mesh = influence->mesh;
    const struct near_rule rule = {.point = {image[0], image[1], image[2]},
                                   .tolerance = influence->tolerance,
                                   .gauss = &influence->gauss};
    for (size_t p = 0; p < mesh->panels; p++) {
        if (work->far[p] >> i & 1)
            continue;
        size_t end = mesh->panel[p].first + mesh->panel[p].count;
        for (size_t e = mesh->panel[p].first; e < end; e++) {
            struct domain domain;
            if (i == 0 && is_home(point, e))
                continue;
            domain_whole(&mesh->element[e], &domain);
            near_nodes(&rule, &domain, &work->nodes);
        }
    }
}

void layer_singular_nodes(const struct layer_surface *surface, const struct layer_point *point,
                          struct layer_work *work)
{
    const struct influence *influence = surface->influence;
    for (size_t h = 0; h < point->homes; h++) {
        double unused[3];
        singular_nodes(&influence->mesh->element[point->home[h]], point->local[h][0],
                       point->local[h][1], singular_order(influence->tolerance), &influence->gauss,
                       &work->singular, unused, NULL);
    }
}

static igabem_status add_near(const struct layer_surface *surface, const struct layer_point *point,
                              int i, const double image[3], struct layer_work *work,
                              struct layer_rows *rows)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    double factor = surface->flat ? 2.0 : 1.0;
    layer_near_nodes(surface, point, i, image, work);
    igabem_status status = flush(work, &work->nodes, image, factor, rows);
    if (i > 0 || status != IGABEM_OK)
        return status;
    /* Both kernels are weakly singular: the rule's principal value corrects nothing. */
    layer_singular_nodes(surface, point, work);
    return flush(work, &work->singular, origin, factor, rows);
}

int layer_images(const struct layer_surface *surface, const struct layer_point *point,
                 double image[4][3], bool turned[4])
{
    int images = 0;
    for (int i = 0; i < 4; i++) {
        if ((i & 1 && !surface->symmetric) || (i & 2 && surface->flat))
            continue;
        turned[images] = i & 1;
        image[images][0] = point->at[0];
        image[images][1] = reflection_y[i] * point->at[1];
        image[images++][2] = reflection_z[i] * point->at[2];
    }
    return images;
}

igabem_status layer_add(const struct layer_surface *surface, const struct layer_point *point,
                        struct layer_work *work, struct layer_rows *rows)
{
    double image[4][3];
    bool turned[4];
    int images = layer_images(surface, point, image, turned);
    layer_look(surface, point, images, (const double(*)[3])image, work);
    add_far(surface, images, (const double(*)[3])image, work, rows);
    igabem_status status = IGABEM_OK;
    for (int i = 0; i < images && status == IGABEM_OK; i++)
        status = add_near(surface, point, i, image[i], work, rows);
    return status;
}

void layer_place(const struct influence *influence, size_t i, struct layer_point *point)
{
    const struct density *density = influence->density;
    const struct mesh *mesh = influence->mesh;
    size_t patch = density->owner[i];
    memset(point, 0, sizeof *point);
    memcpy(point->at, density->point + 3 * i, sizeof point->at);
    for (size_t e = mesh->patch_base[patch]; e < mesh->patch_base[patch + 1]; e++)
        if (point->homes < LAYER_HOMES &&
            element_contains(density, &mesh->element[e], i, point->local[point->homes]))
            point->home[point->homes++] = e;
}

void layer_collocation(const struct influence *influence, size_t i, struct layer_point *point,
                       double *row)
{
    layer_place(influence, i, point);
    const struct element *element = &influence->mesh->element[point->home[0]];
    const double *local = point->local[0];
    double bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], value[ELEMENT_FUNCTIONS];
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    struct jet jet;
    element_jet(element, local[0], local[1], &jet);
    bernstein(element->degree[0], local[0], bu, NULL);
    bernstein(element->degree[1], local[1], bv, NULL);
    for (size_t k = 0; k < m * n; k++)
        value[k] = 0.5 * bu[k / n] * bv[k % n] / jet.weight;
    element_scatter(element, 1, value, row, 0);
}
