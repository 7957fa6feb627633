/* Opening a store: a new file, the same problem again, or a refusal. */
#include "core/error.h"
#include "store/store_internal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The one version of the schema, kept as entry 'format'. 1: version 0.1.0 of the library, without
 * texts, arrays and attributes; 2: without signs of life. */
enum { FORMAT = 3, BUSY = 600000 /* ms that another may hold the file */ };

static const char schema_1[] =
    "CREATE TABLE bayesopt_meta(key TEXT PRIMARY KEY, value BLOB NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE bayesopt_points(id INTEGER PRIMARY KEY, change INTEGER NOT NULL UNIQUE,"
    " phase INTEGER NOT NULL, state INTEGER NOT NULL, level INTEGER NOT NULL,"
    " session INTEGER NOT NULL, detached INTEGER NOT NULL, x BLOB NOT NULL, f REAL,"
    " constraints BLOB, gradient BLOB, variance REAL NOT NULL, note TEXT, asked INTEGER, told "
    "INTEGER);"
    "CREATE TABLE bayesopt_sessions(id INTEGER PRIMARY KEY AUTOINCREMENT, host TEXT NOT NULL,"
    " pid INTEGER NOT NULL, started INTEGER NOT NULL, ended INTEGER NOT NULL);";

static const char schema_2[] =
    "CREATE TABLE bayesopt_texts(name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE bayesopt_arrays(name TEXT PRIMARY KEY, rows INTEGER NOT NULL,"
    " columns INTEGER NOT NULL, value BLOB NOT NULL);"
    "CREATE TABLE bayesopt_attributes(list TEXT NOT NULL, row INTEGER NOT NULL,"
    " position INTEGER NOT NULL, name TEXT NOT NULL, number REAL, text TEXT,"
    " PRIMARY KEY(list, row, name)) WITHOUT ROWID;";

static const char schema_3[] = "ALTER TABLE bayesopt_points ADD COLUMN heard INTEGER";

/* One integer from a query without parameters. */
static bayesopt_status query_count(struct store *store, const char *sql, int64_t *count)
{
    sqlite3_stmt *s;
    bayesopt_status status = store_prepare(store, sql, &s);
    if (status)
        return status;
    if (sqlite3_step(s) == SQLITE_ROW)
        *count = sqlite3_column_int64(s, 0);
    else
        status = store_error(store, "reading the store");
    sqlite3_finalize(s);
    return status;
}

static bayesopt_status check_intact(struct store *store)
{
    static const char no_memory[] = "error code=7"; /* SQLITE_NOMEM */
    sqlite3_stmt *s;
    bayesopt_status status = store_prepare(store, "PRAGMA quick_check(1)", &s);
    if (status)
        return status;
    const char *verdict = NULL;
    if (sqlite3_step(s) == SQLITE_ROW)
        verdict = (const char *)sqlite3_column_text(s, 0);
    if (!verdict)
        status = store_error(store, "checking the store");
    else if (strstr(verdict, no_memory))
        status = bayesopt_fail(BAYESOPT_ERROR_MEMORY, "%s: checking the store: out of memory",
                               store->path);
    else if (strcmp(verdict, "ok") != 0)
        status = bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: the database is damaged: %s",
                               store->path, verdict);
    sqlite3_finalize(s);
    return status;
}

static bayesopt_status put_format(struct store *store)
{
    const double format = FORMAT;
    return store_put_meta(store, "format", &format, 1);
}

static bayesopt_status create_tables(struct bayesopt *bo)
{
    bayesopt_status status = store_execute(bo->store, schema_1);
    if (!status)
        status = store_execute(bo->store, schema_2);
    if (!status)
        status = store_execute(bo->store, schema_3);
    if (!status)
        status = put_format(bo->store);
    return status ? status : store_put_problem(bo);
}

/* The command of version 0.1.0 kept names of variables and constraints in a table of its own. */
static bayesopt_status migrate(struct store *store, int format)
{
    int64_t names = 0;
    bayesopt_status status = store_execute(store, format < 2 ? schema_2 : "");
    if (!status)
        status = query_count(
            store, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'names'",
            &names);
    if (!status && names && format < 2)
        status = store_execute(store, "INSERT INTO bayesopt_texts(name, value) "
                                      "SELECT kind || '.' || (i + 1), name FROM names;"
                                      "DROP TABLE names");
    if (!status)
        status = store_execute(store, schema_3);
    return status ? status : put_format(store);
}

/* A point whose number of the change is none would be passed over by whoever reads the changes. */
static bayesopt_status check_changes(struct store *store)
{
    int64_t lost = 0;
    bayesopt_status status = query_count(
        store,
        "SELECT count(*) FROM bayesopt_points WHERE typeof(change) <> 'integer' OR change < 1",
        &lost);
    if (!status && lost)
        status = bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: %lld points whose change is damaged",
                               store->path, (long long)lost);
    return status;
}

/* The format of a store, 0 for an empty file; anything else is refused. */
static bayesopt_status classify(struct store *store, int *format)
{
    int64_t ours = 0, all = 0;
    double *values = NULL;
    size_t n = 0;
    *format = 0;
    bayesopt_status status =
        query_count(store,
                    "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN "
                    "('bayesopt_meta', 'bayesopt_points', 'bayesopt_sessions')",
                    &ours);
    if (!status)
        status = query_count(store, "SELECT count(*) FROM sqlite_master", &all);
    if (status || !all)
        return status;
    if (ours != 3)
        return bayesopt_fail(BAYESOPT_ERROR_FORMAT,
                             "%s: a database, but not a store of libbayesopt: %lld of its 3 tables",
                             store->path, (long long)ours);
    status = store_get_meta(store, "format", &values, &n);
    double found = !status && n == 1 ? values[0] : 0;
    free(values);
    if (!status && found > FORMAT)
        return bayesopt_fail(BAYESOPT_ERROR_FORMAT,
                             "%s: a newer libbayesopt wrote it: format %g, this one knows 1 to %d",
                             store->path, found, FORMAT);
    if (!status && found != 1 && found != 2 && found != 3)
        return bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: entry 'format' is damaged", store->path);
    *format = (int)found;
    return status ? status : check_changes(store);
}

static void disconnect(struct store *store)
{
    sqlite3_close(store->db);
    free(store->path);
    free(store);
}

/* SQLite says no more than that it cannot. */
static bayesopt_status opening_error(const struct store *store)
{
    int code = store->db ? sqlite3_errcode(store->db) & 0xff : SQLITE_NOMEM;
    if (code == SQLITE_NOMEM)
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "%s: out of memory", store->path);
    if (code == SQLITE_CANTOPEN && access(store->path, F_OK) != 0)
        return bayesopt_fail(BAYESOPT_ERROR_FILE, "%s: %s: %s", store->path,
                             sqlite3_errmsg(store->db), strerror(errno));
    return bayesopt_fail(BAYESOPT_ERROR_FILE, "%s: %s", store->path, sqlite3_errmsg(store->db));
}

/* Where a file system has no locks SQLite answers as if somebody held them, and would wait; the
 * reason is left in errno alone. */
static bayesopt_status check_locks(struct store *store)
{
    errno = 0;
    int code = sqlite3_exec(store->db, "SELECT count(*) FROM sqlite_master", NULL, NULL, NULL);
    if (code == SQLITE_BUSY && errno == ENOLCK)
        return bayesopt_fail(BAYESOPT_ERROR_FILE,
                             "%s: its file system gives no locks (%s), without which two sessions "
                             "would destroy it: keep it on another one",
                             store->path, strerror(ENOLCK));
    return BAYESOPT_OK;
}

/* What a process wrote that died before the end of its transaction is undone by whoever opens the
 * file next and may write. */
static bool undo_unfinished(const char *path)
{
    sqlite3 *db = NULL;
    bool ok = sqlite3_open_v2(path, &db, SQLITE_OPEN_READWRITE, NULL) == SQLITE_OK &&
              sqlite3_busy_timeout(db, BUSY) == SQLITE_OK &&
              sqlite3_exec(db, "BEGIN IMMEDIATE; ROLLBACK", NULL, NULL, NULL) == SQLITE_OK;
    sqlite3_close(db);
    return ok;
}

/* The first of these reads the file. */
static bool begin(struct store *store)
{
    static const char pragmas[] = "PRAGMA synchronous = FULL; PRAGMA temp_store = MEMORY";
    int code = sqlite3_exec(store->db, pragmas, NULL, NULL, NULL);
    if (code == SQLITE_READONLY && undo_unfinished(store->path))
        code = sqlite3_exec(store->db, pragmas, NULL, NULL, NULL);
    return code == SQLITE_OK;
}

static bayesopt_status connect(const char *path, int flags, struct store **out)
{
    struct store *store = calloc(1, sizeof *store);
    if (store)
        store->path = malloc(strlen(path) + 1);
    if (!store || !store->path) {
        free(store);
        return bayesopt_fail(BAYESOPT_ERROR_MEMORY, "out of memory");
    }
    strcpy(store->path, path);
    store->read_only = flags == SQLITE_OPEN_READONLY;
    bayesopt_status status = BAYESOPT_OK;
    if (sqlite3_open_v2(path, &store->db, flags, NULL) != SQLITE_OK)
        status = opening_error(store);
    if (!status)
        status = check_locks(store);
    /* Another session's ask holds the lock while it computes. */
    if (!status)
        sqlite3_busy_timeout(store->db, BUSY);
    if (!status && !begin(store))
        status = store_error(store, "opening the store");
    if (!status)
        status = check_intact(store);
    if (status) {
        disconnect(store);
        return status;
    }
    *out = store;
    return BAYESOPT_OK;
}

bayesopt_status bayesopt_open_store(bayesopt *bo, const char *path)
{
    int format;
    if (!bo || !path)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "a store needs an optimisation and a path");
    if (bo->store || bo->n_points)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT,
                             "%s: a store is opened once and before the first point", path);
    bayesopt_status status = connect(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, &bo->store);
    if (status)
        return status;
    status = store_execute(bo->store, "BEGIN IMMEDIATE");
    bo->store->in_transaction = !status;
    if (!status)
        status = classify(bo->store, &format);
    if (!status && format && format < FORMAT)
        status = migrate(bo->store, format);
    if (!status)
        status = format ? store_compare_problem(bo) : create_tables(bo);
    if (!status)
        status = store_session_start(bo);
    if (!status)
        status = store_refresh(bo);
    if (!status)
        status = store_release_orphans(bo, false, 0);
    if (!status)
        status = store_commit(bo);
    if (status) {
        store_rollback(bo);
        history_truncate(bo, 0);
        disconnect(bo->store);
        bo->store = NULL;
    }
    return status;
}

void store_close(struct bayesopt *bo)
{
    if (!bo->store)
        return;
    if (!bo->store->read_only)
        store_session_end(bo);
    disconnect(bo->store);
    bo->store = NULL;
}

/* Puts a copy in memory, brought up to date, in the place of an older file. */
static bayesopt_status migrate_copy(struct store *store, int format)
{
    sqlite3 *copy = NULL, *file = store->db;
    sqlite3_backup *backup = NULL;
    if (sqlite3_open(":memory:", &copy) == SQLITE_OK &&
        (backup = sqlite3_backup_init(copy, "main", file, "main")) != NULL)
        sqlite3_backup_step(backup, -1);
    bool ok = backup && sqlite3_backup_finish(backup) == SQLITE_OK;
    if (!ok) {
        bayesopt_status status =
            bayesopt_fail(BAYESOPT_ERROR_FILE, "%s: copying the store: %s", store->path,
                          copy ? sqlite3_errmsg(copy) : "out of memory");
        sqlite3_close(copy);
        return status;
    }
    sqlite3_close(file);
    store->db = copy;
    return migrate(store, format);
}

/* An existing store and the optimisation it describes, which does not hold it yet. */
static bayesopt_status open_existing(const char *path, int flags,
                                     bayesopt_input_constraint input_constraint,
                                     void *input_user_data, struct store **store, bayesopt **bo)
{
    int format;
    bayesopt_status status = connect(path, flags, store);
    if (status)
        return status;
    status = classify(*store, &format);
    if (!status && !format)
        status = bayesopt_fail(BAYESOPT_ERROR_FORMAT, "%s: an empty database, not a store", path);
    if (!status && format < FORMAT)
        status = migrate_copy(*store, format);
    if (!status)
        status = store_get_problem(*store, input_constraint, input_user_data, bo);
    if (status)
        disconnect(*store);
    return status;
}

bayesopt_status bayesopt_open(const char *path, bayesopt_input_constraint input_constraint,
                              void *input_user_data, bayesopt **out)
{
    struct store *store;
    bayesopt *bo;
    if (!path || !out)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "a store needs a path and a place to be");
    bayesopt_status status =
        open_existing(path, SQLITE_OPEN_READWRITE, input_constraint, input_user_data, &store, &bo);
    if (status)
        return status;
    disconnect(store);
    status = bayesopt_open_store(bo, path);
    if (status)
        problem_free(bo);
    else
        *out = bo;
    return status;
}

bayesopt_status bayesopt_open_read(const char *path, bayesopt **out)
{
    struct store *store;
    bayesopt *bo;
    if (!path || !out)
        return bayesopt_fail(BAYESOPT_ERROR_ARGUMENT, "a store needs a path and a place to be");
    bayesopt_status status = open_existing(path, SQLITE_OPEN_READONLY, NULL, NULL, &store, &bo);
    if (status)
        return status;
    bo->store = store;
    status = store_refresh(bo);
    if (status) {
        store_close(bo);
        problem_free(bo);
    } else
        *out = bo;
    return status;
}
