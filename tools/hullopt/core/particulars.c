#include "core/particulars.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct particular_row ROWS[PARTICULARS] = {
    {"surface", "wetted surface", "m²", 4, false},
    {"beam", "beam at the waterline", "m", 4, false},
    {"lcb", "centre of buoyancy along x, share of the length", "", 5, true},
    {"km", "metacentre above the keel", "m", 4, false},
    {"gm", "metacentric height", "m", 4, false},
    {"midship", "largest section coefficient", "", 4, false},
    {"waterplane", "waterplane coefficient", "", 4, false},
    {"transom_breadth", "breadth of the transom at the waterline", "m", 4, false},
    {"transom_depth", "depth of the transom", "m", 4, false},
    {"waterlines", "turning of the waterlines", "rad", 3, false},
    {"sections", "turning of the sections", "rad", 3, false},
    {"radius", "least radius of the waterlines", "m", 4, false},
    {"waterlines_energy", "bending energy of the waterlines", "1/m", 3, false},
    {"sections_energy", "bending energy of the sections", "1/m", 3, false},
    {"waterlines_inflections", "inflections of the waterlines", "", 0, false},
    {"sections_inflections", "inflections of the sections", "", 0, false},
    {"stations", "half breadths at the stations, over the original's", "", 4, false},
    {"hard", "half breadths at the hard points, over the original's", "", 4, false},
    {"boxes", "half breadths at the boxes, over theirs", "", 4, false},
};

const struct particular_row *particular_row(enum particular p)
{
    return (unsigned)p < PARTICULARS ? &ROWS[p] : NULL;
}

/* A grid and its parent's. */
struct view {
    const struct problem *problem;
    size_t sections, girth;
    const double *xyz, *parent;
    bool all;
};

static double half_breadth(const struct view *v, const double *xyz, double x, double z)
{
    return galv_grid_half_breadth(v->sections, v->girth, xyz, x, z);
}

static void join(double value[2], double ratio)
{
    value[0] = isnan(ratio) ? NAN : fmin(value[0], ratio);
    value[1] = isnan(ratio) ? NAN : fmax(value[1], ratio);
}

/* Half breadths at (x, z) over those of the parent. */
static void at_point(const struct view *v, double x, double z, double value[2])
{
    join(value, half_breadth(v, v->xyz, x, z) / half_breadth(v, v->parent, x, z));
}

/* Half breadths over that of a box, on its outline and inside. */
static void at_box(const struct view *v, const double box[5], double value[2])
{
    enum { POINTS = 5 };
    for (int i = 0; i < POINTS; i++)
        for (int j = 0; j < POINTS; j++) {
            double s = i / (POINTS - 1.0), t = j / (POINTS - 1.0);
            join(value, half_breadth(v, v->xyz, box[0] + s * (box[1] - box[0]),
                                     box[3] + t * (box[4] - box[3])) /
                            box[2]);
        }
}

static void measure_places(const struct view *v, double value[PARTICULARS][2])
{
    const struct config *c = v->problem->config;
    for (int p = PARTICULAR_STATIONS; p < PARTICULARS; p++) {
        value[p][0] = INFINITY;
        value[p][1] = -INFINITY;
    }
    for (size_t i = 0; i < c->stations; i++)
        at_point(v, c->station[i], 0, value[PARTICULAR_STATIONS]);
    for (size_t i = 0; i + 1 < c->hard_points; i += 2)
        at_point(v, c->hard_point[i], c->hard_point[i + 1], value[PARTICULAR_HARD]);
    for (size_t i = 0; i + 4 < c->boxes; i += 5)
        at_box(v, c->box + i, value[PARTICULAR_BOXES]);
    for (int p = PARTICULAR_STATIONS; p < PARTICULARS; p++)
        if (!(value[p][0] <= value[p][1]))
            value[p][0] = value[p][1] = NAN;
}

/* Fairness takes as long as all the rest. */
static bool measure_fairness(const struct view *v, double value[PARTICULARS][2])
{
    const struct config *c = v->problem->config;
    galv_fairness waterlines = {NAN, NAN, NAN, NAN, {0}}, sections = waterlines;
    bool wanted = v->all;
    for (int p = PARTICULAR_WATERLINES; p < PARTICULAR_STATIONS && !wanted; p++)
        wanted = !isnan(c->particular[p][0]);
    if (wanted &&
        !core_ok(galv_grid_fairness(v->sections, v->girth, v->xyz, &waterlines, &sections),
                 "grid: %s", galv_last_error()))
        return false;
    for (int end = 0; end < 2; end++) {
        value[PARTICULAR_WATERLINES][end] = waterlines.turning;
        value[PARTICULAR_RADIUS][end] = waterlines.radius;
        value[PARTICULAR_WATERLINES_ENERGY][end] = waterlines.energy;
        value[PARTICULAR_WATERLINES_INFLECTIONS][end] = waterlines.inflections;
        value[PARTICULAR_SECTIONS][end] = sections.turning;
        value[PARTICULAR_SECTIONS_ENERGY][end] = sections.energy;
        value[PARTICULAR_SECTIONS_INFLECTIONS][end] = sections.inflections;
    }
    return true;
}

static bool measure(const struct view *v, double value[PARTICULARS][2])
{
    galv_particulars g;
    double length = problem_length(v->problem);
    if (!core_ok(galv_grid_particulars(v->sections, v->girth, v->xyz, &g), "grid: %s",
                 galv_last_error()))
        return false;
    double km = g.draft + g.vcb + g.waterplane_inertia / g.volume;
    const double single[PARTICULAR_WATERLINES] = {
        g.wetted_area,
        g.beam,
        g.lcb / length,
        km,
        km - v->problem->config->kg,
        g.section_area / (g.beam * g.draft),
        g.waterplane_area / (length * g.beam),
        g.transom_beam,
        g.transom_draft,
    };
    for (int p = 0; p < PARTICULAR_WATERLINES; p++)
        value[p][0] = value[p][1] = single[p];
    measure_places(v, value);
    return measure_fairness(v, value);
}

bool particulars_of(const struct problem *problem, const double *points, bool all,
                    double value[PARTICULARS][2])
{
    const nurbs_grid *grid = problem->grid;
    const struct view v = {.problem = problem,
                           .sections = nurbs_grid_rows(grid),
                           .girth = nurbs_grid_columns(grid),
                           .xyz = points,
                           .parent = nurbs_grid_points(grid),
                           .all = all};
    return measure(&v, value);
}
