#include "nurbs_tool.h"

#include <math.h>

/* Smallest and largest coordinates of the control points. */
static void bounding_box(const nurbs_surface *surface, double box[6])
{
    const double *p = nurbs_surface_points(surface);
    size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    for (size_t c = 0; c < 3; c++) {
        box[c] = INFINITY;
        box[3 + c] = -INFINITY;
        for (size_t k = 0; k < n; k++) {
            box[c] = fmin(box[c], p[3 * k + c]);
            box[3 + c] = fmax(box[3 + c], p[3 * k + c]);
        }
    }
}

static size_t distinct_spans(const nurbs_surface *surface, int direction)
{
    const double *knots = nurbs_surface_knots(surface, direction);
    size_t spans = 0, size = nurbs_surface_size(surface, direction);
    for (size_t k = (size_t)nurbs_surface_degree(surface, direction); k < size; k++)
        spans += knots[k + 1] > knots[k];
    return spans;
}

static int describe(const nurbs_patches *patches, size_t index, bool json, json_t *list)
{
    const nurbs_surface *surface = nurbs_patches_get(patches, index);
    int degree[2] = {nurbs_surface_degree(surface, 0), nurbs_surface_degree(surface, 1)};
    size_t size[2] = {nurbs_surface_size(surface, 0), nurbs_surface_size(surface, 1)};
    const char *kind = nurbs_surface_weights(surface) ? "rational" : "polynomial";
    double box[6], area, error;
    const double *unused;
    bounding_box(surface, box);
    if (nurbs_surface_area(surface, &area, &error) != NURBS_OK)
        return library_failure();
    size_t rows = nurbs_patches_parameters(patches, index, 0, &unused),
           columns = nurbs_patches_parameters(patches, index, 1, &unused);
    if (json) {
        json_array_append_new(
            list,
            json_pack("{s:[i,i],s:[I,I],s:[I,I],s:s,s:[f,f,f],s:[f,f,f],s:f,s:f,s:[I,I]}", "degree",
                      degree[0], degree[1], "size", (json_int_t)size[0], (json_int_t)size[1],
                      "spans", (json_int_t)distinct_spans(surface, 0),
                      (json_int_t)distinct_spans(surface, 1), "kind", kind, "low", box[0], box[1],
                      box[2], "high", box[3], box[4], box[5], "area", area, "area_error", error,
                      "design_grid", (json_int_t)rows, (json_int_t)columns));
        return CLI_OK;
    }
    printf("patch %zu: degree %d x %d, %zu x %zu control points, %zu x %zu spans, %s\n", index,
           degree[0], degree[1], size[0], size[1], distinct_spans(surface, 0),
           distinct_spans(surface, 1), kind);
    printf("  control points within x %.6g ... %.6g, y %.6g ... %.6g, z %.6g ... %.6g m\n", box[0],
           box[3], box[1], box[4], box[2], box[5]);
    printf("  area %.8g m^2 (relative error %.1e)\n", area, error);
    if (rows > 0)
        printf("  design grid of %zu x %zu parameters\n", rows, columns);
    return CLI_OK;
}

static int run(int argc, char **argv)
{
    static const struct option options[] = {COMMON_OPTIONS, END_OF_OPTIONS};
    bool json = false;
    int letter, code = CLI_OK;
    while (code == CLI_OK && (letter = getopt_long(argc, argv, ":", options, NULL)) != -1)
        code = common_option(letter, argv, &json);
    if (code == CLI_OK)
        code = operand_count(argc, argv, 1, "one NURBS file");
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    code = load_patches(argv[optind], &patches);
    if (code != CLI_OK)
        return code;
    size_t count = nurbs_patches_count(patches);
    json_t *list = json_array();
    if (!json) {
        printf("%s: %zu patch%s", argv[optind], count, count == 1 ? "" : "es");
        if (nurbs_patches_length(patches) > 0)
            printf(", reference length %.6g m", nurbs_patches_length(patches));
        printf("\n");
        if (*nurbs_patches_note(patches))
            printf("note: %s\n", nurbs_patches_note(patches));
    }
    for (size_t k = 0; k < count && code == CLI_OK; k++)
        code = describe(patches, k, json, list);
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:f,s:s,s:O}", "file", argv[optind], "lpp",
                                    nurbs_patches_length(patches), "note",
                                    nurbs_patches_note(patches), "patches", list));
    json_decref(list);
    nurbs_patches_free(patches);
    return code;
}

const subcommand info_command = {"info", "describe the patches of a file", run,
                                 "usage: nurbs info FILE\n"
                                 "  Degrees, sizes, extents and areas of the patches of a file.\n"};
