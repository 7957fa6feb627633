/* Surfaces and faces of STEP files. */
#include "core/error.h"
#include "core/vector.h"
#include "io/step.h"

#include <nurbs/modify.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 16 };

/* Directions this near to each other are the same (radians). */
static const double parallel = 1e-9;

static nurbs_status number(const step_file *file, size_t instance, const step_record *record,
                           size_t k, double scale, double *value)
{
    nurbs_status status = step_number(file, instance, step_parameter(file, record, k), value);
    *value *= scale;
    return status;
}

/* Surfaces given by a placement and up to two numbers. */
static nurbs_status elementary(const step_file *file, size_t instance, cad_form *f, bool *found)
{
    static const char *const names[] = {"PLANE",
                                        "CYLINDRICAL_SURFACE",
                                        "CONICAL_SURFACE",
                                        "SPHERICAL_SURFACE",
                                        "TOROIDAL_SURFACE",
                                        "DEGENERATE_TOROIDAL_SURFACE"};
    const step_record *record = NULL;
    size_t kind = 0, placement;
    double a = 0, b = 0, origin[3], frame[3][3];
    while (kind < 6 && !(record = step_record_of(file, instance, names[kind])))
        kind++;
    *found = record != NULL;
    if (!record)
        return NURBS_OK;
    nurbs_status status =
        step_reference(file, instance, step_parameter(file, record, 1), &placement);
    if (status == NURBS_OK)
        status = step_placement(file, placement, origin, frame);
    if (status == NURBS_OK && kind > 0)
        status = number(file, instance, record, 2, file->metres, &a);
    if (status == NURBS_OK && (kind == 2 || kind >= 4))
        status = number(file, instance, record, 3, kind == 2 ? file->radians : file->metres, &b);
    if (status == NURBS_OK && kind > 0 && !(a > 0 || (kind == 2 && a == 0)))
        status = step_refuse(file, instance, "its radius %g m is not > 0", a);
    if (status == NURBS_OK && kind == 2 && !(fabs(b) < 1.5707 && b != 0))
        status = step_refuse(file, instance, "its semi-angle %g is none", b);
    if (status == NURBS_OK && kind >= 4 && !(b > 0 && b < a))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "its torus of radii %g m and %g m meets itself", a,
                          b);
    if (status == NURBS_OK)
        status = form_frame(f, origin, frame[2], frame[0]);
    if (status != NURBS_OK)
        return status;
    if (kind == 0)
        form_plane(f);
    else if (kind == 1)
        form_cylinder(f, a);
    else if (kind == 2)
        form_cone(f, a, b);
    else
        form_torus(f, kind == 3 ? 0 : a, kind == 3 ? a : b);
    return NURBS_OK;
}

/* The placement and radius of a circle, seen through surface curves. */
static nurbs_status as_circle(const step_file *file, size_t instance, double center[3],
                              double frame[3][3], double *radius, bool *is)
{
    const step_record *record = step_record_of(file, instance, "CIRCLE");
    size_t placement;
    *is = record != NULL;
    if (!record)
        return NURBS_OK;
    nurbs_status status =
        step_reference(file, instance, step_parameter(file, record, 1), &placement);
    if (status == NURBS_OK)
        status = step_placement(file, placement, center, frame);
    return status == NURBS_OK ? number(file, instance, record, 2, file->metres, radius) : status;
}

static nurbs_status extrusion(step_file *file, size_t instance, const step_record *record,
                              cad_form *f)
{
    size_t profile, vector, direction;
    double along[3], center[3], frame[3][3], radius;
    bool circle = false;
    nurbs_curve *curve = NULL;
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 1), &profile);
    if (status == NURBS_OK)
        status = step_reference(file, instance, step_parameter(file, record, 2), &vector);
    if (status != NURBS_OK)
        return status;
    const step_record *v = step_record_of(file, vector, "VECTOR");
    if (!v)
        return step_refuse(file, vector, "expected a VECTOR");
    status = step_reference(file, vector, step_parameter(file, v, 1), &direction);
    if (status == NURBS_OK)
        status = step_direction(file, direction, along);
    if (status == NURBS_OK)
        status = as_circle(file, profile, center, frame, &radius, &circle);
    if (status == NURBS_OK && circle && fabs(fabs(dot3(along, frame[2])) - 1) < parallel) {
        f->flipped = dot3(along, frame[2]) < 0;
        status = form_frame(f, center, along, frame[0]);
        form_cylinder(f, radius);
        return status;
    }
    if (status == NURBS_OK)
        status = step_curve(file, profile, 0, &curve);
    return status == NURBS_OK ? form_extruded(f, along, curve) : status;
}

/* A circle in a plane with the axis turns into a torus, or a sphere when its centre lies on it. */
static nurbs_status turned_circle(cad_form *f, const double origin[3], const double axis[3],
                                  const double center[3], double frame[3][3], double radius,
                                  bool *is)
{
    double q[3], radial[3], foot[3], round[3];
    minus3(center, origin, q);
    along3(origin, dot3(q, axis), axis, foot);
    minus3(center, foot, radial);
    double major = norm3(radial);
    *is = fabs(dot3(frame[2], axis)) < parallel &&
          fabs(dot3(frame[2], radial)) <= 1e-7 * (major + radius);
    if (!*is)
        return NURBS_OK;
    if (major <= 1e-7 * radius) {
        cross3(axis, frame[2], radial);
        major = 0;
    } else if (major <= radius) {
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "its torus of radii %g m and %g m meets itself",
                          major, radius);
    }
    cross3(axis, radial, round);
    f->flipped = dot3(frame[2], round) > 0;
    nurbs_status status = form_frame(f, foot, axis, radial);
    form_torus(f, major, radius);
    return status;
}

static nurbs_status revolution(step_file *file, size_t instance, const step_record *record,
                               cad_form *f)
{
    size_t profile, placement;
    double origin[3], axes[3][3], center[3], frame[3][3], radius;
    bool circle = false;
    nurbs_curve *curve = NULL;
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 1), &profile);
    if (status == NURBS_OK)
        status = step_reference(file, instance, step_parameter(file, record, 2), &placement);
    if (status == NURBS_OK)
        status = step_placement(file, placement, origin, axes);
    if (status == NURBS_OK)
        status = as_circle(file, profile, center, frame, &radius, &circle);
    if (status == NURBS_OK && circle)
        status = turned_circle(f, origin, axes[2], center, frame, radius, &circle);
    if (status != NURBS_OK || circle)
        return status;
    status = step_curve(file, profile, 0, &curve);
    return status == NURBS_OK ? form_revolved(f, origin, axes[2], curve) : status;
}

/* OFFSET_SURFACE: basis, distance along its normal. */
static nurbs_status offset(step_file *file, size_t instance, const step_record *record, int depth,
                           cad_form *f)
{
    size_t basis;
    double distance;
    nurbs_status status = step_reference(file, instance, step_parameter(file, record, 1), &basis);
    if (status == NURBS_OK)
        status = number(file, instance, record, 2, file->metres, &distance);
    if (status == NURBS_OK)
        status = step_form(file, basis, depth + 1, f);
    return status == NURBS_OK ? form_offset(f, f->flipped ? -distance : distance) : status;
}

nurbs_status step_form(step_file *file, size_t instance, int depth, cad_form *f)
{
    const step_record *record;
    char name[64];
    bool found;
    *f = (cad_form){.kind = FORM_PLANE};
    if (depth > MOST_DEPTH)
        return step_refuse(file, instance, "surfaces inside each other without end");
    if (step_is_spline(file, instance, true)) {
        nurbs_surface *surface;
        nurbs_status status = step_spline_surface(file, instance, &surface);
        return status == NURBS_OK ? form_spline(f, surface) : status;
    }
    nurbs_status status = elementary(file, instance, f, &found);
    if (status != NURBS_OK || found)
        return status;
    if ((record = step_record_of(file, instance, "SURFACE_OF_LINEAR_EXTRUSION")))
        return extrusion(file, instance, record, f);
    if ((record = step_record_of(file, instance, "SURFACE_OF_REVOLUTION")))
        return revolution(file, instance, record, f);
    if ((record = step_record_of(file, instance, "OFFSET_SURFACE")))
        return offset(file, instance, record, depth, f);
    if ((record = step_record_of(file, instance, "RECTANGULAR_TRIMMED_SURFACE")) ||
        (record = step_record_of(file, instance, "CURVE_BOUNDED_SURFACE"))) {
        size_t basis;
        status = step_reference(file, instance, step_parameter(file, record, 1), &basis);
        return status == NURBS_OK ? step_form(file, basis, depth + 1, f) : status;
    }
    return nurbs_fail(NURBS_ERROR_GEOMETRY, "its surface #%zu %s is not read",
                      file->instance[instance].id, step_name(file, instance, name));
}

/* Straight edges between the points of a POLY_LOOP. */
static nurbs_status poly_loop(step_file *file, size_t loop, const step_record *record, cad_face *f)
{
    static const double knots[4] = {0, 0, 1, 1};
    const step_node *list = step_parameter(file, record, 1), *node;
    nurbs_status status = step_list(file, loop, list);
    if (status != NURBS_OK)
        return status;
    node = step_child(file, list, 0);
    for (size_t k = 0; k < list->count && status == NURBS_OK; k++) {
        double ends[6];
        nurbs_curve *edge = NULL;
        size_t index;
        const step_node *next = step_next(file, node);
        next = next ? next : step_child(file, list, 0);
        status = step_reference(file, loop, node, &index);
        if (status == NURBS_OK)
            status = step_point(file, index, ends);
        if (status == NURBS_OK)
            status = step_reference(file, loop, next, &index);
        if (status == NURBS_OK)
            status = step_point(file, index, ends + 3);
        if (status == NURBS_OK && distance3(ends, ends + 3) > 0) {
            status = nurbs_curve_create(1, 2, knots, ends, NULL, &edge);
            if (status == NURBS_OK)
                status = face_add_curve(f, edge);
        }
        node = next;
    }
    return status;
}

static nurbs_status edge_loop(step_file *file, size_t loop, const step_record *record, cad_face *f)
{
    const step_node *list = step_parameter(file, record, 1);
    nurbs_status status = step_list(file, loop, list);
    if (status != NURBS_OK)
        return status;
    for (const step_node *node = step_child(file, list, 0); node && status == NURBS_OK;
         node = step_next(file, node)) {
        size_t oriented, edge;
        nurbs_curve *curve = NULL, *turned;
        status = step_reference(file, loop, node, &oriented);
        const step_record *o =
            status == NURBS_OK ? step_record_of(file, oriented, "ORIENTED_EDGE") : NULL;
        if (status == NURBS_OK && !o)
            status = step_refuse(file, oriented, "expected an ORIENTED_EDGE");
        if (status == NURBS_OK)
            status = step_reference(file, oriented, step_parameter(file, o, 3), &edge);
        if (status == NURBS_OK)
            status = step_edge(file, edge, &curve);
        if (status == NURBS_OK && !step_flag(step_parameter(file, o, 4), true)) {
            status = nurbs_curve_reverse(curve, &turned);
            nurbs_curve_free(curve);
            curve = status == NURBS_OK ? turned : NULL;
        }
        if (status == NURBS_OK)
            status = face_add_curve(f, curve);
    }
    return status;
}

/* FACE_BOUND: loop, orientation. A VERTEX_LOOP bounds nothing. */
static nurbs_status face_bound(step_file *file, size_t bound, cad_face *f)
{
    const step_record *record = step_record_of(file, bound, "FACE_OUTER_BOUND"), *own;
    size_t loop;
    if (!record)
        record = step_record_of(file, bound, "FACE_BOUND");
    if (!record)
        return step_refuse(file, bound, "expected a FACE_BOUND");
    nurbs_status status = step_reference(file, bound, step_parameter(file, record, 1), &loop);
    if (status == NURBS_OK)
        status = face_add_loop(f);
    if (status != NURBS_OK)
        return status;
    if ((own = step_record_of(file, loop, "EDGE_LOOP")))
        status = edge_loop(file, loop, own, f);
    else if ((own = step_record_of(file, loop, "POLY_LOOP")))
        status = poly_loop(file, loop, own, f);
    else if (!step_record_of(file, loop, "VERTEX_LOOP"))
        status = step_refuse(file, loop, "expected an EDGE_LOOP, POLY_LOOP or VERTEX_LOOP");
    if (status == NURBS_OK && !step_flag(step_parameter(file, record, 2), true))
        status = face_reverse_loop(f);
    return status;
}

nurbs_status step_face(step_file *file, size_t instance, cad_face *f)
{
    const step_record *record = step_record_of(file, instance, "ADVANCED_FACE");
    size_t surface;
    *f = (cad_face){.reversed = false};
    if (!record)
        record = step_record_of(file, instance, "FACE_SURFACE");
    if (!record)
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "it is no ADVANCED_FACE or FACE_SURFACE");
    const step_node *bounds = step_parameter(file, record, 1);
    nurbs_status status = step_list(file, instance, bounds);
    if (status == NURBS_OK)
        status = step_reference(file, instance, step_parameter(file, record, 2), &surface);
    if (status == NURBS_OK)
        status = step_form(file, surface, 0, &f->form);
    f->reversed = !step_flag(step_parameter(file, record, 3), true) != f->form.flipped;
    for (const step_node *node = status == NURBS_OK ? step_child(file, bounds, 0) : NULL;
         node && status == NURBS_OK; node = step_next(file, node)) {
        size_t bound;
        status = step_reference(file, instance, node, &bound);
        if (status == NURBS_OK)
            status = face_bound(file, bound, f);
    }
    return status;
}
