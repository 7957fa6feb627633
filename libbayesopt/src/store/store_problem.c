/* What makes two runs the same problem, written to a store and read back from it. */
#include "core/error.h"
#include "store/store_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* An option as numbers. */
struct field {
    const char *name;
    size_t n;
    double *values;
};
enum { FIELDS = 25 };

static double *numbers(size_t n, const double *from)
{
    double *values = malloc((n ? n : 1) * sizeof *values);
    for (size_t i = 0; values && i < n; i++)
        values[i] = from[i];
    return values;
}

/* Seeds have 64 bits, numbers 53: two halves. */
static void split_seed(uint64_t seed, double *halves)
{
    halves[0] = (double)(seed >> 32);
    halves[1] = (double)(seed & UINT32_MAX);
}

/* Order and names of the fields; what each holds is said where it is read
 * back, in create_from_fields(). */
enum {
    BOX_LOWER,
    BOX_UPPER,
    SEED,
    INITIAL_KIND,
    INITIAL_N,
    INITIAL_X,
    CONSTRAINT_LOWER,
    CONSTRAINT_UPPER,
    LINEAR_A,
    LINEAR_B,
    N_INPUT_CONSTRAINTS,
    NOISE,
    KERNEL,
    SCALES,
    TRANSFORM,
    STRATEGY,
    POLISH,
    N_LEVELS,
    LEVEL_COST_RATIO,
    MODEL,
    GROUP,
    KIND,
    FIRST_X,
    OBJECTIVES,
    STOPS
};

/* Stores of earlier versions know nothing of these; they have the default values. */
static bool is_recent(size_t field)
{
    return field == MODEL || field == GROUP || field == KIND || field == FIRST_X ||
           field == OBJECTIVES;
}

static bool problem_fields(const struct bayesopt *bo, struct field *f)
{
    const bayesopt_options *o = &bo->options;
    double seed[2], kind = o->initial_kind, n = (double)o->initial_n;
    double inputs = (double)o->n_input_constraints, noise = o->noise, kernel = o->kernel;
    double scales = o->scales, transform = o->transform, strategy = o->strategy, polish = o->polish;
    double levels = (double)o->n_levels;
    double stops[2] = {(double)o->stop_no_improvement, o->stop_expected_improvement};
    double model[4] = {o->mean, o->choice, o->acquisition, o->lcb_factor}, *group = NULL;
    double kind_head[2] = {o->maximise, o->told_count},
           *kinds = malloc((bo->d + 2) * sizeof *kinds);
    double objectives[3] = {(double)o->n_objectives, bo->maximise[1], bo->maximise[2]};
    split_seed(o->seed, seed);
    memset(f, 0, FIELDS * sizeof *f);
    if (!kinds || (bo->group && !(group = malloc(bo->d * sizeof *group)))) {
        free(kinds);
        return false;
    }
    memcpy(kinds, kind_head, sizeof kind_head);
    for (size_t j = 0; j < bo->d; j++)
        kinds[2 + j] = bo->kind[j];
    for (size_t j = 0; j < bo->d && group; j++)
        group[j] = (double)bo->group[j];
    const struct {
        const char *name;
        size_t n;
        const double *from;
    } list[FIELDS] = {
        [BOX_LOWER] = {"lower", bo->d, bo->lower},
        [BOX_UPPER] = {"upper", bo->d, bo->upper},
        [SEED] = {"seed", 2, seed},
        [INITIAL_KIND] = {"initial_kind", 1, &kind},
        [INITIAL_N] = {"initial_n", 1, &n},
        [INITIAL_X] = {"initial_x", bo->initial_x ? o->initial_n * bo->d : 0, bo->initial_x},
        [CONSTRAINT_LOWER] = {"constraint_lower", o->n_constraints, bo->constraint_lower},
        [CONSTRAINT_UPPER] = {"constraint_upper", o->n_constraints, bo->constraint_upper},
        [LINEAR_A] = {"linear_a", o->n_linear * bo->d, bo->linear_a},
        [LINEAR_B] = {"linear_b", o->n_linear, bo->linear_b},
        [N_INPUT_CONSTRAINTS] = {"n_input_constraints", 1, &inputs},
        [NOISE] = {"noise", 1, &noise},
        [KERNEL] = {"kernel", 1, &kernel},
        [SCALES] = {"scales", 1, &scales},
        [TRANSFORM] = {"transform", 1, &transform},
        [STRATEGY] = {"strategy", 1, &strategy},
        [POLISH] = {"polish", 1, &polish},
        [N_LEVELS] = {"n_levels", 1, &levels},
        [LEVEL_COST_RATIO] = {"level_cost_ratio", 1, &o->level_cost_ratio},
        [MODEL] = {"model", 4, model},
        [GROUP] = {"group", group ? bo->d : 0, group},
        /* Whether the objective is maximised and told points count, then the kinds. */
        [KIND] = {"kinds", bo->d + 2, kinds},
        [FIRST_X] = {"first_x", o->n_first * bo->d, bo->first_x},
        [OBJECTIVES] = {"objectives", 3, objectives},
        [STOPS] = {"stops", 2, stops},
    };
    bool ok = true;
    for (size_t i = 0; i < FIELDS; i++) {
        f[i] = (struct field){list[i].name, list[i].n, numbers(list[i].n, list[i].from)};
        ok = ok && f[i].values;
    }
    free(group);
    free(kinds);
    return ok;
}

static void problem_fields_free(struct field *fields)
{
    for (size_t i = 0; i < FIELDS; i++)
        free(fields[i].values);
}

bayesopt_status store_put_problem(struct bayesopt *bo)
{
    struct field fields[FIELDS];
    bayesopt_status status = problem_fields(bo, fields)
                                 ? BAYESOPT_OK
                                 : bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < FIELDS && !status; i++)
        status = store_put_meta(bo->store, fields[i].name, fields[i].values, fields[i].n);
    problem_fields_free(fields);
    if (!status)
        status = store_put_names(bo);
    return status ? status : store_put_budget(bo);
}

static bayesopt_status compare_field(struct store *store, const struct field *field, bool recent)
{
    double *values;
    size_t n;
    bayesopt_status status = store_get_meta(store, field->name, &values, &n);
    /* What a store does not know it has as it is by default. */
    bool plain = strcmp(field->name, "first_x") != 0 || !field->n;
    for (size_t i = 0; i < field->n && strcmp(field->name, "kinds") == 0; i++)
        plain = plain && field->values[i] == 0;
    if (strcmp(field->name, "objectives") == 0)
        plain = field->values[0] == 1;
    if (!status && !values && recent && plain)
        return BAYESOPT_OK;
    if (!status && (!values || n != field->n))
        status =
            bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                          "%s belongs to another problem: '%s' has %zu numbers there, %zu here",
                          store->path, field->name, n, field->n);
    for (size_t i = 0; i < field->n && !status; i++)
        if (values[i] != field->values[i])
            status =
                bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                              "%s belongs to another problem: '%s' number %zu is %g there, %g here",
                              store->path, field->name, i, values[i], field->values[i]);
    free(values);
    return status;
}

bayesopt_status store_compare_problem(struct bayesopt *bo)
{
    struct field fields[FIELDS];
    bayesopt_status status = problem_fields(bo, fields)
                                 ? BAYESOPT_OK
                                 : bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < STOPS && !status; i++)
        status = compare_field(bo->store, &fields[i], is_recent(i));
    problem_fields_free(fields);
    if (!status)
        status = store_compare_names(bo);
    return status ? status : store_put_budget(bo);
}

static double first(const struct field *field)
{
    return field->n ? field->values[0] : NAN;
}

/* The options and bounds a store was created with; arrays stay in the fields. */
static bayesopt_status create_from_fields(const struct field *f, const struct named *named,
                                          double budget, bayesopt_input_constraint input_constraint,
                                          void *input_user_data, bayesopt **bo)
{
    bayesopt_options o;
    size_t d = f[BOX_LOWER].n, *group = malloc(d * sizeof *group);
    bayesopt_kind *kind = malloc(d * sizeof *kind);
    if (!group || !kind) {
        free(group);
        free(kind);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    for (size_t j = 0; j < f[GROUP].n; j++)
        group[j] = (size_t)f[GROUP].values[j];
    bayesopt_options_init(&o);
    o.group = f[GROUP].n ? group : NULL;
    if (f[KIND].n == d + 2) {
        for (size_t j = 0; j < d; j++)
            kind[j] = (bayesopt_kind)f[KIND].values[2 + j];
        o.kind = kind;
        o.maximise = f[KIND].values[0] != 0;
        o.told_count = f[KIND].values[1] != 0;
    }
    o.n_first = f[FIRST_X].n / d;
    o.first_x = f[FIRST_X].values;
    o.names = (const char *const *)named->names;
    o.n_conditions = named->n;
    o.conditions = (const char *const *)named->conditions;
    o.seed = ((uint64_t)first(&f[SEED]) << 32) | (uint64_t)f[SEED].values[1];
    o.max_evaluations = budget < 0x1p53 ? (size_t)budget : SIZE_MAX;
    o.initial_kind = (bayesopt_design_kind)first(&f[INITIAL_KIND]);
    o.initial_n = (size_t)first(&f[INITIAL_N]);
    o.initial_x = f[INITIAL_X].n ? f[INITIAL_X].values : NULL;
    bool others[2] = {f[OBJECTIVES].values[1] != 0, f[OBJECTIVES].values[2] != 0};
    o.n_objectives = (size_t)first(&f[OBJECTIVES]);
    o.maximise_others = others;
    o.n_constraints = f[CONSTRAINT_LOWER].n - (o.n_objectives - 1);
    o.constraint_lower = f[CONSTRAINT_LOWER].values;
    o.constraint_upper = f[CONSTRAINT_UPPER].values;
    o.n_linear = f[LINEAR_B].n;
    o.linear_a = f[LINEAR_A].values;
    o.linear_b = f[LINEAR_B].values;
    o.noise = (bayesopt_noise)first(&f[NOISE]);
    o.kernel = (bayesopt_kernel)first(&f[KERNEL]);
    o.scales = (bayesopt_scales)first(&f[SCALES]);
    o.transform = (bayesopt_transform)first(&f[TRANSFORM]);
    o.strategy = (bayesopt_strategy)first(&f[STRATEGY]);
    o.polish = first(&f[POLISH]) != 0;
    o.mean = (bayesopt_mean)f[MODEL].values[0];
    o.choice = (bayesopt_choice)f[MODEL].values[1];
    o.acquisition = (bayesopt_acquisition)f[MODEL].values[2];
    o.lcb_factor = f[MODEL].values[3];
    o.n_levels = (size_t)first(&f[N_LEVELS]);
    o.level_cost_ratio = first(&f[LEVEL_COST_RATIO]);
    o.stop_no_improvement = (size_t)first(&f[STOPS]);
    o.stop_expected_improvement = f[STOPS].values[1];
    o.n_input_constraints = (size_t)first(&f[N_INPUT_CONSTRAINTS]);
    o.input_constraint = input_constraint;
    o.input_user_data = input_user_data;
    bool missing = o.n_input_constraints && !input_constraint;
    size_t wanted = o.n_input_constraints;
    if (missing)
        o.n_input_constraints = 0;
    bayesopt_status status = bayesopt_create(d, f[BOX_LOWER].values, f[BOX_UPPER].values, &o, bo);
    free(group);
    free(kind);
    if (!status && missing) {
        (*bo)->options.n_input_constraints = wanted;
        (*bo)->constraints_missing = true;
    }
    return status;
}

static bool is_array(size_t field)
{
    return field <= BOX_UPPER || (field >= INITIAL_X && field <= LINEAR_B) || field == GROUP ||
           field == KIND || field == FIRST_X;
}

/* Counts, choices and switches; the others may be any number. */
static const double MOST_WHOLE = 0x1p53;
static bool is_whole(size_t field, size_t i)
{
    switch (field) {
    case BOX_LOWER:
    case BOX_UPPER:
    case INITIAL_X:
    case CONSTRAINT_LOWER:
    case CONSTRAINT_UPPER:
    case LINEAR_A:
    case LINEAR_B:
    case FIRST_X:
    case LEVEL_COST_RATIO:
        return false;
    case MODEL:
        return i < 3;
    case STOPS:
        return i < 1;
    default:
        return true;
    }
}

/* Arrays must fit each other, everything else has the length it has in any problem. */
static bayesopt_status check_lengths(const struct store *store, const struct field *f,
                                     const size_t *expected)
{
    size_t d = f[BOX_LOWER].n, m = f[CONSTRAINT_LOWER].n, initial = f[INITIAL_X].n;
    for (size_t i = 0; i < FIELDS; i++)
        if (!f[i].values || (!is_array(i) && f[i].n != expected[i]))
            return bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: entry '%s' is damaged", store->path,
                                 f[i].name);
    for (size_t i = 0; i < FIELDS; i++)
        for (size_t j = 0; j < f[i].n; j++)
            if (is_whole(i, j) ? !(f[i].values[j] >= 0 && f[i].values[j] <= MOST_WHOLE &&
                                   f[i].values[j] == floor(f[i].values[j]))
                               : isnan(f[i].values[j]))
                return bayesopt_fail(BAYESOPT_ERROR_FORMAT,
                                     "%s: entry '%s' is damaged: number %zu "
                                     "is %g",
                                     store->path, f[i].name, j, f[i].values[j]);
    double objectives = first(&f[OBJECTIVES]);
    if (!(objectives >= 1 && objectives <= FRONT_MOST_OBJECTIVES) || (double)m + 1 < objectives ||
        !d || f[BOX_UPPER].n != d || f[CONSTRAINT_UPPER].n != m ||
        f[LINEAR_A].n != f[LINEAR_B].n * d || (f[KIND].n != d + 2 && f[KIND].n != 3) ||
        f[FIRST_X].n % d || (f[GROUP].n && f[GROUP].n != d) ||
        (initial && (double)initial != first(&f[INITIAL_N]) * (double)d))
        return bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: its entries do not agree in length",
                             store->path);
    return BAYESOPT_OK;
}

static bayesopt_status read_fields(struct store *store, struct field *fields, double *budget)
{
    /* Names and lengths come from a small problem of the library's own. */
    const double lower = 0, upper = 1;
    bayesopt *sample;
    double *values;
    size_t n, expected[FIELDS];
    bayesopt_status status = bayesopt_create(1, &lower, &upper, NULL, &sample);
    if (status)
        return status;
    bool ok = problem_fields(sample, fields);
    problem_free(sample);
    if (!ok)
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    for (size_t i = 0; i < FIELDS && !status; i++) {
        expected[i] = fields[i].n;
        status = store_get_meta(store, fields[i].name, &values, &n);
        if (!status && !values && is_recent(i))
            continue;
        free(fields[i].values);
        fields[i].values = values;
        fields[i].n = n;
    }
    if (!status)
        status = check_lengths(store, fields, expected);
    if (status)
        return status;
    status = store_get_meta(store, "budget", &values, &n);
    bool good =
        values && n == 1 && values[0] >= 0 && values[0] <= 0x1p64 && values[0] == floor(values[0]);
    if (!status && !good)
        status = bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: entry 'budget' is damaged", store->path);
    if (!status)
        *budget = values[0];
    free(values);
    return status;
}

bayesopt_status store_get_problem(struct store *store, bayesopt_input_constraint input_constraint,
                                  void *input_user_data, bayesopt **bo)
{
    struct field fields[FIELDS] = {{0}};
    double budget = 0;
    bayesopt_status status = read_fields(store, fields, &budget);
    struct named named = {0};
    if (!status)
        status = store_get_names(store, fields[BOX_LOWER].n, &named);
    if (!status)
        status = create_from_fields(fields, &named, budget, input_constraint, input_user_data, bo);
    named_free(&named);
    problem_fields_free(fields);
    return status;
}
