#include "error.h"
#include "grid_measures.h"
#include "model.h"

#include <galv/limits.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Differences are taken over this share of the half box: hulls there are still sound. */
static const double step_share = 0.25;
/* Parent points nearer to the centre plane than this, in metres, belong to keel, stem and stern. */
static const double centre = 1e-6;

enum { BLOCK = 64 }; /* points moved at once, on the stack */

/* Some coordinates of the parent and their rows of the modes, close together. */
typedef struct part {
    size_t n;
    double *start; /* n: parent and mean */
    double *modes; /* modes x n */
} part;

struct galv_limits {
    const galv_model *model;
    size_t sections, girth;
    bool moves_z, bends; /* the volume is not linear: points move along x or z */
    part breadths;       /* y of every point */
    part waterline;      /* x, y above, x, y below for each crossing */
    double *share;       /* of each crossing */
    size_t *section;
    bool *counts; /* of the piece that ends there: not in the parent's stem */
    size_t crossings;
    double entrance;    /* of the parent */
    double volume;      /* of the parent's grid, one side */
    double *gradient;   /* of the volume ratio, or NULL */
    double *correction; /* the same less that of the grid's own volume, where that bends; or NULL */
};

static galv_status part_create(const galv_model *model, size_t n, part *p)
{
    *p = (part){.n = n,
                .start = malloc((n + 1) * sizeof(double)),
                .modes = malloc((n * model->modes + 1) * sizeof(double))};
    if (p->start && p->modes)
        return GALV_OK;
    return galv_fail(GALV_ERROR_MEMORY, "%zu coordinates of %zu modes", n, model->modes);
}

static void part_set(part *p, const galv_model *model, size_t at, size_t coordinate)
{
    p->start[at] = model->parent[coordinate] + model->mean[coordinate];
    for (size_t m = 0; m < model->modes; m++)
        p->modes[m * p->n + at] = model->vectors[m * model->coordinates + coordinate];
}

/* Coordinates first..first+n-1 of the part, moved. */
static void part_move(const part *p, size_t modes, const double *u, size_t first, size_t n,
                      double *out)
{
    memcpy(out, p->start + first, n * sizeof *out);
    galv_add_modes(modes, p->modes + first, p->n, u, n, out);
}

static void part_free(part *p)
{
    free(p->start);
    free(p->modes);
}

static galv_status set_breadths(galv_limits *l)
{
    const galv_model *model = l->model;
    galv_status status = part_create(model, model->points, &l->breadths);
    for (size_t p = 0; p < model->points && !status; p++)
        part_set(&l->breadths, model, p, 3 * p + 1);
    return status;
}

static galv_status set_waterline(galv_limits *l, double most)
{
    const galv_model *model = l->model;
    const double *parent = model->parent;
    galv_crossings c;
    galv_status status = galv_crossings_find(l->sections, l->girth, parent, &c);
    if (status)
        return status;
    l->crossings = c.n;
    l->share = malloc((c.n + 1) * sizeof *l->share);
    l->section = malloc((c.n + 1) * sizeof *l->section);
    l->counts = calloc(c.n + 1, sizeof *l->counts);
    status = l->share && l->section && l->counts
                 ? part_create(model, 4 * c.n, &l->waterline)
                 : galv_fail(GALV_ERROR_MEMORY, "waterline of %zu points", c.n);
    double at[2][2];
    for (size_t i = 0; i < c.n && !status; i++) {
        size_t above = 3 * c.above[i], below = 3 * c.below[i];
        l->share[i] = c.share[i];
        l->section[i] = c.above[i] / l->girth;
        for (size_t k = 0; k < 2; k++) {
            part_set(&l->waterline, model, 4 * i + k, above + k);
            part_set(&l->waterline, model, 4 * i + 2 + k, below + k);
        }
        galv_crossing_at(c.share[i], parent + above, parent + below, at[i % 2]);
        double slope = i ? galv_piece_slope(at[(i + 1) % 2], at[i % 2]) : 0;
        l->counts[i] = i && slope <= GALV_STEM_SLACK * most;
        if (l->counts[i])
            l->entrance = fmax(l->entrance, slope);
    }
    galv_crossings_free(&c);
    return status;
}

static bool moves_along(const galv_model *model, size_t axis)
{
    for (size_t k = axis; k < 3 * model->points; k += 3) {
        if (model->mean[k] != 0)
            return true;
        for (size_t m = 0; m < model->modes; m++)
            if (model->vectors[m * model->coordinates + k] != 0)
                return true;
    }
    return false;
}

galv_status galv_limits_create(const galv_model *model, size_t sections, size_t girth, double most,
                               galv_limits **limits)
{
    if (!model || !limits)
        return galv_fail(GALV_ERROR_ARGUMENT, "model and result must be given");
    *limits = NULL;
    if (!(most >= 0))
        return galv_fail(GALV_ERROR_ARGUMENT, "greatest slope %g, expected at least 0", most);
    if (sections < 2 || girth < 2 || !model->parent || model->points / girth != sections ||
        model->points % girth)
        return galv_fail(GALV_ERROR_ARGUMENT, "a grid of %zu x %zu points, but the model has %zu",
                         sections, girth, model->parent ? model->points : 0);
    galv_limits *l = calloc(1, sizeof *l);
    if (!l)
        return galv_fail(GALV_ERROR_MEMORY, "limits of %zu points", model->points);
    l->model = model;
    l->sections = sections;
    l->girth = girth;
    l->moves_z = moves_along(model, 2);
    l->bends = l->moves_z || moves_along(model, 0);
    galv_status status = galv_grid_volume(sections, girth, model->parent, &l->volume);
    if (!status && l->volume == 0)
        status = galv_fail(GALV_ERROR_GEOMETRY, "the grid has no volume below z = 0");
    if (!status)
        status = set_breadths(l);
    if (!status)
        status = set_waterline(l, most);
    if (status) {
        galv_limits_free(l);
        return status;
    }
    *limits = l;
    return GALV_OK;
}

void galv_limits_free(galv_limits *limits)
{
    if (!limits)
        return;
    part_free(&limits->breadths);
    part_free(&limits->waterline);
    free(limits->share);
    free(limits->section);
    free(limits->counts);
    free(limits->gradient);
    free(limits->correction);
    free(limits);
}

static galv_status check(const galv_limits *limits, const double *u)
{
    if (!limits || !u)
        return galv_fail(GALV_ERROR_ARGUMENT, "limits and latent point must be given");
    return galv_latent_check(limits->model, u);
}

galv_status galv_limits_breadth(const galv_limits *limits, const double *u, double *least,
                                double *share)
{
    galv_status status = check(limits, u);
    if (status)
        return status;
    const double *parent = limits->model->parent;
    size_t points = limits->model->points, modes = limits->model->modes;
    double least_y = INFINITY, least_share = INFINITY, y[BLOCK];
    for (size_t first = 0; first < points; first += BLOCK) {
        size_t n = points - first < BLOCK ? points - first : BLOCK;
        part_move(&limits->breadths, modes, u, first, n, y);
        for (size_t k = 0; k < n; k++) {
            const double *point = parent + 3 * (first + k);
            least_y = fmin(least_y, y[k]);
            if (point[2] <= 0 && point[1] > centre)
                least_share = fmin(least_share, y[k] / point[1]);
        }
    }
    if (least)
        *least = least_y;
    if (share)
        *share = least_share;
    return GALV_OK;
}

/* n points of the moved grid from `first` on, as galv_displace() has them. */
static void move_points(const galv_model *model, const double *u, size_t first, size_t n,
                        double *xyz)
{
    galv_model_displacement(model, u, 3 * first, 3 * n, xyz);
    for (size_t k = 0; k < 3 * n; k++)
        xyz[k] += model->parent[3 * first + k];
}

/* x and y where crossing i of the parent's waterline is now. Points that keep their z keep their
 * share; else the section may cross the water between others: NAN where it does not. */
static void find_crossing(const galv_limits *limits, const double *u, size_t i, double xy[2])
{
    double corner[4], point[2][3];
    if (!limits->moves_z) {
        part_move(&limits->waterline, limits->model->modes, u, 4 * i, 4, corner);
        galv_crossing_at(limits->share[i], corner, corner + 2, xy);
        return;
    }
    size_t first = limits->section[i] * limits->girth;
    xy[0] = xy[1] = NAN;
    move_points(limits->model, u, first, 1, point[0]);
    for (size_t j = 1; j < limits->girth; j++) {
        const double *p = point[(j - 1) % 2], *q = point[j % 2];
        move_points(limits->model, u, first + j, 1, point[j % 2]);
        if ((p[2] >= 0) == (q[2] >= 0))
            continue;
        galv_crossing_at(p[2] / (p[2] - q[2]), p, q, xy);
        return;
    }
}

galv_status galv_limits_entrance(const galv_limits *limits, const double *u, double *ratio)
{
    galv_status status = check(limits, u);
    if (status || !ratio)
        return status ? status : galv_fail(GALV_ERROR_ARGUMENT, "the result must be given");
    double largest = 0, at[2][2];
    for (size_t i = 0; i < limits->crossings; i++) {
        find_crossing(limits, u, i, at[i % 2]);
        if (limits->counts[i]) /* a piece that ends in the air has the slope 0 */
            largest = fmax(largest, galv_piece_slope(at[(i + 1) % 2], at[i % 2]));
    }
    *ratio = limits->entrance > 0 ? largest / limits->entrance : 1;
    return GALV_OK;
}

/* Of a cell between two sections, twice its area: the cross product of its diagonals. */
static void cell_normal(const double *p, const double *q, double n[3])
{
    double a[3], b[3];
    for (int k = 0; k < 3; k++) {
        a[k] = q[3 + k] - p[k];
        b[k] = q[k] - p[3 + k];
    }
    for (int k = 0; k < 3; k++)
        n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static double cosine(const double a[3], const double b[3])
{
    double product = 0, square[2] = {0, 0};
    for (int k = 0; k < 3; k++) {
        product += a[k] * b[k];
        square[0] += a[k] * a[k];
        square[1] += b[k] * b[k];
    }
    return square[1] > 0 ? product / sqrt(square[0] * square[1]) : 0;
}

galv_status galv_limits_turn(const galv_limits *limits, const double *u, double *least)
{
    galv_status status = check(limits, u);
    if (status || !least)
        return status ? status : galv_fail(GALV_ERROR_ARGUMENT, "the result must be given");
    size_t girth = limits->girth;
    const double *parent = limits->model->parent;
    double strip[2][3 * BLOCK], before[3], after[3];
    *least = 1;
    for (size_t i = 0; i + 1 < limits->sections && limits->bends; i++)
        for (size_t first = 0; first + 1 < girth; first += BLOCK - 1) {
            size_t n = girth - first < BLOCK ? girth - first : BLOCK;
            for (size_t side = 0; side < 2; side++)
                move_points(limits->model, u, (i + side) * girth + first, n, strip[side]);
            for (size_t j = 0; j + 1 < n; j++) {
                const double *p = parent + 3 * (i * girth + first + j);
                cell_normal(p, p + 3 * girth, before);
                cell_normal(strip[0] + 3 * j, strip[1] + 3 * j, after);
                if (before[0] != 0 || before[1] != 0 || before[2] != 0)
                    *least = fmin(*least, cosine(before, after));
            }
        }
    return GALV_OK;
}

static double moved_volume(const galv_limits *limits, const double *u)
{
    size_t girth = limits->girth;
    double strip[2][3 * BLOCK], sum = 0;
    for (size_t i = 0; i + 1 < limits->sections; i++)
        for (size_t first = 0; first + 1 < girth; first += BLOCK - 1) {
            size_t n = girth - first < BLOCK ? girth - first : BLOCK;
            for (size_t side = 0; side < 2; side++)
                move_points(limits->model, u, (i + side) * girth + first, n, strip[side]);
            for (size_t j = 0; j + 1 < n; j++)
                galv_add_cell(strip[0] + 3 * j, strip[1] + 3 * j, &sum);
        }
    return 2 * sum;
}

galv_status galv_limits_volume(const galv_limits *limits, const double *u, double *ratio)
{
    galv_status status = check(limits, u);
    if (status || !ratio)
        return status ? status : galv_fail(GALV_ERROR_ARGUMENT, "the result must be given");
    bool linear = limits->gradient && !limits->correction;
    const double *slope = linear ? limits->gradient : limits->correction;
    *ratio = linear ? 1 : moved_volume(limits, u) / limits->volume;
    for (size_t m = 0; slope && m < limits->model->modes; m++)
        *ratio += slope[m] * u[m];
    return GALV_OK;
}

/* Volumes of a latent point's hull and of its grid. */
typedef struct volumes {
    double built, grid;
} volumes;

typedef struct measure {
    const galv_limits *limits;
    galv_built_volume volume;
    void *user_data;
    double *u, *moved;
} measure;

static volumes measure_point(const measure *m)
{
    galv_displace(m->limits->model, m->u, m->moved);
    return (volumes){m->volume(m->user_data, m->moved), moved_volume(m->limits, m->u)};
}

static double step_of(const galv_model *model, size_t mode)
{
    return step_share * (model->upper[mode] - model->lower[mode]) / 2;
}

static double difference(const measure *m, const volumes *parent, size_t mode)
{
    double step = step_of(m->limits->model, mode);
    volumes at[2];
    for (int side = 0; side < 2; side++) {
        m->u[mode] = side ? step : -step;
        at[side] = measure_point(m);
    }
    m->u[mode] = 0;
    double slope = (at[1].built - at[0].built) / (2 * step * parent->built);
    return isfinite(slope) ? slope : (at[1].grid - at[0].grid) / (2 * step * parent->grid);
}

galv_status galv_limits_linearise(galv_limits *limits, galv_built_volume volume, void *user_data)
{
    if (!limits || !volume)
        return galv_fail(GALV_ERROR_ARGUMENT, "limits and volume must be given");
    const galv_model *model = limits->model;
    size_t m = model->modes;
    double *gradient = malloc(m * sizeof *gradient);
    measure work = {.limits = limits,
                    .volume = volume,
                    .user_data = user_data,
                    .u = calloc(m, sizeof(double)),
                    .moved = malloc(3 * model->points * sizeof(double))};
    galv_status status = GALV_OK;
    if (gradient && work.u && work.moved) {
        volumes parent = measure_point(&work);
        for (size_t k = 0; k < m; k++)
            gradient[k] = difference(&work, &parent, k);
        status = galv_limits_set_gradient(limits, gradient);
    } else {
        status = galv_fail(GALV_ERROR_MEMORY, "gradient of %zu modes", m);
    }
    free(gradient);
    free(work.u);
    free(work.moved);
    return status;
}

const double *galv_limits_gradient(const galv_limits *limits)
{
    return limits ? limits->gradient : NULL;
}

/* By differences over the same steps as those of the built hulls; NULL: no memory. */
static double *find_correction(const galv_limits *limits, const double *gradient)
{
    const galv_model *model = limits->model;
    size_t modes = model->modes;
    double *u = calloc(modes, sizeof *u), *correction = malloc(modes * sizeof *correction);
    for (size_t m = 0; u && correction && m < modes; m++) {
        double step = step_of(model, m), side[2];
        for (int i = 0; i < 2; i++) {
            u[m] = i ? step : -step;
            side[i] = moved_volume(limits, u) / limits->volume;
        }
        u[m] = 0;
        correction[m] = gradient[m] - (side[1] - side[0]) / (2 * step);
    }
    if (!u) {
        free(correction);
        correction = NULL;
    }
    free(u);
    return correction;
}

galv_status galv_limits_set_gradient(galv_limits *limits, const double *gradient)
{
    if (!limits || !gradient)
        return galv_fail(GALV_ERROR_ARGUMENT, "limits and gradient must be given");
    size_t m = limits->model->modes;
    for (size_t k = 0; k < m; k++)
        if (!isfinite(gradient[k]))
            return galv_fail(GALV_ERROR_ARGUMENT, "gradient of the volume: component %zu is %g", k,
                             gradient[k]);
    double *copy = malloc(m * sizeof *copy), *correction = NULL;
    if (copy)
        memcpy(copy, gradient, m * sizeof *copy);
    if (!copy || (limits->bends && !(correction = find_correction(limits, gradient)))) {
        free(copy);
        return galv_fail(GALV_ERROR_MEMORY, "gradient of %zu modes", m);
    }
    free(limits->gradient);
    free(limits->correction);
    limits->gradient = copy;
    limits->correction = correction;
    return GALV_OK;
}
