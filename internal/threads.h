/* How many threads a call starts, of OpenMP and of the BLAS. Compiled into each library that has
 * `threads` among its options. */
#ifndef THREADS_H
#define THREADS_H

#include <stdbool.h>

enum { MOST_THREADS = 1024 };

/* What a call found when it set its number. */
struct threads {
    int openmp;
    bool blas; /* set */
};

/* Until the end of the block parallel loops of this thread start so many threads, and so does the
 * BLAS of the whole process, which has one number: 0, as OpenMP and the BLAS decide. One in a child
 * of fork() whose parent had started several: GNU OpenMP would wait there for threads that the
 * child does not have. */
#define THREADS(wanted)                                                                            \
    __attribute__((cleanup(threads_restore), unused)) struct threads threads_before =              \
        threads_enter(wanted)

struct threads threads_enter(int wanted);
void threads_restore(const struct threads *before);

/* Whether a member of options that is a double may be given to THREADS(). */
static inline bool threads_are(double wanted)
{
    return wanted >= 0 && wanted <= MOST_THREADS && wanted == (int)wanted;
}

/* What a loop gets now. */
int threads_at_hand(void);

/* Whether this is the thread of a team that started it, or there is no team. */
bool threads_first(void);

#endif
