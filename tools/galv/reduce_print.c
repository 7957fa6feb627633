#include "cli.h"
#include "json.h"
#include "model_file.h"
#include "reduce.h"

#include <math.h>
#include <stdio.h>

int reduce_print_json(const galv_model *model, const struct reduce_options *options, double seconds)
{
    size_t spectrum = galv_model_spectrum(model), modes = galv_model_modes(model);
    galv_confidence confidence = galv_model_confidence(model);
    json_t *root = json_object();
    json_object_set_new(root, "samples", json_whole(galv_model_samples(model)));
    json_object_set_new(root, "elements", json_whole(galv_model_points(model)));
    json_object_set_new(root, "coordinates", json_whole(galv_model_coordinates(model)));
    json_object_set_new(root, "active", json_whole(galv_model_active(model)));
    json_object_set_new(root, "parameters", json_whole(galv_model_parameters(model)));
    json_object_set_new(root, "modes", json_whole(modes));
    json_object_set_new(root, "retained", json_number(galv_model_retained(model)));
    json_object_set_new(root, "retained_geometry",
                        json_number(galv_model_retained_geometry(model)));
    json_object_set_new(root, "retained_error", json_number(confidence.retained_error));
    json_object_set_new(root, "subspace_angle", json_number(confidence.angle));
    json_object_set_new(root, "trace", json_number(galv_model_trace(model)));
    json_object_set_new(root, "eigenvalues", json_numbers(spectrum, galv_model_eigenvalues(model)));
    json_object_set_new(root, "residuals", json_numbers(spectrum, galv_model_residuals(model)));
    json_object_set_new(root, "mse", json_numbers(spectrum, galv_model_mse(model)));
    json_object_set_new(root, "latent_lower", json_numbers(modes, galv_model_lower(model)));
    json_object_set_new(root, "latent_upper", json_numbers(modes, galv_model_upper(model)));
    json_object_set_new(root, "centred", json_boolean(options->build.centre));
    json_object_set_new(root, "weights", json_string(options->area_weights ? "area" : "equal"));
    json_object_set_new(root, "method", json_string(method_name(galv_model_method(model))));
    if (options->random)
        json_object_set_new(root, "seed", json_whole(options->seed));
    json_object_set_new(root, "seconds", json_number(seconds));
    return json_print(root);
}

int reduce_print_text(const galv_model *model, const struct reduce_options *options, double seconds)
{
    galv_confidence confidence = galv_model_confidence(model);
    printf("%zu samples of %zu parameters on %zu points, %zu of %zu coordinates move\n",
           galv_model_samples(model), galv_model_parameters(model), galv_model_points(model),
           galv_model_active(model), galv_model_coordinates(model));
    printf("%zu modes retain %.3f %% of the variance %.6g m^2", galv_model_modes(model),
           100 * galv_model_retained(model), galv_model_trace(model));
    if (isfinite(confidence.retained_error))
        printf(" (standard error %.3f %%)\ngreatest angle to the modes of half the samples: %.2f "
               "degrees",
               100 * confidence.retained_error, confidence.angle * 180 / 3.14159265358979323846);
    if (options->moments || options->rows)
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
    printf("%s method, %.2f s\n", method_name(galv_model_method(model)), seconds);
    return fflush(stdout) == EOF ? cli_fail("standard output cannot be written") : CLI_OK;
}
