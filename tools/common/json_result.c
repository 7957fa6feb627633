#include "json_result.h"

#include "cli.h"

#include <string.h>

/* A command makes its result once and ends: what the first failure was stays true. */
static char lost[80];
static bool incomplete;

static void note_failure(const char *key)
{
    if (incomplete)
        return;
    incomplete = true;
    size_t length = strnlen(key, sizeof lost - 1);
    memcpy(lost, key, length);
    lost[length] = '\0';
}

void json_result_set(json_t *object, const char *key, json_t *value)
{
    if (json_object_set_new(object, key, value) != 0)
        note_failure(key);
}

void json_result_append(json_t *array, json_t *value)
{
    if (json_array_append_new(array, value) != 0)
        note_failure("a list");
}

bool json_result_write(FILE *stream, json_t *root, size_t flags)
{
    bool whole = root && !incomplete;
    if (whole && json_dumpf(root, stream, flags) != 0 && !ferror(stream))
        whole = false; /* a failure of the stream is told with its reason when it is closed */
    if (whole)
        fputc('\n', stream);
    json_decref(root);
    return whole || cli_refuse("the result cannot be told as JSON: no memory, or a number that is "
                               "not finite, at %s",
                               *lost ? lost : "its end");
}

int json_result_print(json_t *root, size_t flags)
{
    return json_result_write(stdout, root, flags) ? cli_printed() : CLI_FAILED;
}
