/* Volume, entrance and half breadths of grids and of latent points, against closed forms: a box, a
 * wedge, and the Wigley hull with V = 4/9 L B T and the waterline y = B/2 (1 - 4 x^2). */
#include "check.h"

#include <galv/galv.h>

#include <stdlib.h>
#include <string.h>

enum { ROWS = 41, COLUMNS = 17, N = ROWS * COLUMNS };

static const double BEAM = 0.1, DRAFT = 0.0625, TOP = 0.02;

/* Length 1, straight sides above the water, girth from the deck to the keel. */
static void wigley(size_t rows, size_t columns, double *points)
{
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            double x = (double)i / (double)(rows - 1) - 0.5;
            double z = TOP - (TOP + DRAFT) * (double)j / (double)(columns - 1);
            double *p = points + 3 * (i * columns + j);
            p[0] = x;
            p[1] = BEAM / 2 * (1 - 4 * x * x) * (z < 0 ? 1 - z * z / (DRAFT * DRAFT) : 1);
            p[2] = z;
        }
}

static double volume_of(size_t rows, size_t columns, const double *points)
{
    double volume = NAN;
    CU_ASSERT_EQUAL(galv_grid_volume(rows, columns, points, &volume), GALV_OK);
    return volume;
}

static void test_volume_converges(void)
{
    static double points[3 * 129 * 65];
    double exact = 4.0 / 9 * BEAM * DRAFT, error[3];
    for (size_t k = 0; k < 3; k++) {
        size_t rows = (32u << k) + 1, columns = (16u << k) + 1;
        wigley(rows, columns, points);
        error[k] = fabs(fabs(volume_of(rows, columns, points)) / exact - 1);
    }
    CU_ASSERT_TRUE(error[2] < 1e-3);
    CU_ASSERT_TRUE(error[1] < error[0] / 3);
    CU_ASSERT_TRUE(error[2] < error[1] / 3);
}

/* A wall-sided box is cut exactly wherever the water stands on its sides. */
static void test_volume_of_box(void)
{
    static const double z[4] = {-0.4, -0.07, 0.11, 0.3};
    double points[3 * 3 * 4], turned[3 * 3 * 4];
    for (size_t i = 0; i < 3; i++)
        for (size_t j = 0; j < 4; j++) {
            double *p = points + 3 * (4 * i + j), *q = turned + 3 * (4 * i + 3 - j);
            p[0] = 0.5 * (double)i;
            p[1] = 0.2;
            p[2] = z[j];
            memcpy(q, p, 3 * sizeof *p);
        }
    CHECK_RELATIVE(volume_of(3, 4, turned), 2 * 1.0 * 0.2 * 0.4, 1e-14);
    CHECK_RELATIVE(volume_of(3, 4, points), -2 * 1.0 * 0.2 * 0.4, 1e-14);
}

/* Vertical sides over a waterline given by y at the sections. */
static void prism(size_t sections, const double *x, const double *y, double *points)
{
    for (size_t i = 0; i < sections; i++)
        for (size_t j = 0; j < 2; j++)
            memcpy(points + 3 * (2 * i + j), (double[]){x[i], y[i], j ? 0.1 : -0.2},
                   3 * sizeof *points);
}

static void test_entrance_of_wedge(void)
{
    enum { SECTIONS = 6 };
    const double degree = acos(-1) / 180, fine = tan(12 * degree), blunt = tan(60 * degree);
    double x[SECTIONS] = {0, 1, 2, 3, 3.9, 4}, y[SECTIONS], points[6 * SECTIONS], entrance;
    for (size_t i = 0; i < SECTIONS; i++)
        y[i] = fine * (4 - x[i]);
    prism(SECTIONS, x, y, points);
    CU_ASSERT_EQUAL(galv_grid_entrance(SECTIONS, 2, points, 1, &entrance), GALV_OK);
    CHECK_RELATIVE(entrance, sin(12 * degree), 1e-14);
    /* A round stem, as a last piece at 60 degrees. */
    for (size_t i = 0; i < SECTIONS; i++)
        y[i] = fine * fmax(3.9 - x[i], 0) + blunt * fmin(4 - x[i], 0.1);
    prism(SECTIONS, x, y, points);
    CU_ASSERT_EQUAL(galv_grid_entrance(SECTIONS, 2, points, 1, &entrance), GALV_OK);
    CHECK_RELATIVE(entrance, sin(60 * degree), 1e-14);
    CU_ASSERT_EQUAL(galv_grid_entrance(SECTIONS, 2, points, 0.3, &entrance), GALV_OK);
    CHECK_RELATIVE(entrance, sin(12 * degree), 1e-14);
    for (size_t k = 2; k < 6 * SECTIONS; k += 3)
        points[k] -= 1;
    CU_ASSERT_EQUAL(galv_grid_entrance(SECTIONS, 2, points, 1, &entrance), GALV_ERROR_GEOMETRY);
}

/* A model of n displacement fields, orthogonal ones, on the Wigley grid. */
static galv_model *model_of(size_t n, const double *fields)
{
    double points[3 * N], lower[2] = {-0.2, -0.2}, upper[2] = {0.2, 0.2};
    galv_shape *shape = NULL;
    galv_model *model = NULL;
    galv_options options;
    galv_options_init(&options);
    options.variance = 1;
    wigley(ROWS, COLUMNS, points);
    CU_ASSERT_EQUAL_FATAL(galv_shape_fields(n, N, fields, lower, upper, &shape), GALV_OK);
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, N, points, galv_uniform(200, 1), &options, &model),
                          GALV_OK);
    galv_shape_free(shape);
    CU_ASSERT_EQUAL_FATAL(galv_model_modes(model), n);
    return model;
}

/* Latent point of d = sum x_i field_i. */
static void locate(const galv_model *model, size_t n, const double *fields, const double *x,
                   double *u)
{
    static double d[3 * N];
    memset(d, 0, sizeof d);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 3 * N; k++)
            d[k] += x[i] * fields[i * 3 * N + k];
    CU_ASSERT_EQUAL(galv_project(model, d, u), GALV_OK);
}

static double ratio_of(galv_status (*measure)(const galv_limits *, const double *, double *),
                       const galv_limits *limits, const double *u)
{
    double ratio = NAN;
    CU_ASSERT_EQUAL(measure(limits, u, &ratio), GALV_OK);
    return ratio;
}

/* Twelve percent more of everything at one end, none at the other. */
static void test_breadths(void)
{
    static double field[3 * N], points[3 * N];
    const double parent[1] = {0};
    double u[1], least, share;
    galv_limits *limits = NULL;
    wigley(ROWS, COLUMNS, points);
    for (size_t k = 0; k < 3 * N; k += 3)
        field[k + 1] = points[k + 1] * (1 + points[k]);
    galv_model *model = model_of(1, field);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 1, &limits), GALV_OK);
    locate(model, 1, field, (double[]){0.15}, u);
    CU_ASSERT_EQUAL(galv_limits_breadth(limits, u, &least, &share), GALV_OK);
    CHECK_CLOSE(least, 0, 1e-15);
    /* 1.5 times 0.15 at the fore end and half of it at the aft end; next to it. */
    CHECK_CLOSE(share, 1 + 0.15 * (1 - 0.475), 1e-12);
    locate(model, 1, field, (double[]){-1.2}, u);
    CU_ASSERT_EQUAL(galv_limits_breadth(limits, u, &least, NULL), GALV_OK);
    /* y of the waterline times 1 - 1.2 (1 + x), over the sections. */
    double expected = 0;
    for (size_t i = 0; i < ROWS; i++) {
        double x = points[3 * i * COLUMNS];
        expected = fmin(expected, BEAM / 2 * (1 - 4 * x * x) * (1 - 1.2 * (1 + x)));
    }
    CHECK_CLOSE(least, expected, 1e-14);
    CU_ASSERT_EQUAL(galv_limits_breadth(limits, parent, &least, &share), GALV_OK);
    CU_ASSERT_EQUAL(share, 1);
    galv_limits_free(limits);
    galv_model_free(model);
}

/* The waterline has the chords dy/dx = -2 B (x_i + x_{i+1}). */
static void test_entrance(void)
{
    static double field[3 * N], points[3 * N];
    const double slope = 2 * BEAM * (1 - 1.0 / (ROWS - 1)), wider = 1.2 * slope;
    const double parent[1] = {0};
    double u[1];
    galv_limits *limits = NULL;
    wigley(ROWS, COLUMNS, points);
    for (size_t k = 0; k < 3 * N; k += 3)
        field[k + 1] = points[k + 1];
    galv_model *model = model_of(1, field);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 0.3, &limits), GALV_OK);
    CHECK_CLOSE(ratio_of(galv_limits_entrance, limits, parent), 1, 1e-12);
    locate(model, 1, field, (double[]){0.2}, u);
    CHECK_RELATIVE(ratio_of(galv_limits_entrance, limits, u),
                   1.2 * sqrt((1 + slope * slope) / (1 + wider * wider)), 1e-3);
    galv_limits_free(limits);
    galv_model_free(model);
}

struct volume_call {
    size_t calls;
    double per_unit; /* what the callback answers: 1 + per_unit times the mean of y / y0 - 1 */
    const double *points;
    bool fails;
};

/* A hull 1.1 times as sensitive as its grid: a made-up builder whose gradient is known. */
static double built(void *user_data, const double *moved)
{
    struct volume_call *call = user_data;
    double mine = 0, parent = 0;
    call->calls++;
    if (call->fails)
        return NAN;
    for (size_t k = 1; k < 3 * N; k += 3) {
        mine += moved[k];
        parent += call->points[k];
    }
    return 5 * (1 + call->per_unit * (mine / parent - 1));
}

static void test_volume_gradient(void)
{
    static double fields[2 * 3 * N], points[3 * N];
    const double x[2] = {0.15, -0.1};
    double u[2], moved[3 * N], gradient[2];
    galv_limits *limits = NULL;
    wigley(ROWS, COLUMNS, points);
    for (size_t k = 0; k < 3 * N; k += 3) { /* orthogonal: even and odd in x */
        fields[k + 1] = points[k + 1];
        fields[3 * N + k + 1] = points[k + 1] * points[k];
    }
    struct volume_call call = {.per_unit = 1.1, .points = points};
    galv_model *model = model_of(2, fields);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 1, &limits), GALV_OK);
    CU_ASSERT_PTR_NULL(galv_limits_gradient(limits));
    locate(model, 2, fields, x, u);
    galv_displace(model, u, moved);
    double grid = volume_of(ROWS, COLUMNS, moved) / volume_of(ROWS, COLUMNS, points);
    CHECK_CLOSE(ratio_of(galv_limits_volume, limits, u), grid, 1e-13);
    CHECK_CLOSE(grid, 1.15, 1e-12); /* the odd field changes no volume */

    CU_ASSERT_EQUAL(galv_limits_linearise(limits, built, &call), GALV_OK);
    CU_ASSERT_EQUAL(call.calls, 5);
    CHECK_CLOSE(ratio_of(galv_limits_volume, limits, u), 1 + 1.1 * 0.15, 1e-12);
    memcpy(gradient, galv_limits_gradient(limits), sizeof gradient);
    galv_limits_free(limits);

    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 1, &limits), GALV_OK);
    CU_ASSERT_EQUAL(galv_limits_set_gradient(limits, gradient), GALV_OK);
    CHECK_CLOSE(ratio_of(galv_limits_volume, limits, u), 1 + 1.1 * 0.15, 1e-12);
    gradient[1] = NAN;
    CU_ASSERT_EQUAL(galv_limits_set_gradient(limits, gradient), GALV_ERROR_ARGUMENT);
    call.fails = true; /* then it is the grid's */
    CU_ASSERT_EQUAL(galv_limits_linearise(limits, built, &call), GALV_OK);
    CHECK_CLOSE(ratio_of(galv_limits_volume, limits, u), grid, 1e-12);
    galv_limits_free(limits);
    galv_model_free(model);
}

/* The volume by a closed form, as a builder of exact hulls has it. */
struct closed_form {
    double (*volume)(const double *moved);
};

static double exact(void *user_data, const double *moved)
{
    return ((struct closed_form *)user_data)->volume(moved);
}

/* Points that move along x too: 1.1 times the length and the breadth are 1.21 times the volume,
 * which is no linear function. */
static double stretched(const double *moved)
{
    double length = moved[3 * (N - 1)] - moved[0];
    return 4.0 / 9 * BEAM * DRAFT * length * length;
}

static void test_volume_of_longer_hulls(void)
{
    static double field[3 * N], points[3 * N];
    double u[1];
    struct closed_form form = {stretched};
    galv_limits *limits = NULL;
    wigley(ROWS, COLUMNS, points);
    for (size_t k = 0; k < 3 * N; k += 3) {
        field[k] = points[k];
        field[k + 1] = points[k + 1];
    }
    galv_model *model = model_of(1, field);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 1, &limits), GALV_OK);
    for (int known = 0; known < 2; known++) {
        locate(model, 1, field, (double[]){0.1}, u);
        CHECK_CLOSE(ratio_of(galv_limits_volume, limits, u), 1.21, 1e-12);
        CU_ASSERT_EQUAL(galv_limits_linearise(limits, exact, &form), GALV_OK);
        CU_ASSERT_PTR_NOT_NULL(galv_limits_gradient(limits));
    }
    galv_limits_free(limits);
    galv_model_free(model);
}

/* A hull that rises by d out of the water: the area of its sections is cut off at the height d. */
static double risen(const double *moved)
{
    double d = moved[2] - TOP, t = DRAFT - d;
    double area =
        d > 0 ? t - (pow(DRAFT, 3) - d * d * d) / (3 * DRAFT * DRAFT) : 2.0 / 3 * DRAFT - d;
    return 2.0 / 3 * BEAM * area;
}

/* Its volume, better than the grid has it, and the slope of its waterline, which runs between other
 * points than that of the parent. */
static void test_draft(void)
{
    static double field[3 * N], points[3 * N];
    const double slope = 2 * BEAM * (1 - 1.0 / (ROWS - 1));
    double u[1], raw[2];
    struct closed_form form = {risen};
    galv_limits *limits = NULL;
    wigley(ROWS, COLUMNS, points);
    for (size_t k = 2; k < 3 * N; k += 3)
        field[k] = 0.08; /* by at most 0.016 m up and down: the deck stays out of the water */
    galv_model *model = model_of(1, field);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 1, &limits), GALV_OK);
    for (int known = 0; known < 2; known++) {
        for (int side = 0; side < 2; side++) {
            double d = side ? 0.012 : -0.012;
            const double x[1] = {d / 0.08}, moved[3] = {0, 0, TOP + d};
            locate(model, 1, field, x, u);
            double expected = risen(moved) / risen((double[]){0, 0, TOP});
            double error = fabs(ratio_of(galv_limits_volume, limits, u) / expected - 1);
            CU_ASSERT_TRUE(error < 2e-3);
            if (known)
                CU_ASSERT_TRUE(error < raw[side]);
            raw[side] = error;
            double share = d > 0 ? 1 - d * d / (DRAFT * DRAFT) : 1, s = share * slope;
            CHECK_CLOSE(ratio_of(galv_limits_entrance, limits, u),
                        share * sqrt((1 + slope * slope) / (1 + s * s)), 1e-3);
        }
        CU_ASSERT_EQUAL(galv_limits_linearise(limits, exact, &form), GALV_OK);
    }
    galv_limits_free(limits);
    galv_model_free(model);
}

/* A flat side along (1, 0.4) whose x is stretched: its normal turns by a known angle, and points
 * back where x runs the other way. */
static void test_turn(void)
{
    enum { SIDE_ROWS = 6, SIDE_COLUMNS = 4, SIDE = SIDE_ROWS * SIDE_COLUMNS };
    static const double shares[] = {-0.2, 0.1, 0.2};
    double points[3 * SIDE], field[3 * SIDE] = {0}, u[1], least;
    const double lower[1] = {-1}, upper[1] = {1};
    galv_limits *limits = NULL;
    for (size_t k = 0; k < SIDE; k++) {
        double x = (double)(k / SIDE_COLUMNS), z = 0.3 - 0.2 * (double)(k % SIDE_COLUMNS);
        memcpy(points + 3 * k, (double[]){x, 0.4 * x, z}, 3 * sizeof *points);
        field[3 * k] = 0.4 * x; /* y */
    }
    galv_shape *shape = NULL;
    galv_model *model = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_shape_fields(1, SIDE, field, lower, upper, &shape), GALV_OK);
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, SIDE, points, galv_uniform(50, 1), NULL, &model),
                          GALV_OK);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, SIDE_ROWS, SIDE_COLUMNS, 1, &limits), GALV_OK);
    for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
        double d[3 * SIDE], a = shares[i], grown = 1 + 0.4 * a;
        for (size_t k = 0; k < (size_t)3 * SIDE; k++)
            d[k] = a * field[k];
        CU_ASSERT_EQUAL(galv_project(model, d, u), GALV_OK);
        CU_ASSERT_EQUAL(galv_limits_turn(limits, u, &least), GALV_OK);
        /* from the direction (1, 0.4) to (1 + 0.4 a, 0.4) */
        CHECK_CLOSE(least, (grown + 0.16) / sqrt(1.16 * (grown * grown + 0.16)), 1e-12);
    }
    for (size_t k = 0; k < (size_t)3 * SIDE; k++)
        field[k] *= -6; /* x from 1 to 1 - 2.4 a section */
    CU_ASSERT_EQUAL(galv_project(model, field, u), GALV_OK);
    CU_ASSERT_EQUAL(galv_limits_turn(limits, u, &least), GALV_OK);
    CHECK_CLOSE(least, (-1.4 + 0.16) / sqrt(1.16 * (1.96 + 0.16)), 1e-12);
    galv_limits_free(limits);
    galv_model_free(model);
    galv_shape_free(shape);
}

static void test_refusals(void)
{
    static double field[3 * N], points[3 * N];
    double out, u[1] = {NAN};
    galv_limits *limits = NULL;
    wigley(ROWS, COLUMNS, points);
    for (size_t k = 1; k < 3 * N; k += 3)
        field[k] = 1;
    galv_model *model = model_of(1, field);
    CU_ASSERT_EQUAL(galv_limits_create(model, COLUMNS, COLUMNS, 1, &limits), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_limits_create(model, ROWS, COLUMNS, NAN, &limits), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NULL(limits);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, ROWS, COLUMNS, 1, &limits), GALV_OK);
    CU_ASSERT_EQUAL(galv_limits_volume(limits, u, &out), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_limits_entrance(limits, u, &out), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_limits_breadth(limits, u, &out, NULL), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_limits_turn(limits, u, &out), GALV_ERROR_ARGUMENT);
    points[7] = INFINITY;
    CU_ASSERT_EQUAL(galv_grid_volume(ROWS, COLUMNS, points, &out), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), "grid point 0,2"));
    galv_limits_free(limits);
    galv_model_free(model);
}

static const struct check_case cases[] = {
    {"volume of a grid converges", test_volume_converges},
    {"volume of a box is exact", test_volume_of_box},
    {"entrance of a wedge", test_entrance_of_wedge},
    {"half breadths", test_breadths},
    {"entrance of latent points", test_entrance},
    {"gradient of the volume", test_volume_gradient},
    {"volume of longer hulls", test_volume_of_longer_hulls},
    {"volume and waterline at other drafts", test_draft},
    {"how far cells turn", test_turn},
    {"refusals", test_refusals},
};

CHECK_MAIN("galv limits", cases)
