#include "nurbs_tool.h"

/* Back to the axes of the file. */
static nurbs_status save(const nurbs_hull *hull, const char *path)
{
    const double up[3] = {0, 0, nurbs_hull_level(hull)};
    nurbs_patches *moved = NULL;
    nurbs_status status = nurbs_patches_transform(nurbs_hull_wetted(hull), NULL, up, &moved);
    if (status == NURBS_OK)
        status = nurbs_patches_set_length(moved, nurbs_hull_lpp(hull));
    if (status == NURBS_OK)
        status = nurbs_patches_write(moved, path);
    nurbs_patches_free(moved);
    return status;
}

static int report(const char *output, const nurbs_hull *hull, bool json)
{
    const nurbs_patches *wetted = nurbs_hull_wetted(hull);
    const nurbs_surface *first = nurbs_patches_get(wetted, 0);
    size_t patches = nurbs_patches_count(wetted), points = 0;
    for (size_t k = 0; k < patches; k++)
        points += nurbs_surface_size(nurbs_patches_get(wetted, k), 0) *
                  nurbs_surface_size(nurbs_patches_get(wetted, k), 1);
    if (json)
        return print_json(
            json_pack("{s:s,s:I,s:[I,I],s:I,s:f,s:s,s:o}", "file", output, "patches",
                      (json_int_t)patches, "size", (json_int_t)nurbs_surface_size(first, 0),
                      (json_int_t)nurbs_surface_size(first, 1), "control_points",
                      (json_int_t)points, "deviation", nurbs_hull_deviation(hull), "note",
                      nurbs_hull_step(hull, 0), "warnings", hull_steps(hull)));
    printf("%s: %zu patch%s, %zu control points, at most %.3g m from the hull\n", output, patches,
           patches == 1 ? "" : "es", points, nurbs_hull_deviation(hull));
    return CLI_OK;
}

static int run(int argc, char **argv)
{
    nurbs_hull_options hull_options;
    nurbs_hull *hull = NULL;
    const char *output = NULL;
    bool json = false;
    nurbs_hull_options_init(&hull_options);
    hull_options.simplify = 0;
    hull_options.cut = 1e-4;
    const tool_option options[] = {{"level", OPTION_NUMBER, &hull_options.level, 0, 0},
                                   {"tolerance", OPTION_LENGTH, &hull_options.cut, 0, 0},
                                   {"output", OPTION_OUTPUT, &output, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code == CLI_OK)
        code = load_hull(argv[optind], &hull_options, &hull);
    if (code == CLI_OK && save(hull, output) != NURBS_OK)
        code = library_failure();
    if (code == CLI_OK)
        code = report(output, hull, json);
    nurbs_hull_free(hull);
    return code;
}

const subcommand wetted_command = {
    "wetted", "cut a hull at the still water", run,
    "usage: nurbs wetted FILE -o FILE [options]\n"
    "  The surfaces of a hull below a level; what was cut runs from the waterline, v = 0, down.\n"
    "  --level Z      height of the water surface (0)\n"
    "  --tolerance T  metres the surface may move (1e-4)\n"
    "  -o, --output FILE\n"};
