#include "core/textfile.h"

#include "core/error.h"

#include <errno.h>
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

nurbs_status textfile_read(const char *path, char **text, size_t *length)
{
    *text = NULL;
    *length = 0;
    FILE *stream = fopen(path, "rb");
    if (!stream)
        return nurbs_fail(NURBS_ERROR_FILE, "%s: %s", path, strerror(errno));
    size_t room = 0, used = 0, got = 1;
    char *buffer = NULL;
    while (got > 0) {
        if (used + 1 >= room) {
            size_t more = room ? 2 * room : 65536;
            char *larger = realloc(buffer, more);
            if (!larger) {
                free(buffer);
                fclose(stream);
                return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory for %zu bytes", path, more);
            }
            buffer = larger;
            room = more;
        }
        got = fread(buffer + used, 1, room - used - 1, stream);
        used += got;
    }
    int failed = ferror(stream), reason = errno;
    fclose(stream);
    if (failed) {
        free(buffer);
        return nurbs_fail(NURBS_ERROR_FILE, "%s: %s", path, strerror(reason));
    }
    buffer[used] = '\0';
    *text = buffer;
    *length = used;
    return NURBS_OK;
}

static nurbs_status report(outfile *file, const char *path, int reason)
{
    nurbs_status status =
        nurbs_fail(NURBS_ERROR_FILE, "%s: cannot be written: %s", path, strerror(reason));
    outfile_abandon(file);
    return status;
}

nurbs_status outfile_open(outfile *file, const char *path)
{
    size_t length = strlen(path);
    *file = (outfile){.path = malloc(length + 1), .temporary = malloc(length + sizeof ".XXXXXX")};
    if (!file->path || !file->temporary) {
        free(file->path);
        free(file->temporary);
        return nurbs_fail(NURBS_ERROR_MEMORY, "%s: no memory", path);
    }
    memcpy(file->path, path, length + 1);
    memcpy(file->temporary, path, length);
    memcpy(file->temporary + length, ".XXXXXX", sizeof ".XXXXXX");
    numeric_locale_set(&file->locale);
    int descriptor = mkstemp(file->temporary);
    if (descriptor < 0) {
        int reason = errno;
        file->temporary[0] = '\0';
        return report(file, path, reason);
    }
    /* A new file gets the rights of a temporary file; give it those of one made by fopen where the
     * target exists, else readable by all as the usual mask would have it. */
    struct stat target;
    if (fchmod(descriptor, stat(path, &target) == 0 ? target.st_mode & 0777 : 0644) != 0)
        errno = 0;
    file->stream = fdopen(descriptor, "w");
    if (!file->stream) {
        int reason = errno;
        close(descriptor);
        return report(file, path, reason);
    }
    return NURBS_OK;
}

nurbs_status outfile_commit(outfile *file)
{
    int good =
        fflush(file->stream) == 0 && !ferror(file->stream) && fsync(fileno(file->stream)) == 0;
    int reason = errno;
    if (fclose(file->stream) != 0 && good) {
        good = 0;
        reason = errno;
    }
    file->stream = NULL;
    if (good && rename(file->temporary, file->path) != 0) {
        good = 0;
        reason = errno;
    }
    if (!good)
        return report(file, file->path, reason);
    file->temporary[0] = '\0';
    outfile_abandon(file);
    return NURBS_OK;
}

void outfile_abandon(outfile *file)
{
    if (file->stream)
        fclose(file->stream);
    if (file->temporary && file->temporary[0])
        unlink(file->temporary);
    free(file->temporary);
    free(file->path);
    file->path = file->temporary = NULL;
    file->stream = NULL;
    numeric_locale_restore(&file->locale);
}
