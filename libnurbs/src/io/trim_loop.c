#include "io/trim_loop.h"

#include "core/constants.h"
#include "core/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDES = 4, SAMPLES = 24 };

static const double corner_angle = 20 * PI / 180;
static const double kink_angle = 1 * PI / 180;

/* A coordinate serves as parameter of a side whose speed along the side never falls below this
 * share of its mean. */
static const double least_speed = 0.25;

bool trim_loop_turns(const loop_part *part)
{
    return fabs(part->turn) > corner_angle;
}

static double metres(const trim_loop *loop, const double a[2], const double b[2])
{
    return hypot(loop->stretch[0] * (b[0] - a[0]), loop->stretch[1] * (b[1] - a[1]));
}

/* Place x in [0,1] of a part; derivative with respect to x if not NULL. */
void trim_loop_point(const loop_part *part, double x, double uv[2], double *derivative)
{
    double c[6] = {0}, length = part->to - part->from;
    double t = x == 1 ? part->to : part->from + x * length;
    if (part->curve && (t == part->from) == (length > 0))
        nurbs_curve_eval(part->curve, 1, 1, &t, c);
    else if (part->curve) /* the limit from inside a part that ends at a knot */
        nurbs_curve_eval_left(part->curve, 1, 1, &t, c);
    for (int d = 0; d < 2; d++) {
        uv[d] = c[d] + (1 - x) * part->shift[0][d] + x * part->shift[1][d];
        if (derivative)
            derivative[d] = length * c[3 + d] + part->shift[1][d] - part->shift[0][d];
    }
}

/* Mean |Su| and |Sv| over the domain: makes lengths and angles in the plane resemble those on the
 * surface, yet stays regular where an edge of the surface has collapsed. */
static nurbs_status find_stretch(trim_loop *loop)
{
    enum { N = 8 };
    double t[2][N], s[9 * N * N];
    for (int d = 0; d < 2; d++)
        for (int k = 0; k < N; k++)
            t[d][k] = loop->low[d] + (loop->high[d] - loop->low[d]) * (k + 0.5) / N;
    nurbs_status status = nurbs_surface_eval_grid(loop->surface, 1, N, t[0], N, t[1], s);
    if (status != NURBS_OK)
        return status;
    for (size_t k = 0; k < N * N; k++)
        for (size_t d = 0; d < 2; d++) {
            const double *a = s + 9 * k + 3 + 3 * d;
            loop->stretch[d] += sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) / (N * N);
        }
    if (!(loop->stretch[0] > 0 && loop->stretch[1] > 0))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "the trimmed surface has collapsed to a line");
    return NURBS_OK;
}

static loop_part *append(trim_loop *loop)
{
    if (loop->count == loop->room) {
        size_t room = loop->room ? 2 * loop->room : 16;
        loop_part *larger = realloc(loop->part, room * sizeof *larger);
        if (!larger)
            return NULL;
        loop->part = larger;
        loop->room = room;
    }
    loop_part *part = &loop->part[loop->count++];
    *part = (loop_part){0};
    return part;
}

/* The smooth parts of a curve: between the knots at which it may have a kink. */
static nurbs_status append_curve(trim_loop *loop, const nurbs_curve *curve, int backwards)
{
    size_t p = (size_t)nurbs_curve_degree(curve), size = nurbs_curve_size(curve),
           first = loop->count;
    const double *t = nurbs_curve_knots(curve);
    double from = t[0];
    for (size_t k = p + 1; k <= size; k++) {
        if (k < size && (t[k] != t[k + p - 1] || t[k] == from))
            continue;
        loop_part *part = append(loop);
        if (!part)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a loop of %zu curves",
                              loop->count);
        part->curve = curve;
        part->from = backwards ? t[k] : from;
        part->to = backwards ? from : t[k];
        from = t[k];
    }
    for (size_t a = first, b = loop->count - 1; backwards && a < b; a++, b--) {
        loop_part swapped = loop->part[a];
        loop->part[a] = loop->part[b];
        loop->part[b] = swapped;
    }
    return NURBS_OK;
}

static void curve_ends(const nurbs_curve *curve, double ends[2][2])
{
    const double *p = nurbs_curve_points(curve), *last = p + 3 * (nurbs_curve_size(curve) - 1);
    memcpy(ends[0], p, 2 * sizeof *p);
    memcpy(ends[1], last, 2 * sizeof *p);
}

/* Appends all curves, each in the direction in which it continues the one before. */
static nurbs_status append_curves(trim_loop *loop, size_t n, const nurbs_curve *const *curves)
{
    double here[2] = {0, 0};
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        double ends[2][2], next[2][2];
        int backwards = 0;
        curve_ends(curves[k], ends);
        if (k > 0) {
            backwards = metres(loop, here, ends[1]) < metres(loop, here, ends[0]);
        } else if (n > 2) {
            curve_ends(curves[1], next);
            backwards = fmin(metres(loop, ends[0], next[0]), metres(loop, ends[0], next[1])) <
                        fmin(metres(loop, ends[1], next[0]), metres(loop, ends[1], next[1]));
        }
        memcpy(here, ends[!backwards], sizeof here);
        status = append_curve(loop, curves[k], backwards);
    }
    return status;
}

static nurbs_status space_point(const trim_loop *loop, const double uv[2], double p[3])
{
    double inside[2];
    for (int d = 0; d < 2; d++) {
        double slack = 1e-6 * (loop->high[d] - loop->low[d]);
        if (!(uv[d] >= loop->low[d] - slack && uv[d] <= loop->high[d] + slack))
            return nurbs_fail(NURBS_ERROR_GEOMETRY,
                              "its loop leaves the surface at u = %.6g, v = %.6g", uv[0], uv[1]);
        inside[d] = fmin(fmax(uv[d], loop->low[d]), loop->high[d]);
    }
    return nurbs_surface_eval(loop->surface, 0, 1, inside, p);
}

/* Makes the end of part k and the start of the next one meet in the middle; where they are apart in
 * the plane but at one point of the surface (a collapsed edge), a line joins them. */
static nurbs_status close_joint(trim_loop *loop, size_t k)
{
    size_t next = (k + 1) % loop->count;
    double a[2], b[2], p[3], q[3];
    trim_loop_point(&loop->part[k], 1, a, NULL);
    trim_loop_point(&loop->part[next], 0, b, NULL);
    nurbs_status status = space_point(loop, a, p);
    if (status == NURBS_OK)
        status = space_point(loop, b, q);
    if (status != NURBS_OK)
        return status;
    double gap = sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                      (p[2] - q[2]) * (p[2] - q[2]));
    if (gap > loop->tolerance)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "its loop is open by %.3g m at u = %.6g, v = %.6g, more than the "
                          "tolerance",
                          gap, a[0], a[1]);
    loop->closed = fmax(loop->closed, gap);
    if (metres(loop, a, b) > 100 * loop->tolerance) {
        loop_part *line = append(loop);
        if (!line)
            return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a loop of %zu curves",
                              loop->count);
        memmove(loop->part + k + 2, loop->part + k + 1, (loop->count - k - 2) * sizeof *loop->part);
        line = &loop->part[k + 1];
        *line = (loop_part){.shift = {{a[0], a[1]}, {b[0], b[1]}}};
        return NURBS_OK;
    }
    for (int d = 0; d < 2; d++) {
        double middle = 0.5 * (a[d] + b[d]);
        loop->part[k].shift[1][d] += middle - a[d];
        loop->part[next].shift[0][d] += middle - b[d];
    }
    return NURBS_OK;
}

static nurbs_status close_joints(trim_loop *loop)
{
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < loop->count && status == NURBS_OK; k++) {
        size_t before = loop->count;
        status = close_joint(loop, k);
        k += loop->count - before; /* the inserted line already meets both */
    }
    return status;
}

/* Twice the area inside, positive when counterclockwise; fills the lengths of the parts. */
double trim_loop_measure(trim_loop *loop)
{
    double area = 0;
    for (size_t k = 0; k < loop->count; k++) {
        loop_part *part = &loop->part[k];
        double a[2], b[2];
        trim_loop_point(part, 0, a, NULL);
        part->length = 0;
        for (int i = 1; i <= SAMPLES; i++) {
            trim_loop_point(part, (double)i / SAMPLES, b, NULL);
            part->length += metres(loop, a, b);
            area += a[0] * b[1] - b[0] * a[1];
            memcpy(a, b, sizeof a);
        }
    }
    return area;
}

void trim_loop_reverse(trim_loop *loop)
{
    for (size_t k = 0; k < loop->count; k++) {
        loop_part *part = &loop->part[k];
        double shift[2] = {part->shift[0][0], part->shift[0][1]}, from = part->from;
        memcpy(part->shift[0], part->shift[1], sizeof shift);
        memcpy(part->shift[1], shift, sizeof shift);
        part->from = part->to;
        part->to = from;
    }
    for (size_t a = 0, b = loop->count - 1; a < b; a++, b--) {
        loop_part swapped = loop->part[a];
        loop->part[a] = loop->part[b];
        loop->part[b] = swapped;
    }
}

/* Direction at an end of a part, in metres; from a short chord where the speed vanishes. */
static void direction(const trim_loop *loop, const loop_part *part, int end, double out[2])
{
    double uv[2], inner[2];
    trim_loop_point(part, end, uv, out);
    for (int d = 0; d < 2; d++)
        out[d] *= loop->stretch[d];
    if (hypot(out[0], out[1]) > 1e-6 * part->length)
        return;
    trim_loop_point(part, end ? 0.99 : 0.01, inner, NULL);
    for (int d = 0; d < 2; d++)
        out[d] = loop->stretch[d] * (end ? uv[d] - inner[d] : inner[d] - uv[d]);
}

void trim_loop_find_turns(trim_loop *loop)
{
    for (size_t k = 0; k < loop->count; k++) {
        double a[2], b[2];
        direction(loop, &loop->part[k], 1, a);
        direction(loop, &loop->part[(k + 1) % loop->count], 0, b);
        loop->part[k].turn = atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    }
}

/* Parts of no length (a bridge over a gap, a knot pair) would turn anyhow. */
static void drop_short_parts(trim_loop *loop)
{
    double total = 0;
    size_t kept = 0;
    for (size_t k = 0; k < loop->count; k++)
        total += loop->part[k].length;
    for (size_t k = 0; k < loop->count; k++)
        if (loop->part[k].length > 1e-9 * total)
            loop->part[kept++] = loop->part[k];
    loop->count = kept;
}

/* Fills the parts behind which the four corners lie. */
static nurbs_status find_corners(const trim_loop *loop, size_t corner[SIDES])
{
    size_t found = 0;
    for (size_t k = 0; k < loop->count; k++)
        if (trim_loop_turns(&loop->part[k])) {
            if (found < SIDES)
                corner[found] = k;
            found++;
        }
    return found == SIDES
               ? NURBS_OK
               : nurbs_fail(NURBS_ERROR_GEOMETRY, "its loop has %zu corners, expected four", found);
}

/* The side between corners a and b (parts behind which they lie). */
static nurbs_status start_side(const trim_loop *loop, size_t a, size_t b, loop_side *side)
{
    double total = 0, sum = 0;
    side->first = (a + 1) % loop->count;
    side->count = (b + loop->count - a - 1) % loop->count + 1;
    side->along = -1;
    side->share = malloc((side->count + 1) * sizeof *side->share);
    if (!side->share)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a side of %zu curves", side->count);
    for (size_t k = 0; k < side->count; k++)
        total += loop->part[(side->first + k) % loop->count].length;
    for (size_t k = 0; k < side->count; k++) {
        side->share[k] = sum / total;
        sum += loop->part[(side->first + k) % loop->count].length;
    }
    side->share[side->count] = 1;
    trim_loop_point(&loop->part[side->first], 0, side->start, NULL);
    trim_loop_point(&loop->part[b], 1, side->end, NULL);
    return NURBS_OK;
}

/* Whether coordinate d grows or falls along the whole side without slowing down much. */
static int runs_along(const trim_loop *loop, const loop_side *side, int d)
{
    double length = 0, extent = side->end[d] - side->start[d];
    for (size_t k = 0; k < side->count; k++)
        length += loop->part[(side->first + k) % loop->count].length;
    for (size_t k = 0; k < side->count; k++) {
        const loop_part *part = &loop->part[(side->first + k) % loop->count];
        double a[2], b[2];
        trim_loop_point(part, 0, a, NULL);
        for (int i = 1; i <= SAMPLES; i++) {
            trim_loop_point(part, (double)i / SAMPLES, b, NULL);
            if (!((b[d] - a[d]) / extent >= least_speed * metres(loop, a, b) / length))
                return 0;
            memcpy(a, b, sizeof a);
        }
    }
    return 1;
}

/* Opposite sides share their parameter, so that knot lines of the surface stay parameter lines. */
static void choose_parameter(const trim_loop *loop, loop_side *a, loop_side *b)
{
    double reach[2];
    for (int d = 0; d < 2; d++)
        reach[d] = runs_along(loop, a, d) && runs_along(loop, b, d)
                       ? loop->stretch[d] * fabs(a->end[d] - a->start[d])
                       : 0;
    int along = reach[0] >= reach[1] ? 0 : 1;
    if (!(reach[along] > 0))
        return;
    loop_side *const sides[2] = {a, b};
    for (int e = 0; e < 2; e++) {
        loop_side *side = sides[e];
        side->along = along;
        for (size_t k = 1; k < side->count; k++) {
            double uv[2];
            trim_loop_point(&loop->part[(side->first + k) % loop->count], 0, uv, NULL);
            side->share[k] =
                (uv[along] - side->start[along]) / (side->end[along] - side->start[along]);
        }
    }
}

/* The first side is the one that runs most in the direction of u, so that the patch is directed
 * like the surface. */
nurbs_status trim_loop_sides(trim_loop *loop, const size_t corner[4])
{
    size_t first = 0;
    double at[SIDES][2], best = -INFINITY;
    nurbs_status status = NURBS_OK;
    for (int k = 0; k < SIDES; k++) {
        free(loop->side[k].share);
        loop->side[k] = (loop_side){0};
    }
    for (size_t k = 0; k < SIDES; k++)
        trim_loop_point(&loop->part[corner[k]], 1, at[k], NULL);
    for (size_t k = 0; k < SIDES; k++) {
        double run =
            at[(k + 1) % SIDES][0] - at[k][0] + at[(k + 2) % SIDES][0] - at[(k + 3) % SIDES][0];
        if (run > best) {
            best = run;
            first = k;
        }
    }
    for (size_t k = 0; k < SIDES && status == NURBS_OK; k++)
        status = start_side(loop, corner[(first + k) % SIDES], corner[(first + k + 1) % SIDES],
                            &loop->side[k]);
    if (status != NURBS_OK)
        return status;
    choose_parameter(loop, &loop->side[0], &loop->side[2]);
    choose_parameter(loop, &loop->side[1], &loop->side[3]);
    return NURBS_OK;
}

nurbs_status trim_loop_open(const nurbs_surface *surface, size_t n,
                            const nurbs_curve *const *curves, double tolerance, trim_loop *loop)
{
    *loop = (trim_loop){.surface = surface, .tolerance = tolerance};
    for (int d = 0; d < 2; d++) {
        loop->low[d] = nurbs_surface_knots(surface, d)[0];
        loop->high[d] = nurbs_surface_knots(surface, d)[nurbs_surface_size(surface, d)];
    }
    nurbs_status status = find_stretch(loop);
    if (status == NURBS_OK)
        status = append_curves(loop, n, curves);
    if (status == NURBS_OK)
        status = close_joints(loop);
    if (status != NURBS_OK)
        return status;
    double area = trim_loop_measure(loop);
    if (area < 0)
        trim_loop_reverse(loop);
    drop_short_parts(loop);
    trim_loop_find_turns(loop);
    return NURBS_OK;
}

nurbs_status trim_loop_create(const nurbs_surface *surface, size_t n,
                              const nurbs_curve *const *curves, double tolerance, trim_loop *loop)
{
    size_t corner[SIDES];
    nurbs_status status = trim_loop_open(surface, n, curves, tolerance, loop);
    if (status == NURBS_OK)
        status = find_corners(loop, corner);
    return status == NURBS_OK ? trim_loop_sides(loop, corner) : status;
}

void trim_loop_free(trim_loop *loop)
{
    for (int k = 0; k < SIDES; k++)
        free(loop->side[k].share);
    free(loop->part);
    *loop = (trim_loop){0};
}

/* x in [0,1] at which coordinate d of a part is `value`: Newton's method kept in a bracket. */
static double find_coordinate(const loop_part *part, int d, double value, double guess)
{
    double low = 0, high = 1, x = guess, uv[2], slope[2], ends[2];
    trim_loop_point(part, 0, uv, NULL);
    ends[0] = uv[d];
    trim_loop_point(part, 1, uv, NULL);
    ends[1] = uv[d];
    for (int step = 0; step < 60; step++) {
        trim_loop_point(part, x, uv, slope);
        double error = uv[d] - value;
        if ((error < 0) == (ends[1] > ends[0]))
            low = x;
        else
            high = x;
        double next = x - error / slope[d];
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (fabs(next - x) <= 1e-15)
            break;
        x = next;
    }
    return x;
}

void trim_loop_side(const trim_loop *loop, const loop_side *side, double s, double uv[2])
{
    size_t k = 0;
    while (k + 1 < side->count && s > side->share[k + 1])
        k++;
    const loop_part *part = &loop->part[(side->first + k) % loop->count];
    double length = side->share[k + 1] - side->share[k],
           x = fmin(fmax((s - side->share[k]) / length, 0), 1);
    if (side->along >= 0 && x > 0 && x < 1) {
        int d = side->along;
        double value = side->start[d] + s * (side->end[d] - side->start[d]);
        x = find_coordinate(part, d, value, x);
        trim_loop_point(part, x, uv, NULL);
        uv[d] = value;
        return;
    }
    trim_loop_point(part, x, uv, NULL);
}

int trim_loop_kink(const trim_loop *loop, const loop_side *side, size_t k, double *s)
{
    *s = side->share[k + 1];
    return fabs(loop->part[(side->first + k) % loop->count].turn) > kink_angle || side->along < 0;
}
