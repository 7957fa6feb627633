#include "core/error.h"

#include <igabem/ladder.h>

#include <math.h>

static const double finer = 1.5; /* a level than the one before, in parts a span */
static const double least_order = 0.01, most_order = 20.0, margin = 0.01;

static int parts_on_level(int first, size_t level)
{
    int parts = first = first > 0 ? first : 1;
    for (size_t k = 1; k <= level; k++) {
        int next = (int)lround(first * pow(finer, (double)k));
        parts = next > parts ? next : parts + 1;
    }
    return parts;
}

void igabem_ladder_level(size_t level, igabem_options *options)
{
    if (!options || level == 0)
        return;
    options->refine = parts_on_level(options->refine, level);
    if (options->refine_v > 0)
        options->refine_v = parts_on_level(options->refine_v, level);
    if (options->surface_cells > 0)
        options->surface_cells = round(options->surface_cells * pow(finer, (double)level));
    if (options->surface_rows > 0)
        options->surface_rows = round(options->surface_rows * pow(finer, (double)level));
}

size_t igabem_ladder_unknowns(size_t levels)
{
    return (size_t)(400.0 / pow(finer, levels > 1 ? 2.0 * (double)(levels - 2) : 0.0));
}

/* (c0 - c1)/(c1 - c2) = (h0^p - h1^p)/(h1^p - h2^p), which grows with p; bisection. */
igabem_status igabem_ladder_order(const double h[3], const double c[3], double *order,
                                  double *limit)
{
    if (!h || !c || !order || !limit)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_ladder_order");
    if (!(h[0] > h[1] && h[1] > h[2] && h[2] > 0))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "mesh widths %g, %g, %g: expected positive and decreasing", h[0], h[1],
                           h[2]);
    *order = *limit = NAN;
    double ratio = (c[0] - c[1]) / (c[1] - c[2]);
    double low = least_order, high = most_order;
    for (int i = 0; i < 200; i++) {
        double p = 0.5 * (low + high);
        double model = (pow(h[0], p) - pow(h[1], p)) / (pow(h[1], p) - pow(h[2], p));
        if (!(model > ratio))
            low = p;
        else
            high = p;
    }
    double p = 0.5 * (low + high);
    if (!isfinite(ratio) || p < least_order + margin || p > most_order - 10.0 * margin)
        return IGABEM_OK;
    *order = p;
    *limit = c[2] + (c[2] - c[1]) / (pow(h[1] / h[2], p) - 1.0);
    return IGABEM_OK;
}
