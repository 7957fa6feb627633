/* kill -9 at any moment: a run that is killed again and again ends with the same evaluations, bit
 * for bit, as one that never was, and every session finds all that the one before had recorded. */
#include "check.h"
#include "runner.h"

#include <signal.h>
#include <sqlite3.h>
#include <stdbool.h>
#include <time.h>

static struct runner runner;
static char config[200];

enum { ROWS = 64, MODES = 8, KILLS_MOST = 24 };

struct record {
    size_t n;
    sqlite3_int64 id[ROWS];
    double u[ROWS][MODES], cw[ROWS];
    int failed[ROWS];
};

/* The evaluations of a run; none when it has no database yet. */
static void read_record(const char *name, struct record *r)
{
    char path[300];
    sqlite3 *db;
    sqlite3_stmt *s;
    snprintf(path, sizeof path, "%s/%s/run.db", runner.folder, name);
    memset(r, 0, sizeof *r);
    if (access(path, F_OK) != 0)
        return;
    CU_ASSERT_EQUAL_FATAL(sqlite3_open_v2(path, &db, SQLITE_OPEN_READWRITE, NULL), SQLITE_OK);
    sqlite3_busy_timeout(db, 30000);
    CU_ASSERT_EQUAL_FATAL(
        sqlite3_prepare_v2(db,
                           "SELECT id, x, f, state = 2 FROM bayesopt_points WHERE state != 0 "
                           "ORDER BY id",
                           -1, &s, NULL),
        SQLITE_OK);
    while (r->n < ROWS && sqlite3_step(s) == SQLITE_ROW) {
        size_t bytes = (size_t)sqlite3_column_bytes(s, 1);
        CU_ASSERT_TRUE_FATAL(bytes <= sizeof r->u[0]);
        r->id[r->n] = sqlite3_column_int64(s, 0);
        memcpy(r->u[r->n], sqlite3_column_blob(s, 1), bytes);
        r->cw[r->n] = sqlite3_column_double(s, 2);
        r->failed[r->n] = sqlite3_column_int(s, 3);
        r->n++;
    }
    sqlite3_finalize(s);
    sqlite3_close(db);
}

/* Number of points that the search has and that are not open any more. */
static int told(const char *name)
{
    char path[300];
    sqlite3 *db;
    sqlite3_stmt *s;
    int n = -1;
    snprintf(path, sizeof path, "%s/%s/run.db", runner.folder, name);
    CU_ASSERT_EQUAL_FATAL(sqlite3_open_v2(path, &db, SQLITE_OPEN_READONLY, NULL), SQLITE_OK);
    if (sqlite3_prepare_v2(db, "SELECT value FROM bayesopt_texts WHERE name = 'stop'", -1, &s,
                           NULL) == SQLITE_OK &&
        sqlite3_step(s) == SQLITE_ROW)
        n = 1;
    sqlite3_finalize(s);
    sqlite3_close(db);
    return n;
}

static int same_prefix(const struct record *a, const struct record *b)
{
    if (a->n > b->n)
        return 0;
    for (size_t i = 0; i < a->n; i++)
        if (a->id[i] != b->id[i] || memcmp(a->u[i], b->u[i], sizeof a->u[i]) != 0 ||
            a->cw[i] != b->cw[i] || a->failed[i] != b->failed[i])
            return 0;
    return 1;
}

static void pause_for(double seconds)
{
    struct timespec time = {(time_t)seconds, (long)(1e9 * fmod(seconds, 1))};
    nanosleep(&time, NULL);
}

/* Waits until the run has a record more. */
static void wait_for_record(const char *name, pid_t child)
{
    static struct record first, now;
    read_record(name, &first);
    for (int k = 0; k < 20000; k++) {
        read_record(name, &now);
        siginfo_t info = {0};
        bool over = waitid(P_PID, (id_t)child, &info, WEXITED | WNOHANG | WNOWAIT) == 0 &&
                    info.si_pid == child;
        if (now.n > first.n || over)
            return;
        pause_for(0.0005);
    }
}

static void test_killed(void)
{
    char whole[200], broken[200];
    static struct record reference, before, after;
    runner_path(&runner, "whole", whole, sizeof whole);
    runner_path(&runner, "broken", broken, sizeof broken);
    const char *const once[] = {"run", config, "--out", whole, "--threads", "1", NULL};
    int code = runner_run(&runner, once);
    if (code != 0)
        fputs(runner.err, stderr);
    CU_ASSERT_EQUAL_FATAL(code, 0);
    read_record("whole", &reference);
    CU_ASSERT_EQUAL_FATAL(reference.n, 27); /* the parent, 16 and 10 */

    const char *const again[] = {"run",      config,      "--out", broken,
                                 "--resume", "--threads", "1",     NULL};
    unsigned seed = 20240229;
    int kills = 0, useful = 0, ended = 0;
    double patience = 0.3;
    while (!ended) {
        seed = seed * 1664525u + 1013904223u;
        pid_t child = runner_start(&runner, again);
        if (kills == KILLS_MOST)
            ; /* the last session runs to its end */
        else if (seed >> 31)
            wait_for_record("broken", child);
        else
            pause_for(patience * (seed >> 8) / 16777216.0);
        if (kills < KILLS_MOST)
            kill(child, SIGKILL);
        code = runner_wait(&runner, child);
        if (code > 0)
            fputs(runner.err, stderr);
        CU_ASSERT_TRUE_FATAL(code <= 0 && (code == 0 || kills < KILLS_MOST));
        ended = code == 0;
        kills += !ended;
        read_record("broken", &after);
        CU_ASSERT_TRUE_FATAL(same_prefix(&before, &after));
        useful += after.n > before.n;
        /* On a slow machine a session needs longer to get anywhere at all. */
        if (after.n == before.n && patience < 8)
            patience *= 1.3;
        before = after;
    }
    CU_ASSERT_TRUE(ended);
    CU_ASSERT_TRUE(kills >= 3);
    CU_ASSERT_EQUAL(after.n, reference.n);
    CU_ASSERT_TRUE(same_prefix(&reference, &after));
    CU_ASSERT_EQUAL(told("broken"), 1);
    for (size_t i = 0; i < after.n; i++)
        for (size_t j = 0; j < i; j++)
            CU_ASSERT_NOT_EQUAL(memcmp(after.u[i], after.u[j], sizeof after.u[i]), 0);
    printf("%d kills, progress in %d sessions ", kills, useful);
}

/* What the status of a run says, beside its record. */
static void check_status(const char *name, const char *state, size_t n)
{
    char folder[200], words[80];
    runner_path(&runner, name, folder, sizeof folder);
    const char *const status[] = {"status", folder, "--json", NULL};
    CU_ASSERT_EQUAL(runner_run(&runner, status), 0);
    snprintf(words, sizeof words, "\"state\": \"%s\"", state);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, words));
    snprintf(words, sizeof words, "\"evaluated\": %zu,\n  \"budget\": 27", n);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.out, words));
}

/* Two sessions cannot work on one folder. */
static void test_two_sessions(void)
{
    char folder[200];
    runner_path(&runner, "twice", folder, sizeof folder);
    const char *const run[] = {"run", config, "--out", folder, "--resume", "--threads", "1", NULL};
    pid_t first = runner_start(&runner, run);
    struct record record = {0};
    for (int k = 0; k < 3000 && record.n == 0; k++) {
        pause_for(0.005);
        read_record("twice", &record);
    }
    kill(first, SIGSTOP);
    read_record("twice", &record);
    check_status("twice", "searching", record.n);
    int code = runner_run(&runner, run);
    CU_ASSERT_EQUAL(code, 1);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.err, "another hullopt is at work"));
    kill(first, SIGKILL);
    runner_wait(&runner, first);
    CU_ASSERT_EQUAL(runner_run(&runner, run), 0);
}

/* Asked to stop, a run ends the design at hand, says how to go on, and does. */
static void test_stopped(void)
{
    static const int signals[] = {SIGINT, SIGTERM};
    char folder[200];
    static struct record before, after;
    runner_path(&runner, "stopped", folder, sizeof folder);
    const char *const run[] = {"run", config, "--out", folder, "--resume", "--threads", "1", NULL};
    for (int k = 0; k < 2; k++) {
        pid_t child = runner_start(&runner, run);
        wait_for_record("stopped", child);
        kill(child, signals[k]);
        CU_ASSERT_EQUAL(runner_wait(&runner, child), 1);
        CU_ASSERT_PTR_NOT_NULL(strstr(runner.err, "stopped\n"));
        CU_ASSERT_PTR_NOT_NULL(strstr(runner.err, "--resume goes on"));
        CU_ASSERT_PTR_NOT_NULL(strstr(runner.err, "search: "));
        read_record("stopped", &before);
        CU_ASSERT_TRUE(before.n > 0 && before.n < 27);
        check_status("stopped", "interrupted", before.n);
    }
    CU_ASSERT_EQUAL(runner_run(&runner, run), 0);
    CU_ASSERT_PTR_NOT_NULL(strstr(runner.err, "search: 100 %"));
    read_record("stopped", &after);
    CU_ASSERT_EQUAL(after.n, 27);
    CU_ASSERT_TRUE(same_prefix(&before, &after));
    check_status("stopped", "search ended", 27);
}

static const struct check_case cases[] = {
    {"killed at random moments", test_killed},
    {"asked to stop", test_stopped},
    {"two sessions on one folder", test_two_sessions},
};

int main(void)
{
    if (!runner_open(&runner))
        return EXIT_FAILURE;
    runner_path(&runner, "run.yaml", config, sizeof config);
    runner_configuration(&runner, "run.yaml", EXAMPLES_DIR "/hulls/wigley.json", 16, 10, "");
    int code = check_main("hullopt resume", cases, sizeof cases / sizeof *cases);
    return runner_close(&runner) == 0 ? code : EXIT_FAILURE;
}
