#include "core/error.h"

#include <lapacke.h>
#include <stdarg.h>
#include <stdio.h>

static _Thread_local char last_error[512];

const char *igabem_status_string(igabem_status status)
{
    switch (status) {
#define IGABEM_STATUS_TEXT(name, value, text)                                                      \
    case name:                                                                                     \
        return text;
        IGABEM_STATUS_LIST(IGABEM_STATUS_TEXT)
#undef IGABEM_STATUS_TEXT
    }
    return "unknown status";
}

const char *igabem_last_error(void)
{
    return last_error;
}

const char *igabem_version(void)
{
    return IGABEM_VERSION_STRING;
}

igabem_status igabem_fail(igabem_status code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(last_error, sizeof last_error, format, args);
    va_end(args);
    return code;
}

igabem_status igabem_fail_lapack(const char *what, int info)
{
    if (info == LAPACK_WORK_MEMORY_ERROR || info == LAPACK_TRANSPOSE_MEMORY_ERROR)
        return igabem_fail(IGABEM_ERROR_MEMORY, "no memory for LAPACK: %s", what);
    return igabem_fail(IGABEM_ERROR_NUMERIC, "%s: LAPACK ends with %d, %s", what, info,
                       info > 0 ? "the matrix is singular" : "a number is not finite");
}
