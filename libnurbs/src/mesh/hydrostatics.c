/* Hydrostatics of triangles: with normals outwards and fields along y, the divergence theorem needs
 * no lid, no centre plane and no transom, however it is raked: they carry no n_y, or lie in y = 0.
 */
#include "core/error.h"
#include "core/vector.h"
#include "mesh/mesh.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { SECTIONS = 41 };

/* Shares of the extent: lengths below the first are none; edges nearer to another open edge than
 * the second close on it. */
static const double negligible = 2e-6, seam_share = 1e-4;

/* Of the length: where a transom may stand, and how flat it is. */
static const double stern_share = 0.05, flat_share = 1e-4;

typedef struct body {
    const nurbs_mesh *mesh;
    double level, near;
    double low[3], high[3]; /* below the level */
    double x_low, x_high;   /* of all of it */
    bool half, closed_stern;
    double stern; /* x of the closed transom */
    size_t crossings;
    double line_low[2], line_high[2]; /* x and y of the water line */
} body;

/* Below the level: up to four corners. */
static size_t clip(const body *b, size_t triangle, double polygon[4][3])
{
    const size_t *corner = b->mesh->corner + 3 * triangle;
    size_t n = 0;
    for (size_t k = 0; k < 3; k++) {
        const double *p = b->mesh->points + 3 * corner[k],
                     *q = b->mesh->points + 3 * corner[(k + 1) % 3];
        double hp = p[2] - b->level, hq = q[2] - b->level;
        if (hp <= 0)
            memcpy(polygon[n++], p, sizeof polygon[0]);
        if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) {
            for (int c = 0; c < 3; c++)
                polygon[n][c] = p[c] + hp / (hp - hq) * (q[c] - p[c]);
            polygon[n++][2] = b->level;
        }
    }
    return n;
}

static void widen(double value, double *low, double *high)
{
    *low = fmin(*low, value);
    *high = fmax(*high, value);
}

/* Extents of the body, of what is below the level, and of the water line. */
static nurbs_status measure_body(body *b)
{
    const nurbs_mesh *m = b->mesh;
    double y_low = INFINITY, y_high = -INFINITY, z_low = INFINITY, z_high = -INFINITY;
    double polygon[4][3];
    for (int c = 0; c < 3; c++) {
        b->low[c] = INFINITY;
        b->high[c] = -INFINITY;
    }
    b->x_low = b->line_low[0] = b->line_low[1] = INFINITY;
    b->x_high = b->line_high[0] = b->line_high[1] = -INFINITY;
    b->near = negligible * m->extent;
    for (size_t k = 0; k < m->vertices; k++) {
        widen(m->points[3 * k], &b->x_low, &b->x_high);
        widen(m->points[3 * k + 1], &y_low, &y_high);
        widen(m->points[3 * k + 2], &z_low, &z_high);
    }
    b->half = y_low >= -b->near || y_high <= b->near;
    for (size_t k = 0; k < m->triangles; k++) {
        size_t n = clip(b, k, polygon);
        for (size_t i = 0; n > 2 && i < n; i++) {
            for (int c = 0; c < 3; c++)
                widen(polygon[i][c], &b->low[c], &b->high[c]);
            if (polygon[i][2] < b->level)
                continue;
            b->crossings++;
            for (int c = 0; c < 2; c++)
                widen(polygon[i][c], &b->line_low[c], &b->line_high[c]);
        }
    }
    if (!(b->high[0] > b->low[0]))
        return nurbs_fail(
            NURBS_ERROR_GEOMETRY,
            "the mesh has nothing below z = %g m: it lies between z = %.6g and %.6g m", b->level,
            z_low, z_high);
    return NURBS_OK;
}

static void normal_of(const nurbs_mesh *m, size_t triangle, double n[3])
{
    const size_t *corner = m->corner + 3 * triangle;
    double u[3], v[3];
    minus3(m->points + 3 * corner[1], m->points + 3 * corner[0], u);
    minus3(m->points + 3 * corner[2], m->points + 3 * corner[0], v);
    cross3(u, v, n);
    unit3(n);
}

/* A triangle that stands across x near the aft end. */
static bool at_stern(const body *b, size_t triangle)
{
    const size_t *corner = b->mesh->corner + 3 * triangle;
    double n[3];
    normal_of(b->mesh, triangle, n);
    return fabs(n[0]) > 1 - 1e-6 &&
           b->mesh->points[3 * corner[0]] < b->x_low + stern_share * (b->x_high - b->x_low);
}

/* The plane of a closed transom: one of its triangles reaches the level. */
static void find_transom(body *b)
{
    for (size_t k = 0; k < b->mesh->triangles; k++) {
        double polygon[4][3], top = -INFINITY;
        size_t n = clip(b, k, polygon);
        for (size_t i = 0; i < n; i++)
            top = fmax(top, polygon[i][2]);
        if (n < 3 || top < b->level - b->near || !at_stern(b, k))
            continue;
        b->closed_stern = true;
        b->stern = polygon[0][0];
    }
}

static bool is_transom(const body *b, size_t triangle)
{
    double x = b->mesh->points[3 * b->mesh->corner[3 * triangle]];
    return b->closed_stern && fabs(x - b->stern) < flat_share * (b->x_high - b->x_low) &&
           at_stern(b, triangle);
}

static bool is_centre_plane(const body *b, const double polygon[4][3], size_t n)
{
    bool flat = b->half;
    for (size_t i = 0; i < n; i++)
        flat &= fabs(polygon[i][1]) <= b->near;
    return flat;
}

static bool is_waterplane(const body *b, const double polygon[4][3], size_t n)
{
    bool flat = true;
    for (size_t i = 0; i < n; i++)
        flat &= polygon[i][2] >= b->level - b->near;
    return flat;
}

/* Integral of f g over a triangle of unit area, both linear. */
static double product(const double f[3], const double g[3])
{
    return (f[0] * g[0] + f[1] * g[1] + f[2] * g[2] + (f[0] + f[1] + f[2]) * (g[0] + g[1] + g[2])) /
           12;
}

typedef struct sums {
    double area, volume, moment[3], plane, plane_x, plane_xx, plane_yy, forward, transom;
} sums;

static void add_triangle(const double *p[3], bool wetted, bool transom, sums *s)
{
    double u[3], v[3], n[3], x[3], y[3], z[3];
    minus3(p[1], p[0], u);
    minus3(p[2], p[0], v);
    cross3(u, v, n);
    double area = 0.5 * norm3(n), across = 0.5 * n[1];
    for (int k = 0; k < 3; k++) {
        x[k] = p[k][0];
        y[k] = p[k][1];
        z[k] = p[k][2];
    }
    s->area += wetted ? area : 0;
    s->transom += transom ? area : 0;
    s->forward += transom ? 0 : 0.5 * n[0];
    s->volume += across * (y[0] + y[1] + y[2]) / 3;
    s->moment[0] += across * product(x, y);
    s->moment[1] += 0.5 * across * product(y, y);
    s->moment[2] += across * product(z, y);
}

/* The water line from p to q: Simpson's rule is exact for the cubics that the inertia asks. */
static void add_line(const double p[3], const double q[3], double outwards, sums *s)
{
    double dx = q[0] - p[0], sign = outwards >= 0 ? 1 : -1;
    for (int k = 0; k < 3; k++) {
        double t = 0.5 * k, weight = (k == 1 ? 4.0 : 1.0) / 6 * fabs(dx) * sign, x = p[0] + t * dx,
               y = p[1] + t * (q[1] - p[1]);
        s->plane += weight * y;
        s->plane_x += weight * x * y;
        s->plane_xx += weight * x * x * y;
        s->plane_yy += weight * y * y * y / 3;
    }
}

/* The edge at the level of what is left of a triangle below it. */
static void add_water_line(const body *b, size_t triangle, size_t n, const double polygon[4][3],
                           sums *s)
{
    double normal[3];
    normal_of(b->mesh, triangle, normal);
    for (size_t i = 0; i < n; i++) {
        const double *p = polygon[i], *q = polygon[(i + 1) % n];
        if (p[2] >= b->level && q[2] >= b->level)
            add_line(p, q, normal[1], s);
    }
}

static void add_all(const body *b, sums *s)
{
    for (size_t k = 0; k < b->mesh->triangles; k++) {
        double polygon[4][3];
        size_t n = clip(b, k, polygon);
        if (n < 3 || is_waterplane(b, (const double(*)[3])polygon, n))
            continue;
        add_water_line(b, k, n, (const double(*)[3])polygon, s);
        bool transom = is_transom(b, k),
             wetted = !transom && !is_centre_plane(b, (const double(*)[3])polygon, n);
        for (size_t i = 1; i + 1 < n; i++)
            add_triangle((const double *[3]){polygon[0], polygon[i], polygon[i + 1]}, wetted,
                         transom, s);
    }
}

/* Area of the section at x below the level, and its lowest z. */
static double section_area(const body *b, double x, double *keel)
{
    double area = 0;
    for (size_t k = 0; k < b->mesh->triangles; k++) {
        double polygon[4][3], cut[2][3], n[3];
        size_t corners = clip(b, k, polygon), found = 0;
        for (size_t i = 0; corners > 2 && i < corners && found < 2; i++) {
            const double *p = polygon[i], *q = polygon[(i + 1) % corners];
            if ((p[0] >= x) == (q[0] >= x))
                continue;
            for (int c = 0; c < 3; c++)
                cut[found][c] = p[c] + (x - p[0]) / (q[0] - p[0]) * (q[c] - p[c]);
            found++;
        }
        if (found < 2)
            continue;
        normal_of(b->mesh, k, n);
        double dy = cut[1][1] - cut[0][1], dz = cut[1][2] - cut[0][2],
               side = dz * n[1] - dy * n[2] >= 0 ? 1 : -1;
        area -= side * dy * (0.5 * (cut[0][2] + cut[1][2]) - b->level);
        *keel = fmin(*keel, fmin(cut[0][2], cut[1][2]));
    }
    return area;
}

static double to_segment(const double p[3], const double a[3], const double b[3])
{
    double d[3], q[3];
    minus3(b, a, d);
    minus3(p, a, q);
    double t = fmin(fmax(dot3(q, d) / dot3(d, d), 0), 1);
    along3(a, t, d, q);
    return distance3(p, q);
}

/* An open edge whose middle lies on another open one: patches that meet without sharing vertices.
 */
static bool is_seam(const body *b, size_t edge, size_t count, const size_t *open)
{
    const nurbs_mesh *m = b->mesh;
    const mesh_edge *e = &m->edge[edge];
    double middle[3], near = seam_share * m->extent;
    for (int c = 0; c < 3; c++)
        middle[c] = 0.5 * (m->points[3 * e->vertex[0] + (size_t)c] +
                           m->points[3 * e->vertex[1] + (size_t)c]);
    for (size_t k = 0; k < count; k++) {
        const double *p = m->points + 3 * m->edge[open[k]].vertex[0],
                     *q = m->points + 3 * m->edge[open[k]].vertex[1];
        if (open[k] != edge && fmin(p[0], q[0]) <= middle[0] + near &&
            fmax(p[0], q[0]) >= middle[0] - near && to_segment(middle, p, q) <= near)
            return true;
    }
    return false;
}

/* Whether an open edge may be: above the level, in y = 0, or at the stern, as an open transom. */
static bool may_be_open(const body *b, size_t edge)
{
    const double *p = b->mesh->points + 3 * b->mesh->edge[edge].vertex[0],
                 *q = b->mesh->points + 3 * b->mesh->edge[edge].vertex[1];
    if (fmin(p[2], q[2]) >= b->level - b->near)
        return true;
    if (b->half && fabs(p[1]) <= b->near && fabs(q[1]) <= b->near)
        return true;
    return !b->closed_stern && fmax(p[0], q[0]) <= b->x_low + stern_share * (b->x_high - b->x_low);
}

static nurbs_status check_openings(const body *b)
{
    const nurbs_mesh *m = b->mesh;
    size_t count = 0, *open = malloc(m->edges * sizeof *open);
    nurbs_status status = NURBS_OK;
    if (!open)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu edges", m->edges);
    for (size_t k = 0; k < m->edges; k++)
        if (m->edge[k].count == 1 && !may_be_open(b, k))
            open[count++] = k;
    for (size_t k = 0; k < count && status == NURBS_OK; k++)
        if (!is_seam(b, open[k], count, open)) {
            const double *p = m->points + 3 * m->edge[open[k]].vertex[0];
            status = nurbs_fail(NURBS_ERROR_GEOMETRY,
                                "the mesh is open below the water, first at x = %g, y = %g, z = %g",
                                p[0], p[1], p[2]);
        }
    free(open);
    return status;
}

static void fill_sections(const body *b, double sides, nurbs_hydrostatics *r)
{
    double length = b->high[0] - b->low[0], keel;
    for (int k = 0; k < SECTIONS; k++) {
        /* Midpoints of equal parts: never through the ends. */
        double x = b->low[0] + length * (k + 0.5) / SECTIONS, area;
        keel = INFINITY;
        area = sides * section_area(b, x, &keel);
        if (area > r->section_area_max) {
            r->section_area_max = area;
            r->section_area_max_x = x;
        }
    }
    keel = INFINITY;
    section_area(b, 0.5 * (r->x_aft + r->x_fore), &keel);
    r->keel_draft = isfinite(keel) ? b->level - keel : NAN;
}

static void fill(const body *b, const sums *s, nurbs_hydrostatics *r)
{
    double sides = b->half ? 2 : 1;
    bool floats = b->crossings > 0 && b->line_high[0] - b->line_low[0] > b->near;
    const double *low = floats ? b->line_low : b->low, *high = floats ? b->line_high : b->high;
    r->wetted_area = sides * s->area;
    r->volume = sides * s->volume;
    for (int c = 0; c < 3; c++)
        r->centroid[c] = s->moment[c] / s->volume;
    if (b->half)
        r->centroid[1] = 0;
    r->waterplane_area = sides * s->plane;
    if (floats) {
        r->waterplane_centre = s->plane_x / s->plane;
        r->waterplane_inertia_x = sides * s->plane_yy;
        r->waterplane_inertia_y = sides * (s->plane_xx - s->plane_x * r->waterplane_centre);
    } else {
        r->waterplane_area = 0;
    }
    r->beam = b->half ? 2 * fmax(fabs(low[1]), fabs(high[1])) : high[1] - low[1];
    r->draft = b->level - b->low[2];
    r->x_aft = low[0];
    r->x_fore = high[0];
    r->transom_area = sides * (b->closed_stern ? s->transom : fmax(s->forward, 0));
    if (r->transom_area < 1e-6 * r->wetted_area)
        r->transom_area = 0;
    fill_sections(b, sides, r);
}

nurbs_status nurbs_mesh_hydrostatics(const nurbs_mesh *mesh, double level,
                                     nurbs_hydrostatics *result)
{
    if (!mesh || !result || !isfinite(level))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no mesh, no result, or level %g", level);
    body b = {.mesh = mesh, .level = level};
    sums s = {0};
    *result = (nurbs_hydrostatics){0};
    nurbs_status status = measure_body(&b);
    if (status != NURBS_OK)
        return status;
    find_transom(&b);
    status = check_openings(&b);
    if (status != NURBS_OK)
        return status;
    add_all(&b, &s);
    if (!(s.volume > 0))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "the mesh encloses a volume of %g below z = %g",
                          s.volume, level);
    fill(&b, &s, result);
    return NURBS_OK;
}
