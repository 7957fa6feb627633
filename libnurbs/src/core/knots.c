#include "core/error.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdint.h>

nurbs_status nurbs_knots_check(int degree, size_t n, const double *knots)
{
    if (degree < 0 || degree > NURBS_MAX_DEGREE)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "degree is %d, expected 0 to %d", degree,
                          NURBS_MAX_DEGREE);
    const size_t p = (size_t)degree;
    if (n <= p)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "%zu control points of degree %d, expected at least %zu", n, degree,
                          p + 1);
    if (n > SIZE_MAX / 64)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu control points are too many", n);
    if (!knots)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "knots is NULL, expected %zu knots", n + p + 1);

    size_t multiplicity = 0;
    for (size_t i = 0; i < n + p + 1; i++) {
        if (!isfinite(knots[i]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "knot %zu is %g, expected a finite number", i,
                              knots[i]);
        if (i > 0 && knots[i] < knots[i - 1])
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "knot %zu decreases: %.17g after %.17g", i,
                              knots[i], knots[i - 1]);
        if (i > 0 && knots[i] > knots[i - 1] && !isfinite(1.0 / (knots[i] - knots[i - 1])))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "knots %zu and %zu differ by %g, too little to divide by", i - 1, i,
                              knots[i] - knots[i - 1]);
        multiplicity = i > 0 && knots[i] == knots[i - 1] ? multiplicity + 1 : 1;
        if (multiplicity > p + 1)
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "knot %zu (%.17g) has a multiplicity above %zu (degree + 1)", i,
                              knots[i], p + 1);
        if (i == p && multiplicity != p + 1)
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "the first %zu knots differ (%.17g to %.17g), expected a clamped "
                              "knot vector",
                              p + 1, knots[0], knots[p]);
    }
    if (multiplicity != p + 1)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "the last %zu knots differ (%.17g to %.17g), expected a clamped knot "
                          "vector",
                          p + 1, knots[n], knots[n + p]);
    const double length = knots[n] - knots[p];
    if (!isfinite(length) || !isfinite(1.0 / length))
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "the domain from %g to %g has no usable length in double precision",
                          knots[p], knots[n]);
    return NURBS_OK;
}

size_t nurbs_basis_span(int degree, size_t n, const double *knots, double u, size_t *hint)
{
    if (!knots)
        return 0;
    size_t low = (size_t)degree, high = n; /* knots[low] <= u < knots[high] once clamped */
    if (!(u >= knots[low]))
        u = knots[low];
    if (u >= knots[high]) {
        if (hint)
            *hint = n - 1;
        return n - 1;
    }
    if (hint && *hint >= low && *hint < n) {
        const size_t s = *hint;
        if (u >= knots[s]) {
            if (u < knots[s + 1])
                return s;
            low = s + 1;
            if (u < knots[s + 2]) /* exists: u lies before knots[n], so s + 1 < n */
                high = s + 2;
        } else {
            high = s;
            if (u >= knots[s - 1]) /* exists: u lies after knots[degree], so s > degree */
                low = s - 1;
        }
    }
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (u < knots[middle])
            high = middle;
        else
            low = middle;
    }
    if (hint)
        *hint = low;
    return low;
}

void nurbs_greville(int degree, size_t n, const double *knots, double *greville)
{
    if (!knots || !greville)
        return;
    for (size_t i = 0; i < n; i++) {
        if (degree == 0) {
            greville[i] = 0.5 * (knots[i] + knots[i + 1]);
            continue;
        }
        /* Averaging offsets from the middle knot keeps equal knots exact. */
        const double base = knots[i + 1 + (size_t)degree / 2];
        double sum = 0.0;
        for (int k = 1; k <= degree; k++)
            sum += knots[i + (size_t)k] - base;
        greville[i] = base + sum / degree;
    }
}

size_t nurbs_knots_distinct(int degree, size_t n, const double *knots, double *breaks,
                            int *multiplicities)
{
    if (!knots || !breaks)
        return 0;
    size_t count = 0;
    for (size_t i = 0; i < n + (size_t)degree + 1; i++) {
        if (count == 0 || knots[i] != breaks[count - 1]) {
            breaks[count++] = knots[i];
            if (multiplicities)
                multiplicities[count - 1] = 0;
        }
        if (multiplicities)
            multiplicities[count - 1]++;
    }
    return count;
}

size_t nurbs_knots_merge(int degree, size_t n, double *knots, double tolerance)
{
    if (!knots)
        return 0;
    const size_t p = (size_t)degree;
    size_t moved = 0;
    for (size_t i = p + 1, count; i < n; i += count) {
        const double first = knots[i];
        double sum = 0.0;
        count = 1;
        if (first - knots[p] <= tolerance || knots[n] - first <= tolerance)
            continue;
        while (i + count < n && count < p && knots[i + count] - first <= tolerance &&
               knots[n] - knots[i + count] > tolerance)
            sum += knots[i + count++] - first;
        const double mean = first + sum / (double)count;
        for (size_t k = i; k < i + count; k++) {
            moved += knots[k] != mean;
            knots[k] = mean;
        }
    }
    return moved;
}
