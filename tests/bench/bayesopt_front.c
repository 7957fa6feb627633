/* Pareto sets: expected hypervolume improvement beside NSGA-II (Deb, Pratap, Agarwal and Meyarivan,
 * IEEE Trans. Evol. Comp. 6 (2002) 182) at the same number of evaluations. Prints medians over the
 * seeds of the dominated hypervolume, as a share of that of the known front where there is one.
 *
 * usage: bayesopt_front [SEEDS [EVALUATIONS]]
 */
#include <bayesopt/bayesopt.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_D = 6, MOST_M = 3, MOST_G = 2, MOST_N = 400, POPULATION = 20 };

struct problem {
    const char *name;
    size_t d, m, g; /* variables, objectives, constraints g <= 0 */
    double lower[MOST_D], upper[MOST_D], reference[MOST_M];
    double whole; /* hypervolume of the front, NAN: not known in closed form */
    void (*f)(const double *x, double *f, double *g);
};

static const double pi = 3.14159265358979323846;

static double tail(const double *x)
{
    double sum = 0;
    for (size_t j = 1; j < MOST_D; j++)
        sum += x[j];
    return 1 + 9 * sum / (MOST_D - 1);
}

/* Zitzler, Deb and Thiele, Evol. Comp. 8 (2000) 173. */
static void zdt1(const double *x, double *f, double *g)
{
    double h = tail(x);
    (void)g;
    f[0] = x[0];
    f[1] = h * (1 - sqrt(x[0] / h));
}

static void zdt2(const double *x, double *f, double *g)
{
    double h = tail(x);
    (void)g;
    f[0] = x[0];
    f[1] = h * (1 - x[0] * x[0] / (h * h));
}

static void zdt3(const double *x, double *f, double *g)
{
    double h = tail(x);
    (void)g;
    f[0] = x[0];
    f[1] = h * (1 - sqrt(x[0] / h) - x[0] / h * sin(10 * pi * x[0]));
}

/* Deb, Thiele, Laumanns and Zitzler, CEC 2002. */
static void dtlz2(const double *x, double *f, double *g)
{
    double h = 1;
    (void)g;
    for (size_t j = 2; j < MOST_D; j++)
        h += (x[j] - 0.5) * (x[j] - 0.5);
    f[0] = h * cos(x[0] * pi / 2) * cos(x[1] * pi / 2);
    f[1] = h * cos(x[0] * pi / 2) * sin(x[1] * pi / 2);
    f[2] = h * sin(x[0] * pi / 2);
}

/* Binh and Korn, 1997. */
static void bnh(const double *x, double *f, double *g)
{
    f[0] = 4 * x[0] * x[0] + 4 * x[1] * x[1];
    f[1] = (x[0] - 5) * (x[0] - 5) + (x[1] - 5) * (x[1] - 5);
    g[0] = (x[0] - 5) * (x[0] - 5) + x[1] * x[1] - 25;
    g[1] = 7.7 - (x[0] - 8) * (x[0] - 8) - (x[1] + 3) * (x[1] + 3);
}

/* CONSTR of Deb et al. 2002. */
static void constr(const double *x, double *f, double *g)
{
    f[0] = x[0];
    f[1] = (1 + x[1]) / x[0];
    g[0] = 6 - x[1] - 9 * x[0];
    g[1] = 1 + x[1] - 9 * x[0];
}

static const struct problem problems[] = {
    {"zdt1", 6, 2, 0, {0}, {1, 1, 1, 1, 1, 1}, {1.1, 1.1}, 0.11 + 0.1 + 2.0 / 3, zdt1},
    {"zdt2", 6, 2, 0, {0}, {1, 1, 1, 1, 1, 1}, {1.1, 1.1}, 0.11 + 0.1 + 1.0 / 3, zdt2},
    {"zdt3", 6, 2, 0, {0}, {1, 1, 1, 1, 1, 1}, {1.1, 1.1}, NAN, zdt3},
    {"dtlz2",
     6,
     3,
     0,
     {0},
     {1, 1, 1, 1, 1, 1},
     {1.1, 1.1, 1.1},
     1.331 - 4.0 / 24 * 3.14159265358979,
     dtlz2},
    {"bnh", 2, 2, 2, {0, 0}, {5, 3}, {140, 50}, NAN, bnh},
    {"constr", 2, 2, 2, {0.1, 0}, {1, 5}, {1.1, 10}, NAN, constr},
};

/* All that was evaluated. */
struct history {
    size_t n;
    double f[MOST_N][MOST_M], violation[MOST_N];
};

static double violation(const struct problem *p, const double *g)
{
    double sum = 0;
    for (size_t k = 0; k < p->g; k++)
        sum += fmax(g[k], 0);
    return sum;
}

static void note(struct history *h, const struct problem *p, const double *f, const double *g)
{
    memcpy(h->f[h->n], f, p->m * sizeof *f);
    h->violation[h->n++] = violation(p, g);
}

static double volume(const struct history *h, const struct problem *p)
{
    double points[MOST_N * MOST_M], result = NAN;
    size_t n = 0;
    for (size_t i = 0; i < h->n; i++)
        if (h->violation[i] <= 0)
            memcpy(points + n++ * p->m, h->f[i], p->m * sizeof *points);
    bayesopt_hypervolume(p->m, n, points, p->reference, &result);
    return result;
}

static double search(const struct problem *p, uint64_t seed, size_t budget)
{
    bayesopt_options options;
    bayesopt *bo;
    struct history h = {0};
    static const double zero[MOST_G] = {0};
    double x[MOST_D], f[MOST_M], outcomes[MOST_G + MOST_M], g[MOST_G];
    uint64_t id;
    bayesopt_options_init(&options);
    options.seed = seed;
    options.n_objectives = p->m;
    options.n_constraints = p->g;
    options.constraint_upper = zero;
    options.initial_n = POPULATION;
    options.max_evaluations = budget;
    if (bayesopt_create(p->d, p->lower, p->upper, &options, &bo))
        return NAN;
    while (bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK) {
        p->f(x, f, g);
        note(&h, p, f, g);
        memcpy(outcomes, g, p->g * sizeof *g);
        memcpy(outcomes + p->g, f + 1, (p->m - 1) * sizeof *f);
        bayesopt_tell(bo, id, f[0], outcomes);
    }
    bayesopt_free(bo);
    return volume(&h, p);
}

/* NSGA-II: constrained domination, ranks, crowding distance, simulated binary crossover and
 * polynomial mutation with the paper's indices. */
static uint64_t state;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

struct member {
    double x[MOST_D], f[MOST_M], violation, crowding;
    size_t rank;
};

static bool dominates(const struct problem *p, const struct member *a, const struct member *b)
{
    bool better = false;
    if (a->violation > 0 || b->violation > 0)
        return a->violation < b->violation;
    for (size_t c = 0; c < p->m; c++) {
        if (a->f[c] > b->f[c])
            return false;
        better = better || a->f[c] < b->f[c];
    }
    return better;
}

static void rank_all(const struct problem *p, size_t n, struct member *all)
{
    size_t ranked = 0;
    for (size_t i = 0; i < n; i++)
        all[i].rank = SIZE_MAX;
    for (size_t rank = 0; ranked < n; rank++)
        for (size_t i = 0; i < n; i++) {
            bool free = all[i].rank == SIZE_MAX;
            for (size_t k = 0; k < n && free; k++)
                free = all[k].rank < rank || !dominates(p, &all[k], &all[i]);
            if (free) {
                all[i].rank = rank;
                ranked++;
            }
        }
}

static void crowd_all(const struct problem *p, size_t n, struct member *all)
{
    for (size_t i = 0; i < n; i++)
        all[i].crowding = 0;
    for (size_t c = 0; c < p->m; c++)
        for (size_t i = 0; i < n; i++) {
            double below = -INFINITY, above = INFINITY, low = INFINITY, high = -INFINITY;
            for (size_t k = 0; k < n; k++) {
                double f = all[k].f[c];
                if (all[k].rank != all[i].rank)
                    continue;
                low = fmin(low, f);
                high = fmax(high, f);
                if (k != i && f <= all[i].f[c])
                    below = fmax(below, f);
                if (k != i && f >= all[i].f[c])
                    above = fmin(above, f);
            }
            all[i].crowding += high > low ? (above - below) / (high - low) : 0;
        }
}

static bool fitter(const struct member *a, const struct member *b)
{
    return a->rank < b->rank || (a->rank == b->rank && a->crowding > b->crowding);
}

static const struct member *tournament(const struct member *all)
{
    const struct member *a = &all[(size_t)(uniform() * POPULATION)];
    const struct member *b = &all[(size_t)(uniform() * POPULATION)];
    return fitter(a, b) ? a : b;
}

static double spread(double u, double eta)
{
    return u <= 0.5 ? pow(2 * u, 1 / (eta + 1)) : pow(1 / (2 * (1 - u)), 1 / (eta + 1));
}

static void breed(const struct problem *p, const struct member *all, struct member *child)
{
    const struct member *a = tournament(all), *b = tournament(all);
    bool cross = uniform() < 0.9;
    for (size_t j = 0; j < p->d; j++) {
        double range = p->upper[j] - p->lower[j], x = a->x[j];
        if (cross && uniform() < 0.5) {
            double beta = spread(uniform(), 20);
            x = 0.5 * ((1 + beta) * a->x[j] + (1 - beta) * b->x[j]);
        }
        if (uniform() < 1.0 / (double)p->d) {
            double u = uniform();
            x += range * (u < 0.5 ? pow(2 * u, 1 / 21.0) - 1 : 1 - pow(2 * (1 - u), 1 / 21.0));
        }
        child->x[j] = fmin(fmax(x, p->lower[j]), p->upper[j]);
    }
}

static double evolve(const struct problem *p, uint64_t seed, size_t budget)
{
    struct member all[2 * POPULATION];
    struct history h = {0};
    double g[MOST_G], unit[POPULATION * MOST_D];
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = seed;
    bayesopt_design(BAYESOPT_DESIGN_ANNEALED_LHS, POPULATION, p->d, &options, unit);
    state = seed * 7919;
    for (size_t i = 0; h.n < budget; i++) {
        struct member *m = &all[i < POPULATION ? i : POPULATION + i % POPULATION];
        for (size_t j = 0; j < p->d && i < POPULATION; j++)
            m->x[j] = p->lower[j] + unit[i * p->d + j] * (p->upper[j] - p->lower[j]);
        if (i >= POPULATION)
            breed(p, all, m);
        p->f(m->x, m->f, g);
        m->violation = violation(p, g);
        note(&h, p, m->f, g);
        if (i + 1 == POPULATION) {
            rank_all(p, POPULATION, all);
            crowd_all(p, POPULATION, all);
        } else if (i >= POPULATION && (i + 1) % POPULATION == 0) {
            rank_all(p, (size_t)2 * POPULATION, all);
            crowd_all(p, (size_t)2 * POPULATION, all);
            for (size_t a = 0; a < POPULATION; a++)
                for (size_t b = a + 1; b < 2 * POPULATION; b++)
                    if (fitter(&all[b], &all[a])) {
                        struct member kept = all[a];
                        all[a] = all[b];
                        all[b] = kept;
                    }
        }
    }
    return volume(&h, p);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
    size_t seeds = argc > 1 ? strtoul(argv[1], NULL, 10) : 5;
    size_t budget = argc > 2 ? strtoul(argv[2], NULL, 10) : 80;
    double ours[100], theirs[100];
    if (seeds < 1 || seeds > 100 || budget < POPULATION || budget > MOST_N)
        return EXIT_FAILURE;
    printf("problem,evaluations,volume,least,most,nsga2,nsga2_least,nsga2_most,front\n");
    for (size_t k = 0; k < sizeof problems / sizeof *problems; k++) {
        const struct problem *p = &problems[k];
        for (size_t s = 0; s < seeds; s++) {
            ours[s] = search(p, s + 1, budget);
            theirs[s] = evolve(p, s + 1, budget);
        }
        qsort(ours, seeds, sizeof *ours, compare);
        qsort(theirs, seeds, sizeof *theirs, compare);
        printf("%s,%zu,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g,%.5g\n", p->name, budget, ours[seeds / 2],
               ours[0], ours[seeds - 1], theirs[seeds / 2], theirs[0], theirs[seeds - 1], p->whole);
        fflush(stdout);
    }
    return EXIT_SUCCESS;
}
