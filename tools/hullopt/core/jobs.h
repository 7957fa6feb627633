/* Evaluations in processes of their own, each with one thread: one that dies or does not end is a
 * design that failed. */
#ifndef HULLOPT_JOBS_H
#define HULLOPT_JOBS_H

#include "core/evaluate.h"

#include <sys/types.h>

struct job {
    struct evaluation evaluation; /* started by the caller, filled when the job is done */
    double *u;                    /* [modes] its latent point */
    pid_t process;                /* 0: none is at work */
    int pipe;
    double start; /* cli_seconds() */
    size_t slot;  /* its number, by which servers are dealt out */
    bool late;    /* it was ended after most_seconds */
};

/* [n] idle jobs of points of that many coordinates; NULL without memory. */
struct job *jobs_create(size_t n, size_t modes);
/* Ends what is still at work. */
void jobs_free(struct job *jobs, size_t n);

/* Evaluates the design of a job that is idle. */
bool jobs_start(struct problem *problem, struct job *job);

/* Waits until one has ended, or most_seconds (0: any) after its start, when it is ended. NULL when
 * none is at work. */
struct job *jobs_wait(struct job *jobs, size_t n, double most_seconds);

#endif
