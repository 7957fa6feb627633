/* Free-form deformation and given fields. */
#include "check.h"
#include "fixture.h"

#include <string.h>

static const galv_lattice lattice = {
    .box = {{-1, -0.05, -0.35}, {8, 0.5, 0.4}}, .count = {5, 4, 3}, .degree = {4, 3, 2}};

static double binomial(size_t n, size_t k)
{
    double value = 1;
    for (size_t i = 0; i < k; i++)
        value *= (double)(n - i) / (double)(i + 1);
    return value;
}

static double bernstein(size_t n, size_t k, double t)
{
    return binomial(n, k) * pow(t, (double)k) * pow(1 - t, (double)(n - k));
}

/* All control points moved along all axes. */
static size_t all_moves(const galv_lattice *l, galv_lattice_move *moves)
{
    size_t n = 0;
    for (size_t i = 0; i < l->count[0]; i++)
        for (size_t j = 0; j < l->count[1]; j++)
            for (size_t k = 0; k < l->count[2]; k++)
                for (int q = 0; q < 3; q++)
                    moves[n++] = (galv_lattice_move){{i, j, k}, q};
    return n;
}

static galv_shape *make(const galv_lattice *l, size_t n, const galv_lattice_move *moves)
{
    double *lower = malloc(n * sizeof *lower), *upper = malloc(n * sizeof *upper);
    for (size_t i = 0; i < n; i++)
        upper[i] = -(lower[i] = -0.05);
    galv_shape *shape = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_shape_ffd(l, n, moves, lower, upper, &shape), GALV_OK);
    free(lower);
    free(upper);
    return shape;
}

static void test_bernstein_lattice(void)
{
    static galv_lattice_move moves[5 * 4 * 3 * 3];
    size_t n = all_moves(&lattice, moves);
    galv_shape *shape = make(&lattice, n, moves);
    double x[5 * 4 * 3 * 3], xyz[3 * POINTS], d[3 * POINTS];
    fixture_grid(xyz);
    galv_uniform_sample(3, 0, n, galv_shape_lower(shape), galv_shape_upper(shape), x);
    CU_ASSERT_EQUAL(galv_shape_displace(shape, POINTS, xyz, x, d), GALV_OK);
    for (size_t p = 0; p < POINTS; p++) {
        double expected[3] = {0, 0, 0}, t[3];
        for (size_t j = 0; j < 3; j++)
            t[j] = (xyz[3 * p + j] - lattice.box.origin[j]) / lattice.box.length[j];
        for (size_t i = 0; i < n; i++) {
            double value = 1;
            for (size_t j = 0; j < 3; j++)
                value *= bernstein(lattice.count[j] - 1, moves[i].index[j], t[j]);
            expected[moves[i].direction] += x[i] * value;
        }
        for (size_t j = 0; j < 3; j++)
            CHECK_CLOSE(d[3 * p + j], expected[j], 1e-16);
    }
    galv_shape_free(shape);
}

/* B-splines of any degree: equal moves of all control points translate, moves linear in the
 * Greville abscissae stretch. */
static void test_spline_lattice_reproduces_lines(void)
{
    for (int degree = 1; degree <= 5; degree++) {
        galv_lattice l = {.box = {{0, 0, 0}, {1, 1, 1}}, .count = {8, 6, 7}};
        for (int j = 0; j < 3; j++)
            l.degree[j] = degree;
        static galv_lattice_move moves[8 * 6 * 7];
        static double x[8 * 6 * 7], ones[8 * 6 * 7];
        size_t n = 0;
        for (size_t i = 0; i < 8; i++)
            for (size_t j = 0; j < 6; j++)
                for (size_t k = 0; k < 7; k++) {
                    double greville = 0;
                    for (size_t a = i + 1; a <= i + (size_t)degree; a++) {
                        double spans = 8.0 - degree, t = ((double)a - degree) / spans;
                        greville += fmin(fmax(t, 0), 1) / degree;
                    }
                    x[n] = greville;
                    ones[n] = 1;
                    moves[n++] = (galv_lattice_move){{i, j, k}, 2};
                }
        galv_shape *shape = make(&l, n, moves);
        for (int p = 0; p <= 20; p++) {
            double point[3] = {p / 20.0, 0.37, 1 - p / 40.0}, d[3];
            galv_shape_displace(shape, 1, point, ones, d);
            CHECK_CLOSE(d[2], 1, 1e-14);
            galv_shape_displace(shape, 1, point, x, d);
            CHECK_CLOSE(d[2], point[0], 1e-14);
            CU_ASSERT_TRUE(d[0] == 0 && d[1] == 0);
        }
        galv_shape_free(shape);
    }
}

/* Left-out layers fix what they should: the centre plane stays, outside points stay, and with two
 * layers left out at an end, position and slope go to zero there. */
static void test_fixed_by_construction(void)
{
    galv_lattice l = {
        .box = {{0, 0, -0.3}, {6, 0.4, 0.3}}, .count = {7, 4, 3}, .degree = {3, 3, 2}};
    galv_lattice_move moves[3 * 3 * 3];
    double x[27];
    size_t n = 0;
    for (size_t i = 2; i < 5; i++)
        for (size_t j = 1; j < 4; j++)
            for (size_t k = 0; k < 3; k++) {
                x[n] = 0.05 * sin((double)n);
                moves[n++] = (galv_lattice_move){{i, j, k}, 1};
            }
    galv_shape *shape = make(&l, n, moves);
    double points[] = {3, 0, -0.1, 0, 0.2, -0.1, 6, 0.2, -0.1, 1e-4, 0.2, -0.1, 3, 0.2, 0.5}, d[15];
    CU_ASSERT_EQUAL(galv_shape_displace(shape, 5, points, x, d), GALV_OK);
    CU_ASSERT_EQUAL(d[1], 0);
    CU_ASSERT_EQUAL(d[4], 0);
    CU_ASSERT_EQUAL(d[7], 0);
    CU_ASSERT_TRUE(d[10] != 0 && fabs(d[10]) < 1e-9);
    CU_ASSERT_EQUAL(d[13], 0);
    galv_shape_free(shape);
}

/* A linear shape has the same latent space by its own method, by the covariance, and as given
 * fields. */
static void test_same_space_as_fields(void)
{
    enum { COUNT = 300 };
    galv_lattice_move moves[3 * 2 * 3];
    size_t n = 0;
    for (size_t i = 1; i < 4; i++)
        for (size_t j = 1; j < 3; j++)
            for (size_t k = 0; k < 3; k++)
                moves[n++] = (galv_lattice_move){{i, j, k}, 1};
    galv_shape *shape = make(&lattice, n, moves), *fields = NULL;
    double xyz[3 * POINTS], *rows = malloc(n * sizeof xyz), *x = fixture_samples(shape, COUNT, 2);
    fixture_grid(xyz);
    for (size_t i = 0; i < n; i++) {
        double unit[18] = {0};
        unit[i] = 1;
        galv_shape_displace(shape, POINTS, xyz, unit, rows + i * 3 * POINTS);
    }
    CU_ASSERT_EQUAL_FATAL(galv_shape_fields(n, POINTS, rows, galv_shape_lower(shape),
                                            galv_shape_upper(shape), &fields),
                          GALV_OK);
    galv_options options;
    galv_options_init(&options);
    const galv_shape *shapes[] = {shape, shape, fields};
    const galv_method methods[] = {GALV_METHOD_AUTO, GALV_METHOD_COVARIANCE, GALV_METHOD_GRAM};
    galv_model *model[3] = {NULL};
    for (int centre = 0; centre < 2; centre++) {
        options.centre = centre;
        for (int c = 0; c < 3; c++) {
            options.method = methods[c];
            CU_ASSERT_EQUAL_FATAL(
                galv_build(shapes[c], POINTS, xyz, galv_samples(COUNT, x), &options, &model[c]),
                GALV_OK);
        }
        CU_ASSERT_EQUAL(galv_model_method(model[0]), GALV_METHOD_FACTORED);
        const double *values = galv_model_eigenvalues(model[0]);
        for (int c = 1; c < 3; c++) {
            CU_ASSERT_EQUAL(galv_model_modes(model[c]), galv_model_modes(model[0]));
            CHECK_RELATIVE(galv_model_trace(model[c]), galv_model_trace(model[0]), 1e-13);
            for (size_t k = 0; k < galv_model_modes(model[0]); k++) {
                CHECK_CLOSE(galv_model_eigenvalues(model[c])[k], values[k], 1e-13 * values[0]);
                CHECK_CLOSE(galv_model_upper(model[c])[k], galv_model_upper(model[0])[k], 1e-9);
            }
            for (size_t i = 0; i < (size_t)3 * POINTS; i++)
                CHECK_CLOSE(galv_model_mean(model[c])[i], galv_model_mean(model[0])[i], 1e-15);
        }
        for (int c = 0; c < 3; c++)
            galv_model_free(model[c]);
    }
    double d[3 * POINTS];
    CU_ASSERT_EQUAL(galv_shape_displace(fields, POINTS - 1, xyz, x, d), GALV_ERROR_ARGUMENT);
    galv_shape_free(fields);
    galv_shape_free(shape);
    free(rows);
    free(x);
}

static void test_bad_lattices_are_named(void)
{
    galv_lattice l = lattice;
    galv_lattice_move move = {{1, 1, 1}, 1};
    double lower = 0, upper = 1;
    galv_shape *shape = NULL;
    l.degree[1] = 4;
    CU_ASSERT_EQUAL(galv_shape_ffd(&l, 1, &move, &lower, &upper, &shape), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "along y"));
    l = lattice;
    l.count[2] = 1;
    CU_ASSERT_EQUAL(galv_shape_ffd(&l, 1, &move, &lower, &upper, &shape), GALV_ERROR_ARGUMENT);
    l = lattice;
    move.index[0] = 5;
    CU_ASSERT_EQUAL(galv_shape_ffd(&l, 1, &move, &lower, &upper, &shape), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "move 0"));
    move.index[0] = 0;
    move.direction = -1;
    CU_ASSERT_EQUAL(galv_shape_ffd(&l, 1, &move, &lower, &upper, &shape), GALV_ERROR_ARGUMENT);
    double field[3] = {0, NAN, 0};
    CU_ASSERT_EQUAL(galv_shape_fields(1, 1, field, &lower, &upper, &shape), GALV_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"Bernstein lattice equals its definition", test_bernstein_lattice},
    {"spline lattices reproduce lines", test_spline_lattice_reproduces_lines},
    {"edges and centre plane fixed by construction", test_fixed_by_construction},
    {"one latent space by three ways", test_same_space_as_fields},
    {"bad lattices are named", test_bad_lattices_are_named},
};

CHECK_MAIN("galv lattice", cases)
