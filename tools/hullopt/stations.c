#include "stations.h"

#include <math.h>
#include <stdlib.h>

enum { FINE_U = 600, FINE_V = 121 };

static void fill_parameters(const nurbs_surface *surface, int direction, size_t n, double *out)
{
    const double *knots = nurbs_surface_knots(surface, direction);
    size_t size = nurbs_surface_size(surface, direction);
    double first = knots[nurbs_surface_degree(surface, direction)], last = knots[size];
    for (size_t k = 0; k < n; k++)
        out[k] = k + 1 == n ? last : first + (last - first) * (double)k / (double)(n - 1);
}

bool stations_create(const nurbs_surface *surface, struct stations *s)
{
    double u[FINE_U], v[FINE_V];
    *s = (struct stations){FINE_U, FINE_V, malloc(sizeof(double) * 3 * FINE_U * FINE_V)};
    if (!s->points)
        return false;
    fill_parameters(surface, 0, FINE_U, u);
    fill_parameters(surface, 1, FINE_V, v);
    if (nurbs_surface_eval_grid(surface, 0, FINE_U, u, FINE_V, v, s->points) == NURBS_OK)
        return true;
    stations_free(s);
    return false;
}

void stations_free(struct stations *stations)
{
    free(stations->points);
    *stations = (struct stations){0};
}

/* The crossing nearest to midship where a girth line passes x more than once (a bent stem). */
static bool cross(const struct stations *s, size_t j, double x, double yz[2])
{
    bool found = false;
    for (size_t i = 0; i + 1 < s->nu; i++) {
        const double *a = s->points + 3 * (i * s->nv + j), *b = a + 3 * s->nv;
        if ((a[0] <= x) == (b[0] <= x))
            continue;
        double share = (x - a[0]) / (b[0] - a[0]), y = a[1] + share * (b[1] - a[1]);
        if (found && y < yz[0])
            continue;
        yz[0] = y;
        yz[1] = a[2] + share * (b[2] - a[2]);
        found = true;
    }
    return found;
}

size_t stations_section(const struct stations *s, double x, double (*yz)[2])
{
    size_t n = 0;
    for (size_t j = 0; j < s->nv; j++) {
        if (cross(s, j, x, yz[j]))
            n++;
        else
            yz[j][0] = yz[j][1] = NAN;
    }
    return n;
}

double stations_area(size_t n, const double (*yz)[2])
{
    double sum = 0;
    for (size_t j = 0; j + 1 < n; j++) {
        double ya = yz[j][0], za = yz[j][1], yb = yz[j + 1][0], zb = yz[j + 1][1];
        if (!isfinite(ya) || !isfinite(yb) || (za > 0 && zb > 0))
            continue;
        if (za > 0 || zb > 0) {
            double share = za / (za - zb), y = ya + share * (yb - ya);
            if (za > 0) {
                ya = y;
                za = 0;
            } else {
                yb = y;
                zb = 0;
            }
        }
        sum += (ya + yb) / 2 * (za - zb);
    }
    return 2 * fabs(sum);
}
