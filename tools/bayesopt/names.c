#include "names.h"

#include "cli.h"

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool connect(const char *path, sqlite3 **db)
{
    if (sqlite3_open_v2(path, db, SQLITE_OPEN_READWRITE, NULL) == SQLITE_OK) {
        sqlite3_busy_timeout(*db, 600000);
        return true;
    }
    cli_fail("%s: %s", path, *db ? sqlite3_errmsg(*db) : "out of memory");
    sqlite3_close(*db);
    return false;
}

static bool insert(sqlite3 *db, const char *kind, size_t i, const char *name)
{
    sqlite3_stmt *s;
    if (sqlite3_prepare_v2(db, "INSERT OR IGNORE INTO names(kind, i, name) VALUES(?, ?, ?)", -1, &s,
                           NULL) != SQLITE_OK)
        return false;
    sqlite3_bind_text(s, 1, kind, -1, SQLITE_STATIC);
    sqlite3_bind_int64(s, 2, (sqlite3_int64)i);
    sqlite3_bind_text(s, 3, name, -1, SQLITE_STATIC);
    bool ok = sqlite3_step(s) == SQLITE_DONE;
    sqlite3_finalize(s);
    return ok;
}

bool names_write(const char *store, const struct names *names)
{
    sqlite3 *db;
    if (!connect(store, &db))
        return false;
    bool ok =
        sqlite3_exec(db,
                     "BEGIN IMMEDIATE; CREATE TABLE IF NOT EXISTS names(kind TEXT, i INTEGER, "
                     "name TEXT NOT NULL, PRIMARY KEY(kind, i))",
                     NULL, NULL, NULL) == SQLITE_OK;
    for (size_t i = 0; i < names->d && ok; i++)
        ok = insert(db, "variable", i, names->variables[i]);
    for (size_t i = 0; i < names->m && ok; i++)
        ok = insert(db, "constraint", i, names->constraints[i]);
    ok = ok && sqlite3_exec(db, "COMMIT", NULL, NULL, NULL) == SQLITE_OK;
    if (!ok)
        cli_fail("%s: writing names: %s", store, sqlite3_errmsg(db));
    sqlite3_close(db);
    return ok;
}

static bool set_name(char **slot, const char *text)
{
    free(*slot);
    *slot = strdup(text);
    return *slot != NULL;
}

/* A store without the table keeps the defaults. */
static bool read_table(const char *store, struct names *names)
{
    sqlite3 *db;
    sqlite3_stmt *s;
    if (!connect(store, &db))
        return false;
    bool ok = true;
    if (sqlite3_prepare_v2(db, "SELECT kind, i, name FROM names", -1, &s, NULL) == SQLITE_OK) {
        while (ok && sqlite3_step(s) == SQLITE_ROW) {
            const char *kind = (const char *)sqlite3_column_text(s, 0);
            const char *name = (const char *)sqlite3_column_text(s, 2);
            size_t i = (size_t)sqlite3_column_int64(s, 1);
            bool variable = kind && strcmp(kind, "variable") == 0;
            if (name && kind && i < (variable ? names->d : names->m))
                ok = set_name(variable ? &names->variables[i] : &names->constraints[i], name);
        }
        sqlite3_finalize(s);
    }
    sqlite3_close(db);
    return ok;
}

bool names_read(const char *store, const bayesopt *bo, struct names *names)
{
    char text[32];
    *names = (struct names){.d = bayesopt_dimension(bo, NULL, NULL),
                            .m = bayesopt_constraint_count(bo, NULL, NULL)};
    names->variables = calloc(names->d, sizeof *names->variables);
    names->constraints = calloc(names->m + 1, sizeof *names->constraints);
    bool ok = names->variables && names->constraints;
    for (size_t i = 0; i < names->d && ok; i++) {
        snprintf(text, sizeof text, "x%zu", i + 1);
        ok = set_name(&names->variables[i], text);
    }
    for (size_t i = 0; i < names->m && ok; i++) {
        snprintf(text, sizeof text, "c%zu", i + 1);
        ok = set_name(&names->constraints[i], text);
    }
    if (!ok)
        cli_fail("out of memory");
    ok = ok && read_table(store, names);
    if (!ok)
        names_free(names);
    return ok;
}

void names_free(struct names *names)
{
    for (size_t i = 0; names->variables && i < names->d; i++)
        free(names->variables[i]);
    for (size_t i = 0; names->constraints && i < names->m; i++)
        free(names->constraints[i]);
    free(names->variables);
    free(names->constraints);
    *names = (struct names){0};
}

bool store_open(const char *path, bayesopt **bo, struct names *names)
{
    if (bayesopt_open(path, NULL, NULL, bo)) {
        cli_fail("%s", bayesopt_last_error());
        return false;
    }
    if (names_read(path, *bo, names))
        return true;
    bayesopt_free(*bo);
    return false;
}
