/* run: minimise the result of an external command, several at a time. */
#include "commands.h"
#include "evaluate.h"
#include "launcher.h"
#include "text.h"

#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t interrupted;

static void interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

/* Equal failures in a row. */
struct streak {
    enum outcome_kind kind;
    int code;
    size_t n;
    uint64_t *ids; /* [stop_after] */
};

struct runner {
    struct config config;
    bayesopt *bo;
    struct evaluation *slots;           /* [workers] */
    double *x, *constraints, *gradient; /* [workers x d], [m], [d] */
    struct umbridge model;              /* when the file has an objective.url */
    struct cli_progress progress;
    struct streak streak;
    long rank;            /* among the processes of a launcher; -1: there is none */
    size_t told;          /* in this session */
    double heard;         /* when it last gave a sign of life */
    bool works;           /* some evaluation of the study has succeeded */
    bayesopt_status stop; /* positive: nothing more to ask */
};

static bool library_failed(void)
{
    return cli_refuse("%s", bayesopt_last_error());
}

static const struct umbridge *model_of(const struct runner *r)
{
    return r->config.url ? &r->model : NULL;
}

/* Lines for a log, where a terminal has its progress line: start, every tenth evaluation, every
 * failure, end. */
__attribute__((format(printf, 1, 2))) static void log_line(const char *format, ...)
{
    va_list arguments;
    if (isatty(STDERR_FILENO))
        return;
    fprintf(stderr, "%s: ", cli_name());
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

static void log_standing(const struct runner *r, const char *what)
{
    double f;
    uint64_t id;
    size_t points = bayesopt_count(r->bo), budget = bayesopt_budget(r->bo), front;
    if (bayesopt_objective_count(r->bo) > 1 && !bayesopt_pareto(r->bo, &front, NULL))
        log_line("%s: %zu of %zu points asked, %zu in the Pareto set", what, points, budget, front);
    else if (bayesopt_best_told(r->bo, NULL, &f, &id) >= 0)
        log_line("%s: %zu of %zu points asked, best %.6g at point %llu", what, points, budget, f,
                 (unsigned long long)id);
    else
        log_line("%s: %zu of %zu points asked, none succeeded yet", what, points, budget);
}

static bool runner_start(struct runner *r, struct evaluation *slot)
{
    slot->attempt = 1;
    bayesopt_status status = bayesopt_ask_levels(r->bo, 1, slot->x, &slot->id, &slot->level);
    if (status > 0) {
        r->stop = status;
        return true;
    }
    return status ? library_failed() : evaluation_start(&r->config, model_of(r), slot);
}

/* Whether a failure tells of the program or the machine rather than of the point: the shell has not
 * found or not started it, the file calls it transient, or nothing has ever succeeded. */
static bool is_suspicious(const struct runner *r, const struct outcome *o)
{
    bool not_started = o->kind == OUTCOME_STATUS && (o->code == 126 || o->code == 127);
    return o->transient || not_started || !r->works;
}

/* Counts equal failures. When there are too many they become points to be asked again, which gives
 * their share of the budget back. */
static bool watch(struct runner *r, const struct evaluation *slot, const struct outcome *o)
{
    struct streak *s = &r->streak;
    r->works = r->works || o->kind == OUTCOME_DONE;
    if (o->kind == OUTCOME_DONE || !is_suspicious(r, o)) {
        s->n = 0;
        return true;
    }
    if (s->n && (s->kind != o->kind || s->code != o->code))
        s->n = 0;
    s->kind = o->kind;
    s->code = o->code;
    if (r->config.stop_after)
        s->ids[s->n++] = slot->id;
    if (!s->n || s->n < r->config.stop_after)
        return true;
    for (size_t i = 0; i < s->n; i++)
        if (bayesopt_release(r->bo, s->ids[i]))
            return library_failed();
    return cli_refuse("%zu evaluations in a row failed alike, the last of them in %s: %s; they are "
                      "given back, run again to go on (objective.stop_after)",
                      s->n, slot->folder, o->reason);
}

static bool tell(struct runner *r, const struct evaluation *slot, const struct outcome *o)
{
    bool done = o->kind == OUTCOME_DONE;
    bool has_gradient =
        r->config.gradient || (r->config.url && r->config.use_gradient && r->model.has_gradient);
    const bayesopt_attribute attributes[] = {
        {.name = "folder", .text = slot->folder},
        {.name = "attempts", .number = (double)slot->attempt},
    };
    const bayesopt_result result = {
        .f = done ? o->f : (double)NAN,
        .constraints = done && r->config.names.m ? o->constraints : NULL,
        .gradient = done && has_gradient ? o->gradient : NULL,
        .note = done ? NULL : o->reason,
        .transient = o->transient,
        .n_attributes = 2,
        .attributes = attributes,
    };
    return !bayesopt_tell_result(r->bo, slot->id, &result) || library_failed();
}

static bool runner_finish(struct runner *r, struct evaluation *slot, int status)
{
    struct outcome o = {.constraints = r->constraints, .gradient = r->gradient};
    const struct config *c = &r->config;
    slot->process = 0;
    if (!evaluation_read(c, model_of(r), slot, status, &o))
        return false;
    bool again = o.kind != OUTCOME_DONE && (o.transient || !config_knows_transient(c));
    if (again && slot->attempt <= c->retries && !interrupted) {
        slot->attempt++;
        return evaluation_start(c, model_of(r), slot);
    }
    if (o.kind != OUTCOME_DONE)
        log_line("point %llu %s: %s", (unsigned long long)slot->id,
                 o.transient ? "is lost" : "failed", o.reason);
    if (!tell(r, slot, &o) || !watch(r, slot, &o))
        return false;
    if (++r->told % 10 == 0)
        log_standing(r, "running");
    char detail[64] = "";
    double f;
    if (bayesopt_best_told(r->bo, NULL, &f, NULL) >= 0)
        snprintf(detail, sizeof detail, "best %.6g", f);
    if (r->progress.is_terminal) /* else log_standing() */
        cli_progress_update(&r->progress,
                            (double)bayesopt_count(r->bo) / (double)bayesopt_budget(r->bo), detail);
    return true;
}

/* Others see that the points in work are in good hands; seconds between the signs. */
enum { SIGN_PERIOD = 60 };

static bool give_sign(struct runner *r)
{
    double now = cli_seconds();
    if (now - r->heard < SIGN_PERIOD)
        return true;
    r->heard = now;
    return !bayesopt_heartbeat(r->bo, 0) || library_failed();
}

/* Starts what can be started and takes in what has finished; false on an error. */
static bool turn(struct runner *r, size_t *busy)
{
    *busy = 0;
    for (size_t i = 0; i < r->config.workers; i++) {
        struct evaluation *slot = &r->slots[i];
        int status;
        if (!slot->process && !r->stop && !interrupted && !runner_start(r, slot))
            return false;
        if (!slot->process)
            continue;
        evaluation_check_time(&r->config, slot);
        pid_t done = waitpid(slot->process, &status, WNOHANG);
        if (done == slot->process && !interrupted && !runner_finish(r, slot, status))
            return false;
        if (done == slot->process && interrupted)
            slot->process = 0;
        *busy += slot->process != 0;
    }
    return true;
}

static void kill_all(struct runner *r)
{
    for (size_t i = 0; i < r->config.workers; i++)
        if (r->slots[i].process) {
            kill(-r->slots[i].process, SIGKILL);
            waitpid(r->slots[i].process, NULL, 0);
            r->slots[i].process = 0;
        }
}

static bool work(struct runner *r)
{
    const struct timespec pause = {0, 5000000};
    size_t busy = 0;
    bool ok = true;
    r->heard = cli_seconds();
    log_standing(r, "start");
    cli_progress_start(&r->progress, "evaluations");
    while (ok && !interrupted && (!r->stop || busy)) {
        ok = turn(r, &busy) && give_sign(r);
        if (ok && busy)
            nanosleep(&pause, NULL);
    }
    cli_progress_end(&r->progress);
    kill_all(r);
    log_standing(r, r->stop ? bayesopt_status_string(r->stop) : "stopped");
    if (interrupted)
        cli_fail("interrupted; run again to continue");
    return ok && !interrupted;
}

/* Says why there is nothing to report. */
static bool refuse_without_success(const bayesopt *bo)
{
    bayesopt_point p;
    for (size_t i = bayesopt_count(bo); i-- > 0;)
        if (!bayesopt_get(bo, i, &p) && *p.note)
            return cli_refuse("no evaluation succeeded; the last failed, in %s: %s",
                              bayesopt_attribute_text(p.n_attributes, p.attributes, "folder"),
                              p.note);
    return cli_refuse("no evaluation succeeded");
}

static bool report(const struct runner *r)
{
    const struct names *names = &r->config.names;
    if (bayesopt_objective_count(r->bo) > 1 && bayesopt_best_told(r->bo, NULL, NULL, NULL) >= 0)
        return print_front(r->bo, names, r->config.json);
    double f = NAN, *x = malloc(names->d * sizeof *x);
    uint64_t id = 0;
    char buffer[VALUE_SIZE];
    if (!x)
        return cli_refuse("out of memory");
    bayesopt_status status = bayesopt_best(r->bo, x, &f, &id);
    bool ok = status >= 0 || refuse_without_success(r->bo);
    if (ok && r->config.json) {
        print_json(stdout, json_pack("{s:I, s:s, s:I, s:b, s:o, s:o}", "evaluations",
                                     (json_int_t)bayesopt_count(r->bo), "stop",
                                     bayesopt_status_string(r->stop), "id", (json_int_t)id,
                                     "feasible", status == BAYESOPT_OK, "f", number_json(f), "x",
                                     point_json(names, x)));
    } else if (ok) {
        for (size_t j = 0; j < names->d; j++)
            printf("%s = %s\n", names->variables[j], names_value(names, j, x[j], buffer));
        printf("f = %.17g (point %llu%s)\n", f, (unsigned long long)id,
               status ? ", outside the outcome constraints" : "");
    }
    free(x);
    return ok;
}

/* Whether another process holds a point of the store and has given a sign of life of late, which is
 * all that is known of processes on other hosts. */
static bool others_work(struct runner *r)
{
    static const double of_late = 5 * SIGN_PERIOD;
    bayesopt_point p;
    bayesopt_holder holder;
    if (bayesopt_refresh(r->bo))
        return false;
    for (size_t i = 0; !bayesopt_get(r->bo, i, &p); i++)
        if (p.state == BAYESOPT_STATE_PENDING && !bayesopt_get_holder(r->bo, p.id, &holder) &&
            holder.alive && !holder.detached && holder.heard < of_late &&
            holder.process != getpid())
            return true;
    return false;
}

/* A budget spent on failures that say nothing of their points is no finished study. */
static void tell_of_lost(const struct runner *r)
{
    size_t lost = 0;
    uint64_t last = 0;
    bayesopt_point p;
    for (size_t i = 0; !bayesopt_get(r->bo, i, &p); i++)
        if (p.state == BAYESOPT_STATE_LOST) {
            lost++;
            last = p.id;
        }
    if (lost)
        cli_fail("%zu points are lost to failures of the moment, the last of them is %llu; "
                 "'bayesopt tell STORE --retry %llu' has it asked again",
                 lost, (unsigned long long)last, (unsigned long long)last);
}

/* Ranks share the store and the work; the first of them waits for the others and reports. */
static bool conclude(struct runner *r)
{
    const struct timespec pause = {0, 100000000};
    if (r->rank > 0)
        return true;
    while (r->rank == 0 && !interrupted && others_work(r))
        nanosleep(&pause, NULL);
    tell_of_lost(r);
    return report(r);
}

static bool open_model(struct runner *r)
{
    const struct config *c = &r->config;
    size_t most = c->output;
    for (size_t k = 0; k < c->names.m; k++)
        most = config_output(c, k) > most ? config_output(c, k) : most;
    json_t *config = c->model_config ? json_loads(c->model_config, 0, NULL) : NULL;
    char sentence[UMBRIDGE_SENTENCE];
    if (!umbridge_open(&r->model, c->url, c->model, config, c->names.d, most, sentence))
        return cli_refuse("%s", sentence);
    log_line("%s at %s %s", c->model, c->url,
             !r->model.has_gradient ? "has no derivatives"
             : c->use_gradient      ? "has derivatives, which are used"
                                    : "has derivatives, which are not used");
    return true;
}

static bool run(struct runner *r, const char *store)
{
    size_t d = r->config.names.d, workers = r->config.workers;
    struct sigaction action = {.sa_handler = interrupt};
    r->slots = calloc(workers, sizeof *r->slots);
    r->x = malloc((workers * d + r->config.names.m + d) * sizeof *r->x);
    r->streak.ids = calloc(r->config.stop_after + 1, sizeof *r->streak.ids);
    if (!r->slots || !r->x || !r->streak.ids || !store)
        return cli_refuse("out of memory");
    r->constraints = r->x + workers * d;
    r->gradient = r->constraints + r->config.names.m;
    for (size_t i = 0; i < workers; i++)
        r->slots[i].x = r->x + i * d;
    if (r->config.url && !open_model(r))
        return false;
    if (!config_create(&r->config, store, &r->bo))
        return false;
    r->works = bayesopt_best_told(r->bo, NULL, NULL, NULL) >= 0;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    return work(r) && conclude(r);
}

/* The options, the file between them, because options win, and the run. */
static int run_command(int argc, char **argv, const struct settings *table, struct runner *r)
{
    int code = settings_options(argc, argv, table, &r->config, NULL, NULL);
    char *path = code < 0 ? strdup(r->config.path) : NULL;
    if (path && !config_read(path, &r->config))
        code = CLI_FAILED;
    if (code < 0)
        code = settings_options(argc, argv, table, &r->config, NULL, NULL);
    if (code < 0) {
        char *store = config_store(&r->config);
        code = run(r, store) ? CLI_OK : CLI_FAILED;
        free(store);
    }
    free(path);
    return code;
}

int command_run(int argc, char **argv)
{
    struct runner r = {.rank = launcher_leave()};
    char *usage = NULL;
    size_t length;
    config_start(&r.config);
    FILE *out = text_open(&usage, &length);
    if (!out)
        return cli_fail("out of memory");
    fputs("usage: bayesopt run CONFIG.yaml [OPTION]...\n"
          "\n"
          "Minimises, or maximises, what an external command prints. Run again, it continues from "
          "its store; a run\n"
          "that was killed loses nothing but the evaluations then under way, which are repeated.\n"
          "A failed evaluation (exit status, signal, timeout, no number) is recorded and learnt\n"
          "from, unless the file calls it transient.\n"
          "\n"
          "  variables:\n"
          "    - {name: x, lower: 0, upper: 1}\n"
          "  objective:\n"
          "    command: simulate --x {x}\n"
          "    key: cw\n"
          "  search: {evaluations: 100, workers: 2}\n"
          "\n"
          "Keys of the file:\n",
          out);
    settings_help(&CONFIG, &r.config, true, out);
    fputs("\nOptions:\n", out);
    if (!text_close(out, &usage))
        return cli_fail("out of memory");
    struct settings table = CONFIG;
    table.usage = usage;
    int code = run_command(argc, argv, &table, &r);
    bayesopt_free(r.bo);
    umbridge_close(&r.model);
    free(usage);
    free(r.slots);
    free(r.streak.ids);
    free(r.x);
    config_free(&r.config);
    return code;
}
