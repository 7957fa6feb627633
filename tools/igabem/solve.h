/* What the parts of `igabem solve` pass to each other. */
#ifndef IGABEM_TOOL_SOLVE_H
#define IGABEM_TOOL_SOLVE_H

#include "hull_input.h"

#include <igabem/igabem.h>

#include <jansson.h>
#include <stdbool.h>

struct solve_request {
    struct hull_request hull;
    igabem_options options;
    int formulation; /* as the option has it */
    int elements[2]; /* likewise: options.elements_u, elements_v */
    double *fr;
    size_t n_fr;
    bool all;              /* every formulation */
    bool free_to_trim;     /* at the sinkage and trim of equilibrium */
    bool resolution_given; /* --refine, --refine-v or --elements */
    bool survey;           /* shares of bow, middle and stern, and a wave cut */
    int ladder;            /* levels, 1: none */
    double x_s;            /* metres, NAN: options.stern_length */
    double viscosity;      /* kinematic, m^2/s */
    double form_factor;
    char *vtu, *waves, *plot, *pressure_plot, *spectrum;
    size_t waves_grid[2];
    double waves_box[4]; /* x0, x1, y0, y1 in lengths from the fore end, NAN: default */
    bool json;
};

/* Reads the command line. -1 to go on, else an exit code. */
int solve_parse(int argc, char **argv, struct solve_request *request);
void solve_request_free(struct solve_request *request);

enum { WARNINGS_MOST = 16 };

struct solve_result {
    igabem_options options; /* as used */
    igabem_forces forces;
    int refine;
    bool refused;                 /* no figures; the first warning says why */
    double cw_cut;                /* by a longitudinal wave cut; NAN: not asked for, or none */
    double share[3];              /* of the fore, middle and aft third in C_w; NAN likewise */
    char *warning[WARNINGS_MOST]; /* owned; NULL ends */
};

/* Everything that was computed, results[level][case], cases = Froude numbers x formulations. */
struct solve_run {
    const struct solve_request *request;
    const struct hull_input *input;
    igabem_hull_info info;
    size_t cases, levels;
    size_t shown;        /* the case that files and pictures show: of the last Froude number */
    double area_at_rest; /* m^2, what the coefficients refer to when the hull floats freely */
    struct solve_result *results;
};

const struct solve_result *solve_run_result(const struct solve_run *run, size_t level, size_t c);

/* Observed order of C_w over the last three levels up to this one, and Richardson's value; NAN
 * where they do not exist. */
void solve_run_order(const struct solve_run *run, size_t level, size_t c, double *order,
                     double *limit);

/* Resistance with friction; NANs without waves. */
void solve_run_total(const struct solve_run *run, const struct solve_result *result,
                     igabem_total *total);

/* As --solver takes it. */
const char *solve_solver_name(igabem_solver solver);

int solve_print_json(const struct solve_run *run);
int solve_print_table(const struct solve_run *run);

/* Files of one solution; CLI_OK or CLI_FAILED after a message. */
int solve_write_vtu(const igabem_solution *solution, const struct hull_input *input,
                    const char *path);
int solve_write_pressure(const igabem_solution *solution, const struct solve_run *run,
                         const char *path);
int solve_write_waves(const igabem_solution *solution, const struct solve_run *run,
                      const char *path);
int solve_write_spectrum(const igabem_solution *solution, const char *path);

/* Points of one patch on a grid of nu x nv parameters, with the fields on them. */
struct patch_sample {
    size_t nu, nv;
    double *uv, *xyz, *velocity, *cp, *sigma;
};

struct wave_grid {
    size_t nx, ny;
    double *x, *y, *zeta; /* nx * ny each, y fast */
};

/* Pictures, .svg, .png or .pdf. False after a sentence. */
bool solve_write_plot(const struct solve_run *run, const char *path);
bool solve_draw_waves(const struct solve_run *run, const struct wave_grid *grid, const char *path);
bool solve_draw_pressure(const struct solve_run *run, const struct patch_sample *samples,
                         size_t patches, const char *path);

#endif
