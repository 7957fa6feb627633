#include "solve/resolution.h"

#include "core/constants.h"
#include "core/error.h"
#include "influence/spectrum.h"
#include "solve/formulation.h"

#include <math.h>

/* Radians: half a minute on one processor. */
static const double most_phase = 3e4;

/* Of the wave at an angle from end to end of the hull: sqrt(1+t^2) (L + t B) k0. */
static double phase_at(double k0, double length, double beam, double t)
{
    return k0 * sqrt(1.0 + t * t) * (length + t * beam);
}

/* The largest angle that is not refused; 0 if even transverse waves are. */
static double most_angle(double k0, double length, double beam)
{
    double low = 0.0, high = most_phase / (k0 * length);
    if (phase_at(k0, length, beam, 0.0) > most_phase)
        return 0.0;
    for (int i = 0; i < 100; i++) {
        double t = 0.5 * (low + high);
        if (phase_at(k0, length, beam, t) > most_phase)
            high = t;
        else
            low = t;
    }
    return low;
}

igabem_status resolution_check_angle(double k0, double length, double beam, double t,
                                     const char *what)
{
    if (phase_at(k0, length, beam, fabs(t)) <= most_phase)
        return IGABEM_OK;
    double most = most_angle(k0, length, beam), wave = 2.0 * PI / k0;
    if (most > 0.0)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "%s %g: on a hull %.3g m long with transverse waves of %.3g m such "
                           "short waves are not resolved, expected at most %.3g",
                           what, t, length, wave, most);
    return igabem_fail(IGABEM_ERROR_ARGUMENT,
                       "transverse waves of %.3g m on a hull %.3g m long are too short to be "
                       "resolved, expected a higher Froude number",
                       wave, length);
}

igabem_status resolution_check(const igabem_hull *hull, const igabem_options *options)
{
    if (options->kernel != IGABEM_KERNEL_KELVIN)
        return IGABEM_OK;
    double froude = options->froude, k0 = 1.0 / (froude * froude * hull->length);
    double length = hull->upper[0] - hull->lower[0];
    double beam = 2.0 * fmax(fabs(hull->upper[1]), fabs(hull->lower[1]));
    if (!hull->surface_piercing)
        return resolution_check_angle(k0, length, beam, 0.0, "wave angle");
    igabem_status status =
        resolution_check_angle(k0, length, beam, options->spectrum_limit, "spectrum_limit");
    if (status == IGABEM_OK && formulation_has_waves(options) && isfinite(options->cutoff_angle))
        status = resolution_check_angle(
            k0, length, beam, spectrum_limit(k0, options->cutoff_angle, 0.0, options->tolerance),
            "largest wave angle, by the cut-off,");
    return status;
}

igabem_status resolution_check_distance(double k0, double distance)
{
    if (k0 * distance <= most_phase)
        return IGABEM_OK;
    return igabem_fail(IGABEM_ERROR_ARGUMENT,
                       "waves %.3g m from the bow or its centre plane are too far to be followed, "
                       "expected at most %.3g m",
                       distance, most_phase / k0);
}
