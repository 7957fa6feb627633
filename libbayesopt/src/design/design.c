/* Designs on the box: options, checks, which kind. */
#include "core/error.h"
#include "design/design_internal.h"

/* Annealing moves: more would take hours. */
enum { MOST_SWAPS = 1000000000 };

const char *bayesopt_design_name(bayesopt_design_kind kind)
{
    static const char *const names[] = {"uniform", "lhs", "annealed-lhs", "sobol", "stlbo"};
    return (unsigned)kind < sizeof names / sizeof *names ? names[kind] : "unknown";
}

void bayesopt_design_options_init(bayesopt_design_options *options)
{
    if (!options)
        return;
    *options = (bayesopt_design_options){.seed = 1, .power = 2, .latin_weight = 1};
}

static bayesopt_status check(bayesopt_design_kind kind, size_t n, size_t d,
                             const bayesopt_design_options *o)
{
    if (!n || !d || n > BAYESOPT_MOST_POINTS || d > BAYESOPT_MOST_VARIABLES)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "design of %zu points in %zu variables: expected 1 to %d and 1 to %d",
                             n, d, BAYESOPT_MOST_POINTS, BAYESOPT_MOST_VARIABLES);
    if ((unsigned)kind > BAYESOPT_DESIGN_STLBO)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "design kind %d is not known", (int)kind);
    if (!(o->power > 0) || !(o->latin_weight >= 0))
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "design: power %g, Latin weight %g: expected positive, not negative",
                             o->power, o->latin_weight);
    if (o->swaps > MOST_SWAPS)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "design: %zu swaps, expected at most %d",
                             o->swaps, MOST_SWAPS);
    if (o->n_constraints > BAYESOPT_MOST_CONSTRAINTS || o->n_existing > BAYESOPT_MOST_POINTS)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "design: %zu constraints and %zu existing points, expected at most %d "
                             "and %d",
                             o->n_constraints, o->n_existing, BAYESOPT_MOST_CONSTRAINTS,
                             BAYESOPT_MOST_POINTS);
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
    NEED(x);
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
                       options->constraint_user_data))
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
