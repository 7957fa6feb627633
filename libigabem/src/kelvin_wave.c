/* The wave part W, its gradient and its second derivatives on the contour of kelvin_contour.h. */
#include "error.h"
#include "kelvin_domain.h"
#include "kelvin_windows.h"

#include <igabem/kelvin.h>

#include <math.h>

/* Sums kept: W, W_X, W_Y, W_Z, or W_Z, W_XY, W_XZ, W_YZ, W_ZZ. */
enum { MOST_SUMS = 5 };

/* Adds eight nodes to the sums. A derivative multiplies the integrand by i C, i C S, C^2. */
KELVIN_INLINE void add_nodes(const struct kelvin_wave_points *p, const kelvin_vec *e,
                             const kelvin_vec *g, const kelvin_bits *inside, enum kelvin_kind kind,
                             kelvin_vec *sum)
{
    struct kelvin_nodes nodes;
    kelvin_vec size, sine, cosine, floor = {0};
    kelvin_place_nodes(p, e, g, kind, KELVIN_FULL, &nodes);
    floor -= 700;
    kelvin_vec exponent = KELVIN_MAX(nodes.f.re, floor);
    kelvin_vexp(&exponent, &size);
    size = (kelvin_vec)((kelvin_bits)size & *inside);
    kelvin_vsincos(&nodes.f.im, &sine, &cosine);
    struct kelvin_complex C = nodes.C, C2 = nodes.C2, CS = nodes.CS;
    /* w = e^f C dv/du. */
    kelvin_vec re = size * cosine, im = size * sine;
    kelvin_vec wr = re * C.re - im * C.im, wi = re * C.im + im * C.re;
    re = wr - wi * nodes.slope;
    im = wi + wr * nodes.slope;
    if (kind == KELVIN_SECOND_DERIVATIVES) {
        kelvin_vec zr = re * C2.re - im * C2.im, zi = re * C2.im + im * C2.re;
        kelvin_vec xr = re * C.re - im * C.im, xi = re * C.im + im * C.re;
        sum[0] += zi;
        sum[1] -= xr * CS.im + xi * CS.re;
        sum[2] += zr * C.re - zi * C.im;
        sum[3] += zr * CS.re - zi * CS.im;
        sum[4] += zr * C2.im + zi * C2.re;
    } else {
        sum[0] += im;
        sum[1] += re * C.re - im * C.im;
        sum[2] += re * CS.re - im * CS.im;
        sum[3] += re * C2.im + im * C2.re;
    }
}

/* Trapezoid sums of one point over one window. */
KELVIN_INLINE void add_window(const struct kelvin_wave_points *p, double low, double high,
                              double step, enum kelvin_kind kind, double *out)
{
    if (!(high > low))
        return;
    kelvin_vec sum[MOST_SUMS] = {{0}}, e, g, jump = {8 * step, -8 * step}, ratio;
    kelvin_vec index = {0, 1, 2, 3, 4, 5, 6, 7}, u = low + step * index, minus = -u;
    long count = (long)((high - low) / step) + 1;
    kelvin_vexp(&u, &e);
    kelvin_vexp(&minus, &g);
    kelvin_vexp(&jump, &ratio);
    double up = ratio[0], down = ratio[1];
    for (long k = 0; k < count; k += KELVIN_LANES) {
        kelvin_bits inside = KELVIN_LESS(index, (double)(count - k));
        add_nodes(p, &e, &g, &inside, kind, sum);
        e *= up;
        g *= down;
    }
    for (int k = 0; k < MOST_SUMS; k++)
        out[k] += 4 * step * kelvin_add_lanes(&sum[k]);
}

/* The sums for up to eight points with x > 0, y >= 0. */
KELVIN_INLINE void wave_of_lanes(const struct kelvin_wave_points *points, size_t n,
                                 enum kelvin_kind kind, double (*out)[MOST_SUMS])
{
    struct kelvin_window window[2];
    kelvin_find_windows(points, kind, &window[0], &window[1]);
    for (size_t i = 0; i < n; i++) {
        kelvin_vec zero = {0};
        struct kelvin_wave_points p = {zero + points->x[i], zero + points->y[i],
                                       zero + points->z[i], points->e2};
        for (int k = 0; k < MOST_SUMS; k++)
            out[i][k] = 0;
        for (int k = 0; k < 2; k++)
            add_window(&p, window[k].low[i], window[k].high[i], window[k].step[i], kind, out[i]);
    }
}

/* Where results go: W, W_X, W_Y, W_Z, or W_XX, W_XY, W_XZ, W_YY, W_YZ, W_ZZ. */
struct outputs {
    double *to[6];
};

/* sign: of Y, 0 on the centre plane, where the odd derivatives vanish. */
KELVIN_INLINE void write_point(const struct outputs *out, size_t i, double sign, const double *sum,
                               enum kelvin_kind kind)
{
    double gradient[6] = {sum[0], sum[1], sign * sum[2], sum[3]};
    double second[6] = {-sum[0], sign * sum[1], sum[2], sum[0] - sum[4], sign * sum[3], sum[4]};
    for (int k = 0; k < 6; k++)
        if (out->to[k])
            out->to[k][i] = kind == KELVIN_SECOND_DERIVATIVES ? second[k] : gradient[k];
}

/* Points behind the source, waiting for a full vector. */
struct queue {
    size_t n, at[KELVIN_LANES];
    double sign[KELVIN_LANES];
    struct kelvin_wave_points points;
};

KELVIN_INLINE void flush(struct queue *queue, enum kelvin_kind kind, const struct outputs *out)
{
    double sum[KELVIN_LANES][MOST_SUMS];
    wave_of_lanes(&queue->points, queue->n, kind, sum);
    for (size_t k = 0; k < queue->n; k++)
        write_point(out, queue->at[k], queue->sign[k], sum[k], kind);
    queue->n = 0;
}

KELVIN_INLINE void wave_batch(size_t n, const double *X, const double *Y, const double *Z,
                              double depth, double e2, enum kelvin_kind kind,
                              const struct outputs *out)
{
    static const double nothing[MOST_SUMS] = {0};
    kelvin_vec one = {0};
    one += 1;
    struct queue queue = {0, {0}, {0}, {one, one, one, e2}};
    for (size_t i = 0; i < n; i++) {
        if (X[i] < 0) {
            queue.points.x[queue.n] = -X[i];
            queue.points.y[queue.n] = fabs(Y[i]);
            queue.points.z[queue.n] = fmax(-Z[i], depth);
            queue.sign[queue.n] = (Y[i] > 0) - (Y[i] < 0);
            queue.at[queue.n++] = i;
        } else
            write_point(out, i, 0, nothing, kind);
        if (queue.n == KELVIN_LANES || (i + 1 == n && queue.n > 0))
            flush(&queue, kind, out);
    }
}

KELVIN_MULTIVERSION
static void plain_batch(size_t n, const double *X, const double *Y, const double *Z, double depth,
                        const struct outputs *out)
{
    wave_batch(n, X, Y, Z, depth, 0, KELVIN_PLAIN, out);
}

KELVIN_MULTIVERSION
static void filtered_batch(size_t n, const double *X, const double *Y, const double *Z,
                           double depth, double e2, const struct outputs *out)
{
    wave_batch(n, X, Y, Z, depth, e2, KELVIN_FILTERED, out);
}

KELVIN_MULTIVERSION
static void second_batch(size_t n, const double *X, const double *Y, const double *Z,
                         const struct outputs *out)
{
    wave_batch(n, X, Y, Z, 0, 0, KELVIN_SECOND_DERIVATIVES, out);
}

igabem_status igabem_kelvin_wave(size_t n, const double *X, const double *Y, const double *Z,
                                 double *W, double *WX, double *WY, double *WZ)
{
    return igabem_kelvin_wave_filtered(n, X, Y, Z, NULL, W, WX, WY, WZ);
}

void igabem_kelvin_filter_init(igabem_kelvin_filter *filter)
{
    *filter = (igabem_kelvin_filter){0, 0};
}

igabem_status igabem_kelvin_wave_filtered(size_t n, const double *X, const double *Y,
                                          const double *Z, const igabem_kelvin_filter *filter,
                                          double *W, double *WX, double *WY, double *WZ)
{
    igabem_kelvin_filter none = {0, 0};
    struct outputs out = {{W, WX, WY, WZ}};
    if (!filter)
        filter = &none;
    if (!(filter->cut_off >= 0) || !isfinite(filter->cut_off))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave filter: cut_off is %g, expected finite and >= 0", filter->cut_off);
    if (!(filter->depth >= 0) || !isfinite(filter->depth))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave filter: depth is %g, expected finite and >= 0", filter->depth);
    igabem_status status = kelvin_check_wave_domain("kelvin wave part", n, X, Y, Z);
    if (status != IGABEM_OK)
        return status;
    if (filter->cut_off > 0) {
        double e = 1 / (1 + filter->cut_off * filter->cut_off);
        filtered_batch(n, X, Y, Z, filter->depth, e * e, &out);
    } else
        plain_batch(n, X, Y, Z, filter->depth, &out);
    return IGABEM_OK;
}

igabem_status igabem_kelvin_wave_second(size_t n, const double *X, const double *Y, const double *Z,
                                        double *WXX, double *WXY, double *WXZ, double *WYY,
                                        double *WYZ, double *WZZ)
{
    struct outputs out = {{WXX, WXY, WXZ, WYY, WYZ, WZZ}};
    igabem_status status = kelvin_check_wave_domain("kelvin wave part", n, X, Y, Z);
    if (status == IGABEM_OK)
        second_batch(n, X, Y, Z, &out);
    return status;
}
