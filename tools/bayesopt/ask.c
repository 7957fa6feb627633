/* ask: the next points of a store, or the first of a new one. */
#include "commands.h"
#include "config.h"

#include <stdlib.h>

struct arguments {
    char *store, *config;
    size_t n, n_lower, n_upper, initial, budget;
    uint64_t seed;
    double *lower, *upper;
    bool reissue, json;
};

static const struct setting ROWS[] = {
    OPTION("STORE", TEXT, store, .required = true, .sentence = "the file that holds the study"),
    OPTION("points", COUNT, n, .letter = 'n', .least = 1, .most = 10000, .otherwise = "1",
           .sentence = "how many"),
    OPTION("reissue", SWITCH, reissue, .sentence = "first those asked before and never told"),
    OPTION("config", FILE, config,
           .sentence = "create the store from this file's variables, constraints and search"),
    OPTION("lower", NUMBERS, lower, .count = offsetof(struct arguments, n_lower),
           .sentence = "create the store for a box, with --upper"),
    OPTION("upper", NUMBERS, upper, .count = offsetof(struct arguments, n_upper),
           .sentence = "the other end of the box"),
    OPTION("seed", SEED, seed, .otherwise = "1", .sentence = "of the new store"),
    OPTION("initial", COUNT, initial, .sentence = "design of the new store; 0: by rule"),
    OPTION("budget", COUNT, budget, .sentence = "evaluations in all of the new store; 0: by rule"),
    OPTION("json", SWITCH, json, .sentence = "one JSON object"),
};

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
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

/* levels is NULL if there is only one. */
static void print_csv(const struct names *names, size_t n, const double *x, const uint64_t *ids,
                      const int *levels)
{
    printf(levels ? "id,level" : "id");
    for (size_t j = 0; j < names->d; j++)
        printf(",%s", names->variables[j]);
    putchar('\n');
    for (size_t i = 0; i < n && ids[i]; i++) {
        printf("%llu", (unsigned long long)ids[i]);
        if (levels)
            printf(",%d", levels[i]);
        for (size_t j = 0; j < names->d; j++)
            printf(",%.17g", x[i * names->d + j]);
        putchar('\n');
    }
}

static void print_points_json(const struct names *names, size_t n, const double *x,
                              const uint64_t *ids, const int *levels)
{
    json_t *points = json_array();
    for (size_t i = 0; i < n && ids[i]; i++) {
        json_t *point = json_pack("{s:I, s:o}", "id", (json_int_t)ids[i], "x",
                                  named_json(names->d, names->variables, x + i * names->d));
        if (levels)
            json_object_set_new(point, "level", json_integer(levels[i]));
        json_array_append_new(points, point);
    }
    print_json(stdout, json_pack("{s:o}", "points", points));
}

static bool ask(const struct arguments *a)
{
    bayesopt *bo;
    struct names names;
    if (!store_open_to_write(a->store, &bo, &names))
        return false;
    double *x = malloc(a->n * names.d * sizeof *x);
    uint64_t *ids = calloc(a->n, sizeof *ids);
    int *levels = calloc(a->n, sizeof *levels);
    bool ok = (x && ids && levels) || cli_refuse("out of memory");
    bayesopt_status status = a->reissue ? bayesopt_reclaim(bo) : BAYESOPT_OK;
    if (ok && !status)
        status = bayesopt_ask_levels(bo, a->n, x, ids, levels);
    if (ok && status > 0)
        ok = cli_refuse("%s: %s", a->store, bayesopt_status_string(status));
    else if (ok && (status || bayesopt_detach(bo)))
        ok = cli_refuse("%s", bayesopt_last_error());
    if (ok)
        (a->json ? print_points_json : print_csv)(&names, a->n, x, ids,
                                                  bayesopt_level_count(bo) > 1 ? levels : NULL);
    free(x);
    free(ids);
    free(levels);
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
        code = (!a.config || create_from_config(&a)) && (!a.lower || create_from_box(&a)) && ask(&a)
                   ? CLI_OK
                   : CLI_FAILED;
    settings_free(&TABLE, &a);
    return code;
}
