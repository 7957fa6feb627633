/* What a program sees whose thread a call borrows: the number of the BLAS during the call is that
 * of its options, and afterwards what it was; progress comes in small steps, and a cancelled call
 * ends. */
#include "check.h"

#include <bayesopt/bayesopt.h>
#include <galv/model.h>
#include <igabem/solve.h>
#include <nurbs/primitives.h>

#include <cblas.h>

enum { WANTED = 1 };
static int before; /* two, where the BLAS has threads */

/* What the callbacks of a call have seen. */
struct seen {
    size_t calls, wrong; /* calls with another number of the BLAS */
    double last, step, stop;
};

static int start(void)
{
    openblas_set_num_threads(2);
    return openblas_get_num_threads();
}

static void look(struct seen *seen)
{
    seen->calls++;
    seen->wrong += openblas_get_num_threads() != WANTED;
}

static int hear(void *data, double fraction)
{
    struct seen *seen = data;
    look(seen);
    seen->step = fmax(seen->step, fraction - seen->last);
    seen->last = fraction;
    return fraction >= seen->stop;
}

static int count_ask(void *data, size_t found, size_t wanted)
{
    struct seen *seen = data;
    look(seen);
    return found > wanted;
}

static int sines(void *data, size_t first, size_t count, double *rows)
{
    (void)data;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < 30; k++)
            rows[30 * i + k] = sin((double)((first + i) * (k + 1)));
    return 0;
}

static void check(const struct seen *seen)
{
    CU_ASSERT(seen->calls > 0);
    CU_ASSERT_EQUAL(seen->wrong, 0);
    CU_ASSERT_EQUAL(openblas_get_num_threads(), before);
}

static void solve(void)
{
    before = start();
    nurbs_surface *surface;
    igabem_hull *hull;
    igabem_solution *solution;
    igabem_options options;
    igabem_options_init(&options);
    CU_ASSERT_EQUAL_FATAL(nurbs_make_wigley(1, 0.1, 0.0625, &surface), NURBS_OK);
    const nurbs_surface *patch = surface;
    CU_ASSERT_EQUAL_FATAL(igabem_hull_create(&patch, 1, IGABEM_SYMMETRIC, &hull), IGABEM_OK);
    options.froude = 0.4;
    options.elements_u = 12;
    options.elements_v = 4;
    options.threads = WANTED;
    options.progress = hear;
    for (int cancel = 0; cancel < 2; cancel++) {
        struct seen seen = {.stop = cancel ? 0.3 : 2.0};
        options.progress_user_data = &seen;
        CU_ASSERT_EQUAL(igabem_solve(hull, &options, &solution),
                        cancel ? IGABEM_ERROR_CANCELLED : IGABEM_OK);
        check(&seen);
        /* LU of few unknowns is one step. */
        CU_ASSERT(seen.step < 0.2 && (cancel ? seen.last < 0.35 : seen.last == 1.0));
        CU_ASSERT(seen.calls > (cancel ? 10 : 30));
        igabem_solution_free(solution);
    }
    igabem_hull_free(hull);
    nurbs_surface_free(surface);
}

static void build(void)
{
    before = start();
    galv_options options;
    galv_options_init(&options);
    options.threads = WANTED;
    options.progress = hear;
    options.workspace = 1 << 16;
    struct seen seen = {.stop = 2.0};
    options.progress_user_data = &seen;
    const galv_data data = {.count = 2000, .coordinates = 30, .rows = sines};
    galv_model *model;
    CU_ASSERT_EQUAL(galv_build_data(&data, &options, &model), GALV_OK);
    check(&seen);
    galv_model_free(model);
}

static void ask(void)
{
    before = start();
    const double lower[2] = {-1, -1}, upper[2] = {1, 1};
    double x[2];
    uint64_t id;
    bayesopt_options options;
    bayesopt *bo;
    bayesopt_options_init(&options);
    options.initial_n = 5;
    options.threads = -1;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    options.threads = 1.5;
    CU_ASSERT_EQUAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_ERROR_ARGUMENT);
    options.threads = WANTED;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(2, lower, upper, &options, &bo), BAYESOPT_OK);
    struct seen seen = {0};
    CU_ASSERT_EQUAL(bayesopt_set_ask_progress(bo, count_ask, &seen), BAYESOPT_OK);
    for (int k = 0; k < 7; k++) {
        CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, x[0] * x[0] + x[1], NULL), BAYESOPT_OK);
    }
    check(&seen);
    bayesopt_gp_options gp;
    bayesopt_gp_options_init(&gp);
    bayesopt_gp *model;
    gp.threads = 2000;
    CU_ASSERT_EQUAL(bayesopt_gp_create(2, &gp, &model), BAYESOPT_ERROR_ARGUMENT);
    bayesopt_free(bo);
}

static const struct check_case cases[] = {
    {"igabem_solve", solve},
    {"galv_build_data", build},
    {"bayesopt_ask", ask},
};

CHECK_MAIN("guest", cases)
