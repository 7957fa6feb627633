#include "hulls.h"

#include "check.h"

/* Divides every span of one direction in parts. */
static nurbs_surface *divide(nurbs_surface *surface, int direction, int parts)
{
    double breaks[64], knots[256];
    size_t count = 0;
    int degree = nurbs_surface_degree(surface, direction);
    size_t n = nurbs_knots_distinct(degree, nurbs_surface_size(surface, direction),
                                    nurbs_surface_knots(surface, direction), breaks, NULL);
    for (size_t s = 0; s + 1 < n; s++)
        for (int k = 1; k < parts; k++)
            knots[count++] = breaks[s] + (breaks[s + 1] - breaks[s]) * k / parts;
    if (count == 0)
        return surface;
    nurbs_surface *result = NULL;
    CU_ASSERT_EQUAL(nurbs_surface_insert(surface, direction, count, knots, &result), NURBS_OK);
    nurbs_surface_free(surface);
    return result;
}

/* At least cubic, before any knot is inserted: full smoothness. */
static nurbs_surface *elevate(nurbs_surface *surface)
{
    for (int d = 0; d < 2; d++) {
        nurbs_surface *result = NULL;
        int by = 3 - nurbs_surface_degree(surface, d);
        if (by <= 0)
            continue;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_elevate(surface, d, by, &result), NURBS_OK);
        nurbs_surface_free(surface);
        surface = result;
    }
    return surface;
}

nurbs_surface *wigley_surface(double beam, double draft, int parts_u, int parts_v)
{
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1.0, beam, draft, &surface), NURBS_OK);
    surface = divide(elevate(surface), 0, parts_u);
    return surface ? divide(surface, 1, parts_v) : NULL;
}

static igabem_hull *hull_of(nurbs_surface *surface)
{
    igabem_hull *hull = NULL;
    CU_ASSERT_PTR_NOT_NULL_FATAL(surface);
    const nurbs_surface *list[1] = {surface};
    igabem_status status = igabem_hull_create(list, 1, IGABEM_SYMMETRIC, &hull);
    if (status)
        fprintf(stderr, "hull: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    nurbs_surface_free(surface);
    return hull;
}

igabem_hull *wigley_hull(double beam, double draft, int parts_u, int parts_v)
{
    return hull_of(wigley_surface(beam, draft, parts_u, parts_v));
}

nurbs_surface *ellipsoid_surface(double length, double beam, double height, double depth,
                                 int parts_u, int parts_v)
{
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(length, beam, height, depth, &surface), NURBS_OK);
    surface = divide(elevate(surface), 0, parts_u);
    return surface ? divide(surface, 1, parts_v) : NULL;
}

igabem_hull *ellipsoid_hull(double length, double beam, double height, double depth, int parts_u,
                            int parts_v)
{
    return hull_of(ellipsoid_surface(length, beam, height, depth, parts_u, parts_v));
}

nurbs_surface *wedge_surface(double half_breadth, double draft)
{
    const int degree[2] = {1, 1};
    const size_t size[2] = {2, 2};
    const double knots[4] = {0, 0, 1, 1};
    const double points[12] = {0, half_breadth, 0, 0, 0, -draft, 1, 0, 0, 1, 0, -draft};
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, knots, knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}
