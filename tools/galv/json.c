#include "json.h"

#include "cli.h"

#include <math.h>
#include <stdio.h>

json_t *json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *json_whole(size_t value)
{
    return json_integer((json_int_t)value);
}

json_t *json_numbers(size_t n, const double *values)
{
    json_t *list = json_array();
    for (size_t i = 0; i < n; i++)
        json_array_append_new(list, json_number(values[i]));
    return list;
}

int json_print(json_t *root)
{
    if (!root)
        return cli_fail("out of memory");
    int failed = json_dumpf(root, stdout, JSON_REAL_PRECISION(17) | JSON_INDENT(1));
    json_decref(root);
    if (failed || putchar('\n') == EOF || fflush(stdout) == EOF)
        return cli_fail("standard output cannot be written");
    return CLI_OK;
}
