#include "parent.h"

#include "cli.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double greville(int degree, const double *knots, size_t i)
{
    double sum = 0;
    for (int k = 1; k <= degree; k++)
        sum += knots[i + (size_t)k];
    return sum / degree;
}

/* Moves the nearest inner parameter onto each interior knot of multiplicity >= degree. */
static void snap_to_kinks(int degree, size_t size, const double *knots, size_t n, double *out)
{
    size_t p = (size_t)degree;
    for (size_t i = p + 1; i + p <= size; i++) {
        if (knots[i] != knots[i + p - 1] || knots[i] == knots[i - 1] || knots[i] == knots[size])
            continue;
        size_t best = 1;
        for (size_t k = 1; k + 1 < n; k++)
            if (fabs(out[k] - knots[i]) < fabs(out[best] - knots[i]))
                best = k;
        out[best] = knots[i];
    }
}

bool parent_parameters(int degree, size_t size, const double *knots, size_t n, double *out)
{
    for (size_t k = 0; k < n; k++) {
        double position = (double)(size - 1) * (double)k / (double)(n - 1);
        size_t i = (size_t)position;
        if (i > size - 2)
            i = size - 2;
        double share = position - (double)i;
        out[k] = (1 - share) * greville(degree, knots, i) + share * greville(degree, knots, i + 1);
    }
    if (degree > 1)
        snap_to_kinks(degree, size, knots, n, out);
    for (size_t k = 1; k < n; k++)
        if (!(out[k] > out[k - 1]))
            return false;
    return true;
}

/* The parameters that the file keeps for its own design grid, or such as suit the knots. */
static bool choose_parameters(const struct config *config, const struct parent *parent, int axis,
                              size_t n, double *out)
{
    const double *kept;
    if (n == nurbs_patches_parameters(parent->file, 0, axis, &kept)) {
        memcpy(out, kept, n * sizeof *out);
        return true;
    }
    if (parent_parameters(nurbs_surface_degree(parent->surface, axis),
                          nurbs_surface_size(parent->surface, axis),
                          nurbs_surface_knots(parent->surface, axis), n, out))
        return true;
    return cli_fail("%s: %zu grid lines cannot be laid over its knots in direction %d",
                    config->hull, n, axis) == CLI_OK;
}

static bool sample_grid(const struct config *config, struct parent *parent)
{
    const double *kept;
    size_t n[2] = {config->sections, config->girth};
    for (int a = 0; a < 2; a++)
        if (n[a] == 0)
            n[a] = nurbs_patches_parameters(parent->file, 0, a, &kept);
    if (n[0] == 0 || n[1] == 0)
        return cli_fail("%s: grid.%s is missing, and %s keeps no design grid of its own",
                        config->path, n[0] ? "girth" : "sections", config->hull) == CLI_OK;
    double *u = malloc((n[0] + n[1]) * sizeof *u), *v = u + n[0];
    bool ok = u && choose_parameters(config, parent, 0, n[0], u) &&
              choose_parameters(config, parent, 1, n[1], v);
    if (ok && nurbs_grid_sample(parent->surface, n[0], u, n[1], v, &parent->grid) != NURBS_OK)
        ok = cli_fail("%s: %s", config->hull, nurbs_last_error()) == CLI_OK;
    free(u);
    return ok;
}

/* For a file without a length: how far the wet points reach along the ship. */
static double wet_length(const nurbs_grid *grid)
{
    const double *points = nurbs_grid_points(grid);
    size_t n = nurbs_grid_rows(grid) * nurbs_grid_columns(grid);
    double least = INFINITY, most = -INFINITY;
    for (size_t k = 0; k < n; k++) {
        if (points[3 * k + 2] <= 0) {
            least = fmin(least, points[3 * k]);
            most = fmax(most, points[3 * k]);
        }
    }
    return most - least;
}

bool parent_read(const struct config *config, struct parent *parent)
{
    *parent = (struct parent){0};
    if (nurbs_patches_read(config->hull, &parent->file) != NURBS_OK)
        return cli_fail("%s", nurbs_last_error()) == CLI_OK;
    bool ok = nurbs_patches_count(parent->file) == 1;
    if (!ok)
        cli_fail("%s: %zu patches, expected one that covers the side of the hull", config->hull,
                 nurbs_patches_count(parent->file));
    if (ok) {
        parent->surface = nurbs_patches_get(parent->file, 0);
        parent->length = nurbs_patches_length(parent->file);
        ok = sample_grid(config, parent);
    }
    if (ok && !(parent->length > 0))
        parent->length = wet_length(parent->grid);
    if (ok && !(parent->length > 0))
        ok = cli_fail("%s: the grid never crosses the waterplane z = 0", config->hull) == CLI_OK;
    if (!ok)
        parent_free(parent);
    return ok;
}

void parent_free(struct parent *parent)
{
    nurbs_grid_free(parent->grid);
    nurbs_patches_free(parent->file);
    *parent = (struct parent){0};
}
