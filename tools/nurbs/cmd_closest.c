/* Points to parameters, planes to lines. */
#include "json_result.h"
#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A table of numbers as CSV, or as one JSON object {"NAME": [[...], ...]} with fields named like
 * the columns. */
static int print_rows(const char *header, size_t rows, size_t columns, const double *values,
                      bool json)
{
    if (json) {
        json_t *list = json_array();
        for (size_t k = 0; k < rows; k++) {
            json_t *row = json_array();
            for (size_t c = 0; c < columns; c++)
                json_result_append(row, json_real(values[k * columns + c]));
            json_result_append(list, row);
        }
        return print_json(json_pack("{s:s,s:o}", "columns", header, "rows", list));
    }
    printf("%s\n", header);
    for (size_t k = 0; k < rows; k++)
        for (size_t c = 0; c < columns; c++)
            printf("%.17g%c", values[k * columns + c], c + 1 < columns ? ',' : '\n');
    return cli_printed();
}

/* Columns of the result: x, y, z, patch, u, v, distance. */
enum { X, PATCH = 3, U, V, DISTANCE, COLUMNS };

/* Puts in the rows what patch `index` offers where it is nearer than the patches before. */
static nurbs_status improve(const nurbs_surface *surface, size_t index, size_t n,
                            const double *points, double *rows)
{
    double *uv = malloc(3 * n * sizeof *uv), *away = uv + 2 * n;
    if (!uv)
        return NURBS_ERROR_MEMORY;
    nurbs_status status = nurbs_surface_closest(surface, n, points, uv, away);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        double *row = rows + COLUMNS * k;
        if (!(away[k] < row[DISTANCE]))
            continue;
        row[PATCH] = (double)index;
        row[U] = uv[2 * k];
        row[V] = uv[2 * k + 1];
        row[DISTANCE] = away[k];
    }
    free(uv);
    return status;
}

static int find_closest(const nurbs_patches *patches, const struct cli_table *table,
                        const char *path, bool json)
{
    const int at[3] = {cli_table_column(table, "x"), cli_table_column(table, "y"),
                       cli_table_column(table, "z")};
    size_t n = table->rows;
    if (at[0] < 0 || at[1] < 0 || at[2] < 0)
        return cli_fail("%s: expected columns x, y and z", path);
    double *points = malloc((3 + COLUMNS) * (n + 1) * sizeof *points), *rows = points + 3 * (n + 1);
    if (!points)
        return cli_fail("out of memory");
    for (size_t k = 0; k < n; k++) {
        for (size_t c = 0; c < 3; c++)
            rows[COLUMNS * k + X + c] = points[3 * k + c] =
                table->values[k * table->columns + (size_t)at[c]];
        rows[COLUMNS * k + DISTANCE] = INFINITY;
    }
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < nurbs_patches_count(patches) && status == NURBS_OK; k++)
        status = improve(nurbs_patches_get(patches, k), k, n, points, rows);
    int code = status == NURBS_OK ? CLI_OK : library_failure();
    if (code == CLI_OK)
        code = print_rows("x,y,z,patch,u,v,distance", n, COLUMNS, rows, json);
    free(points);
    return code;
}

static int run_closest(int argc, char **argv)
{
    const char *at = NULL;
    bool json = false;
    const tool_option options[] = {{"at", OPTION_TEXT, &at, 0, 0}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code == CLI_OK && !at)
        code = cli_usage("no points: give --at XYZ.csv ('-' reads standard input)");
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    struct cli_table table = {0};
    code = load_patches(argv[optind], &patches);
    if (code == CLI_OK && !cli_table_read(at, &table))
        code = CLI_FAILED;
    if (code == CLI_OK)
        code = find_closest(patches, &table, at, json);
    cli_table_free(&table);
    nurbs_patches_free(patches);
    return code;
}

const subcommand closest_command = {
    "closest", "find the nearest points of a body", run_closest,
    "usage: nurbs closest FILE --at XYZ.csv\n"
    "  Reads points (CSV with header x,y,z; '-' is standard input), prints for each the patch and\n"
    "  parameters of the nearest point and its distance: x,y,z,patch,u,v,distance.\n"};

/* Columns of a cut: patch, line, u, v, x, y, z. */
enum { CUT_COLUMNS = 7 };

typedef struct cut_rows {
    size_t count, lines;
    double *row;
} cut_rows;

static int append_lines(const nurbs_contour *contour, size_t patch, cut_rows *all)
{
    size_t n = contour->lines ? contour->first[contour->lines] : 0;
    double *larger = realloc(all->row, CUT_COLUMNS * (all->count + n + 1) * sizeof *larger);
    if (!larger)
        return cli_fail("out of memory");
    all->row = larger;
    for (size_t line = 0; line < contour->lines; line++, all->lines++)
        for (size_t k = contour->first[line]; k < contour->first[line + 1]; k++) {
            double *row = all->row + CUT_COLUMNS * all->count++;
            row[0] = (double)patch;
            row[1] = (double)all->lines;
            memcpy(row + 2, contour->uv + 2 * k, 2 * sizeof *row);
            memcpy(row + 4, contour->points + 3 * k, 3 * sizeof *row);
        }
    return CLI_OK;
}

static int cut(const nurbs_patches *patches, const double normal[3], double offset, size_t parts,
               bool json)
{
    cut_rows all = {0};
    int code = CLI_OK;
    for (size_t k = 0; k < nurbs_patches_count(patches) && code == CLI_OK; k++) {
        nurbs_contour contour;
        if (nurbs_surface_contour(nurbs_patches_get(patches, k), normal, offset, (int)parts,
                                  &contour) != NURBS_OK) {
            code = library_failure();
            break;
        }
        code = append_lines(&contour, k, &all);
        nurbs_contour_free(&contour);
    }
    if (code == CLI_OK && all.count == 0)
        code = cli_fail("the plane does not cross the body");
    if (code == CLI_OK)
        code = print_rows("patch,line,u,v,x,y,z", all.count, CUT_COLUMNS, all.row, json);
    free(all.row);
    return code;
}

static int run_cut(int argc, char **argv)
{
    const char *plane = NULL;
    size_t parts = 4;
    bool json = false;
    const tool_option options[] = {{"plane", OPTION_TEXT, &plane, 0, 0},
                                   {"parts", OPTION_COUNT, &parts, 1, 64}};
    double normal[3] = {0, 0, 0}, offset = 0;
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code == CLI_OK && (!plane || !strchr("xyz", plane[0]) || plane[0] == '\0' ||
                           plane[1] != '=' || !cli_parse_double(plane + 2, &offset)))
        code = cli_usage("--plane '%s': expected x=A, y=A or z=A", plane ? plane : "");
    if (code != CLI_OK)
        return code;
    normal[plane[0] - 'x'] = 1;
    nurbs_patches *patches = NULL;
    code = load_patches(argv[optind], &patches);
    if (code == CLI_OK)
        code = cut(patches, normal, offset, parts, json);
    nurbs_patches_free(patches);
    return code;
}

const subcommand cut_command = {
    "cut", "print the lines in which a plane cuts a body", run_cut,
    "usage: nurbs cut FILE --plane x=A|y=A|z=A [options]\n"
    "  Sections, buttocks and waterlines: points on both plane and body, to rounding, as\n"
    "  patch,line,u,v,x,y,z; a closed line repeats its first point.\n"
    "  --parts N      cells a knot span and direction that are searched; smaller islands are\n"
    "                 missed (4)\n"};
