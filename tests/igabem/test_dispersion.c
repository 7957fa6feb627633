/* The library's free-surface operator beside its Fourier symbol, and the winding number of what its
 * rows do to waves (docs/theory.md, section 12). */
#include "check.h"
#include "dispersion.h"
#include "exterior/operator.h"

static const double pi = 3.14159265358979323846;

static const struct dispersion_scheme used = {
    .degree = 2, .derivative = DISPERSION_FOURTH, .density = 2, .twice = true};

enum { ROWS = 40, AROUND = 8 };

/* Equal square cells of length 1/cells, beside a wedge whose half breadth grows aft by `slope`, or
 * on a plane: what the operator needs of a grid. */
struct plain {
    struct free_surface surface;
    double offset[2 * ROWS + 1];
    struct edge_point point[2];
};

static void make_surface(size_t cells, double slope, struct plain *plain)
{
    const double dx = 1.0 / (double)cells;
    *plain = (struct plain){.point = {{.at = {0.0, slope, 0.0}}, {.at = {1.0, 0.0, 0.0}}}};
    for (size_t k = 0; k <= 2 * ROWS; k++)
        plain->offset[k] = 0.5 * (double)k * dx;
    plain->surface = (struct free_surface){
        .nx = cells + 2 * AROUND,
        .ny = ROWS,
        .bow = AROUND,
        .stern = AROUND + cells,
        .x0 = 1.0 + AROUND * dx,
        .dx = dx,
        .first = dx,
        .growth = 1.0,
        .offset = plain->offset,
        .waterline = {.n = slope > 0.0 ? 2 : 0, .point = plain->point, .first = 0.0, .last = 1.0}};
}

/* What row (i, j) does to the coefficients exp(-i alpha di + i beta dj) about its cell. */
static double complex symbol(const struct sparse *sparse, const struct free_surface *surface,
                             size_t i, size_t j, double alpha, double beta)
{
    double complex sum = 0.0;
    size_t ny = surface->ny, row = i * ny + j;
    for (size_t k = sparse->start[row]; k < sparse->start[row + 1]; k++) {
        double di = (double)(sparse->column[k] / ny + 1) - (double)i;
        double dj = (double)(sparse->column[k] % ny) - (double)j;
        sum += sparse->value[k] * cexp(I * (beta * dj - alpha * di));
    }
    return sum;
}

/* On a plane the rows are the stencils whose dispersion the theory tabulates, with the damping that
 * belongs to 12 cells a wave; the symbols leave out aliases of 1e-7. */
static void test_plane(void)
{
    struct plain plain;
    make_surface(16, 0.0, &plain);
    const struct free_surface *surface = &plain.surface;
    struct surface_operator operator_;
    CU_ASSERT_EQUAL_FATAL(operator_create(surface, NULL, &operator_), IGABEM_OK);
    const struct dispersion_grid grid = {.h = 1.0};
    const double dx = surface->dx, eps = 2 * pi / 12;
    struct dispersion_scheme damped = used;
    damped.odd = 0.5 * sqrt(eps / pi);
    for (int a = 0; a < 5; a++)
        for (int b = 0; b < 5; b++) {
            double alpha = 0.1 + 0.6 * a, beta = 0.05 + 0.7 * b;
            double complex value = symbol(&operator_.value, surface, 16, 12, alpha, beta);
            double complex second = symbol(&operator_.second, surface, 16, 12, alpha, beta);
            second += sqrt(eps / dx) * symbol(&operator_.odd, surface, 16, 12, alpha, beta);
            double complex wave = -second * dx * dx * dispersion_kernel(2, &grid, alpha, beta);
            CHECK_CLOSE(cabs(value - dispersion_value(&used, alpha, beta)), 0.0, 3e-7);
            CHECK_CLOSE(cabs(wave - dispersion_wave(&damped, &grid, alpha, beta)), 0.0, 3e-7);
        }
    operator_free(&operator_);
}

/* Winding number of the rows at a cell whose lines have the slope tau, eps = k0 dx. */
static int winding(const struct surface_operator *operator_, const struct free_surface *surface,
                   size_t i, size_t j, const struct dispersion_grid *grid, double beta, double eps)
{
    enum { ALONG = 256 };
    double turns = 0.0;
    double complex before = 0.0, begin = 0.0;
    for (int k = 0; k <= ALONG; k++) {
        double alpha = 2 * pi * (k % ALONG + 0.5) / ALONG - pi;
        double complex wave = -symbol(&operator_->second, surface, i, j, alpha, beta) *
                              surface->dx * surface->dx * dispersion_kernel(2, grid, alpha, beta);
        double trace = 1e-3 * (sin(alpha) + grid->tau * sin(beta));
        double complex r =
            symbol(&operator_->value, surface, i, j, alpha, beta) - (creal(wave) + I * trace) / eps;
        if (k == 0)
            begin = r;
        else
            turns += carg((k == ALONG ? begin : r) / before);
        before = r;
    }
    return (int)lround(turns / (2 * pi));
}

/* Beside a wedge waves go downstream alone, however fine the cells: with a second derivative across
 * that is not the first one taken twice this fails at 48 cells a wave. */
static void test_wedge(void)
{
    const double slope = 0.3;
    const size_t i = 24, j = 10;
    struct plain plain;
    make_surface(32, slope, &plain);
    const struct free_surface *surface = &plain.surface;
    struct surface_operator operator_;
    CU_ASSERT_EQUAL_FATAL(operator_create(surface, NULL, &operator_), IGABEM_OK);
    double here = slope * ((double)(i - surface->bow) + 0.5) * surface->dx;
    double all = ROWS * surface->dx, share = 1.0 - ((double)j + 0.5) * surface->dx / all;
    double h = 1.0 - here / all;
    const struct dispersion_grid grid = {.h = h, .tau = slope * share / h};
    for (int cells = 12; cells <= 192; cells *= 2)
        for (int b = 1; b <= 10; b++)
            CU_ASSERT_EQUAL(winding(&operator_, surface, i, j, &grid, 0.1 * pi * b, 2 * pi / cells),
                            -1);
    operator_free(&operator_);
}

/* Where the lines of the grid turn, at the bow, phi = y^2 has no phi_xx: through a spline that is
 * smooth across the turn it would have 2 y slope/dx. */
static void test_bow(void)
{
    const double slope = 0.3;
    struct plain plain;
    make_surface(24, slope, &plain);
    const struct free_surface *surface = &plain.surface;
    size_t nx = surface->nx, ny = surface->ny;
    double *phi = calloc((nx + 1) * ny + 24, sizeof *phi);
    CU_ASSERT_PTR_NOT_NULL_FATAL(phi);
    for (size_t i = 1; i <= nx; i++)
        for (size_t j = 0; j < ny; j++) {
            double xi = (double)i + 0.5, y = free_surface_y(surface, xi, 2 * j + 1);
            double along = free_surface_y(surface, xi + 0.25, 2 * j + 1) -
                           free_surface_y(surface, xi - 0.25, 2 * j + 1);
            double across =
                free_surface_y(surface, xi, 2 * j + 2) - free_surface_y(surface, xi, 2 * j);
            /* A quadratic spline's coefficient: the value less an eighth of second derivatives. */
            phi[(i - 1) * ny + j] = y * y - along * along - 0.25 * across * across;
        }
    struct surface_operator operator_;
    CU_ASSERT_EQUAL_FATAL(operator_create(surface, NULL, &operator_), IGABEM_OK);
    for (size_t i = surface->bow - 2; i < surface->bow + 2; i++)
        for (size_t j = 8; j < 14; j++) {
            const struct sparse *second = &operator_.second;
            double sum = 0.0, turn = 2.0 * free_surface_y(surface, (double)i, 2 * j + 1) * slope;
            for (size_t l = second->start[i * ny + j]; l < second->start[i * ny + j + 1]; l++)
                sum += second->value[l] * phi[second->column[l]];
            CHECK_CLOSE(sum * surface->dx / turn, 0.0, 0.003);
        }
    operator_free(&operator_);
    free(phi);
}

/* The phase error is of order 4: by 16 from one grid to that of half the cells. */
static void test_order(void)
{
    const struct dispersion_grid grid = {.h = 1.0};
    double error[2];
    for (int k = 0; k < 2; k++) {
        double u = 2 * pi / (16 << k);
        double wave = 0.5 * u + sqrt(0.25 * u * u + 0.09 * u * u), exact = sqrt(u * wave);
        error[k] = fabs(dispersion_root(&used, &grid, 0.3 * u, u, exact) / exact - 1.0);
    }
    CHECK_CLOSE(log2(error[0] / error[1]), 4.0, 0.3);
}

static const struct check_case cases[] = {
    {"plane", test_plane}, {"wedge", test_wedge}, {"bow", test_bow}, {"order", test_order}};

CHECK_MAIN("dispersion", cases)
