#include "result/radiation.h"

#include "core/error.h"
#include "exterior/base_flow.h"
#include "exterior/transom.h"

#include <math.h>
#include <stdlib.h>

/* Each side's sources U n_x dS where nothing is solved, and those of a thin ship moved to y = 0
 * together with their mirror image, where it has no waterline. */
static void place_sources(const igabem_formulation_row *formulation, double speed,
                          struct sources *sources)
{
    for (size_t j = 0; j < sources->n && !formulation->solves; j++)
        sources->strength[j] = speed * sources->normal[0][j] * sources->area[j];
    for (size_t j = 0; j < sources->n && formulation->centre_plane; j++)
        sources->y[j] = 0.0;
    if (!formulation->line_term && !formulation->potential)
        sources->n_line = 0;
}

/* phi of the rim of a dry transom and its slope at y. */
static igabem_status rim_values(const igabem_solution *solution, double y, double *phi,
                                double *slope)
{
    const struct edge *rim = &solution->transom->rim_edge;
    size_t patch;
    double uv[2], at[3];
    igabem_status status = edge_locate(rim, solution->density, y, &patch, uv);
    edge_at(rim, y, at);
    *slope = solution->speed * solution->k0 * fmin(0.0, at[2]);
    return status ? status
                  : density_evaluate(solution->density, patch, 1, solution->sigma, 1, uv, phi);
}

/* Part p of the face and of its upper edge, where nu = -e_x. */
static igabem_status fill_face(const igabem_solution *solution, size_t p, const struct gauss *gauss,
                               struct nodes *nodes, double (*surface)[7], double (*line)[4])
{
    const struct transom *transom = solution->transom;
    const double whole[4] = {0.0, 1.0, 0.0, 1.0};
    const int points[2] = {FACE_ACROSS, FACE_UP};
    double width = transom->breadth / (double)transom->face->n;
    struct domain domain;
    domain_whole(&transom->face->element[p], &domain);
    nodes_clear(nodes);
    cell_nodes(&domain, whole, points, gauss, nodes);
    if (nodes->failed)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the face of the transom");
    for (size_t i = 0; i < FACE_ACROSS; i++) {
        double y = width * ((double)p + gauss->node[FACE_ACROSS][i]), phi, slope;
        double dl = width * gauss->weight[FACE_ACROSS][i] / solution->k0;
        igabem_status status = rim_values(solution, y, &phi, &slope);
        if (status)
            return status;
        line[i][0] = transom->x;
        line[i][1] = y;
        line[i][2] = dl * slope;
        line[i][3] = -dl * phi;
        for (size_t k = i; k < nodes->n; k += FACE_ACROSS) {
            const double *normal = nodes->normal + 3 * k;
            surface[k][0] = nodes->x[k];
            surface[k][1] = nodes->y[k];
            surface[k][2] = nodes->z[k];
            surface[k][3] = normal[0] * slope * nodes->g[k];
            for (size_t c = 0; c < 3; c++)
                surface[k][4 + c] = phi * normal[c] * nodes->g[k];
        }
    }
    return IGABEM_OK;
}

static igabem_status add_face(const igabem_solution *solution, struct sources *sources)
{
    size_t parts = solution->transom->face->n;
    struct gauss gauss;
    struct nodes nodes;
    nodes_init(&nodes, solution->transom->face);
    nodes.with_normals = true;
    double(*surface)[7] = malloc(parts * FACE_ACROSS * FACE_UP * sizeof *surface);
    double(*line)[4] = malloc(parts * FACE_ACROSS * sizeof *line);
    igabem_status status =
        surface && line ? gauss_fill(&gauss)
                        : igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the face of the transom");
    for (size_t p = 0; p < parts && status == IGABEM_OK; p++)
        status = fill_face(solution, p, &gauss, &nodes, surface + p * FACE_ACROSS * FACE_UP,
                           line + p * FACE_ACROSS);
    if (status == IGABEM_OK)
        status = sources_append(sources, parts * FACE_ACROSS * FACE_UP, (const double(*)[7])surface,
                                parts * FACE_ACROSS, (const double(*)[4])line);
    free(surface);
    free(line);
    nodes_free(&nodes);
    return status;
}

igabem_status radiation_sources(const igabem_solution *solution, enum radiation_cutoff cutoff,
                                double t_max, size_t cuts, const double *cut,
                                struct sources **sources)
{
    const double *const densities[] = {solution->sigma, solution->sigma_lower,
                                       solution->sigma_upper, solution->sigma_change};
    const struct source_rule rule = {solution->k0, t_max, cuts, cut};
    igabem_status status = sources_create(solution, &rule, densities[cutoff], sources);
    if (status)
        return status;
    place_sources(solution->formulation, solution->speed, *sources);
    if (solution->transom)
        status = add_face(solution, *sources);
    if (!status && solution->cell_source)
        status = sources_append(*sources,
                                solution->surface->nx * solution->surface->ny * BASE_FLOW_SIDE *
                                    BASE_FLOW_SIDE,
                                (const double(*)[7])solution->cell_source, 0, NULL);
    if (status) {
        sources_free(*sources);
        *sources = NULL;
    }
    return status;
}

/* In Green's identity the surface and its edges cancel at large angles, but for what the mesh does
 * not resolve: on transom hulls at Fr 0.28 t 8 to 20 would add a quarter, on a Wigley hull 0.05 %.
 */
static const double most_potential_angle = 8.0;
/* Of a double model the cells radiate too, and cannot beyond what they resolve: t 4 to 8 would add
 * 1 to 2 % on a Wigley hull and Series 60, on the DTMB 5415 12 % at 40 cells and 18 % at 56. */
static const double most_double_model_angle = 4.0;

/* Upper bound of z: the control points' (the hull lies in their hull). */
static double top(const igabem_solution *solution)
{
    double highest = -INFINITY;
    for (size_t p = 0; p < solution->density->patches; p++) {
        const nurbs_surface *surface = solution->density->patch[p].surface;
        size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
        const double *points = nurbs_surface_points(surface);
        for (size_t k = 0; k < n; k++)
            highest = fmax(highest, points[3 * k + 2]);
    }
    return highest;
}

double radiation_limit(const igabem_solution *solution)
{
    const double decay = 40.0; /* of |H|^2 */
    double limit = solution->options.spectrum_limit, depth = -top(solution);
    if (solution->potential)
        limit = fmin(limit, solution->base ? most_double_model_angle : most_potential_angle);
    if (solution->info.surface_piercing || !(depth > 0))
        return limit;
    return sqrt(decay / (2.0 * solution->k0 * depth));
}

void radiation_extent(const igabem_solution *solution, double *length, double *beam)
{
    double lower = INFINITY, upper = -INFINITY, side = 0.0;
    for (size_t p = 0; p < solution->density->patches; p++) {
        const nurbs_surface *surface = solution->density->patch[p].surface;
        size_t n = nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
        const double *points = nurbs_surface_points(surface);
        for (size_t k = 0; k < n; k++) {
            lower = fmin(lower, points[3 * k]);
            upper = fmax(upper, points[3 * k]);
            side = fmax(side, fabs(points[3 * k + 1]));
        }
    }
    *length = upper - lower;
    *beam = 2.0 * side;
}

double radiation_cutoff_angle(const igabem_solution *solution)
{
    double angle = solution->options.cutoff_angle;
    if (solution->potential)
        return 0.0;
    return isfinite(angle) && angle > 0 ? angle : 0.0;
}
