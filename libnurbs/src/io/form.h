/* The surfaces that CAD files describe by their form: planes, surfaces of revolution and extrusion,
 * and B-spline surfaces, as exact NURBS over a stretch of their natural parameters. */
#ifndef NURBS_FORM_H
#define NURBS_FORM_H

#include <nurbs/curve.h>
#include <nurbs/surface.h>

#include <stdbool.h>

/* Conic arc center + cos(t) x + sin(t) y, t from a to b > a (at most a turn), in rational quadratic
 * pieces of at most a quarter turn (The NURBS Book 7.5); its knots are the angles. */
nurbs_status arc_create(const double center[3], const double x[3], const double y[3], double a,
                        double b, nurbs_curve **curve);

/* Knot parameter of an angle on arc_create's pieces from a to b: the pieces run at uneven speed. */
double arc_parameter(double a, double b, double angle);

/* The curve moved by p -> matrix p + shift, its control points alone. */
nurbs_status curve_transform(const nurbs_curve *curve, const double matrix[9],
                             const double shift[3], nurbs_curve **result);

/* A curve turned about origin + R z from angle a to b, measured in the frame x, y, z: direction u
 * is the angle (of arc_parameter), v the curve's. */
nurbs_status revolve(const nurbs_curve *profile, const double origin[3], const double (*frame)[3],
                     double a, double b, nurbs_surface **surface);

typedef enum form_kind { FORM_PLANE, FORM_REVOLVED, FORM_EXTRUDED, FORM_SPLINE } form_kind;
typedef enum form_profile { PROFILE_LINE, PROFILE_CIRCLE, PROFILE_CURVE } form_profile;

/* Natural parameters (a, b):
 * plane      along frame[0] and frame[1]
 * revolved   angle about frame[2] from frame[0]; along the profile in the half plane of radius and
 *            height: a line from (radius, 0) in direction (slope[0], slope[1]), b its length; a
 *            circle about (radius, 0) of radius `minor`, b its angle; or a curve, b its parameter
 * extruded   along the profile curve; height along frame[2]
 * spline     of the surface */
typedef struct cad_form {
    form_kind kind;
    form_profile profile;
    double origin[3], frame[3][3];
    double radius, minor, slope[2];
    nurbs_curve *curve;     /* owned: profile in space */
    nurbs_curve *flat;      /* owned: profile in the plane of projection */
    nurbs_surface *surface; /* owned: of a spline */
    struct nurbs_locator *locator;
    double low[2], high[2]; /* limits of the natural parameters; infinite where there are none */
    double period[2];       /* 0: not periodic */
    bool flipped;           /* the natural parameters turn the other way than the file's */
} cad_form;

/* z along `axis`, x near `reference`; axis and reference need no unit length. */
nurbs_status form_frame(cad_form *f, const double origin[3], const double axis[3],
                        const double reference[3]);
/* After form_frame, with radius, minor, slope filled as the kind asks. */
void form_plane(cad_form *f);
void form_cylinder(cad_form *f, double radius);
/* half_angle: between axis and generator, radius at the origin, growing along the axis. */
void form_cone(cad_form *f, double radius, double half_angle);
void form_torus(cad_form *f, double major, double minor); /* major 0: a sphere */
/* Take the curve or the surface, also when they fail. */
nurbs_status form_revolved(cad_form *f, const double origin[3], const double axis[3],
                           nurbs_curve *profile);
nurbs_status form_extruded(cad_form *f, const double direction[3], nurbs_curve *profile);
nurbs_status form_spline(cad_form *f, nurbs_surface *surface);
void form_free(cad_form *f);

/* Moves the whole form by p -> matrix p + shift of a rigid motion or mirror. */
nurbs_status form_move(cad_form *f, const double matrix[9], const double shift[3]);

/* A surface at the signed distance from a plane, cylinder, cone, sphere or torus; others are
 * refused. */
nurbs_status form_offset(cad_form *f, double distance);

/* Natural parameters of the point nearest to p; loose[d]: parameter d says nothing there (a pole).
 */
nurbs_status form_invert(const cad_form *f, const double p[3], double ab[2], bool loose[2]);

/* Metres per unit of the natural parameters about the point. */
void form_stretch(const cad_form *f, const double ab[2], double stretch[2]);

/* The exact surface over a range of natural parameters. */
nurbs_status form_surface(const cad_form *f, const double low[2], const double high[2],
                          nurbs_surface **surface);
/* Parameters of that surface. */
void form_parameters(const cad_form *f, const double low[2], const double high[2],
                     const double ab[2], double uv[2]);

#endif
