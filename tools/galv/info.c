#include "arguments.h"
#include "cli.h"
#include "commands.h"
#include "constants.h"
#include "json_result.h"

#include <math.h>
#include <stdio.h>

static const struct setting ROWS[] = {
    OPTION_MODEL,
    OPTION_JSON,
};

static const struct settings TABLE = {sizeof ROWS / sizeof *ROWS, ROWS,
                                      .usage = "usage: galv info MODEL [--json]\n"
                                               "\n"
                                               "Says what a model file holds.\n\n"};

static int print_json(const struct arguments *a)
{
    const struct model_file *file = &a->file;
    double radius;
    if (galv_latent_ellipsoid(file->model, 0.95, &radius))
        return cli_fail("%s", galv_last_error());
    json_t *root = json_model(file->model);
    json_result_set(root, "radius95", json_number(radius));
    json_result_set(root, "seed", file->uniform ? json_whole(file->seed) : json_null());
    json_result_set(root, "sections", json_whole(file->sections));
    json_result_set(root, "hull", json_string(file->hull));
    json_result_set(root, "shape",
                    json_string(file->shape.n ? shape_kind_name(file->shape.kind) : "snapshots"));
    return json_print(root, &a->warnings);
}

static int print_text(const struct model_file *file)
{
    const galv_model *m = file->model;
    double lower95[64], upper95[64], radius;
    bool quantiles =
        galv_model_modes(m) <= 64 && !galv_latent_bounds(file->model, 0.95, lower95, upper95);
    printf("%s: %zu points", file->hull, galv_model_points(m));
    if (file->girth)
        printf(" (%zu x %zu)", file->sections, file->girth);
    bool sines = file->shape.kind == SHAPE_SINES;
    if (!file->shape.n)
        printf(", snapshots\n");
    else
        printf(", %zu %s parameters of %s\n", galv_model_parameters(m),
               sines ? shape_combination_name(file->shape.combination) : "linear",
               sines                               ? "sine products"
               : file->shape.kind == SHAPE_LATTICE ? "a lattice"
                                                   : "control points");
    printf("%zu samples", galv_model_samples(m));
    if (file->uniform)
        printf(" (uniform, seed %zu)", file->seed);
    printf("%s, %s method\n", galv_model_centred(m) ? ", centred" : "",
           method_name(galv_model_method(m)));
    printf("%zu modes retain %.3f %% of %.6g m^2", galv_model_modes(m),
           100 * galv_model_retained(m), galv_model_trace(m));
    if (galv_model_coordinates(m) > 3 * galv_model_points(m))
        printf(" with %zu appended quantities, %.3f %% of the points' variance",
               galv_model_coordinates(m) - 3 * galv_model_points(m),
               100 * galv_model_retained_geometry(m));
    if (isfinite(galv_model_confidence(m).retained_error))
        printf("\n%.2f +- %.2f %% of the variance of fresh samples\n"
               "greatest angle to the modes of %s: %.2f degrees",
               100 * galv_model_confidence(m).retained_fresh,
               100 * galv_model_confidence(m).retained_error,
               galv_model_truncation(m) > 0 ? "the model extended" : "half the samples",
               galv_model_confidence(m).angle * 180 / PI);
    if (galv_model_truncation(m) > 0)
        printf("\neigenvalues may be too low by up to %.2e m^2", galv_model_truncation(m));
    if (!galv_latent_ellipsoid(file->model, 0.95, &radius))
        printf("\n95 %% of the samples lie within %.3f standard deviations", radius);
    printf("\n%4s %13s %11s %13s %13s %13s %13s\n", "mode", "eigenvalue", "retained %", "lower",
           "upper", "lower 95 %", "upper 95 %");
    double sum = 0;
    for (size_t k = 0; k < galv_model_modes(m); k++) {
        sum += galv_model_eigenvalues(m)[k];
        printf("%4zu %13.5e %11.4f %13.5e %13.5e", k + 1, galv_model_eigenvalues(m)[k],
               100 * sum / galv_model_trace(m), galv_model_lower(m)[k], galv_model_upper(m)[k]);
        if (quantiles)
            printf(" %13.5e %13.5e", lower95[k], upper95[k]);
        putchar('\n');
    }
    return output_end();
}

int command_info(int argc, char **argv)
{
    struct arguments a;
    int code = arguments_read(argc, argv, &TABLE, &a);
    if (code != -1)
        return code;
    code = a.json ? print_json(&a) : print_text(&a.file);
    arguments_free(&a);
    return code;
}
