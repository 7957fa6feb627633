/* Designs on the box: options, uniform points, Latin hypercubes and their annealing. */
#include "design_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "error.h"

const char *bayesopt_design_name(bayesopt_design_kind kind)
{
    static const char *const names[] = {"uniform", "lhs", "annealed-lhs", "sobol", "stlbo"};
    return (unsigned)kind < sizeof names / sizeof *names ? names[kind] : "unknown";
}

void bayesopt_design_options_init(bayesopt_design_options *options)
{
    *options = (bayesopt_design_options){.seed = 1, .power = 2, .latin_weight = 1};
}

void design_uniform(size_t n, size_t d, struct random_stream *stream, double *x)
{
    for (size_t i = 0; i < n * d; i++)
        x[i] = random_uniform(stream);
}

/* Of n + n_existing strata per variable at least n hold no existing point; the new points take n of
 * those in random order. Without existing points this is a Latin hypercube. */
bool design_lhs(size_t n, size_t d, const bayesopt_design_options *options,
                struct random_stream *stream, double *x)
{
    size_t strata = n + options->n_existing;
    size_t *order = malloc(2 * strata * sizeof *order);
    if (!order)
        return false;
    size_t *taken = order + strata;
    for (size_t j = 0; j < d; j++) {
        memset(taken, 0, strata * sizeof *taken);
        for (size_t e = 0; e < options->n_existing; e++) {
            double bin = options->existing[e * d + j] * (double)strata;
            taken[bin >= (double)strata ? strata - 1 : (size_t)fmax(bin, 0)] = 1;
        }
        random_permutation(stream, strata, order);
        for (size_t s = 0, i = 0; s < strata && i < n; s++)
            if (!taken[order[s]])
                x[i++ * d + j] = ((double)order[s] + random_uniform(stream)) / (double)strata;
    }
    free(order);
    return true;
}

double design_pair_energy(double d2, double power)
{
    if (power == 2)
        return 1 / fmax(d2, 1e-12);
    return pow(fmax(d2, 1e-12), -power / 2);
}

double design_distance2(size_t d, const double *a, const double *b)
{
    double sum = 0;
    for (size_t j = 0; j < d; j++)
        sum += (a[j] - b[j]) * (a[j] - b[j]);
    return sum;
}

struct anneal {
    size_t n, all, d; /* new points, with the existing ones, variables */
    double power, *x, *d2;
    const double *existing;
};

static const double *row(const struct anneal *a, size_t i)
{
    return i < a->n ? a->x + i * a->d : a->existing + (i - a->n) * a->d;
}

/* Change of the energy if rows r and s exchange variable j. Their own distance stays. */
static double swap_gain(const struct anneal *a, size_t r, size_t s, size_t j)
{
    double gain = 0, at_r = a->x[r * a->d + j], at_s = a->x[s * a->d + j];
    for (size_t i = 0; i < a->all; i++) {
        if (i == r || i == s)
            continue;
        double at = row(a, i)[j];
        double change = (at_s - at) * (at_s - at) - (at_r - at) * (at_r - at);
        double old_r = a->d2[r * a->all + i], old_s = a->d2[s * a->all + i];
        gain += design_pair_energy(old_r + change, a->power) - design_pair_energy(old_r, a->power) +
                design_pair_energy(old_s - change, a->power) - design_pair_energy(old_s, a->power);
    }
    return gain;
}

static void swap(struct anneal *a, size_t r, size_t s, size_t j)
{
    double *at_r = &a->x[r * a->d + j], *at_s = &a->x[s * a->d + j], kept = *at_r;
    for (size_t i = 0; i < a->all; i++) {
        if (i == r || i == s)
            continue;
        double at = row(a, i)[j];
        double change = (*at_s - at) * (*at_s - at) - (*at_r - at) * (*at_r - at);
        a->d2[r * a->all + i] += change;
        a->d2[s * a->all + i] -= change;
        if (i < a->n) {
            a->d2[i * a->all + r] += change;
            a->d2[i * a->all + s] -= change;
        }
    }
    *at_r = *at_s;
    *at_s = kept;
}

/* Metropolis moves that exchange one variable of two points: the one-dimensional strata stay
 * occupied while the energy sum 1/dist^power falls. Morris and Mitchell, J. Stat. Plann. Inf. 43
 * (1995). */
bool design_anneal(size_t n, size_t d, const bayesopt_design_options *options,
                   struct random_stream *stream, double *x)
{
    if (n < 2)
        return true;
    struct anneal a = {n, n + options->n_existing, d, options->power, x, NULL, options->existing};
    a.d2 = malloc(n * a.all * sizeof *a.d2);
    if (!a.d2)
        return false;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < a.all; k++)
            a.d2[i * a.all + k] = design_distance2(d, row(&a, i), row(&a, k));
    size_t moves = options->swaps ? options->swaps : 100 * n > 20000 ? 100 * n : 20000;
    /* The scale of the energy's changes sets the temperature. */
    double typical = 0;
    for (int i = 0; i < 64; i++) {
        size_t r = random_below(stream, n), s = (r + 1 + random_below(stream, n - 1)) % n;
        typical += fabs(swap_gain(&a, r, s, random_below(stream, d))) / 64;
    }
    for (size_t m = 0; m < moves; m++) {
        double left = 1 - (double)m / (double)moves;
        double temperature = 0.1 * typical * left * left * left;
        size_t r = random_below(stream, n), s = (r + 1 + random_below(stream, n - 1)) % n;
        size_t j = random_below(stream, d);
        double gain = swap_gain(&a, r, s, j), draw = random_uniform(stream);
        if (gain < 0 || draw < exp(-gain / temperature))
            swap(&a, r, s, j);
    }
    free(a.d2);
    return true;
}

static bayesopt_status check(bayesopt_design_kind kind, size_t n, size_t d,
                             const bayesopt_design_options *o)
{
    if (!n || !d || n > 1000000 || d > 1000)
        return bayesopt_fail(
            BAYESOPT_ERROR_ARGUMENT,
            "design of %zu points in %zu variables: expected 1 to 1000000 and 1 to 1000", n, d);
    if ((unsigned)kind > BAYESOPT_DESIGN_STLBO)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "design kind %d is not known", (int)kind);
    if (!(o->power > 0) || !(o->latin_weight >= 0))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "design: power %g, Latin weight %g: expected positive, not negative",
                             o->power, o->latin_weight);
    if (o->n_constraints && !o->constraint)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "design: %zu constraints without a function",
                             o->n_constraints);
    if (o->n_existing && !o->existing)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "design: %zu existing points without coordinates", o->n_existing);
    for (size_t i = 0; i < o->n_existing * d; i++)
        if (!(o->existing[i] >= 0 && o->existing[i] <= 1))
            return bayesopt_fail(
                BAYESOPT_ERROR_ARGUMENT,
                "design: variable %zu of existing point %zu is %g, expected 0 to 1", i % d, i / d,
                o->existing[i]);
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_design(bayesopt_design_kind kind, size_t n, size_t d,
                                const bayesopt_design_options *options, double *x)
{
    bayesopt_design_options defaults;
    if (!options) {
        bayesopt_design_options_init(&defaults);
        options = &defaults;
    }
    bayesopt_status status = check(kind, n, d, options);
    if (status)
        return status;
    struct random_stream stream;
    struct region region;
    if (!region_create(&region, d, options->n_constraints, options->constraint,
                       options->constraint_data))
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "design: out of memory");
    random_start(&stream, options->seed, STREAM_DESIGN, 0);
    bool ok = true;
    if (kind == BAYESOPT_DESIGN_UNIFORM) {
        design_uniform(n, d, &stream, x);
    } else if (kind == BAYESOPT_DESIGN_SOBOL) {
        ok = design_sobol(n, d, options->seed, x);
    } else if (kind == BAYESOPT_DESIGN_STLBO) {
        status = design_stlbo(n, d, options, &region, x);
    } else {
        ok = design_lhs(n, d, options, &stream, x);
        if (ok && kind == BAYESOPT_DESIGN_ANNEALED_LHS)
            ok = design_anneal(n, d, options, &stream, x);
    }
    if (ok && !status && options->n_constraints && kind != BAYESOPT_DESIGN_STLBO) {
        random_start(&stream, options->seed, STREAM_REPAIR, 0);
        status = design_constrain(n, d, options, &region, &stream, x);
    }
    region_free(&region);
    return ok ? status : bayesopt_fail(BAYESOPT_ERROR_MEMORY, "design: out of memory");
}
