/* Fourier symbols of discrete free-surface operators on a uniform grid (docs/theory.md, section
 * 12). Lengths in cells along the stream: alpha = u dx, beta = v dy, h = dy/dx, tau the slope of
 * the grid's lines, eta_x in cells across per cell along; eps = k0 dx. A scheme is stable with its
 * two upstream conditions if the winding number of R is -1 for every beta. */
#ifndef DISPERSION_H
#define DISPERSION_H

#include <complex.h>
#include <stdbool.h>

enum dispersion_derivative {
    DISPERSION_EXACT, /* the spline's own, integrated as it is */
    DISPERSION_OWN,   /* the spline's own at the collocation points, interpolated */
    DISPERSION_FOURTH /* stencils of order 4 at the collocation points, interpolated */
};

struct dispersion_scheme {
    const char *name;
    int degree; /* of phi, 2 to 5 */
    enum dispersion_derivative derivative;
    int density;   /* degree of the interpolated phi_xx, 0 or 2; not used by DISPERSION_EXACT */
    bool twice;    /* the second derivative across is the first taken twice */
    double filter; /* w of 1 - w (sin^4(alpha/2) + sin^4(beta/2)) on phi_xx */
    double odd;    /* w of the odd damping, mu = w sin^6(beta/2) per cell */
};

struct dispersion_grid {
    double h, tau;
};

/* V, the symbol of phi at the collocation points, over the symbols along and across. */
double dispersion_value(const struct dispersion_scheme *scheme, double alpha, double beta);
/* S, the symbol of -Int phi_xx/(2 pi r) dS at the collocation points. The exact one: V kx^2/k. */
double complex dispersion_wave(const struct dispersion_scheme *scheme,
                               const struct dispersion_grid *grid, double alpha, double beta);
/* Symbol of phi_x at the collocation points over i V, of order 4. */
double dispersion_slope(const struct dispersion_scheme *scheme, double alpha);
/* Winding number of R = V - S/eps about 0 for alpha from -pi to pi, with a trace of Rayleigh
 * damping where there is none; given S at (k + 1/2) 2 pi/n - pi. */
int dispersion_winding(const struct dispersion_scheme *scheme, const struct dispersion_grid *grid,
                       double beta, double eps, int n, const double complex *wave);
/* Real alpha > 0 with R = 0 nearest to `near`, NAN if none within half to one and a half of it. */
double dispersion_root(const struct dispersion_scheme *scheme, const struct dispersion_grid *grid,
                       double beta, double eps, double near);
/* Symbol of 1/(2 pi r) against interpolating splines of degree `density`. */
double dispersion_kernel(int density, const struct dispersion_grid *grid, double alpha,
                         double beta);

#endif
