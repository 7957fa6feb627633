/* What every kind of shape modification provides, and plans: a shape bound to fixed points so that
 * many parameter vectors can be evaluated on them quickly. */
#ifndef GALV_SRC_SHAPE_H
#define GALV_SRC_SHAPE_H

#include <galv/shape.h>

/* Rows of displacements over fixed points. Only `stored` coordinates can differ from zero; index[s]
 * is the place of stored coordinate s among the 3 npoints, increasing. */
typedef struct galv_plan galv_plan;
struct galv_plan {
    size_t stored;
    size_t *index;
    bool concurrent; /* rows() may run in several threads at once */
    /* Fills count rows of `stored` numbers, rows + r ld, for the parameters x + r n. On failure
     * sets *bad to the row at fault. */
    galv_status (*rows)(const galv_plan *plan, size_t count, const double *x, double *rows,
                        size_t ld, size_t *bad);
    void (*destroy)(galv_plan *plan);
};

typedef struct galv_shape_class {
    const char *name;
    bool linear, concurrent;
    galv_status (*displace)(const galv_shape *shape, size_t npoints, const double *xyz,
                            const double *x, double *d);
    galv_status (*plan)(const galv_shape *shape, size_t npoints, const double *xyz,
                        galv_plan **plan);
    void (*destroy)(galv_shape *shape);
} galv_shape_class;

/* The head of every shape; kinds embed it as their first member. */
struct galv_shape {
    const galv_shape_class *class;
    size_t n;
    double *lower, *upper; /* one block, upper = lower + n */
};

/* Checks and copies the bounds into the head of a new shape. */
galv_status galv_shape_start(galv_shape *shape, const galv_shape_class *class, size_t n,
                             const double *lower, const double *upper);

galv_status galv_plan_create(const galv_shape *shape, size_t npoints, const double *xyz,
                             galv_plan **plan);
void galv_plan_free(galv_plan *plan);

/* The plan of a linear shape: its basis on the stored coordinates, rows = x basis. Takes over
 * `basis` (n rows of stored numbers) and `index`, also on failure. */
galv_status galv_plan_linear(size_t n, size_t stored, size_t *index, double *basis,
                             galv_plan **plan);
/* The basis of a linear plan, NULL for any other. */
const double *galv_plan_basis(const galv_plan *plan);

/* Names the first point that is not finite. */
galv_status galv_points_check(size_t npoints, const double *xyz);

#endif
