/* The record of a run, run.db: the store of libbayesopt, whose history is that of the evaluated
 * designs, with their figures as attributes; the latent space and the wave patterns as arrays;
 * verification and sessions as tables. Everything is on disk when a call returns. */
#ifndef HULLOPT_RECORD_H
#define HULLOPT_RECORD_H

#include "core/evaluate.h"
#include "core/verification.h"

#include <bayesopt/bayesopt.h>

struct record {
    bayesopt *bo;
    size_t session;
    int threads;
    double start;
};

/* What a run was begun with. */
struct origin {
    char *configuration;   /* canonical text */
    igabem_options solver; /* as frozen on the parent */
    galv_model *model;
    double *gradient; /* of the volume, modes numbers, or NULL */
    double *initial;  /* of a search, n_initial x modes numbers, or NULL */
    double *ends;     /* problem.ends, or NULL */
    double *map;      /* problem.map, modes x n_parameters numbers, or NULL */
    size_t n_initial, n_parameters;
    size_t grid[2];
    double length;
};
void origin_free(struct origin *origin);

/* The options of the solver that count, by name. Returns how many. */
enum { SOLVER_MOST = 16 };
size_t record_solver(const igabem_options *solver, bayesopt_attribute attributes[SOLVER_MOST]);

/* Of a record at path, for looking only. False for one that is damaged, newer, or no run. */
bool record_read(const char *path, struct record *record, struct origin *origin);
void record_close(struct record *record);
/* Removes the file and what SQLite keeps beside it. */
void record_remove(const char *path);

/* Writes the origin: the last of all that makes a file a run. */
bool record_put_origin(struct record *record, const struct problem *problem);

/* Texts and arrays by name; what is not there is NULL. The caller frees them. */
bool record_put_text(struct record *record, const char *name, const char *text);
bool record_get_text(const struct record *record, const char *name, char **text);
bool record_put_array(struct record *record, const char *name, size_t rows, size_t columns,
                      const double *values);
bool record_get_array(const struct record *record, const char *name, size_t *rows, size_t *columns,
                      double **values);

/* The grid points of a command's hull, so that it can be built again without the command; NULL: not
 * on record. */
bool record_put_points(struct record *record, uint64_t id, size_t n, const double *points);
bool record_get_points(const struct record *record, uint64_t id, size_t n, double **points);

/* Tells the search what became of a design, with all its figures: in one transaction. ratio: of
 * outcome_ratios(). id 0: not asked for; filled, but for the parent, which comes first. */
bool record_tell(struct record *record, struct evaluation *evaluation, const double *ratio);
/* Every design that was told, the parent first; u is borrowed from the record. The caller frees the
 * list. */
bool record_evaluations(const struct record *record, struct evaluation **list, size_t *n);

bool record_put_verification(struct record *record, size_t position,
                             const struct verification *row);
bool record_verifications(const struct record *record, struct verification **list, size_t *n);

/* Time spent by all sessions: begin makes a row, update writes the seconds since `start`, a reading
 * of cli_seconds(). */
bool record_begin_session(struct record *record, int threads, double start);
bool record_update_session(struct record *record);
bool record_seconds(const struct record *record, size_t *sessions, double *seconds);

#endif
