/* Arithmetic of x,y,z triples. */
#ifndef NURBS_VECTOR_H
#define NURBS_VECTOR_H

#include <math.h>

static inline double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double norm3(const double a[3])
{
    return sqrt(dot3(a, a));
}

static inline void cross3(const double a[3], const double b[3], double out[3])
{
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    for (int k = 0; k < 3; k++)
        out[k] = c[k];
}

static inline void minus3(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] - b[k];
}

/* out = a + s b */
static inline void along3(const double a[3], double s, const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[k] + s * b[k];
}

static inline double distance3(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return norm3(d);
}

/* Returns the length; leaves a vector of no length as it is. */
static inline double unit3(double a[3])
{
    double length = norm3(a);
    for (int k = 0; k < 3 && length > 0; k++)
        a[k] /= length;
    return length;
}

/* A unit vector x perpendicular to the unit vector z, near `wish` where that is not along z. */
static inline void perpendicular3(const double z[3], const double wish[3], double x[3])
{
    along3(wish, -dot3(wish, z), z, x);
    if (unit3(x) > 1e-9)
        return;
    int least = fabs(z[0]) <= fabs(z[1]) && fabs(z[0]) <= fabs(z[2]) ? 0
                : fabs(z[1]) <= fabs(z[2])                           ? 1
                                                                     : 2;
    double e[3] = {0, 0, 0};
    e[least] = 1;
    along3(e, -z[least], z, x);
    unit3(x);
}

#endif
