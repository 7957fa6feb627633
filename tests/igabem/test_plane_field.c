/* Derivatives of the double-body flow on the still water against that past a sphere of which half
 * is below it: Phi = -x a^3/(2 r^3), a dipole, up to the waterline. */
#include "check.h"
#include "exterior/plane_field.h"

#include <nurbs/nurbs.h>

enum { DERIVATIVES = 5 };
static const double radius = 0.5;

/* x, y, xx, xy, yy. */
static void dipole(const double at[2], double exact[DERIVATIVES])
{
    double x = at[0], y = at[1], m = -0.5 * radius * radius * radius;
    double r2 = x * x + y * y, r3 = r2 * sqrt(r2), r5 = r3 * r2, r7 = r5 * r2;
    exact[0] = m * (1.0 / r3 - 3.0 * x * x / r5);
    exact[1] = -m * 3.0 * x * y / r5;
    exact[2] = m * (15.0 * x * x * x / r7 - 9.0 * x / r5);
    exact[3] = m * (15.0 * x * x * y / r7 - 3.0 * y / r5);
    exact[4] = m * (15.0 * x * y * y / r7 - 3.0 * x / r5);
}

/* The quarter that is modelled: y >= 0, z <= 0. */
static igabem_hull *quarter(void)
{
    nurbs_surface *sphere = NULL, *part[2] = {NULL, NULL};
    igabem_hull *hull = NULL;
    CU_ASSERT_EQUAL_FATAL(nurbs_make_ellipsoid(1.0, 1.0, 1.0, 0.0, &sphere), NURBS_OK);
    CU_ASSERT_EQUAL_FATAL(nurbs_surface_split(sphere, 1, 0.5, &part[0], &part[1]), NURBS_OK);
    double depth = 0.0;
    for (size_t k = 0; k < nurbs_surface_size(part[0], 0) * nurbs_surface_size(part[0], 1); k++)
        depth -= nurbs_surface_points(part[0])[3 * k + 2];
    const nurbs_surface *lower = part[depth < 0.0];
    CU_ASSERT_EQUAL_FATAL(igabem_hull_create(&lower, 1, IGABEM_SYMMETRIC, &hull), IGABEM_OK);
    nurbs_surface_free(sphere);
    nurbs_surface_free(part[0]);
    nurbs_surface_free(part[1]);
    return hull;
}

/* Largest error of the first and of the second derivatives at a distance from the waterline, over
 * their largest values. */
static void errors(int elements, double tolerance, double distance, double error[2])
{
    igabem_hull *hull = quarter();
    const struct density_rule rule = {.degree = 3, .refine = {elements, elements}};
    struct density *density;
    struct mesh *mesh;
    struct influence *influence;
    CU_ASSERT_EQUAL_FATAL(density_create(hull, &rule, &density), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(mesh_create(density, &mesh), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(influence_create(density, mesh, tolerance, 1, &influence), IGABEM_OK);
    double *phi = malloc(density->n * sizeof *phi);
    CU_ASSERT_PTR_NOT_NULL_FATAL(phi);
    for (size_t i = 0; i < density->n; i++)
        phi[i] = -0.5 * density->point[3 * i];
    CU_ASSERT_EQUAL_FATAL(density_interpolate(density, 1, phi), IGABEM_OK);
    struct plane_layer layer;
    struct layer_work work;
    const struct layer_surface whole = {.influence = influence};
    CU_ASSERT_EQUAL_FATAL(plane_layer_create(influence, phi, true, &layer), IGABEM_OK);
    CU_ASSERT_EQUAL_FATAL(layer_work_create(&whole, &work), IGABEM_OK);
    double most[2] = {0.0, 0.0};
    error[0] = error[1] = 0.0;
    for (int k = 0; k <= 20; k++) {
        double angle = 0.15 * k + 0.02, r = radius + distance, d[DERIVATIVES] = {0.0};
        double at[2] = {r * cos(angle), r * sin(angle)}, exact[DERIVATIVES];
        CU_ASSERT_EQUAL_FATAL(plane_layer_add(&layer, at, &work, d), IGABEM_OK);
        dipole(at, exact);
        for (int c = 0; c < DERIVATIVES; c++) {
            most[c > 1] = fmax(most[c > 1], fabs(exact[c]));
            error[c > 1] = fmax(error[c > 1], fabs(d[c] - exact[c]));
        }
    }
    for (int k = 0; k < 2; k++)
        error[k] /= most[k];
    layer_work_free(&work);
    plane_layer_free(&layer);
    free(phi);
    influence_free(influence);
    mesh_free(mesh);
    density_free(density);
    igabem_hull_free(hull);
}

/* At the default tolerance, down to 1/200 of the diameter; and closer with a smaller one. */
static void test_sphere(void)
{
    static const double distance[4] = {0.5, 0.1, 0.02, 0.005};
    double error[2], loose[2];
    for (int k = 0; k < 4; k++) {
        errors(4, 1e-5, distance[k], error);
        CHECK_CLOSE(error[0], 0.0, 1e-5);
        CHECK_CLOSE(error[1], 0.0, 2e-3);
    }
    errors(4, 1e-4, 0.02, loose);
    errors(4, 1e-6, 0.02, error);
    CU_ASSERT_TRUE(loose[0] > 10.0 * error[0] && loose[1] > 10.0 * error[1]);
}

static const struct check_case cases[] = {{"half a sphere", test_sphere}};

CHECK_MAIN("flow along the still water", cases)
