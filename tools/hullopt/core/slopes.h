/* Derivatives of designs by the solver's tangents (igabem/tangent.h): of what the values are
 * computed from, on the same mesh, for about one and a half solves whatever the number of
 * variables. For designs that move athwartships in one spline space, by the formulations that have
 * them. */
#ifndef HULLOPT_SLOPES_H
#define HULLOPT_SLOPES_H

#include "core/evaluate.h"

#include <igabem/tangent.h>

/* Solutions of a design that was valued, with their systems; NULL where there are no tangents. */
struct slopes_held {
    double *u; /* [modes], NULL: none */
    igabem_solution *solution[SETTINGS_MOST];
};

enum { SLOPES_HELD = 2 }; /* a step that failed comes between a design and its derivatives */

struct slopes {
    struct problem *problem;
    size_t n; /* settings of evaluate_settings() */
    bool has[SETTINGS_MOST];
    igabem_options setting[SETTINGS_MOST];
    struct slopes_held held[SLOPES_HELD]; /* the latest first */
    struct design design;                 /* that is differentiated */
    double *move;                         /* [modes][control points][3], m for a unit of u */
};

/* Whether a setting has tangents. */
bool slopes_has(const struct problem *problem, const igabem_options *setting);

/* Finds which settings have them. Until slopes_end() the problem's solver keeps systems. */
void slopes_start(struct problem *problem, struct slopes *slopes);
void slopes_end(struct slopes *slopes);

/* Whether any setting has tangents. */
bool slopes_any(const struct slopes *slopes);

/* Takes solutions of the design u, leaving NULL in their places. */
void slopes_keep(struct slopes *slopes, const double *u, igabem_solution **solutions);

/* Makes ready for the derivatives at u: moves of its control points, solutions where none are held.
 * false with a sentence: there are none by tangents. */
bool slopes_open(struct slopes *slopes, const double *u);
void slopes_close(struct slopes *slopes);

/* Moves of the control points of the design that was opened, by differences of rebuilt hulls. */
bool slopes_moves(struct slopes *slopes, const double *u);

/* What setting m changes by for a unit of each latent variable: fills dr
 * [modes][IGABEM_WAVE_RESIDUALS], the wetted area darea[modes], m^2, and dsample [modes][samples]
 * (NULL: not wanted) of along x around parts. *solution: that of the setting, borrowed. */
bool slopes_setting(const struct slopes *slopes, size_t m, const size_t parts[2], double *dr,
                    double *darea, igabem_pressure_sample *dsample,
                    const igabem_solution **solution);

/* What C_w of setting m changes by for a unit of each latent variable: fills dcw[modes]. */
bool slopes_cw(const struct slopes *slopes, size_t m, double *dcw);

#endif
