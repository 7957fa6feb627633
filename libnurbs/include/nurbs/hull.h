/**
 * @file hull.h
 * A hull from a file to what a solver or an optimiser takes: placed, cut at the still water, made
 * light within a certified bound, checked, with its hydrostatics; and the same hull after points of
 * its design grid have moved.
 *
 * Axes of the result: x forward, y to port, z up, z = 0 the still water. Everything that was done
 * to the file's surfaces is told in sentences: nurbs_hull_step().
 *
 * Files hold more than hulls. Left out are faces in the centre plane, level ones in the water or
 * above it, and flat ones across the stern in the aft 5 % (a transom is an opening). A starboard
 * half is mirrored; of surfaces that run across the centre plane the port half is taken where a
 * parameter line lies in it; a body open at large x only is turned round. Edges within 1e-6 of the
 * extent of the water and within 1e-5 of it of the centre plane are put there; a half that
 * overshoots the centre plane is lifted, by at most 1e-3 of the extent, and then its edges as near
 * that plane as the lift moved points are put there too. Parameter lines may run in any direction,
 * normals may point either way.
 */
#ifndef NURBS_HULL_H
#define NURBS_HULL_H

#include <nurbs/grid.h>
#include <nurbs/integrals.h>
#include <nurbs/patches.h>

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nurbs_hull nurbs_hull;

/** How a hull is placed, cut and lightened. */
typedef struct nurbs_hull_options {
    double level;  /**< z of the still water in the file's axes, m; 0 */
    double draft;  /**< keel draft amidships that sets the level instead, m; NAN: not given */
    double length; /**< reference length, m; NAN: the file's, else the waterline's */
    double
        cut; /**< how far a cut surface may lie from the file's, m; NAN: 1e-5 of the extent in x */
    double
        simplify;    /**< tolerance of knot removal, over the extent in x (a rebuilt hull: over the
                          reference length); 0: none; NAN: 1e-4 for surfaces that are cut, else none */
    double sinkage;  /**< m, positive down; 0 */
    double trim;     /**< radians, positive bow up, about x = pivot in the still water; 0 */
    double pivot;    /**< m; 0 */
    bool unbounded;  /**< no water surface: the body is moved below z = 0 and not cut; false */
    bool single;     /**< several patches are made one surface through their sections
                          (nurbs_patches_sections()), with its design grid; false */
    double sections; /**< tolerance of that, and of the surface through a mesh, m; 0 or NAN: 5e-4,
                          of a mesh 6e-4 of the extent in x */
    double reserved[7]; /**< 0: room for members of later releases */
} nurbs_hull_options;

/** Fills the defaults; nothing when NULL. */
NURBS_API void nurbs_hull_options_init(nurbs_hull_options *options);

/** Reads a hull: any file that nurbs_patches_read() takes; .stl and .obj, in metres, through
 * nurbs_mesh_sections(); .offsets.csv, .stations and grids .csv, skinned. options NULL: defaults.
 * Errors: those of the reader; NURBS_ERROR_GEOMETRY, with file, patch and place: nothing below the
 * still water, a section that crosses it more than once, an opening below the water elsewhere than
 * at the stern, patches that lie on each other or share an edge by three, sides that are no mirror
 * images, patches that enclose no volume; NURBS_ERROR_NUMERIC: options.cut cannot be kept. */
NURBS_API nurbs_status nurbs_hull_read(const char *path, const nurbs_hull_options *options,
                                       nurbs_hull **hull);

/** The same from surfaces; copies them, with their length and design grid. */
NURBS_API nurbs_status nurbs_hull_create(const nurbs_patches *patches,
                                         const nurbs_hull_options *options, nurbs_hull **hull);
/** The same from n surfaces that belong to no file; copies them. */
NURBS_API nurbs_status nurbs_hull_create_surfaces(size_t n, const nurbs_surface *const *surfaces,
                                                  const nurbs_hull_options *options,
                                                  nurbs_hull **hull);
/** Frees a hull; takes NULL. */
NURBS_API void nurbs_hull_free(nurbs_hull *hull);

/** Creates the design grid of a hull of one patch: points on it that a shape family may move, the
 * sections in u. rows, columns: as many as the file keeps for its own design grid give that grid
 * back; any other number gives parameters spaced like the Greville abscissae, so that they crowd
 * where the surface has detail, with one on every kink. 0: as many as the file keeps, or, if it
 * keeps none, as the patch has control points.
 * Errors: NURBS_ERROR_GEOMETRY: several patches, or that many lines cannot be laid over the knots.
 */
NURBS_API nurbs_status nurbs_hull_design_grid(const nurbs_hull *hull, size_t rows, size_t columns,
                                              nurbs_grid **grid);

/** The same of one of several patches, of a hull or not. Errors: NURBS_ERROR_ARGUMENT: no such
 * patch. */
NURBS_API nurbs_status nurbs_patches_design_grid(const nurbs_patches *patches, size_t index,
                                                 size_t rows, size_t columns, nurbs_grid **grid);

/** Fills the n parameters of the lines of that grid: of its n rows, along axis 0 (u), or of its n
 * columns, along axis 1 (v). They increase. Errors: NURBS_ERROR_ARGUMENT: no such patch or axis, n
 * below 2; NURBS_ERROR_GEOMETRY: that many lines cannot be laid over the knots. */
NURBS_API nurbs_status nurbs_patches_design_parameters(const nurbs_patches *patches, size_t index,
                                                       int axis, size_t n, double *parameters);

/** Creates the hull through the points of a grid: skinned (nurbs_skin() with its defaults), cut at
 * z = 0 within a tenth of the tolerance, and lightened by knot removal within the tolerance, edges
 * kept: 1e-4 of the parent's length or what the parent's options.simplify says. Length and options
 * are the parent's.
 * @param grid  the moved design grid, z = 0 the still water
 * Errors: the sentence begins with the stage that failed: "skin: ", "waterline: ", "simplify: ",
 * "hydrostatics: ". */
NURBS_API nurbs_status nurbs_hull_rebuild(const nurbs_hull *parent, const nurbs_grid *grid,
                                          nurbs_hull **hull);

/** Gives the hulls that are rebuilt from this parent one spline space, so that they depend smoothly
 * on the points of the grid: the parameters of the parent's grid, the knots of a removal at 0.3
 * of the tolerance, and those that the n designs (extremes of the family; those that cannot be
 * built are passed over) need to be held within it. A design outside of what the space holds takes
 * knots of its own as without a shared space, which nurbs_hull_step() tells.
 * @param grid  the parent's own design grid: nurbs_hull_design_grid() */
NURBS_API nurbs_status nurbs_hull_share_space(nurbs_hull *parent, const nurbs_grid *grid, size_t n,
                                              const nurbs_grid *const *designs);
/** Whether a rebuilt hull lies in the shared space. */
NURBS_API bool nurbs_hull_shares_space(const nurbs_hull *hull);

/** Moves of the control points of the light surfaces of a rebuilt hull on the way to another one of
 * the same parent: fills move[points][3], m, patch by patch, u slow and v fast; divided by the step
 * of a parameter between the two, what igabem_tangent_create() takes. In a shared space it is the
 * difference of their control points, else that of the wetted surfaces at equal parameters, fitted
 * on the knots of `hull`.
 * Surfaces that are cut at the water hold this to the tolerance of the cut, whose knots may be
 * others on the two hulls. Errors: NURBS_ERROR_ARGUMENT: different numbers of patches;
 * NURBS_ERROR_GEOMETRY: rational ones. */
NURBS_API nurbs_status nurbs_hull_moves(const nurbs_hull *hull, const nurbs_hull *moved,
                                        double *move);

/** Reads the patches of a hull's file, faces that loops cut out of B-spline surfaces resampled; one
 * surface of a file that holds none, as nurbs_hull_read().
 * @param tolerance  of that, m; NAN: 1e-5 of the extent in x
 * @param report     as in nurbs_patches_read_reported() */
NURBS_API nurbs_status nurbs_hull_read_patches(const char *path, double tolerance,
                                               nurbs_patches **patches, char *report,
                                               size_t report_size);

/** Creates the patches with all edges put into y = 0 whose control points lie within `tolerance`
 * metres of it. edges, moved: fill how many, and by how much at most; NULL allowed. */
NURBS_API nurbs_status nurbs_patches_snap(const nurbs_patches *patches, double tolerance,
                                          nurbs_patches **result, size_t *edges, double *moved);

/** Surfaces, borrowed. Full: as they were read and placed, above and below the water. Wetted: the
 * part below. Light: the same with redundant knots removed, what a solver takes. Of a rebuilt hull
 * the full surface is the skinned one. */
NURBS_API const nurbs_patches *nurbs_hull_full(const nurbs_hull *hull);
/** What of it lies below the still water, cut there. Borrowed; NULL of NULL. */
NURBS_API const nurbs_patches *nurbs_hull_wetted(const nurbs_hull *hull);
/** The same with fewer control points, as the solver takes it. Borrowed; NULL of NULL. */
NURBS_API const nurbs_patches *nurbs_hull_light(const nurbs_hull *hull);

/** Proven bound of the distance of light from wetted, m; 0 if nothing was simplified. */
NURBS_API double nurbs_hull_bound(const nurbs_hull *hull);
/** Largest distance of the wetted surfaces from the full ones, m, measured after the last step on 7
 * places a span and direction; 0 if nothing was cut. At most options.cut. */
NURBS_API double nurbs_hull_deviation(const nurbs_hull *hull);
/** z of the still water in the axes of the file, m. */
NURBS_API double nurbs_hull_level(const nurbs_hull *hull);
/** Reference length, m: the option's, the file's, that of the waterline, or of the body. */
NURBS_API double nurbs_hull_length(const nurbs_hull *hull);
/** Length between perpendiculars that the file keeps, m; 0: none. */
NURBS_API double nurbs_hull_lpp(const nurbs_hull *hull);
/** Whether the surfaces cover y >= 0 only and the other side is their mirror image. */
NURBS_API bool nurbs_hull_is_half(const nurbs_hull *hull);
/** Whether some surface crossed the still water and was cut. */
NURBS_API bool nurbs_hull_is_cut(const nurbs_hull *hull);
/** Whether the hull has a waterline; false: submerged, or without a water surface. */
NURBS_API bool nurbs_hull_has_waterline(const nurbs_hull *hull);

/** Of the wetted surfaces of both sides, z = 0 the still water. Borrowed. */
NURBS_API const nurbs_hydrostatics *nurbs_hull_hydrostatics(const nurbs_hull *hull);

/** Sentences: 0 says how the water divides the hull and what simplification left; each further one
 * is something that was done to the file's surfaces. Borrowed; NULL from the first number on that
 * has none. */
NURBS_API const char *nurbs_hull_step(const nurbs_hull *hull, size_t number);

/** Writes the full surfaces with note (NULL: none), length and design grid, by extension. */
NURBS_API nurbs_status nurbs_hull_write(const nurbs_hull *hull, const char *note, const char *path);

#ifdef __cplusplus
}
#endif

#endif
