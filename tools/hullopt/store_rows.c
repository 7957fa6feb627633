#include "cli.h"
#include "store_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void store_bind(sqlite3_stmt *statement, int index, double value)
{
    if (isnan(value))
        sqlite3_bind_null(statement, index);
    else
        sqlite3_bind_double(statement, index, value);
}

double store_column(sqlite3_stmt *statement, int index)
{
    return sqlite3_column_type(statement, index) == SQLITE_NULL
               ? NAN
               : sqlite3_column_double(statement, index);
}

static void copy_text(sqlite3_stmt *s, int index, char *out, size_t size)
{
    const char *text = (const char *)sqlite3_column_text(s, index);
    snprintf(out, size, "%s", text ? text : "");
}

static void bind_text(sqlite3_stmt *s, int index, const char *text)
{
    sqlite3_bind_text(s, index, text, -1, SQLITE_STATIC);
}

bool store_put_evaluation(struct store *store, size_t modes, const struct evaluation *e)
{
    sqlite3_stmt *s = store_prepare(store, "INSERT INTO hullopt_evaluation VALUES (?1, ?2, ?3, ?4,"
                                           " ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15,"
                                           " ?16, ?17, ?18, ?19, ?20)");
    if (!s)
        return false;
    sqlite3_bind_int64(s, 1, (sqlite3_int64)e->id);
    bind_text(s, 2, e->phase);
    sqlite3_bind_blob64(s, 3, e->u, modes * sizeof *e->u, SQLITE_STATIC);
    sqlite3_bind_int(s, 4, e->failed);
    bind_text(s, 5, e->stage);
    bind_text(s, 6, e->reason);
    const double figures[] = {e->cw,        e->cw_pressure, e->rw,           e->share_beyond_cutoff,
                              e->condition, e->volume,      e->volume_ratio, e->wetted_area,
                              e->bound};
    for (int k = 0; k < 9; k++)
        store_bind(s, 7 + k, figures[k]);
    sqlite3_bind_int64(s, 16, (sqlite3_int64)e->dofs);
    store_bind(s, 17, e->propose_seconds);
    store_bind(s, 18, e->geometry_seconds);
    store_bind(s, 19, e->solve_seconds);
    sqlite3_bind_blob64(s, 20, e->cw_speed, e->speeds * sizeof *e->cw_speed, SQLITE_STATIC);
    return store_finish(store, s);
}

/* Runs of version 0.1 have no such column. */
static void read_speeds(sqlite3_stmt *s, struct evaluation *e)
{
    const void *speeds = sqlite3_column_count(s) > 19 ? sqlite3_column_blob(s, 19) : NULL;
    size_t n = speeds ? (size_t)sqlite3_column_bytes(s, 19) / sizeof *e->cw_speed : 0;
    e->speeds = n < CONFIG_FROUDE_MOST ? n : CONFIG_FROUDE_MOST;
    if (e->speeds)
        memcpy(e->cw_speed, speeds, e->speeds * sizeof *e->cw_speed);
}

static bool read_evaluation(struct store *store, sqlite3_stmt *s, size_t modes,
                            struct evaluation *e)
{
    if (!evaluation_create(modes, e)) {
        cli_fail("out of memory");
        return false;
    }
    const void *u = sqlite3_column_blob(s, 2);
    if (!u || (size_t)sqlite3_column_bytes(s, 2) != modes * sizeof *e->u) {
        cli_fail("%s: evaluation %lld has no latent point of %zu numbers", store->path,
                 sqlite3_column_int64(s, 0), modes);
        evaluation_free(e);
        return false;
    }
    memcpy(e->u, u, modes * sizeof *e->u);
    e->id = (uint64_t)sqlite3_column_int64(s, 0);
    copy_text(s, 1, e->phase, sizeof e->phase);
    e->failed = sqlite3_column_int(s, 3) != 0;
    copy_text(s, 4, e->stage, sizeof e->stage);
    copy_text(s, 5, e->reason, sizeof e->reason);
    double *const figures[] = {
        &e->cw,        &e->cw_pressure, &e->rw,           &e->share_beyond_cutoff,
        &e->condition, &e->volume,      &e->volume_ratio, &e->wetted_area,
        &e->bound};
    for (int k = 0; k < 9; k++)
        *figures[k] = store_column(s, 6 + k);
    e->dofs = (size_t)sqlite3_column_int64(s, 15);
    e->propose_seconds = store_column(s, 16);
    e->geometry_seconds = store_column(s, 17);
    e->solve_seconds = store_column(s, 18);
    read_speeds(s, e);
    return true;
}

int store_find_evaluation(struct store *store, uint64_t id, size_t modes, struct evaluation *e)
{
    sqlite3_stmt *s = store_prepare(store, "SELECT * FROM hullopt_evaluation WHERE id = ?1");
    if (!s)
        return -1;
    sqlite3_bind_int64(s, 1, (sqlite3_int64)id);
    int step = sqlite3_step(s), found = 0;
    if (step == SQLITE_ROW)
        found = read_evaluation(store, s, modes, e) ? 1 : -1;
    else if (step != SQLITE_DONE)
        found = store_report(store) ? 0 : -1;
    sqlite3_finalize(s);
    return found;
}

static bool count_rows(struct store *store, const char *sql, size_t *n)
{
    sqlite3_stmt *s = store_prepare(store, sql);
    bool ok = s && sqlite3_step(s) == SQLITE_ROW;
    *n = ok ? (size_t)sqlite3_column_int64(s, 0) : 0;
    sqlite3_finalize(s);
    return ok;
}

bool store_list_evaluations(struct store *store, size_t modes, struct evaluation **list, size_t *n)
{
    size_t rows;
    *list = NULL;
    *n = 0;
    if (!count_rows(store, "SELECT count(*) FROM hullopt_evaluation", &rows))
        return false;
    *list = calloc(rows + 1, sizeof **list);
    sqlite3_stmt *s =
        *list ? store_prepare(store, "SELECT * FROM hullopt_evaluation ORDER BY id") : NULL;
    bool ok = s != NULL;
    while (ok && *n < rows && sqlite3_step(s) == SQLITE_ROW)
        if ((ok = read_evaluation(store, s, modes, &(*list)[*n])))
            ++*n;
    sqlite3_finalize(s);
    return ok;
}

bool store_put_verification(struct store *store, size_t position, const struct verification *v)
{
    sqlite3_stmt *s = store_prepare(store, "INSERT OR REPLACE INTO hullopt_verification VALUES (?1,"
                                           " ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13,"
                                           " ?14, ?15)");
    if (!s)
        return false;
    sqlite3_bind_int64(s, 1, (sqlite3_int64)position);
    bind_text(s, 2, v->group);
    bind_text(s, 3, v->label);
    bind_text(s, 4, v->formulation);
    store_bind(s, 5, v->froude);
    sqlite3_bind_int(s, 6, v->refine);
    store_bind(s, 7, v->stern_length);
    store_bind(s, 8, v->cw_parent);
    store_bind(s, 9, v->cw_best);
    store_bind(s, 10, v->cw_pressure_parent);
    store_bind(s, 11, v->cw_pressure_best);
    sqlite3_bind_int64(s, 12, (sqlite3_int64)v->dofs_parent);
    sqlite3_bind_int64(s, 13, (sqlite3_int64)v->dofs_best);
    store_bind(s, 14, v->seconds);
    bind_text(s, 15, v->note);
    return store_finish(store, s);
}

static void read_verification(sqlite3_stmt *s, struct verification *v)
{
    copy_text(s, 1, v->group, sizeof v->group);
    copy_text(s, 2, v->label, sizeof v->label);
    copy_text(s, 3, v->formulation, sizeof v->formulation);
    v->froude = store_column(s, 4);
    v->refine = sqlite3_column_int(s, 5);
    v->stern_length = store_column(s, 6);
    v->cw_parent = store_column(s, 7);
    v->cw_best = store_column(s, 8);
    v->cw_pressure_parent = store_column(s, 9);
    v->cw_pressure_best = store_column(s, 10);
    v->dofs_parent = (size_t)sqlite3_column_int64(s, 11);
    v->dofs_best = (size_t)sqlite3_column_int64(s, 12);
    v->seconds = store_column(s, 13);
    copy_text(s, 14, v->note, sizeof v->note);
}

bool store_list_verifications(struct store *store, struct verification **list, size_t *n)
{
    size_t rows;
    *list = NULL;
    *n = 0;
    if (!count_rows(store, "SELECT count(*) FROM hullopt_verification", &rows))
        return false;
    *list = calloc(rows + 1, sizeof **list);
    sqlite3_stmt *s =
        *list ? store_prepare(store, "SELECT * FROM hullopt_verification ORDER BY position") : NULL;
    while (s && *n < rows && sqlite3_step(s) == SQLITE_ROW)
        read_verification(s, &(*list)[(*n)++]);
    sqlite3_finalize(s);
    return s != NULL;
}
