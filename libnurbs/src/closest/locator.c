/* Closest points of a surface by a tree of bounding boxes: the leaves are parts of its Bezier
 * patches, whose control points bound them (convex hull), and each level above joins 2 x 2. */
#include "closest/closest_proof.h"
#include "core/error.h"

#include <nurbs/basis.h>
#include <nurbs/invert.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>

enum { MAX_LEVELS = 48 };

struct nurbs_locator {
    nurbs_surface *surface, *leaves; /* as given, and as the Bezier patches of the leaves */
    size_t *starts[2];               /* first control points of the leaves */
    int levels;
    size_t size[MAX_LEVELS][2];
    double *bounds[MAX_LEVELS]; /* [size 0][size 1][6]: low and high corner */
    double *breaks[2];          /* parameters between the leaves */
};

void nurbs_locator_free(nurbs_locator *locator)
{
    if (!locator)
        return;
    nurbs_surface_free(locator->surface);
    nurbs_surface_free(locator->leaves);
    free(locator->starts[0]);
    free(locator->starts[1]);
    for (int k = 0; k < locator->levels; k++)
        free(locator->bounds[k]);
    free(locator->breaks[0]);
    free(locator->breaks[1]);
    free(locator);
}

static void join(double bounds[6], const double low[3], const double high[3])
{
    for (int c = 0; c < 3; c++) {
        bounds[c] = fmin(bounds[c], low[c]);
        bounds[3 + c] = fmax(bounds[3 + c], high[c]);
    }
}

static double *new_bounds(size_t n)
{
    double *bounds = malloc(6 * n * sizeof *bounds);
    for (size_t i = 0; bounds && i < 6 * n; i++)
        bounds[i] = i % 6 < 3 ? HUGE_VAL : -HUGE_VAL;
    return bounds;
}

/* First control point of each Bezier segment: the knots before it counted with multiplicity. */
static nurbs_status leaf_starts(const struct axis *axis, double **breaks, size_t **starts,
                                size_t *count)
{
    *breaks = malloc((axis->size + 2) * sizeof **breaks);
    *starts = malloc((axis->size + 2) * sizeof **starts);
    if (!*breaks || !*starts)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to locate in %zu spans", axis->size);
    *count = 0;
    for (size_t s = (size_t)axis->degree; s < axis->size; s++)
        if (axis->knots[s] < axis->knots[s + 1]) {
            (*starts)[*count] = s - (size_t)axis->degree;
            (*breaks)[(*count)++] = axis->knots[s];
            (*breaks)[*count] = axis->knots[s + 1];
        }
    return NURBS_OK;
}

static nurbs_status make_leaves(const nurbs_surface *bezier, nurbs_locator *l)
{
    nurbs_status status = NURBS_OK;
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = leaf_starts(&bezier->axis[d], &l->breaks[d], &l->starts[d], &l->size[0][d]);
    if (status == NURBS_OK) {
        l->bounds[0] = new_bounds(l->size[0][0] * l->size[0][1]);
        if (!l->bounds[0])
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu boxes", l->size[0][0],
                                l->size[0][1]);
    }
    const size_t pu = (size_t)bezier->axis[0].degree, pv = (size_t)bezier->axis[1].degree;
    double *box = l->bounds[0];
    for (size_t i = 0; status == NURBS_OK && i < l->size[0][0]; i++)
        for (size_t j = 0; j < l->size[0][1]; j++, box += 6)
            for (size_t a = 0; a <= pu; a++)
                for (size_t b = 0; b <= pv; b++) {
                    const double *p =
                        bezier->points +
                        3 * ((l->starts[0][i] + a) * bezier->axis[1].size + l->starts[1][j] + b);
                    join(box, p, p);
                }
    return status;
}

static nurbs_status make_levels(nurbs_locator *l)
{
    l->levels = 1;
    while (l->size[l->levels - 1][0] > 1 || l->size[l->levels - 1][1] > 1) {
        const int k = l->levels;
        const size_t *below = l->size[k - 1];
        l->size[k][0] = (below[0] + 1) / 2;
        l->size[k][1] = (below[1] + 1) / 2;
        l->bounds[k] = new_bounds(l->size[k][0] * l->size[k][1]);
        if (!l->bounds[k])
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu boxes", l->size[k][0],
                              l->size[k][1]);
        l->levels++;
        for (size_t i = 0; i < below[0]; i++)
            for (size_t j = 0; j < below[1]; j++) {
                const double *box = l->bounds[k - 1] + 6 * (i * below[1] + j);
                join(l->bounds[k] + 6 * (i / 2 * l->size[k][1] + j / 2), box, box + 3);
            }
    }
    return NURBS_OK;
}

/* Cuts the spans of one direction of a net of Bezier patches, more finely where it turns more. */
static nurbs_status cut_spans(const nurbs_surface *bezier, int direction, nurbs_surface **result)
{
    const struct axis *axis = &bezier->axis[direction];
    const size_t p = (size_t)axis->degree, n1 = bezier->axis[1].size;
    const size_t stride = direction == 0 ? 3 * n1 : 3, across = direction == 0 ? 3 : 3 * n1;
    double *u = malloc(10 * axis->size * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to locate in %zu spans", axis->size);
    size_t n = 0;
    for (size_t s = p; s < axis->size; s++) {
        const double low = axis->knots[s], high = axis->knots[s + 1];
        int parts = 0;
        for (size_t j = 0; low < high && j < bezier->axis[1 - direction].size; j++) {
            double first = 0.0, second = 0.0;
            closest_differences(p + 1, stride, bezier->points + (s - p) * stride + j * across,
                                &first, &second);
            const int here = closest_parts(first, second);
            parts = here > parts ? here : parts;
        }
        for (int k = 1; k < parts; k++) {
            const double knot = low + (high - low) * ((double)k / parts);
            if (knot > low && knot < high && (n == 0 || knot > u[n - 1]))
                u[n++] = knot;
        }
    }
    nurbs_status status = nurbs_surface_insert(bezier, direction, n, u, result);
    free(u);
    return status;
}

nurbs_status nurbs_locator_create(const nurbs_surface *surface, nurbs_locator **locator)
{
    if (!surface || !locator)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", surface ? "locator" : "surface");
    *locator = NULL;
    nurbs_locator *l = calloc(1, sizeof *l);
    if (!l)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a locator");
    nurbs_surface *bezier = NULL, *half = NULL, *cut = NULL;
    nurbs_status status = nurbs_surface_copy(surface, &l->surface);
    if (status == NURBS_OK)
        status = nurbs_surface_to_bezier(surface, &bezier);
    if (status == NURBS_OK)
        status = cut_spans(bezier, 1, &half);
    if (status == NURBS_OK)
        status = cut_spans(half, 0, &cut);
    if (status == NURBS_OK)
        status = nurbs_surface_to_bezier(cut, &l->leaves);
    if (status == NURBS_OK)
        status = make_leaves(l->leaves, l);
    if (status == NURBS_OK)
        status = make_levels(l);
    nurbs_surface_free(bezier);
    nurbs_surface_free(half);
    nurbs_surface_free(cut);
    if (status != NURBS_OK)
        nurbs_locator_free(l);
    else
        *locator = l;
    return status;
}

struct node {
    int level;
    size_t i, j;
    double nearest; /* squared distance of its box */
};

/* Pushes the children of a node, the nearest last so that it is visited first. */
static size_t push_children(const nurbs_locator *l, const struct node *node, const double point[3],
                            struct node *stack, size_t height)
{
    const int level = node->level - 1;
    const size_t first = height;
    for (size_t a = 0; a < 4; a++) {
        struct node child = {level, 2 * node->i + a / 2, 2 * node->j + a % 2, 0.0};
        if (child.i >= l->size[level][0] || child.j >= l->size[level][1])
            continue;
        child.nearest = distance_to_bounds(point, l->bounds[level] +
                                                      6 * (child.i * l->size[level][1] + child.j));
        size_t at = height++;
        for (; at > first && stack[at - 1].nearest < child.nearest; at--)
            stack[at] = stack[at - 1];
        stack[at] = child;
    }
    return height;
}

static double search_box(const void *context, const struct box2 *box, const double point[3],
                         double uv[2])
{
    return closest_in_box(context, box, point, uv);
}

static double prove_leaf(const nurbs_locator *l, size_t i, size_t j, const double point[3],
                         double best, double uv[2], size_t *cells)
{
    const struct axis *axis = l->leaves->axis;
    const struct bezier_patch patch = {
        {(size_t)axis[0].degree + 1, (size_t)axis[1].degree + 1},
        l->leaves->net + 4 * (l->starts[0][i] * axis[1].size + l->starts[1][j]),
        4 * axis[1].size,
        {{l->breaks[0][i], l->breaks[1][j]}, {l->breaks[0][i + 1], l->breaks[1][j + 1]}}};
    return closest_prove(&patch, point, search_box, l->surface, best, uv, cells);
}

static double closest(const nurbs_locator *l, const double point[3], double uv[2])
{
    struct node stack[4 * MAX_LEVELS];
    size_t height = 1, cells = CLOSEST_CELLS;
    double best = HUGE_VAL;
    stack[0] = (struct node){l->levels - 1, 0, 0, 0.0};
    while (height > 0) {
        const struct node node = stack[--height];
        if (node.nearest >= best)
            continue;
        if (node.level > 0)
            height = push_children(l, &node, point, stack, height);
        else
            best = prove_leaf(l, node.i, node.j, point, best, uv, &cells);
    }
    /* A minimum next to the edge of a leaf may lie immaterially beyond it. */
    struct box2 domain;
    double at[2] = {uv[0], uv[1]};
    for (int d = 0; d < 2; d++) {
        domain.low[d] = l->surface->axis[d].knots[0];
        domain.high[d] = l->surface->axis[d].knots[l->surface->axis[d].size];
    }
    const double square = closest_in_box(l->surface, &domain, point, at);
    if (square < best) {
        best = square;
        uv[0] = at[0];
        uv[1] = at[1];
    }
    return best;
}

nurbs_status nurbs_locator_closest(const nurbs_locator *locator, size_t n, const double *points,
                                   double *uv, double *distance)
{
    nurbs_status status = closest_check(locator, n, points, uv);
    if (status != NURBS_OK)
        return status;
    for (size_t i = 0; i < n; i++) {
        const double square = closest(locator, points + 3 * i, uv + 2 * i);
        if (distance)
            distance[i] = sqrt(square);
    }
    return NURBS_OK;
}

nurbs_status nurbs_surface_closest(const nurbs_surface *surface, size_t n, const double *points,
                                   double *uv, double *distance)
{
    nurbs_locator *locator;
    nurbs_status status = closest_check(surface, n, points, uv);
    if (status == NURBS_OK)
        status = nurbs_locator_create(surface, &locator);
    if (status != NURBS_OK)
        return status;
    status = nurbs_locator_closest(locator, n, points, uv, distance);
    nurbs_locator_free(locator);
    return status;
}
