#include "tangent/potential_wave.h"

#include "core/vector_math.h"
#include "result/radiation.h"
#include "space/line.h"
#include "space/quadrature_wave.h"
#include "tangent/fold.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double DECAY = 40.0; /* sources beyond e^-40 are left out */

/* Of a node on the hull: its area vector, the area of unit parameters, phi, and the inverse of the
 * homogeneous weight of the density. */
enum column { AX, AY, AZ, PART, PHI, INVERSE, COLUMNS };
/* What a node's wave leaves: 2 e^{az} (cos, sin)(by), and the phase (cos, sin)(kx). */
enum wave { EVEN, ODD, COSINE, SINE, WAVES };
/* What its move, turns and phi count for. */
enum count { PLACE, HX, HZ, VALUE, COUNTS };

/* A node on the waterline: nu_x dl = flux, of which V along the line changes `stretch`. */
struct line_node {
    const struct element *element;
    double local[2], x, y, flux, stretch, phi, v;
    double flow; /* 1, of a double model 0: phi_x has left its waterline */
    int run;
};

struct waves {
    const igabem_tangent *tangent;
    struct nodes surface, face; /* of the hull; of a transom's face, element by element */
    struct hull_nodes hull;
    double *column; /* [COLUMNS][surface.n] */
    double *depth;  /* [blocks] least */
    size_t most;    /* nodes of a block */
    size_t lines;
    struct line_node *line;
    double *rim;       /* phi and phi_x where the face radiates, [2][points] */
    double **rim_rows; /* [points] factors of phi on the hull */
    struct gauss gauss;
};

struct waves_work {
    double *wave; /* [WAVES + COUNTS][most] */
};

/* A wave number, and which part of the wave is asked for: with i times the phase turned back the
 * real part becomes the imaginary one. */
struct angle {
    double a, b, k;
};

void waves_free(struct waves *waves)
{
    if (!waves)
        return;
    nodes_free(&waves->surface);
    nodes_free(&waves->face);
    hull_nodes_free(&waves->hull);
    free(waves->column);
    free(waves->depth);
    free(waves->line);
    free(waves->rim);
    for (size_t k = 0; waves->rim_rows && k < FACE_ACROSS * waves->tangent->shape->parts; k++)
        free(waves->rim_rows[k]);
    free(waves->rim_rows);
    free(waves);
}

size_t waves_width(const struct waves *waves)
{
    const igabem_tangent *tangent = waves->tangent;
    return 2 * tangent->solution->density->n + tangent->field->controls + tangent->shape->size;
}

static void fill_block(const igabem_tangent *tangent, struct waves *waves, size_t b)
{
    const struct nodes *nodes = &waves->surface;
    const struct block *block = &nodes->block[b];
    double phi[ELEMENT_FUNCTIONS], *column = waves->column;
    element_gather(block->element, tangent->solution->sigma, phi);
    waves->depth[b] = INFINITY;
    for (size_t i = block->begin; i < block->end; i++) {
        struct area_change area;
        double weight = nodes_weight(nodes, block->element, i);
        area_change(nodes->jet + 6 * i, nodes->jet + 6 * i + 3, block->element->sign, &area);
        double part = area.size > 0 ? nodes->g[i] * weight / area.size : 0.0;
        for (size_t c = 0; c < 3; c++)
            column[(AX + c) * nodes->n + i] = part * area.area[c];
        column[PART * nodes->n + i] = part;
        column[PHI * nodes->n + i] = nodes_value(nodes, block->element, i, phi, 1) / weight;
        column[INVERSE * nodes->n + i] = 1.0 / weight;
        waves->depth[b] = fmin(waves->depth[b], -nodes->z[i]);
    }
    if (waves->most < block->end - block->begin)
        waves->most = block->end - block->begin;
}

static igabem_status fill_surface(const igabem_tangent *tangent, const struct wave_rule *rule,
                                  struct waves *waves)
{
    struct nodes *nodes = &waves->surface;
    for (size_t e = 0; e < tangent->mesh->n; e++) {
        struct domain domain;
        domain_whole(&tangent->mesh->element[e], &domain);
        wave_nodes(rule, &domain, nodes);
    }
    if (!hull_nodes_fill(nodes, &waves->hull))
        return tangent_no_memory(tangent->field->n);
    waves->column = malloc((COLUMNS * nodes->n + 1) * sizeof *waves->column);
    waves->depth = malloc((nodes->blocks + 1) * sizeof *waves->depth);
    if (!waves->column || !waves->depth)
        return tangent_no_memory(tangent->field->n);
    for (size_t b = 0; b < nodes->blocks; b++)
        fill_block(tangent, waves, b);
    return IGABEM_OK;
}

static void fill_line_node(const igabem_tangent *tangent, const struct line_segment *segment,
                           const struct nodes *nodes, size_t i, const double phi[],
                           const double velocity[], struct line_node *to)
{
    const struct element *element = segment->element;
    double weight = nodes_weight(nodes, element, i);
    struct area_change area;
    struct jet jet;
    *to = (struct line_node){.element = element, .x = nodes->x[i], .y = nodes->y[i]};
    to->run = 1 - segment->fixed;
    nodes_local(nodes, element, i, to->local);
    element_jet(element, to->local[0], to->local[1], &jet);
    area_change(jet.ds, jet.dt, element->sign, &area);
    const double *along = to->run ? jet.dt : jet.ds, *normal = nodes->normal + 3 * i;
    double dl = hypot(along[0], along[1]);
    double outward = along[1] * area.area[0] - along[0] * area.area[1] < 0 ? -1.0 : 1.0;
    to->flux = normal[0] * normal[1] / tangent->solution->k0;
    to->stretch = dl > 0 ? outward * normal[1] / (dl * tangent->solution->k0) : 0.0;
    to->phi = nodes_value(nodes, element, i, phi, 1) / weight;
    to->flow = tangent->solution->base ? 0.0 : 1.0;
    to->v = to->flow * nodes_value(nodes, element, i, velocity, 1) / weight;
}

static igabem_status fill_line(const igabem_tangent *tangent, const struct wave_rule *rule,
                               struct waves *waves)
{
    const igabem_solution *solution = tangent->solution;
    struct line *line = NULL;
    struct nodes nodes;
    size_t room = 0;
    igabem_status status =
        line_create(solution->density, tangent->mesh, solution->options.stem_limit, &line);
    nodes_init(&nodes, tangent->mesh);
    nodes.with_normals = true;
    for (size_t s = 0; status == IGABEM_OK && s < line->n; s++) {
        const struct line_segment *segment = &line->segment[s];
        double phi[ELEMENT_FUNCTIONS], velocity[ELEMENT_FUNCTIONS];
        nodes_clear(&nodes);
        wave_line_nodes(rule, line, segment, segment->range, &nodes);
        element_gather(segment->element, solution->sigma, phi);
        element_gather(segment->element, solution->velocity, velocity);
        if (waves->lines + nodes.n > room) {
            room = 2 * room + nodes.n;
            struct line_node *more = realloc(waves->line, room * sizeof *more);
            waves->line = more ? more : waves->line;
            nodes.failed |= !more;
        }
        if (nodes.failed) {
            status = tangent_no_memory(tangent->field->n);
            continue;
        }
        for (size_t i = 0; i < nodes.n; i++)
            fill_line_node(tangent, segment, &nodes, i, phi, velocity,
                           &waves->line[waves->lines++]);
    }
    nodes_free(&nodes);
    line_free(line);
    return status;
}

/* What radiates from the face of a transom, as radiation.c has it. */
static igabem_status fill_face(const igabem_tangent *tangent, struct waves *waves)
{
    const igabem_solution *solution = tangent->solution;
    const struct shape *shape = tangent->shape;
    size_t points = FACE_ACROSS * shape->parts, hull = solution->density->n;
    const double whole[4] = {0.0, 1.0, 0.0, 1.0};
    const int rule[2] = {FACE_ACROSS, FACE_UP};
    for (size_t p = 0; p < shape->parts; p++) {
        struct domain domain;
        domain_whole(&shape->transom->face->element[p], &domain);
        cell_nodes(&domain, whole, rule, &waves->gauss, &waves->face);
    }
    waves->rim = calloc(2 * points + 1, sizeof *waves->rim);
    waves->rim_rows = calloc(points + 1, sizeof *waves->rim_rows);
    igabem_status status = waves->rim && waves->rim_rows && !waves->face.failed
                               ? IGABEM_OK
                               : tangent_no_memory(tangent->field->n);
    for (size_t k = 0; k < points && status == IGABEM_OK; k++) {
        double at[3], *row = waves->rim_rows[k] = calloc(hull, sizeof *row);
        if (!row)
            return tangent_no_memory(tangent->field->n);
        status = shape_rim(tangent, shape, k / FACE_ACROSS, k % FACE_ACROSS, row);
        for (size_t j = 0; j < hull; j++)
            waves->rim[k] += row[j] * solution->sigma[j];
        edge_at(&shape->transom->rim_edge,
                shape_across(shape, &waves->gauss, k / FACE_ACROSS, k % FACE_ACROSS), at);
        waves->rim[points + k] = solution->speed * solution->k0 * fmin(0.0, at[2]);
    }
    return status;
}

igabem_status waves_create(const igabem_tangent *tangent, double t_max, struct waves **result)
{
    const igabem_solution *solution = tangent->solution;
    struct waves *waves = calloc(1, sizeof *waves);
    *result = NULL;
    if (!waves)
        return tangent_no_memory(tangent->field->n);
    waves->tangent = tangent;
    nodes_init(&waves->surface, tangent->mesh);
    waves->surface.with_jets = true;
    if (tangent->shape->transom)
        nodes_init(&waves->face, tangent->shape->transom->face);
    waves->face.with_jets = true;
    igabem_status status = gauss_fill(&waves->gauss);
    const struct wave_rule rule = {.k0 = solution->k0,
                                   .t_max = t_max,
                                   .tolerance = solution->options.tolerance,
                                   .gauss = &waves->gauss};
    if (status == IGABEM_OK)
        status = fill_surface(tangent, &rule, waves);
    if (status == IGABEM_OK)
        status = fill_line(tangent, &rule, waves);
    if (status == IGABEM_OK && tangent->shape->transom)
        status = fill_face(tangent, waves);
    if (status != IGABEM_OK) {
        waves_free(waves);
        return status;
    }
    *result = waves;
    return IGABEM_OK;
}

struct waves_work *waves_work_create(const struct waves *waves)
{
    struct waves_work *work = malloc(sizeof *work);
    if (!work)
        return NULL;
    work->wave = malloc(((WAVES + COUNTS) * waves->most + 1) * sizeof *work->wave);
    if (work->wave)
        return work;
    free(work);
    return NULL;
}

void waves_work_free(struct waves_work *work)
{
    if (!work)
        return;
    free(work->wave);
    free(work);
}

VECTOR_MULTIVERSION
static void fill_waves(const struct angle *angle, size_t n, const double *x, const double *y,
                       const double *z, double *restrict wave)
{
    double a = angle->a, b = angle->b, k = angle->k;
    for (size_t i = 0; i < n; i++)
        wave[EVEN * n + i] = 2.0 * vector_exp(a * z[i]);
#pragma omp simd
    for (size_t i = 0; i < n; i++) {
        double s, c, sy, cy, e = wave[EVEN * n + i];
        vector_sincos(k * x[i], &s, &c);
        vector_sincos(b * y[i], &sy, &cy);
        wave[EVEN * n + i] = e * cy;
        wave[ODD * n + i] = e * sy;
        wave[COSINE * n + i] = c;
        wave[SINE * n + i] = s;
    }
}

/* F = q E - m.grad E of nodes with q = U A_x, m = phi A; returns the sum of the part asked for and
 * fills what it is to move, turns and phi. step: from column to column. */
VECTOR_MULTIVERSION
static double count_hull(const struct angle *angle, bool imaginary, double speed, size_t n,
                         const double *wave, const double *column, size_t step,
                         double *restrict count)
{
    const double *ax = column + AX * step, *ay = column + AY * step, *az = column + AZ * step;
    const double *part = column + PART * step, *phi = column + PHI * step;
    const double *even = wave + EVEN * n, *odd = wave + ODD * n;
    const double *phase = wave + (imaginary ? SINE : COSINE) * n;
    const double *other = wave + (imaginary ? COSINE : SINE) * n;
    double a = angle->a, b = angle->b, k = angle->k, turn = imaginary ? -1.0 : 1.0, sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < n; i++) {
        double c = phase[i], s = turn * other[i], e = even[i], o = odd[i];
        double up = b * ay[i] * o - a * az[i] * e, ahead = -k * ax[i] * e; /* -A.grad E */
        double value = up * c - ahead * s;
        double q = speed * ax[i] - a * phi[i] * az[i];
        double place = b * b * phi[i] * ay[i] * e - b * q * o, turned = k * b * phi[i] * ax[i] * o;
        sum += speed * ax[i] * e * c + phi[i] * value;
        count[PLACE * n + i] = place * c - turned * s;
        count[HX * n + i] = part[i] * e * (speed * c + k * phi[i] * s);
        count[HZ * n + i] = -part[i] * a * phi[i] * e * c;
        count[VALUE * n + i] = value;
    }
    return sum;
}

/* Adds to the coefficients of phi. */
static void scatter_values(const struct waves *waves, const struct block *block,
                           const double *value, double *row)
{
    const struct nodes *nodes = &waves->surface;
    const struct element *element = block->element;
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double moment[ELEMENT_FUNCTIONS] = {0.0};
    for (size_t i = block->begin; i < block->end; i++) {
        const double *bu = nodes->bu + i * nodes->side[0], *bv = nodes->bv + i * nodes->side[1];
        double factor = value[i - block->begin] * waves->column[INVERSE * nodes->n + i];
        for (size_t a = 0; a < m; a++)
            for (size_t b = 0; b < n; b++)
                moment[a * n + b] += factor * bu[a] * bv[b];
    }
    element_scatter(element, 1, moment, row, 0);
}

static void add_hull(const struct waves *waves, const struct angle *angle, struct waves_work *work,
                     double h[2], double *row)
{
    const igabem_tangent *tangent = waves->tangent;
    const struct nodes *nodes = &waves->surface;
    const struct field *field = tangent->field;
    size_t unknowns = tangent->solution->density->n, width = waves_width(waves);
    for (size_t k = 0; k < nodes->blocks; k++) {
        const struct block *block = &nodes->block[k];
        size_t first = block->begin, n = block->end - first;
        double *count = work->wave + WAVES * n;
        if (angle->a * waves->depth[k] > DECAY)
            continue;
        fill_waves(angle, n, nodes->x + first, nodes->y + first, nodes->z + first, work->wave);
        for (size_t part = 0; part < 2; part++) {
            double *to = row + part * width;
            h[part] += count_hull(angle, part == 1, tangent->solution->speed, n, work->wave,
                                  waves->column + first, nodes->n, count);
            scatter_values(waves, block, count + VALUE * n, to);
            fold_hull(&waves->hull, block, first, count + PLACE * n, count + HX * n, count + HZ * n,
                      to + 2 * unknowns + field->offset[block->element - field->mesh->element]);
        }
    }
}

/* Values and slopes along the line of the Bernstein polynomials at a node of the waterline: of phi
 * over the weight of the density, of the moves over that of the shape. */
static void line_basis(const struct line_node *node, double *phi, double *move, double *slope)
{
    const struct element *element = node->element;
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double bu[ELEMENT_SIDE], du[ELEMENT_SIDE], bv[ELEMENT_SIDE], dv[ELEMENT_SIDE];
    double weight = 0.0, growth = 0.0;
    bernstein(element->degree[0], node->local[0], bu, du);
    bernstein(element->degree[1], node->local[1], bv, dv);
    for (size_t k = 0; k < m * n; k++) {
        double w = element->net[4 * k + 3];
        move[k] = bu[k / n] * bv[k % n];
        slope[k] = node->run ? bu[k / n] * dv[k % n] : du[k / n] * bv[k % n];
        weight += w * move[k];
        growth += w * slope[k];
    }
    for (size_t k = 0; k < m * n; k++) {
        phi[k] = move[k] / (element->rational ? weight : 1.0);
        move[k] /= weight;
        slope[k] = (slope[k] - growth * move[k]) / weight;
    }
}

/* F = flux (i k phi - phi_x) E. */
static void add_line(const struct waves *waves, const struct angle *angle, double h[2], double *row)
{
    const struct field *field = waves->tangent->field;
    size_t unknowns = waves->tangent->solution->density->n, width = waves_width(waves);
    for (size_t l = 0; l < waves->lines; l++) {
        const struct line_node *node = &waves->line[l];
        const struct element *element = node->element;
        size_t count = (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
        double phi[ELEMENT_FUNCTIONS], move[ELEMENT_FUNCTIONS], slope[ELEMENT_FUNCTIONS];
        double moment[2 * ELEMENT_FUNCTIONS];
        double e = 2.0 * cos(angle->b * node->y), o = 2.0 * sin(angle->b * node->y);
        const double wave[2] = {cos(angle->k * node->x), sin(angle->k * node->x)};
        line_basis(node, phi, move, slope);
        for (size_t part = 0; part < 2; part++) {
            double *to = row + part * width, c = wave[part], s = part ? -wave[0] : wave[1];
            double strength = -angle->k * node->phi * s - node->v * c;
            double *net = to + 2 * unknowns + field->offset[element - field->mesh->element];
            h[part] += node->flux * strength * e;
            for (size_t k = 0; k < count; k++) {
                moment[k] = -node->flux * angle->k * s * e * phi[k];
                moment[count + k] = -node->flow * node->flux * c * e * phi[k];
                net[k] +=
                    strength * (node->stretch * e * slope[k] - node->flux * angle->b * o * move[k]);
            }
            element_scatter(element, 2, moment, to, unknowns);
        }
    }
}

/* A node of the face at a point of the rim with phi and phi_x = slope: F = q E - m.grad E with q =
 * slope A_x, m = phi A. */
static void add_face_node(const struct waves *waves, const struct angle *angle, size_t p, size_t i,
                          size_t at, double h[2], double *row)
{
    const struct shape *shape = waves->tangent->shape;
    const struct nodes *nodes = &waves->face;
    const struct element *element = &shape->transom->face->element[p];
    size_t points = FACE_ACROSS * shape->parts, width = waves_width(waves);
    double phi = waves->rim[at], slope = waves->rim[points + at], wave[WAVES], local[2];
    double a = angle->a, b = angle->b, k = angle->k;
    struct area_change area;
    nodes_local(nodes, element, i, local);
    area_change(nodes->jet + 6 * i, nodes->jet + 6 * i + 3, element->sign, &area);
    double part_area = area.size > 0 ? nodes->g[i] / area.size : 0.0;
    fill_waves(angle, 1, &nodes->x[i], &nodes->y[i], &nodes->z[i], wave);
    for (size_t part = 0; part < 2; part++) {
        double *number = row + (part + 1) * width - shape->size;
        double c = wave[part ? SINE : COSINE], s = part ? -wave[COSINE] : wave[SINE];
        double e = wave[EVEN], o = wave[ODD];
        const double *v = area.area;
        double up = b * v[1] * o - a * v[2] * e, ahead = -k * v[0] * e;
        double value = part_area * (up * c - ahead * s), source = part_area * v[0] * e * c;
        double q = part_area * (slope * v[0] - a * phi * v[2]), m = part_area * phi;
        double back = part_area * (slope * v[0] * e + phi * up), side = m * ahead;
        const double place[3] = {-k * (side * c + back * s),
                                 (b * b * m * v[1] * e - b * q * o) * c - k * b * m * v[0] * o * s,
                                 a * (back * c - side * s)};
        const double turned[3] = {part_area * e * (slope * c + k * phi * s), m * b * o * c,
                                  -m * a * e * c};
        h[part] += back * c - side * s;
        number[shape->point + at] += value;
        number[shape->point + points + at] += source;
        fold_face(shape, p, local, nodes->jet + 6 * i, element->sign, place, turned, number);
    }
}

/* The upper edge, where nu = -e_x: F = dl (slope - i k phi) E. */
static void add_face_edge(const struct waves *waves, const struct angle *angle, size_t at,
                          double h[2], double *row)
{
    const struct shape *shape = waves->tangent->shape;
    size_t points = FACE_ACROSS * shape->parts, width = waves_width(waves);
    size_t p = at / FACE_ACROSS, i = at % FACE_ACROSS;
    double phi = waves->rim[at], slope = waves->rim[points + at], parts = (double)shape->parts;
    double y = shape_across(shape, &waves->gauss, p, i);
    double share = waves->gauss.weight[FACE_ACROSS][i] / (parts * waves->tangent->solution->k0);
    double dl = share * shape->transom->breadth;
    double e = 2.0 * cos(angle->b * y), o = 2.0 * sin(angle->b * y);
    const double wave[2] = {cos(angle->k * shape->transom->x), sin(angle->k * shape->transom->x)};
    for (size_t part = 0; part < 2; part++) {
        double *number = row + (part + 1) * width - shape->size;
        double c = wave[part], s = part ? -wave[0] : wave[1];
        double strength = slope * c + angle->k * phi * s;
        h[part] += dl * strength * e;
        number[shape->point + at] += dl * angle->k * s * e;
        number[shape->point + points + at] += dl * c * e;
        number[shape->breadth] +=
            strength * (share * e - dl * angle->b * o * y / shape->transom->breadth);
    }
}

static void add_face(const struct waves *waves, const struct angle *angle, double h[2], double *row)
{
    const struct shape *shape = waves->tangent->shape;
    size_t width = waves_width(waves), unknowns = waves->tangent->solution->density->n;
    size_t points = FACE_ACROSS * shape->parts;
    for (size_t b = 0; b < waves->face.blocks; b++)
        for (size_t i = waves->face.block[b].begin; i < waves->face.block[b].end; i++)
            add_face_node(waves, angle, b, i,
                          FACE_ACROSS * b + (i - waves->face.block[b].begin) % FACE_ACROSS, h, row);
    for (size_t at = 0; at < points; at++) {
        add_face_edge(waves, angle, at, h, row);
        for (size_t part = 0; part < 2; part++) {
            double value = row[(part + 1) * width - shape->size + shape->point + at];
            for (size_t j = 0; j < unknowns; j++)
                row[part * width + j] += value * waves->rim_rows[at][j];
        }
    }
}

void waves_row(const struct waves *waves, double t, struct waves_work *work, double h[2],
               double *row)
{
    double k0 = waves->tangent->solution->k0, k = k0 * sqrt(1.0 + t * t);
    const struct angle angle = {.a = k0 * (1.0 + t * t), .b = k * t, .k = k};
    memset(row, 0, 2 * waves_width(waves) * sizeof *row);
    h[0] = h[1] = 0.0;
    add_hull(waves, &angle, work, h, row);
    add_line(waves, &angle, h, row);
    if (waves->tangent->shape->transom)
        add_face(waves, &angle, h, row);
}
