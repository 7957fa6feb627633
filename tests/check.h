/* The few lines every CUnit program of the suite shares: a table of tests, a relative comparison
 * that prints both numbers when it fails, and a main that returns non-zero on any failure. */
#ifndef TESTS_CHECK_H
#define TESTS_CHECK_H

#include <CUnit/Basic.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* |actual - expected| <= tol * max(1, |expected|) would hide errors of small values; the scale is
 * the caller's to choose. NaN fails. */
static inline void check_close(double actual, double expected, double tol, const char *what,
                               const char *file, unsigned line)
{
    int ok = fabs(actual - expected) <= tol;
    if (!ok)
        fprintf(stderr, "%s:%u: %s = %.17g, expected %.17g, difference %.3g > %.3g\n", file, line,
                what, actual, expected, fabs(actual - expected), tol);
    CU_assertImplementation(ok ? CU_TRUE : CU_FALSE, line, what, file, "", CU_FALSE);
}

#define CHECK_CLOSE(actual, expected, tol)                                                         \
    check_close((actual), (expected), (tol), #actual, __FILE__, __LINE__)
#define CHECK_RELATIVE(actual, expected, tol)                                                      \
    check_close((actual), (expected), (tol)*fabs(expected), #actual, __FILE__, __LINE__)

/* Where scratch files go. */
static inline const char *check_scratch(void)
{
    const char *folder = getenv("TMPDIR");
    return folder && *folder ? folder : "/tmp";
}

struct check_case {
    const char *name;
    void (*run)(void);
};

static inline int check_main(const char *suite_name, const struct check_case *cases, size_t n)
{
    if (CU_initialize_registry() != CUE_SUCCESS)
        return EXIT_FAILURE;
    CU_pSuite suite = CU_add_suite(suite_name, NULL, NULL);
    for (size_t i = 0; suite && i < n; i++)
        if (!CU_add_test(suite, cases[i].name, cases[i].run))
            suite = NULL;
    if (!suite) {
        CU_cleanup_registry();
        return EXIT_FAILURE;
    }
    CU_basic_set_mode(CU_BRM_VERBOSE);
    CU_basic_run_tests();
    unsigned failed = CU_get_number_of_failures();
    CU_cleanup_registry();
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

#define CHECK_MAIN(suite_name, cases)                                                              \
    int main(void)                                                                                 \
    {                                                                                              \
        return check_main(suite_name, cases, sizeof(cases) / sizeof((cases)[0]));                  \
    }

#endif
