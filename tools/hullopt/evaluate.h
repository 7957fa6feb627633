/* The objective: C_w of a latent point, with everything a record of it needs. */
#ifndef HULLOPT_EVALUATE_H
#define HULLOPT_EVALUATE_H

#include "design.h"
#include "latent.h"

#include <stdint.h>

enum { PHASE_SIZE = 16, STAGE_SIZE = 16 };

/* One evaluated design. Figures are NAN where the design did not get that far. */
struct evaluation {
    uint64_t id;            /* of the search; 0: the parent */
    char phase[PHASE_SIZE]; /* "parent", "initial", "global", ... */
    double *u;              /* latent point, owned */
    bool failed;
    char stage[STAGE_SIZE], reason[REASON_SIZE]; /* of the failure, else "" */
    double cw, cw_pressure, rw, share_beyond_cutoff, condition;
    size_t speeds; /* of cw_speed; 0: not solved at other speeds */
    double cw_speed[CONFIG_FROUDE_MOST];
    double volume, volume_ratio, wetted_area, bound;
    size_t dofs;
    double propose_seconds, geometry_seconds, solve_seconds;
};

bool evaluation_create(size_t modes, struct evaluation *evaluation);
void evaluation_free(struct evaluation *evaluation);

/* Largest ratios to the parent: resistance by pressure, C_w at every other speed. NAN: any. */
struct outcome_limits {
    double pressure, speeds;
};

struct evaluator {
    const struct parent *parent;
    const struct latent *latent;
    double tolerance;
    double displacement;  /* allowed relative change of volume, NAN: any */
    double parent_volume; /* m^3, of the parent built in the same way */
    double parent_nu_s;   /* of its waterline */
    struct outcome_limits limits;
    igabem_options solver; /* frozen on the parent */
    size_t speeds;         /* the same at the speeds of the verification */
    igabem_options speed[CONFIG_FROUDE_MOST];
    double *scratch; /* coordinates numbers, owned */
};

/* Builds the parent, freezes the solver's options on it. On failure prints the sentence. */
bool evaluator_create(const struct config *config, const struct parent *parent,
                      const struct latent *latent, struct evaluator *evaluator);
void evaluator_free(struct evaluator *evaluator);

/* Fills everything of *evaluation from its u. A design that cannot be evaluated is a result, not an
 * error. */
void evaluate(struct evaluator *evaluator, struct evaluation *evaluation);

/* The hull of a latent point (NULL: the parent) as patch and as the solver's object; hull NULL: not
 * wanted. */
bool evaluate_build(struct evaluator *evaluator, const double *u, struct design *design,
                    igabem_hull **hull, struct failure *failure);

#endif
