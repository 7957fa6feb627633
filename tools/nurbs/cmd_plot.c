/* Lines plan: profile with buttocks, half-breadth plan with waterlines, body plan with
 * sections, in the layout of a drawing office. */
#include "drawing.h"
#include "nurbs_tool.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

struct plan {
    const nurbs_patches *patches;
    double low[3], high[3];
    double margin; /* pixels */
    drawing *sheet;
};

/* How model axes go onto the sheet: x of the sheet from `across` with a sign, y upwards from `up`.
 */
struct view {
    const char *title;
    int across, up;
    double sign, left, base; /* sheet position of the model's zero */
    double scale;            /* pixels per metre */
};

static void box_of_points(struct plan *plan)
{
    for (int c = 0; c < 3; c++) {
        plan->low[c] = INFINITY;
        plan->high[c] = -INFINITY;
    }
    for (size_t k = 0; k < nurbs_patches_count(plan->patches); k++) {
        const nurbs_surface *surface = nurbs_patches_get(plan->patches, k);
        size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
        const double *p = nurbs_surface_points(surface);
        for (size_t i = 0; i < 3 * n; i++) {
            plan->low[i % 3] = fmin(plan->low[i % 3], p[i]);
            plan->high[i % 3] = fmax(plan->high[i % 3], p[i]);
        }
    }
}

static void put_line(const struct plan *plan, const struct view *view, size_t n,
                     const double *points, drawing_style style)
{
    double *xy = drawing_add_line(plan->sheet, style, n);
    for (size_t k = 0; k < n && xy; k++) {
        xy[2 * k] = view->left + view->sign * view->scale * points[3 * k + (size_t)view->across];
        xy[2 * k + 1] = view->base - view->scale * points[3 * k + (size_t)view->up];
    }
}

/* A straight line along one axis of the view where the other one has `value`. */
static void put_ruler(const struct plan *plan, const struct view *view, bool upright, double value,
                      double from, double to, drawing_style style)
{
    double ends[6] = {0};
    for (size_t e = 0; e < 2; e++) {
        ends[3 * e + (size_t)view->across] = upright ? value : e ? to : from;
        ends[3 * e + (size_t)view->up] = upright ? (e ? to : from) : value;
    }
    put_line(plan, view, 2, ends, style);
}

/* Cells a knot span for sections without visible corners: surfaces of few spans need more. */
static int section_parts(const nurbs_surface *surface)
{
    enum { CELLS = 96, LEAST = 4, MOST = 64 };
    size_t spans = nurbs_surface_size(surface, 0) - (size_t)nurbs_surface_degree(surface, 0),
           across = nurbs_surface_size(surface, 1) - (size_t)nurbs_surface_degree(surface, 1);
    size_t parts = CELLS / (across < spans ? across : spans);
    return parts < LEAST ? LEAST : parts > MOST ? MOST : (int)parts;
}

/* The section of all patches with coordinate `axis` = value. */
static int put_section(const struct plan *plan, const struct view *view, int axis, double value,
                       drawing_style style)
{
    for (size_t k = 0; k < nurbs_patches_count(plan->patches); k++) {
        double normal[3] = {0, 0, 0};
        nurbs_contour contour;
        normal[axis] = 1;
        const nurbs_surface *surface = nurbs_patches_get(plan->patches, k);
        if (nurbs_surface_contour(surface, normal, value, section_parts(surface), &contour) !=
            NURBS_OK)
            return library_failure();
        for (size_t l = 0; l < contour.lines; l++)
            put_line(plan, view, contour.first[l + 1] - contour.first[l],
                     contour.points + 3 * contour.first[l], style);
        nurbs_contour_free(&contour);
    }
    return CLI_OK;
}

/* The four edges of every patch: stem, keel, deck and transom. */
static int put_edges(const struct plan *plan, const struct view *view)
{
    enum { SAMPLES = 400 };
    double t[SAMPLES + 1], points[3 * (SAMPLES + 1)];
    for (size_t k = 0; k < nurbs_patches_count(plan->patches); k++)
        for (int e = 0; e < 4; e++) {
            const nurbs_surface *surface = nurbs_patches_get(plan->patches, k);
            int d = e / 2; /* constant direction */
            const double *fixed = nurbs_surface_knots(surface, d),
                         *range = nurbs_surface_knots(surface, !d);
            double value = e % 2 ? fixed[nurbs_surface_size(surface, d)] : fixed[0],
                   last = range[nurbs_surface_size(surface, !d)];
            for (int i = 0; i <= SAMPLES; i++)
                t[i] = i == SAMPLES ? last : range[0] + (last - range[0]) * i / SAMPLES;
            nurbs_status status =
                d == 0 ? nurbs_surface_eval_grid(surface, 0, 1, &value, SAMPLES + 1, t, points)
                       : nurbs_surface_eval_grid(surface, 0, SAMPLES + 1, t, 1, &value, points);
            if (status != NURBS_OK)
                return library_failure();
            put_line(plan, view, SAMPLES + 1, points, DRAWING_EDGE);
        }
    return CLI_OK;
}

static int put_profile(const struct plan *plan, const struct view *view, size_t buttocks)
{
    int code = put_edges(plan, view);
    for (size_t k = 1; k <= buttocks && code == CLI_OK; k++)
        code = put_section(plan, view, 1, plan->high[1] * (double)k / (double)(buttocks + 1),
                           DRAWING_THIN);
    return code;
}

static int put_half_breadth(const struct plan *plan, const struct view *view, size_t waterlines,
                            double level)
{
    int code = put_edges(plan, view);
    for (size_t k = 1; k < waterlines && code == CLI_OK; k++) {
        double z = plan->low[2] + (plan->high[2] - plan->low[2]) * (double)k / (double)waterlines;
        code = put_section(plan, view, 2, z, DRAWING_THIN);
    }
    return code == CLI_OK ? put_section(plan, view, 2, level, DRAWING_WATER) : code;
}

/* Sections of the fore body to the right, of the aft body to the left. */
static int put_body_plan(const struct plan *plan, struct view view, size_t stations)
{
    double length = plan->high[0] - plan->low[0];
    int code = CLI_OK;
    for (size_t k = 1; k < stations && code == CLI_OK; k++) {
        double share = (double)k / (double)stations;
        view.sign = share < 0.5 ? -1 : 1;
        code = put_section(plan, &view, 0, plan->low[0] + share * length, DRAWING_THIN);
        if (2 * k == stations && code == CLI_OK) {
            view.sign = -1;
            code = put_section(plan, &view, 0, plan->low[0] + share * length, DRAWING_THIN);
        }
    }
    return code;
}

static void put_frame(const struct plan *plan, const struct view *view, double from, double to,
                      double level)
{
    double top = view->base - view->scale * (view->up == 2 ? plan->high[2] : plan->high[1]);
    drawing_add_label(plan->sheet, plan->margin, top - 14, 9.5, view->title);
    double base = view->up == 2 ? level : 0;
    if (base >= plan->low[view->up] && base <= plan->high[view->up]) /* not above or below it */
        put_ruler(plan, view, false, base, from, to, DRAWING_WATER);
}

/* Where the sections of the body plan are, with their numbers from aft below the profile. */
static void put_stations(const struct plan *plan, const struct view *view, size_t stations,
                         bool numbered)
{
    double low = view->up == 2 ? plan->low[2] : 0, high = plan->high[view->up];
    size_t every = stations > 40 ? 10 : 1;
    for (size_t k = 0; k <= stations && stations > 0; k++) {
        double x = plan->low[0] + (plan->high[0] - plan->low[0]) * (double)k / (double)stations;
        char number[24];
        put_ruler(plan, view, true, x, low, high, DRAWING_GRID);
        snprintf(number, sizeof number, "%zu", k);
        if (numbered && k % every == 0)
            drawing_add_label(plan->sheet,
                              view->left + view->scale * x - 3.2 * (double)strlen(number),
                              view->base - view->scale * low + 15, 7, number);
    }
}

/* Where the waterlines of the half-breadth plan are. */
static void put_heights(const struct plan *plan, const struct view *view, size_t waterlines,
                        double from, double to)
{
    for (size_t k = 1; k < waterlines; k++)
        put_ruler(plan, view, false,
                  plan->low[2] + (plan->high[2] - plan->low[2]) * (double)k / (double)waterlines,
                  from, to, DRAWING_GRID);
}

struct request {
    size_t stations, waterlines, buttocks;
    double level;
    size_t width; /* of a PNG, pixels */
    const char *output;
};

static int draw(struct plan *plan, const struct request *request)
{
    double length = plan->high[0] - plan->low[0], height = plan->high[2] - plan->low[2],
           breadth = plan->high[1], gap = 40;
    if (!(length > 0) || !(height > 0) || !(breadth > 0))
        return cli_fail("the body has no extent to draw");
    plan->margin = 30;
    double s = 1200 / length, large = fmin(3 * s, 600 / breadth),
           left = plan->margin - s * plan->low[0];
    double second = plan->margin + 2 * gap + 15 + s * (height + breadth),
           third = second + gap + large * height;
    struct view profile = {
        "Profile and buttocks", 0, 2, 1, left, plan->margin + gap + s * plan->high[2], s};
    struct view half = {"Half-breadth plan and waterlines", 0, 1, 1, left, second, s};
    struct view body = {"Body plan (aft left, fore right)", 1,    2, 1, plan->margin + 600,
                        third + large * plan->low[2],       large};
    plan->sheet->width = 1200 + 2 * plan->margin;
    plan->sheet->height = third + plan->margin;
    put_stations(plan, &profile, request->stations, true);
    put_stations(plan, &half, request->stations, false);
    put_heights(plan, &profile, request->waterlines, plan->low[0], plan->high[0]);
    put_heights(plan, &body, request->waterlines, -breadth, breadth);
    put_ruler(plan, &body, true, 0, plan->low[2], plan->high[2], DRAWING_GRID);
    put_frame(plan, &profile, plan->low[0], plan->high[0], request->level);
    put_frame(plan, &half, plan->low[0], plan->high[0], request->level);
    put_frame(plan, &body, -breadth, breadth, request->level);
    int code = put_profile(plan, &profile, request->buttocks);
    if (code == CLI_OK)
        code = put_half_breadth(plan, &half, request->waterlines, request->level);
    if (code == CLI_OK)
        code = put_body_plan(plan, body, request->stations);
    return code;
}

static bool is_png(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && strcasecmp(dot, ".png") == 0;
}

static int write_sheet(const drawing *sheet, const char *path, double scale)
{
    struct cli_file file;
    if (!cli_file_open(&file, path))
        return cli_fail("%s: %s", path, strerror(errno));
    if (!(is_png(path) ? drawing_write_png(sheet, scale, file.stream)
                       : drawing_write_svg(sheet, file.stream))) {
        cli_file_abandon(&file);
        return cli_fail("%s: out of memory or not writable", path);
    }
    return cli_file_commit(&file) ? CLI_OK : cli_fail("%s: %s", path, strerror(errno));
}

static int plot(const char *input, const struct request *request, bool json)
{
    nurbs_patches *patches = NULL;
    drawing sheet = {0};
    int code = load_patches(input, &patches);
    if (code != CLI_OK)
        return code;
    struct plan plan = {.patches = patches, .sheet = &sheet};
    box_of_points(&plan);
    code = draw(&plan, request);
    if (code == CLI_OK)
        code = write_sheet(&sheet, request->output, (double)request->width / sheet.width);
    drawing_free(&sheet);
    nurbs_patches_free(patches);
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s}", "file", request->output));
    return code;
}

static int run(int argc, char **argv)
{
    struct request request = {20, 12, 4, 0, 2520, NULL};
    bool json = false;
    const tool_option options[] = {{"stations", OPTION_COUNT, &request.stations, 0, 1000},
                                   {"waterlines", OPTION_COUNT, &request.waterlines, 0, 1000},
                                   {"buttocks", OPTION_COUNT, &request.buttocks, 0, 1000},
                                   {"level", OPTION_NUMBER, &request.level, 0, 0},
                                   {"width", OPTION_COUNT, &request.width, 100, 20000},
                                   {"output", OPTION_OUTPUT, &request.output, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    return code == CLI_OK ? plot(argv[optind], &request, json) : code;
}

const subcommand plot_command = {
    "plot", "draw the lines plan", run,
    "usage: nurbs plot FILE -o LINES.svg|LINES.png [options]\n"
    "  Profile with buttocks, half-breadth plan with waterlines, body plan with sections.\n"
    "  --stations N   spaces between sections (20)\n"
    "  --waterlines N spaces between waterlines (12)\n"
    "  --buttocks N   number of buttocks (4)\n"
    "  --level Z      still water, drawn in blue (0)\n"
    "  --width W      pixels of a PNG file (2520)\n"
    "  -o, --output LINES.svg|LINES.png\n"};
