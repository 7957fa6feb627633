/* NULL in place of everything that a call needs: a status, or 0, NULL or "" where a value is
 * returned; no call of libnurbs follows it. */
#include "check.h"

#include <nurbs/nurbs.h>

#include <string.h>

#define CHECK_NULL(call) CU_ASSERT_EQUAL(call, NURBS_ERROR_ARGUMENT)

static void calls_that_can_fail(void)
{
    CHECK_NULL(nurbs_knots_check(1, 2, NULL));
    CHECK_NULL(nurbs_gauss_legendre(2, NULL, NULL));
    CHECK_NULL(nurbs_curve_create(1, 2, NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_curve_copy(NULL, NULL));
    CHECK_NULL(nurbs_curve_eval(NULL, 1, 2, NULL, NULL));
    CHECK_NULL(nurbs_curve_eval_left(NULL, 1, 2, NULL, NULL));
    CHECK_NULL(nurbs_parametrize(1, 2, NULL, NULL));
    CHECK_NULL(nurbs_curve_interpolate(1, 2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_interpolate(NULL, NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_curve_fit(1, 2, NULL, 2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_skin(NULL, NULL, NULL));
    CHECK_NULL(nurbs_skin_light(NULL, NULL, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_skin_parameters(NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_skin_curves(2, NULL, NULL, 1, 1.0, NULL));
    CHECK_NULL(nurbs_surface_fit(NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_fit_points(NULL, NULL, NULL, NULL, 2, NULL, NULL, 1.0, NULL));
    CHECK_NULL(nurbs_ruled(NULL, NULL, NULL));
    CHECK_NULL(nurbs_coons(NULL, NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_normals(NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_surface_curvatures(NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_curve_curvatures(NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_grid_create(2, 2, NULL, NULL));
    CHECK_NULL(nurbs_grid_read(NULL, NULL));
    CHECK_NULL(nurbs_grid_write(NULL, NULL));
    CHECK_NULL(nurbs_grid_sample(NULL, 2, NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_mesh_sections(NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_sections(NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_mesh(NULL, 1.0, NULL));
    CHECK_NULL(nurbs_hull_read(NULL, NULL, NULL));
    CHECK_NULL(nurbs_hull_create(NULL, NULL, NULL));
    CHECK_NULL(nurbs_hull_create_surfaces(2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_hull_design_grid(NULL, 2, 2, NULL));
    CHECK_NULL(nurbs_patches_design_grid(NULL, 2, 2, 2, NULL));
    CHECK_NULL(nurbs_patches_design_parameters(NULL, 0, 0, 2, NULL));
    CHECK_NULL(nurbs_hull_rebuild(NULL, NULL, NULL));
    CHECK_NULL(nurbs_hull_share_space(NULL, NULL, 2, NULL));
    CHECK_NULL(nurbs_hull_moves(NULL, NULL, NULL));
    CHECK_NULL(nurbs_hull_read_patches(NULL, 1.0, NULL, NULL, 2));
    CHECK_NULL(nurbs_patches_snap(NULL, 1.0, NULL, NULL, NULL));
    CHECK_NULL(nurbs_hull_write(NULL, NULL, NULL));
    CHECK_NULL(nurbs_hydrostatics_compute(2, NULL, 1.0, NULL));
    CHECK_NULL(nurbs_hydrostatics_whole(2, NULL, 1.0, NULL));
    CHECK_NULL(nurbs_transom_patches(2, NULL, 1.0, NULL));
    CHECK_NULL(nurbs_surface_area(NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_moments(NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_moments(NULL, NULL, NULL));
    CHECK_NULL(nurbs_locator_create(NULL, NULL));
    CHECK_NULL(nurbs_locator_closest(NULL, 2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_closest(NULL, 2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_closest_near(NULL, 2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_curve_closest(NULL, 2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_read_json(NULL, NULL));
    CHECK_NULL(nurbs_patches_write_json(NULL, NULL));
    CHECK_NULL(nurbs_patches_read_iges(NULL, NULL, NULL, 2));
    CHECK_NULL(nurbs_patches_write_iges(NULL, NULL));
    CHECK_NULL(nurbs_patches_read_iges_untrimmed(NULL, 1.0, NULL, NULL, 2));
    CHECK_NULL(nurbs_patches_read_step(NULL, 1.0, NULL, NULL, 2));
    CHECK_NULL(nurbs_patches_write_step(NULL, NULL));
    CHECK_NULL(nurbs_curves_read_iges(NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_write_stl(NULL, 1, NULL));
    CHECK_NULL(nurbs_patches_write_vtu(NULL, 1, NULL));
    CHECK_NULL(nurbs_patches_write_points(NULL, NULL));
    CHECK_NULL(nurbs_patches_read(NULL, NULL));
    CHECK_NULL(nurbs_patches_read_reported(NULL, 1.0, NULL, NULL, 2));
    CHECK_NULL(nurbs_patches_write(NULL, NULL));
    CHECK_NULL(nurbs_surface_write_iges(NULL, NULL));
    CHECK_NULL(nurbs_mesh_create(2, NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_mesh_read(NULL, 1.0, NULL));
    CHECK_NULL(nurbs_mesh_hydrostatics(NULL, 1.0, NULL));
    CHECK_NULL(nurbs_mesh_doubt(NULL, 1.0, NULL, 2, NULL));
    CHECK_NULL(nurbs_mesh_section(NULL, NULL, 1.0, NULL));
    CHECK_NULL(nurbs_curve_insert(NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_surface_insert(NULL, 1, 2, NULL, NULL));
    CHECK_NULL(nurbs_surface_refine(NULL, 1, NULL));
    CHECK_NULL(nurbs_curve_to_bezier(NULL, NULL));
    CHECK_NULL(nurbs_surface_to_bezier(NULL, NULL));
    CHECK_NULL(nurbs_curve_elevate(NULL, 1, NULL));
    CHECK_NULL(nurbs_surface_elevate(NULL, 1, 1, NULL));
    CHECK_NULL(nurbs_curve_part(NULL, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_surface_part(NULL, 1, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_curve_split(NULL, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_surface_split(NULL, 1, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_curve_reverse(NULL, NULL));
    CHECK_NULL(nurbs_surface_reverse(NULL, 1, NULL));
    CHECK_NULL(nurbs_surface_swap(NULL, NULL));
    CHECK_NULL(nurbs_surface_transform(NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_iso_curve(NULL, 1, 1.0, NULL));
    CHECK_NULL(nurbs_offsets_read(NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_stations_read(NULL, 2, NULL));
    CHECK_NULL(nurbs_hull_particulars(NULL, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_hull_perpendiculars(NULL, NULL));
    CHECK_NULL(nurbs_hull_section_areas(NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_hull_waterline(NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_create(NULL));
    CHECK_NULL(nurbs_patches_add(NULL, NULL));
    CHECK_NULL(nurbs_patches_set_note(NULL, NULL));
    CHECK_NULL(nurbs_patches_set_length(NULL, 1.0));
    CHECK_NULL(nurbs_patches_set_parameters(NULL, 2, 2, NULL, 2, NULL));
    CHECK_NULL(nurbs_make_ellipsoid(1.0, 1.0, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_make_wigley(1.0, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_ship_form_fast(1.0, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_ship_form_bulb(1.0, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_make_ship(NULL, NULL));
    CHECK_NULL(nurbs_surface_wetted(NULL, 1.0, 1.0, NULL));
    CHECK_NULL(nurbs_surface_check_fold(NULL, NULL));
    CHECK_NULL(nurbs_surface_raise_side(NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_contour(NULL, NULL, 1.0, 1, NULL));
    CHECK_NULL(nurbs_curve_simplify(NULL, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_surface_simplify(NULL, 1.0, 1, NULL, NULL));
    CHECK_NULL(nurbs_surface_simplify_geometric(NULL, 1.0, 1, NULL, NULL));
    CHECK_NULL(nurbs_curve_simplify_geometric(NULL, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_curve_remove(NULL, 1.0, 1, NULL, NULL));
    CHECK_NULL(nurbs_surface_remove(NULL, 1, 1.0, 1, NULL, NULL));
    CHECK_NULL(nurbs_surface_create(NULL, NULL, NULL, NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_surface_copy(NULL, NULL));
    CHECK_NULL(nurbs_surface_eval(NULL, 1, 2, NULL, NULL));
    CHECK_NULL(nurbs_surface_eval_sided(NULL, 1, 1, 2, NULL, NULL));
    CHECK_NULL(nurbs_surface_eval_grid(NULL, 1, 2, NULL, 2, NULL, NULL));
    CHECK_NULL(nurbs_surface_basis(NULL, 1, 1.0, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_surface_rows(NULL, 1, 2, NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_topology(NULL, 1.0, NULL));
    CHECK_NULL(nurbs_topology_orient(NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_orient(NULL, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_patches_transform(NULL, NULL, NULL, NULL));
    CHECK_NULL(nurbs_patches_mirror(NULL, 1, NULL));
    CHECK_NULL(nurbs_surface_untrim(NULL, 2, NULL, 1.0, NULL, NULL));
    CHECK_NULL(nurbs_surface_untrim_parts(NULL, 2, NULL, NULL, 1.0, NULL, NULL));
}

static void calls_that_return_a_value(void)
{
    CU_ASSERT_EQUAL(nurbs_curve_degree(NULL), 0);
    CU_ASSERT_EQUAL(nurbs_curve_size(NULL), 0);
    CU_ASSERT_PTR_NULL(nurbs_curve_knots(NULL));
    CU_ASSERT_PTR_NULL(nurbs_curve_points(NULL));
    CU_ASSERT_PTR_NULL(nurbs_curve_weights(NULL));
    CU_ASSERT_EQUAL(nurbs_surface_degree(NULL, 0), 0);
    CU_ASSERT_EQUAL(nurbs_surface_size(NULL, 1), 0);
    CU_ASSERT_PTR_NULL(nurbs_surface_knots(NULL, 0));
    CU_ASSERT_PTR_NULL(nurbs_surface_points(NULL));
    CU_ASSERT_PTR_NULL(nurbs_surface_weights(NULL));
    CU_ASSERT_EQUAL(nurbs_grid_rows(NULL), 0);
    CU_ASSERT_EQUAL(nurbs_grid_columns(NULL), 0);
    CU_ASSERT_PTR_NULL(nurbs_grid_points(NULL));
    CU_ASSERT_PTR_NULL(nurbs_grid_edit(NULL));
    CU_ASSERT_EQUAL(nurbs_patches_count(NULL), 0);
    CU_ASSERT_PTR_NULL(nurbs_patches_get(NULL, 0));
    CU_ASSERT_EQUAL(strcmp(nurbs_patches_note(NULL), ""), 0);
    CU_ASSERT_EQUAL(nurbs_patches_length(NULL), 0);
    CU_ASSERT_EQUAL(nurbs_patches_parameters(NULL, 0, 0, NULL), 0);
    CU_ASSERT_EQUAL(nurbs_basis_span(3, 8, NULL, 0.5, NULL), 0);
    CU_ASSERT_EQUAL(nurbs_knots_distinct(3, 8, NULL, NULL, NULL), 0);
    nurbs_basis(3, NULL, 3, 0.5, NULL);
    nurbs_basis_derivatives(3, NULL, 3, 0.5, 1, NULL);
    nurbs_greville(3, 8, NULL, NULL);
    nurbs_skin_options_init(NULL);
    nurbs_hull_options_init(NULL);
    nurbs_contour_free(NULL);
    nurbs_topology_free(NULL);
    CU_ASSERT_EQUAL(nurbs_hull_length(NULL), 0);
    CU_ASSERT_PTR_NULL(nurbs_hull_full(NULL));
    CU_ASSERT_PTR_NULL(nurbs_hull_step(NULL, 0));
}

static const struct check_case cases[] = {
    {"calls that can fail", calls_that_can_fail},
    {"calls that return a value", calls_that_return_a_value},
};

CHECK_MAIN("nurbs NULL", cases)
