#include "tangent/shape.h"

#include "exterior/base_flow.h"
#include "exterior/operator.h"
#include "exterior/spline.h"
#include "result/radiation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void shape_place(const igabem_solution *solution, struct shape *shape)
{
    const struct free_surface *surface = solution->surface;
    const struct transom *transom = solution->transom;
    size_t columns = transom ? transom->n : 0, parts = transom ? transom->face->n : 0, at = 0;
    *shape = (struct shape){.surface = surface, .transom = transom, .parts = parts};
    at += 3 * surface->nx + 1;
    shape->breadth = at++;
    shape->corner = at;
    at += 2 * (parts + 1);
    shape->wave = at;
    at += surface->nx * surface->ny;
    shape->strip = at;
    at += transom ? transom->cells * columns : 0;
    shape->rim = at;
    at += columns;
    shape->flux = at;
    at += columns;
    shape->point = at;
    shape->size = at + 2 * FACE_ACROSS * parts;
}

double shape_across(const struct shape *shape, const struct gauss *gauss, size_t part,
                    size_t across)
{
    return shape->transom->breadth / (double)shape->parts *
           ((double)part + gauss->node[FACE_ACROSS][across]);
}

igabem_status shape_rim(const igabem_tangent *tangent, const struct shape *shape, size_t part,
                        size_t across, double *row)
{
    struct gauss gauss;
    size_t patch;
    double uv[2];
    igabem_status status = gauss_fill(&gauss);
    if (status == IGABEM_OK)
        status = edge_locate(&shape->transom->rim_edge, tangent->solution->density,
                             shape_across(shape, &gauss, part, across), &patch, uv);
    if (status == IGABEM_OK)
        spline_hull_basis(tangent->mesh, patch, uv, row);
    return status;
}

/* Changes of an edge: of |y| at its points, [points][fields]. */
struct edge_change {
    const struct edge *edge;
    size_t n;
    double *move;
};

static igabem_status edge_change(const igabem_tangent *tangent, const struct edge *edge,
                                 struct edge_change *change)
{
    size_t n = tangent->field->n;
    double *v = malloc(3 * n * sizeof *v);
    *change = (struct edge_change){edge, n, malloc((edge->n * n + 1) * sizeof *change->move)};
    if (!v || !change->move) {
        free(v);
        return tangent_no_memory(n);
    }
    for (size_t k = 0; k < edge->n; k++) {
        double local[2];
        const struct element *element =
            mesh_locate(tangent->mesh, edge->point[k].patch, edge->point[k].uv, local);
        struct jet jet;
        element_jet(element, local[0], local[1], &jet);
        field_at(tangent->field, element, local, v);
        for (size_t f = 0; f < n; f++)
            change->move[k * n + f] = jet.s[1] < 0.0 ? -v[f] : v[f];
    }
    free(v);
    return IGABEM_OK;
}

/* Of free_surface_breadth(). */
static void breadth_change(const struct free_surface *surface, const struct edge_change *line,
                           double x, double *out)
{
    const struct edge *edge = line->edge;
    size_t n = line->n;
    memset(out, 0, n * sizeof *out);
    if (!edge->n || x > edge->last || (x < edge->first && surface->transom == 0))
        return;
    double share = 0.0;
    const struct edge_point *p = x < edge->first ? edge->point : edge_before(edge, x, &share);
    const double *move = line->move + (size_t)(p - edge->point) * n;
    for (size_t f = 0; f < n; f++)
        out[f] = (1.0 - share) * move[f] + share * move[n + f];
}

/* Changes of a place of the rim whose coordinate y changes too. */
struct rim_change {
    double *x, *z, *phi; /* [fields] */
};

/* Of edge_at(). dy[fields]. */
static void change_at(const struct edge_change *rim, double y, const double *dy,
                      const struct rim_change *out)
{
    double share;
    const struct edge_point *p = edge_before(rim->edge, y, &share);
    const double *move = rim->move + (size_t)(p - rim->edge->point) * rim->n;
    double width = p[1].at[1] - p[0].at[1];
    for (size_t f = 0; f < rim->n; f++) {
        double a = move[f], b = move[rim->n + f];
        double change = width > 0 ? (dy[f] - a - share * (b - a)) / width : 0.0;
        out->x[f] = change * (p[1].at[0] - p[0].at[0]);
        out->z[f] = change * (p[1].at[2] - p[0].at[2]);
    }
}

/* Of phi where edge_locate() looks it up, phi on the hull as it is, [n] coefficients; v[3][fields].
 */
static igabem_status change_phi(const igabem_tangent *tangent, const struct edge_change *rim,
                                const double *on_hull, double y, const double *dy, double *v,
                                double *phi)
{
    double share, uv[2], local[2], slope[2];
    size_t patch, n = rim->n;
    const struct edge_point *p = edge_before(rim->edge, y, &share);
    const double *move = rim->move + (size_t)(p - rim->edge->point) * n;
    double width = p[1].at[1] - p[0].at[1];
    memset(phi, 0, n * sizeof *phi);
    if (p[0].patch != p[1].patch || !(width > 0))
        return IGABEM_OK;
    const double step[2] = {p[1].uv[0] - p[0].uv[0], p[1].uv[1] - p[0].uv[1]};
    for (int d = 0; d < 2; d++)
        uv[d] = p[0].uv[d] + share * step[d];
    const struct element *element = mesh_locate(tangent->mesh, p[0].patch, uv, local);
    struct jet jet;
    element_jet(element, local[0], local[1], &jet);
    field_at(tangent->field, element, local, v);
    double sign = jet.s[1] < 0.0 ? -1.0 : 1.0, miss = y - fabs(jet.s[1]), along = 0.0;
    const double ds[2] = {jet.ds[1], jet.dt[1]};
    for (int d = 0; d < 2; d++)
        along += sign * ds[d] * step[d] / (element->upper[d] - element->lower[d]);
    igabem_status status = edge_locate(rim->edge, tangent->solution->density, y, &patch, uv);
    if (status != IGABEM_OK)
        return status;
    element = mesh_locate(tangent->mesh, patch, uv, local);
    element_slope(element, on_hull, local, slope);
    double rise = 0.0; /* of phi with the share */
    for (int d = 0; d < 2; d++)
        rise += slope[d] * step[d] / (element->upper[d] - element->lower[d]);
    for (size_t f = 0; f < n; f++) {
        double a = move[f], b = move[n + f];
        double first = (dy[f] - a - share * (b - a)) / width;
        double missed = dy[f] - sign * v[f] - along * first;
        phi[f] = rise * (first + missed / width - miss * (b - a) / (width * width));
    }
    return IGABEM_OK;
}

/* Of n_x of the face in the middle of one of its elements, whose corners change. */
static void change_turn(const struct shape *shape, size_t part, size_t n, const double *change,
                        double *turn)
{
    const struct element *element = &shape->transom->face->element[part];
    const double *x = change + (shape->corner + part) * n, *z = x + (shape->parts + 1) * n;
    const double *breadth = change + shape->breadth * n;
    struct jet jet;
    double area[3];
    element_jet(element, 0.5, 0.5, &jet);
    double size = jet_area(&jet, element->sign, area);
    for (size_t f = 0; f < n; f++) {
        const double s[3] = {0.5 * (x[n + f] - x[f]), breadth[f] / (double)shape->parts,
                             0.5 * (z[n + f] - z[f])};
        const double t[3] = {-0.5 * (x[n + f] + x[f]), 0.0, -0.5 * (z[n + f] + z[f])};
        double d[3], along = 0.0;
        for (int c = 0; c < 3; c++) {
            int a = (c + 1) % 3, b = (c + 2) % 3;
            d[c] = element->sign *
                   (s[a] * jet.dt[b] - s[b] * jet.dt[a] + jet.ds[a] * t[b] - jet.ds[b] * t[a]);
            along += d[c] * area[c];
        }
        turn[f] = size > 0 ? (d[0] - area[0] * along / (size * size)) / size : 0.0;
    }
}

/* Work of the transom's part: rows of [fields]. */
struct transom_work {
    double *dy, *x, *z, *phi, *v, *depth; /* depth[columns] */
};

static igabem_status change_columns(const igabem_tangent *tangent, const struct shape *shape,
                                    const struct edge_change *rim, const struct transom_work *work,
                                    double *change)
{
    const struct transom *transom = shape->transom;
    const igabem_solution *solution = tangent->solution;
    size_t n = rim->n;
    double rate = solution->speed * solution->k0;
    const double *breadth = change + shape->breadth * n;
    const struct rim_change at = {work->x, work->z, work->phi};
    for (size_t j = 0; j < transom->n; j++) {
        double share = ((double)j + 0.5) / (double)transom->n, y = transom->breadth * share;
        double *flux = change + (shape->flux + j) * n;
        for (size_t f = 0; f < n; f++)
            work->dy[f] = share * breadth[f];
        change_at(rim, y, work->dy, &at);
        memcpy(work->depth + j * n, at.z, n * sizeof *at.z);
        change_turn(shape, j * TRANSOM_FACE_PARTS + TRANSOM_FACE_PARTS / 2, n, change, flux);
        for (size_t f = 0; f < n; f++)
            flux[f] = rate * (flux[f] * transom->depth[j] + transom->turn[j] * at.z[f]);
        igabem_status status = change_phi(tangent, rim, tangent->solution->sigma, y, work->dy,
                                          work->v, change + (shape->rim + j) * n);
        if (status != IGABEM_OK)
            return status;
    }
    return IGABEM_OK;
}

/* Rim and slope of the strip's operators. */
static void change_strip(const igabem_tangent *tangent, const struct shape *shape,
                         const double *depth, double *change, double *row)
{
    const struct transom *transom = shape->transom;
    size_t n = tangent->field->n, cells = transom->cells * transom->n;
    const struct sparse *const kind[2] = {&transom->second, &transom->value};
    double rate = tangent->solution->speed * tangent->solution->k0;
    const double factor[2] = {1.0 / tangent->solution->k0, -1.0};
    for (int o = 0; o < 2; o++)
        for (size_t c = 0; c < cells; c++) {
            double *to = o ? row + c * n : change + (shape->strip + c) * n;
            memset(to, 0, n * sizeof *to);
            for (size_t k = kind[o]->start[c]; k < kind[o]->start[c + 1]; k++) {
                size_t column = kind[o]->column[k];
                if (column < cells)
                    continue;
                column -= cells;
                bool rim = column < transom->n;
                const double *from =
                    rim ? change + (shape->rim + column) * n : depth + (column - transom->n) * n;
                double value = factor[o] * kind[o]->value[k] * (rim ? 1.0 : rate);
                for (size_t f = 0; f < n; f++)
                    to[f] += value * from[f];
            }
        }
}

static igabem_status change_points(const igabem_tangent *tangent, const struct shape *shape,
                                   const struct edge_change *rim, const struct transom_work *work,
                                   double *change)
{
    size_t n = rim->n, points = FACE_ACROSS * shape->parts;
    double rate = tangent->solution->speed * tangent->solution->k0;
    const double *breadth = change + shape->breadth * n;
    struct gauss gauss;
    igabem_status status = gauss_fill(&gauss);
    for (size_t k = 0; k < points && status == IGABEM_OK; k++) {
        double y = shape_across(shape, &gauss, k / FACE_ACROSS, k % FACE_ACROSS), at[3];
        double *phi = change + (shape->point + k) * n, *slope = phi + points * n;
        const struct rim_change to = {work->x, slope, NULL};
        for (size_t f = 0; f < n; f++)
            work->dy[f] = y / shape->transom->breadth * breadth[f];
        edge_at(rim->edge, y, at);
        change_at(rim, y, work->dy, &to);
        for (size_t f = 0; f < n; f++)
            slope[f] *= at[2] < 0.0 ? rate : 0.0;
        status = change_phi(tangent, rim, tangent->solution->sigma, y, work->dy, work->v, phi);
    }
    return status;
}

static igabem_status change_transom(const igabem_tangent *tangent, const struct shape *shape,
                                    double *change, double *row)
{
    const struct transom *transom = shape->transom;
    size_t n = tangent->field->n;
    struct edge_change rim = {.move = NULL};
    double *space = malloc((7 + transom->n) * n * sizeof *space);
    const struct transom_work work = {space,         space + n,     space + 2 * n,
                                      space + 3 * n, space + 4 * n, space + 7 * n};
    igabem_status status =
        space ? edge_change(tangent, &transom->rim_edge, &rim) : tangent_no_memory(n);
    if (status == IGABEM_OK)
        status = change_columns(tangent, shape, &rim, &work, change);
    if (status == IGABEM_OK) {
        change_strip(tangent, shape, work.depth, change, row);
        status = change_points(tangent, shape, &rim, &work, change);
    }
    free(space);
    free(rim.move);
    return status;
}

/* Of the free surface itself. */
static igabem_status change_surface(const igabem_tangent *tangent, const struct shape *shape,
                                    const struct edge_change *line, const double *base,
                                    double *change, double *row)
{
    const igabem_solution *solution = tangent->solution;
    const struct free_surface *surface = shape->surface;
    size_t n = tangent->field->n, nx = surface->nx, cells = nx * surface->ny;
    double *half = malloc((2 * nx + 1) * n * sizeof *half), *odd = malloc(cells * n * sizeof *odd);
    double *wave = change + shape->wave * n;
    igabem_status status = half && odd ? IGABEM_OK : tangent_no_memory(n);
    for (size_t k = 0; k <= 2 * nx && half; k++)
        breadth_change(surface, line, surface->x0 - surface->dx * (0.5 * (double)k), half + k * n);
    if (status == IGABEM_OK)
        status = operator_change(&(struct operator_change){surface, solution->surface_phi, n, half,
                                                           solution->base, base},
                                 row, wave, odd);
    double damping = solution->options.surface_damping / sqrt(solution->k0);
    for (size_t k = 0; k < cells * n && status == IGABEM_OK; k++) {
        double d[5];
        wave[k] = wave[k] / solution->k0 + damping * odd[k];
        row[k] = -row[k];
        for (size_t c = 0; c < 5 && solution->base; c++)
            d[c] = base[(5 * (k / n) + c) * n + k % n];
        if (solution->base)
            wave[k] -=
                solution->speed / solution->k0 * base_flow_known_change(&solution->base[k / n], d);
    }
    free(half);
    free(odd);
    return status;
}

static igabem_status change_corners(const igabem_tangent *tangent, const struct shape *shape,
                                    const struct edge_change *line, double *change)
{
    const struct transom *transom = shape->transom;
    size_t n = tangent->field->n, parts = shape->parts;
    struct edge_change rim = {.move = NULL};
    double *dy = malloc(n * sizeof *dy), *breadth = change + shape->breadth * n;
    igabem_status status =
        dy ? edge_change(tangent, &transom->rim_edge, &rim) : tangent_no_memory(n);
    memcpy(breadth, line->move, n * sizeof *breadth);
    for (size_t k = 0; k <= parts && status == IGABEM_OK; k++) {
        double share = (double)k / (double)parts, y = transom->breadth * share, at[3];
        double *x = change + (shape->corner + k) * n, *z = x + (parts + 1) * n;
        const struct rim_change to = {x, z, NULL};
        for (size_t f = 0; f < n; f++)
            dy[f] = share * breadth[f];
        edge_at(&transom->rim_edge, y, at);
        change_at(&rim, y, dy, &to);
        if (!(at[2] < 0.0)) /* the face ends at the still water */
            memset(z, 0, n * sizeof *z);
    }
    free(dy);
    free(rim.move);
    return status;
}

static igabem_status change_lines(const igabem_tangent *tangent, const struct shape *shape,
                                  const struct edge_change *line, double *change)
{
    const struct free_surface *surface = shape->surface;
    for (size_t k = 0; k <= 3 * surface->nx; k++)
        breadth_change(surface, line, surface->x0 - surface->dx * ((double)k / 3.0),
                       change + (shape->station + k) * tangent->field->n);
    return shape->transom ? change_corners(tangent, shape, line, change) : IGABEM_OK;
}

igabem_status shape_lines(const igabem_tangent *tangent, const struct shape *shape, double *change)
{
    struct edge_change line = {.move = NULL};
    igabem_status status = edge_change(tangent, &shape->surface->waterline, &line);
    if (status == IGABEM_OK)
        status = change_lines(tangent, shape, &line, change);
    free(line.move);
    return status;
}

igabem_status shape_rim_change(const igabem_tangent *tangent, const struct shape *shape,
                               const double *phi, double *change)
{
    const struct transom *transom = shape->transom;
    size_t n = tangent->field->n;
    struct edge_change rim = {.move = NULL};
    double *dy = malloc(4 * n * sizeof *dy);
    igabem_status status =
        dy ? edge_change(tangent, &transom->rim_edge, &rim) : tangent_no_memory(n);
    for (size_t j = 0; j < transom->n && status == IGABEM_OK; j++) {
        double share = ((double)j + 0.5) / (double)transom->n;
        for (size_t f = 0; f < n; f++)
            dy[f] = share * change[shape->breadth * n + f];
        status = change_phi(tangent, &rim, phi, transom->breadth * share, dy, dy + n,
                            change + (shape->rim + j) * n);
    }
    free(dy);
    free(rim.move);
    return status;
}

igabem_status shape_change(const igabem_tangent *tangent, const struct shape *shape,
                           const double *base, double **change, double **row)
{
    size_t n = tangent->field->n, cells = shape->surface->nx * shape->surface->ny;
    size_t rows = cells + (shape->transom ? shape->transom->cells * shape->transom->n : 0);
    struct edge_change line = {.move = NULL};
    *change = calloc(shape->size * n, sizeof **change);
    *row = calloc(rows * n, sizeof **row);
    igabem_status status = *change && *row ? IGABEM_OK : tangent_no_memory(n);
    if (status == IGABEM_OK)
        status = edge_change(tangent, &shape->surface->waterline, &line);
    if (status == IGABEM_OK)
        status = change_lines(tangent, shape, &line, *change);
    if (status == IGABEM_OK)
        status = change_surface(tangent, shape, &line, base, *change, *row);
    if (status == IGABEM_OK && shape->transom)
        status = change_transom(tangent, shape, *change, *row + cells * n);
    free(line.move);
    return status;
}

/* The surface with its inner edge moved by step times a field's moves of the edge's points; the
 * points are the caller's. */
static struct free_surface move_surface(const struct edge_change *line,
                                        const struct free_surface *own, size_t f, double step,
                                        struct edge_point *point)
{
    struct free_surface moved = *own;
    for (size_t k = 0; k < own->waterline.n; k++) {
        point[k] = own->waterline.point[k];
        point[k].at[1] += step * line->move[k * line->n + f];
    }
    moved.waterline.point = point;
    if (own->transom > 0)
        moved.transom = point[0].at[1];
    return moved;
}

/* Work for one field: of the cells' parts both ways, of phi and base, of the edge's points. */
struct cells_work {
    double (*part[2])[7], *phi;
    struct base_point *base;
    struct edge_point *point;
};

static void change_parts(const igabem_tangent *tangent, const struct edge_change *line, size_t f,
                         const double *phi, const double *base, const struct cells_work *work,
                         double *change)
{
    /* of a cell's length, for the largest move: rounding over it and its square are both small */
    static const double share = 2e-5;
    static const size_t column[SHAPE_CELL] = {1, 3, 4, 5};
    const igabem_solution *solution = tangent->solution;
    const struct free_surface *surface = solution->surface;
    size_t n = line->n, cells = surface->nx * surface->ny;
    size_t edge = surface->waterline.n ? surface->stern - surface->bow : 0;
    size_t unknowns = cells + edge, width = tangent->field->width;
    double largest = 0.0;
    const struct field *field = tangent->field;
    for (size_t k = 0; k < field->controls; k++)
        largest = fmax(largest, fabs(field->net[k * width + f]));
    double step = largest > 0 ? share * surface->dx / largest : 1.0;
    for (int side = 0; side < 2; side++) {
        double h = side ? step : -step;
        struct free_surface moved = move_surface(line, surface, f, h, work->point);
        for (size_t k = 0; k < unknowns; k++)
            work->phi[k] = solution->surface_phi[k] + h * phi[k * n + f];
        for (size_t c = 0; c < cells; c++) {
            const double *d = base + 5 * c * n + f;
            work->base[c] = solution->base[c];
            for (size_t k = 0; k < 2; k++)
                work->base[c].gradient[k] += h * d[k * n];
            for (size_t k = 0; k < 3; k++)
                work->base[c].second[k] += h * d[(2 + k) * n];
        }
        base_flow_radiate(&moved, work->base, work->phi, solution->speed, solution->k0,
                          work->part[side]);
    }
    for (size_t p = 0; p < BASE_FLOW_SIDE * BASE_FLOW_SIDE * cells; p++)
        for (size_t k = 0; k < SHAPE_CELL; k++)
            change[(SHAPE_CELL * p + k) * width + f] =
                (work->part[1][p][column[k]] - work->part[0][p][column[k]]) / (2.0 * step);
}

igabem_status shape_cells(const igabem_tangent *tangent, const double *phi, const double *base,
                          double **change)
{
    const struct free_surface *surface = tangent->solution->surface;
    size_t n = tangent->field->n, cells = surface->nx * surface->ny;
    size_t parts = BASE_FLOW_SIDE * BASE_FLOW_SIDE * cells;
    struct edge_change line = {.move = NULL};
    *change = calloc(SHAPE_CELL * parts * tangent->field->width, sizeof **change);
    igabem_status result =
        *change ? edge_change(tangent, &surface->waterline, &line) : tangent_no_memory(n);
    bool failed = result != IGABEM_OK;
#pragma omp parallel reduction(| : failed)
    {
        double(*part)[7] = malloc(2 * parts * sizeof *part);
        const struct cells_work work = {
            {part, part ? part + parts : NULL},
            malloc((cells + surface->nx) * sizeof(double)),
            malloc(cells * sizeof(struct base_point)),
            malloc((surface->waterline.n + 1) * sizeof(struct edge_point))};
        failed |= !part || !work.phi || !work.base || !work.point;
#pragma omp for schedule(dynamic, 1)
        for (size_t f = 0; f < n; f++)
            if (!failed)
                change_parts(tangent, &line, f, phi, base, &work, *change);
        free(part);
        free(work.phi);
        free(work.base);
        free(work.point);
    }
    free(line.move);
    return failed ? tangent_no_memory(n) : IGABEM_OK;
}
