#include "cli.h"
#include "commands.h"
#include "json.h"
#include "use.h"

#include <math.h>
#include <stdio.h>

static const char help[] = "usage: galv info MODEL [--json]\n"
                           "\n"
                           "Says what a model file holds.\n";

static int print_json(const struct model_file *file)
{
    galv_model_data d = galv_model_view(file->model);
    double radius;
    if (galv_latent_ellipsoid(file->model, 0.95, &radius))
        return cli_fail("%s", galv_last_error());
    json_t *root = json_pack(
        "{s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:b,s:s,s:s,"
        "s:s}",
        "samples", json_whole(d.samples), "elements", json_whole(d.points), "coordinates",
        json_whole(d.coordinates), "active", json_whole(d.active), "parameters",
        json_whole(d.parameters), "modes", json_whole(d.modes), "retained", json_number(d.retained),
        "retained_geometry", json_number(d.retained_geometry), "retained_error",
        json_number(d.confidence.retained_error), "subspace_angle", json_number(d.confidence.angle),
        "trace", json_number(d.trace), "eigenvalues", json_numbers(d.spectrum, d.eigenvalues),
        "mse", json_numbers(d.spectrum, d.mse), "latent_lower", json_numbers(d.modes, d.lower),
        "latent_upper", json_numbers(d.modes, d.upper), "radius95", json_number(radius),
        "truncation", json_number(d.truncation), "seed",
        file->uniform ? json_whole(file->seed) : json_null(), "sections",
        json_whole(file->sections), "centred", d.centred, "method", method_name(d.method), "hull",
        file->hull, "shape", file->shape.kind == SHAPE_SINES ? "sines" : "lattice");
    return json_print(root);
}

static int print_text(const struct model_file *file)
{
    galv_model_data d = galv_model_view(file->model);
    double lower95[64], upper95[64], radius;
    bool quantiles = d.modes <= 64 && !galv_latent_bounds(file->model, 0.95, lower95, upper95);
    printf("%s: %zu points", file->hull, d.points);
    if (file->girth)
        printf(" (%zu x %zu)", file->sections, file->girth);
    printf(", %zu %s parameters of %s\n", d.parameters,
           file->shape.combination == GALV_COMBINATION_RECURSIVE && file->shape.kind == SHAPE_SINES
               ? "recursive"
               : "linear",
           file->shape.kind == SHAPE_SINES ? "sine products" : "a lattice");
    printf("%zu samples", d.samples);
    if (file->uniform)
        printf(" (uniform, seed %zu)", file->seed);
    printf("%s, %s method\n", d.centred ? ", centred" : "", method_name(d.method));
    printf("%zu modes retain %.3f %% of %.6g m^2", d.modes, 100 * d.retained, d.trace);
    if (d.coordinates > 3 * d.points)
        printf(" with %zu appended quantities, %.3f %% of the points' variance",
               d.coordinates - 3 * d.points, 100 * d.retained_geometry);
    if (isfinite(d.confidence.retained_error))
        printf("\nstandard error of the retained share %.3f %%, greatest angle to the modes of %s: "
               "%.2f degrees",
               100 * d.confidence.retained_error,
               d.truncation > 0 ? "the model extended" : "half the samples",
               d.confidence.angle * 180 / 3.14159265358979323846);
    if (d.truncation > 0)
        printf("\neigenvalues may be too low by up to %.2e m^2", d.truncation);
    if (!galv_latent_ellipsoid(file->model, 0.95, &radius))
        printf("\n95 %% of the samples lie within %.3f standard deviations", radius);
    printf("\n%4s %13s %11s %13s %13s %13s %13s\n", "mode", "eigenvalue", "retained %", "lower",
           "upper", "lower 95 %", "upper 95 %");
    double sum = 0;
    for (size_t k = 0; k < d.modes; k++) {
        sum += d.eigenvalues[k];
        printf("%4zu %13.5e %11.4f %13.5e %13.5e", k + 1, d.eigenvalues[k], 100 * sum / d.trace,
               d.lower[k], d.upper[k]);
        if (quantiles)
            printf(" %13.5e %13.5e", lower95[k], upper95[k]);
        putchar('\n');
    }
    return fflush(stdout) == EOF ? cli_fail("standard output cannot be written") : CLI_OK;
}

int command_info(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, 0, &use);
    if (result != -1)
        return result;
    result = use.json ? print_json(&use.file) : print_text(&use.file);
    use_free(&use);
    return result;
}
