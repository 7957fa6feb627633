#include "error.h"

#include <lapacke.h>
#include <stdarg.h>
#include <stdio.h>

static _Thread_local char last_error[512];

const char *galv_status_string(galv_status status)
{
    switch (status) {
#define GALV_STATUS_TEXT(name, value, text)                                                        \
    case name:                                                                                     \
        return text;
        GALV_STATUS_LIST(GALV_STATUS_TEXT)
#undef GALV_STATUS_TEXT
    }
    return "unknown status";
}

const char *galv_last_error(void)
{
    return last_error;
}

const char *galv_version(void)
{
    return GALV_VERSION_STRING;
}

galv_status galv_fail(galv_status code, const char *format, ...)
{
    va_list args;
    /* Its sentences name what was to be held. */
    int said = code == GALV_ERROR_MEMORY
                   ? snprintf(last_error, sizeof last_error, "%s", "no memory for ")
                   : 0;
    va_start(args, format);
    vsnprintf(last_error + said, sizeof last_error - (size_t)said, format, args);
    va_end(args);
    return code;
}

galv_status galv_lapack(int info, const char *doing)
{
    if (info == 0)
        return GALV_OK;
    if (info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR)
        return galv_fail(GALV_ERROR_MEMORY, "%s: no memory for the work", doing);
    return galv_fail(GALV_ERROR_NUMERIC, "%s: LAPACK gave %d", doing, info);
}
