#include "core/axis_basis.h"
#include "core/error.h"
#include "core/object.h"

/* C^(k) = (A^(k) - sum_{i=1..k} binomial(k,i) w^(i) C^(k-i)) / w, The NURBS Book eq. 4.8. Row k of
 * out holds A^(k) on entry. */
static void project(int order, const double *w, double *out)
{
    for (int k = 0; k <= order; k++) {
        double binomial = 1.0;
        for (int i = 1; i <= k; i++) {
            binomial = binomial * (k - i + 1) / i;
            for (int c = 0; c < 3; c++)
                out[3 * k + c] -= binomial * w[i] * out[3 * (k - i) + c];
        }
        for (int c = 0; c < 3; c++)
            out[3 * k + c] /= w[0];
    }
}

/* Highest derivative order of rational curves. */
enum { MAX_ORDER = 2 * NURBS_MAX_DEGREE };

NURBS_INLINE void evaluate_one(const nurbs_curve *curve, int degree, int order, size_t span,
                               double u, double *out)
{
    const int kept = order < degree ? order : degree;
    double basis[(NURBS_MAX_DEGREE + 1) * (NURBS_MAX_DEGREE + 1)];
    double w[MAX_ORDER + 1];
    axis_basis(&curve->axis, degree, span, u, kept, basis);
    const double *net = curve->net + 4 * (span - (size_t)degree);
    for (int k = 0; k <= order; k++) {
        double sum[4] = {0.0, 0.0, 0.0, 0.0};
        for (int r = 0; k <= kept && r <= degree; r++)
            for (int c = 0; c < 4; c++)
                sum[c] += basis[k * (degree + 1) + r] * net[4 * r + c];
        for (int c = 0; c < 3; c++)
            out[3 * k + c] = sum[c];
        if (curve->weights)
            w[k] = sum[3];
    }
    if (curve->weights)
        project(order, w, out);
}

NURBS_MULTIVERSION
static void evaluate_cubic(const nurbs_curve *curve, int order, size_t span, double u, double *out)
{
    evaluate_one(curve, 3, order, span, u, out);
}

NURBS_MULTIVERSION
static void evaluate_any(const nurbs_curve *curve, int order, size_t span, double u, double *out)
{
    evaluate_one(curve, curve->axis.degree, order, span, u, out);
}

static nurbs_status evaluate(const nurbs_curve *curve, int order, size_t n, const double *u,
                             int from_left, double *out)
{
    if (!curve || (n && (!u || !out)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%s is NULL", !curve ? "curve" : !u ? "u" : "out");
    if (order < 0 || order > MAX_ORDER)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "derivative order is %d, expected 0 to %d", order,
                          MAX_ORDER);
    const struct axis *axis = &curve->axis;
    const double begin = axis->knots[0], end = axis->knots[axis->size];
    const size_t stride = 3 * ((size_t)order + 1);
    for (size_t i = 0; i < n; i++) {
        if (!(u[i] >= begin && u[i] <= end))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "parameter %zu is %.17g, outside the domain from %.17g to %.17g", i,
                              u[i], begin, end);
        size_t span = axis_span(axis, u[i]);
        if (from_left)
            span = axis_span_left(axis, span, u[i]);
        if (axis->degree == 3)
            evaluate_cubic(curve, order, span, u[i], out + i * stride);
        else
            evaluate_any(curve, order, span, u[i], out + i * stride);
    }
    return NURBS_OK;
}

nurbs_status nurbs_curve_eval(const nurbs_curve *curve, int order, size_t n, const double *u,
                              double *out)
{
    return evaluate(curve, order, n, u, 0, out);
}

nurbs_status nurbs_curve_eval_left(const nurbs_curve *curve, int order, size_t n, const double *u,
                                   double *out)
{
    return evaluate(curve, order, n, u, 1, out);
}
