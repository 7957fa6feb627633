/* How many Gauss points a smooth kernel needs on a piece of surface seen from a distance. */
#ifndef QUADRATURE_REGULAR_H
#define QUADRATURE_REGULAR_H

/* The polynomial that multiplies the integrand: one basis function, on a piece of its element. On
 * it the Chebyshev coefficient of degree p is below share^p, and it takes p of the 2n degrees that
 * n points integrate: an error that falls like rho^-2n falls like rho^-2n max(1, (share rho)^p). */
struct factor {
    int degree;
    double share; /* of the element's width, in (0,1] */
};

/* Points of a Gauss rule over a length of 2 half, its middle at the given distance from the
 * singularity, so that the error of the rule stays below the tolerance; scale: the integral over
 * the length of the kernel as it is at the middle. To the rule the kernel is a double pole, with
 * the error
 *     scale pi (2n+1) rho^{-2n-1},  rho = z + sqrt(z^2-1), z = distance/half
 * (Trefethen, Approximation Theory and Approximation Practice, chapter 19; the remainder's contour
 * shrunk onto the pole). Returns INT_MAX for more than 64 points, and when the singularity is
 * within the length. */
int regular_points(double distance, double half, const struct factor *factor, double scale,
                   double tolerance);

/* The same for the area element along a parameter line with the chord and the second difference
 * |P_0 - 2 P_1 + P_2| of its ends and middle: the tangent c_1 + 2 c_2 x vanishes at |x| = chord/(2
 * bend), in general complex, where the area element has a branch point like a square root. Its
 * error is about 0.7 scale n^{-3/2} rho^{-2n}. */
int shape_points(double chord, double bend, const struct factor *factor, double scale,
                 double tolerance);

#endif
