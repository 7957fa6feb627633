/* The Kelvin Green function and nothing else: the wave elevation on the track behind a submerged
 * source, as another hydrodynamics code would compute it. Prints x and zeta in metres. */
#include <igabem/kelvin.h>

#include <math.h>
#include <stdio.h>

enum { POINTS = 200 };

int main(void)
{
    const double speed = 2.5, gravity = 9.80665, strength = 0.1, depth = 0.5;
    const double k0 = gravity / (speed * speed);
    double x[POINTS], y[POINTS], z[POINTS], xi[POINTS], eta[POINTS], zeta[POINTS], gx[POINTS];
    for (int i = 0; i < POINTS; i++) {
        x[i] = 1 - 0.05 * i; /* upstream to downstream */
        y[i] = z[i] = xi[i] = eta[i] = 0;
        zeta[i] = -depth;
    }
    /* On z = 0 the Rankine source and its image cancel: local and wave part are all there is. */
    if (igabem_kelvin_green(k0, POINTS, x, y, z, xi, eta, zeta, IGABEM_LOCAL | IGABEM_WAVE, NULL,
                            gx, NULL, NULL) != IGABEM_OK) {
        fprintf(stderr, "green_function: %s\n", igabem_last_error());
        return 1;
    }
    for (int i = 0; i < POINTS; i++)
        printf("%8.4f %12.8f\n", x[i], speed / gravity * strength * gx[i]);
    return 0;
}
