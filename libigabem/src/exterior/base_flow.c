#include "exterior/base_flow.h"

#include "core/error.h"
#include "exterior/plane_field.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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

igabem_status base_flow_system(const struct influence *hull, const struct transom *transom,
                               const struct influence *face, double *rows, double *right)
{
    size_t n = hull->density->n, coefficients = transom ? transom->coefficients : 1;
    const struct layer_surface layer[2] = {{.influence = hull, .symmetric = true},
                                           {.influence = face, .symmetric = true}};
    igabem_status result = IGABEM_OK;
    memset(rows, 0, n * n * sizeof *rows);
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
                status = add_row(layer, transom, &point, work, rim, rows + i * n, &right[i]);
            }
        free(rim);
        for (int k = 0; k < (transom ? 2 : 1); k++)
            layer_work_free(&work[k]);
#pragma omp critical(igabem_base_flow)
        if (status != IGABEM_OK)
            result = status;
    }
    /* by the calling thread, which is told why */
    return result == IGABEM_OK ? result : no_memory();
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

/* Coefficients of Phi on the hull. */
static igabem_status potential(const struct influence *hull, const struct transom *transom,
                               const struct influence *face, double *on_hull)
{
    size_t n = hull->density->n;
    double *rows = malloc(n * n * sizeof *rows);
    igabem_status status =
        rows ? base_flow_system(hull, transom, face, rows, on_hull) : no_memory();
    if (status == IGABEM_OK)
        status = factor_and_solve(n, rows, on_hull);
    free(rows);
    return status;
}

/* Derivatives of Phi at the middles of the cells. */
static igabem_status differentiate(const struct free_surface *surface, size_t layers,
                                   const struct plane_layer *layer, int threads,
                                   struct base_point *points)
{
    size_t cells = surface->nx * surface->ny;
    igabem_status result = IGABEM_OK;
#pragma omp parallel num_threads(threads)
    {
        struct layer_work work[2];
        igabem_status status = IGABEM_OK;
        memset(work, 0, sizeof work);
        for (size_t k = 0; k < layers && status == IGABEM_OK; k++) {
            const struct layer_surface whole = {.influence = layer[k].influence};
            status = layer_work_create(&whole, &work[k]);
        }
#pragma omp for schedule(dynamic, 4)
        for (size_t c = 0; c < cells; c++) {
            double d[5] = {0.0};
            for (size_t k = 0; k < layers && status == IGABEM_OK; k++)
                status = plane_layer_add(&layer[k], surface->point[c].at, &work[k], d);
            points[c] = (struct base_point){{d[0], d[1]}, {d[2], d[3], d[4]}};
        }
        for (size_t k = 0; k < layers; k++)
            layer_work_free(&work[k]);
#pragma omp critical(igabem_base_flow)
        if (status != IGABEM_OK)
            result = status;
    }
    return result == IGABEM_OK ? result : no_memory();
}

igabem_status base_flow_create(const struct influence *hull, const struct free_surface *surface,
                               const struct transom *transom, const struct influence *face,
                               double *on_hull, struct base_point **points)
{
    size_t layers = transom ? 2 : 1;
    double *on_face = calloc(transom ? transom->coefficients : 1, sizeof *on_face);
    struct plane_layer layer[2] = {{.phi = NULL}};
    *points = malloc(surface->nx * surface->ny * sizeof **points);
    igabem_status status = on_face && *points ? IGABEM_OK : no_memory();
    if (status == IGABEM_OK)
        status = potential(hull, transom, face, on_hull);
    for (size_t j = 0; transom && j < transom->n && status == IGABEM_OK; j++)
        for (size_t l = transom->rim.start[j]; l < transom->rim.start[j + 1]; l++)
            on_face[j] += transom->rim.value[l] * on_hull[transom->rim.column[l]];
    if (status == IGABEM_OK)
        status = plane_layer_create(hull, on_hull, true, &layer[0]);
    if (status == IGABEM_OK && transom)
        status = plane_layer_create(face, on_face, false, &layer[1]);
    if (status == IGABEM_OK)
        status = differentiate(surface, layers, layer, hull->threads, *points);
    for (size_t k = 0; k < layers; k++)
        plane_layer_free(&layer[k]);
    free(on_face);
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

double base_flow_known_change(const struct base_point *point, const double d[5])
{
    const double *p = point->gradient, *h = point->second, *e = d + 2;
    const double w[2] = {p[0] - 1.0, p[1]};
    double along = h[0] * p[0] + h[1] * p[1], aside = h[1] * p[0] + h[2] * p[1];
    double d_along = e[0] * p[0] + h[0] * d[0] + e[1] * p[1] + h[1] * d[1];
    double d_aside = e[1] * p[0] + h[1] * d[0] + e[2] * p[1] + h[2] * d[1];
    return 2.0 * (d[0] * along + w[0] * d_along + d[1] * aside + w[1] * d_aside) +
           (p[0] * d[0] + p[1] * d[1]) * (h[0] + h[2]) +
           0.5 * (p[0] * p[0] + p[1] * p[1]) * (e[0] + e[2]);
}

/* The lower of two neighbouring middles and the share of the other, beyond the last linear. */
static size_t between(double at, size_t n, double *share)
{
    double low = fmin(fmax(floor(at - 0.5), 0.0), (double)n - 2.0);
    *share = at - 0.5 - low;
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

/* One part, its area over k0, and its share of the momentum; cross: w_y w.grad phi, and phi_x
 * times that. */
static double radiate(const struct free_surface *surface, const struct base_point *points,
                      size_t cell, const double at[2], const double *phi, double speed, double area,
                      double *part, double cross[2])
{
    struct free_surface_place place;
    double d[2], p[2];
    const double *h = points[cell].second;
    cross[0] = cross[1] = 0.0;
    if (!free_surface_locate(surface, at[0], at[1], &place))
        return 0.0;
    operator_gradient(surface, &place, phi, d);
    base_flow_at(surface, points, &place, p);
    double w[2] = {p[0] - 1.0, p[1]}, flow = w[0] * d[0] + w[1] * d[1];
    double turn[2] = {w[0] * h[0] + w[1] * h[1], w[0] * h[1] + w[1] * h[2]};
    part[3] = area * (turn[0] * d[0] + turn[1] * d[1] - speed * base_flow_known(&points[cell]));
    part[4] = area * (flow * w[0] - d[0]);
    part[5] = area * flow * w[1];
    cross[0] = flow * w[1];
    cross[1] = d[0] * cross[0];
    return area * flow * (h[0] * d[0] + h[1] * d[1]) + d[0] * part[3];
}

double base_flow_radiate(const struct free_surface *surface, const struct base_point *points,
                         const double *phi, double speed, double k0, double (*part)[7])
{
    enum { SIDE = BASE_FLOW_SIDE };
    size_t cells = surface->nx * surface->ny;
    double momentum = 0.0;
    memset(part, 0, cells * SIDE * SIDE * sizeof *part);
    for (size_t c = 0; c < cells; c++) {
        size_t i = c / surface->ny, j = c % surface->ny;
        bool strip = j == 0 && i >= surface->stern && surface->transom > 0;
        for (int a = 0; a < SIDE; a++) {
            double xi = (double)i + (a + 0.5) / SIDE, inner = free_surface_y(surface, xi, 2 * j);
            double width = free_surface_y(surface, xi, 2 * j + 2) - inner;
            for (int b = 0; b < SIDE; b++, part++) {
                (*part)[0] = surface->x0 - surface->dx * xi;
                (*part)[1] = inner + width * (b + 0.5) / SIDE;
                double cross[2], length = surface->dx / (SIDE * k0);
                momentum += radiate(surface, points, c, *part, phi, speed, length * width / SIDE,
                                    *part, cross);
                /* The edge along a strip, which the base flow crosses. */
                if (strip && b == 0) {
                    (*part)[3] -= length * cross[0];
                    momentum -= length * cross[1];
                }
            }
        }
    }
    return momentum;
}
