#include "cli.h"
#include "cli/run.h"

#include <getopt.h>
#include <stdint.h>
#include <string.h>

static const char HELP[] =
    "hullopt - shape optimisation of a hull for least wave resistance\n"
    "\n"
    "usage: hullopt run CONFIG.yaml --out DIR [--resume] [options]\n"
    "       hullopt report DIR [options]\n"
    "\n"
    "run     reduces the family of shape modifications of CONFIG.yaml to its latent variables,\n"
    "        searches them for the hull of least wave resistance, and verifies the optimum with\n"
    "        other formulations, at a finer resolution and at other speeds. DIR receives run.db\n"
    "        (every evaluation, on disk before the next begins), summary.json, best.json and\n"
    "        best.igs (the optimum up to the deck), best_wetted.json (the patch that was solved)\n"
    "        and report.html.\n"
    "report  writes all files of DIR but run.db again, also of a run that is not finished.\n"
    "\n"
    "options:\n"
    "  --out DIR         folder of the run, or of the report's files; made when it does not\n"
    "                    exist. The default of report is the folder of the run; of one that may\n"
    "                    not be written it prints the figures alone\n"
    "  --resume          continue the run in DIR, or start it when there is none; nothing that\n"
    "                    was evaluated is lost or evaluated again, however the last session ended\n"
    "  --initial N       size of the initial design, instead of search.initial of CONFIG.yaml\n"
    "  --iterations N    proposals after it, instead of search.iterations\n"
    "  --threads N       threads of the solver; default: all cores\n"
    "  --json            print summary.json on standard output instead of the figures\n"
    "  --help, --version\n"
    "\n"
    "Exit codes: 0 success, 1 failure, 2 usage.\n";

enum {
    OPTION_OUT = 256,
    OPTION_RESUME,
    OPTION_INITIAL,
    OPTION_ITERATIONS,
    OPTION_THREADS,
    OPTION_JSON,
    OPTION_HELP,
    OPTION_VERSION
};

static const struct option LONG_OPTIONS[] = {
    {"out", required_argument, NULL, OPTION_OUT},
    {"resume", no_argument, NULL, OPTION_RESUME},
    {"initial", required_argument, NULL, OPTION_INITIAL},
    {"iterations", required_argument, NULL, OPTION_ITERATIONS},
    {"threads", required_argument, NULL, OPTION_THREADS},
    {"json", no_argument, NULL, OPTION_JSON},
    {"help", no_argument, NULL, OPTION_HELP},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0},
};

static bool positive(const char *text, const char *option, size_t least, size_t *value)
{
    if (cli_parse_size(text, value) && *value >= least && *value <= 100000)
        return true;
    cli_usage("%s is '%s', expected an integer from %zu to 100000", option, text, least);
    return false;
}

/* Returns -1 to go on, else an exit code. */
static int read_options(int argc, char **argv, struct run_options *o)
{
    int option;
    size_t threads;
    while ((option = getopt_long(argc, argv, "", LONG_OPTIONS, NULL)) != -1) {
        switch (option) {
        case OPTION_OUT:
            o->out = optarg;
            break;
        case OPTION_RESUME:
            o->resume = true;
            break;
        case OPTION_INITIAL:
            if (!positive(optarg, "--initial", 2, &o->overrides.initial))
                return CLI_USAGE;
            break;
        case OPTION_ITERATIONS:
            if (!positive(optarg, "--iterations", 0, &o->overrides.iterations))
                return CLI_USAGE;
            break;
        case OPTION_THREADS:
            if (!positive(optarg, "--threads", 1, &threads))
                return CLI_USAGE;
            o->threads = (int)threads;
            cli_set_threads(o->threads);
            break;
        case OPTION_JSON:
            o->json = true;
            break;
        case OPTION_HELP:
            return cli_print(HELP);
        case OPTION_VERSION:
            return cli_version();
        default:
            return cli_usage("unknown or incomplete option '%s'", argv[optind - 1]);
        }
    }
    return -1;
}

int main(int argc, char **argv)
{
    struct run_options options = {.overrides = {SIZE_MAX, SIZE_MAX}, .start = cli_seconds()};
    cli_set_name("hullopt");
    opterr = 0;
    int code = read_options(argc, argv, &options);
    if (code >= 0)
        return code;
    const char *command = optind < argc ? argv[optind] : "";
    bool run = strcmp(command, "run") == 0;
    if (!run && strcmp(command, "report") != 0)
        return *command ? cli_usage("unknown command '%s', expected run or report", command)
                        : cli_usage("no command, expected run or report");
    if (argc - optind != 2)
        return cli_usage("%s takes one argument, %d given", command, argc - optind - 1);
    if (!run)
        return report_command(argv[optind + 1], options.out, options.json);
    if (!options.out)
        return cli_usage("run needs --out DIR");
    options.configuration = argv[optind + 1];
    return run_command(&options);
}
