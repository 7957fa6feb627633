/* galv: latent spaces of hull modifications. */
#include "cli.h"
#include "commands.h"

#include <string.h>

static const char help[] =
    "usage: galv COMMAND [OPTION]...\n"
    "\n"
    "Latent spaces of shape modifications.\n"
    "\n"
    "  reduce       sample a modification on a hull and find its latent space\n"
    "  extend       add samples to a model\n"
    "  info         say what a model file holds\n"
    "  project      latent coordinates of hulls or of parameters\n"
    "  reconstruct  the hull of a latent point\n"
    "  backmap      the parameters whose hull is nearest to a latent point's\n"
    "  plot         variance and error curves and modes on the hull, as SVG\n"
    "  animate      a strip of hulls along each latent direction, as SVG\n"
    "\n"
    "  --help       this text, or with a command its own\n"
    "  --version    version\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

static const struct {
    const char *name, *title;
    int (*run)(int, char **);
} commands[] = {
    {"reduce", "galv reduce", command_reduce},
    {"extend", "galv extend", command_extend},
    {"info", "galv info", command_info},
    {"project", "galv project", command_project},
    {"reconstruct", "galv reconstruct", command_reconstruct},
    {"backmap", "galv backmap", command_backmap},
    {"plot", "galv plot", command_plot},
    {"animate", "galv animate", command_animate},
};

static int run_galv(int argc, char **argv)
{
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
    return cli_main("galv", run_galv, argc, argv);
}
