/* A closed loop in the parameter plane of a surface, and its four sides. */
#ifndef NURBS_TRIM_LOOP_H
#define NURBS_TRIM_LOOP_H

#include <nurbs/curve.h>
#include <nurbs/surface.h>

#include <stdbool.h>

/* A smooth part of a curve run from parameter `from` to `to` (either may be larger), moved by a
 * shift that changes linearly so that parts meet. Without a curve: the line between the shifts. */
typedef struct loop_part {
    const nurbs_curve *curve; /* borrowed */
    double from, to;
    double shift[2][2];
    double length; /* in metres, by the mean stretch of the surface */
    double turn;   /* angle to the next part, radians, positive to the left */
} loop_part;

/* Parts first ... first + count - 1 (modulo the number of parts) between two corners, with a
 * parameter s from 0 to 1: proportional to coordinate `along`, or -1: to the curves' own
 * parameters, parts sharing s by their lengths. */
typedef struct loop_side {
    size_t first, count;
    int along;
    double start[2], end[2];
    double *share; /* [count + 1] s at the ends of the parts */
} loop_side;

typedef struct trim_loop {
    const nurbs_surface *surface; /* borrowed */
    double low[2], high[2];       /* domain of the surface */
    double stretch[2];            /* mean metres per unit of u and v */
    double tolerance;             /* metres */
    double closed;                /* largest gap that was closed, metres */
    size_t count, room;
    loop_part *part;
    loop_side side[4]; /* v = 0 and v = 1 with s along u, u = 0 and u = 1 with s along v */
} trim_loop;

/* The closed loop, counterclockwise, without sides. */
nurbs_status trim_loop_open(const nurbs_surface *surface, size_t n,
                            const nurbs_curve *const *curves, double tolerance, trim_loop *loop);
/* Sides between the corners that lie behind the parts corner[4], which increase. */
nurbs_status trim_loop_sides(trim_loop *loop, const size_t corner[4]);
/* Both, for a loop that has four corners. */
nurbs_status trim_loop_create(const nurbs_surface *surface, size_t n,
                              const nurbs_curve *const *curves, double tolerance, trim_loop *loop);
void trim_loop_free(trim_loop *loop);

/* Place x in [0,1] of a part; derivative with respect to x if not NULL. */
void trim_loop_point(const loop_part *part, double x, double uv[2], double *derivative);
/* Twice the area inside, positive when counterclockwise; fills the lengths of the parts. */
double trim_loop_measure(trim_loop *loop);
void trim_loop_reverse(trim_loop *loop);
void trim_loop_find_turns(trim_loop *loop);
/* Whether there is a corner behind a part. */
bool trim_loop_turns(const loop_part *part);

/* nurbs_surface_untrim() of a loop whose sides are known; *deviation includes closed gaps. */
nurbs_status untrim_sides(trim_loop *loop, double tolerance, nurbs_surface **patch,
                          double *deviation);

/* Point of a side of the loop. */
void trim_loop_side(const trim_loop *loop, const loop_side *side, double s, double uv[2]);

/* Value of s at the joint behind part k of a side, 0 <= k < count - 1, and whether the loop turns
 * there by more than a degree. */
int trim_loop_kink(const trim_loop *loop, const loop_side *side, size_t k, double *s);

#endif
