/* The Gauss-Newton search on problems whose optimum is known in closed form. */
#include "check.h"
#include "core/gauss_newton.h"

#include <math.h>
#include <string.h>

enum { N = 3, R = GN_RESIDUALS, SETTINGS = 2, POINTS = 1 };

/* Residuals x - target_m with a bend: the first components are bent by curvature |x|^2, the rest
 * are constant, so that |r|^2 has its least value where x is the target when nothing is bent. The
 * coarse mesh sees slopes 5 % too steep and values that are off. */
struct body {
    double target[SETTINGS][N], rest, curvature;
    double fence; /* of x[0] + x[1] */
    int fine, coarse, most;
    bool broken; /* no design with x[2] > 0.3 */
};

static void fill(const struct body *body, const double *x, double slope, struct gn_sample *s)
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
    /* By pressure: v_x - v_x^2/2 with v_x = x[0] + 1/2 on a unit area: 3/8 for the parent. */
    s->point[0] = (igabem_pressure_sample){.v = {slope * (x[0] + 0.5)}, .area = 1};
    s->pressure = igabem_pressure_sum(1, s->point, NULL);
}

static enum gn_answer fine(void *user_data, const double *x, struct gn_sample *s)
{
    struct body *body = user_data;
    if (body->most && body->fine == body->most)
        return GN_STOP;
    body->fine++;
    if (body->broken && x[2] > 0.3)
        return GN_FAILED;
    fill(body, x, 1, s);
    return GN_VALUED;
}

static enum gn_answer coarse(void *user_data, const double *x, struct gn_sample *s)
{
    struct body *body = user_data;
    body->coarse++;
    fill(body, x, 1.05, s);
    return GN_VALUED;
}

static bool fence(void *user_data, const double *x, double *value)
{
    const struct body *body = user_data;
    value[0] = x[0] + x[1] - body->fence;
    return true;
}

static const double LOWER[N] = {-2, -2, -2}, UPPER[N] = {2, 2, 2};
static const struct gn_setting ALONE[SETTINGS] = {{0, 1}, {100, 0}};
static const struct gn_setting WORST[SETTINGS] = {{0, 1}, {0, 1}};

static struct gn_problem problem(struct body *body, const struct gn_setting *setting)
{
    return (struct gn_problem){.n = N,
                               .lower = LOWER,
                               .upper = UPPER,
                               .settings = SETTINGS,
                               .setting = setting,
                               .points = POINTS,
                               .pressure = NAN,
                               .coarse = coarse,
                               .fine = fine,
                               .user_data = body};
}

static void finds_the_least_squares(void)
{
    struct body body = {.target = {{0.5, -0.3, 0.8}, {0, 0, 0}}, .rest = 0.5};
    const struct gn_problem p = problem(&body, ALONE);
    double x[N];
    CU_ASSERT_FATAL(gn_run(&p, x));
    for (int k = 0; k < N; k++)
        CHECK_CLOSE(x[k], body.target[0][k], 0.02);
    CU_ASSERT(body.fine <= 6);
    CU_ASSERT(body.coarse <= 5 * (N + 1));
}

/* Bent residuals: the gradient of |r|^2, by differences, vanishes. */
static void finds_a_stationary_point_of_bent_residuals(void)
{
    struct body body = {.target = {{0.5, -0.3, 0.8}, {0, 0, 0}}, .rest = 0.3, .curvature = 0.15};
    const struct gn_problem p = problem(&body, ALONE);
    double x[N], residual[SETTINGS * R], value[SETTINGS], side[2];
    igabem_pressure_sample point[POINTS];
    struct gn_sample s = {.residual = residual, .value = value, .points = POINTS, .point = point};
    CU_ASSERT_FATAL(gn_run(&p, x));
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

/* Two settings of equal parents: the worst of them is least half way between their targets. */
static void finds_the_least_of_the_worst(void)
{
    struct body body = {.target = {{0.6, 0, 0}, {0, 0.6, 0}}, .rest = 0.2};
    const struct gn_problem p = problem(&body, WORST);
    double x[N];
    CU_ASSERT_FATAL(gn_run(&p, x));
    CHECK_CLOSE(x[0], 0.3, 0.02);
    CHECK_CLOSE(x[1], 0.3, 0.02);
}

/* Values at the end of a descent over those of the parent. */
static void descend(struct body *body, const struct gn_setting setting[SETTINGS],
                    double ratio[SETTINGS])
{
    const struct gn_problem p = problem(body, setting);
    double x[N], residual[SETTINGS * R], value[SETTINGS];
    const double zero[N] = {0};
    igabem_pressure_sample point[POINTS];
    struct gn_sample s = {.residual = residual, .value = value, .points = POINTS, .point = point};
    fill(body, zero, 1, &s);
    memcpy(ratio, value, sizeof value);
    CU_ASSERT_FATAL(gn_run(&p, x));
    fill(body, x, 1, &s);
    for (size_t m = 0; m < SETTINGS; m++)
        ratio[m] = value[m] / ratio[m];
}

/* At least half of the gain of the first in the second. */
static void keeps_the_share_of_the_gain(void)
{
    static const struct gn_setting half[SETTINGS] = {{0, 1}, {0.5, 0.5}};
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
    struct gn_problem p = problem(&body, ALONE);
    double x[N];
    p.limits = 1;
    p.limit = fence;
    CU_ASSERT_FATAL(gn_run(&p, x));
    CHECK_CLOSE(x[0], 0.2, 0.02);
    CHECK_CLOSE(x[1], -0.2, 0.02);
    CHECK_CLOSE(x[2], 0.4, 0.02);
    CU_ASSERT(x[0] + x[1] <= 1e-6);
}

/* The pressure of the parent is 3/8; 1.1 times that is v = 1 - sqrt(1 - 0.825). */
static void keeps_the_pressure(void)
{
    struct body body = {.target = {{0.5, 0.1, 0}, {0, 0, 0}}, .rest = 0.1};
    struct gn_problem p = problem(&body, ALONE);
    double x[N], most = 1 - sqrt(1 - 0.825) - 0.5;
    p.pressure = 1.1;
    CU_ASSERT_FATAL(gn_run(&p, x));
    CU_ASSERT(x[0] <= most + 1e-9);
    CU_ASSERT(x[0] > most - 0.02);
    CHECK_CLOSE(x[1], 0.1, 0.02);
}

/* A limit that bends away from its derivatives, and the least value within it, 0.2951 by a random
 * search: a few steps correct the first with the derivatives at hand. */
static void mends_what_a_step_breaks(void)
{
    static const struct gn_setting fenced[SETTINGS] = {{0, 1}, {1, 0}};
    struct body body = {.target = {{0.9, 0, 0}, {0, 0.6, 0}}, .rest = 0.1, .curvature = 0.2};
    double ratio[SETTINGS];
    descend(&body, fenced, ratio);
    CU_ASSERT(ratio[1] <= 1);
    CU_ASSERT(ratio[1] > 0.98);
    CHECK_CLOSE(ratio[0], 0.2951, 0.005);
    CU_ASSERT(body.fine <= 9);
    CU_ASSERT(body.coarse <= 4 * (N + 1));
}

/* Where designs cannot be built the steps get shorter; a budget ends the search with the best. */
static void stops_where_it_must(void)
{
    struct body body = {.target = {{0, 0, 0.8}, {0, 0, 0}}, .rest = 0.1, .broken = true};
    const struct gn_problem p = problem(&body, ALONE);
    double x[N];
    CU_ASSERT_FATAL(gn_run(&p, x));
    CU_ASSERT(x[2] <= 0.3);
    CU_ASSERT(x[2] > 0.2);
    body = (struct body){.target = {{1.5, 0, 0}, {0, 0, 0}}, .rest = 0.1, .most = 2};
    CU_ASSERT_FATAL(gn_run(&p, x));
    CU_ASSERT_EQUAL(body.fine, 2);
    CHECK_CLOSE(x[0], 0.8, 1e-6);
}

static const struct check_case cases[] = {
    {"finds the least squares", finds_the_least_squares},
    {"finds a stationary point of bent residuals", finds_a_stationary_point_of_bent_residuals},
    {"finds the least of the worst", finds_the_least_of_the_worst},
    {"keeps the share of the gain", keeps_the_share_of_the_gain},
    {"stays within known limits", stays_within_known_limits},
    {"keeps the pressure", keeps_the_pressure},
    {"mends what a step breaks", mends_what_a_step_breaks},
    {"stops where it must", stops_where_it_must},
};

CHECK_MAIN("Gauss-Newton", cases)
