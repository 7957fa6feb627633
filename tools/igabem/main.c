/* igabem: hydrostatics, the Kelvin Green function and wave resistance of NURBS hulls. */
#include "cli.h"
#include "commands.h"

#include <string.h>

static const struct {
    const char *name, *title, *summary;
    int (*run)(int, char **);
} commands[] = {
    {"solve", "igabem solve", "wave resistance, waves, pressure", command_solve},
    {"hydrostatics", "igabem hydrostatics", "particulars of a hull at rest", command_hydrostatics},
    {"green", "igabem green", "the Kelvin Green function at points", command_green},
    {"check", "igabem check", "whether a hull can be solved, and why not", command_check},
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

static int print_help(void)
{
    printf("usage: igabem COMMAND [OPTION]...\n\n"
           "Steady ship waves by isogeometric boundary elements.\n\n");
    for (size_t i = 0; i < COMMANDS; i++)
        printf("  %-13s %s\n", commands[i].name, commands[i].summary);
    return cli_print("\n  --help        this text, or with a command its own\n"
                     "  --version     version\n"
                     "\nExit status: 0 success, 1 failure, 2 wrong usage.\n");
}

static int run_igabem(int argc, char **argv)
{
    if (argc < 2)
        return cli_usage("a command is missing");
    if (strcmp(argv[1], "--help") == 0)
        return print_help();
    if (strcmp(argv[1], "--version") == 0)
        return cli_version();
    for (size_t i = 0; i < COMMANDS; i++)
        if (strcmp(argv[1], commands[i].name) == 0) {
            cli_set_name(commands[i].title);
            return commands[i].run(argc - 1, argv + 1);
        }
    return cli_usage("unknown command '%s'", argv[1]);
}

int main(int argc, char **argv)
{
    return cli_main("igabem", run_igabem, argc, argv);
}
