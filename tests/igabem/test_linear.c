/* GMRES alone, and the linear systems of the solver by LU and by GMRES. */
#include "check.h"
#include "solve/linear.h"

#include <igabem/status.h>

#include <lapacke.h>
#include <stdbool.h>
#include <string.h>

enum { N = 40, LARGE = 600 }; /* LARGE: LU by panels */

struct dense {
    size_t n;
    double a[N * N], diagonal[N];
};

static void multiply(const void *data, const double *x, double *y)
{
    const struct dense *dense = data;
    for (size_t i = 0; i < dense->n; i++) {
        y[i] = 0.0;
        for (size_t k = 0; k < dense->n; k++)
            y[i] += dense->a[i * dense->n + k] * x[k];
    }
}

static void divide(const void *data, const double *x, double *y)
{
    const struct dense *dense = data;
    for (size_t i = 0; i < dense->n; i++)
        y[i] = x[i] / dense->diagonal[i];
}

static double uniform(unsigned *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (double)(*state >> 8) / 16777216.0 - 0.5;
}

/* Diagonal from 1 to 1000 and an unsymmetric remainder of size 1. */
static void fill(struct dense *dense)
{
    unsigned state = 7;
    dense->n = N;
    for (size_t i = 0; i < N; i++) {
        for (size_t k = 0; k < N; k++)
            dense->a[i * N + k] = uniform(&state) / sqrt(N);
        dense->diagonal[i] = pow(1000.0, (double)i / (N - 1));
        dense->a[i * N + i] += dense->diagonal[i];
    }
}

static void fill_diagonal(struct dense *dense, size_t n)
{
    memset(dense, 0, sizeof *dense);
    dense->n = n;
    for (size_t i = 0; i < n; i++)
        dense->a[i * n + i] = dense->diagonal[i] = 1.0 + (double)i;
}

static struct gmres problem(const struct dense *dense, size_t restart)
{
    return (struct gmres){.n = dense->n,
                          .matrix = multiply,
                          .data = dense,
                          .restart = restart,
                          .most = 400,
                          .tolerance = 1e-12};
}

static void known_solution(const struct dense *dense, double *x, double *right)
{
    for (size_t i = 0; i < dense->n; i++)
        x[i] = sin(1.0 + (double)i);
    multiply(dense, x, right);
}

static double length(size_t n, const double *x)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += x[i] * x[i];
    return sqrt(sum);
}

/* Without and with a preconditioner, and restarted; the residual is that of x. */
static void test_converges(void)
{
    struct dense dense;
    double expected[N], right[N], x[N], r[N];
    size_t iterations[3];
    fill(&dense);
    known_solution(&dense, expected, right);
    for (int k = 0; k < 3; k++) {
        struct gmres gmres = problem(&dense, k == 2 ? 5 : N);
        struct gmres_result result;
        gmres.precondition = k == 0 ? NULL : divide;
        memset(x, 0, sizeof x);
        CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_OK);
        for (size_t i = 0; i < N; i++)
            CHECK_CLOSE(x[i], expected[i], 1e-9);
        multiply(&dense, x, r);
        for (size_t i = 0; i < N; i++)
            r[i] = right[i] - r[i];
        CHECK_CLOSE(result.residual, length(N, r) / length(N, right), 1e-16);
        CU_ASSERT(result.residual <= gmres.tolerance);
        iterations[k] = result.iterations;
    }
    CU_ASSERT(iterations[0] > 30 && iterations[0] <= N);
    CU_ASSERT(iterations[1] < 25);
    CU_ASSERT(iterations[2] >= iterations[1]);
}

static void test_trivial(void)
{
    struct dense dense;
    double expected[N], right[N], x[N];
    struct gmres_result result;
    fill(&dense);
    known_solution(&dense, expected, right);
    struct gmres gmres = problem(&dense, 10);
    memcpy(x, expected, sizeof x); /* starts from the solution */
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_OK);
    CU_ASSERT_EQUAL(result.iterations, 0);
    memset(right, 0, sizeof right);
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_OK);
    CU_ASSERT_EQUAL(result.iterations, 0);
    CHECK_CLOSE(result.residual, 0.0, 0.0);
    for (size_t i = 0; i < N; i++)
        CHECK_CLOSE(x[i], 0.0, 0.0);
}

/* The space closes before it is full: the solution is in it. */
static void test_lucky_breakdown(void)
{
    struct dense dense;
    double right[N] = {0}, x[N] = {0};
    struct gmres_result result;
    fill_diagonal(&dense, N);
    right[3] = 2.0;
    right[20] = -1.0;
    const struct gmres gmres = problem(&dense, 10);
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_OK);
    CU_ASSERT_EQUAL(result.iterations, 2);
    CHECK_CLOSE(x[3], 0.5, 1e-14);
    CHECK_CLOSE(x[20], -1.0 / 21.0, 1e-14);
}

static void test_singular(void)
{
    struct dense dense;
    double right[N] = {0}, x[N] = {0};
    struct gmres_result result;
    fill_diagonal(&dense, N);
    dense.a[5 * N + 5] = 0.0;
    right[1] = right[9] = 1.0;
    const struct gmres gmres = problem(&dense, 10);
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_OK); /* in the range */
    right[5] = 1.0;
    memset(x, 0, sizeof x);
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_ERROR_NUMERIC);
    CHECK_CLOSE(result.residual, 1.0 / sqrt(3.0), 1e-12);
    memset(dense.a, 0, sizeof dense.a);
    memset(x, 0, sizeof x);
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_ERROR_NUMERIC);
    CHECK_CLOSE(result.residual, 1.0, 0.0);
}

/* A cyclic shift: no vector of the space helps before it is full. */
static void test_stall(void)
{
    struct dense dense = {.n = 20};
    double right[N] = {1.0}, x[N] = {0};
    struct gmres_result result;
    for (size_t i = 0; i < 20; i++)
        dense.a[i * 20 + (i + 1) % 20] = 1.0;
    struct gmres gmres = problem(&dense, 6);
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_ERROR_NUMERIC);
    CU_ASSERT_EQUAL(result.iterations, 6);
    CHECK_CLOSE(result.residual, 1.0, 1e-14);
    gmres.restart = 20;
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_OK);
    CU_ASSERT_EQUAL(result.iterations, 20);
    CHECK_CLOSE(x[1], 1.0, 1e-14);
}

static void test_limit(void)
{
    struct dense dense;
    double expected[N], right[N], x[N] = {0};
    struct gmres_result result;
    fill(&dense);
    known_solution(&dense, expected, right);
    struct gmres gmres = problem(&dense, N);
    gmres.precondition = divide;
    gmres.most = 3;
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_ERROR_NUMERIC);
    CU_ASSERT_EQUAL(result.iterations, 3);
    CU_ASSERT(result.residual > gmres.tolerance && result.residual < 0.1);
    CU_ASSERT(strstr(igabem_last_error(), "3 iterations") != NULL);
}

static void test_not_finite(void)
{
    struct dense dense;
    double expected[N], right[N], x[N] = {0};
    struct gmres_result result;
    fill(&dense);
    known_solution(&dense, expected, right);
    const struct gmres gmres = problem(&dense, N);
    right[4] = NAN;
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_ERROR_NUMERIC);
    right[4] = INFINITY;
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_ERROR_NUMERIC);
    right[4] = 1.0;
    dense.a[N + 2] = NAN;
    CU_ASSERT_EQUAL(gmres_solve(&gmres, right, x, &result), IGABEM_ERROR_NUMERIC);
}

struct shift {
    size_t n;
    const double *rows;
};

static void add_shift(const void *data, const double *x, double *y)
{
    const struct shift *shift = data;
    for (size_t i = 0; i < shift->n; i++)
        for (size_t k = 0; k < shift->n; k++)
            y[i] += shift->rows[i * shift->n + k] * x[k];
}

/* A large diagonal along which x decreases, neighbours that matter, far entries that do not. */
static void fill_system(double *rows, size_t stride, double *point)
{
    unsigned state = 3;
    for (size_t i = 0; i < LARGE; i++) {
        point[3 * i] = -(double)((7 * i) % LARGE);
        point[3 * i + 1] = point[3 * i + 2] = 0.0;
    }
    for (size_t i = 0; i < LARGE; i++)
        for (size_t k = 0; k < LARGE; k++) {
            double d = point[3 * i] - point[3 * k];
            rows[i * stride + k] = (d == 0.0 ? 1.0 : 0.45) * exp(-0.5 * fabs(d)) +
                                   0.02 * uniform(&state) * (d > 0 ? 2.0 : 1.0);
        }
}

static void test_systems(void)
{
    enum { STRIDE = 3 * LARGE };
    double *rows = malloc(STRIDE * LARGE * sizeof *rows);
    double *sum = malloc(LARGE * LARGE * sizeof *sum);
    double *shift = calloc(LARGE * LARGE, sizeof *shift);
    double point[3 * LARGE], right[LARGE], x[LARGE], expected[LARGE], direct, estimate;
    CU_ASSERT_FATAL(rows && sum && shift);
    const struct matrix matrix = {.n = LARGE, .stride = STRIDE, .rows = rows, .threads = 2};
    unsigned state = 11;
    fill_system(rows, STRIDE, point);
    for (size_t i = 0; i < LARGE; i++) {
        right[i] = uniform(&state);
        for (size_t k = 0; k < LARGE; k++)
            shift[i * LARGE + k] = 0.01 * uniform(&state);
    }
    const struct shift data = {LARGE, shift};
    const struct addend addend = {add_shift, &data};
    struct iteration *iteration;
    CU_ASSERT_EQUAL_FATAL(iteration_create(&matrix, point, &iteration), IGABEM_OK);
    CU_ASSERT(iteration_memory(iteration) > 0);
    for (int k = 0; k < 2; k++) {
        struct gmres_result result;
        for (size_t i = 0; i < LARGE * LARGE; i++)
            sum[i] = rows[i / LARGE * STRIDE + i % LARGE] + (k ? shift[i] : 0.0);
        const struct matrix copy = {.n = LARGE, .stride = LARGE, .rows = sum, .threads = 1};
        memcpy(expected, right, sizeof expected);
        CU_ASSERT_EQUAL(linear_lu(&copy, expected, k ? NULL : &direct), IGABEM_OK);
        memset(x, 0, sizeof x);
        CU_ASSERT_EQUAL(iteration_solve(iteration, k ? &addend : NULL, right, x, &result),
                        IGABEM_OK);
        CU_ASSERT(result.iterations > 2 && result.iterations < 60);
        for (size_t i = 0; i < LARGE; i++)
            CHECK_CLOSE(x[i], expected[i], 1e-9);
    }
    CU_ASSERT_EQUAL(iteration_condition(iteration, &estimate), IGABEM_OK);
    CU_ASSERT(direct > 3.0);
    CHECK_RELATIVE(estimate, direct, 0.01);
    iteration_free(iteration);
    memset(rows, 0, LARGE * sizeof *rows);
    CU_ASSERT_EQUAL(iteration_create(&matrix, point, &iteration), IGABEM_ERROR_NUMERIC);
    CU_ASSERT_EQUAL(linear_lu(&matrix, right, NULL), IGABEM_ERROR_NUMERIC);
    rows[0] = NAN;
    CU_ASSERT_EQUAL(iteration_create(&matrix, point, &iteration), IGABEM_ERROR_NUMERIC);
    CU_ASSERT_EQUAL(linear_lu(&matrix, right, NULL), IGABEM_ERROR_NUMERIC);
    free(rows);
    free(sum);
    free(shift);
}

/* LAPACKE without memory for its own work arrays: the linker hands the library's calls to this. */
static lapack_int condition_info;
lapack_int __real_LAPACKE_dgecon(int layout, char norm, lapack_int n, const double *a,
                                 lapack_int stride, double size, double *reciprocal);
lapack_int __wrap_LAPACKE_dgecon(int layout, char norm, lapack_int n, const double *a,
                                 lapack_int stride, double size, double *reciprocal);
lapack_int __wrap_LAPACKE_dgecon(int layout, char norm, lapack_int n, const double *a,
                                 lapack_int stride, double size, double *reciprocal)
{
    return condition_info ? condition_info
                          : __real_LAPACKE_dgecon(layout, norm, n, a, stride, size, reciprocal);
}

static void test_lapack_fails(void)
{
    double a[4] = {2, 1, 1, 3}, right[2] = {1, 1}, condition;
    const struct matrix matrix = {.n = 2, .stride = 2, .rows = a};
    condition_info = LAPACK_WORK_MEMORY_ERROR;
    CU_ASSERT_EQUAL(linear_lu(&matrix, right, &condition), IGABEM_ERROR_MEMORY);
    CU_ASSERT(strstr(igabem_last_error(), "memory") != NULL);
    condition_info = 0;
    double again[4] = {2, 1, 1, 3};
    const struct matrix fresh = {.n = 2, .stride = 2, .rows = again};
    CU_ASSERT_EQUAL(linear_lu(&fresh, right, &condition), IGABEM_OK);
    CHECK_CLOSE(right[0], 0.4, 1e-15);
    CHECK_CLOSE(right[1], 0.2, 1e-15);
    CHECK_CLOSE(condition, 4.0 * 0.8, 1e-14); /* inverse (3 -1; -1 2) / 5 */
}

static const struct check_case cases[] = {
    {"LAPACK without memory", test_lapack_fails},
    {"GMRES converges", test_converges},
    {"GMRES: nothing to do", test_trivial},
    {"GMRES: lucky breakdown", test_lucky_breakdown},
    {"GMRES: singular matrices", test_singular},
    {"GMRES: stall", test_stall},
    {"GMRES: limit", test_limit},
    {"GMRES: not finite", test_not_finite},
    {"LU and GMRES, change, condition", test_systems},
};

CHECK_MAIN("linear", cases)
