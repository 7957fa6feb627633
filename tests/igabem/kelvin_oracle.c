#include "kelvin_oracle.h"

#include <complex.h>
#include <math.h>

static const double pi = 3.14159265358979323846;

struct point {
    double X, Y, Z;
};

/* Adds the integrand (value and three derivatives) at s to sum, times weight. */
typedef void integrand(const struct point *p, double s, double weight, double sum[4]);

/* Gauss 7 and Kronrod 15 points on [-1, 1] (QUADPACK). */
static const double kronrod_x[8] = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144691693013, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0};
static const double kronrod_w[8] = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
static const double gauss_w[4] = {
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

static void integrate(integrand *f, const struct point *p, double low, double high,
                      double tolerance, int depth, double out[4])
{
    double fine[4] = {0}, coarse[4] = {0}, half = 0.5 * (high - low), middle = 0.5 * (high + low),
           error = 0, size = 0;
    for (int k = 0; k < 8; k++)
        for (int side = -1; side <= 1; side += 2) {
            double value[4] = {0};
            if (k == 7 && side == 1)
                break;
            f(p, middle + side * half * kronrod_x[k], half, value);
            for (int c = 0; c < 4; c++) {
                fine[c] += kronrod_w[k] * value[c];
                size += kronrod_w[k] * fabs(value[c]);
                coarse[c] += k % 2 ? gauss_w[k / 2] * value[c] : 0;
            }
        }
    for (int c = 0; c < 4; c++)
        error = fmax(error, fabs(fine[c] - coarse[c]));
    /* The Kronrod sum is much better than the Gauss sum it is judged by; rounding sets the floor.
     */
    if (error <= fmax(tolerance, 2e-15 * size) || depth == 0) {
        for (int c = 0; c < 4; c++)
            out[c] += fine[c];
        return;
    }
    integrate(f, p, low, middle, tolerance, depth - 1, out);
    integrate(f, p, middle, high, tolerance, depth - 1, out);
}

/* 4 Im of e^f cosh v dv and its derivatives. */
static void add_wave(const struct point *p, double complex v, double complex dv, double weight,
                     double sum[4])
{
    double complex C = ccosh(v), S = csinh(v), f = p->Z * C * C + I * C * (p->X + p->Y * S);
    if (creal(f) < -300)
        return;
    double complex w = 4 * weight * cexp(f) * C * dv;
    sum[0] += cimag(w);
    sum[1] += cimag(I * C * w);
    sum[2] += cimag(I * S * C * w);
    sum[3] += cimag(C * C * w);
}

/* A path from v = 0: up the imaginary axis to i tau(0), then v = u + i tau(u) near the stationary
 * points. */
static double tau(const struct point *p, double u)
{
    double a = p->Y * cosh(2 * u) + p->X * sinh(u), x = p->X * cosh(u), y = p->Y * cosh(2 * u);
    return 0.5 * atan2(a, -p->Z * cosh(2 * u) + 0.5 * sqrt(x * x + y * y + 1));
}

static void rise(const struct point *p, double s, double weight, double sum[4])
{
    double top = tau(p, 0);
    add_wave(p, I * (s * top), I * top, weight, sum);
}

static void along(const struct point *p, double u, double weight, double sum[4])
{
    double C1 = cosh(u), S1 = sinh(u), C2 = cosh(2 * u), S2 = sinh(2 * u), X = p->X, Y = p->Y;
    double a = Y * C2 + X * S1, da = 2 * Y * S2 + X * C1;
    double root = sqrt(X * X * C1 * C1 + Y * Y * C2 * C2 + 1), b = -p->Z * C2 + 0.5 * root;
    double db = -2 * p->Z * S2 + 0.5 * (X * X * C1 * S1 + 2 * Y * Y * C2 * S2) / root;
    double slope = 0.5 * (da * b - db * a) / (a * a + b * b);
    add_wave(p, u + I * 0.5 * atan2(a, b), 1 + I * slope, weight, sum);
}

static void second(const struct point *p, double u, double weight, double sum[4])
{
    double s = sin(u), c = cos(u);
    double size = -4 * weight * s * exp(p->Z * s * s - p->Y * s * c);
    sum[0] += size * cos(p->X * s);
    sum[1] -= size * s * sin(p->X * s);
    sum[2] -= size * s * c * cos(p->X * s);
    sum[3] += size * s * s * cos(p->X * s);
}

/* E = e^w E1(w), principal branch, and E' = E - 1/w without cancellation. */
static void exp_integral(double complex w, double complex *E, double complex *dE)
{
    double size = cabs(w);
    if (size + creal(w) < 4 && size < 45) {
        double complex term = 1, sum = 0;
        for (int k = 1; k < 400; k++) {
            term *= -w / k;
            sum += term / k;
            if (k > size && cabs(term) < 1e-19 * k)
                break;
        }
        *E = cexp(w) * (-0.57721566490153286061 - clog(w) - sum);
        *dE = *E - 1 / w;
        return;
    }
    if (size > 45) {
        double complex term = 1 / w;
        *E = term;
        *dE = 0;
        for (int k = 1; k < 45; k++) {
            term *= -k / w;
            *E += term;
            *dE += term;
        }
        return;
    }
    /* Continued fraction 1/(w+1-1/(w+3-4/(w+5-...))) from its tail, E' = -(1 - q) E/w, q =
     * 1/(w+3-...). */
    int n = 40 + (int)(400 / (size + creal(w)));
    double complex tail = w + 2 * n + 1;
    for (int k = n; k > 1; k--)
        tail = w + (2 * k - 1) - (double)k * k / tail;
    double complex q = 1 / tail;
    *E = 1 / (w + 1 - q);
    *dE = -(1 - q) * *E / w;
}

static void third(const struct point *p, double phi, double weight, double sum[4])
{
    double c = cos(phi), s = sin(phi), g = c / (s * s);
    double complex w = -g * (p->Z * c + p->X * s + I * p->Y), E, dE;
    exp_integral(w, &E, &dE);
    double size = -2 / pi * weight * g;
    sum[0] += size * cimag(E);
    sum[1] += size * cimag(-g * s * dE);
    sum[2] += size * cimag(-g * I * dE);
    sum[3] += size * cimag(-g * c * dE);
}

/* Integrates away from `end` to end + length on panels that halve towards end, so that no feature
 * is too narrow to be noticed. */
static void integrate_graded(integrand *f, const struct point *p, double end, double length,
                             double tolerance, double out[4])
{
    double part[4] = {0}, far = length;
    if (length == 0)
        return;
    for (int k = 0; k < 36; k++, far *= 0.5)
        integrate(f, p, end + 0.5 * far, end + far, tolerance, 8, part);
    integrate(f, p, end, end + far, tolerance, 8, part);
    for (int c = 0; c < 4; c++)
        out[c] += length < 0 ? -part[c] : part[c];
}

static void integrate_between(integrand *f, const struct point *p, double low, double high,
                              double tolerance, double out[4])
{
    integrate_graded(f, p, low, 0.5 * (high - low), tolerance, out);
    integrate_graded(f, p, high, 0.5 * (low - high), tolerance, out);
}

static double bounded_asinh(double t, double end)
{
    return t > 0 ? fmin(asinh(t), end) : 0;
}

void kelvin_oracle(double X, double Y, double Z, double sum[4])
{
    struct point p = {X, Y, Z};
    double R = sqrt(X * X + Y * Y + Z * Z), scale = 1e-13 * fmax(1 / (R * R), X < 0 ? 0.1 : 0);
    for (int c = 0; c < 4; c++)
        sum[c] = 0;
    integrate_between(rise, &p, 0, 1, scale, sum);
    double root = sqrt(fmax(0, X * X - 8 * Y * Y)), t1 = 0.25 * (-X - root) / Y,
           t2 = 0.25 * (-X + root) / Y;
    /* e^-80 by the depth or, beyond the stationary points, by Y. */
    double by_depth = 0.5 * log(320 / -Z + 4), by_side = 0.5 * log(1300 / Y + 4) + 1;
    double end = fmin(by_depth, fmax(by_side, asinh(fmax(t2, 0)) + 3));
    double place[4] = {0, bounded_asinh(t1, end), bounded_asinh(t2, end), end};
    for (int k = 0; k < 3; k++)
        integrate_between(along, &p, place[k], place[k + 1], scale, sum);
    integrate_between(second, &p, 0, 0.5 * pi, scale, sum);
    /* w comes close to 0 where Z cos phi + X sin phi = 0 if Y is small. */
    double near = atan2(-Z, X), middle = near > 0.5 * pi ? near - pi : near;
    double angle[4] = {-0.5 * pi, fmin(0, middle), fmax(0, middle), 0.5 * pi};
    for (int k = 0; k < 3; k++)
        integrate_between(third, &p, angle[k], angle[k + 1], scale, sum);
}

void kelvin_oracle_parts(double X, double Y, double Z, double local[4], double wave[4])
{
    double total[4];
    kelvin_oracle(fabs(X), Y, Z, local);
    kelvin_oracle(-fabs(X), Y, Z, total);
    double odd = X < 0 ? -1 : 1;
    local[1] *= odd;
    for (int c = 0; c < 4; c++)
        wave[c] = X < 0 ? total[c] - local[c] : 0;
}
