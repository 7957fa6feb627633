/* tell: results of evaluations, one from the arguments or many from a table. */
#include "cli.h"
#include "commands.h"
#include "names.h"

#include <getopt.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: bayesopt tell STORE ID VALUE [--constraints a,b,...]\n"
    "       bayesopt tell STORE ID --failed REASON\n"
    "       bayesopt tell STORE VALUE --point x1,x2,... [--constraints a,b,...]\n"
    "       bayesopt tell STORE --table FILE.csv\n"
    "\n"
    "Records the result at an asked point, that its evaluation failed, an evaluation made "
    "elsewhere,\n"
    "or a table of results with the columns id and f and one per constraint ('-': standard "
    "input).\n"
    "VALUE is a number; nan and inf count as failures.\n"
    "\n"
    "  --json            one JSON object\n"
    "  --threads N       accepted; telling uses one thread\n"
    "  --help\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

struct arguments {
    const char *constraints, *failed, *point, *table;
    bool json;
    int count;
    char **words; /* after STORE */
};

static bool parse_value(const char *text, double *value)
{
    char *end;
    *value = strtod(text, &end);
    return end != text && *end == '\0';
}

/* The list of an option with the count it must have; NULL text gives NULL numbers. */
static bool numbers(const char *text, size_t n, const char *what, double **out)
{
    size_t count = 0;
    *out = NULL;
    if (!text && n == 0)
        return true;
    if (!text || !cli_parse_list(text, out, &count) || count != n) {
        cli_fail("%s '%s': expected %zu numbers a,b,...", what, text ? text : "", n);
        return false;
    }
    return true;
}

static bool tell_one(bayesopt *bo, const struct names *names, const struct arguments *a)
{
    double value = NAN, *x = NULL, *constraints = NULL;
    size_t id = 0;
    bayesopt_status status;
    if (a->failed) {
        if (!cli_parse_size(a->words[0], &id)) {
            cli_fail("id '%s' is not a whole number", a->words[0]);
            return false;
        }
        status = bayesopt_tell_failed(bo, id, a->failed);
    } else {
        const char *text = a->words[a->count - 1];
        if (!parse_value(text, &value)) {
            cli_fail("value '%s' is not a number", text);
            return false;
        }
        if (!a->point && !cli_parse_size(a->words[0], &id)) {
            cli_fail("id '%s' is not a whole number", a->words[0]);
            return false;
        }
        if (!numbers(a->constraints, names->m, "--constraints", &constraints))
            return false;
        if (a->point && !numbers(a->point, names->d, "--point", &x)) {
            free(constraints);
            return false;
        }
        status = a->point ? bayesopt_tell_point(bo, x, value, constraints)
                          : bayesopt_tell(bo, id, value, constraints);
    }
    free(x);
    free(constraints);
    if (status)
        cli_fail("%s", bayesopt_last_error());
    return !status;
}

static bool tell_table(bayesopt *bo, const struct names *names, const char *path)
{
    struct cli_table table;
    if (!cli_table_read(path, &table))
        return false;
    int id = cli_table_column(&table, "id"), f = cli_table_column(&table, "f");
    double *constraints = malloc((names->m + 1) * sizeof *constraints);
    bool ok = constraints && id >= 0 && f >= 0;
    if (!ok)
        cli_fail("%s: expected the columns id and f", path);
    for (size_t i = 0; i < table.rows && ok; i++) {
        const double *row = table.values + i * table.columns;
        for (size_t k = 0; k < names->m && ok; k++) {
            int column = cli_table_column(&table, names->constraints[k]);
            ok = column >= 0;
            if (ok)
                constraints[k] = row[column];
            else
                cli_fail("%s: expected a column '%s'", path, names->constraints[k]);
        }
        if (ok && bayesopt_tell(bo, (uint64_t)row[id], row[f], names->m ? constraints : NULL)) {
            cli_fail("%s: row %zu: %s", path, i + 1, bayesopt_last_error());
            ok = false;
        }
    }
    free(constraints);
    cli_table_free(&table);
    return ok;
}

enum { CONSTRAINTS = 1000, FAILED, POINT, TABLE, JSON, THREADS, HELP };

static int parse(int argc, char **argv, struct arguments *a)
{
    static const struct option options[] = {
        {"constraints", required_argument, NULL, CONSTRAINTS},
        {"failed", required_argument, NULL, FAILED},
        {"point", required_argument, NULL, POINT},
        {"table", required_argument, NULL, TABLE},
        {"json", no_argument, NULL, JSON},
        {"threads", required_argument, NULL, THREADS},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    int option;
    /* A leading '+' ends options at the first word, so that negative values pass as words; options
     * may follow, hence the loop over what is left. */
    while (optind < argc) {
        if (argv[optind][0] != '-' || strlen(argv[optind]) < 2 || argv[optind][1] != '-') {
            a->words[a->count++] = argv[optind++];
            continue;
        }
        option = getopt_long(argc, argv, "+", options, NULL);
        if (option == CONSTRAINTS)
            a->constraints = optarg;
        else if (option == FAILED)
            a->failed = optarg;
        else if (option == POINT)
            a->point = optarg;
        else if (option == TABLE)
            a->table = optarg;
        else if (option == JSON)
            a->json = true;
        else if (option == HELP)
            return -1;
        else if (option != THREADS)
            return cli_usage("unknown option or missing value");
    }
    int expected = a->table ? 1 : a->failed || a->point ? 2 : 3;
    return a->count == expected ? CLI_OK
                                : cli_usage("%d words, expected %d: STORE and what was evaluated",
                                            a->count, expected);
}

static int tell(const struct arguments *given, const char *store)
{
    bayesopt *bo;
    struct names names;
    if (!store_open_to_write(store, &bo, &names))
        return CLI_FAILED;
    bool ok = given->table ? tell_table(bo, &names, given->table) : tell_one(bo, &names, given);
    if (ok && given->json) {
        json_t *root = json_pack("{s:I}", "evaluations", (json_int_t)bayesopt_count(bo));
        json_dumpf(root, stdout, JSON_INDENT(2));
        json_decref(root);
    }
    names_free(&names);
    bayesopt_free(bo);
    return ok ? CLI_OK : CLI_FAILED;
}

int command_tell(int argc, char **argv)
{
    struct arguments a = {.words = calloc((size_t)argc, sizeof *a.words)};
    if (!a.words)
        return cli_fail("out of memory");
    optind = 1;
    int code = parse(argc, argv, &a);
    if (code < 0) {
        code = cli_print(help);
    } else if (code == CLI_OK) {
        struct arguments rest = a;
        rest.words = a.words + 1;
        rest.count = a.count - 1;
        code = tell(&rest, a.words[0]);
    }
    free(a.words);
    return code;
}
