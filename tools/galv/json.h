/* JSON as the commands of galv print it. */
#ifndef GALV_TOOL_JSON_H
#define GALV_TOOL_JSON_H

#include <jansson.h>
#include <stddef.h>

/* JSON has no NaN: figures that are not known are null. */
json_t *json_number(double value);
json_t *json_whole(size_t value);
json_t *json_numbers(size_t n, const double *values);

/* Prints the object on stdout and releases it; NULL counts as out of memory. Returns an exit code.
 */
int json_print(json_t *root);

#endif
