/* Which parts of the contour of kelvin_contour.h count, and the step of the trapezoid rule on them,
 * for eight points at once.
 *
 * Kept is where the level Re f + 3 |u| exceeds -KELVIN_CUT; |C|^3 <= e^{3|u|} bounds every weight
 * of value and gradient (5 for second derivatives). The level falls to both sides of the stationary
 * points u1 <= u2 and may fall between them: one window or two, found from probes. Where the
 * exponent has frequency w(u) and curvature q(u) as functions of u, the integrand looks like a
 * Gaussian of height e^level with the spectrum exp(-(k-w)^2/(2q)); the trapezoid rule of step h
 * errs by the spectrum at 2 pi/h, so it asks for 2 pi/h > B(u) = w + sqrt(2 q (KELVIN_CUT +
 * level)). With the strip in which the contour is analytic,
 *
 *     h = KELVIN_SAFETY 2 pi/sqrt(max B^2 + 2 KELVIN_STRIP KELVIN_CUT).
 *
 * The last two constants are fitted to errors of about 1e-10 of max(1, |W|), max(1, |grad W|). */
#ifndef IGABEM_KELVIN_WINDOWS_H
#define IGABEM_KELVIN_WINDOWS_H

#include "kelvin_contour.h"

#define KELVIN_CUT    26.0
#define KELVIN_SAFETY 0.97
#define KELVIN_STRIP  25.0

/* Nodes low, low + step, ... below high, per lane; empty where high <= low. */
struct kelvin_window {
    kelvin_vec low, high, step;
};

/* The power of |C| that bounds the weights. */
KELVIN_INLINE double kelvin_weight(enum kelvin_kind kind)
{
    return kind == KELVIN_SECOND_DERIVATIVES ? 5 : 3;
}

/* One place: w, q and what is left above the cut. */
struct kelvin_probe {
    kelvin_vec u, frequency, curvature, above;
};

KELVIN_INLINE void kelvin_probe_at(const struct kelvin_wave_points *p, const kelvin_vec *u,
                                   enum kelvin_kind kind, struct kelvin_probe *probe)
{
    struct kelvin_nodes nodes;
    kelvin_vec e, g, minus = -*u;
    kelvin_vexp(u, &e);
    kelvin_vexp(&minus, &g);
    kelvin_place_nodes(p, &e, &g, kind, KELVIN_ROUGH, &nodes);
    kelvin_bandwidth(p, &nodes, kind, &probe->frequency, &probe->curvature);
    probe->u = *u;
    probe->above = nodes.f.re + kelvin_weight(kind) * KELVIN_MAX(*u, minus) + KELVIN_CUT;
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
KELVIN_INLINE void kelvin_demand_between(const struct kelvin_probe *from,
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

/* A range of probes in one direction from a stationary point. */
struct kelvin_range {
    kelvin_vec demand; /* largest B */
    kelvin_vec last; /* the outermost place above the cut, moved out towards the first one below */
};

/* Probes from `start` outwards to start + reach (either sign). */
KELVIN_INLINE void kelvin_probe_outwards(const struct kelvin_wave_points *p,
                                         const kelvin_vec *start, const kelvin_vec *reach,
                                         enum kelvin_kind kind, struct kelvin_range *seen)
{
    static const double fraction[] = {0.12, 0.26, 0.42, 0.6, 0.8, 1};
    struct kelvin_probe before, now;
    kelvin_vec zero = {0};
    kelvin_probe_at(p, start, kind, &before);
    kelvin_demand(&before, &seen->demand);
    seen->last = *start;
    for (int k = 0; k < 6; k++, before = now) {
        kelvin_vec u = *start + *reach * fraction[k];
        kelvin_probe_at(p, &u, kind, &now);
        kelvin_demand_between(&before, &now, &seen->demand);
        /* Half way between where the chord crosses the cut and the outer end: the level is concave.
         */
        kelvin_bits counts = KELVIN_LESS(zero, now.above);
        kelvin_bits leaves = KELVIN_LESS(zero, before.above) & ~counts;
        kelvin_vec crossing =
            before.u + (u - before.u) * (before.above / (before.above - now.above));
        seen->last = KELVIN_SELECT(leaves, 0.5 * (crossing + u), seen->last);
        seen->last = KELVIN_SELECT(counts, u, seen->last);
    }
}

/* Stationary points of the phase: t = sinh u = (x -+ sqrt(x^2 - 8 y^2))/(4 y), or the real part of
 * the pair. */
struct kelvin_saddles {
    kelvin_vec u1, u2, q1, q2; /* places and |f''| at z = 0 */
    kelvin_bits real;
};

KELVIN_INLINE void kelvin_asinh(const kelvin_vec *t, kelvin_vec *u)
{
    kelvin_vec square = 1 + *t * *t, root;
    kelvin_vrsqrt(&square, &root);
    kelvin_vec e = *t + square * root;
    kelvin_vlog(&e, u);
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
    kelvin_asinh(&t1, &s->u1);
    kelvin_asinh(&t2, &s->u2);
    s->q1 = root;
    s->q2 = root * (1 + t2);
}

/* How far from the stationary points the contour can count: bounds from each way of decaying alone.
 */
struct kelvin_reach {
    kelvin_vec left, right, between; /* places; `between` if only u1 counts */
};

KELVIN_INLINE void kelvin_sqrt(const kelvin_vec *square, kelvin_vec *root)
{
    kelvin_vrsqrt_to(square, KELVIN_ROUGH, root);
    *root *= *square;
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
    kelvin_vlog(&e, &T);
    e = 200 / x + 1;
    kelvin_vlog(&e, &T_x);
    T = KELVIN_CUT + 2 + 0.5 * kelvin_weight(kind) * KELVIN_MIN(T, 2 * T_x);

    /* Where exp(-z cosh^2 u), exp(-x sinh u sin tau), exp(-y sinh 2u sin 2 tau/2) alone reach T. */
    kelvin_vec by_z, by_x, by_y, t_over_x = T / x, t_over_y = T / y, root_x, root_y;
    kelvin_sqrt(&t_over_x, &root_x);
    kelvin_sqrt(&t_over_y, &root_y);
    e = 8 * T / z + 1;
    kelvin_vlog(&e, &by_z);
    by_z *= 0.5;
    if (kind == KELVIN_FILTERED) {
        kelvin_vec by_filter, fourth = 8 * T / (p->e2 + 1e-280);
        kelvin_sqrt(&fourth, &e);
        e = 4 * e + 1;
        kelvin_vlog(&e, &by_filter);
        by_filter *= 0.5;
        by_z = KELVIN_MIN(by_z, by_filter);
    }
    e = 6 * t_over_y + 1;
    kelvin_vlog(&e, &by_y);
    by_y *= 0.5;
    e = KELVIN_MAX(3 * t_over_x, 1.1 * root_x);
    kelvin_asinh(&e, &by_x);

    /* Next to a stationary point: quadratic, or cubic where two merge. */
    kelvin_vec cubic, square1 = 2 * T / s->q1, square2 = 2 * T / s->q2, near1, near2, near_square;
    e = 6 * t_over_x;
    kelvin_vlog(&e, &cubic);
    cubic *= 1.0 / 3;
    kelvin_vexp(&cubic, &cubic);
    kelvin_sqrt(&square1, &near_square);
    kelvin_sqrt(&square2, &near2);
    near1 = 1.3 * KELVIN_MIN(near_square, cubic);
    near2 = 1.3 * KELVIN_MIN(near2, cubic);
    kelvin_vec least1 = 1e-3 * KELVIN_MIN(near1, one), least2 = 1e-3 * KELVIN_MIN(near2, one);

    kelvin_vec far = KELVIN_MIN(by_x, by_y);
    far = KELVIN_MIN(far, by_z);
    reach->left = KELVIN_MAX(-far, s->u1 - near1);
    reach->left = KELVIN_MIN(reach->left, s->u1 - least1);

    /* Beyond u2, where y e^{2u} has to win over x e^u. */
    e = 3 * x / y + 2.5 * root_y + 1;
    kelvin_vlog(&e, &far);
    far = KELVIN_MIN(far, by_z);
    reach->right = KELVIN_MIN(far, s->u2 + near2);
    reach->right = KELVIN_MAX(reach->right, s->u2 + least2);

    e = KELVIN_MAX(5 * t_over_x, 1.6 * root_x);
    kelvin_asinh(&e, &far);
    far = KELVIN_MIN(s->u1 + far, by_z);
    far = KELVIN_MIN(far, s->u2);
    reach->between = KELVIN_MIN(far, s->u1 + 1.5 * near_square);
    reach->between = KELVIN_MAX(reach->between, s->u1 + least1);
}

KELVIN_INLINE void kelvin_step(const kelvin_vec *demand, kelvin_vec *step)
{
    kelvin_vec square = *demand * *demand + 2 * KELVIN_STRIP * KELVIN_CUT;
    kelvin_vrsqrt_to(&square, KELVIN_ROUGH, step);
    *step *= KELVIN_SAFETY * 6.2831853071795865;
}

/* Where the level stays below the cut between u1 and u2: the first and the last such probe. */
struct kelvin_dip {
    kelvin_bits split;
    kelvin_vec from, to, demand_before, demand_after;
};

KELVIN_INLINE void kelvin_find_dip(const struct kelvin_wave_points *p,
                                   const struct kelvin_saddles *s, const kelvin_bits *both,
                                   enum kelvin_kind kind, struct kelvin_dip *dip)
{
    kelvin_vec zero = {0}, gap = s->u2 - s->u1;
    uint64_t any = 0;
    *dip = (struct kelvin_dip){{0}, s->u1, s->u1, zero, zero};
    for (int k = 0; k < KELVIN_LANES; k++)
        any |= (*both)[k];
    if (!any)
        return;
    struct kelvin_probe before, now;
    kelvin_probe_at(p, &s->u1, kind, &before);
    for (int k = 1; k <= 6; k++, before = now) {
        kelvin_vec u = s->u1 + gap * (k / 6.0), demand = zero;
        kelvin_probe_at(p, &u, kind, &now);
        kelvin_demand_between(&before, &now, &demand);
        demand = KELVIN_SELECT(*both, demand, zero);
        kelvin_bits below = *both & KELVIN_LESS(now.above, zero - 2);
        kelvin_vec larger = KELVIN_MAX(dip->demand_before, demand);
        dip->demand_before = KELVIN_SELECT(dip->split, dip->demand_before, larger);
        dip->from = KELVIN_SELECT(below & ~dip->split, u, dip->from);
        dip->to = KELVIN_SELECT(below, u, dip->to);
        dip->split |= below;
        dip->demand_after = KELVIN_MAX(dip->demand_after, demand);
        dip->demand_after = KELVIN_SELECT(below, zero, dip->demand_after);
    }
}

/* first holds the only window, or the one about u1 if second is not empty. */
KELVIN_INLINE void kelvin_find_windows(const struct kelvin_wave_points *p, enum kelvin_kind kind,
                                       struct kelvin_window *first, struct kelvin_window *second)
{
    struct kelvin_saddles s;
    struct kelvin_reach reach;
    struct kelvin_range left, right;
    struct kelvin_probe at_u2;
    kelvin_find_saddles(p, &s);
    kelvin_bound_reach(p, &s, kind, &reach);
    kelvin_probe_at(p, &s.u2, kind, &at_u2);

    kelvin_vec span = reach.left - s.u1;
    kelvin_probe_outwards(p, &s.u1, &span, kind, &left);
    /* Outwards from u2 if it counts or if the pair is complex, from u1 otherwise. */
    kelvin_bits both = s.real & KELVIN_LESS(0 * at_u2.above, at_u2.above), single = s.real & ~both;
    kelvin_vec from = KELVIN_SELECT(single, s.u1, s.u2);
    span = KELVIN_SELECT(single, reach.between - s.u1, reach.right - s.u2);
    kelvin_probe_outwards(p, &from, &span, kind, &right);

    struct kelvin_dip dip;
    kelvin_find_dip(p, &s, &both, kind, &dip);
    kelvin_vec demand = KELVIN_MAX(left.demand, dip.demand_before);
    first->low = left.last;
    first->high = KELVIN_SELECT(dip.split, dip.from, right.last);
    demand = KELVIN_SELECT(dip.split, demand, KELVIN_MAX(demand, right.demand));
    kelvin_step(&demand, &first->step);
    demand = KELVIN_MAX(right.demand, dip.demand_after);
    kelvin_step(&demand, &second->step);
    second->low = dip.to;
    second->high = KELVIN_SELECT(dip.split, right.last, dip.to - 1);
}

#endif
