#include "cli.h"
#include "store_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool store_put_array(struct store *store, const char *name, size_t rows, size_t columns,
                     const double *values)
{
    sqlite3_stmt *s =
        store_prepare(store, "INSERT OR REPLACE INTO hullopt_array VALUES (?1, ?2, ?3, ?4)");
    if (!s)
        return false;
    sqlite3_bind_text(s, 1, name, -1, SQLITE_STATIC);
    sqlite3_bind_int64(s, 2, (sqlite3_int64)rows);
    sqlite3_bind_int64(s, 3, (sqlite3_int64)columns);
    sqlite3_bind_blob64(s, 4, values, rows * columns * sizeof *values, SQLITE_STATIC);
    return store_finish(store, s);
}

double *store_get_array(struct store *store, const char *name, size_t *rows, size_t *columns)
{
    sqlite3_stmt *s =
        store_prepare(store, "SELECT rows, columns, data FROM hullopt_array WHERE name = ?1");
    if (!s)
        return NULL;
    sqlite3_bind_text(s, 1, name, -1, SQLITE_STATIC);
    double *values = NULL;
    if (sqlite3_step(s) == SQLITE_ROW) {
        *rows = (size_t)sqlite3_column_int64(s, 0);
        *columns = (size_t)sqlite3_column_int64(s, 1);
        const void *blob = sqlite3_column_blob(s, 2);
        size_t bytes = (size_t)sqlite3_column_bytes(s, 2);
        if (blob && bytes == *rows * *columns * sizeof *values)
            values = malloc(bytes);
        if (values)
            memcpy(values, blob, bytes);
    }
    sqlite3_finalize(s);
    return values;
}

/* The arrays of a latent space and the row that holds its sizes and totals. */
bool store_put_latent(struct store *store, const struct latent *l)
{
    const double head[] = {
        (double)l->modes,      (double)l->coordinates, (double)l->spectrum, (double)l->samples,
        (double)l->parameters, (double)l->active,      l->retained,         l->trace};
    return store_put_array(store, "latent", 1, sizeof head / sizeof *head, head) &&
           store_put_array(store, "latent.eigenvalues", 1, l->spectrum, l->eigenvalues) &&
           store_put_array(store, "latent.mse", 1, l->spectrum, l->mse) &&
           store_put_array(store, "latent.vectors", l->modes, l->coordinates, l->vectors) &&
           store_put_array(store, "latent.mean", 1, l->coordinates, l->mean) &&
           store_put_array(store, "latent.lower", 1, l->modes, l->lower) &&
           store_put_array(store, "latent.upper", 1, l->modes, l->upper);
}

static bool fetch(struct store *store, const char *name, size_t rows, size_t columns, double *out)
{
    size_t r = 0, c = 0;
    double *values = store_get_array(store, name, &r, &c);
    bool ok = values && r == rows && c == columns;
    if (ok)
        memcpy(out, values, rows * columns * sizeof *out);
    free(values);
    return ok;
}

bool store_get_latent(struct store *store, struct latent *l)
{
    double head[8];
    *l = (struct latent){0};
    bool ok = fetch(store, "latent", 1, 8, head);
    if (ok) {
        *l = (struct latent){.modes = (size_t)head[0],
                             .coordinates = (size_t)head[1],
                             .spectrum = (size_t)head[2],
                             .samples = (size_t)head[3],
                             .parameters = (size_t)head[4],
                             .active = (size_t)head[5],
                             .retained = head[6],
                             .trace = head[7]};
        ok = latent_allocate(l) &&
             fetch(store, "latent.eigenvalues", 1, l->spectrum, l->eigenvalues) &&
             fetch(store, "latent.mse", 1, l->spectrum, l->mse) &&
             fetch(store, "latent.vectors", l->modes, l->coordinates, l->vectors) &&
             fetch(store, "latent.mean", 1, l->coordinates, l->mean) &&
             fetch(store, "latent.lower", 1, l->modes, l->lower) &&
             fetch(store, "latent.upper", 1, l->modes, l->upper);
    }
    if (!ok) {
        cli_fail("%s: the latent space is missing or incomplete", store->path);
        latent_free(l);
    }
    return ok;
}
