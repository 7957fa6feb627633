#include "tangent/base_change.h"

#include "core/constants.h"
#include "core/vector_math.h"
#include "exterior/base_flow.h"
#include "solve/linear.h"
#include "space/quadrature_near.h"
#include "tangent/contract.h"
#include "tangent/row_layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As plane_field.c has it: second derivatives want rules for so much of the tolerance. */
static const double finer = 1e-3;

enum { FLOW = 5 }; /* derivatives of Phi along x, y, xx, xy, yy */

struct flow {
    const igabem_tangent *tangent;
    const struct shape *shape;
    const struct influence *hull;
    struct influence *face;
    size_t layers, n; /* n: unknowns of Phi */
    struct row_layer layer[2];
    double *phi;        /* [n] coefficients of Phi */
    double *numbers;    /* [shape.size][width] changes, of phi of the rim those of Phi */
    double *phi_change; /* [n][width] */
};

static void flow_free(struct flow *flow)
{
    for (size_t k = 0; k < flow->layers; k++)
        row_layer_free(&flow->layer[k]);
    influence_free(flow->face);
    free(flow->phi);
    free(flow->numbers);
    free(flow->phi_change);
}

/* Phi once more, with the factors of its system, and the layers that carry it. */
static igabem_status create(struct flow *flow, double *factors, int *pivots)
{
    const igabem_tangent *tangent = flow->tangent;
    const struct transom *transom = flow->shape->transom;
    const struct matrix matrix = {flow->n, flow->n, factors, flow->hull->threads, NULL};
    igabem_status status = IGABEM_OK;
    if (transom)
        status = influence_create(flow->hull->density, transom->face, flow->hull->tolerance,
                                  flow->hull->threads, &flow->face);
    if (status == IGABEM_OK)
        status = base_flow_system(flow->hull, transom, flow->face, factors, flow->phi);
    if (status == IGABEM_OK)
        status = linear_lu_factor(&matrix, pivots, NULL);
    if (status == IGABEM_OK)
        status = linear_lu_solve(&matrix, pivots, false, 1, flow->phi);
    double *on_hull = malloc(flow->n * sizeof *on_hull);
    double *on_face = transom ? calloc(transom->coefficients, sizeof *on_face) : NULL;
    if (!on_hull || (transom && !on_face))
        status = tangent_no_memory(tangent->field->n);
    for (size_t j = 0; transom && j < transom->n && status == IGABEM_OK; j++)
        for (size_t l = transom->rim.start[j]; l < transom->rim.start[j + 1]; l++)
            on_face[j] += transom->rim.value[l] * flow->phi[transom->rim.column[l]];
    if (status != IGABEM_OK) {
        free(on_hull);
        free(on_face);
        return status;
    }
    memcpy(on_hull, flow->phi, flow->n * sizeof *on_hull);
    flow->layers = transom ? 2 : 1;
    status =
        row_layer_create(tangent, flow->shape, ROW_HULL, flow->hull, 1.0, on_hull, &flow->layer[0]);
    if (transom && status == IGABEM_OK)
        status = row_layer_create(tangent, flow->shape, ROW_FACE, flow->face, 0.0, on_face,
                                  &flow->layer[1]);
    else if (transom)
        free(on_face);
    return status;
}

/* Changes of what else moves the layers. */
static igabem_status change_numbers(struct flow *flow)
{
    const struct field *field = flow->tangent->field;
    size_t n = field->n;
    double *change = calloc(flow->shape->size * n, sizeof *change);
    igabem_status status =
        change ? shape_lines(flow->tangent, flow->shape, change) : tangent_no_memory(n);
    if (status == IGABEM_OK && flow->shape->transom)
        status = shape_rim_change(flow->tangent, flow->shape, flow->phi, change);
    for (size_t k = 0; k < flow->shape->size && status == IGABEM_OK; k++)
        memcpy(flow->numbers + k * field->width, change + k * n, n * sizeof *change);
    free(change);
    return status;
}

/* Phi' on the hull: the change of its rows with Phi fixed, through its system. */
static igabem_status change_phi(struct flow *flow, double *factors, const int *pivots)
{
    const struct field *field = flow->tangent->field;
    size_t n = flow->n, fields = field->n, width = field->controls + flow->shape->size;
    double *right = malloc(n * fields * sizeof *right);
    bool failed = !right;
#pragma omp parallel num_threads(flow->hull->threads) reduction(| : failed)
    {
        struct row_layer_work work[2];
        double *row = malloc(CONTRACT_ROWS * width * sizeof *row);
        double *sum = malloc(CONTRACT_ROWS * fields * sizeof *sum);
        double *point = malloc(CONTRACT_ROWS * field->points * sizeof *point);
        memset(work, 0, sizeof work);
        failed |= !row || !sum || !point;
        for (size_t k = 0; k < flow->layers; k++)
            failed |= !row_layer_work_create(&flow->layer[k], &work[k]);
#pragma omp for schedule(dynamic, 1)
        for (size_t i = 0; i < n; i += CONTRACT_ROWS) {
            size_t count = n - i < CONTRACT_ROWS ? n - i : CONTRACT_ROWS;
            if (failed)
                continue;
            memset(row, 0, CONTRACT_ROWS * width * sizeof *row);
            memset(sum, 0, CONTRACT_ROWS * fields * sizeof *sum);
            for (size_t r = 0; r < count; r++) {
                static const double none[2] = {0.0, 0.0};
                struct layer_point place;
                double turn = 0.0, *to = row + r * width;
                layer_place(flow->hull, i + r, &place);
                const struct layer_point off = {.at = {place.at[0], place.at[1], place.at[2]}};
                failed |= !row_layer_add(&flow->layer[0], &place, &work[0], NULL, to, &turn);
                if (flow->layers > 1)
                    failed |= !row_layer_add(&flow->layer[1], &off, &work[1], NULL,
                                             to + field->controls, &turn);
                fold_point(&field->mesh->element[place.home[0]], place.local[0], turn, none,
                           to + field->offset[place.home[0]]);
            }
            for (size_t r = 0; r < CONTRACT_ROWS; r++)
                field_points_of(field, row + r * width, point + r * field->points);
            contract(field->points, point, field->points, field->point, field->width, fields, sum);
            contract(flow->shape->size, row + field->controls, width, flow->numbers, field->width,
                     fields, sum);
            for (size_t r = 0; r < count; r++)
                for (size_t f = 0; f < fields; f++)
                    right[f * n + i + r] = sum[r * fields + f];
        }
        for (size_t k = 0; k < flow->layers; k++)
            row_layer_work_free(&work[k]);
        free(row);
        free(sum);
        free(point);
    }
    igabem_status status = failed ? tangent_no_memory(fields) : IGABEM_OK;
    const struct matrix matrix = {n, n, factors, flow->hull->threads, NULL};
    if (status == IGABEM_OK)
        status = linear_lu_solve(&matrix, pivots, false, fields, right);
    for (size_t f = 0; f < fields && status == IGABEM_OK; f++)
        for (size_t j = 0; j < n; j++)
            flow->phi_change[j * field->width + f] = right[f * n + j];
    free(right);
    /* From here on the rim follows it. */
    const struct transom *transom = flow->shape->transom;
    for (size_t j = 0; transom && j < transom->n && status == IGABEM_OK; j++)
        for (size_t l = transom->rim.start[j]; l < transom->rim.start[j + 1]; l++)
            for (size_t f = 0; f < fields; f++)
                flow->numbers[(flow->shape->rim + j) * field->width + f] +=
                    transom->rim.value[l] *
                    flow->phi_change[transom->rim.column[l] * field->width + f];
    return status;
}

/* Derivatives of s = 1/r along axes, R = P - Q: s_ab, s_abc, s_abcd, and s_a. */
struct powers {
    double r[3], s3, s5, s7, s9;
};

VECTOR_INLINE double first(const struct powers *p, int a)
{
    return -p->r[a] * p->s3;
}

VECTOR_INLINE double second(const struct powers *p, int a, int b)
{
    return 3.0 * p->r[a] * p->r[b] * p->s5 - (a == b ? p->s3 : 0.0);
}

VECTOR_INLINE double third(const struct powers *p, int a, int b, int c)
{
    const double *r = p->r;
    double mixed = (a == b ? r[c] : 0.0) + (a == c ? r[b] : 0.0) + (b == c ? r[a] : 0.0);
    return -15.0 * r[a] * r[b] * r[c] * p->s7 + 3.0 * mixed * p->s5;
}

VECTOR_INLINE double fourth(const struct powers *p, int a, int b, int c, int d)
{
    const double *r = p->r;
    double mixed = (a == b ? r[c] * r[d] : 0.0) + (a == c ? r[b] * r[d] : 0.0) +
                   (a == d ? r[b] * r[c] : 0.0) + (b == c ? r[a] * r[d] : 0.0) +
                   (b == d ? r[a] * r[c] : 0.0) + (c == d ? r[a] * r[b] : 0.0);
    double plain = (a == b && c == d ? 1.0 : 0.0) + (a == c && b == d ? 1.0 : 0.0) +
                   (a == d && b == c ? 1.0 : 0.0);
    return 105.0 * r[a] * r[b] * r[c] * r[d] * p->s9 - 15.0 * mixed * p->s7 + 3.0 * plain * p->s5;
}

/* Derivative k = x, y, xx, xy or yy of s, and along one and two axes more. */
VECTOR_INLINE double along_0(const struct powers *p, int k)
{
    return k < 2 ? first(p, k) : second(p, k == 4, k > 2);
}

VECTOR_INLINE double along_1(const struct powers *p, int k, int a)
{
    return k < 2 ? second(p, k, a) : third(p, k == 4, k > 2, a);
}

VECTOR_INLINE double along_2(const struct powers *p, int k, int a, int b)
{
    return k < 2 ? third(p, k, a, b) : fourth(p, k == 4, k > 2, a, b);
}

/* Adds derivative k of F = -q s - phi A.grad s (times 1/(2 pi), for the image in the still water)
 * at nodes as seen from p: kernels as row_layer_fold() takes them, with the sign of the derivative
 * where y of p is turned round, and to *turn what the move along y of the point itself counts for.
 */
VECTOR_MULTIVERSION
static void flow_kernels(int k, const double p[3], bool turned, const struct row_stretch *stretch,
                         double *restrict out, double *turn)
{
    const struct nodes *nodes = stretch->nodes;
    size_t n = stretch->n;
    const double *x = nodes->x + stretch->first, *y = nodes->y + stretch->first;
    const double *z = nodes->z + stretch->first, *column = stretch->column;
    const double *ax = column + ROW_AX * n, *ay = column + ROW_AY * n, *az = column + ROW_AZ * n;
    const double *cx = column + ROW_CX * n, *q = column + ROW_Q * n, *phi = column + ROW_PHI * n;
    const double *part = column + ROW_PHI_PART * n;
    double *value = out + ROW_D * n, *place = out + ROW_PLACE * n, *h = out + ROW_TURN * n;
    double scale = (turned && (k == 1 || k == 3) ? -1.0 : 1.0) / (2.0 * PI), sum = 0.0;
    /* No "omp simd": clang 14 would share w, which it keeps in memory, between turns of the loop.
     */
    for (size_t i = 0; i < n; i++) {
        struct powers w = {.r = {p[0] - x[i], p[1] - y[i], p[2] - z[i]}};
        double square = 1.0 / (w.r[0] * w.r[0] + w.r[1] * w.r[1] + w.r[2] * w.r[2]);
        w.s3 = square * sqrt(square);
        w.s5 = w.s3 * square;
        w.s7 = w.s5 * square;
        w.s9 = w.s7 * square;
        double source = -q[i] * scale, dipole = -phi[i] * scale;
        double move[3];
        for (int b = 0; b < 3; b++)
            move[b] = source * along_1(&w, k, b) +
                      dipole * (ax[i] * along_2(&w, k, 0, b) + ay[i] * along_2(&w, k, 1, b) +
                                az[i] * along_2(&w, k, 2, b));
        place[i] -= move[0];
        place[n + i] -= move[1];
        place[2 * n + i] -= move[2];
        value[i] += scale * (ax[i] * along_1(&w, k, 0) + ay[i] * along_1(&w, k, 1) +
                             az[i] * along_1(&w, k, 2));
        h[i] -= scale * (cx[i] * along_0(&w, k) + part[i] * along_1(&w, k, 0));
        h[n + i] -= scale * part[i] * along_1(&w, k, 1);
        h[2 * n + i] -= scale * part[i] * along_1(&w, k, 2);
        sum += move[1];
    }
    *turn += turned ? -sum : sum;
}

/* Work of a thread: five rows over Phi on the hull, the hull's control values and the numbers. */
struct flow_work {
    struct layer_work layer;
    struct row_nodes near;
    double *kernel;
    size_t capacity;
};

static bool add_stretch(const struct flow *flow, size_t l, const struct row_stretch *stretch,
                        const struct regular_rule *rule, const double p[3], bool turned,
                        struct flow_work *work, double *row, size_t width, double turn[FLOW])
{
    const struct row_layer *layer = &flow->layer[l];
    size_t n = stretch->n, skip = l == 0 ? flow->n : flow->n + flow->tangent->field->controls;
    if ((ROW_KERNELS + 1) * n > work->capacity) {
        free(work->kernel);
        work->capacity = 2 * (ROW_KERNELS + 1) * n;
        work->kernel = malloc(work->capacity * sizeof *work->kernel);
    }
    if (!work->kernel) {
        work->capacity = 0;
        return n == 0;
    }
    for (int k = 0; k < FLOW; k++) {
        double *to = row + (size_t)k * width, *kernel = work->kernel;
        memset(kernel, 0, ROW_KERNELS * n * sizeof *kernel);
        switch (k) { /* a constant in each, for the compiler */
        case 0:
            flow_kernels(0, p, turned, stretch, kernel, &turn[0]);
            break;
        case 1:
            flow_kernels(1, p, turned, stretch, kernel, &turn[1]);
            break;
        case 2:
            flow_kernels(2, p, turned, stretch, kernel, &turn[2]);
            break;
        case 3:
            flow_kernels(3, p, turned, stretch, kernel, &turn[3]);
            break;
        default:
            flow_kernels(4, p, turned, stretch, kernel, &turn[4]);
        }
        row_layer_fold(layer, stretch, kernel, to + skip);
        if (l > 0)
            continue;
        /* Against the basis: the rules hold the area with it. */
        double *scatter = kernel + ROW_KERNELS * n;
        for (size_t i = 0; i < n; i++) {
            const double *column = stretch->column + i;
            double area = sqrt(column[ROW_AX * n] * column[ROW_AX * n] +
                               column[ROW_AY * n] * column[ROW_AY * n] +
                               column[ROW_AZ * n] * column[ROW_AZ * n]);
            scatter[i] = area > 0 ? -kernel[ROW_D * n + i] / area : 0.0;
        }
        if (rule)
            regular_scatter(stretch->nodes->block[stretch->block].element, rule, 1, scatter, n, to,
                            0);
        else
            nodes_scatter(stretch->nodes, 1, scatter, n, to, 0);
    }
    return true;
}

static bool add_layer(const struct flow *flow, size_t l, const double at[2], struct flow_work *work,
                      double *row, size_t width, double turn[FLOW])
{
    const struct influence *influence = flow->layer[l].surface.influence;
    const struct mesh *mesh = influence->mesh;
    bool complete = true;
    for (int side = 0; side < 2 && complete; side++) {
        const double p[3] = {at[0], side ? -at[1] : at[1], 0.0};
        const struct near_rule near = {.point = {p[0], p[1], p[2]},
                                       .tolerance = finer * influence->tolerance,
                                       .gauss = &influence->gauss};
        struct row_stretch stretch;
        for (size_t k = 0; k < mesh->panels && complete; k++) {
            int class[2] = {0, 0};
            if (regular_class(influence, k, &near, class)) {
                const struct regular_rule *rule = regular_rule_of(influence, k, class);
                stretch = row_layer_rule(&flow->layer[l], (size_t)(rule - influence->regular));
                complete = add_stretch(flow, l, &stretch, rule, p, side, work, row, width, turn);
                continue;
            }
            for (size_t e = 0; e < mesh->panel[k].count; e++) {
                struct domain domain;
                domain_whole(&mesh->element[mesh->panel[k].first + e], &domain);
                near_nodes(&near, &domain, &work->layer.nodes);
            }
        }
        if (work->layer.nodes.n == 0 && !work->layer.nodes.failed)
            continue;
        complete = complete &&
                   row_layer_own(&flow->layer[l], &work->layer.nodes, &work->near, &stretch) &&
                   add_stretch(flow, l, &stretch, NULL, p, side, work, row, width, turn);
        nodes_clear(&work->layer.nodes);
    }
    return complete;
}

/* The changes at one cell: fills out[FLOW][fields]. */
static bool change_cell(const struct flow *flow, size_t cell, struct flow_work work[2], double *row,
                        double *point, double *sum, double *out)
{
    static const double middle[2] = {0.5, 0.5};
    const struct field *field = flow->tangent->field;
    const struct free_surface *surface = flow->shape->surface;
    const struct row_layer lines = {.kind = ROW_SURFACE, .shape = flow->shape};
    size_t width = flow->n + field->controls + flow->shape->size;
    double turn[FLOW] = {0.0};
    memset(row, 0, 2 * CONTRACT_ROWS * width * sizeof *row);
    memset(sum, 0, 2 * CONTRACT_ROWS * field->n * sizeof *sum);
    for (size_t l = 0; l < flow->layers; l++)
        if (!add_layer(flow, l, surface->point[cell].at, &work[l], row, width, turn))
            return false;
    for (size_t k = 0; k < FLOW; k++)
        row_layer_place(&lines, cell, middle, turn[k], row + k * width + flow->n + field->controls);
    for (size_t r = 0; r < FLOW; r += CONTRACT_ROWS) {
        double *from = row + r * width, *to = sum + r * field->n;
        contract(flow->n, from, width, flow->phi_change, field->width, field->n, to);
        for (size_t k = 0; k < CONTRACT_ROWS; k++)
            field_points_of(field, from + k * width + flow->n, point + k * field->points);
        contract(field->points, point, field->points, field->point, field->width, field->n, to);
        contract(flow->shape->size, from + flow->n + field->controls, width, flow->numbers,
                 field->width, field->n, to);
    }
    memcpy(out, sum, FLOW * field->n * sizeof *out);
    return true;
}

static igabem_status change_cells(const struct flow *flow, double *change)
{
    const struct field *field = flow->tangent->field;
    const struct free_surface *surface = flow->shape->surface;
    size_t width = flow->n + field->controls + flow->shape->size;
    bool failed = false;
#pragma omp parallel num_threads(flow->hull->threads) reduction(| : failed)
    {
        struct flow_work work[2];
        double *row = malloc(2 * CONTRACT_ROWS * width * sizeof *row);
        double *sum = malloc(2 * CONTRACT_ROWS * field->n * sizeof *sum);
        double *point = malloc(CONTRACT_ROWS * field->points * sizeof *point);
        memset(work, 0, sizeof work);
        failed |= !row || !sum || !point;
        for (size_t l = 0; l < flow->layers; l++) {
            failed |= layer_work_create(&flow->layer[l].surface, &work[l].layer) != IGABEM_OK;
            work[l].layer.nodes.with_jets = true;
        }
#pragma omp for schedule(dynamic, 4)
        for (size_t c = 0; c < surface->nx * surface->ny; c++)
            if (!failed)
                failed |=
                    !change_cell(flow, c, work, row, point, sum, change + FLOW * field->n * c);
        for (size_t l = 0; l < flow->layers; l++) {
            layer_work_free(&work[l].layer);
            row_nodes_free(&work[l].near);
            free(work[l].kernel);
        }
        free(row);
        free(sum);
        free(point);
    }
    return failed ? tangent_no_memory(field->n) : IGABEM_OK;
}

igabem_status base_change(const igabem_tangent *tangent, const struct shape *shape,
                          const struct influence *hull, double **result)
{
    const struct field *field = tangent->field;
    size_t n = hull->density->n, cells = shape->surface->nx * shape->surface->ny;
    struct flow flow = {.tangent = tangent,
                        .shape = shape,
                        .hull = hull,
                        .n = n,
                        .phi = malloc(n * sizeof(double)),
                        .numbers = calloc(shape->size * field->width, sizeof(double)),
                        .phi_change = calloc(n * field->width, sizeof(double))};
    double *factors = malloc(n * n * sizeof *factors);
    int *pivots = malloc(n * sizeof *pivots);
    *result = malloc(FLOW * cells * field->n * sizeof **result);
    igabem_status status = tangent_no_memory(field->n);
    if (flow.phi && flow.numbers && flow.phi_change && factors && pivots && *result)
        status = create(&flow, factors, pivots);
    if (status == IGABEM_OK)
        status = change_numbers(&flow);
    if (status == IGABEM_OK)
        status = change_phi(&flow, factors, pivots);
    if (status == IGABEM_OK)
        status = change_cells(&flow, *result);
    flow_free(&flow);
    free(factors);
    free(pivots);
    return status;
}
