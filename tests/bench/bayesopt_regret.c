/* Regret on public test functions beside the figures of other optimisers: one default
 * configuration, the peers' initial designs, seeds and budgets. Prints a Markdown table.
 *
 * usage: bayesopt_regret [SEEDS [FUNCTION...]]   (default 10 seeds up to 6 variables, 5 above) */
#include <bayesopt/bayesopt.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "bayesopt_functions.h"

enum { MOST_VARIABLES = 16, MOST_SEEDS = 1000 };

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* NumPy's default quantile. */
static double quantile(const double *sorted, size_t n, double q)
{
    double position = q * (double)(n - 1);
    size_t i = (size_t)position;
    return i + 1 < n ? sorted[i] + (position - (double)i) * (sorted[i + 1] - sorted[i]) : sorted[i];
}

static double regret(const struct test_function *f, unsigned seed)
{
    double lower[MOST_VARIABLES] = {0}, upper[MOST_VARIABLES], x[MOST_VARIABLES], best = NAN;
    double *initial = malloc(f->n_init * f->d * sizeof *initial);
    bayesopt_options options;
    bayesopt *bo = NULL;
    uint64_t id;
    if (!initial)
        return NAN;
    for (size_t j = 0; j < f->d; j++)
        upper[j] = 1;
    peer_latin_hypercube(seed, f->n_init, f->d, initial);
    bayesopt_options_init(&options);
    options.seed = seed;
    options.initial_n = f->n_init;
    options.initial_x = initial;
    options.max_evaluations = f->n_total;
    bayesopt_status status = bayesopt_create(f->d, lower, upper, &options, &bo);
    while (!status && !(status = bayesopt_ask(bo, 1, x, &id)))
        status = bayesopt_tell(bo, id, f->value(f->d, x), NULL);
    if (status < 0)
        fprintf(stderr, "%s: %s\n", f->name, bayesopt_last_error());
    else
        bayesopt_best(bo, NULL, &best, NULL);
    bayesopt_free(bo);
    free(initial);
    return best - f->minimum;
}

/* Least median of the peers on a function: of Bayesian ones only, or of all kinds. */
static double best_peer(const char *function, int bayesian, char *name, size_t size)
{
    FILE *file = fopen(TEST_DATA_DIR "/bayesopt_peer_regret.csv", "r");
    char line[512], f[64], method[64];
    double best = INFINITY, median;
    while (file && fgets(line, sizeof line, file)) {
        if (sscanf(line, "%63[^,],%*[^,],%*[^,],%*[^,],%63[^,],%*[^,],%*[^,],%lf", f, method,
                   &median) != 3 ||
            strcmp(f, function) != 0 || strncmp(method, "ref_", 4) == 0)
            continue;
        int is_bayesian = strncmp(method, "bayesopt", 8) == 0 || strncmp(method, "limbo", 5) == 0 ||
                          strncmp(method, "sklearn", 7) == 0;
        if ((is_bayesian || !bayesian) && median < best) {
            best = median;
            snprintf(name, size, "%s", method);
        }
    }
    if (file)
        fclose(file);
    return best;
}

static void compare_with_peers(const struct test_function *f, size_t seeds)
{
    static double values[MOST_SEEDS];
    char bayesian[64] = "", any[64] = "";
    clock_t start = clock();
    for (size_t s = 0; s < seeds; s++)
        values[s] = regret(f, (unsigned)s);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    qsort(values, seeds, sizeof *values, compare);
    double peer = best_peer(f->name, 1, bayesian, sizeof bayesian);
    double other = best_peer(f->name, 0, any, sizeof any);
    printf("| %s (%zu, %zu/%zu) | %.3g [%.2g, %.2g] | %zu | %.3g (%s) | %.3g (%s) | %.4f |\n",
           f->name, f->d, f->n_init, f->n_total, quantile(values, seeds, 0.5),
           quantile(values, seeds, 0.25), quantile(values, seeds, 0.75), seeds, peer, bayesian,
           other, any, seconds / (double)(seeds * (f->n_total - f->n_init)));
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
    size_t seeds = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 0;
    if (seeds > MOST_SEEDS)
        return EXIT_FAILURE;
    printf("| function (d, n0/N) | regret, median [quartiles] | seeds | best Bayesian peer | best "
           "of any "
           "kind | CPU s per proposal |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < n_test_functions; i++)
        if (wanted(test_functions[i].name, argc, argv))
            compare_with_peers(&test_functions[i], seeds                      ? seeds
                                                   : test_functions[i].d <= 6 ? 10
                                                                              : 5);
    return EXIT_SUCCESS;
}
