/* best, status and export: what a store holds. */
#include "cli.h"
#include "commands.h"
#include "names.h"

#include <getopt.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct arguments {
    bool json;
    const char *output;
};

enum { JSON = 1000, THREADS, HELP };

/* Options of all three; returns -1 when help was asked for. */
static int parse(int argc, char **argv, struct arguments *a)
{
    static const struct option options[] = {
        {"json", no_argument, NULL, JSON},
        {"output", required_argument, NULL, 'o'},
        {"threads", required_argument, NULL, THREADS},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    int option;
    while ((option = getopt_long(argc, argv, "o:", options, NULL)) != -1) {
        if (option == JSON)
            a->json = true;
        else if (option == 'o')
            a->output = optarg;
        else if (option == HELP)
            return -1;
        else if (option != THREADS)
            return cli_usage("unknown option or missing value");
    }
    return argc - optind == 1 ? CLI_OK : cli_usage("expected one STORE");
}

static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *named(size_t n, char **names, const double *values)
{
    json_t *object = json_object();
    for (size_t i = 0; i < n && values; i++)
        json_object_set_new(object, names[i], number(values[i]));
    return object;
}

static json_t *point_json(const struct names *names, const bayesopt_point *p)
{
    return json_pack("{s:I, s:s, s:s, s:i, s:o, s:o, s:o, s:b, s:s}", "id", (json_int_t)p->id,
                     "phase", bayesopt_phase_name(p->phase), "state", bayesopt_state_name(p->state),
                     "level", p->level, "x", named(names->d, names->variables, p->x), "f",
                     number(p->f), "constraints",
                     named(names->m, names->constraints, p->constraints), "feasible", p->feasible,
                     "note", p->note);
}

static void print_json(FILE *stream, json_t *root)
{
    json_dumpf(root, stream, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    fputc('\n', stream);
    json_decref(root);
}

static const char best_help[] =
    "usage: bayesopt best STORE [--json]\n"
    "\n"
    "Prints the best point so far: the least value within the outcome constraints, or the least\n"
    "violation when none is within them.\n"
    "\n"
    "  --json            one JSON object\n"
    "  --threads N       accepted; one thread is used\n"
    "  --help\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

static int print_best(const bayesopt *bo, const struct names *names, bool json)
{
    uint64_t id;
    bayesopt_point point;
    bayesopt_status status = bayesopt_best(bo, NULL, NULL, &id);
    if (status < 0)
        return cli_fail("%s", bayesopt_last_error());
    size_t i = 0;
    while (!bayesopt_get(bo, i, &point) && point.id != id)
        i++;
    if (json) {
        print_json(stdout, point_json(names, &point));
        return CLI_OK;
    }
    printf("f = %.17g (point %llu%s)\n", point.f, (unsigned long long)id,
           status ? ", outside the outcome constraints" : "");
    for (size_t j = 0; j < names->d; j++)
        printf("%s = %.17g\n", names->variables[j], point.x[j]);
    for (size_t k = 0; k < names->m; k++)
        printf("%s = %.17g\n", names->constraints[k], point.constraints[k]);
    return CLI_OK;
}

int command_best(int argc, char **argv)
{
    struct arguments a = {0};
    bayesopt *bo;
    struct names names;
    int code = parse(argc, argv, &a);
    if (code)
        return code < 0 ? cli_print(best_help) : code;
    if (!store_open(argv[optind], &bo, &names))
        return CLI_FAILED;
    code = print_best(bo, &names, a.json);
    names_free(&names);
    bayesopt_free(bo);
    return code;
}

static const char status_help[] = "usage: bayesopt status STORE [--json]\n"
                                  "\n"
                                  "Prints how many points are done, failed and pending, the "
                                  "budget, the best value, and what the\n"
                                  "model of the objective looks like.\n"
                                  "\n"
                                  "  --json            one JSON object\n"
                                  "  --threads N       accepted; one thread is used\n"
                                  "  --help\n"
                                  "\n"
                                  "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

static void count_states(const bayesopt *bo, size_t counts[3])
{
    bayesopt_point p;
    for (size_t i = 0; i < bayesopt_count(bo); i++)
        if (!bayesopt_get(bo, i, &p))
            counts[p.state]++;
}

static json_t *model_json(bayesopt *bo, const struct names *names)
{
    bayesopt_model_info info;
    double *scales = malloc(names->d * sizeof *scales);
    if (!scales || bayesopt_model(bo, &info, scales)) {
        free(scales);
        return json_null();
    }
    json_t *model = json_pack(
        "{s:I, s:b, s:s, s:o, s:o, s:o, s:o, s:o, s:o}", "n", (json_int_t)info.n, "isotropic",
        info.isotropic, "transform", bayesopt_transform_name(info.transform), "log_posterior",
        number(info.log_posterior), "jitter", number(info.jitter), "signal_variance",
        number(info.signal_variance), "noise_variance", number(info.noise_variance), "loo_rms",
        number(info.loo_rms), "trust_length", number(info.trust_length));
    json_object_set_new(model, "lengthscale", named(names->d, names->variables, scales));
    free(scales);
    return model;
}

static int print_status(bayesopt *bo, const struct names *names, bool json)
{
    size_t counts[3] = {0};
    double f = NAN;
    uint64_t id = 0;
    count_states(bo, counts);
    bool known = bayesopt_best(bo, NULL, &f, &id) >= 0;
    json_t *root = json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:o}", "variables",
                             (json_int_t)names->d, "done", (json_int_t)counts[BAYESOPT_STATE_DONE],
                             "failed", (json_int_t)counts[BAYESOPT_STATE_FAILED], "pending",
                             (json_int_t)counts[BAYESOPT_STATE_PENDING], "budget",
                             (json_int_t)bayesopt_budget(bo), "initial",
                             (json_int_t)bayesopt_initial_count(bo), "best", number(f), "model",
                             model_json(bo, names));
    if (json) {
        print_json(stdout, root);
        return CLI_OK;
    }
    printf(
        "%zu done, %zu failed, %zu pending of %zu evaluations (%zu of them the initial design)\n",
        counts[BAYESOPT_STATE_DONE], counts[BAYESOPT_STATE_FAILED], counts[BAYESOPT_STATE_PENDING],
        bayesopt_budget(bo), bayesopt_initial_count(bo));
    if (known)
        printf("best %.17g at point %llu\n", f, (unsigned long long)id);
    const json_t *model = json_object_get(root, "model");
    if (json_is_object(model))
        printf("model: transform %s, leave-one-out error %.3g of the spread, trust region %.3g\n",
               json_string_value(json_object_get(model, "transform")),
               json_number_value(json_object_get(model, "loo_rms")),
               json_number_value(json_object_get(model, "trust_length")));
    json_decref(root);
    return CLI_OK;
}

int command_status(int argc, char **argv)
{
    struct arguments a = {0};
    bayesopt *bo;
    struct names names;
    int code = parse(argc, argv, &a);
    if (code)
        return code < 0 ? cli_print(status_help) : code;
    if (!store_open(argv[optind], &bo, &names))
        return CLI_FAILED;
    code = print_status(bo, &names, a.json);
    names_free(&names);
    bayesopt_free(bo);
    return code;
}

static const char export_help[] = "usage: bayesopt export STORE [--json] [-o FILE]\n"
                                  "\n"
                                  "Writes the history: CSV with one row per point, or JSON.\n"
                                  "\n"
                                  "  -o, --output FILE where (default standard output)\n"
                                  "  --json            one JSON object with the array 'points'\n"
                                  "  --threads N       accepted; one thread is used\n"
                                  "  --help\n"
                                  "\n"
                                  "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

/* A text as a CSV field. */
static void quote(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', stream);
        fputc(*text == '\n' ? ' ' : *text, stream);
    }
    fputc('"', stream);
}

static void export_csv(FILE *stream, const bayesopt *bo, const struct names *names)
{
    bayesopt_point p;
    fprintf(stream, "id,phase,state,level");
    for (size_t j = 0; j < names->d; j++)
        fprintf(stream, ",%s", names->variables[j]);
    fprintf(stream, ",f");
    for (size_t k = 0; k < names->m; k++)
        fprintf(stream, ",%s", names->constraints[k]);
    fprintf(stream, ",feasible,note\n");
    for (size_t i = 0; i < bayesopt_count(bo); i++) {
        if (bayesopt_get(bo, i, &p))
            continue;
        fprintf(stream, "%llu,%s,%s,%d", (unsigned long long)p.id, bayesopt_phase_name(p.phase),
                bayesopt_state_name(p.state), p.level);
        for (size_t j = 0; j < names->d; j++)
            fprintf(stream, ",%.17g", p.x[j]);
        if (p.state == BAYESOPT_STATE_DONE)
            fprintf(stream, ",%.17g", p.f);
        else
            fputc(',', stream);
        for (size_t k = 0; k < names->m; k++)
            if (p.constraints)
                fprintf(stream, ",%.17g", p.constraints[k]);
            else
                fputc(',', stream);
        fprintf(stream, ",%d,", p.feasible);
        quote(stream, p.note);
        fputc('\n', stream);
    }
}

static void export_json(FILE *stream, const bayesopt *bo, const struct names *names)
{
    bayesopt_point p;
    json_t *points = json_array();
    for (size_t i = 0; i < bayesopt_count(bo); i++)
        if (!bayesopt_get(bo, i, &p))
            json_array_append_new(points, point_json(names, &p));
    print_json(stream, json_pack("{s:o}", "points", points));
}

static int export_to(const bayesopt *bo, const struct names *names, const struct arguments *a)
{
    struct cli_file file;
    if (a->output && !cli_file_open(&file, a->output))
        return cli_fail("%s: cannot be written", a->output);
    (a->json ? export_json : export_csv)(a->output ? file.stream : stdout, bo, names);
    if (a->output && !cli_file_commit(&file))
        return cli_fail("%s: cannot be written", a->output);
    return CLI_OK;
}

int command_export(int argc, char **argv)
{
    struct arguments a = {0};
    bayesopt *bo;
    struct names names;
    int code = parse(argc, argv, &a);
    if (code)
        return code < 0 ? cli_print(export_help) : code;
    if (!store_open(argv[optind], &bo, &names))
        return CLI_FAILED;
    code = export_to(bo, &names, &a);
    names_free(&names);
    bayesopt_free(bo);
    return code;
}
