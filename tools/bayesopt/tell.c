/* tell: results of evaluations, one from the arguments or many from a table. release: points to be
 * asked again. */
#include "commands.h"
#include "import.h"
#include "names.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    char *store, *failed, *retry, *table, *point;
    const char *heartbeat; /* the id */
    double *constraints;
    size_t n_constraints, n_words;
    bool json, outside;
    char **words; /* after STORE: ID, VALUE */
};

static const struct setting ROWS[] = {
    OPTION("STORE", TEXT, store, .required = true, .sentence = "the file that holds the study"),
    OPTION_JSON, /* these two of all three commands */
    OPTION("constraints", NUMBERS, constraints, .count = offsetof(struct arguments, n_constraints),
           .sentence = "values of the outcome constraints"),
    OPTION("failed", TEXT, failed, .sentence = "the evaluation failed, for this reason"),
    OPTION("retry", TEXT, retry,
           .sentence = "id of a failed point to be asked again, its failure forgotten"),
    OPTION("point", TEXT, point, .sentence = "variables of an evaluation made elsewhere"),
    OPTION("outside", SWITCH, outside,
           .sentence = "it may lie outside of the bounds, where it serves the model alone"),
    OPTION("table", TEXT, table,
           .sentence = "CSV file of results ('-': standard input) with the columns f, one per "
                       "constraint, and id or one per variable or both; also one of 'export'"),
};
static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage =
        "usage: bayesopt tell STORE ID VALUE [--constraints A,B,...]\n"
        "       bayesopt tell STORE ID --failed REASON\n"
        "       bayesopt tell STORE --retry ID\n"
        "       bayesopt tell STORE VALUE --point X1,X2,... [--constraints A,B,...] [--outside]\n"
        "       bayesopt tell STORE --table FILE.csv [--outside]\n"
        "\n"
        "Records the result at an asked point, that its evaluation failed, that a failed one is\n"
        "to be repeated, an evaluation made elsewhere, or a table of results. VALUE is a number;\n"
        "nan and inf count as failures.\n\n"};
static const struct settings RELEASE = {
    2, ROWS,
    .usage = "usage: bayesopt release STORE ID [--json]\n"
             "\n"
             "Gives up a pending point: the next 'bayesopt ask' or 'run' gives it out again,\n"
             "whoever had it.\n\n"};

static const struct settings HEARTBEAT = {
    2, ROWS,
    .usage =
        "usage: bayesopt heartbeat STORE ID [--json]\n"
        "\n"
        "Says that a pending point is still in work: 'bayesopt ask --reissue --stale SECONDS'\n"
        "leaves it alone for so long. 'bayesopt run' says so itself every minute.\n\n"};

static bool parse_value(const char *text, double *value)
{
    char *end;
    *value = strtod(text, &end);
    return (end != text && *end == '\0') || cli_refuse("value '%s' is not a number", text);
}

static bool parse_id(const char *text, size_t *id)
{
    return cli_parse_size(text, id) || cli_refuse("id '%s' is not a whole number", text);
}

static bool counts(size_t n, size_t expected, const char *what)
{
    return n == expected || cli_refuse("%s: %zu numbers, expected %zu", what, n, expected);
}

static bool tell_one(bayesopt *bo, const struct names *names, const struct arguments *a)
{
    double value = NAN;
    size_t id = 0;
    if (!a->point && !parse_id(a->words[0], &id))
        return false;
    if (!a->failed && (!parse_value(a->words[a->n_words - 1], &value) ||
                       !counts(a->n_constraints, names->m, "--constraints")))
        return false;
    const bayesopt_result result = {
        .f = value, .constraints = a->constraints, .outside = a->outside};
    double *x = a->point ? malloc(names->d * sizeof *x) : NULL;
    bool ok = !a->point || (x && names_parse_point(names, "--point", a->point, x));
    bayesopt_status status = !ok         ? BAYESOPT_OK
                             : a->failed ? bayesopt_tell_failed(bo, id, a->failed)
                             : a->point  ? bayesopt_tell_point_result(bo, x, &result, NULL)
                                         : bayesopt_tell_result(bo, id, &result);
    free(x);
    return ok && (!status || cli_refuse("%s", bayesopt_last_error()));
}

static bool release(bayesopt *bo, const char *word)
{
    size_t id;
    return parse_id(word, &id) &&
           (!bayesopt_release(bo, id) || cli_refuse("%s", bayesopt_last_error()));
}

static bool hear(bayesopt *bo, const char *word)
{
    size_t id;
    return parse_id(word, &id) &&
           (!bayesopt_heartbeat(bo, id) || cli_refuse("%s", bayesopt_last_error()));
}

static bool tell(const struct arguments *a)
{
    bayesopt *bo;
    struct names names;
    if (!store_open_to_write(a->store, &bo, &names))
        return false;
    bool ok = a->heartbeat ? hear(bo, a->heartbeat)
              : a->retry   ? release(bo, a->retry)
              : a->table   ? import_table(bo, &names, a->table, a->outside)
                           : tell_one(bo, &names, a);
    if (ok && a->json)
        print_json(stdout, json_pack("{s:I}", "evaluations", (json_int_t)bayesopt_count(bo)));
    names_free(&names);
    bayesopt_free(bo);
    return ok;
}

static int with_words(int argc, char **argv, const struct settings *table,
                      int (*command)(struct arguments *a))
{
    struct arguments a = {.words = calloc((size_t)argc, sizeof *a.words)};
    if (!a.words)
        return cli_fail("out of memory");
    settings_start(&TABLE, &a);
    int code = settings_options(argc, argv, table, &a, &a.n_words, a.words);
    if (code < 0)
        code = command(&a);
    settings_free(&TABLE, &a);
    free(a.words);
    return code;
}

static int run_tell(struct arguments *a)
{
    size_t expected = a->table || a->retry ? 0 : a->failed || a->point ? 1 : 2;
    if (a->n_words != expected)
        return cli_usage("%zu words after STORE, expected %zu: what was evaluated", a->n_words,
                         expected);
    return tell(a) ? CLI_OK : CLI_FAILED;
}

static int run_release(struct arguments *a)
{
    size_t id;
    if (a->n_words != 1 || !cli_parse_size(a->words[0], &id))
        return cli_usage("expected STORE and the id of a point");
    a->retry = strdup(a->words[0]);
    return a->retry && tell(a) ? CLI_OK : CLI_FAILED;
}

static int run_heartbeat(struct arguments *a)
{
    size_t id;
    if (a->n_words != 1 || !cli_parse_size(a->words[0], &id) || !id)
        return cli_usage("expected STORE and the id of a point");
    a->heartbeat = a->words[0];
    return tell(a) ? CLI_OK : CLI_FAILED;
}

int command_heartbeat(int argc, char **argv)
{
    return with_words(argc, argv, &HEARTBEAT, run_heartbeat);
}

int command_tell(int argc, char **argv)
{
    return with_words(argc, argv, &TABLE, run_tell);
}

int command_release(int argc, char **argv)
{
    return with_words(argc, argv, &RELEASE, run_release);
}
