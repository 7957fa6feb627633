/**
 * @file kelvin.h
 * The Green function of steady ship waves (Kelvin, Havelock; "Neumann-Kelvin source").
 *
 * Conventions. The body advances towards +x, the frame moves with it, the stream is -U e_x, z
 * points up and the fluid is z < 0; k0 = g/U^2 is the wavenumber of transverse waves. A source of
 * strength 1 at Q = (xi, eta, zeta) emits the volume flux 1, its potential at P = (x, y, z) is G(P,
 * Q) with
 *
 *     4 pi G = -1/r + 1/r' + k0 [ N(X, Y, Z) + W(X, Y, Z) ],
 *     X = k0 (x - xi),  Y = k0 (y - eta),  Z = k0 (z + zeta) <= 0,
 *
 * r = |P - Q|, r' = |P - Q'|, Q' = (xi, eta, -zeta), k0 r' = R = sqrt(X^2 + Y^2 + Z^2), and
 *
 *     N = (2/pi) Int_{-1}^{1} Im[e^s E1(s)] dt,  s = sqrt(1-t^2) (Z sqrt(1-t^2) + Y t + i |X|),
 *     W = 4 H(-X) Int_{-inf}^{inf} e^{Z (1+t^2)} sin((X + Y t) sqrt(1+t^2)) dt.
 *
 * N, the local part, is even in X and Y and decays like -2/R; W, the wave part, is zero for X >= 0.
 * G is harmonic off Q and satisfies G_xx + k0 G_z = 0 on z = 0. Waves exist behind the source only.
 *
 * All functions work on batches of n points held as separate arrays, allocate nothing, keep no
 * state that can change and may be called from any number of threads. Outputs may be NULL when not
 * wanted and must not overlap inputs. When a call fails nothing can be said about what it wrote;
 * the sentence that names the point at fault is igabem_last_error().
 *
 * Domain: every finite X, Y and every Z <= 0 except R = 0 (IGABEM_ERROR_ARGUMENT). Points with Z >
 * 0 or a coordinate that is not finite are refused the same way.
 *   - X = 0: the limits from upstream, X -> 0+ (N_X is discontinuous there, N + W is analytic).
 *   - Z = 0 off the track: the limit, which is regular.
 *   - The track Y = Z = 0, X < 0: the limit along the centre plane Y = 0, Z -> 0-, in which
 *     W = 4 pi Y1(|X|) (Bessel). W is unbounded near the track off this plane.
 */
#ifndef IGABEM_KELVIN_H
#define IGABEM_KELVIN_H

#include <igabem/status.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The terms of 4 pi G, to be combined with |: the first four are the Kelvin source, IGABEM_RANKINE
 * | IGABEM_LID is the double body. */
enum igabem_kelvin_part {
    IGABEM_RANKINE = 1, /**< -1/r                                */
    IGABEM_IMAGE = 2,   /**< +1/r', the rigid-lid image reversed */
    IGABEM_LOCAL = 4,   /**< k0 N                                */
    IGABEM_WAVE = 8,    /**< k0 W                                */
    IGABEM_LID = 16     /**< -1/r', the rigid-lid image: instead of IGABEM_IMAGE, not beside it */
};

/**
 * Local part N and its gradient at n points (X, Y, Z), dimensionless.
 *
 * @param n        number of points
 * @param X,Y,Z    coordinates (borrows, n each); Y of either sign, Z <= 0
 * @param N        values (fills, n) or NULL
 * @param NX,NY,NZ derivatives with respect to X, signed Y and Z (fills, n each) or NULL
 * @return IGABEM_OK, IGABEM_ERROR_ARGUMENT outside the domain stated above
 */
IGABEM_API igabem_status igabem_kelvin_local(size_t n, const double *X, const double *Y,
                                             const double *Z, double *N, double *NX, double *NY,
                                             double *NZ);

/**
 * Second derivatives of N, same conventions as igabem_kelvin_local(). They satisfy
 * N_XX + N_YY + N_ZZ = 0 and N_XX + N_Z = 2 Z/R^3. Error below 2e-8 of max(largest of them, 1/R^3).
 */
IGABEM_API igabem_status igabem_kelvin_local_second(size_t n, const double *X, const double *Y,
                                                    const double *Z, double *NXX, double *NXY,
                                                    double *NXZ, double *NYY, double *NYZ,
                                                    double *NZZ);

/** A short-wave filter of W: surface-piercing hulls need one, submerged bodies do not. */
typedef struct igabem_kelvin_filter {
    double cut_off; /**< t_c > 0: the integrand of W is multiplied by exp(-((1+t^2)/(1+t_c^2))^2),
                       flat at small wave angles t = tan(theta); 0 (default): no such factor */
    double depth;   /**< >= 0, dimensionless (k0 times a length): Z is replaced by min(Z, -depth) in
                       W;   W_Z is the value at that depth; 0 (default): off */
    double reserved[8]; /**< 0: room for members of later releases */
} igabem_kelvin_filter;

/** Fills the defaults: no filter. */
IGABEM_API void igabem_kelvin_filter_init(igabem_kelvin_filter *filter);

/**
 * Wave part W and its gradient at n points, dimensionless; all zero where X >= 0.
 *
 * @param n        number of points
 * @param X,Y,Z    coordinates (borrows, n each); Y of either sign, Z <= 0
 * @param W        values (fills, n) or NULL
 * @param WX,WY,WZ derivatives with respect to X, signed Y and Z (fills, n each) or NULL
 * @return IGABEM_OK, IGABEM_ERROR_ARGUMENT outside the domain stated above
 */
IGABEM_API igabem_status igabem_kelvin_wave(size_t n, const double *X, const double *Y,
                                            const double *Z, double *W, double *WX, double *WY,
                                            double *WZ);

/** Second derivatives of W. They satisfy W_XX + W_YY + W_ZZ = 0 and W_XX + W_Z = 0. */
IGABEM_API igabem_status igabem_kelvin_wave_second(size_t n, const double *X, const double *Y,
                                                   const double *Z, double *WXX, double *WXY,
                                                   double *WXZ, double *WYY, double *WYZ,
                                                   double *WZZ);

/**
 * igabem_kelvin_wave() with a short-wave filter; filter NULL means none. With cut_off > 0 the whole
 * closed half space Z <= 0 is regular, the track included.
 */
IGABEM_API igabem_status igabem_kelvin_wave_filtered(size_t n, const double *X, const double *Y,
                                                     const double *Z,
                                                     const igabem_kelvin_filter *filter, double *W,
                                                     double *WX, double *WY, double *WZ);

/**
 * Green function G (not 4 pi G) of n pairs of points and its gradient with respect to the field
 * point.
 *
 * @param k0          g/U^2 > 0, 1/m
 * @param n           number of pairs
 * @param x,y,z       field points, m (borrows, n each), z <= 0
 * @param xi,eta,zeta source points, m (borrows, n each), zeta <= 0
 * @param parts       sum of igabem_kelvin_part
 * @param g           G, 1/m (fills, n) or NULL
 * @param gx,gy,gz    dG/dx, dG/dy, dG/dz, 1/m^2 (fills, n each) or NULL
 * @return IGABEM_OK; IGABEM_ERROR_ARGUMENT for k0 <= 0, unknown parts, a point above the water, and
 *         coincident points when IGABEM_RANKINE is asked for (r = 0) or one of the others (r' = 0)
 *
 * Derivatives with respect to the source point: dG/dxi = -dG/dx, dG/deta = -dG/dy for every part;
 * dG/dzeta = dG/dz for image, local and wave part, -dG/dz for the Rankine part.
 */
IGABEM_API igabem_status igabem_kelvin_green(double k0, size_t n, const double *x, const double *y,
                                             const double *z, const double *xi, const double *eta,
                                             const double *zeta, unsigned parts, double *g,
                                             double *gx, double *gy, double *gz);

/** Second derivatives of G with respect to the field point, 1/m^3; same rules. */
IGABEM_API igabem_status igabem_kelvin_green_second(double k0, size_t n, const double *x,
                                                    const double *y, const double *z,
                                                    const double *xi, const double *eta,
                                                    const double *zeta, unsigned parts, double *gxx,
                                                    double *gxy, double *gxz, double *gyy,
                                                    double *gyz, double *gzz);

/**
 * Wave resistance of single submerged singularities, closed forms (Havelock), N. a = k0 depth > 0:
 *   source of strength s, m^3/s:         R = (rho s^2 k0^2/4 pi) e^-a [K0(a) + K1(a)]
 *   x-dipole of moment mu, m^4/s:        R = (rho mu^2 k0^4/4 pi) e^-a [K0(a) + (1 + 1/(2a)) K1(a)]
 *   sphere of radius c < depth, m:       the dipole mu = 2 pi c^3 U, Havelock's first approximation
 *
 * @param rho density, kg/m^3, > 0
 * @param k0  g/U^2, 1/m, > 0
 * @param depth of the singularity below the still water, m, > 0
 * @param resistance R (fills)
 */
IGABEM_API igabem_status igabem_kelvin_source_resistance(double rho, double k0, double depth,
                                                         double strength, double *resistance);
/** Of an x-dipole of moment, m^4/s: see igabem_kelvin_source_resistance(). */
IGABEM_API igabem_status igabem_kelvin_dipole_resistance(double rho, double k0, double depth,
                                                         double moment, double *resistance);
/** gravity in m/s^2, > 0; U^2 = gravity/k0. */
IGABEM_API igabem_status igabem_kelvin_sphere_resistance(double rho, double gravity, double k0,
                                                         double depth, double radius,
                                                         double *resistance);

/**
 * Far-field wave amplitude (Kochin function) of point sources,
 *     H(t) = Sum_j strength_j exp(k0 (1+t^2) z_j + i k0 sqrt(1+t^2) (x_j + t y_j)),
 * t = tan(theta) of either sign. The wave resistance of the sources is
 *     R = (rho k0^2/2 pi) Int_{-inf}^{inf} |H(t)|^2 sqrt(1+t^2) dt.
 *
 * @param k0       g/U^2, 1/m, > 0
 * @param nt,t     wave angles (borrows, nt)
 * @param n        number of sources; for a surface patch the nodes of its quadrature rule
 * @param x,y,z    source points, m, z <= 0 (borrows, n each)
 * @param strength m^3/s, for a patch density times weight times area element (borrows, n)
 * @param hr,hi    real and imaginary part of H, m^3/s (fills, nt each)
 */
IGABEM_API igabem_status igabem_kochin_points(double k0, size_t nt, const double *t, size_t n,
                                              const double *x, const double *y, const double *z,
                                              const double *strength, double *hr, double *hi);

/**
 * The same for n straight segments whose strength per length varies linearly, integrated exactly.
 *
 * @param ends     x,y,z of the first and of the second end, m (borrows, 6 n)
 * @param strength per length at the two ends, m^2/s (borrows, 2 n)
 */
IGABEM_API igabem_status igabem_kochin_segments(double k0, size_t nt, const double *t, size_t n,
                                                const double *ends, const double *strength,
                                                double *hr, double *hi);

/**
 * The same for n plane triangles of constant strength per area, integrated exactly.
 *
 * @param corners  x,y,z of the three corners, m (borrows, 9 n)
 * @param strength per area, m/s (borrows, n)
 */
IGABEM_API igabem_status igabem_kochin_triangles(double k0, size_t nt, const double *t, size_t n,
                                                 const double *corners, const double *strength,
                                                 double *hr, double *hi);

#ifdef __cplusplus
}
#endif

#endif
