/**
 * @file patches.h
 * Several patches of one body, as they are stored in a file.
 */
#ifndef NURBS_PATCHES_H
#define NURBS_PATCHES_H

#include <nurbs/surface.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nurbs_patches nurbs_patches;

/** Creates an empty list. */
NURBS_API nurbs_status nurbs_patches_create(nurbs_patches **patches);
/** Frees a list and its surfaces; takes NULL. */
NURBS_API void nurbs_patches_free(nurbs_patches *patches);
/** Copies the surface. */
NURBS_API nurbs_status nurbs_patches_add(nurbs_patches *patches, const nurbs_surface *surface);
/** Number of surfaces; 0 of NULL. */
NURBS_API size_t nurbs_patches_count(const nurbs_patches *patches);
/** Borrowed. */
NURBS_API const nurbs_surface *nurbs_patches_get(const nurbs_patches *patches, size_t index);

/** Free text kept in the JSON file ("provenance"); "" if none. set copies. */
NURBS_API nurbs_status nurbs_patches_set_note(nurbs_patches *patches, const char *text);
/** The note; "" without one. Borrowed. */
NURBS_API const char *nurbs_patches_note(const nurbs_patches *patches);

/** Reference length in metres kept in the JSON file ("lpp"): between perpendiculars, or the body's;
 * 0 if unknown. */
NURBS_API nurbs_status nurbs_patches_set_length(nurbs_patches *patches, double length);
/** The reference length, m; 0 if unknown. */
NURBS_API double nurbs_patches_length(const nurbs_patches *patches);

/** Parameters at which patch `index` gives the design grid back: u[rows] and v[columns],
 * increasing, inside the domain of the patch. Kept in the JSON file ("parameters"); rows = columns
 * = 0 removes them. Copies. Hand them to nurbs_grid_sample(). */
NURBS_API nurbs_status nurbs_patches_set_parameters(nurbs_patches *patches, size_t index,
                                                    size_t rows, const double *u, size_t columns,
                                                    const double *v);
/** Number of parameters in direction 0 (rows, u) or 1 (columns, v); 0 if none are kept. *values is
 * borrowed. */
NURBS_API size_t nurbs_patches_parameters(const nurbs_patches *patches, size_t index, int direction,
                                          const double **values);

#ifdef __cplusplus
}
#endif

#endif
