/* run: minimise the result of an external command, several at a time. */
#include "cli.h"
#include "commands.h"
#include "config.h"
#include "evaluate.h"

#include <errno.h>
#include <getopt.h>
#include <jansson.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>

static const char help[] =
    "usage: bayesopt run CONFIG.yaml [OPTION]...\n"
    "\n"
    "Minimises what an external command prints. Run again, it continues from its store; a run "
    "that\n"
    "was killed loses nothing but the evaluations then under way, which are repeated.\n"
    "\n"
    "  store: run.db                    (default: CONFIG with .db)\n"
    "  variables:\n"
    "    - {name: x, lower: 0, upper: 1}\n"
    "  objective:\n"
    "    command: simulate --x {x}      {name} and {id} are replaced; run by /bin/sh in a folder\n"
    "    key: cw                        of its own; the number after 'cw' in its output, or\n"
    "                                   without a key the last one that ends a line\n"
    "    gradient: dcw                  optional: its derivatives, as many numbers after 'dcw'\n"
    "    folder: evaluations            parent of the working folders\n"
    "    timeout: 600                   seconds, then it has failed (default none)\n"
    "    retries: 1                     again after a failure (default 0)\n"
    "  constraints:\n"
    "    - {name: volume, lower: 0.9}   the number after 'volume' in the output\n"
    "  levels:                          optional: a cheaper, coarser evaluation beside it\n"
    "    cheap: simulate --coarse --x {x}\n"
    "    cost: 0.1                      of the cheap one over the other's\n"
    "  search:\n"
    "    evaluations: 100               initial: 30   design: annealed-lhs   seed: 1\n"
    "    strategy: auto                 noise: deterministic               workers: 1\n"
    "    kernel: matern52 (se, matern32)            scales: auto (isotropic, ard, tied: each\n"
    "    mean: constant (linear)                      variable then has a group: 0, 1, ...)\n"
    "    choice: posterior (loo)                    transform: auto (none, log, yeo-johnson,\n"
    "    acquisition: ei (lcb)   lcb_factor: 2        rank, winsorised)\n"
    "    stop_no_improvement: 0                     stop_expected_improvement: 0\n"
    "\n"
    "  --store FILE      instead of the file's\n"
    "  --threads N       evaluations at a time, instead of the file's workers\n"
    "  --json            one JSON object with the result\n"
    "  --help\n"
    "\n"
    "A failed evaluation (exit status, signal, timeout, no number) is recorded and learnt from.\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

static volatile sig_atomic_t interrupted;

static void interrupt(int signal_number)
{
    (void)signal_number;
    interrupted = 1;
}

struct runner {
    struct config config;
    bayesopt *bo;
    struct evaluation *slots;           /* [workers] */
    double *x, *constraints, *gradient; /* [workers x d], [m], [d] */
    struct cli_progress progress;
    bayesopt_status stop; /* positive: nothing more to ask */
};

static bool runner_start(struct runner *r, struct evaluation *slot)
{
    slot->attempt = 0;
    bayesopt_status status = bayesopt_ask_levels(r->bo, 1, slot->x, &slot->id, &slot->level);
    if (status > 0) {
        r->stop = status;
        return true;
    }
    if (status) {
        cli_fail("%s", bayesopt_last_error());
        return false;
    }
    return evaluation_start(&r->config, slot);
}

static bool runner_finish(struct runner *r, struct evaluation *slot, int status)
{
    char reason[256];
    double f = NAN;
    slot->process = 0;
    bool ok = evaluation_read(&r->config, slot, status, &f, r->constraints, r->gradient, reason,
                              sizeof reason);
    if (!ok && slot->attempt < r->config.retries && !interrupted) {
        slot->attempt++;
        return evaluation_start(&r->config, slot);
    }
    bayesopt_result result = {
        .f = f,
        .constraints = r->config.names.m ? r->constraints : NULL,
        .gradient = r->config.file->objective.gradient ? r->gradient : NULL,
    };
    bayesopt_status told = ok ? bayesopt_tell_result(r->bo, slot->id, &result)
                              : bayesopt_tell_failed(r->bo, slot->id, reason);
    if (told) {
        cli_fail("%s", bayesopt_last_error());
        return false;
    }
    char detail[64] = "";
    if (bayesopt_best(r->bo, NULL, &f, NULL) >= 0)
        snprintf(detail, sizeof detail, "best %.6g", f);
    cli_progress_update(&r->progress,
                        (double)bayesopt_count(r->bo) / (double)bayesopt_budget(r->bo), detail);
    return true;
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
    cli_progress_start(&r->progress, "evaluations");
    while (ok && !interrupted && (!r->stop || busy)) {
        ok = turn(r, &busy);
        if (ok && busy)
            nanosleep(&pause, NULL);
    }
    cli_progress_end(&r->progress);
    kill_all(r);
    if (interrupted)
        cli_fail("interrupted; run again to continue");
    return ok && !interrupted;
}

static int report(const struct runner *r, bool json)
{
    double f = NAN, *x = malloc(r->config.names.d * sizeof *x);
    uint64_t id = 0;
    if (!x)
        return cli_fail("out of memory");
    bayesopt_status status = bayesopt_best(r->bo, x, &f, &id);
    int code = status < 0 ? cli_fail("no evaluation succeeded") : CLI_OK;
    json_t *values = json_object();
    for (size_t j = 0; j < r->config.names.d && !code; j++) {
        json_object_set_new(values, r->config.names.variables[j], json_real(x[j]));
        if (!json)
            printf("%s = %.17g\n", r->config.names.variables[j], x[j]);
    }
    if (!code && !json)
        printf("f = %.17g (point %llu%s)\n", f, (unsigned long long)id,
               status ? ", outside the outcome constraints" : "");
    json_t *root = json_pack(
        "{s:I, s:s, s:I, s:b, s:o, s:o}", "evaluations", (json_int_t)bayesopt_count(r->bo), "stop",
        bayesopt_status_string(r->stop), "id", (json_int_t)id, "feasible", status == BAYESOPT_OK,
        "f", isfinite(f) ? json_real(f) : json_null(), "x", values);
    if (!code && json) {
        json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
        putchar('\n');
    }
    json_decref(root);
    free(x);
    return code;
}

static int run(struct runner *r, const char *store, bool json)
{
    size_t d = r->config.names.d, workers = r->config.workers;
    struct sigaction action = {.sa_handler = interrupt};
    r->slots = calloc(workers, sizeof *r->slots);
    r->x = malloc((workers * d + r->config.names.m + d) * sizeof *r->x);
    if (!r->slots || !r->x)
        return cli_fail("out of memory");
    r->constraints = r->x + workers * d;
    r->gradient = r->constraints + r->config.names.m;
    for (size_t i = 0; i < workers; i++)
        r->slots[i].x = r->x + i * d;
    if (!config_create(&r->config, store, &r->bo))
        return CLI_FAILED;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    return work(r) ? report(r, json) : CLI_FAILED;
}

/* CONFIG.yaml -> CONFIG.db */
static char *default_store(const char *path)
{
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    size_t length = dot && (!slash || dot > slash) ? (size_t)(dot - path) : strlen(path);
    char *store = malloc(length + 4);
    if (store) {
        memcpy(store, path, length);
        memcpy(store + length, ".db", 4);
    }
    return store;
}

enum { STORE = 1000, THREADS, JSON, HELP };

int command_run(int argc, char **argv)
{
    static const struct option options[] = {
        {"store", required_argument, NULL, STORE},
        {"threads", required_argument, NULL, THREADS},
        {"json", no_argument, NULL, JSON},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    const char *store = NULL;
    size_t workers = 0;
    bool json = false;
    int option;
    while ((option = getopt_long(argc, argv, "", options, NULL)) != -1) {
        if (option == STORE)
            store = optarg;
        else if (option == JSON)
            json = true;
        else if (option == HELP)
            return cli_print(help);
        else if (option != THREADS)
            return cli_usage("unknown option or missing value");
        else if (!cli_parse_size(optarg, &workers) || !workers || workers > 1000)
            return cli_usage("--threads '%s', expected 1 to 1000", optarg);
    }
    if (argc - optind != 1)
        return cli_usage("expected one CONFIG.yaml");
    struct runner r = {0};
    if (!config_read(argv[optind], &r.config))
        return CLI_FAILED;
    r.config.workers = workers ? workers : r.config.workers;
    char *made = default_store(argv[optind]);
    if (!store)
        store = r.config.file->store ? r.config.file->store : made;
    int code = store ? run(&r, store, json) : cli_fail("out of memory");
    bayesopt_free(r.bo);
    free(made);
    free(r.slots);
    free(r.x);
    config_free(&r.config);
    return code;
}
