#include "core/error.h"

#include <igabem/friction.h>

#include <math.h>

double igabem_friction_ittc57(double reynolds)
{
    if (!(reynolds > 1000.0))
        return NAN;
    double d = log10(reynolds) - 2.0;
    return 0.075 / (d * d);
}

static igabem_status check(const igabem_forces *forces, double length, const igabem_water *water)
{
    const struct {
        const char *name;
        double value;
    } positive[] = {
        {"length", length}, {"density", water->density}, {"viscosity", water->viscosity}};
    for (size_t k = 0; k < sizeof positive / sizeof *positive; k++)
        if (!(positive[k].value > 0 && isfinite(positive[k].value)))
            return igabem_fail(IGABEM_ERROR_ARGUMENT, "%s is %g, expected a positive number",
                               positive[k].name, positive[k].value);
    if (!isfinite(water->form_factor))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "form factor is %g, expected a number",
                           water->form_factor);
    if (!isfinite(forces->cw))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "the forces have no C_w to add friction to");
    return IGABEM_OK;
}

igabem_status igabem_total_resistance(const igabem_forces *forces, double length,
                                      const igabem_water *water, igabem_total *total)
{
    if (!forces || !water || !total)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_total_resistance");
    igabem_status status = check(forces, length, water);
    if (status)
        return status;
    double speed = forces->speed, reynolds = speed * length / water->viscosity;
    double cf = igabem_friction_ittc57(reynolds), ct = (1.0 + water->form_factor) * cf + forces->cw;
    *total = (igabem_total){
        .reynolds = reynolds,
        .cf = cf,
        .ct = ct,
        .rt = 0.5 * water->density * speed * speed * forces->wetted_area * ct,
    };
    return IGABEM_OK;
}
