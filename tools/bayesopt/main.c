/* bayesopt: minimise an expensive function, from the shell. */
#include "cli.h"
#include "commands.h"

#include <string.h>

static const char help[] =
    "usage: bayesopt COMMAND [OPTION]...\n"
    "\n"
    "Bayesian optimisation of expensive functions. The history lives in one SQLite file, the "
    "store.\n"
    "\n"
    "  run CONFIG.yaml   minimise the result of an external command\n"
    "  ask STORE         the next points to evaluate\n"
    "  tell STORE        the result at a point\n"
    "  release STORE ID  a pending point for somebody else\n"
    "  best STORE        the best point so far\n"
    "  status STORE      how far the run is, and its model\n"
    "  predict STORE     what the model expects at points\n"
    "  export STORE      the history as CSV or JSON\n"
    "  plot STORE        history and slices of the model as a picture\n"
    "  design KIND N D   a design of experiments\n"
    "\n"
    "  --help            this text, or with a command its own\n"
    "  --version         version\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

static const struct {
    const char *name, *title;
    int (*run)(int, char **);
} commands[] = {
    {"run", "bayesopt run", command_run},          {"ask", "bayesopt ask", command_ask},
    {"tell", "bayesopt tell", command_tell},       {"release", "bayesopt release", command_release},
    {"best", "bayesopt best", command_best},       {"status", "bayesopt status", command_status},
    {"plot", "bayesopt plot", command_plot},       {"design", "bayesopt design", command_design},
    {"export", "bayesopt export", command_export}, {"predict", "bayesopt predict", command_predict},
};

static int run_bayesopt(int argc, char **argv)
{
    cli_set_threads(1); /* matrices of a few hundred rows gain nothing from more */
    if (argc < 2)
        return cli_usage("a command is missing");
    if (strcmp(argv[1], "--help") == 0)
        return cli_print(help);
    if (strcmp(argv[1], "--version") == 0)
        return cli_version();
    for (size_t i = 0; i < sizeof commands / sizeof commands[0]; i++)
        if (strcmp(argv[1], commands[i].name) == 0) {
            cli_set_name(commands[i].title);
            return commands[i].run(argc - 1, argv + 1);
        }
    return cli_usage("unknown command '%s'", argv[1]);
}

int main(int argc, char **argv)
{
    return cli_main("bayesopt", run_bayesopt, argc, argv);
}
