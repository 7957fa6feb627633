/* Which parts of the contour of kelvin_contour.h count, and the step of the trapezoid rule on them,
 * for sixteen points at once.
 *
 * Kept is where the level Re f + weight ln(1 + 2 q^2) exceeds -KELVIN_CUT; |C|^3 bounds every
 * weight of value and gradient (5 for second derivatives). The level falls to both sides of the
 * stationary points q1 <= q2 and may fall between them: one window or two, found from probes. Where
 * the exponent has frequency w and curvature c as functions of p, the integrand looks like a
 * Gaussian of height e^level with the spectrum exp(-(k-w)^2/(2c)); the trapezoid rule of step h
 * errs by the spectrum at 2 pi/h, so it asks for 2 pi/h > B = w + sqrt(2 c (KELVIN_CUT + level)).
 * With the strip in which the contour is analytic,
 *
 *     h = KELVIN_SAFETY 2 pi/sqrt(max B^2 + 2 KELVIN_STRIP KELVIN_CUT).
 *
 * The constants are fitted to errors below 1e-10 of max(1, |W|), max(1, |grad W|). */
#ifndef IGABEM_KELVIN_WINDOWS_H
#define IGABEM_KELVIN_WINDOWS_H

#include "core/constants.h"
#include "kelvin/kelvin_contour.h"

#include <stdbool.h>

#define KELVIN_CUT    25.5
#define KELVIN_SAFETY 0.96
/* Behind the source inside the wedge, outside it, and for q = sinh p, which is taken where the
 * contour reaches beyond q = -KELVIN_LONG. */
#define KELVIN_STRIP         14.0
#define KELVIN_STRIP_COMPLEX 80.0
#define KELVIN_STRIP_LONG    40.0
#define KELVIN_LONG          12.0

/* Nodes low, low + step, ... below high in p, per lane; empty where high <= low. */
struct kelvin_window {
    kelvin_vec low, high, step;
};

/* A lane of all ones where q = sinh p. */
struct kelvin_windows {
    struct kelvin_window part[2];
    kelvin_bits curved;
};

/* The power of |C| that bounds the weights. */
KELVIN_INLINE double kelvin_weight(enum kelvin_kind kind)
{
    return kind == KELVIN_SECOND_DERIVATIVES ? 5 : 3;
}

/* One place: w, c and what is left above the cut. */
struct kelvin_probe {
    kelvin_vec q, frequency, curvature, above;
};

KELVIN_OUTLINE void kelvin_probe_at(const struct kelvin_wave_points *p, const kelvin_bits *curved,
                                    const kelvin_vec *q, enum kelvin_kind kind,
                                    struct kelvin_probe *probe)
{
    struct kelvin_nodes nodes;
    kelvin_vec size = 1 + 2 * *q * *q, log, one = {0}, stretch;
    one += 1;
    nodes.q = probe->q = *q;
    kelvin_place_nodes(p, kind, KELVIN_ROUGH, &nodes);
    kelvin_bandwidth(p, &nodes, kind, &probe->frequency, &probe->curvature);
    stretch = KELVIN_SELECT(*curved, nodes.r, one);
    probe->frequency *= stretch;
    probe->curvature *= stretch * stretch;
    kelvin_vlog_rough(&size, &log);
    probe->above = nodes.f.re + kelvin_weight(kind) * log + KELVIN_CUT;
}

/* B of the rule above, zero below the cut. */
KELVIN_INLINE void kelvin_demand(const struct kelvin_probe *at, kelvin_vec *demand)
{
    kelvin_vec zero = {0}, square = 2 * at->curvature * at->above, root;
    square = KELVIN_MAX(square, zero) + 1e-280;
    kelvin_vrsqrt_to(&square, KELVIN_ROUGH, &root);
    *demand = KELVIN_SELECT(KELVIN_LESS(zero, at->above), at->frequency + square * root, zero);
}

/* The largest of *demand and of B at `to` and half way there, up to the cut at most. */
KELVIN_OUTLINE void kelvin_demand_between(const struct kelvin_probe *from,
                                          const struct kelvin_probe *to, kelvin_vec *demand)
{
    kelvin_vec one = {0}, zero = {0}, part, here;
    one += 1;
    part = from->above / (from->above - to->above);
    kelvin_bits leaves = KELVIN_LESS(zero, from->above) & KELVIN_LESS(to->above, zero);
    part = 0.5 * KELVIN_SELECT(leaves, part, one);
    struct kelvin_probe middle = {zero, from->frequency + part * (to->frequency - from->frequency),
                                  from->curvature + part * (to->curvature - from->curvature),
                                  from->above + part * (to->above - from->above)};
    kelvin_demand(&middle, &here);
    *demand = KELVIN_MAX(*demand, here);
    kelvin_demand(to, &here);
    *demand = KELVIN_MAX(*demand, here);
}
/* Stationary points of the phase in q: t = (x -+ sqrt(x^2 - 8 y^2))/(4 y), or the real part of the
 * pair; q = t/sqrt(2 (1 + sqrt(1 + t^2))). */
struct kelvin_saddles {
    kelvin_vec q1, q2, c1, c2; /* places and |f_qq| at z = 0 */
    kelvin_bits real;
};

KELVIN_OUTLINE void kelvin_q_of_t(const kelvin_vec *t, kelvin_vec *q)
{
    kelvin_vec square = 1 + *t * *t, root;
    kelvin_vrsqrt(&square, &root);
    square = 2 + 2 * (square * root);
    kelvin_vrsqrt(&square, &root);
    *q = *t * root;
}

KELVIN_INLINE void kelvin_find_saddles(const struct kelvin_wave_points *p, struct kelvin_saddles *s)
{
    kelvin_vec x = p->x, y = p->y, D = x * x - 8 * (y * y), tiny = x * x * 1e-30, rroot;
    s->real = KELVIN_LESS(0 * D, D);
    D = KELVIN_MAX(D, tiny);
    kelvin_vrsqrt(&D, &rroot);
    kelvin_vec root = D * rroot, sum = x + root, least = 1e-13 * x, y4 = 4 * y;
    y4 = KELVIN_MAX(y4, least);
    kelvin_vec middle = x / y4, t1 = KELVIN_SELECT(s->real, 2 * y / sum, middle);
    kelvin_vec t2 = KELVIN_SELECT(s->real, sum / y4, middle);
    kelvin_q_of_t(&t1, &s->q1);
    kelvin_q_of_t(&t2, &s->q2);
    s->c1 = s->c2 = 4 * root;
}

/* How far from the stationary points the contour can count: bounds from each way of decaying alone.
 */
struct kelvin_reach {
    kelvin_vec left, right, between; /* places; `between` if only q1 counts */
};

KELVIN_INLINE void kelvin_sqrt(const kelvin_vec *square, kelvin_vec *root)
{
    kelvin_vec inverse;
    kelvin_vrsqrt_to(square, KELVIN_ROUGH, &inverse);
    *root = *square * inverse;
}

KELVIN_INLINE void kelvin_bound_reach(const struct kelvin_wave_points *p,
                                      const struct kelvin_saddles *s, enum kelvin_kind kind,
                                      struct kelvin_reach *reach)
{
    kelvin_vec zero = {0}, one = zero + 1, tiny = zero + 1e-280;
    kelvin_vec x = KELVIN_MAX(p->x, tiny), y = KELVIN_MAX(p->y, tiny), z = KELVIN_MAX(p->z, tiny);
    /* T: what -Re f must reach to outweigh the powers of C. */
    kelvin_vec e = 500 / (z + 0.1 * y + 1e-26), T, T_x;
    e = KELVIN_MAX(e, one);
    kelvin_vlog_rough(&e, &T);
    e = 200 / x + 1;
    kelvin_vlog_rough(&e, &T_x);
    T = KELVIN_CUT + 2 + 0.5 * kelvin_weight(kind) * KELVIN_MIN(T, 2 * T_x);

    /* Where z (1 + 2 q^2)^2, 2.5 x q^2, 5 y q^4 alone reach T. */
    kelvin_vec by_z, by_x, by_y, t_over_x = T / x, t_over_y = T / y, t_over_z = T / z;
    kelvin_sqrt(&t_over_z, &by_z);
    by_z = 0.5 * by_z + 0.1;
    kelvin_sqrt(&by_z, &by_z);
    if (kind == KELVIN_FILTERED) {
        kelvin_vec by_filter = T / (p->e2 + 1e-280);
        kelvin_sqrt(&by_filter, &by_filter);
        kelvin_sqrt(&by_filter, &by_filter);
        by_filter = 0.5 * by_filter + 0.1;
        kelvin_sqrt(&by_filter, &by_filter);
        by_z = KELVIN_MIN(by_z, by_filter);
    }
    kelvin_vec root_y;
    kelvin_sqrt(&t_over_y, &root_y);
    e = 0.45 * root_y;
    kelvin_sqrt(&e, &by_y);
    e = 0.4 * t_over_x;
    kelvin_sqrt(&e, &by_x);

    /* Next to a stationary point: quadratic, or less where two merge. */
    kelvin_vec square = 2 * T / s->c1, near, merged;
    kelvin_sqrt(&square, &near);
    square = KELVIN_MAX(t_over_x, t_over_x * t_over_x);
    kelvin_sqrt(&square, &merged);
    kelvin_sqrt(&merged, &merged);
    near = KELVIN_MIN(1.4 * near, 2 * merged);
    kelvin_vec least = 1e-3 * KELVIN_MIN(near, one);

    kelvin_vec far = KELVIN_MIN(by_x, by_y);
    far = KELVIN_MIN(far, by_z);
    reach->left = KELVIN_MAX(-far, s->q1 - near);
    reach->left = KELVIN_MIN(reach->left, s->q1 - least);

    /* Beyond q2, where y q^4 has to win over x q^2. */
    e = x / y + 0.6 * root_y;
    kelvin_sqrt(&e, &far);
    far = KELVIN_MIN(far, by_z);
    far = KELVIN_MIN(far, s->q2 + near);
    reach->right = KELVIN_MAX(far, s->q2 + least);

    /* Between them 2.5 x q^2 holds far from q2 only. */
    far = KELVIN_SELECT(KELVIN_LESS(4 * by_x, s->q2), s->q1 + 2 * by_x, s->q2);
    far = KELVIN_MIN(far, by_z);
    reach->between = KELVIN_MAX(far, s->q1 + least);
}

/* A range of probes in one direction from a stationary point. */
struct kelvin_range {
    kelvin_vec last, demand;
};

KELVIN_OUTLINE void kelvin_look_outwards(const struct kelvin_probe *start,
                                         const struct kelvin_probe *probe, int probes,
                                         struct kelvin_range *seen)
{
    const struct kelvin_probe *before = start;
    kelvin_vec zero = {0};
    kelvin_demand(start, &seen->demand);
    seen->last = start->q;
    for (int k = 0; k < probes; before = &probe[k++]) {
        const struct kelvin_probe *now = &probe[k];
        kelvin_demand_between(before, now, &seen->demand);
        /* Half way between where the chord crosses the cut and the outer end: the level is concave.
         */
        kelvin_bits counts = KELVIN_LESS(zero, now->above);
        kelvin_bits leaves = KELVIN_LESS(zero, before->above) & ~counts;
        kelvin_vec crossing =
            before->q + (now->q - before->q) * (before->above / (before->above - now->above));
        seen->last = KELVIN_SELECT(leaves, 0.5 * (crossing + now->q), seen->last);
        seen->last = KELVIN_SELECT(counts, now->q, seen->last);
    }
}

/* Probes at the stationary points and outwards from them: to the left of q1, and to the right of q2
 * if it counts or if the pair is complex, of q1 otherwise. */
enum { KELVIN_LEFT = 4, KELVIN_RIGHT = 5 };
static const double kelvin_left[KELVIN_LEFT] = {0.2, 0.42, 0.7, 1};
static const double kelvin_right[KELVIN_RIGHT] = {0.12, 0.28, 0.48, 0.72, 1};

struct kelvin_probes {
    struct kelvin_probe q1, q2, left[KELVIN_LEFT], right[KELVIN_RIGHT];
    kelvin_bits both, single; /* both stationary points count; only q1 does */
};

KELVIN_INLINE void kelvin_sort_out(const struct kelvin_saddles *s, struct kelvin_probes *probes)
{
    kelvin_vec zero = {0};
    probes->both = s->real & KELVIN_LESS(zero, probes->q2.above);
    probes->single = s->real & ~probes->both;
}

/* Of sixteen points. */
KELVIN_INLINE void kelvin_probe_points(const struct kelvin_wave_points *p,
                                       const struct kelvin_saddles *s,
                                       const struct kelvin_reach *reach, const kelvin_bits *curved,
                                       enum kelvin_kind kind, struct kelvin_probes *probes)
{
    kelvin_probe_at(p, curved, &s->q1, kind, &probes->q1);
    kelvin_probe_at(p, curved, &s->q2, kind, &probes->q2);
    kelvin_sort_out(s, probes);
    kelvin_vec from = KELVIN_SELECT(probes->single, s->q1, s->q2);
    kelvin_vec to = KELVIN_SELECT(probes->single, reach->between, reach->right);
    for (int k = 0; k < KELVIN_LEFT; k++) {
        kelvin_vec q = s->q1 + (reach->left - s->q1) * kelvin_left[k];
        kelvin_probe_at(p, curved, &q, kind, &probes->left[k]);
    }
    for (int k = 0; k < KELVIN_RIGHT; k++) {
        kelvin_vec q = from + (to - from) * kelvin_right[k];
        kelvin_probe_at(p, curved, &q, kind, &probes->right[k]);
    }
}

KELVIN_INLINE void kelvin_broadcast(const struct kelvin_probe *from, int lane,
                                    struct kelvin_probe *to)
{
    kelvin_vec zero = {0};
    to->q = zero + from->q[lane];
    to->frequency = zero + from->frequency[lane];
    to->curvature = zero + from->curvature[lane];
    to->above = zero + from->above[lane];
}

/* The same probes of the one point that is in all lanes, all at once: both stationary points, the
 * left, the right of q1 and the right of q2. */
KELVIN_INLINE void kelvin_probe_point(const struct kelvin_wave_points *p,
                                      const struct kelvin_saddles *s,
                                      const struct kelvin_reach *reach, const kelvin_bits *curved,
                                      enum kelvin_kind kind, struct kelvin_probes *probes)
{
    enum { INNER = 2 + KELVIN_LEFT, OUTER = INNER + KELVIN_RIGHT };
    struct kelvin_probe all;
    kelvin_vec from = s->q1, to = s->q1, part = {0};
    from[1] = to[1] = s->q2[0];
    for (int k = 0; k < KELVIN_LEFT; k++) {
        to[2 + k] = reach->left[0];
        part[2 + k] = kelvin_left[k];
    }
    for (int k = 0; k < KELVIN_RIGHT; k++) {
        to[INNER + k] = reach->between[0];
        from[OUTER + k] = s->q2[0];
        to[OUTER + k] = reach->right[0];
        part[INNER + k] = part[OUTER + k] = kelvin_right[k];
    }
    kelvin_vec q = from + (to - from) * part;
    kelvin_probe_at(p, curved, &q, kind, &all);
    kelvin_broadcast(&all, 0, &probes->q1);
    kelvin_broadcast(&all, 1, &probes->q2);
    kelvin_sort_out(s, probes);
    int right = probes->single[0] ? INNER : OUTER;
    for (int k = 0; k < KELVIN_LEFT; k++)
        kelvin_broadcast(&all, 2 + k, &probes->left[k]);
    for (int k = 0; k < KELVIN_RIGHT; k++)
        kelvin_broadcast(&all, right + k, &probes->right[k]);
}

KELVIN_INLINE int kelvin_any(const kelvin_bits *mask)
{
    uint64_t any = 0;
    for (int k = 0; k < KELVIN_LANES; k++)
        any |= (*mask)[k];
    return any != 0;
}

/* Where the level stays below the cut between q1 and q2: the first and the last such probe. */
struct kelvin_dip {
    kelvin_bits split;
    kelvin_vec from, to, demand_before, demand_after;
};

KELVIN_INLINE void kelvin_find_dip(const struct kelvin_wave_points *p, const kelvin_bits *curved,
                                   const struct kelvin_probes *at, enum kelvin_kind kind,
                                   struct kelvin_dip *dip)
{
    const kelvin_bits *both = &at->both;
    kelvin_vec zero = {0}, gap = at->q2.q - at->q1.q, room = p->x * gap * gap;
    kelvin_bits deep = *both & KELVIN_LESS(zero + KELVIN_CUT, room);
    *dip = (struct kelvin_dip){{0}, at->q1.q, at->q1.q, zero, zero};
    int probes = kelvin_any(&deep) ? 6 : kelvin_any(both) ? 2 : 0;
    struct kelvin_probe before = at->q1, now;
    for (int k = 1; k <= probes; k++, before = now) {
        kelvin_vec q = at->q1.q + gap * ((double)k / probes), demand = zero;
        if (k < probes)
            kelvin_probe_at(p, curved, &q, kind, &now);
        else
            now = at->q2;
        kelvin_demand_between(&before, &now, &demand);
        demand = KELVIN_SELECT(*both, demand, zero);
        kelvin_bits below = *both & KELVIN_LESS(now.above, zero - 2);
        kelvin_vec larger = KELVIN_MAX(dip->demand_before, demand);
        dip->demand_before = KELVIN_SELECT(dip->split, dip->demand_before, larger);
        dip->from = KELVIN_SELECT(below & ~dip->split, q, dip->from);
        dip->to = KELVIN_SELECT(below, q, dip->to);
        dip->split |= below;
        dip->demand_after = KELVIN_MAX(dip->demand_after, demand);
        dip->demand_after = KELVIN_SELECT(below, zero, dip->demand_after);
    }
}

KELVIN_OUTLINE void kelvin_step(const kelvin_vec *demand, const kelvin_bits *curved,
                                const kelvin_bits *real, kelvin_vec *step)
{
    kelvin_vec zero = {0}, strip = zero + KELVIN_STRIP, complex = zero + KELVIN_STRIP_COMPLEX,
               curve = zero + KELVIN_STRIP_LONG;
    strip = KELVIN_SELECT(*real, strip, complex);
    strip = KELVIN_SELECT(*curved, curve, strip);
    kelvin_vec square = *demand * *demand + 2 * KELVIN_CUT * strip;
    kelvin_vrsqrt_to(&square, KELVIN_ROUGH, step);
    *step *= KELVIN_SAFETY * (2 * PI);
}

/* From q to p: asinh of either sign in the lanes that are curved. */
KELVIN_OUTLINE void kelvin_p_of_q(const kelvin_bits *curved, kelvin_vec *q)
{
    kelvin_vec size = KELVIN_MAX(*q, -*q), square = 1 + size * size, root, p, zero = {0};
    kelvin_vrsqrt(&square, &root);
    root = size + square * root;
    kelvin_vlog(&root, &p);
    p = KELVIN_SELECT(KELVIN_LESS(*q, zero), -p, p);
    *q = KELVIN_SELECT(*curved, p, *q);
}

/* The first holds the only window, or the one about q1 if the second is not empty. alone: the same
 * point is in all lanes. */
KELVIN_INLINE void kelvin_find_windows(const struct kelvin_wave_points *p, bool alone,
                                       enum kelvin_kind kind, struct kelvin_windows *windows)
{
    struct kelvin_window *first = &windows->part[0], *second = &windows->part[1];
    struct kelvin_saddles s;
    struct kelvin_reach reach;
    struct kelvin_probes probes;
    struct kelvin_range left, right;
    struct kelvin_dip dip;
    struct kelvin_probe from;
    kelvin_vec zero = {0};
    kelvin_find_saddles(p, &s);
    kelvin_bound_reach(p, &s, kind, &reach);
    kelvin_bits curved = KELVIN_LESS(reach.left, zero - KELVIN_LONG);
    if (alone)
        kelvin_probe_point(p, &s, &reach, &curved, kind, &probes);
    else
        kelvin_probe_points(p, &s, &reach, &curved, kind, &probes);
    kelvin_look_outwards(&probes.q1, probes.left, KELVIN_LEFT, &left);
    from.q = KELVIN_SELECT(probes.single, probes.q1.q, probes.q2.q);
    from.above = KELVIN_SELECT(probes.single, probes.q1.above, probes.q2.above);
    from.frequency = KELVIN_SELECT(probes.single, probes.q1.frequency, probes.q2.frequency);
    from.curvature = KELVIN_SELECT(probes.single, probes.q1.curvature, probes.q2.curvature);
    kelvin_look_outwards(&from, probes.right, KELVIN_RIGHT, &right);
    kelvin_find_dip(p, &curved, &probes, kind, &dip);

    kelvin_vec demand = KELVIN_MAX(left.demand, dip.demand_before);
    first->low = left.last;
    first->high = KELVIN_SELECT(dip.split, dip.from, right.last);
    demand = KELVIN_SELECT(dip.split, demand, KELVIN_MAX(demand, right.demand));
    kelvin_step(&demand, &curved, &s.real, &first->step);
    demand = KELVIN_MAX(right.demand, dip.demand_after);
    kelvin_step(&demand, &curved, &s.real, &second->step);
    second->low = dip.to;
    second->high = KELVIN_SELECT(dip.split, right.last, dip.to - 1);
    windows->curved = curved;
    if (kelvin_any(&curved)) {
        kelvin_p_of_q(&curved, &first->low);
        kelvin_p_of_q(&curved, &first->high);
        kelvin_p_of_q(&curved, &second->low);
        kelvin_p_of_q(&curved, &second->high);
    }
}

#endif
