#include "nurbs_tool.h"

static int simplify_all(const nurbs_patches *patches, double tolerance, const char *output,
                        bool json)
{
    nurbs_patches *light = NULL;
    json_t *sizes = json_array();
    double worst = 0;
    nurbs_status status = nurbs_patches_create(&light);
    for (size_t k = 0; k < nurbs_patches_count(patches) && status == NURBS_OK; k++) {
        nurbs_surface *surface = NULL;
        double bound = 0;
        status = nurbs_surface_simplify(nurbs_patches_get(patches, k), tolerance,
                                        NURBS_KEEP_EDGES | NURBS_THRIFTY, &surface, &bound);
        if (status == NURBS_OK)
            status = nurbs_patches_add(light, surface);
        if (status == NURBS_OK) {
            worst = bound > worst ? bound : worst;
            json_array_append_new(sizes,
                                  json_pack("[I,I]", (json_int_t)nurbs_surface_size(surface, 0),
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
        status = nurbs_patches_set_note(light, nurbs_patches_note(patches));
    if (status == NURBS_OK)
        status = nurbs_patches_set_length(light, nurbs_patches_length(patches));
    for (size_t k = 0; k < nurbs_patches_count(patches) && status == NURBS_OK; k++) {
        const double *u, *v;
        size_t rows = nurbs_patches_parameters(patches, k, 0, &u),
               columns = nurbs_patches_parameters(patches, k, 1, &v);
        status = nurbs_patches_set_parameters(light, k, rows, u, columns, v);
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
    static const struct option options[] = {{"tolerance", required_argument, NULL, 't'},
                                            {"output", required_argument, NULL, 'o'},
                                            COMMON_OPTIONS,
                                            END_OF_OPTIONS};
    double tolerance = 0;
    const char *output = NULL;
    bool json = false;
    int letter, code = CLI_OK;
    while (code == CLI_OK && (letter = getopt_long(argc, argv, ":o:", options, NULL)) != -1)
        switch (letter) {
        case 't':
            code = length_option("tolerance", optarg, &tolerance);
            break;
        case 'o':
            output = optarg;
            break;
        default:
            code = common_option(letter, argv, &json);
        }
    if (code == CLI_OK)
        code = operand_count(argc, argv, 1, "one NURBS file");
    if (code == CLI_OK && !(tolerance > 0))
        code = cli_usage("no tolerance: give --tolerance T");
    if (code == CLI_OK && !output)
        code = cli_usage("no output file: give -o FILE");
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    code = load_patches(argv[optind], &patches);
    if (code == CLI_OK)
        code = simplify_all(patches, tolerance, output, json);
    nurbs_patches_free(patches);
    return code;
}

const subcommand simplify_command = {
    "simplify", "drop control points within a certified tolerance", run,
    "usage: nurbs simplify FILE --tolerance T -o FILE\n"
    "  Removes knots of every patch while it moves by less than T metres; edges in coordinate\n"
    "  planes stay in them.\n"
    "  --tolerance T  metres\n"
    "  -o, --output FILE\n"};
