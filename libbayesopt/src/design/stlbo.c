/* Sampling by teaching and learning after Khan and Gunpinar, Computer-Aided Design 100 (2018)
 * 52-67: one sub-population of learners per sample, its teacher is the sample; the cost favours
 * space filling (Audze-Eglais) and one-dimensional strata of their own, and penalises violated
 * constraints. The phases are those of Rao, Savsani and Vakharia, Computer-Aided Design 43 (2011)
 * 303. */
#include "core/clones.h"
#include "core/error.h"
#include "design/design_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEARNERS = 10, MOST_SWEEPS = 200, QUIET_SWEEPS = 10, BLOCK = 32 };

struct school {
    size_t n, d;
    const bayesopt_design_options *options;
    struct region *region;
    double *learners;   /* [n x LEARNERS x d] */
    double *violations; /* [n x LEARNERS] of the input constraints */
    double *costs;      /* [LEARNERS] of the present sub-population */
    double *teachers;   /* [n x d] */
    /* Teachers and existing points once more with their strata, variable by variable, filled up to
     * whole blocks: [d x room]. */
    size_t room;
    double *columns, *strata;
    double *mean, *moved, *moved_strata;
    double unit; /* energy of a typical point: scale of the other terms */
};

static double stratum(const struct school *s, double x)
{
    return floor(x * (double)(s->n + s->options->n_existing));
}

static void put_column(struct school *s, size_t k, const double *x)
{
    for (size_t j = 0; j < s->d; j++) {
        s->columns[j * s->room + k] = x[j];
        s->strata[j * s->room + k] = stratum(s, x[j]);
    }
}

/* Squared distances to BLOCK points and the numbers of strata shared with them. */
BAYESOPT_CLONES
static void compare_block(size_t d, size_t room, const double *restrict x,
                          const double *restrict x_strata, const double *restrict columns,
                          const double *restrict strata, double *restrict d2,
                          double *restrict shared)
{
    for (size_t c = 0; c < BLOCK; c++)
        d2[c] = shared[c] = 0;
    for (size_t j = 0; j < d; j++) {
        const double *at = columns + j * room, *bin = strata + j * room;
        double here = x[j], own = x_strata[j];
        for (size_t c = 0; c < BLOCK; c++) {
            d2[c] += (here - at[c]) * (here - at[c]);
            shared[c] += own == bin[c] ? 1 : 0;
        }
    }
}

/* Energy and shared strata of a point; once they reach `most` the rest is left out. */
static double crowding(const struct school *s, size_t self, const double *x, double most)
{
    const bayesopt_design_options *o = s->options;
    double sum = 0, share = o->latin_weight * s->unit / (double)s->d, d2[BLOCK], shared[BLOCK];
    size_t others = s->n + o->n_existing;
    for (size_t j = 0; j < s->d; j++)
        s->moved_strata[j] = stratum(s, x[j]);
    for (size_t b = 0; b < others && sum < most; b += BLOCK) {
        size_t width = others - b < BLOCK ? others - b : BLOCK;
        compare_block(s->d, s->room, x, s->moved_strata, s->columns + b, s->strata + b, d2, shared);
        for (size_t c = 0; c < width && sum < most; c++)
            if (b + c != self)
                sum += design_pair_energy(d2[c], o->power) + share * shared[c];
    }
    return sum;
}

/* Static penalty: any violation costs more than the worst feasible place. */
static double penalty(const struct school *s, double violation)
{
    return violation > 0 ? 1e3 * s->unit * (1 + violation) : 0;
}

/* Constraints may be dear: they are asked only about moves that nothing else rules out. */
static void try_move(struct school *s, size_t p, size_t i)
{
    for (size_t j = 0; j < s->d; j++)
        s->moved[j] = fmin(fmax(s->moved[j], 0), 1);
    double value = crowding(s, p, s->moved, s->costs[i]);
    if (value >= s->costs[i])
        return;
    double violation = s->options->n_constraints ? region_violation(s->region, s->moved) : 0;
    value += penalty(s, violation);
    if (value < s->costs[i]) {
        s->costs[i] = value;
        s->violations[p * LEARNERS + i] = violation;
        memcpy(s->learners + (p * LEARNERS + i) * s->d, s->moved, s->d * sizeof *s->moved);
    }
}

static void teach(struct school *s, size_t p, struct random_stream *stream)
{
    const double *learners = s->learners + p * LEARNERS * s->d, *teacher = s->teachers + p * s->d;
    memset(s->mean, 0, s->d * sizeof *s->mean);
    for (size_t i = 0; i < LEARNERS; i++)
        for (size_t j = 0; j < s->d; j++)
            s->mean[j] += learners[i * s->d + j] / LEARNERS;
    for (size_t i = 0; i < LEARNERS; i++) {
        double factor = (double)(1 + random_below(stream, 2));
        for (size_t j = 0; j < s->d; j++)
            s->moved[j] = learners[i * s->d + j] +
                          random_uniform(stream) * (teacher[j] - factor * s->mean[j]);
        try_move(s, p, i);
    }
}

static void learn(struct school *s, size_t p, struct random_stream *stream)
{
    const double *learners = s->learners + p * LEARNERS * s->d;
    for (size_t i = 0; i < LEARNERS; i++) {
        size_t k = (i + 1 + random_below(stream, LEARNERS - 1)) % LEARNERS;
        double sign = s->costs[i] < s->costs[k] ? 1 : -1;
        for (size_t j = 0; j < s->d; j++) {
            double a = learners[i * s->d + j], b = learners[k * s->d + j];
            s->moved[j] = a + sign * random_uniform(stream) * (a - b);
        }
        try_move(s, p, i);
    }
}

/* Costs move with the teachers of the others, so they are taken anew for every visit. Returns the
 * cost of the new teacher. */
static double visit(struct school *s, size_t p, struct random_stream *stream)
{
    double *learners = s->learners + p * LEARNERS * s->d;
    for (size_t i = 0; i < LEARNERS; i++)
        s->costs[i] = crowding(s, p, learners + i * s->d, INFINITY) +
                      penalty(s, s->violations[p * LEARNERS + i]);
    teach(s, p, stream);
    learn(s, p, stream);
    size_t best = 0;
    for (size_t i = 1; i < LEARNERS; i++)
        best = s->costs[i] < s->costs[best] ? i : best;
    memcpy(s->teachers + p * s->d, learners + best * s->d, s->d * sizeof *learners);
    put_column(s, p, s->teachers + p * s->d);
    return s->costs[best];
}

static void sweep_until_quiet(struct school *s, struct random_stream *stream)
{
    double last = INFINITY;
    for (int sweep = 0, quiet = 0; sweep < MOST_SWEEPS && quiet < QUIET_SWEEPS; sweep++) {
        double total = 0;
        for (size_t p = 0; p < s->n; p++)
            total += visit(s, p, stream);
        quiet = fabs(last - total) < 1e-4 * fabs(total) ? quiet + 1 : 0;
        last = total;
    }
}

/* Learners that start inside the region: the penalty then only has to keep them there. */
static bayesopt_status enrol(struct school *s, struct random_stream *stream)
{
    for (size_t i = 0; i < s->n * LEARNERS; i++) {
        double *x = s->learners + i * s->d;
        design_uniform(1, s->d, stream, x);
        if (s->options->n_constraints && !region_contains(s->region, x) &&
            !region_project(s->region, x) && !region_find(s->region, stream, x))
            return bayesopt_fail(BAYESOPT_ERROR_INFEASIBLE,
                                 "design: no point among 2000 uniform ones and 200 projections "
                                 "satisfies the %zu input constraints",
                                 s->region->m);
        s->violations[i] = s->options->n_constraints ? region_violation(s->region, x) : 0;
    }
    for (size_t p = 0; p < s->n; p++) {
        memcpy(s->teachers + p * s->d, s->learners + p * LEARNERS * s->d,
               s->d * sizeof *s->teachers);
        put_column(s, p, s->teachers + p * s->d);
    }
    for (size_t k = 0; k < s->options->n_existing; k++)
        put_column(s, s->n + k, s->options->existing + k * s->d);
    for (size_t p = 0; p < s->n; p++)
        for (size_t q = 0; q < p; q++)
            s->unit += 2 / (double)s->n *
                       design_pair_energy(
                           design_distance2(s->d, s->teachers + p * s->d, s->teachers + q * s->d),
                           s->options->power);
    return BAYESOPT_OK;
}

bayesopt_status design_stlbo(size_t n, size_t d, const bayesopt_design_options *options,
                             struct region *region, double *x)
{
    struct random_stream stream;
    struct school s = {.n = n, .d = d, .options = options, .region = region, .teachers = x};
    s.room = (n + options->n_existing + BLOCK - 1) / BLOCK * BLOCK;
    s.learners =
        calloc(n * LEARNERS * (d + 1) + LEARNERS + (2 * s.room + 3) * d, sizeof *s.learners);
    if (!s.learners)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "design: out of memory");
    s.violations = s.learners + n * LEARNERS * d;
    s.costs = s.violations + n * LEARNERS;
    s.columns = s.costs + LEARNERS;
    s.strata = s.columns + s.room * d;
    s.mean = s.strata + s.room * d;
    s.moved = s.mean + d;
    s.moved_strata = s.moved + d;
    random_start(&stream, options->seed, STREAM_TEACH, 0);
    bayesopt_status status = enrol(&s, &stream);
    if (!status)
        sweep_until_quiet(&s, &stream);
    free(s.learners);
    return status;
}
