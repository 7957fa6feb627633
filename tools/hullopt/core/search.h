/* The search: ask, evaluate, tell. */
#ifndef HULLOPT_SEARCH_H
#define HULLOPT_SEARCH_H

#include "core/record.h"

/* Opens the record of a run at path, new or resumed, with the optimisation of the problem. The
 * problem must stay where it is as long as the record is open. */
bool search_open(struct problem *problem, const char *path, struct record *record);

/* Evaluates the parent unless that is recorded, then runs until the budget is spent, and writes
 * "stop". */
bool search_run(struct problem *problem, struct record *record, const struct core_watch *watch);

#endif
