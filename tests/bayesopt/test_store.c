/* The store: what was promised is on disk, whatever happens to the process. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <signal.h>
#include <sqlite3.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { D = 3, N = 30 };

static double bowl(const double *x)
{
    double sum = 0;
    for (size_t j = 0; j < D; j++)
        sum += (x[j] - 0.3) * (x[j] - 0.3) * (1 + (double)j);
    return sum;
}

static char path[256];

static void fresh_path(const char *name)
{
    snprintf(path, sizeof path, "%s/bayesopt_%s_%ld.db", check_scratch(), name, (long)getpid());
    remove(path);
}

static bayesopt *make(const bayesopt_options *given)
{
    const double lower[D] = {0, 0, 0}, upper[D] = {1, 1, 1};
    bayesopt_options options;
    bayesopt *bo = NULL;
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.max_evaluations = N;
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(D, lower, upper, given ? given : &options, &bo),
                          BAYESOPT_OK);
    return bo;
}

static bayesopt *open_store(void)
{
    bayesopt *bo = make(NULL);
    bayesopt_status status = bayesopt_open_store(bo, path);
    if (status)
        fprintf(stderr, "%s\n", bayesopt_last_error());
    CU_ASSERT_EQUAL_FATAL(status, BAYESOPT_OK);
    return bo;
}

static void run(bayesopt *bo, size_t most)
{
    double x[D];
    uint64_t id;
    while (most-- > 0 && bayesopt_ask(bo, 1, x, &id) == BAYESOPT_OK)
        CU_ASSERT_EQUAL(bayesopt_tell(bo, id, bowl(x), NULL), BAYESOPT_OK);
}

static void same_history(const bayesopt *a, const bayesopt *b)
{
    bayesopt_point p, q;
    CU_ASSERT_EQUAL_FATAL(bayesopt_count(a), bayesopt_count(b));
    for (size_t i = 0; i < bayesopt_count(a); i++) {
        CU_ASSERT_EQUAL(bayesopt_get(a, i, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(bayesopt_get(b, i, &q), BAYESOPT_OK);
        CU_ASSERT_EQUAL(p.id, q.id);
        CU_ASSERT_EQUAL(p.state, q.state);
        CU_ASSERT_EQUAL(p.phase, q.phase);
        CU_ASSERT_EQUAL(memcmp(p.x, q.x, D * sizeof *p.x), 0);
        CU_ASSERT_EQUAL(memcmp(&p.f, &q.f, sizeof p.f), 0);
    }
}

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

/* A store of version 0.1.0 has no entries for the model's later options. */
static void older_stores_go_on(void)
{
    sqlite3 *db;
    fresh_path("older");
    bayesopt *bo = open_store();
    run(bo, 12);
    bayesopt_free(bo);
    CU_ASSERT_EQUAL(sqlite3_open(path, &db), SQLITE_OK);
    CU_ASSERT_EQUAL(sqlite3_exec(db, "DELETE FROM bayesopt_meta WHERE key IN ('model', 'group')",
                                 NULL, NULL, NULL),
                    SQLITE_OK);
    sqlite3_close(db);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_OK);
    run(bo, N);
    CU_ASSERT_EQUAL(bayesopt_count(bo), N);
    bayesopt_free(bo);
    remove(path);
}

static void write_bytes(const char *text, size_t n)
{
    FILE *file = fopen(path, "wb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    CU_ASSERT_EQUAL(fwrite(text, 1, n, file), n);
    fclose(file);
}

static void expect_refusal(bayesopt_status expected, const char *word)
{
    bayesopt *bo = make(NULL);
    bayesopt_status status = bayesopt_open_store(bo, path);
    CU_ASSERT_EQUAL(status, expected);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), word));
    if (status != expected || !strstr(bayesopt_last_error(), word))
        fprintf(stderr, "status %d: %s\n", (int)status, bayesopt_last_error());
    bayesopt_free(bo);
}

static void damaged_and_foreign_files(void)
{
    static char bytes[1 << 20];
    sqlite3 *db;
    fresh_path("damaged");
    memset(bytes, 'x', 4096);
    write_bytes(bytes, 4096);
    expect_refusal(BAYESOPT_ERROR_FORMAT, "not a database");
    remove(path);

    CU_ASSERT_EQUAL(sqlite3_open(path, &db), SQLITE_OK);
    CU_ASSERT_EQUAL(sqlite3_exec(db, "CREATE TABLE other(a)", NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
    expect_refusal(BAYESOPT_ERROR_FORMAT, "not a store");
    remove(path);

    bayesopt *bo = open_store();
    run(bo, 12);
    bayesopt_free(bo);
    FILE *file = fopen(path, "rb");
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    /* Cut, or overwritten in the middle. */
    write_bytes(bytes, size / 2);
    expect_refusal(BAYESOPT_ERROR_FORMAT, path);
    for (size_t at = 4096; at + 64 < size; at += 4096) {
        char kept[64];
        memcpy(kept, bytes + at, sizeof kept);
        memset(bytes + at, 0x5a, sizeof kept);
        write_bytes(bytes, size);
        memcpy(bytes + at, kept, sizeof kept);
        expect_refusal(BAYESOPT_ERROR_FORMAT, path);
    }
    write_bytes(bytes, size);
    bo = open_store();
    CU_ASSERT_EQUAL(bayesopt_count(bo), 12);
    bayesopt_free(bo);
    remove(path);
}

/* Rows whose content makes no sense are found even if the database is sound. */
static void damaged_rows(void)
{
    static const char *const edits[] = {
        "UPDATE bayesopt_points SET x = zeroblob(7) WHERE id = 3",
        "UPDATE bayesopt_points SET f = NULL WHERE id = 3",
        "UPDATE bayesopt_points SET state = 9 WHERE id = 3",
        "DELETE FROM bayesopt_meta WHERE key = 'format'",
        "UPDATE bayesopt_meta SET value = zeroblob(8) WHERE key = 'models'",
    };
    for (size_t i = 0; i < sizeof edits / sizeof *edits; i++) {
        sqlite3 *db;
        fresh_path("rows");
        bayesopt *bo = open_store();
        run(bo, 12);
        bayesopt_free(bo);
        CU_ASSERT_EQUAL(sqlite3_open(path, &db), SQLITE_OK);
        CU_ASSERT_EQUAL(sqlite3_exec(db, edits[i], NULL, NULL, NULL), SQLITE_OK);
        sqlite3_close(db);
        expect_refusal(BAYESOPT_ERROR_FORMAT, path);
        remove(path);
    }
}

static void another_problem(void)
{
    bayesopt_options options;
    bayesopt *bo;
    fresh_path("other");
    bo = open_store();
    run(bo, 2);
    bayesopt_free(bo);
    bayesopt_options_init(&options);
    options.initial_n = 10;
    options.seed = 99;
    bo = make(&options);
    CU_ASSERT_EQUAL(bayesopt_open_store(bo, path), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "seed"));
    bayesopt_free(bo);
    const double lower[2] = {0, 0}, upper[2] = {1, 1};
    CU_ASSERT_EQUAL_FATAL(bayesopt_create(2, lower, upper, NULL, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_open_store(bo, path), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "lower"));
    bayesopt_free(bo);
    remove(path);
}

/* The caller's own tables live in the same file. */
static void tables_of_the_caller(void)
{
    sqlite3 *db;
    fresh_path("tables");
    bayesopt *bo = open_store();
    CU_ASSERT_EQUAL(sqlite3_open(path, &db), SQLITE_OK);
    sqlite3_busy_timeout(db, 10000);
    CU_ASSERT_EQUAL(
        sqlite3_exec(db, "CREATE TABLE hull(id INTEGER PRIMARY KEY, cw REAL)", NULL, NULL, NULL),
        SQLITE_OK);
    run(bo, 3);
    CU_ASSERT_EQUAL(sqlite3_exec(db, "INSERT INTO hull VALUES(1, 0.5)", NULL, NULL, NULL),
                    SQLITE_OK);
    run(bo, 3);
    sqlite3_close(db);
    bayesopt_free(bo);
    bo = open_store();
    CU_ASSERT_EQUAL(bayesopt_count(bo), 6);
    bayesopt_free(bo);
    remove(path);
}

static void opened_from_the_file_alone(void)
{
    fresh_path("alone");
    bayesopt *bo = open_store(), *again = NULL;
    run(bo, 14);
    bayesopt_free(bo);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &again), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_count(again), 14);
    CU_ASSERT_EQUAL(bayesopt_budget(again), N);
    run(again, N);
    bayesopt *whole = make(NULL);
    run(whole, N);
    same_history(whole, again);
    bayesopt_free(whole);
    bayesopt_free(again);
    remove(path);
    CU_ASSERT_EQUAL(bayesopt_open(path, NULL, NULL, &again), BAYESOPT_ERROR_FILE);
}

static const struct check_case cases[] = {
    {"resuming continues the sequence", resuming_continues_the_sequence},
    {"killed processes lose nothing", killed_processes_lose_nothing},
    {"pending points come back", pending_points_come_back},
    {"several processes", several_processes},
    {"one of several is killed", one_of_several_is_killed},
    {"model options are kept", model_options_are_kept},
    {"older stores go on", older_stores_go_on},
    {"damaged and foreign files", damaged_and_foreign_files},
    {"damaged rows", damaged_rows},
    {"another problem", another_problem},
    {"tables of the caller", tables_of_the_caller},
    {"opened from the file alone", opened_from_the_file_alone},
};

CHECK_MAIN("bayesopt store", cases)
