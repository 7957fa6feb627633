/* A curve or surface being simplified, and the certificate of the result.
 *
 * Certificate. Original and result are brought to the original knots with every span divided; the
 * largest distance of their control points there bounds the distance of the two at equal
 * parameters, because the basis functions are non-negative and sum to one. For rational splines
 * with homogeneous forms (N, w) and (N', w') and any centre c,
 *     S - S' = ((N - c w) - (N' - c w') - (S' - c) (w - w')) / w,
 * so (|d(N - c w)| + max|S' - c| |dw|) / min w over the control points bounds it likewise. */
#ifndef NURBS_SUBJECT_H
#define NURBS_SUBJECT_H

#include "simplify/thinning.h"

/* The spline and the scaled net in which Euclidean norms bound distances. */
struct subject {
    int directions, degree[2];
    size_t size[2], divided_size[2];
    const double *knots[2];
    double *divided[2]; /* knots with every span in equal parts; 1 part: NULL */
    int planes;         /* 3, or 4 when rational */
    double centre[3];
    double scale;        /* 1 / smallest weight, 1 when polynomial */
    double radius;       /* rational: largest distance of a control point from the centre */
    double *net;         /* planes over the knots */
    double *divided_net; /* planes over the divided knots; 1 part: NULL */
    const double *points, *weights;
    double rounding; /* absolute error allowed for in the certificate */
};

/* Borrows points and weights (NULL: polynomial); axes[1] is NULL for a curve. More parts cost more
 * and bring the certified distance closer to the true one. */
nurbs_status subject_create(int directions, int parts, const struct axis *const axes[2],
                            const double *points, const double *weights, struct subject *s);
void subject_free(struct subject *s);

/* A request to thin on the original knots or on the divided ones; coarse knots: the original. */
struct thinning_request subject_request(const struct subject *s, int divided, double tolerance);

/* Scalar planes of a coarse net, borrowed: coordinate c of point i, j at
 * values[c * plane + i * step[0] + j * step[1]]. */
struct coarse_net {
    size_t size[2], plane, step[2];
    double *values;
};

/* Control points of the coarse net as points and weights: fills points[3 * n] and weights[n], n the
 * product of the coarse sizes. Returns 0 when a weight is not positive. */
int subject_read(const struct subject *s, const struct coarse_net *net, double *points,
                 double *weights);

/* The reverse; returns the largest distance of the points from the centre. */
double subject_write(const struct subject *s, const double *points, const double *weights,
                     const struct coarse_net *net);

/* Bound of the distance between the original and the result with these coarse control points, over
 * the fine knots of `t`. Replaces the coarse net of `t`. */
double subject_certify(const struct subject *s, struct thinning *t, const double *points,
                       const double *weights);
struct coarse_net thinning_net(const struct thinning *t);

/* The simpler spline: knots, points and weights; removed 0: it is the original. */
struct simple {
    int removed;
    size_t size[2];
    double *knots[2], *points, *weights;
    double bound;
};

/* Allocates the arrays and copies the coarse knots of each direction. */
nurbs_status simple_create(const struct subject *s, const struct reduction along[2],
                           struct simple *r);
void simple_free(struct simple *r);

/* The result and its bound (NULL: not wanted); a copy and 0 when nothing was removed. */
nurbs_status simple_curve(const nurbs_curve *original, const struct simple *r, nurbs_curve **result,
                          double *bound);
nurbs_status simple_surface(const nurbs_surface *original, const struct simple *r,
                            nurbs_surface **result, double *bound);

#endif
