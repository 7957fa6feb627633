#include "nurbs_tool.h"

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
    nurbs_grid *grid = NULL;
    code = load_patches(argv[optind], &patches);
    if (code == CLI_OK &&
        nurbs_patches_design_grid(patches, index, rows, columns, &grid) != NURBS_OK)
        code = cli_fail("%s: %s", argv[optind], nurbs_last_error());
    if (code == CLI_OK && nurbs_grid_write(grid, output) != NURBS_OK)
        code = library_failure();
    if (code == CLI_OK && json)
        code = print_json(json_pack("{s:s,s:I,s:I}", "file", output, "rows",
                                    (json_int_t)nurbs_grid_rows(grid), "columns",
                                    (json_int_t)nurbs_grid_columns(grid)));
    nurbs_grid_free(grid);
    nurbs_patches_free(patches);
    return code;
}

const subcommand grid_command = {
    "grid", "sample the design grid of a surface", run,
    "usage: nurbs grid FILE -o GRID.csv [options]\n"
    "  Points of one patch on a grid of parameters: those kept in the file by 'nurbs skin' and\n"
    "  'nurbs fit' when the numbers agree, else evenly between the Greville points. FILE may be\n"
    "  triangles (.stl .obj) or an offset table: the points are those of its one surface.\n"
    "  --rows N       number of u parameters (as kept, or as control points)\n"
    "  --columns N    number of v parameters\n"
    "  --patch K      patch, counted from 0 (0)\n"
    "  -o, --output GRID.csv\n"};
