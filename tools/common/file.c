#include "cli.h"
#include "text.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_LINKS = 40, MOST_FILES = 16 };

/* What is being written, so that the end of the command can remove it. */
static const char *unfinished[MOST_FILES];

static void replace_unfinished(const char *from, const char *to)
{
    for (size_t k = 0; k < MOST_FILES; k++)
        if (unfinished[k] == from) {
            unfinished[k] = to;
            return;
        }
}

void cli_files_remove(void)
{
    for (size_t k = 0; k < MOST_FILES; k++)
        if (unfinished[k])
            unlink(unfinished[k]);
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

/* The stream itself where the path names one of the program's own, so that what comes before and
 * after in the same file stays; -1: another path. */
static int own_descriptor(const char *path)
{
    size_t number;
    if (strcmp(path, "/dev/stdout") == 0)
        return STDOUT_FILENO;
    if (strcmp(path, "/dev/stderr") == 0)
        return STDERR_FILENO;
    bool named = strncmp(path, "/dev/fd/", 8) == 0 && cli_parse_size(path + 8, &number);
    return named && number <= INT_MAX ? (int)number : -1;
}

static int open_stream(const char *path)
{
    int own = own_descriptor(path);
    return own >= 0 ? dup(own) : open(path, O_WRONLY | O_APPEND);
}

/* The name that a chain of symbolic links ends in, also one that does not exist yet. NULL with
 * errno set; the caller frees. */
static char *follow_links(const char *path)
{
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

/* An unnamed successor beside file->path, with the rights of what it replaces. */
static int open_temporary(struct cli_file *file)
{
    struct stat info;
    bool exists = stat(file->path, &info) == 0;
    if (exists && S_ISDIR(info.st_mode)) {
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
    replace_unfinished(NULL, temporary);
    mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, exists ? info.st_mode & 07777 : 0666 & ~mask);
    return descriptor;
}

bool cli_file_open(struct cli_file *file, const char *path)
{
    bool stream = is_stream(path);
    *file = (struct cli_file){.path = stream ? strdup(path) : follow_links(path)};
    int descriptor = -1;
    if (file->path)
        descriptor = stream ? open_stream(path) : open_temporary(file);
    if (descriptor >= 0 && (file->stream = fdopen(descriptor, "w")))
        return true;
    int reason = errno;
    if (descriptor >= 0)
        close(descriptor);
    cli_file_abandon(file);
    errno = reason;
    return false;
}

/* The rename itself must survive a power cut: sync the folder that holds the name. */
static void sync_folder(char *path)
{
    char *slash = strrchr(path, '/');
    if (slash)
        slash[slash == path] = '\0';
    int folder = open(slash ? path : ".", O_RDONLY);
    if (folder >= 0) {
        fsync(folder);
        close(folder);
    }
}

bool cli_file_commit(struct cli_file *file)
{
    bool ok = !ferror(file->stream);
    int reason = EIO; /* of a failure before, whose errno is lost */
    if (fflush(file->stream) != 0 || (ok && file->temporary && fsync(fileno(file->stream)) != 0)) {
        ok = false;
        reason = errno;
    }
    if (fclose(file->stream) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    file->stream = NULL;
    if (ok && file->temporary && rename(file->temporary, file->path) != 0) {
        ok = false;
        reason = errno;
    }
    if (ok && file->temporary) {
        sync_folder(file->path);
        replace_unfinished(file->temporary, NULL);
        free(file->temporary);
        file->temporary = NULL;
    }
    cli_file_abandon(file);
    errno = reason;
    return ok;
}

void cli_file_abandon(struct cli_file *file)
{
    if (file->stream)
        fclose(file->stream);
    if (file->temporary) {
        unlink(file->temporary);
        replace_unfinished(file->temporary, NULL);
    }
    free(file->temporary);
    free(file->path);
    *file = (struct cli_file){NULL, NULL, NULL};
}

/* Far beyond what a program says of one evaluation. */
static const size_t MOST_READ = (size_t)256 << 20;

char *cli_read(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    FILE *out = file ? text_open(&text, length) : NULL;
    char buffer[4096];
    size_t n;
    size_t got = 0;
    while (out && got <= MOST_READ && (n = fread(buffer, 1, sizeof buffer, file)) > 0)
        got += fwrite(buffer, 1, n, out);
    bool ok = out && !ferror(file);
    if (out && !text_close(out, &text)) {
        errno = ENOMEM;
        ok = false;
    }
    if (file)
        fclose(file);
    if (ok && *length > MOST_READ) {
        errno = EFBIG;
        ok = false;
    }
    if (ok)
        return text;
    free(text);
    return NULL;
}
