/* What the two preloaded libraries do alike: the count, which begins with main() and is written to
 * FAULT_COUNT when the program ends. */
#ifndef FAULT_START_H
#define FAULT_START_H

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static atomic_bool armed;
static atomic_ulong count;
static unsigned long fault_at; /* 0: none fails */

/* Of the library that includes this: just before main(). */
static void prepare(void);

static void trace(void)
{
    void *calls[40];
    if (!getenv("FAULT_TRACE"))
        return;
    atomic_store(&armed, false);
    backtrace_symbols_fd(calls, backtrace(calls, 40), STDERR_FILENO);
    atomic_store(&armed, true);
}

static void write_count(void)
{
    atomic_store(&armed, false);
    const char *path = getenv("FAULT_COUNT");
    int file = path ? open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644) : -1;
    if (file < 0)
        return;
    char text[32];
    int length = snprintf(text, sizeof text, "%lu\n", atomic_load(&count));
    if (write(file, text, (size_t)length) != length)
        _exit(99);
    close(file);
}

typedef int main_function(int, char **, char **);
static main_function *real_main;

static int armed_main(int argc, char **argv, char **environment)
{
    const char *at = getenv("FAULT_AT");
    void *calls[1];
    backtrace(calls, 1); /* which allocates when first called */
    fault_at = at ? strtoul(at, NULL, 10) : 0;
    prepare();
    atexit(write_count);
    atomic_store(&armed, true);
    return real_main(argc, argv, environment);
}

int __libc_start_main(main_function *main, int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end);
int __libc_start_main(main_function *main, int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end)
{
    typedef int start_function(main_function *, int, char **, void (*)(void), void (*)(void),
                               void (*)(void), void *);
    start_function *start;
    *(void **)&start = dlsym(RTLD_NEXT, "__libc_start_main");
    real_main = main;
    return start(armed_main, argc, argv, init, fini, rtld_fini, stack_end);
}

#endif
