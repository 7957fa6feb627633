#include "kelvin/panel_frame.h"

#include "core/error.h"

#include <math.h>
#include <string.h>

/* Nearer to a plane or an edge than this share of the panel's size is on it. */
static const double on_it = 1e-12;
static const double most_warp = 0.1, same_corner = 1e-9;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void difference(const double a[3], const double b[3], double c[3])
{
    for (int k = 0; k < 3; k++)
        c[k] = a[k] - b[k];
}

static double distance(const double a[3], const double b[3])
{
    double d[3];
    difference(a, b, d);
    return sqrt(dot(d, d));
}

/* Copies the corners that differ from the next one; returns how many. */
static int distinct_corners(const double *corners, double size, double corner[4][3])
{
    int n = 0;
    for (int c = 0; c < 4; c++)
        if (distance(corners + 3 * c, corners + 3 * ((c + 1) % 4)) > same_corner * size)
            memcpy(corner[n++], corners + 3 * c, 3 * sizeof *corners);
    return n;
}

/* The area of a triangle of corners, signed by the normal. */
static double triangle_area(const struct panel *p, const int c[3])
{
    double a[3], b[3], n[3];
    difference(p->corner[c[1]], p->corner[c[0]], a);
    difference(p->corner[c[2]], p->corner[c[0]], b);
    cross(a, b, n);
    return 0.5 * dot(n, p->normal);
}

void panel_triangle(const struct panel *panel, int t, int corner[3])
{
    int first = panel->diagonal;
    corner[0] = first;
    corner[1] = (first + 1 + t) % panel->corners;
    corner[2] = (first + 2 + t) % panel->corners;
}

/* Moves the corners to the plane of their mean; returns by how much at most. */
static double flatten(struct panel *p, double mean[3])
{
    double warp = 0;
    for (int k = 0; k < 3; k++) {
        mean[k] = 0;
        for (int c = 0; c < p->corners; c++)
            mean[k] += p->corner[c][k] / p->corners;
    }
    for (int c = 0; c < p->corners; c++) {
        double d[3];
        difference(p->corner[c], mean, d);
        double h = dot(d, p->normal);
        warp = fmax(warp, fabs(h));
        for (int k = 0; k < 3; k++)
            p->corner[c][k] -= h * p->normal[k];
    }
    return warp;
}

/* Divides a quadrilateral along the diagonal that lies in it; false: it crosses itself. */
static bool divide(struct panel *p)
{
    for (p->diagonal = 0; p->diagonal < p->corners - 2; p->diagonal++) {
        bool inside = true;
        for (int t = 0; t < p->corners - 2; t++) {
            int c[3];
            panel_triangle(p, t, c);
            inside = inside && triangle_area(p, c) >= 0;
        }
        if (inside)
            return true;
    }
    p->diagonal = 0;
    return p->corners == 3;
}

static void measure(struct panel *p)
{
    p->area = 0;
    memset(p->centroid, 0, sizeof p->centroid);
    for (int t = 0; t < p->corners - 2; t++) {
        int c[3];
        panel_triangle(p, t, c);
        double area = triangle_area(p, c);
        p->area += area;
        for (int k = 0; k < 3; k++)
            p->centroid[k] +=
                area * (p->corner[c[0]][k] + p->corner[c[1]][k] + p->corner[c[2]][k]) / 3;
    }
    for (int k = 0; k < 3; k++)
        p->centroid[k] /= p->area;
}

igabem_status panel_frame(size_t j, const double *corners, struct panel *p)
{
    for (int k = 0; k < 12; k++)
        if (!isfinite(corners[k]) || (k % 3 == 2 && corners[k] > 0))
            return igabem_fail(
                IGABEM_ERROR_ARGUMENT,
                "panel %zu: coordinate %d of corner %d is %g, expected finite and z <= 0", j,
                k % 3 + 1, k / 3, corners[k]);
    *p = (struct panel){0};
    for (int c = 0; c < 4; c++)
        for (int d = 0; d < c; d++)
            p->size = fmax(p->size, distance(corners + 3 * c, corners + 3 * d));
    p->corners = distinct_corners(corners, p->size, p->corner);
    if (p->corners < 3)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "panel %zu has %d different corners, expected 3 or 4", j, p->corners);
    double a[3], b[3], mean[3];
    difference(p->corner[2], p->corner[0], a);
    difference(p->corner[3 % p->corners], p->corner[1], b);
    cross(a, b, p->normal);
    double length = sqrt(dot(p->normal, p->normal));
    if (!(length > on_it * p->size * p->size))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "panel %zu has no area", j);
    for (int k = 0; k < 3; k++)
        p->normal[k] /= length;
    double warp = flatten(p, mean);
    if (warp > most_warp * p->size)
        return igabem_fail(
            IGABEM_ERROR_ARGUMENT,
            "panel %zu: corners lie %g of its size off its plane, expected at most %g", j,
            warp / p->size, most_warp);
    if (!divide(p))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "panel %zu crosses itself", j);
    measure(p);
    return IGABEM_OK;
}

/* The solid angle of triangle (a, b, c) seen from the origin, positive from the side to which its
 * normal points (van Oosterom and Strackee 1983). */
static double solid_angle(const double a[3], const double b[3], const double c[3])
{
    double n[3], ra = sqrt(dot(a, a)), rb = sqrt(dot(b, b)), rc = sqrt(dot(c, c));
    cross(b, c, n);
    double top = -dot(a, n);
    double bottom = ra * rb * rc + dot(a, b) * rc + dot(b, c) * ra + dot(c, a) * rb;
    return 2 * atan2(top, bottom);
}

/* With h the height of P over the plane, m the outward normals of the edges in the plane, d the
 * distances of the edges from P along m and L the integrals of 1/r along them (Newman 1986):
 *     I = Sum d L - h Omega,  grad I = -Sum m L - n Omega.  */
bool panel_pole(const struct panel *p, const double P[3], double pole[4])
{
    double to[4][3], up[3];
    difference(P, p->centroid, up);
    double h = dot(up, p->normal), omega = 0;
    if (fabs(h) < on_it * p->size)
        h = 0;
    for (int c = 0; c < p->corners; c++)
        difference(p->corner[c], P, to[c]);
    memset(pole, 0, 4 * sizeof *pole);
    for (int c = 0; c < p->corners; c++) {
        const double *a = to[c], *b = to[(c + 1) % p->corners];
        double e[3], m[3];
        difference(b, a, e);
        double length = sqrt(dot(e, e)), sum = sqrt(dot(a, a)) + sqrt(dot(b, b));
        if (sum - length <= on_it * length)
            return false;
        cross(e, p->normal, m);
        double L = 2 * atanh(length / sum) / length; /* m still has the length of the edge */
        pole[0] += dot(a, m) * L;
        for (int k = 0; k < 3; k++)
            pole[1 + k] -= m[k] * L;
    }
    for (int t = 0; h != 0 && t < p->corners - 2; t++) {
        int c[3];
        panel_triangle(p, t, c);
        omega += solid_angle(to[c[0]], to[c[1]], to[c[2]]);
    }
    pole[0] -= h * omega;
    for (int k = 0; k < 3; k++)
        pole[1 + k] -= p->normal[k] * omega;
    return true;
}
