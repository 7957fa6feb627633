/* From a hull to its sections and the surface through them: sections are added where the surface is
 * too far from the hull. */
#include "core/constants.h"
#include "core/error.h"
#include "lines/lines.h"
#include "mesh/mesh.h"

#include <nurbs/fit.h>
#include <nurbs/modify.h>
#include <nurbs/section.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    FIRST_ROWS = 40,
    FIRST_COLUMNS = 32,
    LEAST = 8,
    MOST = 400,
    MOST_KINKS = 16,
    ROUNDS = 7,
    MOST_DROPPED = 12,
    FOLD_PARTS = 4,
    PARTS_U = 3, /* places between rows and between columns */
    PARTS_V = 2
};

static const double default_tolerance = 5e-4; /* of the extent */
static const double mesh_share = 0.05; /* of the tolerance: how fine triangles of patches are */
/* Of the tolerance: what the surface through the sections may take of it, and what dropping of
 * knots may add; of triangles, whose facets no surface follows, and of patches. */
static const double skin_share[2] = {0.8, 0.5}, light_share[2] = {0.2, 0.45};

/* Of the extent: an end is judged at this distance from it, and at four times that. */
static const double end_step = 1e-3;
/* Breadths at the two places of an end that closes: as roots of the distance, or steeper. */
static const double closes = 1.5;
static const double helps = 0.9;        /* of the deviation: what a round should leave at most */
static const double least_gap = 4e-4;   /* of the extent, between sections */
static const double near_end = 1e-4;    /* of the extent: where an open end is cut */
static const double half_closed = 0.05; /* of its length: what is closed and open of such an end */
static const double closed = 1e-5; /* of the extent: how near the centre plane a closed end is */

typedef struct work {
    const nurbs_mesh *mesh;
    nurbs_sections_options options;
    sheets sheets;
    mesh_distance *distance;
    const projector *onto; /* of patches; NULL: triangles are the hull */
    int attempt;           /* 1: twice as many sections and points to begin with */
    size_t dropped;        /* sections next to the ends that folded the surface */
    size_t n;              /* lines, by place */
    line *line[MOST + MOST_KINKS + 2];
    nurbs_sections *out;
    double row_error[MOST + MOST_KINKS + 2]; /* between line k and k + 1 */
    double column_error;
} work;

void nurbs_sections_options_init(nurbs_sections_options *options)
{
    if (options)
        *options = (nurbs_sections_options){.tolerance = NAN, .kink_angle = 20 * PI / 180};
}

void nurbs_sections_free(nurbs_sections *s)
{
    if (!s)
        return;
    nurbs_grid_free(s->grid);
    nurbs_surface_free(s->surface);
    free(s->u);
    *s = (nurbs_sections){0};
}

static void work_free(work *w)
{
    for (size_t k = 0; k < w->n; k++) {
        line_free(w->line[k]);
        free(w->line[k]);
    }
    mesh_distance_free(w->distance);
}

/* Puts a line, which it takes, in its order. */
static void insert(work *w, line *l)
{
    size_t k = w->n++;
    for (; k > 0 && w->line[k - 1]->place > l->place; k--)
        w->line[k] = w->line[k - 1];
    w->line[k] = l;
}

static nurbs_status trace(work *w, double place, line **l)
{
    *l = calloc(1, sizeof **l);
    if (!*l)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for a section");
    nurbs_status status =
        line_trace(w->mesh, &w->sheets, place, w->options.kink_angle, *l, &w->out->left_out);
    if (status) {
        line_free(*l);
        free(*l);
        *l = NULL;
    }
    return status;
}

static nurbs_status add_row(work *w, double place)
{
    line *l;
    nurbs_status status = trace(w, place, &l);
    if (!status)
        insert(w, l);
    return status;
}

static double widest(const line *l)
{
    double y = 0;
    for (size_t k = 0; k < l->n; k++)
        y = fmax(y, l->points[3 * k + 1]);
    return y;
}

/* What is nearly closed of an end is closed. */
static void close_end(line *l, double nearly)
{
    size_t open = 0;
    for (size_t k = 0; k < l->n; k++)
        if (l->points[3 * k + 1] < nearly)
            l->points[3 * k + 1] = 0;
        else
            open = k + 1;
    if (open == l->n)
        return;
    double share = l->along[open] / l->along[l->n - 1];
    if (share > half_closed && share < 1 - half_closed)
        l->closing = share;
}

/* The last section of an end: its outline if the hull closes there, else its edge. */
static nurbs_status add_end(work *w, int end)
{
    const sheets *s = &w->sheets;
    double inwards = (end ? -1 : 1) * s->extent, tip = s->tip[end];
    line *near = NULL, *far = NULL, *last = NULL;
    nurbs_status status = trace(w, tip + end_step * inwards, &near);
    if (!status)
        status = trace(w, tip + 4 * end_step * inwards, &far);
    if (!status && widest(far) < closes * widest(near))
        status = trace(w, tip + near_end * inwards, &last);
    else if (!status) {
        /* The heights of deck and keel go on to the tip. */
        double deck = (4 * near->points[2] - far->points[2]) / 3,
               keel = (4 * near->points[3 * near->n - 1] - far->points[3 * far->n - 1]) / 3;
        last = calloc(1, sizeof *last);
        status =
            last ? line_outline(s, end, fmin(deck, s->high[2]), fmax(keel, s->low[2]), near, last)
                 : nurbs_fail(NURBS_ERROR_MEMORY, "no memory for an outline");
    }
    for (int k = 0; k < 2; k++) {
        line *one = k ? far : near;
        if (one)
            line_free(one);
        free(one);
    }
    if (status) {
        if (last)
            line_free(last);
        free(last);
        return status;
    }
    close_end(last, 2 * near_end * s->extent);
    last->place = tip;
    insert(w, last);
    return NURBS_OK;
}

/* Crowded towards the ends, where hulls close like roots of the distance. */
static nurbs_status first_rows(work *w)
{
    double low = w->sheets.tip[0], high = w->sheets.tip[1], kink[MOST_KINKS];
    size_t rows = w->options.rows ? w->options.rows : (size_t)FIRST_ROWS << w->attempt, kinks = 0;
    nurbs_status status = add_end(w, 0);
    if (!status)
        status = add_end(w, 1);
    if (!status)
        status = keel_kinks(w->mesh, &w->sheets, w->options.kink_angle, MOST_KINKS, kink, &kinks);
    for (size_t k = 1; k + 1 < rows && !status; k++) {
        double place = low + (high - low) * 0.5 * (1 - cos(PI * (double)k / (double)(rows - 1)));
        bool taken = false;
        for (size_t i = 0; i < kinks; i++) {
            /* The nearest row goes to a kink. */
            double gap = (high - low) * 0.5 * PI / (double)(rows - 1) *
                         sin(PI * (double)k / (double)(rows - 1));
            taken |= fabs(kink[i] - place) < 0.5 * gap;
        }
        status = taken ? NURBS_OK : add_row(w, place);
    }
    for (size_t i = 0; i < kinks && !status; i++)
        status = add_row(w, kink[i]);
    return status;
}

/* Points of the grid onto the patches; those in the centre plane stay there. */
static nurbs_status project(const work *w)
{
    nurbs_grid *grid = w->out->grid;
    double *p = nurbs_grid_edit(grid);
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; w->onto && k < nurbs_grid_rows(grid) * nurbs_grid_columns(grid) && !status;
         k++, p += 3)
        if (p[1] > 0)
            status = projector_put(w->onto, w->options.tolerance, p);
    return status;
}

/* Through all points, or (light) with the knots dropped that its share of the tolerance allows. */
static nurbs_status skin(work *w, size_t columns, bool light)
{
    nurbs_skin_options options;
    nurbs_sections *out = w->out;
    nurbs_grid_free(out->grid);
    nurbs_surface_free(out->surface);
    free(out->u);
    out->grid = NULL;
    out->surface = NULL;
    out->u = out->v = NULL;
    nurbs_status status = lines_grid(w->n, (const line *const *)w->line, columns, &out->grid,
                                     &out->corners, out->corner);
    if (!status)
        status = project(w);
    if (status)
        return status;
    nurbs_skin_options_init(&options);
    options.kink_angle = w->options.kink_angle;
    options.chine_count = out->corners;
    options.chine = out->corner;
    out->u = malloc((w->n + columns) * sizeof *out->u);
    if (!out->u)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu parameters", w->n + columns);
    out->v = out->u + w->n;
    status = light ? nurbs_skin_light(out->grid, &options,
                                      light_share[w->onto != NULL] * w->options.tolerance,
                                      &out->surface, NULL)
                   : nurbs_skin(out->grid, &options, &out->surface);
    return status ? status : nurbs_skin_parameters(out->grid, &options, out->u, out->v);
}

/* Samples between the points of the grid. */
static nurbs_status measure(work *w, size_t columns)
{
    nurbs_sections *out = w->out;
    size_t nu = PARTS_U * (w->n - 1) + 1, nv = PARTS_V * (columns - 1) + 1;
    double *t = malloc((nu + nv + 3 * nu * nv) * sizeof *t);
    if (!t)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for %zu samples", nu * nv);
    double *v = t + nu, *points = v + nv;
    for (size_t k = 0; k < nu; k++) {
        size_t i = k / PARTS_U;
        double s = (double)(k % PARTS_U) / PARTS_U;
        t[k] = k % PARTS_U ? (1 - s) * out->u[i] + s * out->u[i + 1] : out->u[i];
    }
    for (size_t k = 0; k < nv; k++) {
        size_t j = k / PARTS_V;
        double s = (double)(k % PARTS_V) / PARTS_V;
        v[k] = k % PARTS_V ? (1 - s) * out->v[j] + s * out->v[j + 1] : out->v[j];
    }
    nurbs_status status = nurbs_surface_eval_grid(out->surface, 0, nu, t, nv, v, points);
    out->deviation = w->column_error = 0;
    memset(w->row_error, 0, sizeof w->row_error);
    for (size_t k = 0; k < nu * nv && !status; k++) {
        const double *p = points + 3 * k;
        double away = mesh_distance_of(w->distance, p);
        size_t i = k / nv;
        if (i % PARTS_U)
            w->row_error[i / PARTS_U] = fmax(w->row_error[i / PARTS_U], away);
        else
            w->column_error = fmax(w->column_error, away);
        if (away > out->deviation) {
            out->deviation = away;
            memcpy(out->place, p, sizeof out->place);
        }
    }
    free(t);
    return status;
}

/* Sections next to a closed end are narrow and short; where they fold the surface it is better
 * without them. False: enough were dropped. */
static bool drop_near_end(work *w)
{
    size_t k = w->dropped % 2 ? 1 : w->n - 2;
    if (w->dropped++ >= MOST_DROPPED || w->n <= LEAST)
        return false;
    line_free(w->line[k]);
    free(w->line[k]);
    memmove(&w->line[k], &w->line[k + 1], (--w->n - k) * sizeof w->line[0]);
    return true;
}

/* Halves the gaps that are too far off; *added: how many. */
static nurbs_status add_rows(work *w, size_t *added)
{
    double place[MOST];
    size_t n = 0;
    for (size_t k = 0; k + 1 < w->n; k++)
        if (w->row_error[k] > skin_share[w->onto != NULL] * w->options.tolerance &&
            w->n + n < MOST) {
            double a = w->line[k]->place, b = w->line[k + 1]->place;
            bool end = k == 0 || k + 2 == w->n;
            if (b - a > least_gap * w->sheets.extent && !(end && w->dropped))
                place[n++] = 0.5 * (a + b);
        }
    nurbs_status status = NURBS_OK;
    for (size_t k = 0; k < n && !status; k++)
        status = add_row(w, place[k]);
    *added = n;
    return status;
}

/* Whether the points of the first and the last section that lie in the centre plane are there on
 * the surface: an end that is closed below and open above would open when knots are dropped. */
static nurbs_status check_ends(const work *w, size_t columns)
{
    const nurbs_sections *out = w->out;
    for (int end = 0; end < 2; end++) {
        size_t row = end ? w->n - 1 : 0;
        for (size_t j = 0; j < columns; j++) {
            double uv[2] = {out->u[row], out->v[j]}, p[3];
            if (nurbs_grid_points(out->grid)[3 * (row * columns + j) + 1] != 0)
                continue;
            nurbs_status status = nurbs_surface_eval(out->surface, 0, 1, uv, p);
            if (status)
                return status;
            if (fabs(p[1]) > closed * w->sheets.extent)
                return nurbs_fail(NURBS_ERROR_NUMERIC, "the end at x = %.6g m opens to y = %.3g m",
                                  p[0], p[1]);
        }
    }
    return NURBS_OK;
}

static nurbs_status lighten(work *w, size_t columns)
{
    nurbs_status status = skin(w, columns, true);
    if (!status)
        status = nurbs_surface_check_fold(w->out->surface, NULL);
    if (!status)
        status = check_ends(w, columns);
    /* The light one may overshoot the centre plane by more than its share, open an end or fold. */
    if (status == NURBS_ERROR_NUMERIC || status == NURBS_ERROR_GEOMETRY)
        status = skin(w, columns, false);
    if (!status)
        status = measure(w, columns);
    if (!status && w->out->deviation > w->options.tolerance)
        status = nurbs_fail(NURBS_ERROR_NUMERIC,
                            "the surface is %.3g m off the hull at (%.6g, %.6g, %.6g), expected at "
                            "most %.3g m",
                            w->out->deviation, w->out->place[0], w->out->place[1], w->out->place[2],
                            w->options.tolerance);
    return status;
}

static nurbs_status refine(work *w)
{
    const nurbs_sections_options *o = &w->options;
    size_t columns = o->columns ? o->columns : (size_t)FIRST_COLUMNS << w->attempt;
    double last = INFINITY;
    for (int round = 0;; round++) {
        size_t added = 0;
        double within = skin_share[w->onto != NULL] * o->tolerance;
        nurbs_status status = skin(w, columns, false);
        while (status == NURBS_ERROR_GEOMETRY && drop_near_end(w))
            status = skin(w, columns, false);
        if (!status)
            status = measure(w, columns);
        if (status || w->out->deviation <= within)
            return status ? status : lighten(w, columns);
        /* Where rows no longer help it is for want of columns. */
        bool stuck = round > 0 && w->out->deviation > helps * last,
             more =
                 !o->columns && (w->column_error > within || stuck) && 3 * columns / 2 <= MOST / 2;
        last = w->out->deviation;
        if (round < ROUNDS && !o->rows && !(stuck && more))
            status = add_rows(w, &added);
        if (status)
            return status;
        if (round < ROUNDS && more)
            columns += columns / 2;
        else if (added == 0)
            return nurbs_fail(NURBS_ERROR_NUMERIC,
                              "the surface through %zu sections of %zu points is %.3g m off the "
                              "hull at (%.6g, %.6g, %.6g), expected at most %.3g m",
                              w->n, columns, w->out->deviation, w->out->place[0], w->out->place[1],
                              w->out->place[2], within);
    }
}

static nurbs_status check(const nurbs_sections_options *o)
{
    if ((o->rows && (o->rows < LEAST || o->rows > MOST)) ||
        (o->columns && (o->columns < LEAST || o->columns > MOST)))
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "%zu sections of %zu points, expected %d to %d",
                          o->rows, o->columns, LEAST, MOST);
    if (o->tolerance <= 0 || isinf(o->tolerance) || !(o->kink_angle > 0))
        return nurbs_fail(NURBS_ERROR_ARGUMENT,
                          "tolerance %g m, kink angle %g: expected positive ones", o->tolerance,
                          o->kink_angle);
    return NURBS_OK;
}

/* Cutting at the water divides spans, and finds folds that are narrower than a span. */
static bool is_smooth(const nurbs_surface *surface)
{
    nurbs_surface *fine = NULL;
    bool smooth = nurbs_surface_refine(surface, FOLD_PARTS, &fine) == NURBS_OK &&
                  nurbs_surface_check_fold(fine, NULL) == NURBS_OK;
    nurbs_surface_free(fine);
    return smooth;
}

static nurbs_status attempt(const nurbs_mesh *mesh, const projector *onto,
                            const nurbs_sections_options *options, int number,
                            nurbs_sections *sections)
{
    work *w = calloc(1, sizeof *w);
    if (!w)
        return nurbs_fail(NURBS_ERROR_MEMORY, "no memory for sections");
    w->mesh = mesh;
    w->onto = onto;
    w->out = sections;
    w->options = *options;
    w->attempt = number;
    nurbs_status status = check(&w->options);
    if (!status)
        status = sheets_create(mesh, &w->sheets);
    if (!status && isnan(w->options.tolerance))
        w->options.tolerance = default_tolerance * w->sheets.extent;
    if (!status)
        status = mesh_distance_create(mesh, &w->distance);
    if (!status)
        status = first_rows(w);
    if (!status)
        status = refine(w);
    work_free(w);
    free(w);
    if (status)
        nurbs_sections_free(sections);
    return status;
}

/* Blunt ends and notches that few sections fold, or miss, are tried again with twice as many; what
 * comes out of that is taken if it is better. */
static nurbs_status make(const nurbs_mesh *mesh, const projector *onto,
                         const nurbs_sections_options *options, nurbs_sections *sections)
{
    nurbs_sections more = {0};
    nurbs_status status = attempt(mesh, onto, options, 0, sections);
    bool surface = status == NURBS_OK;
    if ((surface && is_smooth(sections->surface)) || options->rows || options->columns ||
        (!surface && status != NURBS_ERROR_GEOMETRY && status != NURBS_ERROR_NUMERIC))
        return status;
    nurbs_status again = attempt(mesh, onto, options, 1, &more);
    if (!again && (!surface || is_smooth(more.surface))) {
        nurbs_sections_free(sections);
        *sections = more;
        return NURBS_OK;
    }
    nurbs_sections_free(&more);
    return surface ? NURBS_OK : again;
}

nurbs_status nurbs_mesh_sections(const nurbs_mesh *mesh, const nurbs_sections_options *options,
                                 nurbs_sections *sections)
{
    nurbs_sections_options defaults;
    if (!mesh || !sections)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "mesh or sections is NULL");
    *sections = (nurbs_sections){0};
    nurbs_sections_options_init(&defaults);
    return make(mesh, NULL, options ? options : &defaults, sections);
}

nurbs_status nurbs_patches_sections(const nurbs_patches *patches,
                                    const nurbs_sections_options *options, nurbs_sections *sections)
{
    nurbs_sections_options o;
    nurbs_mesh *mesh = NULL;
    projector *onto = NULL;
    if (!patches || !sections)
        return nurbs_fail(NURBS_ERROR_ARGUMENT, "patches or sections is NULL");
    *sections = (nurbs_sections){0};
    nurbs_sections_options_init(&o);
    if (options)
        o = *options;
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < nurbs_patches_count(patches); k++) {
        const nurbs_surface *surface = nurbs_patches_get(patches, k);
        const double *p = nurbs_surface_points(surface);
        for (size_t i = 0; i < nurbs_surface_size(surface, 0) * nurbs_surface_size(surface, 1);
             i++) {
            low = fmin(low, p[3 * i]);
            high = fmax(high, p[3 * i]);
        }
    }
    if (isnan(o.tolerance) && high > low)
        o.tolerance = default_tolerance * (high - low);
    nurbs_status status = check(&o);
    if (!status)
        status = nurbs_patches_mesh(patches, mesh_share * o.tolerance, &mesh);
    if (!status)
        status = projector_create(patches, &onto);
    if (!status)
        status = make(mesh, onto, &o, sections);
    projector_free(onto);
    nurbs_mesh_free(mesh);
    return status;
}
