/* The wave angles of a spectral sum, its sources and points in the order of the march, and the
 * order of the unknowns for the further filters. */
#include "core/error.h"
#include "influence/spectral.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sources this share of the hull's length behind a point still count as ahead of it. */
static const double SLACK = 1e-9;

size_t spectral_functions(const struct element *element)
{
    return (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
}

static int by_decreasing_x(const void *a, const void *b)
{
    double d = ((const struct source *)b)->box[0] - ((const struct source *)a)->box[0];
    return (d > 0) - (d < 0);
}

struct point_order {
    double x;
    size_t index;
};

static int points_by_decreasing_x(const void *a, const void *b)
{
    const struct point_order *p = a, *q = b;
    double d = q->x - p->x;
    return d > 0 ? 1 : d < 0 ? -1 : (p->index > q->index) - (p->index < q->index);
}

static igabem_status sort_points(struct spectral *wave)
{
    const struct density *density = wave->influence->density;
    struct point_order *order = malloc(density->n * sizeof *order);
    wave->point = malloc(density->n * sizeof *wave->point);
    if (!order || !wave->point) {
        free(order);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu rows", density->n);
    }
    for (size_t i = 0; i < density->n; i++)
        if (!wave->weight || wave->weight[i] != 0.0)
            order[wave->points++] = (struct point_order){density->point[3 * i], i};
    qsort(order, wave->points, sizeof *order, points_by_decreasing_x);
    for (size_t i = 0; i < wave->points; i++)
        wave->point[i] = order[i].index;
    free(order);
    return IGABEM_OK;
}

static igabem_status make_sources(struct spectral *wave)
{
    const struct mesh *mesh = wave->influence->mesh;
    size_t n = mesh->panels + (wave->line ? wave->line->n : 0), doubles = 0;
    wave->source = malloc(n * sizeof *wave->source);
    if (!wave->source)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu sources", n);
    for (size_t i = 0; i < n; i++) {
        struct source *source = &wave->source[i];
        *source = (struct source){0};
        if (i < mesh->panels) {
            source->panel = &mesh->panel[i];
            source->element = &mesh->element[source->panel->first];
            memcpy(source->box, wave->influence->box[i], sizeof source->box);
        } else {
            source->segment = &wave->line->segment[i - mesh->panels];
            source->element = source->segment->element;
            memcpy(source->box, source->segment->box, sizeof source->box);
        }
        doubles += spectral_functions(source->element) * wave->width;
    }
    wave->sources = n;
    wave->storage = malloc(doubles * sizeof *wave->storage);
    if (!wave->storage)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the moments of %zu sources", n);
    qsort(wave->source, n, sizeof *wave->source, by_decreasing_x);
    double *at = wave->storage;
    for (size_t i = 0; i < n; i++) {
        wave->source[i].moments = at;
        at += spectral_functions(wave->source[i].element) * wave->width;
    }
    return IGABEM_OK;
}

/* Extent of the sources and the least depths of sources and points. */
static igabem_status make_spectrum(struct spectral *wave)
{
    const struct influence *influence = wave->influence;
    double x[2] = {INFINITY, -INFINITY}, y = 0.0, depth = INFINITY, clearance = INFINITY;
    for (size_t e = 0; e < influence->mesh->n; e++) {
        const struct element *element = &influence->mesh->element[e];
        x[0] = fmin(x[0], element->box[0][0]);
        x[1] = fmax(x[1], element->box[1][0]);
        y = fmax(y, fmax(fabs(element->box[0][1]), fabs(element->box[1][1])));
        depth = fmin(depth, fmax(0.0, -element->box[1][2]));
    }
    for (size_t i = 0; i < influence->density->n; i++)
        clearance = fmin(clearance, -influence->density->point[3 * i + 2]);
    if (wave->line && wave->line->n)
        depth = 0.0;
    double t_max = 0.0;
    for (size_t f = 0; f < wave->filters; f++)
        t_max = fmax(t_max, spectrum_limit(wave->k0, wave->cutoff[f], depth + clearance,
                                           3.0 * wave->rule.tolerance));
    igabem_status status = spectrum_create(wave->k0, t_max, x[1] - x[0], 2.0 * y, &wave->spectrum);
    if (status != IGABEM_OK)
        return status;
    wave->x0 = 0.5 * (x[0] + x[1]);
    wave->slack = SLACK * (x[1] - x[0]);
    wave->depth = depth;
    wave->rule.k0 = wave->k0;
    wave->rule.t_max = t_max;
    wave->rule.clearance = clearance;
    wave->rule.gauss = &influence->gauss;
    wave->width = 2 * wave->sets * wave->spectrum->n;
    size_t n = wave->spectrum->n;
    wave->filter = malloc(wave->filters * n * sizeof *wave->filter);
    if (!wave->filter)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the filter");
    for (size_t f = 0; f < wave->filters; f++)
        for (size_t j = 0; j < n; j++)
            wave->filter[f * n + j] = spectrum_filter(wave->spectrum->t[j], wave->cutoff[f]) -
                                      (f > 0 ? wave->filter[j] : 0.0);
    return IGABEM_OK;
}

static size_t unknown_of(const struct element *element, size_t function)
{
    size_t side = (size_t)element->degree[1] + 1;
    return element->first + function / side * element->stride + function % side;
}

/* The unknowns in the order in which the march passes the last of their sources, and how many it
 * has passed when it comes to each point. */
static igabem_status order_unknowns(const struct spectral *wave)
{
    struct filter_change *change = wave->change;
    size_t *waiting = calloc(change->n, sizeof *waiting), next = 0, passed = 0;
    if (!waiting)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a wave operator");
    for (size_t i = 0; i < wave->sources; i++)
        for (size_t f = 0; f < spectral_functions(wave->source[i].element); f++)
            waiting[unknown_of(wave->source[i].element, f)]++;
    for (size_t k = 0; k < change->n; k++)
        change->rank[k] = change->n;
    for (size_t i = 0; i < wave->points; i++) {
        double x = wave->influence->density->point[3 * wave->point[i]] - wave->slack;
        for (; next < wave->sources && wave->source[next].box[0] >= x; next++)
            for (size_t f = 0; f < spectral_functions(wave->source[next].element); f++) {
                size_t k = unknown_of(wave->source[next].element, f);
                if (--waiting[k] == 0) {
                    change->order[passed] = k;
                    change->rank[k] = passed++;
                }
            }
        change->row[i] = (struct filter_change_row){.point = wave->point[i], .ahead = passed};
    }
    free(waiting);
    return IGABEM_OK;
}

static igabem_status make_change(struct spectral *wave)
{
    size_t n = wave->spectrum->n;
    igabem_status status =
        filter_change_create(wave->influence->density->n, wave->points, wave->width,
                             wave->filters - 1, wave->influence->threads, &wave->change);
    if (status != IGABEM_OK)
        return status;
    for (size_t f = 1; f < wave->filters; f++)
        for (size_t set = 0; set < 2 * wave->sets; set++)
            memcpy(wave->change->filter + (f - 1) * wave->width + set * n, wave->filter + f * n,
                   n * sizeof(double));
    return order_unknowns(wave);
}

igabem_status spectral_create(struct spectral *wave)
{
    wave->rule.tolerance = wave->influence->tolerance;
    igabem_status status = make_spectrum(wave);
    if (status == IGABEM_OK)
        status = make_sources(wave);
    if (status == IGABEM_OK)
        status = sort_points(wave);
    if (status == IGABEM_OK && wave->filters > 1)
        status = make_change(wave);
    return status;
}

void spectral_free(struct spectral *wave)
{
    spectrum_free(wave->spectrum);
    free(wave->filter);
    free(wave->source);
    free(wave->storage);
    free(wave->point);
}
