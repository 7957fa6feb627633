#include "arguments.h"
#include "cli.h"
#include "commands.h"
#include "constants.h"
#include "hull.h"
#include "json_result.h"
#include "snapshots.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Samples that settle the weights of appended quantities. */
enum { PILOT = 500 };

static const struct setting_word WEIGHTS[] = {{"equal", 0}, {"area", 1}, {NULL, 0}};

static bool appends_moments(const struct arguments *a)
{
    return a->order_given || a->n_section;
}

static const char *choose_method(int method)
{
    return method <= GALV_METHOD_FACTORED ? method_name((galv_method)method) : NULL;
}

static const struct setting ROWS[] = {
    OPTION("hull", TEXT, hull,
           .sentence = "grid of points, CSV with the columns x,y,z and perhaps i,j, metres; or a "
                       "NURBS hull, JSON, sampled at its design grid"),
    OPTION("grid", COUNT, grid, .n_least = 2, .n_most = 2,
           .count = offsetof(struct arguments, n_grid), .least = 2, .most = 100000,
           .sentence = "SxG: sections x girth points to sample a NURBS hull at instead, or of "
                       "snapshots without a hull"),
    OPTION("shape", TEXT, shape, .sentence = "the modification, YAML"),
    OPTION("snapshots", TEXT, snapshots,
           .sentence = "in place of a modification variants of the hull: CSV, or HDF5 by its name "
                       "(.h5, .hdf5), with a row x,y,z,x,y,z,... of points for each; without "
                       "--hull their mean is the parent"),
    OPTION("dataset", TEXT, dataset, .otherwise = "snapshots", .sentence = "of an HDF5 file"),
    OPTION("displacements", SWITCH, displacements,
           .sentence = "the rows of snapshots are moves from the hull"),
    OPTION_RANDOM,
    OPTION("seed", COUNT, seed, .otherwise = "1",
           .sentence = "of the uniform draws and of the randomised method"),
    OPTION_SAMPLES,
    OPTION_VARIANCE,
    OPTION_KEPT,
    OPTION("spectrum", COUNT, spectrum, .least = 1, .most = 1e6, .otherwise = "64",
           .sentence = "report at least so many eigenvalues"),
    OPTION("centre", SWITCH, centre, .sentence = "subtract the mean of the samples"),
    OPTION("weights", CHOICE, area, .words = WEIGHTS, .otherwise = "equal",
           .sentence = "of the points; area: of the cells around each grid point"),
    OPTION("moments", COUNT, order, .given = offsetof(struct arguments, order_given), .least = 0,
           .most = 8,
           .sentence = "append the geometric moments of the hull up to this order; 0: the volume"),
    OPTION("section-moments", COUNT, section, .n_least = 3, .n_most = 3,
           .count = offsetof(struct arguments, n_section),
           .sentence = "ORDER:FIRST:STRIDE: append those of sections FIRST (1 is the first), FIRST "
                       "+ STRIDE, ... too, ORDER at most 8"),
    OPTION("rows", TEXT, rows,
           .sentence = "append other quantities, CSV with one line per sample and one column per "
                       "quantity, as changes from the parent"),
    OPTION("moment-share", NUMBER, share, .least = 0, .most = INFINITY, .open_least = true,
           .otherwise = "0.5",
           .sentence = "variance of all that is appended relative to that of the points; each "
                       "quantity is given the same part of it"),
    OPTION("method", CHOICE, method, .choice = choose_method, .otherwise = "auto",
           .sentence = "how the spectrum is found; factored: linear shapes"),
    OPTION("workspace", COUNT, workspace, .least = 1, .most = 1 << 24, .otherwise = "512",
           .sentence = "MiB for matrices and blocks of samples"),
    OPTION_WRITTEN,
    OPTION_JSON,
};

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    arguments_either(source, "shape", a->shape, "snapshots", a->snapshots);
    if (a->snapshots && (a->samples || a->random || a->rows || appends_moments(a)))
        settings_complain(source, "snapshots",
                          "takes no samples, no random draws and nothing that is appended");
    if (a->snapshots && a->displacements && !a->hull)
        settings_complain(source, "displacements", "needs --hull");
    if (!a->snapshots && !a->hull)
        settings_complain(source, "hull", "is missing");
    if (!a->snapshots)
        arguments_either(source, "samples", a->samples, "random", a->random);
    if (a->n_section && (a->section[0] > 8 || !a->section[1] || !a->section[2]))
        settings_complain(source, "section-moments",
                          "is %zu:%zu:%zu, expected ORDER:FIRST:STRIDE, such as 1:5:10, ORDER at "
                          "most 8",
                          a->section[0], a->section[1], a->section[2]);
}

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage = "usage: galv reduce --hull HULL --shape SHAPE.yaml (--samples X.csv | --random N) "
             "[OPTION]...\n"
             "       galv reduce --snapshots VARIANTS [--hull HULL] [OPTION]...\n"
             "\n"
             "Samples the modification on the points of the grid and finds the directions of "
             "greatest\n"
             "geometric variance.\n\n"};

/* Everything a run holds. */
struct reduction {
    struct arguments *a;
    struct hull hull;
    double *weights, *extra_weights;
    struct shape_definition definition;
    galv_shape *shape;
    struct rows samples;
    struct snapshots snapshots;
    struct cli_table rows;
    galv_moment_set set;
    galv_extra extra;
    galv_model *model;
    double seconds;
};

static void reduction_free(struct reduction *r)
{
    hull_free(&r->hull);
    free(r->weights);
    free(r->extra_weights);
    shape_definition_free(&r->definition);
    galv_shape_free(r->shape);
    rows_free(&r->samples);
    snapshots_free(&r->snapshots);
    cli_table_free(&r->rows);
    galv_model_free(r->model);
}

static bool load_hull(struct reduction *r)
{
    const struct arguments *a = r->a;
    if (!(a->snapshots ? snapshots_read(a, &r->hull, &r->snapshots)
                       : hull_read(a->hull, a->grid[0], a->grid[1], &r->hull)))
        return false;
    bool grid = r->hull.sections >= 2 && r->hull.girth >= 2;
    if ((a->area || appends_moments(a)) && !grid)
        return cli_refuse("%s: area weights and moments need a full grid (columns i,j, or --grid)",
                          a->hull ? a->hull : a->snapshots);
    if (!a->area)
        return true;
    r->weights = malloc(r->hull.npoints * sizeof *r->weights);
    if (!r->weights)
        return cli_refuse("out of memory");
    return !galv_grid_weights(r->hull.sections, r->hull.girth, r->hull.xyz, r->weights) ||
           cli_refuse("%s: %s", a->hull ? a->hull : a->snapshots, galv_last_error());
}

static bool load_shape(struct reduction *r)
{
    const struct shape_points points = hull_points(&r->hull);
    if (!r->a->shape)
        return true;
    return shape_definition_read(r->a->shape, &points, &r->definition) &&
           (!shape_definition_create(&r->definition, &r->shape) ||
            cli_refuse("%s: %s", r->a->shape, galv_last_error()));
}

static bool load_samples(struct reduction *r)
{
    const char *path = r->a->samples;
    if (!path)
        return true;
    if (!rows_read(path, r->definition.n, "x", &r->samples))
        return false;
    rows_check_bounds(&r->samples, path, &r->definition, &r->a->warnings);
    return true;
}

static galv_sampling choose_sampling(const struct reduction *r, size_t most)
{
    size_t count = r->a->samples ? r->samples.count : r->a->random;
    count = count < most ? count : most;
    return r->a->samples ? galv_samples(count, r->samples.values) : galv_uniform(count, r->a->seed);
}

static bool load_rows(struct reduction *r)
{
    const char *path = r->a->rows;
    size_t samples = choose_sampling(r, SIZE_MAX).count;
    return !path || (cli_table_read(path, &r->rows) &&
                     ((r->rows.rows == samples && r->rows.columns > 0) ||
                      cli_refuse("%s: %zu rows, expected one for each of the %zu samples", path,
                                 r->rows.rows, samples)));
}

/* Moments, then given rows. */
static bool append_quantities(struct reduction *r)
{
    const struct arguments *a = r->a;
    if (!appends_moments(a) && !a->rows)
        return true;
    r->set = (galv_moment_set){
        .sections = r->hull.sections, .girth = r->hull.girth, .order = (unsigned)a->order};
    if (a->n_section) {
        r->set.section_order = (unsigned)a->section[0];
        r->set.section_first = a->section[1] - 1;
        r->set.section_stride = a->section[2];
        if (r->set.section_first >= r->set.sections)
            return cli_refuse("--section-moments: section %zu of a hull of %zu", a->section[1],
                              r->set.sections);
    }
    if (appends_moments(a))
        galv_moments_extra(&r->set, &r->extra);
    r->extra.given = r->rows.columns;
    r->extra.values = r->rows.values;
    r->extra.count += r->extra.given;
    r->extra_weights = malloc(r->extra.count * sizeof *r->extra_weights);
    if (!r->extra_weights)
        return cli_refuse("out of memory");
    if (galv_extra_balance(r->shape, r->hull.npoints, r->hull.xyz, choose_sampling(r, PILOT),
                           &r->extra, a->share, r->extra_weights))
        return cli_refuse("%s", galv_last_error());
    r->extra.weights = r->extra_weights;
    return true;
}

static int show_progress(void *user_data, double fraction)
{
    cli_progress_update(user_data, fraction, "");
    return 0;
}

static bool build(struct reduction *r)
{
    const struct arguments *a = r->a;
    struct cli_progress progress;
    galv_options options;
    galv_options_init(&options);
    options.variance = a->variance;
    options.modes = a->modes;
    options.spectrum = a->spectrum;
    options.centre = a->centre;
    options.method = a->method;
    options.seed = a->seed;
    options.workspace = a->workspace << 20;
    options.extra = r->extra.count ? &r->extra : NULL;
    options.weights = r->weights;
    options.progress = show_progress;
    options.progress_user_data = &progress;
    double start = cli_seconds();
    cli_progress_start(&progress, "samples");
    const galv_data data = {.count = r->snapshots.count,
                            .coordinates = 3 * r->hull.npoints,
                            .values = r->snapshots.values,
                            .npoints = r->hull.npoints,
                            .xyz = r->hull.xyz};
    galv_status status = a->snapshots
                             ? galv_build_data(&data, &options, &r->model)
                             : galv_build(r->shape, r->hull.npoints, r->hull.xyz,
                                          choose_sampling(r, SIZE_MAX), &options, &r->model);
    cli_progress_end(&progress);
    r->seconds = cli_seconds() - start;
    return !status || cli_refuse("%s", galv_last_error());
}

static bool write_model(const struct reduction *r)
{
    const struct arguments *a = r->a;
    struct model_file file = {.model = r->model,
                              .shape = r->definition,
                              .sections = r->hull.sections,
                              .girth = r->hull.girth,
                              .uniform = a->random > 0,
                              .seed = a->seed,
                              .drawn = a->random,
                              .moments = appends_moments(a),
                              .set = r->set,
                              .rows = r->rows.columns};
    snprintf(file.hull, sizeof file.hull, "%s", a->hull ? a->hull : a->snapshots);
    return !a->output || model_file_write(a->output, &file);
}

static int print_json(const struct reduction *r)
{
    json_t *root = json_model(r->model);
    json_result_set(root, "weights", json_string(r->a->area ? "area" : "equal"));
    if (r->a->random)
        json_result_set(root, "seed", json_whole(r->a->seed));
    json_result_set(root, "seconds", json_number(r->seconds));
    return json_print(root, &r->a->warnings);
}

static int print_text(const struct reduction *r)
{
    const galv_model *model = r->model;
    galv_confidence confidence = galv_model_confidence(model);
    printf("%zu %s", galv_model_samples(model), r->a->snapshots ? "snapshots" : "samples");
    if (!r->a->snapshots)
        printf(" of %zu parameters", galv_model_parameters(model));
    printf(" on %zu points, %zu of %zu coordinates move\n", galv_model_points(model),
           galv_model_active(model), galv_model_coordinates(model));
    printf("%zu modes retain %.3f %% of the variance %.6g m^2", galv_model_modes(model),
           100 * galv_model_retained(model), galv_model_trace(model));
    if (isfinite(confidence.retained_error))
        printf("\n%.2f +- %.2f %% of the variance of fresh samples\n"
               "greatest angle to the modes of half the samples: %.2f degrees",
               100 * confidence.retained_fresh, 100 * confidence.retained_error,
               confidence.angle * 180 / PI);
    if (r->extra.count)
        printf("\n%.3f %% of the variance of the points alone",
               100 * galv_model_retained_geometry(model));
    printf("\n%4s %14s %12s %14s\n", "mode", "eigenvalue", "retained %", "mean sq. error");
    double sum = 0;
    for (size_t k = 0; k < galv_model_spectrum(model) && k < galv_model_modes(model) + 5; k++) {
        sum += galv_model_eigenvalues(model)[k];
        printf("%4zu %14.6e %12.4f %14.6e%s\n", k + 1, galv_model_eigenvalues(model)[k],
               100 * sum / galv_model_trace(model), galv_model_mse(model)[k],
               k + 1 == galv_model_modes(model) ? "  <- kept" : "");
    }
    printf("%s method, %.2f s\n", method_name(galv_model_method(model)), r->seconds);
    return output_end();
}

int command_reduce(int argc, char **argv)
{
    struct arguments a;
    int code = arguments_read(argc, argv, &TABLE, &a);
    if (code != -1)
        return code;
    struct reduction r = {.a = &a};
    bool ok = load_hull(&r) && load_shape(&r) && load_samples(&r) && load_rows(&r) &&
              append_quantities(&r) && build(&r) && write_model(&r);
    code = !ok ? CLI_FAILED : a.json ? print_json(&r) : print_text(&r);
    reduction_free(&r);
    arguments_free(&a);
    return code;
}
