/* bayesopt: minimise an expensive function, from the shell. */
#include "cli.h"
#include "commands.h"

static const struct cli_command COMMANDS[] = {
    {"run", "CONFIG.yaml", "minimise the result of an external command", command_run},
    {"ask", "STORE", "the next points to evaluate", command_ask},
    {"tell", "STORE", "the result at a point", command_tell},
    {"release", "STORE ID", "a pending point for somebody else", command_release},
    {"heartbeat", "STORE ID", "says that a pending point is still in work", command_heartbeat},
    {"best", "STORE", "the best point so far", command_best},
    {"status", "STORE", "how far the run is, and its model", command_status},
    {"predict", "STORE", "what the model expects at points", command_predict},
    {"export", "STORE", "the history as CSV or JSON", command_export},
    {"plot", "STORE", "a picture of the history, the model or the Pareto set", command_plot},
    {"report", "STORE", "the study as one page of HTML", command_report},
    {"design", "KIND N D", "a design of experiments", command_design},
};

static int run_bayesopt(int argc, char **argv)
{
    cli_set_threads(1); /* matrices of a few hundred rows gain nothing from more */
    return cli_dispatch("bayesopt",
                        "Bayesian optimisation of expensive functions. The history lives in one "
                        "SQLite file, the store.",
                        sizeof COMMANDS / sizeof *COMMANDS, COMMANDS, argc, argv);
}

int main(int argc, char **argv)
{
    return cli_main("bayesopt", run_bayesopt, argc, argv);
}
