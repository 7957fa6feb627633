/**
 * @file io.h
 * Files of patches. Reading checks everything and names file, patch, field or line at fault;
 * writing goes to a temporary file that replaces the target only when complete.
 */
#ifndef NURBS_IO_H
#define NURBS_IO_H

#include <nurbs/curve.h>
#include <nurbs/patches.h>

#ifdef __cplusplus
extern "C" {
#endif

/** {"format":"nurbs","version":1,"unit":"m","patches":[{"degree","size","knots","points","weights"}]},
 * optional "lpp" and "note". 17 digits: writing and reading restores every bit. */
NURBS_API nurbs_status nurbs_patches_read_json(const char *path, nurbs_patches **patches);
/** Writes the NURBS file of docs/conventions.md. */
NURBS_API nurbs_status nurbs_patches_write_json(const nurbs_patches *patches, const char *path);

/** IGES 5.3 in metres, with transformations 124 and placed subfigures 308/408 (nested); blank
 * entities are left out. B-spline surfaces 128: unclamped knots are clamped, a stated range inside
 * the knots is cut out, equal weights are dropped: all exact. Ruled surfaces 118, surfaces of
 * revolution 120, tabulated cylinders 122, spheres 196 and tori 198 are exact rational surfaces.
 * Faces (144/142, 143/141, 510/508, and 108 with its own curve) on these, on planes 108 and 190, on
 * cylinders 192 and cones 194 and on exact offsets 140 end at their loops: exact where these run
 * along parameter lines (or are straight, on a plane), else resampled within 1e-6 of their extent.
 * Where a loop cuts a B-spline surface, the whole surface is kept and the report says so.
 * @param report  NULL: not wanted; filled with counts of all entities and what was changed or left
 *                out, with type and directory number
 * The writer writes entities 128 in metres with as many digits as restore every bit. */
NURBS_API nurbs_status nurbs_patches_read_iges(const char *path, nurbs_patches **patches,
                                               char *report, size_t report_size);
/** Writes entities 126 and 128 of IGES 5.3, in metres. */
NURBS_API nurbs_status nurbs_patches_write_iges(const nurbs_patches *patches, const char *path);

/** The same, but every B-spline surface is replaced by patches that end at the loops of its faces:
 * nurbs_surface_untrim(), or nurbs_surface_untrim_parts() where they have not four sides, with its
 * tolerance in metres (0: never), which then holds for faces on other surfaces too. The report
 * tells the deviation of each patch, and why other surfaces are kept whole. */
NURBS_API nurbs_status nurbs_patches_read_iges_untrimmed(const char *path, double tolerance,
                                                         nurbs_patches **patches, char *report,
                                                         size_t report_size);

/** STEP files (ISO 10303-21) of AP203, AP214 and AP242 in metres: the faces of solids, shells and
 * surface models where assemblies (placed relationships, mapped items) put them, with the units of
 * each representation. Surfaces: B-spline (rational, Bezier, uniform), plane, cylinder, cone,
 * sphere, torus, extrusion, revolution, and exact offsets. Normals point as the faces say: out of a
 * solid. Faces whose edges are parameter lines, and plane ones of three or four straight edges, are
 * exact; others are resampled inside their loops, holes included, within the tolerance.
 * @param tolerance  metres; 0: 1e-6 of the extent of each face
 * @param report     fills what was resampled and with what deviation, and what was left out and
 *                   why, with the number of the instance; NULL: not wanted
 * Errors name line and instance. */
NURBS_API nurbs_status nurbs_patches_read_step(const char *path, double tolerance,
                                               nurbs_patches **patches, char *report,
                                               size_t report_size);

/** Writes the patches as faces of one open shell, AP214, in metres, with as many digits as restore
 * every bit: each its own surface between its own edges; a closed patch has a seam, a collapsed
 * edge none. */
NURBS_API nurbs_status nurbs_patches_write_step(const nurbs_patches *patches, const char *path);

/** Curves of an IGES file in metres: entities 126 (B-spline), 112 (parametric spline), 106 (points
 * joined by lines), 110 (line), 100 and 104 (circular and conic arcs, exact as rational
 * quadratics), and the parts of composite curves 102 in their order. Curves that only serve another
 * entity (physically dependent) are left out.
 * @param n       fills the number of curves; 0 is no error
 * @param curves  creates an array of n curves: nurbs_curves_free() */
NURBS_API nurbs_status nurbs_curves_read_iges(const char *path, size_t *n, nurbs_curve ***curves);
/** Frees n curves and their array. */
NURBS_API void nurbs_curves_free(size_t n, nurbs_curve **curves);

/** Triangles (binary STL) and quads (VTU, ASCII) with `parts` subdivisions a knot span, 0 to 1000;
 * 0: as many, 4 at least, as keep chords within 2e-5 of the extent and make no more than 50000
 * triangles. */
NURBS_API nurbs_status nurbs_patches_write_stl(const nurbs_patches *patches, int parts,
                                               const char *path);
/** Writes parts x parts cells a knot span for ParaView. */
NURBS_API nurbs_status nurbs_patches_write_vtu(const nurbs_patches *patches, int parts,
                                               const char *path);

/** Control points of all patches: CSV with header patch,i,j,x,y,z,weight (counted from 0). */
NURBS_API nurbs_status nurbs_patches_write_points(const nurbs_patches *patches, const char *path);

/** By extension: .json .igs .iges .step .stp for reading; also .stl .vtu .csv (control points) for
 * writing. */
NURBS_API nurbs_status nurbs_patches_read(const char *path, nurbs_patches **patches);

/** The same, and tells what the reader changed, kept whole or left out.
 * @param tolerance  metres, of faces that are resampled inside their loops, as in
 *                   nurbs_patches_read_iges_untrimmed(); 0: B-spline surfaces that a loop cuts are
 *                   kept whole
 * @param report     fills sentences separated by "; ", cut at report_size; "" if there is nothing
 *                   to tell; NULL: not wanted */
NURBS_API nurbs_status nurbs_patches_read_reported(const char *path, double tolerance,
                                                   nurbs_patches **patches, char *report,
                                                   size_t report_size);
/** Writes by the extension of path. */
NURBS_API nurbs_status nurbs_patches_write(const nurbs_patches *patches, const char *path);

/** Writes one surface as IGES. */
NURBS_API nurbs_status nurbs_surface_write_iges(const nurbs_surface *surface, const char *path);

#ifdef __cplusplus
}
#endif

#endif
