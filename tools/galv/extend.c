#include "cli.h"
#include "commands.h"
#include "json.h"
#include "latent_rows.h"
#include "use.h"

#include <math.h>
#include <stdio.h>

static const char help[] =
    "usage: galv extend MODEL (--random N [--seed S] | --samples FILE) [OPTION]...\n"
    "\n"
    "Adds samples to a model without evaluating the old ones again, and says how much that "
    "changes\n"
    "the spectrum and turns the modes. The old samples enter through the eigenpairs the model "
    "keeps;\n"
    "what that can have cost an eigenvalue is printed.\n"
    "\n"
    "  --random N         N more uniform draws within the bounds of the modification\n"
    "  --seed S           of the stream to draw from (default: the model's); the stream the model "
    "was\n"
    "                     last drawn from is continued, any other starts at its first sample\n"
    "  --samples FILE     parameter vectors instead, CSV with one column per parameter\n"
    "  --variance V       share of the variance to retain, in (0, 1] (default 0.95)\n"
    "  --modes M          keep M modes instead\n"
    "  -o, --output FILE  write the extended model, HDF5\n"
    "  --threads N        threads (default: as the environment says)\n"
    "  --json             print one JSON object\n";

/* The new samples, and in *drawn how many the model then has of the stream `seed`. */
static galv_sampling choose_sampling(const struct use *use, const struct rows *x, size_t *seed,
                                     size_t *drawn)
{
    const struct model_file *file = &use->file;
    *seed = file->seed;
    *drawn = file->drawn;
    if (use->samples)
        return galv_samples(x->count, x->values);
    if (use->seed_given && use->seed != file->seed) {
        *seed = use->seed;
        *drawn = 0;
    }
    galv_sampling sampling = galv_uniform(use->random, *seed);
    sampling.first = *drawn;
    *drawn += use->random;
    return sampling;
}

static bool extend(const struct use *use, galv_sampling sampling, galv_model **grown)
{
    const struct model_file *file = &use->file;
    galv_shape *shape = NULL;
    galv_moment_set set;
    galv_extra extra = model_file_extra(file, &set);
    galv_options options;
    galv_options_init(&options);
    options.extra = extra.count ? &extra : NULL;
    options.modes = use->modes;
    if (use->variance > 0)
        options.variance = use->variance;
    bool ok = !shape_definition_create(&file->shape, &shape) &&
              !galv_extend(file->model, shape, sampling, &options, grown);
    if (!ok)
        cli_fail("%s", galv_last_error());
    galv_shape_free(shape);
    return ok;
}

static int print_json(const galv_model *old, const galv_model *new)
{
    return json_print(json_pack(
        "{s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o,s:o}", "samples",
        json_whole(galv_model_samples(new)), "samples_before", json_whole(galv_model_samples(old)),
        "modes", json_whole(galv_model_modes(new)), "retained",
        json_number(galv_model_retained(new)), "retained_before",
        json_number(galv_model_retained(old)), "trace", json_number(galv_model_trace(new)),
        "trace_before", json_number(galv_model_trace(old)), "subspace_angle",
        json_number(galv_model_confidence(new).angle), "truncation",
        json_number(galv_model_truncation(new)), "eigenvalues",
        json_numbers(galv_model_spectrum(new), galv_model_eigenvalues(new)), "eigenvalues_before",
        json_numbers(galv_model_spectrum(old), galv_model_eigenvalues(old))));
}

static int print_text(const galv_model *old, const galv_model *new)
{
    const double *now = galv_model_eigenvalues(new), *before = galv_model_eigenvalues(old);
    printf("%zu samples and %zu more\n", galv_model_samples(old),
           galv_model_samples(new) - galv_model_samples(old));
    printf("%zu modes retain %.3f %% of %.6g m^2; before, %zu retained %.3f %% of %.6g m^2\n",
           galv_model_modes(new), 100 * galv_model_retained(new), galv_model_trace(new),
           galv_model_modes(old), 100 * galv_model_retained(old), galv_model_trace(old));
    printf("greatest angle between old and new modes: %.2f degrees\n",
           galv_model_confidence(new).angle * 180 / 3.14159265358979323846);
    printf("eigenvalues may be too low by up to %.2e m^2\n", galv_model_truncation(new));
    printf("%4s %14s %14s %10s\n", "mode", "before", "now", "change %");
    for (size_t k = 0; k < galv_model_modes(new); k++) {
        if (k < galv_model_spectrum(old))
            printf("%4zu %14.6e %14.6e %10.4f\n", k + 1, before[k], now[k],
                   100 * (now[k] / before[k] - 1));
        else
            printf("%4zu %14s %14.6e\n", k + 1, "", now[k]);
    }
    return fflush(stdout) == EOF ? cli_fail("standard output cannot be written") : CLI_OK;
}

static int run(const struct use *use, const struct rows *x)
{
    size_t seed, drawn;
    galv_sampling sampling = choose_sampling(use, x, &seed, &drawn);
    galv_model *grown = NULL;
    if (!extend(use, sampling, &grown))
        return CLI_FAILED;
    struct model_file file = use->file;
    file.model = grown;
    file.uniform = use->file.uniform && !use->samples && seed == use->file.seed;
    file.seed = seed;
    file.drawn = drawn;
    const galv_model *old = use->file.model;
    int result = use->output && !model_file_write(use->output, &file) ? CLI_FAILED
                 : use->json                                          ? print_json(old, grown)
                                                                      : print_text(old, grown);
    galv_model_free(grown);
    return result;
}

int command_extend(int argc, char **argv)
{
    struct use use;
    int result = use_start(argc, argv, help, USE_OUTPUT | USE_MODES | USE_SAMPLES, &use);
    if (result != -1)
        return result;
    struct rows x = {.values = NULL};
    if (!use.random == !use.samples)
        result = cli_usage("give either --random or --samples");
    else if (use.samples && !rows_read(use.samples, galv_model_parameters(use.file.model), "x", &x))
        result = CLI_FAILED;
    else
        result = run(&use, &x);
    rows_free(&x);
    use_free(&use);
    return result;
}
