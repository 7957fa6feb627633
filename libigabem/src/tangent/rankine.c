#include "core/constants.h"
#include "core/vector_math.h"
#include "space/quadrature_near.h"
#include "space/quadrature_singular.h"
#include "tangent/change.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One of the reflections of the field point that stand for the images of the sources. */
struct reflection {
    double y, z;
};

static const struct reflection reflections[4] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};

/* Adds factor (P - Q)/(4 pi r^3), its components multiplied by the reflection, to k[3][n], its
 * derivative with respect to y of the place P to slope, and with respect to y of the point, which
 * the reflection turns round, to turned. */
VECTOR_MULTIVERSION
static void kernel(const double p[3], const struct reflection *reflection, double factor, size_t n,
                   const double *x, const double *y, const double *z, double *restrict k,
                   double *restrict slope, double *restrict turned)
{
    double sx = factor / (4.0 * PI), sy = sx * reflection->y, sz = sx * reflection->z;
    double turn = reflection->y;
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double dx = p[0] - x[i], dy = p[1] - y[i], dz = p[2] - z[i];
        double inverse2 = 1.0 / (dx * dx + dy * dy + dz * dz);
        double inverse3 = inverse2 * sqrt(inverse2), fall = -3.0 * dy * inverse2 * inverse3;
        double tx = sx * dx * fall, ty = sy * (inverse3 + dy * fall), tz = sz * dz * fall;
        k[i] += sx * dx * inverse3;
        k[n + i] += sy * dy * inverse3;
        k[2 * n + i] += sz * dz * inverse3;
        slope[i] += tx;
        slope[n + i] += ty;
        slope[2 * n + i] += tz;
        turned[i] += turn * tx;
        turned[n + i] += turn * ty;
        turned[2 * n + i] += turn * tz;
    }
}

struct far_view {
    int class[2];
    unsigned images; /* bit i: reflection i is far enough */
};

struct work {
    struct nodes nodes;
    struct nodes singular; /* relative to the point */
    struct moving moving;
    struct kernels kernels;
};

static void reflect(const double p[3], int i, double out[3])
{
    out[0] = p[0];
    out[1] = reflections[i].y * p[1];
    out[2] = reflections[i].z * p[2];
}

static bool panel_contains(const struct influence *influence, size_t p, size_t point)
{
    const struct panel *panel = &influence->mesh->panel[p];
    double local[2];
    for (size_t e = panel->first; e < panel->first + panel->count; e++)
        if (element_contains(influence->density, &influence->mesh->element[e], point, local))
            return true;
    return false;
}

/* The images a panel is far enough from and the rule for them, as the solve chose them. */
static struct far_view look(const struct influence *influence, size_t p, size_t point, int images)
{
    struct far_view view = {{0, 0}, 0};
    for (int i = 0; i < images; i++) {
        struct near_rule rule = {.tolerance = influence->tolerance};
        int class[2] = {view.class[0], view.class[1]};
        reflect(influence->density->point + 3 * point, i, rule.point);
        if (!regular_class(influence, p, &rule, class))
            continue;
        view.images |= 1u << i;
        memcpy(view.class, class, sizeof class);
    }
    if (panel_contains(influence, p, point))
        view.images &= ~1u;
    return view;
}

/* Factor of an image: the solve gives +1/r' the sign of the reflection and the weight of the row.
 */
static double image_factor(const double *image, size_t point, int i)
{
    return i & 1 ? (image ? -image[point] : 0.0) : 1.0;
}

static bool far_part(const struct change *change, const double *image, struct rules *rules,
                     const struct far_view *views, size_t point, int images, struct work *work,
                     double *out, double turn[3])
{
    const struct influence *influence = change->influence;
    for (size_t p = 0; p < influence->mesh->panels; p++) {
        if (!views[p].images)
            continue;
        const struct rule *rule = rules_of(rules, p, views[p].class);
        if (!kernels_clear(&work->kernels, rule->n))
            return false;
        for (int i = 0; i < images; i++) {
            double factor = image_factor(image, point, i), at[3];
            if (!(views[p].images >> i & 1u) || factor == 0.0)
                continue;
            reflect(influence->density->point + 3 * point, i, at);
            kernel(at, &reflections[i], factor, rule->n, rule->x, rule->y, rule->z, work->kernels.k,
                   work->kernels.slope, work->kernels.turned);
        }
        kernels_sum_rule(&work->kernels, change->tangent->field, rule, out, turn);
    }
    return true;
}

/* Nodes that are not shared between points. */
static bool own_nodes(const struct change *change, const double at[3], int i, double factor,
                      struct nodes *nodes, struct work *work, double *out, double turn[3])
{
    if (!moving_fill(change->tangent, change->bernstein, nodes, &work->moving) ||
        !kernels_clear(&work->kernels, nodes->n))
        return false;
    kernel(at, &reflections[i], factor, nodes->n, nodes->x, nodes->y, nodes->z, work->kernels.k,
           work->kernels.slope, work->kernels.turned);
    kernels_sum(&work->kernels, change->tangent->field, nodes, &work->moving, out, turn);
    nodes_clear(nodes);
    return true;
}

/* The correction of the principal value changes with the slopes of the move at the point. */
static void add_correction(const struct change *change, const struct element *element,
                           const double local[2], const double slope[2][3], double *v, double *out)
{
    const struct field *field = change->tangent->field;
    const double *density = change->bernstein + field->offset[element - field->mesh->element];
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], sigma = 0.0;
    bernstein(element->degree[0], local[0], bu, NULL);
    bernstein(element->degree[1], local[1], bv, NULL);
    for (size_t k = 0; k < m * n; k++)
        sigma += bu[k / n] * bv[k % n] * density[k];
    field_at(field, element, local, v);
    for (size_t c = 0; c < 3; c++)
        for (size_t f = 0; f < field->n; f++)
            out[c * field->n + f] +=
                sigma * (slope[0][c] * v[field->n + f] + slope[1][c] * v[2 * field->n + f]);
}

static bool near_part(const struct change *change, const double *image,
                      const struct far_view *views, size_t point, int i, struct work *work,
                      double *v, double *out, double turn[3])
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    const struct influence *influence = change->influence;
    const struct mesh *mesh = influence->mesh;
    double factor = image_factor(image, point, i);
    struct near_rule rule = {.tolerance = influence->tolerance, .gauss = &influence->gauss};
    reflect(influence->density->point + 3 * point, i, rule.point);
    for (size_t p = 0; p < mesh->panels && factor != 0.0; p++) {
        if (views[p].images >> i & 1u)
            continue;
        for (size_t e = mesh->panel[p].first; e < mesh->panel[p].first + mesh->panel[p].count;
             e++) {
            const struct element *element = &mesh->element[e];
            double local[2], correction[3], slope[2][3];
            if (i == 0 && element_contains(influence->density, element, point, local)) {
                singular_nodes(element, local[0], local[1], singular_order(influence->tolerance),
                               &influence->gauss, &work->singular, correction, slope);
                add_correction(change, element, local, (const double(*)[3])slope, v, out);
                continue;
            }
            struct domain domain;
            domain_whole(element, &domain);
            near_nodes(&rule, &domain, &work->nodes);
        }
    }
    return own_nodes(change, rule.point, i, factor, &work->nodes, work, out, turn) &&
           (i > 0 || own_nodes(change, origin, 0, 1.0, &work->singular, work, out, turn));
}

static bool point_change(const struct change *change, const double *image, struct rules *rules,
                         const struct far_view *views, size_t point, struct work *work, double *v,
                         double *out)
{
    int images = change->influence->density->symmetric ? 4 : 2;
    size_t fields = change->tangent->field->n;
    double turn[3] = {0.0, 0.0, 0.0};
    if (!far_part(change, image, rules, views, point, images, work, out, turn))
        return false;
    for (int i = 0; i < images; i++)
        if (!near_part(change, image, views, point, i, work, v, out, turn))
            return false;
    const double *move = change->tangent->point + point * fields;
    for (size_t c = 0; c < 3; c++)
        for (size_t f = 0; f < fields; f++)
            out[c * fields + f] += turn[c] * move[f];
    return true;
}

static void find_views(const struct influence *influence, struct far_view *views,
                       struct rules *rules)
{
    size_t n = influence->density->n, panels = influence->mesh->panels;
    int images = influence->density->symmetric ? 4 : 2;
#pragma omp parallel for num_threads(influence->threads) schedule(dynamic, 4)
    for (size_t i = 0; i < n; i++)
        for (size_t p = 0; p < panels; p++)
            views[i * panels + p] = look(influence, p, i, images);
    for (size_t k = 0; k < n * panels; k++)
        if (views[k].images)
            rules_of(rules, k % panels, views[k].class)->used = true;
}

static bool all_points(const struct change *change, const double *image, struct rules *rules,
                       const struct far_view *views, double *velocity)
{
    const struct influence *influence = change->influence;
    size_t n = influence->density->n, fields = change->tangent->field->n;
    bool failed = false;
#pragma omp parallel num_threads(influence->threads) reduction(| : failed)
    {
        struct work work = {.kernels = {.k = NULL}};
        nodes_init(&work.nodes, influence->mesh);
        nodes_init(&work.singular, influence->mesh);
        work.nodes.with_jets = work.singular.with_jets = true;
        double *v = malloc(3 * fields * sizeof *v);
        failed |= !v;
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < n; i++)
            if (!failed)
                failed |= !point_change(change, image, rules, views + i * influence->mesh->panels,
                                        i, &work, v, velocity + 3 * fields * i);
        nodes_free(&work.nodes);
        nodes_free(&work.singular);
        moving_free(&work.moving);
        kernels_free(&work.kernels);
        free(v);
    }
    return !failed;
}

igabem_status change_rankine(const struct change *change, const double *image, double *velocity)
{
    const struct influence *influence = change->influence;
    size_t panels = influence->mesh->panels;
    struct far_view *views = malloc(influence->density->n * panels * sizeof *views);
    bool complete = views != NULL;
    if (complete)
        find_views(influence, views, change->rules);
    complete = complete && rules_fill(change, change->rules) &&
               all_points(change, image, change->rules, views, velocity);
    free(views);
    return complete ? IGABEM_OK : tangent_no_memory(change->tangent->field->n);
}
