/* The bound of simplification between two facts that do not come from it: the true deviation at
 * samples, and a lower bound of the deviation of any spline on the reduced knots (de la Vallee
 * Poussin). Weights l_i at places u_i with sum l_i B_j(u_i) = 0 for every reduced basis function
 * B_j see nothing of a spline s on the reduced knots, so |sum l_i f(u_i)| = |sum l_i (f - s)(u_i)|
 * <= max |f - s| sum |l_i|. */
#include "check.h"
#include "reference.h"

#include <string.h>

enum { MOST = 16, ACROSS = 60 };

/* n unknowns, n - 1 rows of a (destroyed): a vector in the null space, largest entry 1. */
static void null_vector(size_t n, double a[MOST][MOST], double *x)
{
    size_t column[MOST];
    for (size_t k = 0; k < n; k++)
        column[k] = k;
    for (size_t k = 0; k + 1 < n; k++) {
        size_t row = k, pivot = k;
        for (size_t i = k; i + 1 < n; i++)
            for (size_t j = k; j < n; j++)
                if (fabs(a[i][column[j]]) > fabs(a[row][column[pivot]])) {
                    row = i;
                    pivot = j;
                }
        for (size_t j = 0; j < n; j++) {
            const double swap = a[k][j];
            a[k][j] = a[row][j];
            a[row][j] = swap;
        }
        const size_t swap = column[k];
        column[k] = column[pivot];
        column[pivot] = swap;
        for (size_t i = k + 1; i + 1 < n; i++) {
            const double factor = a[i][column[k]] / a[k][column[k]];
            for (size_t j = k; j < n; j++)
                a[i][column[j]] -= factor * a[k][column[j]];
        }
    }
    x[column[n - 1]] = 1.0;
    for (size_t k = n - 1; k-- > 0;) {
        double sum = 0.0;
        for (size_t j = k + 1; j < n; j++)
            sum -= a[k][column[j]] * x[column[j]];
        x[column[k]] = sum / a[k][column[k]];
    }
}

/* Places (Chebyshev) and weights over the reduced spans first to first + count - 1 of a direction
 * that annihilate its splines; returns their number, 0 when the interval is empty. */
static size_t annihilator(const nurbs_surface *reduced, int direction, size_t first, size_t count,
                          double *places, double *weights)
{
    const int p = nurbs_surface_degree(reduced, direction);
    const double *t = nurbs_surface_knots(reduced, direction);
    const size_t functions = (size_t)p + count, n = functions + 1;
    const double low = t[first], high = t[first + count];
    double a[MOST][MOST] = {{0.0}};
    if (!(high > low) || n > MOST)
        return 0;
    for (size_t k = 0; k < count; k++)
        if (t[first + k] == t[first + k + 1]) /* a short window with a double knot: not needed */
            return 0;
    for (size_t i = 0; i < n; i++) {
        double values[NURBS_MAX_DEGREE + 1];
        places[i] =
            low +
            (high - low) * (0.5 - 0.5 * cos(3.14159265358979323846 * (double)i / (double)(n - 1)));
        size_t span = first;
        while (span + 1 < first + count && places[i] >= t[span + 1])
            span++;
        nurbs_basis(p, t, span, places[i], values);
        for (size_t b = 0; b <= (size_t)p; b++)
            a[span - first + b][i] = values[b];
    }
    null_vector(n, a, weights);
    return n;
}

/* The best lower bound over windows of a direction and lines across; *worst is raised to the
 * deviation at all places used. */
static double lower_bound(const nurbs_surface *s, const nurbs_surface *reduced, int direction,
                          double *worst)
{
    const int p = nurbs_surface_degree(reduced, direction), other = 1 - direction;
    const size_t size = nurbs_surface_size(reduced, direction);
    const double *across = nurbs_surface_knots(s, other);
    const double begin = across[0], length = across[nurbs_surface_size(s, other)] - begin;
    double best = 0.0;
    for (size_t first = (size_t)p; first < size; first++)
        for (size_t count = 1; count <= 4 && first + count <= size; count++) {
            double places[MOST], weights[MOST];
            const size_t n = annihilator(reduced, direction, first, count, places, weights);
            double total = 0.0;
            for (size_t i = 0; i < n; i++)
                total += fabs(weights[i]);
            for (int k = 0; k <= ACROSS && n > 0; k++) {
                double sum[3] = {0.0}, uv[2], a[3], b[3];
                uv[other] = begin + length * k / ACROSS;
                for (size_t i = 0; i < n; i++) {
                    uv[direction] = places[i];
                    CU_ASSERT_EQUAL_FATAL(nurbs_surface_eval(s, 0, 1, uv, a), NURBS_OK);
                    CU_ASSERT_EQUAL_FATAL(nurbs_surface_eval(reduced, 0, 1, uv, b), NURBS_OK);
                    for (size_t c = 0; c < 3; c++)
                        sum[c] += weights[i] / total * a[c];
                    *worst = fmax(*worst, hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]));
                }
                best = fmax(best, hypot(hypot(sum[0], sum[1]), sum[2]));
            }
        }
    return best;
}

/* A random smooth shape on random knots. */
static nurbs_surface *shape(uint64_t *state, const int degree[2], const size_t size[2])
{
    nurbs_surface *knots = random_surface(state, degree, size, 0, 0), *s;
    double *points = malloc(3 * size[0] * size[1] * sizeof *points), g[2][64], wave[9];
    CU_ASSERT_PTR_NOT_NULL_FATAL(points);
    for (int d = 0; d < 2; d++)
        nurbs_greville(degree[d], size[d], nurbs_surface_knots(knots, d), g[d]);
    for (int k = 0; k < 9; k++)
        wave[k] = 1.0 + 4.0 * random_unit(state);
    for (size_t i = 0; i < size[0]; i++)
        for (size_t j = 0; j < size[1]; j++) {
            double *p = points + 3 * (i * size[1] + j);
            for (size_t c = 0; c < 3; c++)
                p[c] = sin(wave[c] * g[0][i] + wave[3 + c] * g[1][j]) +
                       0.3 * cos(wave[6 + c] * g[0][i] * g[1][j]) + 1e-3 * random_unit(state);
        }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, nurbs_surface_knots(knots, 0),
                                               nurbs_surface_knots(knots, 1), points, NULL, &s),
                          NURBS_OK);
    nurbs_surface_free(knots);
    free(points);
    return s;
}

static void test_between_two_facts(void)
{
    static const int degrees[5][2] = {{3, 3}, {2, 2}, {2, 4}, {5, 3}, {1, 3}};
    uint64_t state = 61;
    double share = 0.0;
    int compared = 0;
    for (int k = 0; k < 5; k++)
        for (int t = 0; t < 3; t++) {
            const double tolerance = (double[]){5e-3, 2e-2, 1e-1}[t];
            const size_t size[2] = {30, 22};
            nurbs_surface *s = shape(&state, degrees[k], size), *reduced;
            for (unsigned thrifty = 0; thrifty < 2; thrifty++) {
                double bound, worst = 0.0;
                CU_ASSERT_EQUAL_FATAL(nurbs_surface_simplify(s, tolerance,
                                                             thrifty ? NURBS_SIMPLIFY_THRIFTY : 0,
                                                             &reduced, &bound),
                                      NURBS_OK);
                const double lower =
                    fmax(lower_bound(s, reduced, 0, &worst), lower_bound(s, reduced, 1, &worst));
                CU_ASSERT(lower <= worst * (1.0 + 1e-9));
                CU_ASSERT(worst <= bound);
                CU_ASSERT(bound <= tolerance);
                CU_ASSERT(lower > 0.1 * bound); /* not far from the best there is */
                share += lower / bound;
                compared++;
                nurbs_surface_free(reduced);
            }
            nurbs_surface_free(s);
        }
    CU_ASSERT(share / compared > 0.4);
}

static const struct check_case cases[] = {
    {"bound between the deviation of the best spline and the tolerance", test_between_two_facts},
};

CHECK_MAIN("lower bound", cases)
