#include "result/amplitude.h"

#include "core/error.h"
#include "core/vector_math.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum { PANEL = 10 };  /* Gauss nodes of a panel */
enum { BLOCK = 256 }; /* sources whose waves are kept at a time */

static const double PANEL_PHASE = 16.0; /* radians per panel */
static const double PANEL_WIDTH = 0.4;  /* in asinh t */
static const double DECAY = 40.0;       /* sources beyond e^-40 are left out */

/* Elementary waves at the places of a block: e^{a z} (cos, sin)(k x + b y), both sides at once if
 * symmetric: e^{a z} 2 cos(b y) (cos, sin)(k x). z NULL: on the waterline. */
VECTOR_MULTIVERSION
static void block_waves(bool symmetric, double a, double b, double k, size_t n,
                        const double *restrict x, const double *restrict y,
                        const double *restrict z, double *restrict re, double *restrict im)
{
    double along = symmetric ? 0.0 : b, across = b - along, factor = symmetric ? 2.0 : 1.0;
    for (size_t j = 0; j < n; j++)
        re[j] = z ? factor * vector_exp(a * z[j]) : factor;
#pragma omp simd
    for (size_t j = 0; j < n; j++) {
        double s, c, sy, cy;
        vector_sincos(k * x[j] + along * y[j], &s, &c);
        vector_sincos(across * y[j], &sy, &cy);
        double e = re[j] * cy;
        re[j] = e * c;
        im[j] = e * s;
    }
}

VECTOR_MULTIVERSION
static double dot(size_t n, const double *restrict p, const double *restrict q)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t j = 0; j < n; j++)
        sum += p[j] * q[j];
    return sum;
}

/* Adds to h the waves of n sources for every set of strengths. */
static void add_waves(bool symmetric, double a, double b, double k, size_t n, const double *x,
                      const double *y, const double *z, size_t sets, const double *const *strength,
                      double (*h)[2])
{
    double re[BLOCK], im[BLOCK];
    for (size_t begin = 0; begin < n; begin += BLOCK) {
        size_t m = n - begin < BLOCK ? n - begin : BLOCK;
        block_waves(symmetric, a, b, k, m, x + begin, y + begin, z ? z + begin : NULL, re, im);
        for (size_t l = 0; l < sets; l++) {
            h[l][0] += dot(m, re, strength[l] + begin);
            h[l][1] += dot(m, im, strength[l] + begin);
        }
    }
}

/* Adds to h the waves of n dipoles m: the derivative of the wave at the source along m, whose parts
 * are a m_z, i k m_x and i b m_y. NULL: no such part. */
VECTOR_MULTIVERSION
static void add_dipoles(bool symmetric, double a, double b, double k, size_t n, const double *x,
                        const double *y, const double *z, const double *mx, const double *my,
                        const double *mz, double h[2])
{
    double along = symmetric ? 0.0 : b, across = b - along, factor = symmetric ? 2.0 : 1.0;
    double re = 0.0, im = 0.0;
#pragma omp simd reduction(+ : re, im)
    for (size_t j = 0; j < n; j++) {
        double s, c, sy, cy, e = z ? factor * vector_exp(a * z[j]) : factor;
        vector_sincos(k * x[j] + along * y[j], &s, &c);
        vector_sincos(across * y[j], &sy, &cy);
        double up = mz ? a * mz[j] * cy : 0.0, ahead = k * mx[j] * cy;
        double side = my ? b * my[j] : 0.0;
        up -= symmetric ? side * sy : 0.0; /* i b m_y i sin(b y) */
        ahead += symmetric ? 0.0 : side;
        re += e * (up * c - ahead * s);
        im += e * (up * s + ahead * c);
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

/* What Green's identity has besides sources: - Int phi dE/dn dS + (1/k0) Oint phi E_x nu_x dl. */
static void add_potential(const struct sources *s, double a, double b, double k, size_t n,
                          double h[2])
{
    double surface[2] = {0.0, 0.0};
    add_dipoles(s->symmetric, a, b, k, n, s->x, s->y, s->z, s->dipole[0], s->dipole[1],
                s->dipole[2], surface);
    h[0] -= surface[0];
    h[1] -= surface[1];
    add_dipoles(s->symmetric, a, b, k, s->n_line, s->line_x, s->line_y, NULL, s->line_dipole, NULL,
                NULL, h);
}

void amplitude_sets(size_t sets, const struct sources *const *sources, double k0, double t,
                    double (*h)[2])
{
    const struct sources *places = sources[0];
    const double *strength[AMPLITUDE_SETS], *line_strength[AMPLITUDE_SETS];
    double a = k0 * (1.0 + t * t), k = k0 * sqrt(1.0 + t * t), b = k * t;
    for (size_t l = 0; l < sets; l++) {
        strength[l] = sources[l]->strength;
        line_strength[l] = sources[l]->line_strength;
        h[l][0] = h[l][1] = 0.0;
    }
    add_waves(places->symmetric, a, b, k, shallower(places, DECAY / a), places->x, places->y,
              places->z, sets, strength, h);
    add_waves(places->symmetric, a, b, k, places->n_line, places->line_x, places->line_y, NULL,
              sets, line_strength, h);
    for (size_t l = 0; l < sets && places->dipole[0]; l++)
        add_potential(sources[l], a, b, k, shallower(places, DECAY / a), h[l]);
}

void amplitude(const struct sources *sources, double k0, double t, double h[2])
{
    double one[1][2];
    amplitude_sets(1, &sources, k0, t, one);
    h[0] = one[0][0];
    h[1] = one[0][1];
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

static bool append(size_t *n, size_t *room, double **t, double **weight)
{
    if (*n + PANEL <= *room)
        return true;
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

/* |H|^2 at t, both signs of t. */
static void squares(size_t sets, const struct sources *const *sources, double k0, double t,
                    double square[AMPLITUDE_SETS])
{
    double h[AMPLITUDE_SETS][2], factor = sources[0]->symmetric ? 2.0 : 1.0;
    amplitude_sets(sets, sources, k0, t, h);
    for (size_t l = 0; l < sets; l++)
        square[l] = factor * (h[l][0] * h[l][0] + h[l][1] * h[l][1]);
    if (sources[0]->symmetric)
        return;
    amplitude_sets(sets, sources, k0, -t, h);
    for (size_t l = 0; l < sets; l++)
        square[l] += h[l][0] * h[l][0] + h[l][1] * h[l][1];
}

igabem_status amplitude_integrate(size_t sets, const struct sources *const *sources, double k0,
                                  double length, double beam, double t_max, double t_break,
                                  struct amplitude_sum *sum)
{
    size_t n;
    double *t, *weight;
    igabem_status status = amplitude_rule(k0, length, beam, t_max, t_break, &n, &t, &weight);
    if (status)
        return status;
    double(*square)[AMPLITUDE_SETS] = malloc((n + 1) * sizeof *square);
    if (!square) {
        free(t);
        free(weight);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu wave angles", n);
    }
    /* The sum below has one order whatever the number of threads. */
#pragma omp parallel for schedule(dynamic, 8)
    for (size_t i = 0; i < n; i++)
        squares(sets, sources, k0, t[i], square[i]);
    for (size_t l = 0; l < sets; l++) {
        sum[l] = (struct amplitude_sum){0, 0};
        for (size_t i = 0; i < n; i++) {
            double part = weight[i] * square[i][l] * sqrt(1.0 + t[i] * t[i]);
            sum[l].total += part;
            if (t_break > 0 && t[i] > t_break)
                sum[l].beyond += part;
        }
        if (!isfinite(sum[l].total))
            status = igabem_fail(IGABEM_ERROR_NUMERIC, "the wave spectrum is not finite");
    }
    free(t);
    free(weight);
    free(square);
    return status;
}
