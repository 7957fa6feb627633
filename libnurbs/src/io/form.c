#include "io/form.h"

#include "core/constants.h"
#include "core/error.h"
#include "core/vector.h"

#include <nurbs/invert.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double turn = 2 * PI;

/* Lengths below this share of a form's size are none. */
static const double negligible = 1e-9;

nurbs_status form_frame(cad_form *f, const double origin[3], const double axis[3],
                        const double reference[3])
{
    memcpy(f->origin, origin, sizeof f->origin);
    memcpy(f->frame[2], axis, sizeof f->frame[2]);
    if (!(unit3(f->frame[2]) > 0))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "its axis has no direction");
    perpendicular3(f->frame[2], reference, f->frame[0]);
    cross3(f->frame[2], f->frame[0], f->frame[1]);
    return NURBS_OK;
}

static void set_limits(cad_form *f, double low, double high, double angle_period, double period)
{
    const bool round = f->kind == FORM_REVOLVED;
    f->low[0] = f->kind == FORM_EXTRUDED ? low : round ? 0 : -INFINITY;
    f->high[0] = f->kind == FORM_EXTRUDED ? high : round ? turn : INFINITY;
    f->low[1] = round ? low : -INFINITY;
    f->high[1] = round ? high : INFINITY;
    f->period[0] = angle_period;
    f->period[1] = period;
}

void form_plane(cad_form *f)
{
    f->kind = FORM_PLANE;
    set_limits(f, 0, 0, 0, 0);
}

void form_cylinder(cad_form *f, double radius)
{
    form_cone(f, radius, 0);
}

void form_cone(cad_form *f, double radius, double half_angle)
{
    f->kind = FORM_REVOLVED;
    f->profile = PROFILE_LINE;
    f->radius = radius;
    f->slope[0] = sin(half_angle);
    f->slope[1] = cos(half_angle);
    set_limits(f, f->slope[0] > 0 ? -radius / f->slope[0] : -INFINITY,
               f->slope[0] < 0 ? -radius / f->slope[0] : INFINITY, turn, 0);
}

void form_torus(cad_form *f, double major, double minor)
{
    f->kind = FORM_REVOLVED;
    f->profile = PROFILE_CIRCLE;
    f->radius = major;
    f->minor = minor;
    if (major > 0)
        set_limits(f, 0, turn, turn, turn);
    else
        set_limits(f, -turn / 4, turn / 4, turn, 0);
}

/* The largest distance between control points, for what is negligible. */
static double extent(const nurbs_curve *curve)
{
    const double *p = nurbs_curve_points(curve);
    double most = 0;
    for (size_t k = 1; k < nurbs_curve_size(curve); k++)
        most = fmax(most, distance3(p, p + 3 * k));
    return most;
}

static void curve_domain(const nurbs_curve *curve, double *low, double *high)
{
    const double *knots = nurbs_curve_knots(curve);
    *low = knots[0];
    *high = knots[nurbs_curve_size(curve)];
}

/* The period of a closed profile, else 0. */
static double closed_period(const nurbs_curve *curve)
{
    const double *p = nurbs_curve_points(curve);
    double low, high;
    curve_domain(curve, &low, &high);
    return distance3(p, p + 3 * (nurbs_curve_size(curve) - 1)) <= 1e-9 * extent(curve) ? high - low
                                                                                       : 0;
}

/* The point of the profile that is farthest from the axis gives the frame its first direction. */
static void widest(const nurbs_curve *profile, const double origin[3], const double axis[3],
                   double out[3])
{
    const double *p = nurbs_curve_points(profile);
    double most = -1;
    for (size_t k = 0; k < nurbs_curve_size(profile); k++) {
        double q[3];
        minus3(p + 3 * k, origin, q);
        along3(q, -dot3(q, axis) / dot3(axis, axis), axis, q);
        if (norm3(q) > most) {
            most = norm3(q);
            memcpy(out, q, 3 * sizeof *q);
        }
    }
}

/* A profile that is one straight line in the frame's half plane gives a cylinder or a cone, or a
 * plane across the axis. Radii grow and heights rise along the natural parameters. */
static bool straight_profile(cad_form *f, const nurbs_curve *profile)
{
    const double *p = nurbs_curve_points(profile);
    double d[3], r[2], h[2];
    if (nurbs_curve_degree(profile) != 1 || nurbs_curve_size(profile) != 2)
        return false;
    for (size_t k = 0; k < 2; k++) {
        minus3(p + 3 * k, f->origin, d);
        r[k] = dot3(d, f->frame[0]);
        h[k] = dot3(d, f->frame[2]);
    }
    double length = hypot(r[1] - r[0], h[1] - h[0]);
    if (!(length > 0))
        return false;
    if (fabs(h[1] - h[0]) < 1e-9 * length) {
        double normal[3], at[3];
        along3(f->origin, h[0], f->frame[2], at);
        for (int c = 0; c < 3; c++)
            normal[c] = r[1] > r[0] ? -f->frame[2][c] : f->frame[2][c];
        form_frame(f, at, normal, f->frame[0]);
        form_plane(f);
        return true;
    }
    f->flipped = h[1] < h[0];
    if (f->flipped)
        length = -length;
    double sine = (r[1] - r[0]) / length, cosine = (h[1] - h[0]) / length;
    form_cone(f, r[0] - h[0] * sine / cosine, atan2(sine, cosine));
    return true;
}

/* A profile on both sides of the axis would give every point of the surface twice. */
static nurbs_status check_side(const cad_form *f, const nurbs_curve *profile, double slack)
{
    enum { PLACES = 8 };
    double low, high;
    curve_domain(profile, &low, &high);
    size_t n = PLACES * nurbs_curve_size(profile);
    for (size_t k = 0; k <= n; k++) {
        double t = k == n ? high : low + (high - low) * (double)k / (double)n, p[3], q[3];
        nurbs_status status = nurbs_curve_eval(profile, 0, 1, &t, p);
        if (status != NURBS_OK)
            return status;
        minus3(p, f->origin, q);
        if (dot3(q, f->frame[0]) < -slack)
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "its generatrix crosses its axis");
    }
    return NURBS_OK;
}

nurbs_status form_revolved(cad_form *f, const double origin[3], const double axis[3],
                           nurbs_curve *profile)
{
    double wide[3], matrix[9], zero[3] = {0, 0, 0}, low, high;
    f->curve = profile;
    widest(profile, origin, axis, wide);
    nurbs_status status = form_frame(f, origin, axis, wide);
    if (status != NURBS_OK)
        return status;
    const double size = fmax(extent(profile), norm3(wide));
    const double *p = nurbs_curve_points(profile);
    for (size_t k = 0; k < nurbs_curve_size(profile); k++) {
        double q[3];
        minus3(p + 3 * k, origin, q);
        if (fabs(dot3(q, f->frame[1])) > 1e-6 * size)
            return nurbs_fail(NURBS_ERROR_GEOMETRY,
                              "its generatrix does not lie in a plane with its axis");
    }
    if (straight_profile(f, profile))
        return NURBS_OK;
    nurbs_status crosses = check_side(f, profile, 1e-6 * size);
    if (crosses != NURBS_OK)
        return crosses;
    /* Radius, 0, height as x, y, z. */
    memcpy(matrix, f->frame[0], sizeof f->frame[0]);
    memset(matrix + 3, 0, sizeof f->frame[1]);
    memcpy(matrix + 6, f->frame[2], sizeof f->frame[2]);
    zero[0] = -dot3(origin, f->frame[0]);
    zero[2] = -dot3(origin, f->frame[2]);
    f->kind = FORM_REVOLVED;
    f->profile = PROFILE_CURVE;
    f->radius = size;
    curve_domain(profile, &low, &high);
    set_limits(f, low, high, turn, closed_period(profile));
    return curve_transform(profile, matrix, zero, &f->flat);
}

nurbs_status form_extruded(cad_form *f, const double direction[3], nurbs_curve *profile)
{
    double matrix[9] = {0}, zero[3] = {0, 0, 0}, low, high;
    f->curve = profile;
    const double *p = nurbs_curve_points(profile);
    double chord[3];
    minus3(p + 3 * (nurbs_curve_size(profile) - 1), p, chord);
    nurbs_status status = form_frame(f, p, direction, chord);
    if (status != NURBS_OK)
        return status;
    for (int d = 0; d < 2; d++) {
        memcpy(matrix + 3 * d, f->frame[d], sizeof f->frame[d]);
        zero[d] = -dot3(f->origin, f->frame[d]);
    }
    if (nurbs_curve_degree(profile) == 1 && nurbs_curve_size(profile) == 2) {
        double normal[3];
        cross3(chord, direction, normal);
        status = form_frame(f, p, normal, chord);
        form_plane(f);
        return status;
    }
    f->kind = FORM_EXTRUDED;
    f->profile = PROFILE_CURVE;
    f->radius = extent(profile);
    curve_domain(profile, &low, &high);
    set_limits(f, low, high, closed_period(profile), 0);
    return curve_transform(profile, matrix, zero, &f->flat);
}

/* Whether the first and last lines of control points in a direction coincide. */
static bool closed_in(const nurbs_surface *surface, int direction)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    const double *p = nurbs_surface_points(surface);
    double apart = 0, size = 0;
    for (size_t k = 0; k < nu * nv; k++)
        size = fmax(size, distance3(p, p + 3 * k));
    for (size_t k = 0; k < (direction ? nu : nv); k++) {
        const double *first = p + 3 * (direction ? k * nv : k),
                     *last = p + 3 * (direction ? k * nv + nv - 1 : (nu - 1) * nv + k);
        apart = fmax(apart, distance3(first, last));
    }
    return apart <= 1e-9 * size;
}

nurbs_status form_spline(cad_form *f, nurbs_surface *surface)
{
    f->kind = FORM_SPLINE;
    f->surface = surface;
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(surface, d);
        f->low[d] = knots[0];
        f->high[d] = knots[nurbs_surface_size(surface, d)];
        f->period[d] = closed_in(surface, d) ? f->high[d] - f->low[d] : 0;
    }
    return nurbs_locator_create(surface, &f->locator);
}

void form_free(cad_form *f)
{
    nurbs_curve_free(f->curve);
    nurbs_curve_free(f->flat);
    nurbs_surface_free(f->surface);
    nurbs_locator_free(f->locator);
    *f = (cad_form){0};
}

nurbs_status form_move(cad_form *f, const double matrix[9], const double shift[3])
{
    double moved[3];
    nurbs_status status = NURBS_OK;
    for (int k = 0; k < 3; k++)
        moved[k] = dot3(matrix + 3 * k, f->origin) + shift[k];
    memcpy(f->origin, moved, sizeof moved);
    for (int e = 0; e < 3; e++) {
        for (int k = 0; k < 3; k++)
            moved[k] = dot3(matrix + 3 * k, f->frame[e]);
        memcpy(f->frame[e], moved, sizeof moved);
    }
    if (f->curve) {
        nurbs_curve *curve;
        status = curve_transform(f->curve, matrix, shift, &curve);
        if (status != NURBS_OK)
            return status;
        nurbs_curve_free(f->curve);
        f->curve = curve;
    }
    return status;
}

nurbs_status form_offset(cad_form *f, double distance)
{
    if (f->kind == FORM_PLANE) {
        along3(f->origin, distance, f->frame[2], f->origin);
        return NURBS_OK;
    }
    if (f->kind != FORM_REVOLVED || f->profile == PROFILE_CURVE)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "an offset of this surface is no spline surface; exact are those of "
                          "planes, cylinders, cones, spheres and tori");
    if (f->profile == PROFILE_CIRCLE) {
        if (!(f->minor + distance > 0))
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "the offset %g m is beyond the radius %g m",
                              distance, f->minor);
        form_torus(f, f->radius, f->minor + distance);
        return NURBS_OK;
    }
    /* The normal of a cone is (slope[1], -slope[0]) in radius and height. */
    double radius = f->radius + distance * f->slope[1], half = atan2(f->slope[0], f->slope[1]);
    if (f->slope[0] == 0 && !(radius > 0))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "the offset %g m is beyond the radius %g m",
                          distance, f->radius);
    along3(f->origin, -distance * f->slope[0], f->frame[2], f->origin);
    form_cone(f, radius, half);
    return NURBS_OK;
}

static nurbs_status invert_profile(const cad_form *f, const double flat[3], double *t)
{
    return nurbs_curve_closest(f->flat, 1, flat, t, NULL);
}

static nurbs_status invert_revolved(const cad_form *f, const double q[3], double ab[2],
                                    bool loose[2])
{
    double x = dot3(q, f->frame[0]), y = dot3(q, f->frame[1]), h = dot3(q, f->frame[2]),
           r = hypot(x, y), size = fmax(fmax(fabs(f->radius), f->minor), fabs(h));
    loose[0] = r <= negligible * size;
    ab[0] = atan2(y, x);
    if (ab[0] < 0)
        ab[0] += turn;
    switch (f->profile) {
    case PROFILE_LINE:
        ab[1] = (r - f->radius) * f->slope[0] + h * f->slope[1];
        return NURBS_OK;
    case PROFILE_CIRCLE:
        ab[1] = atan2(h, r - f->radius);
        if (ab[1] < f->low[1])
            ab[1] += turn;
        return NURBS_OK;
    default:
        return invert_profile(f, (const double[3]){r, 0, h}, &ab[1]);
    }
}

/* Where the surface has collapsed to a point, the parameter along that edge is loose. */
static nurbs_status invert_spline(const cad_form *f, const double p[3], double ab[2], bool loose[2])
{
    double s[9], speed[2];
    nurbs_status status = nurbs_locator_closest(f->locator, 1, p, ab, NULL);
    if (status == NURBS_OK)
        status = nurbs_surface_eval(f->surface, 1, 1, ab, s);
    if (status != NURBS_OK)
        return status;
    for (int d = 0; d < 2; d++)
        speed[d] = norm3(s + 3 + 3 * d) * (f->high[d] - f->low[d]);
    for (int d = 0; d < 2; d++)
        loose[d] = speed[d] <= 1e-7 * (speed[0] + speed[1]);
    return NURBS_OK;
}

nurbs_status form_invert(const cad_form *f, const double p[3], double ab[2], bool loose[2])
{
    double q[3];
    nurbs_status status = NURBS_OK;
    loose[0] = loose[1] = false;
    minus3(p, f->origin, q);
    switch (f->kind) {
    case FORM_PLANE:
        ab[0] = dot3(q, f->frame[0]);
        ab[1] = dot3(q, f->frame[1]);
        return NURBS_OK;
    case FORM_REVOLVED:
        return invert_revolved(f, q, ab, loose);
    case FORM_EXTRUDED: {
        const double flat[3] = {dot3(q, f->frame[0]), dot3(q, f->frame[1]), 0};
        double c[3];
        status = invert_profile(f, flat, &ab[0]);
        if (status == NURBS_OK)
            status = nurbs_curve_eval(f->curve, 0, 1, &ab[0], c);
        if (status != NURBS_OK)
            return status;
        minus3(p, c, q);
        ab[1] = dot3(q, f->frame[2]);
        return NURBS_OK;
    }
    default:
        return invert_spline(f, p, ab, loose);
    }
}

static double profile_speed(const cad_form *f, double t)
{
    double c[6] = {0}, low, high;
    curve_domain(f->curve, &low, &high);
    t = fmin(fmax(t, low), high);
    nurbs_curve_eval(f->curve, 1, 1, &t, c);
    return norm3(c + 3);
}

void form_stretch(const cad_form *f, const double ab[2], double stretch[2])
{
    double s[9] = {0}, inside[2];
    stretch[0] = stretch[1] = 1;
    switch (f->kind) {
    case FORM_PLANE:
        return;
    case FORM_REVOLVED:
        if (f->profile == PROFILE_LINE) {
            stretch[0] = fabs(f->radius + ab[1] * f->slope[0]);
        } else if (f->profile == PROFILE_CIRCLE) {
            stretch[0] = fabs(f->radius + f->minor * cos(ab[1]));
            stretch[1] = f->minor;
        } else {
            stretch[0] = f->radius;
            stretch[1] = profile_speed(f, ab[1]);
        }
        return;
    case FORM_EXTRUDED:
        stretch[0] = profile_speed(f, ab[0]);
        return;
    default:
        for (int d = 0; d < 2; d++)
            inside[d] = fmin(fmax(ab[d], f->low[d]), f->high[d]);
        nurbs_surface_eval(f->surface, 1, 1, inside, s);
        for (int d = 0; d < 2; d++)
            stretch[d] = norm3(s + 3 + 3 * d);
    }
}

static nurbs_status line_create(const double a[3], const double b[3], double low, double high,
                                nurbs_curve **curve)
{
    const double knots[4] = {low, low, high, high},
                 points[6] = {a[0], a[1], a[2], b[0], b[1], b[2]};
    return nurbs_curve_create(1, 2, knots, points, NULL, curve);
}

/* The stretch of the profile from `low` to `high` of its natural parameter. */
static nurbs_status profile_part(const cad_form *f, double low, double high, nurbs_curve **part)
{
    double a[3], b[3], from, to;
    *part = NULL;
    if (f->profile == PROFILE_LINE) {
        along3(f->origin, f->radius + low * f->slope[0], f->frame[0], a);
        along3(a, low * f->slope[1], f->frame[2], a);
        along3(f->origin, f->radius + high * f->slope[0], f->frame[0], b);
        along3(b, high * f->slope[1], f->frame[2], b);
        return line_create(a, b, low, high, part);
    }
    if (f->profile == PROFILE_CIRCLE) {
        double y[3];
        along3(f->origin, f->radius, f->frame[0], a);
        for (int k = 0; k < 3; k++) {
            b[k] = f->minor * f->frame[0][k];
            y[k] = f->minor * f->frame[2][k];
        }
        return arc_create(a, b, y, low, high, part);
    }
    curve_domain(f->curve, &from, &to);
    double slack = 1e-9 * (to - from);
    if (low < from - slack || high > to + slack)
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "its loop passes the seam of the closed surface within a face");
    if (low <= from + slack && high >= to - slack)
        return nurbs_curve_copy(f->curve, part);
    return nurbs_curve_part(f->curve, fmax(low, from), fmin(high, to), part);
}

/* Both ends of the extrusion as rows of a net that is linear in v. */
static nurbs_status extrude(const nurbs_curve *profile, const double direction[3], double low,
                            double high, nurbs_surface **surface)
{
    size_t n = nurbs_curve_size(profile);
    const double *p = nurbs_curve_points(profile), *w = nurbs_curve_weights(profile),
                 knots[4] = {low, low, high, high};
    double *points = malloc(8 * n * sizeof *points), *weights = points + 6 * n;
    *surface = NULL;
    if (!points)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu points", 2 * n);
    for (size_t k = 0; k < n; k++) {
        along3(p + 3 * k, low, direction, points + 6 * k);
        along3(p + 3 * k, high, direction, points + 6 * k + 3);
        weights[2 * k] = weights[2 * k + 1] = w ? w[k] : 1;
    }
    nurbs_status status = nurbs_surface_create((const int[]){nurbs_curve_degree(profile), 1},
                                               (const size_t[]){n, 2}, nurbs_curve_knots(profile),
                                               knots, points, w ? weights : NULL, surface);
    free(points);
    return status;
}

nurbs_status form_surface(const cad_form *f, const double low[2], const double high[2],
                          nurbs_surface **surface)
{
    nurbs_curve *part = NULL;
    nurbs_status status;
    *surface = NULL;
    for (int d = 0; d < 2; d++)
        if (!(isfinite(low[d]) && isfinite(high[d]) && high[d] > low[d]))
            return nurbs_fail(NURBS_ERROR_GEOMETRY, "nothing limits it");
    switch (f->kind) {
    case FORM_PLANE: {
        double a[3], b[3];
        along3(f->origin, low[0], f->frame[0], a);
        along3(f->origin, high[0], f->frame[0], b);
        status = line_create(a, b, low[0], high[0], &part);
        if (status == NURBS_OK)
            status = extrude(part, f->frame[1], low[1], high[1], surface);
        break;
    }
    case FORM_REVOLVED:
        status = profile_part(f, low[1], high[1], &part);
        if (status == NURBS_OK)
            status = revolve(part, f->origin, f->frame, low[0], high[0], surface);
        break;
    case FORM_EXTRUDED:
        status = profile_part(f, low[0], high[0], &part);
        if (status == NURBS_OK)
            status = extrude(part, f->frame[2], low[1], high[1], surface);
        break;
    default:
        for (int d = 0; d < 2; d++)
            if (low[d] < f->low[d] - 1e-9 * f->period[d] ||
                high[d] > f->high[d] + 1e-9 * f->period[d])
                return nurbs_fail(NURBS_ERROR_GEOMETRY,
                                  "its loop passes the seam of the closed surface within a face");
        status = nurbs_surface_copy(f->surface, surface);
    }
    nurbs_curve_free(part);
    return status;
}

void form_parameters(const cad_form *f, const double low[2], const double high[2],
                     const double ab[2], double uv[2])
{
    uv[0] = ab[0];
    uv[1] = ab[1];
    if (f->kind != FORM_REVOLVED)
        return;
    uv[0] = arc_parameter(low[0], high[0], ab[0]);
    if (f->profile == PROFILE_CIRCLE)
        uv[1] = arc_parameter(low[1], high[1], ab[1]);
}
