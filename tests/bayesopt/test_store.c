/* The store: what was promised is on disk, whatever happens to the process. */
#include "store_study.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>

/* Interrupted anywhere and resumed, a run proposes what it would have proposed uninterrupted. */
static void resuming_continues_the_sequence(void)
{
    bayesopt *whole = make(NULL);
    run(whole, N);
    fresh_path("resume");
    for (size_t done = 0; done < N;) {
        bayesopt *part = open_store();
        CU_ASSERT_EQUAL(bayesopt_count(part), done);
        run(part, 4);
        done = bayesopt_count(part);
        bayesopt_free(part);
    }
    bayesopt *again = open_store();
    same_history(whole, again);
    bayesopt_free(again);
    bayesopt_free(whole);
    remove(path);
}

/* Processes are killed without warning, some between ask and tell: no value is lost, none evaluated
 * twice under another id, and the sequence is that of an undisturbed run. */
static void killed_processes_lose_nothing(void)
{
    fresh_path("kill");
    for (int round = 0; round < 40; round++) {
        fflush(NULL);
        pid_t child = fork();
        if (child == 0) {
            const double lower[D] = {0, 0, 0}, upper[D] = {1, 1, 1};
            bayesopt_options options;
            bayesopt *bo;
            double x[D];
            uint64_t id;
            bayesopt_options_init(&options);
            options.initial_n = 10;
            options.max_evaluations = N;
            if (bayesopt_create(D, lower, upper, &options, &bo) || bayesopt_open_store(bo, path))
                _exit(1);
            for (int i = 0; bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK; i++) {
                if (i == 1 + round % 2)
                    raise(SIGKILL);
                if (bayesopt_tell(bo, id, bowl(x), NULL))
                    _exit(2);
            }
            _exit(0);
        }
        int status;
        CU_ASSERT_EQUAL(waitpid(child, &status, 0), child);
        if (WIFEXITED(status)) {
            CU_ASSERT_EQUAL(WEXITSTATUS(status), 0);
            break;
        }
    }
    bayesopt *whole = make(NULL), *killed = open_store();
    run(whole, N);
    same_history(whole, killed);
    bayesopt_free(killed);
    bayesopt_free(whole);
    remove(path);
}

static void pending_points_come_back(void)
{
    double x[2 * D], again[2 * D];
    uint64_t ids[2], second[2];
    fresh_path("pending");
    bayesopt *bo = open_store();
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 2, x, ids), BAYESOPT_OK);
    /* Another session meanwhile gets other points. */
    bayesopt *other = open_store();
    CU_ASSERT_EQUAL(bayesopt_ask(other, 1, again, second), BAYESOPT_OK);
    CU_ASSERT_EQUAL(second[0], 3);
    CU_ASSERT_EQUAL(bayesopt_tell(other, second[0], 1, NULL), BAYESOPT_OK);
    bayesopt_free(other);
    bayesopt_free(bo);
    bo = open_store();
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 2, again, second), BAYESOPT_OK);
    CU_ASSERT_EQUAL(memcmp(ids, second, sizeof ids), 0);
    CU_ASSERT_EQUAL(memcmp(x, again, sizeof x), 0);
    /* Detached points are left for whoever tells them, until they are reclaimed. */
    CU_ASSERT_EQUAL(bayesopt_detach(bo), BAYESOPT_OK);
    bayesopt_free(bo);
    bo = open_store();
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, again, second), BAYESOPT_OK);
    CU_ASSERT_EQUAL(second[0], 4);
    CU_ASSERT_EQUAL(bayesopt_tell(bo, 1, bowl(x), NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_reclaim(bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, again, second), BAYESOPT_OK);
    CU_ASSERT_EQUAL(second[0], 2);
    CU_ASSERT_EQUAL(memcmp(x + D, again, D * sizeof *x), 0);
    bayesopt_free(bo);
    remove(path);
}

/* Four processes share a store: ids are given once, every value arrives. */
static void several_processes(void)
{
    fresh_path("share");
    bayesopt *bo = open_store();
    bayesopt_free(bo);
    pid_t children[4];
    fflush(NULL);
    for (int c = 0; c < 4; c++) {
        children[c] = fork();
        if (children[c] == 0) {
            const double lower[D] = {0, 0, 0}, upper[D] = {1, 1, 1};
            bayesopt_options options;
            bayesopt *mine;
            double x[D];
            uint64_t id;
            bayesopt_status status;
            bayesopt_options_init(&options);
            options.initial_n = 10;
            options.max_evaluations = N;
            if (bayesopt_create(D, lower, upper, &options, &mine) ||
                bayesopt_open_store(mine, path))
                _exit(1);
            while ((status = bayesopt_ask(mine, 1, x, &id)) == BAYESOPT_OK)
                if (bayesopt_tell(mine, id, bowl(x), NULL))
                    _exit(2);
            bayesopt_free(mine);
            _exit(status == BAYESOPT_STOP_BUDGET ? 0 : 3);
        }
    }
    for (int c = 0; c < 4; c++) {
        int status;
        CU_ASSERT_EQUAL(waitpid(children[c], &status, 0), children[c]);
        CU_ASSERT(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    bo = open_store();
    CU_ASSERT_EQUAL(bayesopt_count(bo), N);
    for (size_t i = 0; i < bayesopt_count(bo); i++) {
        bayesopt_point p;
        CU_ASSERT_EQUAL(bayesopt_get(bo, i, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(p.id, i + 1);
        CU_ASSERT_EQUAL(p.state, BAYESOPT_STATE_DONE);
        CHECK_CLOSE(p.f, bowl(p.x), 0);
    }
    bayesopt_free(bo);
    remove(path);
}

/* Of three processes at work at once one is killed over a point; whoever asks next gets it. */
static void one_of_several_is_killed(void)
{
    fresh_path("one");
    bayesopt *bo = open_store();
    bayesopt_free(bo);
    pid_t children[3];
    fflush(NULL);
    for (int c = 0; c < 3; c++) {
        children[c] = fork();
        if (children[c] == 0) {
            bayesopt *mine;
            double x[D];
            uint64_t id;
            bayesopt_status status = bayesopt_open(path, NULL, NULL, &mine);
            for (int i = 0; !status && (status = bayesopt_ask(mine, 1, x, &id)) == BAYESOPT_OK;
                 i++) {
                if (c == 0 && i == 1)
                    raise(SIGKILL);
                status = bayesopt_tell(mine, id, bowl(x), NULL);
            }
            _exit(status == BAYESOPT_STOP_BUDGET ? 0 : 1);
        }
    }
    for (int c = 0; c < 3; c++) {
        int status;
        CU_ASSERT_EQUAL(waitpid(children[c], &status, 0), children[c]);
        CU_ASSERT(c == 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0));
    }
    bo = open_store();
    run(bo, N); /* only if the others had finished before */
    CU_ASSERT_EQUAL(bayesopt_count(bo), N);
    for (size_t i = 0; i < N; i++) {
        bayesopt_point p;
        CU_ASSERT_EQUAL(bayesopt_get(bo, i, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(p.id, i + 1);
        CU_ASSERT_EQUAL(p.state, BAYESOPT_STATE_DONE);
        CHECK_CLOSE(p.f, bowl(p.x), 0);
    }
    bayesopt_free(bo);
    remove(path);
}

/* The model's options come back with the file; another choice is another problem. */
static void model_options_are_kept(void)
{
    static const size_t groups[D] = {0, 1, 1};
    bayesopt_options options;
    bayesopt *bo, *again, *whole;
    fresh_path("model");
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.max_evaluations = 16;
    options.scales = BAYESOPT_SCALES_TIED;
    options.group = groups;
    options.mean = BAYESOPT_MEAN_LINEAR;
    options.choice = BAYESOPT_CHOICE_LOO;
    options.acquisition = BAYESOPT_ACQUISITION_LCB;
    bo = make(&options);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_store(bo, path), BAYESOPT_OK);
    run(bo, 12);
    bayesopt_free(bo);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &again), BAYESOPT_OK);
    run(again, N);
    whole = make(&options);
    run(whole, N);
    same_history(whole, again);
    bayesopt_free(whole);
    bayesopt_free(again);
    options.lcb_factor = 3;
    bo = make(&options);
    CU_ASSERT_EQUAL(bayesopt_open_store(bo, path), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "model"));
    bayesopt_free(bo);
    remove(path);
}

static const struct check_case cases[] = {
    {"resuming continues the sequence", resuming_continues_the_sequence},
    {"killed processes lose nothing", killed_processes_lose_nothing},
    {"pending points come back", pending_points_come_back},
    {"several processes", several_processes},
    {"one of several is killed", one_of_several_is_killed},
    {"model options are kept", model_options_are_kept},
};

CHECK_MAIN("bayesopt store", cases)
