/* plot: one picture of a store. */
#include "commands.h"
#include "pictures.h"

struct arguments {
    char *store, *output;
    bool front, slices, contours, loo, parallel, sensitivity, json;
};

static const struct setting ROWS[] = {
    OPTION("STORE", TEXT, store, .required = true, .sentence = "the file that holds the study"),
    OPTION("output", TEXT, output, .letter = 'o', .required = true,
           .sentence = "the picture: a name in .svg, .png or .pdf"),
    OPTION("front", SWITCH, front,
           .sentence = "values of several objectives against each other, the Pareto set marked"),
    OPTION("slices", SWITCH, slices,
           .sentence =
               "the model along one variable at a time through the best point (16 of them)"),
    OPTION("contours", SWITCH, contours,
           .sentence = "the same along pairs of the variables that matter most"),
    OPTION("loo", SWITCH, loo,
           .sentence = "what the model expects of each value from the others alone"),
    OPTION("parallel", SWITCH, parallel,
           .sentence = "points as lines across one axis per variable (12 of them)"),
    OPTION("sensitivity", SWITCH, sensitivity, .sentence = "Sobol' indices of the model"),
    OPTION_JSON,
};

static picture *chosen(const struct arguments *a)
{
    return a->front         ? picture_front
           : a->slices      ? picture_slices
           : a->contours    ? picture_contours
           : a->loo         ? picture_loo
           : a->parallel    ? picture_parallel
           : a->sensitivity ? picture_indices
                            : picture_history;
}

static void check(struct settings_source *source, void *target)
{
    const struct arguments *a = target;
    if (a->front + a->slices + a->contours + a->loo + a->parallel + a->sensitivity > 1)
        settings_complain(source, "front", "and others are given, expected one picture at a time");
}

static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS, .check = check,
    .usage = "usage: bayesopt plot STORE -o FILE [OPTION]...\n"
             "\n"
             "Draws every value with the best so far, or one of the other pictures.\n\n"};

int command_plot(int argc, char **argv)
{
    struct arguments a = {0};
    struct names names;
    struct plot sheet;
    bayesopt *bo;
    settings_start(&TABLE, &a);
    int code = settings_options(argc, argv, &TABLE, &a, NULL, NULL);
    if (code < 0 && !plot_check_path("-o", a.output)) {
        code = CLI_USAGE;
    } else if (code < 0 && !store_open(a.store, &bo, &names)) {
        code = CLI_FAILED;
    } else if (code < 0) {
        bool good = bayesopt_count(bo) > 0 || cli_refuse("%s: nothing to plot yet", a.store);
        good = good && chosen(&a)(&sheet, bo, &names) && plot_save(&sheet, a.output) &&
               (!a.json || print_file(a.output, bo));
        code = good ? CLI_OK : CLI_FAILED;
        names_free(&names);
        bayesopt_free(bo);
    }
    settings_free(&TABLE, &a);
    return code;
}
