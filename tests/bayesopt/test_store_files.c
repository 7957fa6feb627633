/* Files of stores: older and newer ones, damaged and foreign ones, looked at and shared. */
#include "store_study.h"

#include <signal.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static void execute(const char *sql)
{
    sqlite3 *db;
    CU_ASSERT_EQUAL_FATAL(sqlite3_open(path, &db), SQLITE_OK);
    CU_ASSERT_EQUAL(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
    sqlite3_close(db);
}

static size_t file_bytes(char *bytes, size_t room)
{
    FILE *file = fopen(path, "rb");
    CU_ASSERT_PTR_NOT_NULL_FATAL(file);
    size_t n = fread(bytes, 1, room, file);
    fclose(file);
    return n;
}

/* A store of format 2 has no signs of life and no kinds of variables; one of version 0.1.0 has no
 * entries for the model's later options either and none of the later tables. The caller's own
 * tables are left alone. */
static const char to_format_2[] =
    "DELETE FROM bayesopt_meta WHERE key IN ('kinds', 'first_x');"
    "ALTER TABLE bayesopt_points DROP COLUMN heard;"
    "INSERT INTO bayesopt_texts VALUES('variable.1', 'angle');"
    "UPDATE bayesopt_meta SET value = x'0000000000000040' WHERE key = 'format';"; /* 2 */
static const char to_format_1[] =
    "DELETE FROM bayesopt_meta WHERE key IN ('model', 'group', 'kinds', 'first_x');"
    "ALTER TABLE bayesopt_points DROP COLUMN heard;"
    "DROP TABLE bayesopt_texts; DROP TABLE bayesopt_arrays; DROP TABLE bayesopt_attributes;"
    "UPDATE bayesopt_meta SET value = x'000000000000f03f' WHERE key = 'format';" /* 1 */
    "CREATE TABLE names(kind TEXT, i INTEGER, name TEXT NOT NULL, PRIMARY KEY(kind, i));"
    "INSERT INTO names VALUES('variable', 0, 'angle');";

static void older_store_goes_on(const char *made_older)
{
    static char before[1 << 20], after[1 << 20];
    fresh_path("older");
    bayesopt *bo = open_store();
    run(bo, 12);
    bayesopt_free(bo);
    execute(made_older);
    /* To look at it nothing is changed in the file. */
    size_t n = file_bytes(before, sizeof before);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &bo), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 12);
    expect_text(bo, "variable.1", "angle");
    bayesopt_free(bo);
    CU_ASSERT_EQUAL(file_bytes(after, sizeof after), n);
    CU_ASSERT_EQUAL(memcmp(before, after, n), 0);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_OK);
    run(bo, N);
    CU_ASSERT_EQUAL(bayesopt_count(bo), N);
    expect_text(bo, "variable.1", "angle");
    CU_ASSERT_EQUAL(bayesopt_store_put_text(bo, "solver", "panels"), BAYESOPT_OK);
    bayesopt_free(bo);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &bo), BAYESOPT_OK);
    expect_text(bo, "solver", "panels");
    bayesopt_free(bo);
    remove(path);
}

static void older_stores_go_on(void)
{
    older_store_goes_on(to_format_1);
    older_store_goes_on(to_format_2);
}

static void newer_stores_are_refused(void)
{
    bayesopt *bo = NULL;
    fresh_path("newer");
    bo = open_store();
    run(bo, 3);
    bayesopt_free(bo);
    bo = NULL;
    execute("UPDATE bayesopt_meta SET value = x'0000000000001040' WHERE key = 'format'"); /* 4 */
    CU_ASSERT_EQUAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_ERROR_FORMAT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "newer"));
    CU_ASSERT_EQUAL(bayesopt_open_read(path, &bo), BAYESOPT_ERROR_FORMAT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), path));
    CU_ASSERT_PTR_NULL(bo);
    remove(path);
}

/* Looking leaves every byte as it was and adds no file, and everything that would write says so. */
static void reading_changes_nothing(void)
{
    static char before[1 << 20], after[1 << 20];
    double x[D], f, mean;
    uint64_t id;
    bayesopt_model_info info;
    fresh_path("reading");
    bayesopt *bo = open_store(), *whole = make(NULL);
    run(bo, 14);
    run(whole, 14);
    bayesopt_free(bo);
    size_t n = file_bytes(before, sizeof before);
    CU_ASSERT_EQUAL(chmod(path, 0444), 0);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &bo), BAYESOPT_OK);
    same_history(whole, bo);
    CU_ASSERT_EQUAL(bayesopt_best(bo, x, &f, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_model(bo, &info, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_predict(bo, 1, x, &mean, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 1, x, &id), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "reading only"));
    CU_ASSERT_EQUAL(bayesopt_tell_point(bo, x, 1, NULL), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_set_budget(bo, 99), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_reclaim(bo), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_store_put_text(bo, "a", "b"), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 14);
    bayesopt_free(bo);
    bayesopt_free(whole);
    CU_ASSERT_EQUAL(file_bytes(after, sizeof after), n);
    CU_ASSERT_EQUAL(memcmp(before, after, n), 0);
    char beside[300];
    snprintf(beside, sizeof beside, "%s-journal", path);
    CU_ASSERT_NOT_EQUAL(access(beside, F_OK), 0);
    remove(path);
    CU_ASSERT_EQUAL(bayesopt_open_read(path, &bo), BAYESOPT_ERROR_FILE);
}

/* A process dies while SQLite writes its pages: what it wrote is undone when the store is looked at
 * next, for which the file must be writable. */
static void unfinished_writes_are_undone(void)
{
    fresh_path("unfinished");
    bayesopt *bo = open_store(), *whole = make(NULL);
    run(bo, 9);
    run(whole, 9);
    bayesopt_free(bo);
    pid_t child = fork();
    if (child == 0) {
        sqlite3 *db;
        sqlite3_open(path, &db);
        /* A cache of one page, so that the file is written before the end. */
        sqlite3_exec(db,
                     "PRAGMA cache_size = 1; PRAGMA cache_spill = 1; BEGIN;"
                     "UPDATE bayesopt_points SET f = 7; UPDATE bayesopt_meta SET value = value;"
                     "CREATE TABLE filler AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT "
                     "i + 1 FROM n WHERE i < 3000) SELECT i, randomblob(200) AS b FROM n;",
                     NULL, NULL, NULL);
        kill(getpid(), SIGKILL);
    }
    CU_ASSERT_EQUAL(waitpid(child, NULL, 0), child);
    char beside[300];
    snprintf(beside, sizeof beside, "%s-journal", path);
    CU_ASSERT_EQUAL_FATAL(access(beside, F_OK), 0);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &bo), BAYESOPT_OK);
    same_history(whole, bo);
    bayesopt_free(bo);
    bayesopt_free(whole);
    CU_ASSERT_NOT_EQUAL(access(beside, F_OK), 0);
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
    {"older stores go on", older_stores_go_on},
    {"newer stores are refused", newer_stores_are_refused},
    {"reading changes nothing", reading_changes_nothing},
    {"unfinished writes are undone", unfinished_writes_are_undone},
    {"damaged and foreign files", damaged_and_foreign_files},
    {"damaged rows", damaged_rows},
    {"another problem", another_problem},
    {"tables of the caller", tables_of_the_caller},
    {"opened from the file alone", opened_from_the_file_alone},
};

CHECK_MAIN("bayesopt store files", cases)
