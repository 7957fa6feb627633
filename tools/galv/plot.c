#include "cli.h"
#include "commands.h"
#include "plot/ship.h"
#include "use.h"

#include <stdlib.h>

static const char help[] =
    "usage: galv plot MODEL -o FILE.svg|FILE.png|FILE.pdf [--modes K]\n"
    "\n"
    "Draws the retained variance and the mean squared error over the number of modes, and the "
    "first K\n"
    "modes (default 3) on the hull: blue where points stay, yellow where they move most;\n"
    "the bar gives how far at the root mean square of the latent coordinate.\n";

enum { WIDTH = 960, CHART = 300, HULL = 240 };

static bool plot(const struct use *use)
{
    const galv_model *model = use->file.model;
    size_t modes = use->modes ? use->modes : 3;
    modes = modes < galv_model_modes(model) ? modes : galv_model_modes(model);
    if (!use->file.girth)
        modes = 0;
    struct plot sheet;
    if (!plot_open(&sheet, WIDTH, 40 + CHART + HULL * (double)modes, "Latent space"))
        return false;
    const struct plot_latent latent = {.modes = galv_model_modes(model),
                                       .spectrum = galv_model_spectrum(model),
                                       .eigenvalues = galv_model_eigenvalues(model),
                                       .mse = galv_model_mse(model),
                                       .trace = galv_model_trace(model)};
    plot_variance(&sheet, 0, 20, WIDTH / 2.0, CHART, &latent);
    plot_error(&sheet, WIDTH / 2.0, 20, WIDTH / 2.0, CHART, &latent);
    for (size_t k = 0; k < modes; k++) {
        const struct plot_mode mode = {k + 1,
                                       use->file.sections,
                                       use->file.girth,
                                       galv_model_parent(model),
                                       galv_model_vectors(model) +
                                           k * galv_model_coordinates(model),
                                       latent.eigenvalues[k],
                                       latent.trace};
        plot_mode_view(&sheet, 30, 40 + CHART + HULL * (double)k, WIDTH - 40, HULL - 14, &mode);
    }
    return plot_save(&sheet, use->output);
}

int command_plot(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, USE_OUTPUT | USE_MODES, &use);
    if (result != -1)
        return result;
    if (!use.output)
        result = cli_usage("-o FILE.svg is required");
    else if (!plot_check_path("-o", use.output))
        result = CLI_USAGE;
    else
        result = plot(&use) ? CLI_OK : CLI_FAILED;
    use_free(&use);
    return result;
}
