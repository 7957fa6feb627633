/* Every public call answers NULL and absurd sizes by a status, or by 0 or NAN where it returns a
 * value. test_misuse.sh compares the list, and that of test_descent.c, with what the library
 * exports. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdint.h>
#include <string.h>
#include <unistd.h>

enum { D = 2 };
static const size_t HUGE_COUNT = (size_t)1 << 61;
static const double lower[D] = {0, 0}, upper[D] = {1, 1};

/* Refused, with a sentence that says what. */
#define REFUSED(call)                                                                              \
    do {                                                                                           \
        int status = (call);                                                                       \
        if (status != BAYESOPT_ERROR_ARGUMENT || !*bayesopt_last_error())                          \
            fprintf(stderr, "%s gives %d (%s)\n", #call, status, bayesopt_last_error());           \
        CU_ASSERT_EQUAL(status, BAYESOPT_ERROR_ARGUMENT);                                          \
    } while (0)

static bayesopt *make(void)
{
    bayesopt *bo = NULL;
    double x[D];
    uint64_t id;
    bayesopt_options options;
    bayesopt_options_init(&options);
    options.initial_n = 4;
    options.max_evaluations = 20;
    CU_ASSERT_FATAL(bayesopt_create(D, lower, upper, &options, &bo) == BAYESOPT_OK);
    for (int i = 0; i < 4; i++) {
        CU_ASSERT(bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK);
        CU_ASSERT(bayesopt_tell(bo, id, x[0] - x[1], NULL) == BAYESOPT_OK);
    }
    return bo;
}

static void creating(void)
{
    bayesopt *bo = NULL;
    bayesopt_options o;
    bayesopt_options_init(NULL);
    REFUSED(bayesopt_create(D, NULL, upper, NULL, &bo));
    REFUSED(bayesopt_create(D, lower, NULL, NULL, &bo));
    REFUSED(bayesopt_create(D, lower, upper, NULL, NULL));
    REFUSED(bayesopt_create(0, lower, upper, NULL, &bo));
    REFUSED(bayesopt_create(HUGE_COUNT, lower, upper, NULL, &bo));
    size_t *counts[] = {&o.initial_n, &o.n_constraints, &o.n_linear, &o.n_input_constraints,
                        &o.n_levels,  &o.n_conditions,  &o.n_first};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        bayesopt_options_init(&o);
        o.linear_a = o.linear_b = o.first_x = lower;
        *counts[i] = HUGE_COUNT;
        REFUSED(bayesopt_create(D, lower, upper, &o, &bo));
        *counts[i] = SIZE_MAX;
        REFUSED(bayesopt_create(D, lower, upper, &o, &bo));
    }
    bayesopt_free(NULL);
    REFUSED(bayesopt_open_store(NULL, "x.db"));
    REFUSED(bayesopt_open(NULL, NULL, NULL, &bo));
    REFUSED(bayesopt_open("x.db", NULL, NULL, NULL));
    REFUSED(bayesopt_open_read(NULL, &bo));
    REFUSED(bayesopt_open_read("x.db", NULL));
}

static void asking_and_telling(void)
{
    bayesopt *bo = make();
    double x[D] = {0.5, 0.5}, f;
    uint64_t id;
    int level;
    bayesopt_result result = {.f = 1};
    bayesopt_point point;
    bayesopt_holder holder;
    REFUSED(bayesopt_open_store(bo, NULL));
    REFUSED(bayesopt_detach(NULL));
    REFUSED(bayesopt_reclaim(NULL));
    REFUSED(bayesopt_heartbeat(NULL, 0));
    REFUSED(bayesopt_heartbeat(bo, UINT64_MAX));
    REFUSED(bayesopt_get_holder(NULL, 1, &holder));
    REFUSED(bayesopt_get_holder(bo, 1, &holder));
    REFUSED(bayesopt_get_holder(bo, 1, NULL));
    REFUSED(bayesopt_reclaim_stale(NULL, 0));
    REFUSED(bayesopt_reclaim_stale(bo, -1));
    REFUSED(bayesopt_reclaim_stale(bo, NAN));
    REFUSED(bayesopt_ask(NULL, 1, x, &id));
    REFUSED(bayesopt_ask(bo, 1, NULL, &id));
    REFUSED(bayesopt_ask(bo, 1, x, NULL));
    REFUSED(bayesopt_ask(bo, 0, x, &id));
    REFUSED(bayesopt_ask(bo, HUGE_COUNT, x, &id));
    REFUSED(bayesopt_ask_levels(NULL, 1, x, &id, &level));
    REFUSED(bayesopt_ask_levels(bo, SIZE_MAX, x, &id, &level));
    REFUSED(bayesopt_set_ask_progress(NULL, NULL, NULL));
    REFUSED(bayesopt_tell(NULL, 1, 0, NULL));
    REFUSED(bayesopt_tell_result(NULL, 1, &result));
    REFUSED(bayesopt_tell_result(bo, 1, NULL));
    REFUSED(bayesopt_tell_failed(NULL, 1, "reason"));
    REFUSED(bayesopt_tell_failed(bo, UINT64_MAX, "reason"));
    REFUSED(bayesopt_release(NULL, 1));
    REFUSED(bayesopt_release(bo, UINT64_MAX));
    REFUSED(bayesopt_tell_point(NULL, x, 0, NULL));
    REFUSED(bayesopt_tell_point(bo, NULL, 0, NULL));
    REFUSED(bayesopt_tell_point_result(NULL, x, &result, &id));
    REFUSED(bayesopt_tell_point_result(bo, NULL, &result, &id));
    REFUSED(bayesopt_tell_point_result(bo, x, NULL, &id));
    result.n_attributes = HUGE_COUNT;
    REFUSED(bayesopt_tell_point_result(bo, x, &result, &id));
    REFUSED(bayesopt_best(NULL, x, &f, &id));
    REFUSED(bayesopt_best_told(NULL, x, &f, &id));
    REFUSED(bayesopt_get(NULL, 0, &point));
    REFUSED(bayesopt_get(bo, 0, NULL));
    REFUSED(bayesopt_get(bo, HUGE_COUNT, &point));
    REFUSED(bayesopt_refresh(NULL));
    REFUSED(bayesopt_set_budget(NULL, 1));
    CU_ASSERT(bayesopt_count(bo) == 4);
    bayesopt_free(bo);
}

static int objective(void *user_data, size_t d, const double *x, double *f, double *constraints)
{
    (void)user_data;
    (void)d;
    (void)constraints;
    *f = x[0];
    return 0;
}

static void looking(void)
{
    bayesopt *bo = make();
    double x[D] = {0.5, 0.5}, mean, sd;
    bayesopt_model_info info;
    CU_ASSERT(bayesopt_count(NULL) == 0);
    CU_ASSERT(bayesopt_dimension(NULL, x, x) == 0);
    CU_ASSERT(bayesopt_constraint_count(NULL, x, x) == 0);
    CU_ASSERT(bayesopt_budget(NULL) == 0 && bayesopt_initial_count(NULL) == 0);
    CU_ASSERT(bayesopt_seed(NULL) == 0 && bayesopt_level_count(NULL) == 0);
    CU_ASSERT(bayesopt_variable_kind(NULL, 0) == BAYESOPT_KIND_REAL);
    CU_ASSERT_STRING_EQUAL(bayesopt_variable_name(NULL, 0), "");
    CU_ASSERT_STRING_EQUAL(bayesopt_variable_name(bo, HUGE_COUNT), "");
    CU_ASSERT(!bayesopt_maximises(NULL));
    CU_ASSERT(bayesopt_dimension(bo, NULL, NULL) == D);
    CU_ASSERT(bayesopt_constraint_count(bo, NULL, NULL) == 0);
    REFUSED(bayesopt_predict(NULL, 1, x, &mean, &sd));
    REFUSED(bayesopt_predict(bo, 1, NULL, &mean, &sd));
    REFUSED(bayesopt_predict(bo, 1, x, NULL, &sd));
    REFUSED(bayesopt_predict(bo, HUGE_COUNT, x, &mean, &sd));
    size_t front;
    CU_ASSERT(bayesopt_objective_count(NULL) == 0);
    REFUSED(bayesopt_pareto(NULL, &front, NULL));
    REFUSED(bayesopt_pareto(bo, NULL, NULL));
    REFUSED(bayesopt_hypervolume(0, 1, x, x, &mean));
    REFUSED(bayesopt_hypervolume(9, 1, x, x, &mean));
    REFUSED(bayesopt_hypervolume(2, 1, NULL, x, &mean));
    REFUSED(bayesopt_hypervolume(2, 1, x, NULL, &mean));
    REFUSED(bayesopt_hypervolume(2, 1, x, x, NULL));
    REFUSED(bayesopt_hypervolume(2, HUGE_COUNT, x, x, &mean));
    REFUSED(bayesopt_predict_outcome(NULL, 0, 1, x, &mean, &sd));
    REFUSED(bayesopt_predict_outcome(bo, 1, 1, x, &mean, &sd));
    REFUSED(bayesopt_sensitivity(NULL, 0, 64, x, x));
    REFUSED(bayesopt_sensitivity(bo, 0, 64, NULL, x));
    REFUSED(bayesopt_sensitivity(bo, 0, 64, x, NULL));
    REFUSED(bayesopt_sensitivity(bo, 0, HUGE_COUNT, x, x));
    REFUSED(bayesopt_sensitivity(bo, 1, 64, x, x));
    REFUSED(bayesopt_leave_one_out(NULL, &front, x, x, x));
    REFUSED(bayesopt_leave_one_out(bo, NULL, x, x, x));
    REFUSED(bayesopt_leave_one_out(bo, &front, NULL, x, x));
    REFUSED(bayesopt_leave_one_out(bo, &front, x, NULL, x));
    REFUSED(bayesopt_leave_one_out(bo, &front, x, x, NULL));
    REFUSED(bayesopt_model(NULL, &info, NULL));
    REFUSED(bayesopt_model(bo, NULL, NULL));
    REFUSED(bayesopt_minimise(NULL, objective, NULL, NULL, NULL));
    REFUSED(bayesopt_minimise(bo, NULL, NULL, NULL, NULL));
    CU_ASSERT(bayesopt_predict(bo, 1, x, &mean, NULL) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_best(bo, NULL, NULL, NULL) == BAYESOPT_OK);
    bayesopt_free(bo);
    CU_ASSERT_STRING_EQUAL(bayesopt_phase_name((bayesopt_phase)99), "unknown");
    CU_ASSERT_STRING_EQUAL(bayesopt_state_name((bayesopt_state)99), "unknown");
    CU_ASSERT_STRING_EQUAL(bayesopt_strategy_name((bayesopt_strategy)99), "unknown");
    CU_ASSERT_STRING_EQUAL(bayesopt_kind_name((bayesopt_kind)99), "unknown");
    CU_ASSERT_STRING_EQUAL(bayesopt_design_name((bayesopt_design_kind)99), "unknown");
    CU_ASSERT_STRING_EQUAL(bayesopt_kernel_name((bayesopt_kernel)99), "unknown");
    CU_ASSERT_STRING_EQUAL(bayesopt_transform_name((bayesopt_transform)99), "unknown");
    CU_ASSERT_STRING_EQUAL(bayesopt_status_string((bayesopt_status)99), "unknown status");
    CU_ASSERT(strlen(bayesopt_version()) > 0);
}

static void records(void)
{
    char path[256], *text;
    size_t rows, columns;
    double value = 1, *values;
    bayesopt_table *table;
    const bayesopt_attribute *list, attribute = {.name = "a"};
    bayesopt *bo = NULL;
    snprintf(path, sizeof path, "%s/bayesopt_misuse_%ld.db", check_scratch(), (long)getpid());
    remove(path);
    CU_ASSERT_FATAL(bayesopt_create(D, lower, upper, NULL, &bo) == BAYESOPT_OK);
    CU_ASSERT_FATAL(bayesopt_open_store(bo, path) == BAYESOPT_OK);
    CU_ASSERT(isnan(bayesopt_attribute_number(3, NULL, "a")));
    CU_ASSERT(isnan(bayesopt_attribute_number(1, &attribute, NULL)));
    CU_ASSERT_STRING_EQUAL(bayesopt_attribute_text(3, NULL, "a"), "");
    REFUSED(bayesopt_store_put_text(NULL, "a", "b"));
    REFUSED(bayesopt_store_put_text(bo, NULL, "b"));
    REFUSED(bayesopt_store_put_text(bo, "a", NULL));
    REFUSED(bayesopt_store_get_text(NULL, "a", &text));
    REFUSED(bayesopt_store_get_text(bo, NULL, &text));
    REFUSED(bayesopt_store_get_text(bo, "a", NULL));
    REFUSED(bayesopt_store_put_array(NULL, "a", 1, 1, &value));
    REFUSED(bayesopt_store_put_array(bo, NULL, 1, 1, &value));
    REFUSED(bayesopt_store_put_array(bo, "a", 1, 1, NULL));
    REFUSED(bayesopt_store_put_array(bo, "a", HUGE_COUNT, HUGE_COUNT, &value));
    REFUSED(bayesopt_store_put_array(bo, "a", HUGE_COUNT, 1, &value));
    REFUSED(bayesopt_store_get_array(NULL, "a", &rows, &columns, &values));
    REFUSED(bayesopt_store_get_array(bo, NULL, &rows, &columns, &values));
    REFUSED(bayesopt_store_get_array(bo, "a", NULL, &columns, &values));
    REFUSED(bayesopt_store_get_array(bo, "a", &rows, NULL, &values));
    REFUSED(bayesopt_store_get_array(bo, "a", &rows, &columns, NULL));
    REFUSED(bayesopt_store_put_row(NULL, "t", 0, 1, &attribute));
    REFUSED(bayesopt_store_put_row(bo, NULL, 0, 1, &attribute));
    REFUSED(bayesopt_store_put_row(bo, "t", 0, 1, NULL));
    REFUSED(bayesopt_store_put_row(bo, "t", SIZE_MAX, 1, &attribute));
    REFUSED(bayesopt_store_put_row(bo, "t", 0, HUGE_COUNT, &attribute));
    REFUSED(bayesopt_store_get_table(NULL, "t", &table));
    REFUSED(bayesopt_store_get_table(bo, NULL, &table));
    REFUSED(bayesopt_store_get_table(bo, "t", NULL));
    bayesopt_table_free(NULL);
    CU_ASSERT(bayesopt_table_rows(NULL) == 0);
    CU_ASSERT(bayesopt_table_row(NULL, HUGE_COUNT, &list) == 0 && list == NULL);
    bayesopt_free(bo);
    remove(path);
}

static void regressions(void)
{
    bayesopt_gp *gp = NULL;
    bayesopt_gp_options o;
    bayesopt_gp_info info;
    double x[3 * D] = {0, 0, 1, 1, 0.5, 0}, y[3] = {1, 2, 3}, mean, var, g[D + 2], work[6];
    double scales[D] = {1, -1};
    bayesopt_gp_parameters p = {.lengthscale = scales, .signal = 1};
    bayesopt_gp_options_init(NULL);
    REFUSED(bayesopt_gp_create(D, NULL, NULL));
    REFUSED(bayesopt_gp_create(HUGE_COUNT, NULL, &gp));
    bayesopt_gp_options_init(&o);
    o.starts = HUGE_COUNT;
    REFUSED(bayesopt_gp_create(D, &o, &gp));
    bayesopt_gp_options_init(&o);
    o.evaluations = HUGE_COUNT;
    REFUSED(bayesopt_gp_create(D, &o, &gp));
    bayesopt_gp_free(NULL);
    CU_ASSERT_FATAL(bayesopt_gp_create(D, NULL, &gp) == BAYESOPT_OK);
    REFUSED(bayesopt_gp_fit(NULL));
    REFUSED(bayesopt_gp_fit(gp));
    REFUSED(bayesopt_gp_set_data(NULL, 3, x, y, NULL));
    REFUSED(bayesopt_gp_set_data(gp, 3, NULL, y, NULL));
    REFUSED(bayesopt_gp_set_data(gp, 3, x, NULL, NULL));
    REFUSED(bayesopt_gp_set_data(gp, HUGE_COUNT, x, y, NULL));
    CU_ASSERT(bayesopt_gp_set_data(gp, 3, x, y, NULL) == BAYESOPT_OK);
    REFUSED(bayesopt_gp_get_info(gp, &info));
    REFUSED(bayesopt_gp_predict(gp, 1, x, &mean, &var));
    CU_ASSERT(bayesopt_gp_fit(gp) == BAYESOPT_OK);
    bayesopt_gp_forget(NULL);
    REFUSED(bayesopt_gp_append(NULL, 1, x, y, NULL));
    REFUSED(bayesopt_gp_append(gp, 1, NULL, y, NULL));
    REFUSED(bayesopt_gp_append(gp, 1, x, NULL, NULL));
    REFUSED(bayesopt_gp_append(gp, HUGE_COUNT, x, y, NULL));
    REFUSED(bayesopt_gp_set_parameters(NULL, &p));
    REFUSED(bayesopt_gp_set_parameters(gp, NULL));
    REFUSED(bayesopt_gp_set_parameters(gp, &p));
    p.lengthscale = NULL;
    REFUSED(bayesopt_gp_set_parameters(gp, &p));
    REFUSED(bayesopt_gp_get_parameters(NULL, &p));
    REFUSED(bayesopt_gp_get_parameters(gp, NULL));
    REFUSED(bayesopt_gp_get_info(NULL, &info));
    REFUSED(bayesopt_gp_get_info(gp, NULL));
    REFUSED(bayesopt_gp_predict(NULL, 1, x, &mean, &var));
    REFUSED(bayesopt_gp_predict(gp, 1, NULL, &mean, &var));
    REFUSED(bayesopt_gp_predict(gp, 1, x, NULL, &var));
    REFUSED(bayesopt_gp_predict(gp, HUGE_COUNT, x, &mean, &var));
    REFUSED(bayesopt_gp_predict_gradient(NULL, x, &mean, &var, g, g, work));
    REFUSED(bayesopt_gp_predict_gradient(gp, NULL, &mean, &var, g, g, work));
    REFUSED(bayesopt_gp_predict_gradient(gp, x, NULL, &var, g, g, work));
    REFUSED(bayesopt_gp_predict_gradient(gp, x, &mean, NULL, g, g, work));
    REFUSED(bayesopt_gp_predict_gradient(gp, x, &mean, &var, NULL, g, work));
    REFUSED(bayesopt_gp_predict_gradient(gp, x, &mean, &var, g, NULL, work));
    REFUSED(bayesopt_gp_predict_gradient(gp, x, &mean, &var, g, g, NULL));
    CU_ASSERT(isnan(bayesopt_gp_to_model(NULL, 1)) && isnan(bayesopt_gp_from_model(NULL, 1)));
    REFUSED(bayesopt_gp_log_likelihood(NULL, &mean, NULL));
    REFUSED(bayesopt_gp_log_likelihood(gp, NULL, NULL));
    REFUSED(bayesopt_gp_loo(NULL, x, y));
    REFUSED(bayesopt_gp_loo(gp, NULL, y));
    REFUSED(bayesopt_gp_loo(gp, x, NULL));
    REFUSED(bayesopt_gp_outputs(NULL, y));
    REFUSED(bayesopt_gp_outputs(gp, NULL));
    REFUSED(bayesopt_gp_save(NULL, "x"));
    REFUSED(bayesopt_gp_save(gp, NULL));
    bayesopt_gp_free(gp);
    REFUSED(bayesopt_gp_load(NULL, &gp));
    REFUSED(bayesopt_gp_load("x", NULL));
}

static void designs(void)
{
    double x[4 * D];
    bayesopt_design_quality quality;
    bayesopt_design_options o;
    bayesopt_design_options_init(NULL);
    REFUSED(bayesopt_design(BAYESOPT_DESIGN_LHS, 4, D, NULL, NULL));
    REFUSED(bayesopt_design(BAYESOPT_DESIGN_LHS, HUGE_COUNT, D, NULL, x));
    REFUSED(bayesopt_design(BAYESOPT_DESIGN_LHS, 4, HUGE_COUNT, NULL, x));
    size_t *counts[] = {&o.swaps, &o.n_constraints, &o.n_existing};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        bayesopt_design_options_init(&o);
        o.existing = x;
        *counts[i] = HUGE_COUNT;
        REFUSED(bayesopt_design(BAYESOPT_DESIGN_LHS, 4, D, &o, x));
    }
    REFUSED(bayesopt_design_measure(4, D, NULL, &quality));
    REFUSED(bayesopt_design_measure(4, D, x, NULL));
    REFUSED(bayesopt_design_measure(0, D, x, &quality));
    REFUSED(bayesopt_design_measure(HUGE_COUNT, D, x, &quality));
    REFUSED(bayesopt_design_measure(4, HUGE_COUNT, x, &quality));
}

static void expressions(void)
{
    bayesopt_expression *e = NULL;
    const char *names[2] = {"a", NULL};
    bayesopt_expression_free(NULL);
    REFUSED(bayesopt_expression_create(NULL, 1, names, &e));
    REFUSED(bayesopt_expression_create("a", 1, NULL, &e));
    REFUSED(bayesopt_expression_create("a", 1, names, NULL));
    REFUSED(bayesopt_expression_create("a", 2, names, &e));
    REFUSED(bayesopt_expression_create("a", HUGE_COUNT, names, &e));
    CU_ASSERT(isnan(bayesopt_expression_value(NULL, lower)));
    CU_ASSERT(bayesopt_expression_relation(NULL) == BAYESOPT_RELATION_NONE);
    CU_ASSERT(!bayesopt_expression_uses(NULL, 0));
    CU_ASSERT_FATAL(bayesopt_expression_create("a", 1, names, &e) == BAYESOPT_OK);
    CU_ASSERT(isnan(bayesopt_expression_value(e, NULL)));
    CU_ASSERT(!bayesopt_expression_uses(e, HUGE_COUNT));
    bayesopt_expression_free(e);
}

/* Scalars only; what may be NULL is. */
static void acquisitions(void)
{
    CU_ASSERT(isfinite(bayesopt_log_ei(0, 1, 0, NULL, NULL)));
    CU_ASSERT(isfinite(bayesopt_log_feasibility(0, 1, -1, 1, NULL, NULL)));
    CU_ASSERT(isfinite(bayesopt_log_h(-1e10)) && isfinite(bayesopt_log_h_derivative(-1e10)));
    CU_ASSERT(isfinite(bayesopt_log_cdf(-1e10)) && isfinite(bayesopt_log_cdf_derivative(-1e10)));
    CU_ASSERT(isfinite(bayesopt_log_interval(-1, 1)) && isfinite(bayesopt_ei(0, 1, 0)));
    CU_ASSERT(isfinite(bayesopt_lcb(0, 1, 2)));
}

static const struct check_case cases[] = {
    {"creating", creating},         {"asking and telling", asking_and_telling},
    {"looking", looking},           {"records", records},
    {"regressions", regressions},   {"designs", designs},
    {"acquisitions", acquisitions}, {"expressions", expressions},
};

CHECK_MAIN("bayesopt misuse", cases)
