/* Two sine functions on a row of points, through the installed libgalv: two modes carry everything.
 */
#include <galv/galv.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS = 40 };

int main(void)
{
    char version[40];
    snprintf(version, sizeof version, "%d.%d.%d", GALV_VERSION_MAJOR, GALV_VERSION_MINOR,
             GALV_VERSION_PATCH);
    if (strcmp(version, galv_version()) != 0)
        return 1;
    double xyz[3 * POINTS];
    for (int i = 0; i < POINTS; i++) {
        xyz[3 * i] = (i + 0.5) / POINTS;
        xyz[3 * i + 1] = xyz[3 * i + 2] = 0.5;
    }
    const galv_sine functions[2] = {{.order = {1, 1, 1}, .direction = 1},
                                    {.order = {2, 1, 1}, .direction = 1}};
    const galv_box box = {{0, 0, 0}, {1, 1, 1}};
    const double lower[2] = {-0.1, -0.1}, upper[2] = {0.1, 0.1};
    galv_shape *shape = NULL;
    galv_model *model = NULL;
    if (galv_shape_sine(2, functions, &box, lower, upper, GALV_COMBINATION_LINEAR, &shape) !=
            GALV_OK ||
        galv_build(shape, POINTS, xyz, galv_uniform(500, 1), NULL, &model) != GALV_OK) {
        fprintf(stderr, "%s\n", galv_last_error());
        return 1;
    }
    int ok = galv_model_modes(model) == 2 && fabs(galv_model_retained(model) - 1) < 1e-12;
    galv_model_free(model);
    galv_shape_free(shape);
    return ok ? 0 : 1;
}
