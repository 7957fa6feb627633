/* report: a study as one page of HTML. */
#include "commands.h"
#include "pictures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BEST_ROWS = 10, FAILURES = 20, COUNTS = BAYESOPT_STATE_LOST + 1 };

/* Readable on a phone, and on paper without the background. */
static const char HEAD[] =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
    "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n";
static const char STYLE[] =
    "<style>\n*{box-sizing:border-box}\n"
    "body{margin:0;background:#f4f6f8;color:#1b2733;"
    "font:15px/1.5 system-ui,'Helvetica Neue',Arial,sans-serif}\n"
    "main{max-width:1080px;margin:0 auto;padding:24px 16px 48px}\n"
    "h1{font-size:25px;margin:0 0 2px}h2{font-size:18px;margin:0 0 12px}\n"
    ".sub,figcaption{color:#5f6c7a;margin:0 0 16px}figcaption{font-size:13px;margin:4px 0 0}\n"
    "section{background:#fff;border:1px solid #e0e6eb;border-radius:10px;padding:18px;"
    "margin:0 0 18px}\n"
    "figure{margin:0 0 14px}svg{width:100%;height:auto;display:block}\n"
    ".narrow{max-width:560px}.wide{overflow-x:auto}\n"
    "table{border-collapse:collapse;width:100%;font-size:13px;font-variant-numeric:tabular-nums}\n"
    "th{text-align:left;color:#5f6c7a;border-bottom:2px solid #e0e6eb}\n"
    "th,td{padding:4px 10px 4px 0;white-space:nowrap}td{border-bottom:1px solid #eef1f4}\n"
    "@media print{body{background:#fff}section{border:0;padding:0;break-inside:avoid}"
    "main{padding:0}}\n"
    "</style>\n";

struct arguments {
    char *store, *output;
    bool json;
};

static const struct setting ROWS[] = {
    OPTION("STORE", TEXT, store, .required = true, .sentence = "the file that holds the study"),
    OPTION("output", TEXT, output, .letter = 'o', .required = true, .sentence = "the page, HTML"),
    OPTION_JSON,
};
static const struct settings TABLE = {
    sizeof ROWS / sizeof *ROWS, ROWS,
    .usage = "usage: bayesopt report STORE -o FILE.html\n"
             "\n"
             "Writes a study as one page that needs nothing else: how far it is, the best points,\n"
             "the history, how good the model is, which variables matter, slices and contours of\n"
             "the model, and what failed.\n\n"};

static void summary(FILE *out, bayesopt *bo, const char *path)
{
    const char *slash = strrchr(path, '/');
    size_t counts[COUNTS] = {0};
    bayesopt_point p;
    for (size_t i = 0; !bayesopt_get(bo, i, &p); i++)
        counts[p.state]++;
    fputs("<h1>", out);
    plot_escape(out, slash ? slash + 1 : path);
    fprintf(out,
            "</h1>\n<p class=\"sub\">%zu variables, %zu of %zu evaluations done, %zu failed, %zu "
            "lost, %zu pending; %s%s</p>\n",
            bayesopt_dimension(bo, NULL, NULL), counts[BAYESOPT_STATE_DONE], bayesopt_budget(bo),
            counts[BAYESOPT_STATE_FAILED], counts[BAYESOPT_STATE_LOST],
            counts[BAYESOPT_STATE_PENDING],
            bayesopt_objective_count(bo) > 1 ? "several objectives; f is " : "f is ",
            bayesopt_maximises(bo) ? "maximised" : "minimised");
}

/* Rows of the history: feasible ones first, better ones first; of several objectives the front. */
static size_t pick_rows(const bayesopt *bo, size_t *rows)
{
    size_t n = 0;
    bayesopt_point p, q;
    if (bayesopt_objective_count(bo) > 1)
        return cli_needed(bayesopt_pareto(bo, &n, rows) == BAYESOPT_ERROR_MEMORY ? NULL : rows) ? n
                                                                                                : 0;
    double sign = bayesopt_maximises(bo) ? -1 : 1;
    for (size_t i = 0; !bayesopt_get(bo, i, &p); i++) {
        if (p.state != BAYESOPT_STATE_DONE || p.outside)
            continue;
        size_t at = n++;
        for (; at > 0 && !bayesopt_get(bo, rows[at - 1], &q); at--) {
            bool before = p.feasible != q.feasible ? p.feasible : sign * p.f < sign * q.f;
            if (!before)
                break;
            rows[at] = rows[at - 1];
        }
        rows[at] = i;
    }
    return n < BEST_ROWS ? n : BEST_ROWS;
}

static void cell(FILE *out, const char *tag, const char *text)
{
    fprintf(out, "<%s>", tag);
    plot_escape(out, text);
    fprintf(out, "</%s>", tag);
}

static void number_cell(FILE *out, double value)
{
    fprintf(out, "<td>%.6g</td>", value);
}

static bool best_table(FILE *out, const bayesopt *bo, const struct names *names)
{
    size_t *rows = malloc((bayesopt_count(bo) + 1) * sizeof *rows);
    bayesopt_point p;
    if (!rows)
        return cli_refuse("out of memory");
    size_t n = pick_rows(bo, rows);
    fprintf(out, "<section><h2>%s</h2><div class=\"wide\"><table><tr><th>point</th>",
            bayesopt_objective_count(bo) > 1 ? "Pareto set" : "Best points");
    cell(out, "th", "f");
    for (size_t k = 0; k < names->m; k++)
        cell(out, "th", names->constraints[k]);
    for (size_t j = 0; j < names->d; j++)
        cell(out, "th", names->variables[j]);
    fputs("</tr>\n", out);
    for (size_t i = 0; i < n && !bayesopt_get(bo, rows[i], &p); i++) {
        fprintf(out, "<tr><td>%llu%s</td>", (unsigned long long)p.id,
                p.feasible ? "" : " (outside the limits)");
        number_cell(out, p.f);
        for (size_t k = 0; k < names->m; k++)
            number_cell(out, p.constraints[k]);
        for (size_t j = 0; j < names->d; j++) {
            char buffer[VALUE_SIZE];
            const char *text = names_value(names, j, p.x[j], buffer);
            if (text == buffer)
                number_cell(out, p.x[j]);
            else
                cell(out, "td", text);
        }
        fputs("</tr>\n", out);
    }
    fputs("</table></div></section>\n", out);
    free(rows);
    return true;
}

static bool figure(FILE *out, bayesopt *bo, const struct names *names, picture *draw, bool narrow,
                   const char *caption)
{
    struct plot sheet;
    if (!draw(&sheet, bo, names))
        return false;
    fputs(narrow ? "<figure class=\"narrow\">\n" : "<figure>\n", out);
    plot_embed(&sheet, out);
    fputs("<figcaption>", out);
    plot_escape(out, caption);
    fputs("</figcaption></figure>\n", out);
    return true;
}

/* What needs a model: two values at least, and for its leave-one-out one level. */
static bool model_section(FILE *out, bayesopt *bo, const struct names *names)
{
    bayesopt_model_info info;
    double *bounds = malloc(2 * names->d * sizeof *bounds);
    size_t movable = 0, numbers = 0;
    bool good = bounds || cli_refuse("out of memory");
    if (good)
        bayesopt_dimension(bo, bounds, bounds + names->d);
    for (size_t j = 0; j < names->d && good; j++) {
        bool moves = bounds[j] < bounds[names->d + j];
        movable += moves;
        numbers += moves && bayesopt_variable_kind(bo, j) != BAYESOPT_KIND_CATEGORICAL;
    }
    free(bounds);
    if (!good || !movable)
        return good;
    bayesopt_status status = bayesopt_model(bo, &info, NULL);
    if (status)
        return status != BAYESOPT_ERROR_MEMORY || cli_refuse("%s", bayesopt_last_error());
    fprintf(out,
            "<section><h2>Model</h2><p class=\"sub\">fitted to %zu values; transform %s; "
            "leave-one-out error %.3g of the spread</p>\n",
            info.n, bayesopt_transform_name(info.transform), info.loo_rms);
    good = figure(out, bo, names, picture_indices, false,
                  "Sobol' indices of the model's mean: the share of its variance over the box that "
                  "a variable explains, alone and together with others.");
    good = good && figure(out, bo, names, picture_slices, false,
                          "Along each variable through the best point, with two standard "
                          "deviations.");
    if (good && numbers > 1)
        good =
            figure(out, bo, names, picture_contours, false,
                   "Along pairs of the variables that matter most; the cross is the best point.");
    if (good && bayesopt_level_count(bo) == 1)
        good = figure(out, bo, names, picture_loo, true,
                      "Each value beside what the model expects of it from the others, with two "
                      "standard deviations.");
    fputs("</section>\n", out);
    return good;
}

static void failures(FILE *out, const bayesopt *bo)
{
    bayesopt_point p;
    size_t shown = 0, all = 0;
    for (size_t i = 0; !bayesopt_get(bo, i, &p); i++) {
        if (p.state != BAYESOPT_STATE_FAILED && p.state != BAYESOPT_STATE_LOST)
            continue;
        if (!all++)
            fputs("<section><h2>Failures</h2><table><tr><th>point</th><th>state</th><th>reason"
                  "</th></tr>\n",
                  out);
        if (shown == FAILURES)
            continue;
        shown++;
        fprintf(out, "<tr><td>%llu</td>", (unsigned long long)p.id);
        cell(out, "td", bayesopt_state_name(p.state));
        fputs("<td style=\"white-space:normal\">", out);
        plot_escape(out, p.note);
        fputs("</td></tr>\n", out);
    }
    if (all)
        fputs("</table>", out);
    if (all > shown)
        fprintf(out, "<p class=\"sub\">and %zu more</p>", all - shown);
    if (all)
        fputs("</section>\n", out);
}

static bool write_page(FILE *out, bayesopt *bo, const struct names *names, const char *path)
{
    fputs(HEAD, out);
    fputs("<title>", out);
    plot_escape(out, path);
    fputs("</title>\n", out);
    fputs(STYLE, out);
    fputs("</head><body><main>\n", out);
    summary(out, bo, path);
    bool good = best_table(out, bo, names);
    fputs("<section><h2>History</h2>\n", out);
    good =
        good && figure(out, bo, names, picture_history, false, "Every value, and the best so far.");
    if (good && bayesopt_objective_count(bo) > 1)
        good = figure(out, bo, names, picture_front, false,
                      "The objectives against each other, the Pareto set marked.");
    good = good && figure(out, bo, names, picture_parallel, false,
                          "Each point as a line across its variables.");
    fputs("</section>\n", out);
    good = good && model_section(out, bo, names);
    failures(out, bo);
    fputs("</main></body></html>\n", out);
    return good;
}

static bool report(const struct arguments *a)
{
    bayesopt *bo;
    struct names names;
    struct output output;
    if (!store_open(a->store, &bo, &names))
        return false;
    bool good = bayesopt_best_told(bo, NULL, NULL, NULL) >= 0 ||
                cli_refuse("%s: %s", a->store, bayesopt_last_error());
    good = good && output_open(&output, a->output);
    if (good && !write_page(output.stream, bo, &names, a->store)) {
        cli_file_abandon(&output.file);
        good = false;
    } else if (good) {
        good = output_close(&output) && (!a->json || print_file(a->output, bo));
    }
    names_free(&names);
    bayesopt_free(bo);
    return good;
}

int command_report(int argc, char **argv)
{
    struct arguments a = {0};
    settings_start(&TABLE, &a);
    int code = settings_options(argc, argv, &TABLE, &a, NULL, NULL);
    if (code < 0)
        code = report(&a) ? CLI_OK : CLI_FAILED;
    settings_free(&TABLE, &a);
    return code;
}
