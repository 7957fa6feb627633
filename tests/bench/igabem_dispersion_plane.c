/* A submerged source and a moving pressure, whose waves are known exactly, on a truncated plane of
 * equal cells. Lengths in cells along the stream. Beyond the plane phi_xx is zero. */
#include "igabem_dispersion.h"

#include <igabem/kelvin.h>

#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { WAVES = 512, TAPS = 5, REACH = 2, SIXTH = 7 };

enum edge { EDGE_CONSTANT, EDGE_LINEAR, EDGE_PARABOLA, EDGE_ZERO };
enum zone { ZONE_NONE, ZONE_DOWNSTREAM, ZONE_SIDE };

struct plane {
    const char *what;
    const struct dispersion_scheme *scheme;
    int cells; /* a transverse wave */
    double h;
    double up, down, half; /* extents, transverse waves */
    double at;             /* where the waves are compared, transverse waves aft */
    enum edge edge;
    enum zone zone; /* where Rayleigh damping absorbs, over the last wave */
    int pressure;   /* for a pressure, 0 a source */
};

static double *allocate(size_t n)
{
    double *p = calloc(n, sizeof *p);
    if (!p) {
        fprintf(stderr, "no memory\n");
        exit(1);
    }
    return p;
}

/* exp(-z) I0(z) */
static double bessel(double z)
{
    enum { N = 400 };
    double sum = 0;
    for (int k = 0; k < N; k++)
        sum += exp(-z * (1 - cos(pi * (k + 0.5) / N))) / N;
    return sum;
}

/* Influences of unit nodal values of phi_xx, g[i * across + j] at i cells along, j cells across:
 * transform of the kernel less exp(-s^2 k^2)/k, whose own is closed. */
static void fill_influences(const struct plane *plane, int along, int across, double *g)
{
    const int half = WAVES / 2 + 1;
    double s = 1.75 * fmax(1, plane->h), *symbol = allocate((size_t)half * (size_t)half),
           *partial = allocate((size_t)along * (size_t)half), *cosine = allocate(WAVES);
    struct dispersion_grid grid = {.h = plane->h};
    for (int k = 0; k < WAVES; k++)
        cosine[k] = cos(2 * pi * k / WAVES);
    for (int a = 0; a < half; a++)
        for (int b = 0; b < half; b++) {
            double u = 2 * pi * a / WAVES, v = 2 * pi * b / WAVES, k = hypot(u, v / plane->h);
            if (k > 0)
                symbol[a * half + b] = dispersion_kernel(plane->scheme->density, &grid, u, v) -
                                       exp(-s * s * k * k) / k;
        }
    for (int i = 0; i < along; i++)
        for (int a = 0; a < half; a++)
            for (int b = 0; b < half; b++)
                partial[i * half + b] += (a == 0 || a == half - 1 ? 1.0 : 2.0) / WAVES *
                                         cosine[(long)i * a % WAVES] * symbol[a * half + b];
    for (int i = 0; i < along; i++)
        for (int j = 0; j < across; j++) {
            double sum = 0, r = hypot(i, plane->h * j);
            for (int b = 0; b < half; b++)
                sum += (b == 0 || b == half - 1 ? 1.0 : 2.0) / WAVES * cosine[(long)j * b % WAVES] *
                       partial[i * half + b];
            g[i * across + j] =
                sum + plane->h / (2 * pi) * sqrt(pi) / (2 * s) * bessel(r * r / (8 * s * s));
        }
    free(symbol);
    free(partial);
    free(cosine);
}

/* Adds the coefficient i of nx + 1, of which 0 and those before it are fixed by the edge, to a row
 * over the unknowns 1 .. nx. */
static void add_along(const struct plane *plane, int nx, int i, double factor, double *row)
{
    double e = i - 1;
    if (i >= 1 && i <= nx) {
        row[i - 1] += factor;
    } else if (i > nx) {
        row[nx - 1] += factor * (1 + (i - nx));
        row[nx - 2] -= factor * (i - nx);
    } else if (plane->edge == EDGE_CONSTANT) {
        row[0] += factor;
    } else if (plane->edge == EDGE_LINEAR) {
        row[0] += factor * (1 - e);
        row[1] += factor * e;
    } else if (plane->edge == EDGE_PARABOLA) {
        row[0] += factor * (1 - e) * (2 - e) / 2;
        row[1] += factor * e * (2 - e);
        row[2] += factor * e * (e - 1) / 2;
    }
}

/* phi, phi_x and phi_xx at the middles of cells 0 .. nx-1 from the unknowns. */
static void fill_along(const struct plane *plane, int nx, double *value, double *slope,
                       double *second)
{
    static const double stencil[2][3][TAPS] = {
        {{0, 0.125, 0.75, 0.125, 0}, {0, 0.5, 0, -0.5, 0}, {0, 1, -2, 1, 0}},
        {{0, 0.125, 0.75, 0.125, 0},
         {-1.0 / 48, 13.0 / 24, 0, -13.0 / 24, 1.0 / 48},
         {1.0 / 24, 5.0 / 6, -1.75, 5.0 / 6, 1.0 / 24}}};
    double *out[3] = {value, slope, second};
    for (int i = 0; i < nx; i++)
        for (int d = 0; d < 3; d++)
            for (int k = 0; k < TAPS; k++)
                add_along(
                    plane, nx, i + k - REACH,
                    stencil[plane->scheme->derivative == DISPERSION_FOURTH && i < nx - 1][d][k],
                    out[d] + (size_t)i * (size_t)nx);
}

/* phi at the middles across from the coefficients, and their sixth difference inside. */
static void fill_across(int ny, double *value, double *sixth)
{
    static const double phi[SIXTH] = {0, 0, 0.125, 0.75, 0.125, 0, 0},
                        d6[SIXTH] = {-1, 6, -15, 20, -15, 6, -1};
    for (int j = 0; j < ny; j++)
        for (int k = 0; k < SIXTH; k++) {
            int m = j + k - SIXTH / 2;
            m = m < 0 ? -1 - m : m;
            if (j + SIXTH / 2 < ny)
                sixth[j * ny + m] += d6[k];
            if (m < ny) {
                value[j * ny + m] += phi[k];
            } else {
                value[j * ny + ny - 1] += phi[k] * (m - ny + 2);
                value[j * ny + ny - 2] -= phi[k] * (m - ny + 1);
            }
        }
}

/* Rayleigh damping per cell in the zones. */
static double absorption(const struct plane *plane, int nx, int ny, int i, int j)
{
    double s = 0, wave = plane->cells;
    if (plane->zone == ZONE_DOWNSTREAM)
        s = 1 - (nx - i - 0.5) / wave;
    if (plane->zone == ZONE_SIDE)
        s = 1 - (ny - j - 0.5) * plane->h / wave;
    return s > 0 ? 6 / wave * s * s : 0;
}

/* out = left (rows x n) times right (n x columns), row major, added. */
static void multiply(int rows, int n, int columns, const double *left, const double *right,
                     double *out)
{
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < n; k++) {
            double f = left[(size_t)i * (size_t)n + (size_t)k];
            const double *r = right + (size_t)k * (size_t)columns;
            double *o = out + (size_t)i * (size_t)columns;
            if (f != 0)
                for (int j = 0; j < columns; j++)
                    o[j] += f * r[j];
        }
}

/* Adds what the density at the middle of (i, j), a row over the unknowns with few entries, does at
 * all middles. */
static void add_density(const double *g, int nx, int ny, int i, int j, const double *density,
                        double factor, double *a)
{
    size_t n = (size_t)nx * (size_t)ny;
    for (size_t column = 0; column < n; column++) {
        double f = factor * density[column];
        if (f == 0)
            continue;
        for (int k = 0; k < nx; k++)
            for (int m = 0; m < ny; m++)
                a[column * n + (size_t)(k * ny + m)] +=
                    f * (g[abs(i - k) * 2 * ny + abs(j - m)] + g[abs(i - k) * 2 * ny + j + m + 1]);
    }
}

struct solution {
    int nx, ny;
    double *slope; /* phi_x at the middles, [nx ny] */
};

static void solve_plane(const struct plane *plane, struct solution *solution)
{
    int nx = (int)lround((plane->up + plane->down) * plane->cells);
    int ny = (int)lround(plane->half * plane->cells / plane->h);
    size_t n = (size_t)nx * (size_t)ny, nn = (size_t)nx * (size_t)nx;
    double eps = 2 * pi / plane->cells, depth = 0.15 * plane->cells;
    double *g = allocate((size_t)nx * 2 * (size_t)ny), *d[3], *y[2];
    for (int k = 0; k < 3; k++)
        d[k] = allocate(nn);
    for (int k = 0; k < 2; k++)
        y[k] = allocate((size_t)ny * (size_t)ny);
    fill_influences(plane, nx, 2 * ny, g);
    fill_along(plane, nx, d[0], d[1], d[2]);
    fill_across(ny, y[0], y[1]);
    double *a = allocate(n * n), *b = allocate(n), *density = allocate(n);
    for (int i = 0; i < nx; i++)
        for (int j = 0; j < ny; j++) {
            double mu = absorption(plane, nx, ny, i, j), odd = plane->scheme->odd / 64;
            for (int k = 0; k < nx; k++)
                for (int m = 0; m < ny; m++)
                    density[k * ny + m] =
                        (d[2][i * nx + k] - 2 * mu * d[1][i * nx + k]) * y[0][j * ny + m] -
                        2 * odd * d[1][i * nx + k] * y[1][j * ny + m];
            add_density(g, nx, ny, i, j, density, 1 / eps, a);
        }
    for (int i = 0; i < nx; i++)
        for (int j = 0; j < ny; j++) {
            size_t row = (size_t)i * (size_t)ny + (size_t)j;
            for (int k = 0; k < nx; k++)
                for (int m = 0; m < ny; m++)
                    a[(size_t)(k * ny + m) * n + row] += d[0][i * nx + k] * y[0][j * ny + m];
            double x = plane->up * plane->cells - i, across = (j + 0.5) * plane->h;
            double r = sqrt(x * x + across * across + depth * depth);
            b[row] = plane->pressure ? x / (2 * pi * r * r * r) : -1 / (2 * pi * r);
        }
    lapack_int *pivot = malloc(n * sizeof *pivot);
    if (!pivot || LAPACKE_dgesv(LAPACK_COL_MAJOR, (lapack_int)n, 1, a, (lapack_int)n, pivot, b,
                                (lapack_int)n))
        fprintf(stderr, "no solution\n");
    solution->nx = nx;
    solution->ny = ny;
    solution->slope = allocate(n);
    double *phi = allocate(n);
    for (int i = 0; i < nx; i++)
        multiply(1, ny, ny, b + i * ny, y[0], phi + i * ny);
    multiply(nx, nx, ny, d[1], phi, solution->slope);
    free(phi);
    free(pivot);
    free(a);
    free(density);
    free(b);
    free(g);
    for (int k = 0; k < 3; k++)
        free(d[k]);
    for (int k = 0; k < 2; k++)
        free(y[k]);
}

/* Exact phi_x and phi_xx; of a pressure by differences of those of a source. */
static void exact(const struct plane *plane, double x, double y, double out[2])
{
    const double eps = 2 * pi / plane->cells, zero = 0, depth = -0.15 * plane->cells, step = 0.02;
    double f[3], xx[3];
    for (int k = -1; k <= 1; k++) {
        double at = x + step * k, g, gx, gy, gz, gxy, gxz, gyy, gyz, gzz;
        const unsigned all = IGABEM_RANKINE | IGABEM_IMAGE | IGABEM_LOCAL | IGABEM_WAVE;
        if (igabem_kelvin_green(eps, 1, &at, &y, &zero, &zero, &zero, &depth, all, &g, &gx, &gy,
                                &gz) ||
            igabem_kelvin_green_second(eps, 1, &at, &y, &zero, &zero, &zero, &depth, all,
                                       &xx[k + 1], &gxy, &gxz, &gyy, &gyz, &gzz))
            gx = xx[k + 1] = NAN;
        f[k + 1] = gx;
    }
    out[0] = plane->pressure ? xx[1] : f[1];
    out[1] = plane->pressure ? (xx[2] - xx[0]) / (2 * step) : xx[1];
}

/* Over one wave length about `at`: the multiple of the exact elevation and the shift that fit best,
 * and the difference left, on the track, inside and near the edge of the wedge. */
static void print_plane(const struct plane *plane)
{
    static const double sector[4] = {-1, 0.05, 0.2, 0.33};
    struct solution solution;
    solve_plane(plane, &solution);
    printf("| %s | %s | %d | %g |", plane->scheme->name, plane->what, plane->cells, plane->h);
    for (int s = 0; s < 3; s++) {
        double m[3] = {0}, r[2] = {0}, left = 0;
        for (int i = 0; i < solution.nx; i++)
            for (int j = 0; j < solution.ny; j++) {
                double x = plane->up * plane->cells - i, y = (j + 0.5) * plane->h, e[2];
                double back = -x / plane->cells - plane->at;
                if (!(back > -0.5 && back < 0.5 && y / -x > sector[s] && y / -x <= sector[s + 1]))
                    continue;
                exact(plane, x, y, e);
                double z = solution.slope[i * solution.ny + j];
                m[0] += e[0] * e[0];
                m[1] += e[0] * e[1];
                m[2] += e[1] * e[1];
                r[0] += e[0] * z;
                r[1] += e[1] * z;
                left += (z - e[0]) * (z - e[0]);
            }
        double det = m[0] * m[2] - m[1] * m[1], p = (r[0] * m[2] - r[1] * m[1]) / det,
               q = (r[1] * m[0] - r[0] * m[1]) / det;
        printf(" %.4f | %+.2f | %.1f |", p, 100 * q / p / plane->cells, 100 * sqrt(left / m[0]));
    }
    printf("\n");
    fflush(stdout);
    free(solution.slope);
}

void dispersion_print_planes(void)
{
    static struct dispersion_scheme damped[3];
    const struct dispersion_scheme *used = &dispersion_schemes[USED];
    const struct plane far = {.what = "",
                              .scheme = used,
                              .cells = 12,
                              .h = 1,
                              .up = 2,
                              .down = 6,
                              .half = 2.3,
                              .at = 5,
                              .edge = EDGE_LINEAR},
                       near = {.what = "",
                               .scheme = used,
                               .cells = 12,
                               .h = 1,
                               .up = 1,
                               .down = 4.2,
                               .half = 1.7,
                               .at = 3,
                               .edge = EDGE_LINEAR};
    printf(
        "Elevation behind a submerged source (depth 0.15 waves) and a pressure on a plane: "
        "amplitude over the exact one, phase in per cent of a cycle, difference in per cent; "
        "on the track, inside the wedge, near its edge\n\n"
        "| scheme | change | cells a wave | dy/dx | amplitude | phase | difference | amplitude | "
        "phase | difference | amplitude | phase | difference |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    struct plane plane = far;
    for (int s = 3; s <= USED; s++) {
        plane.scheme = &dispersion_schemes[s];
        plane.what = "5 waves aft";
        if (s != SHARP)
            print_plane(&plane);
    }
    plane.pressure = 1;
    plane.what = "the same, pressure";
    print_plane(&plane);
    static const char *const edges[] = {"constant upstream", "linear upstream", "parabola upstream",
                                        "zero upstream"};
    static const double ups[] = {0.5, 1, 2};
    for (int k = 0; k < 3; k++)
        for (int e = 0; e < 4; e++) {
            char what[64];
            plane = near;
            plane.up = ups[k];
            plane.edge = (enum edge)e;
            snprintf(what, sizeof what, "3 waves aft, %s, %g waves ahead", edges[e], ups[k]);
            plane.what = what;
            print_plane(&plane);
        }
    static const double halves[] = {1.2, 1.4, 2};
    for (int k = 0; k < 3; k++)
        for (int z = 0; z < 2; z++) {
            char what[64];
            plane = near;
            plane.half = halves[k];
            plane.zone = z ? ZONE_SIDE : ZONE_NONE;
            snprintf(what, sizeof what, "half width %g waves, %s", halves[k],
                     z ? "side absorbs" : "nothing");
            plane.what = what;
            print_plane(&plane);
        }
    static const double downs[] = {3.6, 4, 5};
    for (int k = 0; k < 3; k++)
        for (int z = 0; z < 2; z++) {
            char what[64];
            plane = near;
            plane.down = downs[k];
            plane.zone = z ? ZONE_DOWNSTREAM : ZONE_NONE;
            snprintf(what, sizeof what, "edge %g waves aft, %s", downs[k],
                     z ? "last wave absorbs" : "nothing");
            plane.what = what;
            print_plane(&plane);
        }
    for (int k = 0; k < 3; k++) {
        char what[64];
        damped[k] = *used;
        damped[k].odd = sqrt(2 * pi / 12 / pi) * (k == 0 ? 0.25 : k == 1 ? 0.5 : 1);
        plane = near;
        plane.scheme = &damped[k];
        snprintf(what, sizeof what, "odd damping %.3f", damped[k].odd);
        plane.what = what;
        print_plane(&plane);
    }
    static const int cells[] = {8, 12, 16, 20};
    for (int k = 0; k < 4; k++) {
        plane = near;
        plane.cells = cells[k];
        plane.up = 1;
        plane.what = "refined";
        print_plane(&plane);
    }
    plane = near;
    plane.h = 0.5;
    plane.what = "narrow cells";
    print_plane(&plane);
}
