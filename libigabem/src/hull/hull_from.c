/* From the hull that libnurbs makes to the solver's. */
#include "core/error.h"

#include <igabem/hull.h>

#include <stdlib.h>

igabem_status igabem_hull_from(const nurbs_hull *source, igabem_hull **hull)
{
    if (!source || !hull)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "a hull and a place for it must be given");
    *hull = NULL;
    const nurbs_patches *light = nurbs_hull_light(source);
    size_t n = nurbs_patches_count(light);
    const nurbs_surface **patches = malloc(n * sizeof *patches);
    if (!patches)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a hull of %zu patches", n);
    for (size_t k = 0; k < n; k++)
        patches[k] = nurbs_patches_get(light, k);
    unsigned flags = nurbs_hull_is_half(source) ? IGABEM_SYMMETRIC : 0;
    igabem_status status = igabem_hull_create(patches, n, flags, hull);
    free(patches);
    if (!status)
        status = igabem_hull_set_length(*hull, nurbs_hull_length(source));
    if (status) {
        igabem_hull_free(*hull);
        *hull = NULL;
    }
    return status;
}
