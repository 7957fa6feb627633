#include "cli.h"
#include "commands.h"
#include "hull.h"
#include "latent_rows.h"
#include "results.h"
#include "use.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: galv project MODEL (--hull GRID.csv | --parameters LIST|X.csv) [--json]\n"
    "\n"
    "Prints the latent coordinates u1, u2, ... of a hull with as many points as the model's, or "
    "of\n"
    "parameter vectors, with\n"
    "\n"
    "  distance  root mean square distance of the points from the latent space, metres\n"
    "  radius    sqrt(sum u_k^2 / lambda_k)\n"
    "  nearest   the same distance to the nearest sample\n";

/* Latent coordinates and the three figures of one displacement; d: all coordinates, the moments yet
 * to be filled. */
static bool project(const struct model_file *file, double *d, double *u, double *figures)
{
    const galv_model *model = file->model;
    size_t points = galv_model_points(model), length = galv_model_coordinates(model);
    galv_moment_set set;
    galv_extra extra = model_file_extra(file, &set);
    double *back = malloc(length * sizeof *back), square = 0;
    bool ok =
        back && (extra.count == 0 ||
                 !galv_extra_change(&extra, points, galv_model_parent(model), d, d + 3 * points));
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

static int print(const struct use *use, size_t rows, const double *u, const double *figures)
{
    static const char *const names[] = {"distance", "radius", "nearest"};
    return results_print(use->json, rows, "u", galv_model_modes(use->file.model), u, 3, names,
                         figures);
}

static int project_hull(const struct use *use)
{
    const galv_model *model = use->file.model;
    const double *parent = galv_model_parent(model);
    size_t points = galv_model_points(model);
    struct hull hull;
    if (!hull_read(use->hull, use->file.sections, use->file.girth, &hull))
        return CLI_FAILED;
    int result = CLI_FAILED;
    double figures[3], *d = calloc(galv_model_coordinates(model), sizeof *d);
    double *u = malloc(galv_model_modes(model) * sizeof *u);
    if (hull.npoints != points)
        cli_fail("%s: %zu points, expected the %zu of the model", use->hull, hull.npoints, points);
    else if (!d || !u)
        cli_fail("out of memory");
    else {
        for (size_t i = 0; i < 3 * points; i++)
            d[i] = hull.xyz[i] - parent[i];
        if (project(&use->file, d, u, figures))
            result = print(use, 1, u, figures);
    }
    free(d);
    free(u);
    hull_free(&hull);
    return result;
}

static int project_parameters(const struct use *use)
{
    const galv_model *model = use->file.model;
    size_t n = galv_model_parameters(model), m = galv_model_modes(model);
    struct rows x;
    galv_shape *shape = NULL;
    if (!rows_read(use->parameters, n, "x", &x))
        return CLI_FAILED;
    int result = CLI_FAILED;
    double *d = calloc(galv_model_coordinates(model), sizeof *d);
    double *u = malloc(x.count * m * sizeof *u), *figures = malloc(3 * x.count * sizeof *figures);
    bool ok = d && u && figures;
    if (!ok)
        cli_fail("out of memory");
    else if (!(ok = !shape_definition_create(&use->file.shape, &shape)))
        cli_fail("%s", galv_last_error());
    for (size_t r = 0; ok && r < x.count; r++) {
        ok = !galv_shape_displace(shape, galv_model_points(model), galv_model_parent(model),
                                  x.values + r * n, d);
        if (!ok)
            cli_fail("row %zu: %s", r + 1, galv_last_error());
        ok = ok && project(&use->file, d, u + r * m, figures + 3 * r);
    }
    if (ok)
        result = print(use, x.count, u, figures);
    galv_shape_free(shape);
    free(d);
    free(u);
    free(figures);
    rows_free(&x);
    return result;
}

int command_project(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, USE_HULL | USE_PARAMETERS, &use);
    if (result != -1)
        return result;
    if (!use.hull == !use.parameters)
        result = cli_usage("give either --hull or --parameters");
    else
        result = use.hull ? project_hull(&use) : project_parameters(&use);
    use_free(&use);
    return result;
}
