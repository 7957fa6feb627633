#include "plot/plot.h"
#include "report/outputs.h"
#include "report/parts.h"
#include "report/pictures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* y/L of the longitudinal cut. */
static const double CUT = 0.15;

static void figure(FILE *out, const char *caption)
{
    fputs("<figcaption>", out);
    plot_escape(out, caption);
    fputs("</figcaption></figure>\n", out);
}

static void latent_section(FILE *out, const struct results *r)
{
    fputs("<section><h2>Latent space</h2><div class=\"two\"><figure>\n", out);
    draw_variance(out, r);
    figure(out, "Geometric variance retained by the leading modes.");
    fputs("<figure>\n", out);
    draw_error(out, r);
    figure(out, "Mean square error of the reconstruction, as a function of the modes kept.");
    fputs("</div><div class=\"two\">\n", out);
    for (size_t k = 0; k < 3 && k < galv_model_modes(r->problem->model); k++) {
        fputs("<figure>\n", out);
        draw_mode(out, r, k);
        fputs("</figure>\n", out);
    }
    fputs("<p class=\"note\">The leading modes on the original hull, seen from the port bow: "
          "blue where the mode leaves the surface alone, yellow where it moves it most at the "
          "root mean square of its coordinate. White: still water.</p></div></section>\n",
          out);
}

static void hull_section(FILE *out, const struct results *r)
{
    fputs("<section><h2>Hulls</h2><figure>\n", out);
    draw_lines(out, r);
    figure(out,
           "Lines of both hulls, stations numbered from 0 at the aft perpendicular to 20 at the "
           "fore perpendicular.");
    fputs("<div class=\"two\"><div><figure>\n", out);
    draw_original(out, r);
    fputs("</figure><figure>\n", out);
    draw_optimum(out, r);
    fputs("</figure></div><figure>\n", out);
    draw_section_areas(out, r);
    figure(out, "Sectional-area curves below the still water.");
    fputs("<figure>\n", out);
    draw_fairness(out, r);
    figure(out, "Slope of the waterline: every extremum is an inflection, every kink a knuckle.");
    fputs("</div>\n", out);
    report_particulars(out, r);
    fputs("</section>\n", out);
}

static void history_section(FILE *out, const struct results *r)
{
    fputs("<section><h2>Search</h2><figure>\n", out);
    draw_history(out, r);
    figure(out,
           "Every evaluated design and the best so far. Hollow: outside a limit that the solve "
           "tells. Designs above the frame stand on its upper edge, failed ones above it.");
    report_failures(out, r);
    fputs("</section>\n", out);
}

static void wave_section(FILE *out, const struct results *r)
{
    if (!r->waves[0].elevation)
        return;
    fputs("<section><h2>Waves</h2><figure>\n", out);
    draw_waves(out, r);
    figure(out, "Wave elevation: the original above the centre line, the optimum below, in the "
                "same colours. Grey: waterplanes. Dashed: Kelvin's wedge, 19.47 degrees.");
    char caption[80];
    snprintf(caption, sizeof caption, "Longitudinal wave cut at y = %.2f L.", CUT);
    fputs("<figure>\n", out);
    draw_wave_cut(out, r, CUT);
    figure(out, caption);
    fputs("</section>\n", out);
}

void report_write(FILE *out, const struct results *r)
{
    report_head(out, r);
    report_front(out, r);
    history_section(out, r);
    hull_section(out, r);
    wave_section(out, r);
    report_verification(out, r);
    report_agreement(out, r);
    latent_section(out, r);
    report_model(out, r);
    report_settings(out, r);
    fputs("</main></body></html>\n", out);
}
