/* Second derivatives of N from the tables of kelvin_table.h. N_XX and the component left over by
 * Laplace's equation come from N_XX = 2 Z/R^3 - N_Z; the others from the polynomials. */
#include "core/error.h"
#include "kelvin/kelvin_cell.h"
#include "kelvin/kelvin_domain.h"
#include "kelvin/kelvin_slope.h"

#include <igabem/kelvin.h>

/* Value, gradient and Hessian (xx, xy, xz, yy, yz, zz) in a cell's x, y, z or in M, a, b. */
struct jet2 {
    double value, d[3], dd[6];
};

/* Sums of c_ij x^i y^j for eight coefficients at once: value, x, y, xx, xy, yy. */
enum { F, FX, FY, FXX, FXY, FYY, SUMS };

/* Horner's rule, in both variables. */
KELVIN_INLINE const double *plane_sums(const double *c, int degree, double x, double y,
                                       kelvin_octet sum[SUMS])
{
    kelvin_octet f = {0}, fx = {0}, fy = {0}, fxx = {0}, fxy = {0}, fyy = {0};
    for (int i = degree; i >= 0; i--) {
        kelvin_octet row = *(const kelvin_octet *)c, row_y = {0}, row_yy = {0};
        c += KELVIN_OCTET;
        for (int j = degree - i; j > 0; j--, c += KELVIN_OCTET) {
            row_yy = row_yy * y + row_y; /* half of it */
            row_y = row_y * y + row;
            row = row * y + *(const kelvin_octet *)c;
        }
        fxx = fxx * x + fx; /* half of it */
        fx = fx * x + f;
        f = f * x + row;
        fxy = fxy * x + fy;
        fy = fy * x + row_y;
        fyy = fyy * x + row_yy;
    }
    sum[F] = f;
    sum[FX] = fx;
    sum[FY] = fy;
    sum[FXX] = 2 * fxx;
    sum[FXY] = fxy;
    sum[FYY] = 2 * fyy;
    return c;
}

KELVIN_INLINE double dot_lanes(const kelvin_octet *v, const kelvin_octet *w)
{
    kelvin_octet product = *v * *w;
    double a[KELVIN_OCTET];
    memcpy(a, &product, sizeof a);
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

/* Adds the coefficients of z^first to z^(first+7). */
KELVIN_INLINE void add_planes(const kelvin_octet sum[SUMS], int first, double z, double factor,
                              struct jet2 *jet)
{
    /* factor is z^(first-2), the powers of z that even the second derivative has */
    double z2 = z * z, z3 = z2 * z, z4 = z2 * z2, k = first;
    kelvin_octet power = {1, z, z2, z3, z4, z4 * z, z4 * z2, z4 * z3};
    kelvin_octet order = {k, k + 1, k + 2, k + 3, k + 4, k + 5, k + 6, k + 7};
    kelvin_octet value, slope, bend;
    if (first == 0) {
        kelvin_octet once = {0, 1, z, z2, z3, z4, z4 * z, z4 * z2};
        kelvin_octet twice = {0, 0, 1, z, z2, z3, z4, z4 * z};
        value = power;
        slope = order * once;
        bend = order * (order - 1) * twice;
    } else {
        value = power * (factor * z2);
        slope = order * power * (factor * z);
        bend = order * (order - 1) * power * factor;
    }
    jet->value += dot_lanes(&sum[F], &value);
    jet->d[0] += dot_lanes(&sum[FX], &value);
    jet->d[1] += dot_lanes(&sum[FY], &value);
    jet->d[2] += dot_lanes(&sum[F], &slope);
    jet->dd[0] += dot_lanes(&sum[FXX], &value);
    jet->dd[1] += dot_lanes(&sum[FXY], &value);
    jet->dd[2] += dot_lanes(&sum[FX], &slope);
    jet->dd[3] += dot_lanes(&sum[FYY], &value);
    jet->dd[4] += dot_lanes(&sum[FY], &slope);
    jet->dd[5] += dot_lanes(&sum[F], &bend);
}

KELVIN_INLINE void cell_jet2(const struct kelvin_coordinates *at, struct jet2 *jet)
{
    kelvin_octet sum[SUMS];
    double z = at->z, z2 = z * z, z4 = z2 * z2;
    int degree = (int)at->cell->degree;
    *jet = (struct jet2){0};
    const double *c = plane_sums(kelvin_coefficients + at->cell->offset, degree, at->x, at->y, sum);
    add_planes(sum, 0, z, 0.0, jet);
    if (degree >= KELVIN_OCTET) {
        plane_sums(c, degree - KELVIN_OCTET, at->x, at->y, sum);
        add_planes(sum, KELVIN_OCTET, z, z4 * z2, jet);
    }
    const double s[3] = {at->dx, KELVIN_DY, KELVIN_DY};
    for (int k = 0; k < 3; k++)
        jet->d[k] *= s[k];
    for (int k = 0, i = 0; i < 3; i++)
        for (int j = i; j < 3; j++)
            jet->dd[k++] *= s[i] * s[j];
}

/* N = r F(r, a, b), r = 1/M, in terms of M, a, b. */
KELVIN_INLINE void shell_jet2(const struct kelvin_place *place, struct jet2 *v)
{
    struct kelvin_coordinates at;
    struct jet2 f;
    double r = place->r, r2 = r * r;
    kelvin_shell_coordinates(place, &at);
    cell_jet2(&at, &f);
    v->value = r * f.value;
    v->d[0] = -r2 * (f.value + r * f.d[0]);
    v->d[1] = r * f.d[1];
    v->d[2] = r * f.d[2];
    /* d/dM = -r^2 d/dr twice on r F: 2 r^3 (F + r F_r) + r^4 (2 F_r + r F_rr). */
    v->dd[0] = r2 * r * (2 * f.value + 4 * r * f.d[0] + r2 * f.dd[0]);
    v->dd[1] = -r2 * (f.d[1] + r * f.dd[1]);
    v->dd[2] = -r2 * (f.d[2] + r * f.dd[2]);
    v->dd[3] = r * f.dd[3];
    v->dd[4] = r * f.dd[4];
    v->dd[5] = r * f.dd[5];
}

/* N - C = K - ln(M) L next to the origin. */
KELVIN_INLINE void near_jet2(const struct kelvin_place *place, struct jet2 *v)
{
    struct kelvin_coordinates at;
    struct jet2 L, K;
    double r = place->r, log_M = log(place->M);
    at.dx = 2 * KELVIN_R_NEAR;
    at.x = at.dx * place->M - 1;
    kelvin_cell_coordinates(place, KELVIN_ZONE_LOG_L, &at);
    cell_jet2(&at, &L);
    at.cell += KELVIN_CELLS_PER_ZONE;
    cell_jet2(&at, &K);
    v->value = K.value - log_M * L.value;
    for (int k = 0; k < 3; k++)
        v->d[k] = K.d[k] - log_M * L.d[k];
    for (int k = 0; k < 6; k++)
        v->dd[k] = K.dd[k] - log_M * L.dd[k];
    v->d[0] -= r * L.value;
    v->dd[0] += r * r * L.value - 2 * r * L.d[0];
    v->dd[1] -= r * L.d[1];
    v->dd[2] -= r * L.d[2];
}

/* What is asked for, of X, Y, U = |Z|. */
struct hessian {
    double XY, XU, YU, UU, X, Y, U; /* X, Y, U: first derivatives */
};

/* From (M, a, b) to (X, Y, U). m, p, q: derivatives along the axis called M, that of a, that of b.
 */
KELVIN_INLINE void chain2(const struct kelvin_place *place, const struct jet2 *v, struct hessian *h)
{
    double r = place->r, a = place->a, b = place->b, kappa = place->kappa,
           slope = 2 * place->ratio * r;
    const double *d = v->d, *dd = v->dd;
    double m = d[0] - r * (kappa * a * d[1] + b * d[2]);
    double mm = dd[0] - 2 * r * (kappa * a * dd[1] + b * dd[2]) +
                r * r *
                    (kappa * kappa * a * a * dd[3] + 2 * kappa * a * b * dd[4] + b * b * dd[5] +
                     kappa * (kappa + 1) * a * d[1] + 2 * b * d[2]);
    double mq = r * (dd[2] - r * (d[2] + kappa * a * dd[4] + b * dd[5]));
    double mp = slope * (dd[1] - r * (kappa * d[1] + kappa * a * dd[3] + b * dd[4]));
    double pq = slope * r * dd[4], qq = r * r * dd[5];
    double p = slope * d[1], q = r * d[2];
    if (place->face == 0)
        *h = (struct hessian){mp, mq, pq, qq, m, p, q};
    else if (place->face == 1)
        *h = (struct hessian){mp, pq, mq, qq, p, m, q};
    else
        *h = (struct hessian){pq, mq, mp, mm, q, p, m};
}

/* The closed part C = -2 (1 + U/(R+X)). Its derivatives follow from s = 1/(R+X): s_X = -s/R, s_Y =
 * -Y s^2/R, s_U = -U s^2/R. */
KELVIN_INLINE void add_pole(double X, double Y, double U, double r, struct hessian *h)
{
    double R = sqrt(X * X + Y * Y + U * U), s = 1 / (R + X), w = s / R, w3 = w / (R * R);
    double s_XY = Y * w3 * (1 + R * s), s_XU = U * w3 * (1 + R * s);
    double s_YU = Y * U * s * w3 * (1 + 2 * R * s);
    double s_UU = -s * w + U * U * s * w3 * (1 + 2 * R * s);
    double r2 = r * r;
    h->XY += -2 * U * s_XY * r2;
    h->XU += -2 * (-w + U * s_XU) * r2;
    h->YU += -2 * (-Y * s * w + U * s_YU) * r2;
    h->UU += -2 * (-2 * U * s * w + U * s_UU) * r2;
    h->X += 2 * U * w * r;
    h->Y += 2 * U * Y * s * w * r;
    h->U += -2 * (s - U * U * s * w) * r;
}

KELVIN_INLINE void octant_hessian(double X, double Y, double U, struct hessian *h)
{
    struct kelvin_place place;
    struct jet2 v;
    kelvin_place_point(X, Y, U, &place);
    if (place.r < KELVIN_R_NEAR) {
        shell_jet2(&place, &v);
        chain2(&place, &v, h);
        return;
    }
    near_jet2(&place, &v);
    chain2(&place, &v, h);
    add_pole(X * place.r, Y * place.r, U * place.r, place.r, h);
}

KELVIN_MULTIVERSION
static void second_batch(size_t n, const double *X, const double *Y, const double *Z, double *NXX,
                         double *NXY, double *NXZ, double *NYY, double *NYZ, double *NZZ)
{
    for (size_t i = 0; i < n; i++) {
        struct hessian h;
        octant_hessian(fabs(X[i]), fabs(Y[i]), -Z[i], &h);
        double sx = X[i] < 0 ? -1 : 1, sy = Y[i] < 0 ? -1 : 1;
        double R = sqrt(X[i] * X[i] + Y[i] * Y[i] + Z[i] * Z[i]);
        double XX = 2 * Z[i] / (R * R * R) + h.U;
        if (NXX)
            NXX[i] = XX;
        if (NXY)
            NXY[i] = sx * sy * h.XY;
        if (NXZ)
            NXZ[i] = -sx * h.XU;
        if (NYY)
            NYY[i] = -XX - h.UU;
        if (NYZ)
            NYZ[i] = -sy * h.YU;
        if (NZZ)
            NZZ[i] = h.UU;
    }
}

igabem_status igabem_kelvin_local_second(size_t n, const double *X, const double *Y,
                                         const double *Z, double *NXX, double *NXY, double *NXZ,
                                         double *NYY, double *NYZ, double *NZZ)
{
    igabem_status status = kelvin_check_domain("kelvin local part", n, X, Y, Z);
    if (status == IGABEM_OK)
        second_batch(n, X, Y, Z, NXX, NXY, NXZ, NYY, NYZ, NZZ);
    return status;
}

KELVIN_MULTIVERSION
static void slope_batch(size_t n, const double *X, const double *Y, const double *Z,
                        double *gradient, double *slope)
{
    for (size_t i = 0; i < n; i++) {
        struct hessian h;
        octant_hessian(fabs(X[i]), fabs(Y[i]), -Z[i], &h);
        double sx = X[i] < 0 ? -1 : 1, sy = Y[i] < 0 ? -1 : 1;
        double R = sqrt(X[i] * X[i] + Y[i] * Y[i] + Z[i] * Z[i]);
        gradient[i] = sx * h.X;
        gradient[n + i] = sy * h.Y;
        gradient[2 * n + i] = -h.U;
        slope[i] = sx * sy * h.XY;
        slope[n + i] = -(2 * Z[i] / (R * R * R) + h.U) - h.UU;
        slope[2 * n + i] = -sy * h.YU;
    }
}

igabem_status kelvin_local_slope(size_t n, const double *X, const double *Y, const double *Z,
                                 double *gradient, double *slope)
{
    igabem_status status = kelvin_check_domain("kelvin local part", n, X, Y, Z);
    if (status == IGABEM_OK)
        slope_batch(n, X, Y, Z, gradient, slope);
    return status;
}
