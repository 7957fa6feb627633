/* Preloaded (LD_PRELOAD) into a program: a file system without locks, as some that are mounted over
 * a network. Every fcntl() that would take one answers ENOLCK. Needs glibc. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>

typedef int call(int, int, ...);

static int answer(const char *name, int file, int command, void *argument)
{
    call *real;
    if (command == F_SETLK || command == F_SETLKW || command == F_OFD_SETLK ||
        command == F_OFD_SETLKW) {
        errno = ENOLCK;
        return -1;
    }
    *(void **)&real = dlsym(RTLD_NEXT, name);
    return real(file, command, argument);
}

#define ANSWER(name)                                                                               \
    int name(int file, int command, ...)                                                           \
    {                                                                                              \
        va_list list;                                                                              \
        va_start(list, command);                                                                   \
        void *argument = va_arg(list, void *);                                                     \
        va_end(list);                                                                              \
        return answer(#name, file, command, argument);                                             \
    }

ANSWER(fcntl)
ANSWER(fcntl64)
