/* A problem as the descent of libbayesopt sees it (bayesopt/descent.h): wave residuals of every
 * setting, the velocities that make the pressure, derivatives of both by tangents or by differences
 * on a coarse mesh. */
#ifndef HULLOPT_RESIDUALS_H
#define HULLOPT_RESIDUALS_H

#include "core/search.h"
#include "core/slopes.h"

#include <bayesopt/descent.h>

struct descent {
    struct problem *base;
    struct search *search; /* NULL: a forecast, which keeps no record */
    bayesopt_descent_problem problem;
    bayesopt_descent_setting setting[SETTINGS_MOST];
    struct slopes slopes;
    const double *at;                /* the design that it sees */
    size_t points;                   /* of the pressure; 0: not bounded */
    bayesopt_descent_sample *sample; /* to be filled by descent_look() */
    igabem_options coarse[SETTINGS_MOST];
    size_t valued, differentiated; /* designs, coarse solves */
    size_t tangents;               /* settings that the last derivatives had by tangents */
    size_t told;                   /* one more than of these the user knows; 0: nothing yet */
    bool ok;                       /* the record took everything, and nobody asked to stop */
};

/* search: NULL for a forecast. The values are the caller's: problem.fine. false with a sentence;
 * descent_end() is to be called whatever comes of it. */
bool descent_start(struct problem *base, struct search *search, struct descent *descent);
void descent_end(struct descent *descent);

/* Settings as a configuration weighs them: objective, confirmation, or another speed. */
void descent_weigh(const struct config *config, size_t n, bayesopt_descent_setting *setting);

/* Looks at the solutions of descent->at for descent->sample. */
bool descent_look(void *user_data, igabem_solution **solutions);

/* The values of a design that was looked at. */
void descent_keep(const struct descent *descent, const struct evaluation *evaluation,
                  bayesopt_descent_sample *sample);

#endif
