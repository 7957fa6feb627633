/* The run's database: beside the tables of libbayesopt (bayesopt_*) those of hullopt (hullopt_*) in
 * one SQLite file. Every write is a transaction of its own, on disk when the call returns. */
#ifndef HULLOPT_STORE_H
#define HULLOPT_STORE_H

#include "evaluate.h"
#include "latent.h"

#include <stdbool.h>

struct store; /* opaque */

/* What a file is before anything is opened for good. */
enum store_state {
    STORE_ABSENT,  /* no file */
    STORE_RUN,     /* a run */
    STORE_UNUSABLE /* damaged or another database: the sentence was printed */
};
enum store_state store_probe(const char *path);

/* Opens a database that holds a run; create adds hullopt's tables to an existing or new file. On
 * failure prints the sentence and returns NULL. */
struct store *store_create(const char *path);
struct store *store_open(const char *path);
void store_close(struct store *store);

/* Removes the file and what SQLite keeps beside it. */
void store_remove(const char *path);

/* Texts by key, allocated for the caller; get gives NULL when there is none. */
char *store_get_text(struct store *store, const char *key);
bool store_put_text(struct store *store, const char *key, const char *value);

/* Arrays of numbers by name: rows x columns, allocated for the caller. */
bool store_put_array(struct store *store, const char *name, size_t rows, size_t columns,
                     const double *values);
double *store_get_array(struct store *store, const char *name, size_t *rows, size_t *columns);

bool store_put_latent(struct store *store, const struct latent *latent);
bool store_get_latent(struct store *store, struct latent *latent);

/* Records of evaluations. find: 1 found, 0 not there, -1 failed. list: all, by id; free each. */
bool store_put_evaluation(struct store *store, size_t modes, const struct evaluation *evaluation);
int store_find_evaluation(struct store *store, uint64_t id, size_t modes,
                          struct evaluation *evaluation);
bool store_list_evaluations(struct store *store, size_t modes, struct evaluation **list, size_t *n);

/* One line of the verification: parent and optimum under the same settings. */
struct verification {
    char group[16]; /* "objective", "formulation", "resolution", "filter", "speed", "stern" */
    char label[80], formulation[40];
    double froude;
    int refine;
    double stern_length;
    double cw_parent, cw_best; /* NAN: no result, see note */
    double cw_pressure_parent, cw_pressure_best;
    size_t dofs_parent, dofs_best;
    double seconds;
    char note[REASON_SIZE];
};
bool store_put_verification(struct store *store, size_t position, const struct verification *row);
bool store_list_verifications(struct store *store, struct verification **list, size_t *n);

/* Time spent by all sessions: begin makes a row, update writes the seconds since `start`, a reading
 * of cli_seconds(). */
bool store_begin_session(struct store *store, int threads, double start);
bool store_update_session(struct store *store);
double store_total_seconds(struct store *store, size_t *sessions);

#endif
