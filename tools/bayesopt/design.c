/* design: points of a design of experiments and how well they fill the box. */
#include "cli.h"
#include "commands.h"

#include <bayesopt/design.h>

#include <getopt.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: bayesopt design KIND N D [OPTION]...\n"
    "\n"
    "Prints N points in D variables as CSV. KIND: uniform, lhs, annealed-lhs, sobol, stlbo.\n"
    "\n"
    "  --lower LIST, --upper LIST\n"
    "                    box a,b,c (default 0 to 1)\n"
    "  --seed S          default 1\n"
    "  --power P         annealing energy sum 1/dist^P (default 2, Audze-Eglais; 50 near maximin)\n"
    "  -o, --output FILE where (default standard output)\n"
    "  --json            instead of the points, one JSON object with the design's measures\n"
    "  --threads N       accepted; one thread is used\n"
    "  --help\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

struct arguments {
    size_t n, d, seed;
    double power;
    const char *lower, *upper, *output;
    bool json;
    bayesopt_design_kind kind;
};

static bool parse_kind(const char *name, bayesopt_design_kind *kind)
{
    for (int k = BAYESOPT_DESIGN_UNIFORM; k <= BAYESOPT_DESIGN_STLBO; k++)
        if (strcmp(name, bayesopt_design_name((bayesopt_design_kind)k)) == 0) {
            *kind = (bayesopt_design_kind)k;
            return true;
        }
    return false;
}

/* A bound per variable, or the same for all. */
static double *bounds(const char *text, size_t d, double otherwise)
{
    double *values = NULL;
    size_t n = d;
    if (text && (!cli_parse_list(text, &values, &n) || n != d)) {
        cli_fail("bounds '%s': expected %zu numbers a,b,...", text, d);
        free(values);
        return NULL;
    }
    if (!values)
        values = malloc(d * sizeof *values);
    for (size_t j = 0; j < d && values && !text; j++)
        values[j] = otherwise;
    return values;
}

static void print_points(FILE *stream, const struct arguments *a, const double *u,
                         const double *lower, const double *upper)
{
    for (size_t j = 0; j < a->d; j++)
        fprintf(stream, "%sx%zu", j ? "," : "", j + 1);
    fputc('\n', stream);
    for (size_t i = 0; i < a->n; i++)
        for (size_t j = 0; j < a->d; j++)
            fprintf(stream, "%.17g%c", lower[j] + u[i * a->d + j] * (upper[j] - lower[j]),
                    j + 1 < a->d ? ',' : '\n');
}

static int print_measures(const struct arguments *a, const double *u)
{
    bayesopt_design_quality q;
    if (bayesopt_design_measure(a->n, a->d, u, &q))
        return cli_fail("%s", bayesopt_last_error());
    json_t *root =
        json_pack("{s:s, s:I, s:I, s:f, s:f, s:f, s:f, s:f}", "kind", bayesopt_design_name(a->kind),
                  "points", (json_int_t)a->n, "variables", (json_int_t)a->d, "audze_eglais",
                  q.audze_eglais, "phi_p", q.phi_p, "min_distance", q.min_distance, "discrepancy",
                  q.discrepancy, "occupied", q.occupied);
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    putchar('\n');
    json_decref(root);
    return CLI_OK;
}

static int write_design(const struct arguments *a, const double *u)
{
    double *lower = bounds(a->lower, a->d, 0), *upper = lower ? bounds(a->upper, a->d, 1) : NULL;
    struct cli_file file;
    int code = upper ? CLI_OK : CLI_FAILED;
    if (!code && a->output && !cli_file_open(&file, a->output))
        code = cli_fail("%s: cannot be written", a->output);
    if (!code) {
        print_points(a->output ? file.stream : stdout, a, u, lower, upper);
        if (a->output && !cli_file_commit(&file))
            code = cli_fail("%s: cannot be written", a->output);
    }
    free(lower);
    free(upper);
    return code;
}

enum { LOWER = 1000, UPPER, SEED, POWER, JSON, THREADS, HELP };

static int parse(int argc, char **argv, struct arguments *a)
{
    static const struct option options[] = {
        {"lower", required_argument, NULL, LOWER},
        {"upper", required_argument, NULL, UPPER},
        {"seed", required_argument, NULL, SEED},
        {"power", required_argument, NULL, POWER},
        {"output", required_argument, NULL, 'o'},
        {"json", no_argument, NULL, JSON},
        {"threads", required_argument, NULL, THREADS},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    int option;
    while ((option = getopt_long(argc, argv, "o:", options, NULL)) != -1) {
        if (option == LOWER)
            a->lower = optarg;
        else if (option == UPPER)
            a->upper = optarg;
        else if (option == 'o')
            a->output = optarg;
        else if (option == JSON)
            a->json = true;
        else if (option == HELP)
            return -1;
        else if (option == SEED && !cli_parse_size(optarg, &a->seed))
            return cli_usage("--seed '%s' is not a whole number", optarg);
        else if (option == POWER && !cli_parse_double(optarg, &a->power))
            return cli_usage("--power '%s' is not a number", optarg);
        else if (option != THREADS && option != SEED && option != POWER)
            return cli_usage("unknown option or missing value");
    }
    if (argc - optind != 3)
        return cli_usage("expected KIND N D");
    if (!parse_kind(argv[optind], &a->kind))
        return cli_usage("kind '%s', expected uniform, lhs, annealed-lhs, sobol or stlbo",
                         argv[optind]);
    if (!cli_parse_size(argv[optind + 1], &a->n) || !cli_parse_size(argv[optind + 2], &a->d) ||
        !a->n || !a->d || a->n > 1000000 || a->d > 1000)
        return cli_usage("'%s' points in '%s' variables, expected 1 to 1000000 and 1 to 1000",
                         argv[optind + 1], argv[optind + 2]);
    return CLI_OK;
}

int command_design(int argc, char **argv)
{
    struct arguments a = {.seed = 1, .power = 2};
    bayesopt_design_options options;
    int code = parse(argc, argv, &a);
    if (code)
        return code < 0 ? cli_print(help) : code;
    bayesopt_design_options_init(&options);
    options.seed = a.seed;
    options.power = a.power;
    double *u = malloc(a.n * a.d * sizeof *u);
    if (!u)
        return cli_fail("out of memory");
    if (bayesopt_design(a.kind, a.n, a.d, &options, u))
        code = cli_fail("%s", bayesopt_last_error());
    else
        code = a.json ? print_measures(&a, u) : write_design(&a, u);
    free(u);
    return code;
}
