/* Failures of the point and of the moment, and points that are asked again. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>
#include <stdint.h>
#include <unistd.h>

static bayesopt *make(size_t initial, size_t budget)
{
    const double lower = 0, upper = 1;
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.initial_n = initial;
    options.max_evaluations = budget;
    CU_ASSERT_FATAL(bayesopt_create(1, &lower, &upper, &options, &bo) == BAYESOPT_OK);
    return bo;
}

static bayesopt_state state_of(const bayesopt *bo, size_t i)
{
    bayesopt_point point;
    CU_ASSERT_FATAL(bayesopt_get(bo, i, &point) == BAYESOPT_OK);
    return point.state;
}

/* Minimises (x - 0.5)^2 where the first evaluations near the minimum fail. */
static double after_failures(bool transient)
{
    bayesopt *bo = make(8, 24);
    double x, best = INFINITY;
    uint64_t id;
    size_t failures = 0;
    while (bayesopt_ask(bo, 1, &x, &id) == BAYESOPT_OK) {
        bool fails = fabs(x - 0.5) < 0.15 && failures < 4;
        bayesopt_result result = {.f = fails ? NAN : (x - 0.5) * (x - 0.5), .transient = transient};
        failures += fails;
        CU_ASSERT(bayesopt_tell_result(bo, id, &result) == BAYESOPT_OK);
    }
    bayesopt_best(bo, NULL, &best, NULL);
    bayesopt_free(bo);
    return best;
}

static void nothing_is_learnt_from_lost_points(void)
{
    CU_ASSERT(after_failures(true) < 1e-6);
    CU_ASSERT(after_failures(false) > 1e-4);
}

static void failed_points_are_asked_again(void)
{
    bayesopt *bo = make(2, 2);
    bayesopt_point point;
    double x, y;
    uint64_t id;
    bayesopt_ask(bo, 1, &x, &id);
    CU_ASSERT(bayesopt_tell_failed(bo, id, "no licence") == BAYESOPT_OK);
    bayesopt_ask(bo, 1, &y, &id);
    CU_ASSERT(bayesopt_tell(bo, id, 1, NULL) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_ask(bo, 1, &y, &id) == BAYESOPT_STOP_BUDGET);
    CU_ASSERT(bayesopt_release(bo, 2) == BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT(bayesopt_release(bo, 3) == BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT(bayesopt_release(bo, 1) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_get(bo, 0, &point) == BAYESOPT_OK);
    CU_ASSERT(point.state == BAYESOPT_STATE_PENDING && *point.note == '\0');
    CU_ASSERT(bayesopt_ask(bo, 1, &y, &id) == BAYESOPT_OK && id == 1 && x == y);
    bayesopt_result lost = {.f = NAN, .transient = true};
    CU_ASSERT(bayesopt_tell_result(bo, 1, &lost) == BAYESOPT_OK);
    CU_ASSERT(state_of(bo, 0) == BAYESOPT_STATE_LOST);
    CU_ASSERT_STRING_EQUAL(bayesopt_state_name(BAYESOPT_STATE_LOST), "lost");
    bayesopt_free(bo);
}

/* Two sessions on one store: what one loses and releases the other sees and gets. */
static void other_sessions_see_it(void)
{
    char path[256];
    double x, y;
    uint64_t id;
    snprintf(path, sizeof path, "%s/bayesopt_failures_%ld.db", check_scratch(), (long)getpid());
    remove(path);
    bayesopt *a = make(3, 3), *b = make(3, 3);
    CU_ASSERT_FATAL(bayesopt_open_store(a, path) == BAYESOPT_OK);
    CU_ASSERT_FATAL(bayesopt_open_store(b, path) == BAYESOPT_OK);
    bayesopt_ask(a, 1, &x, &id);
    bayesopt_attribute attribute = {.name = "attempts", .number = 3};
    bayesopt_result lost = {
        .f = NAN, .transient = true, .note = "queue", .n_attributes = 1, .attributes = &attribute};
    CU_ASSERT(bayesopt_tell_result(a, id, &lost) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_refresh(b) == BAYESOPT_OK);
    CU_ASSERT(state_of(b, 0) == BAYESOPT_STATE_LOST);
    CU_ASSERT(bayesopt_release(b, 1) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_refresh(a) == BAYESOPT_OK);
    bayesopt_point point;
    CU_ASSERT(bayesopt_get(a, 0, &point) == BAYESOPT_OK);
    CU_ASSERT(point.state == BAYESOPT_STATE_PENDING && point.n_attributes == 0);
    CU_ASSERT(bayesopt_ask(a, 1, &y, &id) == BAYESOPT_OK && id == 1 && x == y);
    /* Held by a living session, and released all the same. */
    CU_ASSERT(bayesopt_release(b, 1) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_ask(b, 1, &y, &id) == BAYESOPT_OK && id == 1);
    CU_ASSERT(bayesopt_tell(b, 1, 4, NULL) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_release(a, 1) == BAYESOPT_ERROR_ARGUMENT);
    bayesopt_free(a);
    bayesopt_free(b);
    remove(path);
}

/* Cancels after a number of calls; tells of progress that goes backwards. */
struct patience {
    size_t calls, most, found;
};

static int lose_patience(void *user_data, size_t found, size_t wanted)
{
    struct patience *p = user_data;
    CU_ASSERT(wanted == 3 && found < wanted && found >= p->found);
    p->found = found;
    return ++p->calls > p->most;
}

/* Wherever an ask is cancelled, it leaves nothing behind, and the next one gives what an
 * undisturbed one gives. */
static void asks_can_be_cancelled(void)
{
    double x[3], y[3];
    uint64_t ids[3], others[3];
    bayesopt *bo = make(6, 20), *calm = make(6, 20);
    for (int i = 0; i < 6; i++) {
        bayesopt_ask(bo, 1, x, ids);
        bayesopt_tell(bo, ids[0], sin(9 * x[0]), NULL);
        bayesopt_ask(calm, 1, x, ids);
        bayesopt_tell(calm, ids[0], sin(9 * x[0]), NULL);
    }
    /* Two points that are left over, of which the first ask would give out both. */
    CU_ASSERT(bayesopt_ask(bo, 2, x, ids) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_release(bo, 7) == BAYESOPT_OK && bayesopt_release(bo, 8) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_ask(calm, 2, x, ids) == BAYESOPT_OK);
    CU_ASSERT(bayesopt_release(calm, 7) == BAYESOPT_OK && bayesopt_release(calm, 8) == BAYESOPT_OK);
    struct patience p = {.most = 1000000};
    bayesopt_set_ask_progress(calm, lose_patience, &p);
    CU_ASSERT(bayesopt_ask(calm, 3, y, others) == BAYESOPT_OK);
    CU_ASSERT(p.calls > 10);
    const size_t all = p.calls;
    for (size_t most = 0; most < all; most += 1 + all / 7) {
        p = (struct patience){.most = most};
        bayesopt_set_ask_progress(bo, lose_patience, &p);
        CU_ASSERT(bayesopt_ask(bo, 3, x, ids) == BAYESOPT_ERROR_CANCELLED);
        CU_ASSERT(bayesopt_count(bo) == 8);
    }
    bayesopt_set_ask_progress(bo, NULL, NULL);
    CU_ASSERT(bayesopt_ask(bo, 3, x, ids) == BAYESOPT_OK);
    for (int i = 0; i < 3; i++)
        CU_ASSERT(ids[i] == others[i] && x[i] == y[i]);
    bayesopt_free(bo);
    bayesopt_free(calm);
}

static const struct check_case cases[] = {
    {"nothing is learnt from lost points", nothing_is_learnt_from_lost_points},
    {"failed points are asked again", failed_points_are_asked_again},
    {"other sessions see it", other_sessions_see_it},
    {"asks can be cancelled", asks_can_be_cancelled},
};

CHECK_MAIN("bayesopt failures", cases)
