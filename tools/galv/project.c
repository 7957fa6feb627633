#include "arguments.h"
#include "cli.h"
#include "commands.h"
#include "hull.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    arguments_either(source, "hull", a->hull, "parameters", a->parameters);
}

static const struct setting ROWS[] = {
    OPTION_MODEL,
    OPTION("hull", TEXT, hull, .sentence = "a hull with as many points as the model's"),
    OPTION_PARAMETERS,
    OPTION_JSON,
};

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage = "usage: galv project MODEL (--hull GRID.csv | --parameters LIST|X.csv) [--json]\n"
             "\n"
             "Prints the latent coordinates u1, u2, ... of a hull, or of parameter vectors, with\n"
             "\n"
             "  distance  root mean square distance of the points from the latent space, metres\n"
             "  radius    sqrt(sum u_k^2 / lambda_k)\n"
             "  nearest   the same distance to the nearest sample\n\n"};

/* Latent coordinates and the three figures of one displacement; d: all coordinates, the moments yet
 * to be filled. */
static bool project(const struct model_file *file, double *d, double *u, double *figures)
{
    const galv_model *model = file->model;
    size_t points = galv_model_points(model), length = galv_model_coordinates(model);
    galv_moment_set set;
    galv_extra extra;
    model_file_extra(file, &set, &extra);
    double *back = malloc(length * sizeof *back), square = 0;
    if (!back)
        return cli_refuse("out of memory");
    bool ok = extra.count == 0 ||
              !galv_extra_change(&extra, points, galv_model_parent(model), d, d + 3 * points);
    ok = ok && !galv_project(model, d, u) && !galv_reconstruct(model, u, back) &&
         !galv_latent_distance(model, u, &figures[1], &figures[2]);
    for (size_t i = 0; ok && i < 3 * points; i++)
        square += (d[i] - back[i]) * (d[i] - back[i]);
    figures[0] = sqrt(square / (double)points);
    free(back);
    if (!ok)
        cli_fail("%s", galv_last_error());
    return ok;
}

static int print(const struct arguments *a, size_t rows, const double *u, const double *figures)
{
    static const char *const names[] = {"distance", "radius", "nearest"};
    const struct table table = {rows, galv_model_modes(a->file.model), 3, "u", names, u, figures};
    return table_print(&table, a->json, &a->warnings);
}

static bool project_hull(const struct arguments *a, double *u, double *figures)
{
    const galv_model *model = a->file.model;
    const double *parent = galv_model_parent(model);
    size_t points = galv_model_points(model);
    struct hull hull;
    if (!hull_read(a->hull, a->file.sections, a->file.girth, &hull))
        return false;
    double *d = calloc(galv_model_coordinates(model), sizeof *d);
    bool ok = hull.npoints == points || cli_refuse("%s: %zu points, expected the %zu of the model",
                                                   a->hull, hull.npoints, points);
    ok = ok && (d || cli_refuse("out of memory"));
    for (size_t i = 0; ok && i < 3 * points; i++)
        d[i] = hull.xyz[i] - parent[i];
    ok = ok && project(&a->file, d, u, figures);
    free(d);
    hull_free(&hull);
    return ok;
}

static bool project_parameters(const struct arguments *a, const struct rows *x, double *u,
                               double *figures)
{
    const galv_model *model = a->file.model;
    size_t m = galv_model_modes(model);
    galv_shape *shape = NULL;
    double *d = calloc(galv_model_coordinates(model), sizeof *d);
    bool ok =
        (d || cli_refuse("out of memory")) &&
        (!shape_definition_create(&a->file.shape, &shape) || cli_refuse("%s", galv_last_error()));
    for (size_t r = 0; ok && r < x->count; r++)
        ok = (!galv_shape_displace(shape, galv_model_points(model), galv_model_parent(model),
                                   x->values + r * x->width, d) ||
              cli_refuse("row %zu: %s", r + 1, galv_last_error())) &&
             project(&a->file, d, u + r * m, figures + 3 * r);
    galv_shape_free(shape);
    free(d);
    return ok;
}

int command_project(int argc, char **argv)
{
    struct arguments a;
    struct rows x = {.count = 1};
    int code = arguments_read(argc, argv, &TABLE, &a);
    if (code != -1)
        return code;
    const galv_model *model = a.file.model;
    bool ok = !a.parameters || (arguments_have_parameters(&a) &&
                                rows_read(a.parameters, galv_model_parameters(model), "x", &x));
    if (ok && a.parameters)
        rows_check_bounds(&x, "--parameters", &a.file.shape, &a.warnings);
    double *u = ok ? malloc(x.count * galv_model_modes(model) * sizeof *u) : NULL;
    double *figures = ok ? malloc(3 * x.count * sizeof *figures) : NULL;
    ok = ok && ((u && figures) || cli_refuse("out of memory")) &&
         (a.hull ? project_hull(&a, u, figures) : project_parameters(&a, &x, u, figures));
    code = ok ? print(&a, x.count, u, figures) : CLI_FAILED;
    free(u);
    free(figures);
    rows_free(&x);
    arguments_free(&a);
    return code;
}
