/* Uniform points, Latin hypercubes and their annealing. */
#include "design/design_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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
