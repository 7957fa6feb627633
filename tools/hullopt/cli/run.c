#include "cli.h"
#include "cli/commands.h"
#include "cli/folder.h"
#include "core/optimise.h"
#include "core/remote.h"
#include "core/search.h"
#include "report/outputs.h"
#include "report/results.h"

#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A progress line for each stage. */
struct watch {
    struct cli_progress progress;
    const char *stage;
};

static volatile sig_atomic_t stop;

static void ask_to_stop(int signal)
{
    stop = signal;
}

/* A second signal ends the process at once; nothing that was evaluated is lost by that. */
static void stop_on_signals(void)
{
    struct sigaction action = {.sa_handler = ask_to_stop, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static void show(void *user_data, const char *stage, double fraction, const char *detail)
{
    struct watch *watch = user_data;
    if (watch->stage && strcmp(watch->stage, stage) != 0)
        cli_progress_end(&watch->progress);
    if (!watch->stage || strcmp(watch->stage, stage) != 0)
        cli_progress_start(&watch->progress, stage);
    watch->progress.is_run = true;
    watch->stage = stage;
    cli_progress_update(&watch->progress, fraction, detail);
}

/* The bar on a terminal counts failures as it is. */
static void tell(void *user_data, const char *sentence)
{
    const struct watch *watch = user_data;
    if (!watch->progress.is_terminal)
        fprintf(stderr, "%s: %s\n", cli_name(), sentence);
}

static bool say(bool ok)
{
    return ok || cli_refuse("%s", core_sentence());
}

/* A new run or an old one; refuses what would mix two. */
static bool prepare(const struct options *options, struct problem *problem, const galv_shape *shape,
                    const char *path, const struct core_watch *watch)
{
    if (access(path, F_OK) != 0)
        return say(optimise_begin(problem, shape, path, watch));
    if (options->resume)
        return say(optimise_resume(problem, path));
    struct record record;
    struct origin origin;
    if (!say(record_read(path, &record, &origin)))
        return false;
    record_close(&record);
    origin_free(&origin);
    return cli_refuse("%s holds a run already: continue it with --resume or choose another folder",
                      options->out);
}

static bool report(const struct options *options, struct problem *problem,
                   const struct record *record)
{
    struct results results;
    if (!say(results_read(problem, record, 0, &results)))
        return false;
    bool ok = outputs_write(&results, options->out, options->json);
    results_free(&results);
    return ok;
}

static bool work(const struct options *options, struct problem *problem, const galv_shape *shape,
                 const char *path, bool is_new, const struct core_watch *watch)
{
    struct record record;
    struct remote remote = {.n = 0};
    bool ok = say(search_open(problem, path, &record));
    if (ok && options->servers) {
        problem->remote = &remote;
        ok = say(remote_open(&remote, problem, options->servers));
        if (!ok && is_new) /* a run that never began */
            record_remove(path);
    }
    ok = ok && say(record_begin_session(&record, cli_threads(), options->start) &&
                   optimise_run(problem, shape, &record, watch));
    cli_progress_end(&((struct watch *)watch->user_data)->progress);
    if (!ok && stop)
        cli_fail("nothing is lost: hullopt run %s --out %s --resume goes on", options->path,
                 options->out);
    ok = ok && report(options, problem, &record);
    remote_close(&remote);
    problem->remote = NULL;
    record_close(&record);
    return ok;
}

static bool run_in_folder(const struct options *options, struct problem *problem,
                          const galv_shape *shape)
{
    struct folder folder;
    struct watch lines = {0};
    const struct core_watch watch = {show, tell, &stop, &lines};
    stop_on_signals();
    if (!folder_open(&folder, options->out))
        return false;
    char *path = folder_join(options->out, "run.db");
    bool is_new = path && access(path, F_OK) != 0;
    bool ready = path && prepare(options, problem, shape, path, &watch);
    bool ok = ready && work(options, problem, shape, path, is_new, &watch);
    if (ready)
        folder_close(&folder);
    else
        folder_abandon(&folder);
    free(path);
    return ok;
}

int run_command(const struct options *options)
{
    struct config config;
    struct problem problem;
    if (!config_read(options->path, &options->overrides, &config))
        return CLI_FAILED;
    const struct method_row *method = method_row(config.method);
    bool asks = method->kind == METHOD_GAUSSIAN_PROCESS || method->kind == METHOD_DESIGN;
    bool ok = options->jobs == 1 || asks ||
              cli_refuse("--jobs %d: %s needs the value of each design before the next",
                         options->jobs, method->name);
    ok = ok && (!options->servers || method->kind != METHOD_DESCENT ||
                cli_refuse("--server: %s needs the solutions themselves, which no server gives",
                           method->name));
    ok = ok && say(problem_read(&config, &problem));
    if (ok) {
        problem.jobs = (size_t)options->jobs;
        problem.job_seconds = options->timeout;
        galv_shape *shape = problem_shape(&problem);
        ok = shape && run_in_folder(options, &problem, shape);
        galv_shape_free(shape);
        problem_free(&problem);
    }
    config_free(&config);
    return ok ? CLI_OK : CLI_FAILED;
}

/* The hulls and figures of a record, built again. */
static bool restore(const char *path, size_t design, struct record *record, struct config *config,
                    struct problem *problem, struct results *results)
{
    struct origin origin;
    if (!say(record_read(path, record, &origin)))
        return false;
    bool ok = config_restore(origin.configuration, config) ||
              cli_refuse("%s: the configuration is damaged", path);
    if (ok) {
        ok =
            problem_restore(config, origin.model, origin.grid, origin.length, origin.ends, problem);
        origin.model = NULL;
        origin.ends = NULL;
        problem->solver = origin.solver;
        ok = (ok && results_read(problem, record, design, results)) ||
             cli_refuse("%s: %s", path, core_sentence());
        if (!ok) {
            problem_free(problem);
            config_free(config);
        }
    }
    origin_free(&origin);
    if (!ok)
        record_close(record);
    return ok;
}

/* Where the files go; NULL: nowhere, which is said. */
static const char *choose_folder(const char *folder, const char *out)
{
    if (out || access(folder, W_OK) == 0)
        return out ? out : folder;
    fprintf(stderr, "%s: warning: %s: %s; no file is written, --out takes them elsewhere\n",
            cli_name(), folder, strerror(errno));
    return NULL;
}

int report_command(const struct options *options)
{
    const char *folder = options->path, *out = options->out;
    if (options->design && !out)
        return cli_usage("--design needs --out: the files of %s are about its best", folder);
    struct record record;
    struct config config;
    struct problem problem;
    struct results results;
    struct folder made = {.lock = -1};
    char *path = folder_join(folder, "run.db");
    bool ok = path != NULL;
    if (ok && access(path, F_OK) != 0)
        ok = cli_refuse("%s: no such file; is %s the folder of a run?", path, folder);
    if (ok && restore(path, options->design, &record, &config, &problem, &results)) {
        ok = (!out || folder_open(&made, out)) &&
             outputs_write(&results, choose_folder(folder, out), options->json);
        folder_close(&made);
        results_free(&results);
        problem_free(&problem);
        config_free(&config);
        record_close(&record);
    } else {
        ok = false;
    }
    free(path);
    return ok ? CLI_OK : CLI_FAILED;
}
