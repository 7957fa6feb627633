/* Surfaces of IGES files that are given by their form: ruled, revolved and extruded surfaces,
 * planes and quadrics, offsets. */
#include "core/constants.h"
#include "core/error.h"
#include "core/vector.h"
#include "io/iges.h"

#include <nurbs/fit.h>
#include <nurbs/modify.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_OFFSETS = 8 };

static const double turn = 2 * PI;

static nurbs_status refuse(const iges_file *file, size_t entity, const char *what)
{
    return nurbs_fail(NURBS_ERROR_FORMAT, "%s: entity %d at D%zu: %s", file->path,
                      file->entity[entity].type, iges_number(entity), what);
}

bool iges_is_form(int type)
{
    return type == 108 || type == 118 || type == 120 || type == 122 || type == 140 || type == 190 ||
           type == 192 || type == 194 || type == 196 || type == 198;
}

/* Parameters k, k + 1, k + 2. */
static nurbs_status triple(const iges_file *file, size_t entity, size_t k, double scale,
                           double out[3])
{
    nurbs_status status = NURBS_OK;
    for (size_t c = 0; c < 3 && status == NURBS_OK; c++) {
        status = iges_real(file, entity, k + c, 0, &out[c]);
        out[c] *= scale;
    }
    return status;
}

/* A point 116 or direction 123 to which parameter k points; `missing` where it points to nothing.
 */
static nurbs_status pointed(const iges_file *file, size_t entity, size_t k, double scale,
                            const double missing[3], double out[3])
{
    long number = 0;
    size_t index;
    nurbs_status status = iges_integer(file, entity, k, 0, &number);
    memcpy(out, missing, 3 * sizeof *out);
    if (status != NURBS_OK || number == 0)
        return status;
    status = iges_pointer(file, entity, k, &index);
    if (status == NURBS_OK && file->entity[index].type != 116 && file->entity[index].type != 123)
        return refuse(file, entity, "its place or direction is no point 116 and no direction 123");
    return status == NURBS_OK ? triple(file, index, 0, scale, out) : status;
}

static nurbs_status length(const iges_file *file, size_t entity, size_t k, double *value)
{
    nurbs_status status = iges_real(file, entity, k, 0, value);
    *value *= file->metres;
    if (status == NURBS_OK && !(*value > 0))
        return refuse(file, entity, "a radius is not > 0");
    return status;
}

/* Plane 108: A x + B y + C z = D. */
static nurbs_status read_plane(const iges_file *file, size_t entity, cad_form *f)
{
    static const double x[3] = {1, 0, 0}, none[3] = {0, 0, 0};
    double normal[3], d, origin[3];
    nurbs_status status = triple(file, entity, 0, 1, normal);
    if (status == NURBS_OK)
        status = iges_real(file, entity, 3, 0, &d);
    if (status != NURBS_OK)
        return status;
    double square = dot3(normal, normal);
    if (!(square > 0))
        return refuse(file, entity, "its normal has no direction");
    along3(none, d * file->metres / square, normal, origin);
    status = form_frame(f, origin, normal, x);
    form_plane(f);
    return status;
}

/* Entities 190 to 198: a point, an axis, radii; where the reference direction stands. */
static nurbs_status read_quadric(const iges_file *file, size_t entity, cad_form *f)
{
    static const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1}, none[3] = {0, 0, 0};
    int type = file->entity[entity].type;
    double origin[3], axis[3], reference[3], radius = 0, second = 0;
    size_t at_axis = type == 196 ? 2 : 1, at_radius = type == 196 ? 1 : 2,
           at_reference = type == 190                  ? 2
                          : type == 194 || type == 198 ? 4
                                                       : 3;
    nurbs_status status = pointed(file, entity, 0, file->metres, none, origin);
    if (status == NURBS_OK)
        status = pointed(file, entity, at_axis, 1, z, axis);
    if (status == NURBS_OK)
        status = pointed(file, entity, at_reference, 1, x, reference);
    if (status == NURBS_OK && type != 190)
        status = type == 194 ? iges_real(file, entity, at_radius, 0, &radius)
                             : length(file, entity, at_radius, &radius);
    if (status == NURBS_OK && type == 194) {
        radius *= file->metres;
        status = iges_real(file, entity, 3, 0, &second);
        if (status == NURBS_OK && !(radius >= 0 && second > 0 && second < 90))
            return refuse(file, entity, "radius < 0 or semi-angle outside 0 to 90 degrees");
    }
    if (status == NURBS_OK && type == 198)
        status = length(file, entity, 3, &second);
    if (status == NURBS_OK && type == 198 && !(second < radius))
        return refuse(file, entity, "its minor radius is not smaller than the major one");
    if (status == NURBS_OK)
        status = form_frame(f, origin, axis, reference);
    if (status != NURBS_OK)
        return status;
    if (type == 190)
        form_plane(f);
    else if (type == 192)
        form_cylinder(f, radius);
    else if (type == 194)
        form_cone(f, radius, second * turn / 360);
    else
        form_torus(f, type == 198 ? radius : 0, type == 198 ? second : radius);
    return NURBS_OK;
}

/* Curve to which parameter k points, composites joined. */
static nurbs_status pointed_curve(iges_file *file, size_t entity, size_t k, nurbs_curve **curve)
{
    size_t index;
    *curve = NULL;
    nurbs_status status = iges_pointer(file, entity, k, &index);
    return status == NURBS_OK ? iges_curve_joined(file, index, curve) : status;
}

/* Surface of revolution 120: axis (a line 110), generatrix, start and end angle. */
typedef struct revolution {
    double origin[3], axis[3], range[2];
    nurbs_curve *profile;
} revolution;

static nurbs_status read_revolution(iges_file *file, size_t entity, revolution *r)
{
    nurbs_curve *line = NULL;
    *r = (revolution){.range = {0, 0}};
    nurbs_status status = pointed_curve(file, entity, 0, &line);
    if (status == NURBS_OK) {
        const double *p = nurbs_curve_points(line);
        memcpy(r->origin, p, sizeof r->origin);
        minus3(p + 3 * (nurbs_curve_size(line) - 1), p, r->axis);
        if (!(norm3(r->axis) > 0))
            status = refuse(file, entity, "its axis has no direction");
    }
    nurbs_curve_free(line);
    if (status == NURBS_OK)
        status = iges_real(file, entity, 2, 0, &r->range[0]);
    if (status == NURBS_OK)
        status = iges_real(file, entity, 3, turn, &r->range[1]);
    if (status == NURBS_OK && !(r->range[1] > r->range[0] && r->range[1] - r->range[0] < 7))
        return refuse(file, entity, "its end angle does not lie within a turn after the start");
    if (status == NURBS_OK)
        r->range[1] = fmin(r->range[1], r->range[0] + turn);
    return status == NURBS_OK ? pointed_curve(file, entity, 1, &r->profile) : status;
}

static nurbs_status whole_revolution(iges_file *file, size_t entity, nurbs_surface **surface)
{
    static const double x[3] = {1, 0, 0};
    revolution r;
    cad_form frame = {0};
    nurbs_status status = read_revolution(file, entity, &r);
    if (status == NURBS_OK)
        status = form_frame(&frame, r.origin, r.axis, x);
    if (status == NURBS_OK)
        status = revolve(r.profile, r.origin, (const double(*)[3])frame.frame, r.range[0],
                         r.range[1], surface);
    nurbs_curve_free(r.profile);
    return status;
}

/* Tabulated cylinder 122: directrix, and the end of the generator that begins where it does. */
static nurbs_status read_tabulated(iges_file *file, size_t entity, double along[3],
                                   nurbs_curve **profile)
{
    nurbs_status status = pointed_curve(file, entity, 0, profile);
    if (status == NURBS_OK)
        status = triple(file, entity, 1, file->metres, along);
    if (status != NURBS_OK)
        return status;
    minus3(along, nurbs_curve_points(*profile), along);
    return norm3(along) > 0 ? NURBS_OK : refuse(file, entity, "its generator has no length");
}

static nurbs_status whole_tabulated(iges_file *file, size_t entity, nurbs_surface **surface)
{
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    nurbs_curve *profile = NULL, *moved = NULL;
    double along[3];
    nurbs_status status = read_tabulated(file, entity, along, &profile);
    if (status == NURBS_OK)
        status = curve_transform(profile, identity, along, &moved);
    if (status == NURBS_OK)
        status = nurbs_ruled(profile, moved, surface);
    nurbs_curve_free(profile);
    nurbs_curve_free(moved);
    return status;
}

/* Ruled surface 118: two curves, direction flag. */
static nurbs_status whole_ruled(iges_file *file, size_t entity, nurbs_surface **surface)
{
    nurbs_curve *rail[2] = {NULL, NULL}, *turned;
    long backwards = 0;
    nurbs_status status = pointed_curve(file, entity, 0, &rail[0]);
    if (status == NURBS_OK)
        status = pointed_curve(file, entity, 1, &rail[1]);
    if (status == NURBS_OK)
        status = iges_integer(file, entity, 2, 0, &backwards);
    if (status == NURBS_OK && backwards == 1) {
        status = nurbs_curve_reverse(rail[1], &turned);
        if (status == NURBS_OK) {
            nurbs_curve_free(rail[1]);
            rail[1] = turned;
        }
    }
    /* Form 0 pairs equal arc lengths, form 1 equal parameters: the same for lines and arcs. */
    if (status == NURBS_OK && file->entity[entity].form == 0 &&
        (nurbs_curve_size(rail[0]) > 3 || nurbs_curve_size(rail[1]) > 3))
        iges_report(file,
                    "118 ruled surface D%zu: rules join equal parameters, the file asks for equal "
                    "arc lengths; ",
                    iges_number(entity));
    if (status == NURBS_OK)
        status = nurbs_ruled(rail[0], rail[1], surface);
    nurbs_curve_free(rail[0]);
    nurbs_curve_free(rail[1]);
    return status;
}

/* Applies the entity's own transformation to a surface. */
static nurbs_status move_whole(const iges_file *file, size_t entity, nurbs_surface **surface)
{
    double matrix[9], shift[3];
    nurbs_surface *moved = NULL;
    if (file->entity[entity].transformation == 0)
        return NURBS_OK;
    nurbs_status status = iges_transformation(file, entity, matrix, shift);
    if (status == NURBS_OK)
        status = nurbs_surface_transform(*surface, matrix, shift, &moved);
    if (status == NURBS_OK) {
        nurbs_surface_free(*surface);
        *surface = moved;
    }
    return status;
}

/* Offset 140: the form of its base, moved along the normal that is nearer to the stated direction.
 */
static nurbs_status read_offset(iges_file *file, size_t entity, int depth, cad_form *f);

static nurbs_status read_spline(iges_file *file, size_t entity, cad_form *f)
{
    nurbs_surface *surface = NULL;
    nurbs_status status = iges_whole(file, entity, &surface);
    return status == NURBS_OK ? form_spline(f, surface) : status;
}

static nurbs_status own_form(iges_file *file, size_t entity, int depth, cad_form *f)
{
    nurbs_status status;
    switch (file->entity[entity].type) {
    case 108:
        return read_plane(file, entity, f);
    case 120: {
        revolution r;
        status = read_revolution(file, entity, &r);
        if (status != NURBS_OK) {
            nurbs_curve_free(r.profile);
            return status;
        }
        return form_revolved(f, r.origin, r.axis, r.profile);
    }
    case 122: {
        double along[3];
        nurbs_curve *profile = NULL;
        status = read_tabulated(file, entity, along, &profile);
        if (status != NURBS_OK) {
            nurbs_curve_free(profile);
            return status;
        }
        return form_extruded(f, along, profile);
    }
    case 140:
        return read_offset(file, entity, depth, f);
    case 190:
    case 192:
    case 194:
    case 196:
    case 198:
        return read_quadric(file, entity, f);
    default:
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "it is no form");
    }
}

static nurbs_status form_at(iges_file *file, size_t entity, int depth, cad_form *f)
{
    double matrix[9], shift[3];
    int type = file->entity[entity].type;
    *f = (cad_form){.kind = FORM_PLANE};
    if (type == 128 || type == 118)
        return read_spline(file, entity, f);
    nurbs_status status = own_form(file, entity, depth, f);
    /* A generatrix that does not lie in a plane with its axis: a surface like any other. */
    if (status == NURBS_ERROR_GEOMETRY && (type == 120 || type == 122)) {
        form_free(f);
        return read_spline(file, entity, f);
    }
    if (status == NURBS_OK && file->entity[entity].transformation > 0) {
        status = iges_transformation(file, entity, matrix, shift);
        if (status == NURBS_OK)
            status = form_move(f, matrix, shift);
    }
    return status;
}

static nurbs_status read_offset(iges_file *file, size_t entity, int depth, cad_form *f)
{
    double wish[3], distance;
    size_t base;
    if (depth == MAX_OFFSETS)
        return refuse(file, entity, "offsets of offsets without end");
    nurbs_status status = triple(file, entity, 0, 1, wish);
    if (status == NURBS_OK)
        status = iges_real(file, entity, 3, 0, &distance);
    if (status == NURBS_OK)
        status = iges_pointer(file, entity, 4, &base);
    if (status == NURBS_OK)
        status = form_at(file, base, depth + 1, f);
    if (status != NURBS_OK)
        return status;
    /* Outwards at the start of the parameters, where the indicator stands. */
    const double *normal = f->frame[f->kind == FORM_PLANE ? 2 : 0];
    if (dot3(normal, wish) < 0)
        distance = -distance;
    return form_offset(f, distance * file->metres);
}

nurbs_status iges_form(iges_file *file, size_t entity, cad_form *f)
{
    return form_at(file, entity, 0, f);
}

/* A closed sphere or torus. */
static nurbs_status whole_form(iges_file *file, size_t entity, nurbs_surface **surface)
{
    cad_form f;
    nurbs_status status = iges_form(file, entity, &f);
    if (status == NURBS_OK)
        status = form_surface(&f, f.low, f.high, surface);
    form_free(&f);
    return status;
}

nurbs_status iges_whole(iges_file *file, size_t entity, nurbs_surface **surface)
{
    nurbs_status status;
    *surface = NULL;
    switch (file->entity[entity].type) {
    case 128:
        return iges_surface(file, entity, surface);
    case 118:
        status = whole_ruled(file, entity, surface);
        break;
    case 120:
        status = whole_revolution(file, entity, surface);
        break;
    case 122:
        status = whole_tabulated(file, entity, surface);
        break;
    default:
        return whole_form(file, entity, surface);
    }
    if (status == NURBS_OK)
        status = move_whole(file, entity, surface);
    if (status != NURBS_OK) {
        nurbs_surface_free(*surface);
        *surface = NULL;
    }
    return status;
}
