/* The objective: C_w of a latent point, with everything a record of it needs. */
#ifndef HULLOPT_EVALUATE_H
#define HULLOPT_EVALUATE_H

#include "core/problem.h"

#include <stdint.h>

enum {
    REASON_SIZE = 256,
    SPEEDS_MOST = (1 + CONFIG_MODELS_MOST) * CONFIG_FROUDE_MOST,
    SURFACES_MOST = 1 + CONFIG_FROUDE_MOST,
    SETTINGS_MOST = 1 + CONFIG_MODELS_MOST + SPEEDS_MOST
};

/* One evaluated design. Figures are NAN where the design did not get that far. */
struct evaluation {
    uint64_t id;       /* of the search; 0: the parent */
    const char *phase; /* "parent", "initial", "global", ... */
    const double *u;   /* latent point, borrowed */
    bool failed;
    bool no_memory;                   /* failed for want of it: nothing is known of the design */
    char reason[REASON_SIZE];         /* of the failure, "skin: ..."; else "" */
    double objective;                 /* what the search lowers: objective_of() */
    double value;                     /* by objective.command */
    double told[OBJECTIVES_MOST - 1]; /* by the same, of the other objectives */
    char made[CONFIG_PATH];           /* file of the hull by parameters.command, or "" */
    double cw, cw_pressure, rw, share_beyond_cutoff, condition;
    size_t models; /* of cw_model: by the other formulations of search.models */
    double cw_model[CONFIG_MODELS_MOST];
    size_t speeds; /* of cw_speed: speed by speed the solver's formulation, then the others; 0: not
                      solved at other speeds */
    double cw_speed[SPEEDS_MOST];
    double volume, volume_ratio, wetted_area, bound;
    double outside; /* by how much it breaks what is known beforehand; <= 0: it does not */
    double breadth; /* least share of its half breadth that a wet point keeps */
    double particular[PARTICULARS][2]; /* of particulars_of() */
    double nu_s;                       /* of the waterline, as design_nu_s() */
    double sinkage, trim;              /* at flow.froude, of struct attitude */
    size_t surfaces;               /* of surface: at flow.froude and the other speeds; 0: held */
    double surface[SURFACES_MOST]; /* wetted by the still water there, over that at rest */
    size_t dofs;
    double propose_seconds, geometry_seconds, solve_seconds;
    /* Of core/remote.h: servers that did not answer, bit by bit, why the last did not, and whether
     * none is left: then nothing is known of the design. */
    uint64_t lost;
    char lost_reason[REASON_SIZE];
    bool unanswered;
};

/* Everything else NAN, 0 or "". */
void evaluation_start(uint64_t id, const char *phase, const double *u,
                      struct evaluation *evaluation);

/* Whether the configuration bounds or weighs C_w at verification.froude, or lowers one there. */
bool evaluate_asks_speeds(const struct config *config);
/* Settings of the solver that a design is valued with, in the order of the figures above: cw,
 * cw_model, and cw_speed when that is so. Returns how many. */
size_t evaluate_settings(const struct problem *problem, igabem_options settings[SETTINGS_MOST]);

/* Looks at the solutions, one for each of these settings, before they are freed; it may take some,
 * leaving NULL in their places. false, with a sentence, fails the design. */
typedef bool (*evaluate_look)(void *user_data, igabem_solution **solutions);

/* Fills everything of an evaluation that was started. A design that cannot be evaluated is a
 * result, not an error. look: NULL, nobody does. */
void evaluate(struct problem *problem, struct evaluation *evaluation, evaluate_look look,
              void *user_data);
/* The design of the points of a grid: inside or outside of any limit, which only the figures tell.
 */
void evaluate_points(struct problem *problem, const double *points, struct evaluation *evaluation);
/* The parent, which is built already. */
void evaluate_parent(struct problem *problem, struct evaluation *evaluation, evaluate_look look,
                     void *user_data);

#endif
