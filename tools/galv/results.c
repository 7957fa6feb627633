#include "results.h"

#include "cli.h"
#include "json.h"

#include <stdio.h>

static int print_csv(size_t rows, const char *prefix, size_t width, const double *values,
                     size_t extras, const char *const *names, const double *more)
{
    for (size_t k = 0; k < width; k++)
        printf("%s%s%zu", k ? "," : "", prefix, k + 1);
    for (size_t k = 0; k < extras; k++)
        printf(",%s", names[k]);
    for (size_t r = 0; r < rows; r++) {
        for (size_t k = 0; k < width; k++)
            printf("%c%.17g", k ? ',' : '\n', values[r * width + k]);
        for (size_t k = 0; k < extras; k++)
            printf(",%.17g", more[r * extras + k]);
    }
    putchar('\n');
    return fflush(stdout) == EOF ? cli_fail("standard output cannot be written") : CLI_OK;
}

int results_print(bool json, size_t rows, const char *prefix, size_t width, const double *values,
                  size_t extras, const char *const *names, const double *more)
{
    if (!json)
        return print_csv(rows, prefix, width, values, extras, names, more);
    json_t *list = json_array();
    char name[32];
    for (size_t r = 0; r < rows; r++) {
        json_t *row = json_object();
        for (size_t k = 0; k < width; k++) {
            snprintf(name, sizeof name, "%s%zu", prefix, k + 1);
            json_object_set_new(row, name, json_number(values[r * width + k]));
        }
        for (size_t k = 0; k < extras; k++)
            json_object_set_new(row, names[k], json_number(more[r * extras + k]));
        json_array_append_new(list, row);
    }
    return json_print(json_pack("{s:o}", "rows", list));
}
