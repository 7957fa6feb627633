/* A file made for its shape has as many spans as the shape needs, which may be a single one; waves
 * need more. 400 unknowns keep C_w of a Wigley hull within 1 % of its limit for Fr >= 0.25 and that
 * of a submerged spheroid within 1e-3 for Fr >= 0.30 (docs/validation.md). */
#include "resolution.h"

#include "cli.h"

#include <math.h>
#include <stdlib.h>

static const double WANTED = 400.0, RATIO = 1.5; /* unknowns; mesh widths of a ladder */

enum { MOST_PARTS = 64, SAMPLES = 33 };

/* One patch, along the hull and around it: knot spans, length of the middle line, degree of the
 * density. */
struct extent {
    double spans[2], length[2], degree[2];
};

static int measure(const nurbs_surface *surface, int least_degree, struct extent *extent)
{
    double low[2], high[2], uv[SAMPLES][2], xyz[SAMPLES][3], gain[2];
    for (int d = 0; d < 2; d++) {
        int degree = nurbs_surface_degree(surface, d);
        size_t size = nurbs_surface_size(surface, d);
        const double *knots = nurbs_surface_knots(surface, d);
        double *breaks = malloc((size + 1) * sizeof *breaks);
        if (!breaks)
            return 0;
        extent->spans[d] = (double)nurbs_knots_distinct(degree, size, knots, breaks, NULL) - 1.0;
        extent->degree[d] = degree > least_degree ? degree : least_degree;
        low[d] = knots[degree];
        high[d] = knots[size];
        free(breaks);
    }
    for (int d = 0; d < 2; d++) {
        for (int i = 0; i < SAMPLES; i++) {
            uv[i][d] = low[d] + (high[d] - low[d]) * i / (SAMPLES - 1.0);
            uv[i][1 - d] = 0.5 * (low[1 - d] + high[1 - d]);
        }
        if (nurbs_surface_eval(surface, 0, SAMPLES, uv[0], xyz[0]))
            return 0;
        gain[d] = fabs(xyz[SAMPLES - 1][0] - xyz[0][0]);
        extent->length[d] = 0.0;
        for (int i = 1; i < SAMPLES; i++)
            extent->length[d] += hypot(hypot(xyz[i][0] - xyz[i - 1][0], xyz[i][1] - xyz[i - 1][1]),
                                       xyz[i][2] - xyz[i - 1][2]);
    }
    if (gain[1] > gain[0])
        *extent = (struct extent){.spans = {extent->spans[1], extent->spans[0]},
                                  .length = {extent->length[1], extent->length[0]},
                                  .degree = {extent->degree[1], extent->degree[0]}};
    return 1;
}

static double unknowns(size_t n, const struct extent *extent, const int parts[2])
{
    double sum = 0.0;
    for (size_t p = 0; p < n; p++)
        sum += (extent[p].spans[0] * parts[0] + extent[p].degree[0]) *
               (extent[p].spans[1] * parts[1] + extent[p].degree[1]);
    return sum;
}

/* Elements may be longer than wide by the square root of the patch's own ratio: more than zero
 * means that the direction along is due to be divided. Mean over the patches. */
static double lag(size_t n, const struct extent *extent, const int parts[2])
{
    double sum = 0.0;
    for (size_t p = 0; p < n; p++)
        sum += 0.5 * log(extent[p].length[0] / extent[p].length[1]) -
               log(extent[p].spans[0] * parts[0] / (extent[p].spans[1] * parts[1]));
    return sum;
}

int resolution_by_rule(const struct hull_input *input, int levels, igabem_options *options)
{
    size_t n = nurbs_patches_count(input->patches);
    struct extent *extent = calloc(n, sizeof *extent);
    int parts[2] = {1, 1}, ok = extent != NULL;
    for (size_t p = 0; ok && p < n; p++)
        ok = measure(nurbs_patches_get(input->patches, p), options->degree, &extent[p]);
    double wanted = levels > 1 ? WANTED / pow(RATIO, 2.0 * (levels - 2)) : WANTED;
    while (ok && unknowns(n, extent, parts) < wanted && parts[0] < MOST_PARTS &&
           parts[1] < MOST_PARTS)
        parts[lag(n, extent, parts) >= 0.0 ? 0 : 1]++;
    free(extent);
    if (!ok)
        return cli_fail("out of memory");
    options->refine = parts[0];
    options->refine_v = parts[1];
    return CLI_OK;
}
