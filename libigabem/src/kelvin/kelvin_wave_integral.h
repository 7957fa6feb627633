/* The integral of W, its gradient or its second derivatives on the contour of kelvin_contour.h: the
 * body of one kernel of kelvin_wave_kernel.h, included once for each instruction set with
 * KELVIN_WAVE_KERNEL as its name. */
#include "kelvin/kelvin_wave_kernel.h"
#include "kelvin/kelvin_windows.h"

#include <math.h>
#include <stdbool.h>

/* Sums kept: W, W_X, W_Y, W_Z, or W_Z, W_XY, W_XZ, W_YZ, W_ZZ. */
enum { MOST_SUMS = 5 };

/* Adds the nodes n->q in the lanes `inside` to the sums, each times *weight. A
 * derivative multiplies the integrand by i C, i C S, C^2. */
KELVIN_INLINE void add_nodes(const struct kelvin_wave_points *p, struct kelvin_nodes *n,
                             const kelvin_bits *inside, const kelvin_vec *weight,
                             enum kelvin_kind kind, kelvin_vec *sum)
{
    kelvin_vec size, sine, cosine, floor = {0};
    kelvin_place_nodes(p, kind, KELVIN_FULL, n);
    floor -= 700;
    kelvin_vec exponent = KELVIN_MAX(n->f.re, floor);
    kelvin_vexp(&exponent, &size);
    size = (kelvin_vec)((kelvin_bits)size & *inside);
    kelvin_vsincos(&n->f.im, &sine, &cosine);
    struct kelvin_complex C = n->C, C2 = n->C2, CS = n->CS, g;
    size *= *weight;
    /* g = e^f C dv/dq. */
    g.re = size * cosine;
    g.im = size * sine;
    kelvin_multiply(&g, &C, &g);
    kelvin_multiply(&g, &n->dv, &g);
    if (kind == KELVIN_SECOND_DERIVATIVES) {
        struct kelvin_complex gx, gz;
        kelvin_multiply(&g, &C, &gx);
        kelvin_multiply(&g, &C2, &gz);
        sum[0] += gz.im;
        sum[1] -= gx.re * CS.im + gx.im * CS.re;
        sum[2] += gz.re * C.re - gz.im * C.im;
        sum[3] += gz.re * CS.re - gz.im * CS.im;
        sum[4] += gz.re * C2.im + gz.im * C2.re;
    } else {
        sum[0] += g.im;
        sum[1] += g.re * C.re - g.im * C.im;
        sum[2] += g.re * CS.re - g.im * CS.im;
        sum[3] += g.re * C2.im + g.im * C2.re;
    }
}

/* One window of one of the points in hand. */
struct job {
    size_t point;
    double low, step;
    int count; /* a multiple of 8 */
    bool curved;
};

/* Two numbers, one in the lower and one in the upper eight lanes. */
KELVIN_INLINE void put_side_by_side(double a, double b, kelvin_vec *v)
{
    const kelvin_bits lower = {~UINT64_C(0), ~UINT64_C(0), ~UINT64_C(0), ~UINT64_C(0),
                               ~UINT64_C(0), ~UINT64_C(0), ~UINT64_C(0), ~UINT64_C(0)};
    kelvin_vec zero = {0}, va = zero + a, vb = zero + b;
    *v = KELVIN_SELECT(lower, va, vb);
}

/* Trapezoid sums over two windows side by side, b's count >= a's. */
KELVIN_INLINE void add_windows(const struct kelvin_wave_points *points, const struct job *a,
                               const struct job *b, enum kelvin_kind kind, kelvin_vec *sum)
{
    const kelvin_vec index = {0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7};
    struct kelvin_wave_points p;
    kelvin_vec low, step, count, one = {0};
    one += 1;
    p.e2 = points->e2;
    put_side_by_side(points->x[a->point], points->x[b->point], &p.x);
    put_side_by_side(points->y[a->point], points->y[b->point], &p.y);
    put_side_by_side(points->z[a->point], points->z[b->point], &p.z);
    put_side_by_side(a->low, b->low, &low);
    put_side_by_side(a->step, b->step, &step);
    put_side_by_side(a->count, b->count, &count);
    for (int k = 0; k < b->count; k += KELVIN_OCTET) {
        struct kelvin_nodes nodes;
        kelvin_vec place = index + (double)k;
        kelvin_bits inside = KELVIN_LESS(place, count);
        nodes.q = low + step * place;
        kelvin_vec slope = one;
        if (b->curved) {
            kelvin_vec up, down = -nodes.q;
            kelvin_vexp(&nodes.q, &up);
            kelvin_vexp(&down, &down);
            slope = 0.5 * (up + down);
            nodes.q = 0.5 * (up - down);
        }
        add_nodes(&p, &nodes, &inside, &slope, kind, sum);
    }
}

KELVIN_INLINE void add_job(const struct job *job, const kelvin_vec *sum, int first,
                           double (*out)[MOST_SUMS])
{
    for (int k = 0; k < MOST_SUMS; k++)
        out[job->point][k] += 4 * job->step * kelvin_add_octet(&sum[k], first);
}

/* Sorted by curved and count, so that neighbours take the same time. */
KELVIN_INLINE void queue_job(struct job *job, int n, const struct job *new)
{
    int at = n, key = new->count + (new->curved << 24);
    for (; at > 0 && job[at - 1].count + (job[at - 1].curved << 24) > key; at--)
        job[at] = job[at - 1];
    job[at] = *new;
}

/* The jobs of the point in the given lane of `windows`. */
KELVIN_INLINE int queue_point(const struct kelvin_windows *windows, int lane, size_t point,
                              struct job *job, int n)
{
    for (int part = 0; part < 2; part++) {
        const struct kelvin_window *w = &windows->part[part];
        double low = w->low[lane], length = w->high[lane] - low;
        if (!(length > 0))
            continue;
        int count = ((int)(length / w->step[lane]) + KELVIN_OCTET) & -KELVIN_OCTET;
        struct job new = {point, low, length / (count - 1), count, windows->curved[lane] != 0};
        queue_job(job, n++, &new);
    }
    return n;
}

/* Fewer points than this are probed one by one. */
enum { FEW = 3 };

/* The sums for up to sixteen points with x > 0, y >= 0. */
KELVIN_INLINE void wave_of_lanes(const struct kelvin_wave_points *points, size_t n,
                                 enum kelvin_kind kind, double (*out)[MOST_SUMS])
{
    struct job job[2 * KELVIN_LANES];
    struct kelvin_windows windows;
    int jobs = 0;
    memset(out, 0, n * sizeof *out);
    /* One copy of the search for both ways: it is most of the code. */
    bool alone = n < FEW;
    for (size_t i = 0; i < n; i += alone ? 1 : n) {
        kelvin_vec zero = {0};
        struct kelvin_wave_points p = *points;
        if (alone) {
            p.x = zero + points->x[i];
            p.y = zero + points->y[i];
            p.z = zero + points->z[i];
        }
        kelvin_find_windows(&p, alone, kind, &windows);
        for (size_t k = i; k < (alone ? i + 1 : n); k++)
            jobs = queue_point(&windows, (int)(k - i), k, job, jobs);
    }
    for (int i = 0; i < jobs; i++) {
        kelvin_vec sum[MOST_SUMS] = {{0}};
        bool pair = i + 1 < jobs && job[i].curved == job[i + 1].curved;
        add_windows(points, &job[i], &job[i + pair], kind, sum);
        add_job(&job[i], sum, 0, out);
        if (pair)
            add_job(&job[++i], sum, KELVIN_OCTET, out);
    }
}

/* sign: of Y, 0 on the centre plane, where the odd derivatives vanish. */
KELVIN_INLINE void write_point(const struct kelvin_wave_call *call, size_t i, double sign,
                               const double *sum, enum kelvin_kind kind)
{
    double gradient[6] = {sum[0], sum[1], sign * sum[2], sum[3]};
    double second[6] = {-sum[0], sign * sum[1], sum[2], sum[0] - sum[4], sign * sum[3], sum[4]};
    for (int k = 0; k < 6; k++)
        if (call->to[k])
            call->to[k][i] = kind == KELVIN_SECOND_DERIVATIVES ? second[k] : gradient[k];
}

/* Points behind the source, waiting for a full vector. */
struct queue {
    size_t n, at[KELVIN_LANES];
    double sign[KELVIN_LANES];
    struct kelvin_wave_points points;
};

KELVIN_INLINE void flush(struct queue *queue, enum kelvin_kind kind,
                         const struct kelvin_wave_call *call)
{
    double sum[KELVIN_LANES][MOST_SUMS];
    wave_of_lanes(&queue->points, queue->n, kind, sum);
    for (size_t k = 0; k < queue->n; k++)
        write_point(call, queue->at[k], queue->sign[k], sum[k], kind);
    queue->n = 0;
}

/* kind and e2 again: known at compile time. */
KELVIN_INLINE void wave_batch(const struct kelvin_wave_call *call, enum kelvin_kind kind, double e2)
{
    static const double nothing[MOST_SUMS] = {0};
    kelvin_vec one = {0};
    one += 1;
    struct queue queue = {0, {0}, {0}, {one, one, one, e2}};
    for (size_t i = 0; i < call->n; i++) {
        if (call->X[i] < 0) {
            queue.points.x[queue.n] = -call->X[i];
            queue.points.y[queue.n] = fabs(call->Y[i]);
            queue.points.z[queue.n] = fmax(-call->Z[i], call->depth);
            queue.sign[queue.n] = (call->Y[i] > 0) - (call->Y[i] < 0);
            queue.at[queue.n++] = i;
        } else
            write_point(call, i, 0, nothing, kind);
        if (queue.n == KELVIN_LANES || (i + 1 == call->n && queue.n > 0))
            flush(&queue, kind, call);
    }
}

KELVIN_OUTLINE void plain_batch(const struct kelvin_wave_call *call)
{
    wave_batch(call, KELVIN_PLAIN, 0);
}

KELVIN_OUTLINE void filtered_batch(const struct kelvin_wave_call *call)
{
    wave_batch(call, KELVIN_FILTERED, call->e2);
}

KELVIN_OUTLINE void second_batch(const struct kelvin_wave_call *call)
{
    wave_batch(call, KELVIN_SECOND_DERIVATIVES, 0);
}

void KELVIN_WAVE_KERNEL(const struct kelvin_wave_call *call)
{
    if (call->kind == KELVIN_PLAIN)
        plain_batch(call);
    else if (call->kind == KELVIN_FILTERED)
        filtered_batch(call);
    else
        second_batch(call);
}
