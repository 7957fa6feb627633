/* Searches by other optimisers, on the record of a run: what is on record is never evaluated again.
 * They are deterministic, so a run that was interrupted comes by the same designs to where it was.
 */
#ifndef HULLOPT_CONVENTIONAL_H
#define HULLOPT_CONVENTIONAL_H

#include "core/search.h"

/* What an optimiser sees of a design: ratios to the parent. */
struct seen {
    bool valued;      /* false: too far outside, or failed */
    double objective; /* 1: the parent's */
    double *outcome;  /* what only the solve tells, <= 0 where allowed */
    double *limit;    /* what is known beforehand, likewise */
};

/* The evaluations of a run by their designs. */
struct ledger {
    struct search *search;
    const struct method_row *method;
    size_t n, most;          /* variables; evaluations allowed, the parent among them */
    size_t outcomes, limits; /* how many */
    double *lower, *upper;   /* of outcomes, [2 outcomes] together */
    size_t count, calls;     /* evaluations on record, designs asked for */
    double *u, *value;       /* rows of n, and of 1 + outcomes */
    double *room;            /* of the design at hand */
    bool ok, spent;          /* the record took everything; nothing may be evaluated any more */
};

bool ledger_open(struct search *search, const struct method_row *method, struct ledger *ledger);
void ledger_close(struct ledger *ledger);
/* False when the search has to end. */
bool ledger_look(struct ledger *ledger, const double *u, struct seen *seen);
/* One number for optimisers that take no constraints: the objective with a penalty, or above every
 * design where there is none. False when the search has to end. */
bool ledger_penalised(struct ledger *ledger, const double *u, double *value);

/* Runs until the method ends or the budget is spent, and writes "stop". */
bool conventional_run(struct search *search, const struct method_row *method);
/* The same of METHOD_SWARM. */
bool swarm_run(struct search *search, const struct method_row *method);
/* Writes "stop" with why the search ended, unless the record failed. */
bool ledger_stop(struct ledger *ledger, const char *reason);

#endif
