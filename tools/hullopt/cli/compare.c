#include "core/compare.h"

#include "cli.h"
#include "cli/commands.h"
#include "cli/folder.h"
#include "json_result.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *label_of(const struct comparison *c, size_t group)
{
    size_t i = 0;
    while (c->group[i] != group)
        i++;
    return c->course[i].label;
}

static void print_number(double value)
{
    if (isinf(value))
        printf("%8s", "-");
    else
        printf("%8.4g", value);
}

/* Reductions turn the quartiles round. */
static void print_table(const struct comparison *c, double *values)
{
    double q[3];
    printf("best known: %.2f %% less than the original, of %zu runs\n\n", 100 * (1 - c->least),
           c->n);
    printf("%-30s%5s%27s%25s%24s\n%-30s%5s%9s%9s%9s%9s%8s%8s%8s%8s%8s\n", "", "", "reduction, %",
           "evaluations to within", "seconds to within", "method", "runs", "quartile", "median",
           "quartile", "10 %", "5 %", "1 %", "10 %", "5 %", "1 %");
    for (size_t g = 0; g < c->groups; g++) {
        size_t n = comparison_last(c, g, values);
        comparison_quartiles(n, values, q);
        printf("%-30s%5zu%9.2f%9.2f%9.2f ", label_of(c, g), n, 100 * (1 - q[2]), 100 * (1 - q[1]),
               100 * (1 - q[0]));
        for (int seconds = 0; seconds < 2; seconds++)
            for (size_t level = 0; level < COMPARE_LEVELS; level++) {
                comparison_quartiles(comparison_needed(c, g, level, seconds, values), values, q);
                print_number(q[1]);
            }
        printf("\n");
    }
    printf("\nmedians over the runs of a method; -: fewer than half of them came so near\n");
}

static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *numbers(size_t n, const double *values)
{
    json_t *a = json_array();
    for (size_t i = 0; i < n; i++)
        json_array_append_new(a, number(values[i]));
    return a;
}

/* Lower quartile, median, upper quartile. */
static json_t *spread(size_t n, double *values)
{
    double q[3];
    comparison_quartiles(n, values, q);
    return numbers(3, q);
}

static json_t *levels(const struct comparison *c, size_t g, bool seconds, double *values)
{
    json_t *o = json_object();
    char name[16];
    for (size_t level = 0; level < COMPARE_LEVELS; level++) {
        snprintf(name, sizeof name, "%g", COMPARE_LEVEL[level]);
        json_result_set(o, name, spread(comparison_needed(c, g, level, seconds, values), values));
    }
    return o;
}

static json_t *result(const struct comparison *c, double *values)
{
    json_t *o = json_object(), *groups = json_array(), *runs = json_array();
    json_result_set(o, "best_known", json_real(c->least));
    for (size_t g = 0; g < c->groups; g++) {
        json_t *row = json_object();
        json_result_set(row, "method", json_string(label_of(c, g)));
        json_result_set(row, "best", spread(comparison_last(c, g, values), values));
        json_result_set(row, "evaluations", levels(c, g, false, values));
        json_result_set(row, "seconds", levels(c, g, true, values));
        json_array_append_new(groups, row);
    }
    for (size_t i = 0; i < c->n; i++) {
        const struct course *r = &c->course[i];
        json_t *row = json_object();
        json_result_set(row, "group", json_integer((json_int_t)c->group[i]));
        json_result_set(row, "best", numbers(r->n, r->best));
        json_result_set(row, "seconds", numbers(r->n, r->seconds));
        json_array_append_new(runs, row);
    }
    json_result_set(o, "methods", groups);
    json_result_set(o, "runs", runs);
    return o;
}

static bool compare(const struct options *options, size_t n, char *const *paths)
{
    struct comparison c;
    if (!comparison_read(n, paths, &c))
        return cli_refuse("%s", core_sentence());
    double *values = malloc((n + 1) * sizeof *values);
    bool ok = values || cli_refuse("out of memory");
    if (ok && options->json) {
        ok =
            json_result_print(result(&c, values), JSON_COMPACT | JSON_REAL_PRECISION(12)) == CLI_OK;
    } else if (ok) {
        print_table(&c, values);
        ok = cli_printed() == CLI_OK;
    }
    free(values);
    comparison_free(&c);
    return ok;
}

int compare_command(const struct options *options)
{
    size_t n = options->n_folders;
    if (n < 2)
        return cli_usage("%zu folders, expected at least 2", n);
    char **paths = calloc(n, sizeof *paths);
    bool ok = paths || cli_refuse("out of memory");
    for (size_t i = 0; i < n && ok; i++)
        ok = (paths[i] = folder_join(options->folders[i], "run.db")) || cli_refuse("out of memory");
    ok = ok && compare(options, n, paths);
    for (size_t i = 0; paths && i < n; i++)
        free(paths[i]);
    free(paths);
    return ok ? CLI_OK : CLI_FAILED;
}
