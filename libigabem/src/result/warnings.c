/* What may be wrong with a result, and with a hull. */
#include "core/constants.h"
#include "exterior/free_surface.h"
#include "hull/hull.h"
#include "result/momentum.h"
#include "solve/solution.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/* nu_s: C_w rests on a plateau of the cut-off below the first (docs/validation.md). */
static const double full_entrance = 0.29, blunt_entrance = 0.35;
static const double length_over_extent = 1.25;
/* A cubic spline needs about so many coefficients a period. */
static const double fewest_per_wave = 8.0;
/* Of a surface-piercing hull: slower, waves shorter than 0.06 of the length; faster, it planes. */
static const double least_froude = 0.1, most_froude = 1.0;
static const double most_trim = 3.0, degree = 180 / PI;
static const double most_sinkage = 0.01; /* of the length */
static const double most_error = 0.01;   /* of C_w, estimated */
static const double most_gap = 0.5, most_momentum_gap = 0.25, most_gap_submerged = 0.01;

struct subject {
    const igabem_hull_info *info;
    const igabem_solution *solution; /* NULL: a hull alone */
    const igabem_forces *forces;     /* NULL: not known */
};

struct sentence {
    char text[240];
};

__attribute__((format(printf, 2, 3))) static bool say(struct sentence *sentence, const char *format,
                                                      ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(sentence->text, sizeof sentence->text, format, args);
    va_end(args);
    return true;
}

/* Whether the short-wave filter and what it depends on matter. */
static bool knows_cutoff(const struct subject *s)
{
    return !s->solution || (s->solution->waves && s->solution->formulation->kelvin_rows);
}

static bool closed_transom(const struct subject *s, struct sentence *sentence)
{
    return s->info->transom == IGABEM_TRANSOM_CLOSED && knows_cutoff(s) &&
           say(sentence, "closed transom: without viscosity the flow turns round its corner, C_w "
                         "means nothing; leave its patch out for a transom that runs dry");
}

static bool full_bow(const struct subject *s, struct sentence *sentence)
{
    if (!s->info->surface_piercing || !(s->info->nu_s > full_entrance) || !knows_cutoff(s))
        return false;
    if (s->info->nu_s > blunt_entrance)
        return say(sentence, "full waterline entrance (nu_s > 0.35): no cut-off plateau is known "
                             "for it, do not trust C_w");
    return say(sentence, "full waterline entrance (nu_s > 0.29): C_w depends on the cut-off by 5 "
                         "to 15 %%");
}

/* The lines of the grid turn with the waterline; beyond this no refinement was seen to settle. */
static bool steep_end(const struct subject *s, struct sentence *sentence)
{
    return s->solution && s->solution->potential && s->info->surface_piercing &&
           s->info->nu_s > blunt_entrance &&
           say(sentence,
               "waterline end with nu_s %.2g, beyond %g: the free surface beside it is not known "
               "to "
               "converge, do not trust C_w",
               s->info->nu_s, blunt_entrance);
}

static bool strange_length(const struct subject *s, struct sentence *sentence)
{
    double extent = s->info->hydrostatics.x_fore - s->info->hydrostatics.x_aft;
    double ratio = s->info->length / extent;
    return (ratio > length_over_extent || ratio < 1.0 / length_over_extent) &&
           say(sentence,
               "the reference length is %.4g m, but the wetted hull is %.4g m long: Fr and k0 "
               "follow the first",
               s->info->length, extent);
}

static bool coarse_mesh(const struct subject *s, struct sentence *sentence)
{
    return s->forces && s->forces->unknowns_per_wave < fewest_per_wave &&
           say(sentence,
               "%.2g unknowns along a transverse wave of %.3g m, expected %g at least: refine",
               s->forces->unknowns_per_wave, 2.0 * PI / s->forces->k0, fewest_per_wave);
}

static bool coarse_result(const struct subject *s, struct sentence *sentence)
{
    return s->forces && s->forces->cw_error > most_error * s->forces->cw &&
           say(sentence,
               "C_w has a discretisation error of about %.2g %%, expected %g %% at most: refine",
               100.0 * s->forces->cw_error / s->forces->cw, 100.0 * most_error);
}

/* A wave that reaches the stern in fewer cells has lost its phase (docs/experiments.md). */
static bool coarse_surface(const struct subject *s, struct sentence *sentence)
{
    if (!s->solution || !s->solution->potential)
        return false;
    double wave = 2.0 * PI / s->solution->k0, cells = wave / s->solution->surface->dx;
    return cells < fewest_per_wave &&
           say(sentence,
               "%.2g cells of the free surface along a transverse wave of %.3g m, expected %g at "
               "least: state more",
               cells, wave, fewest_per_wave);
}

static bool strange_speed(const struct subject *s, struct sentence *sentence)
{
    if (!s->solution || !s->solution->waves || !s->info->surface_piercing)
        return false;
    double froude = s->solution->options.froude;
    return (froude < least_froude || froude > most_froude) &&
           say(sentence,
               "Fr %.4g is outside of %g to %g, for which linear theory of a floating hull is "
               "meant",
               froude, least_froude, most_froude);
}

static bool strange_attitude(const struct subject *s, struct sentence *sentence)
{
    if (!s->forces || !s->solution->waves)
        return false;
    double trim = degree * s->forces->trim, sinkage = s->forces->sinkage / s->info->length;
    return (fabs(trim) > most_trim || fabs(sinkage) > most_sinkage) &&
           say(sentence,
               "sinkage %.2g %% of the length and trim %.2g degrees are beyond linear theory, "
               "which takes both as small",
               100.0 * sinkage, trim);
}

static bool momentum_gap(const struct subject *s, struct sentence *sentence)
{
    if (!s->forces || !momentum_kept(s->solution))
        return false;
    double a = s->forces->cw, b = s->forces->cw_momentum;
    return fabs(a - b) > most_momentum_gap * fmax(a, b) &&
           say(sentence,
               "C_w by Kochin function (%.3g) and by the momentum of the same solution (%.3g) "
               "differ by more than a quarter of the larger: believe neither without a refinement",
               a, b);
}

static bool negative_pressure(const struct subject *s, struct sentence *sentence)
{
    return s->forces && s->solution->waves && !momentum_kept(s->solution) &&
           s->forces->cw_pressure < 0 &&
           say(sentence,
               "C_w by pressure is below zero (%.3g, by Kochin function %.3g): not resolved, "
               "refine along the hull",
               s->forces->cw_pressure, s->forces->cw);
}

/* On a submerged body the two are one number (Lagally): what they differ by is discretisation
 * error. */
static bool pressure_gap(const struct subject *s, struct sentence *sentence)
{
    if (!s->forces || !(s->forces->cw_pressure >= 0) || !isfinite(s->forces->cw) ||
        momentum_kept(s->solution))
        return false;
    double a = s->forces->cw, b = s->forces->cw_pressure, gap = fabs(b / a - 1.0);
    if (s->info->surface_piercing)
        return fabs(a - b) > most_gap * fmax(a, b) &&
               say(sentence,
                   "C_w by Kochin function (%.3g) and by pressure (%.3g) differ by more than half "
                   "of the larger: believe neither without a refinement",
                   a, b);
    return gap > most_gap_submerged &&
           say(sentence,
               "C_w by Kochin function and by pressure differ by %.2g %%, on a submerged body all "
               "of it discretisation error: refine",
               100.0 * gap);
}

static bool (*const checks[])(const struct subject *subject, struct sentence *sentence) = {
    closed_transom,    steep_end,     full_bow,      strange_length,
    coarse_mesh,       coarse_result, strange_speed, strange_attitude,
    negative_pressure, pressure_gap,  momentum_gap,  coarse_surface,
};

static const char *find(const struct subject *subject, size_t number)
{
    static _Thread_local struct sentence sentence;
    for (size_t k = 0; k < sizeof checks / sizeof *checks; k++)
        if (checks[k](subject, &sentence) && number-- == 0)
            return sentence.text;
    return NULL;
}

const char *igabem_hull_warning(const igabem_hull *hull, size_t number)
{
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    const struct subject subject = {&info, NULL, NULL};
    return hull ? find(&subject, number) : NULL;
}

const char *igabem_solution_warning(const igabem_solution *solution, const igabem_forces *forces,
                                    size_t number)
{
    if (!solution)
        return NULL;
    const struct subject subject = {&solution->info, solution, forces};
    return find(&subject, number);
}
