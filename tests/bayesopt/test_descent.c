/* The descent on problems whose optimum is known in closed form, and what it refuses. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <math.h>
#include <string.h>

enum { N = 3, R = 5, SETTINGS = 2 };

/* Residuals x - target_m with a bend: the first components are bent by curvature |x|^2, the rest
 * are constant, so that |r|^2 has its least value where x is the target when nothing is bent. The
 * coarse mesh sees slopes 5 % too steep and values that are off. */
struct body {
    double target[SETTINGS][N], rest, curvature;
    double fence; /* of x[0] + x[1] */
    int fine, coarse, derivatives, most;
    int known;   /* settings whose derivatives slopes() has */
    bool broken; /* no value with x[2] > 0.3 */
    bool exact;  /* the coarse values are the fine ones */
    double lost; /* x[2] from which on numbers are none; 0: nowhere */
};

/* Of a state s = x[0] + 1/2: s - s^2/2, which is 3/8 at the start. */
static double bounded(void *user_data, const double *state, double *gradient)
{
    (void)user_data;
    if (gradient)
        gradient[0] = 1 - state[0];
    return state[0] - state[0] * state[0] / 2;
}

static void fill(const struct body *body, const double *x, double slope, bayesopt_descent_sample *s)
{
    double square = x[0] * x[0] + x[1] * x[1] + x[2] * x[2];
    memset(s->residual, 0, SETTINGS * R * sizeof(double));
    for (int m = 0; m < SETTINGS; m++) {
        double *r = s->residual + m * R;
        for (int k = 0; k < N; k++)
            r[k] = slope * (x[k] - body->target[m][k]) + body->curvature * square;
        r[N] = body->rest;
        s->value[m] = 0;
        for (int k = 0; k < R; k++)
            s->value[m] += r[k] * r[k];
    }
    s->state[0] = slope * (x[0] + 0.5);
    s->bounded = bounded(NULL, s->state, NULL);
}

static bayesopt_descent_answer fine(void *user_data, const double *x, bayesopt_descent_sample *s)
{
    struct body *body = user_data;
    if (body->most && body->fine == body->most)
        return BAYESOPT_DESCENT_STOP;
    body->fine++;
    if (body->broken && x[2] > 0.3)
        return BAYESOPT_DESCENT_FAILED;
    fill(body, x, 1, s);
    if (body->lost != 0 && x[2] > body->lost)
        s->value[0] = NAN;
    return BAYESOPT_DESCENT_VALUED;
}

static bayesopt_descent_answer coarse(void *user_data, const double *x, bayesopt_descent_sample *s)
{
    struct body *body = user_data;
    body->coarse++;
    fill(body, x, body->exact ? 1 : 1.05, s);
    return BAYESOPT_DESCENT_VALUED;
}

static int fence(void *user_data, size_t d, const double *x, double *value)
{
    const struct body *body = user_data;
    (void)d;
    value[0] = x[0] + x[1] - body->fence;
    return 0;
}

static const double LOWER[N] = {-2, -2, -2}, UPPER[N] = {2, 2, 2};
static const bayesopt_descent_setting ALONE[SETTINGS] = {{0, 1}, {100, 0}};
static const bayesopt_descent_setting WORST[SETTINGS] = {{0, 1}, {0, 1}};

static bayesopt_descent_problem problem(struct body *body, const bayesopt_descent_setting *setting)
{
    bayesopt_descent_problem p;
    bayesopt_descent_problem_init(&p);
    p.d = N;
    p.lower = LOWER;
    p.upper = UPPER;
    p.n_settings = SETTINGS;
    p.setting = setting;
    p.n_residuals = R;
    p.n_state = 1;
    p.function = bounded;
    p.coarse = coarse;
    p.fine = fine;
    p.user_data = body;
    return p;
}

static void finds_the_least_squares(void)
{
    struct body body = {.target = {{0.5, -0.3, 0.8}, {0, 0, 0}}, .rest = 0.5};
    const bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {0};
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    for (int k = 0; k < N; k++)
        CHECK_CLOSE(x[k], body.target[0][k], 0.02);
    CU_ASSERT(body.fine <= 6);
    CU_ASSERT(body.coarse <= 5 * (N + 1));
}

/* Bent residuals: the gradient of |r|^2, by differences, vanishes. */
static void finds_a_stationary_point_of_bent_residuals(void)
{
    struct body body = {.target = {{0.5, -0.3, 0.8}, {0, 0, 0}}, .rest = 0.3, .curvature = 0.15};
    const bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {0}, residual[SETTINGS * R], value[SETTINGS], state, side[2];
    bayesopt_descent_sample s = {.residual = residual, .value = value, .state = &state};
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    fill(&body, x, 1, &s);
    double least = value[0];
    for (int k = 0; k < N; k++) {
        double keep = x[k];
        for (int i = 0; i < 2; i++) {
            x[k] = keep + (i ? 1e-4 : -1e-4);
            fill(&body, x, 1, &s);
            side[i] = value[0];
        }
        x[k] = keep;
        CHECK_CLOSE((side[1] - side[0]) / 2e-4, 0, 0.1);
        CU_ASSERT(fmin(side[0], side[1]) > least - 1e-5);
    }
}

/* Two settings alike at the start: the worst of them is least half way between their targets. */
static void finds_the_least_of_the_worst(void)
{
    struct body body = {.target = {{0.6, 0, 0}, {0, 0.6, 0}}, .rest = 0.2};
    const bayesopt_descent_problem p = problem(&body, WORST);
    double x[N] = {0};
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    CHECK_CLOSE(x[0], 0.3, 0.02);
    CHECK_CLOSE(x[1], 0.3, 0.02);
}

/* Values at the end of a descent over those at the start. */
static void descend(struct body *body, const bayesopt_descent_setting setting[SETTINGS],
                    double ratio[SETTINGS])
{
    const bayesopt_descent_problem p = problem(body, setting);
    double x[N] = {0}, residual[SETTINGS * R], value[SETTINGS], state;
    const double zero[N] = {0};
    bayesopt_descent_sample s = {.residual = residual, .value = value, .state = &state};
    fill(body, zero, 1, &s);
    memcpy(ratio, value, sizeof value);
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    fill(body, x, 1, &s);
    for (size_t m = 0; m < SETTINGS; m++)
        ratio[m] = value[m] / ratio[m];
}

/* At least half of the gain of the first in the second. */
static void keeps_the_share_of_the_gain(void)
{
    static const bayesopt_descent_setting half[SETTINGS] = {{0, 1}, {0.5, 0.5}};
    struct body body = {.target = {{0.6, 0, 0}, {-0.1, 0.6, 0}}, .rest = 0.2};
    double ratio[SETTINGS];
    descend(&body, half, ratio);
    double gain = 1 - ratio[0], other = 1 - ratio[1];
    CU_ASSERT(gain > 0.3);
    CU_ASSERT(other >= 0.5 * gain - 1e-9);
    CU_ASSERT(other < 0.6 * gain);
}

/* On the fence x[0] + x[1] <= 0 the least square is the projection of the target. */
static void stays_within_known_limits(void)
{
    struct body body = {.target = {{0.5, 0.1, 0.4}, {0, 0, 0}}, .rest = 0.3};
    bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {0};
    p.n_limits = 1;
    p.limit = fence;
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    CHECK_CLOSE(x[0], 0.2, 0.02);
    CHECK_CLOSE(x[1], -0.2, 0.02);
    CHECK_CLOSE(x[2], 0.4, 0.02);
    CU_ASSERT(x[0] + x[1] <= 1e-6);
}

/* b is 3/8 at the start; 1.1 times that is v = 1 - sqrt(1 - 0.825). */
static void keeps_the_bound(void)
{
    struct body body = {.target = {{0.5, 0.1, 0}, {0, 0, 0}}, .rest = 0.1};
    bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {0}, most = 1 - sqrt(1 - 0.825) - 0.5;
    p.bound = 1.1;
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    CU_ASSERT(x[0] <= most + 1e-9);
    CU_ASSERT(x[0] > most - 0.02);
    CHECK_CLOSE(x[1], 0.1, 0.02);
}

/* A limit that bends away from its derivatives, and the least value within it, 0.2951 by a random
 * search: a few steps correct the first with the derivatives at hand. */
static void mends_what_a_step_breaks(void)
{
    static const bayesopt_descent_setting fenced[SETTINGS] = {{0, 1}, {1, 0}};
    struct body body = {.target = {{0.9, 0, 0}, {0, 0.6, 0}}, .rest = 0.1, .curvature = 0.2};
    double ratio[SETTINGS];
    descend(&body, fenced, ratio);
    CU_ASSERT(ratio[1] <= 1);
    CU_ASSERT(ratio[1] > 0.98);
    CHECK_CLOSE(ratio[0], 0.2951, 0.005);
    CU_ASSERT(body.fine <= 9);
    CU_ASSERT(body.coarse <= 4 * (N + 1));
}

/* Where there are no values the steps get shorter; a budget ends the search with the best. */
static void stops_where_it_must(void)
{
    struct body body = {.target = {{0, 0, 0.8}, {0, 0, 0}}, .rest = 0.1, .broken = true};
    const bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {0};
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    CU_ASSERT(x[2] <= 0.3);
    CU_ASSERT(x[2] > 0.2);
    body = (struct body){.target = {{1.5, 0, 0}, {0, 0, 0}}, .rest = 0.1, .most = 2};
    memset(x, 0, sizeof x);
    CU_ASSERT_EQUAL(bayesopt_descend(&p, x, NULL), BAYESOPT_STOP_BUDGET);
    CU_ASSERT_EQUAL(body.fine, 2);
    CHECK_CLOSE(x[0], 0.8, 1e-6);
}

/* Another start, at which the ratios are one: |r|^2 is 1.28 there and 0.09 at the target. */
static void starts_where_it_is_told(void)
{
    struct body body = {.target = {{0.5, -0.3, 0.8}, {0, 0, 0}}, .rest = 0.3};
    const bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {1.2, 0.4, 1.3}, ratio;
    const double start = 0.7 * 0.7 + 0.7 * 0.7 + 0.5 * 0.5 + 0.09;
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, &ratio), BAYESOPT_OK);
    for (int k = 0; k < N; k++)
        CHECK_CLOSE(x[k], body.target[0][k], 0.02);
    CHECK_CLOSE(ratio, 0.09 / start, 1e-3);
}

/* A limit that no point keeps: the second sum is asked to fall to a tenth though its residuals do
 * not depend on x at its rest of 0.5. */
static void tells_that_nothing_is_allowed(void)
{
    static const bayesopt_descent_setting tenth[SETTINGS] = {{0, 1}, {0.1, 0}};
    struct body body = {.target = {{0.5, -0.3, 0.8}, {0, 0, 0}}, .rest = 0.5};
    const bayesopt_descent_problem p = problem(&body, tenth);
    double x[N] = {0}, ratio;
    CU_ASSERT_EQUAL(bayesopt_descend(&p, x, &ratio), BAYESOPT_NONE_FEASIBLE);
    CU_ASSERT(isfinite(ratio));
}

/* Two linear settings whose model is exact: the worst of |x - a|^2 + c and |x - b|^2 + c within a
 * ball or the fence, by hand. a and b are as far from the start. */
static void minimises_the_model_at_the_start(void)
{
    struct body body = {.target = {{0.6, 0, 0}, {0, 0.6, 0}}, .rest = 0.2, .fence = -0.2};
    const double start = 0.36 + 0.04;
    bayesopt_descent_problem p = problem(&body, WORST), fenced, alone;
    bayesopt_descent_model *model = NULL;
    double x[N], ratio, broken;
    body.exact = true;
    CU_ASSERT_EQUAL_FATAL(bayesopt_descent_model_create(&p, NULL, &model), BAYESOPT_OK);
    CU_ASSERT_EQUAL(body.fine, 1);
    CU_ASSERT_EQUAL(body.coarse, N + 1);
    CU_ASSERT_EQUAL(
        bayesopt_descent_model_minimise(model, NULL, NULL, INFINITY, 0, x, &ratio, &broken),
        BAYESOPT_OK);
    CHECK_CLOSE(x[0], 0.3, 1e-4);
    CHECK_CLOSE(x[1], 0.3, 1e-4);
    CHECK_CLOSE(ratio, (0.09 + 0.09 + 0.04) / start, 1e-5);
    CHECK_CLOSE(broken, 0, 1e-12);
    alone = p; /* the second may stay where it is: |x - b|^2 <= |b|^2, a circle through the start */
    alone.setting = (const bayesopt_descent_setting[]){{0, 1}, {1, 0}};
    CU_ASSERT_EQUAL(
        bayesopt_descent_model_minimise(model, &alone, NULL, INFINITY, 0, x, &ratio, &broken),
        BAYESOPT_OK);
    CHECK_CLOSE(x[0], 0.6 / sqrt(2), 1e-3);
    CHECK_CLOSE(x[1], 0.6 - 0.6 / sqrt(2), 1e-3);
    CHECK_CLOSE(ratio, (0.36 * (3 - 2 * sqrt(2)) + 0.04) / start, 1e-4);
    fenced = p; /* x + y <= -0.2 */
    fenced.n_limits = 1;
    fenced.limit = fence;
    CU_ASSERT_EQUAL(
        bayesopt_descent_model_minimise(model, &fenced, NULL, INFINITY, 0, x, &ratio, NULL),
        BAYESOPT_OK);
    CHECK_CLOSE(x[0], -0.1, 1e-4);
    CHECK_CLOSE(x[1], -0.1, 1e-4);
    /* A tenth of the half width, 2, about (1, 0, 0) and on to the start: where y is 0.2 the two
     * sums are equal at x = 0.2. */
    CU_ASSERT_EQUAL(bayesopt_descent_model_minimise(model, NULL, (const double[]){1, 0, 0}, 0.1, 0,
                                                    x, &ratio, NULL),
                    BAYESOPT_OK);
    CHECK_CLOSE(x[0], 0.2, 1e-4);
    CHECK_CLOSE(x[1], 0.2, 1e-4);
    body.fence = -10;
    CU_ASSERT_EQUAL(
        bayesopt_descent_model_minimise(model, &fenced, NULL, INFINITY, 0, x, &ratio, NULL),
        BAYESOPT_ERROR_INFEASIBLE);
    CU_ASSERT_EQUAL(body.fine, 1);
    bayesopt_descent_model_free(model);
}

/* The derivatives of the first setting, and those of the others that body->known has. */
static bayesopt_descent_answer slopes(void *user_data, const double *x, bayesopt_descent_slopes *s)
{
    struct body *body = user_data;
    body->derivatives++;
    for (int m = 0; m < body->known; m++) {
        s->known[m] = true;
        for (int k = 0; k < N; k++)
            for (int i = 0; i < R; i++)
                s->residual[(m * N + k) * R + i] =
                    (i < N) * ((i == k) + 2 * body->curvature * x[k]);
    }
    s->state_known = body->known == SETTINGS;
    for (int k = 0; k < N && s->state_known; k++)
        s->state[k] = k == 0;
    if (body->lost != 0)
        s->residual[0] = NAN;
    return body->known ? BAYESOPT_DESCENT_VALUED : BAYESOPT_DESCENT_FAILED;
}

/* Derivatives that are given: all, so that nothing is differenced; of one setting, while the other
 * and the state are; none after all; or numbers that are none, which are differenced too. */
static void takes_derivatives(void)
{
    for (int known = SETTINGS; known >= -1; known--) {
        struct body body = {.target = {{0.9, 0, 0}, {0, 0.6, 0}}, .rest = 0.1, .curvature = 0.2};
        bayesopt_descent_problem p =
            problem(&body, (const bayesopt_descent_setting[]){{0, 1}, {1, 0}});
        double x[N] = {0}, ratio;
        body.known = known < 0 ? SETTINGS : known;
        body.lost = known < 0 ? 10 : 0;
        p.derivatives = slopes;
        p.bound = 3; /* not reached */
        if (known == SETTINGS)
            p.coarse = NULL;
        CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, &ratio), BAYESOPT_OK);
        CHECK_CLOSE(ratio, 0.2951, 0.005);
        CU_ASSERT(body.derivatives >= 1);
        CU_ASSERT_EQUAL(body.coarse, known == SETTINGS ? 0 : body.derivatives * (N + 1));
    }
}

/* Without coarse evaluations what is not known is not to be had. */
static void needs_all_derivatives(void)
{
    struct body body = {.target = {{0.9, 0, 0}, {0, 0.6, 0}}, .rest = 0.1, .known = 1};
    bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {0};
    p.derivatives = slopes;
    p.coarse = NULL;
    CU_ASSERT_EQUAL(bayesopt_descend(&p, x, NULL), BAYESOPT_ERROR_NUMERIC);
}

/* Refused, with a sentence that says what. */
#define REFUSED(call)                                                                              \
    do {                                                                                           \
        int status = (call);                                                                       \
        if (status != BAYESOPT_ERROR_ARGUMENT || !*bayesopt_last_error())                          \
            fprintf(stderr, "%s gives %d (%s)\n", #call, status, bayesopt_last_error());           \
        CU_ASSERT_EQUAL(status, BAYESOPT_ERROR_ARGUMENT);                                          \
    } while (0)

static void refuses_what_is_no_problem(void)
{
    static const bayesopt_descent_setting none[SETTINGS] = {{1, 0}, {1, 0}},
                                          back[SETTINGS] = {{0, 1}, {1, -1}},
                                          lost[SETTINGS] = {{0, 1}, {NAN, 0}};
    static const double wide[N] = {-2, NAN, -2};
    struct body body = {.target = {{0.5, 0, 0}, {0, 0, 0}}, .rest = 0.5};
    const bayesopt_descent_problem good = problem(&body, ALONE);
    double x[N] = {0}, outside[N] = {3, 0, 0};
    bayesopt_descent_problem_init(NULL);
    REFUSED(bayesopt_descend(NULL, x, NULL));
    REFUSED(bayesopt_descend(&good, NULL, NULL));
    REFUSED(bayesopt_descend(&good, outside, NULL));
#define REFUSED_WITH(change)                                                                       \
    do {                                                                                           \
        bayesopt_descent_problem bad = good;                                                       \
        bad.change;                                                                                \
        REFUSED(bayesopt_descend(&bad, x, NULL));                                                  \
    } while (0)
    REFUSED_WITH(d = 0);
    REFUSED_WITH(d = (size_t)-1);
    REFUSED_WITH(lower = NULL);
    REFUSED_WITH(upper = NULL);
    REFUSED_WITH(lower = wide);
    REFUSED_WITH(upper = LOWER);
    REFUSED_WITH(n_settings = 0);
    REFUSED_WITH(n_settings = (size_t)-1);
    REFUSED_WITH(setting = NULL);
    REFUSED_WITH(setting = none);
    REFUSED_WITH(setting = back);
    REFUSED_WITH(setting = lost);
    REFUSED_WITH(n_residuals = 0);
    REFUSED_WITH(n_residuals = (size_t)-1);
    REFUSED_WITH(n_state = (size_t)-1);
    REFUSED_WITH(bound = INFINITY);
    REFUSED_WITH(n_limits = 1);
    REFUSED_WITH(n_limits = (size_t)-1);
    REFUSED_WITH(fine = NULL);
    REFUSED_WITH(coarse = NULL); /* and no derivatives */
    bayesopt_descent_problem bad = good;
    bad.bound = 1;
    bad.function = NULL;
    REFUSED(bayesopt_descend(&bad, x, NULL));
    CU_ASSERT_EQUAL(body.fine + body.coarse, 0);
}

static void refuses_what_is_no_model(void)
{
    struct body body = {.target = {{0.5, 0, 0}, {0, 0, 0}}, .rest = 0.5};
    const bayesopt_descent_problem good = problem(&body, ALONE);
    bayesopt_descent_problem other = good;
    bayesopt_descent_model *model = NULL;
    double x[N], ratio;
    const double nowhere[N] = {0, NAN, 0}, outside[N] = {3, 0, 0};
    REFUSED(bayesopt_descent_model_create(NULL, NULL, &model));
    REFUSED(bayesopt_descent_model_create(&good, NULL, NULL));
    REFUSED(bayesopt_descent_model_create(&good, outside, &model));
    CU_ASSERT_PTR_NULL(model);
    bayesopt_descent_model_free(NULL);
    CU_ASSERT_EQUAL_FATAL(bayesopt_descent_model_create(&good, NULL, &model), BAYESOPT_OK);
    REFUSED(bayesopt_descent_model_minimise(NULL, NULL, NULL, 1, 0, x, &ratio, NULL));
    REFUSED(bayesopt_descent_model_minimise(model, NULL, NULL, 1, 0, NULL, &ratio, NULL));
    REFUSED(bayesopt_descent_model_minimise(model, NULL, NULL, 1, 0, x, NULL, NULL));
    REFUSED(bayesopt_descent_model_minimise(model, NULL, NULL, 0, 0, x, &ratio, NULL));
    REFUSED(bayesopt_descent_model_minimise(model, NULL, NULL, NAN, 0, x, &ratio, NULL));
    REFUSED(bayesopt_descent_model_minimise(model, NULL, NULL, 1, NAN, x, &ratio, NULL));
    REFUSED(bayesopt_descent_model_minimise(model, NULL, nowhere, 1, 0, x, &ratio, NULL));
    other.n_state = 0;
    REFUSED(bayesopt_descent_model_minimise(model, &other, NULL, 1, 0, x, &ratio, NULL));
    other = good;
    other.bound = 1;
    REFUSED(bayesopt_descent_model_minimise(model, &other, NULL, 1, 0, x, &ratio, NULL));
    bayesopt_descent_model_free(model);
}

/* Numbers that are none do not pass for values, neither of the start nor of a step. */
static void takes_no_number_that_is_none(void)
{
    struct body body = {.target = {{0.5, -0.3, 0.8}, {0, 0, 0}}, .rest = 0.5, .lost = -3};
    bayesopt_descent_problem p = problem(&body, ALONE);
    double x[N] = {0};
    CU_ASSERT_EQUAL(bayesopt_descend(&p, x, NULL), BAYESOPT_ERROR_NUMERIC);
    body.lost = 0.3; /* of x[2] and above */
    CU_ASSERT_EQUAL_FATAL(bayesopt_descend(&p, x, NULL), BAYESOPT_OK);
    CU_ASSERT(x[2] <= 0.3);
    CU_ASSERT(x[2] > 0.2);
    body = (struct body){.rest = 0}; /* a sum of squares that is 0 at the start */
    memset(x, 0, sizeof x);
    CU_ASSERT_EQUAL(bayesopt_descend(&p, x, NULL), BAYESOPT_ERROR_NUMERIC);
}

static const struct check_case cases[] = {
    {"finds the least squares", finds_the_least_squares},
    {"finds a stationary point of bent residuals", finds_a_stationary_point_of_bent_residuals},
    {"finds the least of the worst", finds_the_least_of_the_worst},
    {"keeps the share of the gain", keeps_the_share_of_the_gain},
    {"stays within known limits", stays_within_known_limits},
    {"keeps the bound", keeps_the_bound},
    {"mends what a step breaks", mends_what_a_step_breaks},
    {"stops where it must", stops_where_it_must},
    {"starts where it is told", starts_where_it_is_told},
    {"tells that nothing is allowed", tells_that_nothing_is_allowed},
    {"minimises the model at the start", minimises_the_model_at_the_start},
    {"takes derivatives", takes_derivatives},
    {"needs all derivatives", needs_all_derivatives},
    {"refuses what is no problem", refuses_what_is_no_problem},
    {"refuses what is no model", refuses_what_is_no_model},
    {"takes no number that is none", takes_no_number_that_is_none},
};

CHECK_MAIN("descent", cases)
