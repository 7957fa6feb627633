/* Reading and writing the history. Every change is one transaction with full synchronisation: a
 * process may be killed at any moment and the file holds what was promised. */
#include "core/error.h"
#include "store/store_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bayesopt_status store_error(const struct store *store, const char *doing)
{
    int code = sqlite3_errcode(store->db) & 0xff;
    bayesopt_status status = code == SQLITE_CORRUPT || code == SQLITE_NOTADB ? BAYESOPT_ERROR_FORMAT
                             : code == SQLITE_NOMEM                          ? BAYESOPT_ERROR_MEMORY
                                                                             : BAYESOPT_ERROR_FILE;
    if (code == SQLITE_NOMEM) /* which the message may not tell */
        return bayesopt_fail(status, "%s: %s: out of memory", store->path, doing);
    int reason = sqlite3_system_errno(store->db);
    bool of_system = code == SQLITE_IOERR || code == SQLITE_FULL;
    return of_system && reason
               ? bayesopt_fail(status, "%s: %s: %s: %s", store->path, doing,
                               sqlite3_errmsg(store->db), strerror(reason))
               : bayesopt_fail(status, "%s: %s: %s", store->path, doing, sqlite3_errmsg(store->db));
}

bayesopt_status store_execute(struct store *store, const char *sql)
{
    return sqlite3_exec(store->db, sql, NULL, NULL, NULL) == SQLITE_OK
               ? BAYESOPT_OK
               : store_error(store, "writing the store");
}

bayesopt_status store_prepare(struct store *store, const char *sql, sqlite3_stmt **statement)
{
    return sqlite3_prepare_v2(store->db, sql, -1, statement, NULL) == SQLITE_OK
               ? BAYESOPT_OK
               : store_error(store, "reading the store");
}

bool store_bind_numbers(sqlite3_stmt *statement, int index, const double *values, size_t n)
{
    if (!values)
        return sqlite3_bind_null(statement, index) == SQLITE_OK;
    unsigned char *bytes = malloc(n ? 8 * n : 1);
    if (!bytes)
        return false;
    for (size_t i = 0; i < n; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        for (int b = 0; b < 8; b++)
            bytes[8 * i + (size_t)b] = (unsigned char)(bits >> (8 * b));
    }
    return sqlite3_bind_blob64(statement, index, bytes, 8 * n, free) == SQLITE_OK;
}

static void decode(const unsigned char *bytes, size_t n, double *values)
{
    for (size_t i = 0; i < n; i++) {
        uint64_t bits = 0;
        for (int b = 0; b < 8; b++)
            bits |= (uint64_t)bytes[8 * i + (size_t)b] << (8 * b);
        memcpy(&values[i], &bits, sizeof bits);
    }
}

bayesopt_status store_column_numbers(sqlite3_stmt *statement, int column, size_t n, double **values)
{
    *values = NULL;
    if (sqlite3_column_type(statement, column) != SQLITE_BLOB ||
        (size_t)sqlite3_column_bytes(statement, column) != 8 * n)
        return BAYESOPT_OK;
    const void *bytes = sqlite3_column_blob(statement, column);
    if (bytes || !n)
        *values = malloc((n ? n : 1) * sizeof **values);
    if (!*values)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    decode(bytes, n, *values);
    return BAYESOPT_OK;
}

bool store_column_whole(sqlite3_stmt *statement, int column, int64_t most)
{
    int64_t value = sqlite3_column_int64(statement, column);
    return sqlite3_column_type(statement, column) == SQLITE_INTEGER && value >= 0 && value <= most;
}

bayesopt_status store_put_meta(struct store *store, const char *key, const double *values, size_t n)
{
    sqlite3_stmt *s;
    bayesopt_status status =
        store_prepare(store, "INSERT OR REPLACE INTO bayesopt_meta(key, value) VALUES(?, ?)", &s);
    if (status)
        return status;
    sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    if (!store_bind_numbers(s, 2, values, n))
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    else if (sqlite3_step(s) != SQLITE_DONE)
        status = store_error(store, "writing the store");
    sqlite3_finalize(s);
    return status;
}

bayesopt_status store_get_meta(struct store *store, const char *key, double **values, size_t *n)
{
    sqlite3_stmt *s;
    *values = NULL;
    *n = 0;
    bayesopt_status status =
        store_prepare(store, "SELECT value FROM bayesopt_meta WHERE key = ?", &s);
    if (status)
        return status;
    sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    int code = sqlite3_step(s);
    if (code == SQLITE_ROW) {
        *n = (size_t)sqlite3_column_bytes(s, 0) / 8;
        status = store_column_numbers(s, 0, *n, values);
        if (!status && !*values)
            status =
                bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: entry '%s' is damaged", store->path, key);
    } else if (code != SQLITE_DONE) {
        status = store_error(store, "reading the store");
    }
    sqlite3_finalize(s);
    return status;
}

enum column {
    ID,
    CHANGE,
    PHASE,
    STATE,
    LEVEL,
    SESSION,
    DETACHED,
    X,
    F,
    CONSTRAINTS,
    GRADIENT,
    VARIANCE,
    NOTE
};

static bayesopt_status damaged(const struct store *store, sqlite3_stmt *s, const char *what)
{
    return bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: point %lld: %s", store->path,
                         (long long)sqlite3_column_int64(s, ID), what);
}

/* The numbers of a column that has some, which are finite. */
static bayesopt_status read_numbers(const struct store *store, sqlite3_stmt *s, int column,
                                    size_t n, const char *what, double **values)
{
    bayesopt_status status = store_column_numbers(s, column, n, values);
    bool good = status || *values;
    for (size_t i = 0; i < n && *values && good; i++)
        good = isfinite((*values)[i]);
    return good ? status : damaged(store, s, what);
}

static bool is_number(sqlite3_stmt *s, int column)
{
    int type = sqlite3_column_type(s, column);
    return (type == SQLITE_FLOAT || type == SQLITE_INTEGER) &&
           isfinite(sqlite3_column_double(s, column));
}

/* The outcome columns of a row, into a point that has none yet. */
static bayesopt_status read_outcome(struct bayesopt *bo, sqlite3_stmt *s, struct point *p)
{
    size_t m = bo->options.n_constraints;
    free(p->constraints);
    free(p->gradient);
    free(p->note);
    attributes_free(&p->attributes);
    p->constraints = p->gradient = NULL;
    p->note = NULL;
    p->f = NAN;
    p->variance = 0;
    if (sqlite3_column_type(s, NOTE) == SQLITE_TEXT) {
        const char *note = (const char *)sqlite3_column_text(s, NOTE);
        p->note = note ? strdup(note) : NULL;
        if (!p->note)
            return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    } else if (sqlite3_column_type(s, NOTE) != SQLITE_NULL) {
        return damaged(bo->store, s, "its note is not a text");
    }
    if (p->state != BAYESOPT_STATE_PENDING) {
        bayesopt_status status = store_get_attributes(bo->store, p);
        if (status)
            return status;
    }
    if (p->state != BAYESOPT_STATE_DONE)
        return BAYESOPT_OK;
    p->f = problem_sign(bo) * sqlite3_column_double(s, F);
    p->variance = sqlite3_column_double(s, VARIANCE);
    if (!is_number(s, F))
        return damaged(bo->store, s, "is done without a finite value");
    if (!is_number(s, VARIANCE) || p->variance < 0)
        return damaged(bo->store, s, "its variance is damaged");
    bayesopt_status status = BAYESOPT_OK;
    if (m)
        status = read_numbers(bo->store, s, CONSTRAINTS, m, "its constraints are damaged",
                              &p->constraints);
    if (!status && sqlite3_column_type(s, GRADIENT) != SQLITE_NULL)
        status =
            read_numbers(bo->store, s, GRADIENT, bo->d, "its gradient is damaged", &p->gradient);
    return status;
}

static bayesopt_status read_row(struct bayesopt *bo, sqlite3_stmt *s)
{
    int64_t id = sqlite3_column_int64(s, ID);
    int phase = sqlite3_column_int(s, PHASE), state = sqlite3_column_int(s, STATE);
    int level = sqlite3_column_int(s, LEVEL);
    if (id < 1 || !store_column_whole(s, PHASE, BAYESOPT_PHASE_DESCENT) ||
        !store_column_whole(s, STATE, BAYESOPT_STATE_LOST) ||
        !store_column_whole(s, LEVEL, (int64_t)bo->options.n_levels - 1) ||
        !store_column_whole(s, CHANGE, INT64_MAX) || !store_column_whole(s, SESSION, INT64_MAX) ||
        !store_column_whole(s, DETACHED, 1))
        return damaged(bo->store, s,
                       "id, change, phase, state, level, session or detached is outside its range");
    struct point *p = history_find(bo, (uint64_t)id);
    if (!p) {
        double *x;
        bayesopt_status status = store_column_numbers(s, X, bo->d, &x);
        if (status)
            return status;
        bool inside = x && !problem_check_values(bo, 1, x) &&
                      (phase == BAYESOPT_PHASE_EXTERNAL || problem_inside(bo, x));
        if (inside && bo->n_points && bo->points[bo->n_points - 1].id >= (uint64_t)id)
            inside = false;
        p = inside ? history_append(bo, (uint64_t)id, x, (bayesopt_phase)phase) : NULL;
        free(x);
        if (!inside)
            return damaged(bo->store, s, "its coordinates are damaged or out of bounds");
        if (!p)
            return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    p->state = (bayesopt_state)state;
    p->level = level;
    p->session = sqlite3_column_int64(s, SESSION);
    p->detached = sqlite3_column_int(s, DETACHED) != 0;
    bo->surrogates.fitted = false;
    return read_outcome(bo, s, p);
}

static bayesopt_status read_state(struct bayesopt *bo)
{
    double *values;
    size_t n, size = surrogates_state_size(&bo->surrogates, bo->d);
    bayesopt_status status = store_get_meta(bo->store, "models", &values, &n);
    if (!status && values && !(n == size && surrogates_restore(&bo->surrogates, bo->d, values)))
        status =
            bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: entry 'models' is damaged", bo->store->path);
    free(values);
    if (status || bo->design)
        return status;
    status = store_get_meta(bo->store, "design", &values, &n);
    if (!status && values && n != bo->options.initial_n * bo->d)
        status =
            bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: entry 'design' is damaged", bo->store->path);
    if (status)
        free(values);
    else
        bo->design = values;
    return status;
}

bayesopt_status store_refresh(struct bayesopt *bo)
{
    struct store *store = bo->store;
    sqlite3_stmt *s;
    bool changed = false;
    bayesopt_status status = store_prepare(
        store,
        "SELECT id, change, phase, state, level, session, detached, x, f, constraints, "
        "gradient, variance, note FROM bayesopt_points WHERE change > ? ORDER BY id",
        &s);
    if (status)
        return status;
    sqlite3_bind_int64(s, 1, store->change);
    int code = SQLITE_DONE;
    int64_t last = store->change;
    while (!status && (code = sqlite3_step(s)) == SQLITE_ROW) {
        int64_t change = sqlite3_column_int64(s, CHANGE);
        last = change > last ? change : last;
        changed = true;
        status = read_row(bo, s);
    }
    if (!status && code != SQLITE_DONE)
        status = store_error(store, "reading the store");
    sqlite3_finalize(s);
    if (!status && changed)
        status = read_state(bo);
    if (!status)
        store->change = last;
    return status;
}

bayesopt_status store_begin(struct bayesopt *bo)
{
    if (!bo->store)
        return BAYESOPT_OK;
    if (bo->store->read_only)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "%s was opened for reading only",
                             bo->store->path);
    bayesopt_status status = store_execute(bo->store, "BEGIN IMMEDIATE");
    if (status)
        return status;
    bo->store->in_transaction = true;
    bo->store->change_before = bo->store->change;
    status = store_refresh(bo);
    bo->store->change_before = bo->store->change;
    if (status)
        store_rollback(bo);
    return status;
}

bayesopt_status store_commit(struct bayesopt *bo)
{
    if (!bo->store)
        return BAYESOPT_OK;
    bayesopt_status status = store_execute(bo->store, "COMMIT");
    if (!status)
        bo->store->in_transaction = false;
    return status;
}

void store_rollback(struct bayesopt *bo)
{
    if (bo->store && bo->store->in_transaction) {
        sqlite3_exec(bo->store->db, "ROLLBACK", NULL, NULL, NULL);
        bo->store->in_transaction = false;
        bo->store->change = bo->store->change_before;
    }
}

bayesopt_status bayesopt_refresh(bayesopt *bo)
{
    NEED(bo);
    return bo->store ? store_refresh(bo) : BAYESOPT_OK;
}

static bayesopt_status write_point(struct bayesopt *bo, const struct point *p, const char *sql)
{
    sqlite3_stmt *s;
    if (!bo->store)
        return BAYESOPT_OK;
    bayesopt_status status = store_prepare(bo->store, sql, &s);
    if (status)
        return status;
    sqlite3_bind_int64(s, 1, (int64_t)p->id);
    sqlite3_bind_int64(s, 2, ++bo->store->change);
    sqlite3_bind_int(s, 3, (int)p->phase);
    sqlite3_bind_int(s, 4, (int)p->state);
    sqlite3_bind_int(s, 5, p->level);
    sqlite3_bind_int64(s, 6, p->session);
    sqlite3_bind_int(s, 7, p->detached);
    bool ok = store_bind_numbers(s, 8, p->x, bo->d);
    if (p->state == BAYESOPT_STATE_DONE)
        sqlite3_bind_double(s, 9, problem_sign(bo) * p->f);
    ok = ok && store_bind_numbers(s, 10, p->constraints, bo->options.n_constraints);
    ok = ok && store_bind_numbers(s, 11, p->gradient, bo->d);
    sqlite3_bind_double(s, 12, p->variance);
    if (p->note)
        sqlite3_bind_text(s, 13, p->note, -1, SQLITE_STATIC);
    if (!ok)
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    else if (sqlite3_step(s) != SQLITE_DONE)
        status = store_error(bo->store, "writing the store");
    sqlite3_finalize(s);
    if (!status && p->state != BAYESOPT_STATE_PENDING)
        status = store_put_attributes(bo->store, p);
    return status;
}

bayesopt_status store_insert(struct bayesopt *bo, const struct point *point)
{
    return write_point(
        bo, point,
        "INSERT INTO bayesopt_points(id, change, phase, state, level, session, detached, "
        "x, f, constraints, gradient, variance, note, asked) "
        "VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, "
        "strftime('%s', 'now'))");
}

bayesopt_status store_update(struct bayesopt *bo, const struct point *point)
{
    return write_point(
        bo, point,
        "UPDATE bayesopt_points SET change = ?2, phase = ?3, state = ?4, level = ?5, "
        "session = ?6, detached = ?7, x = ?8, f = ?9, constraints = ?10, gradient = ?11, "
        "variance = ?12, note = ?13, told = CASE WHEN ?4 THEN strftime('%s', 'now') END "
        "WHERE id = ?1");
}

bayesopt_status store_put_state(struct bayesopt *bo)
{
    size_t n = surrogates_state_size(&bo->surrogates, bo->d);
    if (!bo->store)
        return BAYESOPT_OK;
    double *values = malloc(n * sizeof *values);
    if (!values)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    surrogates_save(&bo->surrogates, bo->d, values);
    bayesopt_status status = store_put_meta(bo->store, "models", values, n);
    free(values);
    return status;
}

bayesopt_status store_put_budget(struct bayesopt *bo)
{
    double budget = (double)bo->options.max_evaluations;
    return bo->store ? store_put_meta(bo->store, "budget", &budget, 1) : BAYESOPT_OK;
}

bayesopt_status store_put_design(struct bayesopt *bo)
{
    return bo->store
               ? store_put_meta(bo->store, "design", bo->design, bo->options.initial_n * bo->d)
               : BAYESOPT_OK;
}
