/* A swarm of particles with the constriction factor of Clerc and Kennedy, IEEE Trans. Evol. Comput.
 * 6 (2002) 58: every particle is drawn to its own best place and to the best of all. */
#include "core/constraints.h"
#include "core/conventional.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double CONSTRICTION = 0.7298, PULL = 2.05;
enum { SIZE = 20 }; /* the usual number; the parent is one of them */

struct swarm {
    struct ledger *ledger;
    size_t n, draws;
    const double *lower, *upper;
    double *x, *v, *best; /* [SIZE][n] */
    double *random;       /* [2 n] */
    double value[SIZE];   /* at best */
};

/* Unit numbers, the same ones in every run of a seed. */
static void draw(struct swarm *s)
{
    const struct config *config = s->ledger->search->problem->config;
    double *zero = s->random + 2 * s->n, *one = zero + 2 * s->n;
    galv_uniform_sample(config->search_seed, s->draws++, 2 * s->n, zero, one, s->random);
}

static void move(struct swarm *s, size_t p, size_t leader)
{
    double *x = s->x + p * s->n, *v = s->v + p * s->n;
    const double *own = s->best + p * s->n, *all = s->best + leader * s->n;
    draw(s);
    for (size_t k = 0; k < s->n; k++) {
        v[k] = CONSTRICTION * (v[k] + PULL * s->random[k] * (own[k] - x[k]) +
                               PULL * s->random[s->n + k] * (all[k] - x[k]));
        x[k] += v[k];
        if (x[k] < s->lower[k] || x[k] > s->upper[k])
            v[k] = 0;
        x[k] = fmin(fmax(x[k], s->lower[k]), s->upper[k]);
    }
}

static bool visit(struct swarm *s, size_t p)
{
    double value;
    if (!ledger_penalised(s->ledger, s->x + p * s->n, &value))
        return false;
    if (value < s->value[p]) {
        s->value[p] = value;
        memcpy(s->best + p * s->n, s->x + p * s->n, s->n * sizeof *s->x);
    }
    return true;
}

static size_t leader_of(const struct swarm *s)
{
    size_t leader = 0;
    for (size_t p = 1; p < SIZE; p++)
        if (s->value[p] < s->value[leader])
            leader = p;
    return leader;
}

/* Limits of a point of the unit box, for the first places. */
static int limits_of_unit(void *user_data, size_t d, const double *t, double *value)
{
    struct swarm *s = user_data;
    double *u = s->random;
    for (size_t k = 0; k < d; k++)
        u[k] = s->lower[k] + t[k] * (s->upper[k] - s->lower[k]);
    return limits_evaluate(s->ledger->search->problem, d, u, value);
}

/* The parent, and a Latin hypercube inside the limits. */
static bool start(struct swarm *s)
{
    bayesopt_design_options options;
    bayesopt_design_options_init(&options);
    options.seed = s->ledger->search->problem->config->search_seed;
    options.n_constraints = s->ledger->limits;
    options.constraint = limits_of_unit;
    options.constraint_user_data = s;
    memset(s->x, 0, s->n * sizeof *s->x);
    double *first = s->x + s->n;
    if (bayesopt_design(BAYESOPT_DESIGN_LHS, SIZE - 1, s->n, &options, first) != BAYESOPT_OK)
        return core_fail("search: %s", bayesopt_last_error());
    for (size_t i = 0; i < (SIZE - 1) * s->n; i++) {
        size_t k = i % s->n;
        first[i] = fmin(s->lower[k] + first[i] * (s->upper[k] - s->lower[k]), s->upper[k]);
    }
    memcpy(s->best, s->x, SIZE * s->n * sizeof *s->x);
    return true;
}

static void fly(struct swarm *s)
{
    bool going = true;
    for (size_t p = 0; p < SIZE && going; p++) {
        s->value[p] = INFINITY;
        going = visit(s, p);
    }
    while (going) {
        size_t leader = leader_of(s);
        for (size_t p = 0; p < SIZE && going; p++) {
            move(s, p, leader);
            going = visit(s, p);
        }
    }
}

bool swarm_run(struct search *search, const struct method_row *method)
{
    struct ledger ledger;
    bool ok = ledger_open(search, method, &ledger);
    size_t n = ledger.n;
    struct swarm s = {.ledger = &ledger,
                      .n = n,
                      .lower = galv_model_lower(search->problem->model),
                      .upper = galv_model_upper(search->problem->model)};
    double *room = calloc((3 * SIZE + 6) * n, sizeof *room);
    if (ok && room) {
        s.x = room;
        s.v = room + SIZE * n;
        s.best = room + 2 * SIZE * n;
        s.random = room + 3 * SIZE * n;
        for (size_t k = 0; k < 2 * n; k++)
            s.random[4 * n + k] = 1;
        ok = start(&s);
        if (ok) {
            fly(&s);
            ok = ledger_stop(&ledger, "the method ended by itself");
        }
    } else {
        ok = ok && core_no_memory();
    }
    free(room);
    ledger_close(&ledger);
    return ok;
}
