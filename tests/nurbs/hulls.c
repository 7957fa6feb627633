#include "hulls.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int hull5415_load(struct hull5415 *hull)
{
    *hull = (struct hull5415){0};
    if (nurbs_patches_read(EXAMPLES_DIR "/hulls/dtmb5415.json", &hull->file) != NURBS_OK) {
        fprintf(stderr, "%s\n", nurbs_last_error());
        return 0;
    }
    hull->surface = nurbs_patches_get(hull->file, 0);
    size_t rows = nurbs_patches_parameters(hull->file, 0, 0, &hull->u),
           columns = nurbs_patches_parameters(hull->file, 0, 1, &hull->v);
    return nurbs_grid_sample(hull->surface, rows, hull->u, columns, hull->v, &hull->grid) ==
           NURBS_OK;
}

void hull5415_free(struct hull5415 *hull)
{
    nurbs_grid_free(hull->grid);
    nurbs_patches_free(hull->file);
}

nurbs_grid *kinked_grid(size_t rows, size_t columns, size_t kink)
{
    nurbs_grid *grid;
    if (nurbs_grid_create(rows, columns, NULL, &grid) != NURBS_OK)
        return NULL;
    double *p = nurbs_grid_edit(grid);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++, p += 3) {
            double s = (double)i / (double)(rows - 1), t = (double)j / (double)(columns - 1),
                   k = (double)kink / (double)(rows - 1);
            /* Only the keel breaks: the rise fades with the third power of the girth. */
            double rise = s > k ? 1.2 * (s - k) * t * t * t : 0;
            p[0] = 1 - s;
            p[1] = 0.15 * (1 - t * t) * s * (1.4 - s);
            p[2] = 0.2 - 0.7 * t + rise;
        }
    return grid;
}

double surface_distance(const nurbs_surface *a, const nurbs_surface *b, size_t n)
{
    double *u = malloc((n + 6 * n * n) * sizeof *u), *p = u + n, *q = p + 3 * n * n, worst = 0;
    for (size_t k = 0; k < n; k++)
        u[k] = (double)k / (double)(n - 1);
    if (nurbs_surface_eval_grid(a, 0, n, u, n, u, p) != NURBS_OK ||
        nurbs_surface_eval_grid(b, 0, n, u, n, u, q) != NURBS_OK)
        worst = INFINITY;
    for (size_t k = 0; k < 3 * n * n && worst < INFINITY; k += 3)
        worst = fmax(worst, hypot(hypot(p[k] - q[k], p[k + 1] - q[k + 1]), p[k + 2] - q[k + 2]));
    free(u);
    return worst;
}

double lowest_y(const nurbs_surface *surface, size_t n)
{
    double *u = malloc((n + 3 * n * n) * sizeof *u), *p = u + n, low = INFINITY;
    for (size_t k = 0; k < n; k++)
        u[k] = (double)k / (double)(n - 1);
    if (nurbs_surface_eval_grid(surface, 0, n, u, n, u, p) != NURBS_OK)
        low = -INFINITY;
    for (size_t k = 0; k < n * n && low > -INFINITY; k++)
        low = fmin(low, p[3 * k + 1]);
    free(u);
    return low;
}

const char *scratch_file(const char *name)
{
    static char path[256];
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/nurbs_test_%ld_%s", folder ? folder : "/tmp", (long)getpid(),
             name);
    return path;
}

const char *write_scratch(const char *name, const char *text)
{
    const char *path = scratch_file(name);
    FILE *stream = fopen(path, "wb");
    if (stream) {
        fwrite(text, 1, strlen(text), stream);
        fclose(stream);
    }
    return path;
}
