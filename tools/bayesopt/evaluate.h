/* One evaluation of an external command: its folder, its process, its output. */
#ifndef BAYESOPT_TOOL_EVALUATE_H
#define BAYESOPT_TOOL_EVALUATE_H

#include "config.h"

#include <bayesopt/bayesopt.h>

#include <stdbool.h>
#include <sys/types.h>

struct evaluation {
    uint64_t id;
    int level;
    double *x; /* [d], owned by the caller */
    pid_t process;
    double started;
    size_t attempt;
    bool timed_out;
    char folder[512];
};

/* Starts the command for e->id and e->x in a folder of its own, output to files there. */
bool evaluation_start(const struct config *config, struct evaluation *e);
/* Kills the process group if the time is up. */
void evaluation_check_time(const struct config *config, struct evaluation *e);
/* What a finished process left: fills *f, constraints [m] and, if the file asks for it, gradient
 * [d], or writes the reason of the failure. */
bool evaluation_read(const struct config *config, const struct evaluation *e, int status, double *f,
                     double *constraints, double *gradient, char *reason, size_t size);

#endif
