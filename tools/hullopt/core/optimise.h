/* All stages of an optimisation: latent space, search, verification, wave patterns, and the
 * parameters of the best design. Each goes on where an earlier session left it. */
#ifndef HULLOPT_OPTIMISE_H
#define HULLOPT_OPTIMISE_H

#include "core/record.h"

/* The latent space of a new run, which becomes a record at path, whole or not at all; or that of
 * the run at path, which must have been begun with the same configuration. */
bool optimise_begin(struct problem *problem, const galv_shape *shape, const char *path,
                    const struct core_watch *watch);
bool optimise_resume(struct problem *problem, const char *path);

/* Every stage that is not done, on an open record with a session. */
bool optimise_run(struct problem *problem, const galv_shape *shape, struct record *record,
                  const struct core_watch *watch);

/* Builds the best design; one that a command made from its points on record. */
bool optimise_set_best(struct problem *problem, const struct record *record,
                       const struct evaluation *best);

#endif
