/* A smooth objective with its minimum inside, and a search for it in the box [-1, 2]^d. */
#ifndef TESTS_BAYESOPT_SEARCH_PROBLEM_H
#define TESTS_BAYESOPT_SEARCH_PROBLEM_H

#include "check.h"

#include <bayesopt/bayesopt.h>

static inline double bowl(size_t d, const double *x)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++)
        sum += (x[j] - 0.3) * (x[j] - 0.3) * (1 + (double)j);
    return sum;
}

static inline bayesopt *make(size_t d, const bayesopt_options *options)
{
    double lower[64], upper[64];
    bayesopt *bo = NULL;
    for (size_t j = 0; j < d; j++) {
        lower[j] = -1;
        upper[j] = 2;
    }
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(d, lower, upper, options, &bo), BAYESOPT_OK);
    return bo;
}

#endif
