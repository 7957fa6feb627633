/* What a run works on: the parent on its design grid, the latent space that moves the grid, and the
 * solver's options as they suit the parent. The parent and the best design are built here, once. */
#ifndef HULLOPT_PROBLEM_H
#define HULLOPT_PROBLEM_H

#include "config.h"
#include "core/sentence.h"

#include <galv/galv.h>
#include <igabem/igabem.h>
#include <nurbs/nurbs.h>

/* A hull, and the same as the solver sees it. */
struct design {
    nurbs_hull *hull;
    igabem_hull *body;
};
void design_free(struct design *design);

struct remote;

struct problem {
    const struct config *config;
    size_t jobs; /* designs evaluated at once, in processes of their own; 0, 1: in this one */
    double job_seconds;    /* after which such a design has failed; 0: never */
    struct remote *remote; /* who solves instead, borrowed; NULL: this process */
    nurbs_hull *source; /* the parent as it was read: every design has its length and tolerance */
    nurbs_grid *grid;   /* design grid on it */
    nurbs_grid *moved;  /* of the design at hand */
    char made[CONFIG_PATH]; /* file of its hull, where a command made that */
    double *ends;  /* grids of the command's hulls at the lower and upper end of each parameter */
    double *map;   /* latent coordinates by the parameters of snapshots; NULL: there are none */
    double *back;  /* and these by those */
    double *found; /* grid of its best hull, of a run that is looked at; NULL: not known */
    struct design parent; /* built from its grid like every design */
    struct design best;   /* empty before problem_set_best(), and when nothing is better */
    bool is_solved;       /* with these options, frozen on the parent */
    igabem_options solver;
    size_t speeds; /* the same at the speeds of the verification */
    igabem_options speed[CONFIG_FROUDE_MOST];
    galv_model *model;                 /* NULL before problem_reduce() or problem_recall() */
    galv_limits *limits;               /* of its latent points */
    double particular[PARTICULARS][2]; /* of the parent, by particulars_of() */
    double *initial;                   /* designs of its own to begin a search with, or NULL */
};

/* Reads the hull, samples the grid, builds the parent, freezes the options on it. */
bool problem_read(const struct config *config, struct problem *problem);
/* The hulls of a run without its file: from the latent space, the size of the grid, the length and
 * the ends of a command's parameters (NULL: none). Takes model and ends, whatever comes of it.
 * There are no options to solve with. */
bool problem_restore(const struct config *config, galv_model *model, const size_t grid[2],
                     double length, double *ends, struct problem *problem);
void problem_free(struct problem *problem);

/* Freezes the options on the parent again, after the configuration changed: the mesh is kept. */
bool problem_freeze(struct problem *problem);

/* Reduces the shape to its latent space. */
bool problem_reduce(struct problem *problem, const galv_shape *shape,
                    const struct core_watch *watch);
/* Takes a latent space that was found earlier, and the gradient of the volume (NULL: none). */
bool problem_recall(struct problem *problem, galv_model *model, const double *gradient);

/* The design of a latent point (NULL: the parent). The sentence begins with the stage that failed,
 * "skin: ". */
bool problem_build(struct problem *problem, const double *u, struct design *design);
/* Its hull alone, as libnurbs makes it. */
bool problem_build_hull(struct problem *problem, const double *u, nurbs_hull **hull);
/* The design of the points of a grid. */
bool problem_build_points(struct problem *problem, const double *points, struct design *design);
bool problem_set_best(struct problem *problem, const double *u);

/* Fills the grid points of the hull in a file that the command made. */
bool problem_read_points(struct problem *problem, const char *path, double *points);
/* The same of a command's hull: of parameters, less the original's. */
bool problem_make_points(struct problem *problem, const double *u, double *points);
/* The family of designs: that of the shape file, or the command's. NULL with a sentence, which for
 * a shape file is printed. */
galv_shape *problem_shape(struct problem *problem);

/* The best design, or the parent. */
const struct design *problem_best(const struct problem *problem);
/* Reference length, m. */
double problem_length(const struct problem *problem);
/* The waterline's largest |nu_x| outside stem arcs; NAN without a body. */
double design_nu_s(const struct design *design);

#endif
