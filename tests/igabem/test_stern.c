/* Sterns: open, and closed by a flat patch. Both are the same ship to hydrostatics and to the
 * rules; what flows past them is not the same. */
#include "check.h"
#include "hulls.h"

static const double half_breadth = 0.05, draft = 0.0625;

/* The face that closes the wedge, its lower end `rake` further forward. */
static nurbs_surface *face(double rake)
{
    const double knots[4] = {0, 0, 1, 1};
    const double points[12] = {0, 0, 0, rake, 0, -draft, 0, half_breadth, 0, rake, 0, -draft};
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots,
                                               knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

/* The side of the wedge, with its stern raked likewise. */
static nurbs_surface *side(double rake)
{
    const double knots[4] = {0, 0, 1, 1};
    const double points[12] = {0, half_breadth, 0, rake, 0, -draft, 1, 0, 0, 1, 0, -draft};
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots,
                                               knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

static igabem_hull *wedge(double rake, int closed, int both_sides)
{
    const double mirror[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};
    nurbs_surface *patch[4] = {side(rake), closed ? face(rake) : NULL, NULL, NULL};
    size_t n = closed ? 2 : 1;
    for (size_t k = 0, half = n; k < half && both_sides; k++)
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(patch[k], mirror, NULL, &patch[n++]),
                              NURBS_OK);
    igabem_hull *hull = NULL;
    igabem_status status = igabem_hull_create((const nurbs_surface *const *)patch, n,
                                              both_sides ? 0 : IGABEM_SYMMETRIC, &hull);
    if (status)
        fprintf(stderr, "hull: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    for (size_t k = 0; k < n; k++)
        nurbs_surface_free(patch[k]);
    return hull;
}

/* V = L b T/2 less what the rake takes, A_T = b T; the face belongs to A_T, not to S. */
static void particulars(void)
{
    for (int k = 0; k < 4; k++) {
        double rake = k % 2 ? 0.02 : 0.0;
        igabem_hull *open = wedge(rake, 0, 0), *closed = wedge(rake, 1, k / 2);
        igabem_hull_info a, b;
        igabem_hull_get_info(open, &a);
        igabem_hull_get_info(closed, &b);
        CU_ASSERT_EQUAL(a.transom, IGABEM_TRANSOM_OPEN);
        CU_ASSERT_EQUAL(b.transom, IGABEM_TRANSOM_CLOSED);
        CU_ASSERT_EQUAL(b.surface_piercing, 1);
        CHECK_RELATIVE(b.hydrostatics.transom_area, half_breadth * draft, 1e-10);
        CHECK_RELATIVE(b.hydrostatics.volume, half_breadth * draft * (0.5 - rake / 6.0), 1e-10);
        CHECK_RELATIVE(b.hydrostatics.waterplane_area, half_breadth, 1e-12);
        CHECK_RELATIVE(b.hydrostatics.volume, a.hydrostatics.volume, 1e-12);
        CHECK_RELATIVE(b.hydrostatics.wetted_area, a.hydrostatics.wetted_area, 1e-9);
        CHECK_RELATIVE(b.hydrostatics.centroid[0], a.hydrostatics.centroid[0], 1e-10);
        CHECK_RELATIVE(b.hydrostatics.section_area_max, a.hydrostatics.section_area_max, 1e-6);
        CHECK_RELATIVE(b.nu_s, half_breadth / sqrt(1 + half_breadth * half_breadth), 1e-9);
        CHECK_RELATIVE(b.length, 1.0, 1e-12);
        igabem_options options;
        igabem_options_init(&options);
        options.refine = 1;
        options.froude = 0.35;
        CU_ASSERT_EQUAL(igabem_options_freeze(closed, &options), IGABEM_OK);
        CU_ASSERT_EQUAL(options.formulation, IGABEM_FORMULATION_NEUMANN_KELVIN_STERN);
        CHECK_RELATIVE(options.stem_limit, 1.2 * b.nu_s, 1e-12);
        igabem_hull_free(open);
        igabem_hull_free(closed);
    }
}

static igabem_forces solve(int closed, igabem_formulation formulation, int along, int around)
{
    igabem_hull *hull = wedge(0.0, closed, 0);
    igabem_options options;
    igabem_solution *solution = NULL;
    igabem_forces forces;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = 0.35;
    options.elements_u = along;
    options.elements_v = around;
    options.formulation = formulation;
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    return forces;
}

/* The rows of the face lie aft of x_s and see the double-body kernel: C_w settles with the mesh, at
 * a hundred times that of the open stern, and plain Neumann-Kelvin gives several times as much
 * again. A dry transom adds its hydrostatic pressure, which only an open one lacks. */
static void flow(void)
{
    igabem_forces coarse = solve(1, IGABEM_FORMULATION_AUTO, 12, 4),
                  fine = solve(1, IGABEM_FORMULATION_AUTO, 18, 6);
    igabem_forces body = solve(1, IGABEM_FORMULATION_DOUBLE_BODY_KOCHIN, 12, 4),
                  plain = solve(1, IGABEM_FORMULATION_NEUMANN_KELVIN, 12, 4),
                  open = solve(0, IGABEM_FORMULATION_AUTO, 12, 4);
    printf("\n    closed %.3e, %.3e; double body %.3e, neumann-kelvin %.3e; open %.3e", coarse.cw,
           fine.cw, body.cw, plain.cw, open.cw);
    CHECK_RELATIVE(fine.cw, coarse.cw, 0.06);
    CHECK_RELATIVE(coarse.cw, body.cw, 0.02);
    CU_ASSERT(plain.cw > 4 * coarse.cw);
    CU_ASSERT(coarse.cw > 50 * open.cw);
    CU_ASSERT(isnan(coarse.cw_transom));
    /* -(g/(U^2/2 S)) Int z n_x dS = g A_T T/3 / (U^2 S/2) for the triangle. */
    double speed = 0.35 * sqrt(9.80665);
    CHECK_RELATIVE(open.cw_transom,
                   9.80665 * half_breadth * draft * draft / 3 /
                       (0.5 * speed * speed * open.wetted_area),
                   1e-3);
}

static const struct check_case cases[] = {
    {"particulars of open and closed transoms", particulars},
    {"flow past open and closed transoms", flow},
};

CHECK_MAIN("stern", cases)
