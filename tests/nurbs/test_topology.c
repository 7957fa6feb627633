/* Shared edges, gaps, free edges and orientation of bodies cut from known surfaces. */
#include "check.h"

#include <nurbs/nurbs.h>

#include <string.h>

static nurbs_patches *start(void)
{
    nurbs_patches *patches;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    return patches;
}

static void add_and_free(nurbs_patches *patches, nurbs_surface *surface)
{
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, surface), NURBS_OK);
    nurbs_surface_free(surface);
}

/* The Wigley hull (u lengthwise, v downwards) cut at u = 0.4, its fore part again at v = 0.3. Fore
 * parts are reversed in v when asked. */
static nurbs_patches *cut_wigley(int reversed)
{
    nurbs_patches *patches = start();
    nurbs_surface *hull, *aft, *fore, *upper, *lower;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(2, 0.2, 0.125, &hull), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(hull, 0, 0.4, &aft, &fore), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(fore, 1, 0.3, &upper, &lower), NURBS_OK);
    nurbs_surface_free(hull);
    nurbs_surface_free(fore);
    if (reversed) {
        nurbs_surface *turned;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_reverse(lower, 1, &turned), NURBS_OK);
        nurbs_surface_free(lower);
        lower = turned;
    }
    add_and_free(patches, aft);
    add_and_free(patches, upper);
    add_and_free(patches, lower);
    return patches;
}

static const nurbs_joint *joint_of(const nurbs_topology *t, size_t a, size_t b)
{
    for (size_t k = 0; k < t->joints; k++)
        if ((t->joint[k].edge[0] == a && t->joint[k].edge[1] == b) ||
            (t->joint[k].edge[0] == b && t->joint[k].edge[1] == a))
            return &t->joint[k];
    return NULL;
}

/* Aft's edge u = 0.4 meets one edge of each fore part (a T junction). */
static void finds_shared_and_free_edges(void)
{
    nurbs_patches *patches = cut_wigley(0);
    nurbs_topology t;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(patches, 1e-6, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.edges, 12);
    CU_ASSERT_EQUAL(t.joints, 3);
    CU_ASSERT_EQUAL(t.inconsistent, 0);
    CU_ASSERT(t.gap < 1e-15);
    const nurbs_joint *upper = joint_of(&t, 1, 4), *lower = joint_of(&t, 1, 8),
                      *level = joint_of(&t, 7, 10);
    CU_ASSERT_PTR_NOT_NULL_FATAL(upper);
    CU_ASSERT_PTR_NOT_NULL_FATAL(lower);
    CU_ASSERT_PTR_NOT_NULL_FATAL(level);
    int aft = upper->edge[0] == 1 ? 0 : 1;
    double ends[2] = {upper->edge[0] == 1 ? upper->from[0] : upper->from[1],
                      aft == 0 ? upper->to[0] : upper->to[1]};
    CHECK_CLOSE(fmin(ends[0], ends[1]), 0, 1e-6);
    CHECK_CLOSE(fmax(ends[0], ends[1]), 0.3, 1e-5);
    CHECK_CLOSE(upper->length + lower->length, t.edge[1].length, 1e-5);
    CHECK_CLOSE(t.edge[1].joined, t.edge[1].length, 1e-5);
    CHECK_CLOSE(level->length, t.edge[7].length, 1e-12);
    size_t free_edges = 0;
    for (size_t k = 0; k < 12; k++)
        free_edges += t.edge[k].joined == 0;
    CU_ASSERT_EQUAL(free_edges, 12 - 5);
    CHECK_CLOSE(t.edge[2].length, 0.8, 0.01); /* the aft waterline: 0.8 m of length */
    nurbs_topology_free(&t);
    nurbs_patches_free(patches);
}

static void measures_gaps_in_metres(void)
{
    nurbs_patches *patches = cut_wigley(0), *moved = start();
    const double shift[3] = {0, 3e-5, 4e-5};
    for (size_t k = 0; k < 3; k++) {
        nurbs_surface *copy;
        CU_ASSERT_EQUAL(nurbs_surface_transform(nurbs_patches_get(patches, k), NULL,
                                                k == 2 ? shift : NULL, &copy),
                        NURBS_OK);
        add_and_free(moved, copy);
    }
    nurbs_topology t;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(moved, 1e-3, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.joints, 3);
    const nurbs_joint *level = joint_of(&t, 7, 10), *upper = joint_of(&t, 1, 4);
    CU_ASSERT_PTR_NOT_NULL_FATAL(level);
    CHECK_CLOSE(level->gap, 5e-5, 1e-6); /* largest at the bow, where the edge runs across */
    CU_ASSERT(level->gap <= 5e-5 + 1e-12);
    CU_ASSERT(upper && upper->gap < 1e-15);
    CHECK_CLOSE(t.gap, level->gap, 0);
    nurbs_topology_free(&t);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(moved, 1e-6, &t), NURBS_OK);
    CU_ASSERT_PTR_NULL(joint_of(&t, 7, 10));
    CU_ASSERT_EQUAL(t.edge[10].joined, 0);
    nurbs_topology_free(&t);
    nurbs_patches_free(moved);
    nurbs_patches_free(patches);
}

static void orients_outwards(void)
{
    nurbs_patches *patches = cut_wigley(1), *result;
    nurbs_topology t;
    size_t turned;
    nurbs_moments m, whole;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(patches, 1e-6, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.joints, 3);
    CU_ASSERT_EQUAL(t.inconsistent, 2);
    nurbs_topology_free(&t);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_orient(patches, 1e-6, &result, &turned), NURBS_OK);
    CU_ASSERT(turned == 1 || turned == 2);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(result, 1e-6, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.inconsistent, 0);
    nurbs_topology_free(&t);
    CU_ASSERT_EQUAL(nurbs_patches_moments(result, &m, NULL), NURBS_OK);
    CHECK_CLOSE(m.volume, 2.0 / 9 * 2 * 0.2 * 0.125, 1e-14);
    nurbs_patches *again;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_orient(result, 1e-6, &again, &turned), NURBS_OK);
    CU_ASSERT_EQUAL(turned, 0);
    nurbs_patches_free(again);
    /* Mirror images keep their normals outwards and meet the other half along keel and ends. */
    nurbs_patches *ship;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_mirror(result, 1, &ship), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_count(ship), 6);
    CU_ASSERT_EQUAL(nurbs_patches_moments(ship, &whole, NULL), NURBS_OK);
    CHECK_CLOSE(whole.volume, 2 * m.volume, 1e-14);
    CHECK_CLOSE(whole.moment[1], 0, 1e-16);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(ship, 1e-6, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.inconsistent, 0);
    CU_ASSERT(t.joints >= 11); /* three a side, two at the keel, three at the ends */
    nurbs_topology_free(&t);
    CU_ASSERT_EQUAL(nurbs_patches_mirror(result, 3, &again), NURBS_ERROR_ARGUMENT);
    nurbs_patches_free(ship);
    nurbs_patches_free(result);
    nurbs_patches_free(patches);
}

/* Moving, scaling and mirroring keeps what belongs to the patches. */
static void transforms_all_that_belongs_to_patches(void)
{
    nurbs_patches *patches = cut_wigley(0), *moved;
    const double u[3] = {0, 0.1, 0.4}, v[2] = {0.25, 1}, *kept,
                 matrix[9] = {2, 0, 0, 0, 2, 0, 0, 0, -2}, shift[3] = {1, 0, 0};
    CU_ASSERT_EQUAL(nurbs_patches_set_note(patches, "cut"), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_set_length(patches, 2), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_set_parameters(patches, 0, 3, u, 2, v), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_transform(patches, matrix, shift, &moved), NURBS_OK);
    CU_ASSERT_STRING_EQUAL(nurbs_patches_note(moved), "cut");
    CHECK_CLOSE(nurbs_patches_length(moved), 4, 1e-15);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_parameters(moved, 0, 0, &kept), 3);
    CHECK_CLOSE(kept[1], 0.3, 1e-15); /* u runs the other way */
    double p[3], q[3], at[2] = {kept[1], 0.25}, before[2] = {0.1, 0.25};
    CU_ASSERT_EQUAL(nurbs_surface_eval(nurbs_patches_get(moved, 0), 0, 1, at, p), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_surface_eval(nurbs_patches_get(patches, 0), 0, 1, before, q), NURBS_OK);
    CHECK_CLOSE(p[0], 2 * q[0] + 1, 1e-14);
    CHECK_CLOSE(p[2], -2 * q[2], 1e-14);
    nurbs_moments a, b;
    CU_ASSERT_EQUAL(nurbs_patches_moments(patches, &a, NULL), NURBS_OK);
    CU_ASSERT_EQUAL(nurbs_patches_moments(moved, &b, NULL), NURBS_OK);
    CHECK_CLOSE(b.volume, 8 * a.volume, 1e-13);
    nurbs_patches *none;
    const double flat[9] = {1, 0, 0, 0, 1, 0, 0, 0, 0};
    CU_ASSERT_EQUAL(nurbs_patches_transform(patches, flat, NULL, &none), NURBS_ERROR_ARGUMENT);
    nurbs_patches_free(moved);
    nurbs_patches_free(patches);
}

/* Collapsed edges are told, closed bodies have no free edge. */
static void closed_bodies_have_no_free_edge(void)
{
    nurbs_surface *half;
    nurbs_patches *patches = start(), *whole;
    nurbs_topology t;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(2, 0.6, 0.5, 0.3, &half), NURBS_OK);
    add_and_free(patches, half);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_mirror(patches, 1, &whole), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(whole, 1e-9, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.joints, 2);
    CU_ASSERT_EQUAL(t.inconsistent, 0);
    for (size_t k = 0; k < t.edges; k++) {
        CU_ASSERT_EQUAL(t.edge[k].collapsed, t.edge[k].side < 2);
        if (!t.edge[k].collapsed)
            CHECK_CLOSE(t.edge[k].joined, t.edge[k].length, 1e-9);
    }
    nurbs_topology_free(&t);
    nurbs_patches_free(whole);
    nurbs_patches_free(patches);
}

/* A band of bilinear patches closed after half a turn (Moebius): no orientation suits. */
static void refuses_a_moebius_strip(void)
{
    enum { PARTS = 5 };
    const double knots[4] = {0, 0, 1, 1}, turn = 6.28318530717958647693;
    nurbs_patches *patches = start(), *result;
    for (int k = 0; k < PARTS; k++) {
        double points[12];
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                double *p = points + 6 * i + 3 * j, angle = turn * (k + i) / PARTS,
                       r = 1 + 0.3 * (2 * j - 1) * cos(angle / 2);
                p[0] = r * cos(angle);
                p[1] = r * sin(angle);
                p[2] = 0.3 * (2 * j - 1) * sin(angle / 2);
            }
        nurbs_surface *part;
        CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){1, 1}, (const size_t[]){2, 2},
                                                   knots, knots, points, NULL, &part),
                              NURBS_OK);
        add_and_free(patches, part);
    }
    nurbs_topology t;
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_topology(patches, 1e-9, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.joints, PARTS);
    CU_ASSERT_EQUAL(t.inconsistent, 1);
    nurbs_topology_free(&t);
    CU_ASSERT_EQUAL(nurbs_patches_orient(patches, 1e-9, &result, NULL), NURBS_ERROR_GEOMETRY);
    CU_ASSERT_PTR_NULL(result);
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "no orientation"));
    CU_ASSERT_PTR_NOT_NULL(strstr(nurbs_last_error(), "meet at ("));
    CU_ASSERT_EQUAL(nurbs_patches_topology(patches, 0, &t), NURBS_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(nurbs_patches_topology(patches, NAN, &t), NURBS_ERROR_ARGUMENT);
    nurbs_patches_free(patches);
    patches = start();
    CU_ASSERT_EQUAL(nurbs_patches_topology(patches, 1e-6, &t), NURBS_OK);
    CU_ASSERT_EQUAL(t.joints, 0);
    nurbs_topology_free(&t);
    nurbs_patches_free(patches);
}

static const struct check_case cases[] = {
    {"finds shared and free edges", finds_shared_and_free_edges},
    {"measures gaps in metres", measures_gaps_in_metres},
    {"orients outwards", orients_outwards},
    {"transforms all that belongs to patches", transforms_all_that_belongs_to_patches},
    {"closed bodies have no free edge", closed_bodies_have_no_free_edge},
    {"refuses a moebius strip", refuses_a_moebius_strip},
};

CHECK_MAIN("nurbs topology", cases)
