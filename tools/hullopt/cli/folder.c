#include "cli/folder.h"

#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

char *folder_join(const char *path, const char *name)
{
    size_t length = strlen(path), room = length + strlen(name) + 2;
    char *joined = cli_needed(malloc(room));
    memcpy(joined, path, length);
    if (length && path[length - 1] != '/')
        joined[length++] = '/';
    strcpy(joined + length, name);
    return joined;
}

/* mkdir -p; created tells whether the last component is new. */
static bool make_folders(const char *path, bool *created)
{
    char *copy = strdup(path);
    if (!copy)
        return false;
    for (char *c = copy + 1; *c; c++) {
        if (*c != '/')
            continue;
        *c = '\0';
        int failed = mkdir(copy, 0777) != 0 && errno != EEXIST;
        *c = '/';
        if (failed && c[1]) {
            free(copy);
            return false;
        }
    }
    free(copy);
    *created = mkdir(path, 0777) == 0;
    return *created || errno == EEXIST;
}

static int take_lock(const char *path)
{
    int descriptor = open(path, O_RDWR | O_CREAT, 0666);
    if (descriptor < 0)
        return -1;
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(descriptor, F_SETLK, &whole) == 0)
        return descriptor;
    int reason = errno;
    close(descriptor);
    errno = reason;
    return -1;
}

bool folder_open(struct folder *folder, const char *path)
{
    *folder = (struct folder){.lock = -1};
    if (!make_folders(path, &folder->created)) {
        cli_fail("%s: the folder cannot be made: %s", path, strerror(errno));
        return false;
    }
    folder->path = strdup(path);
    char *lock = folder_join(path, ".lock");
    if (folder->path && lock)
        folder->lock = take_lock(lock);
    int reason = errno;
    free(lock);
    if (folder->lock >= 0)
        return true;
    if (reason == EAGAIN || reason == EACCES)
        cli_fail("%s: %s", path,
                 reason == EAGAIN ? "another hullopt is at work in this folder" : "not writable");
    else
        cli_fail("%s: not writable: %s", path, strerror(reason));
    folder_abandon(folder);
    return false;
}

void folder_close(struct folder *folder)
{
    if (folder->lock >= 0)
        close(folder->lock);
    free(folder->path);
    *folder = (struct folder){.lock = -1};
}

void folder_abandon(struct folder *folder)
{
    if (folder->created && folder->path) {
        char *lock = folder_join(folder->path, ".lock");
        if (lock && folder->lock >= 0)
            unlink(lock);
        free(lock);
        rmdir(folder->path);
    }
    folder_close(folder);
}

long folder_holder(const char *path)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    char *lock = folder_join(path, ".lock");
    int descriptor = lock ? open(lock, O_RDONLY) : -1;
    bool held =
        descriptor >= 0 && fcntl(descriptor, F_GETLK, &whole) == 0 && whole.l_type != F_UNLCK;
    if (descriptor >= 0)
        close(descriptor);
    free(lock);
    return held ? (long)whole.l_pid : 0;
}
