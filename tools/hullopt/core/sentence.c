#include "core/sentence.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local char sentence[SENTENCE_SIZE];

bool core_fail(const char *format, ...)
{
    char made[SENTENCE_SIZE]; /* the arguments may hold the last one */
    va_list args;
    va_start(args, format);
    vsnprintf(made, sizeof made, format, args);
    va_end(args);
    snprintf(sentence, sizeof sentence, "%s", made);
    return false;
}

bool core_no_memory(void)
{
    return core_fail("out of memory");
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
