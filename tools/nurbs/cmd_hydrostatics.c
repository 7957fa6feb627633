#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>

static double highest_point(const nurbs_surface *surface)
{
    const double *p = nurbs_surface_points(surface);
    size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
    double top = -INFINITY;
    for (size_t k = 0; k < n; k++)
        top = fmax(top, p[3 * k + 2]);
    return top;
}

static int report(const char *path, const nurbs_hydrostatics *h, bool json)
{
    if (json)
        return print_json(
            json_pack("{s:s,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f,s:f}",
                      "file", path, "volume", h->volume, "wetted_area", h->wetted_area, "lcb",
                      h->centroid[0], "vcb", h->centroid[2], "waterplane_area", h->waterplane_area,
                      "lcf", h->waterplane_centre, "waterplane_inertia_x", h->waterplane_inertia_x,
                      "waterplane_inertia_y", h->waterplane_inertia_y, "beam", h->beam, "draft",
                      h->draft, "keel_draft", h->keel_draft, "x_aft", h->x_aft, "x_fore", h->x_fore,
                      "transom_area", h->transom_area, "section_area_max", h->section_area_max,
                      "section_area_max_x", h->section_area_max_x, "error", h->error));
    printf("%s (metres; both sides)\n", path);
    printf("  displaced volume       %.8g\n  wetted area            %.8g\n", h->volume,
           h->wetted_area);
    printf("  centre of buoyancy     x %.8g, z %.8g\n", h->centroid[0], h->centroid[2]);
    printf("  waterplane area        %.8g, centre x %.8g\n", h->waterplane_area,
           h->waterplane_centre);
    printf("  waterplane inertia     about x %.8g, about y %.8g\n", h->waterplane_inertia_x,
           h->waterplane_inertia_y);
    printf("  waterline              x %.8g ... %.8g, beam %.8g\n", h->x_aft, h->x_fore, h->beam);
    printf("  draft                  %.8g, keel amidships %.8g\n", h->draft, h->keel_draft);
    printf("  immersed transom area  %.8g\n", h->transom_area);
    printf("  largest section        %.8g at x %.8g\n", h->section_area_max, h->section_area_max_x);
    printf("  relative error         %.1e (quadrature)\n", h->error);
    return CLI_OK;
}

/* Cuts every patch that reaches above the level; those below stay as they are. */
static int wetted_patches(const nurbs_patches *patches, double level, double tolerance,
                          const nurbs_surface **wetted, nurbs_surface **cut)
{
    for (size_t k = 0; k < nurbs_patches_count(patches); k++) {
        wetted[k] = nurbs_patches_get(patches, k);
        if (highest_point(wetted[k]) <= level + 1e-9)
            continue;
        if (nurbs_surface_wetted(wetted[k], level, tolerance, &cut[k]) != NURBS_OK)
            return cli_fail("patch %zu: %s", k, nurbs_last_error());
        wetted[k] = cut[k];
    }
    return CLI_OK;
}

static int compute(const char *path, double level, double tolerance, bool json)
{
    nurbs_patches *patches = NULL;
    nurbs_hydrostatics h;
    int code = load_patches(path, &patches);
    if (code != CLI_OK)
        return code;
    size_t count = nurbs_patches_count(patches);
    const nurbs_surface **wetted = calloc(count, sizeof *wetted);
    nurbs_surface **cut = calloc(count, sizeof *cut);
    code = wetted && cut ? wetted_patches(patches, level, tolerance, wetted, cut)
                         : cli_fail("out of memory");
    if (code == CLI_OK && nurbs_hydrostatics_compute(count, wetted, level, &h) != NURBS_OK)
        code = library_failure();
    if (code == CLI_OK)
        code = report(path, &h, json);
    for (size_t k = 0; cut && k < count; k++)
        nurbs_surface_free(cut[k]);
    free(cut);
    free(wetted);
    nurbs_patches_free(patches);
    return code;
}

static int run(int argc, char **argv)
{
    double level = 0, tolerance = 1e-5;
    bool json = false;
    const tool_option options[] = {{"level", OPTION_NUMBER, &level, 0, 0},
                                   {"tolerance", OPTION_LENGTH, &tolerance, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    return code == CLI_OK ? compute(argv[optind], level, tolerance, json) : code;
}

const subcommand hydrostatics_command = {
    "hydrostatics", "volume, areas and centres below the still water", run,
    "usage: nurbs hydrostatics FILE [options]\n"
    "  Hydrostatics of a half hull (y >= 0), doubled: patches that reach above the level are cut.\n"
    "  --level Z      height of the water surface (0)\n"
    "  --tolerance T  metres the cut surface may move (1e-5)\n"};
