/**
 * @file store.h
 * What a store keeps beside the history: named texts and arrays of a run, attributes of its
 * evaluations, and rows of tables that the caller names. It is the whole record of a run: no second
 * file, no SQL.
 *
 *     bayesopt_attribute told[] = {{.name = "volume", .number = 0.76},
 *                                  {.name = "mesh", .text = "36 x 13"}};
 *     bayesopt_tell_result(bo, id, &(bayesopt_result){.f = f, .n_attributes = 2,
 *                                                     .attributes = told});
 *     ...
 *     bayesopt_get(bo, i, &point);
 *     volume = bayesopt_attribute_number(point.n_attributes, point.attributes, "volume");
 *
 * Every put is a transaction of its own and is on disk when the call returns. Names are the
 * caller's, not empty. All calls need an open store (bayesopt_open_store(), bayesopt_open(),
 * bayesopt_open_read()); the puts need one that may be written. Without one they return
 * BAYESOPT_ERROR_ARGUMENT.
 */
#ifndef BAYESOPT_STORE_H
#define BAYESOPT_STORE_H

#include <bayesopt/status.h>

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bayesopt bayesopt;

/** A named number, or a named text. */
typedef struct bayesopt_attribute {
    const char *name; /**< not empty, once in its list */
    double number;    /**< any, NAN too; ignored beside a text */
    const char *text; /**< NULL: a number */
} bayesopt_attribute;

/** The number called @p name; NAN if there is none. */
BAYESOPT_API double bayesopt_attribute_number(size_t n, const bayesopt_attribute *attributes,
                                              const char *name);
/** The text called @p name, borrowed from the list; "" if there is none. */
BAYESOPT_API const char *bayesopt_attribute_text(size_t n, const bayesopt_attribute *attributes,
                                                 const char *name);

/** Keeps a text, in place of what had the name. */
BAYESOPT_API bayesopt_status bayesopt_store_put_text(bayesopt *bo, const char *name,
                                                     const char *text);
/** Creates a copy of a text, to be released with free(); *text is NULL if there is none. */
BAYESOPT_API bayesopt_status bayesopt_store_get_text(const bayesopt *bo, const char *name,
                                                     char **text);

/** Keeps an array, in place of what had the name; values [rows x columns], row by row, any bits. */
BAYESOPT_API bayesopt_status bayesopt_store_put_array(bayesopt *bo, const char *name, size_t rows,
                                                      size_t columns, const double *values);
/** Creates a copy of an array with the bits that were put, to be released with free(); *values is
 * NULL, and the sizes are 0, if there is none. */
BAYESOPT_API bayesopt_status bayesopt_store_get_array(const bayesopt *bo, const char *name,
                                                      size_t *rows, size_t *columns,
                                                      double **values);

/** Keeps a row of a table, in place of what had its number. Rows may have different attributes. */
BAYESOPT_API bayesopt_status bayesopt_store_put_row(bayesopt *bo, const char *table, size_t row,
                                                    size_t n, const bayesopt_attribute *attributes);

/** A copy of a table. */
typedef struct bayesopt_table bayesopt_table;

/** Creates a copy of a table, rows by increasing number, to be released with
 * bayesopt_table_free(). A table without rows is no error. */
BAYESOPT_API bayesopt_status bayesopt_store_get_table(const bayesopt *bo, const char *table,
                                                      bayesopt_table **out);
/** Frees a table; takes NULL. */
BAYESOPT_API void bayesopt_table_free(bayesopt_table *table);
/** Number of rows. */
BAYESOPT_API size_t bayesopt_table_rows(const bayesopt_table *table);
/** Number of attributes of row i, in the order they were put; *attributes is borrowed from the
 * table. 0 and NULL beyond the last row. */
BAYESOPT_API size_t bayesopt_table_row(const bayesopt_table *table, size_t i,
                                       const bayesopt_attribute **attributes);

#ifdef __cplusplus
}
#endif

#endif
