/* What evaluating in batches costs: regret after an initial design and 60 proposals, one by one and
 * in batches of 10, medians and quartiles, and how close the points of a batch of 20 lie. Prints a
 * Markdown table, of the eight functions or of those named.
 *
 *     bayesopt_batches [SEEDS] [FUNCTION]...
 */
#include "bayesopt_functions.h"

#include <bayesopt/bayesopt.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PROPOSALS = 60, BATCH = 10, LARGE = 20, MOST_SEEDS = 50, MOST_VARIABLES = 15 };

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bayesopt *start(const struct test_function *f, unsigned seed, size_t proposals)
{
    double lower[MOST_VARIABLES] = {0}, upper[MOST_VARIABLES];
    bayesopt_options options;
    bayesopt *bo = NULL;
    for (size_t j = 0; j < f->d; j++)
        upper[j] = 1;
    bayesopt_options_init(&options);
    options.seed = seed + 1;
    options.initial_n = f->n_init;
    options.max_evaluations = f->n_init + proposals;
    if (bayesopt_create(f->d, lower, upper, &options, &bo))
        fprintf(stderr, "%s: %s\n", f->name, bayesopt_last_error());
    return bo;
}

/* Asks for n points at a time until the budget is spent. */
static double regret(const struct test_function *f, unsigned seed, size_t n)
{
    double x[LARGE * MOST_VARIABLES], best = NAN;
    uint64_t ids[LARGE];
    bayesopt *bo = start(f, seed, PROPOSALS);
    size_t asked = 0;
    while (bo && bayesopt_ask(bo, asked < f->n_init ? 1 : n, x, ids) == BAYESOPT_OK) {
        for (size_t i = 0; i < (asked < f->n_init ? 1 : n) && ids[i]; i++)
            bayesopt_tell(bo, ids[i], f->value(f->d, x + i * f->d), NULL);
        asked = bayesopt_count(bo);
    }
    if (bo)
        bayesopt_best(bo, NULL, &best, NULL);
    bayesopt_free(bo);
    return best - f->minimum;
}

/* Distances of the points of one batch of 20 to their nearest neighbours in it, ascending. */
static void spread(const struct test_function *f, unsigned seed, double nearest[LARGE])
{
    double x[LARGE * MOST_VARIABLES];
    uint64_t ids[LARGE];
    bayesopt *bo = start(f, seed, LARGE);
    for (size_t i = 0; bo && i < f->n_init && bayesopt_ask(bo, 1, x, ids) == BAYESOPT_OK; i++)
        bayesopt_tell(bo, ids[0], f->value(f->d, x), NULL);
    for (size_t i = 0; i < LARGE; i++)
        nearest[i] = NAN;
    if (bo && bayesopt_ask(bo, LARGE, x, ids) == BAYESOPT_OK)
        for (size_t i = 0; i < LARGE; i++) {
            nearest[i] = INFINITY;
            for (size_t k = 0; k < LARGE; k++) {
                double square = 0;
                for (size_t j = 0; j < f->d; j++)
                    square += pow(x[i * f->d + j] - x[k * f->d + j], 2);
                if (k != i)
                    nearest[i] = fmin(nearest[i], sqrt(square));
            }
        }
    bayesopt_free(bo);
    qsort(nearest, LARGE, sizeof *nearest, compare);
}

static double median(double *values, size_t n)
{
    qsort(values, n, sizeof *values, compare);
    return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

static void print_spread(size_t n, double *values)
{
    qsort(values, n, sizeof *values, compare);
    printf(" %.3g [%.2g, %.2g] |", median(values, n), values[n / 4], values[n - 1 - n / 4]);
}

static void measure(const struct test_function *f, size_t seeds)
{
    static double single[MOST_SEEDS], batch[MOST_SEEDS], least[MOST_SEEDS], middle[MOST_SEEDS];
    for (size_t s = 0; s < seeds; s++) {
        double nearest[LARGE];
        single[s] = regret(f, (unsigned)s, 1);
        batch[s] = regret(f, (unsigned)s, BATCH);
        spread(f, (unsigned)s, nearest);
        least[s] = nearest[0];
        middle[s] = nearest[LARGE / 2];
    }
    printf("| %s (%zu, %zu + %d) |", f->name, f->d, f->n_init, PROPOSALS);
    print_spread(seeds, single);
    print_spread(seeds, batch);
    printf(" %.2g | %.2g | %.2g |\n", median(batch, seeds) / median(single, seeds),
           median(least, seeds), median(middle, seeds));
    fflush(stdout);
}

static int wanted(const char *name, int argc, char **argv)
{
    for (int i = 2; i < argc; i++)
        if (strcmp(argv[i], name) == 0)
            return 1;
    return argc <= 2;
}

int main(int argc, char **argv)
{
    size_t seeds = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 5;
    if (!seeds || seeds > MOST_SEEDS)
        return EXIT_FAILURE;
    printf("| function (d, n0 + n) | regret one by one | in batches of 10 | ratio | least distance "
           "in a batch of 20 | median |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < n_test_functions; i++)
        if (wanted(test_functions[i].name, argc, argv))
            measure(&test_functions[i], seeds);
    for (size_t i = 0; i < n_held_out_functions && argc > 2; i++) /* where they are named */
        if (wanted(held_out_functions[i].name, argc, argv))
            measure(&held_out_functions[i], seeds);
    return EXIT_SUCCESS;
}
