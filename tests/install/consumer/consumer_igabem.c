/* One Green function value, through the installed libigabem: the rigid-wall limit N -> -2/R far
 * away. */
#include <igabem/igabem.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

int main(void)
{
    char version[40];
    snprintf(version, sizeof version, "%d.%d.%d", IGABEM_VERSION_MAJOR, IGABEM_VERSION_MINOR,
             IGABEM_VERSION_PATCH);
    if (strcmp(version, igabem_version()) != 0)
        return 1;
    const double X = 3000, Y = 4000, Z = -1e-3;
    double n, nx, ny, nz;
    if (igabem_kelvin_local(1, &X, &Y, &Z, &n, &nx, &ny, &nz) != IGABEM_OK) {
        fprintf(stderr, "%s\n", igabem_last_error());
        return 1;
    }
    return fabs(n + 2.0 / 5000) < 1e-6 ? 0 : 1;
}
