#include "json_result.h"
#include "nurbs_tool.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { REPORT_SIZE = 4000 };

static int read_number(const tool_option *option, const char *text)
{
    double value;
    if (!cli_parse_double(text, &value))
        return cli_usage("--%s '%s': expected a number", option->name, text);
    if (option->kind == OPTION_LENGTH && !(value > 0))
        return cli_usage("--%s '%s': expected a length > 0 in metres", option->name, text);
    *(double *)option->value = value;
    return CLI_OK;
}

static int read_count(const tool_option *option, const char *text)
{
    size_t value;
    if (!cli_parse_size(text, &value) || value < option->least || value > option->most)
        return cli_usage("--%s '%s': expected a number from %zu to %zu", option->name, text,
                         option->least, option->most);
    *(size_t *)option->value = value;
    return CLI_OK;
}

static int read_option(const tool_option *option, const char *text)
{
    switch (option->kind) {
    case OPTION_NUMBER:
    case OPTION_LENGTH:
        return read_number(option, text);
    case OPTION_COUNT:
        return read_count(option, text);
    case OPTION_FLAG:
        *(bool *)option->value = true;
        return CLI_OK;
    default:
        *(const char **)option->value = text;
        return CLI_OK;
    }
}

/* Letters of getopt_long; the own options count from OWN. */
enum { JSON_LETTER = 'J', THREADS_LETTER = 'T', OUTPUT_LETTER = 'o', OWN = 256, MOST_OPTIONS = 16 };

static int read_letter(int letter, char **argv, const tool_option *own, bool *json)
{
    int threads;
    switch (letter) {
    case JSON_LETTER:
        *json = true;
        return CLI_OK;
    case THREADS_LETTER:
        if (!cli_parse_int(optarg, &threads) || threads < 1)
            return cli_usage("--threads '%s': expected a number from 1", optarg);
        cli_set_threads(threads);
        return CLI_OK;
    case ':':
        return cli_usage("option '%s' needs a value", argv[optind - 1]);
    case '?':
        return cli_usage("unknown option '%s'", argv[optind - 1]);
    default:
        return read_option(own + (letter - OWN), optarg);
    }
}

static int check_operands(int argc, char **argv, const operands *wanted)
{
    if (argc - optind < wanted->least)
        return cli_usage("expected %s", wanted->what);
    if (argc - optind > wanted->most)
        return cli_usage("unexpected operand '%s', expected only %s", argv[optind + wanted->most],
                         wanted->what);
    return CLI_OK;
}

int parse_options(int argc, char **argv, size_t n, const tool_option *own, operands wanted,
                  bool *json)
{
    struct option options[MOST_OPTIONS + 3] = {
        {"json", no_argument, NULL, JSON_LETTER},
        {"threads", required_argument, NULL, THREADS_LETTER}};
    const tool_option *output = NULL;
    for (size_t k = 0; k < n; k++) {
        options[k + 2] = (struct option){
            own[k].name, own[k].kind == OPTION_FLAG ? no_argument : required_argument, NULL,
            OWN + (int)k};
        if (own[k].kind == OPTION_OUTPUT)
            output = &own[k];
    }
    int letter, code = CLI_OK;
    while (code == CLI_OK &&
           (letter = getopt_long(argc, argv, output ? ":o:" : ":", options, NULL)) != -1) {
        if (letter == OUTPUT_LETTER)
            letter = OWN + (int)(output - own);
        code = read_letter(letter, argv, own, json);
    }
    if (code == CLI_OK)
        code = check_operands(argc, argv, &wanted);
    if (code == CLI_OK && output && !*(const char **)output->value)
        code = cli_usage("no output file: give -o FILE");
    return code;
}

int print_json(json_t *object)
{
    return json_result_print(object, JSON_REAL_PRECISION(17));
}

int library_failure(void)
{
    return cli_fail("%s", nurbs_last_error());
}

bool is_skinned(const char *path)
{
    static const char *const extensions[] = {".stl", ".obj", ".csv", ".stations"};
    const char *dot = strrchr(path, '.');
    for (size_t k = 0; dot && k < sizeof extensions / sizeof *extensions; k++)
        if (strcasecmp(dot, extensions[k]) == 0)
            return true;
    return false;
}

int load_patches(const char *path, nurbs_patches **patches)
{
    char report[REPORT_SIZE];
    nurbs_status status =
        is_skinned(path) ? nurbs_hull_read_patches(path, NAN, patches, report, sizeof report)
                         : nurbs_patches_read_reported(path, 0, patches, report, sizeof report);
    if (status != NURBS_OK)
        return library_failure();
    if (*report)
        fprintf(stderr, "%s: %s: %s\n", cli_name(), path, report);
    return CLI_OK;
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

nurbs_status start_patches(const nurbs_patches *from, nurbs_patches **patches)
{
    nurbs_status status = nurbs_patches_create(patches);
    if (status == NURBS_OK && from)
        status = nurbs_patches_set_length(*patches, nurbs_patches_length(from));
    if (status == NURBS_OK && from)
        status = nurbs_patches_set_note(*patches, nurbs_patches_note(from));
    return status;
}

nurbs_status add_with_parameters(const nurbs_surface *surface, const nurbs_patches *from,
                                 size_t index, nurbs_patches *patches)
{
    const double *u, *v;
    size_t rows = nurbs_patches_parameters(from, index, 0, &u),
           columns = nurbs_patches_parameters(from, index, 1, &v);
    nurbs_status status = nurbs_patches_add(patches, surface);
    return status == NURBS_OK ? nurbs_patches_set_parameters(
                                    patches, nurbs_patches_count(patches) - 1, rows, u, columns, v)
                              : status;
}

int save_surface(const nurbs_surface *surface, const nurbs_patches *from, const char *path)
{
    nurbs_patches *patches = NULL;
    nurbs_status status = start_patches(from, &patches);
    if (status == NURBS_OK)
        status = nurbs_patches_add(patches, surface);
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
