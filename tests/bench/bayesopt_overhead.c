/* What a proposal costs: CPU time per ask at d = 15 with a hyper-parameter fit each time, its
 * growth with the data, and the peak memory of the process. */
#include "bayesopt_functions.h"

#include <bayesopt/bayesopt.h>

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

enum { D = 15, PROPOSALS = 10 };

static double seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static void measure(size_t n)
{
    const struct test_function *f = &test_functions[n_test_functions - 1];
    double lower[D] = {0}, upper[D], x[D], first = 0, rest = 0, most = 0;
    bayesopt_options options;
    bayesopt *bo;
    uint64_t id;
    for (size_t j = 0; j < D; j++)
        upper[j] = 1;
    bayesopt_options_init(&options);
    options.initial_n = n;
    options.initial_kind = BAYESOPT_DESIGN_LHS;
    options.max_evaluations = n + PROPOSALS + 1;
    if (bayesopt_create(D, lower, upper, &options, &bo))
        return;
    for (size_t i = 0; i < n + PROPOSALS + 1; i++) {
        double start = seconds();
        if (bayesopt_ask(bo, 1, x, &id))
            break;
        double taken = seconds() - start;
        if (i == n)
            first = taken;
        else if (i > n) {
            rest += taken / PROPOSALS;
            most = taken > most ? taken : most;
        }
        bayesopt_tell(bo, id, f->value(D, x), NULL);
    }
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    printf("| %zu | %.4f | %.4f | %.3f | %.1f |\n", n, rest, most, first,
           (double)usage.ru_maxrss / 1024);
    fflush(stdout);
    bayesopt_free(bo);
}

int main(int argc, char **argv)
{
    printf("| n | CPU s per proposal, warm fit each | slowest | cold fit and first proposal | peak "
           "RSS "
           "MiB |\n|---|---|---|---|---|\n");
    static const size_t sizes[] = {50, 100, 200, 300, 500, 1000, 2000};
    size_t count = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 4;
    for (size_t i = 0; i < count && i < sizeof sizes / sizeof *sizes; i++)
        measure(sizes[i]);
    return EXIT_SUCCESS;
}
