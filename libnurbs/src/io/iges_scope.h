/* Which entities of an IGES file are read together: those of the file itself, or of one subfigure.
 */
#ifndef NURBS_IGES_SCOPE_H
#define NURBS_IGES_SCOPE_H

#include "io/iges.h"

#include <nurbs/patches.h>

/* What was met, for the summary. */
typedef struct iges_tally {
    size_t surfaces, trimmed, resampled; /* B-spline surfaces kept; trimmed in the file */
    size_t faces, exact, pieces; /* faces on other surfaces; exact ones; patches of the rest */
    size_t left_out, blank, instances;
} iges_tally;

/* Adds the patches of all entities k with scope[k] set. */
nurbs_status iges_read_scope(iges_file *file, const unsigned char *scope, double tolerance,
                             nurbs_patches *patches, iges_tally *tally);

const char *iges_type_name(int type);

#endif
