/* Variables that are not real numbers on a line, conditions on inputs, objectives to be maximised,
 * and what is known before the first ask. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdint.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 4 };

typedef double function(const double *x);

struct problem {
    size_t d;
    double lower[MOST], upper[MOST];
    bayesopt_kind kind[MOST];
    function *f;
};

static void path_of(char path[256], const char *name)
{
    snprintf(path, 256, "%s/bayesopt_kinds_%s_%ld.db", check_scratch(), name, (long)getpid());
    remove(path);
}

static bayesopt *make(const struct problem *p, const bayesopt_options *base)
{
    bayesopt_options options = *base;
    bayesopt *bo = NULL;
    options.kind = p->kind;
    bayesopt_status status = bayesopt_create(p->d, p->lower, p->upper, &options, &bo);
    if (status)
        fprintf(stderr, "%s\n", bayesopt_last_error());
    CU_ASSERT_EQUAL_FATAL(status, BAYESOPT_OK);
    return bo;
}

/* Runs to the end; checks that every point is one of the problem's. */
static bayesopt_status run(bayesopt *bo, const struct problem *p)
{
    double x[MOST];
    uint64_t id;
    bayesopt_status status;
    while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK) {
        for (size_t j = 0; j < p->d; j++) {
            CU_ASSERT(x[j] >= p->lower[j] && x[j] <= p->upper[j]);
            if (p->kind[j] == BAYESOPT_KIND_INTEGER || p->kind[j] == BAYESOPT_KIND_CATEGORICAL)
                CU_ASSERT(x[j] == floor(x[j]));
        }
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, p->f(x), NULL), BAYESOPT_OK);
    }
    return status;
}

static size_t repeats(const bayesopt *bo, size_t d)
{
    size_t count = 0;
    bayesopt_point a, b;
    for (size_t i = 0; !bayesopt_get(bo, i, &a); i++)
        for (size_t k = 0; k < i && !bayesopt_get(bo, k, &b); k++)
            count += memcmp(a.x, b.x, d * sizeof *a.x) == 0;
    return count;
}

/* Cells of a grid with a valley across it: 21 x 31 x 3 points, the least at (13, 22, 1). */
static double valley(const double *x)
{
    static const double offset[] = {3, 0, 1.5};
    double along = x[0] - 13 + 0.5 * (x[1] - 22), across = x[1] - 22;
    return 0.1 * along * along + 0.02 * across * across + offset[(int)x[2]];
}

static void mixed_integers(void)
{
    static const struct problem p = {
        3,
        {0, 0, 0},
        {20, 30, 2},
        {BAYESOPT_KIND_INTEGER, BAYESOPT_KIND_INTEGER, BAYESOPT_KIND_CATEGORICAL},
        valley};
    bayesopt_options options;
    double f, x[MOST];
    bayesopt_options_init(&options);
    options.initial_n = 15;
    options.max_evaluations = 45;
    bayesopt *bo = make(&p, &options);
    CU_ASSERT_EQUAL(run(bo, &p), BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(repeats(bo, 3), 0);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CHECK_CLOSE(f, 0, 1e-12); /* the least of the 1953, found with 45 */
    bayesopt_free(bo);
}

/* A category of its own basin each; the least is -2 at category 3. */
static double categories(const double *x)
{
    static const double centre[] = {0.2, 0.8, 0.5, 0.35, 0.9}, depth[] = {0, -1, -0.5, -2, 0.3};
    int c = (int)x[1];
    return 10 * (x[0] - centre[c]) * (x[0] - centre[c]) + depth[c] +
           2 * (x[2] - 0.6) * (x[2] - 0.6);
}

static void mixed_categories(void)
{
    static const struct problem p = {
        3,
        {0, 0, 0},
        {1, 4, 1},
        {BAYESOPT_KIND_REAL, BAYESOPT_KIND_CATEGORICAL, BAYESOPT_KIND_REAL},
        categories};
    bayesopt_options options;
    double f, x[MOST];
    bayesopt_options_init(&options);
    options.initial_n = 15;
    options.max_evaluations = 45;
    bayesopt *bo = make(&p, &options);
    CU_ASSERT_EQUAL(run(bo, &p), BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CHECK_CLOSE(f, -2, 1e-3);
    CU_ASSERT(x[1] == 3);
    bayesopt_free(bo);
}

/* A space of 12 points is searched to its end, and no point twice. */
static void a_small_space_ends(void)
{
    static const struct problem p = {
        3,
        {1, 0, 7},
        {3, 3, 7},
        {BAYESOPT_KIND_INTEGER, BAYESOPT_KIND_CATEGORICAL, BAYESOPT_KIND_REAL},
        valley};
    static const struct problem first = {
        2, {0, 0}, {2, 3}, {BAYESOPT_KIND_INTEGER, BAYESOPT_KIND_CATEGORICAL}, NULL};
    bayesopt_options options;
    double x[MOST];
    uint64_t id;
    bayesopt_options_init(&options);
    options.max_evaluations = 40;
    for (size_t initial = 0; initial < 9; initial += 4) {
        options.initial_n = initial;
        bayesopt *bo = make(initial ? &first : &p, &options);
        bayesopt_status status;
        while ((status = bayesopt_ask(bo, 1, x, &id)) == BAYESOPT_OK)
            CU_ASSERT_EQUAL(bayesopt_tell(bo, id, x[0] * x[0] - x[1], NULL), BAYESOPT_OK);
        CU_ASSERT_EQUAL(status, BAYESOPT_STOP_EXHAUSTED);
        CU_ASSERT_EQUAL(bayesopt_count(bo), 12);
        CU_ASSERT_EQUAL(repeats(bo, initial ? 2 : 3), 0);
        bayesopt_free(bo);
    }
}

static double decades(const double *x)
{
    double a = log10(x[0]) - 2.3, b = log10(x[1]) + 4.1;
    return a * a + 0.5 * b * b;
}

static void logarithms(void)
{
    static const struct problem p = {
        2, {1e-6, 1e-6}, {1e6, 1e6}, {BAYESOPT_KIND_LOG, BAYESOPT_KIND_LOG}, decades};
    bayesopt_options options;
    double f, x[MOST];
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.max_evaluations = 30;
    bayesopt *bo = make(&p, &options);
    CU_ASSERT_EQUAL(run(bo, &p), BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CHECK_CLOSE(f, 0, 1e-6);
    bayesopt_free(bo);
}

/* With the objective's sign turned and maximised the same points are proposed. */
static double minus_categories(const double *x)
{
    return -categories(x);
}

static void maximising(void)
{
    struct problem p = {3,
                        {0, 0, 0},
                        {1, 4, 1},
                        {BAYESOPT_KIND_REAL, BAYESOPT_KIND_CATEGORICAL, BAYESOPT_KIND_REAL},
                        categories};
    bayesopt_options options;
    bayesopt_point a, b;
    double most, mean, x[MOST];
    char path[256];
    path_of(path, "maximise");
    bayesopt_options_init(&options);
    options.initial_n = 8;
    options.max_evaluations = 16;
    bayesopt *least = make(&p, &options);
    CU_ASSERT_EQUAL(run(least, &p), BAYESOPT_STOP_BUDGET);
    p.f = minus_categories;
    options.maximise = true;
    bayesopt *greatest = make(&p, &options);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_store(greatest, path), BAYESOPT_OK);
    CU_ASSERT_EQUAL(run(greatest, &p), BAYESOPT_STOP_BUDGET);
    for (size_t i = 0; i < 16; i++) {
        CU_ASSERT(!bayesopt_get(least, i, &a) && !bayesopt_get(greatest, i, &b));
        CU_ASSERT(memcmp(a.x, b.x, 3 * sizeof *a.x) == 0);
        CU_ASSERT(a.f == -b.f);
    }
    CU_ASSERT_EQUAL(bayesopt_best(greatest, x, &most, NULL), BAYESOPT_OK);
    CU_ASSERT(most == minus_categories(x));
    CU_ASSERT_EQUAL(bayesopt_predict(greatest, 1, x, &mean, NULL), BAYESOPT_OK);
    CHECK_CLOSE(mean, most, 1e-4);
    bayesopt_free(least);
    bayesopt_free(greatest);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &greatest), BAYESOPT_OK);
    CU_ASSERT(bayesopt_maximises(greatest));
    CU_ASSERT(bayesopt_variable_kind(greatest, 1) == BAYESOPT_KIND_CATEGORICAL);
    CU_ASSERT_EQUAL(bayesopt_best_told(greatest, NULL, &mean, NULL), BAYESOPT_OK);
    CU_ASSERT(mean == most);
    bayesopt_free(greatest);
    bayesopt_options_init(&options);
    options.initial_n = 8;
    least = make(&p, &options);
    CU_ASSERT_EQUAL(bayesopt_open_store(least, path), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_free(least);
    remove(path);
}

static double linear(const double *x)
{
    return x[0] + 2 * x[1] + 0.1 * x[2];
}

/* A linear objective on a curve; n is whole. */
static void conditions(void)
{
    static const struct problem p = {
        3,
        {0.2, 0.2, 0},
        {4, 4, 5},
        {BAYESOPT_KIND_REAL, BAYESOPT_KIND_REAL, BAYESOPT_KIND_INTEGER},
        linear};
    static const char *const names[] = {"x", "y", "n"}, *const texts[] = {"x*y == 1", "n >= x"},
                             *const others[] = {"x*y == 1", "n >= y"},
                             *const wrong[] = {"x*w == 1"};
    bayesopt_options options;
    bayesopt *bo;
    double f, x[MOST], most = 0;
    uint64_t id;
    char path[256];
    path_of(path, "conditions");
    bayesopt_options_init(&options);
    options.initial_n = 8;
    options.max_evaluations = 30;
    options.names = names;
    options.n_conditions = 2;
    options.conditions = texts;
    bo = make(&p, &options);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_store(bo, path), BAYESOPT_OK);
    for (int i = 0; i < 10 && !bayesopt_ask(bo, 1, x, &id); i++)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, linear(x), NULL), BAYESOPT_OK);
    bayesopt_free(bo);
    /* The store knows the rest. */
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_OK);
    CU_ASSERT_STRING_EQUAL(bayesopt_variable_name(bo, 2), "n");
    for (int i = 0; i < 20 && !bayesopt_ask(bo, 1, x, &id); i++)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, linear(x), NULL), BAYESOPT_OK);
    bayesopt_point point;
    for (size_t i = 0; !bayesopt_get(bo, i, &point); i++) {
        most = fmax(most, fabs(point.x[0] * point.x[1] - 1));
        CU_ASSERT(point.x[2] >= point.x[0] && point.x[2] == floor(point.x[2]));
    }
    CU_ASSERT(most < 2e-5); /* 1e-6 of 15, what x y - 1 comes to in the box */
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    /* n = 1: x + 2/x falls to x = 1, 3.1; n = 2: x = sqrt 2, 2 sqrt 2 + 0.2 = 3.0284 */
    CHECK_CLOSE(f, 2 * sqrt(2) + 0.2, 5e-3);
    bayesopt_free(bo);
    options.conditions = others;
    bo = make(&p, &options);
    CU_ASSERT_EQUAL(bayesopt_open_store(bo, path), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "condition 2 is 'n >= x' there"));
    bayesopt_free(bo);
    options.conditions = wrong;
    options.n_conditions = 1;
    options.kind = p.kind;
    CU_ASSERT_EQUAL(bayesopt_create(3, p.lower, p.upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "'x*w == 1': at 'w == 1'"));
    remove(path);
}

static double bowl(const double *x)
{
    return (x[0] - 0.3) * (x[0] - 0.3) + (x[1] - 0.6) * (x[1] - 0.6);
}

static const struct problem square = {
    2, {0, 0}, {1, 1}, {BAYESOPT_KIND_REAL, BAYESOPT_KIND_REAL}, bowl};

/* Own points come first and to the bit; told ones shorten the design, which keeps off both. */
static void known_points(void)
{
    static const double first[] = {0.1, 0.2, 0.9, 1.0 / 3};
    static const double told[] = {0.5, 0.5, 0.25, 0.75, 0.75, 0.25};
    bayesopt_options options;
    bayesopt_point p, q;
    double x[MOST];
    uint64_t id;
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.max_evaluations = 12;
    options.n_first = 2;
    options.first_x = first;
    options.told_count = true;
    bayesopt *bo = make(&square, &options);
    for (size_t i = 0; i < 3; i++)
        CU_ASSERT_EQUAL(bayesopt_tell_point(bo, told + 2 * i, bowl(told + 2 * i), NULL),
                        BAYESOPT_OK);
    for (size_t i = 0; i < 2; i++) {
        CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_OK);
        CU_ASSERT(memcmp(x, first + 2 * i, sizeof first / 2) == 0);
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(x), NULL), BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(run(bo, &square), BAYESOPT_STOP_BUDGET);
    size_t initial = 0;
    for (size_t i = 0; !bayesopt_get(bo, i, &p); i++) {
        initial += p.phase == BAYESOPT_PHASE_INITIAL;
        for (size_t k = 0; k < i && p.phase == BAYESOPT_PHASE_INITIAL; k++) {
            CU_ASSERT(!bayesopt_get(bo, k, &q));
            CU_ASSERT(hypot(p.x[0] - q.x[0], p.x[1] - q.x[1]) > 0.1);
        }
    }
    CU_ASSERT_EQUAL(initial, 7);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 12);
    bayesopt_free(bo);
}

/* Points outside of the box serve the model alone. */
static void outside_points(void)
{
    bayesopt_options options;
    bayesopt_point p;
    double x[MOST], f, mean[2];
    uint64_t id;
    char path[256];
    path_of(path, "outside");
    bayesopt_options_init(&options);
    options.initial_n = 6;
    options.max_evaluations = 8;
    bayesopt *bo = make(&square, &options);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_store(bo, path), BAYESOPT_OK);
    static const double far[][2] = {{1.2, 0.6}, {-0.2, 0.6}, {0.3, 1.3}, {0.3, -0.3}};
    for (size_t i = 0; i < 4; i++) {
        bayesopt_result result = {.f = bowl(far[i]) - 100, .outside = true};
        CU_ASSERT_EQUAL(bayesopt_tell_point_result(bo, far[i], &result, NULL), BAYESOPT_OK);
        result.outside = false;
        CU_ASSERT_EQUAL(bayesopt_tell_point_result(bo, far[i], &result, NULL),
                        BAYESOPT_ERROR_ARGUMENT);
    }
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(x) - 100, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 12); /* they cost no budget */
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CU_ASSERT(x[0] >= 0 && x[0] <= 1 && x[1] >= 0 && x[1] <= 1);
    CU_ASSERT(f < -100 + 1e-3);
    CU_ASSERT(!bayesopt_get(bo, 0, &p) && p.outside && !p.feasible);
    static const double edge[] = {1, 0.6, 0.3, 1};
    CU_ASSERT_EQUAL(bayesopt_predict(bo, 2, edge, mean, NULL), BAYESOPT_OK);
    CHECK_CLOSE(mean[0], bowl(edge) - 100, 2e-2);
    bayesopt_free(bo);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &bo), BAYESOPT_OK);
    CU_ASSERT(bayesopt_count(bo) == 12 && !bayesopt_get(bo, 0, &p) && p.outside);
    bayesopt_free(bo);
    remove(path);
}

/* The covariance of categories: what they are called does not matter, and the likelihood's
 * derivatives are those of its differences. */
static void categorical_regression(void)
{
    enum { N = 12, D = 2 };
    static const bool categorical[D] = {false, true};
    double x[N * D], turned[N * D], y[N], gradient[D + 2], value, above, below;
    double scales[D] = {0.6, 1.3}, at[D] = {0.4, 0.5}, other[D] = {0.4, 1}, mean[2], var[2];
    bayesopt_gp_options options;
    bayesopt_gp *gp = NULL, *again = NULL;
    bayesopt_gp_options_init(&options);
    options.categorical = categorical;
    static const double renamed[] = {1, 0, 0.5}; /* of 0, 0.5, 1 */
    for (size_t i = 0; i < N; i++) {
        x[i * D] = turned[i * D] = (double)((7 * i) % N) / N;
        x[i * D + 1] = 0.5 * (double)(i % 3);
        turned[i * D + 1] = renamed[i % 3];
        y[i] = sin(5 * x[i * D]) + (double)(i % 3 == 1);
    }
    bayesopt_gp_parameters p = {scales, 1.5, 1e-3, 0};
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_create(D, &options, &gp), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_create(D, &options, &again), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(gp, N, x, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_set_data(again, N, turned, y, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &p), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(again, &p), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, at, &mean[0], &var[0]), BAYESOPT_OK);
    at[1] = 0;
    CU_ASSERT_EQUAL(bayesopt_gp_predict(again, 1, at, &mean[1], &var[1]), BAYESOPT_OK);
    CHECK_CLOSE(mean[0], mean[1], 1e-12);
    CHECK_CLOSE(var[0], var[1], 1e-12);
    CU_ASSERT_EQUAL(bayesopt_gp_log_likelihood(gp, &value, gradient), BAYESOPT_OK);
    for (size_t j = 0; j < D; j++) {
        double kept = scales[j], step = 1e-5;
        scales[j] = kept * exp(step);
        CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_log_likelihood(gp, &above, NULL), BAYESOPT_OK);
        scales[j] = kept * exp(-step);
        CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_gp_log_likelihood(gp, &below, NULL), BAYESOPT_OK);
        scales[j] = kept;
        CHECK_CLOSE(gradient[j], (above - below) / (2 * step), 1e-6 * (1 + fabs(gradient[j])));
    }
    CU_ASSERT_EQUAL(bayesopt_gp_set_parameters(gp, &p), BAYESOPT_OK);
    char path[256];
    path_of(path, "gp");
    bayesopt_gp_free(again);
    CU_ASSERT_EQUAL(bayesopt_gp_save(gp, path), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_gp_load(path, &again), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(gp, 1, other, &mean[0], &var[0]), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_gp_predict(again, 1, other, &mean[1], &var[1]), BAYESOPT_OK);
    CU_ASSERT(mean[0] == mean[1] && var[0] == var[1]);
    bayesopt_gp_free(gp);
    bayesopt_gp_free(again);
    remove(path);
}

static void refusals(void)
{
    static const struct {
        double lower, upper;
        bayesopt_kind kind;
    } wrong[] = {{0, 1, BAYESOPT_KIND_LOG},       {-1, 1, BAYESOPT_KIND_LOG},
                 {0.5, 2, BAYESOPT_KIND_INTEGER}, {0, 2.5, BAYESOPT_KIND_CATEGORICAL},
                 {0, 1e9, BAYESOPT_KIND_INTEGER}, {0, 1, (bayesopt_kind)9}};
    bayesopt_options options;
    bayesopt *bo;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        bayesopt_options_init(&options);
        options.kind = &wrong[i].kind;
        CU_ASSERT_EQUAL(bayesopt_create(1, &wrong[i].lower, &wrong[i].upper, &options, &bo),
                        BAYESOPT_ERROR_ARGUMENT);
    }
    bayesopt_options_init(&options);
    bayesopt_kind kind = BAYESOPT_KIND_CATEGORICAL;
    double lower = 0, upper = 3, half = 1.5;
    options.kind = &kind;
    options.mean = BAYESOPT_MEAN_LINEAR;
    CU_ASSERT_EQUAL(bayesopt_create(1, &lower, &upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    options.mean = BAYESOPT_MEAN_CONSTANT;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(1, &lower, &upper, &options, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_tell_point(bo, &half, 1, NULL), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_free(bo);
    static const char *const names[] = {"c"}, *const texts[] = {"c <= 2"};
    options.names = names;
    options.n_conditions = 1;
    options.conditions = texts;
    CU_ASSERT_EQUAL(bayesopt_create(1, &lower, &upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"integers and a category", mixed_integers},
    {"categories and reals", mixed_categories},
    {"a small space ends", a_small_space_ends},
    {"logarithms", logarithms},
    {"maximising", maximising},
    {"conditions", conditions},
    {"known points", known_points},
    {"points outside of the box", outside_points},
    {"a regression of categories", categorical_regression},
    {"refusals", refusals},
};

CHECK_MAIN("bayesopt kinds", cases)
