/* The local part N and its gradient from the tables of kelvin_table.h. */
#include "core/error.h"
#include "kelvin/kelvin_cell.h"
#include "kelvin/kelvin_domain.h"

#include <igabem/kelvin.h>

/* Derivatives with respect to a cell's x, y, z, or to M, a, b, or to X, Y, U = |Z|. */
struct jet {
    double value, d[3];
};

/* Sum_{i+j <= degree} c_ij x^i y^j for eight coefficients at once, with its derivatives in x and y:
 * Horner. */
KELVIN_INLINE const double *plane_sum(const double *c, int degree, double x, double y,
                                      kelvin_octet *f, kelvin_octet *fx, kelvin_octet *fy)
{
    kelvin_octet sum = {0}, sum_x = {0}, sum_y = {0};
    for (int i = degree; i >= 0; i--) {
        kelvin_octet row = *(const kelvin_octet *)c, row_y = {0};
        c += KELVIN_OCTET;
        for (int j = degree - i; j > 0; j--, c += KELVIN_OCTET) {
            row_y = row_y * y + row;
            row = row * y + *(const kelvin_octet *)c;
        }
        sum_x = sum_x * x + sum;
        sum = sum * x + row;
        sum_y = sum_y * x + row_y;
    }
    *f = sum;
    *fx = sum_x;
    *fy = sum_y;
    return c;
}

KELVIN_INLINE double add_lanes(const kelvin_octet *v)
{
    double a[KELVIN_OCTET];
    memcpy(a, v, sizeof a);
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

KELVIN_INLINE void cell_jet(const struct kelvin_coordinates *at, struct jet *jet)
{
    double z = at->z, z2 = z * z, z3 = z2 * z, z4 = z2 * z2, z7 = z4 * z3, z8 = z4 * z4;
    kelvin_octet power = {1, z, z2, z3, z4, z4 * z, z4 * z2, z7};
    kelvin_octet slope = {0, 1, 2 * z, 3 * z2, 4 * z3, 5 * z4, 6 * (z4 * z), 7 * (z4 * z2)};
    int degree = (int)at->cell->degree;
    kelvin_octet f, fx, fy;
    const double *c =
        plane_sum(kelvin_coefficients + at->cell->offset, degree, at->x, at->y, &f, &fx, &fy);
    kelvin_octet fz = f * slope;
    f *= power;
    fx *= power;
    fy *= power;
    if (degree >= KELVIN_OCTET) {
        kelvin_octet g, gx, gy;
        plane_sum(c, degree - KELVIN_OCTET, at->x, at->y, &g, &gx, &gy);
        kelvin_octet high = power * z8;
        fz += g * (slope * z8 + power * (8 * z7));
        f += g * high;
        fx += gx * high;
        fy += gy * high;
    }
    jet->value = add_lanes(&f);
    jet->d[0] = add_lanes(&fx) * at->dx;
    jet->d[1] = add_lanes(&fy) * KELVIN_DY;
    jet->d[2] = add_lanes(&fz) * KELVIN_DY;
}

/* N as a function of (M, a, b), and its derivatives. */
KELVIN_INLINE void shell_jet(const struct kelvin_place *place, struct jet *v)
{
    struct kelvin_coordinates at;
    struct jet f;
    double r = place->r;
    kelvin_shell_coordinates(place, &at);
    cell_jet(&at, &f);
    v->value = r * f.value;
    v->d[0] = -r * r * (f.value + r * f.d[0]);
    v->d[1] = r * f.d[1];
    v->d[2] = r * f.d[2];
}

/* The same for N - C = K - ln(M) L next to the origin. */
KELVIN_INLINE void near_jet(const struct kelvin_place *place, struct jet *v)
{
    struct kelvin_coordinates at;
    struct jet L, K;
    double log_M = log(place->M);
    at.dx = 2 * KELVIN_R_NEAR;
    at.x = at.dx * place->M - 1;
    kelvin_cell_coordinates(place, KELVIN_ZONE_LOG_L, &at);
    cell_jet(&at, &L);
    at.cell += KELVIN_CELLS_PER_ZONE;
    cell_jet(&at, &K);
    v->value = K.value - log_M * L.value;
    for (int k = 0; k < 3; k++)
        v->d[k] = K.d[k] - log_M * L.d[k];
    v->d[0] -= L.value * place->r;
}

/* From (M, a, b) to (X, Y, U): the axis called M, that of a, that of b. */
KELVIN_INLINE void chain(const struct kelvin_place *place, const struct jet *v, struct jet *out)
{
    static const int axis_M[3] = {0, 1, 2}, axis_a[3] = {1, 0, 1}, axis_b[3] = {2, 2, 0};
    double r = place->r;
    out->value = v->value;
    out->d[axis_M[place->face]] =
        v->d[0] - r * (place->kappa * place->a * v->d[1] + place->b * v->d[2]);
    out->d[axis_a[place->face]] = 2 * place->ratio * r * v->d[1];
    out->d[axis_b[place->face]] = r * v->d[2];
}

KELVIN_INLINE void octant_jet(double X, double Y, double U, struct jet *out)
{
    struct kelvin_place place;
    struct jet v;
    kelvin_place_point(X, Y, U, &place);
    if (place.r < KELVIN_R_NEAR) {
        shell_jet(&place, &v);
        chain(&place, &v, out);
        return;
    }
    struct kelvin_pole pole;
    near_jet(&place, &v);
    chain(&place, &v, out);
    kelvin_pole_at(X * place.r, Y * place.r, U * place.r, &pole);
    out->value += pole.value;
    out->d[0] += pole.dX * place.r;
    out->d[1] += pole.dY * place.r;
    out->d[2] += pole.dU * place.r;
}

KELVIN_MULTIVERSION
static void local_batch(size_t n, const double *X, const double *Y, const double *Z, double *N,
                        double *NX, double *NY, double *NZ)
{
    for (size_t i = 0; i < n; i++) {
        struct jet jet;
        octant_jet(fabs(X[i]), fabs(Y[i]), -Z[i], &jet);
        if (N)
            N[i] = jet.value;
        if (NX)
            NX[i] = X[i] < 0 ? -jet.d[0] : jet.d[0];
        if (NY)
            NY[i] = Y[i] < 0 ? -jet.d[1] : jet.d[1];
        if (NZ)
            NZ[i] = -jet.d[2];
    }
}

igabem_status igabem_kelvin_local(size_t n, const double *X, const double *Y, const double *Z,
                                  double *N, double *NX, double *NY, double *NZ)
{
    igabem_status status = kelvin_check_domain("kelvin local part", n, X, Y, Z);
    if (status == IGABEM_OK)
        local_batch(n, X, Y, Z, N, NX, NY, NZ);
    return status;
}
