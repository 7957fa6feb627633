/* Discrete dispersion relation of the spline spaces of an exterior Rankine method: tables of the
 * phase error, of stability, of truncated grids; with "picture" docs/images/dispersion.svg on the
 * standard output, with "planes" the submerged source and the pressure patch alone (minutes). */
#include "igabem_dispersion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

const struct dispersion_scheme dispersion_schemes[SCHEMES] = {
    {.name = "quadratic, exact integrals", .degree = 2, .derivative = DISPERSION_EXACT},
    {.name = "cubic, exact integrals", .degree = 3, .derivative = DISPERSION_EXACT},
    {.name = "quartic, exact integrals", .degree = 4, .derivative = DISPERSION_EXACT},
    {.name = "quadratic, own derivative, constant density",
     .degree = 2,
     .derivative = DISPERSION_OWN},
    {.name = "quadratic, own derivative, quadratic density",
     .degree = 2,
     .derivative = DISPERSION_OWN,
     .density = 2},
    {.name = "quadratic, order 4, second derivative across",
     .degree = 2,
     .derivative = DISPERSION_FOURTH,
     .density = 2},
    {.name = "quadratic, order 4, first derivative twice across",
     .degree = 2,
     .derivative = DISPERSION_FOURTH,
     .density = 2,
     .twice = true}};

static void print_phases(void)
{
    static const double angle[] = {0, 20, 35.264, 50, 60}, aspect[] = {0.5, 1, 2};
    static const int cells[] = {6, 8, 12, 16, 24, 48};
    printf("Error of the wave number along the stream, per cent, lines along the stream; columns: "
           "angle of the wave/dy over dx; `-`: fewer than two cells a wave across\n\n"
           "| scheme | cells a transverse wave |");
    for (size_t k = 0; k < sizeof angle / sizeof *angle; k++)
        for (size_t l = 0; l < (k ? 3 : 1); l++)
            printf(" %.0f/%g |", angle[k], aspect[l]);
    printf("\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (size_t s = 0; s < SCHEMES; s++) {
        if (s == SHARP)
            continue;
        for (size_t c = 0; c < sizeof cells / sizeof *cells; c++) {
            double eps = 2 * pi / cells[c];
            printf("| %s | %d |", dispersion_schemes[s].name, cells[c]);
            for (size_t k = 0; k < sizeof angle / sizeof *angle; k++)
                for (size_t l = 0; l < (k ? 3 : 1); l++) {
                    struct dispersion_grid grid = {.h = aspect[l]};
                    double t = angle[k] * pi / 180, u = eps / cos(t), beta = u * tan(t) * grid.h;
                    double a = beta < pi
                                   ? dispersion_root(&dispersion_schemes[s], &grid, beta, eps, u)
                                   : NAN;
                    if (isnan(a))
                        printf(" - |");
                    else
                        printf(" %.3f |", 100 * (a / u - 1));
                }
            printf("\n");
        }
    }
}

void dispersion_first_lost(const struct dispersion_scheme *scheme,
                           const struct dispersion_grid *grid, size_t n, const double *eps,
                           double *lost)
{
    enum { ALONG = 256, ACROSS = 20 };
    for (size_t k = 0; k < n; k++)
        lost[k] = 2;
    for (int b = 1; b <= ACROSS; b++) {
        double beta = pi * b / ACROSS;
        double complex wave[ALONG];
        for (int a = 0; a < ALONG; a++)
            wave[a] = dispersion_wave(scheme, grid, 2 * pi * (a + 0.5) / ALONG - pi, beta);
        for (size_t k = 0; k < n; k++)
            if (lost[k] > 1 && dispersion_winding(scheme, grid, beta, eps[k], ALONG, wave) != -1)
                lost[k] = beta / pi;
    }
}

static void print_stability(void)
{
    static const double slope[] = {0, 0.1, 0.2, 0.3, 0.5}, aspect[] = {0.25, 0.5, 1, 2};
    static const int cells[] = {8, 12, 24, 48, 96, 192};
    enum { CELLS = sizeof cells / sizeof *cells };
    double eps[CELLS], lost[CELLS];
    for (size_t c = 0; c < CELLS; c++)
        eps[c] = 2 * pi / cells[c];
    printf("\nFirst beta/pi that is not stable; `.`: none. Columns: cells a transverse wave\n\n"
           "| scheme | slope of the lines | dy/dx |");
    for (size_t c = 0; c < CELLS; c++)
        printf(" %d |", cells[c]);
    printf("\n|---|---|---|---|---|---|---|---|---|\n");
    for (size_t s = 1; s < SCHEMES; s++)
        for (size_t k = 0; k < sizeof slope / sizeof *slope && s != 2; k++)
            for (size_t l = 0; l < sizeof aspect / sizeof *aspect; l++) {
                struct dispersion_grid grid = {.h = aspect[l], .tau = -slope[k] / aspect[l]};
                dispersion_first_lost(&dispersion_schemes[s], &grid, CELLS, eps, lost);
                printf("| %s | %g | %g |", dispersion_schemes[s].name, slope[k], aspect[l]);
                for (size_t c = 0; c < CELLS; c++)
                    if (lost[c] > 1)
                        printf(" . |");
                    else
                        printf(" %.2f |", lost[c]);
                printf("\n");
                fflush(stdout);
            }
}

/* The grid's error of the direction in which energy goes, dalpha/dbeta, as the damping per cell
 * that takes a wave to 1/e while it strays by half its length across, over its value at beta = pi,
 * (1/2) sqrt(eps/(pi h)); beside powers of sin(beta/2). */
static void print_straying(void)
{
    printf("\nDamping per cell by straying over (1/2) sqrt(eps/(pi h)), h = 1\n\n"
           "| beta/pi | 0.2 | 0.3 | 0.4 | 0.5 | 0.6 | 0.7 | 0.8 | 0.9 | 0.98 |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n");
    static const double at[] = {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.98};
    for (int cells = 12; cells <= 96; cells *= 2) {
        double eps = 2 * pi / cells;
        struct dispersion_grid grid = {.h = 1};
        printf("| %d cells a wave |", cells);
        for (size_t k = 0; k < sizeof at / sizeof *at; k++) {
            double a[2], exact[2];
            for (int side = 0; side < 2; side++) {
                double beta = pi * at[k] + (side ? 1e-3 : -1e-3), v = beta / grid.h;
                double wave = 0.5 * eps + sqrt(0.25 * eps * eps + v * v);
                exact[side] = sqrt(eps * wave);
                a[side] = dispersion_root(&dispersion_schemes[USED], &grid, beta, eps, exact[side]);
            }
            double stray = fabs(exact[1] - exact[0] - a[1] + a[0]) / 2e-3 * at[k];
            printf(" %.3f |", stray / (0.5 * sqrt(eps / (pi * grid.h))));
        }
        printf("\n");
    }
    for (int power = 4; power <= 8; power += 2) {
        printf("| sin^%d(beta/2) |", power);
        for (size_t k = 0; k < sizeof at / sizeof *at; k++)
            printf(" %.3f |", pow(sin(0.5 * pi * at[k]), power));
        printf("\n");
    }
}

/* What the least damping takes off waves in five transverse waves, to first order. */
static void print_losses(void)
{
    static const double angle[] = {20, 35.264, 50};
    printf("\nLoss of amplitude by the least damping in 5 transverse waves, h = 1, per cent\n\n"
           "| cells a wave | 20 degrees | 35 | 50 |\n|---|---|---|---|\n");
    for (int cells = 12; cells <= 48; cells *= 2) {
        double eps = 2 * pi / cells;
        struct dispersion_scheme scheme = dispersion_schemes[USED];
        scheme.odd = 0.5 * sqrt(eps / pi);
        struct dispersion_grid grid = {.h = 1};
        printf("| %d |", cells);
        for (size_t k = 0; k < sizeof angle / sizeof *angle; k++) {
            double t = angle[k] * pi / 180, u = eps / cos(t), beta = u * tan(t);
            double a = dispersion_root(&scheme, &grid, beta, eps, u), r[2];
            for (int side = 0; side < 2; side++) {
                double at = a + (side ? 1e-4 : -1e-4);
                r[side] = dispersion_value(&scheme, at, beta) -
                          creal(dispersion_wave(&scheme, &grid, at, beta)) / eps;
            }
            double rate =
                cimag(dispersion_wave(&scheme, &grid, a, beta)) / eps / (r[1] - r[0]) * 2e-4;
            printf(" %.2f |", 100 * (1 - exp(-fabs(rate) * 5 * cells)));
        }
        printf("\n");
    }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "picture") == 0) {
        dispersion_print_picture();
    } else if (argc > 1 && strcmp(argv[1], "planes") == 0) {
        dispersion_print_planes();
    } else {
        print_phases();
        print_straying();
        print_losses();
        print_stability();
        dispersion_print_lines();
    }
    return 0;
}
