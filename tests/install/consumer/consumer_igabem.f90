! The rigid-wall limit N -> -2/R far away, through the installed Fortran module.
program consumer_igabem
  use, intrinsic :: iso_c_binding, only: dp => c_double
  use igabem
  implicit none
  real(dp) :: n(1), nx(1), ny(1), nz(1)
  call kelvin_local([3000._dp], [4000._dp], [-1.e-3_dp], n, nx, ny, nz)
  if (abs(n(1) + 2 / 5000._dp) > 1e-6_dp) stop 1
end program
