/* The folder of a run: made when missing, and held by one process at a time. */
#ifndef HULLOPT_FOLDER_H
#define HULLOPT_FOLDER_H

#include <stdbool.h>

struct folder {
    char *path;
    int lock;     /* descriptor of PATH/.lock, which the system frees when the process dies */
    bool created; /* by this call: removed again by folder_abandon when still empty */
};

/* On failure prints the sentence and returns false, leaving nothing behind. */
bool folder_open(struct folder *folder, const char *path);
void folder_close(struct folder *folder);
/* After a failure that left no result: removes what folder_open made. */
void folder_abandon(struct folder *folder);

/* The process that holds a folder; 0: none, or none that can be seen. */
long folder_holder(const char *path);

/* PATH/NAME, allocated for the caller. */
char *folder_join(const char *path, const char *name);

#endif
