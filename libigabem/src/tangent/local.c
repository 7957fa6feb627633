/* The local part k0 N, by the rules that the solve chose (influence/local.c). */
#include "core/constants.h"
#include "kelvin/kelvin_slope.h"
#include "space/quadrature_near.h"
#include "tangent/change.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { IMAGES = 2, NONE = -1 }; /* of the half hull: the point and its mirror image in y */

struct local_work {
    struct nodes nodes;
    struct moving moving;
    struct kernels kernels;
    double *batch; /* X, Y, Z, gradient and slope, `capacity` each */
    size_t capacity;
};

/* The point above the water, where the free surface sees it from. */
static void image_of(const struct density *density, size_t point, int i, double image[3])
{
    const double *p = density->point + 3 * point;
    image[0] = p[0];
    image[1] = i ? -p[1] : p[1];
    image[2] = -p[2];
}

/* Adds the kernels of one image at the nodes. */
static bool add_kernels(double k0, double weight, const double image[3], int i, size_t n,
                        const double *x, const double *y, const double *z, struct local_work *work)
{
    enum { COLUMNS = 9 };
    if (n > work->capacity) {
        free(work->batch);
        work->capacity = n + n / 2;
        work->batch = malloc(COLUMNS * work->capacity * sizeof *work->batch);
    }
    if (!work->batch) {
        work->capacity = 0;
        return n == 0;
    }
    double *X = work->batch, *Y = X + n, *Z = Y + n, *gradient = Z + n, *slope = gradient + 3 * n;
    for (size_t k = 0; k < n; k++) {
        X[k] = k0 * (image[0] - x[k]);
        Y[k] = k0 * (image[1] - y[k]);
        Z[k] = k0 * (z[k] - image[2]);
    }
    if (kelvin_local_slope(n, X, Y, Z, gradient, slope) != IGABEM_OK)
        return false;
    double turn = i ? -1.0 : 1.0, factor = weight * k0 * k0 / (4.0 * PI);
    for (size_t c = 0; c < 3; c++) {
        double sign = c == 1 ? factor * turn : factor;
        for (size_t k = c * n; k < (c + 1) * n; k++) {
            work->kernels.k[k] += sign * gradient[k];
            work->kernels.slope[k] += sign * k0 * slope[k];
            work->kernels.turned[k] += turn * sign * k0 * slope[k];
        }
    }
    return true;
}

static bool add_own(double k0, double weight, const double image[3], int i, struct local_work *work)
{
    const struct nodes *nodes = &work->nodes;
    return kernels_clear(&work->kernels, nodes->n) &&
           add_kernels(k0, weight, image, i, nodes->n, nodes->x, nodes->y, nodes->z, work);
}

/* The rule by which every image sees a panel from afar; NONE: there is none. */
static void look(const struct influence *influence, double k0, size_t p, size_t point, int class[2])
{
    const double *box = influence->box[p], x = influence->density->point[3 * point];
    double slack = 1e-9 * (influence->half[p][0] + influence->half[p][1]);
    struct near_rule rule = {.k0 = k0, .tolerance = influence->tolerance};
    bool far = !(box[0] < x - slack && box[1] > x + slack);
    class[0] = class[1] = 0;
    for (int i = 0; i < IMAGES && far; i++) {
        image_of(influence->density, point, i, rule.point);
        far = regular_class(influence, p, &rule, class);
    }
    if (!far)
        class[0] = class[1] = NONE;
}

/* Appends the nodes of a panel for one image, divided at x = x_P. */
static void panel_nodes(const struct influence *influence, const struct near_rule *rule, size_t p,
                        struct nodes *nodes)
{
    const struct panel *panel = &influence->mesh->panel[p];
    double slack = 1e-9 * (influence->half[p][0] + influence->half[p][1]), x = rule->point[0];
    for (size_t e = panel->first; e < panel->first + panel->count; e++) {
        const struct element *element = &influence->mesh->element[e];
        struct domain pieces[DOMAIN_PIECES];
        size_t n = 1;
        if (element->box[0][0] < x - slack && element->box[1][0] > x + slack)
            n = domain_cut(element, x, pieces);
        else
            domain_whole(element, pieces);
        for (size_t k = 0; k < n; k++)
            near_nodes(rule, &pieces[k], nodes);
    }
}

static bool surface_change(const struct change *change, double weight, const int (*class)[2],
                           size_t point, struct local_work *work, double *out, double turn[3])
{
    const struct influence *influence = change->influence;
    const struct field *field = change->tangent->field;
    double k0 = change->tangent->solution->k0, image[3];
    struct near_rule rule = {
        .k0 = k0, .tolerance = influence->tolerance, .gauss = &influence->gauss};
    for (size_t p = 0; p < influence->mesh->panels; p++) {
        if (class[p][0] == NONE)
            continue;
        const struct rule *far = rules_of(change->rules, p, class[p]);
        if (!kernels_clear(&work->kernels, far->n))
            return false;
        for (int i = 0; i < IMAGES; i++) {
            image_of(influence->density, point, i, image);
            if (!add_kernels(k0, weight, image, i, far->n, far->x, far->y, far->z, work))
                return false;
        }
        kernels_sum_rule(&work->kernels, field, far, out, turn);
    }
    for (int i = 0; i < IMAGES; i++) {
        image_of(influence->density, point, i, rule.point);
        nodes_clear(&work->nodes);
        for (size_t p = 0; p < influence->mesh->panels; p++)
            if (class[p][0] == NONE)
                panel_nodes(influence, &rule, p, &work->nodes);
        if (!moving_fill(change->tangent, change->bernstein, &work->nodes, &work->moving) ||
            !add_own(k0, weight, rule.point, i, work))
            return false;
        kernels_sum(&work->kernels, field, &work->nodes, &work->moving, out, turn);
    }
    return true;
}

static bool line_part(const struct change *change, const struct line *line, double weight,
                      size_t point, struct local_work *work, double *out, double turn[3])
{
    const struct influence *influence = change->influence;
    double k0 = change->tangent->solution->k0;
    struct near_rule rule = {
        .k0 = k0, .tolerance = influence->tolerance, .gauss = &influence->gauss};
    for (int i = 0; i < IMAGES; i++) {
        image_of(influence->density, point, i, rule.point);
        for (size_t s = 0; s < line->n; s++) {
            const struct line_segment *segment = &line->segment[s];
            double stops[ELEMENT_SIDE + 2];
            size_t n = line_cut(segment, rule.point[0], stops);
            nodes_clear(&work->nodes);
            for (size_t k = 0; k + 1 < n; k++)
                if (stops[k + 1] - stops[k] > 1e-12)
                    line_near(line, segment, stops + k, &rule, &work->nodes);
            if (!moving_fill_line(change->tangent, change->bernstein, line, segment, 1.0 / k0,
                                  &work->nodes, &work->moving) ||
                !add_own(k0, weight, rule.point, i, work))
                return false;
            kernels_sum(&work->kernels, change->tangent->field, &work->nodes, &work->moving, out,
                        turn);
        }
    }
    return true;
}

static void find_classes(const struct change *change, const double *weight, int (*class)[2])
{
    const struct influence *influence = change->influence;
    size_t n = influence->density->n, panels = influence->mesh->panels;
    double k0 = change->tangent->solution->k0;
#pragma omp parallel for num_threads(influence->threads) schedule(dynamic, 4)
    for (size_t i = 0; i < n; i++)
        for (size_t p = 0; p < panels; p++) {
            int *to = class[i * panels + p];
            to[0] = to[1] = NONE;
            if (weight[i] != 0.0)
                look(influence, k0, p, i, to);
        }
    for (size_t k = 0; k < n * panels; k++)
        if (class[k][0] != NONE)
            rules_of(change->rules, k % panels, class[k])->used = true;
}

static bool all_points(const struct change *change, const struct line *line, const double *weight,
                       const int (*class)[2], double *velocity)
{
    const struct influence *influence = change->influence;
    const igabem_tangent *tangent = change->tangent;
    size_t n = influence->density->n, fields = tangent->field->n, panels = influence->mesh->panels;
    bool failed = false;
#pragma omp parallel num_threads(influence->threads) reduction(| : failed)
    {
        struct local_work work = {.batch = NULL};
        nodes_init(&work.nodes, influence->mesh);
        work.nodes.with_jets = work.nodes.with_normals = true;
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < n; i++) {
            double *out = velocity + 3 * fields * i, turn[3] = {0.0, 0.0, 0.0};
            if (failed || weight[i] == 0.0)
                continue;
            failed |= !surface_change(change, weight[i], class + i * panels, i, &work, out, turn) ||
                      (line && !line_part(change, line, weight[i], i, &work, out, turn));
            for (size_t c = 0; c < 3; c++)
                for (size_t f = 0; f < fields; f++)
                    out[c * fields + f] += turn[c] * tangent->point[i * fields + f];
        }
        nodes_free(&work.nodes);
        moving_free(&work.moving);
        kernels_free(&work.kernels);
        free(work.batch);
    }
    return !failed;
}

igabem_status change_local(const struct change *change, const struct line *line,
                           const double *weight, double *velocity)
{
    const struct influence *influence = change->influence;
    int(*class)[2] = malloc(influence->density->n * influence->mesh->panels * sizeof *class);
    bool complete = class != NULL;
    if (complete)
        find_classes(change, weight, class);
    complete = complete && rules_fill(change, change->rules) &&
               all_points(change, line, weight, (const int(*)[2]) class, velocity);
    free(class);
    return complete ? IGABEM_OK : tangent_no_memory(change->tangent->field->n);
}
