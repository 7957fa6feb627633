/* With a cell's control points Q = N - w P relative to the point, g = |Q|^2 - d w^2 has the sign of
 * the squared distance less d. Its Bernstein coefficients bound it: none negative, and the cell
 * holds nothing nearer than sqrt(d). Where those of its second derivatives prove it convex, with d
 * that of a local minimum in the cell, g is zero with a vanishing gradient (or one that points out
 * of the cell) there and so nowhere negative. Other cells are cut in four. */
#include "closest/closest_proof.h"

#include <nurbs/basis.h>

#include <float.h>
#include <math.h>
#include <string.h>

enum { ORDER = NURBS_MAX_DEGREE + 1, SQUARE = 2 * NURBS_MAX_DEGREE + 1, DEPTH = 26 };

/* A cell is let go when it cannot improve the squared distance by more than this part. */
static const double immaterial = 1e-9;

struct cell {
    double low[2], high[2]; /* in the patch, 0 to 1 */
    int depth;
};

/* Bernstein coefficients of |Q|^2 and w^2 over a cell. */
struct squares {
    size_t size[2];
    double distance[SQUARE * SQUARE], weight[SQUARE * SQUARE], largest;
};

/* The control points of one line over [low, high]: two cuts by de Casteljau. */
static void restrict_line(size_t count, size_t step, double low, double high, double *b)
{
    for (size_t k = 1; k < count; k++) /* to [0, high] */
        for (size_t i = count - 1; i >= k; i--)
            for (size_t c = 0; c < 4; c++)
                b[i * step + c] = (1.0 - high) * b[(i - 1) * step + c] + high * b[i * step + c];
    const double t = high > 0.0 ? low / high : 0.0; /* then to its part from low on */
    for (size_t k = 1; k < count; k++)
        for (size_t i = 0; i + k < count; i++)
            for (size_t c = 0; c < 4; c++)
                b[i * step + c] = (1.0 - t) * b[i * step + c] + t * b[(i + 1) * step + c];
}

/* Control points of a cell, relative to the point. */
static void cell_net(const struct bezier_patch *patch, const struct cell *cell,
                     const double point[3], double *net)
{
    const size_t p = patch->order[0], q = patch->order[1];
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < q; j++) {
            const double *from = patch->net + i * patch->stride + 4 * j;
            double *to = net + 4 * (i * q + j);
            for (size_t c = 0; c < 3; c++)
                to[c] = from[c] - from[3] * point[c];
            to[3] = from[3];
        }
    if (cell->depth == 0)
        return;
    for (size_t j = 0; j < q; j++)
        restrict_line(p, 4 * q, cell->low[0], cell->high[0], net + 4 * j);
    for (size_t i = 0; i < p && q > 1; i++)
        restrict_line(q, 4, cell->low[1], cell->high[1], net + 4 * i * q);
}

static void binomials(size_t order, double *row)
{
    row[0] = 1.0;
    for (size_t k = 1; k < order; k++)
        row[k] = row[k - 1] * (double)(order - k) / (double)k;
}

/* Products of scaled coefficients (Farouki and Rajan 1988). */
static void square_net(const size_t order[2], double *net, struct squares *s)
{
    double choose[2][ORDER], twice[2][SQUARE];
    const size_t p = order[0], q = order[1];
    for (int d = 0; d < 2; d++) {
        s->size[d] = 2 * order[d] - 1;
        binomials(order[d], choose[d]);
        binomials(s->size[d], twice[d]);
    }
    const size_t m = s->size[1], count = s->size[0] * m;
    memset(s->distance, 0, count * sizeof(double));
    memset(s->weight, 0, count * sizeof(double));
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < q; j++)
            for (size_t c = 0; c < 4; c++)
                net[4 * (i * q + j) + c] *= choose[0][i] * choose[1][j];
    for (size_t i = 0; i < p; i++)
        for (size_t k = 0; k < p; k++)
            for (size_t j = 0; j < q; j++)
                for (size_t l = 0; l < q; l++) {
                    const double *a = net + 4 * (i * q + j), *b = net + 4 * (k * q + l);
                    s->distance[(i + k) * m + j + l] += a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
                    s->weight[(i + k) * m + j + l] += a[3] * b[3];
                }
    s->largest = 0.0;
    for (size_t i = 0; i < s->size[0]; i++)
        for (size_t j = 0; j < m; j++) {
            const double scale = 1.0 / (twice[0][i] * twice[1][j]);
            s->distance[i * m + j] *= scale;
            s->weight[i * m + j] *= scale;
            s->largest = fmax(s->largest, fabs(s->distance[i * m + j]));
        }
}

/* Nothing in the cell is nearer than the root of d by more than an immaterial part. */
static int none_nearer(const struct squares *s, double d)
{
    const double rounding = 64.0 * DBL_EPSILON * s->largest;
    for (size_t k = 0; k < s->size[0] * s->size[1]; k++)
        if (s->distance[k] - d * (1.0 - immaterial) * s->weight[k] < -rounding)
            return 0;
    return 1;
}

static int is_convex(const struct squares *s, double d)
{
    const size_t n = s->size[0], m = s->size[1];
    const double factor[2] = {(double)((n - 1) * (n - 2)), (double)((m - 1) * (m - 2))};
    double g[SQUARE * SQUARE], uu = HUGE_VAL, vv = HUGE_VAL, uv = 0.0;
    for (size_t k = 0; k < n * m; k++)
        g[k] = s->distance[k] - d * s->weight[k];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < m; j++) {
            const double *x = g + i * m + j;
            if (i + 2 < n)
                uu = fmin(uu, factor[0] * (x[0] - 2.0 * x[m] + x[2 * m]));
            if (j + 2 < m)
                vv = fmin(vv, factor[1] * (x[0] - 2.0 * x[1] + x[2]));
            if (i + 1 < n && j + 1 < m)
                uv = fmax(uv, (double)((n - 1) * (m - 1)) * fabs(x[0] - x[1] - x[m] + x[m + 1]));
        }
    const double rounding = 256.0 * DBL_EPSILON * s->largest * (factor[0] + factor[1]);
    if (m == 1)
        return uu > rounding;
    return uu > rounding && vv > rounding && (uu - rounding) * (vv - rounding) > uv * uv;
}

static struct box2 cell_box(const struct bezier_patch *patch, const struct cell *cell)
{
    struct box2 box;
    for (int d = 0; d < 2; d++) {
        const double width = patch->box.high[d] - patch->box.low[d];
        box.low[d] =
            cell->low[d] == 0.0 ? patch->box.low[d] : patch->box.low[d] + cell->low[d] * width;
        box.high[d] =
            cell->high[d] == 1.0 ? patch->box.high[d] : patch->box.low[d] + cell->high[d] * width;
    }
    return box;
}

static size_t push_parts(const struct cell *cell, int directions, struct cell *stack, size_t height)
{
    for (int k = 0; k < (directions == 2 ? 4 : 2); k++) {
        struct cell part = *cell;
        part.depth++;
        for (int d = 0; d < directions; d++) {
            const double middle = 0.5 * (cell->low[d] + cell->high[d]);
            *(k >> d & 1 ? &part.low[d] : &part.high[d]) = middle;
        }
        stack[height++] = part;
    }
    return height;
}

double closest_prove(const struct bezier_patch *patch, const double point[3], closest_search search,
                     const void *context, double best, double uv[2], size_t *cells)
{
    const int directions = patch->order[1] > 1 ? 2 : 1;
    double net[4 * ORDER * ORDER];
    struct squares s;
    struct cell stack[3 * DEPTH + 4];
    size_t height = 1;
    stack[0] = (struct cell){{0.0, 0.0}, {1.0, 1.0}, 0};
    while (height > 0 && *cells > 0) {
        const struct cell cell = stack[--height];
        --*cells;
        cell_net(patch, &cell, point, net);
        square_net(patch->order, net, &s);
        if (best < HUGE_VAL && none_nearer(&s, best))
            continue;
        const struct box2 box = cell_box(patch, &cell);
        double at[2] = {0.5 * (box.low[0] + box.high[0]), 0.5 * (box.low[1] + box.high[1])};
        const double square = search(context, &box, point, at);
        if (square < best) {
            best = square;
            uv[0] = at[0];
            uv[1] = at[1];
        }
        if (cell.depth < DEPTH && !is_convex(&s, square) && !none_nearer(&s, best))
            height = push_parts(&cell, directions, stack, height);
    }
    return best;
}
