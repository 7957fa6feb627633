#include "core/error.h"

#include <nurbs/io.h>

#include <ctype.h>
#include <string.h>

/* Whether the path ends in `extension` (lower case, with its dot), in capitals or not. */
static int has_extension(const char *path, const char *extension)
{
    size_t length = strlen(path), n = strlen(extension);
    if (length <= n)
        return 0;
    for (size_t k = 0; k < n; k++)
        if (tolower((unsigned char)path[length - n + k]) != extension[k])
            return 0;
    return 1;
}

nurbs_status nurbs_patches_read_reported(const char *path, double tolerance,
                                         nurbs_patches **patches, char *report, size_t report_size)
{
    NURBS_NEED(path && patches);
    *patches = NULL;
    if (report && report_size)
        report[0] = '\0';
    if (has_extension(path, ".json"))
        return nurbs_patches_read_json(path, patches);
    if (has_extension(path, ".igs") || has_extension(path, ".iges"))
        return nurbs_patches_read_iges_untrimmed(path, tolerance, patches, report, report_size);
    if (has_extension(path, ".step") || has_extension(path, ".stp"))
        return nurbs_patches_read_step(path, tolerance, patches, report, report_size);
    return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s: read are .json, .igs, .iges, .step and .stp",
                      path);
}

nurbs_status nurbs_patches_read(const char *path, nurbs_patches **patches)
{
    NURBS_NEED(path && patches);
    return nurbs_patches_read_reported(path, 0, patches, NULL, 0);
}

nurbs_status nurbs_patches_write(const nurbs_patches *patches, const char *path)
{
    NURBS_NEED(patches && path);
    if (has_extension(path, ".json"))
        return nurbs_patches_write_json(patches, path);
    if (has_extension(path, ".igs") || has_extension(path, ".iges"))
        return nurbs_patches_write_iges(patches, path);
    if (has_extension(path, ".step") || has_extension(path, ".stp"))
        return nurbs_patches_write_step(patches, path);
    if (has_extension(path, ".stl"))
        return nurbs_patches_write_stl(patches, 0, path);
    if (has_extension(path, ".vtu"))
        return nurbs_patches_write_vtu(patches, 0, path);
    if (has_extension(path, ".csv"))
        return nurbs_patches_write_points(patches, path);
    return nurbs_fail(NURBS_ERROR_ARGUMENT,
                      "%s: written are .json, .igs, .iges, .step, .stp, .stl, .vtu and "
                      ".csv",
                      path);
}
