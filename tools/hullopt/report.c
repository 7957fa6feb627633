#include "outputs.h"
#include "report/drawings.h"
#include "report/svg.h"
#include "report_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* y/L of the longitudinal cut. */
static const double CUT = 0.15;

static void figure(FILE *out, const char *caption)
{
    fputs("<figcaption>", out);
    svg_escape(out, caption);
    fputs("</figcaption></figure>\n", out);
}

static void draw_mode(FILE *out, const struct results *r, size_t mode)
{
    size_t rows = nurbs_grid_rows(r->parent.grid), columns = nurbs_grid_columns(r->parent.grid);
    double *size = malloc(rows * columns * sizeof *size), most = 0;
    const double *w = r->latent.vectors + mode * r->latent.coordinates;
    char title[60];
    for (size_t k = 0; size && k < rows * columns; k++) {
        size[k] =
            sqrt(w[3 * k] * w[3 * k] + w[3 * k + 1] * w[3 * k + 1] + w[3 * k + 2] * w[3 * k + 2]);
        most = fmax(most, size[k]);
    }
    snprintf(title, sizeof title, "Mode %zu, %.1f %% of the variance", mode + 1,
             100 * r->latent.eigenvalues[mode] / r->latent.trace);
    const struct hull_view view = {.rows = rows,
                                   .columns = columns,
                                   .points = nurbs_grid_points(r->parent.grid),
                                   .values = size,
                                   .high = most,
                                   .title = title,
                                   .low_label = "0",
                                   .high_label = "max",
                                   .bar_title = "deformation"};
    draw_hull(out, &view);
    free(size);
}

static void latent_section(FILE *out, const struct results *r)
{
    fputs("<section><h2>Latent space</h2><div class=\"two\"><figure>\n", out);
    draw_variance(out, &r->latent, results_number(r->settings, "latent.variance"));
    figure(out, "Geometric variance retained by the leading modes.");
    fputs("<figure>\n", out);
    draw_error(out, &r->latent);
    figure(out, "Mean square error of the reconstruction, as a function of the modes kept.");
    fputs("</div><div class=\"two\">\n", out);
    for (size_t k = 0; k < 3 && k < r->latent.modes; k++) {
        fputs("<figure>\n", out);
        draw_mode(out, r, k);
        fputs("</figure>\n", out);
    }
    fputs("<p class=\"note\">The leading modes on the original hull, seen from the port bow: "
          "blue where the mode leaves the surface alone, yellow where it moves it most. White: "
          "still water.</p></div></section>\n",
          out);
}

static void draw_original(FILE *out, const struct results *r)
{
    const struct hull_view view = {.rows = nurbs_grid_rows(r->parent.grid),
                                   .columns = nurbs_grid_columns(r->parent.grid),
                                   .points = nurbs_grid_points(r->parent.grid),
                                   .title = "Original"};
    draw_hull(out, &view);
}

/* The optimum, coloured by how far each point moved, outwards positive. */
static void draw_optimum(FILE *out, const struct results *r)
{
    size_t n = r->latent.coordinates, points = n / 3;
    double *moved = malloc(n * sizeof *moved), *change = malloc(points * sizeof *change), most = 0;
    const double *parent = nurbs_grid_points(r->parent.grid);
    if (moved && change) {
        latent_displace(&r->latent, r->best->u, moved);
        for (size_t k = 0; k < points; k++) {
            const double *d = moved + 3 * k;
            double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            change[k] = d[1] < 0 ? -length : length;
            most = fmax(most, length);
        }
        for (size_t k = 0; k < n; k++)
            moved[k] += parent[k];
        char low[32], high[32];
        snprintf(low, sizeof low, "−%.0f mm", 1000 * most);
        snprintf(high, sizeof high, "+%.0f mm", 1000 * most);
        const struct hull_view view = {.rows = nurbs_grid_rows(r->parent.grid),
                                       .columns = nurbs_grid_columns(r->parent.grid),
                                       .points = moved,
                                       .values = most > 0 ? change : NULL,
                                       .low = -most,
                                       .high = most,
                                       .diverging = true,
                                       .title = "Optimum",
                                       .low_label = low,
                                       .high_label = high,
                                       .bar_title = "moved outwards"};
        draw_hull(out, &view);
    }
    free(moved);
    free(change);
}

static void hull_section(FILE *out, const struct results *r)
{
    fputs("<section><h2>Hulls</h2><div class=\"two\"><div><figure>\n", out);
    draw_body_plan(out, r);
    figure(out, "Body plans, stations numbered from 0 at the aft perpendicular to 20 at the fore "
                "perpendicular.");
    fputs("</div><div><figure>\n", out);
    draw_original(out, r);
    fputs("</figure><figure>\n", out);
    draw_optimum(out, r);
    fputs("</figure><figure>\n", out);
    draw_section_areas(out, r);
    figure(out, "Sectional-area curves below the still water.");
    fputs("</div></div>\n", out);
    report_particulars(out, r);
    fputs("</section>\n", out);
}

static void history_section(FILE *out, const struct results *r)
{
    fputs("<section><h2>Search</h2><figure>\n", out);
    draw_history(out, r);
    figure(out, "Every evaluated design and the best so far. Designs above the frame stand on its "
                "upper edge.");
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

bool report_write(FILE *out, const struct results *r)
{
    report_head(out, r);
    history_section(out, r);
    hull_section(out, r);
    wave_section(out, r);
    report_verification(out, r);
    latent_section(out, r);
    report_settings(out, r);
    fputs("</main></body></html>\n", out);
    return !ferror(out);
}
