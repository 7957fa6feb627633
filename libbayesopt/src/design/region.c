#include "design/region.h"

#include "core/matrix.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool region_create(struct region *region, size_t d, size_t m, bayesopt_input_constraint constraint,
                   void *data)
{
    *region = (struct region){.d = d, .m = m, .constraint = constraint, .data = data};
    region->values = malloc((2 * m + m * d + m * m + d) * sizeof(double));
    if (!region->values)
        return false;
    region->moved = region->values + m;
    region->jacobian = region->moved + m;
    region->gram = region->jacobian + m * d;
    region->step = region->gram + m * m;
    return true;
}

void region_free(struct region *region)
{
    free(region->values);
    *region = (struct region){0};
}

bool region_values(struct region *region, const double *x, double *value)
{
    if (!region->m)
        return true;
    if (region->constraint(region->data, region->d, x, value))
        return false;
    for (size_t i = 0; i < region->m; i++)
        if (isnan(value[i]))
            return false;
    return true;
}

bool region_contains(struct region *region, const double *x)
{
    return region_violation(region, x) <= 0;
}

double region_violation(struct region *region, const double *x)
{
    double sum = 0;
    if (!region_values(region, x, region->values))
        return INFINITY;
    for (size_t i = 0; i < region->m; i++)
        sum += fmax(region->values[i], 0);
    return sum;
}

bool region_jacobian(struct region *region, const double *x, const double *value, double *jacobian)
{
    size_t d = region->d;
    double *at = region->step;
    memcpy(at, x, d * sizeof *at);
    for (size_t j = 0; j < d; j++) {
        double step = x[j] < 0.5 ? 1e-6 : -1e-6;
        at[j] = x[j] + step;
        if (!region_values(region, at, region->moved))
            return false;
        at[j] = x[j];
        for (size_t i = 0; i < region->m; i++)
            jacobian[i * d + j] = (region->moved[i] - value[i]) / step;
    }
    return true;
}

/* Least-length solution of J s = -(g + margin) over the violated rows, coordinates that rest on a
 * bound and would leave the box held fixed. */
static bool newton_step(struct region *region, double *x, double margin)
{
    size_t d = region->d, count = 0;
    double *g = region->values, *jacobian = region->jacobian;
    if (!region_jacobian(region, x, g, jacobian))
        return false;
    for (size_t i = 0; i < region->m; i++)
        if (g[i] > 0) {
            double sign_sum = 0;
            memmove(jacobian + count * d, jacobian + i * d, d * sizeof *jacobian);
            g[count] = g[i] * (1 + margin) + 1e-12;
            for (size_t j = 0; j < d; j++) {
                double *slope = &jacobian[count * d + j];
                if ((x[j] <= 0 && *slope > 0) || (x[j] >= 1 && *slope < 0))
                    *slope = 0;
                sign_sum += fabs(*slope);
            }
            if (!(sign_sum > 0))
                return false;
            count++;
        }
    for (size_t a = 0; a < count; a++)
        for (size_t b = 0; b <= a; b++) {
            double dot = 0;
            for (size_t j = 0; j < d; j++)
                dot += jacobian[a * d + j] * jacobian[b * d + j];
            region->gram[a * count + b] = dot * (a == b ? 1 + 1e-10 : 1);
        }
    if (!matrix_cholesky(count, region->gram, count))
        return false;
    matrix_forward(count, region->gram, count, g);
    matrix_backward(count, region->gram, count, g);
    for (size_t j = 0; j < d; j++) {
        double step = 0;
        for (size_t a = 0; a < count; a++)
            step -= jacobian[a * d + j] * g[a];
        x[j] = fmin(fmax(x[j] + step, 0), 1);
    }
    return true;
}

bool region_project(struct region *region, double *x)
{
    double last = INFINITY;
    for (int iteration = 0; iteration < 20; iteration++) {
        double violation = region_violation(region, x);
        if (violation <= 0)
            return true;
        /* Overshoot a little more each time: curved boundaries are approached from outside. */
        if (isinf(violation) || (iteration > 5 && violation > 0.9 * last) ||
            !newton_step(region, x, 0.01 * (iteration + 1)))
            return false;
        last = violation;
    }
    return region_contains(region, x);
}

void region_retreat(struct region *region, const double *inside, double *x)
{
    double low = 0, high = 1, *at = region->step;
    if (region_contains(region, x))
        return;
    for (int i = 0; i < 20; i++) {
        double middle = (low + high) / 2;
        for (size_t j = 0; j < region->d; j++)
            at[j] = inside[j] + middle * (x[j] - inside[j]);
        *(region_contains(region, at) ? &low : &high) = middle;
    }
    for (size_t j = 0; j < region->d; j++)
        x[j] = inside[j] + low * (x[j] - inside[j]);
}

bool region_find(struct region *region, struct random_stream *stream, double *x)
{
    for (int attempt = 0; attempt < 2000; attempt++) {
        for (size_t j = 0; j < region->d; j++)
            x[j] = random_uniform(stream);
        if (region_contains(region, x))
            return true;
        if (attempt % 10 == 9 && region_project(region, x))
            return true;
    }
    return false;
}
