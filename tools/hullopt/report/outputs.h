/* The files of a run folder, written anew from the database: summary.json, best.json,
 * best_wetted.json, best.igs, report.html. */
#ifndef HULLOPT_OUTPUTS_H
#define HULLOPT_OUTPUTS_H

#include "report/results.h"

#include <jansson.h>

/* Writes the files into the folder (NULL: none) and prints the summary, as JSON or its figures. On
 * failure prints the sentence. */
bool outputs_write(const struct results *results, const char *folder, bool json);

/* A new object with the contents of summary.json; NULL when memory runs out. */
json_t *summary_make(const struct results *results);

/* The whole page. */
void report_write(FILE *out, const struct results *results);

#endif
