/* A grid of section points becomes a light IGES hull: sections_to_iges GRID.csv HULL.igs */
#include <nurbs/nurbs.h>

#include <stdio.h>

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: sections_to_iges GRID.csv HULL.igs\n");
        return 2;
    }
    nurbs_grid *grid = NULL;
    nurbs_surface *hull = NULL, *light = NULL;
    double bound = 0;
    const double tolerance = 5e-4; /* metres */

    nurbs_skin_options skin;
    nurbs_skin_options_init(&skin); /* cubic, centripetal, kinks found at 20 degrees */

    nurbs_status status = nurbs_grid_read(argv[1], &grid);
    if (status == NURBS_OK)
        status = nurbs_skin(grid, &skin, &hull);
    if (status == NURBS_OK)
        status = nurbs_surface_simplify(
            hull, tolerance, NURBS_SIMPLIFY_KEEP_EDGES | NURBS_SIMPLIFY_THRIFTY, &light, &bound);
    if (status == NURBS_OK)
        status = nurbs_surface_write_iges(light, argv[2]);
    if (status == NURBS_OK)
        printf("%zu x %zu control points instead of %zu x %zu, within %.2g m\n",
               nurbs_surface_size(light, 0), nurbs_surface_size(light, 1),
               nurbs_surface_size(hull, 0), nurbs_surface_size(hull, 1), bound);
    else
        fprintf(stderr, "sections_to_iges: %s\n", nurbs_last_error());

    nurbs_surface_free(light);
    nurbs_surface_free(hull);
    nurbs_grid_free(grid);
    return status == NURBS_OK ? 0 : 1;
}
