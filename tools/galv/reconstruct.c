#include "cli.h"
#include "commands.h"
#include "hull.h"
#include "latent_rows.h"
#include "use.h"

#include <stdlib.h>

static const char help[] =
    "usage: galv reconstruct MODEL (--latent u1,u2,... | --parameters x1,x2,...) [-o GRID.csv]\n"
    "\n"
    "Writes the hull of a latent point, or of parameters, as a grid i,j,x,y,z (standard output "
    "unless\n"
    "-o is given). Numbers left out are 0; instead of numbers the name of a CSV file with one "
    "row.\n";

static galv_status displacement(const struct use *use, const double *row, double *d)
{
    const galv_model *model = use->file.model;
    if (use->latent)
        return galv_reconstruct(model, row, d);
    galv_shape *shape = NULL;
    galv_status status = shape_definition_create(&use->file.shape, &shape);
    if (!status)
        status =
            galv_shape_displace(shape, galv_model_points(model), galv_model_parent(model), row, d);
    galv_shape_free(shape);
    return status;
}

static int reconstruct(const struct use *use)
{
    const galv_model *model = use->file.model;
    size_t points = galv_model_points(model);
    size_t width = use->latent ? galv_model_modes(model) : galv_model_parameters(model);
    struct rows rows;
    if (!rows_read(use->latent ? use->latent : use->parameters, width, use->latent ? "u" : "x",
                   &rows))
        return CLI_FAILED;
    int result = CLI_FAILED;
    double *d = malloc(galv_model_coordinates(model) * sizeof *d);
    if (rows.count != 1)
        cli_fail("%zu rows, expected one", rows.count);
    else if (!d)
        cli_fail("out of memory");
    else if (displacement(use, rows.values, d))
        cli_fail("%s", galv_last_error());
    else {
        struct hull hull = {
            .npoints = points, .sections = use->file.sections, .girth = use->file.girth};
        for (size_t i = 0; i < 3 * points; i++)
            d[i] += galv_model_parent(model)[i];
        if (hull_write(use->output ? use->output : "-", &hull, d))
            result = CLI_OK;
    }
    free(d);
    rows_free(&rows);
    return result;
}

int command_reconstruct(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, USE_LATENT | USE_PARAMETERS | USE_OUTPUT, &use);
    if (result != -1)
        return result;
    result = !use.latent == !use.parameters ? cli_usage("give either --latent or --parameters")
                                            : reconstruct(&use);
    use_free(&use);
    return result;
}
