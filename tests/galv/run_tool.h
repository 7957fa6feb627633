/* Runs the galv command and takes what it prints. */
#ifndef TESTS_GALV_RUN_TOOL_H
#define TESTS_GALV_RUN_TOOL_H

#include <jansson.h>
#include <stddef.h>

struct run {
    int code;     /* exit code, -1 when it did not exit */
    char *output; /* standard output */
    char *errors; /* standard error */
};

/* Arguments as in a shell; files named without a folder are in a scratch folder of this process. */
struct run run_tool(const char *arguments);
void run_free(struct run *run);

/* Runs, expects exit code 0 and one JSON object on stdout. The caller owns it. */
json_t *run_json(const char *arguments);

/* Path of a file in the scratch folder; valid until the next call. */
const char *scratch(const char *name);
void scratch_write(const char *name, const char *text);
void scratch_remove_all(void);

#endif
