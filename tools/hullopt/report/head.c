#include "plot/plot.h"
#include "report/parts.h"

#include <math.h>

static const char STYLE[] =
    "<style>\n"
    ":root{color-scheme:light}\n"
    "*{box-sizing:border-box}\n"
    "body{margin:0;background:#f4f6f8;color:#1b2733;"
    "font:15px/1.5 system-ui,'Helvetica Neue',Arial,sans-serif}\n"
    "main{max-width:1160px;margin:0 auto;padding:28px 20px 60px}\n"
    "h1{font-size:27px;margin:0 0 2px;letter-spacing:-.01em}\n"
    "h2{font-size:19px;margin:0 0 14px}\n"
    ".sub{color:#5f6c7a;margin:0 0 20px}\n"
    "section{background:#fff;border:1px solid #e0e6eb;border-radius:10px;padding:22px 24px;"
    "margin:0 0 20px}\n"
    ".cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(165px,1fr));gap:12px;"
    "margin:0 0 20px}\n"
    ".card{background:#fff;border:1px solid #e0e6eb;border-radius:10px;padding:13px 16px}\n"
    ".card b{display:block;font-size:20px;font-weight:600;letter-spacing:-.02em;white-space:nowrap;"
    "font-variant-numeric:tabular-nums}\n"
    ".card span{color:#5f6c7a;font-size:13px}\n"
    ".verdict{border-left:5px solid;border-radius:8px;padding:12px 18px;margin:0 0 20px}\n"
    ".yes{background:#eaf6ee;border-color:#2f9e57}.some{background:#fdf5e3;border-color:#d99a1c}\n"
    ".no{background:#fdecea;border-color:#c4372b}\n"
    ".two{display:grid;grid-template-columns:1fr 1fr;gap:20px}.two>*{min-width:0}\n"
    "figure{margin:0 0 12px}svg{width:100%;height:auto;display:block}\n"
    "figcaption,.note{color:#5f6c7a;font-size:13px;margin:4px 0 0}\n"
    "table{border-collapse:collapse;width:100%;font-size:14px;"
    "font-variant-numeric:tabular-nums}\n"
    "th{text-align:left;font-weight:600;color:#5f6c7a;border-bottom:2px solid #e0e6eb}\n"
    "th,td{padding:5px 10px 5px 0}td{border-bottom:1px solid #eef1f4}\n"
    ".n{text-align:right}tr.total td{font-weight:600}\n"
    ".tag{border-radius:4px;padding:1px 7px;font-size:12px;white-space:nowrap}\n"
    "code{font:13px/1.5 ui-monospace,Menlo,Consolas,monospace;overflow-wrap:anywhere}\n"
    /* On a phone tables and pictures move sideways in their own place: letters stay readable. */
    "@media screen and (max-width:800px){main{padding:16px 8px 40px}section{padding:16px 12px}"
    ".two{grid-template-columns:minmax(0,1fr)}figure,table{overflow-x:auto}table{display:block}"
    "svg{min-width:460px}svg[viewBox^='0 0 1120']{min-width:1010px}"
    ".card b{white-space:normal}}\n"
    /* Paper lies on its side, as wide as the pictures. */
    "@page{size:A4 landscape;margin:6mm}\n"
    "@media print{body{background:#fff}main{max-width:none;padding:0}"
    "section{border:0;padding:0}body,p,.note{font-size:12px}table,code{font-size:11px}"
    "th,td{padding:2px 8px 2px 0}.card "
    "b{font-size:15px}svg{max-height:185mm}figure,tr,.card,.verdict,h2{break-inside:avoid}"
    "h2,thead{break-after:avoid}}\n"
    "</style>\n";

static void card(FILE *out, const char *value, const char *label)
{
    fputs("<div class=\"card\"><b>", out);
    plot_escape(out, value);
    fputs("</b><span>", out);
    plot_escape(out, label);
    fputs("</span></div>\n", out);
}

static void duration(char *text, size_t size, double seconds)
{
    if (seconds < 120)
        snprintf(text, size, "%.1f s", seconds);
    else
        snprintf(text, size, "%d min %02d s", (int)(seconds / 60), (int)fmod(seconds, 60));
}

static void cards(FILE *out, const struct results *r)
{
    char value[80], label[120];
    struct results_times times = results_times(r);
    fputs("<div class=\"cards\">\n", out);
    if (r->problem->config->judge.command) {
        snprintf(value, sizeof value, "%+.1f %%", 100 * (r->best->value / r->baseline->value - 1));
        card(out, value, "objective of the command, which was lowered");
    }
    snprintf(value, sizeof value, "%+.1f %%", 100 * (r->best->cw / r->baseline->cw - 1));
    card(out, value, "wave resistance coefficient");
    snprintf(value, sizeof value, "%.3f → %.3f", 1e3 * r->baseline->cw, 1e3 * r->best->cw);
    card(out, value, "10³ Cw, original → optimum");
    double total[2];
    results_total_resistance(r, total);
    if (isfinite(total[0])) {
        snprintf(value, sizeof value, "%+.1f %%", 100 * (total[1] / total[0] - 1));
        card(out, value, "total resistance by ITTC-57");
    }
    snprintf(value, sizeof value, "%+.2f %%", 100 * (r->best->volume_ratio - 1));
    card(out, value, "displacement");
    snprintf(value, sizeof value, "%zu of %zu", galv_model_modes(r->problem->model),
             results_parameters(r));
    snprintf(label, sizeof label, "latent variables, %.2f %% of the variance",
             100 * galv_model_retained(r->problem->model));
    card(out, value, label);
    snprintf(value, sizeof value, "%zu", r->n - 1);
    snprintf(label, sizeof label, "designs evaluated, %zu failed", r->failed);
    card(out, value, label);
    duration(value, sizeof value, r->seconds);
    snprintf(label, sizeof label, "in all, %.2f s an evaluation", times.evaluation);
    card(out, value, label);
    fputs("</div>\n", out);
}

static void verdict(FILE *out, const struct results *r)
{
    const struct verdict *v = &r->verdict;
    const char *tone = v->formulations                       ? "yes"
                       : v->only_objective || v->models == 0 ? "no"
                                                             : "some";
    if (r->n_rows == 0)
        tone = "some";
    fprintf(out, "<div class=\"verdict %s\">", tone);
    plot_escape(out, results_statement(r));
    fputs("</div>\n", out);
}

void report_head(FILE *out, const struct results *r)
{
    const struct config *config = r->problem->config;
    fputs("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
          "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"><title>",
          out);
    plot_escape(out, config->name);
    fprintf(out, "</title>\n%s</head><body><main>\n<h1>", STYLE);
    plot_escape(out, config->name);
    fprintf(out, "</h1>\n<p class=\"sub\">hullopt %s · Fr %g · %s · length %.4g m%s</p>\n",
            TOOL_VERSION, config->solver.froude,
            igabem_formulation_name(r->problem->solver.formulation), problem_length(r->problem),
            r->chosen     ? " · one design of the run"
            : r->complete ? ""
                          : " · run not finished");
    verdict(out, r);
    cards(out, r);
}
