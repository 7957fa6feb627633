/* Particulars of a hull at rest. */
#include "core/error.h"
#include "hull/hull.h"

#include <nurbs/particulars.h>

#include <math.h>

/* Relative to the waterline: a reference length that is none of this hull, and how far a
 * perpendicular stands from the waterline's end, a rudder stock or the stem on the water. */
static const double longest = 1.05, overhang = 0.05;

static void find_perpendiculars(const nurbs_hull *hull, const nurbs_hydrostatics *h, double x[2])
{
    double length = hull->length, water = h->x_fore - h->x_aft, near = overhang * water;
    bool given = hull->waterline && (!isnan(hull->options.length) || hull->lpp > 0) &&
                 length <= longest * water;
    double ends[] = {0, -0.5 * length}; /* of axes from the aft perpendicular, from midship */
    x[0] = h->x_aft;
    for (int k = 1; k >= 0; k--)
        if (given && fabs(ends[k] - h->x_aft) <= near && fabs(ends[k] + length - h->x_fore) <= near)
            x[0] = ends[k];
    x[1] = given ? x[0] + length : h->x_fore;
}

static nurbs_status light_hydrostatics(const nurbs_hull *hull, nurbs_hydrostatics *h)
{
    *h = hull->hydrostatics;
    return hull->light == hull->wetted ? NURBS_OK : hull_hydrostatics(hull->light, hull->half, h);
}

nurbs_status nurbs_hull_perpendiculars(const nurbs_hull *hull, double x[2])
{
    nurbs_hydrostatics h;
    if (!hull || !x)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hull or perpendiculars are NULL");
    nurbs_status status = light_hydrostatics(hull, &h);
    if (!status)
        find_perpendiculars(hull, &h, x);
    return status;
}

static void find_centres(nurbs_particulars *p, const nurbs_hull *hull)
{
    const nurbs_hydrostatics *h = &p->hydrostatics;
    double aft = p->perpendicular[0], fore = p->perpendicular[1];
    p->lcb_from_fore = fore - h->centroid[0];
    p->lcb_percent = 100.0 * (h->centroid[0] - 0.5 * (aft + fore)) / (fore - aft);
    p->kb = h->centroid[2] + h->keel_draft;
    p->lcf = hull->waterline ? h->waterplane_centre : NAN;
    p->lcf_from_fore = fore - p->lcf;
}

static void find_stability(nurbs_particulars *p, double density, double kg)
{
    const nurbs_hydrostatics *h = &p->hydrostatics;
    p->bmt = h->waterplane_inertia_x / h->volume;
    p->bml = h->waterplane_inertia_y / h->volume;
    p->kmt = p->kb + p->bmt;
    p->gmt = p->kb + p->bmt - kg;
    p->tpc = 1e-5 * density * h->waterplane_area;
    double gml = isnan(kg) ? p->bml : p->kb + p->bml - kg;
    p->mtc = 1e-5 * density * h->volume * gml / p->length;
}

static void find_coefficients(nurbs_particulars *p)
{
    const nurbs_hydrostatics *h = &p->hydrostatics;
    double length = p->waterline_length, beam = h->beam, draft = h->keel_draft,
           area = h->section_area_max;
    p->cb = h->volume / (length * beam * draft);
    p->cm = area / (beam * draft);
    p->cp = h->volume / (area * length);
    p->cwp = h->waterplane_area / (length * beam);
    p->cvp = h->volume / (h->waterplane_area * draft);
}

nurbs_status nurbs_hull_particulars(const nurbs_hull *hull, double density, double kg,
                                    nurbs_particulars *particulars)
{
    if (!hull || !particulars)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "hull or particulars are NULL");
    if (!(isfinite(density) && density > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "density %g kg/m^3, expected a positive one",
                          density);
    if (isinf(kg))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "centre of gravity %g m above the keel", kg);
    nurbs_particulars p = {.length = hull->length};
    double *water[] = {&p.waterline_length,
                       &p.bmt,
                       &p.bml,
                       &p.kmt,
                       &p.gmt,
                       &p.tpc,
                       &p.mtc,
                       &p.cb,
                       &p.cm,
                       &p.cp,
                       &p.cwp,
                       &p.cvp,
                       &p.bulb_ratio};
    nurbs_status status = light_hydrostatics(hull, &p.hydrostatics);
    if (status)
        return status;
    const nurbs_hydrostatics *h = &p.hydrostatics;
    find_perpendiculars(hull, h, p.perpendicular);
    p.mass = density * h->volume;
    p.transom_ratio = h->section_area_max > 0 ? h->transom_area / h->section_area_max : NAN;
    find_centres(&p, hull);
    if (hull->waterline) {
        p.waterline_length = h->x_fore - h->x_aft;
        find_stability(&p, density, kg);
        find_coefficients(&p);
        status = nurbs_hull_section_areas(hull, 1, &p.perpendicular[1], &p.bulb_ratio);
        p.bulb_ratio /= h->section_area_max;
    } else
        for (size_t k = 0; k < sizeof water / sizeof *water; k++)
            *water[k] = NAN;
    if (!status)
        *particulars = p;
    return status;
}
