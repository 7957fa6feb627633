/* The search: ask, evaluate, tell; or the steps of a descent. */
#ifndef HULLOPT_SEARCH_H
#define HULLOPT_SEARCH_H

#include "core/record.h"

/* Designs that a search may evaluate, the parent among them. */
size_t search_budget(const struct config *config);

/* Opens the record of a run at path, new or resumed, with the optimisation of the problem. The
 * problem must stay where it is as long as the record is open. */
bool search_open(struct problem *problem, const char *path, struct record *record);

/* Evaluates the parent unless that is recorded, then runs until the budget is spent, and writes
 * "stop". */
bool search_run(struct problem *problem, struct record *record, const struct core_watch *watch);

/* Where a search stands. */
struct search {
    struct problem *problem;
    struct record *record;
    const struct core_watch *watch;
    struct evaluation parent;
    double best;
    size_t done, failed;
};

/* Evaluates a design that was started and tells the record of it. */
bool search_step(struct search *search, struct evaluation *e, evaluate_look look, void *user_data);
/* Shows how far it is, and what it is about (NULL: nothing to add). */
void search_show(const struct search *search, const char *what);

#endif
