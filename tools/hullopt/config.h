/* The YAML file of a run: every setting with its default and range, and one canonical text by which
 * a later session recognises the same run. */
#ifndef HULLOPT_CONFIG_H
#define HULLOPT_CONFIG_H

#include "methods.h"
#include "settings.h"

#include <bayesopt/bayesopt.h>
#include <igabem/solve.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* What is lowered: objective.quantity is one of the first three; what follows is for a second and a
 * third objective alone. */
enum quantity {
    QUANTITY_NONE = -1,
    QUANTITY_CW,
    QUANTITY_WAVE,
    QUANTITY_TOTAL,
    QUANTITY_PRESSURE,     /* C_w by pressure */
    QUANTITY_DISPLACEMENT, /* volume */
    QUANTITY_COMMAND,      /* another number that objective.command prints */
    QUANTITY_PARTICULAR    /* and those of core/particulars.h that are of one place */
};

enum { CONFIG_PARAMETERS_MOST = 100, CONFIG_PATH = 600 /* of a file of a command */ };
enum { CONFIG_FROUDE_MOST = 8, CONFIG_MODELS_MOST = 5, CONFIG_PLACES_MOST = 40, PARTICULARS = 19 };

enum { CONFIG_DESIGN_FORECAST = BAYESOPT_DESIGN_STLBO + 1 };

/* A command of somebody else, run in a fresh folder. */
struct config_command {
    char *command;  /* with {fields}; NULL: there is none */
    char *file;     /* in the folder: the hull that it writes, or reads */
    char *key;      /* before the number that it prints; NULL: the last one */
    double timeout; /* s */
};

/* A second or a third objective. */
enum { OBJECTIVES_MOST = 3 };
struct config_objective {
    int quantity;
    double froude; /* of a resistance; NAN: flow.froude */
    bool maximise;
    char *key; /* before the number of the command */
};

struct config {
    char *path;         /* of the YAML file; the paths below are resolved against its folder */
    char *name;         /* title of the report */
    char *hull, *shape; /* files; of a hull by command the second is NULL */

    struct config_command maker; /* in place of hull and shape: of parameters, */
    size_t n_parameters, n_original, n_lower, n_upper;
    size_t snapshots; /* hulls of the command, whose latent space is searched; 0: the parameters */
    char *parameter[CONFIG_PARAMETERS_MOST]; /* by name, each from lower to upper */
    double original[CONFIG_PARAMETERS_MOST], lower[CONFIG_PARAMETERS_MOST],
        upper[CONFIG_PARAMETERS_MOST];
    struct config_command judge; /* of what is lowered */
    char *folder;                /* where commands work */

    double draft; /* at the keel amidships, which sets the still water, m; NAN: as in the file */
    double trim;  /* degrees, bow up, about the middle of the waterline */
    bool free_to_trim;      /* designs float at the sinkage and trim of each speed */
    size_t sections, girth; /* design grid; 0: the one that the hull file keeps */
    size_t samples;         /* of the latent space */
    uint64_t latent_seed;
    double variance;     /* share to retain, inside (0, 1) */
    double tolerance;    /* of the simplified patch, share of the length */
    double displacement; /* largest relative change of the volume; NAN: not constrained */
    double entrance;     /* largest nu_s of the waterline over that of the parent; NAN: any */
    double pressure;     /* largest pressure resistance over that of the parent; NAN: any */
    double speeds;       /* largest C_w at each of verify_froude over the parent's; NAN: any */
    double breadth; /* least share of its half breadth that a wet point keeps; NAN: any from 0 */
    double particular[PARTICULARS][2];   /* least and most of core/particulars.h; NAN: any */
    double kg;                           /* centre of gravity above the deepest point, m */
    size_t stations, hard_points, boxes; /* numbers below: x; x, z; x, x, y, z, z */
    double station[CONFIG_PLACES_MOST], hard_point[CONFIG_PLACES_MOST], box[CONFIG_PLACES_MOST];
    int quantity; /* one of enum quantity */
    struct config_objective other[OBJECTIVES_MOST - 1];
    int running_surface;           /* friction is that of the surface as the design floats */
    double viscosity, form_factor; /* of its friction: m^2/s, k */
    size_t weights; /* of flow.froude and each of verify_froude; 0: flow.froude alone */
    double weight[1 + CONFIG_FROUDE_MOST];
    int space;     /* of the variables: 0 latent, 1 the parameters themselves */
    int method;    /* of method_row() */
    size_t models; /* formulations besides the solver's: the worst of all is the objective */
    igabem_formulation model[CONFIG_MODELS_MOST];
    double confirm; /* least share of the gain that they see; NAN: the worst of all counts */
    size_t initial, iterations;
    int design; /* a bayesopt_design_kind, or by the derivatives at the original */
    bayesopt_strategy strategy;
    uint64_t search_seed;
    igabem_options solver; /* froude, gravity, density and everything else of a solve */

    int verify_refine;
    size_t verify_froudes;
    double verify_froude[CONFIG_FROUDE_MOST];
    size_t waves_along, waves_across; /* points of the wave pattern */

    char *text; /* "field = value" lines with the digests of the input files */
};

extern const struct settings CONFIG;

/* Command-line replacements of two fields of the file; -1: not given. */
struct config_overrides {
    int initial, iterations;
};

/* Reads and checks everything that needs no geometry. Prints a sentence with file, line and field
 * for all that is wrong. */
bool config_read(const char *path, const struct config_overrides *overrides, struct config *config);
/* The same from the canonical text of a run; there is no path, and hull and shape are names. False
 * for a text that no version of this command wrote. */
bool config_restore(const char *text, struct config *config);
void config_free(struct config *config);

/* Whether every design is a hull of parameters.command: else the latent space of a shape, or of
 * snapshots of the command, moves the grid. */
bool config_by_command(const struct config *config);

/* What the fields of a command stand for: a fields_value with a struct config_fields. */
struct config_fields {
    const struct config *config;
    const double *x;         /* [n_parameters] */
    const char *here, *hull; /* folder of the configuration; the hull to judge, or NULL */
};
bool config_field(void *fields, const char *name, size_t length, FILE *out);

/* First line in which two canonical texts differ, as "SIDE '...', SIDE '...'" in sentence[size];
 * false when they are equal. */
bool config_difference(const char *a, const char *b, const char *const sides[2], char *sentence,
                       size_t size);

#endif
