/* best, status and export: what a store holds. */
#include "commands.h"
#include "json_result.h"
#include "names.h"

#include <math.h>
#include <stdlib.h>

enum { STATES = BAYESOPT_STATE_LOST + 1 };

struct arguments {
    char *store, *output;
    bool json;
};

static const struct setting ROWS[] = {
    OPTION("STORE", TEXT, store, .required = true, .sentence = "the file that holds the study"),
    OPTION_JSON,
    OPTION("output", TEXT, output, .letter = 'o', .sentence = "file, instead of standard output"),
};

/* What the three do alike: options, opening, closing. The last row is for those that write a file.
 */
static int look(int argc, char **argv, const char *usage, bool writes,
                bool (*show)(bayesopt *bo, const struct names *names, const struct arguments *a))
{
    const struct settings table = {sizeof ROWS / sizeof *ROWS - !writes, ROWS, .usage = usage};
    struct arguments a = {0};
    struct names names;
    bayesopt *bo;
    settings_start(&table, &a);
    int code = settings_options(argc, argv, &table, &a, NULL, NULL);
    if (code < 0 && !store_open(a.store, &bo, &names)) {
        code = CLI_FAILED;
    } else if (code < 0) {
        code = show(bo, &names, &a) ? CLI_OK : CLI_FAILED;
        names_free(&names);
        bayesopt_free(bo);
    }
    settings_free(&table, &a);
    return code;
}

static json_t *row_json(const struct names *names, const bayesopt_point *p)
{
    json_t *attributes = json_object();
    for (size_t i = 0; i < p->n_attributes; i++) {
        const bayesopt_attribute *a = &p->attributes[i];
        json_result_set(attributes, a->name,
                        a->text ? json_string(a->text) : number_json(a->number));
    }
    return json_pack("{s:I, s:s, s:s, s:i, s:o, s:o, s:o, s:b, s:s, s:o}", "id", (json_int_t)p->id,
                     "phase", bayesopt_phase_name(p->phase), "state", bayesopt_state_name(p->state),
                     "level", p->level, "x", point_json(names, p->x), "f", number_json(p->f),
                     "constraints", named_json(names->m, names->constraints, p->constraints),
                     "feasible", p->feasible, "note", p->note, "attributes", attributes);
}

bool print_file(const char *path, const bayesopt *bo)
{
    return print_json(stdout, json_pack("{s:s, s:I}", "file", path, "evaluations",
                                        (json_int_t)bayesopt_count(bo)));
}

bool print_front(bayesopt *bo, const struct names *names, bool json)
{
    bayesopt_point p;
    size_t n, *rows = malloc((bayesopt_count(bo) + 1) * sizeof *rows);
    if (!rows || bayesopt_pareto(bo, &n, rows)) {
        free(rows);
        return cli_refuse("%s", rows ? bayesopt_last_error() : "out of memory");
    }
    json_t *list = json ? json_array() : NULL;
    if (!json) {
        printf("id");
        for (size_t j = 0; j < names->d; j++)
            printf(",%s", names->variables[j]);
        printf(",f");
        for (size_t k = 0; k < names->m; k++)
            printf(",%s", names->constraints[k]);
        putchar('\n');
    }
    for (size_t i = 0; i < n && !bayesopt_get(bo, rows[i], &p); i++) {
        char buffer[VALUE_SIZE];
        if (json) {
            json_result_append(list, row_json(names, &p));
            continue;
        }
        printf("%llu", (unsigned long long)p.id);
        for (size_t j = 0; j < names->d; j++)
            printf(",%s", names_value(names, j, p.x[j], buffer));
        printf(",%.17g", p.f);
        for (size_t k = 0; k < names->m; k++)
            printf(",%.17g", p.constraints[k]);
        putchar('\n');
    }
    free(rows);
    if (json)
        print_json(stdout, json_pack("{s:I, s:o}", "evaluations", (json_int_t)bayesopt_count(bo),
                                     "front", list));
    return n > 0 || cli_refuse("no evaluation satisfies the outcome constraints");
}

static bool show_best(bayesopt *bo, const struct names *names, const struct arguments *a)
{
    uint64_t id, lucky;
    double f, least;
    bayesopt_point point;
    char buffer[VALUE_SIZE];
    if (bayesopt_objective_count(bo) > 1)
        return print_front(bo, names, a->json);
    bayesopt_status status = bayesopt_best(bo, NULL, &f, &id);
    if (status < 0 || bayesopt_best_told(bo, NULL, &least, &lucky) < 0)
        return cli_refuse("%s", bayesopt_last_error());
    for (size_t i = 0; !bayesopt_get(bo, i, &point) && point.id != id;)
        i++;
    bool noisy = lucky != id || f != point.f;
    if (a->json) {
        json_t *root = row_json(names, &point);
        if (noisy) {
            json_result_set(root, "f", number_json(f));
            json_result_set(root, "told", number_json(point.f));
            json_result_set(
                root, "luckiest",
                json_pack("{s:I, s:o}", "id", (json_int_t)lucky, "f", number_json(least)));
        }
        return print_json(stdout, root);
    }
    printf("f = %.17g (point %llu%s)\n", f, (unsigned long long)id,
           status ? ", outside the outcome constraints" : "");
    if (noisy)
        printf("which is the model's mean; told there: %.17g; least told: %.17g (point %llu)\n",
               point.f, least, (unsigned long long)lucky);
    for (size_t j = 0; j < names->d; j++)
        printf("%s = %s\n", names->variables[j], names_value(names, j, point.x[j], buffer));
    for (size_t k = 0; k < names->m; k++)
        printf("%s = %.17g\n", names->constraints[k], point.constraints[k]);
    return true;
}

int command_best(int argc, char **argv)
{
    return look(
        argc, argv,
        "usage: bayesopt best STORE [OPTION]...\n"
        "\n"
        "Prints the best point so far: the least value within the outcome constraints, or\n"
        "the least violation when none is within them; when the objective is maximised, the\n"
        "greatest. With noise it is the point of\n"
        "least mean, and the least value told stands beside it. Of several objectives it is the\n"
        "Pareto set, as CSV.\n\n",
        false, show_best);
}

static void count_states(const bayesopt *bo, size_t counts[STATES])
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
        "{s:I, s:b, s:s, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "n", (json_int_t)info.n, "isotropic",
        info.isotropic, "transform", bayesopt_transform_name(info.transform), "log_posterior",
        number_json(info.log_posterior), "jitter", number_json(info.jitter), "signal_variance",
        number_json(info.signal_variance), "noise_variance", number_json(info.noise_variance),
        "loo_rms", number_json(info.loo_rms), "trust_length", number_json(info.trust_length),
        "repeat_sd", number_json(info.repeat_sd));
    json_result_set(model, "lengthscale", named_json(names->d, names->variables, scales));
    free(scales);
    return model;
}

/* Who holds the pending points; NULL after a sentence. */
static json_t *holders_json(bayesopt *bo)
{
    json_t *list = json_array();
    bayesopt_point p;
    bayesopt_holder h;
    for (size_t i = 0; !bayesopt_get(bo, i, &p); i++) {
        if (p.state != BAYESOPT_STATE_PENDING)
            continue;
        if (bayesopt_get_holder(bo, p.id, &h)) {
            cli_fail("%s", bayesopt_last_error());
            json_decref(list);
            return NULL;
        }
        json_result_append(list, json_pack("{s:I, s:s, s:I, s:f, s:f, s:b, s:b}", "id",
                                           (json_int_t)p.id, "host", h.host, "process",
                                           (json_int_t)h.process, "asked", h.asked, "heard",
                                           h.heard, "alive", h.alive, "detached", h.detached));
    }
    return list;
}

/* Clocks of several machines agree to less, s. */
static const double FAST_CLOCK = 60;

static void print_holders(const json_t *list)
{
    size_t i;
    const json_t *h;
    json_array_foreach(list, i, h)
    {
        bool detached = json_is_true(json_object_get(h, "detached"));
        const char *host = json_string_value(json_object_get(h, "host"));
        double heard = json_number_value(json_object_get(h, "heard"));
        if (!json_integer_value(json_object_get(h, "process"))) {
            printf("point %lld waits to be asked again\n",
                   (long long)json_integer_value(json_object_get(h, "id")));
            continue;
        }
        printf("point %lld %s%lld%s%s%s, asked %.0f s ago, heard of %.0f s ago\n",
               (long long)json_integer_value(json_object_get(h, "id")),
               detached ? "waits to be told; asked by process " : "is held by process ",
               (long long)json_integer_value(json_object_get(h, "process")),
               host && *host ? " on " : "", host ? host : "",
               detached || json_is_true(json_object_get(h, "alive")) ? "" : " (which is dead)",
               fmax(json_number_value(json_object_get(h, "asked")), 0), fmax(heard, 0));
        if (heard < -FAST_CLOCK)
            printf("point %lld was heard of %.0f s from now: a clock is wrong, and until then "
                   "'ask --reissue --stale' keeps it ('bayesopt release' gives it out)\n",
                   (long long)json_integer_value(json_object_get(h, "id")), -heard);
    }
}

static bool show_status(bayesopt *bo, const struct names *names, const struct arguments *a)
{
    size_t counts[STATES] = {0};
    double f = NAN;
    uint64_t id = 0;
    count_states(bo, counts);
    bool known = bayesopt_best(bo, NULL, &f, &id) >= 0;
    json_t *root = json_pack(
        "{s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:o}", "variables", (json_int_t)names->d, "done",
        (json_int_t)counts[BAYESOPT_STATE_DONE], "failed",
        (json_int_t)counts[BAYESOPT_STATE_FAILED], "lost", (json_int_t)counts[BAYESOPT_STATE_LOST],
        "pending", (json_int_t)counts[BAYESOPT_STATE_PENDING], "budget",
        (json_int_t)bayesopt_budget(bo), "initial", (json_int_t)bayesopt_initial_count(bo), "best",
        number_json(f), "model", model_json(bo, names));
    json_t *holders = holders_json(bo);
    if (!holders) {
        json_decref(root);
        return false;
    }
    json_result_set(root, "holders", holders);
    if (a->json)
        return print_json(stdout, root);
    printf("%zu done, %zu failed, %zu lost, %zu pending of %zu evaluations (%zu of them the "
           "initial design)\n",
           counts[BAYESOPT_STATE_DONE], counts[BAYESOPT_STATE_FAILED], counts[BAYESOPT_STATE_LOST],
           counts[BAYESOPT_STATE_PENDING], bayesopt_budget(bo), bayesopt_initial_count(bo));
    if (known)
        printf("best %.17g at point %llu\n", f, (unsigned long long)id);
    const json_t *model = json_object_get(root, "model");
    if (json_is_object(model))
        printf("model: transform %s, leave-one-out error %.3g of the spread, trust region %.3g\n",
               json_string_value(json_object_get(model, "transform")),
               json_number_value(json_object_get(model, "loo_rms")),
               json_number_value(json_object_get(model, "trust_length")));
    print_holders(json_object_get(root, "holders"));
    json_decref(root);
    return true;
}

int command_status(int argc, char **argv)
{
    return look(argc, argv,
                "usage: bayesopt status STORE [OPTION]...\n"
                "\n"
                "Prints how many points are done, failed and pending, the budget, the best value,\n"
                "what the model of the objective looks like, and who holds the pending points.\n\n",
                false, show_status);
}

/* A text as a CSV field. */
static void quote(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', stream);
        fputc(*text == '\n' || *text == '\r' ? ' ' : *text, stream);
    }
    fputc('"', stream);
}

static void export_csv(FILE *stream, const bayesopt *bo, const struct names *names)
{
    bayesopt_point p;
    char buffer[VALUE_SIZE];
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
            fprintf(stream, ",%s", names_value(names, j, p.x[j], buffer));
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

static bool show_history(bayesopt *bo, const struct names *names, const struct arguments *a)
{
    struct output output;
    bayesopt_point p;
    bool whole = true;
    if (!output_open(&output, a->output))
        return false;
    json_t *points = a->json ? json_array() : NULL;
    for (size_t i = 0; a->json && !bayesopt_get(bo, i, &p); i++)
        json_result_append(points, row_json(names, &p));
    if (a->json)
        whole = print_json(output.stream, json_pack("{s:o}", "points", points));
    else
        export_csv(output.stream, bo, names);
    if (whole)
        return output_close(&output);
    cli_file_abandon(&output.file);
    return false;
}

int command_export(int argc, char **argv)
{
    return look(
        argc, argv,
        "usage: bayesopt export STORE [OPTION]...\n"
        "\n"
        "Writes the history: CSV with one row per point, which 'bayesopt tell --table' reads\n"
        "back, or a JSON object with the array 'points'.\n\n",
        true, show_history);
}
