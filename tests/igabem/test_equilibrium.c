/* Equilibrium of a hull under way: buoyancy, weight and the dynamic pressure, integrated here over
 * the surface of the placed hull, leave no force and no moment. */
#include "check.h"

#include <igabem/equilibrium.h>
#include <nurbs/nurbs.h>

#include <string.h>

enum { ALONG = 96, AROUND = 32 };
static const double half_breadth = 0.05, draft = 0.0625, gravity = 9.80665;

/* y = b (1 - (2x)^2) (1 - (z/T)^2), fuller aft by a factor 1 - x/2, from the keel to the water and
 * half a draft above it: one patch of degree 3 x 2. */
static nurbs_patches *hull_with_freeboard(void)
{
    const double top = 0.5;
    const double knots_u[8] = {0, 0, 0, 0, 1, 1, 1, 1}, knots_v[6] = {0, 0, 0, 1, 1, 1};
    /* Bernstein coefficients of (1 - 4x^2)(1 - x/2), x = u - 1/2, and of 1 - s^2, s = -1 + (1 +
     * top) v. */
    const double along[4] = {0.0, 5.0 / 3.0, 1.0, 0.0};
    const double up[3] = {0.0, 1.0 + top, 1.0 - top * top};
    double points[36];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            double *p = points + 3 * (3 * i + j);
            p[0] = i / 3.0 - 0.5;
            p[1] = half_breadth * along[i] * up[j];
            p[2] = draft * (-1.0 + (1.0 + top) * j / 2.0);
        }
    nurbs_surface *surface = NULL;
    nurbs_patches *patches = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_create((const int[]){3, 2}, (const size_t[]){4, 3}, knots_u,
                                               knots_v, points, NULL, &surface),
                          NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_add(patches, surface), NURBS_OK);
    nurbs_surface_free(surface);
    return patches;
}

/* Upward force of the dynamic pressure on both sides over rho, and its moment about the transverse
 * axis (x, z = 0), positive bow up: midpoint rule. */
static void dynamic_load(const igabem_solution *solution, const nurbs_surface *surface,
                         double speed, double x, double load[2])
{
    load[0] = load[1] = 0.0;
    double range[2][2];
    for (int d = 0; d < 2; d++) {
        const double *knots = nurbs_surface_knots(surface, d);
        range[d][0] = knots[0];
        range[d][1] = knots[nurbs_surface_size(surface, d)];
    }
    double du = (range[0][1] - range[0][0]) / ALONG, dv = (range[1][1] - range[1][0]) / AROUND;
    for (int i = 0; i < ALONG; i++)
        for (int j = 0; j < AROUND; j++) {
            const double uv[2] = {range[0][0] + (i + 0.5) * du, range[1][0] + (j + 0.5) * dv};
            double velocity[3], cp, t[9];
            CU_ASSERT_EQUAL_FATAL(igabem_surface_velocity(solution, 0, 1, uv, velocity, &cp),
                                  IGABEM_OK);
            CU_ASSERT_EQUAL_FATAL(nurbs_surface_eval(surface, 1, 1, uv, t), NURBS_OK);
            double n[3] = {t[4] * t[8] - t[5] * t[7], t[5] * t[6] - t[3] * t[8],
                           t[3] * t[7] - t[4] * t[6]};
            double outward = n[1] < 0 ? -1.0 : 1.0; /* the side looks to port */
            double p = 0.5 * speed * speed * cp * outward * du * dv;
            load[0] -= 2.0 * p * n[2];
            load[1] += 2.0 * p * (t[2] * n[0] - (t[0] - x) * n[2]);
        }
}

static void balance(void)
{
    nurbs_patches *patches = hull_with_freeboard();
    nurbs_hull *rest = NULL, *placed = NULL;
    igabem_hull *hull = NULL;
    igabem_solution *solution = NULL;
    igabem_options options;
    igabem_equilibrium at;
    igabem_options_init(&options);
    options.froude = 0.32;
    options.elements_u = 18;
    options.elements_v = 5;
    CU_ASSERT_EQUAL_FATAL(nurbs_hull_create(patches, NULL, &rest), NURBS_OK);
    igabem_status status = igabem_equilibrium_find(patches, NULL, &options, &at, &placed);
    if (status)
        fprintf(stderr, "%s\n", igabem_last_error());
    CU_ASSERT_EQUAL_FATAL(status, IGABEM_OK);
    CU_ASSERT_TRUE(at.sinkage > 1e-4 && at.sinkage < 1e-2);
    CU_ASSERT_TRUE(fabs(at.trim) > 1e-5);
    CU_ASSERT_TRUE(at.solves > 1 && at.change < 1e-5);

    CU_ASSERT_EQUAL_FATAL(igabem_hull_from(placed, &hull), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    igabem_forces forces;
    CU_ASSERT_EQUAL_FATAL(igabem_forces_compute(solution, &forces), IGABEM_OK);
    const nurbs_hydrostatics *h = nurbs_hull_hydrostatics(placed),
                             *h0 = nurbs_hull_hydrostatics(rest);
    double x = h->waterplane_centre, load[2];
    dynamic_load(solution, nurbs_patches_get(nurbs_hull_light(placed), 0), forces.speed, x, load);
    /* What the dynamic pressure presses down, the buoyancy gained carries; within the quadrature
     * here and what a draft of 2e-5 of the length would change. */
    double gained = gravity * (h->volume - h0->volume);
    CU_ASSERT_TRUE(gained > 0);
    CHECK_CLOSE(load[0] + gained, 0.0, 2e-5 * gravity * h->waterplane_area + 0.01 * gained);
    double moment =
        gravity * (h->volume * (h->centroid[0] - x) - h0->volume * (h0->centroid[0] - x));
    CHECK_CLOSE(load[1] + moment, 0.0,
                4e-5 * gravity * h->waterplane_inertia_y + 0.02 * fabs(moment));

    igabem_solution_free(solution);
    igabem_hull_free(hull);
    nurbs_hull_free(placed);
    nurbs_hull_free(rest);
    nurbs_patches_free(patches);
}

static void refusals(void)
{
    nurbs_patches *patches = hull_with_freeboard();
    igabem_options options;
    igabem_equilibrium at;
    nurbs_hull *placed = NULL;
    igabem_options_init(&options);
    options.froude = 0.32;
    options.formulation = IGABEM_FORMULATION_HOGNER;
    CU_ASSERT_EQUAL(igabem_equilibrium_find(patches, NULL, &options, &at, &placed),
                    IGABEM_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), "hogner"));
    CU_ASSERT_PTR_NULL(placed);
    options.kernel = IGABEM_KERNEL_DOUBLE_BODY;
    CU_ASSERT_EQUAL(igabem_equilibrium_find(patches, NULL, &options, &at, NULL),
                    IGABEM_ERROR_ARGUMENT);
    nurbs_patches_free(patches);
}

static const struct check_case cases[] = {
    {"balance of forces", balance},
    {"refusals", refusals},
};
CHECK_MAIN("igabem_equilibrium", cases)
