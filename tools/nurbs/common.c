#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>

int common_option(int letter, char **argv, bool *json)
{
    int threads;
    switch (letter) {
    case 'J':
        *json = true;
        return CLI_OK;
    case 'T':
        if (!cli_parse_int(optarg, &threads) || threads < 1)
            return cli_usage("--threads '%s': expected a number from 1", optarg);
        cli_set_threads(threads);
        return CLI_OK;
    case ':':
        return cli_usage("option '%s' needs a value", argv[optind - 1]);
    default:
        return cli_usage("unknown option '%s'", argv[optind - 1]);
    }
}

int number_option(const char *name, const char *text, double *value)
{
    if (!cli_parse_double(text, value))
        return cli_usage("--%s '%s': expected a number", name, text);
    return CLI_OK;
}

int length_option(const char *name, const char *text, double *value)
{
    if (!cli_parse_double(text, value) || !(*value > 0))
        return cli_usage("--%s '%s': expected a length > 0 in metres", name, text);
    return CLI_OK;
}

int operand_count(int argc, char **argv, int n, const char *what)
{
    if (argc - optind < n)
        return cli_usage("expected %s", what);
    if (argc - optind > n)
        return cli_usage("unexpected operand '%s', expected only %s", argv[optind + n], what);
    return CLI_OK;
}

int print_json(json_t *object)
{
    char *text = object ? json_dumps(object, JSON_REAL_PRECISION(17)) : NULL;
    json_decref(object);
    if (!text)
        return cli_fail("a result cannot be written as JSON");
    printf("%s\n", text);
    free(text);
    return fflush(stdout) == EOF ? cli_fail("standard output cannot be written") : CLI_OK;
}

int library_failure(void)
{
    return cli_fail("%s", nurbs_last_error());
}

int load_patches(const char *path, nurbs_patches **patches)
{
    return nurbs_patches_read(path, patches) == NURBS_OK ? CLI_OK : library_failure();
}

int load_surface(const char *path, size_t index, nurbs_patches **patches,
                 const nurbs_surface **surface)
{
    int code = load_patches(path, patches);
    if (code != CLI_OK)
        return code;
    *surface = nurbs_patches_get(*patches, index);
    return *surface ? CLI_OK
                    : cli_fail("%s: no patch %zu, the file has %zu (counted from 0)", path, index,
                               nurbs_patches_count(*patches));
}

int save_surface(const nurbs_surface *surface, const nurbs_patches *from, const char *path)
{
    nurbs_patches *patches;
    nurbs_status status = nurbs_patches_create(&patches);
    if (status == NURBS_OK)
        status = nurbs_patches_add(patches, surface);
    if (status == NURBS_OK && from)
        status = nurbs_patches_set_length(patches, nurbs_patches_length(from));
    if (status == NURBS_OK && from)
        status = nurbs_patches_set_note(patches, nurbs_patches_note(from));
    if (status == NURBS_OK)
        status = nurbs_patches_write(patches, path);
    int code = status == NURBS_OK ? CLI_OK : library_failure();
    nurbs_patches_free(patches);
    return code;
}

int grid_deviation(const nurbs_surface *surface, const nurbs_grid *grid, const double *u,
                   const double *v, double *worst)
{
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    const double *expected = nurbs_grid_points(grid);
    nurbs_grid *sampled;
    if (nurbs_grid_sample(surface, rows, u, columns, v, &sampled) != NURBS_OK)
        return library_failure();
    const double *points = nurbs_grid_points(sampled);
    *worst = 0;
    for (size_t k = 0; k < 3 * rows * columns; k += 3) {
        double square = 0;
        for (size_t c = k; c < k + 3; c++)
            square += (points[c] - expected[c]) * (points[c] - expected[c]);
        *worst = fmax(*worst, sqrt(square));
    }
    nurbs_grid_free(sampled);
    return CLI_OK;
}
