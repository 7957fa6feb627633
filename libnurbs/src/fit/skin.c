/* Skinning of a grid: a curve through every section, then curves through their control points.
 *
 * Kinks. A tensor product can only break where a whole parameter line may break, so a station with
 * a kink and a column that is a chine get a knot of multiplicity `degree`. Lines that turn less
 * than the kink angle there are still interpolated with full smoothness and only carry the extra
 * knots: the hull stays C^2 where it is smooth, and no tangent is invented at a station. */
#include "core/error.h"
#include "fit/interpolate.h"
#include "fit/parametrize.h"

#include <nurbs/basis.h>
#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

void nurbs_skin_options_init(nurbs_skin_options *options)
{
    if (!options)
        return;
    *options = (nurbs_skin_options){.degree = 3,
                                    .parametrize = NURBS_PARAMETRIZATION_CENTRIPETAL,
                                    .kink_angle = 0.34906585039886592};
}

typedef struct skin {
    size_t rows, columns, kinks;
    const double *points;
    double *u, *v;         /* parameters of rows and columns */
    size_t *kink;          /* row indices */
    unsigned char *active; /* [columns][kinks]: this column breaks at that kink */
    size_t chines;
    const size_t *chine;   /* column indices */
    unsigned char *broken; /* [rows][chines]: this section breaks at that chine */
    double *net;           /* control points of the sections: [axis_v.size][rows][3] */
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
    if (options->chine_count && !options->chine)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "chine is NULL, expected %zu columns",
                          options->chine_count);
    for (size_t k = 0; k < options->chine_count; k++)
        if (options->chine[k] < 1 || options->chine[k] + 1 >= columns ||
            (k > 0 && options->chine[k] <= options->chine[k - 1]))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "chine %zu is column %zu, expected increasing columns between the "
                              "first and the last of %zu",
                              k, options->chine[k] + 1, columns);
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
    free(work->broken);
    free(work->net);
}

static nurbs_status skin_reserve(const nurbs_grid *grid, const nurbs_skin_options *options,
                                 skin *work)
{
    size_t rows = nurbs_grid_rows(grid), columns = nurbs_grid_columns(grid);
    *work = (skin){.rows = rows,
                   .columns = columns,
                   .points = nurbs_grid_points(grid),
                   .chines = options->chine_count,
                   .chine = options->chine};
    work->u = malloc((rows + columns) * sizeof(double));
    work->kink = malloc(rows * sizeof(size_t));
    work->active = calloc(rows * columns, 1);
    work->broken = calloc(rows * columns, 1);
    if (!work->u || !work->kink || !work->active || !work->broken) {
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

/* The sections that turn at the chines. */
static void find_broken(double angle, skin *work)
{
    for (size_t i = 0; i < work->rows; i++)
        for (size_t k = 0; k < work->chines; k++) {
            const double *p = work->points + 3 * (i * work->columns + work->chine[k]);
            work->broken[i * work->chines + k] =
                !(angle > 0) || nurbs_turning_angle(p - 3, p, p + 3) > angle;
        }
}

/* Control points of the sections first ... last - 1, which break alike. */
static nurbs_status solve_sections(const kinked_axis *axis, const skin *work, size_t first,
                                   size_t last)
{
    size_t m = 3 * (last - first), rows = work->rows;
    double *data = malloc((work->columns + axis->size) * m * sizeof *data);
    if (!data)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory to skin %zu sections", last - first);
    double *control = data + work->columns * m;
    for (size_t j = 0; j < work->columns; j++)
        for (size_t i = first; i < last; i++)
            memcpy(data + j * m + 3 * (i - first), work->points + 3 * (i * work->columns + j),
                   3 * sizeof(double));
    nurbs_status status =
        kinked_axis_solve(axis, work->broken + first * work->chines, m, data, control);
    for (size_t j = 0; j < axis->size && status == NURBS_OK; j++)
        memcpy(work->net + 3 * (j * rows + first), control + j * m, m * sizeof(double));
    free(data);
    return status;
}

/* Control points of the section curves. */
static nurbs_status section_curves(const kinked_axis *axis, const skin *work)
{
    nurbs_status status = NURBS_OK;
    for (size_t first = 0, last; first < work->rows && status == NURBS_OK; first = last) {
        for (last = first + 1; last < work->rows; last++)
            if (memcmp(work->broken + first * work->chines, work->broken + last * work->chines,
                       work->chines) != 0)
                break;
        status = solve_sections(axis, work, first, last);
    }
    return status;
}

/* With chines there are more control columns than columns: each takes the kinks of the column
 * nearest to its Greville abscissa. Creates active[axis->size][kinks]. */
static nurbs_status spread_active(const kinked_axis *axis, skin *work)
{
    unsigned char *active = calloc(axis->size * work->kinks + 1, 1);
    double *greville = malloc(axis->size * sizeof *greville);
    nurbs_status status = NURBS_OK;
    if (active && greville) {
        nurbs_greville(axis->degree, axis->size, axis->knots, greville);
        for (size_t j = 0, column = 0; j < axis->size; j++) {
            while (column + 1 < work->columns &&
                   fabs(work->v[column + 1] - greville[j]) <= fabs(work->v[column] - greville[j]))
                column++;
            memcpy(active + j * work->kinks,
                   work->active + (work->chines ? column : j) * work->kinks, work->kinks);
        }
        free(work->active);
        work->active = active;
        active = NULL;
    } else {
        status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu columns", axis->size);
    }
    free(active);
    free(greville);
    return status;
}

/* Interpolates together the neighbouring columns first ... last - 1, which break alike. */
static nurbs_status solve_columns(const kinked_axis *axis, const skin *work, size_t across,
                                  size_t first, size_t last, double *points)
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
        memcpy(points + 3 * (i * across + first), control + i * m, m * sizeof(double));
    free(data);
    return status;
}

static nurbs_status solve_net(const kinked_axis *axis, const skin *work, size_t across,
                              double *points)
{
    nurbs_status status = NURBS_OK;
    for (size_t first = 0, last; first < across && status == NURBS_OK; first = last) {
        for (last = first + 1; last < across; last++)
            if (memcmp(work->active + first * work->kinks, work->active + last * work->kinks,
                       work->kinks) != 0)
                break;
        status = solve_columns(axis, work, across, first, last, points);
    }
    return status;
}

static nurbs_status build_surface(int degree, skin *work, nurbs_surface **surface)
{
    kinked_axis along = {0}, across = {0};
    double *points = NULL;
    nurbs_status status =
        kinked_axis_create(degree, work->columns, work->v, work->chines, work->chine, &across);
    if (status == NURBS_OK)
        status = kinked_axis_create(degree, work->rows, work->u, work->kinks, work->kink, &along);
    if (status == NURBS_OK) {
        points = malloc(3 * along.size * across.size * sizeof *points);
        work->net = malloc(3 * work->rows * across.size * sizeof *points);
        if (!points || !work->net)
            status = nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu x %zu control points",
                                along.size, across.size);
    }
    if (status == NURBS_OK)
        status = section_curves(&across, work);
    if (status == NURBS_OK)
        status = spread_active(&across, work);
    if (status == NURBS_OK)
        status = solve_net(&along, work, across.size, points);
    if (status == NURBS_OK)
        status = nurbs_surface_create((int[]){degree, degree}, (size_t[]){along.size, across.size},
                                      along.knots, across.knots, points, NULL, surface);
    kinked_axis_free(&along);
    kinked_axis_free(&across);
    free(points);
    return status;
}

/* The parameters of `lines` lines of n points, or those given. */
static nurbs_status take_parameters(const nurbs_skin_options *options, const double *given,
                                    size_t lines, size_t n, size_t line_step, size_t step,
                                    const double *points, double *t)
{
    if (!given)
        return nurbs_parametrize_lines(options->parametrize, lines, n, line_step, step, points, t);
    for (size_t k = 0; k < n; k++)
        if (!isfinite(given[k]) || (k > 0 && !(given[k] > given[k - 1])))
            return nurbs_fail(NURBS_ERROR_ARGUMENT,
                              "parameter %zu of a skin is %g, expected increasing numbers", k + 1,
                              given[k]);
    memcpy(t, given, n * sizeof *t);
    return NURBS_OK;
}

static nurbs_status parameters(const nurbs_skin_options *options, skin *work)
{
    nurbs_status status = take_parameters(options, options->u, work->columns, work->rows, 1,
                                          work->columns, work->points, work->u);
    if (status == NURBS_OK)
        status = take_parameters(options, options->v, work->rows, work->columns, work->columns, 1,
                                 work->points, work->v);
    return status;
}

nurbs_status nurbs_skin_parameters(const nurbs_grid *grid, const nurbs_skin_options *options,
                                   double *u, double *v)
{
    NURBS_NEED(grid && u && v);
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
    NURBS_NEED(grid && surface);
    nurbs_skin_options defaults;
    skin work;
    *surface = NULL;
    nurbs_skin_options_init(&defaults);
    options = options ? options : &defaults;
    nurbs_status status = check_request(grid, options);
    if (status == NURBS_OK)
        status = skin_reserve(grid, options, &work);
    if (status != NURBS_OK)
        return status;
    status = parameters(options, &work);
    if (status == NURBS_OK) {
        find_kinks(options->kink_angle, &work);
        find_broken(options->kink_angle, &work);
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
