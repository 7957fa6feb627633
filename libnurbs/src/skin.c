/* Skinning of a grid: a curve through every section, then curves through their control points.
 *
 * Kinks. A tensor product can only break where a whole parameter line may break, so a station with
 * a kink gets a knot of multiplicity `degree`. Lines that turn less than the kink angle there are
 * still interpolated with full smoothness and only carry the extra knots: the hull stays C^2 where
 * it is smooth, and no tangent is invented at a station. */
#include "error.h"
#include "interpolate.h"
#include "parametrize.h"
#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

void nurbs_skin_options_init(nurbs_skin_options *options)
{
    *options = (nurbs_skin_options){
        .degree = 3, .parametrize = NURBS_CENTRIPETAL, .kink_angle = 0.34906585039886592};
}

typedef struct skin {
    size_t rows, columns, kinks;
    const double *points;
    double *u, *v;         /* parameters of rows and columns */
    size_t *kink;          /* row indices */
    unsigned char *active; /* [columns][kinks]: this column breaks at that kink */
    double *net;           /* [columns][rows][3], then the control net of sections */
} skin;

static nurbs_status check_request(const nurbs_grid *grid, const nurbs_skin_options *options)
{
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    const double *points = nurbs_grid_points(grid);
    if (options->degree < 1 || options->degree > 5)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "skin of degree %d, expected 1 to 5",
                          options->degree);
    if (rows <= (size_t)options->degree || columns <= (size_t)options->degree)
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "grid of %zu x %zu points is too small for a skin of degree %d", rows,
                          columns, options->degree);
    if (isnan(options->kink_angle))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "kink_angle is NaN");
    for (size_t k = 0; k < 3 * rows * columns; k++)
        if (!isfinite(points[k]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT, "grid point (%zu,%zu): coordinate %zu is %g",
                              k / 3 / columns + 1, k / 3 % columns + 1, k % 3, points[k]);
    return NURBS_OK;
}

static void skin_release(skin *work)
{
    free(work->u);
    free(work->kink);
    free(work->active);
    free(work->net);
}

static nurbs_status skin_reserve(const nurbs_grid *grid, skin *work)
{
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    *work = (skin){rows, columns, 0, nurbs_grid_points(grid), NULL, NULL, NULL, NULL, NULL};
    work->u = malloc((rows + columns) * sizeof(double));
    work->kink = malloc(rows * sizeof(size_t));
    work->active = calloc(rows * columns, 1);
    work->net = malloc(3 * rows * columns * sizeof(double));
    if (!work->u || !work->kink || !work->active || !work->net) {
        skin_release(work);
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to skin %zu x %zu points", rows, columns);
    }
    work->v = work->u + rows;
    return NURBS_OK;
}

static double turning_at(const skin *work, size_t row, size_t column)
{
    const double *p = work->points + 3 * (row * work->columns + column);
    size_t step = 3 * work->columns;
    return nurbs_turning_angle(p - step, p, p + step);
}

/* Stations where an edge line of the grid turns by more than `angle`, and the columns that turn so
 * there. */
static void find_kinks(double angle, skin *work)
{
    if (!(angle > 0))
        return;
    for (size_t i = 1; i + 1 < work->rows; i++)
        if (turning_at(work, i, 0) > angle || turning_at(work, i, work->columns - 1) > angle)
            work->kink[work->kinks++] = i;
    for (size_t j = 0; j < work->columns; j++)
        for (size_t k = 0; k < work->kinks; k++)
            work->active[j * work->kinks + k] = turning_at(work, work->kink[k], j) > angle;
}

/* Control points of the section curves: net[columns][rows][3]. */
static nurbs_status section_curves(int degree, const double *knots, skin *work)
{
    for (size_t i = 0; i < work->rows; i++)
        for (size_t j = 0; j < work->columns; j++)
            memcpy(work->net + 3 * (j * work->rows + i), work->points + 3 * (i * work->columns + j),
                   3 * sizeof(double));
    banded factors;
    nurbs_status status = collocation_factor(degree, work->columns, knots, work->v, &factors);
    if (status == NURBS_OK) {
        banded_solve(&factors, 3 * work->rows, work->net);
        banded_free(&factors);
    }
    return status;
}

/* Interpolates together the neighbouring columns first ... last - 1, which break alike. */
static nurbs_status solve_columns(const kinked_axis *axis, const skin *work, size_t first,
                                  size_t last, double *points)
{
    size_t m = 3 * (last - first), rows = work->rows;
    double *data = malloc((rows + axis->size) * m * sizeof *data);
    if (!data)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to skin %zu columns", last - first);
    double *control = data + rows * m;
    for (size_t j = first; j < last; j++)
        for (size_t i = 0; i < rows; i++)
            memcpy(data + i * m + 3 * (j - first), work->net + 3 * (j * rows + i),
                   3 * sizeof(double));
    nurbs_status status =
        kinked_axis_solve(axis, work->active + first * work->kinks, m, data, control);
    for (size_t i = 0; i < axis->size && status == NURBS_OK; i++)
        memcpy(points + 3 * (i * work->columns + first), control + i * m, m * sizeof(double));
    free(data);
    return status;
}

static nurbs_status solve_net(const kinked_axis *axis, const skin *work, double *points)
{
    nurbs_status status = NURBS_OK;
    for (size_t first = 0, last; first < work->columns && status == NURBS_OK; first = last) {
        for (last = first + 1; last < work->columns; last++)
            if (memcmp(work->active + first * work->kinks, work->active + last * work->kinks,
                       work->kinks) != 0)
                break;
        status = solve_columns(axis, work, first, last, points);
    }
    return status;
}

static nurbs_status build_surface(int degree, skin *work, nurbs_surface **surface)
{
    kinked_axis axis;
    size_t order = (size_t)degree + 1;
    double *knots_v = malloc((work->columns + order) * sizeof *knots_v), *points = NULL;
    if (!knots_v)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu knots", work->columns + order);
    interpolation_knots(degree, work->columns, work->v, knots_v);
    nurbs_status status =
        kinked_axis_create(degree, work->rows, work->u, work->kinks, work->kink, &axis);
    if (status == NURBS_OK) {
        points = malloc(3 * axis.size * work->columns * sizeof *points);
        if (!points)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu control points",
                                axis.size, work->columns);
        if (status == NURBS_OK)
            status = section_curves(degree, knots_v, work);
        if (status == NURBS_OK)
            status = solve_net(&axis, work, points);
        if (status == NURBS_OK)
            status =
                nurbs_surface_create((int[]){degree, degree}, (size_t[]){axis.size, work->columns},
                                     axis.knots, knots_v, points, NULL, surface);
        kinked_axis_free(&axis);
    }
    free(points);
    free(knots_v);
    return status;
}

static nurbs_status parameters(const nurbs_skin_options *options, skin *work)
{
    nurbs_status status = nurbs_parametrize_lines(options->parametrize, work->columns, work->rows,
                                                  1, work->columns, work->points, work->u);
    if (status == NURBS_OK)
        status = nurbs_parametrize_lines(options->parametrize, work->rows, work->columns,
                                         work->columns, 1, work->points, work->v);
    return status;
}

nurbs_status nurbs_skin_parameters(const nurbs_grid *grid, const nurbs_skin_options *options,
                                   double *u, double *v)
{
    nurbs_skin_options defaults;
    nurbs_skin_options_init(&defaults);
    options = options ? options : &defaults;
    skin work = {.rows = nurbs_grid_rows(grid),
                 .columns = nurbs_grid_columns(grid),
                 .points = nurbs_grid_points(grid),
                 .u = u,
                 .v = v};
    return parameters(options, &work);
}

nurbs_status nurbs_skin(const nurbs_grid *grid, const nurbs_skin_options *options,
                        nurbs_surface **surface)
{
    nurbs_skin_options defaults;
    skin work;
    *surface = NULL;
    nurbs_skin_options_init(&defaults);
    options = options ? options : &defaults;
    nurbs_status status = check_request(grid, options);
    if (status == NURBS_OK)
        status = skin_reserve(grid, &work);
    if (status != NURBS_OK)
        return status;
    status = parameters(options, &work);
    if (status == NURBS_OK) {
        find_kinks(options->kink_angle, &work);
        status = build_surface(options->degree, &work, surface);
    }
    skin_release(&work);
    if (status == NURBS_OK)
        status = nurbs_surface_check_fold(*surface, NULL);
    if (status != NURBS_OK) {
        nurbs_surface_free(*surface);
        *surface = NULL;
    }
    return status;
}
