/* What a store keeps beside the history: texts, arrays, tables, attributes. */
#include "store_study.h"

#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <time.h>

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

static const struct check_case cases[] = {
    {"records round trip", records_round_trip},
    {"records need a store and names", records_need_a_store_and_names},
    {"attributes of evaluations", attributes_of_evaluations},
    {"attributes share the fate of their value", attributes_share_the_fate_of_their_value},
};

CHECK_MAIN("bayesopt store records", cases)
