#include "exterior/free_surface.h"

#include "core/error.h"
#include "exterior/spline.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = SPLINE_SIDE, DEGREE = SIDE - 1 };

static igabem_status no_memory(size_t cells)
{
    return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for %zu cells of the free surface", cells);
}

/* (r^eta - 1)/(r - 1) */
static double series(double ratio, double eta)
{
    double excess = ratio - 1.0;
    return excess > 1e-9 ? expm1(eta * log1p(excess)) / excess : eta;
}

/* Ratio of the series of ny terms that adds up to sum. */
static double growth(double sum, double ny)
{
    double low = 1.0, high = 3.0;
    for (int k = 0; k < 80; k++) {
        double middle = 0.5 * (low + high);
        if (series(middle, ny) > sum)
            high = middle;
        else
            low = middle;
    }
    return low;
}

double free_surface_offset(const struct free_surface *surface, double eta)
{
    return surface->first * series(surface->growth, eta);
}

double free_surface_breadth(const struct free_surface *surface, double x)
{
    const struct edge *waterline = &surface->waterline;
    double at[3];
    if (!waterline->n || x > waterline->last)
        return 0.0;
    if (x < waterline->first)
        return surface->transom;
    edge_at(waterline, x, at);
    return at[1];
}

double free_surface_y(const struct free_surface *surface, double xi, size_t two_eta)
{
    double s = surface->offset[two_eta], all = surface->offset[2 * surface->ny];
    double breadth = free_surface_breadth(surface, surface->x0 - surface->dx * xi);
    return breadth * (1.0 - s / all) + s;
}

bool free_surface_locate(const struct free_surface *surface, double x, double y,
                         struct free_surface_place *place)
{
    double all = surface->offset[2 * surface->ny], dx = surface->dx;
    double xi = (surface->x0 - x) / dx, breadth = free_surface_breadth(surface, x);
    double stretch = 1.0 - breadth / all, s = (fabs(y) - breadth) / stretch;
    double excess = surface->growth - 1.0;
    if (!(xi >= 0.0 && xi <= (double)surface->nx && s >= 0.0 && s <= all))
        return false;
    double eta =
        excess > 1e-9 ? log1p(s * excess / surface->first) / log1p(excess) : s / surface->first;
    double rise = excess > 1e-9 ? (surface->first / excess + s) * log1p(excess) : surface->first;
    /* Slope of the waterline within the cell, at whose lines it may have its ends. */
    double cell = fmin(floor(xi), (double)surface->nx - 1.0);
    double a = fmax(cell, xi - 0.25), b = fmin(cell + 1.0, xi + 0.25);
    double slope = (free_surface_breadth(surface, surface->x0 - dx * a) -
                    free_surface_breadth(surface, surface->x0 - dx * b)) /
                   (dx * (b - a));
    *place = (struct free_surface_place){.xi = xi,
                                         .eta = fmin(eta, (double)surface->ny),
                                         .eta_x = -slope * (1.0 - s / all) / (stretch * rise),
                                         .eta_y = 1.0 / (stretch * rise)};
    return true;
}

static const double *fill_net(const struct free_surface *surface, size_t i, size_t j)
{
    double point[SIDE][SIDE][3], all = surface->offset[2 * surface->ny];
    for (int a = 0; a < SIDE; a++) {
        double x = surface->x0 - surface->dx * ((double)i + a / 3.0);
        double breadth = free_surface_breadth(surface, x);
        for (int b = 0; b < SIDE; b++) {
            double s = free_surface_offset(surface, (double)j + b / 3.0);
            point[a][b][0] = x;
            point[a][b][1] = breadth * (1.0 - s / all) + s;
            point[a][b][2] = 0.0;
        }
    }
    return spline_net(surface->mesh, i * surface->ny + j, (const double *)point);
}

static void fill_elements(struct free_surface *surface)
{
    struct mesh *mesh = surface->mesh;
    for (size_t i = 0; i < surface->nx; i++)
        for (size_t j = 0; j < surface->ny; j++) {
            size_t e = i * surface->ny + j;
            struct element *element = &mesh->element[e];
            *element = (struct element){.degree = {DEGREE, DEGREE},
                                        .upper = {1.0, 1.0},
                                        .extraction = {spline_quadratic, spline_quadratic},
                                        .net = fill_net(surface, i, j),
                                        .first = i * surface->columns + j,
                                        .stride = surface->columns,
                                        .sign = 1.0};
            spline_panel(mesh, e);
            struct jet jet;
            element_jet(element, 0.5, 0.5, &jet);
            surface->point[e] = (struct layer_point){
                .at = {jet.s[0], jet.s[1], 0.0}, .homes = 1, .home = {e}, .local = {{0.5, 0.5}}};
        }
}

/* Beside a waterline that crosses more than this share of the first row in a cell's length the
 * operator amplifies short waves (theory.md, section 12). */
static const double skew_most = 0.8;

static igabem_status check_skew(const struct free_surface *surface)
{
    for (size_t i = surface->bow; i < surface->stern && surface->waterline.n; i++) {
        double xi = (double)i, across = free_surface_y(surface, xi, 0);
        double skew = fabs(free_surface_y(surface, xi + 1.0, 0) - across);
        double row = free_surface_y(surface, xi + 0.5, 2) - free_surface_y(surface, xi + 0.5, 0);
        if (skew > skew_most * row)
            return igabem_fail(IGABEM_ERROR_GEOMETRY,
                               "the waterline is %.3g times as steep at x = %.6g m as a first row "
                               "of surface_first %.3g can follow: expected at least %.3g",
                               skew / (skew_most * row), surface->x0 - surface->dx * (xi + 0.5),
                               surface->first / surface->dx,
                               skew / row / skew_most * surface->first / surface->dx);
    }
    return IGABEM_OK;
}

igabem_status free_surface_create(const struct free_surface_rule *rule,
                                  const struct density *density, const double ends[2],
                                  struct free_surface **result)
{
    *result = NULL;
    struct edge waterline;
    igabem_status status =
        edge_create(density, HULL_EDGE_WATERLINE, 0, ends[1] - ends[0], &waterline);
    if (status != IGABEM_OK)
        return status;
    double aft = waterline.n ? waterline.first : ends[0];
    double fore = waterline.n ? waterline.last : ends[1], length = fore - aft;
    size_t beside = (size_t)fmax(4.0, round(rule->cells));
    double dx = length / (double)beside, first = rule->first * dx;
    size_t ahead = (size_t)fmax(4.0, round(rule->upstream * length / dx));
    size_t behind = (size_t)fmax(4.0, round(rule->downstream * length / dx));
    size_t nx = ahead + beside + behind, ny = (size_t)fmax(4.0, round(rule->rows));
    struct free_surface *surface = calloc(1, sizeof *surface);
    if (!surface) {
        edge_free(&waterline);
        return no_memory(nx * ny);
    }
    *surface = (struct free_surface){
        .nx = nx,
        .ny = ny,
        .bow = ahead,
        .stern = ahead + beside,
        .x0 = fore + (double)ahead * dx,
        .dx = dx,
        .first = first,
        .growth = growth(rule->side * length / first, (double)ny),
        .waterline = waterline,
        .transom = rule->transom && waterline.n ? waterline.point[0].at[1] : 0.0,
        .columns = ny + DEGREE,
        .coefficients = (nx + DEGREE) * (ny + DEGREE),
        .offset = malloc((2 * ny + 1) * sizeof(double)),
        .point = malloc(nx * ny * sizeof(struct layer_point)),
        .mesh = spline_mesh(nx * ny)};
    if (!surface->offset || !surface->point || !surface->mesh) {
        free_surface_free(surface);
        return no_memory(nx * ny);
    }
    for (size_t k = 0; k <= 2 * ny; k++)
        surface->offset[k] = first * series(surface->growth, 0.5 * (double)k);
    status = check_skew(surface);
    if (status != IGABEM_OK) {
        free_surface_free(surface);
        return status;
    }
    fill_elements(surface);
    *result = surface;
    return IGABEM_OK;
}

void free_surface_free(struct free_surface *surface)
{
    if (!surface)
        return;
    edge_free(&surface->waterline);
    mesh_free(surface->mesh);
    free(surface->offset);
    free(surface->point);
    free(surface);
}
