/* Conditions as texts: values against C's own arithmetic, and what is refused. */
#include "check.h"

#include <bayesopt/expression.h>

#include <stdlib.h>
#include <string.h>

static const char *const names[] = {"a", "b", "L.pp", "e1"};
static const double at[] = {0.7, -2.5, 142, 3};

static double value(const char *text)
{
    bayesopt_expression *e;
    CU_ASSERT_EQUAL_FATAL(bayesopt_expression_create(text, 4, names, &e), BAYESOPT_OK);
    double result = bayesopt_expression_value(e, at);
    bayesopt_expression_free(e);
    return result;
}

static void values(void)
{
    double a = at[0], b = at[1], l = at[2];
    CHECK_CLOSE(value("1 + 2*3 - 8/4/2"), 1 + 2 * 3 - 8.0 / 4 / 2, 0);
    CHECK_CLOSE(value("-2^2"), -4, 0);
    CHECK_CLOSE(value("2^-1"), 0.5, 0);
    CHECK_CLOSE(value("2^3^2"), 512, 0);
    CHECK_CLOSE(value("--a - -b"), a + b, 0);
    CHECK_CLOSE(value("(a+b)*(a-b)"), (a + b) * (a - b), 0);
    CHECK_CLOSE(value("1.5e-3*L.pp"), 1.5e-3 * l, 0);
    CHECK_CLOSE(value(".5*e1"), 1.5, 0);
    CHECK_CLOSE(value("sin(a)^2 + cos(a)^2"), 1, 1e-15);
    CHECK_CLOSE(value("exp(log(a)) + log10(100) + sqrt(4) + abs(b)"), a + 2 + 2 - b, 1e-14);
    CHECK_CLOSE(value("atan(tan(a)) + asin(sin(a)) + acos(cos(a))"), 3 * a, 1e-14);
    CHECK_CLOSE(value("min(a, b, -3) + max(a,b) + floor(b)"), -3 + a - 3, 1e-15);
    CHECK_CLOSE(value("4*atan(1) - pi"), 0, 0);
    CHECK_CLOSE(value("a <= b"), a - b, 0);
    CHECK_CLOSE(value("a + 1 > 2*b"), 2 * b - (a + 1), 0);
    CU_ASSERT(isnan(value("sqrt(b)")) && isnan(value("min(1, sqrt(b))")));
}

static void relations(void)
{
    static const struct {
        const char *text;
        bayesopt_relation relation;
    } all[] = {{"a", BAYESOPT_RELATION_NONE},
               {"a<b", BAYESOPT_RELATION_LEAST},
               {"a >= b", BAYESOPT_RELATION_LEAST},
               {"a == b", BAYESOPT_RELATION_EQUAL}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        bayesopt_expression *e;
        CU_ASSERT_EQUAL_FATAL(bayesopt_expression_create(all[i].text, 4, names, &e), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_expression_relation(e), all[i].relation);
        CU_ASSERT(bayesopt_expression_uses(e, 0) && !bayesopt_expression_uses(e, 2));
        bayesopt_expression_free(e);
    }
}

static void refusals(void)
{
    static const char *const wrong[] = {
        "",       "a +",    "a b",       "(a",     "a)",      "c + 1", "a = b", "a <= b <= 1",
        "sqrt a", "sqrt()", "sqrt(a,b)", "min(a)", "0x10",    "1e999", "2a",    "a ** b",
        "a, b",   "sin",    "a $ b",     "3 4",    "max(a,b", "1..2",  "nan",   "inf"};
    bayesopt_expression *e = NULL;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        bayesopt_status status = bayesopt_expression_create(wrong[i], 4, names, &e);
        if (status != BAYESOPT_ERROR_ARGUMENT)
            fprintf(stderr, "'%s' is taken\n", wrong[i]);
        CU_ASSERT_EQUAL(status, BAYESOPT_ERROR_ARGUMENT);
        CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "expected"));
    }
}

/* However deep or long, an answer comes: a value or a refusal. */
static void bounds(void)
{
    static const char *const pieces[] = {"(", "-(", "2^", "min(1,", "1+(", "a*("};
    char text[6000];
    bayesopt_expression *e;
    for (size_t p = 0; p < sizeof pieces / sizeof *pieces; p++) {
        *text = '\0';
        while (strlen(text) < 4000)
            strcat(text, pieces[p]);
        CU_ASSERT_EQUAL(bayesopt_expression_create(text, 4, names, &e), BAYESOPT_ERROR_ARGUMENT);
    }
    strcpy(text, "1");
    while (strlen(text) < 4000)
        strcat(text, "+1");
    CU_ASSERT_EQUAL_FATAL(bayesopt_expression_create(text, 4, names, &e), BAYESOPT_OK);
    CHECK_CLOSE(bayesopt_expression_value(e, at), (double)(strlen(text) + 1) / 2, 0);
    bayesopt_expression_free(e);
    while (strlen(text) < 5000)
        strcat(text, "+1");
    CU_ASSERT_EQUAL(bayesopt_expression_create(text, 4, names, &e), BAYESOPT_ERROR_ARGUMENT);
}

static const struct check_case cases[] = {
    {"values", values}, {"relations", relations}, {"refusals", refusals}, {"bounds", bounds}};

CHECK_MAIN("bayesopt expression", cases)
