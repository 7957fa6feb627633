/* ask: the next points of a store, or the first of a new one. */
#include "commands.h"
#include "config.h"
#include "json_result.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct arguments {
    char *store, *config;
    size_t n, n_lower, n_upper, initial, budget;
    uint64_t seed;
    bool seed_given, initial_given, budget_given;
    double *lower, *upper;
    double stale;
    bool reissue, json;
};

static const struct setting ROWS[] = {
    OPTION("STORE", TEXT, store, .required = true, .sentence = "the file that holds the study"),
    OPTION("points", COUNT, n, .letter = 'n', .least = 1, .most = 10000, .otherwise = "1",
           .sentence = "how many"),
    OPTION("reissue", SWITCH, reissue, .sentence = "first those asked before and never told"),
    OPTION("stale", NUMBER, stale, .most = INFINITY, .otherwise = "0",
           .sentence = "with --reissue: only those that were last asked so many seconds ago"),
    OPTION("config", FILE, config,
           .sentence = "create the store from this file's variables, constraints and search"),
    OPTION("lower", NUMBERS, lower, .count = offsetof(struct arguments, n_lower),
           .sentence = "create the store for a box, with --upper"),
    OPTION("upper", NUMBERS, upper, .count = offsetof(struct arguments, n_upper),
           .sentence = "the other end of the box"),
    OPTION("seed", COUNT, seed, .otherwise = "1", .given = offsetof(struct arguments, seed_given),
           .sentence = "of the new store"),
    OPTION("initial", COUNT, initial, .given = offsetof(struct arguments, initial_given),
           .sentence = "design of the new store; 0: by rule"),
    OPTION("budget", COUNT, budget, .given = offsetof(struct arguments, budget_given),
           .sentence = "evaluations in all, also of a store that exists; 0: by rule"),
    OPTION_JSON,
};

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    if (a->stale > 0 && !a->reissue)
        settings_complain(source, "stale", "is %g without --reissue", a->stale);
    if (a->n_lower != a->n_upper)
        settings_complain(source, "upper", "has %zu numbers and --lower %zu, expected as many",
                          a->n_upper, a->n_lower);
}

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage = "usage: bayesopt ask STORE [OPTION]...\n"
             "\n"
             "Prints the next points to evaluate as CSV (id, with two levels the level, and\n"
             "variables). They wait for 'bayesopt tell', which may come from any process, in any\n"
             "order. When nothing is left to evaluate the exit status is 1.\n\n"};

static bool create_from_box(const struct arguments *a)
{
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.seed = a->seed;
    options.initial_n = a->initial;
    options.max_evaluations = a->budget;
    bool ok = (!bayesopt_create(a->n_lower, a->lower, a->upper, &options, &bo) &&
               !bayesopt_open_store(bo, a->store)) ||
              cli_refuse("%s", bayesopt_last_error());
    bayesopt_free(bo);
    return ok;
}

static bool create_from_config(const struct arguments *a)
{
    struct config config;
    bayesopt *bo = NULL;
    config_start(&config);
    bool ok = config_read(a->config, &config) && config_create(&config, a->store, &bo);
    bayesopt_free(bo);
    config_free(&config);
    return ok;
}

/* What was given of a store that exists must be what it was made with; its budget may change. */
static bool agrees(const struct arguments *a, bayesopt *bo, const struct names *names)
{
    double *bounds = malloc(2 * names->d * sizeof *bounds);
    if (!bounds)
        return cli_refuse("out of memory");
    bayesopt_dimension(bo, bounds, bounds + names->d);
    bool ok =
        !a->lower || a->n_lower == names->d ||
        cli_refuse("--lower has %zu numbers, %s has %zu variables", a->n_lower, a->store, names->d);
    for (size_t j = 0; j < names->d && a->lower && ok; j++)
        ok = (a->lower[j] == bounds[j] && a->upper[j] == bounds[names->d + j]) ||
             cli_refuse("%s exists, where '%s' goes from %g to %g, not from %g to %g", a->store,
                        names->variables[j], bounds[j], bounds[names->d + j], a->lower[j],
                        a->upper[j]);
    free(bounds);
    if (ok && a->seed_given && a->seed != bayesopt_seed(bo))
        ok = cli_refuse("%s exists and has the seed %llu, not %llu", a->store,
                        (unsigned long long)bayesopt_seed(bo), (unsigned long long)a->seed);
    if (ok && a->initial_given && a->initial && a->initial != bayesopt_initial_count(bo))
        ok = cli_refuse("%s exists and has an initial design of %zu, not %zu", a->store,
                        bayesopt_initial_count(bo), a->initial);
    if (ok && a->budget_given && bayesopt_set_budget(bo, a->budget))
        ok = cli_refuse("%s", bayesopt_last_error());
    return ok;
}

/* Points as they were asked; levels is NULL if there is only one. */
struct points {
    size_t n;
    double *x;
    uint64_t *ids;
    int *levels;
};

static void print_header(const struct names *names, bool levels)
{
    printf(levels ? "id,level" : "id");
    for (size_t j = 0; j < names->d; j++)
        printf(",%s", names->variables[j]);
    putchar('\n');
}

static void print_csv(const struct names *names, const struct points *p)
{
    for (size_t i = 0; i < p->n && p->ids[i]; i++) {
        char buffer[VALUE_SIZE];
        printf("%llu", (unsigned long long)p->ids[i]);
        if (p->levels)
            printf(",%d", p->levels[i]);
        for (size_t j = 0; j < names->d; j++)
            printf(",%s", names_value(names, j, p->x[i * names->d + j], buffer));
        putchar('\n');
    }
}

static void print_points_json(const struct names *names, const struct points *p)
{
    json_t *points = json_array();
    for (size_t i = 0; i < p->n && p->ids[i]; i++) {
        json_t *point = json_pack("{s:I, s:o}", "id", (json_int_t)p->ids[i], "x",
                                  point_json(names, p->x + i * names->d));
        if (p->levels)
            json_result_set(point, "level", json_integer(p->levels[i]));
        json_result_append(points, point);
    }
    print_json(stdout, json_pack("{s:o}", "points", points));
}

static bool written(void)
{
    return cli_printed() == CLI_OK;
}

/* Prints what was asked. Points that nobody can read are to be asked again. */
static bool print_points(const struct arguments *a, bayesopt *bo, const struct names *names,
                         const struct points *p)
{
    (a->json ? print_points_json : print_csv)(names, p);
    if (written())
        return true;
    for (size_t i = 0; i < p->n && p->ids[i]; i++)
        bayesopt_release(bo, p->ids[i]);
    return false;
}

static bool ask(const struct arguments *a, bayesopt *bo, const struct names *names)
{
    bool levels = bayesopt_level_count(bo) > 1;
    struct points p = {a->n, malloc(a->n * names->d * sizeof *p.x), calloc(a->n, sizeof *p.ids),
                       calloc(a->n, sizeof *p.levels)};
    int *all_levels = p.levels;
    bool ok = (p.x && p.ids && p.levels) || cli_refuse("out of memory");
    bayesopt_status status = ok && a->reissue ? bayesopt_reclaim_stale(bo, a->stale) : BAYESOPT_OK;
    if (ok && !status && !a->json) { /* an output that takes nothing costs no point */
        print_header(names, levels);
        ok = written();
    }
    if (ok && !status)
        status = bayesopt_ask_levels(bo, a->n, p.x, p.ids, p.levels);
    p.levels = levels ? all_levels : NULL;
    if (ok && status > 0)
        ok = cli_refuse("%s: %s", a->store, bayesopt_status_string(status));
    else if (ok && (status || bayesopt_detach(bo)))
        ok = cli_refuse("%s", bayesopt_last_error());
    ok = ok && print_points(a, bo, names, &p);
    free(p.x);
    free(p.ids);
    free(all_levels);
    return ok;
}

static bool run(const struct arguments *a)
{
    bayesopt *bo;
    struct names names;
    bool exists = access(a->store, F_OK) == 0;
    if ((a->config && !create_from_config(a)) || (!exists && a->lower && !create_from_box(a)) ||
        !store_open_to_write(a->store, &bo, &names))
        return false;
    bool ok = (!exists || agrees(a, bo, &names)) && ask(a, bo, &names);
    names_free(&names);
    bayesopt_free(bo);
    return ok;
}

int command_ask(int argc, char **argv)
{
    struct arguments a = {0};
    settings_start(&TABLE, &a);
    int code = settings_options(argc, argv, &TABLE, &a, NULL, NULL);
    if (code < 0)
        code = run(&a) ? CLI_OK : CLI_FAILED;
    settings_free(&TABLE, &a);
    return code;
}
