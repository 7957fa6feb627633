/* The Green function of all pairs of n points and n sources: pairwise calls on replicated
 * coordinates, the matrix call, and flat panels. Processor time of one thread, so that other work
 * on the machine does not count. igabem_matrix [n]                                            */
#include <igabem/panel.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double *room(size_t n)
{
    double *data = malloc(n * sizeof *data);
    if (!data)
        exit(EXIT_FAILURE);
    return data;
}

/* Replicates the coordinates of all pairs, calls, and forms normal derivatives. */
static igabem_status pairwise(size_t n, const double *points, const double *normals,
                              const double *sources, unsigned parts, double *slope)
{
    size_t pairs = n * n;
    double *at[10];
    for (int k = 0; k < 10; k++)
        at[k] = room(pairs);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            for (size_t k = 0; k < 3; k++) {
                at[k][i * n + j] = points[3 * i + k];
                at[3 + k][i * n + j] = sources[3 * j + k];
            }
    igabem_status status = igabem_kelvin_green(1.5, pairs, at[0], at[1], at[2], at[3], at[4], at[5],
                                               parts, at[6], at[7], at[8], at[9]);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            size_t p = i * n + j;
            slope[p] = normals[3 * i] * at[7][p] + normals[3 * i + 1] * at[8][p] +
                       normals[3 * i + 2] * at[9][p];
        }
    for (int k = 0; k < 10; k++)
        free(at[k]);
    return status;
}

int main(int argc, char **argv)
{
    size_t n = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 600;
    double *points = room(3 * n), *normals = room(3 * n), *sources = room(3 * n);
    double *corners = room(12 * n), *slope = room(n * n), *other = room(n * n);
    /* A slender body's surface, rows of 20 around it; sources a little inside. */
    for (size_t i = 0; i < n; i++) {
        double s = ((double)(i / 20) + 0.5) / ((double)n / 20),
               w = 6.283185307179586 * (double)(i % 20) / 20;
        double r = 0.2 * sqrt(4 * s * (1 - s)), h = 0.02;
        double y = cos(w), z = sin(w), along[3] = {h, 0, 0}, round[3] = {0, -h * z, h * y};
        for (size_t k = 0; k < 3; k++) {
            double radial = k == 0 ? 0 : k == 1 ? y : z;
            points[3 * i + k] = (k == 0 ? 1 - 2 * s : k == 1 ? r * y : r * z - 0.5);
            normals[3 * i + k] = radial;
            sources[3 * i + k] = points[3 * i + k] - 0.01 * radial;
            for (size_t c = 0; c < 4; c++)
                corners[12 * i + 3 * c + k] = points[3 * i + k] +
                                              (c == 0 || c == 3 ? -1 : 1) * along[k] +
                                              (c < 2 ? -1 : 1) * round[k];
        }
    }
    const unsigned parts[3] = {IGABEM_RANKINE | IGABEM_LID,
                               IGABEM_RANKINE | IGABEM_IMAGE | IGABEM_LOCAL,
                               IGABEM_RANKINE | IGABEM_IMAGE | IGABEM_LOCAL | IGABEM_WAVE};
    const char *name[3] = {"double body", "without waves", "Kelvin"};
    igabem_matrix_options options;
    igabem_matrix_options_init(&options);
    options.threads = 1;
    printf("%zu x %zu pairs, ns each    pairwise    matrix    panels 1e-3\n", n, n);
    for (int p = 0; p < 3; p++) {
        double pair = 1e9 / (double)(n * n), t = seconds();
        options.parts = parts[p];
        options.tolerance = 1e-3;
        if (pairwise(n, points, normals, sources, parts[p], other))
            return EXIT_FAILURE;
        double a = seconds() - t;
        t = seconds();
        if (igabem_green_matrix(1.5, n, points, normals, n, sources, &options, NULL, NULL, slope))
            return EXIT_FAILURE;
        double b = seconds() - t, worst = 0;
        for (size_t i = 0; i < n * n; i++)
            worst = fmax(worst, fabs(slope[i] - other[i]));
        t = seconds();
        if (igabem_panel_matrix(1.5, n, points, normals, n, corners, &options, NULL, NULL, slope)) {
            fprintf(stderr, "%s\n", igabem_last_error());
            return EXIT_FAILURE;
        }
        double c = seconds() - t;
        printf("%-22s %12.0f %9.0f %14.0f   (differ by %.0e)\n", name[p], a * pair, b * pair,
               c * pair, worst);
    }
    printf("memory beside the result: pairwise %.0f MB, matrix 0\n", 80e-6 * (double)(n * n));
    free(points), free(normals), free(sources), free(corners), free(slope), free(other);
    return EXIT_SUCCESS;
}
