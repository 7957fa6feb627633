#include "store_edits.h"

#include "target.h"

#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_COLUMNS = 400, MOST_EDITS = 8 };

/* Every column of every table, and what tells the rows of the table apart. */
static struct column {
    char table[80], name[80], key[200];
} columns[MOST_COLUMNS];
static size_t n_columns;

static char *store;
static size_t store_size;

static void load(void)
{
    const char *name = getenv("FUZZ_STORE");
    FILE *stream = name ? fopen(name, "rb") : NULL;
    demand(stream != NULL, "FUZZ_STORE names a store");
    fseek(stream, 0, SEEK_END);
    store_size = (size_t)ftell(stream);
    rewind(stream);
    store = malloc(store_size);
    demand(store && fread(store, 1, store_size, stream) == store_size, "the store can be read");
    fclose(stream);
}

static void list_columns(sqlite3 *db)
{
    sqlite3_stmt *s = NULL;
    sqlite3_prepare_v2(
        db,
        "SELECT m.name, c.name, coalesce((SELECT group_concat(name) FROM pragma_table_info(m.name) "
        "WHERE pk > 0), 'rowid') FROM sqlite_master m, pragma_table_info(m.name) c "
        "WHERE m.type = 'table' ORDER BY 1, 2",
        -1, &s, NULL);
    while (n_columns < MOST_COLUMNS && sqlite3_step(s) == SQLITE_ROW) {
        struct column *c = &columns[n_columns++];
        snprintf(c->table, sizeof c->table, "%s", (const char *)sqlite3_column_text(s, 0));
        snprintf(c->name, sizeof c->name, "%s", (const char *)sqlite3_column_text(s, 1));
        snprintf(c->key, sizeof c->key, "%s", (const char *)sqlite3_column_text(s, 2));
    }
    sqlite3_finalize(s);
    demand(n_columns > 0, "the store has tables");
}

/* The value of one edit; what is left of the bytes is the rest. */
static void bind(sqlite3_stmt *s, int kind, size_t *n, const uint8_t **bytes)
{
    double number = 0;
    size_t length = *n < sizeof number ? *n : sizeof number, rest = *n < 64 ? *n : 64;
    memcpy(&number, *bytes, length);
    switch (kind % 6) {
    case 0: /* nothing */
        break;
    case 1:
        sqlite3_bind_int64(s, 1, length ? (int8_t) * *bytes : 0);
        break;
    case 2:
        sqlite3_bind_double(s, 1, number);
        break;
    case 3:
        sqlite3_bind_text(s, 1, (const char *)*bytes, (int)rest, SQLITE_TRANSIENT);
        length = rest;
        break;
    case 4:
        sqlite3_bind_blob(s, 1, *bytes, (int)rest, SQLITE_TRANSIENT);
        length = rest;
        break;
    default:
        sqlite3_bind_zeroblob(s, 1, (int)(length ? 8 * **bytes : 0));
    }
    *n -= length;
    *bytes += length;
}

/* One edit; false when no bytes are left. */
static bool edit(sqlite3 *db, size_t *n, const uint8_t **bytes)
{
    enum { HEAD = 4, ROWS = 16, REMOVED = 240 };
    if (*n < HEAD)
        return false;
    const uint8_t *head = *bytes;
    const struct column *c = &columns[(head[0] + 256 * (size_t)(head[3] >> 4)) % n_columns];
    bool removed = head[2] > REMOVED;
    char text[800], set[100] = "";
    *bytes += HEAD;
    *n -= HEAD;
    if (!removed)
        snprintf(set, sizeof set, "SET %s = ?1", c->name);
    snprintf(text, sizeof text, "%s %s %s WHERE (%s) IN (SELECT %s FROM %s LIMIT 1 OFFSET %d)",
             removed ? "DELETE FROM" : "UPDATE", c->table, set, c->key, c->key, c->table,
             head[1] % ROWS);
    sqlite3_stmt *s = NULL;
    demand(sqlite3_prepare_v2(db, text, -1, &s, NULL) == SQLITE_OK, sqlite3_errmsg(db));
    if (!removed)
        bind(s, head[3] & 15, n, bytes);
    sqlite3_step(s); /* what a constraint of the schema forbids is not done */
    sqlite3_finalize(s);
    return true;
}

void store_edit(const char *path, size_t n, const uint8_t *bytes)
{
    if (!store)
        load();
    FILE *stream = fopen(path, "wb");
    demand(stream && fwrite(store, 1, store_size, stream) == store_size && fclose(stream) == 0,
           "the store can be written");
    sqlite3 *db = NULL;
    demand(sqlite3_open(path, &db) == SQLITE_OK, "the store can be opened");
    sqlite3_exec(db, "PRAGMA synchronous = OFF; PRAGMA journal_mode = MEMORY; BEGIN", 0, 0, 0);
    if (!n_columns)
        list_columns(db);
    for (int k = 0; k < MOST_EDITS && edit(db, &n, &bytes); k++)
        ;
    sqlite3_exec(db, "COMMIT", 0, 0, 0);
    sqlite3_close(db);
}
