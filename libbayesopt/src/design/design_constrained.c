/* Designs within a region: repair of the points that violate a constraint, then spreading. */
#include "core/error.h"
#include "design/design_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Cost of one point beside the others: its share of the energy plus, weighted, how many others sit
 * in the same one-dimensional strata (which an energy alone would let pile up on the boundary). */
static double point_cost(size_t n, size_t d, const bayesopt_design_options *o, const double *x,
                         size_t self, const double *at, double unit)
{
    double energy = 0, shared = 0, bins = (double)(n + o->n_existing);
    for (size_t k = 0; k < n + o->n_existing; k++) {
        const double *other = k < n ? x + k * d : o->existing + (k - n) * d;
        if (k == self)
            continue;
        energy += design_pair_energy(design_distance2(d, at, other), o->power);
        for (size_t j = 0; j < d; j++)
            shared += floor(at[j] * bins) == floor(other[j] * bins);
    }
    return energy + o->latin_weight * unit * shared / (double)d;
}

/* Random moves of single points along the region, kept when the cost falls. */
static void spread(size_t n, size_t d, const bayesopt_design_options *o, struct region *region,
                   struct random_stream *stream, double *x, double *moved)
{
    double unit = 0;
    for (size_t i = 0; i < n && n > 1; i++)
        unit += point_cost(n, d, o, x, i, x + i * d, 0) / (double)n;
    size_t moves = o->swaps ? o->swaps : 40 * n;
    for (size_t m = 0; m < moves; m++) {
        size_t i = random_below(stream, n);
        double size = 0.5 * (1 - 0.9 * (double)m / (double)moves);
        memcpy(moved, x + i * d, d * sizeof *moved);
        size_t changes = 1 + random_below(stream, d < 3 ? d : 3);
        for (size_t c = 0; c < changes; c++) {
            size_t j = random_below(stream, d);
            moved[j] = fmin(fmax(moved[j] + size * random_normal(stream), 0), 1);
        }
        if (point_cost(n, d, o, x, i, moved, unit) >= point_cost(n, d, o, x, i, x + i * d, unit))
            continue;
        if (region_project(region, moved) &&
            point_cost(n, d, o, x, i, moved, unit) < point_cost(n, d, o, x, i, x + i * d, unit))
            memcpy(x + i * d, moved, d * sizeof *moved);
    }
}

bayesopt_status design_constrain(size_t n, size_t d, const bayesopt_design_options *options,
                                 struct region *region, struct random_stream *stream, double *x)
{
    double *inside = malloc(2 * d * sizeof *inside);
    if (!inside)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "design: out of memory");
    double *moved = inside + d;
    bayesopt_status status = BAYESOPT_OK;
    size_t repaired = 0;
    for (size_t i = 0; i < n && !status; i++) {
        double *point = x + i * d;
        if (region_contains(region, point))
            continue;
        repaired++;
        memcpy(moved, point, d * sizeof *moved);
        if (region_project(region, moved)) {
            memcpy(point, moved, d * sizeof *moved);
        } else if (region_find(region, stream, inside)) {
            region_retreat(region, inside, point);
        } else {
            status = bayesopt_fail(BAYESOPT_ERROR_INFEASIBLE,
                                   "design: no point among 2000 uniform ones and 200 projections "
                                   "satisfies the %zu input constraints",
                                   region->m);
        }
    }
    if (!status && repaired)
        spread(n, d, options, region, stream, x, moved);
    free(inside);
    return status;
}
