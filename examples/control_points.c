/* Moves of control points of a NURBS hull as a shape modification: the rows of basis functions at
 * the points of a grid are its fields. usage: example_control_points HULL.json
 *
 * Fails when the displaced grid is not that of the hull with its control points moved. */
#include <galv/galv.h>
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS = 60, GIRTH = 20, POINTS = STATIONS * GIRTH, ALONG = 6, AROUND = 4 };
enum { N = ALONG * AROUND };

/* Parameters of the grid: equally spaced over the patch. */
static void grid_parameters(const nurbs_surface *hull, double *uv)
{
    const double *ku = nurbs_surface_knots(hull, 0), *kv = nurbs_surface_knots(hull, 1);
    double u0 = ku[0], du = ku[nurbs_surface_size(hull, 0)] - u0;
    double v0 = kv[0], dv = kv[nurbs_surface_size(hull, 1)] - v0;
    for (int i = 0; i < STATIONS; i++)
        for (int j = 0; j < GIRTH; j++) {
            double *p = uv + 2 * (i * GIRTH + j);
            p[0] = u0 + du * i / (STATIONS - 1);
            p[1] = v0 + dv * j / (GIRTH - 1);
        }
}

/* Which control points move: N inner ones, so that the edges of the patch stay. */
static size_t moved(const nurbs_surface *hull, int k)
{
    size_t nu = nurbs_surface_size(hull, 0), nv = nurbs_surface_size(hull, 1);
    size_t i = (size_t)(1 + k / AROUND) * nu / (ALONG + 1);
    size_t j = (size_t)(1 + k % AROUND) * nv / (AROUND + 1);
    return i * nv + j;
}

/* Field k: the basis function of control point k at every grid point, along y. */
static int make_fields(const nurbs_surface *hull, const double *uv, double *fields)
{
    size_t count =
        (size_t)(nurbs_surface_degree(hull, 0) + 1) * (size_t)(nurbs_surface_degree(hull, 1) + 1);
    size_t *columns = malloc(POINTS * count * sizeof *columns);
    double *values = malloc(POINTS * count * sizeof *values);
    int failed =
        !columns || !values || nurbs_surface_rows(hull, 0, POINTS, uv, columns, values) != NURBS_OK;
    for (size_t r = 0; !failed && r < POINTS * count; r++)
        for (int k = 0; k < N; k++)
            if (columns[r] == moved(hull, k))
                fields[3 * ((size_t)k * POINTS + r / count) + 1] = values[r];
    free(columns);
    free(values);
    return failed;
}

/* The grid of the hull with its control points moved by x along y. */
static int move_hull(const nurbs_surface *hull, const double *x, const double *uv, double *xyz)
{
    const int degree[2] = {nurbs_surface_degree(hull, 0), nurbs_surface_degree(hull, 1)};
    const size_t size[2] = {nurbs_surface_size(hull, 0), nurbs_surface_size(hull, 1)};
    nurbs_surface *other = NULL;
    double *points = malloc(3 * size[0] * size[1] * sizeof *points);
    if (!points)
        return 1;
    memcpy(points, nurbs_surface_points(hull), 3 * size[0] * size[1] * sizeof *points);
    for (int k = 0; k < N; k++)
        points[3 * moved(hull, k) + 1] += x[k];
    int failed = nurbs_surface_create(degree, size, nurbs_surface_knots(hull, 0),
                                      nurbs_surface_knots(hull, 1), points,
                                      nurbs_surface_weights(hull), &other) != NURBS_OK ||
                 nurbs_surface_eval(other, 0, POINTS, uv, xyz) != NURBS_OK;
    nurbs_surface_free(other);
    free(points);
    return failed;
}

/* Largest difference between the two ways to the same hull. */
static double difference(const nurbs_surface *hull, const galv_shape *shape, const double *uv,
                         const double *xyz)
{
    static double other[3 * POINTS], d[3 * POINTS];
    double x[N], largest = 0;
    galv_uniform_sample(1, 0, N, galv_shape_lower(shape), galv_shape_upper(shape), x);
    if (move_hull(hull, x, uv, other) || galv_shape_displace(shape, POINTS, xyz, x, d) != GALV_OK)
        return INFINITY;
    for (size_t i = 0; i < (size_t)3 * POINTS; i++)
        largest = fmax(largest, fabs(xyz[i] + d[i] - other[i]));
    return largest;
}

int main(int argc, char **argv)
{
    static double uv[2 * POINTS], xyz[3 * POINTS], fields[3 * N * POINTS];
    double lower[N], upper[N];
    nurbs_patches *patches = NULL;
    galv_shape *shape = NULL;
    galv_model *model = NULL;
    if (argc != 2 || nurbs_patches_read(argv[1], &patches) != NURBS_OK) {
        fprintf(stderr, "control_points: %s\n", argc == 2 ? nurbs_last_error() : "HULL.json?");
        return 1;
    }
    const nurbs_surface *hull = nurbs_patches_get(patches, 0);
    for (int k = 0; k < N; k++) {
        lower[k] = -0.02;
        upper[k] = 0.02;
    }
    grid_parameters(hull, uv);
    int failed =
        nurbs_surface_eval(hull, 0, POINTS, uv, xyz) != NURBS_OK || make_fields(hull, uv, fields);
    if (!failed && (galv_shape_fields(N, POINTS, fields, lower, upper, &shape) != GALV_OK ||
                    galv_build(shape, POINTS, xyz, galv_uniform(2000, 1), NULL, &model) != GALV_OK))
        failed = fprintf(stderr, "control_points: %s\n", galv_last_error());
    if (!failed) {
        double off = difference(hull, shape, uv, xyz);
        printf(
            "%d control points, %zu latent variables retain %.2f %%; displaced grid off the moved "
            "hull's by %.1e m\n",
            N, galv_model_modes(model), 100 * galv_model_retained(model), off);
        failed = !(off < 1e-12);
    }
    galv_model_free(model);
    galv_shape_free(shape);
    nurbs_patches_free(patches);
    return failed ? 1 : 0;
}
