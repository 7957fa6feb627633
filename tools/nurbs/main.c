#include "nurbs_tool.h"

#include <string.h>

static const subcommand *const commands[] = {
    &make_command,    &info_command,     &eval_command,   &skin_command,         &fit_command,
    &grid_command,    &simplify_command, &wetted_command, &hydrostatics_command, &moments_command,
    &closest_command, &cut_command,      &edit_command,   &convert_command,      &plot_command,
    &clean_command,   &sections_command,
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static const subcommand *find_command(const char *name)
{
    for (size_t k = 0; k < COMMANDS; k++)
        if (strcmp(commands[k]->name, name) == 0)
            return commands[k];
    return NULL;
}

static const char COMMON[] =
    "  --json         print one JSON object on standard output and nothing else\n"
    "  --threads N    threads to use\n";

static int print_own_help(const subcommand *command)
{
    fputs(command->help, stdout);
    return cli_print(COMMON);
}

static int print_help(void)
{
    printf("nurbs - make, look at, fit, simplify and convert NURBS hulls\n\n"
           "usage: nurbs COMMAND [options] ...\n       nurbs COMMAND --help | --version\n\n"
           "Commands:\n");
    for (size_t k = 0; k < COMMANDS; k++)
        printf("  %-13s %s\n", commands[k]->name, commands[k]->summary);
    for (size_t k = 0; k < COMMANDS; k++)
        printf("\n%s", commands[k]->help);
    printf("\nOptions of every command:\n%s", COMMON);
    return cli_print(
        "  --help         print this text, or the text of a command\n"
        "  --version      print the version\n\n"
        "Files: .json (NURBS file, see docs/nurbs.md), .igs, .iges, .step and .stp are\n"
        "read and written; .stl, .vtu and .csv are written; .stl, .obj, .offsets.csv,\n"
        ".stations and grids .csv are read as the one surface through them. Lengths are\n"
        "in metres.\n\n"
        "Exit status: 0 success, 1 the run failed, 2 wrong usage.\n");
}

static int run_nurbs(int argc, char **argv)
{
    if (argc < 2)
        return cli_usage("no command");
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "help") == 0)
        return print_help();
    if (strcmp(argv[1], "--version") == 0)
        return cli_version();
    const subcommand *command = find_command(argv[1]);
    if (!command)
        return cli_usage("unknown command '%s'", argv[1]);
    char name[40];
    snprintf(name, sizeof name, "nurbs %s", command->name);
    cli_set_name(name);
    for (int k = 2; k < argc; k++) {
        if (strcmp(argv[k], "--help") == 0)
            return print_own_help(command);
        if (strcmp(argv[k], "--version") == 0)
            return cli_version();
    }
    opterr = 0;
    return command->run(argc - 1, argv + 1);
}

int main(int argc, char **argv)
{
    return cli_main("nurbs", run_nurbs, argc, argv);
}
