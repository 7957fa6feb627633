/* Greedy knot removal on the net of a curve or a surface, the engine of simplification. The method
 * is described in thinning.c. */
#ifndef NURBS_THINNING_H
#define NURBS_THINNING_H

#include "simplify/reduction.h"

/* Control points must have side * (plane - value) >= 0; with a fourth plane, which then holds
 * weights, side * (plane - value * fourth) >= 0. side 0: no wall. */
struct wall {
    int side;
    double value;
};

/* Fine knots and control net to approximate, and the coarse knots to start from: a part of the fine
 * ones. The net is `planes` scalar planes of fine_size[0] x fine_size[1]; a curve has one direction
 * and fine_size[1] = 1. Everything is borrowed. */
struct thinning_request {
    int planes, directions;
    int degree[2];
    size_t fine_size[2], coarse_size[2];
    const double *fine[2], *coarse[2];
    const double *target;
    double tolerance; /* of the Euclidean norm over the planes */
    int keep_kinks;   /* knots of multiplicity >= degree stay */
    struct wall wall[3];
};

struct thinning {
    int planes, directions;
    size_t size[2]; /* fine */
    struct reduction along[2];
    const double *target;
    double
        *coarse;   /* planes of size[0] x size[1], of which the leading rows and columns are used */
    double *error; /* target - A_0 coarse A_1' */
    double tolerance;
    struct wall wall[3];
    double *key[2];     /* by coarse knot: largest error once it is gone; HUGE_VAL: not removable */
    unsigned *stamp[2]; /* version of the state that a key was computed for */
    unsigned version;
    struct removal removal;
    double *line; /* change of the error across the removal's direction, planes * longest size */
    double *jump; /* the same in coarse control points, longest size */
    double *half, *turned, *change, *excess; /* work: a plane each, excess two */
};

/* The coarse net starts as the least-squares fit of the target. */
nurbs_status thinning_create(const struct thinning_request *request, struct thinning *t);
void thinning_free(struct thinning *t);

/* Computes the difference afresh from the coarse net. */
void thinning_difference(struct thinning *t);

/* Largest norm of the difference over the fine knots. */
double thinning_largest(const struct thinning *t);

/* Removes knots, the least harmful first, until no further one fits the tolerance. */
void thinning_run(struct thinning *t);

/* Removes the knot of this index among the coarse knots of a direction, whatever the error; 0 when
 * that is impossible. */
int thinning_remove(struct thinning *t, int direction, size_t index);

/* Lowers the largest difference towards the goal by at most so many steps; returns it. */
double thinning_balance(struct thinning *t, double goal, int steps);

/* Goes on removing knots whose harm can be balanced away within the tolerance, until `failures`
 * trials in a row did not succeed. */
nurbs_status thinning_squeeze(struct thinning *t, int failures);

#endif
