/* NULL in every pointer of every public call: a status and a sentence, or 0, NaN, NULL or "" where
 * a value is returned; never a crash. Calls that take NULL for "not wanted" succeed. */
#include "check.h"
#include "fixture.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

static double grid[3 * POINTS];
static galv_shape *shape;
static galv_model *model;
static galv_limits *limits;

/* Names of the calls that the tests below make. */
static const char *walked[128];
static size_t n_walked;

static void walk(const char *name)
{
    for (size_t i = 0; i < n_walked; i++)
        if (strcmp(walked[i], name) == 0)
            return;
    CU_ASSERT_TRUE_FATAL(n_walked < sizeof walked / sizeof *walked);
    walked[n_walked++] = name;
}

static void refused(const char *name, galv_status status, const char *call)
{
    walk(name);
    if (status >= 0 || !*galv_last_error())
        fprintf(stderr, "%s: %s\n", call, galv_status_string(status));
    CU_ASSERT_TRUE(status < 0);
    CU_ASSERT_TRUE(*galv_last_error() != '\0');
}

static void expect_not(bool wrong, const char *name)
{
    if (wrong)
        fprintf(stderr, "%s(NULL) gives something\n", name);
    CU_ASSERT_FALSE(wrong);
}

#define REFUSED(name, ...) refused(#name, name(__VA_ARGS__), #name "(" #__VA_ARGS__ ")")
#define IS_NULL(name, ...) (walk(#name), expect_not(name(__VA_ARGS__) != NULL, #name))
#define IS_NAN(name, ...)  (walk(#name), expect_not(!isnan(name(__VA_ARGS__)), #name))
#define IS_ZERO(name, ...) (walk(#name), expect_not(name(__VA_ARGS__) != 0, #name))
#define RUNS(name, ...)    (walk(#name), name(__VA_ARGS__))

static int move_nothing(void *user_data, size_t npoints, const double *xyz, const double *x,
                        double *d)
{
    (void)user_data, (void)xyz, (void)x;
    memset(d, 0, 3 * npoints * sizeof *d);
    return 0;
}

static void test_shapes(void)
{
    galv_shape *made;
    galv_sine sine = {.order = {1, 1, 1}, .direction = 1};
    galv_box box = fixture_box;
    const double low[1] = {-1}, high[1] = {1};
    const galv_lattice lattice = {.box = box, .count = {3, 3, 3}, .degree = {2, 2, 2}};
    const galv_lattice_move move = {.index = {1, 1, 1}, .direction = 1};
    double d[3 * POINTS], x[FUNCTIONS] = {0}, bound[FUNCTIONS];
    bool fixed;
    REFUSED(galv_box_around, POINTS, NULL, &box);
    REFUSED(galv_box_around, POINTS, grid, NULL);
    REFUSED(galv_shape_sine, 1, NULL, &box, low, high, GALV_COMBINATION_LINEAR, &made);
    REFUSED(galv_shape_sine, 1, &sine, NULL, low, high, GALV_COMBINATION_LINEAR, &made);
    REFUSED(galv_shape_sine, 1, &sine, &box, NULL, high, GALV_COMBINATION_LINEAR, &made);
    REFUSED(galv_shape_sine, 1, &sine, &box, low, NULL, GALV_COMBINATION_LINEAR, &made);
    REFUSED(galv_shape_sine, 1, &sine, &box, low, high, GALV_COMBINATION_LINEAR, NULL);
    REFUSED(galv_shape_callback, 1, NULL, high, move_nothing, NULL, true, &made);
    REFUSED(galv_shape_callback, 1, low, NULL, move_nothing, NULL, true, &made);
    REFUSED(galv_shape_callback, 1, low, high, NULL, NULL, true, &made);
    REFUSED(galv_shape_callback, 1, low, high, move_nothing, NULL, true, NULL);
    REFUSED(galv_shape_ffd, NULL, 1, &move, low, high, &made);
    REFUSED(galv_shape_ffd, &lattice, 1, NULL, low, high, &made);
    REFUSED(galv_shape_ffd, &lattice, 1, &move, NULL, high, &made);
    REFUSED(galv_shape_ffd, &lattice, 1, &move, low, NULL, &made);
    REFUSED(galv_shape_ffd, &lattice, 1, &move, low, high, NULL);
    REFUSED(galv_shape_fields, 1, POINTS, NULL, low, high, &made);
    REFUSED(galv_shape_fields, 1, POINTS, grid, NULL, high, &made);
    REFUSED(galv_shape_fields, 1, POINTS, grid, low, NULL, &made);
    REFUSED(galv_shape_fields, 1, POINTS, grid, low, high, NULL);
    REFUSED(galv_shape_displace, NULL, POINTS, grid, x, d);
    REFUSED(galv_shape_displace, shape, POINTS, NULL, x, d);
    REFUSED(galv_shape_displace, shape, POINTS, grid, NULL, d);
    REFUSED(galv_shape_displace, shape, POINTS, grid, x, NULL);
    REFUSED(galv_shape_fold_bound, NULL, bound, &fixed);
    REFUSED(galv_shape_fold_bound, shape, NULL, &fixed);
    REFUSED(galv_shape_fold_bound, shape, bound, NULL);
    IS_ZERO(galv_shape_parameters, NULL);
    IS_NULL(galv_shape_lower, NULL);
    IS_NULL(galv_shape_upper, NULL);
    IS_ZERO(galv_shape_is_linear, NULL);
    RUNS(galv_shape_free, NULL);
}

static int measure(void *user_data, size_t npoints, const double *xyz, double *values)
{
    (void)user_data;
    for (size_t i = 0; i < npoints; i++)
        *values = (i ? *values : 0) + xyz[3 * i + 1];
    return 0;
}

static void test_building(void)
{
    galv_model *made;
    double weights[POINTS], values[1], d[3 * POINTS] = {0};
    const galv_sampling few = galv_uniform(30, 1), none = galv_samples(30, NULL);
    const galv_extra extra = {.count = 1, .evaluate = measure};
    const galv_data data = {.count = 3, .coordinates = 4};
    REFUSED(galv_grid_weights, SECTIONS, GIRTH, NULL, weights);
    REFUSED(galv_grid_weights, SECTIONS, GIRTH, grid, NULL);
    REFUSED(galv_build, NULL, POINTS, grid, few, NULL, &made);
    REFUSED(galv_build, shape, POINTS, NULL, few, NULL, &made);
    REFUSED(galv_build, shape, POINTS, grid, few, NULL, NULL);
    REFUSED(galv_build, shape, POINTS, grid, none, NULL, &made);
    REFUSED(galv_build_data, NULL, NULL, &made);
    REFUSED(galv_build_data, &data, NULL, &made); /* neither rows nor values */
    REFUSED(galv_build_data, &(galv_data){.count = 3, .coordinates = 1, .values = grid}, NULL,
            NULL);
    REFUSED(galv_extend, NULL, shape, few, NULL, &made);
    REFUSED(galv_extend, model, NULL, few, NULL, &made);
    REFUSED(galv_extend, model, shape, few, NULL, NULL);
    REFUSED(galv_extra_balance, NULL, POINTS, grid, few, &extra, 0.5, values);
    REFUSED(galv_extra_balance, shape, POINTS, NULL, few, &extra, 0.5, values);
    REFUSED(galv_extra_balance, shape, POINTS, grid, few, NULL, 0.5, values);
    REFUSED(galv_extra_balance, shape, POINTS, grid, few, &extra, 0.5, NULL);
    REFUSED(galv_extra_change, NULL, POINTS, grid, d, values);
    REFUSED(galv_extra_change, &extra, POINTS, NULL, d, values);
    REFUSED(galv_extra_change, &extra, POINTS, grid, NULL, values);
    REFUSED(galv_extra_change, &extra, POINTS, grid, d, NULL);
    RUNS(galv_options_init, NULL);
    RUNS(galv_uniform_sample, 1, 0, 3, NULL, grid, values);
    RUNS(galv_uniform_sample, 1, 0, 3, grid, NULL, values);
    RUNS(galv_uniform_sample, 1, 0, 3, grid, grid, NULL);
    walk("galv_uniform");
    walk("galv_samples");
}

static void test_models(void)
{
    double u[FUNCTIONS] = {0}, v[FUNCTIONS], d[3 * POINTS] = {0}, x[FUNCTIONS], r;
    galv_model *made;
    IS_ZERO(galv_model_samples, NULL);
    IS_ZERO(galv_model_points, NULL);
    IS_ZERO(galv_model_coordinates, NULL);
    IS_ZERO(galv_model_active, NULL);
    IS_ZERO(galv_model_parameters, NULL);
    IS_ZERO(galv_model_modes, NULL);
    IS_ZERO(galv_model_spectrum, NULL);
    IS_ZERO(galv_model_passes, NULL);
    IS_ZERO(galv_model_centred, NULL);
    IS_ZERO(galv_model_method, NULL);
    IS_NAN(galv_model_retained, NULL);
    IS_NAN(galv_model_retained_geometry, NULL);
    IS_NAN(galv_model_trace, NULL);
    IS_NAN(galv_model_truncation, NULL);
    IS_NULL(galv_model_eigenvalues, NULL);
    IS_NULL(galv_model_residuals, NULL);
    IS_NULL(galv_model_mse, NULL);
    IS_NULL(galv_model_vectors, NULL);
    IS_NULL(galv_model_mean, NULL);
    IS_NULL(galv_model_parent, NULL);
    IS_NULL(galv_model_weights, NULL);
    IS_NULL(galv_model_latent, NULL);
    IS_NULL(galv_model_lower, NULL);
    IS_NULL(galv_model_upper, NULL);
    walk("galv_model_confidence");
    CU_ASSERT_TRUE(isnan(galv_model_confidence(NULL).retained_fresh));
    REFUSED(galv_latent_bounds, NULL, 1, u, v);
    REFUSED(galv_latent_bounds, model, 1, NULL, v);
    REFUSED(galv_latent_bounds, model, 1, u, NULL);
    REFUSED(galv_latent_ellipsoid, NULL, 1, &r);
    REFUSED(galv_latent_ellipsoid, model, 1, NULL);
    REFUSED(galv_latent_distance, NULL, u, &r, &r);
    REFUSED(galv_latent_distance, model, NULL, &r, &r);
    CU_ASSERT_EQUAL(galv_latent_distance(model, u, NULL, NULL), GALV_OK);
    REFUSED(galv_project, NULL, d, u);
    REFUSED(galv_project, model, NULL, u);
    REFUSED(galv_project, model, d, NULL);
    REFUSED(galv_reconstruct, NULL, u, d);
    REFUSED(galv_reconstruct, model, NULL, d);
    REFUSED(galv_reconstruct, model, u, NULL);
    REFUSED(galv_displace, NULL, u, d);
    REFUSED(galv_displace, model, NULL, d);
    REFUSED(galv_displace, model, u, NULL);
    REFUSED(galv_backmap, NULL, shape, u, x, &r);
    REFUSED(galv_backmap, model, NULL, u, x, &r);
    REFUSED(galv_backmap, model, shape, NULL, x, &r);
    REFUSED(galv_backmap, model, shape, u, NULL, &r);
    CU_ASSERT_EQUAL(galv_backmap(model, shape, u, x, NULL), GALV_OK);
    RUNS(galv_model_free, NULL);
    walk("galv_model_field_count");
    walk("galv_model_field");
    CU_ASSERT_PTR_NULL(galv_model_field(NULL, 0).values);
    IS_NAN(galv_field_number, NULL);
    REFUSED(galv_model_restore, 1, NULL, &made);
    REFUSED(galv_model_restore, 0, NULL, NULL);
    REFUSED(galv_model_restore, 1, &(galv_field){.name = NULL}, &made);
}

static double volume(void *user_data, const double *moved)
{
    (void)user_data;
    return moved[0];
}

static void test_limits(void)
{
    galv_limits *made;
    double u[FUNCTIONS] = {0}, value;
    galv_particulars particulars;
    galv_model *parameters;
    galv_fairness fairness;
    REFUSED(galv_grid_volume, SECTIONS, GIRTH, NULL, &value);
    REFUSED(galv_grid_volume, SECTIONS, GIRTH, grid, NULL);
    REFUSED(galv_grid_particulars, SECTIONS, GIRTH, NULL, &particulars);
    REFUSED(galv_grid_particulars, SECTIONS, GIRTH, grid, NULL);
    REFUSED(galv_grid_fairness, SECTIONS, GIRTH, NULL, &fairness, &fairness);
    CU_ASSERT_EQUAL(galv_grid_fairness(SECTIONS, GIRTH, grid, NULL, NULL), GALV_OK);
    IS_NAN(galv_grid_half_breadth, SECTIONS, GIRTH, NULL, 0, 0);
    REFUSED(galv_grid_entrance, SECTIONS, GIRTH, NULL, 1, &value);
    REFUSED(galv_grid_entrance, SECTIONS, GIRTH, grid, 1, NULL);
    REFUSED(galv_build_parameters, NULL, SECTIONS * GIRTH, grid, &parameters);
    REFUSED(galv_build_parameters, shape, SECTIONS * GIRTH, NULL, &parameters);
    REFUSED(galv_build_parameters, shape, SECTIONS * GIRTH, grid, NULL);
    REFUSED(galv_limits_create, NULL, SECTIONS, GIRTH, 1, &made);
    REFUSED(galv_limits_create, model, SECTIONS, GIRTH, 1, NULL);
    REFUSED(galv_limits_turn, NULL, u, &value);
    REFUSED(galv_limits_turn, limits, u, NULL);
    REFUSED(galv_limits_breadth, NULL, u, &value, &value);
    REFUSED(galv_limits_breadth, limits, NULL, &value, &value);
    CU_ASSERT_EQUAL(galv_limits_breadth(limits, u, NULL, NULL), GALV_OK);
    REFUSED(galv_limits_entrance, NULL, u, &value);
    REFUSED(galv_limits_entrance, limits, NULL, &value);
    REFUSED(galv_limits_entrance, limits, u, NULL);
    REFUSED(galv_limits_volume, NULL, u, &value);
    REFUSED(galv_limits_volume, limits, NULL, &value);
    REFUSED(galv_limits_volume, limits, u, NULL);
    REFUSED(galv_limits_linearise, NULL, volume, NULL);
    REFUSED(galv_limits_linearise, limits, NULL, NULL);
    IS_NULL(galv_limits_gradient, NULL);
    REFUSED(galv_limits_set_gradient, NULL, u);
    REFUSED(galv_limits_set_gradient, limits, NULL);
    RUNS(galv_limits_free, NULL);
}

static void test_moments(void)
{
    double values[4];
    walk("galv_moments_count");
    REFUSED(galv_moments, SECTIONS, GIRTH, NULL, 1, values);
    REFUSED(galv_moments, SECTIONS, GIRTH, grid, 1, NULL);
    REFUSED(galv_section_moments, GIRTH, NULL, 1, values);
    REFUSED(galv_section_moments, GIRTH, grid, 1, NULL);
    walk("galv_moments_extra");
    galv_moment_set set = {.sections = SECTIONS, .girth = GIRTH};
    galv_extra extra;
    REFUSED(galv_moments_extra, NULL, &extra);
    REFUSED(galv_moments_extra, &set, NULL);
}

/* The name before the next parenthesis: what the line declares. */
static void check_declared(const char *text)
{
    char name[80];
    const char *end = strchr(text, '('), *start = end;
    while (start && start > text && (start[-1] == '_' || (start[-1] >= 'a' && start[-1] <= 'z')))
        start--;
    if (!end || end == start)
        return;
    snprintf(name, sizeof name, "%.*s", (int)(end - start), start);
    bool known = strcmp(name, "galv_status_string") == 0 || strcmp(name, "galv_last_error") == 0 ||
                 strcmp(name, "galv_version") == 0; /* take no pointers */
    for (size_t i = 0; i < n_walked && !known; i++)
        known = strcmp(walked[i], name) == 0;
    if (!known)
        fprintf(stderr, "%s is not walked\n", name);
    CU_ASSERT_TRUE(known);
}

/* A call that is new in the headers has to be walked too. */
static void test_every_call(void)
{
    static const char folder[] = EXAMPLES_DIR "/../libgalv/include/galv";
    DIR *headers = opendir(folder);
    size_t calls = 0;
    CU_ASSERT_PTR_NOT_NULL_FATAL(headers);
    for (struct dirent *entry; (entry = readdir(headers));) {
        char path[400], line[400];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        FILE *file = strstr(entry->d_name, ".h") ? fopen(path, "r") : NULL;
        while (file && fgets(line, sizeof line, file)) {
            if (strncmp(line, "GALV_API", 8) != 0)
                continue;
            if (!strchr(line, '(') && !fgets(line, sizeof line, file))
                break;
            check_declared(line);
            calls++;
        }
        if (file)
            fclose(file);
    }
    closedir(headers);
    CU_ASSERT_TRUE(calls >= n_walked);
}

static void prepare(void)
{
    fixture_grid(grid);
    shape = fixture_shape(GALV_COMBINATION_RECURSIVE, 0.03);
    CU_ASSERT_EQUAL_FATAL(galv_build(shape, POINTS, grid, galv_uniform(60, 1), NULL, &model),
                          GALV_OK);
    CU_ASSERT_EQUAL_FATAL(galv_limits_create(model, SECTIONS, GIRTH, 1, &limits), GALV_OK);
}

static void clean_up(void)
{
    galv_limits_free(limits);
    galv_model_free(model);
    galv_shape_free(shape);
}

static const struct check_case cases[] = {
    {"a shape, a model, limits", prepare},
    {"shapes", test_shapes},
    {"building", test_building},
    {"models", test_models},
    {"limits", test_limits},
    {"moments", test_moments},
    {"every call of the headers", test_every_call},
    {"freed", clean_up},
};

CHECK_MAIN("galv NULL", cases)
