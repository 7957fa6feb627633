#include "core/sentence.h"

#include <bayesopt/status.h>
#include <galv/status.h>
#include <igabem/status.h>
#include <nurbs/status.h>

#include <stdarg.h>
#include <stdio.h>

/* The libraries' statuses have the same numbers. */
_Static_assert((int)NURBS_ERROR_MEMORY == (int)GALV_ERROR_MEMORY &&
                   (int)NURBS_ERROR_MEMORY == (int)IGABEM_ERROR_MEMORY &&
                   (int)NURBS_ERROR_MEMORY == (int)BAYESOPT_ERROR_MEMORY,
               "one number for want of memory");
enum { NO_MEMORY = NURBS_ERROR_MEMORY };

static _Thread_local char sentence[SENTENCE_SIZE];
static _Thread_local bool lacked_memory;

static void keep(const char *format, va_list args)
{
    char made[SENTENCE_SIZE]; /* the arguments may hold the last one */
    vsnprintf(made, sizeof made, format, args);
    snprintf(sentence, sizeof sentence, "%s", made);
}

bool core_fail(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    keep(format, args);
    va_end(args);
    return false;
}

bool core_no_memory(void)
{
    lacked_memory = true;
    return core_fail("out of memory");
}

bool core_ok(int status, const char *format, ...)
{
    if (status == 0)
        return true;
    va_list args;
    va_start(args, format);
    keep(format, args);
    va_end(args);
    lacked_memory = lacked_memory || status == NO_MEMORY;
    return false;
}

bool core_lacked_memory(void)
{
    bool lacked = lacked_memory;
    lacked_memory = false;
    return lacked;
}

const char *core_sentence(void)
{
    return sentence;
}

void core_show(const struct core_watch *watch, const char *stage, double fraction,
               const char *detail)
{
    if (watch->show)
        watch->show(watch->user_data, stage, fraction, detail);
}

void core_tell(const struct core_watch *watch, const char *format, ...)
{
    char line[SENTENCE_SIZE];
    va_list args;
    if (!watch->tell)
        return;
    va_start(args, format);
    vsnprintf(line, sizeof line, format, args);
    va_end(args);
    watch->tell(watch->user_data, line);
}

bool core_goes_on(const struct core_watch *watch)
{
    return !watch->stop || !*watch->stop || core_fail("stopped");
}
