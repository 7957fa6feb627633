/* ask: the next points of a store, or the first of a new one. */
#include "cli.h"
#include "commands.h"
#include "config.h"
#include "names.h"

#include <getopt.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>

static const char help[] =
    "usage: bayesopt ask STORE [OPTION]...\n"
    "\n"
    "Prints the next points to evaluate as CSV (id, with two levels the level, and variables). "
    "They wait for 'bayesopt tell',\n"
    "which may come from any process, in any order.\n"
    "\n"
    "  -n, --points N    so many points (default 1)\n"
    "  --reissue         first those asked before and never told\n"
    "  --config FILE     create the store from this file's variables, constraints and search\n"
    "  --lower LIST, --upper LIST\n"
    "                    create the store for this box, a,b,c\n"
    "  --seed S --initial N --budget N\n"
    "                    with --lower and --upper: seed, initial design, evaluations in all\n"
    "  --json            one JSON object\n"
    "  --threads N       accepted; asking uses one thread\n"
    "  --help\n"
    "\n"
    "Exit status: 0 success; 1 failure, or nothing left to evaluate; 2 wrong usage.\n";

struct arguments {
    size_t n, seed, initial, budget;
    bool reissue, json;
    const char *config, *lower, *upper;
};

static bool create_from_box(const char *store, const struct arguments *a)
{
    double *lower = NULL, *upper = NULL;
    size_t d, e;
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.seed = a->seed;
    options.initial_n = a->initial;
    options.max_evaluations = a->budget;
    bool ok = cli_parse_list(a->lower, &lower, &d) && cli_parse_list(a->upper, &upper, &e);
    if (!ok || d != e) {
        cli_fail("--lower '%s' and --upper '%s': expected as many numbers in both", a->lower,
                 a->upper);
        ok = false;
    } else if (bayesopt_create(d, lower, upper, &options, &bo) || bayesopt_open_store(bo, store)) {
        cli_fail("%s", bayesopt_last_error());
        ok = false;
    }
    bayesopt_free(bo);
    free(lower);
    free(upper);
    return ok;
}

static bool create_from_config(const char *store, const char *path)
{
    struct config config;
    bayesopt *bo = NULL;
    if (!config_read(path, &config))
        return false;
    bool ok = config_create(&config, store, &bo);
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

static void print_json(const struct names *names, size_t n, const double *x, const uint64_t *ids,
                       const int *levels)
{
    json_t *points = json_array();
    for (size_t i = 0; i < n && ids[i]; i++) {
        json_t *values = json_object();
        for (size_t j = 0; j < names->d; j++)
            json_object_set_new(values, names->variables[j], json_real(x[i * names->d + j]));
        json_t *point = json_pack("{s:I, s:o}", "id", (json_int_t)ids[i], "x", values);
        if (levels)
            json_object_set_new(point, "level", json_integer(levels[i]));
        json_array_append_new(points, point);
    }
    json_t *root = json_pack("{s:o}", "points", points);
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    putchar('\n');
    json_decref(root);
}

static int ask(const char *store, const struct arguments *a)
{
    bayesopt *bo;
    struct names names;
    if (!store_open_to_write(store, &bo, &names))
        return CLI_FAILED;
    double *x = malloc(a->n * names.d * sizeof *x);
    uint64_t *ids = calloc(a->n, sizeof *ids);
    int *levels = calloc(a->n, sizeof *levels);
    int code = CLI_OK;
    bayesopt_status status = a->reissue ? bayesopt_reclaim(bo) : BAYESOPT_OK;
    if (!x || !ids || !levels)
        code = cli_fail("out of memory");
    else if (!status)
        status = bayesopt_ask_levels(bo, a->n, x, ids, levels);
    if (!code && status < 0)
        code = cli_fail("%s", bayesopt_last_error());
    else if (!code && status > 0)
        code = cli_fail("%s: %s", store, bayesopt_status_string(status));
    if (!code && bayesopt_detach(bo))
        code = cli_fail("%s", bayesopt_last_error());
    if (!code)
        (a->json ? print_json : print_csv)(&names, a->n, x, ids,
                                           bayesopt_level_count(bo) > 1 ? levels : NULL);
    free(x);
    free(ids);
    free(levels);
    names_free(&names);
    bayesopt_free(bo);
    return code;
}

enum { CONFIG = 1000, LOWER, UPPER, SEED, INITIAL, BUDGET, REISSUE, JSON, THREADS, HELP };

static int parse(int argc, char **argv, struct arguments *a)
{
    static const struct option options[] = {
        {"points", required_argument, NULL, 'n'},    {"config", required_argument, NULL, CONFIG},
        {"lower", required_argument, NULL, LOWER},   {"upper", required_argument, NULL, UPPER},
        {"seed", required_argument, NULL, SEED},     {"initial", required_argument, NULL, INITIAL},
        {"budget", required_argument, NULL, BUDGET}, {"reissue", no_argument, NULL, REISSUE},
        {"json", no_argument, NULL, JSON},           {"threads", required_argument, NULL, THREADS},
        {"help", no_argument, NULL, HELP},           {NULL, 0, NULL, 0},
    };
    int option;
    size_t threads;
    while ((option = getopt_long(argc, argv, "n:", options, NULL)) != -1) {
        size_t *number = option == 'n'       ? &a->n
                         : option == SEED    ? &a->seed
                         : option == INITIAL ? &a->initial
                         : option == BUDGET  ? &a->budget
                         : option == THREADS ? &threads
                                             : NULL;
        if (number && !cli_parse_size(optarg, number))
            return cli_usage("'%s' is not a whole number", optarg);
        if (option == CONFIG)
            a->config = optarg;
        else if (option == LOWER)
            a->lower = optarg;
        else if (option == UPPER)
            a->upper = optarg;
        else if (option == REISSUE)
            a->reissue = true;
        else if (option == JSON)
            a->json = true;
        else if (option == HELP)
            return -1;
        else if (!number)
            return cli_usage("unknown option or missing value");
    }
    if (a->n < 1 || a->n > 10000)
        return cli_usage("--points %zu, expected 1 to 10000", a->n);
    if ((a->lower != NULL) != (a->upper != NULL))
        return cli_usage("--lower and --upper go together");
    return argc - optind == 1 ? CLI_OK : cli_usage("expected one STORE");
}

int command_ask(int argc, char **argv)
{
    struct arguments a = {.n = 1, .seed = 1};
    int code = parse(argc, argv, &a);
    if (code)
        return code < 0 ? cli_print(help) : code;
    const char *store = argv[optind];
    if (a.config && !create_from_config(store, a.config))
        return CLI_FAILED;
    if (a.lower && !create_from_box(store, &a))
        return CLI_FAILED;
    return ask(store, &a);
}
