#include "tangent/row.h"

#include "exterior/base_flow.h"
#include "exterior/layers.h"
#include "exterior/operator.h"
#include "tangent/row_layer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum layer_part { PART_HULL, PART_SURFACE, PART_STRIP, PART_FACE, PARTS };

struct rows {
    const igabem_tangent *tangent;
    const struct shape *shape;
    size_t net, parts;
    struct influence *influence[PARTS]; /* but the hull's, owned */
    struct row_layer layer[PARTS];
};

struct row_work {
    struct row_layer_work layer[PARTS];
    double *single;
};

void rows_free(struct rows *rows)
{
    if (!rows)
        return;
    for (size_t p = 0; p < PARTS; p++) {
        row_layer_free(&rows->layer[p]);
        if (p != PART_HULL)
            influence_free(rows->influence[p]);
    }
    free(rows);
}

size_t rows_width(const struct rows *rows)
{
    return rows->net + rows->shape->size;
}

/* Coefficients of what the free surface carries, phi_xx/k0 with its damping. */
static igabem_status surface_strength(const igabem_tangent *tangent, double **strength)
{
    const igabem_solution *solution = tangent->solution;
    const struct free_surface *surface = solution->surface;
    size_t cells = surface->nx * surface->ny, ny = surface->ny;
    *strength = calloc(surface->coefficients + surface->nx + ny, sizeof **strength);
    double *value = malloc(3 * cells * sizeof *value);
    if (*strength && value) {
        double damping = solution->options.surface_damping / sqrt(solution->k0);
        double *second = value + cells, *odd = second + cells;
        operator_apply(surface, solution->base, solution->surface_phi, value, second, odd);
        for (size_t c = 0; c < cells; c++) {
            double known = solution->base ? base_flow_known(&solution->base[c]) : 0.0;
            (*strength)[(c / ny + 1) * surface->columns + c % ny + 1] =
                (second[c] - solution->speed * known) / solution->k0 + damping * odd[c];
        }
        operator_interpolate(surface, *strength, *strength + surface->coefficients);
    }
    bool complete = *strength && value;
    free(value);
    return complete ? IGABEM_OK : tangent_no_memory(tangent->field->n);
}

static igabem_status strip_strength(const igabem_tangent *tangent, double **strength)
{
    const igabem_solution *solution = tangent->solution;
    const struct transom *transom = solution->transom;
    const struct sparse *second = &transom->second;
    *strength = calloc(transom->coefficients + transom->cells, sizeof **strength);
    if (!*strength)
        return tangent_no_memory(tangent->field->n);
    for (size_t c = 0; c < transom->cells * transom->n; c++) {
        double *to = &(*strength)[(c / transom->n + 1) * transom->stride + c % transom->n];
        for (size_t k = second->start[c]; k < second->start[c + 1]; k++)
            *to += second->value[k] * solution->strip_phi[second->column[k]] / solution->k0;
    }
    transom_interpolate(transom, *strength, *strength + transom->coefficients);
    return IGABEM_OK;
}

/* phi of the rim, column by column. */
static igabem_status face_strength(const igabem_tangent *tangent, double **strength)
{
    const igabem_solution *solution = tangent->solution;
    const struct transom *transom = solution->transom;
    *strength = calloc(transom->coefficients, sizeof **strength);
    if (!*strength)
        return tangent_no_memory(tangent->field->n);
    memcpy(*strength, solution->strip_phi + transom->cells * transom->n,
           transom->n * sizeof **strength);
    return IGABEM_OK;
}

static igabem_status hull_strength(const igabem_tangent *tangent, double **strength)
{
    size_t n = tangent->solution->density->n;
    *strength = malloc(n * sizeof **strength);
    if (!*strength)
        return tangent_no_memory(tangent->field->n);
    memcpy(*strength, tangent->solution->sigma, n * sizeof **strength);
    return IGABEM_OK;
}

igabem_status rows_create(const igabem_tangent *tangent, const struct shape *shape,
                          const struct influence *hull, struct rows **result)
{
    const struct transom *transom = shape->transom;
    const struct mesh *mesh[PARTS] = {tangent->mesh, shape->surface->mesh,
                                      transom ? transom->strip : NULL,
                                      transom ? transom->face : NULL};
    const enum row_layer_kind kind[PARTS] = {ROW_HULL, ROW_SURFACE, ROW_STRIP, ROW_FACE};
    igabem_status (*const strength_of[PARTS])(const igabem_tangent *, double **) = {
        hull_strength, surface_strength, strip_strength, face_strength};
    struct rows *rows = calloc(1, sizeof *rows);
    *result = NULL;
    if (!rows)
        return tangent_no_memory(tangent->field->n);
    rows->tangent = tangent;
    rows->shape = shape;
    rows->net = tangent->field->controls;
    rows->parts = transom ? PARTS : PART_STRIP;
    igabem_status status = IGABEM_OK;
    for (size_t p = 0; p < rows->parts && status == IGABEM_OK; p++) {
        double *strength = NULL;
        if (p != PART_HULL)
            status = influence_create(hull->density, mesh[p], hull->tolerance, hull->threads,
                                      &rows->influence[p]);
        if (status == IGABEM_OK)
            status = strength_of[p](tangent, &strength);
        if (status == IGABEM_OK)
            status = row_layer_create(tangent, shape, kind[p],
                                      p == PART_HULL ? hull : rows->influence[p],
                                      tangent->solution->speed, strength, &rows->layer[p]);
        else
            free(strength);
    }
    if (status != IGABEM_OK) {
        rows_free(rows);
        return status;
    }
    *result = rows;
    return IGABEM_OK;
}

struct row_work *row_work_create(const struct rows *rows)
{
    const struct free_surface *surface = rows->shape->surface;
    const struct transom *transom = rows->shape->transom;
    size_t doubles = surface->coefficients + surface->nx + surface->ny;
    if (transom && doubles < transom->coefficients + transom->cells)
        doubles = transom->coefficients + transom->cells;
    struct row_work *work = calloc(1, sizeof *work);
    bool complete = work != NULL;
    if (work)
        complete = (work->single = malloc(doubles * sizeof *work->single)) != NULL;
    for (size_t p = 0; p < rows->parts && complete; p++)
        complete = row_layer_work_create(&rows->layer[p], &work->layer[p]);
    if (complete)
        return work;
    row_work_free(work);
    return NULL;
}

void row_work_free(struct row_work *work)
{
    if (!work)
        return;
    for (size_t p = 0; p < PARTS; p++)
        row_layer_work_free(&work->layer[p]);
    free(work->single);
    free(work);
}

/* The place of an unknown on each of the surfaces. */
struct places {
    struct layer_point hull, surface, strip;
    size_t cell; /* of the surface or the strip */
    enum layer_part on;
};

static void find_places(const struct rows *rows, size_t i, struct places *places)
{
    const igabem_solution *solution = rows->tangent->solution;
    const struct free_surface *surface = rows->shape->surface;
    size_t hull = solution->density->n, cells = surface->nx * surface->ny;
    memset(places, 0, sizeof *places);
    if (i < hull) {
        places->on = PART_HULL;
        layer_place(rows->layer[PART_HULL].surface.influence, i, &places->hull);
        memcpy(places->surface.at, places->hull.at, sizeof places->hull.at);
        memcpy(places->strip.at, places->hull.at, sizeof places->hull.at);
        return;
    }
    places->on = i < hull + cells ? PART_SURFACE : PART_STRIP;
    places->cell = i - hull - (i < hull + cells ? 0 : cells);
    const struct layer_point *point = i < hull + cells ? &surface->point[places->cell]
                                                       : &rows->shape->transom->point[places->cell];
    memcpy(places->hull.at, point->at, sizeof point->at);
    places->surface = places->strip = places->hull;
    if (places->on == PART_SURFACE)
        places->surface = *point;
    else
        places->strip = *point;
}

/* What the move of the unknown's own place counts for. */
static void add_turn(const struct rows *rows, const struct places *places, double turn, double *row)
{
    static const double middle[2] = {0.5, 0.5}, none[2] = {0.0, 0.0};
    const struct field *field = rows->tangent->field;
    if (places->on == PART_HULL) {
        size_t e = places->hull.home[0];
        fold_point(&field->mesh->element[e], places->hull.local[0], turn, none,
                   row + field->offset[e]);
        return;
    }
    row_layer_place(&rows->layer[places->on], places->cell, middle, turn, row + rows->net);
}

igabem_status rows_fill(const struct rows *rows, size_t i, struct row_work *work, double *row)
{
    const struct shape *shape = rows->shape;
    const struct free_surface *surface = shape->surface;
    const struct transom *transom = shape->transom;
    struct places places;
    double turn = 0.0, *number = row + rows->net, *single = work->single;
    memset(row, 0, rows_width(rows) * sizeof *row);
    find_places(rows, i, &places);
    bool complete = row_layer_add(&rows->layer[PART_HULL], &places.hull, &work->layer[PART_HULL],
                                  NULL, row, &turn);
    memset(single, 0, surface->coefficients * sizeof *single);
    complete = complete && row_layer_add(&rows->layer[PART_SURFACE], &places.surface,
                                         &work->layer[PART_SURFACE], single, number, &turn);
    operator_fold(surface, single, single + surface->coefficients);
    for (size_t c = 0; c < surface->nx * surface->ny; c++)
        number[shape->wave + c] =
            single[(c / surface->ny + 1) * surface->columns + c % surface->ny + 1];
    if (transom) {
        memset(single, 0, transom->coefficients * sizeof *single);
        complete = complete && row_layer_add(&rows->layer[PART_STRIP], &places.strip,
                                             &work->layer[PART_STRIP], single, number, &turn);
        transom_fold(transom, single, single + transom->coefficients);
        for (size_t c = 0; c < transom->cells * transom->n; c++)
            number[shape->strip + c] =
                single[(c / transom->n + 1) * transom->stride + c % transom->n];
        const struct layer_point off = {
            .at = {places.hull.at[0], places.hull.at[1], places.hull.at[2]}};
        complete = complete && row_layer_add(&rows->layer[PART_FACE], &off, &work->layer[PART_FACE],
                                             NULL, number, &turn);
    }
    add_turn(rows, &places, turn, row);
    return complete ? IGABEM_OK : tangent_no_memory(rows->tangent->field->n);
}
