#include "core/threads.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#ifdef _OPENMP
#include <omp.h>

static atomic_bool started, forked;
static pthread_once_t watched = PTHREAD_ONCE_INIT;

static void in_child(void)
{
    if (atomic_load(&started))
        atomic_store(&forked, true);
}

static void watch(void)
{
    pthread_atfork(NULL, NULL, in_child);
}

int threads_at_hand(void)
{
    int threads = atomic_load(&forked) ? 1 : omp_get_max_threads();
    if (threads > 1) {
        pthread_once(&watched, watch);
        atomic_store(&started, true);
    }
    return threads;
}

int threads_enter(int wanted)
{
    int before = omp_get_max_threads();
    if (wanted > 0 && wanted <= MOST_THREADS)
        omp_set_num_threads(wanted);
    omp_set_num_threads(threads_at_hand());
    return before;
}

void threads_restore(const int *before)
{
    omp_set_num_threads(*before);
}

#else

int threads_at_hand(void)
{
    return 1;
}

int threads_enter(int wanted)
{
    (void)wanted;
    return 1;
}

void threads_restore(const int *before)
{
    (void)before;
}

#endif
