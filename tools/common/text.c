/* fopencookie() is GNU's; musl and the C library of Android have it too. */
#define _GNU_SOURCE
#include "text.h"

#include <stdlib.h>
#include <string.h>

#ifdef __linux__

struct target {
    char **text;
    size_t *length, room;
};

static ssize_t append(void *cookie, const char *bytes, size_t n)
{
    struct target *t = cookie;
    if (n >= t->room - *t->length) {
        size_t room = 2 * (*t->length + n) + 1;
        char *more = room > n ? realloc(*t->text, room) : NULL;
        if (!more)
            return 0;
        *t->text = more;
        t->room = room;
    }
    memcpy(*t->text + *t->length, bytes, n);
    *t->length += n;
    (*t->text)[*t->length] = '\0';
    return (ssize_t)n;
}

static int end(void *cookie)
{
    free(cookie);
    return 0;
}

FILE *text_open(char **text, size_t *length)
{
    struct target *t = malloc(sizeof *t);
    *text = calloc(1, 1);
    *length = 0;
    FILE *stream = NULL;
    if (t && *text) {
        *t = (struct target){text, length, 1};
        stream = fopencookie(t, "w", (cookie_io_functions_t){.write = append, .close = end});
    }
    if (!stream) {
        free(t);
        free(*text);
        *text = NULL;
    }
    return stream;
}

#else

FILE *text_open(char **text, size_t *length)
{
    return open_memstream(text, length);
}

#endif

char *text_close(FILE *stream, char **text)
{
    int lost = ferror(stream);
    if (fclose(stream) != 0 || lost) {
        free(*text);
        *text = NULL;
    }
    return *text;
}
