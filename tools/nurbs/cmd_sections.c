/* The sections of any hull, and the surface through them. */
#include "nurbs_tool.h"

#include <string.h>

static bool is_grid(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot && strcmp(dot, ".csv") == 0;
}

/* The points of the design grid, or the hull's one surface, by extension. */
static int save(const nurbs_hull *hull, const nurbs_grid *grid, const char *note,
                const char *output)
{
    nurbs_status status =
        is_grid(output) ? nurbs_grid_write(grid, output) : nurbs_hull_write(hull, note, output);
    return status == NURBS_OK ? CLI_OK : library_failure();
}

static int make(const char *path, const nurbs_hull_options *options, size_t rows, size_t columns,
                const char *output, bool json)
{
    nurbs_hull *hull = NULL;
    nurbs_grid *grid = NULL;
    int code = load_hull(path, options, &hull);
    if (code == CLI_OK && nurbs_hull_design_grid(hull, rows, columns, &grid) != NURBS_OK)
        code = cli_fail("%s: %s", path, nurbs_last_error());
    if (code == CLI_OK)
        code = save(hull, grid, path, output);
    if (code == CLI_OK && json)
        code = print_json(json_pack(
            "{s:s,s:I,s:I,s:o}", "file", output, "sections", (json_int_t)nurbs_grid_rows(grid),
            "points", (json_int_t)nurbs_grid_columns(grid), "warnings", hull_steps(hull)));
    else if (code == CLI_OK)
        printf("%s: %zu sections of %zu points\n", output, nurbs_grid_rows(grid),
               nurbs_grid_columns(grid));
    nurbs_grid_free(grid);
    nurbs_hull_free(hull);
    return code;
}

static int run(int argc, char **argv)
{
    nurbs_hull_options hull;
    const char *output = NULL;
    size_t rows = 0, columns = 0;
    bool json = false;
    nurbs_hull_options_init(&hull);
    hull.single = true;
    const tool_option options[] = {{"rows", OPTION_COUNT, &rows, 2, 1000000},
                                   {"columns", OPTION_COUNT, &columns, 2, 1000000},
                                   {"tolerance", OPTION_LENGTH, &hull.sections, 0, 0},
                                   {"level", OPTION_NUMBER, &hull.level, 0, 0},
                                   {"lpp", OPTION_LENGTH, &hull.length, 0, 0},
                                   {"output", OPTION_OUTPUT, &output, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code == CLI_OK && (rows || columns) && !is_grid(output))
        code = cli_usage("--rows and --columns: they divide the points of a grid, expected an "
                         "output in .csv, '%s' holds the surface",
                         output);
    return code == CLI_OK ? make(argv[optind], &hull, rows, columns, output, json) : code;
}

const subcommand sections_command = {
    "sections", "make one surface of any hull, through its sections", run,
    "usage: nurbs sections FILE -o OUT [options]\n"
    "  FILE: patches (.json .igs .step), triangles in metres (.stl .obj), an offset table\n"
    "  (.offsets.csv), stations (.stations) or a grid (.csv). Many patches and triangles are cut "
    "by\n"
    "  sheets that follow stem and stern, each section is ordered from deck to keel with its\n"
    "  corners, and one surface is passed through all of them. OUT: that surface, or the grid of\n"
    "  points on it (.csv), sections from small to large x.\n"
    "  --tolerance T  metres the surface may lie off the hull (5e-4 of its length); sections and\n"
    "                 points are added until it is kept\n"
    "  --rows N, --columns N   points of a grid in .csv (those that the surface was made from)\n"
    "  --level Z      height of the water surface (0)\n"
    "  --lpp L        reference length kept in OUT\n"};
