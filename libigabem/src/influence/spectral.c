/* The wave part, separable in the wave angle: for a source ahead of the point
 *     sin(X s) cos(Y t s) e^{Z s^2}  =  sum of products of a factor of the point and one of the
 * source, s = sqrt(1+t^2). Moments of the basis over pieces wholly ahead are accumulated while
 * marching from bow to stern; a row is then a product of the factors of its point with that state.
 * Pieces that straddle x = x_P are cut there and what lies ahead is summed directly. */
#include "influence/spectral.h"

#include "core/constants.h"
#include "core/error.h"
#include "core/vector_math.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_POINTS = 8 };

/* e^{k0 s^2 z} cos(a - x0 phase) ... of one node for all angles: re, im (= -sin) times the cosine
 * and sine in eta. */
VECTOR_INLINE void node_waves(const struct spectral *wave, size_t angles, double x, double y,
                              double z, double *out)
{
    const double *t = wave->spectrum->t, *root = wave->spectrum->root;
    double k0 = wave->k0, dx = k0 * (x - wave->x0), ky = k0 * y, kz = k0 * z;
    size_t n = wave->spectrum->n;
    double *re = out, *im = out + n, *re2 = out + 2 * n, *im2 = out + 3 * n;
    int sets = (int)wave->sets;
    for (size_t j = 0; j < angles; j++) {
        double sine, cosine, sine_y, cosine_y;
        double amplitude = vector_exp(fmax(kz * (1.0 + t[j] * t[j]), -600.0));
        vector_sincos(dx * root[j], &sine, &cosine);
        vector_sincos(ky * t[j] * root[j], &sine_y, &cosine_y);
        re[j] = amplitude * cosine * cosine_y;
        im[j] = -amplitude * sine * cosine_y;
        if (sets == 2) {
            re2[j] = amplitude * cosine * sine_y;
            im2[j] = -amplitude * sine * sine_y;
        }
    }
}

size_t spectral_angles(const struct spectral *wave, double depth)
{
    struct wave_rule rule = wave->rule;
    rule.clearance = 0.0;
    rule.tolerance *= 0.01;
    double reach = wave_reach(&rule, depth);
    size_t n = wave->spectrum->n;
    while (n > 0 && wave->spectrum->t[n - 1] > reach)
        n--;
    return n;
}

/* Returns the number of waves evaluated. */
VECTOR_MULTIVERSION
static size_t accumulate(const struct spectral *wave, const struct nodes *nodes, size_t functions,
                         const double *f, double *buffer, double *moments)
{
    size_t n = wave->spectrum->n, waves = 0;
    for (size_t i = 0; i < nodes->n; i++) {
        size_t angles = spectral_angles(wave, wave->rule.clearance - nodes->z[i]);
        waves += angles;
        node_waves(wave, angles, nodes->x[i], nodes->y[i], nodes->z[i], buffer);
        for (size_t a = 0; a < functions; a++) {
            double strength = f[i * functions + a];
            for (size_t set = 0; set < 2 * wave->sets && strength != 0.0; set++) {
                double *to = moments + a * wave->width + set * n;
                const double *from = buffer + set * n;
                for (size_t j = 0; j < angles; j++)
                    to[j] += strength * from[j];
            }
        }
    }
    return waves;
}

struct wave_work {
    struct nodes nodes;
    double *buffer; /* one node's waves, or one point's factors */
    double *f;      /* folded basis, or kernels at nodes */
    size_t f_capacity;
    struct igabem_cost cost;
    double *nearby; /* [filters - 1][n] what further filters change, cleared after use */
};

static bool reserve(struct wave_work *work, size_t n)
{
    if (n > work->f_capacity) {
        free(work->f);
        work->f_capacity = 2 * n;
        work->f = malloc(work->f_capacity * sizeof *work->f);
    }
    return n == 0 || work->f != NULL;
}

void spectral_nodes(const struct spectral *wave, const struct source *source, double x,
                    const struct wave_rule *rule, struct nodes *nodes)
{
    if (source->segment) {
        double stops[ELEMENT_SIDE + 2];
        size_t n = line_cut(source->segment, x, stops), begin = nodes->n;
        for (size_t k = 0; k + 1 < n; k++) {
            struct line_point middle;
            line_evaluate(wave->line, source->segment, 0.5 * (stops[k] + stops[k + 1]), &middle);
            if (middle.x > x)
                wave_line_nodes(rule, wave->line, source->segment, stops + k, nodes);
        }
        for (size_t i = begin; i < nodes->n; i++)
            nodes->g[i] /= wave->k0;
        return;
    }
    for (size_t e = source->panel->first; e < source->panel->first + source->panel->count; e++) {
        const struct element *element = &wave->influence->mesh->element[e];
        struct domain pieces[DOMAIN_PIECES];
        size_t n = 0;
        if (element->box[0][0] >= x) {
            domain_whole(element, pieces);
            pieces[n++].ahead = true;
        } else if (element->box[1][0] > x) {
            n = domain_cut(element, x, pieces);
        }
        for (size_t k = 0; k < n; k++)
            if (pieces[k].ahead)
                wave_nodes(rule, &pieces[k], nodes);
    }
}

static igabem_status source_moments(const struct spectral *wave, struct source *source,
                                    struct wave_work *work)
{
    size_t m = spectral_functions(source->element);
    nodes_clear(&work->nodes);
    spectral_nodes(wave, source, -INFINITY, &wave->rule, &work->nodes);
    if (work->nodes.failed || !reserve(work, m * work->nodes.n))
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for wave moments");
    nodes_fold(&work->nodes, work->f);
    memset(source->moments, 0, m * wave->width * sizeof *source->moments);
    work->cost.wave += accumulate(wave, &work->nodes, m, work->f, work->buffer, source->moments);
    return IGABEM_OK;
}

/* Rows of factors of a point: three components with the first filter, and what each further filter
 * changes along the normal. */
static size_t factor_rows(const struct spectral *wave)
{
    return wave->filters + 2;
}

/* Factors of a point: for every row (see above), a last one along the normal without filter, and
 * every set the multipliers of re and im, so that the
 * velocity is the sum over angles of factor times moment. The order is [row][width]. */
static size_t point_factors(const struct spectral *wave, size_t point, double *factor)
{
    const struct spectrum *spectrum = wave->spectrum;
    const double *p = wave->influence->density->point + 3 * point;
    const double *normal = wave->influence->density->normal + 3 * point;
    size_t n = spectrum->n, width = wave->width, angles = spectral_angles(wave, wave->depth - p[2]);
    double k0 = wave->k0, scale = k0 * k0 / (4.0 * PI) * (wave->sets == 1 ? 16.0 : 8.0);
    scale *= wave->weight ? wave->weight[point] : 1.0;
    for (size_t j = 0; j < angles; j++) {
        double t = spectrum->t[j], s = spectrum->root[j], sine, cosine, sine_y, cosine_y;
        vector_sincos(k0 * (p[0] - wave->x0) * s, &sine, &cosine);
        vector_sincos(k0 * p[1] * t * s, &sine_y, &cosine_y);
        double base = scale * spectrum->weight[j] * vector_exp(fmax(k0 * p[2] * s * s, -600.0));
        double u = base * s, v = -base * t * s, w = base * s * s;
        double *row = factor + j;
        for (size_t set = 0; set < wave->sets; set++, row += 2 * n) {
            double even = set == 0 ? cosine_y : sine_y, odd = set == 0 ? sine_y : -cosine_y;
            double re[3] = {u * even * cosine, v * odd * sine, w * even * sine};
            double im[3] = {-u * even * sine, v * odd * cosine, w * even * cosine};
            for (size_t c = 0; c < 3; c++) {
                row[c * width] = wave->filter[j] * re[c];
                row[c * width + n] = wave->filter[j] * im[c];
            }
            double along_re = normal[0] * re[0] + normal[1] * re[1] + normal[2] * re[2];
            double along_im = normal[0] * im[0] + normal[1] * im[1] + normal[2] * im[2];
            for (size_t f = 1; f < wave->filters; f++) {
                row[(2 + f) * width] = wave->filter[f * n + j] * along_re;
                row[(2 + f) * width + n] = wave->filter[f * n + j] * along_im;
            }
            row[(2 + wave->filters) * width] = along_re;
            row[(2 + wave->filters) * width + n] = along_im;
        }
    }
    return angles;
}

/* Adds factor . state_k to the rows of unknown k. */
VECTOR_MULTIVERSION
static void product(const struct spectral *wave, const double *factor, size_t angles,
                    const double *state, size_t first, size_t last, double *rows)
{
    size_t n = wave->spectrum->n, width = wave->width, stride = wave->influence->density->n;
    for (size_t k = first; k < last; k++) {
        double u = 0.0, v = 0.0, w = 0.0;
        for (size_t set = 0; set < 2 * wave->sets; set++) {
            const double *from = state + k * width + set * n, *a = factor + set * n;
            double su[8] = {0}, sv[8] = {0}, sw[8] = {0};
            size_t j = 0;
            for (; j + 8 <= angles; j += 8)
                for (size_t l = 0; l < 8; l++) {
                    su[l] += a[j + l] * from[j + l];
                    sv[l] += a[width + j + l] * from[j + l];
                    sw[l] += a[2 * width + j + l] * from[j + l];
                }
            for (; j < angles; j++) {
                su[0] += a[j] * from[j];
                sv[0] += a[width + j] * from[j];
                sw[0] += a[2 * width + j] * from[j];
            }
            for (size_t l = 0; l < 8; l++) {
                u += su[l];
                v += sv[l];
                w += sw[l];
            }
        }
        rows[k] += u;
        rows[stride + k] += v;
        rows[2 * stride + k] += w;
    }
}

/* The products of a further filter with the unknowns that are not wholly ahead. */
VECTOR_MULTIVERSION
static void product_nearby(const struct spectral *wave, const double *factor, size_t angles,
                           const double *state, size_t first, size_t last, size_t ahead,
                           double *nearby)
{
    size_t n = wave->spectrum->n, width = wave->width;
    for (size_t k = first; k < last; k++)
        for (size_t set = 0; set < 2 * wave->sets && wave->change->rank[k] >= ahead; set++) {
            const double *from = state + k * width + set * n, *a = factor + set * n;
            double sum[8] = {0};
            size_t j = 0;
            for (; j + 8 <= angles; j += 8)
                for (size_t l = 0; l < 8; l++)
                    sum[l] += a[j + l] * from[j + l];
            for (; j < angles; j++)
                sum[0] += a[j] * from[j];
            for (size_t l = 0; l < 8; l++)
                nearby[k] += sum[l];
        }
}

/* Velocities at the point due to nodes ahead of it: fills k[row of factors][node]. Returns the
 * number of waves evaluated. */
VECTOR_MULTIVERSION
static size_t direct_sum(const struct spectral *wave, const double *factor, size_t point_angles,
                         double clearance, const struct nodes *nodes, double *buffer, double *k)
{
    size_t n = wave->spectrum->n, width = wave->width, waves = 0;
    for (size_t i = 0; i < nodes->n; i++) {
        size_t angles = spectral_angles(wave, clearance - nodes->z[i]);
        angles = angles < point_angles ? angles : point_angles;
        waves += angles;
        node_waves(wave, angles, nodes->x[i], nodes->y[i], nodes->z[i], buffer);
        for (size_t row = 0; row < factor_rows(wave); row++) {
            double sum = 0.0;
            for (size_t set = 0; set < 2 * wave->sets; set++) {
                const double *a = factor + row * width + set * n, *b = buffer + set * n;
                double part[8] = {0};
                size_t j = 0;
                for (; j + 8 <= angles; j += 8)
                    for (size_t l = 0; l < 8; l++)
                        part[l] += a[j + l] * b[j + l];
                for (; j < angles; j++)
                    part[0] += a[j] * b[j];
                for (size_t l = 0; l < 8; l++)
                    sum += part[l];
            }
            k[row * nodes->n + i] = sum;
        }
    }
    return waves;
}

static igabem_status straddling(const struct spectral *wave, size_t point, const double *factor,
                                size_t angles, double slack, struct wave_work *work, double *rows)
{
    const struct density *density = wave->influence->density;
    const double *p = density->point + 3 * point;
    struct wave_rule rule = wave->rule;
    rule.clearance = -p[2];
    nodes_clear(&work->nodes);
    for (size_t i = 0; i < wave->sources; i++) {
        const struct source *source = &wave->source[i];
        if (source->box[0] < p[0] - slack && source->box[1] > p[0] + slack)
            spectral_nodes(wave, source, p[0], &rule, &work->nodes);
    }
    size_t n = work->nodes.n;
    if (n == 0 && !work->nodes.failed)
        return IGABEM_OK;
    if (work->nodes.failed || !reserve(work, factor_rows(wave) * n))
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for wave sums");
    work->cost.wave += direct_sum(wave, factor, angles, -p[2], &work->nodes, work->buffer, work->f);
    nodes_scatter(&work->nodes, 3, work->f, n, rows, density->n);
    if (wave->change)
        nodes_scatter(&work->nodes, wave->filters - 1, work->f + 3 * n, n, work->nearby,
                      density->n);
    return IGABEM_OK;
}

static void add_moments(const struct spectral *wave, const struct source *source, double *state,
                        size_t range[2])
{
    const struct element *element = source->element;
    size_t n = (size_t)element->degree[1] + 1, m = (size_t)element->degree[0] + 1;
    for (size_t a = 0; a < m; a++) {
        size_t first = element->first + a * element->stride;
        double *to = state + first * wave->width;
        const double *from = source->moments + a * n * wave->width;
        for (size_t j = 0; j < n * wave->width; j++)
            to[j] += from[j];
    }
    size_t last = element->first + (m - 1) * element->stride + n;
    range[0] = element->first < range[0] ? element->first : range[0];
    range[1] = last > range[1] ? last : range[1];
}

/* Row `index` of the operator of the further filters. */
static igabem_status record_change(const struct spectral *wave, size_t index, size_t angles,
                                   const double *factor, double *nearby)
{
    size_t n = wave->spectrum->n;
    const double *from = factor + (2 + wave->filters) * wave->width;
    double *to = wave->change->factor + index * wave->width;
    for (size_t set = 0; set < 2 * wave->sets; set++)
        memcpy(to + set * n, from + set * n, angles * sizeof *to);
    if (filter_change_collect(wave->change, index, nearby))
        return IGABEM_OK;
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a wave operator");
}

/* Where a thread is on its march from bow to stern. */
struct state {
    double *moments; /* sums over the sources passed, [unknown][width] */
    size_t next;     /* source */
    size_t range[2]; /* of the unknowns met so far */
};

/* Rows of a block of consecutive points (in order of decreasing x), behind those of the state. */
static igabem_status block_rows(const struct spectral *wave, size_t begin, size_t end,
                                struct wave_work *work, struct state *state, double *factor,
                                double *rows)
{
    const struct density *density = wave->influence->density;
    size_t n = density->n, *range = state->range;
    double slack = wave->slack;
    for (size_t i = begin; i < end; i++) {
        size_t point = wave->point[i];
        const double *p = density->point + 3 * point;
        while (state->next < wave->sources && wave->source[state->next].box[0] >= p[0] - slack)
            add_moments(wave, &wave->source[state->next++], state->moments, range);
        size_t angles = point_factors(wave, point, factor);
        double *out = rows + 3 * n * point;
        if (range[0] < range[1])
            product(wave, factor, angles, state->moments, range[0], range[1], out);
        for (size_t f = 1; f < wave->filters && range[0] < range[1]; f++)
            product_nearby(wave, factor + (2 + f) * wave->width, angles, state->moments, range[0],
                           range[1], wave->change->row[i].ahead, work->nearby + (f - 1) * n);
        igabem_status status = straddling(wave, point, factor, angles, slack, work, out);
        if (status == IGABEM_OK && wave->change)
            status = record_change(wave, i, angles, factor, work->nearby);
        if (status != IGABEM_OK)
            return status;
    }
    return IGABEM_OK;
}

static igabem_status march(const struct spectral *wave, int threads, double *rows)
{
    const struct density *density = wave->influence->density;
    size_t blocks = wave->points / BLOCK_POINTS + 1;
    struct progress *progress = wave->influence->progress;
    if (progress)
        progress_stage(progress, progress->to, wave->sources + blocks);
    igabem_status result = IGABEM_OK;
#pragma omp parallel num_threads(threads)
    {
        struct wave_work work = {0};
        nodes_init(&work.nodes, wave->influence->mesh);
        work.buffer = malloc(wave->width * sizeof *work.buffer);
        struct state state = {.range = {density->n, 0}};
        state.moments = calloc(density->n * wave->width, sizeof *state.moments);
        double *factor = malloc((factor_rows(wave) + 1) * wave->width * sizeof *factor);
        work.nearby = calloc(density->n * wave->filters, sizeof *work.nearby);
        igabem_status status = IGABEM_OK;
        if (!work.buffer || !work.nearby || !state.moments || !factor)
            status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for wave sums");
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < wave->sources; i++)
            if (status == IGABEM_OK) {
                status = source_moments(wave, &wave->source[i], &work);
                if (progress_step(wave->influence->progress))
                    status = IGABEM_ERROR_CANCELLED;
            }
#pragma omp single
        for (size_t i = 0; i < wave->sources && wave->change; i++) {
            size_t range[2] = {0, 0};
            add_moments(wave, &wave->source[i], wave->change->moments, range);
        }
/* each thread's blocks come in increasing order, as its state needs them */
#pragma omp for schedule(monotonic : dynamic, 1)
        for (size_t b = 0; b < blocks; b++)
            if (status == IGABEM_OK) {
                status = block_rows(wave, wave->points * b / blocks,
                                    wave->points * (b + 1) / blocks, &work, &state, factor, rows);
                if (progress_step(wave->influence->progress))
                    status = IGABEM_ERROR_CANCELLED;
            }
#pragma omp critical
        {
            influence_count(wave->influence, &work.cost);
            if (status != IGABEM_OK)
                result = status;
        }
        nodes_free(&work.nodes);
        free(work.buffer);
        free(work.f);
        free(work.nearby);
        free(state.moments);
        free(factor);
    }
    if (result == IGABEM_ERROR_CANCELLED)
        return progress_status(wave->influence->progress);
    return result == IGABEM_OK ? result : igabem_fail(result, "no memory for the wave part");
}

igabem_status influence_wave(const struct influence *influence, const struct line *line, double k0,
                             size_t filters, const double *cutoff, const double *weight,
                             double *rows, struct filter_change **change)
{
    struct spectral wave = {.influence = influence,
                            .line = line && line->n ? line : NULL,
                            .sets = influence->density->symmetric ? 1 : 2,
                            .k0 = k0,
                            .filters = filters,
                            .cutoff = cutoff,
                            .weight = weight};
    igabem_status status = spectral_create(&wave);
    if (status == IGABEM_OK)
        status = march(&wave, influence->threads, rows);
    spectral_free(&wave);
    if (status != IGABEM_OK) {
        filter_change_free(wave.change);
        wave.change = NULL;
    }
    if (change)
        *change = wave.change;
    return status;
}
