#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parameters of one direction: those kept in the file when their number is the one asked for (or
 * none is asked for), else equal steps between the interpolation points. */
static double *choose_parameters(const nurbs_patches *patches, size_t index, int direction,
                                 size_t *n)
{
    const double *kept;
    size_t count = nurbs_patches_parameters(patches, index, direction, &kept);
    const nurbs_surface *surface = nurbs_patches_get(patches, index);
    size_t size = nurbs_surface_size(surface, direction);
    if (*n == 0)
        *n = count ? count : size;
    double *result = malloc(*n * sizeof *result), *greville = malloc(size * sizeof *greville);
    if (result && *n == count) {
        memcpy(result, kept, count * sizeof *result);
    } else if (result && greville) {
        nurbs_greville(nurbs_surface_degree(surface, direction), size,
                       nurbs_surface_knots(surface, direction), greville);
        for (size_t k = 0; k < *n; k++) {
            double at = (double)(size - 1) * (double)k / (double)(*n - 1);
            size_t i = at < (double)(size - 2) ? (size_t)at : size - 2;
            result[k] = greville[i] + (at - (double)i) * (greville[i + 1] - greville[i]);
        }
    }
    free(greville);
    return result;
}

static int sample(const nurbs_patches *patches, size_t index, size_t rows, size_t columns,
                  const char *output, bool json)
{
    double *u = choose_parameters(patches, index, 0, &rows),
           *v = choose_parameters(patches, index, 1, &columns);
    nurbs_grid *grid = NULL;
    int code = u && v ? CLI_OK : cli_fail("out of memory");
    if (code == CLI_OK && (nurbs_grid_sample(nurbs_patches_get(patches, index), rows, u, columns, v,
                                             &grid) != NURBS_OK ||
                           nurbs_grid_write(grid, output) != NURBS_OK))
        code = library_failure();
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:I,s:I}", "file", output, "rows", (json_int_t)rows,
                                    "columns", (json_int_t)columns));
    nurbs_grid_free(grid);
    free(u);
    free(v);
    return code;
}

static int run(int argc, char **argv)
{
    size_t rows = 0, columns = 0, index = 0;
    const char *output = NULL;
    bool json = false;
    const tool_option options[] = {{"rows", OPTION_COUNT, &rows, 2, 1000000},
                                   {"columns", OPTION_COUNT, &columns, 2, 1000000},
                                   PATCH_OPTION(&index),
                                   {"output", OPTION_OUTPUT, &output, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    const nurbs_surface *surface;
    code = load_surface(argv[optind], index, &patches, &surface);
    if (code == CLI_OK)
        code = sample(patches, index, rows, columns, output, json);
    nurbs_patches_free(patches);
    return code;
}

const subcommand grid_command = {
    "grid", "sample the design grid of a surface", run,
    "usage: nurbs grid FILE -o GRID.csv [options]\n"
    "  Points of one patch on a grid of parameters: those kept in the file by 'nurbs skin' and\n"
    "  'nurbs fit' when the numbers agree, else evenly between the Greville points.\n"
    "  --rows N       number of u parameters (as kept, or as control points)\n"
    "  --columns N    number of v parameters\n"
    "  --patch K      patch, counted from 0 (0)\n"
    "  -o, --output GRID.csv\n"};
