#include "space/density.h"

#include "core/error.h"
#include "space/element.h"

#include <nurbs/basis.h>
#include <nurbs/modify.h>

#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static igabem_status from_nurbs(nurbs_status status, size_t patch)
{
    char what[32];
    snprintf(what, sizeof what, "patch %zu", patch);
    return hull_nurbs_fail(status, what);
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

/* Distinct knots of one direction of a surface; creates *breaks. */
static size_t distinct_knots(const nurbs_surface *surface, int direction, double **breaks,
                             int **multiplicities)
{
    size_t n = nurbs_surface_size(surface, direction);
    *breaks = malloc((n + 2) * sizeof **breaks);
    *multiplicities = malloc((n + 2) * sizeof **multiplicities);
    if (!*breaks || !*multiplicities)
        return 0;
    return nurbs_knots_distinct(nurbs_surface_degree(surface, direction), n,
                                nurbs_surface_knots(surface, direction), *breaks, *multiplicities);
}

static int same(double a, double b, double scale)
{
    return fabs(a - b) <= 1e-9 * scale;
}

/* Inserts those of `count` increasing parameters that are no knots yet; one that is within rounding
 * of a knot is replaced by it. */
static nurbs_status insert_missing(nurbs_surface **surface, int direction, double *wanted,
                                   size_t count)
{
    double *breaks = NULL, *missing = malloc((count + 1) * sizeof *missing);
    int *multiplicities = NULL;
    size_t n = distinct_knots(*surface, direction, &breaks, &multiplicities), added = 0, k = 0;
    nurbs_status status = n && missing ? NURBS_OK : NURBS_ERROR_MEMORY;
    for (size_t i = 0; i < count && status == NURBS_OK; i++) {
        double scale = breaks[n - 1] - breaks[0];
        while (k + 1 < n && breaks[k] < wanted[i] && !same(breaks[k], wanted[i], scale))
            k++;
        if (same(breaks[k], wanted[i], scale))
            wanted[i] = breaks[k];
        else
            missing[added++] = wanted[i];
    }
    nurbs_surface *result = NULL;
    if (status == NURBS_OK && added) {
        status = nurbs_surface_insert(*surface, direction, added, missing, &result);
        status = replace(surface, status, result);
    }
    free(breaks);
    free(multiplicities);
    free(missing);
    return status;
}

/* Divides every span of one direction in equal parts. */
static nurbs_status refine_direction(nurbs_surface **surface, int direction, int parts)
{
    double *breaks = NULL, *inserted = NULL;
    int *multiplicities = NULL;
    size_t count = distinct_knots(*surface, direction, &breaks, &multiplicities), added = 0;
    nurbs_status status = NURBS_ERROR_MEMORY;
    if (count)
        inserted = malloc(count * (size_t)parts * sizeof *inserted);
    for (size_t k = 0; inserted && k + 1 < count; k++)
        for (int i = 1; i < parts; i++)
            inserted[added++] = breaks[k] + (breaks[k + 1] - breaks[k]) * i / parts;
    if (inserted)
        status = insert_missing(surface, direction, inserted, added);
    free(breaks);
    free(multiplicities);
    free(inserted);
    return status;
}

static nurbs_status elevated_surface(const nurbs_surface *hull, int degree, nurbs_surface **surface)
{
    nurbs_status status = nurbs_surface_copy(hull, surface);
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        int by = degree - nurbs_surface_degree(*surface, d);
        if (by > 0) {
            nurbs_surface *result = NULL;
            status = nurbs_surface_elevate(*surface, d, by, &result);
            status = replace(surface, status, result);
        }
    }
    return status;
}

/* Break k of m over [0,1]: uniform, or, where that would make the span at a waterline narrower than
 * least, 1 - (1 - k/m)^p from the waterline on with a first span of that width. What changes within
 * less than the filter's length of the still water is what the filter took out: collocation rows
 * there only amplify it. */
static double break_at(const struct density_patch *patch, int d, size_t k, size_t m, double least)
{
    double t = (double)k / (double)m;
    int low = patch->hull.edge[2 * d] == HULL_EDGE_WATERLINE;
    int high = patch->hull.edge[2 * d + 1] == HULL_EDGE_WATERLINE;
    if (low == high || least * (double)m <= 1.0)
        return t;
    double power = log1p(-least) / log1p(-1.0 / (double)m);
    return low ? 1.0 - pow(1.0 - t, power) : pow(t, power);
}

/* Clamped knots of its own, their breaks made knots of the surface. */
static nurbs_status own_knots(struct density_patch *patch, int d, int elements, double least)
{
    size_t p = (size_t)patch->degree[d], m = (size_t)elements;
    const double *domain = patch->hull.domain[d];
    patch->size[d] = m + p;
    patch->knots[d] = malloc((m + 2 * p + 1) * sizeof(double));
    double *knots = patch->knots[d];
    if (!knots)
        return NURBS_ERROR_MEMORY;
    for (size_t k = 0; k <= p; k++) {
        knots[k] = domain[0];
        knots[m + p + k] = domain[1];
    }
    for (size_t k = 1; k < m; k++)
        knots[p + k] = domain[0] + (domain[1] - domain[0]) * break_at(patch, d, k, m, least);
    return insert_missing(&patch->surface, d, knots + p + 1, m - 1);
}

static nurbs_status hull_knots(struct density_patch *patch, int d)
{
    size_t n = nurbs_surface_size(patch->surface, d), count = n + (size_t)patch->degree[d] + 1;
    patch->size[d] = n;
    patch->knots[d] = malloc(count * sizeof(double));
    if (!patch->knots[d])
        return NURBS_ERROR_MEMORY;
    memcpy(patch->knots[d], nurbs_surface_knots(patch->surface, d), count * sizeof(double));
    return NURBS_OK;
}

/* Whether the normal of the surface turns suddenly at a parameter of direction d. */
static int is_kink(const struct density_patch *patch, int d, double parameter)
{
    enum { SAMPLES = 7 };
    const double *range = patch->hull.domain[d], *across = patch->hull.domain[1 - d];
    double step = 1e-7 * (range[1] - range[0]);
    for (int k = 0; k < SAMPLES; k++) {
        double normal[2][3], area[2];
        for (int side = 0; side < 2; side++) {
            double uv[2], triples[9];
            uv[d] = parameter + (side ? step : -step);
            uv[1 - d] = across[0] + (across[1] - across[0]) * (k + 0.5) / SAMPLES;
            if (nurbs_surface_eval(patch->surface, 1, 1, uv, triples) != NURBS_OK)
                return 1;
            hull_normal(&patch->hull, triples, normal[side], &area[side]);
        }
        double cosine =
            normal[0][0] * normal[1][0] + normal[0][1] * normal[1][1] + normal[0][2] * normal[1][2];
        if (cosine < 1.0 - 1e-6)
            return 1;
    }
    return 0;
}

/* Elements end at every knot, panels at those of the density and where the shape is only C0. */
static nurbs_status find_breaks(struct density_patch *patch, int d)
{
    int *multiplicities = NULL;
    size_t n = distinct_knots(patch->surface, d, &patch->breaks[d], &multiplicities), count = 0;
    double *panels = malloc((n + 1) * sizeof *panels);
    const double *knots = patch->knots[d];
    patch->panel_breaks[d] = panels;
    if (!n || !panels) {
        free(multiplicities);
        return NURBS_ERROR_MEMORY;
    }
    patch->spans[d] = n - 1;
    size_t k = 0, last = patch->size[d] + (size_t)patch->degree[d];
    for (size_t i = 0; i < n; i++) {
        while (k < last && knots[k] < patch->breaks[d][i])
            k++;
        if (knots[k] == patch->breaks[d][i] || multiplicities[i] >= patch->degree[d])
            panels[count++] = patch->breaks[d][i];
    }
    patch->panels[d] = count - 1;
    free(multiplicities);
    return NURBS_OK;
}

/* Greville points. The first and the last go half way to their neighbour: off the waterline, where
 * the kernel is singular, and off stem, keel and collapsed edges, where the normal is not defined.
 * Those on a knot of multiplicity >= degree, or on a kink of the shape, move likewise. */
static void collocation_abscissae(struct density_patch *patch, int d)
{
    size_t n = patch->size[d];
    int degree = patch->degree[d];
    const double *knots = patch->knots[d];
    double *abscissa = patch->abscissa[d];
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
        if (multiplicity >= degree) {
            double towards = same(abscissa[i + 1], here, scale) ? previous : abscissa[i + 1];
            abscissa[i] = 0.5 * (here + towards);
        } else if (is_kink(patch, d, here)) {
            abscissa[i] = 0.75 * here + 0.25 * abscissa[i + 1];
        }
    }
}

/* A density_rule for u and v of one patch. */
struct patch_rule {
    int degree, refine[2], elements[2];
    double least[2]; /* width of own spans at the waterline, share of the range */
};

static nurbs_status shape_and_basis(const struct hull_patch *hull, const struct patch_rule *rule,
                                    struct density_patch *patch)
{
    nurbs_status status = elevated_surface(hull->surface, rule->degree, &patch->surface);
    int own = rule->elements[0] > 0 || rule->elements[1] > 0;
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        patch->degree[d] = nurbs_surface_degree(patch->surface, d);
        if (rule->elements[d] > 0)
            continue;
        if (rule->refine[d] > 1)
            status = refine_direction(&patch->surface, d, rule->refine[d]);
        if (status == NURBS_OK)
            status = hull_knots(patch, d);
    }
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        if (rule->elements[d] > 0)
            status = own_knots(patch, d, rule->elements[d], rule->least[d]);
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = find_breaks(patch, d);
    patch->hull.surface = patch->surface;
    if (status == NURBS_OK && !own)
        patch->weights = nurbs_surface_weights(patch->surface);
    return status;
}

/* The rule of the hull, along and around it, as one for the directions u and v of a patch. */
static struct patch_rule rule_of_patch(const igabem_hull *hull, size_t index,
                                       const struct density_rule *rule)
{
    const struct hull_patch *patch = &hull->patches[index];
    struct patch_rule own = {.degree = rule->degree};
    for (int d = 0; d < 2; d++) {
        int around = hull_is_around(patch, d);
        double share = hull->run[around] > 0 ? patch->length[d] / hull->run[around] : 1.0;
        own.refine[d] = rule->refine[around];
        own.elements[d] = hull_share(hull, index, d, rule->elements[around]);
        own.least[d] = fmin(rule->waterline_span / share, 0.5);
    }
    return own;
}

static igabem_status create_patch(const igabem_hull *hull, size_t index,
                                  const struct density_rule *rule, size_t offset,
                                  struct density_patch *patch)
{
    const struct patch_rule own = rule_of_patch(hull, index, rule);
    patch->hull = hull->patches[index];
    patch->hull.surface = NULL;
    patch->offset = offset;
    nurbs_status status = shape_and_basis(&hull->patches[index], &own, patch);
    if (status != NURBS_OK)
        return from_nurbs(status, index);
    for (int d = 0; d < 2; d++) {
        if (patch->degree[d] > ELEMENT_MAX_DEGREE)
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "patch %zu: degree %d of the density exceeds %d", index,
                               patch->degree[d], (int)ELEMENT_MAX_DEGREE);
        patch->abscissa[d] = malloc(patch->size[d] * sizeof(double));
        if (!patch->abscissa[d])
            return igabem_fail(IGABEM_ERROR_MEMORY, "patch %zu: no memory for the density", index);
        collocation_abscissae(patch, d);
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

igabem_status density_create(const igabem_hull *hull, const struct density_rule *rule,
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
        status = create_patch(hull, k, rule, density->n, patch);
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

/* Inserts those knots of `wanted` that *surface has not. */
static nurbs_status insert_knots(const nurbs_surface *wanted, int d, nurbs_surface **surface)
{
    size_t count = nurbs_surface_size(wanted, d) + (size_t)nurbs_surface_degree(wanted, d) + 1;
    size_t n = nurbs_surface_size(*surface, d) + (size_t)nurbs_surface_degree(*surface, d) + 1;
    const double *to = nurbs_surface_knots(wanted, d), *from = nurbs_surface_knots(*surface, d);
    double *missing = malloc(count * sizeof *missing);
    size_t added = 0, at = 0;
    if (!missing)
        return NURBS_ERROR_MEMORY;
    for (size_t k = 0; k < count; k++)
        if (at < n && from[at] == to[k])
            at++;
        else
            missing[added++] = to[k];
    nurbs_status status = NURBS_OK;
    if (added) {
        nurbs_surface *result = NULL;
        status = nurbs_surface_insert(*surface, d, added, missing, &result);
        status = replace(surface, status, result);
    }
    free(missing);
    return status;
}

igabem_status density_conform(const struct density *density, size_t index,
                              const nurbs_surface *surface, nurbs_surface **result)
{
    const nurbs_surface *wanted = density->patch[index].surface;
    nurbs_status status = nurbs_surface_copy(surface, result);
    for (int d = 0; d < 2 && status == NURBS_OK; d++) {
        int by = nurbs_surface_degree(wanted, d) - nurbs_surface_degree(*result, d);
        nurbs_surface *elevated = NULL;
        if (by > 0) {
            status = nurbs_surface_elevate(*result, d, by, &elevated);
            status = replace(result, status, elevated);
        }
    }
    for (int d = 0; d < 2 && status == NURBS_OK; d++)
        status = insert_knots(wanted, d, result);
    bool alike = status == NURBS_OK;
    for (int d = 0; d < 2 && alike; d++)
        alike = nurbs_surface_size(*result, d) == nurbs_surface_size(wanted, d) &&
                nurbs_surface_degree(*result, d) == nurbs_surface_degree(wanted, d);
    if (alike)
        return IGABEM_OK;
    nurbs_surface_free(*result);
    *result = NULL;
    return status == NURBS_OK
               ? igabem_fail(IGABEM_ERROR_ARGUMENT,
                             "patch %zu: other knots than those of the solution's hull", index)
               : from_nurbs(status, index);
}

void density_free(struct density *density)
{
    if (!density)
        return;
    for (size_t k = 0; density->patch && k < density->patches; k++) {
        nurbs_surface_free(density->patch[k].surface);
        for (int d = 0; d < 2; d++) {
            free(density->patch[k].knots[d]);
            free(density->patch[k].breaks[d]);
            free(density->patch[k].panel_breaks[d]);
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
    const double *knots = patch->knots[d];
    memset(matrix, 0, n * n * sizeof *matrix);
    for (size_t i = 0; i < n; i++) {
        double x = patch->abscissa[d][i];
        span = nurbs_basis_span((int)p, n, knots, x, &span);
        nurbs_basis((int)p, knots, span, x, matrix + i * n + span - p);
    }
    return LAPACKE_dgetrf(LAPACK_ROW_MAJOR, (lapack_int)n, (lapack_int)n, matrix, (lapack_int)n,
                          pivots);
}

/* Functions of the density at (u, v): fills basis[pu+1][pv+1], returns the index of the first one
 * within the patch. */
static size_t evaluate_basis(const struct density_patch *patch, const double uv[2], double *basis,
                             double *divisor)
{
    double value[2][ELEMENT_SIDE];
    size_t first[2], n = (size_t)patch->degree[1] + 1;
    for (int d = 0; d < 2; d++) {
        size_t span =
            nurbs_basis_span(patch->degree[d], patch->size[d], patch->knots[d], uv[d], NULL);
        nurbs_basis(patch->degree[d], patch->knots[d], span, uv[d], value[d]);
        first[d] = span - (size_t)patch->degree[d];
    }
    size_t corner = first[0] * patch->size[1] + first[1],
           count = (size_t)(patch->degree[0] + 1) * n;
    double sum = 0.0;
    for (size_t k = 0; k < count; k++) {
        size_t at = corner + k / n * patch->size[1] + k % n;
        basis[k] = value[0][k / n] * value[1][k % n] * (patch->weights ? patch->weights[at] : 1.0);
        sum += basis[k];
    }
    *divisor = patch->weights ? sum : 1.0;
    for (size_t k = 0; k < count; k++)
        basis[k] /= *divisor;
    return corner;
}

/* One patch, one field: the collocation matrix is diag(1/W) (Bu x Bv) diag(w) with the weights w of
 * the control points and W(u,v) of the collocation points. */
static igabem_status interpolate_patch(const struct density *density,
                                       const struct density_patch *patch, size_t fields,
                                       double *values)
{
    size_t nu = patch->size[0], nv = patch->size[1], n = nu * nv;
    const double *weights = patch->weights;
    double *work = malloc((nu * nu + nv * nv + 2 * n) * sizeof *work);
    lapack_int *pivots = malloc((nu + nv) * sizeof *pivots);
    igabem_status status = IGABEM_OK;
    if (!work || !pivots) {
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory to interpolate on a patch");
        goto done;
    }
    double *mu = work, *mv = mu + nu * nu, *scale = mv + nv * nv, *turned = scale + n;
    lapack_int info = factor_direction(patch, 0, mu, pivots);
    if (info == 0)
        info = factor_direction(patch, 1, mv, pivots + nu);
    if (info != 0) {
        status = igabem_fail_lapack("interpolation at Greville points", info);
        goto done;
    }
    for (size_t k = 0; k < n; k++)
        scale[k] = 1.0;
    for (size_t k = 0; k < n && weights; k++) {
        double basis[ELEMENT_FUNCTIONS];
        evaluate_basis(patch, density->uv[patch->offset + k], basis, &scale[k]);
    }
    for (size_t f = 0; f < fields; f++) {
        double *field = values + f * density->n + patch->offset;
        for (size_t k = 0; k < n; k++)
            field[k] *= scale[k];
        info = LAPACKE_dgetrs(LAPACK_ROW_MAJOR, 'N', (lapack_int)nu, (lapack_int)nv, mu,
                              (lapack_int)nu, pivots, field, (lapack_int)nv);
        for (size_t i = 0; i < nu; i++)
            for (size_t j = 0; j < nv; j++)
                turned[j * nu + i] = field[i * nv + j];
        if (info == 0)
            info = LAPACKE_dgetrs(LAPACK_ROW_MAJOR, 'N', (lapack_int)nv, (lapack_int)nu, mv,
                                  (lapack_int)nv, pivots + nu, turned, (lapack_int)nu);
        if (info != 0) {
            status = igabem_fail_lapack("interpolation on a patch", info);
            goto done;
        }
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
        double basis[ELEMENT_FUNCTIONS], divisor;
        const double *at = uv + 2 * k;
        for (int d = 0; d < 2; d++)
            if (!(at[d] >= patch->hull.domain[d][0] && at[d] <= patch->hull.domain[d][1]))
                return igabem_fail(IGABEM_ERROR_ARGUMENT,
                                   "point %zu: parameter %g is outside %g to %g", k, at[d],
                                   patch->hull.domain[d][0], patch->hull.domain[d][1]);
        size_t first = patch->offset + evaluate_basis(patch, at, basis, &divisor);
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
