/* The reference spectra of tests/data/galv_reference.csv, on the design grid of the hull that comes
 * with the project: to rounding against those of that grid, and within what the fit of the hull
 * changes against those of the original one. */
#include "check.h"

#include <galv/galv.h>
#include <nurbs/nurbs.h>

#include <string.h>

enum { N = 500, FUNCTIONS = 27, SECTIONS = 90, GIRTH = 25, POINTS = SECTIONS * GIRTH };

static double samples[N * FUNCTIONS], grid[3 * POINTS];

static const int orders[3][FUNCTIONS] = {
    {1, 1, 1, 1, 1, 2, 3, 1, 1, 1, 1, 2, 2, 3, 3, 2, 2, 3, 3, 2, 2, 2, 2, 3, 3, 3, 3},
    {1, 1, 1, 2, 3, 1, 1, 2, 2, 3, 3, 1, 1, 1, 1, 2, 3, 2, 3, 2, 2, 3, 3, 2, 3, 2, 3},
    {1, 2, 3, 1, 1, 1, 1, 2, 3, 2, 3, 2, 3, 2, 3, 1, 1, 1, 1, 2, 3, 2, 3, 2, 2, 3, 3},
};

static void make_samples(void)
{
    long long s = 20220527;
    for (size_t i = 0; i < N * FUNCTIONS; i++) {
        s = 16807 * s % 2147483647;
        samples[i] = 0.0195 * (2 * ((double)s / 2147483647) - 1);
    }
}

static galv_shape *make_shape(galv_combination combination)
{
    const galv_box box = {{0, 0, -6.16 * 5.72 / 142}, {6.11880671, 0.41367282, 0.77321795}};
    galv_sine functions[FUNCTIONS];
    double lower[FUNCTIONS], upper[FUNCTIONS];
    for (int i = 0; i < FUNCTIONS; i++) {
        functions[i] =
            (galv_sine){.order = {orders[0][i], orders[1][i], orders[2][i]}, .direction = 1};
        upper[i] = -(lower[i] = -0.0195);
    }
    galv_shape *shape = NULL;
    galv_shape_sine(FUNCTIONS, functions, &box, lower, upper, combination, &shape);
    return shape;
}

static void read_grid(void)
{
    nurbs_hull *hull = NULL;
    nurbs_grid *points = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_read(EXAMPLES_DIR "/hulls/dtmb5415.json", NULL, &hull),
                          NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_design_grid(hull, 0, 0, &points), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_rows(points), SECTIONS);
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_columns(points), GIRTH);
    memcpy(grid, nurbs_grid_points(points), sizeof grid);
    nurbs_grid_free(points);
    nurbs_hull_free(hull);
}

struct line {
    char quantity[16], set[24], where[24];
    double value;
};

/* Hands every line of the reference to `check`; returns their number. */
static size_t each_line(void (*check)(const struct line *, void *), void *user_data)
{
    FILE *stream = fopen(TEST_DATA_DIR "/galv_reference.csv", "r");
    char text[256];
    size_t lines = 0;
    CU_ASSERT_PTR_NOT_NULL_FATAL(stream);
    while (fgets(text, sizeof text, stream)) {
        struct line line = {"", "", "", 0};
        char *field[4] = {text};
        if (*text == '#')
            continue;
        for (int f = 1; f < 4 && field[f - 1]; f++)
            if ((field[f] = strchr(field[f - 1], ',')))
                *field[f]++ = '\0';
        if (!field[3] || sscanf(field[3], "%lf", &line.value) != 1)
            continue;
        snprintf(line.quantity, sizeof line.quantity, "%.15s", field[0]);
        snprintf(line.set, sizeof line.set, "%.23s", field[1]);
        snprintf(line.where, sizeof line.where, "%.23s", field[2]);
        check(&line, user_data);
        lines++;
    }
    fclose(stream);
    return lines;
}

static void check_parameter(const struct line *line, void *user_data)
{
    size_t index, *seen = user_data;
    if (strcmp(line->quantity, "parameter") != 0)
        return;
    CU_ASSERT_EQUAL(sscanf(line->where, "%zu", &index), 1);
    CHECK_RELATIVE(samples[index], line->value, 1e-14);
    ++*seen;
}

static void test_parameters(void)
{
    size_t seen = 0;
    make_samples();
    CU_ASSERT_TRUE(each_line(check_parameter, &seen) > 80);
    CU_ASSERT_EQUAL(seen, 3);
}

/* How far a quantity may be off: metres for displacements, else relative. */
struct tolerance {
    double displacement, trace, leading, trailing, peak;
};
/* Both programs sum 500 samples in double precision; the small eigenvalues of the linear set are
 * 1e-6 of the first. */
static const struct tolerance same_grid = {1e-14, 1e-12, 1e-10, 1e-8, 1e-9};
/* The fitted hull is up to 1e-4 m from the original grid. */
static const struct tolerance fitted_grid = {3e-5, 2e-5, 2e-4, 2e-3, 3e-4};

struct comparison {
    const char *set;
    const struct tolerance *tolerance;
    const galv_shape *shape;
    const galv_model *model;
    size_t seen;
};

static void check_line(const struct line *line, void *user_data)
{
    struct comparison *c = user_data;
    const struct tolerance *t = c->tolerance;
    size_t a = 0, i = 0, j = 0;
    static double d[3 * POINTS];
    if (strcmp(line->set, c->set) != 0)
        return;
    c->seen++;
    int numbers = sscanf(line->where, "%zu %zu %zu", &a, &i, &j);
    size_t place = 3 * ((i - 1) * GIRTH + j - 1) + 1;
    if (strcmp(line->quantity, "displacement") == 0 && numbers == 3) {
        CU_ASSERT_EQUAL(
            galv_shape_displace(c->shape, POINTS, grid, samples + (a - 1) * FUNCTIONS, d), GALV_OK);
        CHECK_CLOSE(d[place], line->value, t->displacement);
    } else if (strcmp(line->quantity, "trace") == 0) {
        CHECK_RELATIVE(galv_model_trace(c->model), line->value, t->trace);
    } else if (strcmp(line->quantity, "modes95") == 0) {
        CU_ASSERT_EQUAL(galv_model_modes(c->model), (size_t)line->value);
    } else if (strcmp(line->quantity, "eigenvalue") == 0) {
        CHECK_RELATIVE(galv_model_eigenvalues(c->model)[a - 1], line->value,
                       a <= 20 ? t->leading : t->trailing);
    } else if (strcmp(line->quantity, "peak") == 0 && numbers == 3) {
        CHECK_RELATIVE(galv_model_vectors(c->model)[(a - 1) * 3 * POINTS + place], line->value,
                       t->peak);
    }
}

static void compare(const char *set, const struct tolerance *tolerance, size_t lines,
                    const galv_shape *shape, const galv_model *model)
{
    struct comparison c = {set, tolerance, shape, model, 0};
    each_line(check_line, &c);
    CU_ASSERT_EQUAL(c.seen, lines);
}

static void test_spectra(void)
{
    read_grid();
    make_samples();
    for (int recursive = 0; recursive < 2; recursive++)
        for (int method = GALV_METHOD_COVARIANCE; method <= GALV_METHOD_RANDOMISED; method++) {
            galv_shape *shape =
                make_shape(recursive ? GALV_COMBINATION_RECURSIVE : GALV_COMBINATION_LINEAR);
            galv_model *model = NULL;
            galv_options options;
            galv_options_init(&options);
            options.method = (galv_method)method;
            CU_ASSERT_EQUAL_FATAL(
                galv_build(shape, POINTS, grid, galv_samples(N, samples), &options, &model),
                GALV_OK);
            compare(recursive ? "shipped recursive" : "shipped linear", &same_grid, 38, shape,
                    model);
            compare(recursive ? "recursive" : "linear", &fitted_grid, recursive ? 50 : 37, shape,
                    model);
            galv_model_free(model);
            galv_shape_free(shape);
        }
}

static const struct check_case cases[] = {
    {"the stream of parameters", test_parameters},
    {"spectra of two grids", test_spectra},
};

CHECK_MAIN("galv reference", cases)
