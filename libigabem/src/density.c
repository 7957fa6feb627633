#include "density.h"

#include "element.h"
#include "error.h"

#include <lapacke.h>
#include <math.h>
#include <nurbs/basis.h>
#include <nurbs/modify.h>
#include <stdlib.h>
#include <string.h>

static igabem_status from_nurbs(nurbs_status status, size_t patch)
{
    igabem_status code = status == NURBS_ERROR_MEMORY ? IGABEM_ERROR_MEMORY : IGABEM_ERROR_GEOMETRY;
    return igabem_fail(code, "patch %zu: %s", patch, nurbs_last_error());
}

/* Replaces *surface by the result of a change of representation. */
static nurbs_status replace(nurbs_surface **surface, nurbs_status status, nurbs_surface *result)
{
    if (status != NURBS_OK)
        return status;
    nurbs_surface_free(*surface);
    *surface = result;
    return NURBS_OK;
}

static nurbs_status refine_direction(nurbs_surface **surface, int direction, int parts)
{
    size_t n = nurbs_surface_size(*surface, direction);
    int degree = nurbs_surface_degree(*surface, direction);
    const double *knots = nurbs_surface_knots(*surface, direction);
    double *breaks = malloc(2 * (n + 1) * sizeof *breaks * (size_t)parts);
    if (!breaks)
        return NURBS_ERROR_MEMORY;
    size_t count = nurbs_knots_distinct(degree, n, knots, breaks, NULL), added = 0;
    double *inserted = breaks + n + 1;
    for (size_t k = 0; k + 1 < count; k++)
        for (int i = 1; i < parts; i++)
            inserted[added++] = breaks[k] + (breaks[k + 1] - breaks[k]) * i / parts;
    nurbs_surface *result = NULL;
    nurbs_status status = nurbs_surface_insert(*surface, direction, added, inserted, &result);
    free(breaks);
    return replace(surface, status, result);
}

static nurbs_status refined_surface(const nurbs_surface *hull, int degree, const int refine[2],
                                    nurbs_surface **surface)
{
    nurbs_status status = nurbs_surface_copy(hull, surface);
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        int by = degree - nurbs_surface_degree(*surface, d);
        if (by > 0) {
            nurbs_surface *result = NULL;
            status = nurbs_surface_elevate(*surface, d, by, &result);
            status = replace(surface, status, result);
        }
        if (status == NURBS_OK && refine[d] > 1)
            status = refine_direction(surface, d, refine[d]);
    }
    return status;
}

static int same(double a, double b, double scale)
{
    return fabs(a - b) <= 1e-12 * scale;
}

/* Greville points. The first and the last go half way to their neighbour: off the waterline, where
 * the kernel is singular, and off stem, keel and collapsed edges, where the normal is not defined.
 * Those on a knot of multiplicity >= degree, where the surface may have a kink, move likewise. */
static void collocation_abscissae(int degree, size_t n, const double *knots, double *abscissa)
{
    double scale = knots[n] - knots[0], previous = knots[0], here = knots[0];
    nurbs_greville(degree, n, knots, abscissa);
    for (size_t i = 0; i < n; i++, previous = here) {
        here = abscissa[i];
        if (i == 0) {
            abscissa[i] = 0.5 * (here + abscissa[i + 1]);
            continue;
        }
        if (i + 1 == n) {
            abscissa[i] = 0.5 * (previous + here);
            continue;
        }
        int multiplicity = 0;
        for (size_t k = i; k <= i + (size_t)degree + 1; k++)
            multiplicity += same(knots[k], here, scale);
        if (multiplicity < degree)
            continue;
        double towards = same(abscissa[i + 1], here, scale) ? previous : abscissa[i + 1];
        abscissa[i] = 0.5 * (here + towards);
    }
}

static igabem_status create_patch(const struct hull_patch *hull, size_t index, int degree,
                                  const int refine[2], size_t offset, struct density_patch *patch)
{
    patch->hull = *hull;
    patch->hull.surface = NULL;
    patch->offset = offset;
    nurbs_status status = refined_surface(hull->surface, degree, refine, &patch->surface);
    patch->hull.surface = patch->surface;
    if (status != NURBS_OK)
        return from_nurbs(status, index);
    for (int d = 0; d < 2; d++) {
        int p = nurbs_surface_degree(patch->surface, d);
        size_t n = nurbs_surface_size(patch->surface, d);
        const double *knots = nurbs_surface_knots(patch->surface, d);
        if (p > ELEMENT_MAX_DEGREE)
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "patch %zu: degree %d of the density exceeds %d", index, p,
                               (int)ELEMENT_MAX_DEGREE);
        patch->degree[d] = p;
        patch->size[d] = n;
        patch->breaks[d] = malloc((n + 1) * sizeof(double));
        patch->abscissa[d] = malloc(n * sizeof(double));
        if (!patch->breaks[d] || !patch->abscissa[d])
            return igabem_fail(IGABEM_ERROR_MEMORY, "patch %zu: no memory for the density", index);
        patch->spans[d] = nurbs_knots_distinct(p, n, knots, patch->breaks[d], NULL) - 1;
        collocation_abscissae(p, n, knots, patch->abscissa[d]);
    }
    return IGABEM_OK;
}

static igabem_status collocation_points(struct density *density, size_t index)
{
    const struct density_patch *patch = &density->patch[index];
    size_t n = patch->size[0] * patch->size[1];
    double *triples = malloc(9 * n * sizeof *triples);
    if (!triples)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu collocation points", n);
    nurbs_status status =
        nurbs_surface_eval_grid(patch->surface, 1, patch->size[0], patch->abscissa[0],
                                patch->size[1], patch->abscissa[1], triples);
    if (status != NURBS_OK) {
        free(triples);
        return from_nurbs(status, index);
    }
    for (size_t k = 0; k < n; k++) {
        size_t row = patch->offset + k;
        double area;
        memcpy(density->point + 3 * row, triples + 9 * k, 3 * sizeof(double));
        memcpy(density->jet[row], triples + 9 * k + 3, 6 * sizeof(double));
        density->owner[row] = index;
        density->uv[row][0] = patch->abscissa[0][k / patch->size[1]];
        density->uv[row][1] = patch->abscissa[1][k % patch->size[1]];
        if (!hull_normal(&patch->hull, triples + 9 * k, density->normal + 3 * row, &area)) {
            free(triples);
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "patch %zu: the normal vanishes at the collocation point (%g, %g)",
                               index, density->uv[row][0], density->uv[row][1]);
        }
    }
    free(triples);
    return IGABEM_OK;
}

igabem_status density_create(const igabem_hull *hull, int degree, const int refine[2],
                             struct density **result)
{
    *result = NULL;
    struct density *density = calloc(1, sizeof *density);
    if (density)
        density->patch = calloc(hull->n, sizeof *density->patch);
    if (!density || !density->patch) {
        density_free(density);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the density of %zu patches",
                           hull->n);
    }
    density->patches = hull->n;
    density->symmetric = hull->symmetric;
    igabem_status status = IGABEM_OK;
    for (size_t k = 0; k < hull->n && status == IGABEM_OK; k++) {
        struct density_patch *patch = &density->patch[k];
        status = create_patch(&hull->patches[k], k, degree, refine, density->n, patch);
        if (status == IGABEM_OK)
            density->n += patch->size[0] * patch->size[1];
    }
    if (status == IGABEM_OK) {
        size_t n = density->n;
        density->point = malloc(3 * n * sizeof *density->point);
        density->normal = malloc(3 * n * sizeof *density->normal);
        density->owner = malloc(n * sizeof *density->owner);
        density->uv = malloc(n * sizeof *density->uv);
        density->jet = malloc(n * sizeof *density->jet);
        if (!density->point || !density->normal || !density->owner || !density->uv || !density->jet)
            status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu collocation points", n);
    }
    for (size_t k = 0; k < hull->n && status == IGABEM_OK; k++)
        status = collocation_points(density, k);
    if (status != IGABEM_OK) {
        density_free(density);
        return status;
    }
    *result = density;
    return IGABEM_OK;
}

void density_free(struct density *density)
{
    if (!density)
        return;
    for (size_t k = 0; density->patch && k < density->patches; k++) {
        nurbs_surface_free(density->patch[k].surface);
        for (int d = 0; d < 2; d++) {
            free(density->patch[k].breaks[d]);
            free(density->patch[k].abscissa[d]);
        }
    }
    free(density->patch);
    free(density->point);
    free(density->normal);
    free(density->owner);
    free(density->uv);
    free(density->jet);
    free(density);
}

/* LU factors of the matrix B_j(abscissa_i) of one direction. */
static lapack_int factor_direction(const struct density_patch *patch, int d, double *matrix,
                                   lapack_int *pivots)
{
    size_t n = patch->size[d], p = (size_t)patch->degree[d], span = 0;
    const double *knots = nurbs_surface_knots(patch->surface, d);
    memset(matrix, 0, n * n * sizeof *matrix);
    for (size_t i = 0; i < n; i++) {
        double x = patch->abscissa[d][i];
        span = nurbs_basis_span((int)p, n, knots, x, &span);
        nurbs_basis((int)p, knots, span, x, matrix + i * n + span - p);
    }
    return LAPACKE_dgetrf(LAPACK_ROW_MAJOR, (lapack_int)n, (lapack_int)n, matrix, (lapack_int)n,
                          pivots);
}

/* One patch, one field: the collocation matrix is diag(1/W) (Bu x Bv) diag(w) with the weights w of
 * the control points and W(u,v) of the collocation points. */
static igabem_status interpolate_patch(const struct density *density,
                                       const struct density_patch *patch, size_t fields,
                                       double *values)
{
    size_t nu = patch->size[0], nv = patch->size[1], n = nu * nv;
    const double *weights = nurbs_surface_weights(patch->surface);
    double *work = malloc((nu * nu + nv * nv + 2 * n) * sizeof *work);
    lapack_int *pivots = malloc((nu + nv) * sizeof *pivots);
    igabem_status status = IGABEM_OK;
    if (!work || !pivots) {
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory to interpolate on a patch");
        goto done;
    }
    double *mu = work, *mv = mu + nu * nu, *scale = mv + nv * nv, *turned = scale + n;
    if (factor_direction(patch, 0, mu, pivots) || factor_direction(patch, 1, mv, pivots + nu)) {
        status = igabem_fail(IGABEM_ERROR_NUMERIC, "singular interpolation at Greville points");
        goto done;
    }
    for (size_t k = 0; k < n; k++)
        scale[k] = 1.0;
    if (weights) {
        size_t span[2];
        double basis[ELEMENT_FUNCTIONS];
        size_t q = (size_t)patch->degree[1];
        for (size_t k = 0; k < n; k++) { /* R_ij = w_ij B_ij / W for any one function */
            const double *uv = density->uv[patch->offset + k];
            if (nurbs_surface_basis(patch->surface, 0, uv[0], uv[1], span, basis) != NURBS_OK) {
                status = igabem_fail(IGABEM_ERROR_NUMERIC, "%s", nurbs_last_error());
                goto done;
            }
            size_t first =
                (span[0] - (size_t)patch->degree[0]) * nv + span[1] - (size_t)patch->degree[1];
            double sum = 0.0;
            for (size_t m = 0; m < (size_t)(patch->degree[0] + 1) * (q + 1); m++)
                sum += basis[m] / weights[first + m / (q + 1) * nv + m % (q + 1)];
            scale[k] = 1.0 / sum; /* sum R/w = sum B / W = 1 / W */
        }
    }
    for (size_t f = 0; f < fields; f++) {
        double *field = values + f * density->n + patch->offset;
        for (size_t k = 0; k < n; k++)
            field[k] *= scale[k];
        LAPACKE_dgetrs(LAPACK_ROW_MAJOR, 'N', (lapack_int)nu, (lapack_int)nv, mu, (lapack_int)nu,
                       pivots, field, (lapack_int)nv);
        for (size_t i = 0; i < nu; i++)
            for (size_t j = 0; j < nv; j++)
                turned[j * nu + i] = field[i * nv + j];
        LAPACKE_dgetrs(LAPACK_ROW_MAJOR, 'N', (lapack_int)nv, (lapack_int)nu, mv, (lapack_int)nv,
                       pivots + nu, turned, (lapack_int)nu);
        for (size_t i = 0; i < nu; i++)
            for (size_t j = 0; j < nv; j++)
                field[i * nv + j] = turned[j * nu + i] / (weights ? weights[i * nv + j] : 1.0);
    }
done:
    free(work);
    free(pivots);
    return status;
}

igabem_status density_interpolate(const struct density *density, size_t fields, double *values)
{
    igabem_status status = IGABEM_OK;
    for (size_t k = 0; k < density->patches && status == IGABEM_OK; k++)
        status = interpolate_patch(density, &density->patch[k], fields, values);
    return status;
}

igabem_status density_evaluate(const struct density *density, size_t index, size_t fields,
                               const double *coefficients, size_t m, const double *uv, double *out)
{
    if (index >= density->patches)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "patch %zu of %zu", index, density->patches);
    const struct density_patch *patch = &density->patch[index];
    size_t nv = patch->size[1], q = (size_t)patch->degree[1] + 1;
    for (size_t k = 0; k < m; k++) {
        size_t span[2];
        double basis[ELEMENT_FUNCTIONS];
        if (nurbs_surface_basis(patch->surface, 0, uv[2 * k], uv[2 * k + 1], span, basis) !=
            NURBS_OK)
            return igabem_fail(IGABEM_ERROR_ARGUMENT, "point %zu: %s", k, nurbs_last_error());
        size_t first = patch->offset + (span[0] - (size_t)patch->degree[0]) * nv + span[1] -
                       (size_t)patch->degree[1];
        for (size_t f = 0; f < fields; f++) {
            const double *c = coefficients + f * density->n + first;
            double sum = 0.0;
            for (size_t i = 0; i < (size_t)(patch->degree[0] + 1); i++)
                for (size_t j = 0; j < q; j++)
                    sum += basis[i * q + j] * c[i * nv + j];
            out[k * fields + f] = sum;
        }
    }
    return IGABEM_OK;
}
