/* What the rows of a verification are taken to mean. */
#include "check.h"
#include "core/verify.h"
#include "report/verdict.h"

#include <string.h>

static struct verification row(enum verification_group group, double before, double after)
{
    struct verification v = {.group = group,
                             .cw_parent = before,
                             .cw_best = after,
                             .cw_pressure_parent = NAN,
                             .cw_pressure_best = NAN};
    return v;
}

static void test_confirmed(void)
{
    const struct verification rows[] = {
        row(GROUP_OBJECTIVE, 1.6e-3, 0.8e-3),   row(GROUP_FORMULATION, 1.9e-3, 1.2e-3),
        row(GROUP_FORMULATION, 1.7e-3, 1.0e-3), row(GROUP_STERN, 1.6e-3, 0.9e-3),
        row(GROUP_RESOLUTION, 1.6e-3, 0.85e-3), row(GROUP_SPEED, 1.0e-3, 0.99e-3),
    };
    struct verdict v;
    verdict_reach(rows, 6, &v);
    CHECK_CLOSE(v.claimed, 0.5, 1e-15);
    CU_ASSERT_EQUAL(v.models, 2); /* another stern is no other model */
    CU_ASSERT_EQUAL(v.confirm, 2);
    CU_ASSERT_TRUE(v.formulations && v.resolution && v.speeds && !v.only_objective);
    CU_ASSERT_TRUE(v.has_sterns && v.sterns);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "2 of 2"));
}

static void test_only_objective(void)
{
    const struct verification rows[] = {
        row(GROUP_OBJECTIVE, 2.6e-3, 0.9e-3),   row(GROUP_FORMULATION, 1.9e-3, 2.0e-3),
        row(GROUP_FORMULATION, 1.6e-3, 1.5e-3), row(GROUP_RESOLUTION, 2.6e-3, 2.0e-3),
        row(GROUP_SPEED, 1.0e-3, 1.2e-3),
    };
    struct verdict v;
    verdict_reach(rows, 5, &v);
    CU_ASSERT_TRUE(v.only_objective);
    CU_ASSERT_FALSE(v.formulations || v.resolution || v.speeds);
    CU_ASSERT_EQUAL(v.deny, 1);
    CU_ASSERT_EQUAL(v.partly, 1);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "Only the model of the search"));
}

/* A run may leave its verification out. */
static void test_nothing_asked(void)
{
    const struct verification rows[] = {row(GROUP_OBJECTIVE, 1.6e-3, 0.8e-3)};
    struct verdict v;
    verdict_reach(rows, 1, &v);
    CU_ASSERT_FALSE(v.formulations || v.only_objective);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "No other formulation was asked"));
}

/* Kochin function and pressure of the same solution contradict each other: that is said. */
static void test_pressure(void)
{
    struct verification rows[] = {row(GROUP_OBJECTIVE, 1.0, 0.5), row(GROUP_FORMULATION, 1.0, 0.6)};
    struct verdict v;
    rows[0].cw_pressure_parent = 1.0;
    rows[0].cw_pressure_best = 1.7;
    verdict_reach(rows, 2, &v);
    CHECK_CLOSE(v.pressure, -0.7, 1e-15);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "+70.0 %"));
    rows[0].cw_pressure_best = 0.6;
    verdict_reach(rows, 2, &v);
    CU_ASSERT_PTR_NULL(strstr(v.statement, "pressure"));
}

static void test_divided(void)
{
    const struct verification rows[] = {
        row(GROUP_OBJECTIVE, 1.0, 0.5),
        row(GROUP_FORMULATION, 1.0, 0.6),
        row(GROUP_FORMULATION, 1.0, 1.1),
    };
    struct verdict v;
    verdict_reach(rows, 3, &v);
    CU_ASSERT_FALSE(v.formulations);
    CU_ASSERT_FALSE(v.only_objective);
    CU_ASSERT_FALSE(v.has_resolution || v.has_speeds);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "disagree"));
}

/* A row without a result is no evidence either way. */
static void test_missing(void)
{
    const struct verification rows[] = {row(GROUP_OBJECTIVE, 1.0, 0.5),
                                        row(GROUP_FORMULATION, 1.0, NAN)};
    struct verdict v;
    verdict_reach(rows, 2, &v);
    CU_ASSERT_EQUAL(v.models, 0);
    CU_ASSERT_FALSE(v.formulations);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "unconfirmed"));
    verdict_reach(rows, 0, &v);
    CU_ASSERT_FALSE(v.formulations || v.only_objective);
}

static void test_filter(void)
{
    struct verification rows[] = {row(GROUP_OBJECTIVE, 1.0e-3, 0.5e-3),
                                  row(GROUP_FORMULATION, 1e-3, 0.6e-3),
                                  row(GROUP_FILTER, 1.0e-3, 0.6e-3)};
    struct verdict v;
    verdict_reach(rows, 3, &v);
    CU_ASSERT(v.has_filter && v.filter);
    CU_ASSERT_PTR_NULL(strstr(v.statement, "filter"));
    rows[2].cw_best = 1.5e-3;
    verdict_reach(rows, 3, &v);
    CU_ASSERT(v.has_filter && !v.filter);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "too full"));
}

/* Of two other sterns one that loses decides. */
static void test_sterns(void)
{
    const struct verification rows[] = {row(GROUP_OBJECTIVE, 1.0, 0.5),
                                        row(GROUP_FORMULATION, 1.0, 0.6),
                                        row(GROUP_STERN, 1.0, 0.8), row(GROUP_STERN, 1.0, 0.5)};
    struct verdict v;
    verdict_reach(rows, 4, &v);
    CU_ASSERT_TRUE(v.has_sterns && !v.sterns && v.formulations);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "another length"));
}

static void test_no_gain(void)
{
    const struct verification rows[] = {row(GROUP_OBJECTIVE, 1.0, 1.0),
                                        row(GROUP_FORMULATION, 1.0, 1.0)};
    struct verdict v;
    verdict_reach(rows, 2, &v);
    CU_ASSERT_FALSE(v.formulations || v.only_objective);
    CU_ASSERT_PTR_NOT_NULL(strstr(v.statement, "no hull of less wave resistance"));
}

static void test_plan(void)
{
    struct config config = {.verify_refine = 2};
    struct problem problem = {.config = &config, .speeds = 2};
    igabem_options *frozen = &problem.solver, options[VERIFY_MOST];
    struct verification rows[VERIFY_MOST];
    igabem_options_init(frozen);
    frozen->froude = 0.35;
    frozen->refine = 1;
    frozen->formulation = IGABEM_FORMULATION_NEUMANN_KELVIN_STERN;
    frozen->stern_length = 0.35;
    frozen->cutoff_angle = 5.0;
    frozen->stem_limit = 0.35;
    problem.speed[0] = problem.speed[1] = *frozen;
    problem.speed[0].froude = 0.28;
    problem.speed[0].stern_length = 0.224; /* by the rule at that speed */
    problem.speed[1].froude = 0.41;
    size_t n = verify_plan(&problem, rows, options);
    CU_ASSERT_EQUAL(n, 1 + 6 + 2 + 1 + 1 + 2 * 3);
    CU_ASSERT_EQUAL(rows[0].group, GROUP_OBJECTIVE);
    for (size_t i = 1; i < n; i++) {
        int speed = options[i].froude != frozen->froude;
        int changed = (!speed && options[i].formulation != frozen->formulation) +
                      (!speed && options[i].stern_length != frozen->stern_length) +
                      (options[i].refine != frozen->refine) + speed +
                      (isnan(options[i].cutoff_angle) && isnan(options[i].stem_limit));
        CU_ASSERT_EQUAL(changed, 1);
        CU_ASSERT_EQUAL(options[i].froude, rows[i].froude);
        CU_ASSERT_EQUAL(options[i].refine, rows[i].refine);
    }
    CU_ASSERT_EQUAL(options[n - 6].stern_length, 0.224);
    CU_ASSERT_EQUAL(rows[n - 6].stern_length, 0.224);
    /* Those with water outside of the hull only, at every speed. */
    CU_ASSERT_EQUAL(options[n - 5].formulation, IGABEM_FORMULATION_EXTERIOR);
    CU_ASSERT_EQUAL(options[n - 2].formulation, IGABEM_FORMULATION_EXTERIOR);
    CU_ASSERT_EQUAL(options[n - 1].formulation, IGABEM_FORMULATION_DOUBLE_MODEL);
    CU_ASSERT_EQUAL(options[n - 1].froude, 0.41);
    /* Spans of its own make a ladder of three meshes, a free surface included. */
    frozen->elements_u = 30;
    frozen->elements_v = 9;
    frozen->refine_v = 1; /* as igabem_options_freeze() leaves it */
    frozen->surface_cells = 48;
    problem.speeds = 0;
    n = verify_plan(&problem, rows, options);
    CU_ASSERT_EQUAL(n, 1 + 6 + 2 + 2 + 1);
    for (size_t i = 0; i < n; i++) {
        long thirds = rows[i].group == GROUP_COARSER      ? 2
                      : rows[i].group == GROUP_RESOLUTION ? 6
                                                          : 3;
        CU_ASSERT_EQUAL(options[i].elements_u * options[i].refine, 10 * thirds);
        CU_ASSERT_EQUAL(options[i].elements_v * options[i].refine_v, 3 * thirds);
        CU_ASSERT_EQUAL(options[i].surface_cells, 16.0 * (double)thirds);
    }
    problem.speeds = 2;
    frozen->elements_u = frozen->elements_v = -1;
    frozen->formulation = IGABEM_FORMULATION_NEUMANN_KELVIN;
    config.verify_refine = 1;
    problem.speeds = 0;
    CU_ASSERT_EQUAL(verify_plan(&problem, rows, options), 1 + 6 + 1);
    frozen->cutoff_angle = INFINITY; /* submerged: no filter to choose */
    CU_ASSERT_EQUAL(verify_plan(&problem, rows, options), 1 + 6);
}

static const struct check_case cases[] = {
    {"nothing else asked", test_nothing_asked},
    {"all models agree", test_confirmed},
    {"only the objective sees the gain", test_only_objective},
    {"pressure contradicts", test_pressure},
    {"models disagree", test_divided},
    {"missing results", test_missing},
    {"filter of its own", test_filter},
    {"other sterns", test_sterns},
    {"no gain at all", test_no_gain},
    {"what is verified", test_plan},
};

CHECK_MAIN("hullopt verdict", cases)
