/* The wave part k0 W, by the march of influence/spectral.c with the density folded in: instead of
 * moments of all unknowns the state holds the waves of the sources passed, and how each field
 * changes them. */
#include "core/constants.h"
#include "core/error.h"
#include "core/vector_math.h"
#include "influence/spectral.h"
#include "tangent/change.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_POINTS = 8, WAVES = 4, FACTORS = 6 };

struct march {
    const struct change *change;
    struct spectral *wave;
    size_t width;   /* 2 angles: re and im */
    double *moment; /* [sources][1 + fields][width]: of the sources, and what each field changes */
};

struct wave_work {
    struct nodes nodes;
    struct moving moving;
    struct kernels kernels;
    double *waves;  /* of a node, [WAVES][angles] */
    double *change; /* of a node, [2][fields] */
    double *factor; /* of a point, [FACTORS][width] */
};

/* e^{k0 s^2 z} cos(k0 t s y) (cos, -sin)(k0 s (x - x0)) of one node, and their derivatives with
 * respect to y. */
VECTOR_MULTIVERSION
static void node_waves(const struct spectral *wave, size_t angles, double x, double y, double z,
                       double *restrict out)
{
    const double *t = wave->spectrum->t, *root = wave->spectrum->root;
    double k0 = wave->k0, dx = k0 * (x - wave->x0), ky = k0 * y, kz = k0 * z;
    size_t n = wave->spectrum->n;
    double *re = out, *im = out + n, *re_y = out + 2 * n, *im_y = out + 3 * n;
#pragma omp simd
    for (size_t j = 0; j < angles; j++) {
        double sine, cosine, sine_y, cosine_y, across = t[j] * root[j];
        double amplitude = vector_exp(fmax(kz * (1.0 + t[j] * t[j]), -600.0));
        vector_sincos(dx * root[j], &sine, &cosine);
        vector_sincos(ky * across, &sine_y, &cosine_y);
        double even = amplitude * cosine_y, odd = -k0 * across * amplitude * sine_y;
        re[j] = even * cosine;
        im[j] = -even * sine;
        re_y[j] = odd * cosine;
        im_y[j] = -odd * sine;
    }
}

/* Adds a times from to to. */
VECTOR_MULTIVERSION
static void add(size_t n, double a, const double *restrict from, double *restrict to)
{
    for (size_t j = 0; j < n; j++)
        to[j] += a * from[j];
}

VECTOR_MULTIVERSION
static void add_both(size_t n, double a, const double *restrict p, double b,
                     const double *restrict q, double *restrict to)
{
    for (size_t j = 0; j < n; j++)
        to[j] += a * p[j] + b * q[j];
}

VECTOR_MULTIVERSION
static double dot(size_t n, const double *restrict p, const double *restrict q)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t j = 0; j < n; j++)
        sum += p[j] * q[j];
    return sum;
}

/* Nodes of a source ahead of x as moving ones. */
static bool source_nodes(const struct march *march, const struct source *source, double x,
                         const struct wave_rule *rule, struct wave_work *work)
{
    const struct change *change = march->change;
    nodes_clear(&work->nodes);
    spectral_nodes(march->wave, source, x, rule, &work->nodes);
    if (source->segment)
        return moving_fill_line(change->tangent, change->bernstein, march->wave->line,
                                source->segment, 1.0 / march->wave->k0, &work->nodes,
                                &work->moving);
    return moving_fill(change->tangent, change->bernstein, &work->nodes, &work->moving);
}

static bool source_moments(const struct march *march, size_t index, struct wave_work *work)
{
    const struct spectral *wave = march->wave;
    const struct field *field = march->change->tangent->field;
    const struct nodes *nodes = &work->nodes;
    size_t n = wave->spectrum->n, width = march->width;
    double *moment = march->moment + index * (1 + field->n) * width;
    memset(moment, 0, (1 + field->n) * width * sizeof *moment);
    if (!source_nodes(march, &wave->source[index], -INFINITY, &wave->rule, work))
        return false;
    for (size_t b = 0; b < nodes->blocks; b++)
        for (size_t i = nodes->block[b].begin; i < nodes->block[b].end; i++) {
            size_t angles = spectral_angles(wave, wave->rule.clearance - nodes->z[i]);
            const double *re = work->waves, *im = re + n, *re_y = im + n, *im_y = re_y + n;
            node_waves(wave, angles, nodes->x[i], nodes->y[i], nodes->z[i], work->waves);
            moving_changes(field, nodes, &work->moving, nodes->block[b].element, i, work->change);
            add(angles, work->moving.strength[i], re, moment);
            add(angles, work->moving.strength[i], im, moment + n);
            for (size_t f = 0; f < field->n; f++) {
                double q = work->change[f], moved = work->change[field->n + f];
                double *to = moment + (1 + f) * width;
                add_both(angles, q, re, moved, re_y, to);
                add_both(angles, q, im, moved, im_y, to + n);
            }
        }
    return true;
}

/* Multipliers of re and im for the three components of the velocity, then their derivatives with
 * respect to y of the point. Returns the number of angles that reach it. */
static size_t point_factors(const struct march *march, const double *weight, size_t point,
                            double *factor)
{
    const struct spectral *wave = march->wave;
    const struct spectrum *spectrum = wave->spectrum;
    const double *p = wave->influence->density->point + 3 * point;
    size_t n = spectrum->n, width = march->width,
           angles = spectral_angles(wave, wave->depth - p[2]);
    double k0 = wave->k0, scale = 16.0 * k0 * k0 / (4.0 * PI) * weight[point];
    for (size_t j = 0; j < angles; j++) {
        double t = spectrum->t[j], s = spectrum->root[j], sine, cosine, sine_y, cosine_y;
        vector_sincos(k0 * (p[0] - wave->x0) * s, &sine, &cosine);
        vector_sincos(k0 * p[1] * t * s, &sine_y, &cosine_y);
        double base = scale * wave->filter[j] * spectrum->weight[j] *
                      vector_exp(fmax(k0 * p[2] * s * s, -600.0));
        double u = base * s, v = -base * t * s, w = base * s * s, k = k0 * t * s;
        const double even[2] = {cosine_y, -k * sine_y}, odd[2] = {sine_y, k * cosine_y};
        for (size_t d = 0; d < 2; d++) {
            double *to = factor + 3 * d * width + j;
            to[0] = u * even[d] * cosine;
            to[n] = -u * even[d] * sine;
            to[width] = v * odd[d] * sine;
            to[width + n] = v * odd[d] * cosine;
            to[2 * width] = w * even[d] * sine;
            to[2 * width + n] = w * even[d] * cosine;
        }
    }
    return angles;
}

/* factor . wave over the leading angles, re and im. */
static double product(const struct march *march, size_t angles, const double *factor,
                      const double *wave)
{
    size_t n = march->wave->spectrum->n;
    return dot(angles, factor, wave) + dot(angles, factor + n, wave + n);
}

/* The parts of sources that straddle x = x_P. */
static bool straddling(const struct march *march, size_t point, size_t point_angles,
                       struct wave_work *work, double *out, double turn[3])
{
    const struct spectral *wave = march->wave;
    const struct nodes *nodes = &work->nodes;
    const double *p = wave->influence->density->point + 3 * point;
    size_t n = wave->spectrum->n;
    struct wave_rule rule = wave->rule;
    rule.clearance = -p[2];
    for (size_t s = 0; s < wave->sources; s++) {
        const struct source *source = &wave->source[s];
        if (!(source->box[0] < p[0] - wave->slack && source->box[1] > p[0] + wave->slack))
            continue;
        if (!source_nodes(march, source, p[0], &rule, work) ||
            !kernels_clear(&work->kernels, nodes->n))
            return false;
        for (size_t i = 0; i < nodes->n; i++) {
            size_t angles = spectral_angles(wave, -p[2] - nodes->z[i]);
            angles = angles < point_angles ? angles : point_angles;
            node_waves(wave, angles, nodes->x[i], nodes->y[i], nodes->z[i], work->waves);
            for (size_t c = 0; c < 3; c++) {
                const double *still = work->factor + c * march->width;
                const double *turned = work->factor + (3 + c) * march->width;
                size_t at = c * nodes->n + i;
                work->kernels.k[at] = product(march, angles, still, work->waves);
                /* the source moves, not the place that sees it */
                work->kernels.slope[at] = -product(march, angles, still, work->waves + 2 * n);
                work->kernels.turned[at] = product(march, angles, turned, work->waves);
            }
        }
        kernels_sum(&work->kernels, march->change->tangent->field, nodes, &work->moving, out, turn);
    }
    return true;
}

/* Where a thread is on its march from bow to stern. */
struct state {
    double *moment; /* [1 + fields][width]: sums over the sources passed */
    size_t next;    /* source */
};

static bool point_change(const struct march *march, const double *weight, size_t point,
                         struct wave_work *work, struct state *state, double *out)
{
    const struct spectral *wave = march->wave;
    size_t fields = march->change->tangent->field->n, size = (1 + fields) * march->width;
    double x = wave->influence->density->point[3 * point], turn[3];
    for (; state->next < wave->sources && wave->source[state->next].box[0] >= x - wave->slack;
         state->next++)
        add(size, 1.0, march->moment + state->next * size, state->moment);
    size_t angles = point_factors(march, weight, point, work->factor);
    for (size_t c = 0; c < 3; c++) {
        const double *still = work->factor + c * march->width;
        turn[c] = product(march, angles, work->factor + (3 + c) * march->width, state->moment);
        for (size_t f = 0; f < fields; f++)
            out[c * fields + f] +=
                product(march, angles, still, state->moment + (1 + f) * march->width);
    }
    if (!straddling(march, point, angles, work, out, turn))
        return false;
    for (size_t c = 0; c < 3; c++)
        for (size_t f = 0; f < fields; f++)
            out[c * fields + f] += turn[c] * march->change->tangent->point[point * fields + f];
    return true;
}

static bool run(const struct march *march, const double *weight, double *velocity)
{
    const struct spectral *wave = march->wave;
    size_t fields = march->change->tangent->field->n, blocks = wave->points / BLOCK_POINTS + 1;
    size_t n = wave->spectrum->n;
    bool failed = false;
#pragma omp parallel num_threads(wave->influence->threads) reduction(| : failed)
    {
        struct wave_work work = {.waves = NULL};
        nodes_init(&work.nodes, wave->influence->mesh);
        work.nodes.with_jets = work.nodes.with_normals = true;
        work.waves = malloc(WAVES * n * sizeof *work.waves);
        work.change = malloc(2 * fields * sizeof *work.change);
        work.factor = malloc(FACTORS * march->width * sizeof *work.factor);
        struct state state = {calloc((1 + fields) * march->width, sizeof(double)), 0};
        failed |= !work.waves || !work.change || !work.factor || !state.moment;
#pragma omp for schedule(dynamic, 1)
        for (size_t s = 0; s < wave->sources; s++)
            if (!failed)
                failed |= !source_moments(march, s, &work);
/* each thread's blocks come in increasing order, as its state needs them */
#pragma omp for schedule(monotonic : dynamic, 1)
        for (size_t b = 0; b < blocks; b++)
            for (size_t i = wave->points * b / blocks; i < wave->points * (b + 1) / blocks; i++)
                if (!failed)
                    failed |= !point_change(march, weight, wave->point[i], &work, &state,
                                            velocity + 3 * fields * wave->point[i]);
        nodes_free(&work.nodes);
        moving_free(&work.moving);
        kernels_free(&work.kernels);
        free(work.waves);
        free(work.change);
        free(work.factor);
        free(state.moment);
    }
    return !failed;
}

igabem_status change_wave(const struct change *change, const struct line *line,
                          const double *weight, double *velocity)
{
    const igabem_solution *solution = change->tangent->solution;
    size_t fields = change->tangent->field->n;
    struct spectral wave = {.influence = change->influence,
                            .line = line && line->n ? line : NULL,
                            .sets = 1,
                            .k0 = solution->k0,
                            .filters = 1,
                            .cutoff = &solution->options.cutoff_angle,
                            .weight = weight};
    igabem_status status = spectral_create(&wave);
    if (status == IGABEM_OK) {
        struct march march = {change, &wave, wave.width, NULL};
        march.moment = malloc(wave.sources * (1 + fields) * wave.width * sizeof *march.moment);
        if (!march.moment || !run(&march, weight, velocity))
            status = tangent_no_memory(fields);
        free(march.moment);
    }
    spectral_free(&wave);
    return status;
}
