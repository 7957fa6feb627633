/* Does another model see the gain? The optimum beside the parent in every other formulation, at a
 * finer resolution, with the short-wave filter that its own waterline asks for, and at other
 * speeds. */
#ifndef HULLOPT_VERIFY_H
#define HULLOPT_VERIFY_H

#include "core/record.h"

enum { VERIFY_MOST = 32 };

/* Of the coarser mesh, elements each way over those of the search. */
extern const double VERIFY_COARSER;

/* The rows of a verification with their settings; results NAN. Returns how many. */
size_t verify_plan(const struct problem *problem, struct verification rows[VERIFY_MOST],
                   igabem_options options[VERIFY_MOST]);

/* Solves what the record does not hold yet, a row at a time. */
bool verify_run(const struct problem *problem, struct record *record,
                const struct core_watch *watch);

#endif
