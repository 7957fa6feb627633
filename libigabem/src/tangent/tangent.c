#include "tangent/tangent.h"

#include "core/error.h"
#include "influence/influence.h"
#include "solve/formulation.h"
#include "tangent/potential.h"
#include "threads.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

igabem_status tangent_no_memory(size_t fields)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for derivatives along %zu fields", fields);
}

igabem_status tangent_check(const igabem_solution *solution)
{
    const igabem_formulation_row *formulation = solution->formulation;
    if (!solution->waves)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "this solution has no free surface, expected the Kelvin kernel");
    if (!formulation->tangents)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "formulation %s has no tangents yet",
                           formulation->name);
    if (!solution->density->symmetric)
        return igabem_fail(IGABEM_ERROR_ARGUMENT,
                           "tangents of a hull given whole, expected a half");
    return IGABEM_OK;
}

/* Nodes for the area of an element and its changes: more where two rules differ. */
static void area_nodes(const struct element *element, const struct gauss *gauss,
                       struct nodes *nodes, int *points)
{
    static const int few = 6, more = 8, most = GAUSS_MAX;
    static const double whole[4] = {0.0, 1.0, 0.0, 1.0}, agreed = 1e-10;
    struct domain domain;
    double area[2] = {0.0, 0.0};
    domain_whole(element, &domain);
    for (int k = 0; k < 2; k++) {
        *points = k ? more : few;
        nodes_clear(nodes);
        cell_nodes(&domain, whole, (const int[]){*points, *points}, gauss, nodes);
        for (size_t i = 0; i < nodes->n; i++)
            area[k] += nodes->g[i];
    }
    if (fabs(area[1] - area[0]) <= agreed * area[1])
        return;
    *points = most;
    nodes_clear(nodes);
    cell_nodes(&domain, whole, (const int[]){most, most}, gauss, nodes);
}

/* What the control values of a field on an element count for in the change of its area. */
static void area_factors(const struct element *element, const struct gauss *gauss, int points,
                         const struct nodes *nodes, double *factor)
{
    size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
    size_t side = (size_t)points; /* the nodes run along the first parameter fastest */
    memset(factor, 0, m * n * sizeof *factor);
    for (size_t i = 0; i < nodes->n; i++) {
        double weight = gauss->weight[points][i % side] * gauss->weight[points][i / side];
        double bu[ELEMENT_SIDE], du[ELEMENT_SIDE], bv[ELEMENT_SIDE], dv[ELEMENT_SIDE];
        double local[2], w[3] = {0.0, 0.0, 0.0};
        struct area_change area;
        nodes_local(nodes, element, i, local);
        bernstein(element->degree[0], local[0], bu, du);
        bernstein(element->degree[1], local[1], bv, dv);
        for (size_t k = 0; k < m * n; k++) {
            double net = element->net[4 * k + 3];
            w[0] += bu[k / n] * bv[k % n] * net;
            w[1] += du[k / n] * bv[k % n] * net;
            w[2] += bu[k / n] * dv[k % n] * net;
        }
        area_change(nodes->jet + 6 * i, nodes->jet + 6 * i + 3, element->sign, &area);
        double along = weight * area.length[0] / w[0], across = weight * area.length[1] / w[0];
        double still = -(along * w[1] + across * w[2]) / w[0];
        for (size_t k = 0; k < m * n; k++)
            factor[k] += (still * bu[k / n] + along * du[k / n]) * bv[k % n] +
                         across * bu[k / n] * dv[k % n];
    }
}

/* The wetted area leaves out what closes a transom. */
igabem_status tangent_area(igabem_tangent *tangent)
{
    size_t n = tangent->field->n;
    struct gauss gauss;
    struct nodes nodes;
    nodes_init(&nodes, tangent->mesh);
    nodes.with_jets = true;
    igabem_status status = gauss_fill(&gauss);
    for (size_t e = 0; e < tangent->mesh->n && status == IGABEM_OK; e++) {
        const struct element *element = &tangent->mesh->element[e];
        if (tangent->solution->density->patch[element->patch].hull.transom)
            continue;
        int points;
        double factor[ELEMENT_FUNCTIONS];
        area_nodes(element, &gauss, &nodes, &points);
        if (nodes.failed) {
            status = tangent_no_memory(n);
            continue;
        }
        area_factors(element, &gauss, points, &nodes, factor);
        field_contract(tangent->field, element, 1, factor, tangent->area);
    }
    for (size_t f = 0; f < n; f++)
        tangent->area[f] *= 2.0;
    nodes_free(&nodes);
    return status;
}

static void point_tangents(igabem_tangent *tangent, double *v)
{
    const struct density *density = tangent->solution->density;
    size_t n = tangent->field->n;
    for (size_t i = 0; i < density->n; i++) {
        size_t patch = density->owner[i], e = tangent->mesh->patch_base[patch];
        double local[2];
        while (!element_contains(density, &tangent->mesh->element[e], i, local))
            e++;
        const struct element *element = &tangent->mesh->element[e];
        struct jet jet;
        struct area_change area;
        element_jet(element, local[0], local[1], &jet);
        area_change(jet.ds, jet.dt, element->sign, &area);
        field_at(tangent->field, element, local, v);
        for (size_t f = 0; f < n; f++) {
            double *to = tangent->normal + 3 * (f * density->n + i);
            tangent->point[i * n + f] = v[f];
            double vs = v[n + f], vt = v[2 * n + f];
            double size = area.length[0] * vs + area.length[1] * vt;
            for (size_t c = 0; c < 3; c++)
                to[c] = (area.vector[0][c] * vs + area.vector[1][c] * vt -
                         area.area[c] * size / area.size) /
                        area.size;
        }
    }
}

/* U n_x on the hull, for which nothing is solved; on the waterline it is interpolated. */
static igabem_status explicit_tangents(igabem_tangent *tangent)
{
    const igabem_solution *solution = tangent->solution;
    size_t unknowns = solution->density->n, n = tangent->field->n;
    for (size_t k = 0; k < n * unknowns; k++)
        tangent->sigma[k] = solution->speed * tangent->normal[3 * k];
    return density_interpolate(solution->density, n, tangent->sigma);
}

static igabem_status fill(const igabem_hull *hull, size_t n, const double *move,
                          igabem_tangent *tangent)
{
    const igabem_solution *solution = tangent->solution;
    size_t unknowns = solution->density->n;
    igabem_status status = mesh_create(solution->density, &tangent->mesh);
    if (status == IGABEM_OK)
        status = field_create(hull, solution->density, tangent->mesh, n, move, &tangent->field);
    if (status != IGABEM_OK)
        return status;
    double *v = malloc(3 * n * sizeof *v);
    tangent->area = calloc(n, sizeof *tangent->area);
    tangent->point = malloc(n * unknowns * sizeof *tangent->point);
    tangent->normal = malloc(3 * n * unknowns * sizeof *tangent->normal);
    tangent->sigma = malloc(n * unknowns * sizeof *tangent->sigma);
    bool complete = v && tangent->area && tangent->point && tangent->normal && tangent->sigma;
    status = complete ? tangent_area(tangent) : tangent_no_memory(n);
    if (status == IGABEM_OK) {
        point_tangents(tangent, v);
        if (solution->potential)
            status = potential_tangent(tangent);
        else
            status = formulation_solves(&solution->options) ? tangent_solve(tangent)
                                                            : explicit_tangents(tangent);
    }
    free(v);
    return status;
}

igabem_status igabem_tangent_create(const igabem_hull *hull, const igabem_solution *solution,
                                    size_t n, const double *move, igabem_tangent **result)
{
    if (result)
        *result = NULL;
    if (!hull || !solution || !move || !result)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "NULL argument of igabem_tangent_create");
    if (n == 0)
        return igabem_fail(IGABEM_ERROR_ARGUMENT, "no fields, expected at least one");
    igabem_status status = tangent_check(solution);
    if (status != IGABEM_OK)
        return status;
    THREADS(solution->options.threads);
    igabem_tangent *tangent = calloc(1, sizeof *tangent);
    if (!tangent)
        return tangent_no_memory(n);
    tangent->solution = solution;
    status = fill(hull, n, move, tangent);
    if (status != IGABEM_OK) {
        igabem_tangent_free(tangent);
        return status;
    }
    *result = tangent;
    return IGABEM_OK;
}

void igabem_tangent_free(igabem_tangent *tangent)
{
    if (!tangent)
        return;
    field_free(tangent->field);
    mesh_free(tangent->mesh);
    free(tangent->area);
    free(tangent->point);
    free(tangent->normal);
    free(tangent->sigma);
    free(tangent->velocity);
    free(tangent->shape);
    free(tangent->change);
    free(tangent->cells);
    free(tangent);
}
