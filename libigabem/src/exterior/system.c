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
    free(system->right);
    *system = (struct exterior_system){0};
}

/* A collocation point of the hull, its elements, and there half the basis: the solid angle. */
static void hull_point(const struct influence *hull, size_t i, struct layer_point *point,
                       double *row)
{
    const struct density *density = hull->density;
    const struct mesh *mesh = hull->mesh;
    size_t patch = density->owner[i];
    memset(point, 0, sizeof *point);
    memcpy(point->at, density->point + 3 * i, sizeof point->at);
    for (size_t e = mesh->patch_base[patch]; e < mesh->patch_base[patch + 1]; e++) {
        const struct element *element = &mesh->element[e];
        double *local = point->local[point->homes];
        if (point->homes == LAYER_HOMES || !element_contains(density, element, i, local))
            continue;
        point->home[point->homes++] = e;
        if (point->homes > 1)
            continue;
        double bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], value[ELEMENT_FUNCTIONS];
        size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
        struct jet jet;
        element_jet(element, local[0], local[1], &jet);
        bernstein(element->degree[0], local[0], bu, NULL);
        bernstein(element->degree[1], local[1], bv, NULL);
        for (size_t k = 0; k < m * n; k++)
            value[k] = 0.5 * bu[k / n] * bv[k % n] / jet.weight;
        element_scatter(element, 1, value, row, 0);
    }
}

struct rows_work {
    struct layer_work hull, surface;
    double *single; /* over the coefficients of phi_xx, and scratch */
};

/* Adds factor times a row of the operator, whose last columns stand for the hull's edge. */
static void add_sparse(const struct exterior_system *system, const struct sparse *sparse,
                       const struct sparse *edge, size_t c, double factor, double *row)
{
    size_t cells = system->n - system->hull;
    for (size_t k = sparse->start[c]; k < sparse->start[c + 1]; k++) {
        double value = factor * sparse->value[k];
        if (sparse->column[k] < cells) {
            row[system->hull + sparse->column[k]] += value;
            continue;
        }
        size_t at = sparse->column[k] - cells;
        for (size_t l = edge->start[at]; l < edge->start[at + 1]; l++)
            row[edge->column[l]] += value * edge->value[l];
    }
}

/* One row: layers of the hull and of the free surface, and the operator on the latter. */
static igabem_status fill_row(const struct layer_surface *hull, const struct layer_surface *flat,
                              const struct free_surface *surface,
                              const struct surface_operator *operator_, const struct sparse *edge,
                              size_t i, struct rows_work *work, struct exterior_system *system)
{
    size_t cells = surface->nx * surface->ny;
    double *fixed = system->fixed + i * system->n, *wave = system->wave + i * system->n;
    memset(fixed, 0, system->n * sizeof *fixed);
    memset(wave, 0, system->n * sizeof *wave);
    memset(work->single, 0, surface->coefficients * sizeof *work->single);
    struct layer_point on_hull = {.homes = 0}, on_surface = {.homes = 0};
    if (i < system->hull) {
        hull_point(hull->influence, i, &on_hull, fixed);
        memcpy(on_surface.at, on_hull.at, sizeof on_hull.at);
    } else {
        size_t c = i - system->hull;
        on_surface = surface->point[c];
        memcpy(on_hull.at, on_surface.at, sizeof on_hull.at);
        add_sparse(system, &operator_->value, edge, c, 1.0, fixed);
    }
    struct layer_rows dipole = {.dipole = fixed}, single = {.single = work->single};
    igabem_status status = layer_add(hull, &on_hull, &work->hull, &dipole);
    if (status == IGABEM_OK)
        status = layer_add(flat, &on_surface, &work->surface, &single);
    system->right[i] = dipole.flow;
    operator_fold(surface, work->single, work->single + surface->coefficients);
    const struct sparse *second = &operator_->second;
    for (size_t c = 0; c < cells; c++) {
        size_t at = (c / surface->ny + 1) * surface->columns + c % surface->ny + 1;
        double strength = work->single[at];
        add_sparse(system, second, edge, c, strength, wave);
    }
    return status;
}

static igabem_status fill(const struct influence *hull, const struct influence *flat,
                          const struct free_surface *surface,
                          const struct surface_operator *operator_, const struct sparse *edge,
                          struct exterior_system *system)
{
    const struct layer_surface layer[2] = {{.influence = hull, .symmetric = true},
                                           {.influence = flat, .symmetric = true, .flat = true}};
    size_t doubles = surface->coefficients + surface->nx + surface->ny;
    igabem_status result = IGABEM_OK;
#pragma omp parallel num_threads(hull->threads)
    {
        struct rows_work work = {.single = malloc(doubles * sizeof(double))};
        igabem_status status = work.single ? IGABEM_OK : no_memory(system->n);
        igabem_status second = layer_work_create(&layer[0], &work.hull);
        igabem_status third = layer_work_create(&layer[1], &work.surface);
        status = status ? status : second ? second : third;
#pragma omp for schedule(dynamic, 4)
        for (size_t i = 0; i < system->n; i++)
            if (status == IGABEM_OK)
                status = fill_row(&layer[0], &layer[1], surface, operator_, edge, i, &work, system);
        layer_work_free(&work.hull);
        layer_work_free(&work.surface);
        free(work.single);
#pragma omp critical(igabem_exterior)
        if (status != IGABEM_OK)
            result = status;
    }
    return result == IGABEM_OK ? result : no_memory(system->n);
}

igabem_status exterior_system_create(const struct influence *hull,
                                     const struct free_surface *surface, double damping,
                                     struct exterior_system *system)
{
    size_t n = hull->density->n + surface->nx * surface->ny;
    *system = (struct exterior_system){.n = n,
                                       .hull = hull->density->n,
                                       .fixed = malloc(n * n * sizeof(double)),
                                       .wave = malloc(n * n * sizeof(double)),
                                       .right = malloc(n * sizeof(double))};
    if (!system->fixed || !system->wave || !system->right)
        return no_memory(n);
    struct influence *flat = NULL;
    struct surface_operator operator_ = {0};
    struct sparse edge = {0};
    igabem_status status = operator_create(surface, damping, &operator_);
    if (status == IGABEM_OK)
        status = operator_edge(surface, hull->density, hull->mesh, &edge);
    if (status == IGABEM_OK)
        status =
            influence_create(hull->density, surface->mesh, hull->tolerance, hull->threads, &flat);
    if (status == IGABEM_OK)
        status = fill(hull, flat, surface, &operator_, &edge, system);
    influence_free(flat);
    operator_free(&operator_);
    sparse_free(&edge);
    return status;
}
