#include "core/objective.h"
#include "plot/plot.h"
#include "report/parts.h"
#include "report/pictures.h"

#include <math.h>

static void heading(FILE *out, const struct config *config)
{
    struct objective o;
    fputs("<table><thead><tr><th>design</th>", out);
    for (size_t k = 0; k < objectives_count(config); k++) {
        objectives_describe(config, k, &o);
        fputs("<th class=\"n\">", out);
        plot_escape(out, o.label);
        fprintf(out, "%s</th><th class=\"n\">change</th>", o.maximise ? ", raised" : "");
    }
    fputs("<th class=\"n\">C_w</th><th class=\"n\">displacement</th></tr></thead><tbody>\n", out);
}

static void design_row(FILE *out, const struct results *r, const struct evaluation *e)
{
    const struct config *config = r->problem->config;
    fprintf(out, "<tr%s><td>%llu%s</td>", e == r->best ? " class=\"total\"" : "",
            (unsigned long long)e->id,
            e == r->baseline ? ", the original"
            : e == r->best   ? ", shown here"
                             : "");
    for (size_t k = 0; k < objectives_count(config); k++) {
        double before = results_objective(r, k, r->baseline), after = results_objective(r, k, e);
        fprintf(out, "<td class=\"n\">%.5g</td>", after);
        if (before > 0)
            fprintf(out, "<td class=\"n\">%+.2f %%</td>", 100 * (after / before - 1));
        else
            fprintf(out, "<td class=\"n\">%+.3g</td>", after - before);
    }
    fprintf(out, "<td class=\"n\">%+.1f %%</td><td class=\"n\">%+.2f %%</td></tr>\n",
            100 * (e->cw / r->baseline->cw - 1), 100 * (e->volume / r->baseline->volume - 1));
}

void report_front(FILE *out, const struct results *r)
{
    if (objectives_count(r->problem->config) == 1)
        return;
    fputs("<section><h2>Pareto set</h2><figure>\n", out);
    draw_front(out, r);
    fprintf(out,
            "<figcaption>Every evaluated design by its objectives. In the set are those of which "
            "none is better in one without being worse in another: %zu. The rest of this page is "
            "about %s.</figcaption></figure>\n",
            r->n_front,
            r->chosen ? "one chosen design" : "the one nearest to the best of each objective");
    heading(out, r->problem->config);
    for (size_t i = 0; i < r->n_front; i++)
        design_row(out, r, &r->evaluations[r->front[i]]);
    fputs(
        "</tbody></table><p class=\"note\"><code>hullopt report RUN --design N --out FOLDER</code> "
        "writes hull and page of another one.</p></section>\n",
        out);
}
