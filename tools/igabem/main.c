/* igabem: hydrostatics, the Kelvin Green function and wave resistance of NURBS hulls. */
#include "cli.h"
#include "commands.h"

static const struct cli_command COMMANDS[] = {
    {"solve", "", "wave resistance, waves, pressure", command_solve},
    {"hydrostatics", "", "particulars of a hull at rest", command_hydrostatics},
    {"green", "", "the Kelvin Green function at points", command_green},
    {"check", "", "whether a hull can be solved, and why not", command_check},
};

static int run_igabem(int argc, char **argv)
{
    return cli_dispatch("igabem", "Steady ship waves by isogeometric boundary elements.",
                        sizeof COMMANDS / sizeof *COMMANDS, COMMANDS, argc, argv);
}

int main(int argc, char **argv)
{
    return cli_main("igabem", run_igabem, argc, argv);
}
