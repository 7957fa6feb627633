/* How far a call has come, as its caller hears it. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <igabem/solve.h>

struct progress {
    igabem_progress tell; /* NULL: nobody listens */
    void *user_data;
    double done; /* fraction */
};

/* IGABEM_ERROR_CANCELLED when the caller wants to stop. */
igabem_status progress_report(struct progress *progress, double fraction);

#endif
