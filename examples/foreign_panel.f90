! A Neumann-Kelvin panel code of one's own on the kernel of libigabem, as foreign_panel.c: flat panels of
! constant source density on a submerged spheroid, sigma/2 + Int sigma dG/dn = U n_x.
!   gfortran igabem.f90 foreign_panel.f90 $(pkg-config --libs libigabem)
program foreign_panel
  use, intrinsic :: iso_c_binding, only: dp => c_double, c_size_t
  use igabem
  implicit none
  real(dp), parameter :: pi = 3.14159265358979323846_dp, gravity = 9.80665_dp, density = 1000
  real(dp), parameter :: length = 2, radius = 0.2_dp, depth = 0.5_dp, froude = 0.6_dp
  real(dp) :: coarse, fine, limit, ours

  coarse = panel_cw(8, 6)
  fine = panel_cw(16, 12)
  limit = fine + (fine - coarse)/3 ! the error falls as h^2
  ours = spline_cw()
  print '(a, 2es13.5)', 'C_w by 48 and 192 panels a side  ', coarse, fine
  print '(a, 2es13.5)', 'their limit, and libigabem       ', limit, ours
  if (.not. abs(limit/ours - 1) < 0.01_dp) error stop 'foreign_panel: the two codes differ'

contains

  subroutine must(status)
    integer(c_int), intent(in) :: status
    if (status == igabem_ok) return
    print '(2a)', 'foreign_panel: ', igabem_error_message()
    error stop
  end subroutine

  function place(theta, psi) result(at)
    real(dp), intent(in) :: theta, psi
    real(dp) :: at(3)
    at = [length/2*cos(theta), radius*sin(theta)*cos(psi), radius*sin(theta)*sin(psi) - depth]
  end function

  ! C_w = R/(rho U^2 S/2) of rows x columns panels on the side y > 0 and their mirror images.
  real(dp) function panel_cw(rows, columns) result(cw)
    integer, intent(in) :: rows, columns
    real(dp), dimension(3, rows*columns, 2) :: centre, normal ! of a side and of the other one
    real(dp) :: corners(3, 4, rows*columns), area(rows*columns), sigma(rows*columns)
    real(dp) :: slope(rows*columns, rows*columns, 2), theta, psi, speed, k0
    type(igabem_matrix_options) :: options
    integer :: r, c, i, n
    n = rows*columns
    speed = froude*sqrt(gravity*length)
    k0 = gravity/speed**2
    do r = 0, rows - 1
      do c = 0, columns - 1
        theta = pi*r/rows
        psi = pi*c/columns - pi/2
        corners(:, 1, r*columns + c + 1) = place(theta, psi)
        corners(:, 2, r*columns + c + 1) = place(theta + pi/rows, psi)
        corners(:, 3, r*columns + c + 1) = place(theta + pi/rows, psi + pi/columns)
        corners(:, 4, r*columns + c + 1) = place(theta, psi + pi/columns)
      end do
    end do
    call must(igabem_panel_frames(int(n, c_size_t), corners, centre, normal, area))
    ! What the mirrored panels do to the points is what the panels do to the mirrored points.
    centre(:, :, 2) = centre(:, :, 1)
    normal(:, :, 2) = normal(:, :, 1)
    centre(2, :, 2) = -centre(2, :, 1)
    normal(2, :, 2) = -normal(2, :, 1)
    ! slope(j, i, side): panel j at point i, the transpose of what the equations need.
    call igabem_matrix_options_init(options)
    options%tolerance = 1e-3_dp
    call must(igabem_panel_matrix(k0, int(2*n, c_size_t), centre, normal, int(n, c_size_t), corners, options, slope=slope))
    slope(:, :, 1) = transpose(slope(:, :, 1) + slope(:, :, 2))
    do i = 1, n
      slope(i, i, 1) = slope(i, i, 1) + 0.5_dp ! the jump: the water is where the normals point
    end do
    ! What a panel emits leaves the body: its diagonal takes what flat panels miss of curvature.
    do i = 1, n
      slope(i, i, 1) = slope(i, i, 1) + 1 - dot_product(area, slope(:, i, 1))/area(i)
    end do
    sigma = speed*normal(1, :, 1)
    call eliminate(slope(:, :, 1), sigma)
    cw = resistance(k0, centre, sigma*area)/(0.5_dp*density*speed**2*2*sum(area))
  end function

  ! Gaussian elimination; a matrix with sigma/2 on its diagonal needs no pivots.
  subroutine eliminate(a, b)
    real(dp), intent(inout) :: a(:, :), b(:)
    real(dp) :: factors(size(b))
    integer :: k, j
    do k = 1, size(b)
      factors = a(:, k)/a(k, k)
      factors(:k) = 0
      do j = k, size(b)
        a(:, j) = a(:, j) - factors*a(k, j)
      end do
      b = b - factors*b(k)
    end do
    do k = size(b), 1, -1
      b(k) = (b(k) - dot_product(a(k, k + 1:), b(k + 1:)))/a(k, k)
    end do
  end subroutine

  ! R = (rho k0^2/2 pi) Int |H|^2 sqrt(1+t^2) dt with t = sinh(s), H of both sides.
  real(dp) function resistance(k0, centre, strength) result(r)
    real(dp), intent(in) :: k0, centre(:, :, :), strength(:)
    integer, parameter :: half = 200, angles = 2*half + 1
    real(dp), parameter :: step = 0.02_dp
    real(dp) :: t(angles), hr(angles, 2), hi(angles, 2)
    integer :: i, side
    t = sinh([(step*i, i=-half, half)])
    do side = 1, 2
      call must(igabem_kochin_points(k0, int(angles, c_size_t), t, int(size(strength), c_size_t), centre(1, :, side), &
                                     centre(2, :, side), centre(3, :, side), strength, hr(:, side), hi(:, side)))
    end do
    r = density*k0**2/(2*pi)*step*sum((1 + t**2)*(sum(hr, 2)**2 + sum(hi, 2)**2))
  end function

  ! The same by libigabem's own solver: splines on the exact spheroid.
  real(dp) function spline_cw() result(cw)
    type(c_ptr) :: patches(1), hull, flow
    type(igabem_options) :: options
    type(igabem_forces) :: forces
    call igabem_options_init(options)
    options%froude = froude
    call must(nurbs_make_ellipsoid(length, 2*radius, 2*radius, depth, patches(1)))
    call must(igabem_hull_create(patches, 1_c_size_t, igabem_symmetric, hull))
    call igabem_options_refine(hull, 100_c_size_t, options)
    call must(igabem_solve(hull, options, flow))
    call must(igabem_forces_compute(flow, forces))
    if (.not. forces%unknowns_per_wave > 1) error stop 'foreign_panel: forces are laid out otherwise'
    cw = forces%cw
    call igabem_solution_free(flow)
    call igabem_hull_free(hull)
    call nurbs_surface_free(patches(1))
  end function

end program
