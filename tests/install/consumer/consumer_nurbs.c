/* The wetted area and volume of a Wigley hull, through the installed libnurbs. */
#include <nurbs/nurbs.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

int main(void)
{
    char version[40];
    snprintf(version, sizeof version, "%d.%d.%d", NURBS_VERSION_MAJOR, NURBS_VERSION_MINOR,
             NURBS_VERSION_PATCH);
    if (strcmp(version, nurbs_version()) != 0)
        return 1;
    nurbs_surface *hull = NULL;
    nurbs_hydrostatics hydrostatics;
    if (nurbs_make_wigley(1, 0.1, 0.0625, &hull) != NURBS_OK ||
        nurbs_hydrostatics_compute(1, (const nurbs_surface *const[]){hull}, 0, &hydrostatics) !=
            NURBS_OK) {
        fprintf(stderr, "%s\n", nurbs_last_error());
        return 1;
    }
    nurbs_surface_free(hull);
    /* 4 B L T / 9 */
    return fabs(hydrostatics.volume - 4 * 0.1 * 0.0625 / 9) < 1e-12 ? 0 : 1;
}
