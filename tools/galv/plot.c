#include "cli.h"
#include "commands.h"
#include "svg.h"
#include "use.h"
#include "view.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: galv plot MODEL -o FILE.svg [--modes K]\n"
    "\n"
    "Draws the retained variance and the mean squared error over the number of modes, and the "
    "first K\n"
    "modes (default 3) on the hull: blue where points stay, yellow where they move most;\n"
    "the bar gives how far at the root mean square of the latent coordinate.\n";

enum { WIDTH = 960, CHART = 250, HULL = 230 };

static int draw_curves(FILE *out, const galv_model *model)
{
    size_t modes = galv_model_modes(model), n = 2 * modes + 2;
    n = n < galv_model_spectrum(model) ? n : galv_model_spectrum(model);
    double *share = malloc(n * sizeof *share), sum = 0;
    if (!share)
        return -1;
    for (size_t k = 0; k < n; k++) {
        sum += galv_model_eigenvalues(model)[k];
        share[k] = 100 * sum / galv_model_trace(model);
    }
    struct svg_chart variance = {.x = 70,
                                 .y = 50,
                                 .width = 370,
                                 .height = CHART,
                                 .title = "Variance retained, %",
                                 .label = "modes",
                                 .mark = modes};
    struct svg_chart error = variance;
    error.x = 560;
    error.title = "Mean squared error, m^2";
    error.logarithmic = 1;
    svg_draw_chart(out, &variance, n, share);
    svg_draw_chart(out, &error, n, galv_model_mse(model));
    free(share);
    return 0;
}

static int draw_mode(FILE *out, const struct model_file *file, size_t k, double top)
{
    const galv_model *model = file->model;
    size_t points = galv_model_points(model);
    const double *mode = galv_model_vectors(model) + k * galv_model_coordinates(model);
    double spread = sqrt(galv_model_eigenvalues(model)[k]), largest = 0;
    double *size = malloc(points * sizeof *size);
    if (!size)
        return -1;
    for (size_t p = 0; p < points; p++) {
        size[p] = spread * hypot(hypot(mode[3 * p], mode[3 * p + 1]), mode[3 * p + 2]);
        largest = fmax(largest, size[p]);
    }
    svg_text(out, 30, top + 16, 14, SVG_START, "mode %zu, %.2f %% of the variance", k + 1,
             100 * galv_model_eigenvalues(model)[k] / galv_model_trace(model));
    svg_text(out, WIDTH - 410, top + 16, 11, SVG_END, "points move by 0");
    svg_colour_bar(out, WIDTH - 400, top + 5, 160, 14);
    svg_text(out, WIDTH - 230, top + 16, 11, SVG_START, "%.3g m where u%zu = %.3g m", largest,
             k + 1, spread);
    struct view view = {.x = 30,
                        .y = top + 24,
                        .width = WIDTH - 60,
                        .height = HULL - 40,
                        .sections = file->sections,
                        .girth = file->girth};
    int failed = view_surface(out, &view, galv_model_parent(model), size);
    free(size);
    return failed;
}

static int plot(const struct use *use)
{
    const struct model_file *file = &use->file;
    size_t modes = use->modes ? use->modes : 3;
    modes = modes < galv_model_modes(file->model) ? modes : galv_model_modes(file->model);
    if (!file->girth)
        modes = 0;
    struct cli_file out;
    if (!cli_file_open(&out, use->output))
        return cli_fail("%s: %s", use->output, strerror(errno));
    double top = CHART + 120;
    svg_begin(out.stream, WIDTH, top + HULL * (double)modes + (modes ? 20 : 0));
    int failed = draw_curves(out.stream, file->model);
    for (size_t k = 0; k < modes && !failed; k++)
        failed = draw_mode(out.stream, file, k, top + HULL * (double)k);
    svg_end(out.stream);
    if (failed) {
        cli_file_abandon(&out);
        return cli_fail("out of memory");
    }
    return cli_file_commit(&out) ? CLI_OK : cli_fail("%s: %s", use->output, strerror(errno));
}

int command_plot(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, USE_OUTPUT | USE_MODES, &use);
    if (result != -1)
        return result;
    result = use.output ? plot(&use) : cli_usage("-o FILE.svg is required");
    use_free(&use);
    return result;
}
