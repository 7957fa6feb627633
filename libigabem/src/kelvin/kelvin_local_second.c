/* Second derivatives of N from the tables of kelvin_table.h. N_XX and the component left over by
 * Laplace's equation come from N_XX = 2 Z/R^3 - N_Z; the others from the polynomials. */
#include "core/error.h"
#include "kelvin/kelvin_cell.h"
#include "kelvin/kelvin_domain.h"

#include <igabem/kelvin.h>

/* Value, gradient and Hessian (xx, xy, xz, yy, yz, zz) in a cell's x, y, z or in M, a, b. */
struct jet2 {
    double value, d[3], dd[6];
};

/* Sum of c_ijk x^i y^j z^k over the cell, by powers of z inside Horner's rule in x and y. */
static void cell_jet2(const struct kelvin_coordinates *at, struct jet2 *jet)
{
    double x = at->x, y = at->y, power[2 * KELVIN_OCTET + 8], sum[3][3][3] = {{{0}}};
    int degree = (int)at->cell->degree;
    power[0] = 1;
    for (int k = 1; k <= degree; k++)
        power[k] = power[k - 1] * at->z;
    const double *c = kelvin_coefficients + at->cell->offset;
    for (int first = 0; first <= degree; first += KELVIN_OCTET)
        for (int part = 0; part < 3; part++) {
            /* part: order of the derivative in z, as a weight on the powers. */
            double weight[KELVIN_OCTET] = {0}, plane[3][3] = {{0}};
            for (int l = 0; l < KELVIN_OCTET && first + l <= degree; l++) {
                int k = first + l;
                double factor = part == 0 ? 1 : part == 1 ? k : k * (k - 1.0);
                weight[l] = k >= part ? factor * power[k - part] : 0;
            }
            const double *row = c;
            for (int i = degree - first; i >= 0; i--) {
                double r[3] = {0};
                for (int j = degree - first - i; j >= 0; j--, row += KELVIN_OCTET) {
                    double s = 0;
                    for (int l = 0; l < KELVIN_OCTET; l++)
                        s += row[l] * weight[l];
                    r[2] = r[2] * y + 2 * r[1];
                    r[1] = r[1] * y + r[0];
                    r[0] = r[0] * y + s;
                }
                for (int q = 0; q < 3; q++) {
                    plane[2][q] = plane[2][q] * x + 2 * plane[1][q];
                    plane[1][q] = plane[1][q] * x + plane[0][q];
                    plane[0][q] = plane[0][q] * x + r[q];
                }
            }
            for (int p = 0; p < 3; p++)
                for (int q = 0; q < 3; q++)
                    sum[p][q][part] += plane[p][q];
            if (part == 2)
                c = row;
        }
    double s[3] = {at->dx, KELVIN_DY, KELVIN_DY};
    jet->value = sum[0][0][0];
    jet->d[0] = s[0] * sum[1][0][0];
    jet->d[1] = s[1] * sum[0][1][0];
    jet->d[2] = s[2] * sum[0][0][1];
    jet->dd[0] = s[0] * s[0] * sum[2][0][0];
    jet->dd[1] = s[0] * s[1] * sum[1][1][0];
    jet->dd[2] = s[0] * s[2] * sum[1][0][1];
    jet->dd[3] = s[1] * s[1] * sum[0][2][0];
    jet->dd[4] = s[1] * s[2] * sum[0][1][1];
    jet->dd[5] = s[2] * s[2] * sum[0][0][2];
}

/* N = r F(r, a, b), r = 1/M, in terms of M, a, b. */
static void shell_jet2(const struct kelvin_place *place, struct jet2 *v)
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
static void near_jet2(const struct kelvin_place *place, struct jet2 *v)
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
    double XY, XU, YU, UU, U; /* U: first derivative */
};

/* From (M, a, b) to (X, Y, U). m, p, q: derivatives along the axis called M, that of a, that of b.
 */
static void chain2(const struct kelvin_place *place, const struct jet2 *v, struct hessian *h)
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
    if (place->face == 0)
        *h = (struct hessian){mp, mq, pq, qq, r * d[2]};
    else if (place->face == 1)
        *h = (struct hessian){mp, pq, mq, qq, r * d[2]};
    else
        *h = (struct hessian){pq, mq, mp, mm, m};
}

/* The closed part C = -2 (1 + U/(R+X)). Its derivatives follow from s = 1/(R+X): s_X = -s/R, s_Y =
 * -Y s^2/R, s_U = -U s^2/R. */
static void add_pole(double X, double Y, double U, double r, struct hessian *h)
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
    h->U += -2 * (s - U * U * s * w) * r;
}

static void octant_hessian(double X, double Y, double U, struct hessian *h)
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

igabem_status igabem_kelvin_local_second(size_t n, const double *X, const double *Y,
                                         const double *Z, double *NXX, double *NXY, double *NXZ,
                                         double *NYY, double *NYZ, double *NZZ)
{
    igabem_status status = kelvin_check_domain("kelvin local part", n, X, Y, Z);
    for (size_t i = 0; status == IGABEM_OK && i < n; i++) {
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
    return status;
}
