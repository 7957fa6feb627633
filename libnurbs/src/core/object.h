/* The objects behind nurbs_curve and nurbs_surface, shared by the sources of the library. */
#ifndef NURBS_OBJECT_H
#define NURBS_OBJECT_H

#include <nurbs/curve.h>
#include <nurbs/surface.h>

#include <stdint.h>

/* One parameter direction. `bucket` divides the domain into equal parts and holds the span at the
 * left end of each, so that finding a span takes constant time for usual knot vectors. */
struct axis {
    int degree;
    size_t size;
    double *knots;    /* size + degree + 1 */
    double *inverse;  /* 1 / (t[e+1] - t[e+1-q]) at (q - 1) * stride + e, degrees q = 1 ... */
    size_t buckets;   /* number of parts */
    double scale;     /* buckets / length of the domain */
    uint32_t *bucket; /* buckets + 1 */
};

/* `net` holds the homogeneous control points (w x, w y, w z, w) at a stride of 4, w = 1 for a
 * polynomial: what evaluation reads. All arrays live in one allocation with the object. */
struct nurbs_curve {
    struct axis axis;
    double *points;
    double *weights; /* NULL: polynomial */
    double *net;
};

struct nurbs_surface {
    struct axis axis[2];
    double *points;
    double *weights;
    double *net;
};

/* The largest net that is accepted: sizes in bytes then stay far from overflow. */
#define NURBS_MAX_POINTS ((size_t)1 << 40)

/* A cursor through one allocation whose parts start on cache lines. */
static inline size_t padded(size_t bytes)
{
    return (bytes + 63) / 64 * 64;
}

static inline void *take(char **cursor, size_t bytes)
{
    void *part = *cursor;
    *cursor += padded(bytes);
    return part;
}

/* Bytes that axis_place takes from the cursor. */
size_t axis_bytes(int degree, size_t size);
void axis_place(struct axis *axis, int degree, size_t size, const double *knots, char **cursor);

/* Bytes of the net, the points and the weights of n control points. */
static inline size_t net_bytes(size_t n)
{
    return padded(4 * n * sizeof(double)) + padded(3 * n * sizeof(double)) +
           padded(n * sizeof(double));
}

/* A surface with its knots checked and copied; points, weights (rational) and net are the caller's
 * to fill. */
nurbs_status surface_reserve(const int degree[2], const size_t size[2],
                             const double *const knots[2], int rational, nurbs_surface **surface);

/* Checks n control points and their weights (NULL: none). */
nurbs_status points_check(size_t n, const double *points, const double *weights);

/* net = (w p, w) of n points. */
void homogenize(size_t n, const double *points, const double *weights, double *net);

/* Of a row of axis.inverse. */
static inline size_t axis_stride(const struct axis *axis)
{
    return axis->size + (size_t)axis->degree;
}

/* Checks the arguments that every change of a surface has, and clears the result. */
nurbs_status modify_check(const nurbs_surface *surface, int direction, nurbs_surface **result);

/* Span of u, which must lie in the domain. */
static inline size_t axis_span(const struct axis *axis, double u)
{
    const double *t = axis->knots;
    size_t part = (size_t)((u - t[0]) * axis->scale);
    part = part < axis->buckets ? part : axis->buckets - 1;
    size_t low = axis->bucket[part];
    const size_t high = axis->bucket[part + 1] + 1; /* rounding may move u over one boundary */
    if (high - low > 8) {
        size_t last = high < axis->size ? high : axis->size;
        while (last - low > 1) {
            const size_t middle = low + (last - low) / 2;
            if (u < t[middle])
                last = middle;
            else
                low = middle;
        }
    }
    while (u < t[low])
        low--;
    while (low + 1 < axis->size && u >= t[low + 1])
        low++;
    return low;
}

/* Span whose right end is u if u is an interior knot, given span = axis_span(u); else that span. */
static inline size_t axis_span_left(const struct axis *axis, size_t span, double u)
{
    const double *t = axis->knots;
    if (u != t[span] || u == t[0])
        return span;
    do
        span--;
    while (t[span] == u);
    return span;
}

#endif
