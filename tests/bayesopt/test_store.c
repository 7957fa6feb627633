/* The store: what was promised is on disk, whatever happens to the process. */
#include "check.h"

#include <bayesopt/bayesopt.h>

#include <signal.h>
#include <sqlite3.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
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

static void expect_text(const bayesopt *bo, const char *name, const char *expected)
{
    char *text;
    CU_ASSERT_EQUAL(bayesopt_store_get_text(bo, name, &text), BAYESOPT_OK);
    CU_ASSERT_PTR_NOT_NULL_FATAL(text);
    CU_ASSERT_STRING_EQUAL(text, expected);
    free(text);
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

/* Texts, arrays and tables come back from the file as they went in, bit for bit. */
static void records_round_trip(void)
{
    const double odd[6] = {-0.0, NAN, INFINITY, 0x1p-1074, 1.0 / 3, -1e308};
    const bayesopt_attribute first[] = {{.name = "cw", .number = 1.0 / 3},
                                        {.name = "label", .text = "Fr 0.28"},
                                        {.name = "missing", .number = NAN}},
                             other[] = {{.name = "cw", .number = -0.5}};
    const bayesopt_attribute *row;
    bayesopt_table *table;
    char *text;
    double *values;
    size_t rows, columns;
    fresh_path("records");
    bayesopt *bo = open_store();
    CU_ASSERT_EQUAL(bayesopt_store_put_text(bo, "note", "first"), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_store_put_text(bo, "note", "M\xc3\xbcller's \"hull\"\n"), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_store_put_array(bo, "odd", 2, 3, odd), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_store_put_array(bo, "empty", 0, 4, NULL), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_store_put_row(bo, "speeds", 7, 1, first), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_store_put_row(bo, "speeds", 7, 3, first), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_store_put_row(bo, "speeds", 2, 1, other), BAYESOPT_OK);
    bayesopt_free(bo);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &bo), BAYESOPT_OK);
    expect_text(bo, "note", "M\xc3\xbcller's \"hull\"\n");
    CU_ASSERT_EQUAL(bayesopt_store_get_text(bo, "none", &text), BAYESOPT_OK);
    CU_ASSERT_PTR_NULL(text);
    CU_ASSERT_EQUAL(bayesopt_store_get_array(bo, "odd", &rows, &columns, &values), BAYESOPT_OK);
    CU_ASSERT_EQUAL(rows, 2);
    CU_ASSERT_EQUAL_FATAL(columns, 3);
    CU_ASSERT_EQUAL(memcmp(values, odd, sizeof odd), 0);
    free(values);
    CU_ASSERT_EQUAL(bayesopt_store_get_array(bo, "empty", &rows, &columns, &values), BAYESOPT_OK);
    CU_ASSERT(rows == 0 && columns == 4 && values != NULL);
    free(values);
    CU_ASSERT_EQUAL(bayesopt_store_get_array(bo, "none", &rows, &columns, &values), BAYESOPT_OK);
    CU_ASSERT_PTR_NULL(values);
    CU_ASSERT_EQUAL_FATAL(bayesopt_store_get_table(bo, "speeds", &table), BAYESOPT_OK);
    CU_ASSERT_EQUAL_FATAL(bayesopt_table_rows(table), 2);
    size_t n = bayesopt_table_row(table, 0, &row);
    CU_ASSERT_EQUAL(n, 1);
    CHECK_CLOSE(bayesopt_attribute_number(n, row, "cw"), -0.5, 0);
    n = bayesopt_table_row(table, 1, &row);
    CU_ASSERT_EQUAL(n, 3);
    CHECK_CLOSE(bayesopt_attribute_number(n, row, "cw"), 1.0 / 3, 0);
    CU_ASSERT_STRING_EQUAL(bayesopt_attribute_text(n, row, "label"), "Fr 0.28");
    CU_ASSERT(isnan(bayesopt_attribute_number(n, row, "missing")));
    CU_ASSERT(isnan(bayesopt_attribute_number(n, row, "label")));
    CU_ASSERT_STRING_EQUAL(bayesopt_attribute_text(n, row, "cw"), "");
    CU_ASSERT_EQUAL(bayesopt_table_row(table, 2, &row), 0);
    bayesopt_table_free(table);
    CU_ASSERT_EQUAL(bayesopt_store_get_table(bo, "none", &table), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_table_rows(table), 0);
    bayesopt_table_free(table);
    bayesopt_free(bo);
    remove(path);
}

static void records_need_a_store_and_names(void)
{
    const bayesopt_attribute twice[] = {{.name = "a", .number = 1}, {.name = "a", .number = 2}};
    const bayesopt_attribute nameless = {.number = 1};
    double number = 1;
    fresh_path("names");
    bayesopt *bo = make(NULL);
    CU_ASSERT_EQUAL(bayesopt_store_put_text(bo, "a", "b"), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_store(bo, path), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_store_put_text(bo, "", "b"), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_store_put_text(bo, "a", NULL), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_store_put_array(bo, "a", (size_t)1 << 61, 8, &number),
                    BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_store_put_row(bo, "a", 0, 2, twice), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_PTR_NOT_NULL(strstr(bayesopt_last_error(), "'a'"));
    CU_ASSERT_EQUAL(bayesopt_store_put_row(bo, "a", 0, 1, &nameless), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_store_put_row(bo, "a", 0, 1, NULL), BAYESOPT_ERROR_ARGUMENT);
    const double x[D] = {0.5, 0.5, 0.5};
    bayesopt_result result = {.f = 1, .n_attributes = 2, .attributes = twice};
    CU_ASSERT_EQUAL(bayesopt_tell_point_result(bo, x, &result, NULL), BAYESOPT_ERROR_ARGUMENT);
    CU_ASSERT_EQUAL(bayesopt_count(bo), 0);
    bayesopt_free(bo);
    remove(path);
}

/* What is known beside the value comes with it, of failures too, in this process and the next. */
static void attributes_of_evaluations(void)
{
    double x[2 * D];
    uint64_t ids[2], parent;
    fresh_path("attributes");
    bayesopt *bo = open_store(), *reader;
    const bayesopt_attribute told[] = {{.name = "volume", .number = 0.76},
                                       {.name = "mesh", .text = "36 x 13"}};
    bayesopt_result result = {.f = 0.5, .n_attributes = 2, .attributes = told};
    const double at[D] = {0.1, 0.2, 0.3};
    CU_ASSERT_EQUAL(bayesopt_tell_point_result(bo, at, &result, &parent), BAYESOPT_OK);
    CU_ASSERT_EQUAL(parent, 1);
    CU_ASSERT_EQUAL_FATAL(bayesopt_open_read(path, &reader), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_ask(bo, 2, x, ids), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_tell(bo, ids[0], 0.25, NULL), BAYESOPT_OK);
    result = (bayesopt_result){.f = NAN, .note = "folded", .n_attributes = 1, .attributes = told};
    CU_ASSERT_EQUAL(bayesopt_tell_result(bo, ids[1], &result), BAYESOPT_OK);
    CU_ASSERT_EQUAL(bayesopt_refresh(reader), BAYESOPT_OK);
    const bayesopt *both[] = {bo, reader};
    for (size_t k = 0; k < 2; k++) {
        bayesopt_point p;
        CU_ASSERT_EQUAL_FATAL(bayesopt_count(both[k]), 3);
        CU_ASSERT_EQUAL(bayesopt_get(both[k], 0, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(p.n_attributes, 2);
        CHECK_CLOSE(bayesopt_attribute_number(p.n_attributes, p.attributes, "volume"), 0.76, 0);
        CU_ASSERT_STRING_EQUAL(bayesopt_attribute_text(p.n_attributes, p.attributes, "mesh"),
                               "36 x 13");
        CU_ASSERT_EQUAL(bayesopt_get(both[k], 1, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(p.n_attributes, 0);
        CU_ASSERT_EQUAL(bayesopt_get(both[k], 2, &p), BAYESOPT_OK);
        CU_ASSERT_EQUAL(p.state, BAYESOPT_STATE_FAILED);
        CU_ASSERT_EQUAL(p.n_attributes, 1);
    }
    bayesopt_free(reader);
    bayesopt_free(bo);
    remove(path);
}

/* Killed at any moment, no value is on disk without its attributes, and none is lost that was
 * told. */
static void attributes_share_the_fate_of_their_value(void)
{
    fresh_path("fate");
    bayesopt *bo = open_store();
    bayesopt_free(bo);
    for (int round = 0; round < 12; round++) {
        int ends[2];
        char byte;
        CU_ASSERT_EQUAL_FATAL(pipe(ends), 0);
        fflush(NULL);
        pid_t child = fork();
        if (child == 0) {
            double x[D];
            uint64_t id;
            bayesopt *mine;
            if (bayesopt_open(path, NULL, NULL, &mine))
                _exit(1);
            while (bayesopt_ask(mine, 1, x, &id) == BAYESOPT_OK) {
                bayesopt_attribute copy = {.name = "copy", .number = bowl(x)};
                bayesopt_result r = {.f = bowl(x), .n_attributes = 1, .attributes = &copy};
                if (write(ends[1], "t", 1) != 1 || bayesopt_tell_result(mine, id, &r))
                    _exit(2);
            }
            _exit(0);
        }
        close(ends[1]);
        /* A tell has begun; the kill comes somewhere within it or after. */
        if (read(ends[0], &byte, 1) == 1)
            nanosleep(&(struct timespec){.tv_nsec = 400000L * round}, NULL);
        kill(child, SIGKILL);
        CU_ASSERT_EQUAL(waitpid(child, NULL, 0), child);
        close(ends[0]);
        CU_ASSERT_EQUAL_FATAL(bayesopt_open(path, NULL, NULL, &bo), BAYESOPT_OK);
        for (size_t i = 0; i < bayesopt_count(bo); i++) {
            bayesopt_point p;
            CU_ASSERT_EQUAL(bayesopt_get(bo, i, &p), BAYESOPT_OK);
            if (p.state == BAYESOPT_STATE_DONE)
                CHECK_CLOSE(bayesopt_attribute_number(p.n_attributes, p.attributes, "copy"), p.f,
                            0);
        }
        bayesopt_free(bo);
    }
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
    {"newer stores are refused", newer_stores_are_refused},
    {"records round trip", records_round_trip},
    {"records need a store and names", records_need_a_store_and_names},
    {"attributes of evaluations", attributes_of_evaluations},
    {"attributes share the fate of their value", attributes_share_the_fate_of_their_value},
    {"reading changes nothing", reading_changes_nothing},
    {"damaged and foreign files", damaged_and_foreign_files},
    {"damaged rows", damaged_rows},
    {"another problem", another_problem},
    {"tables of the caller", tables_of_the_caller},
    {"opened from the file alone", opened_from_the_file_alone},
};

CHECK_MAIN("bayesopt store", cases)
