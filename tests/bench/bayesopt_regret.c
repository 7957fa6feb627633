/* Regret on public test functions beside the figures of other optimisers: one default
 * configuration, the peers' initial designs, seeds and budgets. Prints Markdown tables: the
 * functions for which figures of the peers are known, ten stated before any optimiser was run on
 * them (figures by bayesopt_peers.py), then others, where NLopt's DIRECT_L and BOBYQA (from the
 * best point of the same design) run along.
 *
 * usage: bayesopt_regret [SEEDS [FUNCTION...]]   (default 10 seeds up to 6 variables, 5 above) */
#include "bayesopt_functions.h"

#include <bayesopt/bayesopt.h>

#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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
                          strncmp(method, "sklearn", 7) == 0 ||
                          strncmp(method, "openturns", 9) == 0;
        if ((is_bayesian || !bayesian) && median < best) {
            best = median;
            snprintf(name, size, "%s", method);
        }
    }
    if (file)
        fclose(file);
    return best;
}

struct counted {
    const struct test_function *f;
    double best;
};

static double counted_value(unsigned d, const double *u, double *gradient, void *data)
{
    struct counted *c = data;
    (void)gradient;
    double value = c->f->value(d, u);
    c->best = fmin(c->best, value);
    return value;
}

/* DIRECT_L with the whole budget, or BOBYQA with what the Latin hypercube leaves of it. */
static double peer_regret(const struct test_function *f, nlopt_algorithm algorithm, unsigned seed)
{
    struct counted c = {f, INFINITY};
    double lower[MOST_VARIABLES] = {0}, upper[MOST_VARIABLES], x[MOST_VARIABLES], value;
    size_t budget = f->n_total;
    for (size_t j = 0; j < f->d; j++) {
        upper[j] = 1;
        x[j] = 0.5;
    }
    if (algorithm == NLOPT_LN_BOBYQA) {
        double *initial = malloc(f->n_init * f->d * sizeof *initial);
        if (!initial)
            return NAN;
        peer_latin_hypercube(seed, f->n_init, f->d, initial);
        for (size_t i = 0; i < f->n_init; i++) {
            value = f->value(f->d, initial + i * f->d);
            if (value < c.best) {
                c.best = value;
                memcpy(x, initial + i * f->d, f->d * sizeof *x);
            }
        }
        free(initial);
        budget -= f->n_init;
    }
    nlopt_opt opt = nlopt_create(algorithm, (unsigned)f->d);
    nlopt_set_min_objective(opt, counted_value, &c);
    nlopt_set_lower_bounds(opt, lower);
    nlopt_set_upper_bounds(opt, upper);
    nlopt_set_initial_step1(opt, 0.1);
    nlopt_set_maxeval(opt, (int)budget);
    nlopt_optimize(opt, x, &value);
    nlopt_destroy(opt);
    return c.best - f->minimum;
}

static void compare_on_held_out(const struct test_function *f, size_t seeds)
{
    static double values[MOST_SEEDS], bobyqa[MOST_SEEDS];
    clock_t start = clock();
    for (size_t s = 0; s < seeds; s++)
        values[s] = regret(f, (unsigned)s);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    for (size_t s = 0; s < seeds; s++)
        bobyqa[s] = peer_regret(f, NLOPT_LN_BOBYQA, (unsigned)s);
    double direct = peer_regret(f, NLOPT_GN_DIRECT_L, 0);
    qsort(values, seeds, sizeof *values, compare);
    qsort(bobyqa, seeds, sizeof *bobyqa, compare);
    printf("| %s (%zu, %zu/%zu) | %.3g [%.2g, %.2g] | %zu | %.3g [%.2g, %.2g] | %.3g | %.4f |\n",
           f->name, f->d, f->n_init, f->n_total, quantile(values, seeds, 0.5),
           quantile(values, seeds, 0.25), quantile(values, seeds, 0.75), seeds,
           quantile(bobyqa, seeds, 0.5), quantile(bobyqa, seeds, 0.25),
           quantile(bobyqa, seeds, 0.75), direct,
           seconds / (double)(seeds * (f->n_total - f->n_init)));
    fflush(stdout);
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

static size_t seeds_for(const struct test_function *f, size_t given)
{
    return given ? given : f->d <= 6 ? 10 : 5;
}

static void compare_all(size_t n, const struct test_function *functions, size_t seeds, int argc,
                        char **argv)
{
    printf("| function (d, n0/N) | regret, median [quartiles] | seeds | best Bayesian peer | best "
           "of any kind | CPU s per proposal |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < n; i++)
        if (wanted(functions[i].name, argc, argv))
            compare_with_peers(&functions[i], seeds_for(&functions[i], seeds));
    printf("\n");
}

int main(int argc, char **argv)
{
    size_t seeds = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 0;
    if (seeds > MOST_SEEDS)
        return EXIT_FAILURE;
    compare_all(n_test_functions, test_functions, seeds, argc, argv);
    compare_all(n_stated_functions, stated_functions, seeds, argc, argv);
    printf("| function (d, n0/N) | regret, median [quartiles] | seeds | LHS + BOBYQA | DIRECT_L | "
           "CPU s per proposal |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < n_held_out_functions; i++)
        if (wanted(held_out_functions[i].name, argc, argv))
            compare_on_held_out(&held_out_functions[i], seeds_for(&held_out_functions[i], seeds));
    return EXIT_SUCCESS;
}
