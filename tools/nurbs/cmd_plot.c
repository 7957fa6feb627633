/* Lines plan: profile with buttocks, half-breadth plan with waterlines, body plan with sections. */
#include "nurbs_tool.h"
#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>

struct request {
    struct plot_lines lines;
    double length;
    size_t width; /* of a PNG, pixels */
    const char *output;
};

static bool draw(const nurbs_patches *patches, const struct request *request)
{
    enum { WIDTH = 1260 };
    size_t n = nurbs_patches_count(patches);
    const nurbs_surface **surfaces = malloc((n + 1) * sizeof *surfaces);
    struct plot plot;
    if (!surfaces)
        return cli_refuse("out of memory");
    for (size_t k = 0; k < n; k++)
        surfaces[k] = nurbs_patches_get(patches, k);
    const struct plot_hull hull = {NULL, n, surfaces, {"#333344", 0.8, NULL}};
    bool good = plot_lines_plan(&plot, WIDTH, &request->lines, 1, &hull);
    free(surfaces);
    if (!good)
        return false;
    plot.scale = (double)request->width / WIDTH;
    return plot_save(&plot, request->output);
}

/* Of what is no hull: the ends of its control points. */
static bool find_perpendiculars(const nurbs_hull *hull, const nurbs_patches *patches, double length,
                                double x[2])
{
    if (hull)
        return nurbs_hull_perpendiculars(hull, x) == NURBS_OK;
    x[0] = INFINITY;
    x[1] = -INFINITY;
    for (size_t k = 0; k < nurbs_patches_count(patches); k++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, k);
        size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
        for (size_t i = 0; i < n; i++) {
            x[0] = fmin(x[0], nurbs_surface_points(surface)[3 * i]);
            x[1] = fmax(x[1], nurbs_surface_points(surface)[3 * i]);
        }
    }
    if (length > 0)
        x[1] = x[0] + length;
    return true;
}

static int run(int argc, char **argv)
{
    struct request request = {{{0, 0}, 0, 20, 12, 5}, NAN, 2520, NULL};
    bool json = false;
    struct plot_lines *lines = &request.lines;
    const tool_option options[] = {{"stations", OPTION_COUNT, &lines->stations, 1, 1000},
                                   {"waterlines", OPTION_COUNT, &lines->waterlines, 1, 1000},
                                   {"buttocks", OPTION_COUNT, &lines->buttocks, 1, 1000},
                                   {"level", OPTION_NUMBER, &lines->level, 0, 0},
                                   {"lpp", OPTION_LENGTH, &request.length, 0, 0},
                                   {"width", OPTION_COUNT, &request.width, 100, 20000},
                                   {"output", OPTION_OUTPUT, &request.output, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    nurbs_hull_options hull_options;
    nurbs_hull *hull = NULL;
    nurbs_patches *patches = NULL;
    if (code != CLI_OK)
        return code;
    if (!plot_check_path("--output", request.output))
        return CLI_USAGE;
    nurbs_hull_options_init(&hull_options);
    hull_options.level = lines->level;
    hull_options.length = request.length;
    hull_options.simplify = 0;
    /* What is no hull is drawn as it stands: the picture shows what is wrong with it. */
    if (load_hull(argv[optind], &hull_options, &hull) != CLI_OK)
        code = load_patches(argv[optind], &patches);
    const nurbs_patches *drawn = hull ? nurbs_hull_full(hull) : patches;
    if (code == CLI_OK && !find_perpendiculars(hull, patches, request.length, lines->perpendicular))
        code = library_failure();
    if (code == CLI_OK)
        code = draw(drawn, &request) ? CLI_OK : CLI_FAILED;
    nurbs_hull_free(hull);
    nurbs_patches_free(patches);
    return code == CLI_OK && json ? print_json(json_pack("{s:s}", "file", request.output)) : code;
}

const subcommand plot_command = {
    "plot", "draw the lines plan", run,
    "usage: nurbs plot FILE -o LINES.svg|LINES.png|LINES.pdf [options]\n"
    "  Profile with buttocks, half-breadth plan with waterlines, body plan with sections, "
    "stations\n"
    "  from 0 at the aft to the last at the fore perpendicular, with scales in metres.\n"
    "  --stations N   spaces between sections (20)\n"
    "  --waterlines N about so many waterlines, a round number of metres apart (12)\n"
    "  --buttocks N   about so many buttocks, likewise (5)\n"
    "  --level Z      still water, drawn in blue (0)\n"
    "  --lpp L        length between perpendiculars (that of the file, else of the waterline)\n"
    "  --width W      pixels of a PNG file (2520)\n"
    "  -o, --output LINES.svg|LINES.png|LINES.pdf\n"};
