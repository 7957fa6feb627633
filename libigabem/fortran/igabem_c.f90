! The C interface of libigabem, and what of libnurbs it takes: made from the headers, which have every
! meaning, by libigabem/fortran/interfaces. An absent argument is NULL in C; texts end in c_null_char.
module igabem_c
  use, intrinsic :: iso_c_binding
  implicit none
  integer(c_int), parameter :: igabem_ok = 0
  integer(c_int), parameter :: igabem_error_argument = -1
  integer(c_int), parameter :: igabem_error_memory = -2
  integer(c_int), parameter :: igabem_error_file = -3
  integer(c_int), parameter :: igabem_error_format = -4
  integer(c_int), parameter :: igabem_error_geometry = -5
  integer(c_int), parameter :: igabem_error_numeric = -6
  integer(c_int), parameter :: igabem_error_cancelled = -7
  integer(c_int), parameter :: igabem_formulation_auto = 0
  integer(c_int), parameter :: igabem_formulation_neumann_kelvin = 1
  integer(c_int), parameter :: igabem_formulation_neumann_kelvin_stern = 2
  integer(c_int), parameter :: igabem_formulation_double_body_kochin = 3
  integer(c_int), parameter :: igabem_formulation_hogner = 4
  integer(c_int), parameter :: igabem_formulation_michell = 5
  integer(c_int), parameter :: igabem_formulation_exterior = 6
  integer(c_int), parameter :: igabem_formulation_double_model = 7
  integer(c_int), parameter :: nurbs_ok = 0
  integer(c_int), parameter :: nurbs_error_argument = -1
  integer(c_int), parameter :: nurbs_error_memory = -2
  integer(c_int), parameter :: nurbs_error_file = -3
  integer(c_int), parameter :: nurbs_error_format = -4
  integer(c_int), parameter :: nurbs_error_geometry = -5
  integer(c_int), parameter :: nurbs_error_numeric = -6
  integer(c_int), parameter :: nurbs_error_cancelled = -7
  integer(c_int), parameter :: igabem_symmetric = 1
  integer(c_int), parameter :: igabem_transom_none = 0
  integer(c_int), parameter :: igabem_transom_open = 1
  integer(c_int), parameter :: igabem_transom_closed = 2
  integer(c_int), parameter :: igabem_kernel_kelvin = 0
  integer(c_int), parameter :: igabem_kernel_double_body = 1
  integer(c_int), parameter :: igabem_kernel_rankine = 2
  integer(c_int), parameter :: igabem_solver_auto = 0
  integer(c_int), parameter :: igabem_solver_lu = 1
  integer(c_int), parameter :: igabem_solver_gmres = 2
  integer(c_int), parameter :: igabem_rankine = 1
  integer(c_int), parameter :: igabem_image = 2
  integer(c_int), parameter :: igabem_local = 4
  integer(c_int), parameter :: igabem_wave = 8
  integer(c_int), parameter :: igabem_lid = 16
  integer(c_int), parameter :: igabem_wave_residuals_number = 320

  type, bind(c) :: igabem_formulation_row
    type(c_ptr) :: name
    type(c_ptr) :: sentence
    logical(c_bool) :: solves
    logical(c_bool) :: kelvin_rows
    logical(c_bool) :: stern_rows
    logical(c_bool) :: line_term
    logical(c_bool) :: pressure
    logical(c_bool) :: centre_plane
    logical(c_bool) :: potential
    logical(c_bool) :: double_model
    logical(c_bool) :: tangents
  end type

  type, bind(c) :: nurbs_hydrostatics
    real(c_double) :: wetted_area
    real(c_double) :: volume
    real(c_double) :: centroid(3)
    real(c_double) :: waterplane_area
    real(c_double) :: waterplane_centre
    real(c_double) :: waterplane_inertia_x
    real(c_double) :: waterplane_inertia_y
    real(c_double) :: beam
    real(c_double) :: draft
    real(c_double) :: keel_draft
    real(c_double) :: x_aft
    real(c_double) :: x_fore
    real(c_double) :: transom_area
    real(c_double) :: section_area_max
    real(c_double) :: section_area_max_x
    real(c_double) :: error
    real(c_double) :: reserved(8)
  end type

  type, bind(c) :: nurbs_moments
    real(c_double) :: area
    real(c_double) :: volume
    real(c_double) :: moment(3)
    real(c_double) :: second(6)
    real(c_double) :: reserved(8)
  end type

  type, bind(c) :: nurbs_hull_options
    real(c_double) :: level
    real(c_double) :: draft
    real(c_double) :: length
    real(c_double) :: cut
    real(c_double) :: simplify
    real(c_double) :: sinkage
    real(c_double) :: trim
    real(c_double) :: pivot
    logical(c_bool) :: unbounded
    logical(c_bool) :: single
    real(c_double) :: sections
    real(c_double) :: reserved(7)
  end type

  type, bind(c) :: igabem_hull_info
    real(c_double) :: length
    type(nurbs_hydrostatics) :: hydrostatics
    integer(c_int) :: surface_piercing
    integer(c_int) :: transom
    real(c_double) :: nu_s
    integer(c_size_t) :: patches
    real(c_double) :: reserved(8)
  end type

  type, bind(c) :: igabem_options
    real(c_double) :: froude
    real(c_double) :: gravity
    real(c_double) :: density
    integer(c_int) :: kernel
    integer(c_int) :: formulation
    integer(c_int) :: refine
    integer(c_int) :: refine_v
    integer(c_int) :: elements_u
    integer(c_int) :: elements_v
    real(c_double) :: waterline_span
    integer(c_int) :: degree
    integer(c_int) :: line_term
    real(c_double) :: cutoff_angle
    real(c_double) :: cutoff_factor
    real(c_double) :: stem_limit
    real(c_double) :: stern_length
    real(c_double) :: stern_blend
    real(c_double) :: spectrum_limit
    real(c_double) :: tolerance
    integer(c_int) :: solver
    integer(c_int) :: sensitivity
    integer(c_int) :: threads
    type(c_funptr) :: progress
    type(c_ptr) :: progress_user_data
    real(c_double) :: surface_cells
    real(c_double) :: surface_rows
    real(c_double) :: surface_first
    real(c_double) :: surface_damping
    real(c_double) :: surface_upstream
    real(c_double) :: surface_downstream
    real(c_double) :: surface_side
    real(c_double) :: surface_columns
    real(c_double) :: keep_system
    real(c_double) :: reserved(7)
  end type

  type, bind(c) :: igabem_cost
    integer(c_size_t) :: singular_pairs
    integer(c_size_t) :: near_pairs
    integer(c_size_t) :: far_pairs
    integer(c_size_t) :: rankine
    integer(c_size_t) :: local
    integer(c_size_t) :: wave
    real(c_double) :: reserved(4)
  end type

  type, bind(c) :: igabem_forces
    real(c_double) :: speed
    real(c_double) :: k0
    real(c_double) :: wetted_area
    real(c_double) :: volume
    real(c_double) :: rw
    real(c_double) :: cw
    real(c_double) :: cw_l2
    real(c_double) :: cw_pressure
    real(c_double) :: cw_pressure_linear
    real(c_double) :: cw_run_up
    real(c_double) :: cw_transom
    real(c_double) :: cw_cutoff_lower
    real(c_double) :: cw_cutoff_upper
    real(c_double) :: share_beyond_cutoff
    real(c_double) :: sinkage
    real(c_double) :: trim
    real(c_double) :: condition
    integer(c_size_t) :: iterations
    real(c_double) :: residual
    real(c_double) :: seconds
    real(c_double) :: memory
    integer(c_size_t) :: dofs
    type(igabem_cost) :: cost
    real(c_double) :: unknowns_per_wave
    real(c_double) :: cw_error
    real(c_double) :: cw_momentum
    real(c_double) :: reserved(6)
  end type

  type, bind(c) :: igabem_equilibrium
    real(c_double) :: sinkage
    real(c_double) :: trim
    real(c_double) :: pivot
    real(c_double) :: change
    integer(c_int) :: solves
    real(c_double) :: reserved(8)
  end type

  type, bind(c) :: igabem_water
    real(c_double) :: density
    real(c_double) :: viscosity
    real(c_double) :: form_factor
  end type

  type, bind(c) :: igabem_total
    real(c_double) :: reynolds
    real(c_double) :: cf
    real(c_double) :: ct
    real(c_double) :: rt
    real(c_double) :: reserved(8)
  end type

  type, bind(c) :: igabem_kelvin_filter
    real(c_double) :: cut_off
    real(c_double) :: depth
    real(c_double) :: reserved(8)
  end type

  type, bind(c) :: igabem_matrix_options
    integer(c_int) :: parts
    type(igabem_kelvin_filter) :: filter
    real(c_double) :: tolerance
    integer(c_int) :: threads
    real(c_double) :: reserved(8)
  end type

  type, bind(c) :: igabem_pressure_sample
    real(c_double) :: v(3)
    real(c_double) :: area
    real(c_double) :: rise
  end type

  type, bind(c) :: nurbs_ship_form
    real(c_double) :: length
    real(c_double) :: beam
    real(c_double) :: draft
    real(c_double) :: fullest
    real(c_double) :: transom_beam
    real(c_double) :: transom_draft
    real(c_double) :: run
    real(c_double) :: entrance
    real(c_double) :: section(3)
    real(c_double) :: rake
    real(c_double) :: bulb_length
    real(c_double) :: bulb_beam
    real(c_double) :: reserved(8)
  end type

  interface
    type(c_ptr) function igabem_status_string(status) bind(c)
      import
      integer(c_int), value :: status
    end function
    type(c_ptr) function igabem_last_error() bind(c)
      import
    end function
    type(c_ptr) function igabem_version() bind(c)
      import
    end function
    type(c_ptr) function igabem_formulation_info(formulation) bind(c)
      import
      integer(c_int), value :: formulation
    end function
    type(c_ptr) function igabem_formulation_name(formulation) bind(c)
      import
      integer(c_int), value :: formulation
    end function
    logical(c_bool) function igabem_formulation_parse(name, formulation) bind(c)
      import
      character(kind=c_char), intent(in), optional :: name(*)
      integer(c_int), intent(inout), optional :: formulation
    end function
    type(c_ptr) function nurbs_status_string(status) bind(c)
      import
      integer(c_int), value :: status
    end function
    type(c_ptr) function nurbs_last_error() bind(c)
      import
    end function
    type(c_ptr) function nurbs_version() bind(c)
      import
    end function
    integer(c_int) function nurbs_surface_create(degree, size, knots_u, knots_v, points, &
        weights, surface) bind(c)
      import
      integer(c_int), intent(in), optional :: degree(2)
      integer(c_size_t), intent(in), optional :: size(2)
      real(c_double), intent(in), optional :: knots_u(*)
      real(c_double), intent(in), optional :: knots_v(*)
      real(c_double), intent(in), optional :: points(*)
      real(c_double), intent(in), optional :: weights(*)
      type(c_ptr), intent(inout) :: surface
    end function
    integer(c_int) function nurbs_surface_copy(surface, copy) bind(c)
      import
      type(c_ptr), value :: surface
      type(c_ptr), intent(inout) :: copy
    end function
    subroutine nurbs_surface_free(surface) bind(c)
      import
      type(c_ptr), value :: surface
    end subroutine
    integer(c_int) function nurbs_surface_degree(surface, direction) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: direction
    end function
    integer(c_size_t) function nurbs_surface_size(surface, direction) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: direction
    end function
    type(c_ptr) function nurbs_surface_knots(surface, direction) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: direction
    end function
    type(c_ptr) function nurbs_surface_points(surface) bind(c)
      import
      type(c_ptr), value :: surface
    end function
    type(c_ptr) function nurbs_surface_weights(surface) bind(c)
      import
      type(c_ptr), value :: surface
    end function
    integer(c_int) function nurbs_surface_eval(surface, order, n, uv, out) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: order
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: uv(*)
      real(c_double), intent(inout), optional :: out(*)
    end function
    integer(c_int) function nurbs_surface_eval_sided(surface, order, left, n, uv, out) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: order
      integer(c_int), value :: left
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: uv(*)
      real(c_double), intent(inout), optional :: out(*)
    end function
    integer(c_int) function nurbs_surface_eval_grid(surface, order, nu, u, nv, v, out) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: order
      integer(c_size_t), value :: nu
      real(c_double), intent(in), optional :: u(*)
      integer(c_size_t), value :: nv
      real(c_double), intent(in), optional :: v(*)
      real(c_double), intent(inout), optional :: out(*)
    end function
    integer(c_int) function nurbs_surface_basis(surface, order, u, v, span, values) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: order
      real(c_double), value :: u
      real(c_double), value :: v
      integer(c_size_t), intent(inout), optional :: span(2)
      real(c_double), intent(inout), optional :: values(*)
    end function
    integer(c_int) function nurbs_surface_rows(surface, order, n, uv, columns, values) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: order
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: uv(*)
      integer(c_size_t), intent(inout), optional :: columns(*)
      real(c_double), intent(inout), optional :: values(*)
    end function
    integer(c_int) function nurbs_grid_create(rows, columns, points, grid) bind(c)
      import
      integer(c_size_t), value :: rows
      integer(c_size_t), value :: columns
      real(c_double), intent(in), optional :: points(*)
      type(c_ptr), intent(inout) :: grid
    end function
    subroutine nurbs_grid_free(grid) bind(c)
      import
      type(c_ptr), value :: grid
    end subroutine
    integer(c_size_t) function nurbs_grid_rows(grid) bind(c)
      import
      type(c_ptr), value :: grid
    end function
    integer(c_size_t) function nurbs_grid_columns(grid) bind(c)
      import
      type(c_ptr), value :: grid
    end function
    type(c_ptr) function nurbs_grid_points(grid) bind(c)
      import
      type(c_ptr), value :: grid
    end function
    type(c_ptr) function nurbs_grid_edit(grid) bind(c)
      import
      type(c_ptr), value :: grid
    end function
    integer(c_int) function nurbs_grid_read(path, grid) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), intent(inout) :: grid
    end function
    integer(c_int) function nurbs_grid_write(grid, path) bind(c)
      import
      type(c_ptr), value :: grid
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_grid_sample(surface, rows, u, columns, v, grid) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_size_t), value :: rows
      real(c_double), intent(in), optional :: u(*)
      integer(c_size_t), value :: columns
      real(c_double), intent(in), optional :: v(*)
      type(c_ptr), intent(inout) :: grid
    end function
    integer(c_int) function nurbs_patches_create(patches) bind(c)
      import
      type(c_ptr), intent(inout) :: patches
    end function
    subroutine nurbs_patches_free(patches) bind(c)
      import
      type(c_ptr), value :: patches
    end subroutine
    integer(c_int) function nurbs_patches_add(patches, surface) bind(c)
      import
      type(c_ptr), value :: patches
      type(c_ptr), value :: surface
    end function
    integer(c_size_t) function nurbs_patches_count(patches) bind(c)
      import
      type(c_ptr), value :: patches
    end function
    type(c_ptr) function nurbs_patches_get(patches, index) bind(c)
      import
      type(c_ptr), value :: patches
      integer(c_size_t), value :: index
    end function
    integer(c_int) function nurbs_patches_set_note(patches, text) bind(c)
      import
      type(c_ptr), value :: patches
      character(kind=c_char), intent(in), optional :: text(*)
    end function
    type(c_ptr) function nurbs_patches_note(patches) bind(c)
      import
      type(c_ptr), value :: patches
    end function
    integer(c_int) function nurbs_patches_set_length(patches, length) bind(c)
      import
      type(c_ptr), value :: patches
      real(c_double), value :: length
    end function
    real(c_double) function nurbs_patches_length(patches) bind(c)
      import
      type(c_ptr), value :: patches
    end function
    integer(c_int) function nurbs_patches_set_parameters(patches, index, rows, u, columns, &
        v) bind(c)
      import
      type(c_ptr), value :: patches
      integer(c_size_t), value :: index
      integer(c_size_t), value :: rows
      real(c_double), intent(in), optional :: u(*)
      integer(c_size_t), value :: columns
      real(c_double), intent(in), optional :: v(*)
    end function
    integer(c_size_t) function nurbs_patches_parameters(patches, index, direction, &
        values) bind(c)
      import
      type(c_ptr), value :: patches
      integer(c_size_t), value :: index
      integer(c_int), value :: direction
      type(c_ptr), intent(in) :: values(*)
    end function
    integer(c_int) function nurbs_hydrostatics_compute(n, wetted, level, result) bind(c)
      import
      integer(c_size_t), value :: n
      type(c_ptr), intent(in) :: wetted(*)
      real(c_double), value :: level
      type(nurbs_hydrostatics), intent(inout), optional :: result
    end function
    integer(c_int) function nurbs_hydrostatics_whole(n, wetted, level, result) bind(c)
      import
      integer(c_size_t), value :: n
      type(c_ptr), intent(in) :: wetted(*)
      real(c_double), value :: level
      type(nurbs_hydrostatics), intent(inout), optional :: result
    end function
    integer(c_int) function nurbs_transom_patches(n, wetted, level, closes) bind(c)
      import
      integer(c_size_t), value :: n
      type(c_ptr), intent(in) :: wetted(*)
      real(c_double), value :: level
      integer(c_int), intent(inout), optional :: closes(*)
    end function
    integer(c_int) function nurbs_surface_area(surface, area, error) bind(c)
      import
      type(c_ptr), value :: surface
      real(c_double), intent(inout), optional :: area
      real(c_double), intent(inout), optional :: error
    end function
    integer(c_int) function nurbs_surface_moments(surface, moments, gradient) bind(c)
      import
      type(c_ptr), value :: surface
      type(nurbs_moments), intent(inout), optional :: moments
      real(c_double), intent(inout), optional :: gradient(*)
    end function
    integer(c_int) function nurbs_patches_moments(patches, moments, error) bind(c)
      import
      type(c_ptr), value :: patches
      type(nurbs_moments), intent(inout), optional :: moments
      type(nurbs_moments), intent(inout), optional :: error
    end function
    subroutine nurbs_hull_options_init(options) bind(c)
      import
      type(nurbs_hull_options), intent(inout), optional :: options
    end subroutine
    integer(c_int) function nurbs_hull_read(path, options, hull) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(nurbs_hull_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: hull
    end function
    integer(c_int) function nurbs_hull_create(patches, options, hull) bind(c)
      import
      type(c_ptr), value :: patches
      type(nurbs_hull_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: hull
    end function
    integer(c_int) function nurbs_hull_create_surfaces(n, surfaces, options, hull) bind(c)
      import
      integer(c_size_t), value :: n
      type(c_ptr), intent(in) :: surfaces(*)
      type(nurbs_hull_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: hull
    end function
    subroutine nurbs_hull_free(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end subroutine
    integer(c_int) function nurbs_hull_design_grid(hull, rows, columns, grid) bind(c)
      import
      type(c_ptr), value :: hull
      integer(c_size_t), value :: rows
      integer(c_size_t), value :: columns
      type(c_ptr), intent(inout) :: grid
    end function
    integer(c_int) function nurbs_patches_design_grid(patches, index, rows, columns, &
        grid) bind(c)
      import
      type(c_ptr), value :: patches
      integer(c_size_t), value :: index
      integer(c_size_t), value :: rows
      integer(c_size_t), value :: columns
      type(c_ptr), intent(inout) :: grid
    end function
    integer(c_int) function nurbs_patches_design_parameters(patches, index, axis, n, &
        parameters) bind(c)
      import
      type(c_ptr), value :: patches
      integer(c_size_t), value :: index
      integer(c_int), value :: axis
      integer(c_size_t), value :: n
      real(c_double), intent(inout), optional :: parameters(*)
    end function
    integer(c_int) function nurbs_hull_rebuild(parent, grid, hull) bind(c)
      import
      type(c_ptr), value :: parent
      type(c_ptr), value :: grid
      type(c_ptr), intent(inout) :: hull
    end function
    integer(c_int) function nurbs_hull_share_space(parent, grid, n, designs) bind(c)
      import
      type(c_ptr), value :: parent
      type(c_ptr), value :: grid
      integer(c_size_t), value :: n
      type(c_ptr), intent(in) :: designs(*)
    end function
    logical(c_bool) function nurbs_hull_shares_space(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    integer(c_int) function nurbs_hull_moves(hull, moved, move) bind(c)
      import
      type(c_ptr), value :: hull
      type(c_ptr), value :: moved
      real(c_double), intent(inout), optional :: move(*)
    end function
    integer(c_int) function nurbs_hull_read_patches(path, tolerance, patches, report, &
        report_size) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      real(c_double), value :: tolerance
      type(c_ptr), intent(inout) :: patches
      character(kind=c_char), intent(inout), optional :: report(*)
      integer(c_size_t), value :: report_size
    end function
    integer(c_int) function nurbs_patches_snap(patches, tolerance, result, edges, moved) bind(c)
      import
      type(c_ptr), value :: patches
      real(c_double), value :: tolerance
      type(c_ptr), intent(inout) :: result
      integer(c_size_t), intent(inout), optional :: edges
      real(c_double), intent(inout), optional :: moved
    end function
    type(c_ptr) function nurbs_hull_full(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    type(c_ptr) function nurbs_hull_wetted(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    type(c_ptr) function nurbs_hull_light(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    real(c_double) function nurbs_hull_bound(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    real(c_double) function nurbs_hull_deviation(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    real(c_double) function nurbs_hull_level(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    real(c_double) function nurbs_hull_length(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    real(c_double) function nurbs_hull_lpp(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    logical(c_bool) function nurbs_hull_is_half(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    logical(c_bool) function nurbs_hull_is_cut(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    logical(c_bool) function nurbs_hull_has_waterline(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    type(c_ptr) function nurbs_hull_hydrostatics(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end function
    type(c_ptr) function nurbs_hull_step(hull, number) bind(c)
      import
      type(c_ptr), value :: hull
      integer(c_size_t), value :: number
    end function
    integer(c_int) function nurbs_hull_write(hull, note, path) bind(c)
      import
      type(c_ptr), value :: hull
      character(kind=c_char), intent(in), optional :: note(*)
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function igabem_hull_create(patches, n, flags, hull) bind(c)
      import
      type(c_ptr), intent(in) :: patches(*)
      integer(c_size_t), value :: n
      integer(c_int), value :: flags
      type(c_ptr), intent(inout) :: hull
    end function
    integer(c_int) function igabem_hull_from(source, hull) bind(c)
      import
      type(c_ptr), value :: source
      type(c_ptr), intent(inout) :: hull
    end function
    subroutine igabem_hull_free(hull) bind(c)
      import
      type(c_ptr), value :: hull
    end subroutine
    integer(c_int) function igabem_hull_set_length(hull, length) bind(c)
      import
      type(c_ptr), value :: hull
      real(c_double), value :: length
    end function
    subroutine igabem_hull_get_info(hull, info) bind(c)
      import
      type(c_ptr), value :: hull
      type(igabem_hull_info), intent(inout), optional :: info
    end subroutine
    type(c_ptr) function igabem_hull_warning(hull, number) bind(c)
      import
      type(c_ptr), value :: hull
      integer(c_size_t), value :: number
    end function
    subroutine igabem_options_init(options) bind(c)
      import
      type(igabem_options), intent(inout), optional :: options
    end subroutine
    integer(c_int) function igabem_options_freeze(hull, options) bind(c)
      import
      type(c_ptr), value :: hull
      type(igabem_options), intent(inout), optional :: options
    end function
    subroutine igabem_options_refine(hull, unknowns, options) bind(c)
      import
      type(c_ptr), value :: hull
      integer(c_size_t), value :: unknowns
      type(igabem_options), intent(inout), optional :: options
    end subroutine
    integer(c_int) function igabem_solve(hull, options, solution) bind(c)
      import
      type(c_ptr), value :: hull
      type(igabem_options), intent(in), optional :: options
      type(c_ptr), intent(inout) :: solution
    end function
    integer(c_int) function igabem_solve_many(hull, n, options, solutions) bind(c)
      import
      type(c_ptr), value :: hull
      integer(c_size_t), value :: n
      type(igabem_options), intent(in), optional :: options(*)
      type(c_ptr), intent(inout) :: solutions(*)
    end function
    subroutine igabem_solution_free(solution) bind(c)
      import
      type(c_ptr), value :: solution
    end subroutine
    integer(c_int) function igabem_forces_compute(solution, forces) bind(c)
      import
      type(c_ptr), value :: solution
      type(igabem_forces), intent(inout), optional :: forces
    end function
    type(c_ptr) function igabem_solution_warning(solution, forces, number) bind(c)
      import
      type(c_ptr), value :: solution
      type(igabem_forces), intent(in), optional :: forces
      integer(c_size_t), value :: number
    end function
    integer(c_int) function igabem_solve_hull(hull, options, forces) bind(c)
      import
      type(c_ptr), value :: hull
      type(igabem_options), intent(in), optional :: options
      type(igabem_forces), intent(inout), optional :: forces
    end function
    type(c_ptr) function igabem_solution_options(solution) bind(c)
      import
      type(c_ptr), value :: solution
    end function
    integer(c_int) function igabem_wave_elevation(solution, n, x, y, zeta) bind(c)
      import
      type(c_ptr), value :: solution
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(inout), optional :: zeta(*)
    end function
    integer(c_int) function igabem_surface_velocity(solution, patch, n, uv, velocity, &
        cp) bind(c)
      import
      type(c_ptr), value :: solution
      integer(c_size_t), value :: patch
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: uv(*)
      real(c_double), intent(inout), optional :: velocity(*)
      real(c_double), intent(inout), optional :: cp(*)
    end function
    integer(c_int) function igabem_source_density(solution, patch, n, uv, sigma) bind(c)
      import
      type(c_ptr), value :: solution
      integer(c_size_t), value :: patch
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: uv(*)
      real(c_double), intent(inout), optional :: sigma(*)
    end function
    integer(c_int) function igabem_kochin(solution, n, t, h, dcw) bind(c)
      import
      type(c_ptr), value :: solution
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: t(*)
      real(c_double), intent(inout), optional :: h(2, *)
      real(c_double), intent(inout), optional :: dcw(*)
    end function
    integer(c_int) function igabem_wave_shares(solution, n, x, share) bind(c)
      import
      type(c_ptr), value :: solution
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(inout), optional :: share(*)
    end function
    integer(c_int) function igabem_free_surface_grid(solution, size, x, y) bind(c)
      import
      type(c_ptr), value :: solution
      integer(c_size_t), intent(inout), optional :: size(2)
      real(c_double), intent(inout), optional :: x(*)
      real(c_double), intent(inout), optional :: y(*)
    end function
    integer(c_int) function igabem_wave_cut(solution, y, cw) bind(c)
      import
      type(c_ptr), value :: solution
      real(c_double), value :: y
      real(c_double), intent(inout), optional :: cw
    end function
    integer(c_int) function igabem_equilibrium_find(patches, placement, options, equilibrium, &
        hull) bind(c)
      import
      type(c_ptr), value :: patches
      type(nurbs_hull_options), intent(in), optional :: placement
      type(igabem_options), intent(inout), optional :: options
      type(igabem_equilibrium), intent(inout), optional :: equilibrium
      type(c_ptr), intent(inout) :: hull
    end function
    real(c_double) function igabem_friction_ittc57(reynolds) bind(c)
      import
      real(c_double), value :: reynolds
    end function
    integer(c_int) function igabem_total_resistance(forces, length, water, total) bind(c)
      import
      type(igabem_forces), intent(in), optional :: forces
      real(c_double), value :: length
      type(igabem_water), intent(in), optional :: water
      type(igabem_total), intent(inout), optional :: total
    end function
    integer(c_int) function igabem_kelvin_local(n, x, y, z, n_, nx, ny, nz) bind(c)
      import
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      real(c_double), intent(inout), optional :: n_(*)
      real(c_double), intent(inout), optional :: nx(*)
      real(c_double), intent(inout), optional :: ny(*)
      real(c_double), intent(inout), optional :: nz(*)
    end function
    integer(c_int) function igabem_kelvin_local_second(n, x, y, z, nxx, nxy, nxz, nyy, nyz, &
        nzz) bind(c)
      import
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      real(c_double), intent(inout), optional :: nxx(*)
      real(c_double), intent(inout), optional :: nxy(*)
      real(c_double), intent(inout), optional :: nxz(*)
      real(c_double), intent(inout), optional :: nyy(*)
      real(c_double), intent(inout), optional :: nyz(*)
      real(c_double), intent(inout), optional :: nzz(*)
    end function
    subroutine igabem_kelvin_filter_init(filter) bind(c)
      import
      type(igabem_kelvin_filter), intent(inout), optional :: filter
    end subroutine
    integer(c_int) function igabem_kelvin_wave(n, x, y, z, w, wx, wy, wz) bind(c)
      import
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      real(c_double), intent(inout), optional :: w(*)
      real(c_double), intent(inout), optional :: wx(*)
      real(c_double), intent(inout), optional :: wy(*)
      real(c_double), intent(inout), optional :: wz(*)
    end function
    integer(c_int) function igabem_kelvin_wave_second(n, x, y, z, wxx, wxy, wxz, wyy, wyz, &
        wzz) bind(c)
      import
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      real(c_double), intent(inout), optional :: wxx(*)
      real(c_double), intent(inout), optional :: wxy(*)
      real(c_double), intent(inout), optional :: wxz(*)
      real(c_double), intent(inout), optional :: wyy(*)
      real(c_double), intent(inout), optional :: wyz(*)
      real(c_double), intent(inout), optional :: wzz(*)
    end function
    integer(c_int) function igabem_kelvin_wave_filtered(n, x, y, z, filter, w, wx, wy, &
        wz) bind(c)
      import
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      type(igabem_kelvin_filter), intent(in), optional :: filter
      real(c_double), intent(inout), optional :: w(*)
      real(c_double), intent(inout), optional :: wx(*)
      real(c_double), intent(inout), optional :: wy(*)
      real(c_double), intent(inout), optional :: wz(*)
    end function
    integer(c_int) function igabem_kelvin_green(k0, n, x, y, z, xi, eta, zeta, parts, g, gx, &
        gy, gz) bind(c)
      import
      real(c_double), value :: k0
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      real(c_double), intent(in), optional :: xi(*)
      real(c_double), intent(in), optional :: eta(*)
      real(c_double), intent(in), optional :: zeta(*)
      integer(c_int), value :: parts
      real(c_double), intent(inout), optional :: g(*)
      real(c_double), intent(inout), optional :: gx(*)
      real(c_double), intent(inout), optional :: gy(*)
      real(c_double), intent(inout), optional :: gz(*)
    end function
    integer(c_int) function igabem_kelvin_green_second(k0, n, x, y, z, xi, eta, zeta, parts, &
        gxx, gxy, gxz, gyy, gyz, gzz) bind(c)
      import
      real(c_double), value :: k0
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      real(c_double), intent(in), optional :: xi(*)
      real(c_double), intent(in), optional :: eta(*)
      real(c_double), intent(in), optional :: zeta(*)
      integer(c_int), value :: parts
      real(c_double), intent(inout), optional :: gxx(*)
      real(c_double), intent(inout), optional :: gxy(*)
      real(c_double), intent(inout), optional :: gxz(*)
      real(c_double), intent(inout), optional :: gyy(*)
      real(c_double), intent(inout), optional :: gyz(*)
      real(c_double), intent(inout), optional :: gzz(*)
    end function
    integer(c_int) function igabem_kelvin_source_resistance(rho, k0, depth, strength, &
        resistance) bind(c)
      import
      real(c_double), value :: rho
      real(c_double), value :: k0
      real(c_double), value :: depth
      real(c_double), value :: strength
      real(c_double), intent(inout), optional :: resistance
    end function
    integer(c_int) function igabem_kelvin_dipole_resistance(rho, k0, depth, moment, &
        resistance) bind(c)
      import
      real(c_double), value :: rho
      real(c_double), value :: k0
      real(c_double), value :: depth
      real(c_double), value :: moment
      real(c_double), intent(inout), optional :: resistance
    end function
    integer(c_int) function igabem_kelvin_sphere_resistance(rho, gravity, k0, depth, radius, &
        resistance) bind(c)
      import
      real(c_double), value :: rho
      real(c_double), value :: gravity
      real(c_double), value :: k0
      real(c_double), value :: depth
      real(c_double), value :: radius
      real(c_double), intent(inout), optional :: resistance
    end function
    integer(c_int) function igabem_kochin_points(k0, nt, t, n, x, y, z, strength, hr, &
        hi) bind(c)
      import
      real(c_double), value :: k0
      integer(c_size_t), value :: nt
      real(c_double), intent(in), optional :: t(*)
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: x(*)
      real(c_double), intent(in), optional :: y(*)
      real(c_double), intent(in), optional :: z(*)
      real(c_double), intent(in), optional :: strength(*)
      real(c_double), intent(inout), optional :: hr(*)
      real(c_double), intent(inout), optional :: hi(*)
    end function
    integer(c_int) function igabem_kochin_segments(k0, nt, t, n, ends, strength, hr, hi) bind(c)
      import
      real(c_double), value :: k0
      integer(c_size_t), value :: nt
      real(c_double), intent(in), optional :: t(*)
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: ends(*)
      real(c_double), intent(in), optional :: strength(*)
      real(c_double), intent(inout), optional :: hr(*)
      real(c_double), intent(inout), optional :: hi(*)
    end function
    integer(c_int) function igabem_kochin_triangles(k0, nt, t, n, corners, strength, hr, &
        hi) bind(c)
      import
      real(c_double), value :: k0
      integer(c_size_t), value :: nt
      real(c_double), intent(in), optional :: t(*)
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: corners(*)
      real(c_double), intent(in), optional :: strength(*)
      real(c_double), intent(inout), optional :: hr(*)
      real(c_double), intent(inout), optional :: hi(*)
    end function
    subroutine igabem_ladder_level(level, options) bind(c)
      import
      integer(c_size_t), value :: level
      type(igabem_options), intent(inout), optional :: options
    end subroutine
    integer(c_size_t) function igabem_ladder_unknowns(levels) bind(c)
      import
      integer(c_size_t), value :: levels
    end function
    integer(c_int) function igabem_ladder_order(h, c, order, limit) bind(c)
      import
      real(c_double), intent(in), optional :: h(3)
      real(c_double), intent(in), optional :: c(3)
      real(c_double), intent(inout), optional :: order
      real(c_double), intent(inout), optional :: limit
    end function
    subroutine igabem_matrix_options_init(options) bind(c)
      import
      type(igabem_matrix_options), intent(inout), optional :: options
    end subroutine
    integer(c_int) function igabem_green_matrix(k0, n, points, normals, m, sources, options, &
        value, gradient, slope) bind(c)
      import
      real(c_double), value :: k0
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: points(*)
      real(c_double), intent(in), optional :: normals(*)
      integer(c_size_t), value :: m
      real(c_double), intent(in), optional :: sources(*)
      type(igabem_matrix_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: value(*)
      real(c_double), intent(inout), optional :: gradient(*)
      real(c_double), intent(inout), optional :: slope(*)
    end function
    integer(c_int) function igabem_panel_matrix(k0, n, points, normals, m, corners, options, &
        value, gradient, slope) bind(c)
      import
      real(c_double), value :: k0
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: points(*)
      real(c_double), intent(in), optional :: normals(*)
      integer(c_size_t), value :: m
      real(c_double), intent(in), optional :: corners(*)
      type(igabem_matrix_options), intent(in), optional :: options
      real(c_double), intent(inout), optional :: value(*)
      real(c_double), intent(inout), optional :: gradient(*)
      real(c_double), intent(inout), optional :: slope(*)
    end function
    integer(c_int) function igabem_panel_frames(m, corners, centroid, normal, area) bind(c)
      import
      integer(c_size_t), value :: m
      real(c_double), intent(in), optional :: corners(*)
      real(c_double), intent(inout), optional :: centroid(*)
      real(c_double), intent(inout), optional :: normal(*)
      real(c_double), intent(inout), optional :: area(*)
    end function
    integer(c_int) function igabem_wave_residuals(solution, r) bind(c)
      import
      type(c_ptr), value :: solution
      real(c_double), intent(inout), optional :: r(*)
    end function
    integer(c_int) function igabem_pressure_samples(solution, n_u, n_v, n, sample) bind(c)
      import
      type(c_ptr), value :: solution
      integer(c_size_t), value :: n_u
      integer(c_size_t), value :: n_v
      integer(c_size_t), intent(inout), optional :: n
      type(c_ptr), intent(inout) :: sample
    end function
    real(c_double) function igabem_pressure_sum(n, sample, gradient) bind(c)
      import
      integer(c_size_t), value :: n
      type(igabem_pressure_sample), intent(in), optional :: sample(*)
      type(igabem_pressure_sample), intent(inout), optional :: gradient(*)
    end function
    integer(c_int) function igabem_tangent_create(hull, solution, n, move, tangent) bind(c)
      import
      type(c_ptr), value :: hull
      type(c_ptr), value :: solution
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: move(*)
      type(c_ptr), intent(inout) :: tangent
    end function
    subroutine igabem_tangent_free(tangent) bind(c)
      import
      type(c_ptr), value :: tangent
    end subroutine
    integer(c_int) function igabem_tangent_kochin(tangent, m, t, dh) bind(c)
      import
      type(c_ptr), value :: tangent
      integer(c_size_t), value :: m
      real(c_double), intent(in), optional :: t(*)
      real(c_double), intent(inout), optional :: dh(2, *)
    end function
    integer(c_int) function igabem_tangent_residuals(tangent, dr) bind(c)
      import
      type(c_ptr), value :: tangent
      real(c_double), intent(inout), optional :: dr(*)
    end function
    integer(c_int) function igabem_tangent_cw(tangent, dcw) bind(c)
      import
      type(c_ptr), value :: tangent
      real(c_double), intent(inout), optional :: dcw(*)
    end function
    integer(c_int) function igabem_tangent_wetted_area(tangent, darea) bind(c)
      import
      type(c_ptr), value :: tangent
      real(c_double), intent(inout), optional :: darea(*)
    end function
    integer(c_int) function igabem_tangent_samples(tangent, n_u, n_v, dsample) bind(c)
      import
      type(c_ptr), value :: tangent
      integer(c_size_t), value :: n_u
      integer(c_size_t), value :: n_v
      type(igabem_pressure_sample), intent(inout), optional :: dsample(*)
    end function
    integer(c_int) function igabem_cw_gradient(hull, solution, dcw) bind(c)
      import
      type(c_ptr), value :: hull
      type(c_ptr), value :: solution
      real(c_double), intent(inout), optional :: dcw(*)
    end function
    integer(c_int) function nurbs_curve_create(degree, n, knots, points, weights, curve) bind(c)
      import
      integer(c_int), value :: degree
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: knots(*)
      real(c_double), intent(in), optional :: points(*)
      real(c_double), intent(in), optional :: weights(*)
      type(c_ptr), intent(inout) :: curve
    end function
    integer(c_int) function nurbs_curve_copy(curve, copy) bind(c)
      import
      type(c_ptr), value :: curve
      type(c_ptr), intent(inout) :: copy
    end function
    subroutine nurbs_curve_free(curve) bind(c)
      import
      type(c_ptr), value :: curve
    end subroutine
    integer(c_int) function nurbs_curve_degree(curve) bind(c)
      import
      type(c_ptr), value :: curve
    end function
    integer(c_size_t) function nurbs_curve_size(curve) bind(c)
      import
      type(c_ptr), value :: curve
    end function
    type(c_ptr) function nurbs_curve_knots(curve) bind(c)
      import
      type(c_ptr), value :: curve
    end function
    type(c_ptr) function nurbs_curve_points(curve) bind(c)
      import
      type(c_ptr), value :: curve
    end function
    type(c_ptr) function nurbs_curve_weights(curve) bind(c)
      import
      type(c_ptr), value :: curve
    end function
    integer(c_int) function nurbs_curve_eval(curve, order, n, u, out) bind(c)
      import
      type(c_ptr), value :: curve
      integer(c_int), value :: order
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: u(*)
      real(c_double), intent(inout), optional :: out(*)
    end function
    integer(c_int) function nurbs_curve_eval_left(curve, order, n, u, out) bind(c)
      import
      type(c_ptr), value :: curve
      integer(c_int), value :: order
      integer(c_size_t), value :: n
      real(c_double), intent(in), optional :: u(*)
      real(c_double), intent(inout), optional :: out(*)
    end function
    integer(c_int) function nurbs_patches_read_json(path, patches) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), intent(inout) :: patches
    end function
    integer(c_int) function nurbs_patches_write_json(patches, path) bind(c)
      import
      type(c_ptr), value :: patches
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_patches_read_iges(path, patches, report, report_size) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), intent(inout) :: patches
      character(kind=c_char), intent(inout), optional :: report(*)
      integer(c_size_t), value :: report_size
    end function
    integer(c_int) function nurbs_patches_write_iges(patches, path) bind(c)
      import
      type(c_ptr), value :: patches
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_patches_read_iges_untrimmed(path, tolerance, patches, &
        report, report_size) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      real(c_double), value :: tolerance
      type(c_ptr), intent(inout) :: patches
      character(kind=c_char), intent(inout), optional :: report(*)
      integer(c_size_t), value :: report_size
    end function
    integer(c_int) function nurbs_patches_read_step(path, tolerance, patches, report, &
        report_size) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      real(c_double), value :: tolerance
      type(c_ptr), intent(inout) :: patches
      character(kind=c_char), intent(inout), optional :: report(*)
      integer(c_size_t), value :: report_size
    end function
    integer(c_int) function nurbs_patches_write_step(patches, path) bind(c)
      import
      type(c_ptr), value :: patches
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_curves_read_iges(path, n, curves) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      integer(c_size_t), intent(inout), optional :: n
      type(c_ptr), intent(inout) :: curves
    end function
    subroutine nurbs_curves_free(n, curves) bind(c)
      import
      integer(c_size_t), value :: n
      type(c_ptr), intent(inout) :: curves(*)
    end subroutine
    integer(c_int) function nurbs_patches_write_stl(patches, parts, path) bind(c)
      import
      type(c_ptr), value :: patches
      integer(c_int), value :: parts
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_patches_write_vtu(patches, parts, path) bind(c)
      import
      type(c_ptr), value :: patches
      integer(c_int), value :: parts
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_patches_write_points(patches, path) bind(c)
      import
      type(c_ptr), value :: patches
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_patches_read(path, patches) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      type(c_ptr), intent(inout) :: patches
    end function
    integer(c_int) function nurbs_patches_read_reported(path, tolerance, patches, report, &
        report_size) bind(c)
      import
      character(kind=c_char), intent(in), optional :: path(*)
      real(c_double), value :: tolerance
      type(c_ptr), intent(inout) :: patches
      character(kind=c_char), intent(inout), optional :: report(*)
      integer(c_size_t), value :: report_size
    end function
    integer(c_int) function nurbs_patches_write(patches, path) bind(c)
      import
      type(c_ptr), value :: patches
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_surface_write_iges(surface, path) bind(c)
      import
      type(c_ptr), value :: surface
      character(kind=c_char), intent(in), optional :: path(*)
    end function
    integer(c_int) function nurbs_make_ellipsoid(length, beam, height, depth, surface) bind(c)
      import
      real(c_double), value :: length
      real(c_double), value :: beam
      real(c_double), value :: height
      real(c_double), value :: depth
      type(c_ptr), intent(inout) :: surface
    end function
    integer(c_int) function nurbs_make_wigley(length, beam, draft, surface) bind(c)
      import
      real(c_double), value :: length
      real(c_double), value :: beam
      real(c_double), value :: draft
      type(c_ptr), intent(inout) :: surface
    end function
    integer(c_int) function nurbs_ship_form_fast(length, beam, draft, form) bind(c)
      import
      real(c_double), value :: length
      real(c_double), value :: beam
      real(c_double), value :: draft
      type(nurbs_ship_form), intent(inout), optional :: form
    end function
    integer(c_int) function nurbs_ship_form_bulb(length, beam, draft, form) bind(c)
      import
      real(c_double), value :: length
      real(c_double), value :: beam
      real(c_double), value :: draft
      type(nurbs_ship_form), intent(inout), optional :: form
    end function
    integer(c_int) function nurbs_make_ship(form, surface) bind(c)
      import
      type(nurbs_ship_form), intent(in), optional :: form
      type(c_ptr), intent(inout) :: surface
    end function
  end interface
end module
