#include "cli.h"
#include "commands.h"
#include "svg.h"
#include "use.h"
#include "view.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: galv animate MODEL -o FILE.svg [--modes K] [--frames F] [--scale S]\n"
    "\n"
    "Draws, for each of the first K latent directions (default 3), the body plans of F hulls "
    "(default 5)\n"
    "from the lower to the upper end of the samples, the parent in grey, and the same as a moving\n"
    "picture. S multiplies the displacements (default 1).\n";

enum { PANEL = 190, HEADER = 30 };

struct strip {
    const struct model_file *file;
    size_t modes, frames;
    double scale;
    double *hull, *u; /* moved points; latent point */
};

/* The hull of frame f along direction k: the others at their sample mean of 0. */
static galv_status move_hull(struct strip *strip, size_t k, double value)
{
    const galv_model *model = strip->file->model;
    memset(strip->u, 0, galv_model_modes(model) * sizeof *strip->u);
    strip->u[k] = value;
    galv_status status = galv_reconstruct(model, strip->u, strip->hull);
    for (size_t i = 0; i < 3 * galv_model_points(model) && !status; i++)
        strip->hull[i] = galv_model_parent(model)[i] + strip->scale * strip->hull[i];
    return status;
}

static double frame_value(const struct strip *strip, size_t k, size_t f)
{
    double lower = galv_model_lower(strip->file->model)[k];
    double upper = galv_model_upper(strip->file->model)[k];
    double t = strip->frames > 1 ? (double)f / (double)(strip->frames - 1) : 0.5;
    return lower + t * (upper - lower);
}

static struct view panel(const struct strip *strip, size_t row, size_t column)
{
    return (struct view){.x = 10 + PANEL * (double)column,
                         .y = HEADER + (PANEL + 20) * (double)row,
                         .width = PANEL - 20,
                         .height = PANEL - 20,
                         .sections = strip->file->sections,
                         .girth = strip->file->girth};
}

static void draw_parent(FILE *out, const struct strip *strip, const struct view *view,
                        const struct body_plan *plan)
{
    fputs("<path fill=\"none\" stroke=\"#ccc\" stroke-width=\"0.6\" d=\"", out);
    view_sections(out, view, plan, galv_model_parent(strip->file->model));
    fputs("\"/>\n", out);
}

static galv_status draw_frame(FILE *out, struct strip *strip, size_t k, size_t f)
{
    struct view view = panel(strip, k, f);
    struct body_plan plan = view_body_plan(&view, galv_model_parent(strip->file->model));
    double value = frame_value(strip, k, f);
    galv_status status = move_hull(strip, k, value);
    if (status)
        return status;
    draw_parent(out, strip, &view, &plan);
    fputs("<path fill=\"none\" stroke=\"#1969c8\" stroke-width=\"0.7\" d=\"", out);
    view_sections(out, &view, &plan, strip->hull);
    fputs("\"/>\n", out);
    svg_text(out, view.x + view.width / 2, view.y + view.height + 16, 11, SVG_MIDDLE,
             "u%zu = %.3g m", k + 1, value);
    return GALV_OK;
}

/* There and back again through the frames. */
static galv_status draw_motion(FILE *out, struct strip *strip, size_t k)
{
    struct view view = panel(strip, k, strip->frames);
    struct body_plan plan = view_body_plan(&view, galv_model_parent(strip->file->model));
    size_t steps = strip->frames > 1 ? 2 * strip->frames - 1 : 1;
    draw_parent(out, strip, &view, &plan);
    /* Viewers that do not animate show the first hull. */
    galv_status first = move_hull(strip, k, frame_value(strip, k, 0));
    if (first)
        return first;
    fputs("<path fill=\"none\" stroke=\"#d62728\" stroke-width=\"0.7\" d=\"", out);
    view_sections(out, &view, &plan, strip->hull);
    fprintf(out,
            "\"><animate attributeName=\"d\" dur=\"%zus\" repeatCount=\"indefinite\" values=\"",
            strip->frames);
    for (size_t s = 0; s < steps; s++) {
        size_t f = s < strip->frames ? s : 2 * (strip->frames - 1) - s;
        galv_status status = move_hull(strip, k, frame_value(strip, k, f));
        if (status)
            return status;
        if (s)
            fputc(';', out);
        view_sections(out, &view, &plan, strip->hull);
    }
    fputs("\"/></path>\n", out);
    svg_text(out, view.x + view.width / 2, view.y + view.height + 16, 11, SVG_MIDDLE,
             "direction %zu in motion", k + 1);
    return GALV_OK;
}

static galv_status draw_all(FILE *out, struct strip *strip)
{
    galv_status status = GALV_OK;
    svg_begin(out, 10 + PANEL * (double)(strip->frames + 1),
              HEADER + (PANEL + 20) * (double)strip->modes);
    const char *slash = strrchr(strip->file->hull, '/');
    svg_text(out, 10, 20, 14, SVG_START, "%s", slash ? slash + 1 : strip->file->hull);
    for (size_t k = 0; k < strip->modes && !status; k++) {
        for (size_t f = 0; f < strip->frames && !status; f++)
            status = draw_frame(out, strip, k, f);
        if (!status)
            status = draw_motion(out, strip, k);
    }
    svg_end(out);
    return status;
}

static int animate(const struct use *use)
{
    const galv_model *model = use->file.model;
    struct strip strip = {.file = &use->file,
                          .modes = use->modes ? use->modes : 3,
                          .frames = use->frames ? use->frames : 5,
                          .scale = use->scale};
    if (strip.modes > galv_model_modes(model))
        strip.modes = galv_model_modes(model);
    if (!use->file.girth)
        return cli_fail("the points of this model are no grid of sections");
    struct cli_file out;
    if (!cli_file_open(&out, use->output))
        return cli_fail("%s: %s", use->output, strerror(errno));
    strip.hull = malloc(galv_model_coordinates(model) * sizeof *strip.hull);
    strip.u = malloc(galv_model_modes(model) * sizeof *strip.u);
    bool memory = strip.hull && strip.u;
    galv_status status = memory ? draw_all(out.stream, &strip) : GALV_ERROR_MEMORY;
    free(strip.hull);
    free(strip.u);
    if (status) {
        cli_file_abandon(&out);
        return cli_fail("%s", memory ? galv_last_error() : "out of memory");
    }
    return cli_file_commit(&out) ? CLI_OK : cli_fail("%s: %s", use->output, strerror(errno));
}

int command_animate(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, USE_OUTPUT | USE_MODES | USE_FRAMES, &use);
    if (result != -1)
        return result;
    result = use.output ? animate(&use) : cli_usage("-o FILE.svg is required");
    use_free(&use);
    return result;
}
