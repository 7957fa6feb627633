/* Waves of one beta on a truncated line of cells: the matrix is Toeplitz, its symbol is R. */
#include "igabem_dispersion.h"

#include <lapacke.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

struct line {
    const struct dispersion_scheme *scheme;
    struct dispersion_grid grid;
    double eps, beta;
    int cells, ahead; /* of the disturbance */
    double depth;     /* of the disturbance, cells */
    int shift;        /* coefficients fixed upstream, less one */
};

/* Coefficients of V and R on the lattice, c[j] for the point j cells downstream of the coefficient,
 * n of them cyclic. */
static void fill_lattice(const struct line *line, int n, double complex *value,
                         double complex *relation)
{
    double complex *v = malloc((size_t)n * sizeof *v), *r = malloc((size_t)n * sizeof *r);
    if (!v || !r)
        abort();
    for (int k = 0; k < n; k++) {
        double alpha = 2 * pi * k / n - (2 * k > n ? 2 * pi : 0);
        v[k] = dispersion_value(line->scheme, alpha, line->beta);
        r[k] = v[k] - dispersion_wave(line->scheme, &line->grid, alpha, line->beta) / line->eps;
    }
    for (int j = 0; j < n; j++) {
        value[j] = relation[j] = 0;
        for (int k = 0; k < n; k++) {
            double complex e = cexp(-2 * I * pi * (double)((long)j * k % n) / n);
            value[j] += v[k] * e / n;
            relation[j] += r[k] * e / n;
        }
    }
    free(v);
    free(r);
}

/* Field of a pressure -exp(-k depth) over the line: f = transform of i u exp(-k depth)/k. */
static double disturbance(const struct line *line, double x)
{
    double sum = 0, step = 0.01, v = line->beta / line->grid.h;
    for (double u = 0.5 * step; u < 40 / line->depth; u += step) {
        double k = hypot(u, v);
        sum -= u * sin(u * x) * exp(-k * line->depth) / k * step / pi;
    }
    return sum;
}

/* Amplitude and phase, part of a cycle, of the wave `back` cells behind the disturbance over the
 * exact one; condition of the matrix in the 1-norm. */
static void solve_line(const struct line *line, double back, double out[3])
{
    enum { N = 1024 };
    static double complex value[N], relation[N];
    size_t n = (size_t)line->cells;
    double complex *a = malloc(n * n * sizeof *a), *b = malloc(n * sizeof *b);
    lapack_int *pivot = malloc(n * sizeof *pivot);
    if (!a || !b || !pivot)
        abort();
    fill_lattice(line, N, value, relation);
    for (int i = 0; i < line->cells; i++) {
        for (int m = 0; m < line->cells; m++)
            a[(size_t)m * n + (size_t)i] = relation[(i - m - line->shift + 2 * N) % N];
        b[i] = disturbance(line, line->ahead - i);
    }
    double norm = LAPACKE_zlange(LAPACK_COL_MAJOR, '1', (lapack_int)n, (lapack_int)n, a,
                                 (lapack_int)n),
           inverse = 0;
    if (LAPACKE_zgetrf(LAPACK_COL_MAJOR, (lapack_int)n, (lapack_int)n, a, (lapack_int)n, pivot) ||
        LAPACKE_zgecon(LAPACK_COL_MAJOR, '1', (lapack_int)n, a, (lapack_int)n, norm, &inverse) ||
        LAPACKE_zgetrs(LAPACK_COL_MAJOR, 'N', (lapack_int)n, 1, a, (lapack_int)n, pivot, b,
                       (lapack_int)n))
        inverse = 0;
    double v = line->beta / line->grid.h;
    double k0 = 0.5 * line->eps + sqrt(0.25 * line->eps * line->eps + v * v);
    double u0 = sqrt(line->eps * k0), length = fmax(2 * pi / u0, 6);
    double slope = -(2 * u0 / (line->eps * k0) - pow(u0, 3) / (line->eps * pow(k0, 3)));
    double normal[3] = {0}, side[2] = {0};
    for (int i = 0; i < line->cells; i++) {
        double x = line->ahead - i;
        if (x > -back || x < -back - length)
            continue;
        double complex phi = 0;
        for (int m = 0; m < line->cells; m++)
            phi += value[(i - m - line->shift + 2 * N) % N] * b[m];
        double c = cos(u0 * x), s = sin(u0 * x);
        normal[0] += c * c;
        normal[1] += c * s;
        normal[2] += s * s;
        side[0] += c * creal(phi);
        side[1] += s * creal(phi);
    }
    double det = normal[0] * normal[2] - normal[1] * normal[1];
    double complex wave = (side[0] * normal[2] - side[1] * normal[1]) / det -
                          I * (side[1] * normal[0] - side[0] * normal[1]) / det;
    double complex exact = 2 * u0 * exp(-k0 * line->depth) / k0 / slope;
    out[0] = cabs(wave / exact);
    out[1] = carg(wave / exact) / (2 * pi);
    out[2] = 1 / inverse;
    free(a);
    free(b);
    free(pivot);
}

static void print_line(const struct line *line, const char *what)
{
    printf("| %s | %s | %.2f | %g | %d |", line->scheme->name, what, line->beta / pi, line->grid.h,
           line->shift + 1);
    for (int cells = 96; cells <= 192; cells *= 2) {
        struct line at = *line;
        at.cells = cells;
        double out[3];
        solve_line(&at, 54, out);
        if (out[2] < 1e9 && line->grid.tau == 0)
            printf(" %.4f | %+.2f | %.1e |", out[0], 100 * out[1], out[2]);
        else
            printf(" - | - | %.1e |", out[2]);
    }
    printf("\n");
    fflush(stdout);
}

void dispersion_print_lines(void)
{
    static const double angle[] = {20, 35.264, 50, 60};
    const double eps = 2 * pi / 12;
    printf(
        "\nWaves of one beta on 96 and 192 cells, 12 a transverse wave: amplitude over the exact "
        "one and phase, per cent of a cycle, 4.5 transverse waves behind a pressure, and "
        "condition; `-`: not stable, or lines oblique\n\n| scheme | change | beta/pi | dy/dx | "
        "upstream conditions | amplitude | "
        "phase | condition | amplitude | phase | condition |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t s = 0; s < SCHEMES; s++)
        for (int k = 0; k < 4 && s != SHARP; k++) {
            double t = angle[k] * pi / 180;
            struct line line = {.scheme = &dispersion_schemes[s],
                                .grid = {.h = 1},
                                .eps = eps,
                                .beta = eps / cos(t) * tan(t),
                                .ahead = 24,
                                .depth = 1.8,
                                .shift = 1};
            print_line(&line, "none");
            for (line.shift = 0; line.shift <= 2 && k == 1 && s == USED; line.shift += 2)
                print_line(&line, "none");
        }
    static const double filter[] = {0.25, 0.5, 1}, across[] = {0.5, 0.8, 1};
    for (int w = 0; w < 6; w++)
        for (int k = 0; k < 3; k++) {
            struct dispersion_scheme scheme = dispersion_schemes[w < 3 ? 3 : USED];
            char what[32];
            if (w < 3)
                scheme.filter = filter[w];
            else
                scheme.odd = filter[w - 3];
            snprintf(what, sizeof what, w < 3 ? "even filter %g" : "odd damping %g", filter[w % 3]);
            struct line line = {.scheme = &scheme,
                                .grid = {.h = 1},
                                .eps = eps,
                                .beta = pi * across[k],
                                .ahead = 24,
                                .depth = 1.8,
                                .shift = 1};
            print_line(&line, what);
        }
    for (size_t s = SHARP; s <= USED; s++)
        for (int cells = 12; cells <= 192; cells *= 4) {
            char what[48];
            snprintf(what, sizeof what, "lines at 0.3, %d cells a wave", cells);
            struct line line = {.scheme = &dispersion_schemes[s],
                                .grid = {.h = 0.5, .tau = -0.6},
                                .eps = 2 * pi / cells,
                                .beta = 0.8 * pi,
                                .ahead = 24,
                                .depth = 1.8,
                                .shift = 1};
            print_line(&line, what);
        }
}
