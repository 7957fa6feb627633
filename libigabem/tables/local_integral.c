#include "local_integral.h"

#include "../src/core/constants.h"
#include "../src/kelvin/kelvin_simd.h"

#include <complex.h>
#include <math.h>

static const double half_pi = PI / 2;
static const double euler_gamma = 0.57721566490153286061;

enum { GAUSS = 14, LANES = 8, MAX_NODES = 4096 };

/* Gauss-Legendre on [-1, 1], positive abscissae and weights of 14 nodes (Abramowitz & Stegun 25.4).
 */
static const double gauss_x[GAUSS / 2] = {
    0.10805494870734366207, 0.31911236892788976044, 0.51524863635815409197, 0.68729290481168547015,
    0.82720131506976499319, 0.92843488366357351734, 0.98628380869681233884};
static const double gauss_w[GAUSS / 2] = {
    0.21526385346315779020, 0.20519846372129560397, 0.18553839747793781374, 0.15720316715819353457,
    0.12151857068790318469, 0.08015808715976020981, 0.03511946033175186303};

/* e^s E1(s) near the origin and along the negative real axis, |s| + Re s < 2, by the ascending
 * series or, where that would overflow, the asymptotic one. Principal branch, Im s >= 0. */
static double complex exp_integral_series(double complex s)
{
    double size = cabs(s);
    if (size > 40) {
        double complex term = 1 / s, sum = term;
        for (int k = 1; k < 40; k++) {
            double complex next = term * (-k / s);
            if (cabs(next) > cabs(term))
                break;
            sum += term = next;
        }
        return sum;
    }
    double re = creal(s), im = cimag(s), tr = 1, ti = 0, sr = 0, si = 0;
    for (int k = 1; k < 200; k++) {
        double swap = -(tr * re - ti * im) / k;
        ti = -(tr * im + ti * re) / k;
        tr = swap;
        sr += tr / k;
        si += ti / k;
        if (k > size && fabs(tr) + fabs(ti) < 1e-18 * k)
            break;
    }
    double complex rest = -euler_gamma - clog(s) - (sr + I * si);
    return cexp(s) * rest;
}

/* Im[e^s E1(s)] of LANES arguments from the convergents p_n/q_n of the continued fraction
 * 1/(s+1-1/(s+3-4/(s+5-...))), whose q_n are Laguerre polynomials: (k+1) q_{k+1} = (2k+1+s) q_k - k
 * q_{k-1}. */
KELVIN_MULTIVERSION
static void convergent(int n, const double *re, const double *im, double *out)
{
    double pr[LANES], pi[LANES], qr[LANES], qi[LANES];
    double lpr[LANES], lpi[LANES], lqr[LANES], lqi[LANES];
    for (int l = 0; l < LANES; l++) {
        lpr[l] = lpi[l] = lqi[l] = pi[l] = 0;
        lqr[l] = pr[l] = 1;
        qr[l] = 1 + re[l];
        qi[l] = im[l];
    }
    for (int k = 1; k < n; k++) {
        double scale = 1.0 / (k + 1), back = k * scale, shift = 2 * k + 1;
        for (int l = 0; l < LANES; l++) {
            double ar = (shift + re[l]) * scale, ai = im[l] * scale;
            double npr = ar * pr[l] - ai * pi[l] - back * lpr[l];
            double npi = ar * pi[l] + ai * pr[l] - back * lpi[l];
            double nqr = ar * qr[l] - ai * qi[l] - back * lqr[l];
            double nqi = ar * qi[l] + ai * qr[l] - back * lqi[l];
            lpr[l] = pr[l];
            lpi[l] = pi[l];
            lqr[l] = qr[l];
            lqi[l] = qi[l];
            pr[l] = npr;
            pi[l] = npi;
            qr[l] = nqr;
            qi[l] = nqi;
        }
        if (k % 16 == 0)
            for (int l = 0; l < LANES; l++) {
                double down = 1 / (fabs(qr[l]) + fabs(qi[l]));
                pr[l] *= down;
                pi[l] *= down;
                qr[l] *= down;
                qi[l] *= down;
                lpr[l] *= down;
                lpi[l] *= down;
                lqr[l] *= down;
                lqi[l] *= down;
            }
    }
    for (int l = 0; l < LANES; l++)
        out[l] = (pi[l] * qr[l] - pr[l] * qi[l]) / (qr[l] * qr[l] + qi[l] * qi[l]);
}

struct nodes {
    int n;
    double weight[MAX_NODES], re[MAX_NODES], im[MAX_NODES]; /* weight times dt, and s */
};

static double sum_exp_integral(struct nodes *nodes)
{
    while (nodes->n % LANES) {
        nodes->weight[nodes->n] = 0;
        nodes->re[nodes->n] = 10;
        nodes->im[nodes->n++] = 0;
    }
    double sum = 0;
    for (int first = 0; first < nodes->n; first += LANES) {
        const double *re = nodes->re + first, *im = nodes->im + first;
        double value[LANES], reach[LANES], least = INFINITY;
        for (int l = 0; l < LANES; l++) {
            reach[l] = re[l] + sqrt(re[l] * re[l] + im[l] * im[l]);
            if (reach[l] >= 2)
                least = fmin(least, reach[l]);
        }
        /* The convergents' error is about exp(-4 sqrt(n (|s| + Re s)/2)). */
        if (least < INFINITY)
            convergent((int)(168 / least) + 8, re, im, value);
        for (int l = 0; l < LANES; l++) {
            if (reach[l] < 2)
                value[l] = cimag(exp_integral_series(re[l] + I * im[l]));
            sum += nodes->weight[first + l] * value[l];
        }
    }
    return sum;
}

/* Adds panels on t = sin(phi) that shrink by 0.3 from `length` down to `scale` towards phi = end,
 * on the side +1 or -1 of it. end is where cos(phi) = 0 or, at_zero, where Re s = 0. On the last
 * panel distance = scale y^3 smooths the logarithm of s. */
static void add_graded(struct nodes *nodes, double end, double side, double length, double scale,
                       int at_zero, double X, double Y, double Z)
{
    double rho = sqrt(Y * Y + Z * Z);
    for (double far = length, near; far > 0; far = near) {
        near = far > scale ? 0.3 * far : 0;
        for (int i = 0; i < GAUSS; i++) {
            double x = i < GAUSS / 2 ? -gauss_x[i] : gauss_x[i - GAUSS / 2];
            double weight = gauss_w[i < GAUSS / 2 ? i : i - GAUSS / 2], distance, y = 0.5 * (1 + x);
            if (near > 0) {
                distance = near + (far - near) * y;
                weight *= 0.5 * (far - near);
            } else {
                distance = far * y * y * y;
                weight *= 1.5 * far * y * y;
            }
            double phi = end + side * distance;
            double c = at_zero ? cos(phi) : sin(distance);
            double depth = at_zero ? rho * sin(side * distance) : Z * c - Y * side * cos(distance);
            int k = nodes->n++;
            nodes->weight[k] = weight * c;
            nodes->re[k] = c * depth;
            nodes->im[k] = c * X;
        }
    }
}

static void place_nodes(struct nodes *nodes, double X, double Y, double Z)
{
    double rho = sqrt(Y * Y + Z * Z), R = sqrt(rho * rho + X * X), zero = atan2(-Z, Y);
    double below = 0.5 * (zero + half_pi), above = 0.5 * (half_pi - zero);
    /* s vanishes at phi = zero and, moved by pi, outside the range next to the other end. */
    double at_end = fmax(1e-9, fmin(0.5 / fmax(1, R), 0.3 * fmax(X, Y) / rho));
    double at_zero = fmax(1e-9, fmin(at_end, 0.3 * fmin(X, Y) / rho));
    nodes->n = 0;
    add_graded(nodes, -half_pi, 1, below, at_end, 0, X, Y, Z);
    add_graded(nodes, zero, -1, below, at_zero, 1, X, Y, Z);
    add_graded(nodes, zero, 1, above, at_zero, 1, X, Y, Z);
    add_graded(nodes, half_pi, -1, above, at_end, 0, X, Y, Z);
}

double local_integral(double X, double Y, double Z)
{
    struct nodes nodes;
    place_nodes(&nodes, X, Y, Z);
    return sum_exp_integral(&nodes) / half_pi;
}

double logarithm_factor(double X, double Y, double Z)
{
    struct nodes nodes;
    place_nodes(&nodes, X, Y, Z);
    double sum = 0;
    for (int k = 0; k < nodes.n; k++)
        sum += nodes.weight[k] * exp(nodes.re[k]) * sin(nodes.im[k]);
    return sum / half_pi;
}
