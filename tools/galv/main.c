/* galv: latent spaces of hull modifications. */
#include "cli.h"
#include "commands.h"

static const struct cli_command COMMANDS[] = {
    {"reduce", "", "sample a modification on a hull and find its latent space", command_reduce},
    {"extend", "", "add samples to a model", command_extend},
    {"info", "", "say what a model file holds", command_info},
    {"project", "", "latent coordinates of hulls or of parameters", command_project},
    {"reconstruct", "", "the hull of a latent point", command_reconstruct},
    {"backmap", "", "the parameters whose hull is nearest to a latent point's", command_backmap},
    {"plot", "", "variance and error curves and modes on the hull, as a picture", command_plot},
    {"animate", "", "a strip of hulls along each latent direction, as a picture", command_animate},
};

static int run_galv(int argc, char **argv)
{
    return cli_dispatch("galv", "Latent spaces of shape modifications.",
                        sizeof COMMANDS / sizeof *COMMANDS, COMMANDS, argc, argv);
}

int main(int argc, char **argv)
{
    return cli_main("galv", run_galv, argc, argv);
}
