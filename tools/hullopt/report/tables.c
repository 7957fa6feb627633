#include "cli.h"
#include "core/constraints.h"
#include "plot/plot.h"
#include "report/particulars.h"
#include "report/parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void cell(FILE *out, const char *format, double value)
{
    fputs("<td class=\"n\">", out);
    if (isfinite(value))
        fprintf(out, format, value);
    else
        fputs("–", out);
    fputs("</td>", out);
}

/* The constraints are figures before and after like the others, with their limits beside them. */
static void constraint_row(FILE *out, const struct results *r, size_t k)
{
    struct constraint_figures f;
    char format[16];
    constraints_figures(r->problem->config, k, r->baseline, r->best, &f);
    if (f.is_optional && isnan(f.allowed))
        return;
    snprintf(format, sizeof format, "%%.%df", f.decimals);
    fprintf(out, "<tr class=\"total\"><td>Constraint: %s</td><td>%s</td>", f.label, f.unit);
    cell(out, format, f.scale * f.before);
    cell(out, format, f.scale * f.after);
    cell(out, "%+.2f %%", 100 * f.change);
    fprintf(out, "<td>%s%s</td></tr>\n", f.limit,
            isnan(f.allowed) ? ""
            : f.kept         ? ", kept"
                             : ", violated");
}

static void total_row(FILE *out, const char *label, const char *unit, const char *format,
                      double before, double after)
{
    fprintf(out, "<tr class=\"total\"><td>%s</td><td>%s</td>", label, unit);
    cell(out, format, before);
    cell(out, format, after);
    cell(out, "%+.1f %%", 100 * (after / before - 1));
    fputs("<td></td></tr>\n", out);
}

void report_particulars(FILE *out, const struct results *r)
{
    struct particular list[PARTICULARS_MOST];
    size_t n = particulars_list(r, list);
    fputs("<table><thead><tr><th>Particulars and constraints</th><th>unit</th>"
          "<th class=\"n\">original</th><th class=\"n\">optimum</th><th class=\"n\">change</th>"
          "<th>limit</th></tr></thead><tbody>\n",
          out);
    double total[2];
    char label[80];
    results_total_resistance(r, total);
    total_row(out, "Wave resistance coefficient, Kochin function", "10⁻³", "%.4f",
              1e3 * r->baseline->cw, 1e3 * r->best->cw);
    total_row(out, "Wave resistance", "N", "%.2f", r->baseline->rw, r->best->rw);
    snprintf(label, sizeof label, "Total resistance, ITTC-57, form factor %g",
             r->problem->config->form_factor);
    total_row(out, label, "N", "%.2f", total[0], total[1]);
    if (r->problem->config->free_to_trim) {
        total_row(out, "Sinkage at flow.froude", "m", "%.5f", r->baseline->sinkage,
                  r->best->sinkage);
        total_row(out, "Trim at flow.froude, bow up", "degrees", "%.3f", r->baseline->trim,
                  r->best->trim);
    }
    for (size_t k = 0; k < constraints_count(); k++)
        constraint_row(out, r, k);
    for (size_t i = 0; i < n; i++) {
        fprintf(out, "<tr><td>%s</td><td>%s</td>", list[i].label, list[i].unit);
        for (int k = 0; k < 2; k++)
            fprintf(out, "<td class=\"n\">%.*f</td>", list[i].decimals, list[i].value[k]);
        cell(out, "%+.2f %%", 100 * (list[i].value[1] / list[i].value[0] - 1));
        fputs("<td></td></tr>\n", out);
    }
    fputs("</tbody></table>\n", out);
}

void report_failures(FILE *out, const struct results *r)
{
    enum { SHOWN = 20 };
    size_t shown = 0;
    if (r->failed == 0)
        return;
    fprintf(out,
            "<details><summary>%zu designs could not be evaluated</summary><table><thead><tr>"
            "<th>design</th><th>stage</th><th>reason</th></tr></thead><tbody>\n",
            r->failed);
    for (size_t i = 0; i < r->n && shown < SHOWN; i++) {
        const struct evaluation *e = &r->evaluations[i];
        if (!e->failed)
            continue;
        int stage = (int)strcspn(e->reason, ":");
        fprintf(out, "<tr><td>%llu</td><td>%.*s</td><td>", (unsigned long long)e->id, stage,
                e->reason);
        plot_escape(out, e->reason + stage + strspn(e->reason + stage, ": "));
        fputs("</td></tr>\n", out);
        shown++;
    }
    fputs("</tbody></table>", out);
    if (shown < r->failed)
        fprintf(out, "<p class=\"note\">The first %zu; all are in run.db.</p>", shown);
    fputs("</details>\n", out);
}

static void judge_cell(FILE *out, const struct verification *v, const struct verdict *verdict)
{
    double gain = 1 - v->cw_best / v->cw_parent;
    const char *tone = "some", *text = "less";
    if (!isfinite(gain)) {
        tone = "some";
        text = "no result";
    } else if (v->group == GROUP_OBJECTIVE) {
        fputs("<td></td>", out);
        return;
    } else if (gain >= 0.5 * verdict->claimed && gain > 0) {
        tone = "yes";
        text = "confirms";
    } else if (gain <= 0.01) {
        tone = "no";
        text = gain < -0.01 ? "rises" : "no gain";
    }
    fprintf(out, "<td><span class=\"tag %s\">%s</span></td>", tone, text);
}

static void ladder(FILE *out, const struct results *r)
{
    struct results_ladder l;
    if (!results_ladder(r, &l))
        return;
    fprintf(out,
            "<p>The mesh: 10³ C<sub>w</sub> of the optimum is %.4f on two thirds of the "
            "resolution, %.4f on that of the search and %.4f on %g times it, ",
            1e3 * l.cw[0], 1e3 * l.cw[1], 1e3 * l.cw[2], l.refine);
    if (isnan(l.order))
        fputs("which follows no power of the width yet.</p>", out);
    else
        fprintf(out, "of observed order %.1f towards %.4f.</p>", l.order, 1e3 * l.limit);
}

void report_verification(FILE *out, const struct results *r)
{
    if (r->n_rows == 0)
        return;
    fputs("<section><h2>Verification</h2><p class=\"note\">The original and the optimum under the "
          "same settings. A gain that only the model of the search sees belongs to that model, not "
          "to the hull.</p><table><thead><tr><th>setting</th><th>formulation</th>"
          "<th class=\"n\">Fr</th><th class=\"n\">unknowns</th><th class=\"n\">10³ Cw original</th>"
          "<th class=\"n\">10³ Cw optimum</th><th class=\"n\">change</th>"
          "<th class=\"n\">by pressure</th><th></th></tr></thead><tbody>\n",
          out);
    for (size_t i = 0; i < r->n_rows; i++) {
        const struct verification *v = &r->rows[i];
        fprintf(out, "<tr%s><td>%s</td><td>%s</td>", i == 0 ? " class=\"total\"" : "", v->label,
                v->formulation);
        cell(out, "%g", v->froude);
        fprintf(out, "<td class=\"n\">%zu, %zu</td>", v->dofs_parent, v->dofs_best);
        cell(out, "%.4f", 1e3 * v->cw_parent);
        cell(out, "%.4f", 1e3 * v->cw_best);
        cell(out, "%+.1f %%", 100 * (v->cw_best / v->cw_parent - 1));
        cell(out, "%+.1f %%", 100 * (v->cw_pressure_best / v->cw_pressure_parent - 1));
        judge_cell(out, v, &r->verdict);
        fputs("</tr>\n", out);
        if (*v->note) {
            fputs("<tr><td colspan=\"9\" class=\"note\">", out);
            plot_escape(out, v->note);
            fputs("</td></tr>\n", out);
        }
    }
    fputs("</tbody></table>", out);
    ladder(out, r);
    fputs("</section>\n", out);
}

/* Lines of the canonical text are in the order of the table; one of an older run may lack rows. */
static void setting_rows(FILE *out, const char *line)
{
    for (size_t r = 0; r < CONFIG.n; r++) {
        const struct setting *row = &CONFIG.rows[r];
        size_t length = strcspn(line, "\n"), key = row->key ? strlen(row->key) : 0;
        if (!key || strncmp(line, row->key, key) != 0 || strncmp(line + key, " =", 2) != 0)
            continue;
        char *value = cli_needed(strndup(line + key + 2, length - key - 2));
        line += length + (line[length] == '\n');
        if (!*value) {
            free(value);
            continue;
        }
        fputs("<tr title=\"", out);
        plot_escape(out, row->sentence);
        fprintf(out, "\"><td><code>%s</code></td><td>", row->key);
        plot_escape(out, value);
        fputs("</td></tr>\n", out);
        free(value);
    }
}

static void solver_rows(FILE *out, const igabem_options *solver)
{
    bayesopt_attribute list[SOLVER_MOST];
    size_t n = record_solver(solver, list);
    for (size_t i = 0; i < n; i++) {
        fprintf(out, "<tr><td><code>%s</code></td><td>", list[i].name);
        if (list[i].text)
            plot_escape(out, list[i].text);
        else
            fprintf(out, "%.15g", list[i].number);
        fputs("</td></tr>\n", out);
    }
}

static void optimum_parameters(FILE *out, const struct results *r)
{
    fputs("<h3>The optimum</h3><p class=\"note\">Latent point, metres:</p><p><code>", out);
    for (size_t k = 0; k < galv_model_modes(r->problem->model); k++)
        fprintf(out, "%s%.6g", k ? ", " : "", r->best->u[k]);
    fputs("</code></p>\n", out);
    if (!r->parameters)
        return;
    if (r->problem->config->maker.command) {
        fputs("<p class=\"note\">Parameters of the command", out);
        if (r->made)
            fprintf(out,
                    ", whose hull is nearest: %.2f mm root mean square from the optimum, C_w %.4e",
                    1e3 * r->residual, r->made_cw);
        fputs(":</p><p><code>", out);
        for (size_t k = 0; k < r->n_parameters; k++)
            fprintf(out, "%s%s = %.6g", k ? ", " : "", r->problem->config->parameter[k],
                    r->parameters[k]);
        fputs("</code></p>\n", out);
        return;
    }
    fprintf(out,
            "<p class=\"note\">Nearest parameters of the original family, metres; the hull they "
            "give differs by %.2f mm root mean square:</p><p><code>",
            1e3 * r->residual);
    for (size_t k = 0; k < r->n_parameters; k++)
        fprintf(out, "%s%.5f", k ? ", " : "", r->parameters[k]);
    fputs("</code></p>\n", out);
}

void report_settings(FILE *out, const struct results *r)
{
    struct results_times t = results_times(r);
    fputs("<section><h2>Settings</h2><div class=\"two\"><div><table><thead><tr><th>run</th>"
          "<th></th></tr></thead><tbody>\n",
          out);
    setting_rows(out, r->problem->config->text);
    fputs("</tbody></table></div><div><table><thead><tr><th>solver, fixed on the original</th>"
          "<th></th></tr></thead><tbody>\n",
          out);
    solver_rows(out, &r->problem->solver);
    fprintf(out,
            "</tbody></table><table style=\"margin-top:18px\"><thead><tr><th>time of an "
            "evaluation</th><th></th></tr></thead><tbody><tr><td>geometry</td><td>%.3f s</td></tr>"
            "<tr><td>solve</td><td>%.3f s</td></tr><tr><td>proposal</td><td>%.3f s</td></tr>"
            "<tr><td>sessions of the run</td><td>%zu</td></tr></tbody></table>\n",
            t.geometry, t.solve, t.propose, r->sessions);
    optimum_parameters(out, r);
    fputs("</div></div></section>\n", out);
}
