/**
 * @file io.h
 * Files of patches. Reading checks everything and names file, patch, field or line at fault;
 * writing goes to a temporary file that replaces the target only when complete.
 */
#ifndef NURBS_IO_H
#define NURBS_IO_H

#include <nurbs/patches.h>

#ifdef __cplusplus
extern "C" {
#endif

/** {"format":"nurbs","version":1,"unit":"m","patches":[{"degree","size","knots","points","weights"}]},
 * optional "lpp" and "note". 17 digits: writing and reading restores every bit. */
NURBS_API nurbs_status nurbs_patches_read_json(const char *path, nurbs_patches **patches);
NURBS_API nurbs_status nurbs_patches_write_json(const nurbs_patches *patches, const char *path);

/** IGES 5.3: entities 128 (and their transformations 124) are read, lengths converted to metres;
 * report (NULL: not wanted) is filled with counts of what was read and skipped. Writes 128. */
NURBS_API nurbs_status nurbs_patches_read_iges(const char *path, nurbs_patches **patches,
                                               char *report, size_t report_size);
NURBS_API nurbs_status nurbs_patches_write_iges(const nurbs_patches *patches, const char *path);

/** For looking: triangles (binary STL) and quads (VTU, ASCII) with `parts` subdivisions a knot
 * span. */
NURBS_API nurbs_status nurbs_patches_write_stl(const nurbs_patches *patches, int parts,
                                               const char *path);
NURBS_API nurbs_status nurbs_patches_write_vtu(const nurbs_patches *patches, int parts,
                                               const char *path);

/** By extension: .json .igs .iges for reading; also .stl .vtu .csv (control points) for writing. */
NURBS_API nurbs_status nurbs_patches_read(const char *path, nurbs_patches **patches);
NURBS_API nurbs_status nurbs_patches_write(const nurbs_patches *patches, const char *path);

NURBS_API nurbs_status nurbs_surface_write_iges(const nurbs_surface *surface, const char *path);

#ifdef __cplusplus
}
#endif

#endif
