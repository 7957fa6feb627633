#include "core/axis_basis.h"
#include "core/error.h"
#include "core/object.h"
#include "core/surface_derivatives.h"

#include <string.h>

/* One homogeneous point; the compiler maps it to the vector registers of the machine. */
typedef double quad __attribute__((vector_size(32)));

enum {
    MAX_WIDTH = NURBS_MAX_DEGREE + 1,
    GRID_DOUBLES = 3 * MAX_WIDTH * 16, /* basis values of one block of grid columns */
    GRID_COLUMNS = 128
};

/* Homogeneous sums in the order of the public triples: S, Su, Sv, Suu, Suv, Svv. */
NURBS_INLINE void project(int order, const quad *h, double *out)
{
    const double w = 1.0 / h[0][3];
    double s[6][3];
    for (int c = 0; c < 3; c++)
        s[0][c] = h[0][c] * w;
    if (order >= 1)
        for (int c = 0; c < 3; c++) {
            s[1][c] = (h[1][c] - h[1][3] * s[0][c]) * w;
            s[2][c] = (h[2][c] - h[2][3] * s[0][c]) * w;
        }
    if (order >= 2)
        for (int c = 0; c < 3; c++) {
            s[3][c] = (h[3][c] - 2.0 * h[1][3] * s[1][c] - h[3][3] * s[0][c]) * w;
            s[4][c] = (h[4][c] - h[1][3] * s[2][c] - h[2][3] * s[1][c] - h[4][3] * s[0][c]) * w;
            s[5][c] = (h[5][c] - 2.0 * h[2][3] * s[2][c] - h[5][3] * s[0][c]) * w;
        }
    memcpy(out, s, (size_t)NURBS_SURFACE_TRIPLES(order) * 3 * sizeof(double));
}

NURBS_INLINE void store(int order, int rational, const quad *h, double *out)
{
    if (rational) {
        project(order, h, out);
        return;
    }
    for (int k = 0; k < NURBS_SURFACE_TRIPLES(order); k++)
        for (int c = 0; c < 3; c++)
            out[3 * k + c] = h[k][c];
}

NURBS_INLINE void load(const double *p, quad *q)
{
    memcpy(q, p, sizeof *q);
}

NURBS_INLINE void evaluate_one(const nurbs_surface *s, int pu, int pv, int order, int rational,
                               const size_t span[2], const double *uv, double *out)
{
    double bu[3 * MAX_WIDTH], bv[3 * MAX_WIDTH];
    axis_basis(&s->axis[0], pu, span[0], uv[0], order, bu);
    axis_basis(&s->axis[1], pv, span[1], uv[1], order, bv);
    const size_t stride = 4 * s->axis[1].size;
    const double *net = s->net + (span[0] - (size_t)pu) * stride + 4 * (span[1] - (size_t)pv);
    const int wu = pu + 1, wv = pv + 1;
    quad h[6];
    memset(h, 0, sizeof h);
    for (int a = 0; a < wu; a++, net += stride) {
        quad row[3];
        memset(row, 0, sizeof row);
        for (int b = 0; b < wv; b++) {
            quad point;
            load(net + 4 * b, &point);
            for (int k = 0; k <= order; k++)
                row[k] += bv[k * wv + b] * point;
        }
        h[0] += bu[a] * row[0];
        if (order >= 1) {
            h[1] += bu[wu + a] * row[0];
            h[2] += bu[a] * row[1];
        }
        if (order >= 2) {
            h[3] += bu[2 * wu + a] * row[0];
            h[4] += bu[wu + a] * row[1];
            h[5] += bu[a] * row[2];
        }
    }
    store(order, rational, h, out);
}

static nurbs_status outside(const nurbs_surface *s, int direction, size_t index, double value)
{
    const struct axis *axis = &s->axis[direction];
    return nurbs_fail(NURBS_ERROR_ARGUMENT,
                      "parameter %zu has %c = %.17g, outside the domain from %.17g to %.17g", index,
                      "uv"[direction], value, axis -> knots[0], axis -> knots[axis->size]);
}

static int inside(const struct axis *axis, double value)
{
    return value >= axis->knots[0] && value <= axis->knots[axis->size];
}

/* Returns 0 outside the domain. */
NURBS_INLINE int find_spans(const nurbs_surface *s, unsigned left, const double *uv, size_t span[2])
{
    for (int d = 0; d < 2; d++) {
        const struct axis *axis = &s->axis[d];
        if (!inside(axis, uv[d]))
            return 0;
        span[d] = axis_span(axis, uv[d]);
        if (left & (1U << d))
            span[d] = axis_span_left(axis, span[d], uv[d]);
    }
    return 1;
}

/* Returns the number of points done: less than n where a parameter is outside the domain. */
NURBS_INLINE size_t evaluate_all(const nurbs_surface *s, int pu, int pv, int order, int rational,
                                 unsigned left, size_t n, const double *uv, double *out)
{
    const size_t stride = 3 * (size_t)NURBS_SURFACE_TRIPLES(order);
    for (size_t i = 0; i < n; i++) {
        size_t span[2];
        if (!find_spans(s, left, uv + 2 * i, span))
            return i;
        evaluate_one(s, pu, pv, order, rational, span, uv + 2 * i, out + i * stride);
    }
    return n;
}

NURBS_MULTIVERSION
static size_t evaluate_cubic(const nurbs_surface *s, int order, unsigned left, size_t n,
                             const double *uv, double *out)
{
    if (s->weights)
        return order == 0   ? evaluate_all(s, 3, 3, 0, 1, left, n, uv, out)
               : order == 1 ? evaluate_all(s, 3, 3, 1, 1, left, n, uv, out)
                            : evaluate_all(s, 3, 3, 2, 1, left, n, uv, out);
    return order == 0   ? evaluate_all(s, 3, 3, 0, 0, left, n, uv, out)
           : order == 1 ? evaluate_all(s, 3, 3, 1, 0, left, n, uv, out)
                        : evaluate_all(s, 3, 3, 2, 0, left, n, uv, out);
}

NURBS_MULTIVERSION
static size_t evaluate_any(const nurbs_surface *s, int order, unsigned left, size_t n,
                           const double *uv, double *out)
{
    return evaluate_all(s, s->axis[0].degree, s->axis[1].degree, order, s->weights != NULL, left, n,
                        uv, out);
}

static nurbs_status eval_check(const nurbs_surface *surface, int order, int highest, const void *in,
                               const void *out)
{
    if (!surface || !in || !out)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL",
                          !surface ? "surface"
                          : !in    ? "the parameter array"
                                   : "out");
    if (order < 0 || order > highest)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "derivative order is %d, expected 0 to %d", order,
                          highest);
    return NURBS_OK;
}

/* As evaluate_all, any order. */
static size_t evaluate_high(const nurbs_surface *s, int order, unsigned left, size_t n,
                            const double *uv, double *out)
{
    const size_t stride = 3 * (size_t)NURBS_SURFACE_TRIPLES(order);
    for (size_t i = 0; i < n; i++) {
        size_t span[2];
        if (!find_spans(s, left, uv + 2 * i, span))
            return i;
        surface_derivatives(s, order, span, uv + 2 * i, out + i * stride);
    }
    return n;
}

nurbs_status nurbs_surface_eval_sided(const nurbs_surface *surface, int order, unsigned left,
                                      size_t n, const double *uv, double *out)
{
    if (n == 0)
        return NURBS_OK;
    nurbs_status status = eval_check(surface, order, SURFACE_MAX_ORDER, uv, out);
    if (status != NURBS_OK)
        return status;
    const int cubic = surface->axis[0].degree == 3 && surface->axis[1].degree == 3;
    const size_t done = order > 2 ? evaluate_high(surface, order, left, n, uv, out)
                        : cubic   ? evaluate_cubic(surface, order, left, n, uv, out)
                                  : evaluate_any(surface, order, left, n, uv, out);
    if (done == n)
        return NURBS_OK;
    const int direction = inside(&surface->axis[0], uv[2 * done]) ? 1 : 0;
    return outside(surface, direction, done, uv[2 * done + (size_t)direction]);
}

nurbs_status nurbs_surface_eval(const nurbs_surface *surface, int order, size_t n, const double *uv,
                                double *out)
{
    return nurbs_surface_eval_sided(surface, order, 0, n, uv, out);
}

/* Sums the net over u for the pv + 1 columns of one v span: column[b][k], k the u derivative. */
NURBS_INLINE void contract_u(const nurbs_surface *s, int pu, int pv, int order, size_t span_u,
                             size_t span_v, const double *bu, quad *column)
{
    const size_t stride = 4 * s->axis[1].size;
    const double *net = s->net + (span_u - (size_t)pu) * stride + 4 * (span_v - (size_t)pv);
    for (int b = 0; b <= pv; b++) {
        quad sum[3];
        memset(sum, 0, sizeof sum);
        for (int a = 0; a <= pu; a++) {
            quad point;
            load(net + (size_t)a * stride + 4 * b, &point);
            for (int k = 0; k <= order; k++)
                sum[k] += bu[k * (pu + 1) + a] * point;
        }
        for (int k = 0; k <= order; k++)
            column[b * (order + 1) + k] = sum[k];
    }
}

/* One row of one block of grid columns. */
NURBS_INLINE void grid_row(const nurbs_surface *s, int pu, int pv, int order, int rational,
                           double u, size_t columns, const size_t *span_v, const double *bv,
                           double *out)
{
    const int wv = pv + 1, rows = order + 1;
    const size_t stride = 3 * (size_t)NURBS_SURFACE_TRIPLES(order);
    double bu[3 * MAX_WIDTH];
    quad column[3 * MAX_WIDTH];
    const size_t span_u = axis_span(&s->axis[0], u);
    axis_basis(&s->axis[0], pu, span_u, u, order, bu);
    size_t current = SIZE_MAX;
    for (size_t j = 0; j < columns; j++, bv += rows * wv) {
        if (span_v[j] != current) {
            current = span_v[j];
            contract_u(s, pu, pv, order, span_u, current, bu, column);
        }
        quad h[6];
        memset(h, 0, sizeof h);
        for (int b = 0; b < wv; b++) {
            const quad *sum = column + b * rows;
            h[0] += bv[b] * sum[0];
            if (order >= 1) {
                h[1] += bv[b] * sum[1];
                h[2] += bv[wv + b] * sum[0];
            }
            if (order >= 2) {
                h[3] += bv[b] * sum[2];
                h[4] += bv[wv + b] * sum[1];
                h[5] += bv[2 * wv + b] * sum[0];
            }
        }
        store(order, rational, h, out + j * stride);
    }
}

NURBS_INLINE void grid_all(const nurbs_surface *s, int pu, int pv, int order, int rational,
                           size_t nu, const double *u, size_t nv, const double *v, double *out)
{
    const size_t stride = 3 * (size_t)NURBS_SURFACE_TRIPLES(order);
    const size_t values = (size_t)((order + 1) * (pv + 1));
    const size_t fit = GRID_DOUBLES / values;
    const size_t block = fit < GRID_COLUMNS ? fit : GRID_COLUMNS;
    double bv[GRID_DOUBLES];
    size_t span_v[GRID_COLUMNS];
    for (size_t first = 0; first < nv; first += block) {
        const size_t columns = nv - first < block ? nv - first : block;
        for (size_t j = 0; j < columns; j++) {
            span_v[j] = axis_span(&s->axis[1], v[first + j]);
            axis_basis(&s->axis[1], pv, span_v[j], v[first + j], order, bv + j * values);
        }
        for (size_t i = 0; i < nu; i++)
            grid_row(s, pu, pv, order, rational, u[i], columns, span_v, bv,
                     out + (i * nv + first) * stride);
    }
}

NURBS_MULTIVERSION
static void grid_cubic(const nurbs_surface *s, int order, size_t nu, const double *u, size_t nv,
                       const double *v, double *out)
{
    if (s->weights) {
        if (order == 0)
            grid_all(s, 3, 3, 0, 1, nu, u, nv, v, out);
        else if (order == 1)
            grid_all(s, 3, 3, 1, 1, nu, u, nv, v, out);
        else
            grid_all(s, 3, 3, 2, 1, nu, u, nv, v, out);
    } else {
        if (order == 0)
            grid_all(s, 3, 3, 0, 0, nu, u, nv, v, out);
        else if (order == 1)
            grid_all(s, 3, 3, 1, 0, nu, u, nv, v, out);
        else
            grid_all(s, 3, 3, 2, 0, nu, u, nv, v, out);
    }
}

NURBS_MULTIVERSION
static void grid_any(const nurbs_surface *s, int order, size_t nu, const double *u, size_t nv,
                     const double *v, double *out)
{
    grid_all(s, s->axis[0].degree, s->axis[1].degree, order, s->weights != NULL, nu, u, nv, v, out);
}

nurbs_status nurbs_surface_eval_grid(const nurbs_surface *surface, int order, size_t nu,
                                     const double *u, size_t nv, const double *v, double *out)
{
    if (nu == 0 || nv == 0)
        return NURBS_OK;
    nurbs_status status = eval_check(surface, order, SURFACE_MAX_ORDER, u && v ? u : NULL, out);
    if (status != NURBS_OK)
        return status;
    const double *const at[2] = {u, v};
    const size_t count[2] = {nu, nv};
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < count[d]; i++) {
            if (!inside(&surface->axis[d], at[d][i]))
                return outside(surface, d, i, at[d][i]);
            if (i > 0 && at[d][i] < at[d][i - 1])
                return nurbs_fail(NURBS_ERROR_ARGUMENT,
                                  "grid parameter %c decreases at %zu: %.17g after %.17g", "uv"[d],
                                  i, at[d][i], at[d][i - 1]);
        }
    if (order > 2)
        for (size_t k = 0; k < nu * nv; k++)
            evaluate_high(surface, order, 0, 1, (const double[]){u[k / nv], v[k % nv]},
                          out + k * 3 * (size_t)NURBS_SURFACE_TRIPLES(order));
    else if (surface->axis[0].degree == 3 && surface->axis[1].degree == 3)
        grid_cubic(surface, order, nu, u, nv, v, out);
    else
        grid_any(surface, order, nu, u, nv, v, out);
    return NURBS_OK;
}

/* R = w N / W and its derivatives, from products N already in values: the quotient rule for each
 * function, with W and its derivatives the sums over all of them. */
static void make_rational(int order, size_t count, const double *w, double *values)
{
    double sum[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int k = 0; k < NURBS_SURFACE_TRIPLES(order); k++)
        for (size_t i = 0; i < count; i++) {
            values[(size_t)k * count + i] *= w[i];
            sum[k] += values[(size_t)k * count + i];
        }
    double *r = values;
    for (size_t i = 0; i < count; i++, r++) {
        r[0] /= sum[0];
        if (order >= 1) {
            r[count] = (r[count] - sum[1] * r[0]) / sum[0];
            r[2 * count] = (r[2 * count] - sum[2] * r[0]) / sum[0];
        }
        if (order >= 2) {
            r[3 * count] = (r[3 * count] - 2.0 * sum[1] * r[count] - sum[3] * r[0]) / sum[0];
            r[4 * count] =
                (r[4 * count] - sum[1] * r[2 * count] - sum[2] * r[count] - sum[4] * r[0]) / sum[0];
            r[5 * count] = (r[5 * count] - 2.0 * sum[2] * r[2 * count] - sum[5] * r[0]) / sum[0];
        }
    }
}

nurbs_status nurbs_surface_basis(const nurbs_surface *surface, int order, double u, double v,
                                 size_t span[2], double *values)
{
    nurbs_status status = eval_check(surface, order, 2, span, values);
    if (status != NURBS_OK)
        return status;
    const double at[2] = {u, v};
    double basis[2][3 * MAX_WIDTH];
    for (int d = 0; d < 2; d++) {
        const struct axis *axis = &surface->axis[d];
        if (!inside(axis, at[d]))
            return outside(surface, d, 0, at[d]);
        span[d] = axis_span(axis, at[d]);
        axis_basis(axis, axis->degree, span[d], at[d], order, basis[d]);
    }
    static const int du[6] = {0, 1, 0, 2, 1, 0}, dv[6] = {0, 0, 1, 0, 1, 2};
    const size_t pu = (size_t)surface->axis[0].degree, pv = (size_t)surface->axis[1].degree;
    const size_t wu = pu + 1, wv = pv + 1, count = wu * wv;
    for (int k = 0; k < NURBS_SURFACE_TRIPLES(order); k++)
        for (size_t a = 0; a < wu; a++)
            for (size_t b = 0; b < wv; b++)
                values[(size_t)k * count + a * wv + b] =
                    basis[0][(size_t)du[k] * wu + a] * basis[1][(size_t)dv[k] * wv + b];
    if (!surface->weights)
        return NURBS_OK;
    double w[MAX_WIDTH * MAX_WIDTH];
    for (size_t a = 0; a < wu; a++)
        for (size_t b = 0; b < wv; b++)
            w[a * wv + b] =
                surface->weights[(span[0] - pu + a) * surface->axis[1].size + span[1] - pv + b];
    make_rational(order, count, w, values);
    return NURBS_OK;
}

nurbs_status nurbs_surface_rows(const nurbs_surface *surface, int order, size_t n, const double *uv,
                                size_t *columns, double *values)
{
    if (n == 0)
        return NURBS_OK;
    nurbs_status status = eval_check(surface, order, 2, uv && columns ? uv : NULL, values);
    if (status != NURBS_OK)
        return status;
    const size_t pu = (size_t)surface->axis[0].degree, pv = (size_t)surface->axis[1].degree;
    const size_t count = (pu + 1) * (pv + 1);
    for (size_t i = 0; i < n; i++, values += (size_t)NURBS_SURFACE_TRIPLES(order) * count) {
        for (int d = 0; d < 2; d++)
            if (!inside(&surface->axis[d], uv[2 * i + (size_t)d]))
                return outside(surface, d, i, uv[2 * i + (size_t)d]);
        size_t span[2];
        status = nurbs_surface_basis(surface, order, uv[2 * i], uv[2 * i + 1], span, values);
        if (status != NURBS_OK)
            return status;
        for (size_t a = 0; a <= pu; a++)
            for (size_t b = 0; b <= pv; b++)
                *columns++ = (span[0] - pu + a) * surface->axis[1].size + span[1] - pv + b;
    }
    return NURBS_OK;
}
