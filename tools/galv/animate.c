#include "arguments.h"
#include "cli.h"
#include "commands.h"
#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct setting ROWS[] = {
    OPTION_MODEL,
    OPTION_PICTURE,
    OPTION_SHOWN,
    OPTION("frames", COUNT, frames, .least = 1, .most = 1000, .otherwise = "5",
           .sentence = "hulls from the lower to the upper end of the samples"),
    OPTION("scale", NUMBER, scale, .least = 0, .most = INFINITY, .open_least = true,
           .otherwise = "1", .sentence = "multiplies the displacements"),
    OPTION_JSON,
};

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage = "usage: galv animate MODEL -o FILE.svg|FILE.png|FILE.pdf [--modes K] [--frames F] "
             "[--scale S] [--json]\n"
             "\n"
             "Draws, for each of the leading latent directions, body plans from the lower to the "
             "upper end\n"
             "of the samples, the parent in grey, and in an SVG the same as a moving picture.\n\n"};

enum { PANEL = 190, GAP = 20, HEADER = 34 };

static const struct plot_pen parent_pen = {"#b9c2cb", 0.7, NULL},
                             moved_pen = {PLOT_BLUE, 0.8, NULL},
                             motion_pen = {PLOT_OPTIMUM, 0.8, NULL};

struct strip {
    const struct model_file *file;
    size_t modes, frames, stride; /* sections drawn: every stride-th */
    double scale, middle;         /* x (metres) that divides fore from aft sections */
    struct plot sheet;
    struct plot_frame frame;
    double *hull, *u; /* moved points; latent point */
};

/* The hull of frame f along direction k: the others at their sample mean of 0. */
static galv_status move_hull(struct strip *strip, size_t k, size_t f)
{
    const galv_model *model = strip->file->model;
    double lower = galv_model_lower(model)[k], upper = galv_model_upper(model)[k];
    double t = strip->frames > 1 ? (double)f / (double)(strip->frames - 1) : 0.5;
    memset(strip->u, 0, galv_model_modes(model) * sizeof *strip->u);
    strip->u[k] = lower + t * (upper - lower);
    galv_status status = galv_reconstruct(model, strip->u, strip->hull);
    for (size_t i = 0; i < galv_model_coordinates(model) && !status; i++)
        strip->hull[i] = galv_model_parent(model)[i] + strip->scale * strip->hull[i];
    return status;
}

static void include(const struct strip *strip, const double *p, double low[3], double high[3])
{
    for (size_t i = 0; i < galv_model_coordinates(strip->file->model); i++) {
        low[i % 3] = fmin(low[i % 3], p[i]);
        high[i % 3] = fmax(high[i % 3], i % 3 == 1 ? fabs(p[i]) : p[i]);
    }
}

/* The frame of a body plan: around the parent and the hulls at the ends of all directions. */
static galv_status fit(struct strip *strip)
{
    double low[3] = {INFINITY, 0, INFINITY}, high[3] = {-INFINITY, 0, -INFINITY};
    include(strip, galv_model_parent(strip->file->model), low, high);
    strip->middle = (low[0] + high[0]) / 2;
    for (size_t k = 0; k < strip->modes; k++)
        for (size_t end = 0; end < 2; end++) {
            galv_status status = move_hull(strip, k, end * (strip->frames - 1));
            if (status)
                return status;
            include(strip, strip->hull, low, high);
        }
    double side = fmax(fmax(2 * high[1], high[2] - low[2]), 1e-12) / 0.96;
    double centre = (high[2] + low[2]) / 2;
    strip->frame = (struct plot_frame){.width = PANEL, .height = PANEL};
    strip->frame.x = (struct plot_axis){.low = -side / 2, .high = side / 2};
    strip->frame.y = (struct plot_axis){.low = centre - side / 2, .high = centre + side / 2};
    strip->stride = strip->file->sections > 24 ? strip->file->sections / 24 + 1 : 1;
    return GALV_OK;
}

/* Aft sections to the left, fore sections to the right. */
static void put_sections(struct strip *strip, const double *xyz)
{
    size_t girth = strip->file->girth;
    for (size_t i = 0; i < strip->file->sections; i += strip->stride) {
        const double *section = xyz + 3 * i * girth;
        double side = section[3 * (girth / 2)] < strip->middle ? -1 : 1;
        for (size_t j = 0; j < girth; j++)
            fprintf(strip->sheet.out, "%c%.2f %.2f", j ? 'L' : 'M',
                    plot_x(&strip->frame, side * section[3 * j + 1]),
                    plot_y(&strip->frame, section[3 * j + 2]));
    }
}

static void put_hull(struct strip *strip, const double *xyz, struct plot_pen pen)
{
    plot_path(&strip->sheet, pen, NULL);
    put_sections(strip, xyz);
    plot_path_end(&strip->sheet);
}

/* There and back again through the frames; viewers that do not animate show the first hull. */
static galv_status put_motion(struct strip *strip, size_t k)
{
    FILE *out = strip->sheet.out;
    size_t last = strip->frames - 1;
    plot_path(&strip->sheet, motion_pen, NULL);
    for (size_t s = 0; s <= 2 * last + 1; s++) {
        galv_status status = move_hull(strip, k,
                                       s == 0          ? 0
                                       : s <= last + 1 ? s - 1
                                                       : 2 * last + 1 - s);
        if (status)
            return status;
        if (s == 1)
            fprintf(out,
                    "\"><animate attributeName=\"d\" dur=\"%zus\" repeatCount=\"indefinite\" "
                    "values=\"",
                    strip->frames);
        else if (s > 1)
            fputc(';', out);
        put_sections(strip, strip->hull);
    }
    fputs("\"/></path>\n", out);
    return GALV_OK;
}

static galv_status draw_row(struct strip *strip, size_t k)
{
    for (size_t f = 0; f <= strip->frames; f++) {
        bool moving = f == strip->frames;
        galv_status status = move_hull(strip, k, moving ? 0 : f);
        strip->frame.left = 10 + (PANEL + GAP) * (double)f;
        strip->frame.top = HEADER + (PANEL + 2 * GAP) * (double)k;
        put_hull(strip, galv_model_parent(strip->file->model), parent_pen);
        if (!status && moving)
            status = put_motion(strip, k);
        if (status)
            return status;
        double x = strip->frame.left + PANEL / 2.0, y = strip->frame.top + PANEL + 14;
        if (moving) {
            plot_text(&strip->sheet, x, y, 11, PLOT_MIDDLE, PLOT_INK, "direction %zu in motion",
                      k + 1);
            continue;
        }
        put_hull(strip, strip->hull, moved_pen);
        plot_text(&strip->sheet, x, y, 11, PLOT_MIDDLE, PLOT_INK, "u_{%zu} = %.3g m", k + 1,
                  strip->u[k]);
    }
    return GALV_OK;
}

static bool animate(struct strip *strip, const char *output)
{
    const char *slash = strrchr(strip->file->hull, '/');
    galv_status status = fit(strip);
    if (status)
        return cli_refuse("%s", galv_last_error());
    if (!plot_open(&strip->sheet, (PANEL + GAP) * (double)(strip->frames + 1),
                   HEADER + (PANEL + 2 * GAP) * (double)strip->modes, "Latent directions"))
        return false;
    plot_text(&strip->sheet, 10, 20, 13, PLOT_START, PLOT_INK,
              "%s: body plans along the latent directions, the parent in grey",
              slash ? slash + 1 : strip->file->hull);
    plot_scale_bar(&strip->sheet, strip->sheet.width - 30, 10,
                   PANEL / (strip->frame.x.high - strip->frame.x.low), 100);
    for (size_t k = 0; k < strip->modes && !status; k++)
        status = draw_row(strip, k);
    if (!status)
        return plot_save(&strip->sheet, output);
    plot_free(&strip->sheet);
    return cli_refuse("%s", galv_last_error());
}

static bool run(const struct arguments *a)
{
    const galv_model *model = a->file.model;
    struct strip strip = {
        .file = &a->file, .modes = a->modes, .frames = a->frames, .scale = a->scale};
    if (strip.modes > galv_model_modes(model))
        strip.modes = galv_model_modes(model);
    if (!a->file.girth)
        return cli_refuse("the points of this model are no grid of sections");
    strip.hull = malloc(galv_model_coordinates(model) * sizeof *strip.hull);
    strip.u = malloc(galv_model_modes(model) * sizeof *strip.u);
    bool good = strip.hull && strip.u ? animate(&strip, a->output) : cli_refuse("out of memory");
    free(strip.hull);
    free(strip.u);
    return good;
}

int command_animate(int argc, char **argv)
{
    return picture_command(argc, argv, &TABLE, run);
}
