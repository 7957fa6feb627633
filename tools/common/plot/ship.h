/* Pictures of this field that more than one command draws. */
#ifndef TOOLS_PLOT_SHIP_H
#define TOOLS_PLOT_SHIP_H

#include "plot/plot.h"

#include <nurbs/nurbs.h>

/* A hull in a lines plan: its half surfaces and how they are drawn. */
struct plot_hull {
    const char *name;
    size_t n;
    const nurbs_surface *const *surfaces;
    struct plot_pen pen;
};

/* Lines plan in the layout of a drawing office: profile with buttocks, half-breadth plan with
 * waterlines, body plan, in the same spacing, with a bar of metres for each scale. Several hulls
 * are laid over each other; the grid and the numbers are those of the first. */
struct plot_lines {
    double perpendicular[2];     /* x of station 0 and of the last */
    double level;                /* of the still water */
    size_t stations;             /* spaces between the perpendiculars */
    size_t waterlines, buttocks; /* about so many spaces, round numbers of metres apart */
};
/* Opens the sheet. False after a sentence. */
bool plot_lines_plan(struct plot *plot, double width, const struct plot_lines *lines, size_t n,
                     const struct plot_hull *hulls);

/* A bar of four round lengths in metres that ends at `right`, about `room` long. */
void plot_scale_bar(struct plot *plot, double right, double y, double scale, double room);

/* A hull seen from the port bow, both sides, coloured by a value per point of a grid of rows from
 * aft (values NULL: grey), into the frame's rectangle. False: out of memory. */
struct plot_view {
    size_t rows, columns;
    const double *points, *values;
    struct plot_scale scale;
};
void plot_hull_view(struct plot *plot, double left, double top, double width, double height,
                    const struct plot_view *view);

/* A mode of a latent space on the hull: displacement at the root mean square of its coordinate. */
struct plot_mode {
    size_t number; /* from 1 */
    size_t rows, columns;
    const double *points, *vector;
    double eigenvalue, trace;
};
void plot_mode_view(struct plot *plot, double left, double top, double width, double height,
                    const struct plot_mode *mode);

/* Retained variance and mean square error over the number of modes. */
struct plot_latent {
    size_t modes, spectrum, parameters; /* kept, known; parameters 0: nonlinear family */
    const double *eigenvalues, *mse;
    double trace, wanted; /* share of the variance, 0: not known */
};
void plot_variance(struct plot *plot, double left, double top, double width, double height,
                   const struct plot_latent *latent);
void plot_error(struct plot *plot, double left, double top, double width, double height,
                const struct plot_latent *latent);

/* Every evaluation of a search and the best so far. */
struct plot_trial {
    double number, value;
    bool initial, infeasible, failed;
    char note[288];
};
struct plot_history {
    size_t n;
    const struct plot_trial *trials;
    double reference, unit; /* NAN: none; numbers shown are values times unit */
    const char *label;
};
void plot_history(struct plot *plot, double left, double top, double width, double height,
                  const struct plot_history *history);

/* Designs by two or three objectives, one pair against each other in each panel. */
enum { PLOT_OBJECTIVES = 3 };
struct plot_design {
    double value[PLOT_OBJECTIVES];
    bool member, infeasible; /* of the Pareto set; outside of the limits */
    char note[24];
};
struct plot_front {
    size_t n, objectives;
    const struct plot_design *designs;
    const double *original, *shown; /* values of two designs to be marked; NULL: none */
    const char *labels[PLOT_OBJECTIVES];
};
/* These open the sheet. */
bool plot_front(struct plot *plot, double width, double height, const struct plot_front *front);
/* Predicted against told values, with two standard deviations of each prediction. */
bool plot_leave_one_out(struct plot *plot, double side, size_t n, const double *told,
                        const double *mean, const double *sd);
/* Sobol' indices of variables, alone and with others, in an order. */
bool plot_indices(struct plot *plot, double width, size_t n, const double *first,
                  const double *total, const size_t *order, char *const *names);
/* The places of n values, the greatest first. */
void plot_order(size_t n, const double *value, size_t *order);

/* Wave elevations on nx x ny points, y fast, NAN inside the hull; a field that begins at y >= 0 is
 * one half. waterplane: n_edge pairs x,y of its half, from end to end. */
struct plot_waves {
    const char *name;
    size_t nx, ny, n_edge;
    double x0, dx, y0, dy;
    const double *elevation;
    double *edge;
};
/* Draws one field, or two halves above and below the centre line, in one scale, in mm. Opens the
 * sheet. */
bool plot_wave_pattern(struct plot *plot, double width, size_t n, const struct plot_waves *waves);
/* Elevation between the points; where there is no water that of the next water outside. */
double plot_wave_at(const struct plot_waves *waves, double x, double y);

#endif
