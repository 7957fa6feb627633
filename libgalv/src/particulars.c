/* Particulars and fairness of a grid. */
#include "constants.h"
#include "error.h"
#include "grid_measures.h"

#include <galv/particulars.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 5 };
/* Depths of the waterlines, shares of the draft: the keel's own flat is left out. */
static const double LEVEL[LEVELS] = {0, 0.2, 0.4, 0.6, 0.8};
static const double COUNTED_TURN = 1e-3; /* rad: less is a straight line */

/* A polygon that grows point by point, and what the fairness of it is so far. */
typedef struct curve {
    size_t n;
    double at[2], heading, length, turn;
    galv_fairness *sum;
} curve;

static void turn_at(curve *c, double turn, double length)
{
    double curvature = fabs(turn) / length;
    c->sum->turning += fabs(turn);
    c->sum->energy += curvature * curvature * length;
    c->sum->radius = fmin(c->sum->radius, 1 / curvature);
    if (fabs(turn) < COUNTED_TURN)
        return;
    c->sum->inflections += turn * c->turn < 0;
    c->turn = turn;
}

static void add_point(curve *c, double a, double b)
{
    double length = hypot(a - c->at[0], b - c->at[1]);
    if (c->n && !(length > 0))
        return;
    double heading = atan2(b - c->at[1], a - c->at[0]);
    if (c->n >= 2)
        turn_at(c, remainder(heading - c->heading, 2 * PI), (length + c->length) / 2);
    c->at[0] = a;
    c->at[1] = b;
    c->heading = heading;
    c->length = length;
    c->n++;
}

/* x and y where a section first crosses the level, from its first point on. */
static bool cross_level(size_t girth, const double *section, double z, double xy[2])
{
    for (size_t j = 0; j + 1 < girth; j++) {
        const double *p = section + 3 * j, *q = p + 3;
        if ((p[2] >= z) == (q[2] >= z))
            continue;
        galv_crossing_at((p[2] - z) / (p[2] - q[2]), p, q, xy);
        return true;
    }
    return false;
}

static void add_waterline(size_t sections, size_t girth, const double *xyz, double z,
                          galv_fairness *sum)
{
    curve c = {.sum = sum};
    double xy[2];
    for (size_t i = 0; i < sections; i++)
        if (cross_level(girth, xyz + 3 * i * girth, z, xy))
            add_point(&c, xy[0], xy[1]);
}

/* The wet part of a section: its area from the centre line and, where asked for, its curve. */
static double add_section(size_t girth, const double *section, galv_fairness *sum)
{
    curve c = {.sum = sum};
    double area = 0;
    for (size_t j = 0; j < girth; j++) {
        const double *p = section + 3 * j, *q = j + 1 < girth ? p + 3 : p;
        double a[2] = {p[1], p[2]}, b[2] = {q[1], q[2]};
        if (a[1] <= 0 && sum)
            add_point(&c, a[0], a[1]);
        if ((a[1] <= 0) != (b[1] <= 0)) {
            double share = a[1] / (a[1] - b[1]);
            double *dry = a[1] > 0 ? a : b;
            dry[0] = p[1] + share * (q[1] - p[1]);
            dry[1] = 0;
            if (sum)
                add_point(&c, dry[0], 0);
        } else if (a[1] > 0) {
            continue;
        }
        area += (a[0] + b[0]) / 2 * (b[1] - a[1]);
    }
    return fabs(area);
}

/* The waterplane, piece by piece: y is linear between the sections. */
static size_t add_waterplane(size_t sections, size_t girth, const double *xyz, galv_particulars *p)
{
    double area = 0, inertia = 0, at[2], last[2] = {0, 0};
    size_t n = 0;
    for (size_t i = 0; i < sections; i++) {
        if (!cross_level(girth, xyz + 3 * i * girth, 0, at))
            continue;
        double dx = at[0] - last[0], a = last[1], b = at[1];
        if (n++) {
            area += dx * (a + b) / 2;
            inertia += dx * (a + b) * (a * a + b * b) / 4;
        }
        p->beam = fmax(p->beam, 2 * at[1]);
        memcpy(last, at, sizeof last);
    }
    p->waterplane_area = 2 * fabs(area);
    p->waterplane_inertia = 2 * fabs(inertia) / 3;
    return n;
}

/* Volume under a wet triangle, its moments along x and z, and its area: y is linear on it. */
static void add_triangle(const double *a, const double *b, const double *c, double sum[4])
{
    const double *const corner[3] = {a, b, c};
    double u[3], v[3], projected;
    for (int k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    projected = (u[0] * v[2] - v[0] * u[2]) / 2;
    double y = a[1] + b[1] + c[1];
    sum[0] += projected * y / 3;
    /* The integral of a product of linear functions: A/12 (sum f sum g + sum f_k g_k). */
    for (int m = 0; m < 2; m++) {
        int axis = m ? 2 : 0;
        double product = 0, total = 0;
        for (int k = 0; k < 3; k++) {
            total += corner[k][axis];
            product += corner[k][axis] * corner[k][1];
        }
        sum[1 + m] += projected * (total * y + product) / 12;
    }
    double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    sum[3] += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
}

static void add_cells(size_t sections, size_t girth, const double *xyz, double sum[4])
{
    for (size_t i = 0; i + 1 < sections; i++)
        for (size_t j = 0; j + 1 < girth; j++) {
            const double *a = xyz + 3 * (i * girth + j), *c = a + 3 * girth;
            const double *const triangles[2][3] = {{a, a + 3, c + 3}, {a, c + 3, c}};
            for (int t = 0; t < 2; t++) {
                double polygon[4][3];
                const double *const *corner = triangles[t];
                if (corner[0][2] <= 0 && corner[1][2] <= 0 && corner[2][2] <= 0) {
                    add_triangle(corner[0], corner[1], corner[2], sum);
                    continue;
                }
                size_t n = galv_wet_polygon(corner, polygon);
                for (size_t k = 2; k < n; k++)
                    add_triangle(polygon[0], polygon[k - 1], polygon[k], sum);
            }
        }
}

static void add_sections(size_t sections, size_t girth, const double *xyz, galv_particulars *p)
{
    double aft = INFINITY;
    for (size_t i = 0; i < sections; i++) {
        const double *section = xyz + 3 * i * girth;
        double xy[2] = {0, 0}, deepest = 0, x = 0;
        p->section_area = fmax(p->section_area, 2 * add_section(girth, section, NULL));
        for (size_t j = 0; j < girth; j++) {
            deepest = fmax(deepest, -section[3 * j + 2]);
            x += section[3 * j] / (double)girth;
        }
        p->draft = fmax(p->draft, deepest);
        if (x >= aft)
            continue;
        aft = x;
        p->transom_draft = deepest;
        p->transom_beam = cross_level(girth, section, 0, xy) ? 2 * xy[1] : 0;
    }
}

galv_status galv_grid_particulars(size_t sections, size_t girth, const double *xyz,
                                  galv_particulars *p)
{
    if (!p)
        return galv_fail(GALV_ERROR_ARGUMENT, "the result must be given");
    galv_status status = galv_grid_check(sections, girth, xyz);
    if (status)
        return status;
    double sum[4] = {0};
    *p = (galv_particulars){0};
    add_cells(sections, girth, xyz, sum);
    add_sections(sections, girth, xyz, p);
    size_t n = add_waterplane(sections, girth, xyz, p);
    if (sum[0] == 0 || n < 2)
        return galv_fail(GALV_ERROR_GEOMETRY,
                         "volume %g below z = 0, %zu sections that cross it: expected a hull in "
                         "the water",
                         2 * sum[0], n);
    p->volume = 2 * fabs(sum[0]);
    p->lcb = sum[1] / sum[0];
    p->vcb = sum[2] / sum[0];
    p->wetted_area = 2 * sum[3];
    return GALV_OK;
}

galv_status galv_grid_fairness(size_t sections, size_t girth, const double *xyz,
                               galv_fairness *waterlines, galv_fairness *stations)
{
    galv_status status = galv_grid_check(sections, girth, xyz);
    double deepest = 0;
    if (status)
        return status;
    for (size_t k = 0; k < sections * girth; k++)
        deepest = fmax(deepest, -xyz[3 * k + 2]);
    if (waterlines)
        *waterlines = (galv_fairness){.radius = INFINITY};
    for (size_t k = 0; k < LEVELS && waterlines; k++)
        add_waterline(sections, girth, xyz, -LEVEL[k] * deepest, waterlines);
    if (stations)
        *stations = (galv_fairness){.radius = INFINITY};
    for (size_t i = 0; i < sections && stations; i++)
        add_section(girth, xyz + 3 * i * girth, stations);
    return GALV_OK;
}

double galv_grid_half_breadth(size_t sections, size_t girth, const double *xyz, double x, double z)
{
    double at[2], last[2] = {0, 0};
    size_t n = 0;
    if (galv_grid_check(sections, girth, xyz))
        return NAN;
    for (size_t i = 0; i < sections; i++) {
        if (!cross_level(girth, xyz + 3 * i * girth, z, at))
            continue;
        double dx = at[0] - last[0], share = (x - last[0]) / dx;
        if (n++ && dx != 0 && share >= 0 && share <= 1)
            return last[1] + share * (at[1] - last[1]);
        memcpy(last, at, sizeof last);
    }
    return NAN;
}
