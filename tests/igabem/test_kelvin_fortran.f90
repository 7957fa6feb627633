! The Fortran module against values of tests/data/kelvin_reference.csv.
program test_kelvin_fortran
  use, intrinsic :: iso_c_binding, only: dp => c_double
  use igabem
  implicit none
  real(dp), parameter :: pi = 3.14159265358979323846_dp
  ! Row X = -1.34164, Y = 4.47214, Z = -1.78885: N and W.
  real(dp), parameter :: local = -0.44864439739399222_dp, wave = -0.091501642407751850_dp
  real(dp) :: x(2), y(2), z(2), g(2), gx(2), gy(2), gz(2), one, onex, oney, onez
  integer :: status
  x = [-1.34164_dp, 1.34164_dp]
  y = [4.47214_dp, -4.47214_dp]
  z = -1.78885_dp

  call kelvin_local(x, y, z, g, gx, gy, gz)
  call check(abs(g(1) - local) < 1e-11_dp, 'N')
  call check(gx(1) == -gx(2) .and. gy(1) == -gy(2), 'symmetry of N')
  call kelvin_wave(x, y, z, g, gx, gy, gz)
  call check(abs(g(1) - wave) < 1e-10_dp .and. g(2) == 0, 'W')

  ! k0 = 2: lengths are halved, 4 pi G = k0 (N + W).
  call kelvin_green(2._dp, x/2, y/2, z/2 + 0.1_dp, 0*x, 0*x, 0*x - 0.1_dp, g, gx, gy, gz, &
                    parts=igabem_local + igabem_wave)
  call check(abs(4*pi*g(1) - 2*(local + wave)) < 1e-9_dp, 'G of arrays')
  call kelvin_green(2._dp, x(1)/2, y(1)/2, z(1)/2 + 0.1_dp, 0._dp, 0._dp, -0.1_dp, one, onex, oney, onez, &
                    parts=igabem_local + igabem_wave)
  call check(one == g(1) .and. onez == gz(1), 'G of scalars')

  call kelvin_green(2._dp, 1._dp, 1._dp, 1._dp, 0._dp, 0._dp, -0.1_dp, one, onex, oney, onez, status=status)
  call check(status == -1 .and. index(igabem_error_message(), 'pair 0') > 0, 'refusal')
  call kelvin_local(x, y, z(1:1), g, gx, gy, gz, status)
  call check(status == -1, 'refusal of lengths')

contains
  subroutine check(ok, what)
    logical, intent(in) :: ok
    character(len=*), intent(in) :: what
    if (ok) return
    print '(2a)', 'failed: ', what
    stop 1
  end subroutine
end program
