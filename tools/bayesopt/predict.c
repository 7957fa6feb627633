/* predict: what the model of a store expects at points. */
#include "commands.h"
#include "csv.h"
#include "names.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    char *store, *table, *output, *point;
    bool json;
};

static const struct setting ROWS[] = {
    OPTION("STORE", TEXT, store, .required = true, .sentence = "the file that holds the study"),
    OPTION("point", TEXT, point, .sentence = "variables of one point"),
    OPTION("table", TEXT, table,
           .sentence = "CSV file of points ('-': standard input), a column per variable"),
    OPTION("output", TEXT, output, .letter = 'o', .sentence = "file, instead of standard output"),
    OPTION_JSON,
};

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    if (!a->point == !a->table)
        settings_complain(source, "point", "and --table: expected one of them");
}

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage = "usage: bayesopt predict STORE (--point X1,X2,... | --table FILE.csv) [OPTION]...\n"
             "\n"
             "Prints as CSV what the model, fitted to the history, expects of the objective: its\n"
             "median and half the width of its central 68 % interval.\n\n"};

/* Fills n points [n x d], which the caller frees. */
static bool read_points(const struct arguments *a, const struct names *names, size_t *n, double **x)
{
    struct csv csv;
    size_t d = names->d;
    *n = 1;
    *x = NULL;
    if (a->table && !csv_read(a->table, &csv))
        return false;
    *n = a->table ? csv.rows : 1;
    *x = malloc((*n + 1) * d * sizeof **x);
    bool ok = *x || cli_refuse("out of memory");
    ok = ok && (a->point ? names_parse_point(names, "--point", a->point, *x)
                         : csv_points(&csv, names, *x));
    if (a->table)
        csv_free(&csv);
    return ok;
}

static void print(const struct arguments *a, FILE *out, const struct names *names, size_t n,
                  const double *x, const double *mean, const double *sd)
{
    json_t *points = a->json ? json_array() : NULL;
    for (size_t j = 0; j < names->d && !a->json; j++)
        fprintf(out, "%s,", names->variables[j]);
    if (!a->json)
        fputs("mean,sd\n", out);
    for (size_t i = 0; i < n; i++) {
        const double *at = x + i * names->d;
        char buffer[VALUE_SIZE];
        for (size_t j = 0; j < names->d && !a->json; j++)
            fprintf(out, "%s,", names_value(names, j, at[j], buffer));
        if (a->json)
            json_array_append_new(points,
                                  json_pack("{s:o, s:o, s:o}", "x", point_json(names, at), "mean",
                                            number_json(mean[i]), "sd", number_json(sd[i])));
        else
            fprintf(out, "%.17g,%.17g\n", mean[i], sd[i]);
    }
    if (a->json)
        print_json(out, json_pack("{s:o}", "points", points));
}

static bool predict(const struct arguments *a, bayesopt *bo, const struct names *names)
{
    struct output output;
    double *x, *mean = NULL;
    size_t n;
    bool ok = read_points(a, names, &n, &x);
    if (ok && !(mean = malloc((2 * n + 1) * sizeof *mean)))
        ok = cli_refuse("out of memory");
    if (ok && n && bayesopt_predict(bo, n, x, mean, mean + n))
        ok = cli_refuse("%s: %s", a->store, bayesopt_last_error());
    ok = ok && output_open(&output, a->output);
    if (ok) {
        print(a, output.stream, names, n, x, mean, mean + n);
        ok = output_close(&output);
    }
    if (ok && (fflush(stdout) != 0 || ferror(stdout)))
        ok = cli_refuse("standard output: %s", strerror(errno));
    free(x);
    free(mean);
    return ok;
}

int command_predict(int argc, char **argv)
{
    struct arguments a = {0};
    struct names names;
    bayesopt *bo;
    settings_start(&TABLE, &a);
    int code = settings_options(argc, argv, &TABLE, &a, NULL, NULL);
    if (code < 0 && !store_open(a.store, &bo, &names)) {
        code = CLI_FAILED;
    } else if (code < 0) {
        code = predict(&a, bo, &names) ? CLI_OK : CLI_FAILED;
        names_free(&names);
        bayesopt_free(bo);
    }
    settings_free(&TABLE, &a);
    return code;
}
