#include "cli.h"
#include "cli/commands.h"
#include "cli/folder.h"
#include "core/front.h"
#include "core/objective.h"
#include "core/record.h"
#include "core/search.h"
#include "json_result.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

/* Where a run stands, by its record alone. */
struct status {
    struct record record;
    struct origin origin;
    struct config config;
    struct evaluation *list;
    const struct evaluation *best; /* of the list; NULL: nothing is evaluated */
    char *stop;                    /* of the search; NULL: it goes on */
    size_t n, failed, budget, sessions, rows, front;
    double seconds, left; /* of the search; NAN: unknown, or over */
    long holder;          /* process that works on it; 0: none */
};

/* What is left takes as long a design as what is done. */
static double time_left(const struct status *s)
{
    double spent = 0;
    for (size_t i = 0; i < s->n; i++) {
        const struct evaluation *e = &s->list[i];
        const double parts[] = {e->propose_seconds, e->geometry_seconds, e->solve_seconds};
        for (int k = 0; k < 3; k++)
            spent += isnan(parts[k]) ? 0 : parts[k];
    }
    return s->stop || s->n == 0 ? NAN : spent / (double)s->n * (double)(s->budget - s->n);
}

static bool read_figures(struct status *s)
{
    struct verification *rows;
    if (!record_evaluations(&s->record, &s->list, &s->n) ||
        !record_get_text(&s->record, "stop", &s->stop) ||
        !record_verifications(&s->record, &rows, &s->rows) ||
        !record_seconds(&s->record, &s->sessions, &s->seconds))
        return false;
    free(rows);
    if (s->n && !front_best(&s->record, &s->config, s->origin.length, s->n, s->list, &s->best))
        return false;
    if (objectives_count(&s->config) > 1 &&
        bayesopt_pareto(s->record.bo, &s->front, NULL) != BAYESOPT_OK)
        return core_fail("%s", bayesopt_last_error());
    for (size_t i = 0; i < s->n; i++)
        s->failed += s->list[i].failed;
    s->budget = search_budget(&s->config);
    s->left = time_left(s);
    return true;
}

static bool read_status(const char *folder, const char *path, struct status *s)
{
    s->holder = folder_holder(folder);
    if (access(path, F_OK) != 0)
        return cli_refuse("%s: no such file; %s", path,
                          s->holder ? "the run is finding its latent space"
                                    : "is this the folder of a run?");
    return (record_read(path, &s->record, &s->origin) || cli_refuse("%s", core_sentence())) &&
           (config_restore(s->origin.configuration, &s->config) ||
            cli_refuse("%s: the configuration is damaged", path)) &&
           (read_figures(s) || cli_refuse("%s: %s", path, core_sentence()));
}

static const char *state(const struct status *s)
{
    return s->holder ? (s->stop ? "verifying" : "searching")
                     : (s->stop ? "search ended" : "interrupted");
}

static void set_number(json_t *o, const char *key, double value)
{
    json_result_set(o, key, isnan(value) ? json_null() : json_real(value));
}

static bool print_json(const struct status *s)
{
    json_t *o = json_object();
    json_result_set(o, "state", json_string(state(s)));
    json_result_set(o, "process", s->holder ? json_integer(s->holder) : json_null());
    json_result_set(o, "stop", s->stop ? json_string(s->stop) : json_null());
    json_result_set(o, "evaluated", json_integer((json_int_t)s->n));
    json_result_set(o, "budget", json_integer((json_int_t)s->budget));
    json_result_set(o, "failed", json_integer((json_int_t)s->failed));
    set_number(o, "objective_parent", s->n ? s->list[0].objective : NAN);
    set_number(o, "objective_best", s->best ? s->best->objective : NAN);
    if (objectives_count(&s->config) > 1)
        json_result_set(o, "front", json_integer((json_int_t)s->front));
    json_result_set(o, "verified", json_integer((json_int_t)s->rows));
    json_result_set(o, "sessions", json_integer((json_int_t)s->sessions));
    set_number(o, "seconds", s->seconds);
    set_number(o, "seconds_left", s->left);
    return json_result_print(o, JSON_INDENT(2) | JSON_REAL_PRECISION(15)) == CLI_OK;
}

static bool print_text(const struct status *s)
{
    printf("%-16s%s", "state", state(s));
    if (s->holder)
        printf(" (process %ld)", s->holder);
    printf("%s%s\n%-16s%zu of %zu, %zu failed\n", s->stop ? ": " : "", s->stop ? s->stop : "",
           "designs", s->n, s->budget, s->failed);
    char best[40];
    if (s->best) {
        objective_print(&s->config, s->origin.length, s->best->objective, s->list, best,
                        sizeof best);
        printf("%-16s%s, %+.1f %% from the parent's\n", "best", best,
               100 * (s->best->objective / s->list[0].objective - 1));
    }
    if (objectives_count(&s->config) > 1)
        printf("%-16s%zu designs, the above is the nearest to the best of each\n", "Pareto set",
               s->front);
    printf("%-16s%zu rows\n%-16s%.0f s in %zu sessions\n", "verification", s->rows, "time",
           s->seconds, s->sessions);
    if (!isnan(s->left))
        printf("%-16sabout %.0f s for the search\n", "left", s->left);
    return cli_printed() == CLI_OK;
}

int status_command(const struct options *options)
{
    struct status s = {0};
    char *path = folder_join(options->path, "run.db");
    bool ok = (path || cli_refuse("out of memory")) && read_status(options->path, path, &s) &&
              (options->json ? print_json(&s) : print_text(&s));
    free(s.list);
    free(s.stop);
    config_free(&s.config);
    origin_free(&s.origin);
    record_close(&s.record);
    free(path);
    return ok ? CLI_OK : CLI_FAILED;
}
