#include "exterior/system.h"

#include "core/error.h"

#include <stdlib.h>
#include <string.h>

static igabem_status no_memory(size_t n)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for a system of %zu unknowns", n);
}

void exterior_system_free(struct exterior_system *system)
{
    free(system->fixed);
    free(system->wave);
    free(system->odd);
    free(system->right);
    free(system->slope);
    free(system->known);
    free(system->base);
    free(system->base_on_hull);
    *system = (struct exterior_system){0};
}

/* What the rows are made of. */
enum layer_part { PART_HULL, PART_SURFACE, PART_STRIP, PART_FACE, PARTS };

struct assembly {
    const struct free_surface *surface;
    const struct transom *transom; /* NULL: without strip and face */
    struct layer_surface layer[PARTS];
    struct influence *influence[PARTS]; /* but the hull's, owned */
    struct surface_operator operator_;
    struct sparse edge;
    size_t parts;
    size_t doubles; /* of the scratch of a row */
};

struct row_work {
    struct layer_work layer[PARTS];
    double *single, *dipole;
};

/* Adds factor times a row of the operator, whose last columns stand for the hull's edge. */
static void add_surface(const struct exterior_system *system, const struct assembly *assembly,
                        const struct sparse *sparse, size_t c, double factor, double *row)
{
    const struct sparse *edge = &assembly->edge;
    for (size_t k = sparse->start[c]; k < sparse->start[c + 1]; k++) {
        double value = factor * sparse->value[k];
        if (sparse->column[k] < system->cells) {
            row[system->hull + sparse->column[k]] += value;
            continue;
        }
        size_t at = sparse->column[k] - system->cells;
        for (size_t l = edge->start[at]; l < edge->start[at + 1]; l++)
            row[edge->column[l]] += value * edge->value[l];
    }
}

static void add_rim(const struct transom *transom, size_t column, double factor, double *row)
{
    const struct sparse *rim = &transom->rim;
    for (size_t l = rim->start[column]; l < rim->start[column + 1]; l++)
        row[rim->column[l]] += factor * rim->value[l];
}

/* The same of the strip, whose last columns stand for the rim's phi and its slope U k0 z. Adds what
 * of the slope the row holds, over U k0, to *known. */
static void add_strip(const struct exterior_system *system, const struct transom *transom,
                      const struct sparse *sparse, size_t c, double factor, double *row,
                      double *known)
{
    size_t unknowns = transom->cells * transom->n;
    for (size_t k = sparse->start[c]; k < sparse->start[c + 1]; k++) {
        double value = factor * sparse->value[k];
        size_t column = sparse->column[k];
        if (column < unknowns)
            row[system->hull + system->cells + column] += value;
        else if (column < unknowns + transom->n)
            add_rim(transom, column - unknowns, value, row);
        else
            *known += value * transom->depth[column - unknowns - transom->n];
    }
}

/* Strengths of the free surface: the layer's factors through the operator. */
static igabem_status add_waves(const struct assembly *assembly, const struct layer_point *point,
                               struct row_work *work, const struct exterior_system *system,
                               size_t i)
{
    double *wave = system->wave + i * system->n, *odd = system->odd + i * system->n;
    const struct free_surface *surface = assembly->surface;
    struct layer_rows rows = {.single = work->single};
    memset(work->single, 0, surface->coefficients * sizeof *work->single);
    igabem_status status =
        layer_add(&assembly->layer[PART_SURFACE], point, &work->layer[PART_SURFACE], &rows);
    operator_fold(surface, work->single, work->single + surface->coefficients);
    for (size_t c = 0; c < system->cells; c++) {
        size_t at = (c / surface->ny + 1) * surface->columns + c % surface->ny + 1;
        add_surface(system, assembly, &assembly->operator_.second, c, work->single[at], wave);
        add_surface(system, assembly, &assembly->operator_.odd, c, work->single[at], odd);
        if (system->base)
            system->known[i] += work->single[at] * base_flow_known(&system->base[c]);
    }
    return status;
}

/* Strip and face. */
static igabem_status add_transom(const struct assembly *assembly, const struct layer_point *point,
                                 const double at[3], struct row_work *work,
                                 const struct exterior_system *system, size_t i)
{
    const struct transom *transom = assembly->transom;
    double *fixed = system->fixed + i * system->n, *wave = system->wave + i * system->n;
    double known = 0.0;
    struct layer_point off = {.at = {at[0], at[1], at[2]}};
    struct layer_rows rows = {.single = work->single};
    memset(work->single, 0, transom->coefficients * sizeof *work->single);
    igabem_status status = layer_add(&assembly->layer[PART_STRIP], point ? point : &off,
                                     &work->layer[PART_STRIP], &rows);
    transom_fold(transom, work->single, work->single + transom->coefficients);
    for (size_t c = 0; c < transom->cells * transom->n; c++) {
        double strength = work->single[(c / transom->n + 1) * transom->stride + c % transom->n];
        add_strip(system, transom, &transom->second, c, strength, wave, &known);
    }
    /* - (1/k0) known U k0 on the left. */
    system->right[i] += known;
    if (status != IGABEM_OK)
        return status;
    struct layer_rows face = {.single = work->single, .dipole = work->dipole};
    memset(work->single, 0, transom->coefficients * sizeof *work->single);
    memset(work->dipole, 0, transom->coefficients * sizeof *work->dipole);
    status = layer_add(&assembly->layer[PART_FACE], &off, &work->layer[PART_FACE], &face);
    for (size_t j = 0; j < transom->n; j++) {
        add_rim(transom, j, work->dipole[j], fixed);
        system->slope[i] += work->single[j] * transom->turn[j] * transom->depth[j];
    }
    return status;
}

static igabem_status fill_row(const struct assembly *assembly, size_t i, struct row_work *work,
                              struct exterior_system *system)
{
    double *fixed = system->fixed + i * system->n;
    memset(fixed, 0, system->n * sizeof *fixed);
    memset(system->wave + i * system->n, 0, system->n * sizeof *fixed);
    memset(system->odd + i * system->n, 0, system->n * sizeof *fixed);
    system->right[i] = system->slope[i] = system->known[i] = 0.0;
    struct layer_point on_hull = {.homes = 0}, on_surface = {.homes = 0};
    const struct layer_point *on_strip = NULL;
    size_t c = i - system->hull;
    if (i < system->hull) {
        layer_collocation(assembly->layer[PART_HULL].influence, i, &on_hull, fixed);
        memcpy(on_surface.at, on_hull.at, sizeof on_hull.at);
    } else if (c < system->cells) {
        on_surface = assembly->surface->point[c];
        memcpy(on_hull.at, on_surface.at, sizeof on_hull.at);
        add_surface(system, assembly, &assembly->operator_.value, c, 1.0, fixed);
    } else {
        double known = 0.0;
        c -= system->cells;
        on_strip = &assembly->transom->point[c];
        memcpy(on_hull.at, on_strip->at, sizeof on_hull.at);
        memcpy(on_surface.at, on_strip->at, sizeof on_hull.at);
        add_strip(system, assembly->transom, &assembly->transom->value, c, 1.0, fixed, &known);
        system->slope[i] -= known;
    }
    struct layer_rows dipole = {.dipole = fixed};
    igabem_status status =
        layer_add(&assembly->layer[PART_HULL], &on_hull, &work->layer[PART_HULL], &dipole);
    system->right[i] += dipole.flow;
    if (status == IGABEM_OK)
        status = add_waves(assembly, &on_surface, work, system, i);
    if (status == IGABEM_OK && assembly->transom)
        status = add_transom(assembly, on_strip, on_hull.at, work, system, i);
    return status;
}

static igabem_status work_create(const struct assembly *assembly, struct row_work *work)
{
    memset(work, 0, sizeof *work);
    work->single = malloc(2 * assembly->doubles * sizeof *work->single);
    work->dipole = work->single ? work->single + assembly->doubles : NULL;
    igabem_status status = work->single ? IGABEM_OK : no_memory(assembly->doubles);
    for (size_t p = 0; p < assembly->parts && status == IGABEM_OK; p++)
        status = layer_work_create(&assembly->layer[p], &work->layer[p]);
    return status;
}

static igabem_status fill(const struct assembly *assembly, const struct influence *hull,
                          struct exterior_system *system)
{
    igabem_status result = IGABEM_OK;
    if (hull->progress)
        progress_stage(hull->progress, hull->progress->to, system->n);
#pragma omp parallel num_threads(hull->threads)
    {
        struct row_work work;
        igabem_status status = work_create(assembly, &work);
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < system->n; i++)
            if (status == IGABEM_OK) {
                status = fill_row(assembly, i, &work, system);
                if (progress_step(hull->progress))
                    status = IGABEM_ERROR_CANCELLED;
            }
        for (size_t p = 0; p < assembly->parts; p++)
            layer_work_free(&work.layer[p]);
        free(work.single);
#pragma omp critical(igabem_exterior)
        if (status != IGABEM_OK)
            result = status;
    }
    if (result == IGABEM_ERROR_CANCELLED)
        return progress_status(hull->progress);
    return result == IGABEM_OK ? result : no_memory(system->n);
}

static void assembly_free(struct assembly *assembly)
{
    for (size_t p = PART_SURFACE; p < PARTS; p++)
        influence_free(assembly->influence[p]);
    operator_free(&assembly->operator_);
    sparse_free(&assembly->edge);
}

static igabem_status assembly_create(const struct influence *hull,
                                     const struct free_surface *surface,
                                     const struct transom *transom, struct assembly *assembly)
{
    const struct mesh *mesh[PARTS] = {hull->mesh, surface->mesh, transom ? transom->strip : NULL,
                                      transom ? transom->face : NULL};
    *assembly = (struct assembly){.surface = surface, .transom = transom};
    assembly->parts = transom ? PARTS : PART_STRIP;
    assembly->doubles = surface->coefficients + surface->nx + surface->ny;
    if (transom && assembly->doubles < transom->coefficients + transom->cells)
        assembly->doubles = transom->coefficients + transom->cells;
    igabem_status status = operator_edge(surface, hull->density, hull->mesh, &assembly->edge);
    for (size_t p = 0; p < assembly->parts && status == IGABEM_OK; p++) {
        if (p != PART_HULL)
            status = influence_create(hull->density, mesh[p], hull->tolerance, hull->threads,
                                      &assembly->influence[p]);
        assembly->layer[p] =
            (struct layer_surface){.influence = p == PART_HULL ? hull : assembly->influence[p],
                                   .symmetric = true,
                                   .flat = p == PART_SURFACE || p == PART_STRIP};
    }
    if (status != IGABEM_OK)
        assembly_free(assembly);
    return status;
}

igabem_status exterior_system_create(const struct influence *hull,
                                     const struct free_surface *surface,
                                     const struct transom *transom, bool double_model,
                                     struct exterior_system *system)
{
    size_t cells = surface->nx * surface->ny;
    size_t n = hull->density->n + cells + (transom ? transom->cells * transom->n : 0);
    *system = (struct exterior_system){.n = n,
                                       .hull = hull->density->n,
                                       .cells = cells,
                                       .fixed = malloc(n * n * sizeof(double)),
                                       .wave = malloc(n * n * sizeof(double)),
                                       .odd = malloc(n * n * sizeof(double)),
                                       .right = malloc(n * sizeof(double)),
                                       .slope = malloc(n * sizeof(double)),
                                       .known = malloc(n * sizeof(double))};
    if (!system->fixed || !system->wave || !system->odd || !system->right || !system->slope ||
        !system->known)
        return no_memory(n);
    struct assembly assembly;
    igabem_status status = assembly_create(hull, surface, transom, &assembly);
    if (status != IGABEM_OK)
        return status;
    if (double_model) {
        system->base_on_hull = malloc(system->hull * sizeof(double));
        status = system->base_on_hull
                     ? base_flow_create(hull, surface, transom, assembly.influence[PART_FACE],
                                        system->base_on_hull, &system->base)
                     : no_memory(n);
    }
    if (status == IGABEM_OK)
        status = operator_create(surface, system->base, &assembly.operator_);
    if (status == IGABEM_OK)
        status = fill(&assembly, hull, system);
    assembly_free(&assembly);
    return status;
}
