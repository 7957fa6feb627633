/* Several objectives: volumes against inclusion and exclusion, the expected improvement against
 * quadrature of the improvement itself, and searches whose Pareto sets are known. */
#include "check.h"
#include "core/front.h"

#include <bayesopt/bayesopt.h>

#include <stdint.h>
#include <string.h>
#include <unistd.h>

enum { MOST = 3, POINTS = 8 };

/* Some fronts and dominated points, from a small generator of their own. */
static double next(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Inclusion and exclusion over all subsets of the boxes that points dominate. */
static double volume_of_union(size_t m, size_t n, const double *points, const double *reference)
{
    double sum = 0;
    for (unsigned set = 1; set < 1u << n; set++) {
        double sign = -1, product = 1;
        for (size_t c = 0; c < m; c++) {
            double corner = -INFINITY;
            for (size_t i = 0; i < n; i++)
                if (set & (1u << i))
                    corner = fmax(corner, points[i * m + c]);
            product *= fmax(reference[c] - corner, 0);
        }
        for (size_t i = 0; i < n; i++)
            sign = set & (1u << i) ? -sign : sign;
        sum += sign * product;
    }
    return sum;
}

static void volumes(void)
{
    uint64_t state = 3;
    double points[POINTS * 4], reference[4] = {0.9, 0.8, 1, 0.7}, volume;
    for (int round = 0; round < 40; round++) {
        size_t m = 1 + (size_t)round % 4, n = 1 + (size_t)round % POINTS;
        for (size_t i = 0; i < n * m; i++)
            points[i] = next(&state);
        CU_ASSERT_EQUAL(bayesopt_hypervolume(m, n, points, reference, &volume), BAYESOPT_OK);
        CHECK_CLOSE(volume, volume_of_union(m, n, points, reference), 1e-13);
    }
    CU_ASSERT_EQUAL(bayesopt_hypervolume(2, 0, points, reference, &volume), BAYESOPT_OK);
    CU_ASSERT(volume == 0);
}

/* The expectation as an integral of P(y <= z) over the z that are not dominated, by midpoints of
 * cells in which points and reference are corners. */
static double expected_growth(size_t m, size_t n, const double *points, const double *mean,
                              const double *sd)
{
    enum { CELLS = 160 };
    static double below[MOST][CELLS];
    const double low = -3, width = 4.0 / CELLS;
    double sum = 0;
    for (size_t c = 0; c < m; c++)
        for (size_t i = 0; i < CELLS; i++) {
            double z = low + ((double)i + 0.5) * width;
            below[c][i] = 0.5 * erfc((mean[c] - z) / (sd[c] * sqrt(2)));
        }
    for (size_t t = 0; t < (size_t)(m == 2 ? 1 : CELLS) * CELLS * CELLS; t++) {
        double z[MOST], product = 1;
        bool free = true;
        size_t rest = t;
        for (size_t c = 0; c < m; c++, rest /= CELLS) {
            z[c] = low + ((double)(rest % CELLS) + 0.5) * width;
            product *= width * below[c][rest % CELLS];
        }
        for (size_t i = 0; i < n && free; i++) {
            bool dominated = true;
            for (size_t c = 0; c < m; c++)
                dominated = dominated && points[i * m + c] <= z[c];
            free = !dominated;
        }
        sum += free ? product : 0;
    }
    return sum;
}

static void improvements(void)
{
    static const double reference[MOST] = {1, 1, 1};
    uint64_t state = 11;
    double points[POINTS * MOST], mean[MOST], sd[MOST], by_mean[MOST], by_sd[MOST];
    for (int round = 0; round < 12; round++) {
        struct front front;
        size_t m = 2 + (size_t)round % 2, n = (size_t)round % 6;
        for (size_t i = 0; i < n * m; i++)
            points[i] = 0.1 * floor(11 * next(&state));
        for (size_t c = 0; c < m; c++) {
            mean[c] = 0.2 + 0.7 * next(&state);
            sd[c] = 0.1 + 0.3 * next(&state);
        }
        CU_ASSERT_FATAL(front_create(&front, m, n, points, reference));
        double value = front_log_improvement(&front, mean, sd, by_mean, by_sd);
        double expected = expected_growth(m, n, points, mean, sd);
        CHECK_RELATIVE(exp(value), expected, 5e-3);
        for (size_t c = 0; c < m; c++)
            for (int which = 0; which < 2; which++) {
                double *at = which ? &sd[c] : &mean[c], kept = *at, step = 1e-6;
                *at = kept + step;
                double above = front_log_improvement(&front, mean, sd, NULL, NULL);
                *at = kept - step;
                double below = front_log_improvement(&front, mean, sd, NULL, NULL);
                *at = kept;
                double slope = which ? by_sd[c] : by_mean[c];
                CHECK_CLOSE(slope, (above - below) / (2 * step), 1e-5 * (1 + fabs(slope)));
            }
        /* Far from the front, where the value itself is no number any more, the logarithm is. */
        for (size_t c = 0; c < m; c++)
            mean[c] = 60;
        value = front_log_improvement(&front, mean, sd, by_mean, by_sd);
        CU_ASSERT(isfinite(value) && value < -700 && isfinite(by_mean[0]) && by_mean[0] < 0);
        front_free(&front);
    }
}

/* f1 = |x - a|^2, f2 = |x - b|^2: the Pareto set is the segment from a to b. */
static double square(const double *x, double a, double b)
{
    return (x[0] - a) * (x[0] - a) + (x[1] - b) * (x[1] - b);
}

static bayesopt *start(size_t objectives, bool turned)
{
    static const double lower[2] = {0, 0}, upper[2] = {1, 1};
    static const bool maximise[2] = {true, true};
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.n_objectives = objectives;
    options.initial_n = 10;
    options.max_evaluations = 30;
    options.maximise_others = turned ? maximise : NULL;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_OK);
    return bo;
}

static void tell(bayesopt *bo, size_t objectives, bool turned, uint64_t id, const double *x)
{
    double others[2] = {square(x, 0.8, 0.8), square(x, 0.2, 0.8)};
    for (size_t k = 0; k < 2; k++)
        others[k] *= turned ? -1 : 1;
    CU_ASSERT_EQUAL(bayesopt_tell(bo, id, square(x, 0.2, 0.2), others), BAYESOPT_OK);
    (void)objectives;
}

/* Dominated volume of a history, objectives to be minimised, below (0.72, 0.72, ...). */
static double dominated(const bayesopt *bo, size_t objectives, bool turned)
{
    static const double reference[MOST] = {0.72, 0.72, 0.72};
    double values[64 * MOST], volume = NAN;
    size_t n, rows[64];
    bayesopt_point p;
    CU_ASSERT_EQUAL(bayesopt_pareto(bo, &n, rows), BAYESOPT_OK);
    for (size_t i = 0; i < n && !bayesopt_get(bo, rows[i], &p); i++) {
        values[i * objectives] = p.f;
        for (size_t k = 1; k < objectives; k++)
            values[i * objectives + k] = (turned ? -1 : 1) * p.constraints[k - 1];
    }
    CU_ASSERT_EQUAL(bayesopt_hypervolume(objectives, n, values, reference, &volume), BAYESOPT_OK);
    return volume;
}

static void searches(void)
{
    /* The whole front of two: f1 = s^2 0.72, f2 = (1 - s)^2 0.72, so the volume is
     * 0.72^2 (1 - int (1 - sqrt t)^2 dt) = 0.72^2 5/6. */
    const double whole = 0.72 * 0.72 * 5 / 6;
    double x[2];
    uint64_t id;
    for (int turned = 0; turned < 2; turned++) {
        bayesopt *bo = start(2, turned);
        while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
            tell(bo, 2, turned, id, x);
        double volume = dominated(bo, 2, turned);
        CU_ASSERT(volume > 0.95 * whole && volume < whole);
        bayesopt_free(bo);
    }
    bayesopt *bo = start(3, false), *twin = start(3, false);
    double y[8 * 2];
    uint64_t ids[8];
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        tell(bo, 3, false, id, x);
    /* In batches nearly as good as one by one. */
    while (bayesopt_ask(twin, 5, y, ids) == BAYESOPT_OK)
        for (size_t i = 0; i < 5; i++)
            if (ids[i])
                tell(twin, 3, false, ids[i], y + 2 * i);
    CU_ASSERT(dominated(twin, 3, false) > 0.95 * dominated(bo, 3, false));
    bayesopt_free(bo);
    bayesopt_free(twin);
}

/* Constraints, failures, a store, resumed. */
static void stored(void)
{
    static const double lower[2] = {0, 0}, upper[2] = {1, 1}, most = 0.5;
    char path[256];
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_point p;
    double x[2];
    uint64_t id;
    size_t n, rows[40];
    snprintf(path, sizeof path, "%s/bayesopt_front_%ld.db", check_scratch(), (long)getpid());
    remove(path);
    bayesopt_options_init(&options);
    options.n_objectives = 2;
    options.n_constraints = 1;
    options.constraint_upper = &most;
    options.initial_n = 10;
    options.max_evaluations = 30;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_store(bo, path), BAYESOPT_OK);
    for (int round = 0; round < 30; round++) {
        if (round == 15) {
            bayesopt_free(bo);
            CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_OK);
            CU_ASSERT(bayesopt_objective_count(bo) == 2);
        }
        CU_ASSERT_EQUAL_FATAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_OK);
        const double outcomes[2] = {x[0], square(x, 0.8, 0.8)};
        bayesopt_status told = x[1] > 0.9 ? bayesopt_tell_failed(bo, id, "beyond")
                                          : bayesopt_tell(bo, id, square(x, 0.2, 0.2), outcomes);
        CU_ASSERT_EQUAL(told, BAYESOPT_OK);
    }
    CU_ASSERT_EQUAL(bayesopt_pareto(bo, &n, rows), BAYESOPT_OK);
    CU_ASSERT(n > 8);
    double last = -INFINITY, nearest = INFINITY;
    for (size_t i = 0; i < n; i++) {
        CU_ASSERT(!bayesopt_get(bo, rows[i], &p) && p.feasible && p.x[0] <= 0.5 && p.f >= last);
        last = p.f;
        nearest = fmin(nearest, p.constraints[1]);
    }
    CHECK_CLOSE(nearest, 0.12, 0.03); /* 0.09 at (0.5, 0.8) */
    bayesopt_free(bo);
    options.n_objectives = 1;
    options.n_constraints = 2;
    CU_ASSERT_EQUAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_OK);
    bayesopt_free(bo);
    remove(path);
}

static const struct check_case cases[] = {{"volumes", volumes},
                                          {"expected improvement", improvements},
                                          {"searches", searches},
                                          {"constraints, failures and a store", stored}};

CHECK_MAIN("bayesopt front", cases)
