#include "json_result.h"
#include "nurbs_tool.h"

#include <math.h>
#include <string.h>
#include <strings.h>

/* warnings: NULL unless json; taken over. */
static int report(const char *path, const nurbs_hydrostatics *h, const char *note, json_t *warnings,
                  bool json)
{
    if (json)
        return print_json(json_pack(
            "{s:s,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:o,s:f,s:f,s:f,s:f,s:f,s:f,s:s,s:o}",
            "file", path, "volume", h->volume, "wetted_area", h->wetted_area, "lcb", h->centroid[0],
            "vcb", h->centroid[2], "waterplane_area", h->waterplane_area, "lcf",
            h->waterplane_centre, "waterplane_inertia_x", h->waterplane_inertia_x,
            "waterplane_inertia_y", h->waterplane_inertia_y, "beam", h->beam, "draft", h->draft,
            "keel_draft", isfinite(h->keel_draft) ? json_real(h->keel_draft) : json_null(), "x_aft",
            h->x_aft, "x_fore", h->x_fore, "transom_area", h->transom_area, "section_area_max",
            h->section_area_max, "section_area_max_x", h->section_area_max_x, "error", h->error,
            "note", note, "warnings", warnings));
    printf("%s: %s (metres; both sides; z from the still water)\n", path, note);
    printf("  displaced volume       %.8g\n  wetted area            %.8g\n", h->volume,
           h->wetted_area);
    printf("  centre of buoyancy     x %.8g, z %.8g\n", h->centroid[0], h->centroid[2]);
    printf("  waterplane area        %.8g, centre x %.8g\n", h->waterplane_area,
           h->waterplane_centre);
    printf("  waterplane inertia     about x %.8g, about y %.8g\n", h->waterplane_inertia_x,
           h->waterplane_inertia_y);
    printf("  waterline              x %.8g ... %.8g, beam %.8g\n", h->x_aft, h->x_fore, h->beam);
    printf("  draft                  %.8g, keel amidships ", h->draft);
    if (isfinite(h->keel_draft))
        printf("%.8g\n", h->keel_draft);
    else
        printf("none\n");
    printf("  immersed transom area  %.8g\n", h->transom_area);
    printf("  largest section        %.8g at x %.8g\n", h->section_area_max, h->section_area_max_x);
    printf("  relative error         %.1e (quadrature)\n", h->error);
    return CLI_OK;
}

/* Triangles as they are, cut exactly at the level. */
static int report_mesh(const char *path, double unit, double level, bool json)
{
    nurbs_mesh *mesh = NULL;
    nurbs_hydrostatics h;
    char note[80], doubt[256] = "";
    int code = CLI_OK;
    if (nurbs_mesh_read(path, unit, &mesh) != NURBS_OK)
        return library_failure();
    if (nurbs_mesh_hydrostatics(mesh, level, &h) != NURBS_OK ||
        nurbs_mesh_doubt(mesh, level, &h, sizeof doubt, doubt) != NURBS_OK)
        code = cli_fail("%s: %s", path, nurbs_last_error());
    snprintf(note, sizeof note, "%zu triangles cut at z = %g m", nurbs_mesh_triangles(mesh), level);
    h.centroid[2] -= level;
    if (*doubt)
        fprintf(stderr, "%s: %s: %s\n", cli_name(), path, doubt);
    json_t *warnings = json ? json_array() : NULL;
    if (json && *doubt)
        json_result_append(warnings, json_string(doubt));
    if (code == CLI_OK)
        code = report(path, &h, note, warnings, json);
    else
        json_decref(warnings);
    nurbs_mesh_free(mesh);
    return code;
}

static bool is_mesh(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && (strcasecmp(dot, ".stl") == 0 || strcasecmp(dot, ".obj") == 0);
}

static int run(int argc, char **argv)
{
    nurbs_hull_options hull_options;
    nurbs_hull *hull = NULL;
    bool json = false;
    double unit = 1;
    nurbs_hull_options_init(&hull_options);
    hull_options.simplify = 0;
    const tool_option options[] = {{"level", OPTION_NUMBER, &hull_options.level, 0, 0},
                                   {"tolerance", OPTION_LENGTH, &hull_options.cut, 0, 0},
                                   {"unit", OPTION_LENGTH, &unit, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code == CLI_OK && is_mesh(argv[optind]))
        return report_mesh(argv[optind], unit, hull_options.level, json);
    if (code == CLI_OK)
        code = load_hull(argv[optind], &hull_options, &hull);
    if (code == CLI_OK)
        code = report(argv[optind], nurbs_hull_hydrostatics(hull), nurbs_hull_step(hull, 0),
                      json ? hull_steps(hull) : NULL, json);
    nurbs_hull_free(hull);
    return code;
}

const subcommand hydrostatics_command = {
    "hydrostatics", "volume, areas and centres below the still water", run,
    "usage: nurbs hydrostatics FILE [options]\n"
    "  Hydrostatics of both sides. Surfaces that reach above the level are cut there; faces that "
    "are\n"
    "  no hull are left out, and what was done to the file is told on stderr.\n"
    "  --level Z      height of the water surface (0)\n"
    "  --tolerance T  metres the cut surface may move (1e-5 of the extent in x)\n"
    "  FILE may be triangles (.stl, .obj), which are cut as they are, or an offset table.\n"
    "  --unit U       metres of a unit of such triangles: 0.001 for millimetres (1)\n"};
