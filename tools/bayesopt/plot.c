/* plot: the history and slices of the model through the best point, drawn by gnuplot. */
#include "cli.h"
#include "commands.h"
#include "names.h"

#include <getopt.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static const char help[] =
    "usage: bayesopt plot STORE -o FILE [OPTION]...\n"
    "\n"
    "Draws every value with the best so far, or the model along one variable at a time through "
    "the\n"
    "best point. FILE ends in .svg, .png or .pdf; gnuplot is needed.\n"
    "\n"
    "  -o, --output FILE the picture\n"
    "  --slices          slices of the model instead of the history (the first 16 variables)\n"
    "  --threads N       accepted; one thread is used\n"
    "  --help\n"
    "\n"
    "Exit status: 0 success, 1 failure, 2 wrong usage.\n";

enum { SAMPLES = 101, MOST_SLICES = 16 };

static const char *terminal(const char *path)
{
    const char *dot = strrchr(path, '.');
    if (dot && strcmp(dot, ".svg") == 0)
        return "svg";
    if (dot && strcmp(dot, ".png") == 0)
        return "pngcairo";
    if (dot && strcmp(dot, ".pdf") == 0)
        return "pdfcairo";
    return NULL;
}

/* A text within gnuplot's double quotes. */
static void quote(FILE *g, const char *text)
{
    fputc('"', g);
    for (; *text; text++) {
        if (*text == '"' || *text == '\\')
            fputc('\\', g);
        fputc(*text == '\n' ? ' ' : *text, g);
    }
    fputc('"', g);
}

static void number_or_gap(FILE *g, double value)
{
    if (isfinite(value))
        fprintf(g, "%.17g ", value);
    else
        fprintf(g, "NaN ");
}

static void draw_history(FILE *g, const bayesopt *bo)
{
    bayesopt_point p;
    double best = INFINITY;
    fprintf(g, "$data << END\n");
    for (size_t i = 0; i < bayesopt_count(bo); i++) {
        if (bayesopt_get(bo, i, &p) || p.state != BAYESOPT_STATE_DONE)
            continue;
        best = p.feasible ? fmin(best, p.f) : best;
        bool designed = p.phase == BAYESOPT_PHASE_INITIAL || p.phase == BAYESOPT_PHASE_EXTERNAL;
        fprintf(g, "%llu ", (unsigned long long)p.id);
        number_or_gap(g, designed ? p.f : NAN);
        number_or_gap(g, designed ? NAN : p.f);
        number_or_gap(g, best);
        fputc('\n', g);
    }
    fprintf(g, "END\nset xlabel 'evaluation'\nset ylabel 'objective'\nset key outside center top "
               "horizontal\n"
               "plot $data using 1:2 with points pt 7 ps 0.8 lc rgb '#999999' title 'design', "
               "$data using 1:3 with points pt 7 ps 0.8 lc rgb '#d98b2b' title 'proposals', "
               "$data using 1:4 with steps lw 2 lc rgb '#1f4e9c' title 'best so far'\n");
}

/* The curve and some room on both sides of it: the band may be wider by orders. */
static void curve_range(const double *mean, double *low, double *high)
{
    *low = *high = mean[0];
    for (size_t s = 1; s < SAMPLES; s++) {
        *low = fmin(*low, mean[s]);
        *high = fmax(*high, mean[s]);
    }
    double room = 0.3 * (*high - *low);
    if (!(room > 0) || !isfinite(room))
        room = fmax(fabs(*low), 1e-300);
    *low -= room;
    *high += room;
}

static bool draw_slices(FILE *g, bayesopt *bo, const struct names *names)
{
    size_t d = names->d, shown = d < MOST_SLICES ? d : MOST_SLICES;
    size_t columns = (size_t)ceil(sqrt((double)shown)), rows = (shown + columns - 1) / columns;
    double *lower = malloc((3 * d + SAMPLES * (d + 2)) * sizeof *lower);
    if (!lower)
        return false;
    double *upper = lower + d, *best = upper + d, *x = best + d, *mean = x + SAMPLES * d;
    double *sd = mean + SAMPLES;
    bayesopt_dimension(bo, lower, upper);
    bool ok = bayesopt_best(bo, best, NULL, NULL) >= 0;
    fprintf(g, "set multiplot layout %zu,%zu\nunset key\n", rows, columns);
    for (size_t j = 0; j < shown && ok; j++) {
        for (size_t s = 0; s < SAMPLES; s++) {
            memcpy(x + s * d, best, d * sizeof *x);
            x[s * d + j] = lower[j] + (upper[j] - lower[j]) * (double)s / (SAMPLES - 1);
        }
        ok = !bayesopt_predict(bo, SAMPLES, x, mean, sd);
        if (!ok)
            break;
        double low, high;
        curve_range(mean, &low, &high);
        fprintf(g, "$slice%zu << END\n", j);
        for (size_t s = 0; s < SAMPLES; s++)
            fprintf(g, "%.17g %.17g %.17g %.17g\n", x[s * d + j], mean[s],
                    fmax(mean[s] - 2 * sd[s], low), fmin(mean[s] + 2 * sd[s], high));
        fprintf(g, "END\nset xrange [%.17g:%.17g]\nset yrange [%.17g:%.17g]\nset ylabel '%s'\n",
                lower[j], upper[j], low, high, j % columns ? "" : "objective");
        fprintf(g, "set xlabel ");
        quote(g, names->variables[j]);
        fprintf(g,
                "\nset arrow 1 from %.17g, graph 0 to %.17g, graph 1 nohead dt 2 lc rgb '#888888'\n"
                "plot $slice%zu using 1:3:4 with filledcurves lc rgb '#c8d8f0', '' using 1:2 with "
                "lines lw 2 lc rgb '#1f4e9c'\n",
                best[j], best[j], j);
    }
    fprintf(g, "unset multiplot\n");
    free(lower);
    return ok;
}

static int plot(bayesopt *bo, const struct names *names, const char *output, bool slices)
{
    /* A gnuplot that is missing or stops early must not end this process. */
    signal(SIGPIPE, SIG_IGN);
    FILE *g = popen("gnuplot 2>/dev/null", "w");
    if (!g)
        return cli_fail("gnuplot cannot be started");
    fprintf(g, "set terminal %s size %s\nset encoding utf8\nset output ", terminal(output),
            strcmp(terminal(output), "pdfcairo") == 0 ? "20cm,15cm" : "1000,750");
    quote(g, output);
    fprintf(g, "\nset grid lc rgb '#dddddd'\n");
    bool ok = true;
    if (slices)
        ok = draw_slices(g, bo, names);
    else
        draw_history(g, bo);
    int status = pclose(g);
    if (!ok)
        return cli_fail("%s", bayesopt_last_error());
    if (status != 0)
        return cli_fail("gnuplot failed with status %d; is it installed?",
                        WIFEXITED(status) ? WEXITSTATUS(status) : -1);
    return CLI_OK;
}

enum { SLICES = 1000, THREADS, HELP };

int command_plot(int argc, char **argv)
{
    static const struct option options[] = {
        {"output", required_argument, NULL, 'o'},
        {"slices", no_argument, NULL, SLICES},
        {"threads", required_argument, NULL, THREADS},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };
    const char *output = NULL;
    bool slices = false;
    int option;
    while ((option = getopt_long(argc, argv, "o:", options, NULL)) != -1) {
        if (option == 'o')
            output = optarg;
        else if (option == SLICES)
            slices = true;
        else if (option == HELP)
            return cli_print(help);
        else if (option != THREADS)
            return cli_usage("unknown option or missing value");
    }
    if (argc - optind != 1 || !output)
        return cli_usage("expected one STORE and -o FILE");
    if (!terminal(output))
        return cli_usage("'%s': expected a name that ends in .svg, .png or .pdf", output);
    bayesopt *bo;
    struct names names;
    if (!store_open(argv[optind], &bo, &names))
        return CLI_FAILED;
    int code = bayesopt_count(bo) ? plot(bo, &names, output, slices)
                                  : cli_fail("%s: nothing to plot yet", argv[optind]);
    names_free(&names);
    bayesopt_free(bo);
    return code;
}
