#include "plot/plot.h"
#include "report/agreement.h"
#include "report/parts.h"

#include <math.h>

static const char *const colours[FORMULATIONS_MOST] = {PLOT_INK,      PLOT_OPTIMUM, PLOT_BLUE,
                                                       PLOT_ORIGINAL, PLOT_RED,     PLOT_PALE};

/* Every design by the search's formulation and by the others. */
static void scatter(FILE *out, const struct agreement *a)
{
    enum { SIDE = 420, EDGE = 66 };
    struct plot_frame f = {.left = EDGE, .top = 16, .width = SIDE, .height = SIDE};
    struct plot_legend legend[FORMULATIONS_MOST];
    struct plot plot;
    char title[80], label[80];
    snprintf(title, sizeof title, "Designs by each formulation, Fr %g", a->froude);
    snprintf(label, sizeof label, "C_{w} over the original's by %s", a->name[0]);
    f.x = (struct plot_axis){.low = 1, .high = 1, .label = label};
    f.y = (struct plot_axis){.low = 1, .high = 1, .label = "by the others"};
    for (size_t k = 0; k < a->models; k++) {
        plot_include(k ? &f.y : &f.x, a->n, a->ratio[k]);
        legend[k] = (struct plot_legend){a->name[k], {colours[k], 2, NULL}, PLOT_DOT};
    }
    if (!plot_open(&plot, EDGE + SIDE + 180, SIDE + 70, title))
        return;
    plot_axes(&plot, &f);
    plot_clip(&plot, &f);
    double low = fmax(f.x.low, f.y.low), high = fmin(f.x.high, f.y.high);
    plot_line(&plot, plot_x(&f, low), plot_y(&f, low), plot_x(&f, high), plot_y(&f, high),
              (struct plot_pen){PLOT_MUTED, 1, "5 3"});
    for (size_t k = 1; k < a->models; k++)
        for (size_t i = 0; i < a->n; i++)
            plot_mark(&plot, plot_x(&f, a->ratio[0][i]), plot_y(&f, a->ratio[k][i]), PLOT_DOT, 3.5,
                      colours[k], NULL);
    plot_unclip(&plot);
    plot_legend(&plot, EDGE + SIDE + 14, 26, true, a->models - 1, legend + 1);
    plot_embed(&plot, out);
}

static void table(FILE *out, const struct agreement *a)
{
    fprintf(out, "<table><thead><tr><th>Fr %g</th>", a->froude);
    for (size_t l = 0; l < a->models; l++)
        fprintf(out, "<th class=\"n\">%s</th>", a->name[l]);
    fputs("</tr></thead><tbody>\n", out);
    for (size_t k = 0; k < a->models; k++) {
        fprintf(out, "<tr><td>%s</td>", a->name[k]);
        for (size_t l = 0; l < a->models; l++)
            fprintf(out, isfinite(a->rank[k][l]) ? "<td class=\"n\">%.2f</td>" : "<td></td>",
                    a->rank[k][l]);
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table>\n", out);
}

void report_agreement(FILE *out, const struct results *r)
{
    struct agreement a;
    for (size_t s = 0; s <= r->problem->speeds && agreement_of(r, s, &a); s++) {
        if (s == 0)
            fprintf(out,
                    "<section><h2>How alike the models rank</h2><p class=\"note\">Spearman's "
                    "correlation of the ranks that two formulations give the %zu designs of this "
                    "run: 1, they agree which is better; 0, one tells nothing of the other.</p>\n",
                    a.n);
        fputs("<div class=\"two\"><div>\n", out);
        table(out, &a);
        fputs("</div><figure>\n", out);
        scatter(out, &a);
        fputs("</figure></div>\n", out);
        agreement_free(&a);
    }
    if (r->problem->config->models > 0)
        fputs("</section>\n", out);
}
