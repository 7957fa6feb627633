/* A surface cut at a level where not every section crosses it: seams that slope through the water,
 * patches that dip into it. The surface is divided across its sections into strips that lie wholly
 * below, wholly above, or whose sections cross once; these are cut by surface_wetted(). */
#include "core/error.h"
#include "hull/hull.h"
#include "section/wetted.h"

#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>

enum { ALONG = 8, ACROSS = 4 }; /* samples a knot span */

/* Relative to the extent: heights below this are none. */
static const double rounding = 1e-12;

typedef enum course { ABOVE, BELOW, CROSSES, SEVERAL } course;

typedef struct strips {
    const nurbs_surface *surface;
    double level, slack;
    size_t n; /* samples of a section */
    double *v, *points;
} strips;

static size_t divide(const nurbs_surface *surface, int direction, size_t parts, double *t)
{
    const double *knots = nurbs_surface_knots(surface, direction);
    size_t size = nurbs_surface_size(surface, direction), count = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, direction); k < size; k++)
        for (size_t s = 0; s < parts && knots[k + 1] > knots[k]; s++)
            t[count++] = knots[k] + (knots[k + 1] - knots[k]) * (double)s / (double)parts;
    t[count++] = knots[size];
    return count;
}

static nurbs_status find_course(const strips *s, double u, course *found)
{
    size_t changes = 0;
    int before = 0, below = 0;
    nurbs_status status = nurbs_surface_eval_grid(s->surface, 0, 1, &u, s->n, s->v, s->points);
    for (size_t k = 0; k < s->n && !status; k++) {
        double height = s->points[3 * k + 2] - s->level;
        int side = height > s->slack ? 1 : height < -s->slack ? -1 : 0;
        below |= side < 0;
        changes += side && before && side != before;
        before = side ? side : before;
    }
    *found = changes > 1 ? SEVERAL : changes == 1 ? CROSSES : below ? BELOW : ABOVE;
    return status;
}

/* Between sections of different courses: the last parameter, seen from `from`, of its course. */
static nurbs_status find_change(const strips *s, double from, double to, course of, double *at)
{
    for (;;) {
        double middle = 0.5 * (from + to);
        course here;
        if (middle == from || middle == to)
            break;
        nurbs_status status = find_course(s, middle, &here);
        if (status)
            return status;
        *(here == of ? &from : &to) = middle;
    }
    *at = from;
    return NURBS_OK;
}

/* One strip: kept, cut, or left out. */
static nurbs_status add_strip(const strips *s, double from, double to, bool crosses, bool below,
                              double tolerance, nurbs_patches *out, double *deviation)
{
    const double *t = nurbs_surface_knots(s->surface, 0);
    double length = t[nurbs_surface_size(s->surface, 0)] - t[0], off = 0;
    nurbs_surface *part = NULL, *wetted = NULL;
    if ((!crosses && !below) || !(to - from > 1e-12 * length))
        return NURBS_OK;
    nurbs_status status = nurbs_surface_part(s->surface, 0, from, to, &part);
    if (!status && crosses)
        status = surface_wetted(part, s->level, tolerance, &wetted, &off);
    if (!status)
        status = nurbs_patches_add(out, crosses ? wetted : part);
    *deviation = fmax(*deviation, off);
    nurbs_surface_free(part);
    nurbs_surface_free(wetted);
    return status;
}

/* Whether a strip ends between two neighbouring courses: a section that crosses next to one that
 * lies above belongs to one strip with it, whose end surface_wetted() finds. */
static bool parts_strips(course a, course b)
{
    return a != b && (a == BELOW || b == BELOW);
}

/* Walks along u[n]. */
static nurbs_status walk(const strips *s, size_t n, const double *u, double tolerance,
                         nurbs_patches *out, double *deviation)
{
    course last = ABOVE, here;
    bool crosses = false, below = false, left = false;
    double from = u[0];
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && !status; k++, last = here) {
        status = find_course(s, u[k], &here);
        if (!status && here == SEVERAL)
            status = nurbs_fail(NURBS_ERROR_GEOMETRY,
                                "the section at u = %.6g crosses the level z = %g more than once",
                                u[k], s->level);
        double at = u[k];
        /* A crossing that comes back after sections above begins a strip of its own. */
        bool again = here == CROSSES && left;
        if (!status && k && (parts_strips(last, here) || again)) {
            if (again && last == ABOVE)
                at = u[k - 1];
            else
                status =
                    find_change(s, last == BELOW ? u[k] : u[k - 1], last == BELOW ? u[k - 1] : u[k],
                                last == BELOW ? here : last, &at);
            if (!status)
                status = add_strip(s, from, at, crosses, below, tolerance, out, deviation);
            from = at;
            crosses = below = left = false;
        }
        crosses |= here == CROSSES;
        below |= here == BELOW;
        left |= here == ABOVE && crosses;
    }
    return status ? status
                  : add_strip(s, from, u[n - 1], crosses, below, tolerance, out, deviation);
}

nurbs_status hull_cut_strips(const nurbs_surface *surface, double level, double extent,
                             double tolerance, nurbs_patches *below, double *deviation)
{
    size_t nu = ALONG * nurbs_surface_size(surface, 0) + 1,
           nv = ACROSS * nurbs_surface_size(surface, 1) + 1;
    double *u = malloc((nu + 4 * nv) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu sections", nu);
    strips s = {.surface = surface,
                .level = level,
                .slack = rounding * extent,
                .v = u + nu,
                .points = u + nu + nv};
    s.n = divide(surface, 1, ACROSS, s.v);
    nu = divide(surface, 0, ALONG, u);
    nurbs_status status = walk(&s, nu, u, tolerance, below, deviation);
    free(u);
    return status;
}
