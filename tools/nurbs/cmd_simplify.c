#include "json_result.h"
#include "nurbs_tool.h"

static int simplify_all(const nurbs_patches *patches, double tolerance, bool geometric,
                        const char *output, bool json)
{
    nurbs_patches *light = NULL;
    json_t *sizes = json_array();
    double worst = 0;
    nurbs_status status = start_patches(patches, &light);
    for (size_t k = 0; k < nurbs_patches_count(patches) && status == NURBS_OK; k++) {
        nurbs_surface *surface = NULL;
        double bound = 0;
        const nurbs_surface *full = nurbs_patches_get(patches, k);
        if (geometric)
            status = nurbs_surface_simplify_geometric(full, tolerance, NURBS_SIMPLIFY_KEEP_EDGES,
                                                      &surface, &bound);
        else
            status = nurbs_surface_simplify(full, tolerance,
                                            NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY,
                                            &surface, &bound);
        /* The geometric mode has a parametrisation of its own. */
        if (status == NURBS_OK)
            status = geometric ? nurbs_patches_add(light, surface)
                               : add_with_parameters(surface, patches, k, light);
        if (status == NURBS_OK) {
            worst = bound > worst ? bound : worst;
            json_result_append(sizes, json_pack("[I,I]", (json_int_t)nurbs_surface_size(surface, 0),
                                                (json_int_t)nurbs_surface_size(surface, 1)));
            if (!json)
                printf("patch %zu: %zu x %zu -> %zu x %zu control points, moved at most %.3g m\n",
                       k, nurbs_surface_size(nurbs_patches_get(patches, k), 0),
                       nurbs_surface_size(nurbs_patches_get(patches, k), 1),
                       nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1), bound);
        }
        nurbs_surface_free(surface);
    }
    if (status == NURBS_OK)
        status = nurbs_patches_write(light, output);
    int code = status == NURBS_OK ? CLI_OK : library_failure();
    if (code == CLI_OK && json)
        code =
            print_json(json_pack("{s:s,s:O,s:f}", "file", output, "sizes", sizes, "bound", worst));
    json_decref(sizes);
    nurbs_patches_free(light);
    return code;
}

static int run(int argc, char **argv)
{
    double tolerance = 0;
    const char *output = NULL;
    bool geometric = false, json = false;
    const tool_option options[] = {{"tolerance", OPTION_LENGTH, &tolerance, 0, 0},
                                   {"geometric", OPTION_FLAG, &geometric, 0, 0},
                                   {"output", OPTION_OUTPUT, &output, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code == CLI_OK && !(tolerance > 0))
        code = cli_usage("no tolerance: give --tolerance T");
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    code = load_patches(argv[optind], &patches);
    if (code == CLI_OK)
        code = simplify_all(patches, tolerance, geometric, output, json);
    nurbs_patches_free(patches);
    return code;
}

const subcommand simplify_command = {
    "simplify", "drop control points within a certified tolerance", run,
    "usage: nurbs simplify FILE --tolerance T -o FILE [--geometric]\n"
    "  Removes knots of every patch while it moves by less than T metres; edges in coordinate\n"
    "  planes stay in them.\n"
    "  --tolerance T  metres\n"
    "  --geometric    keep the shape rather than the parametrisation: evens out wobbling\n"
    "                 parameters first; slower, fewer points on uneven surfaces\n"
    "  -o, --output FILE\n"};
