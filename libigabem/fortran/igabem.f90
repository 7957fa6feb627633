! Fortran modules of libigabem. igabem_c (igabem_c.f90, made from the headers) is its whole C interface:
! kernel, matrices of points and panels, amplitude, filters, hulls of libnurbs, solver. igabem adds to it the
! Green function on Fortran's arrays and the sentence of the last failure. Fortran 2018: absent arguments are
! NULL. Compile this file with the program that uses it and link with -ligabem -lnurbs.
!
!   use igabem
!   call kelvin_green(k0, x, y, z, xi, eta, zeta, g, gx, gy, gz)
!
! takes scalars or arrays of equal length. Optional last arguments: parts, a sum of igabem_rankine,
! igabem_image, igabem_local, igabem_wave and igabem_lid (default: the first four), and status, 0 on success.
! Without status a failure stops the program with the library's message. Matrices that C stores row by row, [n][m],
! are arrays (m, n).
include 'igabem_c.f90'

module igabem
  use igabem_c
  implicit none
  private :: green_points, green_point, finish, differ

  interface kelvin_green
    module procedure green_points, green_point
  end interface

  interface
    integer(c_size_t) function text_length(s) bind(c, name='strlen')
      import :: c_ptr, c_size_t
      type(c_ptr), value :: s
    end function
  end interface

contains

  ! The sentence that says what was wrong with the last failing call of this thread.
  function igabem_error_message() result(text)
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: raw(:)
    type(c_ptr) :: address
    integer :: i, n
    address = igabem_last_error()
    n = int(text_length(address))
    call c_f_pointer(address, raw, [n])
    allocate (character(len=n) :: text)
    do i = 1, n
      text(i:i) = raw(i)
    end do
  end function

  subroutine finish(code, status)
    integer(c_int), intent(in) :: code
    integer, intent(out), optional :: status
    if (present(status)) then
      status = int(code)
    else if (code /= 0) then
      write (*, '(2a)') 'igabem: ', igabem_error_message()
      error stop
    end if
  end subroutine

  ! True, with status set or the program stopped, unless all the sizes are n.
  logical function differ(n, sizes, status)
    integer, intent(in) :: n, sizes(:)
    integer, intent(out), optional :: status
    differ = any(sizes /= n)
    if (.not. differ) return
    if (.not. present(status)) error stop 'igabem: arrays of different lengths'
    status = -1
  end function

  subroutine green_points(k0, x, y, z, xi, eta, zeta, g, gx, gy, gz, parts, status)
    real(c_double), intent(in) :: k0
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:), xi(:), eta(:), zeta(:)
    real(c_double), intent(out), contiguous :: g(:), gx(:), gy(:), gz(:)
    integer, intent(in), optional :: parts
    integer, intent(out), optional :: status
    integer(c_int) :: which
    which = 15
    if (present(parts)) which = int(parts, c_int)
    if (differ(size(x), [size(y), size(z), size(xi), size(eta), size(zeta), size(g), size(gx), &
                         size(gy), size(gz)], status)) return
    call finish(igabem_kelvin_green(k0, int(size(x), c_size_t), x, y, z, xi, eta, zeta, which, g, gx, gy, gz), status)
  end subroutine

  subroutine green_point(k0, x, y, z, xi, eta, zeta, g, gx, gy, gz, parts, status)
    real(c_double), intent(in) :: k0, x, y, z, xi, eta, zeta
    real(c_double), intent(out) :: g, gx, gy, gz
    integer, intent(in), optional :: parts
    integer, intent(out), optional :: status
    real(c_double) :: v(1), vx(1), vy(1), vz(1)
    v = 0; vx = 0; vy = 0; vz = 0
    call green_points(k0, [x], [y], [z], [xi], [eta], [zeta], v, vx, vy, vz, parts, status)
    g = v(1); gx = vx(1); gy = vy(1); gz = vz(1)
  end subroutine

  ! N and its gradient, dimensionless.
  subroutine kelvin_local(x, y, z, v, vx, vy, vz, status)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    real(c_double), intent(out), contiguous :: v(:), vx(:), vy(:), vz(:)
    integer, intent(out), optional :: status
    if (differ(size(x), [size(y), size(z), size(v), size(vx), size(vy), size(vz)], status)) return
    call finish(igabem_kelvin_local(int(size(x), c_size_t), x, y, z, v, vx, vy, vz), status)
  end subroutine

  ! W and its gradient, dimensionless.
  subroutine kelvin_wave(x, y, z, v, vx, vy, vz, status)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    real(c_double), intent(out), contiguous :: v(:), vx(:), vy(:), vz(:)
    integer, intent(out), optional :: status
    if (differ(size(x), [size(y), size(z), size(v), size(vx), size(vy), size(vz)], status)) return
    call finish(igabem_kelvin_wave(int(size(x), c_size_t), x, y, z, v, vx, vy, vz), status)
  end subroutine

end module
