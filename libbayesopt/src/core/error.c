#include "core/error.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local char last_error[512];

const char *bayesopt_status_string(bayesopt_status status)
{
    switch (status) {
#define BAYESOPT_STATUS_TEXT(name, value, text)                                                    \
    case name:                                                                                     \
        return text;
        BAYESOPT_STATUS_LIST(BAYESOPT_STATUS_TEXT)
#undef BAYESOPT_STATUS_TEXT
    }
    return "unknown status";
}

const char *bayesopt_last_error(void)
{
    return last_error;
}

const char *bayesopt_version(void)
{
    return BAYESOPT_VERSION_STRING;
}

bayesopt_status bayesopt_fail(bayesopt_status code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(last_error, sizeof last_error, format, args);
    va_end(args);
    return code;
}
