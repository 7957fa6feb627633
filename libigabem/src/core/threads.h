/* How many threads the parallel loops of a call start. */
#ifndef IGABEM_THREADS_H
#define IGABEM_THREADS_H

enum { MOST_THREADS = 1024 };

/* Until the end of the block parallel loops of this thread start so many threads: 0, as OpenMP
 * decides. One in a child of fork() whose parent had started several: GNU OpenMP would wait there
 * for threads that the child does not have. */
#define THREADS(wanted)                                                                            \
    __attribute__((cleanup(threads_restore))) int threads_before = threads_enter(wanted)

int threads_enter(int wanted); /* returns the number that was set before */
void threads_restore(const int *before);

/* What a loop gets now. */
int threads_at_hand(void);

#endif
