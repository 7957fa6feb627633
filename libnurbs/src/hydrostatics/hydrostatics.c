/* Volumes by the divergence theorem with F = (0, y, 0): the centre plane y = 0, the water plane and
 * a transom closed by lines along y carry no flux, so the hull alone is integrated. */
#include "core/error.h"
#include "hydrostatics/hydro_parts.h"
#include "integrals/quadrature.h"

#include <math.h>
#include <stdlib.h>

/* How a patch counts. */
typedef struct patch_role {
    int *sign;    /* turns it outwards */
    int *transom; /* it closes the stern */
} patch_role;

/* Outward sums of all patches; area and normal without the transom. */
static nurbs_status sum_patches(size_t n, const nurbs_surface *const *patches,
                                const patch_role *role, double level, size_t order,
                                patch_sums *total)
{
    *total = no_sums;
    for (size_t k = 0; k < n; k++) {
        patch_sums patch;
        nurbs_status status = patch_integrate(patches[k], level, order, &patch);
        if (status != NURBS_OK)
            return status;
        int sign = role->sign[k];
        total->area += role->transom[k] ? 0 : patch.area;
        for (int c = 0; c < 3; c++) {
            total->normal[c] += role->transom[k] ? 0 : sign * patch.normal[c];
            total->low[c] = fmin(total->low[c], patch.low[c]);
            total->high[c] = fmax(total->high[c], patch.high[c]);
        }
        total->y_ny += sign * patch.y_ny;
        total->x_y_ny += sign * patch.x_y_ny;
        total->y_y_ny += sign * patch.y_y_ny;
        total->z_y_ny += sign * patch.z_y_ny;
    }
    return NURBS_OK;
}

/* Raises the order until two of them agree, or until more points would only cost time. */
static nurbs_status sum_adaptively(size_t n, const nurbs_surface *const *patches,
                                   const patch_role *role, double level, patch_sums *total,
                                   double *error)
{
    size_t spans = 0;
    for (size_t k = 0; k < n; k++)
        spans += patch_spans(patches[k], 0) * patch_spans(patches[k], 1);
    size_t order = spans > 300 ? 3 : 6;
    for (;;) {
        patch_sums coarse;
        nurbs_status status = sum_patches(n, patches, role, level, order, &coarse);
        if (status == NURBS_OK)
            status = sum_patches(n, patches, role, level, order + 2, total);
        if (status != NURBS_OK)
            return status;
        *error = fmax(fabs(total->area - coarse.area) / total->area,
                      fabs(total->y_ny - coarse.y_ny) / fabs(total->y_ny));
        order *= 2;
        if (!(*error > 1e-12) || order > 48 || order * order * spans > 50000)
            return NURBS_OK;
    }
}

static nurbs_status check_half(const patch_sums *sums, double level)
{
    if (!(sums->high[1] > 0) || -sums->low[1] > 0.02 * sums->high[1])
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "y runs from %g to %g m: expected a half hull with y >= 0", sums->low[1],
                          sums->high[1]);
    if (sums->high[2] - level > 1e-3 * (sums->high[2] - sums->low[2]))
        return nurbs_fail(NURBS_ERROR_GEOMETRY,
                          "the surface reaches z = %g, above the level %g: cut the hull first "
                          "(nurbs_surface_wetted)",
                          sums->high[2], level);
    return NURBS_OK;
}

/* Length and breadth at the level; those of the body when it is submerged. */
static nurbs_status fill_plane(size_t n, const nurbs_surface *const *patches,
                               const waterplane *plane, nurbs_hydrostatics *result)
{
    result->waterplane_area = plane->area;
    if (plane->area > 0) {
        result->waterplane_centre = plane->moment_x / plane->area;
        result->waterplane_inertia_x = plane->inertia_xx;
        result->waterplane_inertia_y =
            plane->inertia_yy - plane->moment_x * plane->moment_x / plane->area;
    }
    if (plane->edges > 0) {
        result->beam = plane->beam;
        result->x_aft = plane->aft;
        result->x_fore = plane->fore;
        return NURBS_OK;
    }
    nurbs_status status = extreme_point(n, patches, 1, 1, &result->beam);
    result->beam *= 2;
    if (status == NURBS_OK)
        status = extreme_point(n, patches, 0, -1, &result->x_aft);
    if (status == NURBS_OK)
        status = extreme_point(n, patches, 0, 1, &result->x_fore);
    return status;
}

static nurbs_status fill_depths(size_t n, const nurbs_surface *const *patches, const int *sign,
                                double level, nurbs_hydrostatics *result)
{
    double lowest = 0, keel = 0, area;
    nurbs_status status = extreme_point(n, patches, 2, -1, &lowest);
    if (status == NURBS_OK)
        status =
            section_area(n, patches, sign, 0.5 * (result->x_aft + result->x_fore), &area, &keel);
    result->draft = level - lowest;
    result->keel_draft = isfinite(keel) ? level - keel : NAN;
    return status;
}

static nurbs_status compute(size_t n, const nurbs_surface *const *wetted, const patch_role *role,
                            double level, nurbs_hydrostatics *result)
{
    patch_sums sums;
    waterplane plane;
    nurbs_status status = sum_adaptively(n, wetted, role, level, &sums, &result->error);
    if (status == NURBS_OK)
        status = check_half(&sums, level);
    if (status == NURBS_OK)
        status = waterplane_integrate(n, wetted, role->sign, level, &plane);
    if (status != NURBS_OK)
        return status;
    if (!(sums.y_ny > 0))
        return nurbs_fail(NURBS_ERROR_GEOMETRY, "the patches enclose no volume");
    result->wetted_area = 2 * sums.area;
    result->volume = 2 * sums.y_ny;
    result->centroid[0] = sums.x_y_ny / sums.y_ny;
    result->centroid[2] = sums.z_y_ny / sums.y_ny;
    double open = 2 * fabs(sums.normal[0]);
    result->transom_area = open > 1e-9 * result->wetted_area ? open : 0;
    status = fill_plane(n, wetted, &plane, result);
    if (status == NURBS_OK)
        status = fill_depths(n, wetted, role->sign, level, result);
    if (status == NURBS_OK)
        status = section_area_largest(n, wetted, role->sign, result->x_aft, result->x_fore,
                                      &result->section_area_max, &result->section_area_max_x);
    return status;
}

nurbs_status nurbs_hydrostatics_compute(size_t n, const nurbs_surface *const *wetted, double level,
                                        nurbs_hydrostatics *result)
{
    NURBS_NEED(result && (n == 0 || wetted));
    *result = (nurbs_hydrostatics){0};
    if (n == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "no patches");
    if (!isfinite(level))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "level %g is not finite", level);
    patch_role role = {malloc(n * sizeof *role.sign), malloc(n * sizeof *role.transom)};
    nurbs_status status = role.sign && role.transom
                              ? outward_signs(n, wetted, level, role.sign)
                              : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    if (status == NURBS_OK)
        status = nurbs_transom_patches(n, wetted, level, role.transom);
    if (status == NURBS_OK)
        status = compute(n, wetted, &role, level, result);
    free(role.sign);
    free(role.transom);
    return status;
}
