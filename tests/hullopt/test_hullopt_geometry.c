/* From a configuration to the parent, its latent space and the hulls of latent points, on the
 * shipped Wigley hull: V = 4/9 L B T. And which designs the constraints allow. */
#include "check.h"
#include "core/constraints.h"
#include "core/jobs.h"
#include "core/objective.h"
#include "core/problem.h"

#include <signal.h>
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

static void test_parent(void)
{
    FILE *file = fopen(path, "w");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    fputs("hull: " EXAMPLES_DIR "/hulls/wigley.json\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\n"
          "grid: {sections: 21, girth: 9}\nlatent: {samples: 200, variance: 0.95}\n"
          "flow: {froude: 0.316}\nsolver: {formulation: hogner}\n"
          "reconstruction: {tolerance: 1e-3}\nsearch: {initial: 8}\n"
          "constraints: {displacement: 0.05, breadth: 0.2, entrance: 1.2}\n",
          file);
    fclose(file);
    CU_ASSERT_TRUE_FATAL(config_read(path, NULL, &config));
    say_why(problem_read(&config, &problem));
    CU_ASSERT_EQUAL(nurbs_grid_rows(problem.grid), 21);
    CU_ASSERT_EQUAL(nurbs_grid_columns(problem.grid), 9);
    CHECK_CLOSE(problem_length(&problem), 1, 1e-6);
    CHECK_RELATIVE(nurbs_hull_hydrostatics(problem.parent.hull)->volume, 4.0 / 9 * 0.1 * 0.0625,
                   5e-3);
    CU_ASSERT_TRUE(nurbs_hull_bound(problem.parent.hull) <= config.tolerance);
    /* the waterline's slope at its ends is 2 B/L */
    CHECK_CLOSE(design_nu_s(&problem.parent), 0.2 / sqrt(1.04), 0.02);
    CU_ASSERT_TRUE(isfinite(problem.solver.cutoff_angle));
    CU_ASSERT_PTR_EQUAL(problem_best(&problem), &problem.parent);
}

static void test_latent_space(void)
{
    const struct core_watch nobody = {0};
    galv_shape *shape = problem_shape(&problem);
    CU_ASSERT_PTR_NOT_NULL_FATAL(shape);
    say_why(problem_reduce(&problem, shape, &nobody));
    CU_ASSERT_TRUE(galv_model_retained(problem.model) >= config.variance);
    CU_ASSERT_PTR_NOT_NULL(galv_limits_gradient(problem.limits)); /* it moves along y alone */
    galv_shape_free(shape);
}

/* The volume told before a hull is built is that of the hull; u = 0 is the parent, bit for bit. */
static void test_designs(void)
{
    size_t modes = galv_model_modes(problem.model);
    double *u = calloc(modes, sizeof *u), ratio;
    struct design design;
    double parent = nurbs_hull_hydrostatics(problem.parent.hull)->volume;
    say_why(problem_build(&problem, u, &design));
    CU_ASSERT_EQUAL(nurbs_hull_hydrostatics(design.hull)->volume, parent);
    design_free(&design);
    for (size_t k = 0; k < modes; k++) {
        u[k] = 0.6 * galv_model_upper(problem.model)[k];
        CU_ASSERT_EQUAL(galv_limits_volume(problem.limits, u, &ratio), GALV_OK);
        say_why(problem_build(&problem, u, &design));
        CHECK_CLOSE(nurbs_hull_hydrostatics(design.hull)->volume / parent, ratio, 2e-4);
        design_free(&design);
    }
    say_why(problem_set_best(&problem, u));
    CU_ASSERT_PTR_EQUAL(problem_best(&problem), &problem.best);
    u[0] = NAN;
    CU_ASSERT_FALSE(problem_build(&problem, u, &design));
    CU_ASSERT_EQUAL(strncmp(core_sentence(), "grid: ", 6), 0);
    CU_ASSERT_PTR_NULL(design.hull);
    for (size_t k = 0; k < modes; k++)
        u[k] = 1e3; /* metres: no hull at all */
    CU_ASSERT_FALSE(problem_build(&problem, u, &design));
    CU_ASSERT_PTR_NOT_NULL(strchr(core_sentence(), ':'));
    free(u);
}

/* One value for each limit, negative at the parent; every limit is broken by a point of its own. */
static void test_limits(void)
{
    size_t modes = galv_model_modes(problem.model);
    double *u = calloc(modes, sizeof *u), value[5];
    struct config asked = config;
    CU_ASSERT_EQUAL_FATAL(limits_count(&config), 5);
    CU_ASSERT_EQUAL(limits_evaluate(&problem, modes, u, value), 0);
    CHECK_CLOSE(value[0], -1e-9, 1e-12); /* keel and stem are on the centre plane */
    CHECK_CLOSE(value[1], 0.2 - 1, 1e-12);
    CHECK_CLOSE(value[2], 1 - 1.2, 1e-12);
    CHECK_CLOSE(value[3], -(0.05 - 1e-4), 1e-12);
    CHECK_CLOSE(value[4], -(0.05 - 1e-4), 1e-12);
    for (size_t k = 0; k < modes; k++)
        u[k] = 5 * galv_model_upper(problem.model)[k];
    CU_ASSERT_EQUAL(limits_evaluate(&problem, modes, u, value), 0);
    CU_ASSERT_TRUE(fmax(value[3], value[4]) > 0);
    asked.breadth = asked.entrance = asked.displacement = NAN;
    CU_ASSERT_EQUAL(limits_count(&asked), 1);
    free(u);
}

/* The hulls of a run come back without its files. */
static void test_restored(void)
{
    struct config again;
    struct problem back;
    galv_field fields[64];
    galv_model *model;
    size_t n = galv_model_field_count(), grid[2] = {21, 9};
    for (size_t i = 0; i < n; i++)
        fields[i] = galv_model_field(problem.model, i);
    CU_ASSERT_EQUAL_FATAL(galv_model_restore(n, fields, &model), GALV_OK);
    CU_ASSERT_TRUE_FATAL(config_restore(config.text, &again));
    CU_ASSERT_EQUAL(again.tolerance, config.tolerance);
    CU_ASSERT_EQUAL(again.displacement, 0.05);
    CU_ASSERT_TRUE(isnan(again.speeds));
    CU_ASSERT_EQUAL(again.solver.formulation, IGABEM_FORMULATION_HOGNER);
    CU_ASSERT_EQUAL(again.initial, 8);
    say_why(problem_restore(&again, model, grid, problem_length(&problem), NULL, &back));
    CU_ASSERT_EQUAL(nurbs_hull_hydrostatics(back.parent.hull)->volume,
                    nurbs_hull_hydrostatics(problem.parent.hull)->volume);
    problem_free(&back);
    CU_ASSERT_EQUAL_FATAL(galv_model_restore(n, fields, &model), GALV_OK);
    grid[0] = 20;
    CU_ASSERT_FALSE(problem_restore(&again, model, grid, 1, NULL, &back));
    CU_ASSERT_PTR_NOT_NULL(strstr(core_sentence(), "20 x 9"));
    config_free(&again);
    CU_ASSERT_FALSE(config_restore("colour = red\n", &again));
}

static void test_allowed_designs(void)
{
    struct evaluation parent = {.id = 0, .cw = 2, .cw_pressure = 3};
    struct evaluation better = {.id = 5, .cw = 1, .cw_pressure = 3.2};
    const struct config none = {.confirm = NAN, .pressure = NAN, .speeds = NAN},
                        loose = {.confirm = NAN, .pressure = 1.1, .speeds = NAN},
                        tight = {.confirm = NAN, .pressure = 1, .speeds = NAN},
                        speeds = {
                            .confirm = NAN, .pressure = NAN, .speeds = 1, .verify_froudes = 2};
    CU_ASSERT_TRUE(outcome_allowed(&none, &better, &parent));
    CU_ASSERT_TRUE(outcome_allowed(&loose, &better, &parent));
    CU_ASSERT_FALSE(outcome_allowed(&tight, &better, &parent));
    CU_ASSERT_TRUE(outcome_allowed(&tight, &parent, &parent));
    better.failed = true;
    CU_ASSERT_FALSE(outcome_allowed(&none, &better, &parent));
    parent.cw_pressure = better.cw_pressure = NAN;
    better.failed = false;
    CU_ASSERT_FALSE(outcome_allowed(&tight, &better, &parent));
    parent.speeds = better.speeds = 2;
    parent.cw_speed[0] = parent.cw_speed[1] = 1;
    better.cw_speed[0] = 0.5;
    better.cw_speed[1] = 1.01;
    CU_ASSERT_FALSE(outcome_allowed(&speeds, &better, &parent));
    CU_ASSERT_TRUE(outcome_allowed(&none, &better, &parent));
    better.cw_speed[1] = 0.99;
    CU_ASSERT_TRUE(outcome_allowed(&speeds, &better, &parent));
    better.cw_speed[0] = NAN;
    CU_ASSERT_FALSE(outcome_allowed(&speeds, &better, &parent));
    double lower[OUTCOME_MOST], bound[OUTCOME_MOST], ratio[OUTCOME_MOST];
    const struct config both = {.confirm = NAN, .pressure = 1.1, .speeds = 1, .verify_froudes = 2};
    better.cw_speed[0] = 0.25;
    parent.cw_pressure = 2;
    better.cw_pressure = 1;
    CU_ASSERT_EQUAL_FATAL(outcome_bounds(&both, lower, bound), 3);
    outcome_ratios(&both, &better, &parent, ratio);
    CU_ASSERT_EQUAL(bound[0], 1.1);
    CU_ASSERT_TRUE(isinf(lower[0]) && isinf(lower[2]));
    CU_ASSERT_EQUAL(bound[2], 1);
    CU_ASSERT_EQUAL(ratio[0], 0.5);
    CU_ASSERT_EQUAL(ratio[1], 0.25);
    CU_ASSERT_EQUAL(ratio[2], 0.99);
}

/* Two designs at once have the figures that each has alone; one that is killed, and one that takes
 * longer than it may, are designs that failed. */
static void test_jobs(void)
{
    size_t modes = galv_model_modes(problem.model);
    struct job *jobs = jobs_create(2, modes), *job;
    CU_ASSERT_PTR_NOT_NULL_FATAL(jobs);
    CU_ASSERT_PTR_NULL(jobs_wait(jobs, 2, 0));
    double cw[2];
    for (size_t i = 0; i < 2; i++) {
        for (size_t k = 0; k < modes; k++)
            jobs[i].u[k] = 0.2 * (double)i * galv_model_upper(problem.model)[k];
        struct evaluation *e = &jobs[i].evaluation;
        evaluation_start(i + 1, NULL, jobs[i].u, e);
        evaluate(&problem, e, NULL, NULL);
        CU_ASSERT_FALSE(e->failed);
        cw[i] = e->cw;
        evaluation_start(i + 1, NULL, jobs[i].u, e);
        say_why(jobs_start(&problem, &jobs[i]));
    }
    for (int i = 0; i < 2; i++) {
        job = jobs_wait(jobs, 2, 0);
        CU_ASSERT_PTR_NOT_NULL_FATAL(job);
        CU_ASSERT_PTR_EQUAL(job->evaluation.u, job->u);
        CHECK_RELATIVE(job->evaluation.cw, cw[job - jobs], 1e-12);
    }
    say_why(jobs_start(&problem, &jobs[0]));
    CU_ASSERT_EQUAL(kill(jobs[0].process, SIGKILL), 0);
    job = jobs_wait(jobs, 2, 0);
    CU_ASSERT_TRUE(job == &jobs[0] && job->evaluation.failed);
    CU_ASSERT_PTR_NOT_NULL(strstr(job->evaluation.reason, "process: ended by signal 9"));
    CU_ASSERT_TRUE(isnan(job->evaluation.cw));
    say_why(jobs_start(&problem, &jobs[1]));
    CU_ASSERT_EQUAL(kill(jobs[1].process, SIGSTOP), 0);
    job = jobs_wait(jobs, 2, 0.1);
    CU_ASSERT_TRUE(job == &jobs[1] && job->evaluation.failed);
    CU_ASSERT_PTR_NOT_NULL(strstr(job->evaluation.reason, "process: not done after"));
    jobs_free(jobs, 2);
}

/* The objective is the worst ratio of all models, and each of them is bounded at other speeds. */
static void test_worst_of_models(void)
{
    const struct config several = {
        .confirm = NAN, .pressure = NAN, .speeds = 1, .verify_froudes = 1, .models = 2};
    struct evaluation e[3] = {{.cw = 2}, {.id = 1, .cw = 1}, {.id = 2, .cw = 1.2}};
    double lower[OUTCOME_MOST], upper[OUTCOME_MOST];
    for (int i = 0; i < 3; i++) {
        e[i].models = 2;
        e[i].speeds = 3;
        e[i].cw_model[0] = e[i].cw_model[1] = i ? 2 : 4;
        e[i].cw_speed[0] = e[i].cw_speed[1] = e[i].cw_speed[2] = 1;
    }
    e[1].cw_model[1] = 3.6;
    CU_ASSERT_EQUAL(outcome_bounds(&several, lower, upper), 3);
    for (int i = 0; i < 3; i++)
        e[i].objective = objective_of(&several, 1, &e[i], &e[0]);
    CU_ASSERT_EQUAL(e[0].objective, 2);
    CHECK_CLOSE(e[1].objective, 1.8, 1e-15);
    CHECK_CLOSE(e[2].objective, 1.2, 1e-15);
    CU_ASSERT_PTR_EQUAL(outcome_best(&several, 3, e), &e[2]);
    e[2].cw_speed[2] = 1.01;
    CU_ASSERT_PTR_EQUAL(outcome_best(&several, 3, e), &e[1]);
}

/* Resistances by hand: L 4 m, g 10 m/s^2, water of 1000 kg/m^3 and 1e-6 m^2/s. At Fr 0.5 U^2 is 10
 * and at 0.25 2.5 m^2/s^2; ITTC-57 gives C_f = 0.075/(log10 Re - 2)^2. */
static void test_quantities(void)
{
    struct config c = {.confirm = NAN,
                       .solver = {.froude = 0.5, .gravity = 10, .density = 1000},
                       .viscosity = 1e-6,
                       .form_factor = 0.2,
                       .verify_froudes = 1,
                       .verify_froude = {0.25}};
    const struct evaluation e[2] = {
        {.cw = 2e-3, .wetted_area = 3, .speeds = 1, .cw_speed = {1e-3}},
        {.id = 1, .cw = 1e-3, .wetted_area = 3.3, .speeds = 1, .cw_speed = {0.5e-3}}};
    double cf[2], wave[2], total[2], slow[2];
    char text[40];
    for (int j = 0; j < 2; j++) {
        double speed = sqrt(j ? 2.5 : 10), order = log10(4 * speed / 1e-6) - 2;
        cf[j] = 0.075 / (order * order);
    }
    for (int i = 0; i < 2; i++) {
        wave[i] = 5000 * e[i].wetted_area * e[i].cw;
        total[i] = 5000 * e[i].wetted_area * (e[i].cw + 1.2 * cf[0]);
        slow[i] = 1250 * e[i].wetted_area * (e[i].cw_speed[0] + 1.2 * cf[1]);
        CHECK_RELATIVE(objective_total_resistance(&c, 4, &e[i]), total[i], 1e-12);
    }
    CHECK_RELATIVE(objective_of(&c, 4, &e[1], &e[0]), 1e-3, 1e-12);
    c.quantity = QUANTITY_WAVE;
    CHECK_RELATIVE(objective_of(&c, 4, &e[1], &e[0]), 2e-3 * wave[1] / wave[0], 1e-12);
    c.quantity = QUANTITY_TOTAL;
    CHECK_RELATIVE(objective_of(&c, 4, &e[1], &e[0]), 2e-3 * total[1] / total[0], 1e-12);
    c.weights = 2;
    c.weight[0] = 1;
    c.weight[1] = 3;
    double ratio = (total[1] + 3 * slow[1]) / (total[0] + 3 * slow[0]);
    CHECK_RELATIVE(objective_of(&c, 4, &e[1], &e[0]), 2e-3 * ratio, 1e-12);
    objective_print(&c, 4, 2e-3 * ratio, &e[0], text, sizeof text);
    CU_ASSERT_STRING_EQUAL(strtok(text, " "), "weighted");
    CU_ASSERT_STRING_EQUAL(strtok(NULL, " "), "R_t");
    CHECK_RELATIVE(atof(strtok(NULL, " ")), total[1] + 3 * slow[1], 1e-3);
    c.other[0] = (struct config_objective){QUANTITY_TOTAL, 0.25, false, NULL};
    c.other[1] = (struct config_objective){QUANTITY_WAVE, NAN, false, NULL};
    CU_ASSERT_EQUAL(objectives_count(&c), 3);
    CU_ASSERT_TRUE(objectives_ask_speeds(&c));
    CHECK_RELATIVE(objectives_value(&c, 0, 4, &e[1], &e[0]), total[1] + 3 * slow[1], 1e-12);
    CHECK_RELATIVE(objectives_value(&c, 1, 4, &e[1], &e[0]), slow[1], 1e-12);
    CHECK_RELATIVE(objectives_value(&c, 2, 4, &e[1], &e[0]), wave[1], 1e-12);
    c.other[0] = (struct config_objective){QUANTITY_PARTICULAR, NAN, false, NULL};
    CU_ASSERT_FALSE(objectives_ask_speeds(&c));
    CU_ASSERT_EQUAL(objectives_value(&c, 1, 4, &e[1], &e[0]), 3.3);
    struct objective o;
    objectives_describe(&c, 1, &o);
    CU_ASSERT_STRING_EQUAL(o.name, "wetted surface, m²");
    objectives_describe(&c, 2, &o);
    CU_ASSERT_STRING_EQUAL(o.name, "wave resistance, N, at Fr 0.5");
    c.viscosity = 1; /* no correlation line at Re 13 */
    CU_ASSERT_TRUE(isnan(objective_of(&c, 4, &e[1], &e[0])));
}

static size_t violations_of(const struct config *asked, const char *name,
                            const struct evaluation e[2])
{
    for (size_t k = 0; k < constraints_count(); k++)
        if (strcmp(constraints_name(k), name) == 0)
            return constraints_violations(asked, k, 2, e);
    return SIZE_MAX;
}

/* A search ends on its limits: what lies on one but for rounding is kept. */
static void test_on_a_limit(void)
{
    const struct config asked = {.breadth = 0.2, .pressure = NAN, .speeds = NAN, .confirm = NAN};
    struct evaluation e[2] = {{.cw = 1, .breadth = 1}, {.id = 1, .cw = 1}};
    static const double breadth[] = {0.2 - 1e-14, 0.2 - 1e-5, 0.2 - 1e-4};
    for (size_t i = 0; i < 3; i++) {
        e[1].breadth = breadth[i];
        CU_ASSERT_EQUAL(violations_of(&asked, "breadth", e), i == 2);
    }
}

/* Of a gain of 50 % the other models see 50 and 10: enough for a fifth of it, not for a half. Then
 * the solver's own C_w alone is the objective. */
static void test_confirmed_gain(void)
{
    struct config asked = {.pressure = NAN, .speeds = NAN, .models = 2, .confirm = 0.5};
    struct evaluation e[2] = {{.cw = 2, .models = 2, .cw_model = {4, 1}},
                              {.id = 1, .cw = 1, .models = 2, .cw_model = {2, 0.9}}};
    double lower[OUTCOME_MOST], upper[OUTCOME_MOST], ratio[OUTCOME_MOST];
    for (size_t p = 0; p < PARTICULARS; p++)
        asked.particular[p][0] = asked.particular[p][1] = NAN;
    CU_ASSERT_EQUAL(outcome_bounds(&asked, lower, upper), 2);
    outcome_ratios(&asked, &e[1], &e[0], ratio);
    CHECK_CLOSE(ratio[0] - upper[0], -0.25, 1e-15); /* 1 - 0.5 asks for 0.75 */
    CHECK_CLOSE(ratio[1] - upper[1], 0.15, 1e-15);  /* it has 0.9 */
    CU_ASSERT_EQUAL(objective_of(&asked, 1, &e[1], &e[0]), 1);
    CU_ASSERT_FALSE(outcome_allowed(&asked, &e[1], &e[0]));
    CU_ASSERT_EQUAL(violations_of(&asked, "confirm", e), 1);
    asked.confirm = 0.2;
    CU_ASSERT_TRUE(outcome_allowed(&asked, &e[1], &e[0]));
    CU_ASSERT_EQUAL(violations_of(&asked, "confirm", e), 0);
}

static const struct check_case cases[] = {
    {"the parent", test_parent},
    {"the latent space", test_latent_space},
    {"designs of latent points", test_designs},
    {"limits known before a hull is built", test_limits},
    {"hulls without their files", test_restored},
    {"designs in processes of their own", test_jobs},
    {"designs that can be the best", test_allowed_designs},
    {"the worst of several models", test_worst_of_models},
    {"resistances as the objective", test_quantities},
    {"a share of the gain confirmed", test_confirmed_gain},
    {"on a limit but for rounding", test_on_a_limit},
};

int main(void)
{
    snprintf(path, sizeof path, "%s/hullopt_geometry_XXXXXX", check_scratch());
    int file = mkstemp(path);
    if (file < 0)
        return EXIT_FAILURE;
    close(file);
    int code = check_main("hullopt geometry", cases, sizeof cases / sizeof *cases);
    problem_free(&problem);
    config_free(&config);
    return unlink(path) == 0 ? code : EXIT_FAILURE;
}
