#include "tangent/row_layer.h"

#include "core/constants.h"
#include "core/vector_math.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 4 };

/* Of those of the free surface: their strength q, q V and q V_t/y_t for a unit move of the inner
 * edge, and the cubics along x through the four places of the edge that move them. */
enum flat_column { STRENGTH, MOVED, STRETCHED, CUBIC, FLAT = CUBIC + SIDE };
enum { ROW_COLUMNS = ROW_GENERAL_COLUMNS }; /* the larger number */

/* What kernels leave at a node of the free surface: G and its derivative along y at the node,
 * without strength. */
enum flat_kernel { FLAT_G, FLAT_Y, FLAT_KERNELS };

static bool is_flat(const struct row_layer *layer)
{
    return layer->kind == ROW_SURFACE || layer->kind == ROW_STRIP;
}

static struct row_stretch stretch_of(const struct row_nodes *row, size_t first, size_t end,
                                     size_t block)
{
    return (struct row_stretch){
        row->nodes, &row->hull, first, end, end - first, block, row->column + ROW_COLUMNS * first};
}

static double *column_of(const struct row_stretch *stretch, size_t c)
{
    return stretch->column + c * stretch->n;
}

/* Blocks go on from stretch to stretch: the part of block b; false: it lies behind. */
static bool part_of(const struct row_stretch *stretch, size_t b, struct block *block)
{
    if (b >= stretch->nodes->blocks || stretch->nodes->block[b].begin >= stretch->end)
        return false;
    *block = stretch->nodes->block[b];
    block->begin = block->begin > stretch->first ? block->begin : stretch->first;
    block->end = block->end < stretch->end ? block->end : stretch->end;
    return true;
}

/* V of a unit move of the inner edge at t of row j of the surface, and V_t. The strip's move is
 * that of the transom's half breadth. */
static void row_move(const struct row_layer *layer, size_t j, double t, double *v, double *slope)
{
    if (layer->kind == ROW_STRIP) {
        double columns = (double)layer->shape->transom->n;
        *v = ((double)j + t) / columns;
        *slope = 1.0 / columns;
        return;
    }
    /* The cubic through thirds that the element has. */
    const struct free_surface *surface = layer->shape->surface;
    double all = surface->offset[2 * surface->ny];
    *v = *slope = 0.0;
    for (int b = 0; b < SIDE; b++) {
        double value = 1.0, derivative = 0.0;
        for (int c = 0; c < SIDE; c++) {
            if (c == b)
                continue;
            double width = (b - c) / 3.0;
            derivative = (derivative * (t - c / 3.0) + value) / width;
            value *= (t - c / 3.0) / width;
        }
        double move = 1.0 - free_surface_offset(surface, (double)j + b / 3.0) / all;
        *v += value * move;
        *slope += derivative * move;
    }
}

static void cubics(double s, double value[SIDE])
{
    for (int a = 0; a < SIDE; a++) {
        value[a] = 1.0;
        for (int c = 0; c < SIDE; c++)
            if (c != a)
                value[a] *= (3.0 * s - c) / (a - c);
    }
}

static size_t rows_of(const struct row_layer *layer)
{
    return layer->kind == ROW_STRIP ? layer->shape->transom->n : layer->shape->surface->ny;
}

/* Adds the sums over the cubics of a cell. */
static void add_cell(const struct row_layer *layer, size_t cell, const double sum[SIDE],
                     double *numbers)
{
    if (layer->kind == ROW_STRIP) {
        numbers[layer->shape->breadth] += sum[0] + sum[1] + sum[2] + sum[3];
        return;
    }
    double *to = numbers + layer->shape->station + 3 * (cell / rows_of(layer));
    for (int a = 0; a < SIDE; a++)
        to[a] += sum[a];
}

void row_layer_place(const struct row_layer *layer, size_t cell, const double local[2],
                     double place, double *numbers)
{
    double v, slope, sum[SIDE];
    row_move(layer, cell % rows_of(layer), local[1], &v, &slope);
    cubics(local[0], sum);
    for (int a = 0; a < SIDE; a++)
        sum[a] *= place * v;
    add_cell(layer, cell, sum, numbers);
}

static void fill_flat(const struct row_layer *layer, const struct block *block,
                      const struct row_stretch *stretch)
{
    const struct nodes *nodes = stretch->nodes;
    const struct element *element = block->element;
    size_t cell = (size_t)(element - layer->surface.influence->mesh->element);
    double field[ELEMENT_FUNCTIONS];
    element_gather(element, layer->strength, field);
    for (size_t i = block->begin; i < block->end; i++) {
        double local[2], v, slope, along[SIDE];
        double q = nodes_value(nodes, element, i, field, 1) * nodes->g[i];
        nodes_local(nodes, element, i, local);
        row_move(layer, cell % rows_of(layer), local[1], &v, &slope);
        cubics(local[0], along);
        size_t to = i - stretch->first;
        column_of(stretch, STRENGTH)[to] = q;
        column_of(stretch, MOVED)[to] = q * v;
        column_of(stretch, STRETCHED)[to] = q * slope / nodes->jet[6 * i + 4];
        for (size_t a = 0; a < SIDE; a++)
            column_of(stretch, CUBIC + a)[to] = along[a];
    }
}

static void fill_general(const struct row_layer *layer, const struct block *block,
                         const struct row_stretch *stretch)
{
    const struct nodes *nodes = stretch->nodes;
    const struct element *element = block->element;
    const igabem_solution *solution = layer->tangent->solution;
    const struct transom *transom = layer->shape->transom;
    double field[ELEMENT_FUNCTIONS], flux = 0.0;
    element_gather(element, layer->strength, field);
    if (layer->kind == ROW_FACE) {
        size_t j = (size_t)(element - transom->face->element) / TRANSOM_FACE_PARTS;
        flux = layer->speed * solution->k0 * transom->turn[j] * transom->depth[j];
    }
    for (size_t i = block->begin; i < block->end; i++) {
        struct area_change area;
        size_t to = i - stretch->first;
        double weight = nodes_weight(nodes, element, i);
        area_change(nodes->jet + 6 * i, nodes->jet + 6 * i + 3, element->sign, &area);
        double part = area.size > 0 ? nodes->g[i] * weight / area.size : 0.0;
        double phi = nodes_value(nodes, element, i, field, 1) / weight, carried = 0.0;
        for (size_t c = 0; c < 3; c++) {
            double of_area = c == 0 ? layer->speed : 0.0;
            if (layer->kind == ROW_FACE)
                of_area = area.size > 0 ? flux * area.area[c] / area.size : 0.0;
            column_of(stretch, ROW_AX + c)[to] = part * area.area[c];
            column_of(stretch, ROW_CX + c)[to] = part * of_area;
            carried += part * of_area * area.area[c];
        }
        column_of(stretch, ROW_Q)[to] = carried;
        column_of(stretch, ROW_PHI)[to] = phi;
        column_of(stretch, ROW_PHI_PART)[to] = part * phi;
    }
}

static bool reserve(const struct row_layer *layer, struct nodes *nodes, struct row_nodes *row)
{
    if (nodes->failed)
        return false;
    if (nodes->n > row->capacity) {
        free(row->column);
        row->capacity = row->capacity ? nodes->n + nodes->n / 2 : nodes->n;
        row->column = malloc(ROW_COLUMNS * row->capacity * sizeof *row->column);
    }
    row->nodes = nodes;
    if (!row->column) {
        row->capacity = 0;
        return nodes->n == 0;
    }
    return layer->kind != ROW_HULL || hull_nodes_fill(nodes, &row->hull);
}

static void fill_stretch(const struct row_layer *layer, const struct row_stretch *stretch)
{
    struct block block;
    for (size_t b = stretch->block; part_of(stretch, b, &block); b++)
        if (is_flat(layer))
            fill_flat(layer, &block, stretch);
        else
            fill_general(layer, &block, stretch);
}

void row_nodes_free(struct row_nodes *row)
{
    hull_nodes_free(&row->hull);
    free(row->column);
    row->column = NULL;
    row->capacity = 0;
}

struct row_stretch row_layer_rule(const struct row_layer *layer, size_t r)
{
    return stretch_of(&layer->far, layer->node[r], layer->node[r + 1], layer->block[r]);
}

/* The nodes of all far rules, and the blocks of each. */
static bool fill_far(struct row_layer *layer)
{
    const struct influence *influence = layer->surface.influence;
    size_t each = (size_t)REGULAR_CLASSES * REGULAR_CLASSES, rules = each * influence->mesh->panels;
    struct nodes *nodes = &layer->nodes;
    layer->node = malloc((rules + 1) * sizeof *layer->node);
    layer->block = malloc((rules + 1) * sizeof *layer->block);
    if (!layer->node || !layer->block)
        return false;
    for (size_t r = 0; r < rules; r++) {
        const int class[2] = {(int)(r % each) / REGULAR_CLASSES, (int)(r % each) % REGULAR_CLASSES};
        layer->node[r] = nodes->n;
        regular_nodes(influence, r / each, class, nodes);
    }
    layer->node[rules] = nodes->n;
    if (!reserve(layer, nodes, &layer->far))
        return false;
    for (size_t r = 0, b = 0; r < rules; r++) {
        while (b + 1 < nodes->blocks && nodes->block[b].end <= layer->node[r])
            b++;
        layer->block[r] = b;
        const struct row_stretch stretch = row_layer_rule(layer, r);
        fill_stretch(layer, &stretch);
    }
    return true;
}

igabem_status row_layer_create(const igabem_tangent *tangent, const struct shape *shape,
                               enum row_layer_kind kind, const struct influence *influence,
                               double speed, double *strength, struct row_layer *layer)
{
    *layer = (struct row_layer){.kind = kind,
                                .tangent = tangent,
                                .shape = shape,
                                .speed = speed,
                                .strength = strength,
                                .surface = {.influence = influence, .symmetric = true}};
    layer->surface.flat = is_flat(layer);
    nodes_init(&layer->nodes, influence->mesh);
    layer->nodes.with_jets = true;
    return fill_far(layer) ? IGABEM_OK : tangent_no_memory(tangent->field->n);
}

void row_layer_free(struct row_layer *layer)
{
    nodes_free(&layer->nodes);
    row_nodes_free(&layer->far);
    free(layer->node);
    free(layer->block);
    free(layer->strength);
}

bool row_layer_work_create(const struct row_layer *layer, struct row_layer_work *work)
{
    memset(work, 0, sizeof *work);
    bool complete = layer_work_create(&layer->surface, &work->layer) == IGABEM_OK;
    work->layer.nodes.with_jets = work->layer.singular.with_jets = true;
    return complete;
}

void row_layer_work_free(struct row_layer_work *work)
{
    layer_work_free(&work->layer);
    row_nodes_free(&work->near);
    free(work->kernel);
}

static bool clear_kernels(const struct row_layer *layer, struct row_layer_work *work, size_t n)
{
    size_t kernels = is_flat(layer) ? (size_t)FLAT_KERNELS : (size_t)ROW_KERNELS;
    if (n > work->capacity) {
        free(work->kernel);
        work->capacity = n + n / 2;
        work->kernel = malloc(ROW_KERNELS * work->capacity * sizeof *work->kernel);
    }
    if (!work->kernel) {
        work->capacity = 0;
        return n == 0;
    }
    memset(work->kernel, 0, kernels * n * sizeof *work->kernel);
    return true;
}

/* Adds the kernels of nodes that carry phi as seen from p; returns the derivative of their sum with
 * respect to y of p. */
VECTOR_MULTIVERSION
static double general_kernels(const double p[3], size_t n, const double *x, const double *y,
                              const double *z, const double *column, double *restrict out)
{
    const double *ax = column + ROW_AX * n, *ay = column + ROW_AY * n, *az = column + ROW_AZ * n;
    const double *cx = column + ROW_CX * n, *cy = column + ROW_CY * n, *cz = column + ROW_CZ * n;
    const double *q = column + ROW_Q * n, *phi = column + ROW_PHI * n,
                 *part = column + ROW_PHI_PART * n;
    double turn = 0.0, scale = -1.0 / (4.0 * PI);
#pragma omp simd reduction(+ : turn)
    for (size_t i = 0; i < n; i++) {
        double dx = p[0] - x[i], dy = p[1] - y[i], dz = p[2] - z[i];
        double square = 1.0 / (dx * dx + dy * dy + dz * dz), g = scale * sqrt(square);
        double d = g * square * (ax[i] * dx + ay[i] * dy + az[i] * dz), fall = g * square;
        double along = square * (q[i] * g - 3.0 * phi[i] * d), turned = phi[i] * fall;
        double move = along * dy + turned * ay[i];
        out[i] += g;
        out[n + i] += d;
        out[2 * n + i] += along * dx + turned * ax[i];
        out[3 * n + i] += move;
        out[4 * n + i] += along * dz + turned * az[i];
        out[5 * n + i] += cx[i] * g - part[i] * fall * dx;
        out[6 * n + i] += cy[i] * g - part[i] * fall * dy;
        out[7 * n + i] += cz[i] * g - part[i] * fall * dz;
        turn -= move;
    }
    return turn;
}

/* The same on the free surface, twice for the image. */
VECTOR_MULTIVERSION
static double flat_kernels(const double p[3], size_t n, const double *x, const double *y,
                           const double *z, const double *strength, double *restrict out)
{
    double turn = 0.0, scale = -2.0 / (4.0 * PI);
#pragma omp simd reduction(+ : turn)
    for (size_t i = 0; i < n; i++) {
        double dx = p[0] - x[i], dy = p[1] - y[i], dz = p[2] - z[i];
        double square = 1.0 / (dx * dx + dy * dy + dz * dz), g = scale * sqrt(square);
        double slope = g * square * dy;
        out[i] += g;
        out[n + i] += slope;
        turn -= strength[i] * slope;
    }
    return turn;
}

/* Nodes as seen from p, y turned round or not. */
static void add_kernels(const struct row_layer *layer, const struct row_stretch *stretch,
                        const double p[3], bool turned, double *out, double *turn)
{
    const struct nodes *nodes = stretch->nodes;
    size_t first = stretch->first, n = stretch->n;
    const double *x = nodes->x + first, *y = nodes->y + first, *z = nodes->z + first;
    double sum = is_flat(layer) ? flat_kernels(p, n, x, y, z, stretch->column, out)
                                : general_kernels(p, n, x, y, z, stretch->column, out);
    *turn += turned ? -sum : sum;
}

/* Of n nodes, all in one row of columns. */
VECTOR_MULTIVERSION
static void flat_sums(size_t n, size_t step, const double *column, const double *kernel,
                      double sum[SIDE])
{
    const double *moved = column + MOVED * step, *stretched = column + STRETCHED * step;
    const double *cubic = column + CUBIC * step, *g = kernel + FLAT_G * step;
    const double *slope = kernel + FLAT_Y * step;
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
#pragma omp simd reduction(+ : s0, s1, s2, s3)
    for (size_t i = 0; i < n; i++) {
        double value = moved[i] * slope[i] + stretched[i] * g[i];
        s0 += value * cubic[i];
        s1 += value * cubic[step + i];
        s2 += value * cubic[2 * step + i];
        s3 += value * cubic[3 * step + i];
    }
    sum[0] = s0;
    sum[1] = s1;
    sum[2] = s2;
    sum[3] = s3;
}

static void fold_transom(const struct row_layer *layer, const struct row_stretch *stretch,
                         const struct block *block, const double *kernel, double *numbers)
{
    const struct shape *shape = layer->shape;
    const struct element *element = block->element;
    size_t part = (size_t)(element - shape->transom->face->element), n = stretch->n;
    for (size_t i = block->begin; i < block->end; i++) {
        double local[2], place[3], h[3], square = 0.0;
        size_t at = i - stretch->first;
        for (size_t c = 0; c < 3; c++) {
            double area = column_of(stretch, ROW_AX + c)[at];
            place[c] = kernel[(ROW_PLACE + c) * n + at];
            h[c] = kernel[(ROW_TURN + c) * n + at];
            square += area * area;
        }
        nodes_local(stretch->nodes, element, i, local);
        fold_face(shape, part, local, stretch->nodes->jet + 6 * i, element->sign, place, h,
                  numbers);
        numbers[shape->rim + part / TRANSOM_FACE_PARTS] -= kernel[ROW_D * n + at];
        numbers[shape->flux + part / TRANSOM_FACE_PARTS] += kernel[ROW_G * n + at] * sqrt(square);
    }
}

/* Turns the kernels of nodes into what the numbers count for. */
void row_layer_fold(const struct row_layer *layer, const struct row_stretch *stretch,
                    const double *kernel, double *numbers)
{
    const struct field *field = layer->tangent->field;
    size_t n = stretch->n;
    struct block block;
    for (size_t b = stretch->block; part_of(stretch, b, &block); b++) {
        if (is_flat(layer)) {
            double sum[SIDE];
            size_t first = block.begin - stretch->first;
            flat_sums(block.end - block.begin, n, stretch->column + first, kernel + first, sum);
            add_cell(layer, (size_t)(block.element - layer->surface.influence->mesh->element), sum,
                     numbers);
        } else if (layer->kind == ROW_FACE) {
            fold_transom(layer, stretch, &block, kernel, numbers);
        } else {
            fold_hull(stretch->hull, &block, stretch->first, kernel + (ROW_PLACE + 1) * n,
                      kernel + ROW_TURN * n, kernel + (ROW_TURN + 2) * n,
                      numbers + field->offset[block.element - field->mesh->element]);
        }
    }
}

static bool add_far(const struct row_layer *layer, int images, const double image[4][3],
                    const bool turned[4], struct row_layer_work *work, double *single,
                    double *numbers, double *turn)
{
    const struct influence *influence = layer->surface.influence;
    const struct mesh *mesh = influence->mesh;
    for (size_t p = 0; p < mesh->panels; p++) {
        if (!work->layer.far[p])
            continue;
        const struct regular_rule *rule = regular_rule_of(influence, p, work->layer.class[p]);
        const struct row_stretch stretch =
            row_layer_rule(layer, (size_t)(rule - influence->regular));
        if (!clear_kernels(layer, work, stretch.n))
            return false;
        for (int i = 0; i < images; i++)
            if (work->layer.far[p] >> i & 1)
                add_kernels(layer, &stretch, image[i], turned[i], work->kernel, turn);
        row_layer_fold(layer, &stretch, work->kernel, numbers);
        if (single)
            regular_scatter(&mesh->element[mesh->panel[p].first], rule, 1, work->kernel, rule->n,
                            single, 0);
    }
    return true;
}

bool row_layer_own(const struct row_layer *layer, struct nodes *nodes, struct row_nodes *row,
                   struct row_stretch *stretch)
{
    if (!reserve(layer, nodes, row))
        return false;
    *stretch = stretch_of(row, 0, nodes->n, 0);
    fill_stretch(layer, stretch);
    return true;
}

/* Nodes that are not shared between points. */
static bool add_own(const struct row_layer *layer, struct nodes *nodes, const double p[3],
                    bool turned, struct row_layer_work *work, double *single, double *numbers,
                    double *turn)
{
    if (!nodes->failed && nodes->n == 0)
        return true;
    struct row_stretch stretch;
    if (!row_layer_own(layer, nodes, &work->near, &stretch) ||
        !clear_kernels(layer, work, nodes->n))
        return false;
    add_kernels(layer, &stretch, p, turned, work->kernel, turn);
    row_layer_fold(layer, &stretch, work->kernel, numbers);
    if (single)
        nodes_scatter(nodes, 1, work->kernel, nodes->n, single, 0);
    nodes_clear(nodes);
    return true;
}

bool row_layer_add(const struct row_layer *layer, const struct layer_point *point,
                   struct row_layer_work *work, double *single, double *numbers, double *turn)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    double image[4][3];
    bool turned[4], complete;
    int images = layer_images(&layer->surface, point, image, turned);
    layer_look(&layer->surface, point, images, (const double(*)[3])image, &work->layer);
    complete =
        add_far(layer, images, (const double(*)[3])image, turned, work, single, numbers, turn);
    for (int i = 0; i < images && complete; i++) {
        layer_near_nodes(&layer->surface, point, i, image[i], &work->layer);
        complete =
            add_own(layer, &work->layer.nodes, image[i], turned[i], work, single, numbers, turn);
    }
    layer_singular_nodes(&layer->surface, point, &work->layer);
    return complete &&
           add_own(layer, &work->layer.singular, origin, false, work, single, numbers, turn);
}
