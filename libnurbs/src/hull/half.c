/* Which side of the centre plane a file describes: the starboard half is mirrored, of surfaces that
 * run from side to side the port half is taken. */
#include "core/error.h"
#include "hull/hull.h"
#include "integrals/quadrature.h"

#include <nurbs/integrals.h>
#include <nurbs/modify.h>
#include <nurbs/topology.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FLAT_ORDER = 6 };

static const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};

/* A surface with less than this on one side, over its reach on the other, lies on one side. */
static const double one_sided = 0.05;
static const double flat_share = 1 - 1e-6; /* |Int n dS| over the area of a plate */
static const double symmetry = 1e-3; /* of area and breadth, else the sides are not mirror images */

static bool runs_across(const hull_box *box, double clearance)
{
    double starboard = -box->lower[1], port = box->upper[1];
    return fmin(starboard, port) > fmax(clearance, one_sided * fmax(starboard, port));
}

/* Control points of one edge row within `tolerance` of y = 0 are put there. */
static nurbs_status flatten_edge(nurbs_surface **surface, int direction, bool last)
{
    size_t n[2] = {nurbs_surface_size(*surface, 0), nurbs_surface_size(*surface, 1)};
    const int degree[2] = {nurbs_surface_degree(*surface, 0), nurbs_surface_degree(*surface, 1)};
    double *points = malloc(3 * n[0] * n[1] * sizeof *points);
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", n[0] * n[1]);
    memcpy(points, nurbs_surface_points(*surface), 3 * n[0] * n[1] * sizeof *points);
    size_t fixed = last ? n[direction] - 1 : 0;
    for (size_t k = 0; k < n[!direction]; k++)
        points[3 * (direction ? k * n[1] + fixed : fixed * n[1] + k) + 1] = 0;
    nurbs_surface *flat = NULL;
    nurbs_status status = nurbs_surface_create(degree, n, nurbs_surface_knots(*surface, 0),
                                               nurbs_surface_knots(*surface, 1), points,
                                               nurbs_surface_weights(*surface), &flat);
    free(points);
    if (status)
        return status;
    nurbs_surface_free(*surface);
    *surface = flat;
    return NURBS_OK;
}

static nurbs_status y_at(const nurbs_surface *surface, int direction, double t, double across,
                         double *y)
{
    double uv[2], p[3];
    uv[direction] = t;
    uv[!direction] = across;
    nurbs_status status = nurbs_surface_eval(surface, 0, 1, uv, p);
    *y = p[1];
    return status;
}

/* The parameter line of a direction that lies in the centre plane, by bisection on its middle. */
static nurbs_status centre_line(const nurbs_surface *surface, int direction, double clearance,
                                double *at, double *low_side, bool *found)
{
    enum { SAMPLES = 32 };
    const double *t = nurbs_surface_knots(surface, direction),
                 *s = nurbs_surface_knots(surface, !direction);
    double low = t[0], high = t[nurbs_surface_size(surface, direction)], first = s[0],
           length = s[nurbs_surface_size(surface, !direction)] - first, y, other;
    nurbs_status status = y_at(surface, direction, low, first + 0.5 * length, low_side);
    if (!status)
        status = y_at(surface, direction, high, first + 0.5 * length, &other);
    *found = !status && (*low_side > 0) != (other > 0);
    for (int k = 0; k < 80 && *found && !status; k++) {
        *at = 0.5 * (low + high);
        status = y_at(surface, direction, *at, first + 0.5 * length, &y);
        *((y > 0) == (*low_side > 0) ? &low : &high) = *at;
    }
    for (int k = 0; k <= SAMPLES && *found && !status; k++) {
        status = y_at(surface, direction, *at, first + length * k / SAMPLES, &y);
        *found = fabs(y) <= clearance;
    }
    return status;
}

static nurbs_status is_flat(const nurbs_surface *surface, bool *yes)
{
    patch_sums sums;
    nurbs_status status = patch_integrate(surface, 0, FLAT_ORDER, &sums);
    const double *n = sums.normal;
    *yes = !status && sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) > flat_share * sums.area;
    return status;
}

/* The part to port of a flat patch, a bottom or stem plate, without a parameter line in the centre
 * plane: with y for a height, cut as at the water. */
static nurbs_status cut_port_side(nurbs_hull *hull, const nurbs_surface *surface,
                                  nurbs_patches *port)
{
    static const double over[9] = {1, 0, 0, 0, 0, 1, 0, -1, 0},
                        back[9] = {1, 0, 0, 0, 0, -1, 0, 1, 0};
    nurbs_surface *turned = NULL;
    nurbs_patches *below = NULL;
    nurbs_status status = nurbs_surface_transform(surface, over, NULL, &turned);
    if (!status)
        status = nurbs_patches_create(&below);
    if (!status)
        status =
            hull_cut_patch(turned, 0, hull->extent, hull->options.cut, below, &hull->deviation);
    for (size_t k = 0; k < nurbs_patches_count(below) && !status; k++) {
        nurbs_surface *part = NULL;
        status = nurbs_surface_transform(nurbs_patches_get(below, k), back, NULL, &part);
        if (!status)
            status = nurbs_patches_add(port, part);
        nurbs_surface_free(part);
    }
    nurbs_surface_free(turned);
    nurbs_patches_free(below);
    return status;
}

/* The part of a surface to port of the centre plane; exactly if a parameter line lies there. */
static nurbs_status port_side(nurbs_hull *hull, const nurbs_surface *surface, nurbs_patches *port)
{
    for (int d = 0; d < 2; d++) {
        const double *t = nurbs_surface_knots(surface, d);
        double at, low_side;
        bool found;
        nurbs_surface *part = NULL;
        nurbs_status status =
            centre_line(surface, d, HULL_CLEARANCE * hull->extent, &at, &low_side, &found);
        if (status)
            return status;
        if (!found)
            continue;
        bool first = low_side > 0;
        status = nurbs_surface_part(surface, d, first ? t[0] : at,
                                    first ? at : t[nurbs_surface_size(surface, d)], &part);
        if (!status)
            status = flatten_edge(&part, d, first);
        if (!status)
            status = nurbs_patches_add(port, part);
        nurbs_surface_free(part);
        return status;
    }
    bool plate = false;
    nurbs_status status = is_flat(surface, &plate);
    if (status || plate)
        return status ? status : cut_port_side(hull, surface, port);
    return nurbs_fail(
        NURBS_ERROR_GEOMETRY,
        "it runs across the centre plane, and none of its parameter lines lies there: "
        "expected one side, or a surface that can be divided at y = 0");
}

typedef enum lie { TO_PORT, TO_STARBOARD, ACROSS } lie;

static nurbs_status find_lie(const nurbs_surface *surface, double clearance, lie *where)
{
    hull_box box = hull_box_empty();
    nurbs_status status = hull_box_widen(surface, &box);
    *where = runs_across(&box, clearance)    ? ACROSS
             : box.upper[1] >= -box.lower[1] ? TO_PORT
                                             : TO_STARBOARD;
    return status;
}

/* Areas by where patches lie. */
static nurbs_status find_areas(const nurbs_hull *hull, double area[3])
{
    area[TO_PORT] = area[TO_STARBOARD] = area[ACROSS] = 0;
    for (size_t k = 0; k < nurbs_patches_count(hull->full); k++) {
        lie where;
        double one;
        nurbs_status status =
            find_lie(nurbs_patches_get(hull->full, k), HULL_CLEARANCE * hull->extent, &where);
        if (!status)
            status = nurbs_surface_area(nurbs_patches_get(hull->full, k), &one, NULL);
        if (status)
            return status;
        area[where] += one;
    }
    return NURBS_OK;
}

/* What runs across is symmetric; beside it there is one side, or its mirror image too. */
static nurbs_status check_symmetry(const double area[3], double half)
{
    double sides = fmax(area[TO_PORT], area[TO_STARBOARD]);
    if (fabs(2 * half - area[ACROSS]) <= symmetry * area[ACROSS] &&
        (fabs(area[TO_PORT] - area[TO_STARBOARD]) <= symmetry * sides || area[TO_STARBOARD] == 0))
        return NURBS_OK;
    return nurbs_fail(NURBS_ERROR_GEOMETRY,
                      "the sides are no mirror images: %.6g m^2 of the area are to port, %.6g m^2 "
                      "to starboard",
                      area[TO_PORT] + half, area[TO_STARBOARD] + area[ACROSS] - half);
}

/* Adds the port half of what runs across, and its area. */
static nurbs_status add_port_side(nurbs_hull *hull, const nurbs_surface *surface,
                                  nurbs_patches *port, double *half)
{
    size_t first = nurbs_patches_count(port);
    nurbs_status status = port_side(hull, surface, port);
    for (size_t k = first; k < nurbs_patches_count(port) && !status; k++) {
        double area;
        status = nurbs_surface_area(nurbs_patches_get(port, k), &area, NULL);
        *half += status ? 0 : area;
    }
    return status;
}

/* Of surfaces that run across the centre plane the port side, with the patches to port. */
static nurbs_status take_port(nurbs_hull *hull, const double area[3])
{
    size_t *number = NULL;
    double half = 0;
    nurbs_patches *port = NULL;
    nurbs_status status = hull_start_patches(hull->full, &port);
    for (size_t k = 0; k < nurbs_patches_count(hull->full) && !status; k++) {
        const nurbs_surface *surface = nurbs_patches_get(hull->full, k);
        size_t before = nurbs_patches_count(port), after;
        lie where;
        status = find_lie(surface, HULL_CLEARANCE * hull->extent, &where);
        if (!status && where == ACROSS) {
            char name[40];
            snprintf(name, sizeof name, "patch %zu", hull->number[k]);
            status = add_port_side(hull, surface, port, &half);
            status = status ? nurbs_fail_in(status, name) : NURBS_OK;
        } else if (!status && where == TO_PORT)
            status = nurbs_patches_add(port, surface);
        after = nurbs_patches_count(port);
        size_t *more = realloc(number, (after + 1) * sizeof *number);
        if (!more && !status)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", after);
        number = more ? more : number;
        for (; before < after && !status; before++)
            number[before] = hull->number[k];
    }
    if (!status)
        status = check_symmetry(area, half);
    if (status) {
        nurbs_patches_free(port);
        free(number);
        return status;
    }
    free(hull->number);
    hull->number = number;
    hull_replace_full(hull, port);
    return hull_tell(hull, "port and starboard in one: the port half is taken");
}

static nurbs_status mirror_all(nurbs_hull *hull)
{
    const double none[3] = {0, 0, 0};
    nurbs_patches *turned = NULL;
    nurbs_status status = nurbs_patches_transform(hull->full, mirror, none, &turned);
    if (status)
        return status;
    hull_replace_full(hull, turned);
    return hull_tell(hull, "the starboard half: mirrored to y >= 0");
}

nurbs_status hull_take_half(nurbs_hull *hull)
{
    double area[3];
    nurbs_status status = find_areas(hull, area);
    if (!status && area[TO_PORT] == 0 && area[TO_STARBOARD] > 0) {
        status = mirror_all(hull);
        area[TO_PORT] = area[TO_STARBOARD];
        area[TO_STARBOARD] = 0;
    }
    return !status && area[ACROSS] > 0 ? take_port(hull, area) : status;
}
