/* Bodies in several patches: whatever their number, orientation and knots, the solver gives what it
 * gives on one patch, and refuses sets that are no body. */
#include "check.h"
#include "hulls.h"

#include <string.h>

enum { MOST = 16 };

struct body {
    nurbs_surface *patch[MOST];
    size_t n;
};

static struct body body_of(nurbs_surface *surface)
{
    struct body body = {.n = 1};
    CU_ASSERT_PTR_NOT_NULL_FATAL(surface);
    body.patch[0] = surface;
    return body;
}

static struct body wigley(void)
{
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1.0, 0.1, 0.0625, &surface), NURBS_OK);
    return body_of(surface);
}

/* Length 6 diameters, axis at 0.125 L: one of the bodies with an exact resistance. */
static struct body spheroid(void)
{
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(1.0, 1.0 / 6.0, 1.0 / 6.0, 0.125, &surface),
                          NURBS_OK);
    return body_of(surface);
}

static void release(struct body *body)
{
    while (body->n > 0)
        nurbs_surface_free(body->patch[--body->n]);
}

/* Patch k becomes *result, which a call has just created. */
static void replace(struct body *body, size_t k, nurbs_status status, nurbs_surface **result)
{
    CU_ASSERT_EQUAL_FATAL(status, NURBS_OK);
    nurbs_surface_free(body->patch[k]);
    body->patch[k] = *result;
}

/* Cuts patches first ... n-1 at a share of the range of a direction. */
static void cut(struct body *body, size_t first, int direction, double share)
{
    for (size_t k = first, n = body->n; k < n; k++) {
        nurbs_surface *low = NULL, *high = NULL;
        const double *knots = nurbs_surface_knots(body->patch[k], direction);
        double from = knots[0], to = knots[nurbs_surface_size(body->patch[k], direction)];
        nurbs_status status =
            nurbs_surface_split(body->patch[k], direction, from + share * (to - from), &low, &high);
        replace(body, k, status, &low);
        body->patch[body->n++] = high;
    }
}

/* Gives the patches different orientations: reversed in u, in v, u and v exchanged. */
static void turn(struct body *body)
{
    nurbs_surface *result = NULL;
    for (size_t k = 0; k < body->n; k++) {
        if (k % 2)
            replace(body, k, nurbs_surface_swap(body->patch[k], &result), &result);
        if (k % 3 == 1)
            replace(body, k, nurbs_surface_reverse(body->patch[k], 0, &result), &result);
        if (k % 4 == 3)
            replace(body, k, nurbs_surface_reverse(body->patch[k], 1, &result), &result);
    }
}

static void mirror(struct body *body)
{
    const double across[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};
    for (size_t k = 0, n = body->n; k < n; k++)
        CU_ASSERT_EQUAL_FATAL(
            nurbs_surface_transform(body->patch[k], across, NULL, &body->patch[body->n++]),
            NURBS_OK);
}

static igabem_hull *hull_of(const struct body *body, unsigned flags)
{
    igabem_hull *hull = NULL;
    igabem_status status =
        igabem_hull_create((const nurbs_surface *const *)body->patch, body->n, flags, &hull);
    if (status)
        fprintf(stderr, "hull: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    return hull;
}

static igabem_hull_info info_of(const struct body *body, unsigned flags)
{
    igabem_hull *hull = hull_of(body, flags);
    igabem_hull_info info;
    igabem_hull_get_info(hull, &info);
    igabem_hull_free(hull);
    return info;
}

static igabem_options setting(double froude, int along, int around)
{
    igabem_options options;
    igabem_options_init(&options);
    options.refine = 1;
    options.froude = froude;
    options.elements_u = along;
    options.elements_v = around;
    return options;
}

/* Solves and frees the hull. */
static igabem_forces solve(igabem_hull *hull, const igabem_options *options, double *wave_cut)
{
    igabem_solution *solution = NULL;
    igabem_forces forces;
    igabem_status status = igabem_solve(hull, options, &solution);
    if (status)
        fprintf(stderr, "solve: %s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    if (wave_cut)
        CU_ASSERT_EQUAL(igabem_wave_cut(solution, NAN, wave_cut), IGABEM_OK);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    return forces;
}

#ifndef PATCHES_SLOW
static const double pi = 3.14159265358979323846;

static void move(struct body *body, size_t k, double dx, double dy, double dz)
{
    const double shift[3] = {dx, dy, dz};
    nurbs_surface *result = NULL;
    replace(body, k, nurbs_surface_transform(body->patch[k], NULL, shift, &result), &result);
}

/* Depth does not turn a body inside out. */
static void far_below(void)
{
    struct body body = spheroid();
    cut(&body, 0, 0, 0.5);
    cut(&body, 0, 1, 0.5);
    turn(&body);
    for (size_t k = 0; k < body.n; k++)
        move(&body, k, 0, 0, -1e4);
    igabem_hull_info info = info_of(&body, IGABEM_SYMMETRIC);
    CHECK_RELATIVE(info.hydrostatics.volume, 4.0 / 3 * pi * 0.5 / 144, 1e-8);
    igabem_options options = setting(0.5, 4, 4);
    options.kernel = IGABEM_KERNEL_RANKINE;
    igabem_solution *solution = NULL;
    igabem_hull *hull = hull_of(&body, IGABEM_SYMMETRIC);
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    double sigma;
    const double *u = nurbs_surface_knots(body.patch[0], 0),
                 *v = nurbs_surface_knots(body.patch[0], 1);
    CU_ASSERT_EQUAL(
        igabem_source_density(
            solution, 0, 1,
            (const double[2]){u[0], 0.5 * (v[0] + v[nurbs_surface_size(body.patch[0], 1)])},
            &sigma),
        IGABEM_OK);
    CU_ASSERT(sigma < 0); /* a sink at the stern */
    igabem_solution_free(solution);
    igabem_hull_free(hull);
    release(&body);
}

static void check_spheroid(const igabem_hull_info *info)
{
    const double a = 0.5, b = 1.0 / 12.0, e = sqrt(1 - b * b / (a * a));
    const nurbs_hydrostatics *h = &info->hydrostatics;
    CHECK_RELATIVE(h->volume, 4.0 / 3 * pi * a * b * b, 1e-10);
    CHECK_RELATIVE(h->wetted_area, 2 * pi * (b * b + a * b * asin(e) / e), 1e-9);
    CHECK_RELATIVE(h->centroid[2], -0.125, 1e-10);
    CHECK_CLOSE(h->centroid[0], 0.0, 1e-10);
    CHECK_RELATIVE(h->section_area_max, pi * b * b, 1e-8);
    CHECK_RELATIVE(h->draft, 0.125 + b, 1e-9);
    CHECK_RELATIVE(h->beam, 2 * b, 1e-9);
    CU_ASSERT_EQUAL(info->surface_piercing, 0);
    CU_ASSERT_EQUAL(info->transom, IGABEM_TRANSOM_NONE);
}

/* Orientation and number of the patches do not matter; four strips and more meet at the poles. */
static void submerged_particulars(void)
{
    const double cuts[][2] = {{0.5, 0.5}, {0.3, 0.6}, {0.0, 0.4}};
    for (int k = 0; k < 3; k++) {
        struct body body = spheroid();
        if (cuts[k][0] > 0)
            cut(&body, 0, 0, cuts[k][0]);
        cut(&body, 0, 1, cuts[k][1]);
        if (k == 2)
            cut(&body, 0, 1, 0.5);
        turn(&body);
        igabem_hull_info info = info_of(&body, IGABEM_SYMMETRIC);
        CU_ASSERT_EQUAL(info.patches, 4);
        check_spheroid(&info);
        mirror(&body);
        turn(&body);
        info = info_of(&body, 0);
        CU_ASSERT_EQUAL(info.patches, 8);
        check_spheroid(&info);
        release(&body);
    }
}

/* Exact C_w (tests of the spheroid in one patch name the source) within the error of one patch. */
static void submerged_resistance(void)
{
    const double exact = 0.005940084442;
    struct body body = spheroid(), turned;
    cut(&body, 0, 0, 0.5);
    cut(&body, 0, 1, 0.5);
    igabem_options options = setting(0.5, 16, 6), coarse = setting(0.5, 4, 2);
    igabem_forces plain = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    printf("\n    4 patches, %zu unknowns: error %.1e", plain.dofs, plain.cw_l2 / exact - 1);
    CU_ASSERT_EQUAL(plain.dofs, 4 * (8 + 4) * (3 + 4));
    CHECK_RELATIVE(plain.cw_l2, exact, 1e-4);
    CHECK_RELATIVE(plain.cw_pressure, plain.cw, 2e-4);
    turned = body;
    coarse.tolerance = 1e-6;
    igabem_forces half = solve(hull_of(&turned, IGABEM_SYMMETRIC), &coarse, NULL);
    mirror(&turned);
    turn(&turned);
    igabem_forces full = solve(hull_of(&turned, 0), &coarse, NULL);
    CU_ASSERT_EQUAL(full.dofs, 2 * half.dofs);
    CHECK_RELATIVE(full.cw, half.cw, 1e-5);
    CHECK_RELATIVE(full.cw_pressure, half.cw_pressure, 1e-5);
    release(&turned);
}

/* Orientations change nothing but rounding, though points of the waterline then lie above z = 0 by
 * a rounding error or do not. */
static void orientation_does_not_matter(void)
{
    igabem_forces forces[2];
    for (int k = 0; k < 2; k++) {
        struct body body = wigley();
        cut(&body, 0, 0, 0.5);
        cut(&body, 0, 1, 0.4);
        if (k)
            turn(&body);
        igabem_options options = setting(0.35, 8, 4);
        forces[k] = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
        release(&body);
    }
    CHECK_RELATIVE(forces[1].cw, forces[0].cw, 1e-8);
    CHECK_RELATIVE(forces[1].cw_pressure, forces[0].cw_pressure, 1e-8);
}

/* Elements stated for the hull fall to the patches by length, along and around, whatever u and v
 * are; without a number each patch keeps its knots. */
static void elements_are_shared(void)
{
    struct body body = wigley();
    cut(&body, 0, 0, 0.25);
    cut(&body, 0, 1, 0.5);
    turn(&body);
    igabem_options options = setting(0.35, 8, 4);
    options.formulation = IGABEM_FORMULATION_HOGNER;
    igabem_forces forces = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    CU_ASSERT_EQUAL(forces.dofs, 2 * (2 + 3) * (2 + 3) + 2 * (6 + 3) * (2 + 3));
    options.refine = 2;
    options.refine_v = 1;
    forces = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    CU_ASSERT_EQUAL(forces.dofs, 2 * (4 + 3) * (2 + 3) + 2 * (12 + 3) * (2 + 3));
    options.elements_u = options.elements_v = 0;
    options.degree = 4;
    forces = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    CU_ASSERT_EQUAL(forces.dofs, 4 * (2 * 1 + 2 + 2) * (1 + 4));
    release(&body);
}

static nurbs_surface *bilinear(const double a[3], const double b[3], const double c[3],
                               const double d[3])
{
    const double knots[4] = {0, 0, 1, 1};
    double points[12];
    nurbs_surface *surface = NULL;
    for (int k = 0; k < 3; k++) {
        points[k] = a[k];
        points[3 + k] = b[k];
        points[6 + k] = c[k];
        points[9 + k] = d[k];
    }
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2}, knots,
                                               knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

/* A box that narrows to the stem: wall, and flat bottom whose fore edge is a point. Then the wall
 * in two triangles, of which one has an edge of no length on the waterline. The bottom has no n_y:
 * its neighbours turn it. */
static void triangles(void)
{
    const double b = 0.05, t = 0.0625, top[3] = {0, b, 0}, chine[3] = {0, b, -t},
                 stem[3] = {1, 0, 0}, foot[3] = {1, 0, -t}, keel[3] = {0, 0, -t};
    igabem_forces forces[2];
    for (int k = 0; k < 2; k++) {
        struct body body = {.n = 2};
        body.patch[0] = bilinear(chine, keel, foot, foot);
        body.patch[1] = k ? bilinear(top, top, chine, foot) : bilinear(top, chine, stem, foot);
        if (k)
            body.patch[body.n++] = bilinear(top, stem, top, foot);
        igabem_hull_info info = info_of(&body, IGABEM_SYMMETRIC);
        CHECK_RELATIVE(info.hydrostatics.volume, b * t, 1e-10);
        CHECK_RELATIVE(info.hydrostatics.wetted_area, 2 * t * sqrt(1 + b * b) + b, 1e-10);
        CHECK_RELATIVE(info.hydrostatics.waterplane_area, b, 1e-10);
        CHECK_RELATIVE(info.hydrostatics.transom_area, 2 * b * t, 1e-10);
        CHECK_RELATIVE(info.nu_s, b / sqrt(1 + b * b), 1e-9);
        CU_ASSERT_EQUAL(info.transom, IGABEM_TRANSOM_OPEN);
        igabem_options options = setting(0.35, 12, 6);
        forces[k] = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
        release(&body);
    }
    printf("\n    C_w differs by %.1e", forces[1].cw / forces[0].cw - 1);
    CHECK_RELATIVE(forces[1].cw, forces[0].cw, 0.03);
}

static void expect_refusal(const struct body *body, unsigned flags, const char *words)
{
    igabem_hull *hull = (igabem_hull *)1;
    CU_ASSERT_EQUAL(
        igabem_hull_create((const nurbs_surface *const *)body->patch, body->n, flags, &hull),
        IGABEM_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NULL(hull);
    if (!strstr(igabem_last_error(), words))
        fprintf(stderr, "expected '%s' in: %s\n", words, igabem_last_error());
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), words));
}

/* A band of bilinear patches closed after half a turn, deep in the water on one side. */
static struct body moebius(void)
{
    enum { PARTS = 5 };
    const double knots[4] = {0, 0, 1, 1};
    struct body body = {.n = PARTS};
    for (int k = 0; k < PARTS; k++) {
        double points[12];
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                double *p = points + 6 * i + 3 * j, angle = 2 * pi * (k + i) / PARTS,
                       r = 1 + 0.3 * (2 * j - 1) * cos(angle / 2);
                p[0] = r * cos(angle);
                p[1] = 2 + r * sin(angle);
                p[2] = -1 + 0.3 * (2 * j - 1) * sin(angle / 2);
            }
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2},
                                                   knots, knots, points, NULL, &body.patch[k]),
                              NURBS_OK);
    }
    return body;
}

static void refuses_what_is_no_body(void)
{
    struct body gap = wigley();
    cut(&gap, 0, 0, 0.5);
    move(&gap, 1, 1e-3, 0, 0);
    expect_refusal(&gap, IGABEM_SYMMETRIC, "open at");
    release(&gap);

    struct body band = moebius();
    expect_refusal(&band, IGABEM_SYMMETRIC, "no orientation");
    release(&band);

    struct body twice = spheroid();
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_copy(twice.patch[0], &twice.patch[twice.n++]), NURBS_OK);
    expect_refusal(&twice, IGABEM_SYMMETRIC, "no volume");
    release(&twice);

    struct body part_twice = wigley();
    cut(&part_twice, 0, 0, 0.5);
    CU_ASSERT_EQUAL_FATAL(
        nurbs_surface_copy(part_twice.patch[1], &part_twice.patch[part_twice.n++]), NURBS_OK);
    expect_refusal(&part_twice, IGABEM_SYMMETRIC, "patches 1 and 2");
    release(&part_twice);

    /* The upper strake reaches below the upper edge of the lower one. */
    struct body overlapping = wigley(), lower = wigley();
    cut(&overlapping, 0, 1, 0.6);
    cut(&lower, 0, 1, 0.4);
    nurbs_surface_free(overlapping.patch[1]);
    overlapping.patch[1] = lower.patch[1];
    lower.n = 1;
    expect_refusal(&overlapping, IGABEM_SYMMETRIC, "open at");
    release(&overlapping);
    release(&lower);

    /* A second body in the first one; beside it, and ahead, is another matter. */
    for (int k = 0; k < 3; k++) {
        struct body two = wigley(), bulb = spheroid();
        const double small[9] = {0.2, 0, 0, 0, 0.2, 0, 0, 0, 0.2};
        nurbs_surface *result = NULL;
        replace(&bulb, 0, nurbs_surface_transform(bulb.patch[0], small, NULL, &result), &result);
        cut(&two, 0, 0, 0.5);
        two.patch[two.n++] = bulb.patch[0];
        move(&two, 2, k == 1 ? 0.65 : 0.4, 0, k == 2 ? -0.08 : 0);
        if (k == 0)
            expect_refusal(&two, IGABEM_SYMMETRIC, "patch 2 reaches into the body");
        else
            CU_ASSERT_EQUAL(info_of(&two, IGABEM_SYMMETRIC).patches, 3);
        release(&two);
    }
}

#else
/* The density has other knots on either side of every edge. */
static void knots_differ_across_edges(void)
{
    const int parts[4] = {4, 6, 5, 5};
    struct body body = spheroid();
    cut(&body, 0, 0, 0.45);
    cut(&body, 0, 1, 0.55);
    for (size_t k = 0; k < 4; k++) {
        nurbs_surface *result = NULL;
        replace(&body, k, nurbs_surface_refine(body.patch[k], parts[k], &result), &result);
    }
    turn(&body);
    igabem_options options = setting(0.5, 0, 0);
    igabem_forces forces = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    printf("\n    %zu unknowns: error %.1e", forces.dofs, forces.cw_l2 / 0.005940084442 - 1);
    CHECK_RELATIVE(forces.cw_l2, 0.005940084442, 1e-4);
    release(&body);
}

static double largest_difference(const igabem_forces *a, const igabem_forces *b)
{
    double pairs[4][2] = {{a->cw, b->cw},
                          {a->cw_pressure, b->cw_pressure},
                          {a->sinkage, b->sinkage},
                          {a->trim, b->trim}};
    double largest = 0.0;
    for (int k = 0; k < 4; k++)
        largest = fmax(largest, fabs(pairs[k][0] / pairs[k][1] - 1));
    return largest;
}

/* Midships, in depth (the lower strake does not touch the water), both: the density may jump at
 * the edges, so figures agree to the error of the mesh. */
static void surface_piercing(void)
{
    const int meshes[2][2] = {{12, 4}, {24, 8}};
    struct body one = wigley();
    igabem_forces whole[2];
    double wave_cut[2];
    for (int m = 0; m < 2; m++) {
        igabem_options options = setting(0.35, meshes[m][0], meshes[m][1]);
        whole[m] = solve(hull_of(&one, IGABEM_SYMMETRIC), &options, m ? &wave_cut[0] : NULL);
    }
    double change = largest_difference(&whole[0], &whole[1]);
    release(&one);
    for (int split = 1; split <= 3; split++) {
        struct body body = wigley();
        if (split & 1)
            cut(&body, 0, 0, 0.5);
        if (split & 2)
            cut(&body, 0, 1, 0.5);
        turn(&body);
        igabem_hull_info info = info_of(&body, IGABEM_SYMMETRIC);
        CHECK_RELATIVE(info.hydrostatics.volume, 4 * 0.1 * 0.0625 / 9, 1e-12);
        CHECK_RELATIVE(info.hydrostatics.wetted_area, 0.1487906310, 1e-9);
        CHECK_RELATIVE(info.hydrostatics.waterplane_area, 2 * 0.1 / 3, 1e-12);
        CHECK_RELATIVE(info.hydrostatics.section_area_max, 2.0 / 3 * 0.1 * 0.0625, 1e-9);
        CHECK_RELATIVE(info.nu_s, 0.2 / sqrt(1.04), 1e-9);
        double difference[2];
        for (int m = 0; m < 2; m++) {
            igabem_options options = setting(0.35, meshes[m][0], meshes[m][1]);
            igabem_forces forces = solve(hull_of(&body, IGABEM_SYMMETRIC), &options,
                                         m == 1 && split == 3 ? &wave_cut[1] : NULL);
            difference[m] = largest_difference(&forces, &whole[m]);
        }
        printf("\n    %zu patches: difference %.1e, %.1e; of the meshes %.1e", body.n,
               difference[0], difference[1], change);
        CU_ASSERT(difference[0] < 1.5 * change);
        CU_ASSERT(difference[1] < 0.05 * change);
        CU_ASSERT(difference[1] < 1e-3);
        if (split == 3)
            CHECK_RELATIVE(wave_cut[1], wave_cut[0], 1e-3);
        if (split & 1)
            CU_ASSERT(difference[1] < 0.1 * difference[0]);
        release(&body);
    }
}

/* Both sides as patches, each cut midships and in depth, beside the half hull. */
static void both_sides(void)
{
    struct body body = wigley();
    cut(&body, 0, 0, 0.5);
    cut(&body, 0, 1, 0.5);
    igabem_options options = setting(0.35, 12, 4);
    double wave_cut[2];
    igabem_forces half = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, &wave_cut[0]);
    mirror(&body);
    turn(&body);
    igabem_hull_info info = info_of(&body, 0);
    CHECK_RELATIVE(info.hydrostatics.volume, 4 * 0.1 * 0.0625 / 9, 1e-12);
    CHECK_RELATIVE(info.hydrostatics.waterplane_area, 2 * 0.1 / 3, 1e-12);
    CHECK_RELATIVE(info.hydrostatics.waterplane_inertia_y, 0.1 * 0.125 * 4.0 / 15, 1e-10);
    CHECK_RELATIVE(info.hydrostatics.beam, 0.1, 1e-9);
    igabem_forces whole = solve(hull_of(&body, 0), &options, &wave_cut[1]);
    printf("\n    difference %.1e, of the wave cuts %.1e", largest_difference(&whole, &half),
           wave_cut[1] / wave_cut[0] - 1);
    CU_ASSERT_EQUAL(whole.dofs, 2 * half.dofs);
    CU_ASSERT(largest_difference(&whole, &half) < 1e-4);
    CHECK_RELATIVE(wave_cut[1], wave_cut[0], 1e-3);
    release(&body);
}

/* The fore body of a bulbous hull in two patches, one with the bulb, behind them one patch for the
 * rest: beside the hull in one patch, within what its mesh changes. */
static void bulb_of_its_own(void)
{
    nurbs_patches *file = NULL;
    nurbs_surface *surface = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_read(EXAMPLES_DIR "/hulls/bulb.json", &file), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_copy(nurbs_patches_get(file, 0), &surface), NURBS_OK);
    nurbs_patches_free(file);
    struct body body = body_of(surface);
    igabem_options options = setting(0.3, 24, 8);
    igabem_hull_info one = info_of(&body, IGABEM_SYMMETRIC);
    igabem_forces whole = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    cut(&body, 0, 0, 0.9);
    cut(&body, 1, 1, 0.5);
    CU_ASSERT_EQUAL_FATAL(body.n, 3);
    turn(&body);
    igabem_hull_info three = info_of(&body, IGABEM_SYMMETRIC);
    CHECK_RELATIVE(three.hydrostatics.volume, one.hydrostatics.volume, 1e-9);
    CHECK_RELATIVE(three.hydrostatics.wetted_area, one.hydrostatics.wetted_area, 1e-9);
    CHECK_RELATIVE(three.hydrostatics.transom_area, one.hydrostatics.transom_area, 1e-9);
    CHECK_RELATIVE(three.nu_s, one.nu_s, 1e-4);
    CU_ASSERT_EQUAL(three.transom, IGABEM_TRANSOM_OPEN);
    igabem_forces parts = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    printf("\n    C_w differs by %.1e, sinkage by %.1e", parts.cw / whole.cw - 1,
           parts.sinkage / whole.sinkage - 1);
    CHECK_RELATIVE(parts.cw, whole.cw, 1e-2);
    CHECK_RELATIVE(parts.sinkage, whole.sinkage, 1e-2);
    release(&body);
}

/* A seam of one patch meets two others in its course. */
static void hanging_node(void)
{
    struct body body = wigley(), one = wigley();
    cut(&body, 0, 0, 0.4);
    cut(&body, 1, 1, 0.3);
    CU_ASSERT_EQUAL_FATAL(body.n, 3);
    turn(&body);
    igabem_hull_info info = info_of(&body, IGABEM_SYMMETRIC);
    CHECK_RELATIVE(info.hydrostatics.volume, 4 * 0.1 * 0.0625 / 9, 1e-12);
    igabem_options options = setting(0.35, 20, 6);
    igabem_forces a = solve(hull_of(&one, IGABEM_SYMMETRIC), &options, NULL),
                  b = solve(hull_of(&body, IGABEM_SYMMETRIC), &options, NULL);
    printf("\n    difference %.1e", largest_difference(&b, &a));
    CU_ASSERT(largest_difference(&b, &a) < 5e-3);
    release(&one);
    release(&body);
}

#endif

static const struct check_case cases[] = {
#ifndef PATCHES_SLOW
    {"particulars of a submerged body in 4 and 8 patches", submerged_particulars},
    {"far below the water", far_below},
    {"exact resistance in 4 patches, 8 like 4", submerged_resistance},
    {"orientation of the patches", orientation_does_not_matter},
    {"elements shared among the patches", elements_are_shared},
    {"triangles, a point on the waterline", triangles},
    {"refuses what is no body", refuses_what_is_no_body},
#else
    {"knots differ across edges", knots_differ_across_edges},
    {"surface-piercing hull against one patch", surface_piercing},
    {"whole hull beside the half", both_sides},
    {"bulb as a patch of its own", bulb_of_its_own},
    {"hanging node", hanging_node},
#endif
};

CHECK_MAIN("patches", cases)
