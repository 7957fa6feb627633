#include "amplitude.h"

#include "error.h"
#include "wave_math.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum { PANEL = 10 }; /* Gauss nodes of a panel */

static const double PANEL_PHASE = 16.0; /* radians per panel */
static const double PANEL_WIDTH = 0.4;  /* in asinh t */
static const double DECAY = 40.0;       /* sources beyond e^-40 are left out */

/* Both sides at once: q e^{a z} 2 cos(b y) (cos, sin)(k x). */
WAVE_MULTIVERSION
static void sum_symmetric(double a, double b, double k, size_t n, const double *restrict x,
                          const double *restrict y, const double *restrict z,
                          const double *restrict q, double *restrict h)
{
    double re = 0.0, im = 0.0;
#pragma omp simd reduction(+ : re, im)
    for (size_t j = 0; j < n; j++) {
        double s, c, sy, cy;
        wave_sincos(k * x[j], &s, &c);
        wave_sincos(b * y[j], &sy, &cy);
        double e = 2.0 * q[j] * wave_exp(a * z[j]) * cy;
        re += e * c;
        im += e * s;
    }
    h[0] += re;
    h[1] += im;
}

WAVE_MULTIVERSION
static void sum_plain(double a, double b, double k, size_t n, const double *restrict x,
                      const double *restrict y, const double *restrict z, const double *restrict q,
                      double *restrict h)
{
    double re = 0.0, im = 0.0;
#pragma omp simd reduction(+ : re, im)
    for (size_t j = 0; j < n; j++) {
        double s, c;
        wave_sincos(k * x[j] + b * y[j], &s, &c);
        double e = q[j] * wave_exp(a * z[j]);
        re += e * c;
        im += e * s;
    }
    h[0] += re;
    h[1] += im;
}

WAVE_MULTIVERSION
static void sum_line(int symmetric, double b, double k, size_t n, const double *restrict x,
                     const double *restrict y, const double *restrict q, double *restrict h)
{
    double re = 0.0, im = 0.0, factor = symmetric ? 2.0 : 1.0, along = symmetric ? 0.0 : b;
#pragma omp simd reduction(+ : re, im)
    for (size_t j = 0; j < n; j++) {
        double s, c, sy, cy;
        wave_sincos(k * x[j] + along * y[j], &s, &c);
        wave_sincos((b - along) * y[j], &sy, &cy);
        re += factor * q[j] * cy * c;
        im += factor * q[j] * cy * s;
    }
    h[0] += re;
    h[1] += im;
}

/* Number of sources above the depth (they are ordered by depth). */
static size_t shallower(const struct sources *sources, double depth)
{
    size_t low = 0, high = sources->n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (-sources->z[middle] <= depth)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void amplitude(const struct sources *sources, double k0, double t, double h[2])
{
    double a = k0 * (1.0 + t * t), k = k0 * sqrt(1.0 + t * t), b = k * t;
    size_t n = shallower(sources, DECAY / a);
    h[0] = h[1] = 0.0;
    if (sources->symmetric)
        sum_symmetric(a, b, k, n, sources->x, sources->y, sources->z, sources->strength, h);
    else
        sum_plain(a, b, k, n, sources->x, sources->y, sources->z, sources->strength, h);
    if (sources->n_line)
        sum_line(sources->symmetric, b, k, sources->n_line, sources->line_x, sources->line_y,
                 sources->line_strength, h);
}

/* End of the panel that starts at v. */
static double panel_end(double k0, double length, double beam, double v, double v_max)
{
    double width = fmin(PANEL_WIDTH, v_max - v);
    double t = sinh(v), start = k0 * sqrt(1.0 + t * t) * (length + t * beam);
    for (;;) {
        double te = sinh(v + width), end = k0 * sqrt(1.0 + te * te) * (length + te * beam);
        if (end - start <= PANEL_PHASE)
            return v + width;
        width *= fmax(0.5, 0.95 * PANEL_PHASE / (end - start));
    }
}

static int append(size_t *n, size_t *room, double **t, double **weight)
{
    if (*n + PANEL <= *room)
        return 1;
    *room = 2 * *room + 64 * PANEL;
    double *more_t = realloc(*t, *room * sizeof **t);
    if (more_t)
        *t = more_t;
    double *more_w = realloc(*weight, *room * sizeof **weight);
    if (more_w)
        *weight = more_w;
    return more_t && more_w;
}

igabem_status amplitude_rule(double k0, double length, double beam, double t_max, double t_break,
                             size_t *n, double **t, double **weight)
{
    double nodes[PANEL], weights[PANEL];
    size_t room = 0;
    *n = 0;
    *t = *weight = NULL;
    if (!(t_max > 0) || !isfinite(t_max) || nurbs_gauss_legendre(PANEL, nodes, weights))
        return igabem_fail(IGABEM_ERROR_NUMERIC, "largest wave angle %g, expected 0 < t < inf",
                           t_max);
    double v = 0.0, v_max = asinh(t_max);
    double v_break = t_break > 0 && t_break < t_max ? asinh(t_break) : v_max;
    while (v < v_max) {
        double stop = v < v_break ? v_break : v_max;
        double end = panel_end(k0, length, beam, v, stop);
        if (!append(n, &room, t, weight)) {
            free(*t);
            free(*weight);
            *t = *weight = NULL;
            return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu wave angles", room);
        }
        for (int i = 0; i < PANEL; i++, ++*n) {
            double at = v + (end - v) * nodes[i];
            (*t)[*n] = sinh(at);
            (*weight)[*n] = (end - v) * weights[i] * cosh(at);
        }
        v = end;
    }
    return IGABEM_OK;
}

igabem_status amplitude_integrate(const struct sources *sources, double k0, double length,
                                  double beam, double t_max, double t_break,
                                  struct amplitude_sum *sum)
{
    size_t n;
    double *t, *weight;
    igabem_status status = amplitude_rule(k0, length, beam, t_max, t_break, &n, &t, &weight);
    if (status)
        return status;
        /* Replaces every weight by the integrand, so that the sum below has one order whatever the
         * number of threads. */
#pragma omp parallel for schedule(dynamic, 8)
    for (size_t i = 0; i < n; i++) {
        double h[2], factor = sources->symmetric ? 2.0 : 1.0, square;
        amplitude(sources, k0, t[i], h);
        square = h[0] * h[0] + h[1] * h[1];
        if (!sources->symmetric) {
            amplitude(sources, k0, -t[i], h);
            square += h[0] * h[0] + h[1] * h[1];
        }
        weight[i] *= factor * square * sqrt(1.0 + t[i] * t[i]);
    }
    *sum = (struct amplitude_sum){0, 0};
    for (size_t i = 0; i < n; i++) {
        sum->total += weight[i];
        if (t_break > 0 && t[i] > t_break)
            sum->beyond += weight[i];
    }
    free(t);
    free(weight);
    if (!isfinite(sum->total))
        return igabem_fail(IGABEM_ERROR_NUMERIC, "the wave spectrum is not finite");
    return IGABEM_OK;
}
