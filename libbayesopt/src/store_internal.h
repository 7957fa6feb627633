/* The SQLite side of a store. */
#ifndef BAYESOPT_STORE_INTERNAL_H
#define BAYESOPT_STORE_INTERNAL_H

#include "store.h"

#include <sqlite3.h>

struct store {
    sqlite3 *db;
    char *path;
    int64_t change;        /* last change read or written */
    int64_t change_before; /* the same when the transaction began */
    bool in_transaction;
};

/* What makes two runs the same problem, every entry as numbers. */
struct field {
    const char *name;
    size_t n;
    double *values;
};
enum { FIELDS = 22 };

/* Fills fields [FIELDS] with the problem of bo; free each values. false: out of memory. */
bool problem_fields(const struct bayesopt *bo, struct field *fields);
void problem_fields_free(struct field *fields);

bayesopt_status store_error(const struct store *store, const char *doing);
bayesopt_status store_execute(struct store *store, const char *sql);
bayesopt_status store_prepare(struct store *store, const char *sql, sqlite3_stmt **statement);
/* Arrays of doubles as little-endian blobs. */
bool store_bind_numbers(sqlite3_stmt *statement, int index, const double *values, size_t n);
/* NULL if the column is not a blob of n numbers. The caller frees. */
double *store_column_numbers(sqlite3_stmt *statement, int column, size_t n);
bayesopt_status store_put_meta(struct store *store, const char *key, const double *values,
                               size_t n);
/* *values is NULL if there is no such key; *n its length. The caller frees. */
bayesopt_status store_get_meta(struct store *store, const char *key, double **values, size_t *n);
/* Reads rows changed since the last reading, and the models' state. */
bayesopt_status store_refresh(struct bayesopt *bo);

/* store_session.c */
bayesopt_status store_session_start(struct bayesopt *bo);
void store_session_end(struct bayesopt *bo);

#endif
