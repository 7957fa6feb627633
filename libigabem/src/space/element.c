#include "space/element.h"

#include "core/constants.h"
#include "core/error.h"
#include "core/vector_math.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void bernstein_cubic(double s, double *values, double *derivatives)
{
    double r = 1.0 - s, rr = r * r, ss = s * s, rs = r * s;
    values[0] = rr * r;
    values[1] = 3.0 * rr * s;
    values[2] = 3.0 * r * ss;
    values[3] = ss * s;
    if (!derivatives)
        return;
    derivatives[0] = -3.0 * rr;
    derivatives[1] = 3.0 * rr - 6.0 * rs;
    derivatives[2] = 6.0 * rs - 3.0 * ss;
    derivatives[3] = 3.0 * ss;
}

void bernstein(int p, double s, double *values, double *derivatives)
{
    if (p == 3) { /* nearly always */
        bernstein_cubic(s, values, derivatives);
        return;
    }
    double r = 1.0 - s;
    values[0] = 1.0;
    if (derivatives)
        derivatives[0] = 0.0;
    for (int k = 1; k <= p; k++) {
        if (k == p && derivatives) {
            derivatives[0] = -p * values[0];
            for (int i = 1; i < p; i++)
                derivatives[i] = p * (values[i - 1] - values[i]);
            derivatives[p] = p * values[p - 1];
        }
        values[k] = s * values[k - 1];
        for (int i = k - 1; i > 0; i--)
            values[i] = r * values[i] + s * values[i - 1];
        values[0] *= r;
    }
}

void element_jet(const struct element *element, double s, double t, struct jet *jet)
{
    int p = element->degree[0], q = element->degree[1];
    double bu[ELEMENT_SIDE], du[ELEMENT_SIDE], bv[ELEMENT_SIDE], dv[ELEMENT_SIDE];
    bernstein(p, s, bu, du);
    bernstein(q, t, bv, dv);
    double h[4] = {0}, hs[4] = {0}, ht[4] = {0};
    const double *net = element->net;
    for (int a = 0; a <= p; a++) {
        double row[4] = {0}, row_t[4] = {0};
        for (int b = 0; b <= q; b++, net += 4)
            for (int c = 0; c < 4; c++) {
                row[c] += bv[b] * net[c];
                row_t[c] += dv[b] * net[c];
            }
        for (int c = 0; c < 4; c++) {
            h[c] += bu[a] * row[c];
            hs[c] += du[a] * row[c];
            ht[c] += bu[a] * row_t[c];
        }
    }
    double inverse = 1.0 / h[3];
    jet->weight = element->rational ? h[3] : 1.0;
    for (int c = 0; c < 3; c++) {
        jet->s[c] = h[c] * inverse;
        jet->ds[c] = (hs[c] - jet->s[c] * hs[3]) * inverse;
        jet->dt[c] = (ht[c] - jet->s[c] * ht[3]) * inverse;
    }
}

double jet_area(const struct jet *jet, double sign, double area[3])
{
    const double *a = jet->ds, *b = jet->dt;
    area[0] = sign * (a[1] * b[2] - a[2] * b[1]);
    area[1] = sign * (a[2] * b[0] - a[0] * b[2]);
    area[2] = sign * (a[0] * b[1] - a[1] * b[0]);
    return sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
}

void element_scatter(const struct element *element, size_t fields, const double *moments,
                     double *rows, size_t stride)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *eu = element->extraction[0], *ev = element->extraction[1];
    for (size_t c = 0; c < fields; c++, moments += m * n, rows += stride) {
        double half[ELEMENT_FUNCTIONS];
        for (size_t a = 0; a < m; a++)
            for (size_t j = 0; j < n; j++) {
                double sum = 0.0;
                for (size_t b = 0; b < n; b++)
                    sum += ev[j * n + b] * moments[a * n + b];
                half[a * n + j] = sum;
            }
        for (size_t i = 0; i < m; i++) {
            double *row = rows + element->first + i * element->stride;
            const double *w = element->weight ? element->weight + i * element->stride : NULL;
            for (size_t j = 0; j < n; j++) {
                double sum = 0.0;
                for (size_t a = 0; a < m; a++)
                    sum += eu[i * m + a] * half[a * n + j];
                row[j] += w ? w[j] * sum : sum;
            }
        }
    }
}

void element_gather(const struct element *element, const double *coefficients, double *out)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *eu = element->extraction[0], *ev = element->extraction[1];
    double half[ELEMENT_FUNCTIONS] = {0};
    for (size_t i = 0; i < m; i++) {
        const double *row = coefficients + element->first + i * element->stride;
        const double *w = element->weight ? element->weight + i * element->stride : NULL;
        for (size_t b = 0; b < n; b++) {
            double sum = 0.0;
            for (size_t j = 0; j < n; j++)
                sum += ev[j * n + b] * (w ? w[j] * row[j] : row[j]);
            for (size_t a = 0; a < m; a++)
                half[a * n + b] += eu[i * m + a] * sum;
        }
    }
    memcpy(out, half, m * n * sizeof *out);
}

VECTOR_MULTIVERSION
void element_controls(const struct element *element, const double *factor, double *point)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    const double *su = element->shape[0], *sv = element->shape[1];
    double half[ELEMENT_FUNCTIONS];
    for (size_t a = 0; a < m; a++)
        for (size_t j = 0; j < n; j++) {
            double sum = 0.0;
            for (size_t b = 0; b < n; b++)
                sum += sv[j * n + b] * factor[a * n + b];
            half[a * n + j] = sum;
        }
    for (size_t i = 0; i < m; i++) {
        size_t corner = i * element->control_stride;
        double *row = point + element->control + corner, sum[ELEMENT_SIDE] = {0.0};
        for (size_t a = 0; a < m; a++)
            for (size_t j = 0; j < n; j++)
                sum[j] += su[i * m + a] * half[a * n + j];
        for (size_t j = 0; j < n; j++)
            row[j] += element->shape_weight ? element->shape_weight[corner + j] * sum[j] : sum[j];
    }
}

const struct element *mesh_locate(const struct mesh *mesh, size_t patch, const double uv[2],
                                  double local[2])
{
    const struct element *element = NULL;
    for (size_t e = mesh->patch_base[patch]; e < mesh->patch_base[patch + 1]; e++) {
        bool inside = true;
        element = &mesh->element[e];
        for (int d = 0; d < 2; d++) {
            local[d] = (uv[d] - element->lower[d]) / (element->upper[d] - element->lower[d]);
            inside = inside && local[d] >= -1e-12 && local[d] <= 1.0 + 1e-12;
        }
        if (inside)
            break;
    }
    return element;
}

void element_slope(const struct element *element, const double *coefficients, const double local[2],
                   double slope[2])
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    double field[ELEMENT_FUNCTIONS], bu[ELEMENT_SIDE], du[ELEMENT_SIDE], bv[ELEMENT_SIDE],
        dv[ELEMENT_SIDE], f[3] = {0}, w[3] = {0};
    element_gather(element, coefficients, field);
    bernstein(element->degree[0], local[0], bu, du);
    bernstein(element->degree[1], local[1], bv, dv);
    for (size_t a = 0; a < m; a++)
        for (size_t b = 0; b < n; b++) {
            const double basis[3] = {bu[a] * bv[b], du[a] * bv[b], bu[a] * dv[b]};
            double weight = element->rational ? element->net[4 * (a * n + b) + 3] : 1.0;
            for (size_t k = 0; k < 3; k++) {
                f[k] += basis[k] * field[a * n + b];
                w[k] += basis[k] * weight;
            }
        }
    for (size_t d = 0; d < 2; d++)
        slope[d] = (f[d + 1] - f[0] / w[0] * w[d + 1]) / w[0];
}

/* Solves A x = b for `columns` right-hand sides, n <= ELEMENT_SIDE, partial pivoting; the Bernstein
 * matrix at Chebyshev points is far from singular. */
static void solve_small(size_t n, double *a, size_t columns, double *b)
{
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        for (size_t i = k + 1; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[pivot * n + k]))
                pivot = i;
        for (size_t j = 0; j < n; j++) {
            double swap = a[k * n + j];
            a[k * n + j] = a[pivot * n + j];
            a[pivot * n + j] = swap;
        }
        for (size_t j = 0; j < columns; j++) {
            double swap = b[k * columns + j];
            b[k * columns + j] = b[pivot * columns + j];
            b[pivot * columns + j] = swap;
        }
        for (size_t i = 0; i < n; i++) {
            if (i == k)
                continue;
            double factor = a[i * n + k] / a[k * n + k];
            for (size_t j = k; j < n; j++)
                a[i * n + j] -= factor * a[k * n + j];
            for (size_t j = 0; j < columns; j++)
                b[i * columns + j] -= factor * b[k * columns + j];
        }
    }
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < columns; j++)
            b[k * columns + j] /= a[k * n + k];
}

/* Extraction matrix of one span: the spline functions sampled at Chebyshev points of the span,
 * expressed in Bernstein polynomials. */
static void extraction_matrix(int degree, const double *knots, size_t span, double lower,
                              double upper, double *extraction)
{
    size_t n = (size_t)degree + 1;
    double matrix[ELEMENT_FUNCTIONS], values[ELEMENT_FUNCTIONS];
    for (size_t k = 0; k < n; k++) {
        double s = 0.5 - 0.5 * cos(PI * ((double)k + 0.5) / (double)n);
        bernstein(degree, s, matrix + k * n, NULL);
        nurbs_basis(degree, knots, span, lower + (upper - lower) * s, values + k * n);
    }
    solve_small(n, matrix, n, values);
    for (size_t a = 0; a < n; a++)
        for (size_t k = 0; k < n; k++)
            extraction[a * n + k] = values[k * n + a];
}

/* Bezier points of the shape over one span of its own knots; corner: its first control point. */
static void bezier_net(const struct element *element, const nurbs_surface *surface, size_t corner,
                       const double *shape[2], double *net)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    size_t stride = nurbs_surface_size(surface, 1);
    const double *points = nurbs_surface_points(surface), *weights = nurbs_surface_weights(surface);
    memset(net, 0, 4 * m * n * sizeof *net);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++) {
            size_t at = corner + i * stride + j;
            const double *point = points + 3 * at;
            double w = weights ? weights[at] : 1.0;
            for (size_t a = 0; a < m; a++)
                for (size_t b = 0; b < n; b++) {
                    double e = w * shape[0][i * m + a] * shape[1][j * n + b];
                    double *out = net + 4 * (a * n + b);
                    for (size_t c = 0; c < 3; c++)
                        out[c] += e * point[c];
                    out[3] += e;
                }
        }
}

static void bounding_box(struct element *element)
{
    size_t n = (size_t)(element->degree[0] + 1) * (size_t)(element->degree[1] + 1);
    for (size_t c = 0; c < 3; c++) {
        element->box[0][c] = INFINITY;
        element->box[1][c] = -INFINITY;
        for (size_t k = 0; k < n; k++) {
            double x = element->net[4 * k + c] / element->net[4 * k + 3];
            element->box[0][c] = fmin(element->box[0][c], x);
            element->box[1][c] = fmax(element->box[1][c], x);
        }
    }
}

/* Extraction of density and shape over every span of one direction, and their first functions. */
struct extraction {
    const double *density, *shape;
    size_t density_first, shape_first;
};

static void extract_direction(const struct density_patch *patch, int d, double **storage,
                              struct extraction *extraction)
{
    size_t p = (size_t)patch->degree[d], block = (p + 1) * (p + 1);
    const double *shape_knots = nurbs_surface_knots(patch->surface, d);
    for (size_t k = 0; k < patch->spans[d]; k++) {
        double lower = patch->breaks[d][k], upper = patch->breaks[d][k + 1];
        double middle = 0.5 * (lower + upper);
        size_t density = nurbs_basis_span((int)p, patch->size[d], patch->knots[d], middle, NULL);
        size_t shape = nurbs_basis_span((int)p, nurbs_surface_size(patch->surface, d), shape_knots,
                                        middle, NULL);
        extraction_matrix((int)p, patch->knots[d], density, lower, upper, *storage);
        extraction_matrix((int)p, shape_knots, shape, lower, upper, *storage + block);
        extraction[k] = (struct extraction){*storage, *storage + block, density - p, shape - p};
        *storage += 2 * block;
    }
}

static void fill_element(const struct density_patch *patch, const nurbs_surface *surface,
                         size_t index, size_t base, const struct extraction *u,
                         const struct extraction *v, size_t k, size_t l, double **storage,
                         struct element *element)
{
    size_t corner = u->density_first * patch->size[1] + v->density_first;
    size_t shape = u->shape_first * nurbs_surface_size(surface, 1) + v->shape_first;
    const double *extraction[2] = {u->shape, v->shape};
    *element = (struct element){
        .patch = index,
        .degree = {patch->degree[0], patch->degree[1]},
        .lower = {patch->breaks[0][k], patch->breaks[1][l]},
        .upper = {patch->breaks[0][k + 1], patch->breaks[1][l + 1]},
        .extraction = {u->density, v->density},
        .weight = patch->weights ? patch->weights + corner : NULL,
        .net = *storage,
        .first = patch->offset + corner,
        .stride = patch->size[1],
        .shape = {u->shape, v->shape},
        .shape_weight = nurbs_surface_weights(patch->surface)
                            ? nurbs_surface_weights(patch->surface) + shape
                            : NULL,
        .control = base + shape,
        .control_stride = nurbs_surface_size(surface, 1),
        .rational = patch->weights != NULL,
        .sign = patch->hull.sign,
    };
    bezier_net(element, surface, shape, extraction, *storage);
    bounding_box(element);
    *storage += 4 * (size_t)(patch->degree[0] + 1) * (size_t)(patch->degree[1] + 1);
}

/* Range of the elements of one direction that make up a panel. */
static void panel_range(const struct density_patch *patch, int d, size_t panel, size_t range[2])
{
    const double *breaks = patch->breaks[d], *ends = patch->panel_breaks[d];
    range[0] = 0;
    while (breaks[range[0]] < ends[panel])
        range[0]++;
    range[1] = range[0];
    while (breaks[range[1]] < ends[panel + 1])
        range[1]++;
}

static igabem_status fill_patch(const struct density *density, const nurbs_surface *surface,
                                size_t index, size_t base, struct mesh *mesh, double **storage)
{
    const struct density_patch *patch = &density->patch[index];
    struct extraction *u = malloc((patch->spans[0] + patch->spans[1]) * sizeof *u);
    if (!u)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the elements");
    struct extraction *v = u + patch->spans[0];
    extract_direction(patch, 0, storage, u);
    extract_direction(patch, 1, storage, v);
    for (size_t a = 0; a < patch->panels[0]; a++)
        for (size_t b = 0; b < patch->panels[1]; b++) {
            size_t range_u[2], range_v[2];
            panel_range(patch, 0, a, range_u);
            panel_range(patch, 1, b, range_v);
            struct panel *panel = &mesh->panel[mesh->panels++];
            *panel = (struct panel){
                .first = mesh->n,
                .lower = {patch->panel_breaks[0][a], patch->panel_breaks[1][b]},
                .upper = {patch->panel_breaks[0][a + 1], patch->panel_breaks[1][b + 1]}};
            for (size_t k = range_u[0]; k < range_u[1]; k++)
                for (size_t l = range_v[0]; l < range_v[1]; l++)
                    fill_element(patch, surface, index, base, &u[k], &v[l], k, l, storage,
                                 &mesh->element[mesh->n++]);
            panel->count = mesh->n - panel->first;
        }
    free(u);
    return IGABEM_OK;
}

igabem_status mesh_create(const struct density *density, struct mesh **result)
{
    return mesh_create_on(density, NULL, result);
}

igabem_status mesh_create_on(const struct density *density, const nurbs_surface *const *surface,
                             struct mesh **result)
{
    *result = NULL;
    size_t elements = 0, panels = 0, doubles = 0;
    struct mesh *mesh = calloc(1, sizeof *mesh);
    if (mesh)
        mesh->patch_base = calloc(density->patches + 1, sizeof *mesh->patch_base);
    if (!mesh || !mesh->patch_base) {
        mesh_free(mesh);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the elements");
    }
    for (size_t k = 0; k < density->patches; k++) {
        const struct density_patch *patch = &density->patch[k];
        size_t side[2], spans = patch->spans[0] * patch->spans[1];
        for (int d = 0; d < 2; d++) {
            side[d] = (size_t)patch->degree[d] + 1;
            doubles += 2 * patch->spans[d] * side[d] * side[d];
            if ((size_t)patch->degree[d] > mesh->degree[d])
                mesh->degree[d] = (size_t)patch->degree[d];
        }
        mesh->patch_base[k] = elements;
        elements += spans;
        panels += patch->panels[0] * patch->panels[1];
        doubles += 4 * spans * side[0] * side[1];
    }
    mesh->patch_base[density->patches] = elements;
    mesh->element = calloc(elements, sizeof *mesh->element);
    mesh->panel = calloc(panels, sizeof *mesh->panel);
    mesh->storage = malloc(doubles * sizeof *mesh->storage);
    igabem_status status = IGABEM_OK;
    if (!mesh->element || !mesh->panel || !mesh->storage)
        status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu elements", elements);
    double *storage = mesh->storage;
    size_t base = 0;
    for (size_t k = 0; k < density->patches && status == IGABEM_OK; k++) {
        const nurbs_surface *own = surface ? surface[k] : density->patch[k].surface;
        status = fill_patch(density, own, k, base, mesh, &storage);
        base += nurbs_surface_size(own, 0) * nurbs_surface_size(own, 1);
    }
    if (status != IGABEM_OK) {
        mesh_free(mesh);
        return status;
    }
    *result = mesh;
    return IGABEM_OK;
}

void mesh_free(struct mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->element);
    free(mesh->panel);
    free(mesh->storage);
    free(mesh->patch_base);
    free(mesh);
}
