#include "arguments.h"
#include "cli.h"
#include "commands.h"
#include "plot/ship.h"

#include <stdlib.h>

static const struct setting ROWS[] = {
    OPTION_MODEL,
    OPTION_PICTURE,
    OPTION_SHOWN,
    OPTION_JSON,
};

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage =
        "usage: galv plot MODEL -o FILE.svg|FILE.png|FILE.pdf [--modes K] [--json]\n"
        "\n"
        "Draws the retained variance and the mean squared error over the number of modes, and the "
        "leading\n"
        "modes on the hull: blue where points stay, yellow where they move most;\n"
        "the bar gives how far at the root mean square of the latent coordinate.\n\n"};

enum { WIDTH = 960, CHART = 300, HULL = 240 };

static bool plot(const struct arguments *a)
{
    const galv_model *model = a->file.model;
    size_t modes = a->modes < galv_model_modes(model) ? a->modes : galv_model_modes(model);
    if (!a->file.girth)
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
                                       a->file.sections,
                                       a->file.girth,
                                       galv_model_parent(model),
                                       galv_model_vectors(model) +
                                           k * galv_model_coordinates(model),
                                       latent.eigenvalues[k],
                                       latent.trace};
        plot_mode_view(&sheet, 30, 40 + CHART + HULL * (double)k, WIDTH - 40, HULL - 14, &mode);
    }
    return plot_save(&sheet, a->output);
}

int command_plot(int argc, char **argv)
{
    return picture_command(argc, argv, &TABLE, plot);
}
