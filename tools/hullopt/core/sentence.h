/* How the core reports a failure: it prints nothing, returns core_fail("%s: ...", path) and leaves
 * the sentence to its caller. */
#ifndef HULLOPT_SENTENCE_H
#define HULLOPT_SENTENCE_H

#include <signal.h>
#include <stdbool.h>

enum { SENTENCE_SIZE = 512 };

/* Keeps the sentence for this thread and returns false. */
__attribute__((format(printf, 1, 2))) bool core_fail(const char *format, ...);
bool core_no_memory(void);
/* Whether a call of a library went well, by the status that it returned; if not, as core_fail(). */
__attribute__((format(printf, 2, 3))) bool core_ok(int status, const char *format, ...);
/* Whether, since it was asked last, a failure was for want of memory, which says nothing of what
 * was computed. */
bool core_lacked_memory(void);
/* Of the last failure; borrowed until the next. */
const char *core_sentence(void);

/* How far a stage is, 0..1, to whoever watches. */
typedef void (*core_progress)(void *user_data, const char *stage, double fraction,
                              const char *detail);
struct core_watch {
    core_progress show;                                  /* NULL: nobody */
    void (*tell)(void *user_data, const char *sentence); /* a line of a log; NULL: nobody */
    const volatile sig_atomic_t *stop; /* not 0: end before the next solve; NULL: never */
    void *user_data;
};
void core_show(const struct core_watch *watch, const char *stage, double fraction,
               const char *detail);
__attribute__((format(printf, 2, 3))) void core_tell(const struct core_watch *watch,
                                                     const char *format, ...);
/* False, with a sentence, once the run is asked to stop. */
bool core_goes_on(const struct core_watch *watch);

#endif
