#include "cli.h"
#include "cli/commands.h"
#include "text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char HELP[] =
    "hullopt - shape optimisation of a hull for least wave resistance\n"
    "\n"
    "usage: hullopt init [HULL [SHAPE.yaml]] [-o CONFIG.yaml] [options]\n"
    "       hullopt check CONFIG.yaml [options]\n"
    "       hullopt run CONFIG.yaml --out DIR [--resume] [options]\n"
    "       hullopt report DIR [options]\n"
    "       hullopt status DIR [options]\n"
    "       hullopt compare DIR DIR... [options]\n"
    "       hullopt forecast CONFIG.yaml [options]\n"
    "       hullopt evaluate CONFIG.yaml --latent U,... | --parameters X,... [options]\n"
    "       hullopt serve CONFIG.yaml [options]\n"
    "\n"
    "init    writes a configuration with every key, its meaning and its default.\n"
    "check   reads all that CONFIG.yaml names, evaluates the original hull once and tells what a\n"
    "        run would do and how long it would take. Writes nothing.\n"
    "run     reduces the family of shape modifications of CONFIG.yaml to its latent variables,\n"
    "        searches them for the hull of least wave resistance, and verifies the optimum with\n"
    "        other formulations, at a finer resolution and at other speeds. DIR receives run.db\n"
    "        (every evaluation, on disk before the next begins), summary.json, best.json and\n"
    "        best.igs (the optimum up to the deck), best_wetted.json (the patch that was solved)\n"
    "        and report.html.\n"
    "report  writes all files of DIR but run.db again, also of a run that is not finished; into\n"
    "        another folder by --out. Of one that may not be written it prints the figures "
    "alone.\n"
    "        With --design the files are about another design, as one of the Pareto set.\n"
    "status  tells how far the run in DIR is, also while it is at work. Writes nothing.\n"
    "compare  sets runs of one problem by several methods and seeds beside each other: best "
    "designs\n"
    "        with quartiles, evaluations and seconds to within 10, 5 and 1 % of the best known.\n"
    "forecast  tells, from one Jacobian at the original, what a search may gain, what confirmation "
    "by\n"
    "        the other models costs, and what each constraint costs.\n"
    "evaluate  builds and solves one design and tells its figures and what it breaks; a design "
    "that\n"
    "        cannot be evaluated is a failure.\n"
    "serve   offers the problem of CONFIG.yaml as a model of UM-Bridge: latent variables in; C_w,\n"
    "        constraints (<= 0 where kept) and particulars out. Stops on SIGINT and SIGTERM.\n";

#define ROW(kind, member, meaning, ...)                                                            \
    SETTING_ROW(struct options, NULL, kind, member, meaning, __VA_ARGS__)
#define HEADING(name)                                                                              \
    {                                                                                              \
        .type = SETTING_HEADING, .sentence = "options of " name ":"                                \
    }
#define JSON ROW(SWITCH, json, "one JSON object on standard output", .option = "json")

static const struct setting_word AS_CONFIGURED[] = {{"as configured", -1}, {NULL, 0}};

static const struct setting INIT[] = {
    HEADING("init"),
    ROW(TEXT, path, "the hull", .option = "HULL"),
    ROW(TEXT, shape, "how it may be modified", .option = "SHAPE.yaml"),
    ROW(TEXT, out, "file to write; by default standard output", .option = "output", .letter = 'o'),
    ROW(NUMBER, froude, "Froude number", .option = "fr", SETTING_INSIDE(0, 10)),
    JSON,
};
static const struct setting CHECK[] = {
    HEADING("check"),
    ROW(TEXT, path, "the configuration", .option = "CONFIG.yaml", .required = true),
    JSON,
};
static const struct setting RUN[] = {
    HEADING("run"),
    ROW(TEXT, path, "the configuration", .option = "CONFIG.yaml", .required = true),
    ROW(TEXT, out, "folder of the run; made when it does not exist", .option = "out",
        .required = true),
    ROW(SWITCH, resume,
        "continue the run in DIR, or start it when there is none; nothing that was evaluated is "
        "lost or evaluated again, however the last session ended",
        .option = "resume"),
    ROW(INTEGER, jobs, "designs evaluated at once, in processes of one thread each",
        .option = "jobs", SETTING_FROM(1, 64), .otherwise = "1"),
    ROW(TEXT, servers,
        "URL,... of servers that solve the designs, --jobs at once in all: 'hullopt serve' of the "
        "same configuration, or UM-Bridge's load balancer in front of it",
        .option = "server"),
    ROW(NUMBER, timeout,
        "s after which one of several designs at once has failed, or the server that has it is "
        "lost; 0: never",
        .option = "timeout", SETTING_FROM(0, 1e6), .otherwise = "0"),
    ROW(INTEGER, overrides.initial, "size of the initial design", .option = "initial",
        SETTING_FROM(2, 100000), .words = AS_CONFIGURED, .otherwise = "as configured"),
    ROW(INTEGER, overrides.iterations, "proposals after it", .option = "iterations",
        SETTING_FROM(0, 100000), .words = AS_CONFIGURED, .otherwise = "as configured"),
    JSON,
};
static const struct setting REPORT[] = {
    HEADING("report"),
    ROW(TEXT, path, "folder of the run", .option = "DIR", .required = true),
    ROW(TEXT, out, "folder for the files; by default that of the run", .option = "out"),
    ROW(COUNT, design,
        "number of a design that the files are about instead of the best; with --out",
        .option = "design", .otherwise = "0"),
    JSON,
};
static const struct setting STATUS[] = {
    HEADING("status"),
    ROW(TEXT, path, "folder of the run", .option = "DIR", .required = true),
    JSON,
};
static const struct setting_word OF_PORT[] = {{"of $PORT, or 4242", -1}, {NULL, 0}};
static const struct setting SERVE[] = {
    HEADING("serve"),
    ROW(TEXT, path, "the configuration", .option = "CONFIG.yaml", .required = true),
    ROW(TEXT, address,
        "IPv4 address to listen at; 0.0.0.0: every one of this machine, for "
        "whoever can reach it",
        .option = "address", .otherwise = "127.0.0.1"),
    ROW(INTEGER, port, "port to listen at; 0: any free one, which is printed", .option = "port",
        SETTING_FROM(0, 65535), .words = OF_PORT, .otherwise = "of $PORT, or 4242"),
    ROW(INTEGER, jobs, "designs evaluated at once, with as many shares of the threads",
        .option = "jobs", SETTING_FROM(1, 64), .otherwise = "1"),
    JSON,
};

static const struct setting FORECAST[] = {
    HEADING("forecast"),
    ROW(TEXT, path, "the configuration", .option = "CONFIG.yaml", .required = true),
    JSON,
};
static const struct setting COMPARE[] = {
    HEADING("compare"),
    JSON,
};
static const struct setting EVALUATE[] = {
    HEADING("evaluate"),
    ROW(TEXT, path, "the configuration", .option = "CONFIG.yaml", .required = true),
    ROW(NUMBERS, latent, "latent variables", .option = "latent",
        .count = offsetof(struct options, n_latent)),
    ROW(NUMBERS, parameters, "parameters of the shape instead", .option = "parameters",
        .count = offsetof(struct options, n_parameters)),
    JSON,
};

#define COMMAND(name, list)                                                                        \
    {                                                                                              \
#name, {sizeof list / sizeof *list, list, .usage = HELP }, name##_command                  \
    }
static const struct command {
    const char *name;
    struct settings table;
    int (*run)(const struct options *options);
} COMMANDS[] = {COMMAND(init, INIT),         COMMAND(check, CHECK),       COMMAND(run, RUN),
                COMMAND(report, REPORT),     COMMAND(status, STATUS),     COMMAND(compare, COMPARE),
                COMMAND(forecast, FORECAST), COMMAND(evaluate, EVALUATE), COMMAND(serve, SERVE)};
enum { N_COMMANDS = sizeof COMMANDS / sizeof *COMMANDS };

/* The options of all commands. */
static int print_help(const struct options *options)
{
    char *text = NULL;
    size_t length;
    FILE *out = text_open(&text, &length);
    if (!out)
        return cli_fail("out of memory");
    fputs(HELP, out);
    for (size_t k = 0; k < N_COMMANDS; k++)
        settings_help(&COMMANDS[k].table, options, false, out);
    fputs("\nAll take --threads N (default: all cores), --help and --version.\n"
          "\nExit codes: 0 success, 1 failure, 2 usage.\n",
          out);
    int code = cli_print(text_close(out, &text));
    free(text);
    return code;
}

static int run_hullopt(int argc, char **argv)
{
    struct options options = {.froude = NAN, .overrides = {-1, -1}, .start = cli_seconds()};
    if (argc < 2)
        return cli_usage("no command, expected init, check, run, report, status, compare, "
                         "forecast, evaluate or serve");
    if (strcmp(argv[1], "--help") == 0)
        return print_help(&options);
    if (strcmp(argv[1], "--version") == 0)
        return cli_version();
    for (size_t k = 0; k < N_COMMANDS; k++) {
        const struct command *command = &COMMANDS[k];
        if (strcmp(argv[1], command->name) != 0)
            continue;
        settings_start(&command->table, &options);
        bool takes_words = command->run == compare_command;
        options.folders = takes_words ? cli_needed(calloc((size_t)argc, sizeof *argv)) : NULL;
        int code = settings_options(argc - 1, argv + 1, &command->table, &options,
                                    takes_words ? &options.n_folders : NULL, options.folders);
        code = code < 0 ? command->run(&options) : code;
        free(options.folders);
        settings_free(&command->table, &options);
        return code;
    }
    return cli_usage("unknown command '%s', expected init, check, run, report, status, compare, "
                     "forecast, evaluate or serve",
                     argv[1]);
}

int main(int argc, char **argv)
{
    return cli_main("hullopt", run_hullopt, argc, argv);
}
