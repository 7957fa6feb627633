#include "core/error.h"

#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>

#define PER_SPAN ((size_t)3)

/* Parameters inside every non-empty span; returns their number. */
static size_t sample_spans(const nurbs_surface *surface, int direction, double *t)
{
    const double *knots = nurbs_surface_knots(surface, direction);
    size_t count = 0;
    for (size_t k = (size_t)nurbs_surface_degree(surface, direction);
         k < nurbs_surface_size(surface, direction); k++)
        for (size_t s = 0; s < PER_SPAN && knots[k + 1] > knots[k]; s++)
            t[count++] =
                knots[k] + (knots[k + 1] - knots[k]) * ((double)s + 0.5) / (double)PER_SPAN;
    return count;
}

/* Unit normals, zero where the surface is degenerate to rounding. */
static void unit_normals(size_t n, const double *triples, double *normals)
{
    for (size_t k = 0; k < n; k++) {
        const double *a = triples + 9 * k + 3, *b = triples + 9 * k + 6;
        double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
        double length = sqrt(c[0] * c[0] + c[1] * c[1] + c[2] * c[2]),
               scale = sqrt((a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) *
                            (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]));
        for (size_t d = 0; d < 3; d++)
            normals[3 * k + d] = length > 1e-9 * scale ? c[d] / length : 0;
    }
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Index of a sample whose normal turns by more than a right angle and a half against one of the
 * next samples in u, v; n[0]*n[1] if there is none. */
static size_t find_reversal(const size_t n[2], const double *normals)
{
    for (size_t i = 0; i < n[0]; i++)
        for (size_t j = 0; j < n[1]; j++) {
            const double *at = normals + 3 * (i * n[1] + j);
            if ((i + 1 < n[0] && dot(at, at + 3 * n[1]) < -0.7071067811865476) ||
                (j + 1 < n[1] && dot(at, at + 3) < -0.7071067811865476))
                return i * n[1] + j;
        }
    return n[0] * n[1];
}

nurbs_status nurbs_surface_check_fold(const nurbs_surface *surface, double uv[2])
{
    NURBS_NEED(surface);
    size_t room[2] = {PER_SPAN * nurbs_surface_size(surface, 0),
                      PER_SPAN * nurbs_surface_size(surface, 1)};
    double *u = malloc((room[0] + room[1] + 12 * room[0] * room[1]) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu samples", room[0], room[1]);
    double *v = u + room[0], *triples = v + room[1];
    const size_t n[2] = {sample_spans(surface, 0, u), sample_spans(surface, 1, v)};
    double *normals = triples + 9 * n[0] * n[1];
    nurbs_status status = nurbs_surface_eval_grid(surface, 1, n[0], u, n[1], v, triples);
    if (status == NURBS_OK) {
        unit_normals(n[0] * n[1], triples, normals);
        size_t at = find_reversal(n, normals);
        if (at < n[0] * n[1]) {
            const double *p = triples + 9 * at;
            status = nurbs_fail(NURBS_ERROR_GEOMETRY,
                                "the surface is folded at u = %.6g, v = %.6g (x = %.6g, y = %.6g, "
                                "z = %.6g m): its normal reverses",
                                u[at / n[1]], v[at % n[1]], p[0], p[1], p[2]);
            if (uv) {
                uv[0] = u[at / n[1]];
                uv[1] = v[at % n[1]];
            }
        }
    }
    free(u);
    return status;
}
