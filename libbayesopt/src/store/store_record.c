/* What a store keeps beside the history: texts, arrays, rows of attributes. */
#include "core/error.h"
#include "store/store_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The rows of this table are the attributes of the points; the caller's tables have names. */
static const char points[] = "";

/* What one entry of an SQLite database holds. */
static const size_t MOST_NUMBERS = 1000000000 / sizeof(double);

struct bayesopt_table {
    size_t n;
    struct attributes *rows;
};

static bayesopt_status no_memory(void)
{
    return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
}

static bayesopt_status check_name(const bayesopt *bo, const char *name)
{
    if (!bo || !name || !*name)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "an entry of a store needs a name");
    if (!bo->store)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "'%s': no store is open", name);
    return BAYESOPT_OK;
}

/* Runs a statement that gives no rows, whose binding may have failed, and releases it. */
static bayesopt_status finish(struct store *store, sqlite3_stmt *s, bool bound)
{
    bayesopt_status status = BAYESOPT_OK;
    if (!bound)
        status = no_memory();
    else if (sqlite3_step(s) != SQLITE_DONE)
        status = store_error(store, "writing the store");
    sqlite3_finalize(s);
    return status;
}

/* Ends the transaction that store_begin() began. */
static bayesopt_status conclude(bayesopt *bo, bayesopt_status status)
{
    if (!status)
        status = store_commit(bo);
    if (status)
        store_rollback(bo);
    return status;
}

/* A statement whose first parameter is a name, on the first row of its answer; NULL: there is none.
 */
static bayesopt_status look_up(struct store *store, const char *sql, const char *name,
                               sqlite3_stmt **s)
{
    bayesopt_status status = store_prepare(store, sql, s);
    if (status)
        return status;
    sqlite3_bind_text(*s, 1, name, -1, SQLITE_STATIC);
    int code = sqlite3_step(*s);
    if (code == SQLITE_ROW)
        return BAYESOPT_OK;
    if (code != SQLITE_DONE)
        status = store_error(store, "reading the store");
    sqlite3_finalize(*s);
    *s = NULL;
    return status;
}

bayesopt_status store_put_text(struct store *store, const char *name, const char *text)
{
    sqlite3_stmt *s;
    bayesopt_status status = store_prepare(
        store, "INSERT OR REPLACE INTO bayesopt_texts(name, value) VALUES(?1, ?2)", &s);
    if (status)
        return status;
    sqlite3_bind_text(s, 1, name, -1, SQLITE_STATIC);
    bool bound =
        sqlite3_bind_text64(s, 2, text, strlen(text), SQLITE_STATIC, SQLITE_UTF8) == SQLITE_OK;
    return finish(store, s, bound);
}

bayesopt_status store_get_text(struct store *store, const char *name, char **text)
{
    sqlite3_stmt *s;
    *text = NULL;
    bayesopt_status status =
        look_up(store, "SELECT value FROM bayesopt_texts WHERE name = ?1", name, &s);
    if (status || !s)
        return status;
    bool is_text = sqlite3_column_type(s, 0) == SQLITE_TEXT;
    const char *value = is_text ? (const char *)sqlite3_column_text(s, 0) : NULL;
    *text = value ? strdup(value) : NULL;
    sqlite3_finalize(s);
    if (!is_text)
        return bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: text '%s' is damaged", store->path, name);
    return *text ? BAYESOPT_OK : no_memory();
}

bayesopt_status bayesopt_store_put_text(bayesopt *bo, const char *name, const char *text)
{
    bayesopt_status status = check_name(bo, name);
    if (!status && !text)
        status = bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "'%s': the text is NULL", name);
    if (!status)
        status = store_begin(bo);
    return status ? status : conclude(bo, store_put_text(bo->store, name, text));
}

bayesopt_status bayesopt_store_get_text(const bayesopt *bo, const char *name, char **text)
{
    if (!text)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "no place for the text");
    *text = NULL;
    bayesopt_status status = check_name(bo, name);
    return status ? status : store_get_text(bo->store, name, text);
}

bayesopt_status bayesopt_store_put_array(bayesopt *bo, const char *name, size_t rows,
                                         size_t columns, const double *values)
{
    sqlite3_stmt *s;
    bayesopt_status status = check_name(bo, name);
    if (!status && rows && columns && (!values || rows > MOST_NUMBERS / columns))
        status = bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                               "'%s': %zu x %zu numbers, values %s, expected at most %zu given",
                               name, rows, columns, values ? "given" : "NULL", MOST_NUMBERS);
    if (!status)
        status = store_begin(bo);
    if (status)
        return status;
    status = store_prepare(bo->store,
                           "INSERT OR REPLACE INTO bayesopt_arrays(name, rows, columns, value) "
                           "VALUES(?1, ?2, ?3, ?4)",
                           &s);
    if (!status) {
        const double none = 0;
        sqlite3_bind_text(s, 1, name, -1, SQLITE_STATIC);
        sqlite3_bind_int64(s, 2, (int64_t)rows);
        sqlite3_bind_int64(s, 3, (int64_t)columns);
        status =
            finish(bo->store, s, store_bind_numbers(s, 4, values ? values : &none, rows * columns));
    }
    return conclude(bo, status);
}

bayesopt_status bayesopt_store_get_array(const bayesopt *bo, const char *name, size_t *rows,
                                         size_t *columns, double **values)
{
    sqlite3_stmt *s;
    if (!rows || !columns || !values)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "no place for the array");
    *rows = *columns = 0;
    *values = NULL;
    bayesopt_status status = check_name(bo, name);
    if (!status)
        status =
            look_up(bo->store, "SELECT rows, columns, value FROM bayesopt_arrays WHERE name = ?1",
                    name, &s);
    if (status || !s)
        return status;
    size_t r = (size_t)sqlite3_column_int64(s, 0), c = (size_t)sqlite3_column_int64(s, 1);
    bool sized = store_column_whole(s, 0, INT64_MAX) && store_column_whole(s, 1, INT64_MAX);
    /* The blob bounds what the two sizes may claim. */
    if (sized && (!c || r <= (size_t)sqlite3_column_bytes(s, 2) / c))
        status = store_column_numbers(s, 2, r * c, values);
    sqlite3_finalize(s);
    if (status)
        return status;
    if (!*values)
        return bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: array '%s' is damaged", bo->store->path,
                             name);
    *rows = r;
    *columns = c;
    return BAYESOPT_OK;
}

/* Replaces a row, within a transaction. */
static bayesopt_status put_attributes(struct store *store, const char *table, int64_t row, size_t n,
                                      const bayesopt_attribute *attributes)
{
    sqlite3_stmt *s;
    bayesopt_status status =
        store_prepare(store, "DELETE FROM bayesopt_attributes WHERE list = ?1 AND row = ?2", &s);
    if (status)
        return status;
    sqlite3_bind_text(s, 1, table, -1, SQLITE_STATIC);
    sqlite3_bind_int64(s, 2, row);
    status = finish(store, s, true);
    for (size_t i = 0; i < n && !status; i++) {
        const bayesopt_attribute *a = &attributes[i];
        status = store_prepare(store,
                               "INSERT INTO bayesopt_attributes(list, row, position, name, number, "
                               "text) VALUES(?1, ?2, ?3, ?4, ?5, ?6)",
                               &s);
        if (status)
            return status;
        sqlite3_bind_text(s, 1, table, -1, SQLITE_STATIC);
        sqlite3_bind_int64(s, 2, row);
        sqlite3_bind_int64(s, 3, (int64_t)i);
        sqlite3_bind_text(s, 4, a->name, -1, SQLITE_STATIC);
        /* Without a text NULL stands for NAN. */
        if (a->text)
            sqlite3_bind_text(s, 6, a->text, -1, SQLITE_STATIC);
        else if (!isnan(a->number))
            sqlite3_bind_double(s, 5, a->number);
        status = finish(store, s, true);
    }
    return status;
}

bayesopt_status store_put_attributes(struct store *store, const struct point *p)
{
    return put_attributes(store, points, (int64_t)p->id, p->attributes.n, p->attributes.items);
}

/* The attribute of a row of an answer (name, number, text), borrowed until the next step. */
static bayesopt_status column_attribute(struct store *store, sqlite3_stmt *s, bayesopt_attribute *a)
{
    int name = sqlite3_column_type(s, 0), number = sqlite3_column_type(s, 1);
    int text = sqlite3_column_type(s, 2);
    if (name != SQLITE_TEXT || (text != SQLITE_TEXT && text != SQLITE_NULL) ||
        (number != SQLITE_FLOAT && number != SQLITE_INTEGER && number != SQLITE_NULL))
        return bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: an attribute is damaged", store->path);
    *a = (bayesopt_attribute){
        .name = (const char *)sqlite3_column_text(s, 0),
        .number = number == SQLITE_NULL ? (double)NAN : sqlite3_column_double(s, 1),
        .text = (const char *)sqlite3_column_text(s, 2),
    };
    return a->name && (a->text || text == SQLITE_NULL) ? BAYESOPT_OK : no_memory();
}

bayesopt_status store_get_attributes(struct store *store, struct point *p)
{
    sqlite3_stmt *s;
    attributes_free(&p->attributes);
    bayesopt_status status = store_prepare(store,
                                           "SELECT name, number, text FROM bayesopt_attributes "
                                           "WHERE list = ?1 AND row = ?2 ORDER BY position",
                                           &s);
    if (status)
        return status;
    sqlite3_bind_text(s, 1, points, -1, SQLITE_STATIC);
    sqlite3_bind_int64(s, 2, (int64_t)p->id);
    int code = SQLITE_DONE;
    while (!status && (code = sqlite3_step(s)) == SQLITE_ROW) {
        bayesopt_attribute a;
        status = column_attribute(store, s, &a);
        if (!status && !attributes_append(&p->attributes, &a))
            status = no_memory();
    }
    if (!status && code != SQLITE_DONE)
        status = store_error(store, "reading the store");
    sqlite3_finalize(s);
    return status;
}

bayesopt_status bayesopt_store_put_row(bayesopt *bo, const char *table, size_t row, size_t n,
                                       const bayesopt_attribute *attributes)
{
    bayesopt_status status = check_name(bo, table);
    if (!status)
        status = attributes_check(n, attributes);
    if (!status && (row > INT64_MAX || !n))
        status = bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "'%s': row %zu of %zu attributes", table,
                               row, n);
    if (!status)
        status = store_begin(bo);
    if (status)
        return status;
    return conclude(bo, put_attributes(bo->store, table, (int64_t)row, n, attributes));
}

static bayesopt_status read_table(struct store *store, sqlite3_stmt *s, bayesopt_table *table)
{
    int64_t last = 0;
    int code;
    while ((code = sqlite3_step(s)) == SQLITE_ROW) {
        bayesopt_attribute a;
        bayesopt_status status = column_attribute(store, s, &a);
        int64_t row = sqlite3_column_int64(s, 3);
        if (status)
            return status;
        if (!table->n || row != last) {
            struct attributes *more = realloc(table->rows, (table->n + 1) * sizeof *more);
            if (!more)
                return no_memory();
            table->rows = more;
            more[table->n++] = (struct attributes){0};
            last = row;
        }
        if (!attributes_append(&table->rows[table->n - 1], &a))
            return no_memory();
    }
    return code == SQLITE_DONE ? BAYESOPT_OK : store_error(store, "reading the store");
}

bayesopt_status bayesopt_store_get_table(const bayesopt *bo, const char *name, bayesopt_table **out)
{
    sqlite3_stmt *s;
    if (!out)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "no place for the table");
    *out = NULL;
    bayesopt_status status = check_name(bo, name);
    if (!status)
        status = store_prepare(bo->store,
                               "SELECT name, number, text, row FROM bayesopt_attributes "
                               "WHERE list = ?1 ORDER BY row, position",
                               &s);
    if (status)
        return status;
    bayesopt_table *table = calloc(1, sizeof *table);
    sqlite3_bind_text(s, 1, name, -1, SQLITE_STATIC);
    status = table ? read_table(bo->store, s, table) : no_memory();
    sqlite3_finalize(s);
    if (status)
        bayesopt_table_free(table);
    else
        *out = table;
    return status;
}

void bayesopt_table_free(bayesopt_table *table)
{
    if (!table)
        return;
    for (size_t i = 0; i < table->n; i++)
        attributes_free(&table->rows[i]);
    free(table->rows);
    free(table);
}

size_t bayesopt_table_rows(const bayesopt_table *table)
{
    return table ? table->n : 0;
}

size_t bayesopt_table_row(const bayesopt_table *table, size_t i,
                          const bayesopt_attribute **attributes)
{
    bool there = table && i < table->n;
    if (attributes)
        *attributes = there ? table->rows[i].items : NULL;
    return there ? table->rows[i].n : 0;
}
