/* Points near patches put onto them: triangles are only the way to find sections. */
#include "core/error.h"
#include "core/vector.h"
#include "lines/lines.h"

#include <nurbs/invert.h>

#include <math.h>
#include <stdlib.h>

struct projector {
    size_t n;
    const nurbs_patches *patches;
    nurbs_locator **locator;
    double (*box)[6]; /* of the control points */
};

nurbs_status projector_create(const nurbs_patches *patches, projector **result)
{
    projector *p = calloc(1, sizeof *p);
    *result = NULL;
    if (!p)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for locators");
    p->n = nurbs_patches_count(patches);
    p->patches = patches;
    p->locator = calloc(p->n + 1, sizeof(nurbs_locator *));
    p->box = malloc((p->n + 1) * sizeof *p->box);
    nurbs_status status = p->locator && p->box
                              ? NURBS_OK
                              : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu locators", p->n);
    for (size_t k = 0; k < p->n && !status; k++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, k);
        const double *q = nurbs_surface_points(surface);
        status = nurbs_locator_create(surface, &p->locator[k]);
        for (size_t c = 0; c < 3; c++) {
            p->box[k][c] = INFINITY;
            p->box[k][3 + c] = -INFINITY;
        }
        for (size_t i = 0; i < 3 * nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
             i++) {
            p->box[k][i % 3] = fmin(p->box[k][i % 3], q[i]);
            p->box[k][3 + i % 3] = fmax(p->box[k][3 + i % 3], q[i]);
        }
    }
    if (status) {
        projector_free(p);
        return status;
    }
    *result = p;
    return NURBS_OK;
}

void projector_free(projector *p)
{
    for (size_t k = 0; p && p->locator && k < p->n; k++)
        nurbs_locator_free(p->locator[k]);
    if (p) {
        free(p->locator);
        free(p->box);
    }
    free(p);
}

static double box_distance(const double box[6], const double p[3])
{
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = fmax(fmax(box[c] - p[c], p[c] - box[3 + c]), 0);
    return norm3(d);
}

nurbs_status projector_put(const projector *p, double reach, double point[3])
{
    double nearest = reach, found[3] = {point[0], point[1], point[2]};
    for (size_t k = 0; k < p->n; k++) {
        double uv[2], away;
        if (box_distance(p->box[k], point) > nearest)
            continue;
        nurbs_status status = nurbs_locator_closest(p->locator[k], 1, point, uv, &away);
        if (!status && away < nearest) {
            nearest = away;
            status = nurbs_surface_eval(nurbs_patches_get(p->patches, k), 0, 1, uv, found);
        }
        if (status)
            return status;
    }
    for (int c = 0; c < 3; c++)
        point[c] = found[c];
    return NURBS_OK;
}
