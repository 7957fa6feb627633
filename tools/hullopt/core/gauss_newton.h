/* Gauss-Newton search on what the solver sees rather than on C_w: wave residuals r_m of several
 * settings, |r_m|^2 = C_w (or a resistance), and the velocities that make the pressure, all nearly
 * linear in the shape. They are differentiated on a coarse mesh; each step solves
 *
 *     min tau + penalty e   s.t.  |r_m + J_m d|^2 / C_m <= tau                       (objective),
 *                                 |r_m + J_m d|^2 / C_m <= offset_m + share_m tau + e   (others),
 *                                 pressure(z + Z d) / parent <= bound + e,
 *                                 known limits,   box,   |d| <= radius,   e >= 0
 *
 * (C_m of the parent; Fletcher's Sl1QP, with the largest excess for their sum) about the fine
 * values of the best design so far. A step counts by its own fine values, in the same penalty
 * function, and corrects the derivatives by Broyden's update: a solve on the fine mesh costs a
 * tenth of new derivatives, which are taken where that no longer leads on. */
#ifndef HULLOPT_GAUSS_NEWTON_H
#define HULLOPT_GAUSS_NEWTON_H

#include <igabem/residual.h>

#include <stdbool.h>
#include <stddef.h>

/* How C_w of a setting over that of the parent is bounded: offset + share tau. */
struct gn_setting {
    double offset, share; /* the objective: 0, 1; a limit b: b, 0; at least the part f of the gain:
                             1 - f, f */
};

static inline bool gn_is_objective(const struct gn_setting *setting)
{
    return setting->share == 1 && setting->offset == 0;
}

/* Those of the waves, and one for the friction where the total resistance is lowered. */
enum { GN_RESIDUALS = IGABEM_WAVE_RESIDUALS + 1 };

/* What the fine or the coarse mesh says of a design. */
struct gn_sample {
    double *residual; /* [settings][GN_RESIDUALS] */
    double *value;    /* [settings] the sum of their squares, of the fine mesh by its adaptive
                         integral: C_w, or a resistance */
    size_t points;    /* of the pressure; 0: not bounded */
    igabem_pressure_sample *point;
    double pressure; /* C_w by pressure */
};

enum gn_answer { GN_VALUED, GN_FAILED, GN_STOP };

struct gn_problem {
    size_t n;
    const double *lower, *upper; /* [n] */
    size_t settings;
    const struct gn_setting *setting;
    size_t points;   /* samples of the pressure */
    double pressure; /* bound of its ratio; NAN: none */
    size_t limits;
    /* Fills value[limits], <= 0 allowed; false: not known there. */
    bool (*limit)(void *user_data, const double *x, double *value);
    /* Fill a sample. GN_FAILED: there is no such design; GN_STOP: end the search. */
    enum gn_answer (*coarse)(void *user_data, const double *x, struct gn_sample *sample);
    enum gn_answer (*fine)(void *user_data, const double *x, struct gn_sample *sample);
    /* A line now and then; may be NULL. */
    void (*tell)(void *user_data, const char *sentence);
    void *user_data;
};

/* Starts from x = 0, the parent, and ends when new derivatives led to less than 0.5 % and promise
 * less than 0.1 %, or fine() says stop.
 * Fills x[n] with the best design within all limits. false: out of memory, or the parent has no
 * value. */
bool gn_run(const struct gn_problem *problem, double *x);

#endif
