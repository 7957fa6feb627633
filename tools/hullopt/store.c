#include "store.h"

#include "cli.h"
#include "store_internal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char TABLES[] =
    "BEGIN IMMEDIATE;"
    "CREATE TABLE hullopt_text (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
    "CREATE TABLE hullopt_array (name TEXT PRIMARY KEY, rows INTEGER NOT NULL,"
    " columns INTEGER NOT NULL, data BLOB NOT NULL);"
    "CREATE TABLE hullopt_evaluation (id INTEGER PRIMARY KEY, phase TEXT NOT NULL,"
    " u BLOB NOT NULL, failed INTEGER NOT NULL, stage TEXT NOT NULL, reason TEXT NOT NULL,"
    " cw REAL, cw_pressure REAL, rw REAL, share_beyond_cutoff REAL, condition REAL, volume REAL,"
    " volume_ratio REAL, wetted_area REAL, bound REAL, dofs INTEGER NOT NULL,"
    " propose_seconds REAL, geometry_seconds REAL, solve_seconds REAL, cw_speeds BLOB);"
    "CREATE TABLE hullopt_verification (position INTEGER PRIMARY KEY, family TEXT NOT NULL,"
    " label TEXT NOT NULL, formulation TEXT NOT NULL, froude REAL, refine INTEGER,"
    " stern_length REAL, cw_parent REAL, cw_best REAL, cw_pressure_parent REAL,"
    " cw_pressure_best REAL, dofs_parent INTEGER, dofs_best INTEGER, seconds REAL,"
    " note TEXT NOT NULL);"
    "CREATE TABLE hullopt_session (id INTEGER PRIMARY KEY, threads INTEGER NOT NULL,"
    " seconds REAL NOT NULL);"
    "COMMIT;";

bool store_report(struct store *store)
{
    cli_fail("%s: %s", store->path, sqlite3_errmsg(store->db));
    return false;
}

static struct store *open_file(const char *path, int flags)
{
    struct store *store = calloc(1, sizeof *store);
    if (!store || !(store->path = strdup(path))) {
        free(store);
        cli_fail("out of memory");
        return NULL;
    }
    if (sqlite3_open_v2(path, &store->db, flags, NULL) != SQLITE_OK ||
        sqlite3_busy_timeout(store->db, 60000) != SQLITE_OK ||
        sqlite3_exec(store->db, "PRAGMA synchronous = FULL", NULL, NULL, NULL) != SQLITE_OK) {
        store_report(store);
        store_close(store);
        return NULL;
    }
    return store;
}

struct store *store_create(const char *path)
{
    struct store *store = open_file(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
    if (store && sqlite3_exec(store->db, TABLES, NULL, NULL, NULL) != SQLITE_OK) {
        store_report(store);
        store_close(store);
        store = NULL;
    }
    return store;
}

struct store *store_open(const char *path)
{
    return open_file(path, SQLITE_OPEN_READWRITE);
}

void store_close(struct store *store)
{
    if (!store)
        return;
    sqlite3_close(store->db);
    free(store->path);
    free(store);
}

void store_remove(const char *path)
{
    static const char *const suffixes[] = {"", "-journal", "-wal", "-shm"};
    char name[4096];
    for (size_t i = 0; i < sizeof suffixes / sizeof *suffixes; i++)
        if (snprintf(name, sizeof name, "%s%s", path, suffixes[i]) < (int)sizeof name)
            unlink(name);
}

/* First column of the first row as text, for the checks of store_probe. */
static bool first_text(sqlite3 *db, const char *sql, char *text, size_t size)
{
    sqlite3_stmt *statement;
    *text = '\0';
    if (sqlite3_prepare_v2(db, sql, -1, &statement, NULL) != SQLITE_OK)
        return false;
    int step = sqlite3_step(statement);
    if (step == SQLITE_ROW)
        snprintf(text, size, "%s", (const char *)sqlite3_column_text(statement, 0));
    sqlite3_finalize(statement);
    return step == SQLITE_ROW;
}

enum store_state store_probe(const char *path)
{
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return STORE_ABSENT;
    char text[200];
    struct store *store = store_open(path);
    if (!store)
        return STORE_UNUSABLE;
    enum store_state state = STORE_UNUSABLE;
    if (!first_text(store->db, "PRAGMA quick_check(1)", text, sizeof text))
        cli_fail("%s: damaged, it cannot be resumed: %s", path, sqlite3_errmsg(store->db));
    else if (strcmp(text, "ok") != 0)
        cli_fail("%s: damaged, it cannot be resumed: %.*s", path, (int)strcspn(text, "\n"), text);
    else if (!first_text(store->db, "SELECT value FROM hullopt_text WHERE key = 'configuration'",
                         text, sizeof text))
        cli_fail("%s: not the database of a hullopt run", path);
    else
        state = STORE_RUN;
    store_close(store);
    return state;
}

sqlite3_stmt *store_prepare(struct store *store, const char *sql)
{
    sqlite3_stmt *statement;
    if (sqlite3_prepare_v2(store->db, sql, -1, &statement, NULL) == SQLITE_OK)
        return statement;
    store_report(store);
    return NULL;
}

bool store_finish(struct store *store, sqlite3_stmt *statement)
{
    bool ok = sqlite3_step(statement) == SQLITE_DONE;
    if (!ok)
        store_report(store);
    sqlite3_finalize(statement);
    return ok;
}

bool store_put_text(struct store *store, const char *key, const char *value)
{
    sqlite3_stmt *s = store_prepare(store, "INSERT OR REPLACE INTO hullopt_text VALUES (?1, ?2)");
    if (!s)
        return false;
    sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    sqlite3_bind_text(s, 2, value, -1, SQLITE_STATIC);
    return store_finish(store, s);
}

char *store_get_text(struct store *store, const char *key)
{
    sqlite3_stmt *s = store_prepare(store, "SELECT value FROM hullopt_text WHERE key = ?1");
    if (!s)
        return NULL;
    sqlite3_bind_text(s, 1, key, -1, SQLITE_STATIC);
    char *value = NULL;
    if (sqlite3_step(s) == SQLITE_ROW)
        value = strdup((const char *)sqlite3_column_text(s, 0));
    sqlite3_finalize(s);
    return value;
}

bool store_begin_session(struct store *store, int threads, double start)
{
    sqlite3_stmt *s =
        store_prepare(store, "INSERT INTO hullopt_session (threads, seconds) VALUES (?1, 0)");
    if (!s)
        return false;
    sqlite3_bind_int(s, 1, threads);
    if (!store_finish(store, s))
        return false;
    store->session = sqlite3_last_insert_rowid(store->db);
    store->session_start = start;
    return true;
}

bool store_update_session(struct store *store)
{
    sqlite3_stmt *s = store_prepare(store, "UPDATE hullopt_session SET seconds = ?2 WHERE id = ?1");
    if (!s)
        return false;
    sqlite3_bind_int64(s, 1, store->session);
    sqlite3_bind_double(s, 2, cli_seconds() - store->session_start);
    return store_finish(store, s);
}

double store_total_seconds(struct store *store, size_t *sessions)
{
    sqlite3_stmt *s =
        store_prepare(store, "SELECT coalesce(sum(seconds), 0), count(*) FROM hullopt_session");
    double total = 0;
    *sessions = 0;
    if (s && sqlite3_step(s) == SQLITE_ROW) {
        total = sqlite3_column_double(s, 0);
        *sessions = (size_t)sqlite3_column_int64(s, 1);
    }
    sqlite3_finalize(s);
    return total;
}
