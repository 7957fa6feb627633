#include "exterior/free_surface.h"

#include "core/error.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { DEGREE = 3, SIDE = DEGREE + 1 };

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

double free_surface_y(const struct free_surface *surface, double xi, size_t two_eta)
{
    double s = surface->offset[two_eta], all = surface->offset[2 * surface->ny];
    double breadth = waterline_breadth(&surface->waterline, surface->x0 - surface->dx * xi);
    return breadth * (1.0 - s / all) + s;
}

bool free_surface_locate(const struct free_surface *surface, double x, double y,
                         struct free_surface_place *place)
{
    double all = surface->offset[2 * surface->ny], dx = surface->dx;
    double xi = (surface->x0 - x) / dx, breadth = waterline_breadth(&surface->waterline, x);
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
    double slope = (waterline_breadth(&surface->waterline, surface->x0 - dx * a) -
                    waterline_breadth(&surface->waterline, surface->x0 - dx * b)) /
                   (dx * (b - a));
    *place = (struct free_surface_place){.xi = xi,
                                         .eta = fmin(eta, (double)surface->ny),
                                         .eta_x = -slope * (1.0 - s / all) / (stretch * rise),
                                         .eta_y = 1.0 / (stretch * rise)};
    return true;
}

/* Bezier points of the cubic through values at 0, 1/3, 2/3, 1. */
static void bezier(const double value[SIDE], size_t step, double *out, size_t out_step)
{
    double a = value[0], b = value[step], c = value[2 * step], d = value[3 * step];
    out[0] = a;
    out[out_step] = (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0;
    out[2 * out_step] = (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0;
    out[3 * out_step] = d;
}

/* The three quadratic splines that an inner cell sees, in Bernstein polynomials of degree 3, and no
 * fourth. */
static const double quadratic[SIDE * SIDE] = {1.0 / 2, 1.0 / 6, 0.0, 0.0, 1.0 / 2, 5.0 / 6,
                                              5.0 / 6, 1.0 / 2, 0.0, 0.0, 1.0 / 6, 1.0 / 2,
                                              0.0,     0.0,     0.0, 0.0};

static void fill_net(const struct free_surface *surface, size_t i, size_t j, double *net)
{
    double value[SIDE][SIDE], half[SIDE][SIDE], all = surface->offset[2 * surface->ny];
    for (int a = 0; a < SIDE; a++) {
        double x = surface->x0 - surface->dx * ((double)i + a / 3.0);
        double breadth = waterline_breadth(&surface->waterline, x);
        for (int b = 0; b < SIDE; b++) {
            double s = surface->first * series(surface->growth, (double)j + b / 3.0);
            value[a][b] = breadth * (1.0 - s / all) + s;
        }
    }
    for (int a = 0; a < SIDE; a++)
        bezier(value[a], 1, half[a], 1);
    for (int b = 0; b < SIDE; b++) {
        double y[SIDE];
        bezier(&half[0][b], SIDE, y, 1);
        for (int a = 0; a < SIDE; a++) {
            double *h = net + 4 * (a * SIDE + b);
            h[0] = surface->x0 - surface->dx * ((double)i + a / 3.0);
            h[1] = y[a];
            h[2] = 0.0;
            h[3] = 1.0;
        }
    }
}

static void fill_elements(struct free_surface *surface)
{
    struct mesh *mesh = surface->mesh;
    double *net = mesh->storage;
    for (size_t i = 0; i < surface->nx; i++)
        for (size_t j = 0; j < surface->ny; j++, net += 4 * SIDE * SIDE) {
            size_t e = i * surface->ny + j;
            struct element *element = &mesh->element[e];
            *element = (struct element){.degree = {DEGREE, DEGREE},
                                        .upper = {1.0, 1.0},
                                        .extraction = {quadratic, quadratic},
                                        .net = net,
                                        .first = i * surface->columns + j,
                                        .stride = surface->columns,
                                        .sign = 1.0};
            fill_net(surface, i, j, net);
            for (size_t c = 0; c < 3; c++) {
                element->box[0][c] = INFINITY;
                element->box[1][c] = -INFINITY;
                for (size_t k = 0; k < SIDE * SIDE; k++) {
                    element->box[0][c] = fmin(element->box[0][c], net[4 * k + c]);
                    element->box[1][c] = fmax(element->box[1][c], net[4 * k + c]);
                }
            }
            mesh->panel[e] = (struct panel){.first = e, .count = 1, .upper = {1.0, 1.0}};
            struct jet jet;
            element_jet(element, 0.5, 0.5, &jet);
            surface->point[e] = (struct layer_point){
                .at = {jet.s[0], jet.s[1], 0.0}, .homes = 1, .home = {e}, .local = {{0.5, 0.5}}};
        }
}

static struct mesh *empty_mesh(size_t cells)
{
    struct mesh *mesh = calloc(1, sizeof *mesh);
    if (!mesh)
        return NULL;
    *mesh = (struct mesh){.n = cells,
                          .panels = cells,
                          .element = calloc(cells, sizeof *mesh->element),
                          .panel = calloc(cells, sizeof *mesh->panel),
                          .storage = malloc(cells * 4 * SIDE * SIDE * sizeof *mesh->storage),
                          .degree = {DEGREE, DEGREE},
                          .patch_base = calloc(2, sizeof *mesh->patch_base)};
    if (mesh->element && mesh->panel && mesh->storage && mesh->patch_base)
        return mesh;
    mesh_free(mesh);
    return NULL;
}

igabem_status free_surface_create(const struct free_surface_rule *rule, struct waterline *waterline,
                                  struct free_surface **result)
{
    *result = NULL;
    double length = waterline->fore - waterline->aft;
    size_t beside = (size_t)fmax(4.0, round(rule->cells));
    double dx = length / (double)beside, first = rule->first * dx;
    size_t ahead = (size_t)fmax(4.0, round(rule->upstream / dx));
    size_t behind = (size_t)fmax(4.0, round(rule->downstream / dx));
    size_t nx = ahead + beside + behind, ny = (size_t)fmax(4.0, round(rule->rows));
    struct free_surface *surface = calloc(1, sizeof *surface);
    if (!surface) {
        waterline_free(waterline);
        return no_memory(nx * ny);
    }
    *surface = (struct free_surface){.nx = nx,
                                     .ny = ny,
                                     .bow = ahead,
                                     .stern = ahead + beside,
                                     .x0 = waterline->fore + (double)ahead * dx,
                                     .dx = dx,
                                     .first = first,
                                     .growth = growth(rule->side / first, (double)ny),
                                     .waterline = *waterline,
                                     .columns = ny + DEGREE,
                                     .coefficients = (nx + DEGREE) * (ny + DEGREE),
                                     .offset = malloc((2 * ny + 1) * sizeof(double)),
                                     .point = malloc(nx * ny * sizeof(struct layer_point)),
                                     .mesh = empty_mesh(nx * ny)};
    if (!surface->offset || !surface->point || !surface->mesh) {
        free_surface_free(surface);
        return no_memory(nx * ny);
    }
    for (size_t k = 0; k <= 2 * ny; k++)
        surface->offset[k] = first * series(surface->growth, 0.5 * (double)k);
    fill_elements(surface);
    *result = surface;
    return IGABEM_OK;
}

void free_surface_free(struct free_surface *surface)
{
    if (!surface)
        return;
    waterline_free(&surface->waterline);
    mesh_free(surface->mesh);
    free(surface->offset);
    free(surface->point);
    free(surface);
}
