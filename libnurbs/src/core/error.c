#include "core/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static _Thread_local char last_error[512];

const char *nurbs_status_string(nurbs_status status)
{
    switch (status) {
#define NURBS_STATUS_TEXT(name, value, text)                                                       \
    case name:                                                                                     \
        return text;
        NURBS_STATUS_LIST(NURBS_STATUS_TEXT)
#undef NURBS_STATUS_TEXT
    }
    return "unknown status";
}

const char *nurbs_last_error(void)
{
    return last_error;
}

const char *nurbs_version(void)
{
    return NURBS_VERSION_STRING;
}

nurbs_status nurbs_fail(nurbs_status code, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(last_error, sizeof last_error, format, args);
    va_end(args);
    return code;
}

nurbs_status nurbs_fail_in(nurbs_status code, const char *where)
{
    char sentence[sizeof last_error];
    memcpy(sentence, last_error, sizeof sentence);
    return nurbs_fail(code, "%s: %s", where, sentence);
}
