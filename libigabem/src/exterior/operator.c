#include "exterior/operator.h"

#include "core/constants.h"
#include "core/error.h"
#include "exterior/spline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ALONG = SPLINE_STENCIL, DIFFERENCE = 7, ACROSS = 11 };

void operator_free(struct surface_operator *operator_)
{
    sparse_free(&operator_->value);
    sparse_free(&operator_->second);
    sparse_free(&operator_->odd);
}

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the free-surface operator");
}

static const double sixth[DIFFERENCE] = {-1.0, 6.0, -15.0, 20.0, -15.0, 6.0, -1.0};

/* Products of the stencils across; the second derivative is the first taken twice, which vanishes
 * on the shortest wave: with the spline's own, lines that are oblique to the stream take the root
 * off the operator there, and nothing is stable. */
struct across {
    double value[ACROSS], first[ACROSS], second[ACROSS], value_sixth[ACROSS], first_sixth[ACROSS];
};

/* Product of a stencil and one of `width` places, both about their middle. */
static void convolve(const double a[ALONG], size_t width, const double *b, double out[ACROSS])
{
    memset(out, 0, ACROSS * sizeof *out);
    for (size_t i = 0; i < ALONG; i++)
        for (size_t j = 0; j < width; j++)
            out[i + j + (DIFFERENCE - width) / 2] += a[i] * b[j];
}

static void fill_across(struct across *across)
{
    static const double unit = 1.0;
    convolve(spline_along[0], 1, &unit, across->value);
    convolve(spline_along[1], 1, &unit, across->first);
    convolve(spline_along[1], ALONG, spline_along[1], across->second);
    convolve(spline_along[0], DIFFERENCE, sixth, across->value_sixth);
    convolve(spline_along[1], DIFFERENCE, sixth, across->first_sixth);
}

/* Whether the inner edge of a cell is the hull's or that of the strip aft of its transom. */
static bool is_beside(const struct free_surface *surface, size_t i)
{
    return surface->waterline.n > 0 && i >= surface->bow &&
           (i < surface->stern || surface->transom > 0);
}

/* Adds factor times the coefficient along the waterline of the spline through the hull's phi at the
 * middles of the cells, which are the columns after those of the unknowns. */
static void add_edge(const struct free_surface *surface, long i, double factor, double *row)
{
    long bow = (long)surface->bow, stern = (long)surface->stern;
    double *edge = row + surface->nx * surface->ny - bow;
    if (i == bow || i == stern - 1) {
        edge[i] += factor;
        return;
    }
    edge[i - 1] -= 0.125 * factor;
    edge[i] += 1.25 * factor;
    edge[i + 1] -= 0.125 * factor;
}

/* Adds factor times the coefficient of cell (i, j), which may lie beyond the edges of the grid, as
 * seen from a cell beside the body or not, to a row over the unknowns. */
static void add_coefficient(const struct free_surface *surface, bool beside, long i, long j,
                            double factor, double *row)
{
    long ny = (long)surface->ny;
    if (factor == 0.0)
        return;
    if (i < 1) {
        /* Linear upstream. */
        add_coefficient(surface, beside, 1, j, (double)(2 - i) * factor, row);
        add_coefficient(surface, beside, 2, j, (double)(i - 1) * factor, row);
        return;
    }
    double *at = row + (i - 1) * ny;
    bool hull = beside && i >= (long)surface->bow && i < (long)surface->stern;
    if (j < 0 && beside && i >= (long)surface->stern && surface->transom > 0) {
        at[0] += (double)(1 - j) * factor;
        at[1] += (double)j * factor;
    } else if (j < 0 && !hull) {
        at[-1 - j] += factor;
    } else if (j < 0) {
        /* Through the hull's phi at the edge: c_-1 = 2 e - c_0; beyond it a parabola. */
        double m = (double)(-1 - j), last_factor = factor * (1.0 + m + 0.5 * m * (m + 1.0));
        at[0] -= factor * m * (m + 2.0) + last_factor;
        at[1] += factor * 0.5 * m * (m + 1.0);
        add_edge(surface, i, 2.0 * last_factor, row);
    } else if (j >= ny) {
        at[ny - 1] += (double)(j - ny + 2) * factor;
        at[ny - 2] -= (double)(j - ny + 1) * factor;
    } else {
        at[j] += factor;
    }
}

/* Adds the product of two stencils about cell (i, j). */
static void add_product(const struct free_surface *surface, bool beside, size_t i, size_t j,
                        const double a[ALONG], const double b[ACROSS], double factor, double *row)
{
    for (long k = 0; k < ALONG; k++)
        for (long l = 0; l < ACROSS; l++)
            add_coefficient(surface, beside, (long)i + k - 2, (long)j + l - ACROSS / 2,
                            factor * a[k] * b[l], row);
}

/* Derivatives of eta(x, y) at the middle of cell (i, j), and dy/deta. */
struct lines {
    double ex, exx, ye;
};

static struct lines lines_at(const struct free_surface *surface, size_t i, size_t j)
{
    double y[3][3], dx = surface->dx;
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++)
            y[a][b] = free_surface_y(surface, (double)i + 0.5 * (double)a, 2 * j + b);
    double ye = y[1][2] - y[1][0], yee = 4.0 * (y[1][2] - 2.0 * y[1][1] + y[1][0]);
    double yx = -(y[2][1] - y[0][1]) / dx;
    double yxx = 4.0 * (y[2][1] - 2.0 * y[1][1] + y[0][1]) / (dx * dx);
    double yxe = -(y[2][2] - y[2][0] - y[0][2] + y[0][0]) / dx;
    double ex = -yx / ye;
    return (struct lines){ex, -(yxx + 2.0 * ex * yxe + ex * ex * yee) / ye, ye};
}

/* phi_xx at the middle of cell (i, j), F over (x, eta):
 *     phi_xx = F_xx + 2 eta_x F_x,eta + eta_x^2 F_eta,eta + eta_xx F_eta. */
static void second_row(const struct free_surface *surface, const struct across *across, bool beside,
                       size_t i, size_t j, double *row)
{
    const struct lines at = lines_at(surface, i, j);
    const double(*d)[ALONG] = i + 1 < surface->nx ? spline_along : spline_last, dx = surface->dx;
    add_product(surface, beside, i, j, d[2], across->value, 1.0 / (dx * dx), row);
    add_product(surface, beside, i, j, d[1], across->first, -2.0 * at.ex / dx, row);
    add_product(surface, beside, i, j, d[0], across->second, at.ex * at.ex, row);
    add_product(surface, beside, i, j, d[0], across->first, at.exx, row);
}

/* -2 mu phi_x over sqrt(k0), of the sixth difference across. */
static void odd_row(const struct free_surface *surface, const struct across *across, bool beside,
                    size_t i, size_t j, double *row)
{
    const struct lines at = lines_at(surface, i, j);
    const double(*d)[ALONG] = i + 1 < surface->nx ? spline_along : spline_last;
    const double twice = 1.0 / (64.0 * sqrt(PI * at.ye));
    add_product(surface, beside, i, j, d[1], across->value_sixth, twice / surface->dx, row);
    add_product(surface, beside, i, j, d[0], across->first_sixth, -twice * at.ex, row);
}

igabem_status operator_create(const struct free_surface *surface, struct surface_operator *result)
{
    size_t nx = surface->nx, ny = surface->ny, n = nx * ny, room[3] = {0, 0, 0};
    size_t columns = n + surface->stern - surface->bow;
    struct across across;
    fill_across(&across);
    *result = (struct surface_operator){.value.start = calloc(n + 1, sizeof(size_t)),
                                        .second.start = calloc(n + 1, sizeof(size_t)),
                                        .odd.start = calloc(n + 1, sizeof(size_t))};
    double *row = calloc(columns, sizeof *row);
    bool complete = result->value.start && result->second.start && result->odd.start && row;
    for (size_t c = 0; c < n && complete; c++) {
        size_t i = c / ny, j = c % ny;
        bool beside = is_beside(surface, i);
        add_product(surface, beside, i, j, spline_along[0], across.value, 1.0, row);
        complete = sparse_append(&result->value, columns, row, &room[0]);
        second_row(surface, &across, beside, i, j, row);
        complete = complete && sparse_append(&result->second, columns, row, &room[1]);
        odd_row(surface, &across, beside, i, j, row);
        complete = complete && sparse_append(&result->odd, columns, row, &room[2]);
    }
    free(row);
    if (complete)
        return IGABEM_OK;
    operator_free(result);
    return no_memory();
}

igabem_status operator_edge(const struct free_surface *surface, const struct density *density,
                            const struct mesh *mesh, struct sparse *edge)
{
    size_t n = surface->waterline.n ? surface->stern - surface->bow : 0, room = 0;
    *edge = (struct sparse){.start = calloc(n + 1, sizeof(size_t))};
    double *row = calloc(density->n, sizeof *row);
    igabem_status status = edge->start && row ? IGABEM_OK : no_memory();
    for (size_t k = 0; k < n && status == IGABEM_OK; k++) {
        size_t patch;
        double x = surface->x0 - surface->dx * ((double)(surface->bow + k) + 0.5), uv[2];
        status = edge_locate(&surface->waterline, density, x, &patch, uv);
        if (status == IGABEM_OK)
            spline_hull_basis(mesh, patch, uv, row);
        if (status == IGABEM_OK && !sparse_append(edge, density->n, row, &room))
            status = no_memory();
    }
    free(row);
    if (status != IGABEM_OK)
        sparse_free(edge);
    return status;
}

/* A coefficient, by the same rules as in the operator. */
static double coefficient(const struct free_surface *surface, bool beside, long i, long j,
                          const double *phi)
{
    long ny = (long)surface->ny, bow = (long)surface->bow, stern = (long)surface->stern;
    if (i < 1)
        return (double)(2 - i) * coefficient(surface, beside, 1, j, phi) +
               (double)(i - 1) * coefficient(surface, beside, 2, j, phi);
    const double *at = phi + (i - 1) * ny;
    if (j >= ny)
        return 2.0 * at[ny - 1] - at[ny - 2];
    if (j >= 0)
        return at[j];
    if (beside && i >= stern && surface->transom > 0)
        return 2.0 * at[0] - at[1];
    if (!beside || i < bow || i >= stern)
        return at[0];
    const double *edge = phi + surface->nx * surface->ny - bow;
    double bend = i == bow || i == stern - 1 ? 0.0 : edge[i - 1] - 2.0 * edge[i] + edge[i + 1];
    return 2.0 * (edge[i] - 0.125 * bend) - at[0];
}

double operator_slope(const struct free_surface *surface, const struct free_surface_place *place,
                      const double *phi)
{
    double i = fmin(floor(place->xi), (double)surface->nx - 1.0);
    double j = fmin(floor(place->eta), (double)surface->ny - 1.0);
    double u[3], du[3], v[3], dv[3], along_xi = 0.0, along_eta = 0.0;
    bool beside =
        surface->waterline.n > 0 && i >= (double)surface->bow && i < (double)surface->stern;
    spline_evaluate(place->xi - i, u, du);
    spline_evaluate(place->eta - j, v, dv);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            double c = coefficient(surface, beside, (long)i + a - 1, (long)j + b - 1, phi);
            along_xi += du[a] * v[b] * c;
            along_eta += u[a] * dv[b] * c;
        }
    return -along_xi / surface->dx + place->eta_x * along_eta;
}

void operator_fold(const struct free_surface *surface, double *coefficients, double *scratch)
{
    size_t nx = surface->nx, ny = surface->ny, columns = surface->columns;
    for (size_t j = 0; j < ny + 2; j++)
        spline_fold(nx, coefficients + j, columns, scratch);
    for (size_t i = 1; i <= nx; i++)
        spline_fold(ny, coefficients + i * columns, 1, scratch);
}
