/* Patches turned, moved and mirrored with what belongs to them. */
#include "core/error.h"

#include <nurbs/integrals.h>
#include <nurbs/modify.h>
#include <nurbs/topology.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Parameters of the design grid of patch `index`; u runs from the other end when turned. */
static nurbs_status copy_parameters(const nurbs_patches *from, size_t index, int turned,
                                    nurbs_patches *to)
{
    const double *u, *v;
    size_t rows = nurbs_patches_parameters(from, index, 0, &u),
           columns = nurbs_patches_parameters(from, index, 1, &v),
           last = nurbs_patches_count(to) - 1;
    if (rows == 0)
        return NURBS_OK;
    if (!turned)
        return nurbs_patches_set_parameters(to, last, rows, u, columns, v);
    const nurbs_surface *surface = nurbs_patches_get(from, index);
    const double *knots = nurbs_surface_knots(surface, 0);
    double low = knots[0], high = knots[nurbs_surface_size(surface, 0)];
    double *reversed = malloc(rows * sizeof *reversed);
    if (!reversed)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", rows);
    for (size_t k = 0; k < rows; k++)
        reversed[k] = fmin(fmax(low + high - u[rows - 1 - k], low), high);
    nurbs_status status = nurbs_patches_set_parameters(to, last, rows, reversed, columns, v);
    free(reversed);
    return status;
}

static nurbs_status add_moved(const nurbs_patches *from, size_t index, const double *matrix,
                              const double *shift, int turned, nurbs_patches *to)
{
    nurbs_surface *moved = NULL, *reversed = NULL;
    nurbs_status status =
        nurbs_surface_transform(nurbs_patches_get(from, index), matrix, shift, &moved);
    if (status == NURBS_OK && turned)
        status = nurbs_surface_reverse(moved, 0, &reversed);
    if (status == NURBS_OK)
        status = nurbs_patches_add(to, turned ? reversed : moved);
    if (status == NURBS_OK)
        status = copy_parameters(from, index, turned, to);
    nurbs_surface_free(moved);
    nurbs_surface_free(reversed);
    return status;
}

static nurbs_status start_copy(const nurbs_patches *from, double scale, nurbs_patches **to)
{
    nurbs_status status = nurbs_patches_create(to);
    if (status == NURBS_OK)
        status = nurbs_patches_set_note(*to, nurbs_patches_note(from));
    if (status == NURBS_OK)
        status = nurbs_patches_set_length(*to, scale * nurbs_patches_length(from));
    return status;
}

static nurbs_status finish(nurbs_status status, nurbs_patches **result)
{
    if (status != NURBS_OK) {
        nurbs_patches_free(*result);
        *result = NULL;
    }
    return status;
}

static double determinant(const double *m)
{
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
           m[2] * (m[3] * m[7] - m[4] * m[6]);
}

nurbs_status nurbs_patches_transform(const nurbs_patches *patches, const double *matrix,
                                     const double shift[3], nurbs_patches **result)
{
    NURBS_NEED(patches && result);
    double size = matrix ? determinant(matrix) : 1;
    *result = NULL;
    if (!isfinite(size) || size == 0)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "the matrix has the determinant %g", size);
    nurbs_status status = start_copy(patches, cbrt(fabs(size)), result);
    for (size_t k = 0; k < nurbs_patches_count(patches) && status == NURBS_OK; k++)
        status = add_moved(patches, k, matrix, shift, size < 0, *result);
    return finish(status, result);
}

nurbs_status nurbs_patches_mirror(const nurbs_patches *patches, int axis, nurbs_patches **result)
{
    NURBS_NEED(patches && result);
    double matrix[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    *result = NULL;
    if (axis < 0 || axis > 2)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "axis %d, expected 0, 1 or 2", axis);
    matrix[4 * axis] = -1;
    nurbs_status status = start_copy(patches, 1, result);
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < nurbs_patches_count(patches) && status == NURBS_OK; k++)
            status = add_moved(patches, k, side ? matrix : NULL, NULL, side, *result);
    return finish(status, result);
}

/* Edges that meet in a corner at a small angle run within the tolerance for a little while. */
static int is_short(const nurbs_topology *topology, const nurbs_joint *joint)
{
    const double share = 0.05;
    const nurbs_edge *a = &topology->edge[joint->edge[0]], *b = &topology->edge[joint->edge[1]];
    return joint->length < share * fmin(a->length, b->length);
}

/* Spreads the sign of patch `seed` over all that are joined to it; `number` is that of its part. */
static nurbs_status spread(const nurbs_topology *topology, size_t seed, size_t number,
                           size_t *queue, int *sign, size_t *part)
{
    size_t head = 0, tail = 0;
    queue[tail++] = seed;
    sign[seed] = 1;
    part[seed] = number;
    while (head < tail) {
        size_t at = queue[head++];
        for (size_t j = 0; j < topology->joints; j++) {
            const nurbs_joint *joint = &topology->joint[j];
            size_t a = joint->edge[0] / 4, b = joint->edge[1] / 4;
            if ((a != at && b != at) || is_short(topology, joint))
                continue;
            size_t other = a == at ? b : a;
            int wanted = joint->consistent ? sign[at] : -sign[at];
            if (sign[other] == 0) {
                sign[other] = wanted;
                part[other] = number;
                queue[tail++] = other;
            } else if (sign[other] != wanted) {
                return nurbs_fail(NURBS_ERROR_GEOMETRY,
                                  "patches %zu and %zu meet at (%.6g, %.6g, %.6g) so that no "
                                  "orientation suits all patches joined to them",
                                  a, b, joint->at[0], joint->at[1], joint->at[2]);
            }
        }
    }
    return NURBS_OK;
}

nurbs_status nurbs_topology_orient(const nurbs_topology *topology, int *sign, size_t *part,
                                   size_t *parts)
{
    NURBS_NEED(topology && sign && part && parts);
    size_t n = topology->edges / 4, *queue = malloc((n + 1) * sizeof *queue);
    nurbs_status status = NURBS_OK;
    *parts = 0;
    if (!queue)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    memset(sign, 0, n * sizeof *sign);
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        if (sign[k] == 0)
            status = spread(topology, k, (*parts)++, queue, sign, part);
    free(queue);
    return status;
}

/* Turns every connected part outwards. */
static nurbs_status point_outwards(const nurbs_patches *patches, size_t parts, const size_t *part,
                                   int *sign)
{
    size_t n = nurbs_patches_count(patches);
    double *volume = calloc(parts + 1, sizeof *volume);
    nurbs_status status = NURBS_OK;
    if (!volume)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parts", parts);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        nurbs_moments m;
        status = nurbs_surface_moments(nurbs_patches_get(patches, k), &m, NULL);
        volume[part[k]] += sign[k] * (status == NURBS_OK ? m.volume : 0);
    }
    for (size_t k = 0; k < n && status == NURBS_OK; k++)
        sign[k] *= volume[part[k]] < 0 ? -1 : 1;
    free(volume);
    return status;
}

nurbs_status nurbs_patches_orient(const nurbs_patches *patches, double tolerance,
                                  nurbs_patches **result, size_t *turned)
{
    NURBS_NEED(patches && result);
    size_t n = nurbs_patches_count(patches), count = 0, parts = 0;
    nurbs_topology topology;
    *result = NULL;
    nurbs_status status = nurbs_patches_topology(patches, tolerance, &topology);
    if (status != NURBS_OK)
        return status;
    int *sign = malloc((n + 1) * sizeof *sign);
    size_t *part = malloc((n + 1) * sizeof *part);
    if (!sign || !part)
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu patches", n);
    if (status == NURBS_OK)
        status = nurbs_topology_orient(&topology, sign, part, &parts);
    if (status == NURBS_OK)
        status = point_outwards(patches, parts, part, sign);
    if (status == NURBS_OK)
        status = start_copy(patches, 1, result);
    for (size_t k = 0; k < n && status == NURBS_OK; k++) {
        status = add_moved(patches, k, NULL, NULL, sign[k] < 0, *result);
        count += sign[k] < 0;
    }
    if (turned)
        *turned = count;
    free(sign);
    free(part);
    nurbs_topology_free(&topology);
    return finish(status, result);
}
