#include "exterior/base_flow.h"

#include "core/error.h"
#include "exterior/layers.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TERMS = 10, QUADRATIC = 6, REACH = 2, WINDOW = (2 * REACH + 1) * (2 * REACH + 1) };

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the double-body flow");
}

/* Row of Int Phi dG/dn over hull and face, and Int G n_x over the hull. */
static igabem_status add_row(const struct layer_surface layer[2], const struct transom *transom,
                             const struct layer_point *point, struct layer_work work[2],
                             double *rim, double *row, double *right)
{
    struct layer_rows dipole = {.dipole = row};
    igabem_status status = layer_add(&layer[0], point, &work[0], &dipole);
    *right = dipole.flow;
    if (!transom || status != IGABEM_OK)
        return status;
    struct layer_point off = {.at = {point->at[0], point->at[1], point->at[2]}};
    struct layer_rows face = {.dipole = rim};
    memset(rim, 0, transom->coefficients * sizeof *rim);
    status = layer_add(&layer[1], &off, &work[1], &face);
    for (size_t j = 0; j < transom->n; j++)
        for (size_t l = transom->rim.start[j]; l < transom->rim.start[j + 1]; l++)
            row[transom->rim.column[l]] += rim[j] * transom->rim.value[l];
    return status;
}

/* rows are row by row, so LAPACK sees the transpose. */
static igabem_status factor_and_solve(size_t n, double *rows, double *right)
{
    const lapack_int order = (lapack_int)n;
    lapack_int *pivot = malloc(n * sizeof *pivot);
    lapack_int info = LAPACK_WORK_MEMORY_ERROR;
    if (pivot)
        info = LAPACKE_dgetrf(LAPACK_COL_MAJOR, order, order, rows, order, pivot);
    if (info == 0)
        info = LAPACKE_dgetrs(LAPACK_COL_MAJOR, 'T', order, 1, rows, order, pivot, right, order);
    free(pivot);
    if (info < 0)
        return no_memory();
    return info == 0 ? IGABEM_OK
                     : igabem_fail(IGABEM_ERROR_NUMERIC, "the double-body flow has no solution");
}

/* Phi on the hull and then at the middles of the cells. */
static igabem_status potential(const struct influence *hull, const struct free_surface *surface,
                               const struct transom *transom, const struct influence *face,
                               double *on_hull, double *phi)
{
    size_t n = hull->density->n, cells = surface->nx * surface->ny;
    size_t coefficients = transom ? transom->coefficients : 1;
    const struct layer_surface layer[2] = {{.influence = hull, .symmetric = true},
                                           {.influence = face, .symmetric = true}};
    double *rows = calloc(n * n, sizeof *rows);
    igabem_status result = rows ? IGABEM_OK : no_memory();
#pragma omp parallel num_threads(hull->threads)
    {
        struct layer_work work[2];
        double *rim = malloc(coefficients * sizeof *rim);
        igabem_status status = result;
        memset(work, 0, sizeof work);
        for (int k = 0; k < (transom ? 2 : 1) && status == IGABEM_OK; k++)
            status = rim ? layer_work_create(&layer[k], &work[k]) : no_memory();
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < n; i++)
            if (status == IGABEM_OK) {
                struct layer_point point;
                layer_collocation(hull, i, &point, rows + i * n);
                status = add_row(layer, transom, &point, work, rim, rows + i * n, &on_hull[i]);
            }
            /* by the calling thread, which is told why */
#pragma omp master
        if (status == IGABEM_OK)
            status = factor_and_solve(n, rows, on_hull);
#pragma omp barrier
        double *row = malloc(n * sizeof *row);
        if (!row && status == IGABEM_OK)
            status = no_memory();
#pragma omp for schedule(dynamic, 4)
        for (size_t c = 0; c < cells; c++)
            if (status == IGABEM_OK) {
                struct layer_point point = surface->point[c];
                point.homes = 0;
                memset(row, 0, n * sizeof *row);
                status = add_row(layer, transom, &point, work, rim, row, &phi[c]);
                for (size_t k = 0; k < n; k++)
                    phi[c] -= row[k] * on_hull[k];
            }
        free(row);
        free(rim);
        for (int k = 0; k < (transom ? 2 : 1); k++)
            layer_work_free(&work[k]);
#pragma omp critical(igabem_base_flow)
        if (status != IGABEM_OK)
            result = status;
    }
    free(rows);
    return result == IGABEM_ERROR_MEMORY ? no_memory() : result;
}

/* A value of Phi near a cell. */
struct sample {
    double x, y, phi;
};

/* The values about a cell: its neighbours', beyond the centre line their images, at a waterline the
 * hull's. */
static size_t collect(const struct free_surface *surface, bool strip, const double *phi,
                      const double *edge, size_t cell, struct sample sample[WINDOW])
{
    long nx = (long)surface->nx, ny = (long)surface->ny, i = (long)cell / ny, j = (long)cell % ny;
    long bow = surface->waterline.n ? (long)surface->bow : nx, stern = (long)surface->stern;
    size_t n = 0;
    for (long a = i - REACH; a <= i + REACH; a++)
        for (long b = j - REACH; b <= j + REACH; b++) {
            if (a < 0 || a >= nx || b >= ny)
                continue;
            bool beside = a >= bow && a < stern, open = strip && a >= stern;
            if (b >= 0 || (!beside && !open)) {
                size_t at = (size_t)(a * ny + (b < 0 ? -1 - b : b));
                const double *p = surface->point[at].at;
                sample[n++] = (struct sample){p[0], b < 0 ? -p[1] : p[1], phi[at]};
            } else if (beside && b == -1) {
                double x = surface->point[a * ny].at[0];
                sample[n++] = (struct sample){x, free_surface_breadth(surface, x), edge[a - bow]};
            }
        }
    return n;
}

/* Least squares by a cubic, where less than four values lie in a row by a quadratic. */
static igabem_status fit(size_t terms, size_t n, const struct sample *sample, const double at[2],
                         const double size[2], struct base_point *point)
{
    double matrix[WINDOW * TERMS], right[WINDOW];
    for (size_t k = 0; k < n; k++) {
        double u = (sample[k].x - at[0]) / size[0], v = (sample[k].y - at[1]) / size[1];
        double weight = 1.0 / (0.5 + u * u + v * v);
        const double term[TERMS] = {1.0,   u,         v,         u * u,     u * v,
                                    v * v, u * u * u, u * u * v, u * v * v, v * v * v};
        for (size_t l = 0; l < terms; l++)
            matrix[k * terms + l] = weight * term[l];
        right[k] = weight * sample[k].phi;
    }
    lapack_int info = LAPACKE_dgels(LAPACK_ROW_MAJOR, 'N', (lapack_int)n, (lapack_int)terms, 1,
                                    matrix, (lapack_int)terms, right, 1);
    if (info < 0)
        return no_memory();
    if (info > 0)
        return igabem_fail(IGABEM_ERROR_NUMERIC,
                           "the double-body flow at (%.6g, %.6g) m has no derivatives", at[0],
                           at[1]);
    *point =
        (struct base_point){{right[1] / size[0], right[2] / size[1]},
                            {2.0 * right[3] / (size[0] * size[0]), right[4] / (size[0] * size[1]),
                             2.0 * right[5] / (size[1] * size[1])}};
    return IGABEM_OK;
}

static double row_width(const struct free_surface *surface, size_t i, size_t j)
{
    double xi = (double)i + 0.5;
    return free_surface_y(surface, xi, 2 * j + 2) - free_surface_y(surface, xi, 2 * j);
}

igabem_status base_flow_create(const struct influence *hull, const struct free_surface *surface,
                               const struct transom *transom, const struct influence *face,
                               const struct sparse *edge, struct base_point **points)
{
    size_t cells = surface->nx * surface->ny, n = hull->density->n;
    double *on_hull = malloc(n * sizeof *on_hull), *phi = malloc(cells * sizeof *phi);
    double *beside = calloc(edge->rows + 1, sizeof *beside);
    *points = malloc(cells * sizeof **points);
    igabem_status status = on_hull && phi && beside && *points ? IGABEM_OK : no_memory();
    if (status == IGABEM_OK)
        status = potential(hull, surface, transom, face, on_hull, phi);
    for (size_t k = 0; k < edge->rows && status == IGABEM_OK; k++)
        for (size_t l = edge->start[k]; l < edge->start[k + 1]; l++)
            beside[k] += edge->value[l] * on_hull[edge->column[l]];
    for (size_t c = 0; c < cells && status == IGABEM_OK; c++) {
        struct sample sample[WINDOW];
        size_t i = c / surface->ny, j = c % surface->ny;
        bool aft = transom && i >= surface->stern;
        bool four = i >= 1 && i + 2 < surface->nx && j + 2 < surface->ny && (j > 0 || !aft);
        const double size[2] = {surface->dx, row_width(surface, i, j)};
        size_t m = collect(surface, transom != NULL, phi, beside, c, sample);
        status =
            fit(four ? TERMS : QUADRATIC, m, sample, surface->point[c].at, size, &(*points)[c]);
    }
    free(on_hull);
    free(phi);
    free(beside);
    if (status != IGABEM_OK) {
        free(*points);
        *points = NULL;
    }
    return status;
}

double base_flow_known(const struct base_point *point)
{
    const double *p = point->gradient, *h = point->second, w[2] = {p[0] - 1.0, p[1]};
    double along = h[0] * p[0] + h[1] * p[1], aside = h[1] * p[0] + h[2] * p[1];
    return 2.0 * (w[0] * along + w[1] * aside) + 0.5 * (p[0] * p[0] + p[1] * p[1]) * (h[0] + h[2]);
}

/* The lower of two neighbouring middles and the share of the other. */
static size_t between(double at, size_t n, double *share)
{
    double x = fmin(fmax(at - 0.5, 0.0), (double)n - 1.0), low = fmin(floor(x), (double)n - 2.0);
    *share = x - low;
    return (size_t)low;
}

void base_flow_at(const struct free_surface *surface, const struct base_point *points,
                  const struct free_surface_place *place, double gradient[2])
{
    double u, v;
    size_t ny = surface->ny, i = between(place->xi, surface->nx, &u),
           j = between(place->eta, ny, &v);
    const struct base_point *p = points + i * ny + j;
    for (int c = 0; c < 2; c++)
        gradient[c] = (1.0 - u) * ((1.0 - v) * p[0].gradient[c] + v * p[1].gradient[c]) +
                      u * ((1.0 - v) * p[ny].gradient[c] + v * p[ny + 1].gradient[c]);
}

static double row_times(const struct sparse *rows, size_t row, const double *phi)
{
    double sum = 0.0;
    for (size_t k = rows->start[row]; k < rows->start[row + 1]; k++)
        sum += rows->value[k] * phi[rows->column[k]];
    return sum;
}

igabem_status base_flow_excess(const struct free_surface *surface, const struct base_point *points,
                               const struct sparse *second, const double *phi, double speed,
                               double k0, double *excess)
{
    struct surface_operator stream;
    igabem_status status = operator_create(surface, NULL, &stream);
    if (status != IGABEM_OK)
        return status;
    for (size_t c = 0; c < surface->nx * surface->ny; c++) {
        double strength = row_times(second, c, phi) - speed * base_flow_known(&points[c]);
        excess[c] = (strength - row_times(&stream.second, c, phi)) / k0 * surface->dx *
                    row_width(surface, c / surface->ny, c % surface->ny);
    }
    operator_free(&stream);
    return IGABEM_OK;
}
