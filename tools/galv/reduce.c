#include "reduce.h"

#include "cli.h"
#include "commands.h"
#include "hull_grid.h"
#include "shape_yaml.h"

#include <stdlib.h>

struct hull {
    double *xyz, *weights;
    size_t npoints, sections, girth;
};

static bool read_hull(const struct reduce_options *options, struct hull *hull)
{
    *hull = (struct hull){0};
    if (!hull_grid_read(options->hull, &hull->xyz, &hull->npoints, &hull->sections, &hull->girth))
        return false;
    if (!options->area_weights)
        return true;
    if (hull->sections < 2 || hull->girth < 2) {
        cli_fail("%s: area weights need the columns i,j of a full grid", options->hull);
        return false;
    }
    hull->weights = malloc(hull->npoints * sizeof *hull->weights);
    if (!hull->weights) {
        cli_fail("out of memory");
        return false;
    }
    if (galv_grid_weights(hull->sections, hull->girth, hull->xyz, hull->weights)) {
        cli_fail("%s: %s", options->hull, galv_last_error());
        return false;
    }
    return true;
}

/* The parameter vectors of a CSV file: as many columns as the shape has parameters. */
static bool read_samples(const char *path, size_t n, struct cli_table *table)
{
    if (!cli_table_read(path, table))
        return false;
    if (table->columns == n && table->rows > 0)
        return true;
    cli_fail("%s: %zu rows of %zu numbers, expected rows of %zu parameters", path, table->rows,
             table->columns, n);
    cli_table_free(table);
    return false;
}

static int show_progress(void *context, double fraction)
{
    cli_progress_update(context, fraction, "");
    return 0;
}

static int reduce(struct reduce_options *options, const struct hull *hull, const galv_shape *shape)
{
    struct cli_table table = {0};
    galv_sampling sampling = galv_uniform(options->random, options->seed);
    if (options->samples) {
        if (!read_samples(options->samples, galv_shape_parameters(shape), &table))
            return CLI_FAILED;
        sampling = galv_samples(table.rows, table.values);
    }
    struct cli_progress progress;
    cli_progress_start(&progress, "samples");
    options->build.weights = hull->weights;
    options->build.progress = show_progress;
    options->build.progress_context = &progress;
    galv_model *model = NULL;
    double start = cli_seconds();
    galv_status status =
        galv_build(shape, hull->npoints, hull->xyz, sampling, &options->build, &model);
    double seconds = cli_seconds() - start;
    cli_progress_end(&progress);
    int result = CLI_FAILED;
    if (status)
        cli_fail("%s", galv_last_error());
    else
        result = options->json ? reduce_print_json(model, options, seconds)
                               : reduce_print_text(model, seconds);
    galv_model_free(model);
    cli_table_free(&table);
    return result;
}

int command_reduce(int argc, char **argv)
{
    struct reduce_options options;
    int result = reduce_parse(argc, argv, &options);
    if (result != -1)
        return result;
    if (options.threads)
        cli_set_threads(options.threads);
    struct hull hull;
    galv_shape *shape = NULL;
    if (read_hull(&options, &hull))
        shape = shape_yaml_read(options.shape, hull.npoints, hull.xyz);
    result = shape ? reduce(&options, &hull, shape) : CLI_FAILED;
    galv_shape_free(shape);
    free(hull.xyz);
    free(hull.weights);
    return result;
}
