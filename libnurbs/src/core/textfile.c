#include "core/textfile.h"

#include "core/error.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void numeric_locale_set(numeric_locale *scope)
{
    scope->plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    scope->before = scope->plain ? uselocale(scope->plain) : (locale_t)0;
}

void numeric_locale_restore(numeric_locale *scope)
{
    if (scope->plain) {
        uselocale(scope->before);
        freelocale(scope->plain);
        scope->plain = (locale_t)0;
    }
}

/* Far beyond any hull, far below what would fill a machine. */
static const size_t MOST_BYTES = (size_t)512 << 20;

/* The whole stream and a terminating zero in *text, which the caller frees also on failure. */
static nurbs_status read_stream(FILE *stream, const char *path, char **text, size_t *length)
{
    size_t room = 0, got = 1;
    while (got > 0) {
        if (*length + 1 >= room) {
            if (room > MOST_BYTES)
                return nurbs_fail(NURBS_ERROR_FILE, "%s: more than %zu bytes, too many for a hull",
                                  path, MOST_BYTES);
            size_t more = room ? 2 * room : 65536;
            char *larger = realloc(*text, more);
            if (!larger)
                return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu bytes", path, more);
            *text = larger;
            room = more;
        }
        got = fread(*text + *length, 1, room - *length - 1, stream);
        *length += got;
    }
    if (ferror(stream))
        return nurbs_fail(NURBS_ERROR_FILE, "%s: %s", path, strerror(errno));
    (*text)[*length] = '\0';
    return NURBS_OK;
}

static void drop_byte_order_mark(char *text, size_t *length)
{
    if (*length < 3 || memcmp(text, "\xef\xbb\xbf", 3) != 0)
        return;
    *length -= 3;
    memmove(text, text + 3, *length + 1);
}

nurbs_status textfile_read(const char *path, char **text, size_t *length)
{
    *text = NULL;
    *length = 0;
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return nurbs_fail(errno == ENOMEM ? NURBS_ERROR_MEMORY : NURBS_ERROR_FILE, "%s: %s", path,
                          strerror(errno));
    struct stat info;
    nurbs_status status = NURBS_OK;
    if (fstat(fileno(stream), &info) == 0 && S_ISREG(info.st_mode) &&
        info.st_size > (off_t)MOST_BYTES)
        status = nurbs_fail(NURBS_ERROR_FILE, "%s: %lld bytes, expected at most %zu", path,
                            (long long)info.st_size, MOST_BYTES);
    if (status == NURBS_OK)
        status = read_stream(stream, path, text, length);
    fclose(stream);
    if (status == NURBS_OK) {
        drop_byte_order_mark(*text, length);
        return NURBS_OK;
    }
    free(*text);
    *text = NULL;
    *length = 0;
    return status;
}

static nurbs_status report(outfile *file, const char *path, int reason)
{
    nurbs_status status = nurbs_fail(reason == ENOMEM ? NURBS_ERROR_MEMORY : NURBS_ERROR_FILE,
                                     "%s: cannot be written: %s", path, strerror(reason));
    outfile_abandon(file);
    return status;
}

/* Devices, FIFOs and whatever stands for an open stream take bytes as they come; a name beside them
 * would not reach whom they lead to. */
static bool is_stream(const char *path)
{
    struct stat info;
    return strncmp(path, "/dev/std", 8) == 0 || strncmp(path, "/dev/fd/", 8) == 0 ||
           strncmp(path, "/proc/", 6) == 0 ||
           (stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode));
}

/* The name that a chain of symbolic links ends in, also one that does not exist yet. NULL with
 * errno set. */
static char *follow_links(const char *path)
{
    enum { MOST_LINKS = 40 };
    char link[PATH_MAX], *target = strdup(path);
    for (int k = 0; target; k++) {
        ssize_t length = readlink(target, link, sizeof link - 1);
        if (length < 0)
            return target; /* no link, or nothing there */
        if (k == MOST_LINKS) {
            free(target);
            errno = ELOOP;
            return NULL;
        }
        link[length] = '\0';
        const char *slash = link[0] == '/' ? NULL : strrchr(target, '/');
        size_t folder = slash ? (size_t)(slash - target) + 1 : 0;
        char *next = malloc(folder + (size_t)length + 1);
        if (next) {
            memcpy(next, target, folder);
            memcpy(next + folder, link, (size_t)length + 1);
        }
        free(target);
        target = next;
    }
    errno = ENOMEM;
    return NULL;
}

/* A successor beside file->path, with the rights of what it replaces, else readable by all as the
 * usual mask would have it. */
static int open_temporary(outfile *file)
{
    struct stat target;
    bool exists = stat(file->path, &target) == 0;
    if (exists && S_ISDIR(target.st_mode)) {
        errno = EISDIR;
        return -1;
    }
    if (exists && access(file->path, W_OK) != 0)
        return -1;
    size_t length = strlen(file->path);
    char *temporary = malloc(length + sizeof ".XXXXXX");
    if (!temporary) {
        errno = ENOMEM;
        return -1;
    }
    memcpy(temporary, file->path, length);
    memcpy(temporary + length, ".XXXXXX", sizeof ".XXXXXX");
    int descriptor = mkstemp(temporary);
    if (descriptor < 0) {
        int reason = errno;
        free(temporary);
        errno = reason;
        return -1;
    }
    file->temporary = temporary;
    if (fchmod(descriptor, exists ? target.st_mode & 0777 : 0644) != 0)
        errno = 0;
    return descriptor;
}

nurbs_status outfile_open(outfile *file, const char *path)
{
    bool stream = is_stream(path);
    *file = (outfile){.path = stream ? strdup(path) : follow_links(path)};
    numeric_locale_set(&file->locale);
    int descriptor = -1;
    if (file->path)
        descriptor = stream ? open(path, O_WRONLY | O_APPEND) : open_temporary(file);
    if (descriptor >= 0 && (file->stream = fdopen(descriptor, "w")))
        return NURBS_OK;
    int reason = errno;
    if (descriptor >= 0)
        close(descriptor);
    return report(file, path, reason);
}

nurbs_status outfile_commit(outfile *file)
{
    bool good = !ferror(file->stream);
    int reason = EIO; /* of a failure before, whose errno is lost */
    if (fflush(file->stream) != 0 ||
        (good && file->temporary && fsync(fileno(file->stream)) != 0)) {
        good = false;
        reason = errno;
    }
    if (fclose(file->stream) != 0 && good) {
        good = false;
        reason = errno;
    }
    file->stream = NULL;
    if (good && file->temporary && rename(file->temporary, file->path) != 0) {
        good = false;
        reason = errno;
    }
    if (!good)
        return report(file, file->path, reason);
    free(file->temporary);
    file->temporary = NULL;
    outfile_abandon(file);
    return NURBS_OK;
}

void outfile_abandon(outfile *file)
{
    if (file->stream)
        fclose(file->stream);
    if (file->temporary)
        unlink(file->temporary);
    free(file->temporary);
    free(file->path);
    file->path = file->temporary = NULL;
    file->stream = NULL;
    numeric_locale_restore(&file->locale);
}
