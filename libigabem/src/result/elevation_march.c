#include "result/elevation_march.h"

#include "core/error.h"
#include "core/vector_math.h"
#include "result/amplitude.h"

#include <stdlib.h>

igabem_status elevation_march_create(double k0, bool symmetric, double length, double beam,
                                     double t_max, double t_c, struct elevation_march **march)
{
    struct elevation_march *result = calloc(1, sizeof *result);
    *march = NULL;
    if (!result)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a wave field");
    result->k0 = k0;
    result->symmetric = symmetric;
    igabem_status status =
        amplitude_rule(k0, length, beam, t_max, 0.0, &result->n, &result->t, &result->weight);
    for (int k = 0; !status && k < (symmetric ? 2 : 4); k++) {
        double **sums[4] = {&result->even_re, &result->even_im, &result->odd_re, &result->odd_im};
        *sums[k] = calloc(result->n, sizeof(double));
        if (!*sums[k])
            status = igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu wave angles", result->n);
    }
    if (status) {
        elevation_march_free(result);
        return status;
    }
    for (size_t j = 0; j < result->n; j++) {
        double square = 1.0 + result->t[j] * result->t[j];
        result->weight[j] *= sqrt(square);
        if (t_c > 0) {
            double ratio = square / (1.0 + t_c * t_c);
            result->weight[j] *= exp(-ratio * ratio);
        }
    }
    *march = result;
    return IGABEM_OK;
}

void elevation_march_free(struct elevation_march *march)
{
    if (!march)
        return;
    free(march->t);
    free(march->weight);
    free(march->even_re);
    free(march->even_im);
    free(march->odd_re);
    free(march->odd_im);
    free(march);
}

VECTOR_MULTIVERSION
static void sum_sources(double a, double b, double k, size_t n, const double *restrict x,
                        const double *restrict y, const double *restrict z,
                        const double *restrict q, double *restrict sums)
{
    double er = 0.0, ei = 0.0, odd_r = 0.0, odd_i = 0.0;
#pragma omp simd reduction(+ : er, ei, odd_r, odd_i)
    for (size_t j = 0; j < n; j++) {
        double s, c, sy, cy;
        vector_sincos(k * x[j], &s, &c);
        vector_sincos(b * y[j], &sy, &cy);
        double e = q[j] * vector_exp(a * z[j]);
        er += e * c * cy;
        ei -= e * s * cy;
        odd_r += e * c * sy;
        odd_i -= e * s * sy;
    }
    sums[0] = er;
    sums[1] = ei;
    sums[2] = odd_r;
    sums[3] = odd_i;
}

static void sums_at(const struct elevation_march *march, size_t j, const struct point_set *set,
                    size_t begin, size_t end, double sums[4])
{
    double t = march->t[j], a = march->k0 * (1.0 + t * t), k = march->k0 * sqrt(1.0 + t * t);
    sum_sources(a, k * t, k, end - begin, set->x + begin, set->y + begin, set->z + begin,
                set->q + begin, sums);
    for (int i = 0; march->symmetric && i < 4; i++)
        sums[i] *= 2.0;
}

void elevation_march_add(struct elevation_march *march, const struct point_set *set, size_t begin,
                         size_t end)
{
    if (begin == end)
        return;
#pragma omp parallel for schedule(static)
    for (size_t j = 0; j < march->n; j++) {
        double sums[4];
        sums_at(march, j, set, begin, end, sums);
        march->even_re[j] += sums[0];
        march->even_im[j] += sums[1];
        if (!march->symmetric) {
            march->odd_re[j] += sums[2];
            march->odd_im[j] += sums[3];
        }
    }
}

void elevation_march_line(const struct elevation_march *march, double x,
                          const struct point_set *extra, double *even, double *odd)
{
#pragma omp parallel for schedule(static)
    for (size_t j = 0; j < march->n; j++) {
        double sums[4] = {0, 0, 0, 0}, s, c, t = march->t[j];
        if (extra && extra->n)
            sums_at(march, j, extra, 0, extra->n, sums);
        vector_sincos(march->k0 * sqrt(1.0 + t * t) * x, &s, &c);
        double scale = 2.0 * march->weight[j]; /* both signs of t */
        even[j] = scale * (c * (march->even_re[j] + sums[0]) - s * (march->even_im[j] + sums[1]));
        if (!march->symmetric)
            odd[j] = scale * (c * (march->odd_re[j] + sums[2]) - s * (march->odd_im[j] + sums[3]));
    }
}

VECTOR_MULTIVERSION
static double series(double k0, double y, size_t n, const double *restrict t,
                     const double *restrict even)
{
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (size_t j = 0; j < n; j++) {
        double s, c;
        vector_sincos(k0 * sqrt(1.0 + t[j] * t[j]) * t[j] * y, &s, &c);
        sum += even[j] * c;
    }
    return sum;
}

double elevation_march_value(const struct elevation_march *march, const double *even,
                             const double *odd, double y)
{
    double sum = series(march->k0, y, march->n, march->t, even);
    for (size_t j = 0; !march->symmetric && j < march->n; j++) {
        double t = march->t[j];
        sum += odd[j] * sin(march->k0 * sqrt(1.0 + t * t) * t * y);
    }
    return sum;
}
