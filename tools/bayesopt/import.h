/* Results from a table: of asked points by their ids, of others by their variables. */
#ifndef BAYESOPT_TOOL_IMPORT_H
#define BAYESOPT_TOOL_IMPORT_H

#include "names.h"

/* Tells every row of a CSV file, also of one that 'bayesopt export' wrote. Nothing is told unless
 * every row is well; prints the sentence with the line at fault. */
bool import_table(bayesopt *bo, const struct names *names, const char *path, bool outside);

#endif
