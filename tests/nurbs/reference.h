/* Cases of tests/data/nurbs_reference.json as curves and surfaces, and deterministic random
 * numbers, for the tests of libnurbs. */
#ifndef TESTS_NURBS_REFERENCE_H
#define TESTS_NURBS_REFERENCE_H

#include <nurbs/nurbs.h>

#include <jansson.h>
#include <stdint.h>

struct reference {
    json_t *root;
    json_t *cases;
};

/* Exits when the file is missing: no test can go on. */
struct reference reference_load(void);
void reference_free(struct reference *reference);
int reference_is(const json_t *c, const char *kind);
const char *reference_id(const json_t *c);

/* Numbers of an array of any nesting, flattened; *n (NULL allowed) is their count. free(). */
double *reference_numbers(const json_t *array, size_t *n);

/* Points of dimension dim as x,y,z triples (z = 0 in the plane). free(). */
double *reference_points(const json_t *array, int dim, size_t *n);

/* A spline from the degree of `c` (plus `by`) and the knots, n, P and w of `part` (`c` itself or
 * its insert or elevate part). Exits when it cannot be made. */
nurbs_curve *reference_curve(const json_t *c, const json_t *part, int by);
nurbs_surface *reference_surface(const json_t *c, const json_t *part, int by);

/* Largest |component| of n numbers, at least 1. */
double scale_of(const double *values, size_t n);
/* Largest |a - b| of n numbers; NaN if there is one. */
double largest_difference(const double *a, const double *b, size_t n);

/* SplitMix64: uniform in [0,1). */
double random_unit(uint64_t *state);
/* Clamped knots on [0,1]: n - degree - 1 interior ones, some double, some 1e-9 apart when `hard`.
 */
void random_knots(uint64_t *state, int degree, size_t n, int hard, double *knots);
/* Random control points in [-1,1]^3, weights in [0.5, 2] when rational. */
nurbs_curve *random_curve(uint64_t *state, int degree, size_t n, int hard, int rational);
nurbs_surface *random_surface(uint64_t *state, const int degree[2], const size_t size[2], int hard,
                              int rational);

#endif
