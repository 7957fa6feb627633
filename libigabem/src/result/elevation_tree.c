#include "result/elevation_tree.h"

#include "core/constants.h"
#include "core/error.h"

#include <igabem/kelvin.h>

#include <math.h>
#include <stdlib.h>

enum { MAX_NODES = 4 /* interpolation nodes per dimension */ };

static const double SEPARATION = 3.0; /* a node is far at this many half diagonals */
static const double NEAR = 1.2;       /* a piece is near within this many diagonals */

struct node {
    size_t begin, end; /* pieces order[begin..end) */
    int child[2];      /* -1: leaf */
    double lower[3], upper[3];
    size_t proxies, first_proxy;
};

struct elevation_tree {
    const struct elevation_pieces *pieces;
    const struct point_set *set;
    const size_t *first;
    size_t *order;
    struct node *node;
    size_t n_nodes;
    struct point_set proxy;
};

static void node_bounds(const struct elevation_tree *tree, struct node *node)
{
    for (int k = 0; k < 3; k++) {
        node->lower[k] = INFINITY;
        node->upper[k] = -INFINITY;
    }
    for (size_t i = node->begin; i < node->end; i++) {
        const struct elevation_piece *piece = &tree->pieces->piece[tree->order[i]];
        for (int k = 0; k < 3; k++) {
            node->lower[k] = fmin(node->lower[k], piece->lower[k]);
            node->upper[k] = fmax(node->upper[k], piece->upper[k]);
        }
    }
}

/* Interpolation nodes of one side: fewer where the box is thin, for an even error. */
static int side_nodes(double side, double longest)
{
    if (side > 0.35 * longest)
        return 4;
    if (side > 0.08 * longest)
        return 3;
    return side > 0.001 * longest ? 2 : 1;
}

static void chebyshev(int n, double lower, double upper, double *nodes)
{
    for (int i = 0; i < n; i++)
        nodes[i] =
            0.5 * (lower + upper) + 0.5 * (upper - lower) * cos(PI * (2.0 * i + 1.0) / (2.0 * n));
}

static void lagrange(int n, const double *nodes, double x, double *values)
{
    for (int i = 0; i < n; i++) {
        values[i] = 1.0;
        for (int j = 0; j < n; j++)
            if (j != i)
                values[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
    }
}

/* Equivalent sources of a node. */
static bool add_proxies(struct elevation_tree *tree, struct node *node)
{
    double at[3][MAX_NODES], longest = 0.0;
    int count[3];
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, node->upper[k] - node->lower[k]);
    for (int k = 0; k < 3; k++) {
        count[k] = side_nodes(node->upper[k] - node->lower[k], longest);
        chebyshev(count[k], node->lower[k], node->upper[k], at[k]);
    }
    node->first_proxy = tree->proxy.n;
    node->proxies = (size_t)(count[0] * count[1] * count[2]);
    for (int a = 0; a < count[0]; a++)
        for (int b = 0; b < count[1]; b++)
            for (int c = 0; c < count[2]; c++)
                if (!point_set_add(&tree->proxy, at[0][a], at[1][b], at[2][c], 0.0))
                    return false;
    double *q = tree->proxy.q + node->first_proxy;
    for (size_t i = node->begin; i < node->end; i++) {
        size_t piece = tree->order[i];
        for (size_t j = tree->first[piece]; j < tree->first[piece + 1]; j++) {
            double l[3][MAX_NODES];
            lagrange(count[0], at[0], tree->set->x[j], l[0]);
            lagrange(count[1], at[1], tree->set->y[j], l[1]);
            lagrange(count[2], at[2], tree->set->z[j], l[2]);
            size_t k = 0;
            for (int a = 0; a < count[0]; a++)
                for (int b = 0; b < count[1]; b++)
                    for (int c = 0; c < count[2]; c++)
                        q[k++] += tree->set->q[j] * l[0][a] * l[1][b] * l[2][c];
        }
    }
    return true;
}

/* Orders the pieces of a node about the middle of its longest side; returns the dividing index. */
static size_t divide(struct elevation_tree *tree, const struct node *node)
{
    int longest = 0;
    for (int k = 1; k < 3; k++)
        if (node->upper[k] - node->lower[k] > node->upper[longest] - node->lower[longest])
            longest = k;
    double middle = 0.5 * (node->upper[longest] + node->lower[longest]);
    size_t low = node->begin, high = node->end;
    while (low < high) {
        const struct elevation_piece *piece = &tree->pieces->piece[tree->order[low]];
        if (0.5 * (piece->lower[longest] + piece->upper[longest]) < middle) {
            low++;
        } else {
            size_t swap = tree->order[--high];
            tree->order[high] = tree->order[low];
            tree->order[low] = swap;
        }
    }
    return low > node->begin && low < node->end ? low : node->begin + (node->end - node->begin) / 2;
}

/* Builds the subtree over order[begin..end); returns its index, -1 when out of memory. */
static int build(struct elevation_tree *tree, size_t begin, size_t end)
{
    int index = (int)tree->n_nodes++;
    struct node *node = &tree->node[index];
    *node = (struct node){.begin = begin, .end = end, .child = {-1, -1}};
    node_bounds(tree, node);
    if (!add_proxies(tree, node))
        return -1;
    if (end - begin == 1)
        return index;
    size_t middle = divide(tree, node);
    node->child[0] = build(tree, begin, middle);
    node->child[1] = build(tree, middle, end);
    return node->child[0] < 0 || node->child[1] < 0 ? -1 : index;
}

igabem_status elevation_tree_create(const struct elevation_pieces *pieces,
                                    const struct point_set *set, const size_t *first,
                                    struct elevation_tree **tree)
{
    struct elevation_tree *result = calloc(1, sizeof *result);
    *tree = NULL;
    if (result) {
        result->pieces = pieces;
        result->set = set;
        result->first = first;
        result->order = malloc(pieces->n * sizeof *result->order);
        result->node = malloc(2 * pieces->n * sizeof *result->node);
    }
    int built = result && result->order && result->node;
    for (size_t i = 0; built && i < pieces->n; i++)
        result->order[i] = i;
    if (built)
        built = build(result, 0, pieces->n) >= 0;
    if (!built) {
        elevation_tree_free(result);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a tree of %zu pieces", pieces->n);
    }
    *tree = result;
    return IGABEM_OK;
}

void elevation_tree_free(struct elevation_tree *tree)
{
    if (!tree)
        return;
    free(tree->order);
    free(tree->node);
    point_set_free(&tree->proxy);
    free(tree);
}

static double node_distance(const struct node *node, double x, double y)
{
    double p[3] = {x, y, 0.0}, square = 0.0;
    for (int k = 0; k < 3; k++) {
        double d = p[k] - 0.5 * (node->lower[k] + node->upper[k]);
        square += d * d;
    }
    return sqrt(square);
}

static double half_diagonal(const struct node *node)
{
    double square = 0.0;
    for (int k = 0; k < 3; k++)
        square += pow(0.5 * (node->upper[k] - node->lower[k]), 2);
    return sqrt(square);
}

static bool add_range(const struct point_set *from, size_t begin, size_t end, struct point_set *set)
{
    for (size_t j = begin; j < end; j++)
        if (!point_set_add(set, from->x[j], from->y[j], from->z[j], from->q[j]))
            return false;
    return true;
}

igabem_status elevation_cut_create(size_t pieces, struct elevation_cut *cut)
{
    *cut =
        (struct elevation_cut){{0}, calloc(pieces, sizeof(size_t)), calloc(pieces, sizeof(size_t))};
    if (cut->first && cut->last)
        return IGABEM_OK;
    elevation_cut_free(cut);
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu pieces", pieces);
}

void elevation_cut_free(struct elevation_cut *cut)
{
    point_set_free(&cut->set);
    free(cut->first);
    free(cut->last);
    *cut = (struct elevation_cut){{0}, NULL, NULL};
}

bool elevation_cut_line(const struct elevation_pieces *pieces, double x, struct elevation_cut *cut)
{
    point_set_clear(&cut->set);
    for (size_t i = 0; i < pieces->n; i++) {
        const struct elevation_piece *piece = &pieces->piece[i];
        cut->first[i] = cut->set.n;
        if (piece->lower[0] < x && x < piece->upper[0] &&
            !elevation_piece_sources(pieces, i, x, &cut->set))
            return false;
        cut->last[i] = cut->set.n;
    }
    return true;
}

/* Gathers the sources that stand for the tree as seen from (x, y, 0). */
static bool gather(const struct elevation_tree *tree, const struct elevation_cut *cut, int index,
                   double x, double y, struct point_set *set)
{
    const struct node *node = &tree->node[index];
    int divided = x > node->lower[0] && x < node->upper[0];
    if (!divided && node_distance(node, x, y) > SEPARATION * half_diagonal(node))
        return add_range(&tree->proxy, node->first_proxy, node->first_proxy + node->proxies, set);
    if (node->child[0] >= 0)
        return gather(tree, cut, node->child[0], x, y, set) &&
               gather(tree, cut, node->child[1], x, y, set);
    size_t piece = tree->order[node->begin];
    const struct elevation_piece *p = &tree->pieces->piece[piece];
    if (elevation_piece_distance(p, x, y) <= NEAR * p->diagonal)
        return elevation_piece_near_sources(tree->pieces, piece, x, y, set);
    if (divided)
        return add_range(&cut->set, cut->first[piece], cut->last[piece], set);
    return add_range(tree->set, tree->first[piece], tree->first[piece + 1], set);
}

/* Turns gathered sources into dimensionless offsets from (x, y, 0), in place. */
static void to_offsets(struct point_set *set, double k0, double x, double y)
{
    for (size_t j = 0; j < set->n; j++) {
        set->x[j] = k0 * (x - set->x[j]);
        set->y[j] = k0 * (y - set->y[j]);
        set->z[j] = k0 * fmin(set->z[j], 0.0);
    }
}

igabem_status elevation_tree_local(const struct elevation_tree *tree,
                                   const struct elevation_cut *cut, double k0, bool symmetric,
                                   double x, double y, struct point_set *scratch, double *sum)
{
    enum { BATCH = 256 };
    double gradient[BATCH];
    *sum = 0.0;
    for (int side = 0; side < (symmetric ? 2 : 1); side++) {
        double at = side ? -y : y;
        point_set_clear(scratch);
        if (!gather(tree, cut, 0, x, at, scratch))
            return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the sources near (%g, %g)", x,
                               y);
        to_offsets(scratch, k0, x, at);
        for (size_t begin = 0; begin < scratch->n; begin += BATCH) {
            size_t n = scratch->n - begin < BATCH ? scratch->n - begin : BATCH;
            igabem_status status =
                igabem_kelvin_local(n, scratch->x + begin, scratch->y + begin, scratch->z + begin,
                                    NULL, gradient, NULL, NULL);
            if (status)
                return status;
            for (size_t j = 0; j < n; j++)
                *sum += scratch->q[begin + j] * gradient[j];
        }
    }
    return IGABEM_OK;
}
