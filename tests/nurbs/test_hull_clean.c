/* Wigley hulls as they come out of CAD systems: faces that are no hull, either half, any direction
 * of the parameter lines, several patches; y = B/2 (1 - (2x/L)^2) (1 - (z/T)^2), so that volume,
 * area and waterplane are known. */
#include "check.h"
#include "hulls.h"

#include <string.h>

static const double L = 10, B = 1, T = 0.625;
static const double pi = 3.14159265358979323846;
static const double volume = 2.7777777777777778, area = 14.879063; /* 4/9 L B T; quadrature */

/* A point at x, z: above z = 0 the sides are upright. */
static void wigley(double x, double z, double p[3])
{
    double depth = fmin(z, 0) / T;
    p[0] = x;
    p[1] = 0.5 * B * (1 - 4 * x * x / L / L) * (1 - depth * depth);
    p[2] = z;
}

/* Sections from z = top(x) to z = bottom(x), skinned. */
static nurbs_surface *skinned(double (*top)(double), double (*bottom)(double))
{
    enum { ROWS = 41, COLUMNS = 25 };
    nurbs_grid *grid;
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, NULL, &grid), NURBS_OK);
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double x = L * (i / (ROWS - 1.0) - 0.5), s = j / (COLUMNS - 1.0);
            wigley(x, (1 - s) * top(x) + s * bottom(x),
                   nurbs_grid_edit(grid) + 3 * (i * COLUMNS + j));
        }
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, NULL, &surface), NURBS_OK);
    nurbs_grid_free(grid);
    return surface;
}

static double water(double x)
{
    (void)x;
    return 0;
}

static double above(double x)
{
    (void)x;
    return 0.35;
}

static double keel(double x)
{
    (void)x;
    return -T;
}

/* Through the water amidships. */
static double sloping(double x)
{
    return 0.02 * x;
}

/* Dives and comes up twice. */
static double wavy(double x)
{
    return 0.1 * cos(0.3 * x * pi);
}

static nurbs_surface *bilinear(const double points[12])
{
    const int degree[2] = {1, 1};
    const size_t size[2] = {2, 2};
    const double knots[4] = {0, 0, 1, 1};
    nurbs_surface *surface;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create(degree, size, knots, knots, points, NULL, &surface),
                          NURBS_OK);
    return surface;
}

static nurbs_surface *plane(double x0, double x1, double y0, double y1, double z0, double z1)
{
    return bilinear((const double[]){x0, y0, z0, x0, y1, z1, x1, y0, z0, x1, y1, z1});
}

static nurbs_surface *copied(const nurbs_surface *surface)
{
    nurbs_surface *copy;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_copy(surface, &copy), NURBS_OK);
    return copy;
}

/* Takes the surfaces. */
static nurbs_status hull_of(size_t n, nurbs_surface **surfaces, nurbs_hull **hull)
{
    nurbs_status status =
        nurbs_hull_create_surfaces(n, (const nurbs_surface *const *)surfaces, NULL, hull);
    for (size_t k = 0; k < n; k++)
        nurbs_surface_free(surfaces[k]);
    return status;
}

static bool tells(const nurbs_hull *hull, const char *words)
{
    const char *step;
    for (size_t k = 1; (step = nurbs_hull_step(hull, k)); k++)
        if (strstr(step, words))
            return true;
    return false;
}

/* Takes the surfaces; the hull is that of the formula, and the report holds the words. */
static void is_the_wigley_hull(size_t n, nurbs_surface **surfaces, const char *words)
{
    nurbs_hull *hull = NULL;
    if (hull_of(n, surfaces, &hull) != NURBS_OK)
        fprintf(stderr, "%s\n", nurbs_last_error());
    CU_ASSERT_PTR_NOT_NULL_FATAL(hull);
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(hull);
    CHECK_RELATIVE(h->volume, volume, 1e-4);
    CHECK_RELATIVE(h->wetted_area, area, 1e-4);
    CHECK_RELATIVE(h->waterplane_area, 2.0 / 3 * L * B, 1e-4);
    CHECK_RELATIVE(h->beam, B, 1e-3);
    CU_ASSERT(nurbs_hull_is_half(hull));
    CU_ASSERT_EQUAL(nurbs_hull_step(hull, 1) != NULL, words != NULL);
    CU_ASSERT(!words || tells(hull, words));
    nurbs_hull_free(hull);
}

static void is_refused(size_t n, nurbs_surface **surfaces, const char *words)
{
    nurbs_hull *hull = NULL;
    CU_ASSERT_EQUAL(hull_of(n, surfaces, &hull), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NULL(hull);
    if (!strstr(nurbs_last_error(), words))
        fprintf(stderr, "'%s' does not say '%s'\n", nurbs_last_error(), words);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), words));
}

static void leaves_out_what_is_no_hull(void)
{
    is_the_wigley_hull(2, (nurbs_surface *[]){skinned(above, keel), plane(-5, 5, 0, 0, 0.35, -T)},
                       "patch 1: in the centre plane");
    is_the_wigley_hull(2, (nurbs_surface *[]){skinned(water, keel), plane(-5, 5, 0, 0.5, 0, 0)},
                       "patch 1: level");
    is_the_wigley_hull(3,
                       (nurbs_surface *[]){plane(-5, 5, -0.5, 0.5, 0.35, 0.35),
                                           skinned(above, water), skinned(water, keel)},
                       "patch 0: level");
    is_refused(1, (nurbs_surface *[]){plane(-5, 5, 0, 0, 0, -T)}, "there is no hull");
}

/* y = (1 - x) (1 + z) below the water and upright above: a wedge of 1 m with a flat stern. */
static void leaves_out_the_transom(void)
{
    nurbs_surface *side =
                      bilinear((const double[]){0, 0.1, 0.1, 0, 0, -0.1, 1, 0, 0.1, 1, 0, -0.1}),
                  *face =
                      bilinear((const double[]){0, 0, 0.1, 0, 0.1, 0.1, 0, 0, -0.1, 0, 0, -0.1}),
                  *turned;
    nurbs_hull *hull = NULL;
    const double x_back[9] = {-1, 0, 0, 0, 1, 0, 0, 0, 1};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(side, x_back, NULL, &turned), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(hull_of(2, (nurbs_surface *[]){side, face}, &hull), NURBS_OK);
    CU_ASSERT(tells(hull, "patch 1: a flat face across the stern"));
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume, 0.0025, 1e-7);
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->transom_area, 0.005, 1e-7);
    nurbs_hull_free(hull);
    /* The same with the bow at small x. */
    CU_ASSERT_EQUAL_FATAL(hull_of(1, (nurbs_surface *[]){turned}, &hull), NURBS_OK);
    CU_ASSERT(tells(hull, "x turned to -1 m - x"));
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->volume, 0.0025, 1e-7);
    CHECK_CLOSE(nurbs_hull_hydrostatics(hull)->centroid[0], -2.0 / 3, 1e-6);
    nurbs_hull_free(hull);
}

/* The same stern closed by two faces, the lower one wholly in the water. */
static void leaves_out_a_transom_in_pieces(void)
{
    nurbs_surface *hull_and_faces[3] = {
        bilinear((const double[]){0, 0.1, 0.1, 0, 0, -0.1, 1, 0, 0.1, 1, 0, -0.1}),
        bilinear((const double[]){0, 0, 0.1, 0, 0.1, 0.1, 0, 0, -0.04, 0, 0.03, -0.04}),
        bilinear((const double[]){0, 0, -0.04, 0, 0.03, -0.04, 0, 0, -0.1, 0, 0, -0.1})};
    nurbs_hull *open = NULL, *closed = NULL;
    nurbs_surface *side = copied(hull_and_faces[0]);
    CU_ASSERT_EQUAL_FATAL(hull_of(1, &side, &open), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(hull_of(3, hull_and_faces, &closed), NURBS_OK);
    CU_ASSERT(tells(closed, "patches 1, 2: a flat face across the stern"));
    CHECK_CLOSE(nurbs_hull_hydrostatics(closed)->wetted_area,
                nurbs_hull_hydrostatics(open)->wetted_area, 1e-12);
    CHECK_CLOSE(nurbs_hull_hydrostatics(closed)->transom_area, 0.005, 1e-7);
    nurbs_hull_free(open);
    nurbs_hull_free(closed);
}

static void any_direction_of_the_parameter_lines(void)
{
    for (int way = 0; way < 8; way++) {
        nurbs_surface *hull = skinned(above, keel), *next;
        for (int d = 0; d < 2; d++) {
            if (!(way & (1 << d)))
                continue;
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_reverse(hull, d, &next), NURBS_OK);
            nurbs_surface_free(hull);
            hull = next;
        }
        if (way & 4) {
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_swap(hull, &next), NURBS_OK);
            nurbs_surface_free(hull);
            hull = next;
        }
        is_the_wigley_hull(1, &hull, NULL);
    }
}

static void upper_edge_within_micrometres(void)
{
    for (double off = -4e-6; off < 5e-6; off += 8e-6) {
        nurbs_surface *hull = skinned(water, keel), *moved;
        const double shift[3] = {0, 0, off};
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(hull, NULL, shift, &moved), NURBS_OK);
        nurbs_surface_free(hull);
        is_the_wigley_hull(1, &moved, NULL);
    }
}

static void seams_through_the_water(void)
{
    is_the_wigley_hull(2, (nurbs_surface *[]){skinned(sloping, keel), skinned(above, sloping)},
                       NULL);
    is_the_wigley_hull(2, (nurbs_surface *[]){skinned(wavy, keel), skinned(above, wavy)}, NULL);
}

static nurbs_surface *mirrored(nurbs_surface *surface)
{
    const double matrix[9] = {1, 0, 0, 0, -1, 0, 0, 0, 1};
    nurbs_surface *image;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(surface, matrix, NULL, &image), NURBS_OK);
    nurbs_surface_free(surface);
    return image;
}

/* Elliptic sections from the water on one side round the keel to the water on the other: the keel
 * is a parameter line without skew. */
static nurbs_surface *both_sides(double skew)
{
    enum { ROWS = 41, COLUMNS = 49 };
    nurbs_grid *grid;
    nurbs_surface *surface;
    nurbs_skin_options options;
    CU_ASSERT_EQUAL_FATAL(nurbs_grid_create(ROWS, COLUMNS, NULL, &grid), NURBS_OK);
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double x = L * (i / (ROWS - 1.0) - 0.5), s = j / (COLUMNS - 1.0) * 2 - 1;
            double *p = nurbs_grid_edit(grid) + 3 * (i * COLUMNS + j);
            s += skew * x / L * (1 - s * s);
            p[0] = x;
            p[1] = 0.5 * B * (1 - 4 * x * x / L / L) * sin(0.5 * pi * s);
            p[2] = fabs(s) == 1 ? 0 : -T * cos(0.5 * pi * s);
        }
    nurbs_skin_options_init(&options);
    options.parametrize = NURBS_PARAMETRIZATION_UNIFORM;
    CU_ASSERT_EQUAL_FATAL(nurbs_skin(grid, &options, &surface), NURBS_OK);
    nurbs_grid_free(grid);
    return surface;
}

static void either_half_or_both_in_one(void)
{
    is_the_wigley_hull(1, (nurbs_surface *[]){mirrored(skinned(above, keel))},
                       "starboard half: mirrored");
    nurbs_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(hull_of(1, (nurbs_surface *[]){both_sides(0)}, &hull), NURBS_OK);
    CU_ASSERT(nurbs_hull_is_half(hull) && tells(hull, "port half is taken"));
    CHECK_RELATIVE(nurbs_hull_hydrostatics(hull)->volume, pi / 4 * 2 / 3 * L * B * T, 1e-4);
    CHECK_RELATIVE(nurbs_hull_hydrostatics(hull)->waterplane_area, 2.0 / 3 * L * B, 1e-4);
    nurbs_hull_free(hull);
    is_refused(1, (nurbs_surface *[]){both_sides(0.1)}, "patch 0: it runs across the centre plane");
    nurbs_surface *whole = both_sides(0), *moved;
    const double shift[3] = {0, 0.05, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(whole, NULL, shift, &moved), NURBS_OK);
    nurbs_surface_free(whole);
    is_refused(1, &moved, "patch 0: it runs across the centre plane");
    is_refused(2, (nurbs_surface *[]){both_sides(0), mirrored(skinned(above, keel))},
               "share an edge in the still water");
    is_refused(
        3, (nurbs_surface *[]){both_sides(0), skinned(above, keel), mirrored(skinned(water, keel))},
        "no mirror images");
}

/* The side divided into four. */
static void quarters(nurbs_surface *part[4])
{
    nurbs_surface *hull = skinned(water, keel), *half[2];
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(hull, 0, 0.4, &half[0], &half[1]), NURBS_OK);
    for (int k = 0; k < 2; k++) {
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(half[k], 1, 0.5, &part[2 * k], &part[2 * k + 1]),
                              NURBS_OK);
        nurbs_surface_free(half[k]);
    }
    nurbs_surface_free(hull);
}

static void missing_and_doubled_patches_are_refused(void)
{
    nurbs_surface *part[5];
    quarters(part);
    is_the_wigley_hull(4, part, NULL);
    for (int missing = 0; missing < 4; missing++) {
        quarters(part);
        nurbs_surface_free(part[missing]);
        part[missing] = part[3];
        is_refused(3, part, "open at");
    }
    for (int twice = 0; twice < 4; twice++) {
        quarters(part);
        part[4] = copied(part[twice]);
        is_refused(5, part, "lies on another one");
    }
    /* A patch that reaches over its neighbour. */
    quarters(part);
    nurbs_surface_free(part[1]);
    nurbs_surface *hull = skinned(water, keel);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_part(hull, 0, 0, 0.7, &part[1]), NURBS_OK);
    nurbs_surface_free(hull);
    is_refused(4, part, "lies on another one");
}

static void half_off_the_centre_plane_is_refused(void)
{
    nurbs_surface *hull = skinned(above, keel), *moved;
    const double shift[3] = {0, 0.01, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(hull, NULL, shift, &moved), NURBS_OK);
    nurbs_surface_free(hull);
    is_refused(1, &moved, "0.01 m off the centre plane");
}

/* As much as a lift takes back from overshoots; here all of the stem, the stern and the keel. */
static void half_beyond_the_centre_plane_is_refused(void)
{
    nurbs_surface *hull = skinned(water, keel), *moved;
    const double shift[3] = {0, -0.004, 0};
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(hull, NULL, shift, &moved), NURBS_OK);
    nurbs_surface_free(hull);
    is_refused(1, &moved, "nurbs clean --shift 0,0.004");
}

/* A hull in another one, and one beside the other that reaches into it. */
static void bodies_in_bodies_are_refused(void)
{
    const double smaller[9] = {0.9, 0, 0, 0, 0.9, 0, 0, 0, 0.9}, aside[3] = {0, 0.7, 0},
                 away[3] = {0, 1.1, 0};
    nurbs_surface *outer = skinned(water, keel), *inner = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(outer, smaller, NULL, &inner), NURBS_OK);
    is_refused(2, (nurbs_surface *[]){outer, inner}, "lies inside it");
    for (int apart = 0; apart < 2; apart++) {
        nurbs_surface *three[3] = {skinned(water, keel), NULL, NULL},
                      *other = mirrored(skinned(water, keel));
        const double *shift = apart ? away : aside;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(three[0], NULL, shift, &three[1]), NURBS_OK);
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(other, NULL, shift, &three[2]), NURBS_OK);
        nurbs_surface_free(other);
        if (!apart) {
            is_refused(3, three, "reaches into another one");
            continue;
        }
        nurbs_hull *hull = NULL;
        CU_ASSERT_EQUAL_FATAL(hull_of(3, three, &hull), NURBS_OK);
        CHECK_RELATIVE(nurbs_hull_hydrostatics(hull)->volume, 3 * volume, 1e-4);
        nurbs_hull_free(hull);
    }
}

/* Two hulls side by side, one half given: a demihull whose centre plane is y = 2. */
static void waterplane_of_a_catamaran(void)
{
    nurbs_surface *sides[2] = {skinned(above, keel), mirrored(skinned(above, keel))}, *moved[2];
    nurbs_hull *hull = NULL;
    const double shift[3] = {0, 2, 0};
    for (int k = 0; k < 2; k++) {
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_transform(sides[k], NULL, shift, &moved[k]), NURBS_OK);
        nurbs_surface_free(sides[k]);
    }
    CU_ASSERT_EQUAL_FATAL(hull_of(2, moved, &hull), NURBS_OK);
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(hull);
    double plane_area = 2 * 2.0 / 3 * L * B;
    CHECK_RELATIVE(h->volume, 2 * volume, 1e-4);
    CHECK_RELATIVE(h->waterplane_area, plane_area, 1e-4);
    /* Steiner: the two waterplanes 2 m off, each with int 2/3 y^3 dx of its own. */
    CHECK_RELATIVE(h->waterplane_inertia_x, 2 * 0.38095238 + plane_area * 4, 1e-4);
    CHECK_RELATIVE(h->beam, 2 * 2.5, 1e-3);
    nurbs_hull_free(hull);
}

static const struct check_case cases[] = {
    {"leaves out what is no hull", leaves_out_what_is_no_hull},
    {"leaves out the transom", leaves_out_the_transom},
    {"leaves out a transom in pieces", leaves_out_a_transom_in_pieces},
    {"any direction of the parameter lines", any_direction_of_the_parameter_lines},
    {"upper edge within micrometres", upper_edge_within_micrometres},
    {"seams through the water", seams_through_the_water},
    {"either half, or both in one", either_half_or_both_in_one},
    {"missing and doubled patches are refused", missing_and_doubled_patches_are_refused},
    {"half off the centre plane is refused", half_off_the_centre_plane_is_refused},
    {"half beyond the centre plane is refused", half_beyond_the_centre_plane_is_refused},
    {"bodies in bodies are refused", bodies_in_bodies_are_refused},
    {"waterplane of a catamaran", waterplane_of_a_catamaran},
};

CHECK_MAIN("nurbs hull clean", cases)
