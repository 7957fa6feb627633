/* The longitudinal cut of wave_cut.c on a free surface that ends behind the ship (docs/theory.md,
 * section 8). Free waves are fitted to the elevations behind the stern; they continue the cut
 * beyond the end of the surface, and small angles, which only a cut of many wave lengths could
 * tell, are theirs alone. */
#include "result/wave_cut_surface.h"

#include "core/constants.h"
#include "core/error.h"
#include "exterior/free_surface.h"
#include "result/amplitude.h"
#include "result/free_waves.h"
#include "result/radiation.h"

#include <nurbs/basis.h>

#include <complex.h>
#include <math.h>
#include <stdlib.h>

enum { CUT_PANEL = 10 };
static const double panel_phase = 8.0;     /* radians of the shortest wave in a panel */
static const double off_side = 0.05;       /* of the length */
static const double last_angle = 4.0;      /* cells hold no waves beyond */
static const double near_stern = 0.3;      /* wave lengths: still the ship's local disturbance */
static const double near_end = 0.5;        /* wave lengths that the end of the surface spoils */
static const double least_area = 0.4;      /* wave lengths between the two */
static const double inner_share = 0.9;     /* of the surface's half breadth */
static const double continued = 25.0;      /* wave lengths, with a taper */
static const double blend[2] = {0.4, 0.8}; /* angles: of the fit up to the first, of the cut from
                                              the second on */

struct cut {
    size_t n, solved;   /* points, and those on the surface */
    double *x, *weight; /* x, y, weight and zeta [n] each */
    double *y, *zeta;
};

static igabem_status no_memory(size_t n)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a wave cut of %zu points", n);
}

static double aft_end(const struct free_surface *surface)
{
    return surface->x0 - surface->dx * (double)surface->nx;
}

/* Elevations at the Gauss points of the cells along the stream, where those of phi_x are of higher
 * order, and their middles across. */
static igabem_status fit_behind(const igabem_solution *solution, double wave,
                                struct free_waves *waves)
{
    const struct free_surface *surface = solution->surface;
    const double gauss[2] = {0.5 - 0.5 / sqrt(3.0), 0.5 + 0.5 / sqrt(3.0)};
    double first = solution->x_aft - near_stern * wave, last = aft_end(surface) + near_end * wave;
    double side = inner_share * surface->offset[2 * surface->ny];
    size_t most = 2 * (surface->nx - surface->stern) * surface->ny, n = 0;
    if (!(first - last >= least_area * wave))
        return igabem_fail(
            IGABEM_ERROR_ARGUMENT,
            "a wave cut needs a free surface of %.3g m aft of the hull, %.3g wave lengths, "
            "expected more than the %.3g m of surface_downstream",
            (near_stern + near_end + least_area) * wave, near_stern + near_end + least_area,
            solution->x_aft - aft_end(surface));
    double *x = malloc((3 * most + 1) * sizeof *x), *y = x + most, *zeta = y + most;
    if (!x)
        return no_memory(most);
    for (size_t i = surface->stern; i < surface->nx; i++)
        for (int g = 0; g < 2; g++) {
            double xi = (double)i + gauss[g], at = surface->x0 - surface->dx * xi;
            if (at > first || at < last)
                continue;
            for (size_t j = 0; j < surface->ny; j++) {
                x[n] = at;
                y[n] = free_surface_y(surface, xi, 2 * j + 1);
                n += y[n] <= side;
            }
        }
    igabem_status status = igabem_wave_elevation(solution, n, x, y, zeta);
    if (!status)
        status = free_waves_fit(solution->k0, solution->x_aft, solution->x_fore - solution->x_aft,
                                n, x, y, zeta, waves);
    free(x);
    return status;
}

/* Panels from one place aft to the next. */
static void place(double from, double to, size_t panels, const double *node, const double *weight,
                  struct cut *cut)
{
    double width = (from - to) / (double)panels;
    for (size_t p = 0; p < panels; p++)
        for (size_t g = 0; g < CUT_PANEL; g++) {
            cut->x[cut->n] = from - width * ((double)p + node[g]);
            cut->weight[cut->n++] = width * weight[g];
        }
}

static igabem_status cut_create(const igabem_solution *solution, double y, double wave,
                                const struct free_waves *waves, struct cut *cut)
{
    const struct free_surface *surface = solution->surface;
    double fore = surface->x0, end = aft_end(surface) + near_end * wave;
    double far = end - continued * wave, node[CUT_PANEL], weight[CUT_PANEL];
    double shortest = solution->k0 * sqrt(1.0 + last_angle * last_angle) / panel_phase;
    size_t panels[2] = {(size_t)ceil((fore - end) * shortest),
                        (size_t)ceil((end - far) * shortest)};
    size_t n = CUT_PANEL * (panels[0] + panels[1]);
    *cut = (struct cut){.x = malloc(4 * n * sizeof *cut->x)};
    if (!cut->x)
        return no_memory(n);
    cut->y = cut->x + n;
    cut->weight = cut->y + n;
    cut->zeta = cut->weight + n;
    if (nurbs_gauss_legendre(CUT_PANEL, node, weight))
        return igabem_fail(IGABEM_ERROR_NUMERIC, "%s", nurbs_last_error());
    place(fore, end, panels[0], node, weight, cut);
    cut->solved = cut->n;
    place(end, far, panels[1], node, weight, cut);
    for (size_t i = 0; i < n; i++)
        cut->y[i] = y;
    igabem_status status = igabem_wave_elevation(solution, cut->solved, cut->x, cut->y, cut->zeta);
    if (!status)
        status = free_waves_elevation(waves, n - cut->solved, cut->x + cut->solved,
                                      cut->y + cut->solved, cut->zeta + cut->solved);
    for (size_t i = cut->solved; i < n; i++) {
        double fade = cos(0.5 * PI * (end - cut->x[i]) / (end - far));
        cut->weight[i] *= fade * fade;
    }
    return status;
}

/* |H|^2 over U^2 at an angle: from the fit |A| pi/(k0 sqrt(1+t^2)), from the cut |Z| t/(1+t^2). */
static double square(const struct cut *cut, const struct free_waves *waves, double t)
{
    double root = sqrt(1.0 + t * t), s = waves->k0 * root;
    double share = fmin(1.0, fmax(0.0, (t - blend[0]) / (blend[1] - blend[0])));
    share *= share * (3.0 - 2.0 * share);
    double fitted = cabs(free_waves_amplitude(waves, t)) * PI / s, re = 0.0, im = 0.0;
    for (size_t i = 0; i < cut->n && share > 0.0; i++) {
        re += cut->weight[i] * cut->zeta[i] * cos(s * cut->x[i]);
        im += cut->weight[i] * cut->zeta[i] * sin(s * cut->x[i]);
    }
    double seen = hypot(re, im) * t / (root * root);
    return share * seen * seen + (1.0 - share) * fitted * fitted;
}

static igabem_status integrate(const igabem_solution *solution, const struct cut *cut,
                               const struct free_waves *waves, double *cw)
{
    double k0 = solution->k0, *t, *weight, sum = 0.0;
    double limit = fmin(last_angle, radiation_limit(solution));
    size_t n;
    igabem_status status =
        amplitude_rule(k0, cut->x[0] - cut->x[cut->n - 1], 0.0, limit, 0.0, &n, &t, &weight);
    if (status)
        return status;
#pragma omp parallel for schedule(dynamic, 8)
    for (size_t i = 0; i < n; i++)
        weight[i] *= square(cut, waves, t[i]) * sqrt(1.0 + t[i] * t[i]);
    for (size_t i = 0; i < n; i++)
        sum += weight[i];
    free(t);
    free(weight);
    *cw = 2.0 * k0 * k0 / (PI * solution->info.hydrostatics.wetted_area) * sum;
    return isfinite(*cw) ? IGABEM_OK
                         : igabem_fail(IGABEM_ERROR_NUMERIC, "the wave cut has no finite spectrum");
}

igabem_status wave_cut_surface(const igabem_solution *solution, double y, double *cw)
{
    const struct free_surface *surface = solution->surface;
    double length, beam, wave = 2.0 * PI / solution->k0;
    double side = inner_share * surface->offset[2 * surface->ny];
    radiation_extent(solution, &length, &beam);
    if (isnan(y))
        y = 0.5 * beam + off_side * (solution->x_fore - solution->x_aft);
    if (!(y > 0.5 * beam && y <= side))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave cut at y = %g m, expected beyond the side of the hull, %g m, and "
                           "within %g m of the free surface that was solved",
                           y, 0.5 * beam, side);
    struct free_waves waves;
    struct cut cut = {.x = NULL};
    igabem_status status = fit_behind(solution, wave, &waves);
    if (!status)
        status = cut_create(solution, y, wave, &waves, &cut);
    if (!status)
        status = integrate(solution, &cut, &waves, cw);
    free(cut.x);
    return status;
}
