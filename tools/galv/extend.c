#include "arguments.h"
#include "cli.h"
#include "commands.h"
#include "constants.h"
#include "json_result.h"

#include <math.h>
#include <stdio.h>

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    arguments_either(source, "random", a->random, "samples", a->samples);
}

static const struct setting ROWS[] = {
    OPTION_MODEL,
    OPTION_RANDOM,
    OPTION("seed", COUNT, seed, .given = offsetof(struct arguments, seed_given),
           .sentence = "of the stream to draw from, by default the model's; the stream the model "
                       "was last drawn from is continued, any other starts at its first sample"),
    OPTION_SAMPLES,
    OPTION_VARIANCE,
    OPTION_KEPT,
    OPTION_WRITTEN,
    OPTION_JSON,
};

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage =
        "usage: galv extend MODEL (--random N [--seed S] | --samples FILE) [OPTION]...\n"
        "\n"
        "Adds samples to a model without evaluating the old ones again, and says how much that "
        "changes\n"
        "the spectrum and turns the modes. The old samples enter through the eigenpairs the model "
        "keeps;\n"
        "what that can have cost an eigenvalue is printed.\n\n"};

/* The new samples, and in *drawn how many the model then has of the stream `seed`. */
static galv_sampling choose_sampling(const struct arguments *a, const struct rows *x, size_t *seed,
                                     size_t *drawn)
{
    const struct model_file *file = &a->file;
    *seed = file->seed;
    *drawn = file->drawn;
    if (a->samples)
        return galv_samples(x->count, x->values);
    if (a->seed_given && a->seed != file->seed) {
        *seed = a->seed;
        *drawn = 0;
    }
    galv_sampling sampling = galv_uniform(a->random, *seed);
    sampling.first = *drawn;
    *drawn += a->random;
    return sampling;
}

static bool extend(const struct arguments *a, galv_sampling sampling, galv_model **grown)
{
    const struct model_file *file = &a->file;
    galv_shape *shape = NULL;
    galv_moment_set set;
    galv_extra extra;
    model_file_extra(file, &set, &extra);
    galv_options options;
    galv_options_init(&options);
    options.extra = extra.count ? &extra : NULL;
    options.modes = a->modes;
    options.variance = a->variance;
    bool ok = !shape_definition_create(&file->shape, &shape) &&
              !galv_extend(file->model, shape, sampling, &options, grown);
    if (!ok)
        cli_fail("%s", galv_last_error());
    galv_shape_free(shape);
    return ok;
}

static int print_json(const galv_model *old, const galv_model *new, const struct warnings *warnings)
{
    json_t *root = json_model(new);
    json_result_set(root, "samples_before", json_whole(galv_model_samples(old)));
    json_result_set(root, "retained_before", json_number(galv_model_retained(old)));
    json_result_set(root, "trace_before", json_number(galv_model_trace(old)));
    json_result_set(root, "eigenvalues_before",
                    json_numbers(galv_model_spectrum(old), galv_model_eigenvalues(old)));
    return json_print(root, warnings);
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
           galv_model_confidence(new).angle * 180 / PI);
    printf("eigenvalues may be too low by up to %.2e m^2\n", galv_model_truncation(new));
    printf("%4s %14s %14s %10s\n", "mode", "before", "now", "change %");
    for (size_t k = 0; k < galv_model_modes(new); k++) {
        if (k < galv_model_spectrum(old))
            printf("%4zu %14.6e %14.6e %10.4f\n", k + 1, before[k], now[k],
                   100 * (now[k] / before[k] - 1));
        else
            printf("%4zu %14s %14.6e\n", k + 1, "", now[k]);
    }
    return output_end();
}

static int run(const struct arguments *a, const struct rows *x)
{
    size_t seed, drawn;
    galv_sampling sampling = choose_sampling(a, x, &seed, &drawn);
    galv_model *grown = NULL;
    if (!extend(a, sampling, &grown))
        return CLI_FAILED;
    struct model_file file = a->file;
    file.model = grown;
    file.uniform = a->file.uniform && !a->samples && seed == a->file.seed;
    file.seed = seed;
    file.drawn = drawn;
    const galv_model *old = a->file.model;
    int result = a->output && !model_file_write(a->output, &file) ? CLI_FAILED
                 : a->json ? print_json(old, grown, &a->warnings)
                           : print_text(old, grown);
    galv_model_free(grown);
    return result;
}

int command_extend(int argc, char **argv)
{
    struct arguments a;
    struct rows x = {.values = NULL};
    int code = arguments_read(argc, argv, &TABLE, &a);
    if (code != -1)
        return code;
    bool ok = arguments_have_parameters(&a) &&
              (!a.samples || rows_read(a.samples, galv_model_parameters(a.file.model), "x", &x));
    if (ok && a.samples)
        rows_check_bounds(&x, a.samples, &a.file.shape, &a.warnings);
    code = ok ? run(&a, &x) : CLI_FAILED;
    rows_free(&x);
    arguments_free(&a);
    return code;
}
