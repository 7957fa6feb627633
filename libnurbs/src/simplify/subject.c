#include "simplify/subject.h"

#include "core/band.h"
#include "core/error.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t count_of(const size_t size[2])
{
    return size[0] * size[1];
}

static void set_net(struct subject *s)
{
    const size_t n = count_of(s->size);
    double largest = 0.0, smallest_weight = HUGE_VAL;
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 3 * n; i++) {
        low[i % 3] = fmin(low[i % 3], s->points[i]);
        high[i % 3] = fmax(high[i % 3], s->points[i]);
        largest = fmax(largest, fabs(s->points[i]));
    }
    s->scale = 1.0;
    s->radius = 0.0;
    for (size_t i = 0; s->weights && i < n; i++)
        smallest_weight = fmin(smallest_weight, s->weights[i]);
    for (int c = 0; c < 3; c++)
        s->centre[c] = s->weights ? low[c] + 0.5 * (high[c] - low[c]) : 0.0;
    if (s->weights) {
        s->scale = 1.0 / smallest_weight;
        for (size_t i = 0; i < n; i++)
            s->radius = fmax(s->radius, hypot(hypot(s->points[3 * i] - s->centre[0],
                                                    s->points[3 * i + 1] - s->centre[1]),
                                              s->points[3 * i + 2] - s->centre[2]));
        if (s->radius == 0.0)
            s->radius = 1.0; /* a single point: any scale serves */
    }
    double largest_weight = 1.0;
    for (size_t i = 0; i < n; i++) {
        const double w = s->weights ? s->weights[i] * s->scale : 1.0;
        largest_weight = fmax(largest_weight, w);
        for (size_t c = 0; c < 3; c++)
            s->net[c * n + i] = w * (s->points[3 * i + c] - s->centre[c]);
        if (s->weights)
            s->net[3 * n + i] = w * s->radius;
    }
    /* Two chains of at most p + 1 convex combinations in each direction, and the difference. */
    s->rounding = 8.0 * (s->degree[0] + s->degree[1] + 4) * DBL_EPSILON * (largest + s->radius) *
                  largest_weight;
}

/* The knots of an axis with every span divided into equal parts. */
static nurbs_status divide(int degree, size_t size, const double *knots, int parts,
                           double **divided, size_t *divided_size)
{
    const size_t count = size + (size_t)degree + 1;
    *divided = malloc((size_t)parts * count * sizeof **divided);
    if (!*divided)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", (size_t)parts * count);
    size_t n = 0;
    for (size_t i = 0; i < count; i++) {
        (*divided)[n++] = knots[i];
        for (int k = 1; i + 1 < count && k < parts; k++) {
            const double knot = knots[i] + (knots[i + 1] - knots[i]) * ((double)k / parts);
            if ((*divided)[n - 1] < knot && knot < knots[i + 1])
                (*divided)[n++] = knot;
        }
    }
    *divided_size = n - (size_t)degree - 1;
    return NURBS_OK;
}

/* Inserts the dividing knots into the planes. */
static nurbs_status set_divided_net(struct subject *s, const struct axis *const axes[2])
{
    const size_t area[3] = {s->size[0] * s->size[1], s->divided_size[0] * s->size[1],
                            s->divided_size[0] * s->divided_size[1]};
    double *half = malloc(area[1] * sizeof *half);
    struct band band[2] = {{0}, {0}};
    nurbs_status status =
        half ? NURBS_OK : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", area[1]);
    for (int d = 0; d < s->directions && status == NURBS_OK; d++)
        status = band_insertion(axes[d], s->divided_size[d], s->divided[d], &band[d]);
    for (size_t plane = 0; status == NURBS_OK && plane < (size_t)s->planes; plane++) {
        const double *from = s->net + plane * area[0];
        double *to = s->divided_net + plane * area[2];
        band_apply(&band[0], s->size[1], from, s->directions == 2 ? half : to);
        for (size_t i = 0; s->directions == 2 && i < s->divided_size[0]; i++)
            band_apply(&band[1], 1, half + i * s->size[1], to + i * s->divided_size[1]);
    }
    band_free(&band[0]);
    band_free(&band[1]);
    free(half);
    return status;
}

void subject_free(struct subject *s)
{
    free(s->divided[0]);
    free(s->divided[1]);
    free(s->net);
    free(s->divided_net);
}

nurbs_status subject_create(int directions, int parts, const struct axis *const axes[2],
                            const double *points, const double *weights, struct subject *s)
{
    memset(s, 0, sizeof *s);
    s->directions = directions;
    s->planes = weights ? 4 : 3;
    s->points = points;
    s->weights = weights;
    s->size[1] = s->divided_size[1] = 1;
    nurbs_status status = NURBS_OK;
    for (int d = 0; d < directions && status == NURBS_OK; d++) {
        s->degree[d] = axes[d]->degree;
        s->size[d] = axes[d]->size;
        s->knots[d] = axes[d]->knots;
        if (parts > 1)
            status = divide(s->degree[d], s->size[d], s->knots[d], parts, &s->divided[d],
                            &s->divided_size[d]);
    }
    if (status == NURBS_OK) {
        s->net = malloc((size_t)s->planes * count_of(s->size) * sizeof(double));
        if (parts > 1)
            s->divided_net = malloc((size_t)s->planes * count_of(s->divided_size) * sizeof(double));
        if (!s->net || (parts > 1 && !s->divided_net))
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory to simplify %zu x %zu points",
                                s->size[0], s->size[1]);
    }
    if (status == NURBS_OK) {
        set_net(s);
        if (!isfinite(s->rounding))
            status = nurbs_fail(NURBS_ERROR_NUMERIC, "points times relative weights overflow");
        else if (parts > 1)
            status = set_divided_net(s, axes);
    }
    if (status != NURBS_OK)
        subject_free(s);
    return status;
}

struct thinning_request subject_request(const struct subject *s, int divided, double tolerance)
{
    struct thinning_request request = {.planes = s->planes,
                                       .directions = s->directions,
                                       .target = divided ? s->divided_net : s->net,
                                       .tolerance = tolerance};
    request.fine_size[1] = 1;
    for (int d = 0; d < s->directions; d++) {
        request.degree[d] = s->degree[d];
        request.fine_size[d] = divided ? s->divided_size[d] : s->size[d];
        request.fine[d] = divided ? s->divided[d] : s->knots[d];
        request.coarse_size[d] = s->size[d];
        request.coarse[d] = s->knots[d];
    }
    return request;
}

struct coarse_net thinning_net(const struct thinning *t)
{
    const size_t area = t->size[0] * t->size[1];
    return (struct coarse_net){{t->along[0].size, t->directions == 2 ? t->along[1].size : 1},
                               area,
                               {t->size[1], 1},
                               t->coarse};
}

int subject_read(const struct subject *s, const struct coarse_net *net, double *points,
                 double *weights)
{
    for (size_t i = 0; i < net->size[0]; i++)
        for (size_t j = 0; j < net->size[1]; j++) {
            const double *at = net->values + i * net->step[0] + j * net->step[1];
            const double w = s->weights ? at[3 * net->plane] / s->radius : 1.0;
            if (!(w > 0.0))
                return 0;
            for (size_t c = 0; c < 3; c++)
                *points++ = s->centre[c] + at[c * net->plane] / w;
            *weights++ = w / s->scale;
        }
    return 1;
}

double subject_write(const struct subject *s, const double *points, const double *weights,
                     const struct coarse_net *net)
{
    double square = 0.0;
    for (size_t i = 0; i < net->size[0]; i++)
        for (size_t j = 0; j < net->size[1]; j++, points += 3, weights++) {
            double *at = net->values + i * net->step[0] + j * net->step[1], sum = 0.0;
            const double w = s->weights ? *weights * s->scale : 1.0;
            for (size_t c = 0; c < 3; c++) {
                const double d = points[c] - s->centre[c];
                at[c * net->plane] = w * d;
                sum += d * d;
            }
            square = fmax(square, sum);
            if (s->weights)
                at[3 * net->plane] = w * s->radius;
        }
    return sqrt(square);
}

double subject_certify(const struct subject *s, struct thinning *t, const double *points,
                       const double *weights)
{
    const struct coarse_net net = thinning_net(t);
    const double radius = subject_write(s, points, weights, &net);
    thinning_difference(t);
    const size_t area = t->size[0] * t->size[1];
    double largest = 0.0;
    for (size_t i = 0; i < area; i++) {
        const double *e = t->error + i;
        double d = sqrt(e[0] * e[0] + e[area] * e[area] + e[2 * area] * e[2 * area]);
        if (s->weights)
            d += fabs(e[3 * area]) * (radius / s->radius);
        largest = fmax(largest, d);
    }
    return largest + s->rounding;
}

nurbs_status simple_create(const struct subject *s, const struct reduction along[2],
                           struct simple *r)
{
    memset(r, 0, sizeof *r);
    r->size[1] = 1;
    for (int d = 0; d < s->directions; d++) {
        const size_t bytes = (along[d].size + (size_t)along[d].degree + 1) * sizeof(double);
        r->size[d] = along[d].size;
        r->removed = r->removed || along[d].size < s->size[d];
        r->knots[d] = malloc(bytes);
        if (r->knots[d])
            memcpy(r->knots[d], along[d].knots, bytes);
    }
    const size_t n = count_of(r->size);
    r->points = malloc(3 * n * sizeof(double));
    r->weights = malloc(n * sizeof(double));
    if (r->points && r->weights && r->knots[0] && (s->directions == 1 || r->knots[1]))
        return NURBS_OK;
    simple_free(r);
    return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu control points", n);
}

void simple_free(struct simple *r)
{
    free(r->knots[0]);
    free(r->knots[1]);
    free(r->points);
    free(r->weights);
    memset(r, 0, sizeof *r);
}

nurbs_status simple_curve(const nurbs_curve *original, const struct simple *r, nurbs_curve **result,
                          double *bound)
{
    if (bound)
        *bound = r->removed ? r->bound : 0.0;
    if (!r->removed)
        return nurbs_curve_copy(original, result);
    return nurbs_curve_create(original->axis.degree, r->size[0], r->knots[0], r->points,
                              original->weights ? r->weights : NULL, result);
}

nurbs_status simple_surface(const nurbs_surface *original, const struct simple *r,
                            nurbs_surface **result, double *bound)
{
    if (bound)
        *bound = r->removed ? r->bound : 0.0;
    if (!r->removed)
        return nurbs_surface_copy(original, result);
    const int degree[2] = {original->axis[0].degree, original->axis[1].degree};
    return nurbs_surface_create(degree, r->size, r->knots[0], r->knots[1], r->points,
                                original->weights ? r->weights : NULL, result);
}
