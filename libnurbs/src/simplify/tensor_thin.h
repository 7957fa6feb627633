/* Quick knot removal on a surface: an order of the knots for each direction by itself, then the
 * numbers to take from both together. */
#ifndef NURBS_TENSOR_THIN_H
#define NURBS_TENSOR_THIN_H

#include "simplify/knot_order.h"
#include "simplify/subject.h"

/* The net is `rows`[size[0]][planes][size[1]]; the fit, over the knots of `along`, is
 * `fit`[m1][planes][m0], turned, so that the rows of a solve are contiguous. */
struct tensor_thin {
    const struct subject *subject;
    struct wall wall[3];
    struct knot_order order[2];
    struct reduction along[2];
    double tolerance;
    int keep_kinks;
    double *rows, *turned_rows, *fit; /* turned_rows[size[1]][planes][size[0]] */
    double *half, *turned, *row;      /* work */
    double *knots;
    unsigned char *gone[2]; /* by knot */
    double *worst[2];       /* largest squared difference of rows and of columns */
};

/* Borrows the subject (two directions, one part). */
nurbs_status tensor_thin_create(const struct subject *s, double tolerance, int keep_kinks,
                                const struct wall wall[3], struct tensor_thin *t);
void tensor_thin_free(struct tensor_thin *t);

/* Takes as many knots as it finds to fit the tolerance, and fits the net without them. */
nurbs_status tensor_thin_run(struct tensor_thin *t);

struct coarse_net tensor_thin_net(const struct tensor_thin *t);

/* As subject_certify. */
double tensor_thin_certify(struct tensor_thin *t, const double *points, const double *weights);

#endif
