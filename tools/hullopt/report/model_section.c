#include "cli.h"
#include "core/objective.h"
#include "plot/ship.h"
#include "report/parts.h"

#include <math.h>
#include <stdlib.h>

enum { HALF = 550, MOST_DIRECTIONS = 100, NAME = 40 };

static void name_directions(const struct results *r, char (*text)[NAME], char **names)
{
    const struct config *c = r->problem->config;
    for (size_t j = 0; j < r->model.d; j++) {
        if (config_by_command(c))
            snprintf(text[j], NAME, "%.39s", c->parameter[j]);
        else
            snprintf(text[j], NAME, "%s %zu", c->space ? "parameter" : "direction", j + 1);
        names[j] = text[j];
    }
}

static void draw_indices(FILE *out, const struct search_model *m, size_t k, const size_t *order,
                         char *const *names)
{
    struct plot plot;
    if (plot_indices(&plot, HALF, m->d, m->first + k * m->d, m->total + k * m->d, order, names))
        plot_embed(&plot, out);
}

/* One row of a direction: its share of the geometric variance, the box, the model's length. */
static void direction_row(FILE *out, const struct results *r, size_t j, const char *name)
{
    const struct search_model *m = &r->model;
    const galv_model *latent = r->problem->model;
    double lower = galv_model_lower(latent)[j], upper = galv_model_upper(latent)[j];
    fputs("<tr><td>", out);
    plot_escape(out, name);
    fprintf(out,
            "</td><td class=\"n\">%.1f %%</td><td class=\"n\">%.3g</td><td class=\"n\">%.3g</td>"
            "<td class=\"n\">%.2f</td>",
            100 * galv_model_eigenvalues(latent)[j] / galv_model_trace(latent), lower, upper,
            m->scale[j] / (upper - lower));
    for (size_t k = 0; k < m->objectives; k++)
        fprintf(out, "<td class=\"n\">%.2f, %.2f</td>", m->first[k * m->d + j],
                m->total[k * m->d + j]);
    fputs("</tr>\n", out);
}

static void table(FILE *out, const struct results *r, const size_t *order, char *const *names)
{
    struct objective o;
    fputs("<table><thead><tr><th>variable</th><th class=\"n\">of the geometric variance</th>"
          "<th class=\"n\">from</th><th class=\"n\">to</th>"
          "<th class=\"n\">length scale over its range</th>",
          out);
    for (size_t k = 0; k < r->model.objectives; k++) {
        objectives_describe(r->problem->config, k, &o);
        fputs("<th class=\"n\">alone, with others", out);
        if (r->model.objectives > 1) {
            fputs(": ", out);
            plot_escape(out, o.name);
        }
        fputs("</th>", out);
    }
    fputs("</tr></thead><tbody>\n", out);
    for (size_t j = 0; j < r->model.d; j++)
        direction_row(out, r, order[j], names[order[j]]);
    fputs("</tbody></table>\n", out);
}

void report_model(FILE *out, const struct results *r)
{
    const struct search_model *m = &r->model;
    char text[MOST_DIRECTIONS][NAME], *names[MOST_DIRECTIONS];
    size_t order[MOST_DIRECTIONS];
    struct plot plot;
    if (!m->known || m->d > MOST_DIRECTIONS)
        return;
    name_directions(r, text, names);
    plot_order(m->d, m->total, order);
    fprintf(
        out,
        "<section><h2>What the search knows</h2><p class=\"note\">Its Gaussian process, fitted to "
        "%zu designs (transform of the objective: %s). Leave-one-out error: %.2g of the standard "
        "deviation of the values.</p><div class=\"two\"><div>\n",
        m->info.n, bayesopt_transform_name(m->info.transform), m->info.loo_rms);
    for (size_t k = 0; k < m->objectives; k++) {
        struct objective o;
        objectives_describe(r->problem->config, k, &o);
        fputs("<figure>\n", out);
        draw_indices(out, m, k, order, names);
        fputs(
            "<figcaption>Share of the variance over the box that each variable explains, alone and "
            "with others: ",
            out);
        plot_escape(out, o.name);
        fputs(".</figcaption></figure>\n", out);
    }
    fputs("</div><figure>\n", out);
    if (plot_leave_one_out(&plot, HALF, m->n, m->told, m->mean, m->sd))
        plot_embed(&plot, out);
    fputs(
        "<figcaption>Each value, over the original's, beside what the model expects of it from all "
        "others, with two standard deviations.</figcaption></figure></div>\n",
        out);
    table(out, r, order, names);
    fputs("</section>\n", out);
}
