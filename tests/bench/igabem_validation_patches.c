/* Bodies in several patches beside the same in one. */
#include "igabem_validation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 8, DIVISIONS = 4 };

/* Cuts at half the range along and around the body; 0 none. */
static const int divisions[DIVISIONS][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};

struct body {
    nurbs_surface *patch[MOST];
    size_t n;
};

static void demand(int status, const char *why)
{
    if (!status)
        return;
    fprintf(stderr, "igabem_validation: several patches: %s\n", why);
    exit(EXIT_FAILURE);
}

static void cut(struct body *body, size_t first, int direction, double at)
{
    for (size_t k = first, n = body->n; k < n; k++) {
        nurbs_surface *low, *high;
        demand(nurbs_surface_split(body->patch[k], direction, at, &low, &high), nurbs_last_error());
        nurbs_surface_free(body->patch[k]);
        body->patch[k] = low;
        body->patch[body->n++] = high;
    }
}

/* Every other patch is given the other way round. */
static void turn(struct body *body)
{
    for (size_t k = 1; k < body->n; k += 2) {
        nurbs_surface *swapped;
        demand(nurbs_surface_swap(body->patch[k], &swapped), nurbs_last_error());
        nurbs_surface_free(body->patch[k]);
        body->patch[k] = swapped;
    }
}

static void mirror(struct body *body)
{
    const double matrix[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};
    for (size_t k = 0, n = body->n; k < n; k++)
        demand(nurbs_surface_transform(body->patch[k], matrix, NULL, &body->patch[body->n++]),
               nurbs_last_error());
}

/* Consumes the patches. */
static igabem_hull *hull_of(struct body *body, unsigned flags)
{
    igabem_hull *hull;
    turn(body);
    demand(igabem_hull_create((const nurbs_surface *const *)body->patch, body->n, flags, &hull),
           igabem_last_error());
    while (body->n > 0)
        nurbs_surface_free(body->patch[--body->n]);
    return hull;
}

static igabem_forces solve(igabem_hull *hull, double froude, int along, int around)
{
    igabem_options options = at_froude(froude);
    igabem_forces forces;
    options.elements_u = along;
    options.elements_v = around;
    solve_all(hull, 1, &options, &forces);
    igabem_hull_free(hull);
    return forces;
}

static void spheroid_table(void)
{
    static const int meshes[2][2] = {{16, 6}, {24, 8}};
    const double exact = 0.005940084442;
    printf("Spheroid, L/D 6, axis at 0.125 L, Fr 0.5, relative error of C_w against the exact "
           "value; elements along and around the half\nbody.\n\n"
           "| patches | unknowns | 16 x 6 | pressure | unknowns | 24 x 8 | pressure |\n"
           "|---|---|---|---|---|---|---|\n");
    for (int k = 0; k <= DIVISIONS; k++) {
        printf("| %s |", k == 0   ? "1"
                         : k == 1 ? "2 along"
                         : k == 2 ? "2 around"
                         : k == 3 ? "2 x 2"
                                  : "2 x 2, both sides");
        for (int m = 0; m < (k < DIVISIONS ? 2 : 1); m++) {
            struct body body = {.patch = {ellipsoid_surface(1, 1. / 6, 1. / 6, 0.125, 1, 1)}, 1};
            const int *at = divisions[k < DIVISIONS ? k : DIVISIONS - 1];
            if (at[0])
                cut(&body, 0, 0, 0.5);
            if (at[1])
                cut(&body, 0, 1, 0.5);
            if (k == DIVISIONS)
                mirror(&body);
            igabem_forces f = solve(hull_of(&body, k == DIVISIONS ? 0 : IGABEM_SYMMETRIC), 0.5,
                                    meshes[m][0], meshes[m][1]);
            printf(" %zu | %+.1e | %+.1e |", f.dofs, f.cw_l2 / exact - 1,
                   f.cw_pressure / f.cw * (f.cw_l2 / exact) - 1);
        }
        printf(k < DIVISIONS ? "\n" : " - | - | - |\n");
    }
    printf("\n");
}

static void wigley_table(void)
{
    static const int meshes[3][2] = {{12, 4}, {24, 8}, {36, 12}};
    printf(
        "Wigley hull, Fr 0.35: one patch, C_w x 1000 by Kochin function and by pressure; then, in "
        "per cent of that on the same number of\nelements, what changes with patches divided "
        "midships, in depth (the lower strake does not touch the water), and both. The\n"
        "density may jump between patches.\n\n"
        "| elements | one patch | midships | in depth | both | pressure | midships | in depth | "
        "both |\n|---|---|---|---|---|---|---|---|---|\n");
    for (int m = 0; m < 3; m++) {
        double cw[DIVISIONS][2];
        for (int k = 0; k < DIVISIONS; k++) {
            struct body body = {.n = 1};
            demand(nurbs_make_wigley(1, 0.1, 0.0625, &body.patch[0]), nurbs_last_error());
            if (divisions[k][0])
                cut(&body, 0, 0, 0.5);
            if (divisions[k][1])
                cut(&body, 0, 1, 0.5);
            igabem_forces f =
                solve(hull_of(&body, IGABEM_SYMMETRIC), 0.35, meshes[m][0], meshes[m][1]);
            cw[k][0] = f.cw;
            cw[k][1] = f.cw_pressure;
        }
        printf("| %d x %d |", meshes[m][0], meshes[m][1]);
        for (int kind = 0; kind < 2; kind++) {
            printf(" %.4f |", 1000 * cw[0][kind]);
            for (int k = 1; k < DIVISIONS; k++)
                printf(" %+.3f |", 100 * (cw[k][kind] / cw[0][kind] - 1));
        }
        printf("\n");
    }
    printf("\n");
}

/* A wedge from the stem at x = 1 to a triangular transom; its face if closed. */
static void transom_table(void)
{
    static const struct {
        igabem_formulation formulation;
        int closed;
    } rows[5] = {{IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 0},
                 {IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 0},
                 {IGABEM_FORMULATION_NEUMANN_KELVIN_STERN, 1},
                 {IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 1},
                 {IGABEM_FORMULATION_NEUMANN_KELVIN, 1}};
    const double b = 0.05, t = 0.0625, knots[4] = {0, 0, 1, 1};
    const double points[2][12] = {{0, b, 0, 0, 0, -t, 1, 0, 0, 1, 0, -t},
                                  {0, 0, 0, 0, 0, -t, 0, b, 0, 0, 0, -t}};
    printf("Wedge with a triangular transom, B/L 0.1, T/L 0.0625, Fr 0.35, C_w x 1000. A closed "
           "transom is wetted all over and the flow turns\nround its corner, which no ship's does "
           "at this speed.\n\n| transom | formulation | 12 x 4 | 18 x 6 | 24 x 8 |\n"
           "|---|---|---|---|---|\n");
    for (int r = 0; r < 5; r++) {
        printf("| %s | %s |", rows[r].closed ? "closed" : "open",
               igabem_formulation_name(rows[r].formulation));
        for (int m = 2; m <= 4; m++) {
            struct body body = {.n = rows[r].closed ? 2 : 1};
            for (size_t k = 0; k < body.n; k++)
                demand(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots,
                                            knots, points[k], NULL, &body.patch[k]),
                       nurbs_last_error());
            igabem_hull *hull = hull_of(&body, IGABEM_SYMMETRIC);
            igabem_options options = at_froude(0.35);
            igabem_forces forces;
            options.formulation = rows[r].formulation;
            options.elements_u = 6 * m;
            options.elements_v = 2 * m;
            solve_all(hull, 1, &options, &forces);
            igabem_hull_free(hull);
            printf(" %.3f |", 1000 * forces.cw);
        }
        printf("\n");
    }
    printf("\n");
}

void patches_section(void)
{
    printf("## Several patches\n\n");
    spheroid_table();
    wigley_table();
    transom_table();
}
