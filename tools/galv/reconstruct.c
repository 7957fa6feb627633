#include "arguments.h"
#include "cli.h"
#include "commands.h"
#include "hull.h"
#include "json_result.h"

#include <stdlib.h>

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    arguments_either(source, "latent", a->latent, "parameters", a->parameters);
}

static const struct setting ROWS[] = {
    OPTION_MODEL,
    OPTION_LATENT,
    OPTION_PARAMETERS,
    OPTION("output", TEXT, output, .letter = 'o',
           .sentence = "a grid i,j,x,y,z; by default standard output"),
    OPTION_JSON,
};

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage = "usage: galv reconstruct MODEL (--latent LIST|U.csv | --parameters LIST|X.csv) [-o "
             "GRID.csv]\n"
             "\n"
             "Writes the hull of a latent point, or of parameters, as a grid. With --json the "
             "figures of the "
             "point\n"
             "are printed, and without -o its points x, y, z.\n\n"};

static galv_status displacement(const struct arguments *a, const double *row, double *d)
{
    const galv_model *model = a->file.model;
    if (a->latent)
        return galv_reconstruct(model, row, d);
    galv_shape *shape = NULL;
    galv_status status = shape_definition_create(&a->file.shape, &shape);
    if (!status)
        status =
            galv_shape_displace(shape, galv_model_points(model), galv_model_parent(model), row, d);
    galv_shape_free(shape);
    return status;
}

/* The points, unless they are in a file, with what the latent point is like. */
static int print_json(struct arguments *a, const double *u, const struct hull *hull,
                      const double *xyz)
{
    double radius, nearest;
    json_t *root = json_pack("{s:o,s:o,s:o}", "elements", json_whole(hull->npoints), "sections",
                             json_whole(hull->sections), "girth", json_whole(hull->girth));
    if (u && !galv_latent_distance(a->file.model, u, &radius, &nearest)) {
        json_result_set(root, "radius", json_number(radius));
        json_result_set(root, "nearest", json_number(nearest));
    }
    if (a->output) {
        json_result_set(root, "file", json_string(a->output));
        return json_print(root, &a->warnings);
    }
    json_t *points = json_array();
    for (size_t p = 0; p < hull->npoints; p++)
        json_result_append(points, json_numbers(3, xyz + 3 * p));
    json_result_set(root, "points", points);
    return json_print(root, &a->warnings);
}

static int write_hull(struct arguments *a, const double *row, double *d)
{
    const galv_model *model = a->file.model;
    const struct hull hull = {
        .npoints = galv_model_points(model), .sections = a->file.sections, .girth = a->file.girth};
    if (displacement(a, row, d))
        return cli_fail("%s", galv_last_error());
    for (size_t i = 0; i < 3 * hull.npoints; i++)
        d[i] += galv_model_parent(model)[i];
    if ((a->output || !a->json) && !hull_write(a->output ? a->output : "-", &hull, d))
        return CLI_FAILED;
    return a->json ? print_json(a, a->latent ? row : NULL, &hull, d) : CLI_OK;
}

int command_reconstruct(int argc, char **argv)
{
    struct arguments a;
    struct rows rows = {.values = NULL};
    int code = arguments_read(argc, argv, &TABLE, &a);
    if (code != -1)
        return code;
    const galv_model *model = a.file.model;
    double *d = malloc(galv_model_coordinates(model) * sizeof *d);
    bool ok = (d || cli_refuse("out of memory")) && (a.latent || arguments_have_parameters(&a)) &&
              (a.latent ? rows_read(a.latent, galv_model_modes(model), "u", &rows)
                        : rows_read(a.parameters, galv_model_parameters(model), "x", &rows)) &&
              (rows.count == 1 || cli_refuse("%zu rows, expected one", rows.count));
    if (ok && a.parameters)
        rows_check_bounds(&rows, "--parameters", &a.file.shape, &a.warnings);
    code = ok ? write_hull(&a, rows.values, d) : CLI_FAILED;
    free(d);
    rows_free(&rows);
    arguments_free(&a);
    return code;
}
