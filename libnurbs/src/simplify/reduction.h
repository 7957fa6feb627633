/* Removing knots of one parameter direction: the coarse knots that are left, least squares onto
 * their splines with both end control points kept, and what removing one more knot would do.
 *
 * Notation: P fine control points over t, c coarse ones over tau (a part of t), A the insertion
 * matrix, so that P - A c are the control points of the difference over t and bound it (convex
 * hull). The coarse control points minimise |P - A c|^2 with c_0 and c_{m-1} fixed. */
#ifndef NURBS_REDUCTION_H
#define NURBS_REDUCTION_H

#include "core/object.h"

#include <nurbs/basis.h>

/* Weights of one column of A: rows first to first + count - 1, from `start` of the weights on. */
struct column {
    size_t first, count, start;
};

struct reduction {
    int degree;
    size_t fine_size, size; /* control points over the fine and the coarse knots */
    const double *fine;     /* knots, borrowed */
    double *knots;          /* coarse: size + degree + 1 */
    size_t *first;          /* rows of A: first column */
    double *rows;           /* fine_size * (degree + 1) */
    double *factor;         /* Cholesky factor of the interior normal matrix, by rows, banded */
    struct column *column;  /* size */
    double *weights;        /* of the columns, fine_size * (degree + 1) */
    double end[2][NURBS_MAX_DEGREE + 1]; /* products of the first and the last column of A with the
                                            one `k` away */
};

/* The removal of one copy of a knot is the condition g c = 0 on `count` coarse control points; the
 * least-squares solution under it differs by -x (g c) / (g x), x = (A'A)^{-1} g, and the fine
 * difference by influence * (g c) / (g x), influence = A x. */
struct removal {
    size_t index; /* of the last copy among the coarse knots */
    size_t first; /* coarse control point of functional[0] */
    size_t count; /* 2 to degree + 2 */
    double functional[NURBS_MAX_DEGREE + 2];
    double ratio[NURBS_MAX_DEGREE + 2]; /* of the reverse insertion, ratio[0] = 1, last 0 */
    double gain;                        /* g x; 0: cannot be removed */
    double *x;                          /* size */
    double *influence;                  /* fine_size */
    size_t low, high;                   /* rows where the influence is not negligible */
};

/* From the fine knots (borrowed) of fine_size control points and the coarse ones to start with
 * (copied), a part of them. */
nurbs_status reduction_create(int degree, size_t fine_size, const double *fine, size_t size,
                              const double *knots, struct reduction *r);
void reduction_free(struct reduction *r);

/* Replaces the coarse knots, of `size` control points, at most as many as at creation. */
void reduction_set(struct reduction *r, size_t size, const double *knots);

/* After a change of the coarse knots: A and the factor. */
void reduction_update(struct reduction *r);

/* Fills index, first, count, functional and ratio for the last copy of a coarse knot. */
void removal_functional(int degree, const double *knots, size_t index, struct removal *removal);

/* Fills the whole removal of the knot with this index; rows where the influence is below
 * `negligible` times its largest are left out of low to high. */
void reduction_assess(const struct reduction *r, size_t index, double negligible,
                      struct removal *removal);

/* Turns the `count` coarse control points from `first` on, which satisfy the condition, into those
 * without the knot: base[count][stride], of which `columns` are used. One row becomes free; returns
 * its index. */
size_t reduction_contract(const struct removal *removal, size_t columns, size_t stride,
                          double *base);

/* Takes the knot out of the coarse knots; call reduction_update next. */
void reduction_drop(struct reduction *r, size_t index);

/* Least squares: coarse[size][columns] from fine[fine_size][columns]. */
void reduction_project(const struct reduction *r, size_t columns, const double *fine,
                       double *coarse);

/* Row i of A coarse; and all of it. */
void reduction_expand_row(const struct reduction *r, size_t i, size_t columns, const double *coarse,
                          double *row);

void reduction_expand(const struct reduction *r, size_t columns, const double *coarse,
                      double *fine);

#endif
