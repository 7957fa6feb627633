/* One evaluation of an external command: its folder, its process, its output. */
#ifndef BAYESOPT_TOOL_EVALUATE_H
#define BAYESOPT_TOOL_EVALUATE_H

#include "config.h"
#include "umbridge.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>
#include <sys/types.h>

struct evaluation {
    uint64_t id;
    int level;
    double *x; /* [d], owned by the caller */
    pid_t process;
    double started;
    size_t attempt; /* from 1 on */
    bool timed_out;
    char folder[512]; /* of this attempt alone */
};

enum outcome_kind {
    OUTCOME_DONE,
    OUTCOME_STATUS, /* code: exit status */
    OUTCOME_SIGNAL, /* code: its number */
    OUTCOME_TIMEOUT,
    OUTCOME_UNREAD, /* ended well, but a number is missing */
};

struct outcome {
    enum outcome_kind kind;
    int code;
    bool transient; /* a failure that says nothing of the point */
    bool no_memory; /* to read it */
    double f;
    double *constraints, *gradient; /* [m], [d], owned by the caller */
    char reason[400];               /* of a failure, with the program's own last words */
};

/* Starts the command, or with a model (else NULL) a request, for e->id and e->x in a folder that
 * did not exist before, output to files there. It dies with this process, and all that it has
 * started in its process group too. */
bool evaluation_start(const struct config *config, const struct umbridge *model,
                      struct evaluation *e);
/* Kills the process group if the time is up. */
void evaluation_check_time(const struct config *config, struct evaluation *e);
/* What a finished process left; false, with a sentence, without memory to read it. */
bool evaluation_read(const struct config *config, const struct umbridge *model,
                     const struct evaluation *e, int status, struct outcome *outcome);

#endif
