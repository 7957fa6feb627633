/* The local part N of the Kelvin Green function by quadrature of its defining integral: what the
 * tables of the library are made from. */
#ifndef IGABEM_TABLES_LOCAL_INTEGRAL_H
#define IGABEM_TABLES_LOCAL_INTEGRAL_H

/* N = (2/pi) Int_{-1}^{1} Im[e^s E1(s)] dt, s = sqrt(1-t^2) (Z sqrt(1-t^2) + Y t + i X), to about
 * 1e-14 of max(1, |N|) / (1 + R). X, Y >= 0, Z <= 0, R > 0. */
double local_integral(double X, double Y, double Z);

/* L = (2/pi) Int_{-1}^{1} Im e^s dt, entire: N + ln(R) L is bounded at R = 0. For R of order 1. */
double logarithm_factor(double X, double Y, double Z);

#endif
