#include "threads.h"

#include <cblas.h>
#include <pthread.h>
#include <stdatomic.h>
#ifdef _OPENMP
#include <omp.h>
#endif

/* The number of the BLAS: the first of the calls at work that sets it keeps what it finds, the last
 * one to end puts that back. Each library counts its own calls. */
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static int setters, found;

static void blas_enter(int wanted)
{
    pthread_mutex_lock(&lock);
    if (!setters++)
        found = openblas_get_num_threads();
    openblas_set_num_threads(wanted);
    pthread_mutex_unlock(&lock);
}

static void blas_leave(void)
{
    pthread_mutex_lock(&lock);
    if (!--setters)
        openblas_set_num_threads(found);
    pthread_mutex_unlock(&lock);
}

#ifdef _OPENMP

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

bool threads_first(void)
{
    return omp_get_thread_num() == 0;
}

#else

bool threads_first(void)
{
    return true;
}

int threads_at_hand(void)
{
    return 1;
}

static int omp_get_max_threads(void)
{
    return 1;
}

static void omp_set_num_threads(int threads)
{
    (void)threads;
}

#endif

/* A BLAS that uses OpenMP sets the number of OpenMP too, so it comes first. */
struct threads threads_enter(int wanted)
{
    struct threads before = {omp_get_max_threads(), wanted > 0 && wanted <= MOST_THREADS};
    if (before.blas) {
        blas_enter(wanted);
        omp_set_num_threads(wanted);
    }
    omp_set_num_threads(threads_at_hand());
    return before;
}

void threads_restore(const struct threads *before)
{
    if (before->blas)
        blas_leave();
    omp_set_num_threads(before->openmp);
}
