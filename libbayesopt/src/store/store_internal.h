/* The SQLite side of a store. */
#ifndef BAYESOPT_STORE_INTERNAL_H
#define BAYESOPT_STORE_INTERNAL_H

#include "store/store.h"

#include <sqlite3.h>

struct store {
    sqlite3 *db;
    char *path;
    int64_t change;        /* last change read or written */
    int64_t change_before; /* the same when the transaction began */
    bool in_transaction;
    bool read_only;
};

bayesopt_status store_error(const struct store *store, const char *doing);
bayesopt_status store_execute(struct store *store, const char *sql);
bayesopt_status store_prepare(struct store *store, const char *sql, sqlite3_stmt **statement);
/* Arrays of doubles as little-endian blobs. */
bool store_bind_numbers(sqlite3_stmt *statement, int index, const double *values, size_t n);
/* A column of n numbers, which the caller frees. Without a blob of this size *values is NULL: the
 * caller says what is damaged. */
bayesopt_status store_column_numbers(sqlite3_stmt *statement, int column, size_t n,
                                     double **values);
/* Whether a column is a whole number in [0, most]. */
bool store_column_whole(sqlite3_stmt *statement, int column, int64_t most);
bayesopt_status store_put_meta(struct store *store, const char *key, const double *values,
                               size_t n);
/* *values is NULL if there is no such key; *n its length. The caller frees. */
bayesopt_status store_get_meta(struct store *store, const char *key, double **values, size_t *n);
/* Reads rows changed since the last reading, and the models' state. */
bayesopt_status store_refresh(struct bayesopt *bo);

/* store_record.c: a text within a transaction; *text NULL if there is none, else the caller frees.
 */
bayesopt_status store_put_text(struct store *store, const char *name, const char *text);
bayesopt_status store_get_text(struct store *store, const char *name, char **text);
/* What is kept beside a point's value. */
bayesopt_status store_put_attributes(struct store *store, const struct point *point);
bayesopt_status store_get_attributes(struct store *store, struct point *point);

/* store_problem.c: written; compared with what was written, the budget excepted, which becomes
 * bo's; read into a new object. */
bayesopt_status store_put_problem(struct bayesopt *bo);
bayesopt_status store_compare_problem(struct bayesopt *bo);
bayesopt_status store_get_problem(struct store *store, bayesopt_input_constraint input_constraint,
                                  void *input_user_data, bayesopt **bo);

/* store_names.c: names of variables and texts of conditions, likewise. */
bayesopt_status store_put_names(struct bayesopt *bo);
bayesopt_status store_compare_names(struct bayesopt *bo);
struct named {
    size_t d, n;
    char **names;      /* [d], NULL where the store has none */
    char **conditions; /* [n] */
};
bayesopt_status store_get_names(struct store *store, size_t d, struct named *named);
void named_free(struct named *named);

/* store_session.c */
bayesopt_status store_session_start(struct bayesopt *bo);
void store_session_end(struct bayesopt *bo);

#endif
