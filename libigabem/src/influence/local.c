#include "core/constants.h"
#include "core/error.h"
#include "influence/influence.h"
#include "space/quadrature_near.h"

#include <igabem/kelvin.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Panels far enough from both images of the point use their regular rules. */
struct far_panel {
    size_t panel, first; /* first node of the batch */
    const struct regular_rule *rule;
};

struct local_work {
    struct nodes nodes[2]; /* per image */
    struct far_panel *far;
    size_t far_panels, far_nodes;
    double *batch; /* X, Y, Z and the three derivatives, `capacity` each */
    size_t capacity;
    struct igabem_cost cost;
};

static bool reserve(struct local_work *work, size_t n)
{
    if (n <= work->capacity)
        return true;
    free(work->batch);
    work->capacity = n + n / 2;
    work->batch = malloc(6 * work->capacity * sizeof *work->batch);
    if (!work->batch)
        work->capacity = 0;
    return work->batch != NULL;
}

/* Rule for a panel that all images see from far enough, NULL if there is none. */
static const struct regular_rule *far_rule(const struct influence *influence, size_t p,
                                           struct near_rule *rule, const double image[2][3],
                                           int images)
{
    int class[2] = {0, 0};
    for (int i = 0; i < images; i++) {
        memcpy(rule->point, image[i], sizeof rule->point);
        if (!regular_class(influence, p, rule, class))
            return NULL;
    }
    return regular_rule_of(influence, p, class);
}

/* Nodes of all panels: regular where possible, else divided towards the image that is near, and
 * always divided at x = x_P, where N has a kink. */
static void collect(const struct influence *influence, double k0, const double image[2][3],
                    int images, struct local_work *work)
{
    const struct mesh *mesh = influence->mesh;
    struct near_rule rule = {
        .k0 = k0, .tolerance = influence->tolerance, .gauss = &influence->gauss};
    double x = image[0][0];
    work->far_panels = work->far_nodes = 0;
    for (int i = 0; i < images; i++)
        nodes_clear(&work->nodes[i]);
    for (size_t p = 0; p < mesh->panels; p++) {
        const struct panel *panel = &mesh->panel[p];
        double slack = 1e-9 * (influence->half[p][0] + influence->half[p][1]);
        int cut = influence->box[p][0] < x - slack && influence->box[p][1] > x + slack;
        const struct regular_rule *far = cut ? NULL : far_rule(influence, p, &rule, image, images);
        if (far) {
            work->far[work->far_panels++] = (struct far_panel){p, work->far_nodes, far};
            work->far_nodes += far->n;
            work->cost.far_pairs += (size_t)images;
            continue;
        }
        for (size_t e = panel->first; e < panel->first + panel->count; e++) {
            const struct element *element = &mesh->element[e];
            struct domain pieces[DOMAIN_PIECES];
            size_t n = 1;
            if (element->box[0][0] < x - slack && element->box[1][0] > x + slack)
                n = domain_cut(element, x, pieces);
            else
                domain_whole(element, pieces);
            for (int i = 0; i < images; i++) {
                memcpy(rule.point, image[i], sizeof rule.point);
                for (size_t k = 0; k < n; k++)
                    near_nodes(&rule, &pieces[k], &work->nodes[i]);
                work->cost.near_pairs++;
            }
        }
    }
}

static void scale_into(double k0, const double image[3], size_t n, const double *x, const double *y,
                       const double *z, double *X, double *Y, double *Z)
{
    for (size_t i = 0; i < n; i++) {
        X[i] = k0 * (image[0] - x[i]);
        Y[i] = k0 * (image[1] - y[i]);
        Z[i] = k0 * (z[i] - image[2]);
    }
}

/* All nodes of the point in one call of the Green function. */
static igabem_status evaluate(double k0, const double image[2][3], int images,
                              struct local_work *work, size_t *total)
{
    size_t n = work->far_nodes * (size_t)images;
    for (int i = 0; i < images; i++) {
        if (work->nodes[i].failed)
            return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for quadrature nodes");
        n += work->nodes[i].n;
    }
    *total = n;
    work->cost.local += n;
    if (!reserve(work, n))
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu nodes", n);
    double *X = work->batch, *Y = X + n, *Z = Y + n, *v = Z + n;
    size_t at = 0;
    for (int i = 0; i < images; i++)
        for (size_t e = 0; e < work->far_panels; e++) {
            const struct regular_rule *rule = work->far[e].rule;
            scale_into(k0, image[i], rule->n, rule->x, rule->y, rule->z, X + at, Y + at, Z + at);
            at += rule->n;
        }
    for (int i = 0; i < images; i++) {
        const struct nodes *nodes = &work->nodes[i];
        scale_into(k0, image[i], nodes->n, nodes->x, nodes->y, nodes->z, X + at, Y + at, Z + at);
        at += nodes->n;
    }
    return igabem_kelvin_local(n, X, Y, Z, NULL, v, v + n, v + 2 * n);
}

/* Turns the derivatives into velocities by a factor; the second half of the far nodes and of the
 * near ones belong to the image in y. */
static void scatter(const struct influence *influence, double factor, int images,
                    struct local_work *work, size_t n, double *rows)
{
    double *v = work->batch + 3 * n;
    size_t far = work->far_nodes, stride = influence->density->n;
    for (size_t i = 0; i < 3 * n; i++)
        v[i] *= factor;
    for (size_t c = 0; c < 3 && images == 2; c++)
        for (size_t i = 0; i < far; i++)
            v[c * n + i] += c == 1 ? -v[c * n + far + i] : v[c * n + far + i];
    for (size_t e = 0; e < work->far_panels; e++) {
        const struct far_panel *entry = &work->far[e];
        regular_scatter(&influence->mesh->element[influence->mesh->panel[entry->panel].first],
                        entry->rule, 3, v + entry->first, n, rows, stride);
    }
    size_t at = far * (size_t)images;
    for (int i = 0; i < images; at += work->nodes[i].n, i++) {
        double *vy = v + n + at;
        for (size_t k = 0; k < work->nodes[i].n && i == 1; k++)
            vy[k] = -vy[k];
        nodes_scatter(&work->nodes[i], 3, v + at, n, rows, stride);
    }
}

/* Both images of the point see the line at the same distance when it lies in the centre plane and
 * at different ones elsewhere, so each has its own nodes. */
static igabem_status line_rows(const struct influence *influence, const struct line *line,
                               double k0, double factor, const double image[2][3], int images,
                               struct local_work *work, double *rows)
{
    struct near_rule rule = {
        .k0 = k0, .tolerance = influence->tolerance, .gauss = &influence->gauss};
    work->far_panels = work->far_nodes = 0;
    for (int i = 0; i < images; i++) {
        nodes_clear(&work->nodes[i]);
        memcpy(rule.point, image[i], sizeof rule.point);
        for (size_t s = 0; s < line->n; s++) {
            double stops[ELEMENT_SIDE + 2];
            size_t n = line_cut(&line->segment[s], image[i][0], stops);
            for (size_t k = 0; k + 1 < n; k++)
                if (stops[k + 1] - stops[k] > 1e-12)
                    line_near(line, &line->segment[s], stops + k, &rule, &work->nodes[i]);
        }
        for (size_t k = 0; k < work->nodes[i].n; k++)
            work->nodes[i].g[k] /= k0;
    }
    size_t total;
    igabem_status status = evaluate(k0, image, images, work, &total);
    if (status == IGABEM_OK)
        scatter(influence, factor, images, work, total, rows);
    return status;
}

static igabem_status surface_rows(const struct influence *influence, double k0, double factor,
                                  const double image[2][3], int images, struct local_work *work,
                                  double *rows)
{
    size_t total;
    collect(influence, k0, image, images, work);
    igabem_status status = evaluate(k0, image, images, work, &total);
    if (status == IGABEM_OK)
        scatter(influence, factor, images, work, total, rows);
    return status;
}

/* The rows of surface sources (line NULL) or of the waterline. */
static igabem_status all_rows(const struct influence *influence, const struct line *line, double k0,
                              const double *weight, double *rows)
{
    const struct density *density = influence->density;
    size_t n = density->n;
    int images = density->symmetric ? 2 : 1;
    igabem_status result = IGABEM_OK;
#pragma omp parallel num_threads(influence->threads)
    {
        struct local_work work = {0};
        for (int i = 0; i < 2; i++)
            nodes_init(&work.nodes[i], influence->mesh);
        work.far = malloc(influence->mesh->panels * sizeof *work.far);
        igabem_status status =
            work.far ? IGABEM_OK : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a matrix row");
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < n; i++) {
            if (status != IGABEM_OK || (weight && weight[i] == 0.0))
                continue;
            const double *p = density->point + 3 * i;
            double image[2][3] = {{p[0], p[1], -p[2]}, {p[0], -p[1], -p[2]}};
            const double(*const_image)[3] = (const double(*)[3])image;
            double *to = rows + 3 * n * i,
                   factor = (weight ? weight[i] : 1.0) * k0 * k0 / (4.0 * PI);
            status = line ? line_rows(influence, line, k0, factor, const_image, images, &work, to)
                          : surface_rows(influence, k0, factor, const_image, images, &work, to);
            if (progress_step(influence->progress))
                status = IGABEM_ERROR_CANCELLED;
        }
#pragma omp critical
        {
            influence_count(influence, &work.cost);
            if (status != IGABEM_OK)
                result = status;
        }
        for (int i = 0; i < 2; i++)
            nodes_free(&work.nodes[i]);
        free(work.far);
        free(work.batch);
    }
    if (result == IGABEM_ERROR_CANCELLED)
        return progress_status(influence->progress);
    if (result == IGABEM_ERROR_MEMORY)
        return igabem_fail(result, "no memory for the local part of the Green function");
    return result == IGABEM_OK ? result
                               : igabem_fail(result, "the local part of the Green function failed");
}

igabem_status influence_local(const struct influence *influence, double k0, const double *weight,
                              double *rows)
{
    return all_rows(influence, NULL, k0, weight, rows);
}

igabem_status influence_local_line(const struct influence *influence, const struct line *line,
                                   double k0, const double *weight, double *rows)
{
    return all_rows(influence, line, k0, weight, rows);
}
