#include "solve/assemble.h"

#include <math.h>
#include <string.h>

/* Adds half the basis at a collocation point: the jump of the normal velocity. */
static void add_jump(const struct influence *influence, size_t point, double *row)
{
    const struct density *density = influence->density;
    const struct mesh *mesh = influence->mesh;
    size_t patch = density->owner[point];
    for (size_t e = mesh->patch_base[patch]; e < mesh->patch_base[patch + 1]; e++) {
        const struct element *element = &mesh->element[e];
        double local[2], bu[ELEMENT_SIDE], bv[ELEMENT_SIDE], value[ELEMENT_FUNCTIONS];
        if (!element_contains(density, element, point, local))
            continue;
        size_t m = (size_t)element->degree[0] + 1, n = (size_t)element->degree[1] + 1;
        struct jet jet;
        element_jet(element, local[0], local[1], &jet);
        bernstein(element->degree[0], local[0], bu, NULL);
        bernstein(element->degree[1], local[1], bv, NULL);
        for (size_t k = 0; k < m * n; k++)
            value[k] = 0.5 * bu[k / n] * bv[k % n] / jet.weight;
        element_scatter(element, 1, value, row, density->n);
        return;
    }
}

/* Normal and two tangents of a point, orthonormal: the first tangent avoids the axis nearest to the
 * normal. */
static void frame(const double *normal, double axis[3][3])
{
    int least = 0;
    for (int c = 1; c < 3; c++)
        if (fabs(normal[c]) < fabs(normal[least]))
            least = c;
    int a = (least + 1) % 3, b = (least + 2) % 3;
    double length = hypot(normal[a], normal[b]);
    memcpy(axis[0], normal, sizeof axis[0]);
    axis[1][least] = 0.0;
    axis[1][a] = -normal[b] / length;
    axis[1][b] = normal[a] / length;
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        axis[2][c] = axis[0][d] * axis[1][e] - axis[0][e] * axis[1][d];
    }
}

void assemble_turn(const struct influence *influence, double *rows)
{
    size_t n = influence->density->n;
#pragma omp parallel for num_threads(influence->threads) schedule(dynamic, 16)
    for (size_t i = 0; i < n; i++) {
        double *row = rows + 3 * n * i, axis[3][3];
        frame(influence->density->normal + 3 * i, axis);
        for (size_t k = 0; k < n; k++) {
            double v[3] = {row[k], row[n + k], row[2 * n + k]};
            for (size_t c = 0; c < 3; c++)
                row[c * n + k] = axis[c][0] * v[0] + axis[c][1] * v[1] + axis[c][2] * v[2];
        }
        add_jump(influence, i, row);
    }
}

void assemble_velocity(const struct influence *influence, const double *rows,
                       const double *normal_velocity, const double *sigma, double *velocity)
{
    size_t n = influence->density->n;
#pragma omp parallel for num_threads(influence->threads) schedule(static)
    for (size_t i = 0; i < n; i++) {
        const double *along = rows + 3 * n * i + n, *across = along + n;
        double axis[3][3], sum[2] = {0.0, 0.0};
        frame(influence->density->normal + 3 * i, axis);
        for (size_t k = 0; k < n; k++) {
            sum[0] += along[k] * sigma[k];
            sum[1] += across[k] * sigma[k];
        }
        for (size_t c = 0; c < 3; c++)
            velocity[c * n + i] =
                normal_velocity[i] * axis[0][c] + sum[0] * axis[1][c] + sum[1] * axis[2][c];
    }
}
