/* Models that grow, that are written out, and that come from plain data; where latent points lie.
 */
#include "check.h"
#include "fixture.h"

#include <string.h>

static double grid[3 * POINTS];

static galv_model *build(const galv_shape *shape, galv_sampling sampling,
                         const galv_options *options)
{
    galv_model *model = NULL;
    fixture_grid(grid);
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, POINTS, grid, sampling, options, &model), GALV_OK);
    return model;
}

/* A model of N samples extended by M against one of N + M. */
static void compare_extension(bool centre, bool weighted, galv_combination combination)
{
    enum { OLD = 300, ADDED = 250 };
    double weights[POINTS];
    fixture_grid(grid);
    galv_grid_weights(SECTIONS, GIRTH, grid, weights);
    galv_shape *shape = fixture_shape(combination, 0.03);
    galv_options options;
    galv_options_init(&options);
    options.centre = centre;
    options.weights = weighted ? weights : NULL;
    galv_model *old = build(shape, galv_uniform(OLD, 7), &options);
    galv_model *whole = build(shape, galv_uniform(OLD + ADDED, 7), &options), *grown = NULL;
    galv_sampling more = galv_uniform(ADDED, 7);
    more.first = OLD;
    CU_ASSERT_EQUAL_FATAL(galv_extend(old, shape, more, &options, &grown), GALV_OK);
    CU_ASSERT_EQUAL(galv_model_samples(grown), OLD + ADDED);
    CU_ASSERT_EQUAL(galv_model_modes(grown), galv_model_modes(whole));
    CHECK_RELATIVE(galv_model_trace(grown), galv_model_trace(whole), 1e-12);
    double bound = galv_model_truncation(grown), scale = galv_model_eigenvalues(whole)[0];
    size_t m = galv_model_modes(grown);
    for (size_t k = 0; k < m; k++) {
        double lost = galv_model_eigenvalues(whole)[k] - galv_model_eigenvalues(grown)[k];
        CU_ASSERT_TRUE(lost >= -1e-13 * scale && lost <= bound + 1e-13 * scale);
    }
    if (combination == GALV_COMBINATION_LINEAR) /* nothing beyond the pairs kept: exact */
        CHECK_CLOSE(bound, 0, 1e-13 * scale);
    else
        CU_ASSERT_TRUE(bound < galv_model_eigenvalues(whole)[m - 1]);
    for (size_t i = 0; i < (size_t)3 * POINTS; i++)
        CHECK_CLOSE(galv_model_mean(grown)[i], galv_model_mean(whole)[i], 1e-15);
    /* New samples are projected as galv_project() does, old ones carried over to their modes'
     * accuracy. */
    for (size_t r = 0; r < OLD + ADDED; r += 50) {
        double x[FUNCTIONS], d[3 * POINTS], u[FUNCTIONS];
        galv_uniform_sample(7, r, FUNCTIONS, galv_shape_lower(shape), galv_shape_upper(shape), x);
        galv_shape_displace(shape, POINTS, grid, x, d);
        galv_project(grown, d, u);
        for (size_t k = 0; k < m; k++)
            CHECK_CLOSE(galv_model_latent(grown)[r * m + k], u[k],
                        r < OLD ? 0.3 * sqrt(scale) : 1e-12);
    }
    double residual, x[FUNCTIONS], u[FUNCTIONS] = {0};
    u[0] = 0.5 * galv_model_upper(grown)[0];
    CU_ASSERT_EQUAL(galv_backmap(grown, shape, u, x, &residual), GALV_OK);
    CU_ASSERT_TRUE(residual < 0.01);
    CU_ASSERT_TRUE(galv_model_confidence(grown).angle > 0);
    galv_model_free(old);
    galv_model_free(whole);
    galv_model_free(grown);
    galv_shape_free(shape);
}

static void test_extension_equals_rebuilding(void)
{
    compare_extension(false, false, GALV_COMBINATION_LINEAR);
    compare_extension(true, true, GALV_COMBINATION_LINEAR);
    compare_extension(false, false, GALV_COMBINATION_RECURSIVE);
    compare_extension(true, false, GALV_COMBINATION_RECURSIVE);
    compare_extension(false, true, GALV_COMBINATION_RECURSIVE);
}

static void test_extension_refuses(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_LINEAR, 0.03), *other = NULL;
    galv_model *model = build(shape, galv_uniform(50, 1), NULL), *grown = NULL;
    galv_sine function;
    double lower = 0, upper = 1;
    function = (galv_sine){.order = {1, 1, 1}, .direction = 1};
    galv_shape_sine(1, &function, &fixture_box, &lower, &upper, GALV_COMBINATION_LINEAR, &other);
    CU_ASSERT_EQUAL(galv_extend(model, other, galv_uniform(5, 1), NULL, &grown),
                    GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_extend(model, shape, galv_uniform(0, 1), NULL, &grown),
                    GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_extend(NULL, shape, galv_uniform(5, 1), NULL, &grown),
                    GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_shape_free(other);
    galv_shape_free(shape);
}

enum { FIELDS = 30 };

/* All fields of a model; the place of one of them. */
static void take_fields(const galv_model *model, galv_field *fields)
{
    CU_ASSERT_EQUAL_FATAL(galv_model_field_count(), FIELDS);
    for (size_t i = 0; i < FIELDS; i++)
        fields[i] = galv_model_field(model, i);
}

static galv_field *named(galv_field *fields, const char *name)
{
    for (size_t i = 0; i < FIELDS; i++)
        if (strcmp(fields[i].name, name) == 0)
            return fields + i;
    CU_FAIL_FATAL("no such field");
    return NULL;
}

static size_t size_of(const galv_field *field)
{
    size_t one = field->type == GALV_TYPE_SIZE   ? sizeof(size_t)
                 : field->type == GALV_TYPE_BOOL ? sizeof(bool)
                                                 : sizeof(double);
    return field->rows * field->columns * one;
}

/* Restoring gives every field back with the same bits, from numbers of their own type, from
 * doubles, and in any order. */
static void test_fields_and_restore(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_options options;
    galv_options_init(&options);
    options.centre = true;
    galv_model *model = build(shape, galv_uniform(120, 1), &options), *copy = NULL;
    galv_field fields[FIELDS], again[FIELDS], doubles[FIELDS];
    double numbers[FIELDS];
    take_fields(model, fields);
    for (size_t i = 0; i < FIELDS; i++) {
        doubles[FIELDS - 1 - i] = fields[i];
        if (fields[i].dimensions == 0) {
            numbers[i] = galv_field_number(&fields[i]);
            doubles[FIELDS - 1 - i].type = GALV_TYPE_DOUBLE;
            doubles[FIELDS - 1 - i].values = &numbers[i];
        }
    }
    for (int pass = 0; pass < 2; pass++) {
        CU_ASSERT_EQUAL_FATAL(galv_model_restore(FIELDS, pass ? doubles : fields, &copy), GALV_OK);
        take_fields(copy, again);
        for (size_t i = 0; i < FIELDS; i++) {
            CU_ASSERT_EQUAL(again[i].rows, fields[i].rows);
            CU_ASSERT_EQUAL(!again[i].values, !fields[i].values);
            if (fields[i].values)
                CU_ASSERT_EQUAL(memcmp(again[i].values, fields[i].values, size_of(&fields[i])), 0);
        }
        double u[FUNCTIONS], x[FUNCTIONS], y[FUNCTIONS];
        for (size_t k = 0; k < galv_model_modes(model); k++)
            u[k] = 0.3 * galv_model_upper(model)[k];
        CU_ASSERT_EQUAL(galv_backmap(model, shape, u, x, NULL), GALV_OK);
        CU_ASSERT_EQUAL(galv_backmap(copy, shape, u, y, NULL), GALV_OK);
        CU_ASSERT_EQUAL(memcmp(x, y, sizeof x), 0);
        galv_model_free(copy);
    }
    galv_model_free(model);
    galv_shape_free(shape);
}

static void refuses(const galv_field *fields, const char *sentence)
{
    galv_model *model = NULL;
    CU_ASSERT_EQUAL(galv_model_restore(FIELDS, fields, &model), GALV_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(galv_last_error(), sentence));
    CU_ASSERT_PTR_NULL(model);
}

static void test_restore_refuses_by_name(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model = build(shape, galv_uniform(120, 1), NULL);
    galv_field fields[FIELDS];
    size_t modes = galv_model_field_count() * 1000;
    double half = 0.5, *values = malloc(galv_model_spectrum(model) * sizeof *values);
    take_fields(model, fields);
    named(fields, "modes")->values = &modes;
    refuses(fields, "30000 modes");
    take_fields(model, fields);
    named(fields, "vectors")->values = NULL;
    refuses(fields, "'vectors' is missing");
    take_fields(model, fields);
    named(fields, "trace")->values = NULL;
    refuses(fields, "'trace' is missing");
    take_fields(model, fields);
    named(fields, "latent")->rows--;
    refuses(fields, "'latent' is 119 x ");
    take_fields(model, fields);
    *named(fields, "samples") =
        (galv_field){.name = "samples", .type = GALV_TYPE_DOUBLE, .values = &half};
    refuses(fields, "'samples' is 0.5");
    take_fields(model, fields);
    named(fields, "mean")->name = "meen";
    refuses(fields, "no 'meen'");
    take_fields(model, fields);
    *named(fields, "upper") = *named(fields, "lower");
    refuses(fields, "'lower' is given twice");
    take_fields(model, fields);
    memcpy(values, galv_model_eigenvalues(model), galv_model_spectrum(model) * sizeof *values);
    values[3] = NAN;
    named(fields, "eigenvalues")->values = values;
    refuses(fields, "'eigenvalues': entry 3");
    values[3] = 2 * values[0];
    refuses(fields, "'eigenvalues': entry 3");
    CU_ASSERT_STRING_EQUAL(galv_model_field(NULL, FIELDS).name, "");
    free(values);
    galv_model_free(model);
    galv_shape_free(shape);
}

/* The displaced grid is the parent plus the mean plus the modes, summed here in another order. */
static void test_displaced_grid(void)
{
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_options options;
    galv_options_init(&options);
    options.centre = true;
    galv_model *model = build(shape, galv_uniform(120, 1), &options);
    double u[FUNCTIONS], moved[3 * POINTS], xyz[3 * POINTS], d[3 * POINTS];
    size_t modes = galv_model_modes(model), length = galv_model_coordinates(model);
    for (size_t k = 0; k < modes; k++)
        u[k] = 0.4 * galv_model_lower(model)[k];
    fixture_grid(xyz);
    CU_ASSERT_EQUAL(galv_displace(model, u, moved), GALV_OK);
    CU_ASSERT_EQUAL(galv_reconstruct(model, u, d), GALV_OK);
    for (size_t i = 0; i < length; i++) {
        double sum = 0;
        for (size_t k = modes; k-- > 0;)
            sum += u[k] * galv_model_vectors(model)[k * length + i];
        CHECK_CLOSE(moved[i], xyz[i] + (galv_model_mean(model)[i] + sum), 1e-15);
        CU_ASSERT_EQUAL(moved[i], d[i] + xyz[i]);
    }
    u[0] = NAN;
    CU_ASSERT_EQUAL(galv_displace(model, u, moved), GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_shape_free(shape);
}

struct matrix {
    const double *rows;
    size_t length, refuse;
};

static int matrix_rows(void *user_data, size_t first, size_t count, double *rows)
{
    const struct matrix *m = user_data;
    memcpy(rows, m->rows + first * m->length, count * m->length * sizeof *rows);
    return first + count > m->refuse ? 5 : 0;
}

static void test_plain_data(void)
{
    enum { COUNT = 90, LENGTH = 40 };
    static double rows[COUNT * LENGTH], weights[LENGTH];
    for (size_t r = 0; r < COUNT; r++)
        for (size_t i = 0; i < LENGTH; i++)
            rows[r * LENGTH + i] = sin((double)(r * (i + 1))) / (double)(1 + i * i);
    for (size_t i = 0; i < LENGTH; i++)
        weights[i] = 1 + (double)i;
    struct matrix matrix = {rows, LENGTH, COUNT};
    galv_data data = {.count = COUNT,
                      .coordinates = LENGTH,
                      .rows = matrix_rows,
                      .user_data = &matrix,
                      .weights = weights};
    double *values = fixture_spectrum(COUNT, LENGTH, rows, true, weights, 0, NULL);
    galv_options options;
    galv_options_init(&options);
    options.centre = true;
    galv_model *model = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_build_data(&data, &options, &model), GALV_OK);
    for (size_t k = 0; k < LENGTH; k++)
        CHECK_CLOSE(galv_model_eigenvalues(model)[k], values[k], 1e-14 * values[0]);
    /* The array itself gives the same bits as its rows one by one. */
    galv_data array = {.count = COUNT, .coordinates = LENGTH, .weights = weights, .values = rows};
    galv_model *same = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_build_data(&array, &options, &same), GALV_OK);
    CU_ASSERT_EQUAL(memcmp(galv_model_eigenvalues(model), galv_model_eigenvalues(same),
                           LENGTH * sizeof(double)),
                    0);
    galv_model_free(same);
    double x, u[LENGTH] = {0};
    galv_shape *shape = fixture_shape(GALV_COMBINATION_LINEAR, 1);
    CU_ASSERT_EQUAL(galv_backmap(model, shape, u, &x, NULL), GALV_ERROR_ARGUMENT);
    galv_shape_free(shape);
    galv_model_free(model);
    matrix.refuse = 10;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_ERROR_NUMERIC);
    data.count = 0;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_ERROR_ARGUMENT);
    free(values);
}

/* Displacements of points that no shape gave: the model moves its points and takes their weights.
 */
static void test_snapshots(void)
{
    enum { COUNT = 30, PLACES = 8, LENGTH = 3 * PLACES };
    static double rows[COUNT * LENGTH], xyz[LENGTH], weights[PLACES], each[LENGTH];
    for (size_t r = 0; r < COUNT; r++)
        for (size_t i = 0; i < LENGTH; i++)
            rows[r * LENGTH + i] = sin((double)(r * (i + 2))) / (double)(2 + i);
    for (size_t i = 0; i < LENGTH; i++) {
        xyz[i] = cos((double)i);
        weights[i / 3] = each[i] = 1 + (double)(i / 3);
    }
    galv_options options;
    galv_options_init(&options);
    options.variance = 1;
    options.weights = weights;
    galv_data data = {
        .count = COUNT, .coordinates = LENGTH, .values = rows, .npoints = PLACES, .xyz = xyz};
    galv_model *model = NULL, *plain = NULL;
    CU_ASSERT_EQUAL_FATAL(galv_build_data(&data, &options, &model), GALV_OK);
    galv_data bare = {.count = COUNT, .coordinates = LENGTH, .values = rows, .weights = each};
    CU_ASSERT_EQUAL_FATAL(galv_build_data(&bare, &options, &plain), GALV_OK);
    CU_ASSERT_EQUAL(galv_model_trace(model), galv_model_trace(plain));
    CU_ASSERT_EQUAL(galv_model_points(model), PLACES);
    CU_ASSERT_EQUAL(galv_model_parameters(model), 0);
    /* All modes are kept, so each snapshot comes back whole. */
    double moved[LENGTH];
    size_t m = galv_model_modes(model);
    for (size_t r = 0; r < COUNT; r++) {
        CU_ASSERT_EQUAL_FATAL(galv_displace(model, galv_model_latent(model) + r * m, moved),
                              GALV_OK);
        for (size_t i = 0; i < LENGTH; i++)
            CHECK_CLOSE(moved[i], xyz[i] + rows[r * LENGTH + i], 1e-12);
    }
    CU_ASSERT_EQUAL(galv_displace(plain, galv_model_latent(plain), moved), GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_model_free(plain);
    data.npoints = PLACES - 1;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_ERROR_ARGUMENT);
    data.npoints = PLACES;
    data.xyz = NULL;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_ERROR_ARGUMENT);
    data.xyz = xyz;
    rows[5] = NAN;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_ERROR_NUMERIC);
}

/* Shares of the samples, counted. */
static void test_bounds_cover_their_share(void)
{
    enum { COUNT = 1000 };
    galv_shape *shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    galv_model *model = build(shape, galv_uniform(COUNT, 1), NULL);
    size_t m = galv_model_modes(model);
    const double *latent = galv_model_latent(model);
    double lower[FUNCTIONS], upper[FUNCTIONS], radius, nearest, r90;
    CU_ASSERT_EQUAL(galv_latent_bounds(model, 1, lower, upper), GALV_OK);
    for (size_t k = 0; k < m; k++) {
        CU_ASSERT_EQUAL(lower[k], galv_model_lower(model)[k]);
        CU_ASSERT_EQUAL(upper[k], galv_model_upper(model)[k]);
    }
    CU_ASSERT_EQUAL(galv_latent_bounds(model, 0.9, lower, upper), GALV_OK);
    CU_ASSERT_EQUAL(galv_latent_ellipsoid(model, 0.9, &r90), GALV_OK);
    size_t inside = 0;
    for (size_t k = 0; k < m; k++) {
        size_t within = 0;
        for (size_t r = 0; r < COUNT; r++)
            within += latent[r * m + k] >= lower[k] && latent[r * m + k] <= upper[k];
        CU_ASSERT_TRUE(within >= 898 && within <= 902);
    }
    for (size_t r = 0; r < COUNT; r++) {
        CU_ASSERT_EQUAL(galv_latent_distance(model, latent + r * m, &radius, NULL), GALV_OK);
        inside += radius <= r90;
    }
    CU_ASSERT_TRUE(inside >= 899 && inside <= 901);
    double u[FUNCTIONS] = {0};
    memcpy(u, latent + 17 * m, m * sizeof *u);
    CU_ASSERT_EQUAL(galv_latent_distance(model, u, NULL, &nearest), GALV_OK);
    CU_ASSERT_EQUAL(nearest, 0);
    u[0] += 100 * sqrt(galv_model_eigenvalues(model)[0]);
    CU_ASSERT_EQUAL(galv_latent_distance(model, u, &radius, &nearest), GALV_OK);
    CU_ASSERT_TRUE(nearest > 95 && nearest < 105 && radius > 95);
    CU_ASSERT_EQUAL(galv_latent_bounds(model, 0, lower, upper), GALV_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(galv_latent_ellipsoid(model, 1.1, &radius), GALV_ERROR_ARGUMENT);
    galv_model_free(model);
    galv_shape_free(shape);
}

static const struct check_case cases[] = {
    {"extending equals rebuilding", test_extension_equals_rebuilding},
    {"extending refuses what does not fit", test_extension_refuses},
    {"a model as fields and back", test_fields_and_restore},
    {"restoring refuses by name", test_restore_refuses_by_name},
    {"the displaced grid", test_displaced_grid},
    {"plain data", test_plain_data},
    {"snapshots of points", test_snapshots},
    {"bounds cover their share", test_bounds_cover_their_share},
};

CHECK_MAIN("galv extend", cases)
