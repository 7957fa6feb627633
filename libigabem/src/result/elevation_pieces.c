#include "result/elevation_pieces.h"

#include "core/error.h"

#include <nurbs/basis.h>

#include <math.h>
#include <stdlib.h>

enum {
    RULE = 5,       /* Gauss points in each direction */
    DEPTH_MAX = 12, /* of the refinement towards a point */
    LATTICE = 3     /* samples a side that measure a piece */
};

static const double PHASE = 6.0;     /* radians of wave phase per rule */
static const double DECAY = 4.0;     /* units of exponent per rule */
static const double VANISHED = 30.0; /* exponent beyond which a wave angle no longer counts */
static const double NEAR = 1.2;      /* diagonals between a point and a rule */

bool point_set_add(struct point_set *set, double x, double y, double z, double q)
{
    if (set->n == set->room) {
        size_t room = 2 * set->room + 256;
        double **arrays[4] = {&set->x, &set->y, &set->z, &set->q};
        for (int k = 0; k < 4; k++) {
            double *more = realloc(*arrays[k], room * sizeof *more);
            if (!more)
                return false;
            *arrays[k] = more;
        }
        set->room = room;
    }
    set->x[set->n] = x;
    set->y[set->n] = y;
    set->z[set->n] = z;
    set->q[set->n++] = q;
    return true;
}

void point_set_clear(struct point_set *set)
{
    set->n = 0;
}

void point_set_free(struct point_set *set)
{
    free(set->x);
    free(set->y);
    free(set->z);
    free(set->q);
    *set = (struct point_set){0, 0, NULL, NULL, NULL, NULL};
}

struct source {
    double at[3];
    double strength; /* per unit of the local parameters */
};

static double gathered_density(const struct elevation_piece *piece, const struct jet *jet, double s,
                               double t)
{
    double bs[ELEMENT_SIDE], bt[ELEMENT_SIDE], sum = 0.0;
    int p = piece->element->degree[0], q = piece->element->degree[1];
    bernstein(p, s, bs, NULL);
    bernstein(q, t, bt, NULL);
    for (int a = 0; a <= p; a++)
        for (int b = 0; b <= q; b++)
            sum += bs[a] * bt[b] * piece->sigma[a * (q + 1) + b];
    return sum / jet->weight;
}

/* Surface point at local (s,t): U n_x where nothing is solved, else the density; a thin ship's in
 * the centre plane. */
static struct source surface_source(const struct elevation_pieces *pieces,
                                    const struct elevation_piece *piece, double s, double t)
{
    const igabem_solution *solution = pieces->solution;
    struct jet jet;
    double normal[3];
    element_jet(piece->element, s, t, &jet);
    double area = jet_area(&jet, piece->element->sign, normal);
    struct source source = {{jet.s[0], jet.s[1], fmin(jet.s[2], 0.0)}, 0.0};
    if (solution->formulation->centre_plane)
        source.at[1] = 0.0;
    if (!solution->formulation->solves)
        source.strength = solution->speed * normal[0];
    else
        source.strength = area * gathered_density(piece, &jet, s, t);
    return source;
}

/* Waterline point: -(1/k0) chi sigma n_x nu_x dl. */
static struct source line_source(const struct elevation_pieces *pieces,
                                 const struct elevation_piece *piece, double s)
{
    const igabem_solution *solution = pieces->solution;
    int along_t = piece->edge == HULL_U0 || piece->edge == HULL_U1;
    double end = piece->edge == HULL_U1 || piece->edge == HULL_V1 ? 1.0 : 0.0;
    double ls = along_t ? end : s, lt = along_t ? s : end, normal[3];
    struct jet jet;
    element_jet(piece->element, ls, lt, &jet);
    double area = jet_area(&jet, piece->element->sign, normal);
    const double *tangent = along_t ? jet.dt : jet.ds;
    double length = hypot(tangent[0], tangent[1]);
    struct source source = {{jet.s[0], jet.s[1], 0.0}, 0.0};
    if (!(length > 0) || !(area > 0))
        return source;
    double outward = tangent[1] * normal[0] - tangent[0] * normal[1] < 0 ? -1.0 : 1.0;
    double nu_x = outward * tangent[1] / length, n_x = normal[0] / area;
    double sigma = solution->formulation->solves ? gathered_density(piece, &jet, ls, lt)
                                                 : solution->speed * n_x;
    source.strength = -solution_stem_limiter(&solution->options, nu_x) * sigma * n_x * nu_x *
                      length / solution->k0;
    return source;
}

static struct source piece_source(const struct elevation_pieces *pieces,
                                  const struct elevation_piece *piece, double s, double t)
{
    return piece->edge < 0 ? surface_source(pieces, piece, s, t) : line_source(pieces, piece, s);
}

/* Gauss rule on [0,1], the same for every piece. */
struct rule {
    double node[RULE], weight[RULE];
};

struct window {
    double s0, s1, t0, t1;
};

static bool add_row(const struct elevation_pieces *pieces, const struct elevation_piece *piece,
                    const struct rule *rule, int along_t, double fixed, double from, double to,
                    double weight, struct point_set *set)
{
    for (int i = 0; i < RULE; i++) {
        double moving = from + (to - from) * rule->node[i];
        struct source source = along_t ? piece_source(pieces, piece, fixed, moving)
                                       : piece_source(pieces, piece, moving, fixed);
        if (!point_set_add(set, source.at[0], source.at[1], source.at[2],
                           weight * (to - from) * rule->weight[i] * source.strength))
            return false;
    }
    return true;
}

/* Where x = x_cut along a row between from and to, by the Illinois rule; the ends bracket it. */
static double find_cut(const struct elevation_pieces *pieces, const struct elevation_piece *piece,
                       int along_t, double fixed, double from, double to, double f_from,
                       double f_to, double x_cut)
{
    int side = 0;
    double at = from;
    for (int iteration = 0; iteration < 60 && fabs(to - from) > 1e-13; iteration++) {
        at = (from * f_to - to * f_from) / (f_to - f_from);
        struct source source = along_t ? piece_source(pieces, piece, fixed, at)
                                       : piece_source(pieces, piece, at, fixed);
        double f = source.at[0] - x_cut;
        if (f == 0.0)
            break;
        if (f * f_to > 0) {
            to = at;
            f_to = f;
            if (side == -1)
                f_from *= 0.5;
            side = -1;
        } else {
            from = at;
            f_from = f;
            if (side == 1)
                f_to *= 0.5;
            side = 1;
        }
    }
    return at;
}

/* One window; rows run in the direction in which x changes most and are divided at x_cut. */
static bool add_window(const struct elevation_pieces *pieces, const struct elevation_piece *piece,
                       const struct rule *rule, const struct window *w, double x_cut,
                       struct point_set *set)
{
    double sm = 0.5 * (w->s0 + w->s1), tm = 0.5 * (w->t0 + w->t1);
    int line = piece->edge >= 0, along_t = 0;
    if (!line) {
        double ds = piece_source(pieces, piece, w->s1, tm).at[0] -
                    piece_source(pieces, piece, w->s0, tm).at[0];
        double dt = piece_source(pieces, piece, sm, w->t1).at[0] -
                    piece_source(pieces, piece, sm, w->t0).at[0];
        along_t = fabs(dt) > fabs(ds);
    }
    double from = along_t ? w->t0 : w->s0, to = along_t ? w->t1 : w->s1;
    double f0 = along_t ? w->s0 : w->t0, f1 = along_t ? w->s1 : w->t1;
    int rows = line ? 1 : RULE;
    for (int r = 0; r < rows; r++) {
        double fixed = f0 + (f1 - f0) * rule->node[r];
        double weight = line ? 1.0 : (f1 - f0) * rule->weight[r];
        int ok = 1, divided = 0;
        if (!isnan(x_cut)) {
            struct source a = along_t ? piece_source(pieces, piece, fixed, from)
                                      : piece_source(pieces, piece, from, fixed);
            struct source b = along_t ? piece_source(pieces, piece, fixed, to)
                                      : piece_source(pieces, piece, to, fixed);
            double fa = a.at[0] - x_cut, fb = b.at[0] - x_cut;
            if (fa * fb < 0) {
                double cut = find_cut(pieces, piece, along_t, fixed, from, to, fa, fb, x_cut);
                ok = add_row(pieces, piece, rule, along_t, fixed, from, cut, weight, set) &&
                     add_row(pieces, piece, rule, along_t, fixed, cut, to, weight, set);
                divided = 1;
            }
        }
        if (!divided)
            ok = add_row(pieces, piece, rule, along_t, fixed, from, to, weight, set);
        if (!ok)
            return false;
    }
    return true;
}

static struct rule make_rule(void)
{
    struct rule rule;
    (void)nurbs_gauss_legendre(RULE, rule.node, rule.weight);
    return rule;
}

bool elevation_piece_sources(const struct elevation_pieces *pieces, size_t index, double x_cut,
                             struct point_set *set)
{
    const struct elevation_piece *piece = &pieces->piece[index];
    struct rule rule = make_rule();
    for (int i = 0; i < piece->parts[0]; i++)
        for (int j = 0; j < piece->parts[1]; j++) {
            struct window w = {i / (double)piece->parts[0], (i + 1) / (double)piece->parts[0],
                               j / (double)piece->parts[1], (j + 1) / (double)piece->parts[1]};
            if (!add_window(pieces, piece, &rule, &w, x_cut, set))
                return false;
        }
    return true;
}

struct bounds {
    double lower[3], upper[3], diagonal;
};

static struct bounds window_bounds(const struct elevation_pieces *pieces,
                                   const struct elevation_piece *piece, const struct window *w)
{
    struct bounds b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, 0.0};
    int columns = piece->edge >= 0 ? 1 : LATTICE;
    for (int i = 0; i < LATTICE; i++)
        for (int j = 0; j < columns; j++) {
            struct source source =
                piece_source(pieces, piece, w->s0 + (w->s1 - w->s0) * i / (LATTICE - 1.0),
                             w->t0 + (w->t1 - w->t0) * j / (LATTICE - 1.0));
            for (int k = 0; k < 3; k++) {
                b.lower[k] = fmin(b.lower[k], source.at[k]);
                b.upper[k] = fmax(b.upper[k], source.at[k]);
            }
        }
    b.diagonal = sqrt(pow(b.upper[0] - b.lower[0], 2) + pow(b.upper[1] - b.lower[1], 2) +
                      pow(b.upper[2] - b.lower[2], 2));
    return b;
}

static double box_distance(const double lower[3], const double upper[3], double x, double y)
{
    double p[3] = {x, y, 0.0}, square = 0.0;
    for (int k = 0; k < 3; k++) {
        double d = fmax(0.0, fmax(lower[k] - p[k], p[k] - upper[k]));
        square += d * d;
    }
    return sqrt(square);
}

double elevation_piece_distance(const struct elevation_piece *piece, double x, double y)
{
    return box_distance(piece->lower, piece->upper, x, y);
}

static bool refine(const struct elevation_pieces *pieces, const struct elevation_piece *piece,
                   const struct rule *rule, const struct window *w, double x, double y, int depth,
                   struct point_set *set)
{
    struct bounds b = window_bounds(pieces, piece, w);
    if (depth >= DEPTH_MAX || box_distance(b.lower, b.upper, x, y) > NEAR * b.diagonal)
        return add_window(pieces, piece, rule, w, x, set);
    double sm = 0.5 * (w->s0 + w->s1), tm = 0.5 * (w->t0 + w->t1);
    if (piece->edge >= 0) {
        struct window left = {w->s0, sm, w->t0, w->t1}, right = {sm, w->s1, w->t0, w->t1};
        return refine(pieces, piece, rule, &left, x, y, depth + 1, set) &&
               refine(pieces, piece, rule, &right, x, y, depth + 1, set);
    }
    for (int q = 0; q < 4; q++) {
        struct window quarter = {q & 1 ? sm : w->s0, q & 1 ? w->s1 : sm, q & 2 ? tm : w->t0,
                                 q & 2 ? w->t1 : tm};
        if (!refine(pieces, piece, rule, &quarter, x, y, depth + 1, set))
            return false;
    }
    return true;
}

bool elevation_piece_near_sources(const struct elevation_pieces *pieces, size_t index, double x,
                                  double y, struct point_set *set)
{
    struct rule rule = make_rule();
    struct window whole = {0.0, 1.0, 0.0, 1.0};
    return refine(pieces, &pieces->piece[index], &rule, &whole, x, y, 0, set);
}

/* Divisions that keep phase and decay within one rule at every angle that counts at this depth. */
static void measure(const struct elevation_pieces *pieces, struct elevation_piece *piece)
{
    struct window whole = {0.0, 1.0, 0.0, 1.0};
    struct bounds b = window_bounds(pieces, piece, &whole);
    for (int k = 0; k < 3; k++) {
        piece->lower[k] = b.lower[k];
        piece->upper[k] = b.upper[k];
    }
    piece->diagonal = b.diagonal;
    double k0 = pieces->solution->k0, angles = 1.0 + pieces->t_max * pieces->t_max;
    if (b.upper[2] < 0)
        angles = fmax(1.0, fmin(angles, VANISHED / (-b.upper[2] * k0)));
    double k = k0 * sqrt(angles), across = k * sqrt(angles - 1.0), decay = k0 * angles;
    for (int d = 0; d < 2; d++) {
        double phase = 0.0, exponent = 0.0;
        int rows = piece->edge >= 0 ? 1 : LATTICE;
        piece->parts[d] = 1;
        if (piece->edge >= 0 && d == 1)
            break;
        for (int r = 0; r < rows; r++)
            for (int i = 1; i < LATTICE; i++) {
                double row = r / (LATTICE - 1.0), a = (i - 1) / (LATTICE - 1.0),
                       c = i / (LATTICE - 1.0);
                struct source from =
                    d ? piece_source(pieces, piece, row, a) : piece_source(pieces, piece, a, row);
                struct source to =
                    d ? piece_source(pieces, piece, row, c) : piece_source(pieces, piece, c, row);
                double step =
                    k * fabs(to.at[0] - from.at[0]) + across * fabs(to.at[1] - from.at[1]);
                phase = fmax(phase, step * (LATTICE - 1.0));
                exponent = fmax(exponent, decay * fabs(to.at[2] - from.at[2]) * (LATTICE - 1.0));
            }
        piece->parts[d] = 1 + (int)fmin(fmax(phase / PHASE, exponent / DECAY), 64.0);
    }
}

static bool has_line_term(const igabem_solution *solution)
{
    return solution->options.line_term && solution->info.surface_piercing &&
           solution->formulation->line_term;
}

/* Whether an element touches an edge of its patch. */
static bool touches(const struct density_patch *patch, const struct element *element, int edge)
{
    int d = edge == HULL_U0 || edge == HULL_U1 ? 0 : 1;
    int last = edge == HULL_U1 || edge == HULL_V1;
    double bound = patch->breaks[d][last ? patch->spans[d] : 0];
    return last ? element->upper[d] >= bound : element->lower[d] <= bound;
}

static void collect(struct elevation_pieces *pieces)
{
    const igabem_solution *solution = pieces->solution;
    for (size_t e = 0; e < pieces->mesh->n; e++) {
        const struct element *element = &pieces->mesh->element[e];
        const struct density_patch *patch = &solution->density->patch[element->patch];
        struct elevation_piece piece = {.element = element, .edge = -1};
        element_gather(element, solution->sigma, piece.sigma);
        measure(pieces, &piece);
        pieces->piece[pieces->n++] = piece;
        for (int edge = 0; edge < HULL_EDGES && has_line_term(solution); edge++) {
            if (patch->hull.edge[edge] != HULL_EDGE_WATERLINE || !touches(patch, element, edge))
                continue;
            piece.edge = edge;
            measure(pieces, &piece);
            pieces->piece[pieces->n++] = piece;
        }
    }
}

igabem_status elevation_pieces_create(const igabem_solution *solution, double t_max,
                                      struct elevation_pieces **pieces)
{
    struct elevation_pieces *result = calloc(1, sizeof *result);
    *pieces = NULL;
    if (!result)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for the elements of the hull");
    result->solution = solution;
    result->t_max = t_max;
    igabem_status status = mesh_create(solution->density, &result->mesh);
    if (!status) {
        result->piece = calloc(result->mesh->n * (1 + HULL_EDGES), sizeof *result->piece);
        if (!result->piece)
            status =
                igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu elements", result->mesh->n);
    }
    if (status) {
        elevation_pieces_free(result);
        return status;
    }
    collect(result);
    *pieces = result;
    return IGABEM_OK;
}

void elevation_pieces_free(struct elevation_pieces *pieces)
{
    if (!pieces)
        return;
    mesh_free(pieces->mesh);
    free(pieces->piece);
    free(pieces);
}
