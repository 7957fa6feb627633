/**
 * @file sections.h
 * Hulls of any kind as sections from deck to keel, and one surface through these: the way from many
 * trimmed patches, or from triangles, to a surface that can be analysed and optimised.
 *
 * A section is where a sheet meets the hull. Sheets are planes amidships; towards the ends they
 * bend so that the last one lies on the outline of the bow, or of the stern, seen from the side:
 * raked stems, bulbs ahead of the stem and raked transoms are followed, not cut across. An end that
 * closes in the centre plane ends in the outline itself, an open one (a transom) in its edge.
 */
#ifndef NURBS_SECTIONS_H
#define NURBS_SECTIONS_H

#include <nurbs/grid.h>
#include <nurbs/mesh.h>
#include <nurbs/patches.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Most corners that a section may keep. */
#define NURBS_SECTIONS_CORNERS 8

/** How sections are laid and fitted. */
typedef struct nurbs_sections_options {
    size_t rows;       /**< sections, 0 or 8 to 400; 0: as many as the tolerance takes */
    size_t columns;    /**< points of each, 0 or 8 to 400; 0: likewise */
    double tolerance;  /**< m: how far the surface may lie from the hull; NAN: 5e-4 of its extent */
    double kink_angle; /**< radians: sections and keel that turn by more at a point keep a corner;
                          20 degrees */
    double reserved[8]; /**< 0: room for members of later releases */
} nurbs_sections_options;

/** Fills the defaults; nothing when NULL. */
NURBS_API void nurbs_sections_options_init(nurbs_sections_options *options);

/** What was made of a hull. Zeroed, it is empty; nurbs_sections_free() frees what it holds. */
typedef struct nurbs_sections {
    nurbs_grid *grid;       /**< rows from small to large x, columns from deck to keel */
    nurbs_surface *surface; /**< nurbs_skin_light() of it, degree 3 */
    double *u, *v;          /**< parameters of rows and columns */
    size_t corners, corner[NURBS_SECTIONS_CORNERS]; /**< columns of corners: chines */
    double deviation; /**< m: the largest distance of the surface from the hull, on 3 x 2 places
                           between neighbouring points */
    double place[3];  /**< where */
    double left_out;  /**< m: greatest length of what a sheet met beside the section: fins, rudders,
                           inner faces */
    double reserved[8]; /**< 0: room for members of later releases */
} nurbs_sections;

/** Fills the sections and the surface through them of a hull of triangles, x forward, z up, one
 * side or both. Level decks are passed over: a section ends where it turns inboard. Errors:
 * NURBS_ERROR_GEOMETRY, with the place: a sheet meets the hull in pieces that do not join, no keel
 * in the centre plane; NURBS_ERROR_NUMERIC: the tolerance is not kept. */
NURBS_API nurbs_status nurbs_mesh_sections(const nurbs_mesh *mesh,
                                           const nurbs_sections_options *options,
                                           nurbs_sections *sections);

/** The same of patches, through nurbs_patches_mesh(). */
NURBS_API nurbs_status nurbs_patches_sections(const nurbs_patches *patches,
                                              const nurbs_sections_options *options,
                                              nurbs_sections *sections);
/** Frees them; takes NULL. */
NURBS_API void nurbs_sections_free(nurbs_sections *sections);

/** Creates triangles of patches, fine enough that they lie within about `tolerance` metres of the
 * surfaces (by second differences of samples), at most some 200000. */
NURBS_API nurbs_status nurbs_patches_mesh(const nurbs_patches *patches, double tolerance,
                                          nurbs_mesh **mesh);

#ifdef __cplusplus
}
#endif

#endif
