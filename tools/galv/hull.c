#include "hull.h"

#include "cli.h"
#include "hull_grid.h"

#include <nurbs/nurbs.h>

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool has_suffix(const char *path, const char *suffix)
{
    size_t length = strlen(path), tail = strlen(suffix);
    return length >= tail && strcmp(path + length - tail, suffix) == 0;
}

/* n equally spaced parameters over the domain of the patch, or those the file keeps. */
static double *choose_parameters(const nurbs_patches *patches, int axis, size_t *n)
{
    const nurbs_surface *surface = nurbs_patches_get(patches, 0);
    const double *kept = NULL;
    size_t count = *n ? *n : nurbs_patches_parameters(patches, 0, axis, &kept);
    double *out = count >= 2 ? malloc(count * sizeof *out) : NULL;
    const double *knots = nurbs_surface_knots(surface, axis);
    double first = knots[nurbs_surface_degree(surface, axis)];
    double last = knots[nurbs_surface_size(surface, axis)];
    for (size_t k = 0; out && k < count; k++)
        out[k] = *n ? first + (last - first) * (double)k / (double)(count - 1) : kept[k];
    *n = count;
    return out;
}

static bool sample(const char *path, struct hull *hull)
{
    hull->u = choose_parameters(hull->patches, 0, &hull->sections);
    hull->v = choose_parameters(hull->patches, 1, &hull->girth);
    nurbs_grid *grid = NULL;
    bool ok = false;
    if (!hull->u || !hull->v)
        cli_fail("%s: keeps no design grid of its own; give --grid SECTIONSxGIRTH", path);
    else if (nurbs_grid_sample(nurbs_patches_get(hull->patches, 0), hull->sections, hull->u,
                               hull->girth, hull->v, &grid) != NURBS_OK)
        cli_fail("%s: %s", path, nurbs_last_error());
    else
        ok = true;
    hull->npoints = hull->sections * hull->girth;
    hull->xyz = ok ? malloc(3 * hull->npoints * sizeof *hull->xyz) : NULL;
    if (ok && !hull->xyz) {
        cli_fail("out of memory");
        ok = false;
    }
    if (ok)
        memcpy(hull->xyz, nurbs_grid_points(grid), 3 * hull->npoints * sizeof *hull->xyz);
    nurbs_grid_free(grid);
    return ok;
}

bool hull_read(const char *path, size_t sections, size_t girth, struct hull *hull)
{
    *hull = (struct hull){.sections = sections, .girth = girth};
    if (!has_suffix(path, ".json"))
        return hull_grid_read(path, &hull->xyz, &hull->npoints, &hull->sections, &hull->girth);
    if (nurbs_patches_read(path, &hull->patches) != NURBS_OK) {
        cli_fail("%s", nurbs_last_error());
        return false;
    }
    bool ok = nurbs_patches_count(hull->patches) > 0 && sample(path, hull);
    if (!ok)
        hull_free(hull);
    return ok;
}

struct shape_points hull_points(const struct hull *hull)
{
    return (struct shape_points){.n = hull->npoints,
                                 .xyz = hull->xyz,
                                 .surface = nurbs_patches_get(hull->patches, 0),
                                 .rows = hull->sections,
                                 .columns = hull->girth,
                                 .u = hull->u,
                                 .v = hull->v};
}

void hull_free(struct hull *hull)
{
    free(hull->xyz);
    free(hull->u);
    free(hull->v);
    nurbs_patches_free(hull->patches);
    *hull = (struct hull){.xyz = NULL};
}

static void write_points(FILE *stream, const struct hull *hull, const double *xyz)
{
    fputs(hull->girth ? "i,j,x,y,z\n" : "x,y,z\n", stream);
    for (size_t p = 0; p < hull->npoints; p++) {
        if (hull->girth)
            fprintf(stream, "%zu,%zu,", p / hull->girth + 1, p % hull->girth + 1);
        fprintf(stream, "%.17g,%.17g,%.17g\n", xyz[3 * p], xyz[3 * p + 1], xyz[3 * p + 2]);
    }
}

bool hull_write(const char *path, const struct hull *hull, const double *xyz)
{
    if (strcmp(path, "-") == 0) {
        write_points(stdout, hull, xyz);
        return cli_printed() == CLI_OK;
    }
    struct cli_file file;
    if (cli_file_open(&file, path)) {
        write_points(file.stream, hull, xyz);
        if (cli_file_commit(&file))
            return true;
    }
    cli_fail("%s: cannot be written: %s", path, strerror(errno));
    return false;
}
