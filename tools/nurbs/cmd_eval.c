#include "json_result.h"
#include "nurbs_tool.h"

#include <stdlib.h>
#include <string.h>

#define POINT  "u,v,x,y,z"
#define FIRST  ",xu,yu,zu,xv,yv,zv"
#define SECOND ",xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv"

static const char *const headers[3] = {POINT, (POINT FIRST), (POINT FIRST SECOND)};

static void print_rows(size_t n, size_t triples, const double *uv, const double *values)
{
    for (size_t k = 0; k < n; k++) {
        printf("%.17g,%.17g", uv[2 * k], uv[2 * k + 1]);
        for (size_t c = 0; c < 3 * triples; c++)
            printf(",%.17g", values[3 * triples * k + c]);
        printf("\n");
    }
}

static int print_json_rows(size_t n, size_t triples, const double *uv, const double *values,
                           int order)
{
    json_t *rows = json_array();
    for (size_t k = 0; k < n; k++) {
        json_t *row = json_array();
        for (size_t c = 0; c < 2; c++)
            json_result_append(row, json_real(uv[2 * k + c]));
        for (size_t c = 0; c < 3 * triples; c++)
            json_result_append(row, json_real(values[3 * triples * k + c]));
        json_result_append(rows, row);
    }
    return print_json(json_pack("{s:s,s:o}", "columns", headers[order], "rows", rows));
}

static int evaluate(const nurbs_surface *surface, const struct cli_table *table, const char *path,
                    int order, bool json)
{
    int u = cli_table_column(table, "u"), v = cli_table_column(table, "v");
    if (u < 0 || v < 0)
        return cli_fail("%s: expected the columns u,v", path);
    size_t n = table->rows, triples = (size_t)NURBS_SURFACE_TRIPLES(order);
    double *uv = malloc((n + 1) * (2 + 3 * triples) * sizeof *uv), *values = uv + 2 * n;
    if (!uv)
        return cli_fail("out of memory");
    for (size_t k = 0; k < n; k++) {
        uv[2 * k] = table->values[k * table->columns + (size_t)u];
        uv[2 * k + 1] = table->values[k * table->columns + (size_t)v];
    }
    int code = CLI_OK;
    if (nurbs_surface_eval(surface, order, n, uv, values) != NURBS_OK) {
        code = cli_fail("%s: %s", path, nurbs_last_error());
    } else if (json) {
        code = print_json_rows(n, triples, uv, values, order);
    } else {
        printf("%s\n", headers[order]);
        print_rows(n, triples, uv, values);
        code = cli_printed();
    }
    free(uv);
    return code;
}

static int run(int argc, char **argv)
{
    size_t index = 0, order = 0;
    const char *at = NULL;
    bool json = false;
    const tool_option options[] = {PATCH_OPTION(&index),
                                   {"at", OPTION_TEXT, &at, 0, 0},
                                   {"derivatives", OPTION_COUNT, &order, 0, 2}};
    int code = parse_options(argc, argv, OPTION_COUNT_OF(options), options, one_file, &json);
    if (code == CLI_OK && !at)
        code = cli_usage("no parameters: give --at UV.csv ('-' reads standard input)");
    if (code != CLI_OK)
        return code;
    nurbs_patches *patches = NULL;
    const nurbs_surface *surface;
    struct cli_table table = {0};
    code = load_surface(argv[optind], index, &patches, &surface);
    if (code == CLI_OK && !cli_table_read(at, &table))
        code = CLI_FAILED;
    if (code == CLI_OK)
        code = evaluate(surface, &table, at, (int)order, json);
    cli_table_free(&table);
    nurbs_patches_free(patches);
    return code;
}

const subcommand eval_command = {
    "eval", "evaluate points and derivatives", run,
    "usage: nurbs eval FILE --at UV.csv [options]\n"
    "  Reads parameters (CSV with header u,v; '-' is standard input), prints u,v,x,y,z, then\n"
    "  xu,yu,zu,xv,yv,zv, then xuu,yuu,zuu,xuv,yuv,zuv,xvv,yvv,zvv with 17 digits.\n"
    "  --patch K      patch, counted from 0 (0)\n"
    "  --derivatives 0|1|2   highest order (0)\n"};
