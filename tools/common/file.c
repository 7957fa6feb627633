#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool cli_file_open(struct cli_file *file, const char *path)
{
    size_t length = strlen(path);
    *file = (struct cli_file){NULL, strdup(path), malloc(length + sizeof ".XXXXXX")};
    if (!file->path || !file->temporary) {
        cli_file_abandon(file);
        errno = ENOMEM;
        return false;
    }
    memcpy(file->temporary, path, length);
    memcpy(file->temporary + length, ".XXXXXX", sizeof ".XXXXXX");
    int descriptor = mkstemp(file->temporary);
    if (descriptor < 0) {
        int reason = errno;
        free(file->temporary);
        file->temporary = NULL;
        cli_file_abandon(file);
        errno = reason;
        return false;
    }
    mode_t mask = umask(0);
    umask(mask);
    fchmod(descriptor, 0666 & ~mask);
    file->stream = fdopen(descriptor, "w");
    if (!file->stream) {
        int reason = errno;
        close(descriptor);
        cli_file_abandon(file);
        errno = reason;
        return false;
    }
    return true;
}

/* The rename itself must survive a power cut: sync the folder that holds the name. */
static void sync_folder(const char *path)
{
    char *copy = strdup(path);
    if (!copy)
        return;
    char *slash = strrchr(copy, '/');
    if (slash)
        slash[slash == copy] = '\0';
    int folder = open(slash ? copy : ".", O_RDONLY);
    if (folder >= 0) {
        fsync(folder);
        close(folder);
    }
    free(copy);
}

bool cli_file_commit(struct cli_file *file)
{
    bool ok =
        fflush(file->stream) == 0 && !ferror(file->stream) && fsync(fileno(file->stream)) == 0;
    int reason = errno;
    if (fclose(file->stream) != 0 && ok) {
        ok = false;
        reason = errno;
    }
    file->stream = NULL;
    if (ok && rename(file->temporary, file->path) != 0) {
        ok = false;
        reason = errno;
    }
    if (ok) {
        sync_folder(file->path);
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
    if (file->temporary)
        unlink(file->temporary);
    free(file->temporary);
    free(file->path);
    *file = (struct cli_file){NULL, NULL, NULL};
}
