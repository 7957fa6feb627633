/* The files of a run folder, written anew from the database: summary.json, best.json,
 * best_wetted.json, best.igs, report.html. */
#ifndef HULLOPT_OUTPUTS_H
#define HULLOPT_OUTPUTS_H

#include "results.h"

#include <jansson.h>

/* json: the summary goes to standard output too; else the figures as text do. On failure prints the
 * sentence. */
bool outputs_write(struct store *store, const char *folder, bool json);

/* A new object with the contents of summary.json; NULL when memory runs out. */
json_t *summary_make(const struct results *results);

/* The whole page. */
bool report_write(FILE *out, const struct results *results);

#endif
