/* NULL in every public call: a status, or what the header says where there is none. Run under the
 * sanitizers as well. */
#include "check.h"
#include "hulls.h"

#include <string.h>

#define REFUSED(call) CU_ASSERT_EQUAL((call), IGABEM_ERROR_ARGUMENT)

static const double one[9] = {1, 1, -1, 1, 1, -2, 2, 1, -1};
static double out[9];

static void green_function(void)
{
    const double *p = one, *z = one + 2;
    REFUSED(igabem_kelvin_local(1, NULL, p, z, out, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_local(1, p, NULL, z, out, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_local(1, p, p, NULL, out, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_local_second(1, p, NULL, z, out, NULL, NULL, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_wave(1, NULL, p, z, out, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_wave_filtered(1, p, p, NULL, NULL, out, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_wave_second(1, p, NULL, z, out, NULL, NULL, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_green(1, 1, NULL, p, z, p, p, z, IGABEM_WAVE, out, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_green(1, 1, p, p, z, p, p, NULL, IGABEM_LOCAL, out, NULL, NULL, NULL));
    REFUSED(igabem_kelvin_green_second(1, 1, p, p, z, NULL, p, z, IGABEM_WAVE, out, NULL, NULL,
                                       NULL, NULL, NULL));
    REFUSED(igabem_kelvin_source_resistance(1, 1, 1, 1, NULL));
    REFUSED(igabem_kelvin_dipole_resistance(1, 1, 1, 1, NULL));
    REFUSED(igabem_kelvin_sphere_resistance(1, 9.8, 1, 1, 0.1, NULL));
    igabem_kelvin_filter_init(NULL);
    /* No outputs wanted: nothing to do, nothing wrong. */
    CU_ASSERT_EQUAL(igabem_kelvin_local(1, p, p, z, NULL, NULL, NULL, NULL), IGABEM_OK);
    CU_ASSERT_EQUAL(igabem_kelvin_wave(0, NULL, NULL, NULL, NULL, NULL, NULL, NULL), IGABEM_OK);
}

static void amplitudes(void)
{
    const double *p = one, *z = one + 2;
    REFUSED(igabem_kochin_points(1, 1, NULL, 1, p, p, z, p, out, out));
    REFUSED(igabem_kochin_points(1, 1, p, 1, NULL, p, z, p, out, out));
    REFUSED(igabem_kochin_points(1, 1, p, 1, p, NULL, z, p, out, out));
    REFUSED(igabem_kochin_points(1, 1, p, 1, p, p, NULL, p, out, out));
    REFUSED(igabem_kochin_points(1, 1, p, 1, p, p, z, NULL, out, out));
    REFUSED(igabem_kochin_points(1, 1, p, 1, p, p, z, p, NULL, out));
    REFUSED(igabem_kochin_points(1, 1, p, 1, p, p, z, p, out, NULL));
    REFUSED(igabem_kochin_segments(1, 1, p, 1, NULL, p, out, out));
    REFUSED(igabem_kochin_segments(1, 1, p, 1, one, NULL, out, out));
    REFUSED(igabem_kochin_segments(1, 1, p, 1, one, p, NULL, out));
    REFUSED(igabem_kochin_triangles(1, 1, p, 1, NULL, p, out, out));
    REFUSED(igabem_kochin_triangles(1, 1, NULL, 1, one, p, out, out));
    REFUSED(igabem_kochin_triangles(1, 1, p, 1, one, p, out, NULL));
}

static void hulls(void)
{
    nurbs_surface *surface = wigley_surface(0.1, 0.0625, 1, 1);
    const nurbs_surface *list[2] = {surface, NULL};
    igabem_hull *hull = NULL;
    igabem_hull_info info = {.length = 1.0};
    REFUSED(igabem_hull_create(list, 1, IGABEM_SYMMETRIC, NULL));
    REFUSED(igabem_hull_create(NULL, 1, IGABEM_SYMMETRIC, &hull));
    REFUSED(igabem_hull_create(list, 2, IGABEM_SYMMETRIC, &hull));
    CU_ASSERT_PTR_NOT_NULL(strstr(igabem_last_error(), "patch 1 is NULL"));
    CU_ASSERT_PTR_NULL(hull);
    REFUSED(igabem_hull_from(NULL, &hull));
    REFUSED(igabem_hull_set_length(NULL, 1.0));
    igabem_hull_get_info(NULL, &info);
    CU_ASSERT_EQUAL(info.length, 0.0);
    CU_ASSERT_PTR_NULL(igabem_hull_warning(NULL, 0));
    igabem_hull_free(NULL);
    nurbs_surface_free(surface);
    hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_hull_get_info(hull, NULL);
    igabem_hull_free(hull);
}

static void solving(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options;
    igabem_solution *solution = NULL;
    igabem_forces forces;
    igabem_options_init(NULL);
    igabem_options_init(&options);
    options.froude = 0.35;
    options.refine = 1;
    REFUSED(igabem_options_freeze(NULL, &options));
    REFUSED(igabem_options_freeze(hull, NULL));
    igabem_options_refine(NULL, 400, &options);
    CU_ASSERT_EQUAL(options.refine, 1);
    igabem_options_refine(hull, 400, NULL);
    REFUSED(igabem_solve(NULL, &options, &solution));
    REFUSED(igabem_solve(hull, NULL, &solution));
    REFUSED(igabem_solve(hull, &options, NULL));
    REFUSED(igabem_solve_many(hull, 1, &options, NULL));
    CU_ASSERT_EQUAL(igabem_solve_many(hull, 0, NULL, NULL), IGABEM_OK);
    REFUSED(igabem_solve_hull(NULL, &options, &forces));
    REFUSED(igabem_solve_hull(NULL, NULL, &forces));
    REFUSED(igabem_solve_hull(NULL, &options, NULL));
    CU_ASSERT_PTR_NULL(igabem_solution_options(NULL));
    CU_ASSERT_PTR_NULL(igabem_solution_warning(NULL, &forces, 0));
    igabem_solution_free(NULL);
    igabem_hull_free(hull);
}

static void results(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options;
    igabem_solution *solution = NULL;
    igabem_forces forces;
    double h[1][2], v[3];
    igabem_options_init(&options);
    options.froude = 0.35;
    options.refine = 1;
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    REFUSED(igabem_forces_compute(NULL, &forces));
    REFUSED(igabem_forces_compute(solution, NULL));
    REFUSED(igabem_wave_elevation(NULL, 1, one, one, out));
    REFUSED(igabem_wave_elevation(solution, 1, NULL, one, out));
    REFUSED(igabem_wave_elevation(solution, 1, one, NULL, out));
    REFUSED(igabem_wave_elevation(solution, 1, one, one, NULL));
    REFUSED(igabem_surface_velocity(NULL, 0, 1, one, v, NULL));
    REFUSED(igabem_surface_velocity(solution, 0, 1, NULL, v, NULL));
    REFUSED(igabem_surface_velocity(solution, 0, 1, one, NULL, NULL));
    REFUSED(igabem_source_density(NULL, 0, 1, one, out));
    REFUSED(igabem_source_density(solution, 0, 1, NULL, out));
    REFUSED(igabem_source_density(solution, 0, 1, one, NULL));
    REFUSED(igabem_kochin(NULL, 1, one, h, NULL));
    REFUSED(igabem_kochin(solution, 1, NULL, h, NULL));
    REFUSED(igabem_kochin(solution, 1, one, NULL, NULL));
    size_t n;
    REFUSED(igabem_wave_residuals(NULL, out));
    REFUSED(igabem_wave_residuals(solution, NULL));
    REFUSED(igabem_pressure_samples(NULL, 1, 1, &n, NULL));
    REFUSED(igabem_pressure_samples(solution, 1, 1, NULL, NULL));
    CU_ASSERT_TRUE(isnan(igabem_pressure_sum(1, NULL, NULL)));
    REFUSED(igabem_wave_shares(NULL, 1, one, out));
    REFUSED(igabem_wave_shares(solution, 1, NULL, out));
    REFUSED(igabem_wave_shares(solution, 1, one, NULL));
    size_t size[2];
    REFUSED(igabem_free_surface_grid(NULL, size, NULL, NULL));
    REFUSED(igabem_free_surface_grid(solution, NULL, NULL, NULL));
    REFUSED(igabem_free_surface_grid(solution, size, NULL, NULL));
    REFUSED(igabem_wave_cut(NULL, NAN, out));
    REFUSED(igabem_wave_cut(solution, NAN, NULL));
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static void tangents(void)
{
    igabem_hull *hull = wigley_hull(0.1, 0.0625, 1, 1);
    igabem_options options;
    igabem_solution *solution = NULL;
    igabem_tangent *tangent = NULL;
    double h[1][2];
    static const double still[3 * 64] = {0.0};
    igabem_pressure_sample sample;
    igabem_options_init(&options);
    options.froude = 0.35;
    options.refine = 1;
    options.formulation = IGABEM_FORMULATION_HOGNER;
    CU_ASSERT_EQUAL_FATAL(igabem_solve(hull, &options, &solution), IGABEM_OK);
    REFUSED(igabem_tangent_create(NULL, solution, 1, still, &tangent));
    REFUSED(igabem_tangent_create(hull, NULL, 1, still, &tangent));
    REFUSED(igabem_tangent_create(hull, solution, 0, still, &tangent));
    REFUSED(igabem_tangent_create(hull, solution, 1, NULL, &tangent));
    REFUSED(igabem_tangent_create(hull, solution, 1, still, NULL));
    CU_ASSERT_EQUAL_FATAL(igabem_tangent_create(hull, solution, 1, still, &tangent), IGABEM_OK);
    REFUSED(igabem_tangent_kochin(NULL, 1, one, h));
    REFUSED(igabem_tangent_kochin(tangent, 1, NULL, h));
    REFUSED(igabem_tangent_kochin(tangent, 1, one, NULL));
    REFUSED(igabem_tangent_residuals(NULL, out));
    REFUSED(igabem_tangent_residuals(tangent, NULL));
    REFUSED(igabem_tangent_cw(NULL, out));
    REFUSED(igabem_tangent_cw(tangent, NULL));
    REFUSED(igabem_tangent_wetted_area(NULL, out));
    REFUSED(igabem_tangent_wetted_area(tangent, NULL));
    REFUSED(igabem_tangent_samples(NULL, 1, 1, &sample));
    REFUSED(igabem_tangent_samples(tangent, 1, 1, NULL));
    REFUSED(igabem_tangent_samples(tangent, 1, 1, &sample)); /* no velocity */
    igabem_tangent_free(tangent);
    igabem_tangent_free(NULL);
    igabem_solution_free(solution);
    igabem_hull_free(hull);
}

static void derived(void)
{
    igabem_options options;
    igabem_equilibrium equilibrium;
    igabem_forces forces = {.cw = 1e-3, .speed = 1.0, .wetted_area = 1.0};
    const igabem_water water = {1000.0, 1e-6, 0.0};
    igabem_total total;
    nurbs_patches *patches = NULL;
    igabem_options_init(&options);
    CU_ASSERT_EQUAL_FATAL(nurbs_patches_create(&patches), NURBS_OK);
    REFUSED(igabem_equilibrium_find(NULL, NULL, &options, &equilibrium, NULL));
    REFUSED(igabem_equilibrium_find(patches, NULL, NULL, &equilibrium, NULL));
    REFUSED(igabem_equilibrium_find(patches, NULL, &options, NULL, NULL));
    REFUSED(igabem_total_resistance(NULL, 1.0, &water, &total));
    REFUSED(igabem_total_resistance(&forces, 1.0, NULL, &total));
    REFUSED(igabem_total_resistance(&forces, 1.0, &water, NULL));
    igabem_ladder_level(1, NULL);
    REFUSED(igabem_ladder_order(NULL, one, out, out + 1));
    REFUSED(igabem_ladder_order(one, NULL, out, out + 1));
    REFUSED(igabem_ladder_order(one, one, NULL, out));
    REFUSED(igabem_ladder_order(one, one, out, NULL));
    nurbs_patches_free(patches);
}

static void names(void)
{
    igabem_formulation formulation;
    CU_ASSERT_FALSE(igabem_formulation_parse(NULL, &formulation));
    CU_ASSERT_FALSE(igabem_formulation_parse("hogner", NULL));
    CU_ASSERT_PTR_NULL(igabem_formulation_name((igabem_formulation)99));
    CU_ASSERT_PTR_NULL(igabem_formulation_info((igabem_formulation)99));
    CU_ASSERT_STRING_EQUAL(igabem_status_string((igabem_status)99), "unknown status");
    CU_ASSERT_PTR_NOT_NULL(igabem_last_error());
    CU_ASSERT_PTR_NOT_NULL(igabem_version());
}

static const struct check_case cases[] = {
    {"Green function", green_function},
    {"amplitudes", amplitudes},
    {"hulls", hulls},
    {"solving", solving},
    {"results", results},
    {"tangents", tangents},
    {"derived figures", derived},
    {"names", names},
};
CHECK_MAIN("igabem_null", cases)
