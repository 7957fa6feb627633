/* Servers of UM-Bridge that solve the designs of a run: 'hullopt serve' on other machines, or that
 * project's load balancer in front of them. What does not answer, or answers something else than
 * the numbers of this problem, is lost for the session; it never is a design that failed. */
#ifndef HULLOPT_REMOTE_H
#define HULLOPT_REMOTE_H

#include "core/evaluate.h"
#include "umbridge.h"

enum { REMOTE_MOST = 64 }; /* bits of evaluation.lost */

struct remote {
    size_t n, first; /* how many, and whom the next design is given to */
    uint64_t lost;   /* who is not asked any more */
    struct umbridge server[REMOTE_MOST];
    char *urls; /* cut into pieces */
    const struct config *config;
};

/* Looks for the model of the problem at each of "URL,URL,...". remote_close() in any case. */
bool remote_open(struct remote *remote, const struct problem *problem, const char *urls);
void remote_close(struct remote *remote);
/* Whether every server gives the original the figures that it has here. */
bool remote_check(const struct remote *remote, const struct evaluation *parent, size_t modes);

/* The server of a place among those at once, or the next one that is not lost. */
void remote_choose(struct remote *remote, size_t place);
/* Figures of the solve of e->u, whose hull was built and measured here. */
bool remote_solve(struct remote *remote, struct evaluation *e);
/* Takes over what an evaluation found out of the servers; false when none is left. */
bool remote_learn(struct remote *remote, const struct evaluation *e,
                  const struct core_watch *watch);

/* What a server answers, in three vectors: C_w in the order of evaluate_settings(); what
 * objective.command told, where there is one, for each objective, and C_w by pressure, where the
 * formulation has it; the figures below, -1 for one that has no value.
 */
enum { REMOTE_FIGURES = 6, REMOTE_SIZE = SETTINGS_MOST + 1 + OBJECTIVES_MOST + REMOTE_FIGURES };
void remote_sizes(const struct config *config, size_t sizes[3]);
void remote_write(const struct config *config, const struct evaluation *e, double *output);

#endif
