/* All eigenpairs of a dense matrix beyond the order up to which LAPACK does them in one call,
 * against a matrix whose spectrum is known: a diagonal one between a reflection, I - 2 v v^T, and
 * itself. */
#include "check.h"
#include "eigen.h"

#include <stdlib.h>
#include <string.h>

enum { ORDER = 700 };

/* A = H D H column by column; v of unit length. */
static void make(const double *diagonal, const double *v, double *a)
{
    double weight = 0;
    for (size_t k = 0; k < ORDER; k++)
        weight += v[k] * v[k] * diagonal[k];
    for (size_t j = 0; j < ORDER; j++)
        for (size_t i = 0; i < ORDER; i++)
            a[j * ORDER + i] = (i == j ? diagonal[i] : 0) +
                               v[i] * v[j] * (4 * weight - 2 * diagonal[i] - 2 * diagonal[j]);
}

static void check_pairs(const double *diagonal)
{
    double *v = malloc(ORDER * sizeof *v), *values = malloc(ORDER * sizeof *values), norm = 0;
    double *a = malloc(3 * ORDER * ORDER * sizeof *a);
    CU_ASSERT_TRUE_FATAL(v && values && a);
    double *kept = a + ORDER * ORDER, *vectors = kept + ORDER * ORDER;
    for (size_t i = 0; i < ORDER; i++) {
        v[i] = sin(1.0 + (double)(i * i % 97));
        norm += v[i] * v[i];
    }
    for (size_t i = 0; i < ORDER; i++)
        v[i] /= sqrt(norm);
    make(diagonal, v, a);
    memcpy(kept, a, ORDER * ORDER * sizeof *a);
    CU_ASSERT_EQUAL_FATAL(galv_eigen_dense(ORDER, a, values, vectors, NULL), GALV_OK);
    double value = 0, residual = 0, skew = 0;
    for (size_t k = 0; k < ORDER; k++) {
        const double *x = vectors + k * ORDER, *other = vectors + (k ? k - 1 : 1) * ORDER;
        double length = 0, product = 0;
        value = fmax(value, fabs(values[k] - diagonal[k]));
        for (size_t i = 0; i < ORDER; i++) {
            double sum = -values[k] * x[i];
            for (size_t j = 0; j < ORDER; j++)
                sum += kept[i * ORDER + j] * x[j];
            residual = fmax(residual, fabs(sum));
            length += x[i] * x[i];
            product += x[i] * other[i];
        }
        skew = fmax(skew, fmax(fabs(length - 1), fabs(product)));
    }
    CHECK_CLOSE(value, 0, 1e-13 * diagonal[0] * sqrt(ORDER));
    CHECK_CLOSE(residual, 0, 1e-13 * diagonal[0] * sqrt(ORDER));
    CHECK_CLOSE(skew, 0, 1e-12);
    free(v);
    free(values);
    free(a);
}

static void test_falling(void)
{
    double diagonal[ORDER];
    for (size_t i = 0; i < ORDER; i++)
        diagonal[i] = 1 / (double)((i + 1) * (i + 1));
    check_pairs(diagonal);
}

/* Many alike, as of a shape with few functions: the rest is rounding. */
static void test_repeated(void)
{
    double diagonal[ORDER];
    for (size_t i = 0; i < ORDER; i++)
        diagonal[i] = i < 20 ? 3 : i < 200 ? 1 : 0;
    check_pairs(diagonal);
}

static const struct check_case cases[] = {
    {"falling", test_falling},
    {"repeated", test_repeated},
};

CHECK_MAIN("dense eigenpairs", cases)
