#include "report/particulars.h"

#include "cli.h"

#include <math.h>

static void set(struct particular *p, int which, double value)
{
    p->value[which] = value;
}

size_t particulars_list(const struct results *r, struct particular list[PARTICULARS_MOST])
{
    static const struct particular rows[] = {
        {"length_pp", "Length between perpendiculars", "m", 3, {0, 0}},
        {"length_wl", "Length of the waterline", "m", 3, {0, 0}},
        {"beam_wl", "Beam at the waterline", "m", 4, {0, 0}},
        {"draft_keel", "Draft at the keel amidships", "m", 4, {0, 0}},
        {"draft_deepest", "Draft at the deepest point", "m", 4, {0, 0}},
        {"volume", "Displacement volume", "m³", 5, {0, 0}},
        {"wetted_area", "Wetted area without transom", "m²", 4, {0, 0}},
        {"waterplane_area", "Waterplane area", "m²", 4, {0, 0}},
        {"lcb_from_fp", "Centre of buoyancy aft of FP", "m", 4, {0, 0}},
        {"vcb", "Centre of buoyancy above the waterline", "m", 4, {0, 0}},
        {"lcf_from_fp", "Centre of flotation aft of FP", "m", 4, {0, 0}},
        {"section_area_max", "Largest section area", "m²", 5, {0, 0}},
        {"transom_area", "Immersed transom area", "m²", 5, {0, 0}},
        {"bm", "Metacentric radius BM, transverse", "m", 4, {0, 0}},
        {"cb", "Block coefficient", "", 4, {0, 0}},
        {"cm", "Largest section coefficient", "", 4, {0, 0}},
        {"cp", "Prismatic coefficient", "", 4, {0, 0}},
        {"cwp", "Waterplane coefficient", "", 4, {0, 0}},
    };
    enum { ROWS = sizeof rows / sizeof *rows };
    double length = problem_length(r->problem), end[2] = {NAN, NAN};
    nurbs_status status = nurbs_hull_perpendiculars(results_hull(r, 0), end);
    cli_needed(status == NURBS_ERROR_MEMORY ? NULL : end);
    double fp = end[1];
    for (size_t i = 0; i < ROWS; i++)
        list[i] = rows[i];
    for (int k = 0; k < 2; k++) {
        const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(results_hull(r, k));
        const double values[ROWS] = {
            length,
            h->x_fore - h->x_aft,
            h->beam,
            h->keel_draft,
            h->draft,
            h->volume,
            h->wetted_area,
            h->waterplane_area,
            fp - h->centroid[0],
            h->centroid[2],
            fp - h->waterplane_centre,
            h->section_area_max,
            h->transom_area,
            h->waterplane_inertia_x / h->volume,
            h->volume / (length * h->beam * h->keel_draft),
            h->section_area_max / (h->beam * h->keel_draft),
            h->volume / (h->section_area_max * length),
            h->waterplane_area / (length * h->beam),
        };
        for (size_t i = 0; i < ROWS; i++)
            set(&list[i], k, values[i]);
    }
    return ROWS;
}
