#include "exterior/operator.h"

#include "core/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ALONG = 5, ACROSS = 9 };

void sparse_free(struct sparse *sparse)
{
    free(sparse->start);
    free(sparse->column);
    free(sparse->value);
    *sparse = (struct sparse){0};
}

void operator_free(struct surface_operator *operator_)
{
    sparse_free(&operator_->value);
    sparse_free(&operator_->second);
}

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the free-surface operator");
}

/* Appends what is not zero of a row, and clears it. */
static bool append_row(size_t columns, double *row, size_t *room, struct sparse *sparse)
{
    size_t n = sparse->start[sparse->rows];
    for (size_t k = 0; k < columns; k++) {
        if (row[k] == 0.0)
            continue;
        if (n == *room) {
            *room = 2 * *room + 1024;
            size_t *column = realloc(sparse->column, *room * sizeof *column);
            sparse->column = column ? column : sparse->column;
            double *value = realloc(sparse->value, *room * sizeof *value);
            sparse->value = value ? value : sparse->value;
            if (!column || !value)
                return false;
        }
        sparse->column[n] = k;
        sparse->value[n++] = row[k];
        row[k] = 0.0;
    }
    sparse->start[++sparse->rows] = n;
    return true;
}

/* Of the spline's coefficients about the middle of a cell: phi and its first and second derivative,
 * of order 4 as values (the spline's own derivatives are of order 2). */
static const double along[3][ALONG] = {{0.0, 0.125, 0.75, 0.125, 0.0},
                                       {1.0 / 48, -13.0 / 24, 0.0, 13.0 / 24, -1.0 / 48},
                                       {1.0 / 24, 5.0 / 6, -1.75, 5.0 / 6, 1.0 / 24}};
/* The spline's own, in the last cell, which has no second neighbour. */
static const double last[3][ALONG] = {
    {0.0, 0.125, 0.75, 0.125, 0.0}, {0.0, -0.5, 0.0, 0.5, 0.0}, {0.0, 1.0, -2.0, 1.0, 0.0}};
static const double fourth[ALONG] = {1.0, -4.0, 6.0, -4.0, 1.0};

/* Products of the stencils across; the second derivative is the first taken twice, which vanishes
 * on the shortest wave: with the spline's own, lines that are oblique to the stream take the root
 * off the operator there, and nothing is stable. */
struct across {
    double value[ACROSS], first[ACROSS], second[ACROSS], value_fourth[ACROSS], first_fourth[ACROSS];
};

static void convolve(const double a[ALONG], const double b[ALONG], double out[ACROSS])
{
    memset(out, 0, ACROSS * sizeof *out);
    for (size_t i = 0; i < ALONG; i++)
        for (size_t j = 0; j < ALONG; j++)
            out[i + j] += a[i] * b[j];
}

static void fill_across(struct across *across)
{
    static const double unit[ALONG] = {0.0, 0.0, 1.0, 0.0, 0.0};
    convolve(along[0], unit, across->value);
    convolve(along[1], unit, across->first);
    convolve(along[1], along[1], across->second);
    convolve(along[0], fourth, across->value_fourth);
    convolve(along[1], fourth, across->first_fourth);
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
    double *at = row + (i < 1 ? 0 : i - 1) * ny;
    bool hull = beside && i >= (long)surface->bow && i < (long)surface->stern;
    if (j < 0 && !hull) {
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
            add_coefficient(surface, beside, (long)i + k - 2, (long)j + l - 4, factor * a[k] * b[l],
                            row);
}

/* phi_xx at the middle of cell (i, j): with eta = eta(x, y) and F over (x, eta),
 *     phi_xx = F_xx + 2 eta_x F_x,eta + eta_x^2 F_eta,eta + eta_xx F_eta,
 * less 2 mu phi_x with mu = damping/(16 dx) of the fourth difference across. */
static void second_row(const struct free_surface *surface, const struct across *across, bool beside,
                       size_t i, size_t j, double damping, double *row)
{
    double y[3][3], dx = surface->dx;
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++)
            y[a][b] = free_surface_y(surface, (double)i + 0.5 * (double)a, 2 * j + b);
    double ye = y[1][2] - y[1][0], yee = 4.0 * (y[1][2] - 2.0 * y[1][1] + y[1][0]);
    double yx = -(y[2][1] - y[0][1]) / dx;
    double yxx = 4.0 * (y[2][1] - 2.0 * y[1][1] + y[0][1]) / (dx * dx);
    double yxe = -(y[2][2] - y[2][0] - y[0][2] + y[0][0]) / dx;
    double ex = -yx / ye, exx = -(yxx + 2.0 * ex * yxe + ex * ex * yee) / ye;
    const double(*d)[ALONG] = i + 1 < surface->nx ? along : last;
    add_product(surface, beside, i, j, d[2], across->value, 1.0 / (dx * dx), row);
    add_product(surface, beside, i, j, d[1], across->first, -2.0 * ex / dx, row);
    add_product(surface, beside, i, j, d[0], across->second, ex * ex, row);
    add_product(surface, beside, i, j, d[0], across->first, exx, row);
    double mu = damping / (16.0 * dx);
    add_product(surface, beside, i, j, d[1], across->value_fourth, 2.0 * mu / dx, row);
    add_product(surface, beside, i, j, d[0], across->first_fourth, -2.0 * mu * ex, row);
}

igabem_status operator_create(const struct free_surface *surface, double damping,
                              struct surface_operator *result)
{
    size_t nx = surface->nx, ny = surface->ny, n = nx * ny, room[2] = {0, 0};
    size_t columns = n + surface->stern - surface->bow;
    struct across across;
    fill_across(&across);
    *result = (struct surface_operator){.value.start = calloc(n + 1, sizeof(size_t)),
                                        .second.start = calloc(n + 1, sizeof(size_t))};
    double *row = calloc(columns, sizeof *row);
    bool complete = result->value.start && result->second.start && row;
    for (size_t c = 0; c < n && complete; c++) {
        size_t i = c / ny, j = c % ny;
        bool beside = surface->waterline.n > 0 && i >= surface->bow && i < surface->stern;
        add_product(surface, beside, i, j, along[0], across.value, 1.0, row);
        complete = append_row(columns, row, &room[0], &result->value);
        second_row(surface, &across, beside, i, j, damping, row);
        complete = complete && append_row(columns, row, &room[1], &result->second);
    }
    free(row);
    if (complete)
        return IGABEM_OK;
    operator_free(result);
    return no_memory();
}

/* The basis of the hull at parameters of a patch. */
static void hull_basis(const struct density *density, const struct mesh *mesh, size_t patch,
                       const double uv[2], double *row)
{
    (void)density;
    size_t e = mesh->patch_base[patch], end = mesh->patch_base[patch + 1];
    while (e + 1 < end && (uv[0] < mesh->element[e].lower[0] || uv[0] > mesh->element[e].upper[0] ||
                           uv[1] < mesh->element[e].lower[1] || uv[1] > mesh->element[e].upper[1]))
        e++;
    const struct element *element = &mesh->element[e];
    double local[2], bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], value[ELEMENT_FUNCTIONS];
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    for (int d = 0; d < 2; d++)
        local[d] = (uv[d] - element->lower[d]) / (element->upper[d] - element->lower[d]);
    struct jet jet;
    element_jet(element, local[0], local[1], &jet);
    bernstein(element->degree[0], local[0], bu, NULL);
    bernstein(element->degree[1], local[1], bv, NULL);
    for (size_t k = 0; k < m * n; k++)
        value[k] = bu[k / n] * bv[k % n] / jet.weight;
    element_scatter(element, 1, value, row, 0);
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
        status = waterline_locate(&surface->waterline, density, x, &patch, uv);
        if (status == IGABEM_OK)
            hull_basis(density, mesh, patch, uv, row);
        if (status == IGABEM_OK && !append_row(density->n, row, &room, edge))
            status = no_memory();
    }
    free(row);
    if (status != IGABEM_OK)
        sparse_free(edge);
    return status;
}

/* The three quadratic splines over a cell at s in [0,1], and their derivatives. */
static void quadratic(double s, double value[3], double derivative[3])
{
    double r = 1.0 - s;
    value[0] = 0.5 * r * r;
    value[1] = 0.5 + s * r;
    value[2] = 0.5 * s * s;
    derivative[0] = -r;
    derivative[1] = 1.0 - 2.0 * s;
    derivative[2] = s;
}

/* A coefficient, by the same rules as in the operator. */
static double coefficient(const struct free_surface *surface, bool beside, long i, long j,
                          const double *phi)
{
    long ny = (long)surface->ny, bow = (long)surface->bow, stern = (long)surface->stern;
    const double *at = phi + (i < 1 ? 0 : i - 1) * ny;
    if (j >= ny)
        return 2.0 * at[ny - 1] - at[ny - 2];
    if (j >= 0)
        return at[j];
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
    quadratic(place->xi - i, u, du);
    quadratic(place->eta - j, v, dv);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            double c = coefficient(surface, beside, (long)i + a - 1, (long)j + b - 1, phi);
            along_xi += du[a] * v[b] * c;
            along_eta += u[a] * dv[b] * c;
        }
    return -along_xi / surface->dx + place->eta_x * along_eta;
}

/* Transposed solution for the coefficients of a quadratic spline through n values at the middles
 * of cells, linear beyond its ends: coefficients [n + 2], `step` apart, become factors of the
 * values, in place from the second on. */
static void fold_line(size_t n, double *c, size_t step, double *scratch)
{
    c[step] += 2.0 * c[0];
    c[2 * step] -= c[0];
    c[n * step] += 2.0 * c[(n + 1) * step];
    c[(n - 1) * step] -= c[(n + 1) * step];
    /* Thomas' algorithm for the transposed matrix; the end values are their coefficients. */
    double *ratio = scratch;
    double *x = c + step;
    for (size_t k = 0; k < n; k++) {
        double diagonal = k == 0 || k == n - 1 ? 1.0 : 0.75;
        double below = k > 0 && k - 1 > 0 && k - 1 < n - 1 ? 0.125 : 0.0; /* (k, k-1) */
        double above = k + 1 < n - 1 ? 0.125 : 0.0;                       /* (k, k+1) */
        double pivot = diagonal - (k ? below * ratio[k - 1] : 0.0);
        ratio[k] = above / pivot;
        x[k * step] = (x[k * step] - (k ? below * x[(k - 1) * step] : 0.0)) / pivot;
    }
    for (size_t k = n - 1; k-- > 0;)
        x[k * step] -= ratio[k] * x[(k + 1) * step];
}

void operator_fold(const struct free_surface *surface, double *coefficients, double *scratch)
{
    size_t nx = surface->nx, ny = surface->ny, columns = surface->columns;
    for (size_t j = 0; j < ny + 2; j++)
        fold_line(nx, coefficients + j, columns, scratch);
    for (size_t i = 1; i <= nx; i++)
        fold_line(ny, coefficients + i * columns, 1, scratch);
}
