#include "core/error.h"
#include "section/cut.h"

#include <math.h>
#include <stdlib.h>

enum { PARTS = 4 };

nurbs_status cut_refuse(const cut *sections, double u, cut_kind kind)
{
    double at[2] = {u, nurbs_surface_knots(sections->hull, 1)[0]}, point[3] = {0, 0, 0};
    nurbs_surface_eval(sections->hull, 0, 1, at, point);
    return nurbs_fail(NURBS_ERROR_GEOMETRY,
                      "the section at u = %.6g (x = %.6g m) %s the level z = %g", u, point[0],
                      kind == CUT_ABOVE   ? "lies wholly above"
                      : kind == CUT_BELOW ? "lies wholly below"
                                          : "crosses more than once",
                      sections->level);
}

int cut_is_point(const cut *sections)
{
    const double *h = sections->polygon;
    double size = 0, reach = 0;
    for (size_t j = 0; j < sections->size[1]; j++)
        for (size_t c = 0; c < 3; c++) {
            size = fmax(size, fabs(h[4 * j + c] / h[4 * j + 3] - h[c] / h[3]));
            reach = fmax(reach, fabs(h[4 * j + c]));
        }
    return size <= 1e-12 * reach;
}

/* Where the profile, between a section that crosses and one that lies above, meets the level. */
static double profile_crossing(const cut *sections, double inside, double outside)
{
    for (;;) {
        double middle = 0.5 * (inside + outside);
        if (middle == inside || middle == outside)
            return inside;
        if (cut_profile(sections, middle) < 0)
            inside = middle;
        else
            outside = middle;
    }
}

/* Fills u with a few parameters per knot span, both ends included; returns their number. */
static size_t scan_parameters(const cut *sections, double *u)
{
    const double *t = sections->knots_u;
    size_t count = 0, n = sections->size[0];
    for (size_t k = (size_t)sections->degree[0]; k < n; k++)
        for (int s = 0; s < PARTS && t[k + 1] > t[k]; s++)
            u[count++] = t[k] + (t[k + 1] - t[k]) * s / PARTS;
    u[count++] = t[n];
    return count;
}

/* The end of the range next to the crossing section `inside`; `outside` is its neighbour towards
 * the end of the hull. */
static nurbs_status range_end(cut *sections, double end, double inside, double outside,
                              double *range, double *limit)
{
    double crossing;
    cut_kind kind = cut_section(sections, end, &crossing);
    *range = end;
    *limit = -1;
    if (cut_is_point(sections)) {
        kind = cut_section(sections, end + 1e-6 * (inside - end), limit);
        return kind == CUT_CROSSES ? NURBS_OK : cut_refuse(sections, end, kind);
    }
    if (inside == end)
        return NURBS_OK;
    *range = profile_crossing(sections, inside, outside);
    *limit = 1;
    return NURBS_OK;
}

nurbs_status cut_range(cut *sections, double range[2], double limit[2])
{
    double *u = malloc((PARTS * sections->size[0] + 1) * sizeof *u);
    if (!u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to scan %zu sections", sections->size[0]);
    size_t count = scan_parameters(sections, u), first = count, last = 0;
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < count && status == NURBS_OK; k++) {
        double crossing;
        cut_kind kind = cut_section(sections, u[k], &crossing);
        if ((k == 0 || k + 1 == count) && cut_is_point(sections))
            continue;
        if (kind == CUT_BELOW || kind == CUT_SEVERAL)
            status = cut_refuse(sections, u[k], kind);
        if (kind != CUT_CROSSES)
            continue;
        if (first < count && last + 1 < k)
            status = nurbs_fail(NURBS_ERROR_GEOMETRY,
                                "the hull leaves the level z = %g after u = %.6g and comes back at "
                                "u = %.6g",
                                sections->level, u[last], u[k]);
        first = first < count ? first : k;
        last = k;
    }
    if (status == NURBS_OK && first == count)
        status = nurbs_fail(NURBS_ERROR_GEOMETRY, "the hull does not cross the level z = %g",
                            sections->level);
    if (status == NURBS_OK)
        status =
            range_end(sections, u[0], u[first], u[first ? first - 1 : 0], &range[0], &limit[0]);
    if (status == NURBS_OK)
        status = range_end(sections, u[count - 1], u[last], u[last + 1 < count ? last + 1 : last],
                           &range[1], &limit[1]);
    free(u);
    return status;
}
