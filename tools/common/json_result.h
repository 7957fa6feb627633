/* JSON results that are whole or not printed: what could not be added, for want of memory or as a
 * number that is not finite, is remembered and keeps the result back. */
#ifndef TOOLS_JSON_RESULT_H
#define TOOLS_JSON_RESULT_H

#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/* As json_object_set_new() and json_array_append_new(): the value is taken, NULL is a failure. */
void json_result_set(json_t *object, const char *key, json_t *value);
void json_result_append(json_t *array, json_t *value);

/* Releases ROOT and prints it with a newline if it is whole; FLAGS are those of json_dumpf(). The
 * first returns an exit code; the second leaves errors of the stream to whoever closes it. Both say
 * what is wrong. */
int json_result_print(json_t *root, size_t flags);
bool json_result_write(FILE *stream, json_t *root, size_t flags);

#endif
