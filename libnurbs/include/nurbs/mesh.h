/**
 * @file mesh.h
 * Bodies as triangles, from STL and OBJ files: hydrostatics and plane sections, exact for the
 * triangles.
 */
#ifndef NURBS_MESH_H
#define NURBS_MESH_H

#include <nurbs/integrals.h>
#include <nurbs/section.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nurbs_mesh nurbs_mesh;

/** Creates a mesh; copies. Vertices nearer than 1e-6 of the extent become one, triangles that
 * collapse are dropped, neighbours are turned alike, and every connected piece that encloses a
 * negative volume is turned outwards.
 * @param vertices  number of x,y,z triples in points
 * @param corner    3 indices a triangle, from 0
 * Errors: an index out of range, NaN or Inf, nothing left; NURBS_ERROR_GEOMETRY: neighbours that
 * cannot be turned alike (a Moebius strip), with the place. */
NURBS_API nurbs_status nurbs_mesh_create(size_t vertices, const double *points, size_t triangles,
                                         const size_t *corner, nurbs_mesh **mesh);
/** Takes NULL. */
NURBS_API void nurbs_mesh_free(nurbs_mesh *mesh);

/** Reads .stl (ASCII or binary) or .obj (v and f lines; polygons are divided from their first
 * corner). Neither format knows a unit.
 * @param unit  metres per unit of the file, > 0
 * Errors name the line, or the byte of a binary file. */
NURBS_API nurbs_status nurbs_mesh_read(const char *path, double unit, nurbs_mesh **mesh);

/** Number of vertices; 0 of NULL. */
NURBS_API size_t nurbs_mesh_vertices(const nurbs_mesh *mesh);
/** Number of triangles; 0 of NULL. */
NURBS_API size_t nurbs_mesh_triangles(const nurbs_mesh *mesh);
/** Borrowed: x,y,z triples, and 3 indices a triangle, counterclockwise seen from outside. */
NURBS_API const double *nurbs_mesh_points(const nurbs_mesh *mesh);
/** Numbers of their vertices, three each. Borrowed; NULL of NULL. */
NURBS_API const size_t *nurbs_mesh_corners(const nurbs_mesh *mesh);

/** Hydrostatics below z = level, the triangles cut exactly there. A mesh on one side of y = 0 is a
 * half body and counts twice; its triangles in y = 0 are no hull, nor are those in the plane of the
 * water. It may be open above the level, in y = 0, and in the aft 5 % of its length (an open
 * transom, taken as standing upright); triangles across x there that reach the level close a
 * transom and are no wetted area either.
 * Filled are all fields; keel_draft from the section amidships, section_area_max of 41 sections,
 * error 0.
 * Errors: NURBS_ERROR_GEOMETRY: nothing below the level, or an opening elsewhere, with its place.
 */
NURBS_API nurbs_status nurbs_mesh_hydrostatics(const nurbs_mesh *mesh, double level,
                                               nurbs_hydrostatics *result);

/** What in the sizes and the hydrostatics of a mesh is unlikely of a ship, with the call of `nurbs
 * clean` that would mend it: more than 600 m or less than 0.02 m long, higher or wider than long, a
 * bow at small x. "" if nothing is. Surfaces are told the same by nurbs_hull_step().
 * @param level     as for the hydrostatics
 * @param size      of the sentence, in bytes; 220 hold all of them */
NURBS_API nurbs_status nurbs_mesh_doubt(const nurbs_mesh *mesh, double level,
                                        const nurbs_hydrostatics *hydrostatics, size_t size,
                                        char *sentence);

/** Fills the lines where normal . p = offset, points in order along each, uv NULL; a closed line
 * repeats its first point. Where edges of triangles lie in the plane, they are taken as lying on
 * its positive side. nurbs_contour_free() frees. */
NURBS_API nurbs_status nurbs_mesh_section(const nurbs_mesh *mesh, const double normal[3],
                                          double offset, nurbs_contour *contour);

#ifdef __cplusplus
}
#endif

#endif
