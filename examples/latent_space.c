/* Six sine modifications of a Wigley hull: how many latent variables carry 95 % of their variance,
 * and which parameters lie behind a latent point. */
#include <galv/galv.h>
#include <nurbs/nurbs.h>

#include <stdio.h>
#include <stdlib.h>

enum { STATIONS = 60, GIRTH = 20, FUNCTIONS = 6 };

static int report(const galv_shape *shape, const galv_model *model)
{
    size_t m = galv_model_modes(model);
    double u[FUNCTIONS] = {0}, x[FUNCTIONS], residual;
    printf("%zu of %d variables retain %.2f %%\n", m, FUNCTIONS, 100 * galv_model_retained(model));
    u[0] = 0.5 * galv_model_upper(model)[0];
    if (galv_backmap(model, shape, u, x, &residual) != GALV_OK)
        return 1;
    printf("half way along the first direction, to %.1e m:", residual);
    for (int i = 0; i < FUNCTIONS; i++)
        printf(" %.4f", x[i]);
    printf("\n");
    return 0;
}

int main(void)
{
    nurbs_surface *hull = NULL;
    nurbs_grid *grid = NULL;
    double along[STATIONS], girth[GIRTH];
    for (int i = 0; i < STATIONS; i++)
        along[i] = i / (STATIONS - 1.0);
    for (int j = 0; j < GIRTH; j++)
        girth[j] = j / (GIRTH - 1.0);
    if (nurbs_make_wigley(1, 0.1, 0.0625, &hull) != NURBS_OK ||
        nurbs_grid_sample(hull, STATIONS, along, GIRTH, girth, &grid) != NURBS_OK) {
        fprintf(stderr, "latent_space: %s\n", nurbs_last_error());
        return 1;
    }

    galv_sine functions[FUNCTIONS];
    double lower[FUNCTIONS], upper[FUNCTIONS];
    for (int i = 0; i < FUNCTIONS; i++) {
        functions[i] = (galv_sine){.order = {1 + i % 3, 1, 1 + i / 3}, .direction = 1};
        lower[i] = -0.002;
        upper[i] = 0.002;
    }
    const galv_box box = {{-0.5, 0, -0.0625}, {1, 0.05, 0.125}};
    galv_shape *shape = NULL;
    galv_model *model = NULL;
    int failed = galv_shape_sine(FUNCTIONS, functions, &box, lower, upper,
                                 GALV_COMBINATION_RECURSIVE, &shape) ||
                 galv_build(shape, (size_t)STATIONS * GIRTH, nurbs_grid_points(grid),
                            galv_uniform(2000, 1), NULL, &model) ||
                 report(shape, model);
    if (failed)
        fprintf(stderr, "latent_space: %s\n", galv_last_error());

    galv_model_free(model);
    galv_shape_free(shape);
    nurbs_grid_free(grid);
    nurbs_surface_free(hull);
    return failed ? 1 : 0;
}
