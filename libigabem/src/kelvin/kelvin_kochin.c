/* Far-field wave amplitudes of points, segments and triangles. On a plane element the exponent
 * k0 (1+t^2) z + i k0 sqrt(1+t^2) (x + t y) is linear, so the integral of the exponential is a
 * divided difference of exp over the exponents at the corners (Hermite-Genocchi). */
#include "core/error.h"
#include "kelvin/kelvin_vecmath.h"

#include <igabem/kelvin.h>

#include <complex.h>
#include <math.h>

static igabem_status check(double k0, size_t nt, const double *t, size_t n, const double *points,
                           const double *strength, const double *hr, const double *hi)
{
    if (!(k0 > 0) || !isfinite(k0))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "wave amplitude: k0 is %g, expected > 0", k0);
    if ((nt > 0 && (!t || !hr || !hi)) || (n > 0 && (!points || !strength)))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "wave amplitude: an array is NULL");
    for (size_t i = 0; i < nt; i++)
        if (!(fabs(t[i]) < 1e6))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "wave amplitude: t[%zu] is %g, expected within 1e6", i, t[i]);
    return IGABEM_OK;
}

static igabem_status check_point(size_t i, double x, double y, double z, double strength)
{
    if (!isfinite(x) || !isfinite(y) || !isfinite(z) || !isfinite(strength))
        return igabem_fail(
            IGABEM_ERROR_ARGUMENT,
            "wave amplitude: element %zu has (%g, %g, %g), strength %g, expected finite", i, x, y,
            z, strength);
    if (z > 0)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "wave amplitude: element %zu has z = %g, expected <= 0", i, z);
    return IGABEM_OK;
}

KELVIN_MULTIVERSION
static void sum_points(double k0, size_t nt, const double *t, size_t n, const double *x,
                       const double *y, const double *z, const double *strength, double *hr,
                       double *hi)
{
    for (size_t i = 0; i < nt; i++) {
        double square = 1 + t[i] * t[i], along = k0 * sqrt(square), across = along * t[i];
        kelvin_vec sum_re = {0}, sum_im = {0}, floor = {0};
        floor -= 700;
        for (size_t first = 0; first < n; first += KELVIN_LANES) {
            kelvin_vec decay = {0}, phase = {0}, weight = {0}, size, sine, cosine;
            for (size_t l = 0; l < KELVIN_LANES && first + l < n; l++) {
                decay[l] = k0 * square * z[first + l];
                phase[l] = along * x[first + l] + across * y[first + l];
                weight[l] = strength[first + l];
            }
            decay = KELVIN_MAX(decay, floor);
            kelvin_vexp(&decay, &size);
            kelvin_vsincos(&phase, &sine, &cosine);
            sum_re += weight * size * cosine;
            sum_im += weight * size * sine;
        }
        hr[i] = kelvin_add_lanes(&sum_re);
        hi[i] = kelvin_add_lanes(&sum_im);
    }
}

igabem_status igabem_kochin_points(double k0, size_t nt, const double *t, size_t n, const double *x,
                                   const double *y, const double *z, const double *strength,
                                   double *hr, double *hi)
{
    igabem_status status = check(k0, nt, t, n, x, strength, hr, hi);
    if (status == IGABEM_OK && n > 0 && (!y || !z))
        status = igabem_fail(IGABEM_ERROR_ARGUMENT, "wave amplitude: an array is NULL");
    for (size_t i = 0; status == IGABEM_OK && i < n; i++)
        status = check_point(i, x[i], y[i], z[i], strength[i]);
    if (status == IGABEM_OK)
        sum_points(k0, nt, t, n, x, y, z, strength, hr, hi);
    return status;
}

static double complex exponent(double k0, double t, const double *p)
{
    double square = 1 + t * t, along = k0 * sqrt(square);
    return k0 * square * p[2] + I * (along * (p[0] + t * p[1]));
}

/* Int_0^1 e^{a + l (b-a)} dl and the same with l as a factor, Re b <= Re a. */
static void segment_moments(double complex a, double complex b, double complex *zeroth,
                            double complex *first)
{
    double complex d = b - a, ea = cexp(a);
    if (cabs(d) < 1) {
        double complex term = 1, sum0 = 0, sum1 = 0;
        for (int k = 0; k < 20; k++) {
            sum0 += term / (k + 1);
            sum1 += term / (k + 2);
            term *= d / (k + 1);
        }
        *zeroth = ea * sum0;
        *first = ea * sum1;
        return;
    }
    double complex eb = cexp(b);
    *zeroth = (eb - ea) / d;
    *first = (eb - *zeroth) / d;
}

static double complex segment(double complex a, double complex b, double sa, double sb)
{
    double complex zeroth, first;
    if (creal(a) < creal(b)) {
        double complex swap = a;
        double swap_s = sa;
        a = b;
        b = swap;
        sa = sb;
        sb = swap_s;
    }
    segment_moments(a, b, &zeroth, &first);
    return sa * zeroth + (sb - sa) * first;
}

igabem_status igabem_kochin_segments(double k0, size_t nt, const double *t, size_t n,
                                     const double *ends, const double *strength, double *hr,
                                     double *hi)
{
    igabem_status status = check(k0, nt, t, n, ends, strength, hr, hi);
    for (size_t i = 0; status == IGABEM_OK && i < 2 * n; i++)
        status = check_point(i / 2, ends[3 * i], ends[3 * i + 1], ends[3 * i + 2], strength[i]);
    for (size_t i = 0; status == IGABEM_OK && i < nt; i++) {
        double complex sum = 0;
        for (size_t k = 0; k < n; k++) {
            const double *p = ends + 6 * k, *q = p + 3;
            double length = sqrt((q[0] - p[0]) * (q[0] - p[0]) + (q[1] - p[1]) * (q[1] - p[1]) +
                                 (q[2] - p[2]) * (q[2] - p[2]));
            sum += length * segment(exponent(k0, t[i], p), exponent(k0, t[i], q), strength[2 * k],
                                    strength[2 * k + 1]);
        }
        hr[i] = creal(sum);
        hi[i] = cimag(sum);
    }
    return status;
}

/* exp[a, b, c]: the corner of the exponential of the matrix with a, b, c on the diagonal and ones
 * above it (Opitz), by scaling, Taylor and squaring; a is the exponent of largest real part. */
static double complex close_difference(double complex a, double complex b, double complex c)
{
    double complex d[3] = {0, b - a, c - a};
    double size = fmax(cabs(d[1]), cabs(d[2]));
    int halvings = 0;
    while (size > 0.5) {
        size *= 0.5;
        halvings++;
    }
    double scale = ldexp(1, -halvings);
    /* Rows of the upper triangle: E = diagonal, F = first, G = second superdiagonal; P the current
     * power. */
    double complex E[3] = {1, 1, 1}, F[2] = {0}, G = 0, P[3] = {1, 1, 1}, Q[2] = {0}, S = 0;
    for (int k = 1; k < 18; k++) {
        /* Power times the matrix, divided by k. */
        double complex newS = (S * d[2] + Q[0]) * scale / k;
        double complex newQ0 = (Q[0] * d[1] + P[0]) * scale / k,
                       newQ1 = (Q[1] * d[2] + P[1]) * scale / k;
        for (int j = 0; j < 3; j++) {
            P[j] *= d[j] * scale / k;
            E[j] += P[j];
        }
        S = newS;
        Q[0] = newQ0;
        Q[1] = newQ1;
        F[0] += Q[0];
        F[1] += Q[1];
        G += S;
    }
    for (int k = 0; k < halvings; k++) {
        G = E[0] * G + F[0] * F[1] + G * E[2];
        F[0] *= E[0] + E[1];
        F[1] *= E[1] + E[2];
        for (int j = 0; j < 3; j++)
            E[j] *= E[j];
    }
    return cexp(a) * G;
}

static double complex triangle(double complex a, double complex b, double complex c)
{
    double complex swap;
    if (creal(b) > creal(a)) {
        swap = a;
        a = b;
        b = swap;
    }
    if (creal(c) > creal(a)) {
        swap = a;
        a = c;
        c = swap;
    }
    if (fmin(cabs(a - b), fmin(cabs(b - c), cabs(c - a))) < 1)
        return close_difference(a, b, c);
    return cexp(a) / ((a - b) * (a - c)) + cexp(b) / ((b - a) * (b - c)) +
           cexp(c) / ((c - a) * (c - b));
}

static double area_twice(const double *p)
{
    double u[3], v[3];
    for (int k = 0; k < 3; k++) {
        u[k] = p[3 + k] - p[k];
        v[k] = p[6 + k] - p[k];
    }
    double nx = u[1] * v[2] - u[2] * v[1], ny = u[2] * v[0] - u[0] * v[2],
           nz = u[0] * v[1] - u[1] * v[0];
    return sqrt(nx * nx + ny * ny + nz * nz);
}

igabem_status igabem_kochin_triangles(double k0, size_t nt, const double *t, size_t n,
                                      const double *corners, const double *strength, double *hr,
                                      double *hi)
{
    igabem_status status = check(k0, nt, t, n, corners, strength, hr, hi);
    for (size_t i = 0; status == IGABEM_OK && i < 3 * n; i++)
        status = check_point(i / 3, corners[3 * i], corners[3 * i + 1], corners[3 * i + 2],
                             strength[i / 3]);
    for (size_t i = 0; status == IGABEM_OK && i < nt; i++) {
        double complex sum = 0;
        for (size_t k = 0; k < n; k++) {
            const double *p = corners + 9 * k;
            sum += strength[k] * area_twice(p) *
                   triangle(exponent(k0, t[i], p), exponent(k0, t[i], p + 3),
                            exponent(k0, t[i], p + 6));
        }
        hr[i] = creal(sum);
        hi[i] = cimag(sum);
    }
    return status;
}
