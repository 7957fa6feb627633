#include "json_result.h"
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
        json_result_append(
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

static const char *const side_names[4] = {"first u", "last u", "first v", "last v"};

/* Whether an edge of a half body lies in the centre plane, where the other half takes over. */
static bool in_centre_plane(const nurbs_patches *patches, const nurbs_edge *edge, double tolerance)
{
    const nurbs_surface *surface = nurbs_patches_get(patches, edge->patch);
    const double *p = nurbs_surface_points(surface);
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    bool within = true;
    for (size_t k = 0; k < (edge->side < 2 ? nv : nu); k++) {
        size_t at = edge->side < 2 ? (edge->side == 0 ? 0 : nu - 1) * nv + k
                                   : k * nv + (edge->side == 2 ? 0 : nv - 1);
        within &= fabs(p[3 * at + 1]) <= tolerance;
    }
    return within;
}

static void print_topology(const nurbs_patches *patches, const nurbs_topology *t, double tolerance)
{
    printf("edges within %.3g m of each other: %zu shared, largest gap %.3g m; ", tolerance,
           t->joints, t->gap);
    if (t->inconsistent > 0)
        printf("the orientation changes at %zu of them\n", t->inconsistent);
    else
        printf("one orientation\n");
    for (size_t k = 0; k < t->joints; k++) {
        const nurbs_joint *j = &t->joint[k];
        printf("  patch %zu %s - patch %zu %s: %.6g m, gap %.3g m%s\n", j->edge[0] / 4,
               side_names[j->edge[0] % 4], j->edge[1] / 4, side_names[j->edge[1] % 4], j->length,
               j->gap, j->consistent ? "" : ", normals differ");
    }
    for (size_t k = 0; k < t->edges; k++) {
        const nurbs_edge *e = &t->edge[k];
        if (e->collapsed)
            printf("  patch %zu %s: a point\n", e->patch, side_names[e->side]);
        else if (e->length - e->joined > 10 * tolerance)
            printf("  patch %zu %s: %.6g m free%s\n", e->patch, side_names[e->side],
                   e->length - e->joined,
                   in_centre_plane(patches, e, tolerance) ? ", in the centre plane" : "");
    }
}

static json_t *pack_topology(const nurbs_patches *patches, const nurbs_topology *t,
                             double tolerance)
{
    json_t *joints = json_array(), *edges = json_array();
    for (size_t k = 0; k < t->joints; k++) {
        const nurbs_joint *j = &t->joint[k];
        json_result_append(
            joints, json_pack("{s:[I,I],s:[s,s],s:[[f,f],[f,f]],s:f,s:f,s:b}", "patches",
                              (json_int_t)(j->edge[0] / 4), (json_int_t)(j->edge[1] / 4), "edges",
                              side_names[j->edge[0] % 4], side_names[j->edge[1] % 4], "ranges",
                              j->from[0], j->to[0], j->from[1], j->to[1], "length", j->length,
                              "gap", j->gap, "consistent", j->consistent));
    }
    for (size_t k = 0; k < t->edges; k++) {
        const nurbs_edge *e = &t->edge[k];
        json_result_append(edges,
                           json_pack("{s:I,s:s,s:f,s:f,s:b,s:b}", "patch", (json_int_t)e->patch,
                                     "edge", side_names[e->side], "length", e->length, "free",
                                     fmax(e->length - e->joined, 0), "collapsed", e->collapsed,
                                     "centre_plane", in_centre_plane(patches, e, tolerance)));
    }
    return json_pack("{s:f,s:f,s:I,s:o,s:o}", "tolerance", tolerance, "gap", t->gap, "inconsistent",
                     (json_int_t)t->inconsistent, "shared", joints, "edges", edges);
}

/* A ten-thousandth of the largest extent: edges that CAD systems take for one are closer, and few
 * details of a hull are that small. */
static double default_tolerance(const nurbs_patches *patches)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY},
           extent = 0;
    for (size_t k = 0; k < nurbs_patches_count(patches); k++) {
        double box[6];
        bounding_box(nurbs_patches_get(patches, k), box);
        for (int c = 0; c < 3; c++) {
            low[c] = fmin(low[c], box[c]);
            high[c] = fmax(high[c], box[3 + c]);
        }
    }
    for (int c = 0; c < 3; c++)
        extent = fmax(extent, high[c] - low[c]);
    return extent > 0 ? 1e-4 * extent : 1e-4;
}

static void print_heading(const char *path, const nurbs_patches *patches)
{
    size_t count = nurbs_patches_count(patches);
    printf("%s: %zu patch%s", path, count, count == 1 ? "" : "es");
    if (nurbs_patches_length(patches) > 0)
        printf(", reference length %.6g m", nurbs_patches_length(patches));
    printf("\n");
    if (*nurbs_patches_note(patches))
        printf("note: %s\n", nurbs_patches_note(patches));
}

/* What every command makes of the file as a hull, with the call that mends what is wrong: sentences
 * about it, or why it is refused. */
static int judge(const char *path, bool json, json_t **verdict)
{
    nurbs_hull_options options;
    nurbs_hull *hull = NULL;
    const char *step;
    nurbs_hull_options_init(&options);
    options.simplify = 0;
    nurbs_status status = nurbs_hull_read(path, &options, &hull);
    if (status != NURBS_OK && status != NURBS_ERROR_GEOMETRY && status != NURBS_ERROR_NUMERIC)
        return library_failure();
    const char *first = hull ? nurbs_hull_step(hull, 0) : nurbs_last_error();
    if (json)
        *verdict = json_pack("{s:b,s:s,s:o}", "taken", hull != NULL, "note", first, "warnings",
                             hull_steps(hull));
    else {
        printf("as a hull: %s%s\n", hull ? "" : "refused: ", first);
        for (size_t k = 1; (step = nurbs_hull_step(hull, k)); k++)
            printf("  %s\n", step);
    }
    nurbs_hull_free(hull);
    return CLI_OK;
}

static int inform(const char *path, const nurbs_patches *patches, double tolerance, bool json)
{
    nurbs_topology topology;
    json_t *list = json_array(), *verdict = NULL;
    int code = CLI_OK;
    if (nurbs_patches_topology(patches, tolerance, &topology) != NURBS_OK)
        code = library_failure();
    if (code == CLI_OK && !json)
        print_heading(path, patches);
    for (size_t k = 0; k < nurbs_patches_count(patches) && code == CLI_OK; k++)
        code = describe(patches, k, json, list);
    if (code == CLI_OK && !json)
        print_topology(patches, &topology, tolerance);
    if (code == CLI_OK)
        code = judge(path, json, &verdict);
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:f,s:s,s:O,s:o,s:o}", "file", path, "lpp",
                                    nurbs_patches_length(patches), "note",
                                    nurbs_patches_note(patches), "patches", list, "topology",
                                    pack_topology(patches, &topology, tolerance), "hull", verdict));
    json_decref(list);
    nurbs_topology_free(&topology);
    return code;
}

static int run(int argc, char **argv)
{
    double tolerance = 0;
    bool json = false;
    const tool_option options[] = {{"tolerance", OPTION_LENGTH, &tolerance, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    code = load_patches(argv[optind], &patches);
    if (code == CLI_OK)
        code = inform(argv[optind], patches, tolerance > 0 ? tolerance : default_tolerance(patches),
                      json);
    nurbs_patches_free(patches);
    return code;
}

const subcommand info_command = {
    "info", "describe the patches of a file", run,
    "usage: nurbs info FILE [options]\n"
    "  Degrees, sizes, extents and areas of the patches of a file; shared edges with their\n"
    "  gaps, free edges, and whether all normals are on one side. Then what every command makes\n"
    "  of the file as a hull, and the call of 'nurbs clean' that mends what is wrong with it.\n"
    "  --tolerance T  metres within which edges run together (1e-4 of the largest extent)\n"};
