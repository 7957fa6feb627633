#include "nurbs_tool.h"

static int run(int argc, char **argv)
{
    double level = 0, tolerance = 1e-4;
    size_t index = 0;
    const char *output = NULL;
    bool json = false;
    const tool_option options[] = {{"level", OPTION_NUMBER, &level, 0, 0},
                                   {"tolerance", OPTION_LENGTH, &tolerance, 0, 0},
                                   PATCH_OPTION(&index),
                                   {"output", OPTION_OUTPUT, &output, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    const nurbs_surface *hull;
    nurbs_surface *wetted = NULL;
    code = load_surface(argv[optind], index, &patches, &hull);
    if (code == CLI_OK && nurbs_surface_wetted(hull, level, tolerance, &wetted) != NURBS_OK)
        code = library_failure();
    if (code == CLI_OK)
        code = save_surface(wetted, patches, output);
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:[I,I]}", "file", output, "size",
                                    (json_int_t)nurbs_surface_size(wetted, 0),
                                    (json_int_t)nurbs_surface_size(wetted, 1)));
    nurbs_surface_free(wetted);
    nurbs_patches_free(patches);
    return code;
}

const subcommand wetted_command = {
    "wetted", "cut a hull at the still water", run,
    "usage: nurbs wetted FILE -o FILE [options]\n"
    "  The part of one patch below a level, re-parametrised so that v = 0 is the waterline.\n"
    "  --level Z      height of the water surface (0)\n"
    "  --tolerance T  metres the surface may move (1e-4)\n"
    "  --patch K      patch, counted from 0 (0)\n"
    "  -o, --output FILE\n"};
