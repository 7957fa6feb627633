/* A study on a store of its own, what the tests of stores share. */
#ifndef TESTS_BAYESOPT_STORE_STUDY_H
#define TESTS_BAYESOPT_STORE_STUDY_H

#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdint.h>
#include <string.h>
#include <unistd.h>

enum { D = 3, N = 30 };

static inline double bowl(const double *x)
{
    double sum = 0;
    for (size_t j = 0; j < D; j++)
        sum += (x[j] - 0.3) * (x[j] - 0.3) * (1 + (double)j);
    return sum;
}

static char path[256];

static inline void fresh_path(const char *name)
{
    snprintf(path, sizeof path, "%s/bayesopt_%s_%ld.db", check_scratch(), name, (long)getpid());
    remove(path);
}

static inline bayesopt *make(const bayesopt_options *given)
{
    const double lower[D] = {0, 0, 0}, upper[D] = {1, 1, 1};
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.max_evaluations = N;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(D, lower, upper, given ? given : &options, &bo),
                          BAYESOPT_OK);
    return bo;
}

static inline bayesopt *open_store(void)
{
    bayesopt *bo = make(NULL);
    bayesopt_status status = bayesopt_open_store(bo, path);
    if (status)
        fprintf(stderr, "%s\n", bayesopt_last_error());
    CU_ASSERT_EQUAL_FATAL(status, BAYESOPT_OK);
    return bo;
}

static inline void run(bayesopt *bo, size_t most)
{
    double x[D];
    uint64_t id;
    while (most-- > 0 && bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(x), NULL), BAYESOPT_OK);
}

static inline void same_history(const bayesopt *a, const bayesopt *b)
{
    bayesopt_point p, q;
    CU_ASSERT_EQUAL_FATAL(bayesopt_count(a), bayesopt_count(b));
    for (size_t i = 0; i < bayesopt_count(a); i++) {
        CU_ASSERT_EQUAL(bayesopt_get(a, i, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_get(b, i, &q), BAYESOPT_OK);
        CU_ASSERT_EQUAL(p.id, q.id);
        CU_ASSERT_EQUAL(p.state, q.state);
        CU_ASSERT_EQUAL(p.phase, q.phase);
        CU_ASSERT_EQUAL(memcmp(p.x, q.x, D * sizeof *p.x), 0);
        CU_ASSERT_EQUAL(memcmp(&p.f, &q.f, sizeof p.f), 0);
    }
}

static inline void expect_text(const bayesopt *bo, const char *name, const char *expected)
{
    char *text;
    CU_ASSERT_EQUAL(bayesopt_store_get_text(bo, name, &text), BAYESOPT_OK);
    CU_ASSERT_PTR_NOT_NULL_FATAL(text);
    CU_ASSERT_STRING_EQUAL(text, expected);
    free(text);
}

#endif
