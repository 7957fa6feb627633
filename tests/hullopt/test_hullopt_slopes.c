/* The derivatives that a descent takes by tangents against differences of the same evaluation on
 * the same mesh: wave residuals of every setting with the friction, samples of the pressure. */
#include "check.h"
#include "core/residuals.h"
#include "shape_yaml.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[200];
static struct config config;
static struct problem problem;

static void say_why(bool ok)
{
    if (!ok)
        fprintf(stderr, "%s\n", core_sentence());
    CU_ASSERT_TRUE_FATAL(ok);
}

static void read_problem(const char *text)
{
    const struct core_watch nobody = {0};
    FILE *file = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fputs(text, file);
    fclose(file);
    CU_ASSERT_TRUE_FATAL(config_read(path, NULL, &config));
    say_why(problem_read(&config, &problem));
    galv_shape *shape = problem_shape(&problem);
    CU_ASSERT_PTR_NOT_NULL_FATAL(shape);
    say_why(problem_reduce(&problem, shape, &nobody));
    galv_shape_free(shape);
}

static void free_problem(void)
{
    problem_free(&problem);
    config_free(&config);
}

/* Everything of two designs and of the derivatives between them. */
struct numbers {
    bayesopt_descent_sample side[2];
    bayesopt_descent_slopes slopes;
    size_t residuals, state;
};

static double *numbers(size_t n)
{
    double *list = calloc(n + 1, sizeof *list);
    CU_ASSERT_PTR_NOT_NULL_FATAL(list);
    return list;
}

static void make_numbers(const bayesopt_descent_problem *p, struct numbers *n)
{
    n->residuals = p->n_settings * p->n_residuals;
    n->state = p->n_state;
    for (int i = 0; i < 2; i++)
        n->side[i] = (bayesopt_descent_sample){.residual = numbers(n->residuals),
                                               .value = numbers(p->n_settings),
                                               .state = numbers(n->state)};
    n->slopes = (bayesopt_descent_slopes){.residual = numbers(p->d * n->residuals),
                                          .state = numbers(p->d * n->state)};
    n->slopes.known = calloc(p->n_settings, sizeof *n->slopes.known);
    CU_ASSERT_PTR_NOT_NULL_FATAL(n->slopes.known);
}

static void free_numbers(struct numbers *n)
{
    for (int i = 0; i < 2; i++) {
        free(n->side[i].residual);
        free(n->side[i].value);
        free(n->side[i].state);
    }
    free(n->slopes.residual);
    free(n->slopes.state);
    free(n->slopes.known);
}

/* Largest error of n derivatives over the largest difference; sides `step` apart. */
static double error(size_t n, const double *ahead, const double *behind, double step,
                    const double *slope)
{
    double worst = 0, largest = 0;
    for (size_t i = 0; i < n; i++) {
        double difference = (ahead[i] - behind[i]) / step;
        worst = fmax(worst, fabs(difference - slope[i]));
        largest = fmax(largest, fabs(difference));
    }
    return worst / largest;
}

/* At u, a share of the upper bounds, by central differences over a share of the half width. `by`
 * settings are known by tangents. */
static void check_slopes(double share, double width, size_t by, double tolerance)
{
    struct descent d;
    struct numbers n;
    const bayesopt_descent_problem *p = &d.problem;
    say_why(descent_start(&problem, NULL, &d));
    for (size_t m = 0; m < p->n_settings; m++)
        d.coarse[m] = d.slopes.setting[m]; /* the very same mesh */
    make_numbers(p, &n);
    const bayesopt_descent_slopes none = {.known = calloc(p->n_settings, sizeof(bool))};
    double *u = numbers(p->d);
    for (size_t k = 0; k < p->d; k++)
        u[k] = share * (k % 2 ? p->lower[k] : p->upper[k]);
    say_why(p->derivatives(p->user_data, u, &n.slopes) == BAYESOPT_DESCENT_VALUED);
    size_t known = 0;
    for (size_t m = 0; m < p->n_settings; m++)
        known += n.slopes.known[m];
    CU_ASSERT_EQUAL(known, by);
    CU_ASSERT_TRUE(n.slopes.state_known);
    for (size_t k = 0; k < p->d; k++) {
        double keep = u[k], h = width * (p->upper[k] - p->lower[k]) / 2;
        for (int i = 0; i < 2; i++) {
            n.side[i].known = &none;
            u[k] = i ? keep - h : keep + h;
            CU_ASSERT_EQUAL_FATAL(p->coarse(p->user_data, u, &n.side[i]), BAYESOPT_DESCENT_VALUED);
        }
        u[k] = keep;
        for (size_t m = 0; m < p->n_settings; m++)
            if (n.slopes.known[m])
                CHECK_CLOSE(error(p->n_residuals, n.side[0].residual + m * p->n_residuals,
                                  n.side[1].residual + m * p->n_residuals, 2 * h,
                                  n.slopes.residual + (m * p->d + k) * p->n_residuals),
                            0, tolerance);
        CHECK_CLOSE(
            error(n.state, n.side[0].state, n.side[1].state, 2 * h, n.slopes.state + k * n.state),
            0, 2 * tolerance);
    }
    free(none.known);
    free(u);
    free_numbers(&n);
    descent_end(&d);
}

/* Resistance of the ship, so that residuals grow with the wetted surface and the friction is one of
 * them. */
static void agrees_on_a_wigley_hull(void)
{
    read_problem("hull: " EXAMPLES_DIR "/hulls/wigley.json\nshape: " EXAMPLES_DIR
                 "/wigley_shape.yaml\ngrid: {sections: 21, girth: 9}\n"
                 "latent: {samples: 200, variance: 0.8}\n"
                 "flow: {froude: 0.316}\n"
                 "solver: {formulation: neumann-kelvin, elements_u: 10, elements_v: 4, "
                 "tolerance: 1e-7}\n"
                 "reconstruction: {tolerance: 1e-3}\n"
                 "objective: {quantity: total-resistance}\n"
                 "search: {method: gauss-newton, models: [double-body-kochin, michell, hogner]}\n"
                 "constraints: {pressure: 1, speeds: 1}\nverification: {froude: [0.28]}\n");
    check_slopes(0, 0.005, 8, 8e-4);
    check_slopes(0.5, 0.005, 8, 8e-4);
    free_problem();
}

/* The potentials, whose free surface follows the waterline. */
static void agrees_with_a_free_surface(void)
{
    read_problem("hull: " EXAMPLES_DIR "/hulls/wigley.json\nshape: " EXAMPLES_DIR
                 "/wigley_shape.yaml\ngrid: {sections: 21, girth: 9}\n"
                 "latent: {samples: 200, variance: 0.6}\n"
                 "flow: {froude: 0.316}\n"
                 "solver: {formulation: exterior, elements_u: 6, elements_v: 3, tolerance: 1e-7, "
                 "surface_cells: 10}\n"
                 "reconstruction: {tolerance: 1e-3}\n"
                 "search: {method: gauss-newton, models: [double-model]}\n"
                 "constraints: {pressure: 1}\n");
    check_slopes(0.3, 0.005, 2, 3e-3);
    free_problem();
}

/* A transom and a dome. */
static void agrees_on_the_dtmb_5415(void)
{
    read_problem("hull: " EXAMPLES_DIR "/hulls/dtmb5415.json\nshape: " EXAMPLES_DIR
                 "/dtmb5415_shape.yaml\n"
                 "latent: {samples: 500, variance: 0.3}\n"
                 "flow: {froude: 0.35}\n"
                 "solver: {formulation: neumann-kelvin-stern, elements_u: 14, elements_v: 5, "
                 "tolerance: 1e-6}\n"
                 "search: {method: gauss-newton, models: [double-body-kochin, hogner]}\n"
                 "constraints: {pressure: 1}\n");
    check_slopes(0, 0.01, 3, 1e-2);
    check_slopes(0.7, 0.01, 3, 1e-2);
    free_problem();
}

static const struct check_case cases[] = {
    {"agrees on a Wigley hull", agrees_on_a_wigley_hull},
    {"agrees with a free surface", agrees_with_a_free_surface},
    {"agrees on the DTMB 5415", agrees_on_the_dtmb_5415},
};

int main(void)
{
    snprintf(path, sizeof path, "%s/test_hullopt_slopes_%ld.yaml", check_scratch(), (long)getpid());
    int failed = check_main("tangents of a run", cases, sizeof cases / sizeof *cases);
    remove(path);
    return failed;
}
