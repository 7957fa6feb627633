#include "result/sources.h"

#include "core/error.h"
#include "solve/solution.h"
#include "space/quadrature_wave.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PLAIN_POINTS = 6 };

static igabem_status no_memory(void)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for point sources");
}

void sources_free(struct sources *sources)
{
    if (!sources)
        return;
    free(sources->x);
    free(sources->line_x);
    free(sources);
}

/* Arrays that the surface and the waterline share: position, strength, measure (area or length) and
 * velocity, indexed like the nodes. */
struct columns {
    double *strength, *measure, *velocity[3];
    double *potential; /* NULL: not wanted */
};

static void evaluate(const igabem_solution *solution, const struct nodes *nodes,
                     const double *sigma, const struct columns *columns)
{
    size_t unknowns = solution->density->n;
    for (size_t b = 0; b < nodes->blocks; b++) {
        const struct block *block = &nodes->block[b];
        const struct element *element = block->element;
        double field[4][ELEMENT_FUNCTIONS];
        element_gather(element, sigma, field[0]);
        for (size_t c = 0; c < 3 && solution->velocity; c++)
            element_gather(element, solution->velocity + c * unknowns, field[c + 1]);
        for (size_t i = block->begin; i < block->end; i++) {
            double weight = nodes_weight(nodes, element, i);
            columns->strength[i] = nodes->g[i] * nodes_value(nodes, element, i, field[0], 1);
            columns->measure[i] = nodes->g[i] * weight;
            if (columns->potential)
                columns->potential[i] = nodes_value(nodes, element, i, field[0], 1) / weight;
            for (size_t c = 0; c < 3 && solution->velocity; c++)
                columns->velocity[c][i] = nodes_value(nodes, element, i, field[c + 1], 1) / weight;
        }
    }
}

struct order {
    double z;
    size_t index;
};

static int by_depth(const void *a, const void *b)
{
    const struct order *p = a, *q = b;
    if (p->z != q->z)
        return p->z < q->z ? 1 : -1;
    return (p->index > q->index) - (p->index < q->index);
}

static igabem_status fill_surface(const igabem_solution *solution, const struct nodes *nodes,
                                  const double *sigma, struct sources *sources)
{
    size_t n = nodes->n;
    struct order *order = malloc((n + 1) * sizeof *order);
    double *column = malloc((5 * n + 1) * sizeof *column);
    sources->x = malloc((14 * n + 1) * sizeof *sources->x);
    if (!order || !column || !sources->x) {
        free(order);
        free(column);
        return no_memory();
    }
    struct columns columns = {
        column, column + n, {column + 2 * n, column + 3 * n, column + 4 * n}, NULL};
    evaluate(solution, nodes, sigma, &columns);
    sources->n = n;
    sources->y = sources->x + n;
    sources->z = sources->y + n;
    sources->strength = sources->z + n;
    sources->area = sources->strength + n;
    for (size_t c = 0; c < 3; c++) {
        sources->normal[c] = sources->area + (c + 1) * n;
        sources->velocity[c] = solution->velocity ? sources->area + (c + 4) * n : NULL;
        sources->dipole[c] = solution->potential ? sources->area + (c + 7) * n : NULL;
    }
    for (size_t i = 0; i < n; i++)
        order[i] = (struct order){nodes->z[i], i};
    qsort(order, n, sizeof *order, by_depth);
    for (size_t i = 0; i < n; i++) {
        size_t k = order[i].index;
        sources->x[i] = nodes->x[k];
        sources->y[i] = nodes->y[k];
        sources->z[i] = nodes->z[k];
        sources->strength[i] = columns.strength[k];
        sources->area[i] = columns.measure[k];
        for (size_t c = 0; c < 3; c++) {
            sources->normal[c][i] = nodes->normal[3 * k + c];
            if (solution->velocity)
                sources->velocity[c][i] = columns.velocity[c][k];
            if (solution->potential)
                sources->dipole[c][i] = columns.strength[k] * nodes->normal[3 * k + c];
        }
        if (solution->potential)
            sources->strength[i] = solution->speed * sources->normal[0][i] * sources->area[i];
    }
    free(order);
    free(column);
    return IGABEM_OK;
}

static igabem_status fill_line(const igabem_solution *solution, const struct nodes *nodes,
                               double k0, const double *sigma, struct sources *sources)
{
    size_t n = nodes->n;
    double *measure = malloc((n + 1) * sizeof *measure);
    sources->line_x = malloc((9 * n + 1) * sizeof *sources->line_x);
    if (!measure || !sources->line_x) {
        free(measure);
        return no_memory();
    }
    sources->n_line = n;
    sources->line_y = sources->line_x + n;
    sources->line_strength = sources->line_x + 2 * n;
    sources->line_length = sources->line_x + 3 * n;
    sources->line_nu_x = sources->line_x + 4 * n;
    for (size_t c = 0; c < 3; c++)
        sources->line_velocity[c] = solution->velocity ? sources->line_x + (5 + c) * n : NULL;
    struct columns columns = {
        sources->line_strength,
        measure,
        {sources->line_velocity[0], sources->line_velocity[1], sources->line_velocity[2]},
        NULL};
    if (solution->potential)
        columns.potential = sources->line_dipole = sources->line_x + 8 * n;
    evaluate(solution, nodes, sigma, &columns);
    for (size_t i = 0; i < n; i++) {
        sources->line_x[i] = nodes->x[i];
        sources->line_y[i] = nodes->y[i];
        sources->line_strength[i] *= solution->options.line_term && k0 > 0 ? 1.0 / k0 : 0.0;
        sources->line_nu_x[i] = nodes->normal[3 * i];
        sources->line_length[i] = nodes->normal[3 * i + 1];
        if (!solution->potential)
            continue;
        double flux = k0 > 0 ? sources->line_nu_x[i] * sources->line_length[i] / k0 : 0.0;
        sources->line_dipole[i] *= flux;
        /* With the cells of a double model phi_x has left the waterline (theory.md, 14). */
        sources->line_strength[i] = solution->base ? 0.0 : -flux * sources->line_velocity[0][i];
    }
    free(measure);
    return IGABEM_OK;
}

/* The first of the planes that crosses the range of x, or NAN. A plane along the edge of an element
 * would cut off a piece of no width. */
static double crossing(const struct source_rule *rule, double lower, double upper)
{
    double edge = 1e-9 * (upper - lower);
    for (size_t i = 0; i < rule->cuts; i++)
        if (rule->cut[i] > lower + edge && rule->cut[i] < upper - edge)
            return rule->cut[i];
    return NAN;
}

static void surface_nodes(const struct mesh *mesh, const struct source_rule *wanted,
                          const struct wave_rule *rule, struct nodes *nodes)
{
    const double whole[4] = {0.0, 1.0, 0.0, 1.0};
    const int plain[2] = {PLAIN_POINTS, PLAIN_POINTS};
    for (size_t e = 0; e < mesh->n; e++) {
        const struct element *element = &mesh->element[e];
        struct domain pieces[DOMAIN_PIECES];
        double x = crossing(wanted, element->box[0][0], element->box[1][0]);
        size_t n = 1;
        if (isnan(x))
            domain_whole(element, pieces);
        else
            n = domain_cut(element, x, pieces);
        for (size_t k = 0; k < n; k++)
            if (rule->k0 > 0)
                wave_nodes(rule, &pieces[k], nodes);
            else
                cell_nodes(&pieces[k], whole, plain, rule->gauss, nodes);
    }
}

static void waterline_nodes(const struct line *line, const struct source_rule *wanted,
                            const struct wave_rule *rule, struct nodes *nodes)
{
    for (size_t i = 0; i < line->n; i++) {
        const struct line_segment *segment = &line->segment[i];
        double stops[ELEMENT_SIDE + 2], x = crossing(wanted, segment->box[0], segment->box[1]);
        size_t n = line_cut(segment, x, stops); /* NAN: no stop */
        for (size_t k = 0; k + 1 < n; k++)
            if (rule->k0 > 0)
                wave_line_nodes(rule, line, segment, stops + k, nodes);
            else
                line_nodes(line, segment, stops + k, PLAIN_POINTS, rule->gauss, nodes);
    }
}

igabem_status sources_create(const igabem_solution *solution, const struct source_rule *wanted,
                             const double *sigma, struct sources **result)
{
    *result = NULL;
    const struct density *density = solution->density;
    struct mesh *mesh = NULL;
    struct line *line = NULL;
    struct gauss gauss;
    struct nodes surface = {0}, waterline = {0};
    struct sources *sources = calloc(1, sizeof *sources);
    igabem_status status = sources ? gauss_fill(&gauss) : no_memory();
    if (status == IGABEM_OK)
        status = mesh_create(density, &mesh);
    if (status == IGABEM_OK)
        status = line_create(density, mesh, solution->options.stem_limit, &line);
    if (status != IGABEM_OK)
        goto done;
    double k0 = wanted->k0;
    struct wave_rule rule = {.k0 = k0,
                             .t_max = wanted->t_max,
                             .tolerance = solution->options.tolerance,
                             .gauss = &gauss};
    nodes_init(&surface, mesh);
    nodes_init(&waterline, mesh);
    surface.with_normals = waterline.with_normals = true;
    surface_nodes(mesh, wanted, &rule, &surface);
    waterline_nodes(line, wanted, &rule, &waterline);
    if (surface.failed || waterline.failed) {
        status = no_memory();
        goto done;
    }
    if (!sigma)
        sigma = solution->sigma;
    sources->symmetric = density->symmetric;
    status = fill_surface(solution, &surface, sigma, sources);
    if (status == IGABEM_OK)
        status = fill_line(solution, &waterline, k0, sigma, sources);
done:
    nodes_free(&surface);
    nodes_free(&waterline);
    line_free(line);
    mesh_free(mesh);
    if (status != IGABEM_OK) {
        sources_free(sources);
        return status;
    }
    *result = sources;
    return IGABEM_OK;
}

static int row_by_depth(const void *a, const void *b)
{
    double za = ((const double *)a)[2], zb = ((const double *)b)[2];
    return (za < zb) - (za > zb);
}

igabem_status sources_append(struct sources *sources, size_t m, const double (*surface)[7],
                             size_t l, const double (*line)[4])
{
    size_t n = sources->n + m, n_line = sources->n_line + l;
    double(*row)[7] = malloc((n + 1) * sizeof *row);
    double *x = malloc((7 * n + 1) * sizeof *x), *line_x = malloc((4 * n_line + 1) * sizeof *x);
    if (!row || !x || !line_x) {
        free(row);
        free(x);
        free(line_x);
        return no_memory();
    }
    const double *const old[7] = {sources->x,        sources->y,         sources->z,
                                  sources->strength, sources->dipole[0], sources->dipole[1],
                                  sources->dipole[2]};
    const double *const old_line[4] = {sources->line_x, sources->line_y, sources->line_strength,
                                       sources->line_dipole};
    for (size_t c = 0; c < 7; c++)
        for (size_t i = 0; i < n; i++)
            row[i][c] = i < sources->n ? old[c][i] : surface[i - sources->n][c];
    qsort(row, n, sizeof *row, row_by_depth);
    for (size_t c = 0; c < 7; c++)
        for (size_t i = 0; i < n; i++)
            x[c * n + i] = row[i][c];
    for (size_t c = 0; c < 4; c++)
        for (size_t i = 0; i < n_line; i++)
            line_x[c * n_line + i] =
                i < sources->n_line ? old_line[c][i] : line[i - sources->n_line][c];
    free(row);
    free(sources->x);
    free(sources->line_x);
    *sources = (struct sources){.symmetric = sources->symmetric,
                                .n = n,
                                .x = x,
                                .y = x + n,
                                .z = x + 2 * n,
                                .strength = x + 3 * n,
                                .dipole = {x + 4 * n, x + 5 * n, x + 6 * n},
                                .n_line = n_line,
                                .line_x = line_x,
                                .line_y = line_x + n_line,
                                .line_strength = line_x + 2 * n_line,
                                .line_dipole = line_x + 3 * n_line};
    return IGABEM_OK;
}
