/* Wave resistance from a longitudinal wave cut (Eggers, Sharma and Ward 1967; docs/theory.md,
 * section 8). Along y = y0 outside the hull the elevation is
 *     zeta = Re Int_0^inf A(t) e^{i k0 sqrt(1+t^2) (x + t y0)} dt + local part,
 * and the Fourier transform Z(s) along x at s = k0 sqrt(1+t^2) >= k0 holds the local part only with
 * a factor e^{-s (y0 - b)}, so that |A| = k0 t |Z| / (pi sqrt(1+t^2)) and, over both sides,
 *     R = (rho U^2 k0^2/pi) Int_0^inf |Z|^2 t^2 (1+t^2)^{-3/2} dt.
 * Behind the end of the cut only the transverse waves are left; they are fitted by
 * Re e^{i psi(xi)} Sum a_m xi^{-1/2-m}, xi the distance astern and psi their phase by the method of
 * stationary phase, and transformed along a path on which e^{i s xi} decays. */
#include "core/constants.h"
#include "core/error.h"
#include "result/amplitude.h"
#include "result/radiation.h"
#include "result/wave_cut_surface.h"
#include "threads.h"

#include <nurbs/basis.h>

#include <complex.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>

enum {
    CUT_PANEL = 10, /* Gauss points of a panel */
    TAIL_TERMS = 3,
    TAIL_POINTS = 400
};
static const double most_phase = 1e4;  /* along the cut, radians: minutes of elevations */
static const double panel_phase = 8.0; /* radians of the shortest wave in a panel */
static const double upstream = 3.0;    /* lengths that the cut begins ahead of the bow */
static const double tail_share = 0.6;  /* of the cut, at its end, that the tail is fitted to */
static const double highest_decay = 9; /* e^-9 of the amplitude: angles beyond are left out */

struct cut {
    double x0;         /* origin of xi = x0 - x: middle of the hull */
    double first, end; /* xi of the first and last point */
    size_t n;
    double *xi, *weight, *zeta; /* [n] rule for the transform and the elevation there */
    double k0, y;
    double _Complex tail[TAIL_TERMS];
};

static igabem_status no_memory(size_t n)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a wave cut of %zu points", n);
}

/* The largest angle whose waves the cut carries. */
static double cut_limit(const igabem_solution *solution)
{
    double t_c = radiation_cutoff_angle(solution), limit = radiation_limit(solution);
    if (t_c > 0) {
        double square = (1.0 + t_c * t_c) * sqrt(highest_decay) - 1.0;
        return fmin(limit, sqrt(square));
    }
    return solution->info.surface_piercing ? limit : limit * sqrt(highest_decay / 20.0);
}

static igabem_status place_points(struct cut *cut, double shortest)
{
    double node[CUT_PANEL], weight[CUT_PANEL];
    size_t panels = (size_t)ceil((cut->end - cut->first) * shortest / panel_phase);
    double width = (cut->end - cut->first) / (double)panels;
    cut->n = panels * CUT_PANEL;
    cut->xi = malloc(3 * cut->n * sizeof *cut->xi);
    if (!cut->xi)
        return no_memory(cut->n);
    cut->weight = cut->xi + cut->n;
    cut->zeta = cut->xi + 2 * cut->n;
    if (nurbs_gauss_legendre(CUT_PANEL, node, weight))
        return igabem_fail(IGABEM_ERROR_NUMERIC, "%s", nurbs_last_error());
    for (size_t i = 0; i < cut->n; i++) {
        cut->xi[i] = cut->first + width * ((double)(i / CUT_PANEL) + node[i % CUT_PANEL]);
        cut->weight[i] = width * weight[i % CUT_PANEL];
    }
    return IGABEM_OK;
}

static igabem_status elevate(const igabem_solution *solution, const struct cut *cut, size_t n,
                             const double *xi, double *zeta)
{
    double *x = calloc(2 * n, sizeof *x);
    if (!x)
        return no_memory(n);
    for (size_t i = 0; i < n; i++) {
        x[i] = cut->x0 - xi[i];
        x[n + i] = cut->y;
    }
    igabem_status status = igabem_wave_elevation(solution, n, x, x + n, zeta);
    free(x);
    for (size_t i = 0; i < n && !status; i++)
        if (!isfinite(zeta[i]))
            status = igabem_fail(IGABEM_ERROR_NUMERIC, "the elevation at x = %g, y = %g m is %g",
                                 cut->x0 - xi[i], cut->y, zeta[i]);
    return status;
}

/* psi(xi) - k0 xi of the transverse waves: the phase k0 sqrt(1+t^2) (xi - t y) where it is
 * stationary, t = (xi - sqrt(xi^2 - 8 y^2))/(4 y). */
static double _Complex transverse_phase(const struct cut *cut, double _Complex xi)
{
    double y = cut->y;
    double _Complex t = 2.0 * y / (xi + csqrt(xi * xi - 8.0 * y * y));
    double _Complex root = csqrt(1.0 + t * t);
    return cut->k0 * (xi * t * t / (root + 1.0) - root * t * y);
}

/* Least squares of the tail over the end of the cut. */
static igabem_status fit_tail(const igabem_solution *solution, struct cut *cut)
{
    enum { COLUMNS = 2 * TAIL_TERMS };
    double reach = tail_share * cut->end, xi[TAIL_POINTS], zeta[TAIL_POINTS];
    double *matrix = malloc(TAIL_POINTS * COLUMNS * sizeof *matrix);
    if (!matrix)
        return no_memory(TAIL_POINTS);
    for (int i = 0; i < TAIL_POINTS; i++) {
        xi[i] = cut->end - reach * i / (TAIL_POINTS - 1.0);
        double phase = cut->k0 * xi[i] + creal(transverse_phase(cut, xi[i]));
        double power = sqrt(cut->end / xi[i]);
        for (int m = 0; m < TAIL_TERMS; m++, power *= cut->end / xi[i]) {
            matrix[i * COLUMNS + 2 * m] = power * cos(phase);
            matrix[i * COLUMNS + 2 * m + 1] = -power * sin(phase);
        }
    }
    igabem_status status = elevate(solution, cut, TAIL_POINTS, xi, zeta);
    lapack_int info = status ? 0
                             : LAPACKE_dgels(LAPACK_ROW_MAJOR, 'N', TAIL_POINTS, COLUMNS, 1, matrix,
                                             COLUMNS, zeta, 1);
    if (info != 0)
        status = igabem_fail_lapack("fit to the tail of the wave cut", info);
    for (int m = 0; m < TAIL_TERMS && !status; m++)
        cut->tail[m] = zeta[2 * m] + I * zeta[2 * m + 1];
    free(matrix);
    return status;
}

/* Int_end^inf of the tail times e^{i s xi}, s > k0: xi = end (1 + i tau), tau = e^{(pi/2) sinh v}.
 */
static double _Complex tail_transform(const struct cut *cut, double s)
{
    const double step = 0.05, reach = 4.5;
    double _Complex sum = 0.0;
    for (double v = -reach; v <= reach; v += step) {
        double tau = exp(0.5 * PI * sinh(v));
        double _Complex ratio = 1.0 + I * tau, xi = cut->end * ratio;
        double weight = step * 0.5 * PI * cosh(v) * tau;
        double _Complex up = 0.0, down = 0.0, power = 1.0 / csqrt(ratio);
        for (int m = 0; m < TAIL_TERMS; m++, power /= ratio) {
            up += cut->tail[m] * power;
            down += conj(cut->tail[m]) * power;
        }
        double _Complex phase = I * transverse_phase(cut, xi);
        sum += weight * (up * cexp(phase + I * (s + cut->k0) * xi) +
                         down * cexp(-phase + I * (s - cut->k0) * xi));
    }
    return 0.5 * I * cut->end * sum;
}

/* |Z(s)|^2. */
static double transform(const struct cut *cut, double s)
{
    double re = 0.0, im = 0.0;
    for (size_t i = 0; i < cut->n; i++) {
        re += cut->weight[i] * cut->zeta[i] * cos(s * cut->xi[i]);
        im += cut->weight[i] * cut->zeta[i] * sin(s * cut->xi[i]);
    }
    double _Complex z = re + I * im + tail_transform(cut, s);
    return creal(z) * creal(z) + cimag(z) * cimag(z);
}

static igabem_status integrate(const igabem_solution *solution, const struct cut *cut, double limit,
                               double *cw)
{
    double k0 = solution->k0, *t, *weight, sum = 0.0;
    size_t n;
    igabem_status status =
        amplitude_rule(k0, cut->end - cut->first, 0.0, limit, 0.0, &n, &t, &weight);
    if (status)
        return status;
#pragma omp parallel for schedule(dynamic, 8)
    for (size_t i = 0; i < n; i++) {
        double square = 1.0 + t[i] * t[i];
        weight[i] *= transform(cut, k0 * sqrt(square)) * t[i] * t[i] / (square * sqrt(square));
    }
    for (size_t i = 0; i < n; i++)
        sum += weight[i];
    free(t);
    free(weight);
    *cw = 2.0 * k0 * k0 / (PI * solution->info.hydrostatics.wetted_area) * sum;
    return isfinite(*cw) ? IGABEM_OK
                         : igabem_fail(IGABEM_ERROR_NUMERIC, "the wave cut has no finite spectrum");
}

/* The waves on both sides must be alike; on a body given whole the amplitudes tell. */
static igabem_status check_symmetry(const igabem_solution *solution)
{
    enum { ANGLES = 3 };
    static const double angle[2 * ANGLES] = {0.2, -0.2, 0.7, -0.7, 1.5, -1.5};
    const double share = 1e-3;
    double h[2 * ANGLES][2], largest = 0.0;
    if (solution->density->symmetric)
        return IGABEM_OK;
    igabem_status status = igabem_kochin(solution, 2 * ANGLES, angle, h, NULL);
    if (status)
        return status;
    for (int i = 0; i < 2 * ANGLES; i++)
        largest = fmax(largest, hypot(h[i][0], h[i][1]));
    for (int i = 0; i < 2 * ANGLES; i += 2) {
        double apart = hypot(h[i][0] - h[i + 1][0], h[i][1] - h[i + 1][1]);
        if (!(apart <= share * largest))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "a wave cut on one side needs the same waves on the other: at t = "
                               "%g and %g the amplitudes differ by %.2g of the largest",
                               angle[i], angle[i + 1], apart / largest);
    }
    return IGABEM_OK;
}

static igabem_status check_request(const igabem_solution *solution, const double *cw)
{
    if (!solution || !cw)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_wave_cut");
    if (!solution->waves)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "this solution has no free surface, expected the Kelvin kernel");
    return check_symmetry(solution);
}

igabem_status igabem_wave_cut(const igabem_solution *solution, double y, double *cw)
{
    igabem_status status = check_request(solution, cw);
    if (status)
        return status;
    THREADS(solution->options.threads);
    if (solution->potential)
        return wave_cut_surface(solution, y, cw);
    double length, beam, k0 = solution->k0, limit = cut_limit(solution);
    radiation_extent(solution, &length, &beam);
    if (isnan(y))
        y = 0.5 * beam + 2.0 * PI / k0;
    if (!(y > 0.5 * beam) || !isfinite(y))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave cut at y = %g m, expected beyond the side of the hull, %g m", y,
                           0.5 * beam);
    /* The diverging waves of angle t leave the cut at xi = y (1 + 2 t^2)/t behind their source. */
    struct cut cut = {.x0 = 0.5 * (solution->x_aft + solution->x_fore), .k0 = k0, .y = y};
    cut.first = -(0.5 + upstream) * length;
    cut.end = 0.5 * length + fmax((y + 0.5 * beam) * (1.0 + 2.0 * limit * limit) / limit + length,
                                  10.0 * 2.0 * PI / k0);
    double phase = k0 * sqrt(1.0 + limit * limit) * (cut.end - cut.first);
    if (phase > most_phase)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave cut at y = %g m: the last diverging waves leave it %.3g m behind "
                           "the hull, too far to be followed, expected y of about %.3g m at most",
                           y, cut.end, y * most_phase / phase);
    status = place_points(&cut, k0 * sqrt(1.0 + limit * limit));
    if (!status)
        status = elevate(solution, &cut, cut.n, cut.xi, cut.zeta);
    if (!status)
        status = fit_tail(solution, &cut);
    if (!status)
        status = integrate(solution, &cut, limit, cw);
    free(cut.xi);
    return status;
}
