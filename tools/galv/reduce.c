#include "reduce.h"

#include "cli.h"
#include "commands.h"
#include "hull.h"
#include "model_file.h"

#include <stdio.h>
#include <stdlib.h>

/* Samples that settle the weights of appended quantities. */
enum { PILOT = 500 };

/* Everything a run holds. */
struct reduction {
    struct hull hull;
    double *weights, *extra_weights;
    struct shape_definition definition;
    galv_shape *shape;
    struct cli_table samples, rows;
    galv_moment_set set;
    galv_extra extra;
    galv_model *model;
};

static void reduction_free(struct reduction *r)
{
    hull_free(&r->hull);
    free(r->weights);
    free(r->extra_weights);
    shape_definition_free(&r->definition);
    galv_shape_free(r->shape);
    cli_table_free(&r->samples);
    cli_table_free(&r->rows);
    galv_model_free(r->model);
}

static bool load_hull(const struct reduce_options *options, struct reduction *r)
{
    if (!hull_read(options->hull, options->sections, options->girth, &r->hull))
        return false;
    bool grid = r->hull.sections >= 2 && r->hull.girth >= 2;
    if ((options->area_weights || options->moments) && !grid) {
        cli_fail("%s: area weights and moments need the columns i,j of a full grid", options->hull);
        return false;
    }
    if (!options->area_weights)
        return true;
    r->weights = malloc(r->hull.npoints * sizeof *r->weights);
    if (!r->weights) {
        cli_fail("out of memory");
        return false;
    }
    if (galv_grid_weights(r->hull.sections, r->hull.girth, r->hull.xyz, r->weights)) {
        cli_fail("%s: %s", options->hull, galv_last_error());
        return false;
    }
    return true;
}

static bool load_shape(const struct reduce_options *options, struct reduction *r)
{
    if (!shape_definition_read(options->shape, r->hull.npoints, r->hull.xyz, &r->definition))
        return false;
    if (shape_definition_create(&r->definition, &r->shape)) {
        cli_fail("%s: %s", options->shape, galv_last_error());
        return false;
    }
    return true;
}

/* The parameter vectors of a CSV file: as many columns as the shape has parameters. */
static bool load_samples(const struct reduce_options *options, struct reduction *r)
{
    size_t n = r->definition.n;
    if (!options->samples)
        return true;
    if (!cli_table_read(options->samples, &r->samples))
        return false;
    if (r->samples.columns == n && r->samples.rows > 0)
        return true;
    cli_fail("%s: %zu rows of %zu numbers, expected rows of %zu parameters", options->samples,
             r->samples.rows, r->samples.columns, n);
    return false;
}

static galv_sampling choose_sampling(const struct reduce_options *options,
                                     const struct reduction *r, size_t most)
{
    size_t count = options->samples ? r->samples.rows : options->random;
    count = count < most ? count : most;
    return options->samples ? galv_samples(count, r->samples.values)
                            : galv_uniform(count, options->seed);
}

static bool load_rows(const struct reduce_options *options, struct reduction *r)
{
    size_t samples = choose_sampling(options, r, SIZE_MAX).count;
    if (!options->rows)
        return true;
    if (!cli_table_read(options->rows, &r->rows))
        return false;
    if (r->rows.rows == samples && r->rows.columns > 0)
        return true;
    cli_fail("%s: %zu rows, expected one for each of the %zu samples", options->rows, r->rows.rows,
             samples);
    return false;
}

/* Moments, then given rows. */
static bool append_quantities(struct reduce_options *options, struct reduction *r)
{
    if (!options->moments && !options->rows)
        return true;
    r->set = options->set;
    r->set.sections = r->hull.sections;
    r->set.girth = r->hull.girth;
    if (options->moments && r->set.section_stride && r->set.section_first >= r->set.sections) {
        cli_fail("--section-moments: section %zu of a hull of %zu", r->set.section_first + 1,
                 r->set.sections);
        return false;
    }
    if (options->moments)
        r->extra = galv_moments_extra(&r->set);
    r->extra.given = r->rows.columns;
    r->extra.values = r->rows.values;
    r->extra.count += r->extra.given;
    r->extra_weights = malloc(r->extra.count * sizeof *r->extra_weights);
    if (!r->extra_weights) {
        cli_fail("out of memory");
        return false;
    }
    if (galv_extra_balance(r->shape, r->hull.npoints, r->hull.xyz,
                           choose_sampling(options, r, PILOT), &r->extra, options->share,
                           r->extra_weights)) {
        cli_fail("%s", galv_last_error());
        return false;
    }
    r->extra.weights = r->extra_weights;
    options->build.extra = &r->extra;
    return true;
}

static int show_progress(void *user_data, double fraction)
{
    cli_progress_update(user_data, fraction, "");
    return 0;
}

static bool build(struct reduce_options *options, struct reduction *r, double *seconds)
{
    struct cli_progress progress;
    cli_progress_start(&progress, "samples");
    options->build.weights = r->weights;
    options->build.progress = show_progress;
    options->build.progress_user_data = &progress;
    double start = cli_seconds();
    galv_status status =
        galv_build(r->shape, r->hull.npoints, r->hull.xyz, choose_sampling(options, r, SIZE_MAX),
                   &options->build, &r->model);
    *seconds = cli_seconds() - start;
    cli_progress_end(&progress);
    if (status)
        cli_fail("%s", galv_last_error());
    return !status;
}

static bool write_model(const struct reduce_options *options, const struct reduction *r)
{
    if (!options->output)
        return true;
    struct model_file file = {.model = r->model,
                              .shape = r->definition,
                              .sections = r->hull.sections,
                              .girth = r->hull.girth,
                              .uniform = options->random > 0,
                              .seed = options->seed,
                              .drawn = options->random,
                              .moments = options->moments,
                              .set = r->set,
                              .rows = r->rows.columns};
    snprintf(file.hull, sizeof file.hull, "%s", options->hull);
    return model_file_write(options->output, &file);
}

int command_reduce(int argc, char **argv)
{
    struct reduce_options options;
    int result = reduce_parse(argc, argv, &options);
    if (result != -1)
        return result;
    if (options.threads)
        cli_set_threads(options.threads);
    struct reduction r = {.model = NULL};
    double seconds = 0;
    bool ok = load_hull(&options, &r) && load_shape(&options, &r) && load_samples(&options, &r) &&
              load_rows(&options, &r) && append_quantities(&options, &r) &&
              build(&options, &r, &seconds) && write_model(&options, &r);
    result = CLI_FAILED;
    if (ok)
        result = options.json ? reduce_print_json(r.model, &options, seconds)
                              : reduce_print_text(r.model, &options, seconds);
    reduction_free(&r);
    return result;
}
