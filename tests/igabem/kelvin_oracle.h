/* N + W and its gradient by Bessho's representation, slowly: an oracle that shares nothing with the
 * library but the definition.
 *
 *     N + W = 4 Im Int_0^inf e^{f(v)} cosh v dv
 *             - 4 Int_0^{pi/2} sin u cos(X sin u) e^{Z sin^2 u - Y sin u cos u} du
 *             - (2/pi) Im Int_{-pi/2}^{pi/2} g e^w E1(w) dphi,
 *     f = Z cosh^2 v + i cosh v (X + Y sinh v),  g = cos phi/sin^2 phi,
 *     w = -g (Z cos phi + X sin phi + i Y),
 *
 * for Y > 0 and either sign of X (Bessho 1964; Wang & Rogers 1990). Each integral adaptively. */
#ifndef TESTS_KELVIN_ORACLE_H
#define TESTS_KELVIN_ORACLE_H

/* Fills value and derivatives in X, Y, Z of N + W. Y > 0, Z < 0. */
void kelvin_oracle(double X, double Y, double Z, double sum[4]);

/* N and W separately: N is N + W at |X|, W the difference. */
void kelvin_oracle_parts(double X, double Y, double Z, double local[4], double wave[4]);

#endif
