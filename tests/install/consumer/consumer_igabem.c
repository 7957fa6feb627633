/* One Green function value, through the installed libigabem: the rigid-wall limit N -> -2/R far
 * away. */
#include <igabem/igabem.h>

#include <math.h>
#include <stdio.h>

int main(void)
{
    const double X = 3000, Y = 4000, Z = -1e-3;
    double n, nx, ny, nz;
    if (igabem_kelvin_local(1, &X, &Y, &Z, &n, &nx, &ny, &nz) != IGABEM_OK) {
        fprintf(stderr, "%s\n", igabem_last_error());
        return 1;
    }
    return fabs(n + 2.0 / 5000) < 1e-6 ? 0 : 1;
}
