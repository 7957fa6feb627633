#include "design.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* The cut at the waterline is this much finer than the simplification, so that it never matters. */
static const double CUT_SHARE = 0.1;

bool failure_set(struct failure *failure, const char *stage, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(failure->reason, sizeof failure->reason, format, args);
    va_end(args);
    failure->stage = stage;
    return false;
}

static bool move_grid(const nurbs_grid *parent, const double *displacement, nurbs_grid **moved)
{
    size_t rows = nurbs_grid_rows(parent), columns = nurbs_grid_columns(parent);
    if (nurbs_grid_create(rows, columns, nurbs_grid_points(parent), moved) != NURBS_OK)
        return false;
    double *points = nurbs_grid_edit(*moved);
    for (size_t k = 0; displacement && k < 3 * rows * columns; k++)
        points[k] += displacement[k];
    return true;
}

static bool build(const struct parent *parent, const nurbs_grid *grid, double tolerance,
                  struct design *design, struct failure *failure)
{
    double distance = tolerance * parent->length;
    if (nurbs_skin(grid, NULL, &design->full) != NURBS_OK)
        return failure_set(failure, "skin", "%s", nurbs_last_error());
    if (nurbs_surface_wetted(design->full, 0, CUT_SHARE * distance, &design->wetted) != NURBS_OK)
        return failure_set(failure, "waterline", "%s", nurbs_last_error());
    if (nurbs_surface_simplify(design->wetted, distance,
                               NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY, &design->light,
                               &design->bound) != NURBS_OK)
        return failure_set(failure, "simplify", "%s", nurbs_last_error());
    const nurbs_surface *wetted = design->wetted;
    if (nurbs_hydrostatics_compute(1, &wetted, 0, &design->hydrostatics) != NURBS_OK)
        return failure_set(failure, "hydrostatics", "%s", nurbs_last_error());
    if (!(design->hydrostatics.volume > 0))
        return failure_set(failure, "hydrostatics", "displacement is %g m^3, expected more than 0",
                           design->hydrostatics.volume);
    return true;
}

bool design_build(const struct parent *parent, const double *displacement, double tolerance,
                  struct design *design, struct failure *failure)
{
    nurbs_grid *grid;
    *design = (struct design){0};
    if (!move_grid(parent->grid, displacement, &grid))
        return failure_set(failure, "grid", "%s", nurbs_last_error());
    bool ok = build(parent, grid, tolerance, design, failure);
    nurbs_grid_free(grid);
    if (!ok)
        design_free(design);
    return ok;
}

void design_free(struct design *design)
{
    nurbs_surface_free(design->full);
    nurbs_surface_free(design->wetted);
    nurbs_surface_free(design->light);
    *design = (struct design){0};
}
