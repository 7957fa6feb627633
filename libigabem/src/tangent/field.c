#include "tangent/field.h"

#include "core/error.h"
#include "core/vector_math.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Moves below this share of the largest count as none, distances below this share of the hull's
 * extent as rounding. */
static const double rounding = 1e-9;

static const char axis_names[] = "xyz";

static size_t patch_points(const nurbs_surface *surface)
{
    return nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
}

size_t field_points(const igabem_hull *hull)
{
    size_t points = 0;
    for (size_t p = 0; p < hull->n; p++)
        points += patch_points(hull->patches[p].surface);
    return points;
}

/* Control point k of an edge: its index in the net; *count is their number. */
static size_t edge_point(const nurbs_surface *surface, int edge, size_t k, size_t *count)
{
    size_t nu = nurbs_surface_size(surface, 0), nv = nurbs_surface_size(surface, 1);
    *count = edge < HULL_V0 ? nv : nu;
    switch (edge) {
    case HULL_U0:
        return k;
    case HULL_U1:
        return (nu - 1) * nv + k;
    case HULL_V0:
        return k * nv;
    default:
        return k * nv + nv - 1;
    }
}

/* Whether a point of an edge cannot leave the centre plane. */
static bool is_held(const igabem_hull *hull, const struct hull_patch *patch, int edge, size_t at)
{
    enum hull_edge kind = patch->edge[edge];
    double y = nurbs_surface_points(patch->surface)[3 * at + 1];
    return kind == HULL_EDGE_CENTRE ||
           (kind == HULL_EDGE_COLLAPSED && fabs(y) <= rounding * hull->extent);
}

void field_hold(const igabem_hull *hull, double *value)
{
    for (size_t p = 0; p < hull->n; p++) {
        const struct hull_patch *patch = &hull->patches[p];
        for (int e = 0; e < HULL_EDGES; e++)
            for (size_t k = 0, count = 1; k < count; k++) {
                size_t at = edge_point(patch->surface, e, k, &count);
                if (is_held(hull, patch, e, at))
                    value[at] = 0.0;
            }
        value += patch_points(patch->surface);
    }
}

static igabem_status check_edge(const igabem_hull *hull, size_t p, int edge, double largest,
                                const double *move)
{
    const struct hull_patch *patch = &hull->patches[p];
    enum hull_edge kind = patch->edge[edge];
    size_t first = edge_point(patch->surface, edge, 0, &(size_t){0}), count = 1;
    for (size_t k = 0; k < count; k++) {
        size_t at = edge_point(patch->surface, edge, k, &count);
        double y = move[3 * at + 1];
        if (is_held(hull, patch, edge, at) && fabs(y) > rounding * largest)
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "patch %zu: control point %zu lies in the centre plane and moves by "
                               "%g m along y, expected 0",
                               p, at, y);
        if (kind == HULL_EDGE_COLLAPSED && fabs(y - move[3 * first + 1]) > rounding * largest)
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "patch %zu: control points %zu and %zu coincide and move by %g and "
                               "%g m along y, expected the same move",
                               p, first, at, move[3 * first + 1], y);
    }
    return IGABEM_OK;
}

/* One field. */
static igabem_status check_move(const igabem_hull *hull, const double *move)
{
    double largest = 0.0;
    size_t points = field_points(hull), base = 0;
    for (size_t k = 0; k < points; k++)
        largest = fmax(largest, fabs(move[3 * k + 1]));
    for (size_t p = 0; p < hull->n; p++) {
        size_t count = patch_points(hull->patches[p].surface);
        for (size_t k = 0; k < 3 * count; k++) {
            double value = move[3 * base + k];
            if (!isfinite(value) || (k % 3 != 1 && fabs(value) > rounding * largest))
                return igabem_fail(IGABEM_ERROR_ARGUMENT,
                                   "patch %zu: control point %zu moves by %g m along %c, expected "
                                   "%s",
                                   p, k / 3, value, axis_names[k % 3],
                                   k % 3 == 1 ? "a number" : "0: hulls move along y");
        }
        for (int e = 0; e < HULL_EDGES; e++) {
            igabem_status status = check_edge(hull, p, e, largest, move + 3 * base);
            if (status != IGABEM_OK)
                return status;
        }
        base += count;
    }
    return IGABEM_OK;
}

/* The patches of the hull with the y moves of fields first, first + 1 and first + 2 as coordinates.
 */
static igabem_status move_surfaces(const igabem_hull *hull, const struct density *density, size_t n,
                                   size_t first, const double *move, nurbs_surface **surface)
{
    size_t points = field_points(hull), base = 0;
    double *coordinates = malloc(3 * points * sizeof *coordinates);
    igabem_status status =
        coordinates ? IGABEM_OK
                    : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu moves", points);
    for (size_t p = 0; p < hull->n && status == IGABEM_OK; p++) {
        const nurbs_surface *own = hull->patches[p].surface;
        const int degree[2] = {nurbs_surface_degree(own, 0), nurbs_surface_degree(own, 1)};
        const size_t size[2] = {nurbs_surface_size(own, 0), nurbs_surface_size(own, 1)};
        size_t count = size[0] * size[1];
        for (size_t k = 0; k < count; k++)
            for (size_t c = 0; c < 3; c++)
                coordinates[3 * k + c] =
                    first + c < n ? move[3 * (points * (first + c) + base + k) + 1] : 0.0;
        nurbs_surface *moves = NULL;
        if (nurbs_surface_create(degree, size, nurbs_surface_knots(own, 0),
                                 nurbs_surface_knots(own, 1), coordinates,
                                 nurbs_surface_weights(own), &moves) != NURBS_OK)
            status = hull_nurbs_fail(NURBS_ERROR_GEOMETRY, "moves of the control points");
        else
            status = density_conform(density, p, moves, &surface[p]);
        nurbs_surface_free(moves);
        base += count;
    }
    free(coordinates);
    return status;
}

static void take_values(const struct mesh *from, const nurbs_surface *const *surface,
                        size_t patches, size_t first, struct field *field)
{
    for (size_t e = 0; e < from->n; e++) {
        const struct element *element = &from->element[e];
        size_t count = (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
        for (size_t k = 0; k < count; k++)
            for (size_t c = 0; c < 3 && first + c < field->n; c++)
                field->net[(field->offset[e] + k) * field->width + first + c] =
                    element->net[4 * k + c];
    }
    double *to = field->point + first;
    for (size_t p = 0; p < patches; p++) {
        const double *point = nurbs_surface_points(surface[p]);
        for (size_t k = 0; k < patch_points(surface[p]); k++, to += field->width)
            for (size_t c = 0; c < 3 && first + c < field->n; c++)
                to[c] = point[3 * k + c];
    }
}

/* The hull is told from another by its surfaces. */
static igabem_status check_hull(const igabem_hull *hull, const struct density *density)
{
    if (hull->n != density->patches)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "a hull of %zu patches, that of the solution has %zu", hull->n,
                           density->patches);
    for (size_t p = 0; p < hull->n; p++) {
        nurbs_surface *surface;
        igabem_status status = density_conform(density, p, hull->patches[p].surface, &surface);
        if (status != IGABEM_OK)
            return status;
        const double *a = nurbs_surface_points(surface),
                     *b = nurbs_surface_points(density->patch[p].surface);
        double difference = 0.0;
        for (size_t k = 0; k < 3 * patch_points(surface); k++)
            difference = fmax(difference, fabs(a[k] - b[k]));
        nurbs_surface_free(surface);
        if (!(difference <= rounding * hull->extent))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "patch %zu is up to %g m away from that of the solution's hull", p,
                               difference);
    }
    return IGABEM_OK;
}

igabem_status field_create(const igabem_hull *hull, const struct density *density,
                           const struct mesh *mesh, size_t n, const double *move,
                           struct field **result)
{
    *result = NULL;
    igabem_status status = check_hull(hull, density);
    for (size_t k = 0; k < n && status == IGABEM_OK; k++)
        status = check_move(hull, move + 3 * field_points(hull) * k);
    return status == IGABEM_OK ? field_make(hull, density, mesh, n, move, result) : status;
}

igabem_status field_make(const igabem_hull *hull, const struct density *density,
                         const struct mesh *mesh, size_t n, const double *move,
                         struct field **result)
{
    igabem_status status = IGABEM_OK;
    *result = NULL;
    struct field *field = calloc(1, sizeof *field);
    nurbs_surface **surface = calloc(hull->n, sizeof *surface);
    size_t total = 0;
    if (field)
        field->offset = malloc(mesh->n * sizeof *field->offset);
    for (size_t e = 0; e < mesh->n && field && field->offset; e++) {
        const struct element *element = &mesh->element[e];
        field->offset[e] = total;
        total += (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
    }
    if (field) {
        field->n = n;
        field->width = (n + FIELD_BLOCK - 1) / FIELD_BLOCK * FIELD_BLOCK;
        field->mesh = mesh;
        field->controls = total;
        field->net = calloc(total * field->width, sizeof *field->net);
        for (size_t p = 0; p < density->patches; p++)
            field->points += patch_points(density->patch[p].surface);
        field->point = calloc(field->points * field->width, sizeof *field->point);
    }
    if (!field || !surface || !field->offset || !field->net || !field->point)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu fields", n);
    for (size_t first = 0; first < n && status == IGABEM_OK; first += 3) {
        struct mesh *moves = NULL;
        status = move_surfaces(hull, density, n, first, move, surface);
        if (status == IGABEM_OK)
            status = mesh_create_on(density, (const nurbs_surface *const *)surface, &moves);
        if (status == IGABEM_OK)
            take_values(moves, (const nurbs_surface *const *)surface, hull->n, first, field);
        mesh_free(moves);
        for (size_t p = 0; p < hull->n; p++) {
            nurbs_surface_free(surface[p]);
            surface[p] = NULL;
        }
    }
    free(surface);
    if (status != IGABEM_OK) {
        field_free(field);
        return status;
    }
    *result = field;
    return IGABEM_OK;
}

void field_free(struct field *field)
{
    if (!field)
        return;
    free(field->offset);
    free(field->net);
    free(field->point);
    free(field);
}

void field_points_of(const struct field *field, const double *factor, double *point)
{
    memset(point, 0, field->points * sizeof *point);
    for (size_t e = 0; e < field->mesh->n; e++)
        element_controls(&field->mesh->element[e], factor + field->offset[e], point);
}

const double *field_net(const struct field *field, const struct element *element)
{
    return field->net + field->offset[element - field->mesh->element] * field->width;
}

/* Sums over the control values of one block of fields. */
VECTOR_MULTIVERSION
static void sum_block(size_t count, size_t width, const double (*basis)[3], const double *net,
                      double sum[3][FIELD_BLOCK])
{
    memset(sum, 0, 3 * sizeof *sum);
    for (size_t k = 0; k < count; k++, net += width)
        for (size_t d = 0; d < 3; d++)
            for (size_t l = 0; l < FIELD_BLOCK; l++)
                sum[d][l] += basis[k][d] * net[l];
}

void field_at(const struct field *field, const struct element *element, const double local[2],
              double *v)
{
    size_t n = field->n, m = (size_t)element->degree[1] + 1;
    size_t count = ((size_t)element->degree[0] + 1) * m;
    double bu[ELEMENT_SIDE], du[ELEMENT_SIDE], bv[ELEMENT_SIDE], dv[ELEMENT_SIDE];
    double basis[ELEMENT_FUNCTIONS][3], weight[3] = {0.0, 0.0, 0.0};
    bernstein(element->degree[0], local[0], bu, du);
    bernstein(element->degree[1], local[1], bv, dv);
    for (size_t k = 0; k < count; k++) {
        basis[k][0] = bu[k / m] * bv[k % m];
        basis[k][1] = du[k / m] * bv[k % m];
        basis[k][2] = bu[k / m] * dv[k % m];
        for (size_t d = 0; d < 3; d++)
            weight[d] += basis[k][d] * element->net[4 * k + 3];
    }
    const double *net = field_net(field, element);
    for (size_t first = 0; first < n; first += FIELD_BLOCK) {
        double sum[3][FIELD_BLOCK];
        sum_block(count, field->width, (const double(*)[3])basis, net + first, sum);
        for (size_t l = 0; l < FIELD_BLOCK && first + l < n; l++) {
            double value = sum[0][l] / weight[0];
            v[first + l] = value;
            for (size_t d = 1; d < 3; d++)
                v[d * n + first + l] = (sum[d][l] - value * weight[d]) / weight[0];
        }
    }
}

/* Sums over the control values of one block of fields for up to three sets of factors. */
VECTOR_MULTIVERSION
static void contract_block(size_t sets, size_t count, size_t width, const double *factor,
                           const double *net, double sum[3][FIELD_BLOCK])
{
    double a[FIELD_BLOCK] = {0}, b[FIELD_BLOCK] = {0}, c[FIELD_BLOCK] = {0};
    const double *second = factor + (sets > 1 ? count : 0);
    const double *third = factor + (sets > 2 ? 2 * count : 0);
    for (size_t k = 0; k < count; k++, net += width)
        for (size_t l = 0; l < FIELD_BLOCK; l++) {
            a[l] += factor[k] * net[l];
            b[l] += second[k] * net[l];
            c[l] += third[k] * net[l];
        }
    memcpy(sum[0], a, sizeof a);
    memcpy(sum[1], b, sizeof b);
    memcpy(sum[2], c, sizeof c);
}

void field_contract(const struct field *field, const struct element *element, size_t sets,
                    const double *factor, double *out)
{
    size_t count = (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
    const double *net = field_net(field, element);
    for (size_t first = 0; first < field->n; first += FIELD_BLOCK) {
        double sum[3][FIELD_BLOCK];
        size_t fields = field->n - first < FIELD_BLOCK ? field->n - first : FIELD_BLOCK;
        contract_block(sets, count, field->width, factor, net + first, sum);
        for (size_t s = 0; s < sets; s++)
            for (size_t l = 0; l < fields; l++)
                out[s * field->n + first + l] += sum[s][l];
    }
}

void area_change(const double ds[3], const double dt[3], double sign, struct area_change *change)
{
    const double area[3] = {sign * (ds[1] * dt[2] - ds[2] * dt[1]),
                            sign * (ds[2] * dt[0] - ds[0] * dt[2]),
                            sign * (ds[0] * dt[1] - ds[1] * dt[0])};
    const double vector[2][3] = {{sign * dt[2], 0.0, -sign * dt[0]},
                                 {-sign * ds[2], 0.0, sign * ds[0]}};
    memcpy(change->area, area, sizeof area);
    memcpy(change->vector, vector, sizeof vector);
    change->size = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    for (int d = 0; d < 2; d++) {
        change->length[d] = change->size > 0
                                ? (area[0] * vector[d][0] + area[2] * vector[d][2]) / change->size
                                : 0.0;
        change->inflow[d] = vector[d][0];
    }
}
