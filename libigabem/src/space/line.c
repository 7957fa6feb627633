#include "space/line.h"

#include "core/error.h"
#include "space/quadrature_regular.h"

#include <math.h>
#include <stdlib.h>

enum { LINE_POINTS = 8, LINE_LEAST = 3, LINE_DEPTH = 40, LINE_TEST = 6 };

static void bound_segment(struct line_segment *segment)
{
    const struct element *element = segment->element;
    size_t columns = (size_t)element->degree[1] + 1;
    size_t at = segment->end ? (size_t)element->degree[segment->fixed] : 0;
    segment->box[0] = INFINITY;
    segment->box[1] = -INFINITY;
    for (size_t k = 0; k <= (size_t)element->degree[1 - segment->fixed]; k++) {
        const double *h =
            element->net + 4 * (segment->fixed == 0 ? at * columns + k : k * columns + at);
        segment->box[0] = fmin(segment->box[0], h[0] / h[3]);
        segment->box[1] = fmax(segment->box[1], h[0] / h[3]);
    }
}

void line_free(struct line *line)
{
    if (line)
        free(line->segment);
    free(line);
}

static void local_of(const struct line_segment *segment, double a, double local[2])
{
    local[segment->fixed] = segment->end;
    local[1 - segment->fixed] = a;
}

void line_evaluate(const struct line *line, const struct line_segment *segment, double a,
                   struct line_point *point)
{
    struct jet jet;
    double local[2], area[3];
    local_of(segment, a, local);
    element_jet(segment->element, local[0], local[1], &jet);
    double size = jet_area(&jet, segment->element->sign, area);
    const double *tangent = segment->fixed == 0 ? jet.dt : jet.ds;
    double length = hypot(tangent[0], tangent[1]), nx = size > 0 ? area[0] / size : 0.0;
    /* nu is the tangent turned by a right angle to the side of n */
    double outward = tangent[1] * area[0] - tangent[0] * area[1] < 0 ? -1.0 : 1.0;
    *point = (struct line_point){.x = jet.s[0], .y = jet.s[1], .dl = length, .weight = jet.weight};
    if (!(length > 0))
        return;
    point->nu_x = outward * tangent[1] / length;
    double ratio = fabs(point->nu_x) / line->limit;
    point->strength = -nx * point->nu_x / (1.0 + ratio * ratio * ratio * ratio);
}

void line_nodes(const struct line *line, const struct line_segment *segment, const double range[2],
                int n, const struct gauss *gauss, struct nodes *nodes)
{
    const struct element *element = segment->element;
    size_t at = nodes_append(nodes, element, (size_t)n);
    if (nodes->failed)
        return;
    double width = range[1] - range[0];
    for (int i = 0; i < n; i++, at++) {
        double a = range[0] + width * gauss->node[n][i], local[2];
        struct line_point point;
        line_evaluate(line, segment, a, &point);
        local_of(segment, a, local);
        nodes->x[at] = point.x;
        nodes->y[at] = point.y;
        nodes->z[at] = 0.0;
        nodes->g[at] = point.strength * point.dl * width * gauss->weight[n][i] / point.weight;
        if (nodes->with_normals) {
            nodes->normal[3 * at] = point.nu_x;
            nodes->normal[3 * at + 1] = point.dl * width * gauss->weight[n][i];
            nodes->normal[3 * at + 2] = 0.0;
        }
        bernstein(element->degree[0], local[0], nodes->bu + at * nodes->side[0], NULL);
        bernstein(element->degree[1], local[1], nodes->bv + at * nodes->side[1], NULL);
    }
}

size_t line_cut(const struct line_segment *segment, double x, double stops[ELEMENT_SIDE + 2])
{
    size_t n = 1;
    double roots[ELEMENT_SIDE];
    stops[0] = segment->range[0];
    if (segment->box[0] < x && segment->box[1] > x) {
        size_t count = edge_roots(segment->element, segment->fixed, segment->end, x, roots);
        for (size_t k = 0; k < count; k++)
            if (roots[k] > segment->range[0] && roots[k] < segment->range[1])
                stops[n++] = roots[k];
    }
    stops[n++] = segment->range[1];
    return n;
}

static void divide(const struct line *line, const struct line_segment *segment,
                   const double range[2], const struct near_rule *rule, int depth,
                   struct nodes *nodes)
{
    struct line_point end[2], middle;
    double centre = 0.5 * (range[0] + range[1]), half = 0.0;
    line_evaluate(line, segment, centre, &middle);
    for (int k = 0; k < 2; k++) {
        line_evaluate(line, segment, range[k], &end[k]);
        half = fmax(half, hypot(end[k].x - middle.x, end[k].y - middle.y));
    }
    double dx = middle.x - rule->point[0], dy = middle.y - rule->point[1],
           distance = sqrt(dx * dx + dy * dy + rule->point[2] * rule->point[2]);
    const struct factor factor = {segment->element->degree[1 - segment->fixed],
                                  range[1] - range[0]};
    int n = regular_points(distance, half, &factor,
                           near_scale(rule, 2.0 * half / rule->k0, distance), rule->tolerance);
    if (depth == LINE_DEPTH || n <= LINE_POINTS) {
        n = n < LINE_LEAST ? LINE_LEAST : n > LINE_POINTS ? LINE_POINTS : n;
        line_nodes(line, segment, range, n, rule->gauss, nodes);
        return;
    }
    const double first[2] = {range[0], centre}, second[2] = {centre, range[1]};
    divide(line, segment, first, rule, depth + 1, nodes);
    divide(line, segment, second, rule, depth + 1, nodes);
}

void line_near(const struct line *line, const struct line_segment *segment, const double range[2],
               const struct near_rule *rule, struct nodes *nodes)
{
    divide(line, segment, range, rule, 0, nodes);
}

static bool append(struct line *line, const struct line_segment *segment)
{
    if (line->n == line->capacity) {
        size_t capacity = 2 * line->capacity + 64;
        struct line_segment *more = realloc(line->segment, capacity * sizeof *more);
        if (!more)
            return false;
        line->segment = more;
        line->capacity = capacity;
    }
    line->segment[line->n++] = *segment;
    return true;
}

/* Integral of the strength and its first moment over a range. */
static void strength_moments(const struct line *line, const struct line_segment *segment,
                             double from, double to, const struct gauss *gauss, double moment[2])
{
    moment[0] = moment[1] = 0.0;
    for (int i = 0; i < LINE_TEST; i++) {
        double a = from + (to - from) * gauss->node[LINE_TEST][i];
        struct line_point point;
        line_evaluate(line, segment, a, &point);
        double part = gauss->weight[LINE_TEST][i] * (to - from) * point.strength * point.dl;
        moment[0] += part;
        moment[1] += part * a;
    }
}

static double segment_length(const struct line *line, const struct line_segment *segment,
                             const struct gauss *gauss)
{
    double length = 0.0;
    for (int i = 0; i < LINE_TEST; i++) {
        struct line_point point;
        line_evaluate(line, segment, gauss->node[LINE_TEST][i], &point);
        length += gauss->weight[LINE_TEST][i] * point.dl;
    }
    return length;
}

/* Appends the segment in halves until the halves agree with the whole to 1e-7 m of unit strength
 * per metre of waterline. */
static bool append_smooth(struct line *line, const struct line_segment *segment, double tolerance,
                          int depth, const struct gauss *gauss)
{
    double from = segment->range[0], to = segment->range[1], middle = 0.5 * (from + to);
    double whole[2], first[2], second[2];
    strength_moments(line, segment, from, to, gauss, whole);
    strength_moments(line, segment, from, middle, gauss, first);
    strength_moments(line, segment, middle, to, gauss, second);
    double error =
        fmax(fabs(first[0] + second[0] - whole[0]), fabs(first[1] + second[1] - whole[1]));
    if (depth == LINE_DEPTH || error <= tolerance)
        return append(line, segment);
    struct line_segment half[2] = {*segment, *segment};
    half[0].range[1] = half[1].range[0] = middle;
    return append_smooth(line, &half[0], 0.5 * tolerance, depth + 1, gauss) &&
           append_smooth(line, &half[1], 0.5 * tolerance, depth + 1, gauss);
}

static bool append_edge(struct line *line, const struct density *density, const struct mesh *mesh,
                        size_t k, int edge, const struct gauss *gauss)
{
    const struct density_patch *patch = &density->patch[k];
    int fixed = edge < HULL_V0 ? 0 : 1, end = edge == HULL_U1 || edge == HULL_V1;
    double bound = patch->breaks[fixed][end ? patch->spans[fixed] : 0];
    for (size_t e = mesh->patch_base[k]; e < mesh->patch_base[k + 1]; e++) {
        const struct element *element = &mesh->element[e];
        if ((end ? element->upper : element->lower)[fixed] != bound)
            continue;
        struct line_segment segment = {
            .element = element, .fixed = fixed, .end = end, .range = {0.0, 1.0}};
        bound_segment(&segment);
        if (!append_smooth(line, &segment, 1e-7 * segment_length(line, &segment, gauss), 0, gauss))
            return false;
    }
    return true;
}

igabem_status line_create(const struct density *density, const struct mesh *mesh, double limit,
                          struct line **result)
{
    *result = NULL;
    struct gauss gauss;
    igabem_status status = gauss_fill(&gauss);
    if (status != IGABEM_OK)
        return status;
    struct line *line = calloc(1, sizeof *line);
    int complete = line != NULL;
    if (line)
        line->limit = limit;
    for (size_t k = 0; k < density->patches && complete; k++)
        for (int edge = 0; edge < HULL_EDGES && complete; edge++)
            if (density->patch[k].hull.edge[edge] == HULL_EDGE_WATERLINE)
                complete = append_edge(line, density, mesh, k, edge, &gauss);
    if (!complete) {
        line_free(line);
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the waterline");
    }
    *result = line;
    return IGABEM_OK;
}
