#include "influence/spectrum.h"

#include "core/error.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum { PANEL_POINTS = 10 };
static const double panel_phase = 20.0, panel_angle = 0.4;

double spectrum_filter(double t, double cutoff)
{
    if (isinf(cutoff))
        return 1.0;
    double ratio = (1.0 + t * t) / (1.0 + cutoff * cutoff);
    return exp(-ratio * ratio);
}

double spectrum_limit(double k0, double cutoff, double depth, double tolerance)
{
    double decades = -log(tolerance), square = INFINITY;
    if (!isinf(cutoff))
        square = (1.0 + cutoff * cutoff) * sqrt(decades) - 1.0;
    if (depth > 0)
        square = fmin(square, decades / (k0 * depth) - 1.0);
    return sqrt(fmax(square, 1.0));
}

/* End of the panel that starts at t0. */
static double panel_end(double k0, double length, double beam, double t0, double t_max)
{
    double t1 = fmin(t_max, sinh(asinh(t0) + panel_angle));
    double start = sqrt(1.0 + t0 * t0) * (length + t0 * beam);
    while (k0 * (sqrt(1.0 + t1 * t1) * (length + t1 * beam) - start) > panel_phase)
        t1 = t0 + 0.8 * (t1 - t0);
    return t1;
}

igabem_status spectrum_create(double k0, double t_max, double length, double beam,
                              struct spectrum **result)
{
    *result = NULL;
    double node[PANEL_POINTS], weight[PANEL_POINTS];
    if (nurbs_gauss_legendre(PANEL_POINTS, node, weight) != NURBS_OK)
        return igabem_fail(IGABEM_ERROR_NUMERIC, "%s", nurbs_last_error());
    size_t panels = 0;
    for (double t = 0.0; t < t_max; panels++)
        t = panel_end(k0, length, beam, t, t_max);
    size_t n = PANEL_POINTS * panels;
    struct spectrum *spectrum = calloc(1, sizeof *spectrum);
    if (spectrum)
        spectrum->t = malloc(3 * n * sizeof *spectrum->t);
    if (!spectrum || !spectrum->t) {
        spectrum_free(spectrum);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu wave angles", n);
    }
    spectrum->n = n;
    spectrum->weight = spectrum->t + n;
    spectrum->root = spectrum->t + 2 * n;
    double t0 = 0.0;
    for (size_t k = 0; k < panels; k++) {
        double t1 = panel_end(k0, length, beam, t0, t_max);
        for (size_t i = 0; i < PANEL_POINTS; i++) {
            double t = t0 + (t1 - t0) * node[i];
            spectrum->t[k * PANEL_POINTS + i] = t;
            spectrum->weight[k * PANEL_POINTS + i] = (t1 - t0) * weight[i];
            spectrum->root[k * PANEL_POINTS + i] = sqrt(1.0 + t * t);
        }
        t0 = t1;
    }
    *result = spectrum;
    return IGABEM_OK;
}

void spectrum_free(struct spectrum *spectrum)
{
    if (spectrum)
        free(spectrum->t);
    free(spectrum);
}
