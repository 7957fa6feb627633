/* How many Gauss points a smooth kernel needs on a piece of surface seen from a distance. */
#ifndef QUADRATURE_REGULAR_H
#define QUADRATURE_REGULAR_H

/* Points of a Gauss rule over a length of 2 half, its middle at the given distance from the
 * singularity, so that scale times the relative error of the rule stays below the tolerance. The
 * singularity of the kernel lies outside the Bernstein ellipse of parameter rho = z + sqrt(z^2-1),
 * z = distance/half, hence the error rho^-2n (Trefethen, Approximation Theory and Approximation
 * Practice, theorem 19.3); one more point is for the density and the shape that multiply the
 * kernel. Returns INT_MAX when the singularity is within the length. */
int regular_points(double distance, double half, double scale, double tolerance);

#endif
