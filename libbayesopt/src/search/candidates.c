/* Where a step looks before it climbs. */
#include "search/search.h"

#include <math.h>
#include <stdlib.h>

/* Chosen on tests/bench/bayesopt_regret. Perturbations of the best points by two sizes keep all but
 * about `moved_variables` coordinates (Regis and Shoemaker, Engineering Optimization 45 (2013)
 * 529). */
enum { CENTRES = 5 };
static const double neighbour_size[2] = {0.02, 0.1}, moved_variables = 8;

/* Some of the Pareto set, drawn anew for each proposal; none if nothing is feasible. */
static size_t pick_front(const struct bayesopt *bo, uint64_t id, size_t *centres)
{
    struct random_stream stream;
    size_t n = 0, count = 0, *rows = malloc((bo->n_points + 1) * sizeof *rows);
    random_start(&stream, bo->options.seed, STREAM_SEARCH, random_hash(id + 1));
    if (rows && pareto_rows(bo, &n, rows))
        for (; count < CENTRES && n > 0; count++) {
            size_t i = random_below(&stream, n);
            centres[count] = rows[i];
            rows[i] = rows[--n];
        }
    free(rows);
    return count;
}

/* Rows of the history by merit: feasible ones by value, then the rest by violation. */
static size_t pick_centres(const struct bayesopt *bo, uint64_t id, size_t *centres)
{
    size_t count = bo->options.n_objectives > 1 ? pick_front(bo, id, centres) : 0;
    if (count)
        return count;
    for (; count < CENTRES; count++) {
        size_t best = SIZE_MAX;
        struct merit most = merit_worst;
        for (size_t i = 0; i < bo->n_points; i++) {
            bool taken = !point_counts(bo, &bo->points[i]);
            for (size_t k = 0; k < count; k++)
                taken = taken || centres[k] == i;
            if (taken)
                continue;
            struct merit merit = point_merit(bo, &bo->points[i]);
            if (merit_better(merit, most)) {
                most = merit;
                best = i;
            }
        }
        if (best == SIZE_MAX)
            break;
        centres[count] = best;
    }
    return count;
}

/* Of the values of a discrete variable within the box the one at this share of them. */
static double pick_value(const struct bayesopt *bo, const struct search *search, size_t j,
                         double share)
{
    double steps = problem_values(bo, j) - 1;
    double low = round(search->lower[j] * steps), high = round(search->upper[j] * steps);
    return problem_value_unit(bo, j, fmin(low + floor(share * (high - low + 1)), high));
}

/* Another category, or a whole number that far away but at least the next one. */
static double step_value(const struct bayesopt *bo, const struct search *search,
                         struct random_stream *stream, size_t j, double from, double move)
{
    double steps = problem_values(bo, j) - 1;
    if (bo->kind[j] == BAYESOPT_KIND_CATEGORICAL || !(steps > 0))
        return pick_value(bo, search, j, random_uniform(stream));
    double to = round(from * steps) + copysign(fmax(round(fabs(move) * steps), 1), move);
    double low = round(search->lower[j] * steps), high = round(search->upper[j] * steps);
    return problem_value_unit(bo, j, fmin(fmax(to, low), high));
}

/* Uniform candidates (a scrambled Sobol sequence) and perturbations of the best points. */
bayesopt_status search_candidates(struct bayesopt *bo, const struct search *search, double *x,
                                  size_t *n)
{
    size_t d = bo->d, centres[CENTRES], count = pick_centres(bo, search->id, centres);
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = random_hash(bo->options.seed ^ random_hash(search->id));
    bayesopt_status status =
        bayesopt_design(BAYESOPT_DESIGN_SOBOL, search->candidates, d, &options, x);
    if (status)
        return status;
    for (size_t i = 0; i < search->candidates; i++)
        for (size_t j = 0; j < d; j++)
            x[i * d + j] =
                problem_is_discrete(bo, j)
                    ? pick_value(bo, search, j, x[i * d + j])
                    : search->lower[j] + x[i * d + j] * (search->upper[j] - search->lower[j]);
    struct random_stream stream;
    random_start(&stream, bo->options.seed, STREAM_SEARCH, search->id);
    double share = fmin(1, moved_variables / (double)d);
    for (size_t i = 0; i < SEARCH_NEIGHBOURS && count; i++) {
        const double *centre = bo->points[centres[i % count]].u;
        double *at = x + (search->candidates + i) * d, size = neighbour_size[i % 2];
        size_t always = random_below(&stream, d);
        for (size_t j = 0; j < d; j++) {
            double draw = random_uniform(&stream), move = size * random_normal(&stream);
            double to = centre[j] + (draw < share || j == always ? move : 0);
            at[j] = fmin(fmax(to, search->lower[j]), search->upper[j]);
            if (problem_is_discrete(bo, j) && to != centre[j])
                at[j] = step_value(bo, search, &stream, j, centre[j], move);
        }
    }
    *n = search->candidates + (count ? SEARCH_NEIGHBOURS : 0);
    return BAYESOPT_OK;
}
