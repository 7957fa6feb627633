#include "exterior/transom.h"

#include "core/error.h"
#include "exterior/spline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = SPLINE_SIDE, LEAST_COLUMNS = 3, FACE_PARTS = TRANSOM_FACE_PARTS };

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the surface aft of the transom");
}

/* One function per column, the element's first. */
static const double constant[SIDE * SIDE] = {1, 1, 1, 1};

/* The face: from the rim straight to the start of the strip. A column has several elements, ruled
 * between points of the rim: a cubic through them may rise above the water where the rim turns up.
 */
static void fill_face(struct transom *transom, const struct edge *rim)
{
    double width = transom->breadth / (double)(transom->n * FACE_PARTS);
    for (size_t k = 0; k < transom->n * FACE_PARTS; k++) {
        double point[SIDE][SIDE][3], end[2][3];
        edge_at(rim, width * (double)k, end[0]);
        edge_at(rim, width * ((double)k + 1.0), end[1]);
        for (int a = 0; a < SIDE; a++)
            for (int b = 0; b < SIDE; b++) {
                double x = end[0][0] + (end[1][0] - end[0][0]) * a / 3.0;
                double z = end[0][2] + (end[1][2] - end[0][2]) * a / 3.0;
                point[a][b][0] = x + (transom->x - x) * b / 3.0;
                point[a][b][1] = width * ((double)k + a / 3.0);
                point[a][b][2] = fmin(0.0, z) * (1.0 - b / 3.0);
            }
        struct element *element = &transom->face->element[k];
        *element = (struct element){.degree = {SIDE - 1, SIDE - 1},
                                    .upper = {1.0, 1.0},
                                    .extraction = {constant, constant},
                                    .net = spline_net(transom->face, k, (const double *)point),
                                    .first = k / FACE_PARTS,
                                    .stride = 1,
                                    .sign = -1.0};
        spline_panel(transom->face, k);
    }
    for (size_t j = 0; j < transom->n; j++) {
        struct jet jet;
        double area[3], at[3];
        const struct element *element = &transom->face->element[j * FACE_PARTS + FACE_PARTS / 2];
        element_jet(element, 0.5, 0.5, &jet);
        double size = jet_area(&jet, element->sign, area);
        transom->turn[j] = size > 0 ? area[0] / size : -1.0;
        edge_at(rim, transom->breadth * ((double)j + 0.5) / (double)transom->n, at);
        transom->depth[j] = at[2];
    }
}

static void fill_strip(struct transom *transom)
{
    double width = transom->breadth / (double)transom->n;
    for (size_t i = 0; i < transom->cells; i++)
        for (size_t j = 0; j < transom->n; j++) {
            double point[SIDE][SIDE][3];
            for (int a = 0; a < SIDE; a++)
                for (int b = 0; b < SIDE; b++) {
                    point[a][b][0] = transom->x - transom->dx * ((double)i + a / 3.0);
                    point[a][b][1] = width * ((double)j + b / 3.0);
                    point[a][b][2] = 0.0;
                }
            size_t e = i * transom->n + j;
            transom->strip->element[e] =
                (struct element){.degree = {SIDE - 1, SIDE - 1},
                                 .upper = {1.0, 1.0},
                                 .extraction = {spline_quadratic, constant},
                                 .net = spline_net(transom->strip, e, (const double *)point),
                                 .first = i * transom->stride + j,
                                 .stride = transom->stride,
                                 .sign = 1.0};
            spline_panel(transom->strip, e);
            transom->point[e] = (struct layer_point){
                .at = {transom->x - transom->dx * ((double)i + 0.5), width * ((double)j + 0.5), 0},
                .homes = 1,
                .home = {e},
                .local = {{0.5, 0.5}}};
        }
}

/* Adds factor times the coefficient of cell i, -2 <= i <= cells, of a column. Those of -1 and 0
 * are the rim's phi less and more half a cell's change of it, that of -2 lies on a parabola. */
static void add_coefficient(const struct transom *transom, long i, size_t j, double factor,
                            double *row)
{
    size_t n = transom->n, unknowns = transom->cells * n;
    double change = -transom->dx; /* of phi downstream, per slope */
    double *rim = row + unknowns + j, *slope = rim + n;
    if (i >= 1) {
        row[(size_t)(i - 1) * n + j] += factor;
    } else if (i == -2) {
        row[j] += factor;
        *slope -= 3.0 * factor * change;
    } else {
        *rim += factor;
        *slope += (i == 0 ? 0.5 : -0.5) * factor * change;
    }
}

static igabem_status fill_operator(struct transom *transom)
{
    size_t n = transom->n, cells = transom->cells, columns = cells * n + 2 * n, room[2] = {0, 0};
    double *row = calloc(columns, sizeof *row), scale = 1.0 / (transom->dx * transom->dx);
    transom->value.start = calloc(cells * n + 1, sizeof(size_t));
    transom->second.start = calloc(cells * n + 1, sizeof(size_t));
    bool complete = row && transom->value.start && transom->second.start;
    for (size_t i = 0; i < cells && complete; i++)
        for (size_t j = 0; j < n && complete; j++) {
            const double *second = i + 1 < cells ? spline_along[2] : spline_last[2];
            for (long k = 0; k < SPLINE_STENCIL; k++)
                if (spline_along[0][k] != 0.0)
                    add_coefficient(transom, (long)i + k - 2, j, spline_along[0][k], row);
            complete = sparse_append(&transom->value, columns, row, &room[0]);
            for (long k = 0; k < SPLINE_STENCIL; k++)
                if (second[k] != 0.0)
                    add_coefficient(transom, (long)i + k - 2, j, scale * second[k], row);
            complete = complete && sparse_append(&transom->second, columns, row, &room[1]);
        }
    free(row);
    return complete ? IGABEM_OK : no_memory();
}

static igabem_status fill_rim(struct transom *transom, const struct density *density,
                              const struct mesh *hull, const struct edge *rim)
{
    size_t room = 0;
    double *row = calloc(density->n, sizeof *row);
    transom->rim.start = calloc(transom->n + 1, sizeof(size_t));
    igabem_status status = row && transom->rim.start ? IGABEM_OK : no_memory();
    for (size_t j = 0; j < transom->n && status == IGABEM_OK; j++) {
        size_t patch;
        double uv[2], y = transom->breadth * ((double)j + 0.5) / (double)transom->n;
        status = edge_locate(rim, density, y, &patch, uv);
        if (status == IGABEM_OK)
            spline_hull_basis(hull, patch, uv, row);
        if (status == IGABEM_OK && !sparse_append(&transom->rim, density->n, row, &room))
            status = no_memory();
    }
    free(row);
    return status;
}

igabem_status transom_create(const struct density *density, const struct mesh *hull, double length,
                             double x, double breadth, double dx, size_t cells, double width,
                             struct transom **result)
{
    *result = NULL;
    struct transom *transom = calloc(1, sizeof *transom);
    if (!transom)
        return no_memory();
    size_t n = (size_t)fmax(LEAST_COLUMNS, round(breadth / width));
    *transom = (struct transom){.n = n,
                                .cells = cells,
                                .x = x,
                                .dx = dx,
                                .breadth = breadth,
                                .depth = malloc(n * sizeof(double)),
                                .turn = malloc(n * sizeof(double)),
                                .face = spline_mesh(n * FACE_PARTS),
                                .strip = spline_mesh(cells * n),
                                .stride = n + SIDE,
                                .coefficients = (cells + SIDE) * (n + SIDE),
                                .point = malloc(cells * n * sizeof(struct layer_point))};
    igabem_status status = edge_create(density, HULL_EDGE_OPEN, 1, length, &transom->rim_edge);
    if (!transom->depth || !transom->turn || !transom->face || !transom->strip || !transom->point)
        status = no_memory();
    if (status == IGABEM_OK) {
        fill_face(transom, &transom->rim_edge);
        fill_strip(transom);
        status = fill_operator(transom);
    }
    if (status == IGABEM_OK)
        status = fill_rim(transom, density, hull, &transom->rim_edge);
    if (status == IGABEM_OK)
        *result = transom;
    else
        transom_free(transom);
    return status;
}

void transom_free(struct transom *transom)
{
    if (!transom)
        return;
    edge_free(&transom->rim_edge);
    free(transom->depth);
    free(transom->turn);
    mesh_free(transom->face);
    mesh_free(transom->strip);
    free(transom->point);
    sparse_free(&transom->rim);
    sparse_free(&transom->value);
    sparse_free(&transom->second);
    free(transom);
}

void transom_fold(const struct transom *transom, double *coefficients, double *scratch)
{
    for (size_t j = 0; j < transom->n; j++)
        spline_fold(transom->cells, coefficients + j, transom->stride, scratch);
}

void transom_interpolate(const struct transom *transom, double *values, double *scratch)
{
    for (size_t j = 0; j < transom->n; j++)
        spline_interpolate(transom->cells, values + j, transom->stride, scratch);
}

/* phi_x of a column. */
static double column_slope(const struct transom *transom, size_t j, double xi, const double *phi)
{
    size_t n = transom->n, unknowns = transom->cells * n;
    double i = fmin(floor(xi), (double)transom->cells - 1.0), value[3], derivative[3], sum = 0.0;
    double half = -0.5 * transom->dx * phi[unknowns + n + j];
    spline_evaluate(xi - i, value, derivative);
    for (int k = 0; k < 3; k++) {
        long cell = (long)i + k - 1;
        double c = cell >= 1 ? phi[(size_t)(cell - 1) * n + j]
                             : phi[unknowns + j] + (cell == 0 ? half : -half);
        sum += derivative[k] * c;
    }
    return -sum / transom->dx;
}

double transom_slope(const struct transom *transom, double x, double y, const double *phi)
{
    double last = (double)transom->n - 1.0, xi = (transom->x - x) / transom->dx;
    double at = fmin(last, fmax(0.0, fabs(y) * (double)transom->n / transom->breadth - 0.5));
    double low = fmin(floor(at), last - 1.0), share = at - low;
    xi = fmin((double)transom->cells, fmax(0.0, xi));
    return (1.0 - share) * column_slope(transom, (size_t)low, xi, phi) +
           share * column_slope(transom, (size_t)low + 1, xi, phi);
}
