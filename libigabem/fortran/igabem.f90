! Fortran 2003 module for the Kelvin Green function of libigabem: see igabem/kelvin.h for every
! convention. Compile it with the program that uses it and link with -ligabem.
!
!   use igabem
!   call kelvin_green(k0, x, y, z, xi, eta, zeta, g, gx, gy, gz)
!
! takes scalars or arrays of equal length. Optional last arguments: parts, a sum of igabem_rankine,
! igabem_image, igabem_local and igabem_wave (default: all four), and status, 0 on success. Without
! status a failure stops the program with the library's message.
module igabem
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: kelvin_green, kelvin_local, kelvin_wave, igabem_error_message
  integer, parameter, public :: igabem_rankine = 1, igabem_image = 2, igabem_local = 4, igabem_wave = 8

  interface kelvin_green
    module procedure green_points, green_point
  end interface

  interface
    integer(c_int) function c_green(k0, n, x, y, z, xi, eta, zeta, parts, g, gx, gy, gz) &
        bind(c, name='igabem_kelvin_green')
      import :: c_int, c_double, c_size_t
      real(c_double), value :: k0
      integer(c_size_t), value :: n
      real(c_double), intent(in) :: x(*), y(*), z(*), xi(*), eta(*), zeta(*)
      integer(c_int), value :: parts
      real(c_double), intent(out) :: g(*), gx(*), gy(*), gz(*)
    end function
    integer(c_int) function c_local(n, x, y, z, v, vx, vy, vz) bind(c, name='igabem_kelvin_local')
      import :: c_int, c_double, c_size_t
      integer(c_size_t), value :: n
      real(c_double), intent(in) :: x(*), y(*), z(*)
      real(c_double), intent(out) :: v(*), vx(*), vy(*), vz(*)
    end function
    integer(c_int) function c_wave(n, x, y, z, v, vx, vy, vz) bind(c, name='igabem_kelvin_wave')
      import :: c_int, c_double, c_size_t
      integer(c_size_t), value :: n
      real(c_double), intent(in) :: x(*), y(*), z(*)
      real(c_double), intent(out) :: v(*), vx(*), vy(*), vz(*)
    end function
    type(c_ptr) function c_last_error() bind(c, name='igabem_last_error')
      import :: c_ptr
    end function
    integer(c_size_t) function c_strlen(s) bind(c, name='strlen')
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
    address = c_last_error()
    n = int(c_strlen(address))
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
    call finish(c_green(k0, int(size(x), c_size_t), x, y, z, xi, eta, zeta, which, g, gx, gy, gz), status)
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
    call finish(c_local(int(size(x), c_size_t), x, y, z, v, vx, vy, vz), status)
  end subroutine

  ! W and its gradient, dimensionless.
  subroutine kelvin_wave(x, y, z, v, vx, vy, vz, status)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    real(c_double), intent(out), contiguous :: v(:), vx(:), vy(:), vz(:)
    integer, intent(out), optional :: status
    if (differ(size(x), [size(y), size(z), size(v), size(vx), size(vy), size(vz)], status)) return
    call finish(c_wave(int(size(x), c_size_t), x, y, z, v, vx, vy, vz), status)
  end subroutine

end module
