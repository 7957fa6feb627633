/* The Green function of n pairs of points, put together from its four parts. */
#include "kelvin/kelvin_green.h"

#include "core/error.h"

#include <math.h>

enum { BLOCK = 64 };

static const double quarter_pi = 0.079577471545947667884; /* 1/(4 pi) */

/* The pairs of one block relative to each other; X, Y, Z in units of 1/k0. */
struct block {
    size_t n;
    double dx[BLOCK], dy[BLOCK], below[BLOCK], above[BLOCK]; /* x-xi, y-eta, z-zeta, z+zeta */
    double X[BLOCK], Y[BLOCK], Z[BLOCK];
};

struct pairs {
    const double *x, *y, *z, *xi, *eta, *zeta;
};

static igabem_status check_pair(double k0, const struct pairs *p, size_t i, unsigned parts)
{
    const double value[6] = {p->x[i], p->y[i], p->z[i], p->xi[i], p->eta[i], p->zeta[i]};
    for (int k = 0; k < 6; k++)
        if (!isfinite(value[k]))
            return igabem_fail(IGABEM_ERROR_ARGUMENT,
                               "kelvin pair %zu: coordinate %d is %g, expected finite", i, k + 1,
                               value[k]);
    if (p->z[i] > 0 || p->zeta[i] > 0)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "kelvin pair %zu: z = %g, zeta = %g, expected points at or below z = 0",
                           i, p->z[i], p->zeta[i]);
    double reach =
        k0 * fmax(fmax(fabs(p->x[i] - p->xi[i]), fabs(p->y[i] - p->eta[i])), -p->z[i] - p->zeta[i]);
    if ((parts & IGABEM_WAVE) && !(reach <= 1e9))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "kelvin pair %zu: %g/k0 apart, expected within 1e9/k0", i, reach);
    if (p->x[i] != p->xi[i] || p->y[i] != p->eta[i])
        return IGABEM_OK;
    if ((parts & IGABEM_RANKINE) && p->z[i] == p->zeta[i])
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "kelvin pair %zu: the points coincide", i);
    if ((parts & ~(unsigned)IGABEM_RANKINE) && p->z[i] + p->zeta[i] == 0)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "kelvin pair %zu: the field point is the image of the source", i);
    return IGABEM_OK;
}

igabem_status kelvin_check_parts(unsigned parts)
{
    const unsigned all = IGABEM_RANKINE | IGABEM_IMAGE | IGABEM_LOCAL | IGABEM_WAVE | IGABEM_LID;
    if (parts & ~all)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "kelvin Green function: parts is %u, expected a sum of 1, 2, 4, 8, 16",
                           parts);
    if ((parts & IGABEM_IMAGE) && (parts & IGABEM_LID))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "kelvin Green function: parts asks for both signs of the image");
    return IGABEM_OK;
}

static igabem_status check(double k0, size_t n, const struct pairs *p, unsigned parts)
{
    if (!(k0 > 0) || !isfinite(k0))
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "kelvin Green function: k0 is %g, expected > 0",
                           k0);
    igabem_status status = kelvin_check_parts(parts);
    if (status != IGABEM_OK)
        return status;
    if (n > 0 && (!p->x || !p->y || !p->z || !p->xi || !p->eta || !p->zeta))
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "kelvin Green function: a coordinate array is NULL");
    for (size_t i = 0; status == IGABEM_OK && i < n; i++)
        status = check_pair(k0, p, i, parts);
    return status;
}

static void fill_block(double k0, const struct pairs *p, size_t first, size_t n, struct block *b)
{
    b->n = n;
    for (size_t i = 0; i < n; i++) {
        size_t k = first + i;
        b->dx[i] = p->x[k] - p->xi[k];
        b->dy[i] = p->y[k] - p->eta[k];
        b->below[i] = p->z[k] - p->zeta[k];
        b->above[i] = p->z[k] + p->zeta[k];
        b->X[i] = k0 * b->dx[i];
        b->Y[i] = k0 * b->dy[i];
        b->Z[i] = k0 * b->above[i];
    }
}

/* Adds strength/r and its gradient. */
static void add_pole(const struct block *b, const double *dz, double strength, double (*out)[BLOCK])
{
    for (size_t i = 0; i < b->n; i++) {
        double square = b->dx[i] * b->dx[i] + b->dy[i] * b->dy[i] + dz[i] * dz[i];
        double inverse = 1 / sqrt(square), pole = strength * inverse,
               slope = -pole * inverse * inverse;
        out[0][i] += pole;
        out[1][i] += slope * b->dx[i];
        out[2][i] += slope * b->dy[i];
        out[3][i] += slope * dz[i];
    }
}

/* Adds strength times the second derivatives xx, xy, xz, yy, yz, zz of 1/r. */
static void add_pole_second(const struct block *b, const double *dz, double strength,
                            double (*out)[BLOCK])
{
    for (size_t i = 0; i < b->n; i++) {
        double d[3] = {b->dx[i], b->dy[i], dz[i]};
        double inverse = 1 / sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        double cube = strength * inverse * inverse * inverse, fifth = 3 * cube * inverse * inverse;
        for (int r = 0, k = 0; r < 3; r++)
            for (int c = r; c < 3; c++, k++)
                out[k][i] += fifth * d[r] * d[c] - (r == c ? cube : 0);
    }
}

static void add_scaled(size_t n, double scale, const double *from, double *to)
{
    for (size_t i = 0; i < n; i++)
        to[i] += scale * from[i];
}

igabem_status kelvin_green_filtered(double k0, size_t n, const double *x, const double *y,
                                    const double *z, const double *xi, const double *eta,
                                    const double *zeta, unsigned parts,
                                    const igabem_kelvin_filter *filter, double *g, double *gx,
                                    double *gy, double *gz)
{
    struct pairs pairs = {x, y, z, xi, eta, zeta};
    double *target[4] = {g, gx, gy, gz};
    igabem_status status = check(k0, n, &pairs, parts);
    for (size_t first = 0; status == IGABEM_OK && first < n; first += BLOCK) {
        struct block b;
        double total[4][BLOCK] = {{0}}, part[4][BLOCK];
        fill_block(k0, &pairs, first, n - first < BLOCK ? n - first : BLOCK, &b);
        if (parts & IGABEM_RANKINE)
            add_pole(&b, b.below, -1, total);
        if (parts & (IGABEM_IMAGE | IGABEM_LID))
            add_pole(&b, b.above, parts & IGABEM_IMAGE ? 1 : -1, total);
        for (unsigned kind = IGABEM_LOCAL; kind <= IGABEM_WAVE && status == IGABEM_OK; kind *= 2) {
            if (!(parts & kind))
                continue;
            status =
                kind == IGABEM_LOCAL
                    ? igabem_kelvin_local(b.n, b.X, b.Y, b.Z, part[0], part[1], part[2], part[3])
                    : igabem_kelvin_wave_filtered(b.n, b.X, b.Y, b.Z, filter, part[0], part[1],
                                                  part[2], part[3]);
            for (int k = 0; k < 4; k++)
                add_scaled(b.n, k == 0 ? k0 : k0 * k0, part[k], total[k]);
        }
        for (int k = 0; k < 4; k++)
            for (size_t i = 0; target[k] && i < b.n; i++)
                target[k][first + i] = quarter_pi * total[k][i];
    }
    return status;
}

igabem_status igabem_kelvin_green(double k0, size_t n, const double *x, const double *y,
                                  const double *z, const double *xi, const double *eta,
                                  const double *zeta, unsigned parts, double *g, double *gx,
                                  double *gy, double *gz)
{
    return kelvin_green_filtered(k0, n, x, y, z, xi, eta, zeta, parts, NULL, g, gx, gy, gz);
}

igabem_status igabem_kelvin_green_second(double k0, size_t n, const double *x, const double *y,
                                         const double *z, const double *xi, const double *eta,
                                         const double *zeta, unsigned parts, double *gxx,
                                         double *gxy, double *gxz, double *gyy, double *gyz,
                                         double *gzz)
{
    struct pairs pairs = {x, y, z, xi, eta, zeta};
    double *target[6] = {gxx, gxy, gxz, gyy, gyz, gzz};
    igabem_status status = check(k0, n, &pairs, parts);
    for (size_t first = 0; status == IGABEM_OK && first < n; first += BLOCK) {
        struct block b;
        double total[6][BLOCK] = {{0}}, part[6][BLOCK];
        fill_block(k0, &pairs, first, n - first < BLOCK ? n - first : BLOCK, &b);
        if (parts & IGABEM_RANKINE)
            add_pole_second(&b, b.below, -1, total);
        if (parts & (IGABEM_IMAGE | IGABEM_LID))
            add_pole_second(&b, b.above, parts & IGABEM_IMAGE ? 1 : -1, total);
        for (unsigned kind = IGABEM_LOCAL; kind <= IGABEM_WAVE && status == IGABEM_OK; kind *= 2) {
            if (!(parts & kind))
                continue;
            status =
                (kind == IGABEM_LOCAL ? igabem_kelvin_local_second : igabem_kelvin_wave_second)(
                    b.n, b.X, b.Y, b.Z, part[0], part[1], part[2], part[3], part[4], part[5]);
            for (int k = 0; k < 6; k++)
                add_scaled(b.n, k0 * k0 * k0, part[k], total[k]);
        }
        for (int k = 0; k < 6; k++)
            for (size_t i = 0; target[k] && i < b.n; i++)
                target[k][first + i] = quarter_pi * total[k][i];
    }
    return status;
}
