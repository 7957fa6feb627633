#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>

/* How far the cut surface is from the hull, on `SHARES` places a knot span and direction, and how
 * far its control points reach above the level, which bounds the surface. */
static int check_cut(const nurbs_surface *hull, const nurbs_surface *wetted, double level,
                     double *deviation, double *above)
{
    enum { SHARES = 3 };
    size_t n[2], count = 0;
    double *t[2] = {NULL, NULL};
    *deviation = 0;
    *above = -INFINITY;
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(wetted, d);
        size_t size = nurbs_surface_size(wetted, d);
        t[d] = malloc(SHARES * size * sizeof(double));
        n[d] = 0;
        for (size_t k = (size_t)nurbs_surface_degree(wetted, d); k < size && t[d]; k++)
            for (int i = 0; i < SHARES && knots[k + 1] > knots[k]; i++)
                t[d][n[d]++] = knots[k] + (knots[k + 1] - knots[k]) * (i + 0.4) / SHARES;
        count = d ? count * n[d] : n[d];
    }
    double *points = malloc(6 * (count + 1) * sizeof *points), *uv = points + 3 * count,
           *away = uv + 2 * count;
    int code = t[0] && t[1] && points ? CLI_OK : cli_fail("out of memory");
    if (code == CLI_OK &&
        (nurbs_surface_eval_grid(wetted, 0, n[0], t[0], n[1], t[1], points) != NURBS_OK ||
         nurbs_surface_closest(hull, count, points, uv, away) != NURBS_OK))
        code = library_failure();
    for (size_t k = 0; k < count && code == CLI_OK; k++)
        *deviation = fmax(*deviation, away[k]);
    const double *net = nurbs_surface_points(wetted);
    for (size_t k = 0; k < nurbs_surface_size(wetted, 0) * nurbs_surface_size(wetted, 1); k++)
        *above = fmax(*above, net[3 * k + 2] - level);
    free(t[0]);
    free(t[1]);
    free(points);
    return code;
}

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
    double deviation = 0, above = 0;
    if (code == CLI_OK)
        code = check_cut(hull, wetted, level, &deviation, &above);
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:[I,I],s:f,s:f}", "file", output, "size",
                                    (json_int_t)nurbs_surface_size(wetted, 0),
                                    (json_int_t)nurbs_surface_size(wetted, 1), "deviation",
                                    deviation, "above", above));
    else if (code == CLI_OK)
        printf("%s: %zu x %zu control points, at most %.3g m from the hull (sampled), none more "
               "than %.3g m above the level\n",
               output, nurbs_surface_size(wetted, 0), nurbs_surface_size(wetted, 1), deviation,
               fmax(above, 0));
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
