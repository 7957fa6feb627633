/* design: points of a design of experiments and how well they fill the box. */
#include "commands.h"
#include "names.h"

#include <bayesopt/design.h>

#include <math.h>
#include <stdlib.h>

struct arguments {
    int kind;
    size_t n, d, n_lower, n_upper;
    uint64_t seed;
    double power, *lower, *upper;
    char *output;
    bool json;
};

static const struct setting_word KINDS[] = {{"uniform", BAYESOPT_DESIGN_UNIFORM},
                                            {"lhs", BAYESOPT_DESIGN_LHS},
                                            {"annealed-lhs", BAYESOPT_DESIGN_ANNEALED_LHS},
                                            {"sobol", BAYESOPT_DESIGN_SOBOL},
                                            {"stlbo", BAYESOPT_DESIGN_STLBO},
                                            {NULL, 0}};

static const struct setting ROWS[] = {
    OPTION("KIND", CHOICE, kind, .words = KINDS, .required = true, .sentence = "of design"),
    OPTION("N", COUNT, n, .least = 1, .most = 1e6, .required = true, .sentence = "points"),
    OPTION("D", COUNT, d, .least = 1, .most = 1000, .required = true, .sentence = "variables"),
    OPTION("lower", NUMBERS, lower, .count = offsetof(struct arguments, n_lower),
           .sentence = "of the box, one number per variable; 0 without"),
    OPTION("upper", NUMBERS, upper, .count = offsetof(struct arguments, n_upper),
           .sentence = "of the box, one number per variable; 1 without"),
    OPTION("seed", COUNT, seed, .otherwise = "1", .sentence = "of the random numbers"),
    OPTION("power", NUMBER, power, .most = INFINITY, .open_least = true, .otherwise = "2",
           .sentence = "annealing energy sum 1/dist^X: 2 Audze-Eglais, 50 near maximin"),
    OPTION("output", TEXT, output, .letter = 'o', .sentence = "file, instead of standard output"),
    OPTION("json", SWITCH, json,
           .sentence = "the design's measures as JSON; the points go to --output alone"),
};

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    if (a->lower && a->n_lower != a->d)
        settings_complain(source, "lower", "has %zu numbers, expected %zu", a->n_lower, a->d);
    if (a->upper && a->n_upper != a->d)
        settings_complain(source, "upper", "has %zu numbers, expected %zu", a->n_upper, a->d);
}

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage = "usage: bayesopt design KIND N D [OPTION]...\n"
             "\n"
             "Prints N points in D variables as CSV. KIND: uniform, lhs, annealed-lhs, sobol, "
             "stlbo.\n\n"};

static bool print_points(const struct arguments *a, const double *u)
{
    struct output output;
    if (!output_open(&output, a->output))
        return false;
    for (size_t j = 0; j < a->d; j++)
        fprintf(output.stream, "%sx%zu", j ? "," : "", j + 1);
    fputc('\n', output.stream);
    for (size_t i = 0; i < a->n * a->d; i++) {
        size_t j = i % a->d;
        double lower = a->lower ? a->lower[j] : 0, upper = a->upper ? a->upper[j] : 1;
        fprintf(output.stream, "%.17g%c", lower + u[i] * (upper - lower),
                j + 1 < a->d ? ',' : '\n');
    }
    return output_close(&output);
}

static bool print_measures(const struct arguments *a, const double *u)
{
    bayesopt_design_quality q;
    if (bayesopt_design_measure(a->n, a->d, u, &q))
        return cli_refuse("%s", bayesopt_last_error());
    return print_json(
        stdout, json_pack("{s:s?, s:s, s:I, s:I, s:f, s:f, s:f, s:f, s:f}", "file", a->output,
                          "kind", bayesopt_design_name((bayesopt_design_kind)a->kind), "points",
                          (json_int_t)a->n, "variables", (json_int_t)a->d, "audze_eglais",
                          q.audze_eglais, "phi_p", q.phi_p, "min_distance", q.min_distance,
                          "discrepancy", q.discrepancy, "occupied", q.occupied));
}

static bool design(const struct arguments *a)
{
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = a->seed;
    options.power = a->power;
    double *u = malloc(a->n * a->d * sizeof *u);
    bool ok = u != NULL || cli_refuse("out of memory");
    ok = ok && (!bayesopt_design((bayesopt_design_kind)a->kind, a->n, a->d, &options, u) ||
                cli_refuse("%s", bayesopt_last_error()));
    ok =
        ok && ((a->json && !a->output) || print_points(a, u)) && (!a->json || print_measures(a, u));
    free(u);
    return ok;
}

int command_design(int argc, char **argv)
{
    struct arguments a = {0};
    settings_start(&TABLE, &a);
    int code = settings_options(argc, argv, &TABLE, &a, NULL, NULL);
    if (code < 0)
        code = design(&a) ? CLI_OK : CLI_FAILED;
    settings_free(&TABLE, &a);
    return code;
}
