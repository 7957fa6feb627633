/* What the files of the store share. */
#ifndef HULLOPT_STORE_INTERNAL_H
#define HULLOPT_STORE_INTERNAL_H

#include "store.h"

#include <sqlite3.h>

struct store {
    sqlite3 *db;
    char *path;
    sqlite3_int64 session;
    double session_start;
};

/* Prints "path: what SQLite says"; returns false. */
bool store_report(struct store *store);
/* NULL after printing. */
sqlite3_stmt *store_prepare(struct store *store, const char *sql);
/* Steps a statement that returns no rows, and finalises it. */
bool store_finish(struct store *store, sqlite3_stmt *statement);

/* NAN is stored as NULL and read back as NAN. */
void store_bind(sqlite3_stmt *statement, int index, double value);
double store_column(sqlite3_stmt *statement, int index);

#endif
