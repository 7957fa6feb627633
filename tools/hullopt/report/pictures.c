#include "report/pictures.h"

#include "cli.h"
#include "constants.h"
#include "core/constraints.h"
#include "core/objective.h"
#include "plot/ship.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Units of the sheets are pixels of the page at its full width. */
enum { FULL = 1120, HALF = 550, CUT = 280, AREAS = 280, HULL = 210, CURVES = 290 };

static const struct plot_pen pens[2] = {{PLOT_ORIGINAL, 1.1, "5 3"}, {PLOT_OPTIMUM, 1.1, NULL}};
static const struct plot_legend legend[2] = {{"original", {PLOT_ORIGINAL, 2, "5 3"}, PLOT_LINE},
                                             {"optimum", {PLOT_OPTIMUM, 2, NULL}, PLOT_LINE}};

/* Whether what a picture needs is there: not so where the geometry has no such thing. */
static bool drawable(int status)
{
    static const int no_memory = NURBS_ERROR_MEMORY; /* the same number in all libraries */
    if (status == no_memory)
        cli_needed(NULL);
    return status == 0;
}

void draw_history(FILE *out, const struct results *r)
{
    enum { HEIGHT = 400 };
    struct plot plot;
    struct plot_trial *trials = cli_needed(calloc(r->n + 1, sizeof *trials));
    for (size_t i = 0; i < r->n; i++) {
        const struct evaluation *e = &r->evaluations[i];
        struct plot_trial *t = &trials[i];
        t->number = (double)i;
        t->value = e->cw;
        t->initial = strcmp(e->phase, "initial") == 0 || e->id == 0;
        t->failed = e->failed;
        t->infeasible = !outcome_allowed(r->problem->config, e, r->baseline);
        if (e->failed)
            snprintf(t->note, sizeof t->note, "%llu: %s", (unsigned long long)e->id, e->reason);
        else
            snprintf(t->note, sizeof t->note, "%llu: C_w %.4e, displacement %+.2f %%",
                     (unsigned long long)e->id, e->cw, 100 * (e->volume_ratio - 1));
    }
    const struct plot_history history = {r->n, trials, r->baseline->cw, 1000, "10³ C_{w}"};
    if (plot_open(&plot, FULL, HEIGHT, "History of the search")) {
        plot_history(&plot, 0, 0, FULL, HEIGHT, &history);
        plot_embed(&plot, out);
    }
    free(trials);
}

void draw_front(FILE *out, const struct results *r)
{
    enum { HEIGHT = 400 };
    struct plot plot;
    struct objective o[OBJECTIVES_MOST];
    double marked[2][OBJECTIVES_MOST];
    struct plot_design *designs = cli_needed(calloc(r->n + 1, sizeof *designs));
    struct plot_front front = {
        r->n, objectives_count(r->problem->config), designs, marked[0], marked[1], {NULL}};
    for (size_t k = 0; k < front.objectives; k++) {
        objectives_describe(r->problem->config, k, &o[k]);
        front.labels[k] = o[k].label;
        marked[0][k] = results_objective(r, k, r->baseline);
        marked[1][k] = results_objective(r, k, r->best);
        for (size_t i = 0; i < r->n; i++)
            designs[i].value[k] = results_objective(r, k, &r->evaluations[i]);
    }
    for (size_t i = 0; i < r->n; i++) {
        designs[i].infeasible =
            !outcome_allowed(r->problem->config, &r->evaluations[i], r->baseline);
        snprintf(designs[i].note, sizeof designs[i].note, "%llu",
                 (unsigned long long)r->evaluations[i].id);
    }
    for (size_t i = 0; i < r->n_front; i++)
        designs[r->front[i]].member = true;
    if (plot_front(&plot, FULL, HEIGHT, &front))
        plot_embed(&plot, out);
    free(designs);
}

static struct plot_hull hull_of(const struct results *r, int which, const nurbs_surface **surface)
{
    *surface = nurbs_patches_get(nurbs_hull_full(results_hull(r, which)), 0);
    return (struct plot_hull){legend[which].text, 1, surface, pens[which]};
}

void draw_lines(FILE *out, const struct results *r)
{
    const nurbs_surface *surface[2];
    const struct plot_hull hulls[2] = {hull_of(r, 0, &surface[0]), hull_of(r, 1, &surface[1])};
    struct plot_lines lines = {.stations = 20, .waterlines = 8, .buttocks = 3};
    struct plot plot;
    if (drawable(nurbs_hull_perpendiculars(results_hull(r, 0), lines.perpendicular)) &&
        plot_lines_plan(&plot, FULL, &lines, 2, hulls))
        plot_embed(&plot, out);
}

void draw_section_areas(FILE *out, const struct results *r)
{
    enum { N = 141 };
    struct plot_frame f = {.left = 62, .top = 34, .width = HALF - 76, .height = AREAS - 80};
    double end[2], station[N], x[N], area[2][N];
    struct plot plot;
    if (!drawable(nurbs_hull_perpendiculars(results_hull(r, 0), end)))
        return;
    f.x = (struct plot_axis){.low = -1, .high = 21, .whole = true, .label = "station"};
    f.y = (struct plot_axis){.low = 0, .high = -INFINITY, .label = "section area, m²"};
    for (size_t i = 0; i < N; i++) {
        station[i] = -1 + 22.0 * (double)i / (N - 1);
        x[i] = end[0] + (end[1] - end[0]) * station[i] / 20;
    }
    for (int k = 0; k < 2; k++) {
        if (!drawable(nurbs_hull_section_areas(results_hull(r, k), N, x, area[k])))
            return;
        plot_include(&f.y, N, area[k]);
    }
    f.y.high *= 1.05;
    if (!plot_open(&plot, HALF, AREAS, "Sectional areas below the still water"))
        return;
    plot_axes(&plot, &f);
    for (int k = 0; k < 2; k++)
        plot_curve(&plot, &f, N, station, area[k], legend[k].pen);
    plot_legend(&plot, f.left, 20, false, 2, legend);
    plot_embed(&plot, out);
}

static const double STEEP = 20; /* degrees */
/* Angles of the pieces of a waterline to the centre plane, at their middles, those of blunt ends
 * cut off. false: it has none. */
static bool waterline_angles(const nurbs_hull *hull, size_t *n, double **x, double **angle)
{
    double *edge = NULL;
    bool ok = drawable(nurbs_hull_waterline(hull, n, &edge)) && *n > 2;
    *x = ok ? cli_needed(malloc(2 * *n * sizeof **x)) : NULL;
    if (*x) {
        *n -= 1;
        *angle = *x + *n;
        for (size_t i = 0; i < *n; i++) {
            const double *p = edge + 2 * i;
            (*x)[i] = (p[0] + p[2]) / 2;
            double degrees = 180 / PI * atan((p[3] - p[1]) / (p[2] - p[0]));
            (*angle)[i] = fmin(fmax(degrees, -STEEP), STEEP);
        }
    }
    free(edge);
    return *x != NULL;
}

void draw_fairness(FILE *out, const struct results *r)
{
    struct plot_frame f = {.left = 62, .top = 34, .width = HALF - 76, .height = AREAS - 80};
    struct plot plot;
    size_t n[2];
    double *x[2] = {NULL, NULL}, *angle[2];
    bool ok = true;
    f.x = (struct plot_axis){.low = INFINITY, .high = -INFINITY, .label = "x, m"};
    f.y = (struct plot_axis){.low = INFINITY, .high = -INFINITY, .label = "angle, degrees"};
    for (int k = 0; k < 2; k++) {
        ok = ok && waterline_angles(results_hull(r, k), &n[k], &x[k], &angle[k]);
        if (ok) {
            plot_include(&f.x, n[k], x[k]);
            plot_include(&f.y, n[k], angle[k]);
        }
    }
    if (ok && plot_open(&plot, HALF, AREAS, "Angle of the waterline to the centre plane")) {
        plot_axes(&plot, &f);
        for (int k = 0; k < 2; k++)
            plot_curve(&plot, &f, n[k], x[k], angle[k], legend[k].pen);
        plot_legend(&plot, f.left, 20, false, 2, legend);
        plot_embed(&plot, out);
    }
    free(x[0]);
    free(x[1]);
}

static void draw_hull(FILE *out, const char *title, const struct plot_view *view)
{
    struct plot plot;
    if (!plot_open(&plot, HALF, HULL, title))
        return;
    plot_text(&plot, 4, 15, 13, PLOT_START, PLOT_INK, "%s", title);
    plot_hull_view(&plot, 4, 24, HALF - 8, HULL - 30, view);
    plot_embed(&plot, out);
}

void draw_original(FILE *out, const struct results *r)
{
    const struct plot_view view = {.rows = nurbs_grid_rows(r->problem->grid),
                                   .columns = nurbs_grid_columns(r->problem->grid),
                                   .points = nurbs_grid_points(r->problem->grid)};
    draw_hull(out, "Original", &view);
}

void draw_optimum(FILE *out, const struct results *r)
{
    const galv_model *model = r->problem->model;
    const double *found = r->problem->found; /* a command's hull is no sum of modes */
    size_t points = galv_model_points(model), n = 3 * points;
    double *moved = cli_needed(malloc(n * sizeof *moved)), most = 0;
    double *change = cli_needed(malloc(points * sizeof *change));
    const double *parent = nurbs_grid_points(r->problem->grid);
    if (found)
        memcpy(moved, found, n * sizeof *moved);
    if (found || drawable(galv_displace(model, r->best->u, moved))) {
        for (size_t k = 0; k < points; k++) {
            double d[3], length = 0;
            for (size_t c = 0; c < 3; c++) {
                d[c] = moved[3 * k + c] - parent[3 * k + c];
                length = hypot(length, d[c]);
            }
            change[k] = d[1] < 0 ? -length : length;
            most = fmax(most, length);
        }
        const struct plot_view view = {
            nurbs_grid_rows(r->problem->grid),
            nurbs_grid_columns(r->problem->grid),
            moved,
            most > 0 ? change : NULL,
            {PLOT_DIVERGING, {.low = -most, .high = most, .unit = 1000, .label = "outwards, mm"}}};
        draw_hull(out, "Optimum", &view);
    }
    free(moved);
    free(change);
}

static struct plot_latent latent_of(const struct results *r)
{
    const galv_model *model = r->problem->model;
    return (struct plot_latent){galv_model_modes(model),      galv_model_spectrum(model),
                                galv_model_parameters(model), galv_model_eigenvalues(model),
                                galv_model_mse(model),        galv_model_trace(model),
                                r->problem->config->variance};
}

static void draw_latent(FILE *out, const char *title, const struct results *r,
                        void (*draw)(struct plot *, double, double, double, double,
                                     const struct plot_latent *))
{
    struct plot plot;
    const struct plot_latent latent = latent_of(r);
    if (!plot_open(&plot, HALF, CURVES, title))
        return;
    draw(&plot, 0, 14, HALF, CURVES - 14, &latent);
    plot_embed(&plot, out);
}

void draw_variance(FILE *out, const struct results *r)
{
    draw_latent(out, "Geometric variance retained against the number of modes", r, plot_variance);
}

void draw_error(FILE *out, const struct results *r)
{
    draw_latent(out, "Mean square error of the reconstruction", r, plot_error);
}

void draw_mode(FILE *out, const struct results *r, size_t mode)
{
    const galv_model *model = r->problem->model;
    struct plot plot;
    char title[32];
    const struct plot_mode shown = {mode + 1,
                                    nurbs_grid_rows(r->problem->grid),
                                    nurbs_grid_columns(r->problem->grid),
                                    nurbs_grid_points(r->problem->grid),
                                    galv_model_vectors(model) +
                                        mode * galv_model_coordinates(model),
                                    galv_model_eigenvalues(model)[mode],
                                    galv_model_trace(model)};
    snprintf(title, sizeof title, "Mode %zu", mode + 1);
    if (!plot_open(&plot, HALF, HULL, title))
        return;
    plot_mode_view(&plot, 4, 0, HALF - 8, HULL - 6, &shown);
    plot_embed(&plot, out);
}

/* With the waterplane; free .edge. */
static struct plot_waves waves_of(const struct results *r, int which)
{
    const struct waves *w = &r->waves[which && r->waves[1].elevation];
    struct plot_waves waves = {legend[which].text, w->nx, w->ny, 0, w->x0, w->dx, w->y0, w->dy,
                               w->elevation,       NULL};
    /* without it the picture lacks the hull */
    if (!drawable(nurbs_hull_waterline(results_hull(r, which), &waves.n_edge, &waves.edge)))
        waves.n_edge = 0;
    return waves;
}

void draw_waves(FILE *out, const struct results *r)
{
    const struct plot_waves waves[2] = {waves_of(r, 0), waves_of(r, 1)};
    struct plot plot;
    if (plot_wave_pattern(&plot, FULL, 2, waves))
        plot_embed(&plot, out);
    free(waves[0].edge);
    free(waves[1].edge);
}

void draw_wave_cut(FILE *out, const struct results *r, double share)
{
    const struct plot_waves waves[2] = {waves_of(r, 0), waves_of(r, 1)};
    size_t n = waves->nx;
    struct plot_frame f = {.left = 66, .top = 34, .width = FULL - 66 - 96, .height = CUT - 80};
    double *x = cli_needed(malloc(3 * n * sizeof *x));
    struct plot plot;
    free(waves[0].edge);
    free(waves[1].edge);
    if (!plot_open(&plot, FULL, CUT, "Longitudinal wave cut")) {
        free(x);
        return;
    }
    f.x = (struct plot_axis){.low = waves->x0,
                             .high = waves->x0 + (double)(n - 1) * waves->dx,
                             .label = "x, m (forward to the right)"};
    f.y = (struct plot_axis){
        .low = INFINITY, .high = -INFINITY, .unit = 1000, .label = "elevation, mm"};
    for (size_t i = 0; i < n; i++) {
        x[i] = waves->x0 + (double)i * waves->dx;
        for (size_t k = 0; k < 2; k++)
            x[(k + 1) * n + i] = plot_wave_at(&waves[k], x[i], share * problem_length(r->problem));
    }
    plot_include(&f.y, 2 * n, x + n);
    plot_nice(&f.y, 4);
    plot_axes(&plot, &f);
    for (size_t k = 0; k < 2; k++)
        if (r->waves[k].elevation)
            plot_curve(&plot, &f, n, x, x + (k + 1) * n, legend[k].pen);
    plot_legend(&plot, f.left, 20, false, 2, legend);
    plot_embed(&plot, out);
    free(x);
}
