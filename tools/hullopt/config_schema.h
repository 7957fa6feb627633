/* The form of the YAML file, every scalar as the text that stands in it. */
#ifndef HULLOPT_CONFIG_SCHEMA_H
#define HULLOPT_CONFIG_SCHEMA_H

#include "yaml_file.h"

#include <stdbool.h>

struct config_file {
    char *name, *hull, *shape;
    struct config_grid {
        char *sections, *girth;
    } grid;
    struct config_latent {
        char *samples, *seed, *variance;
    } latent;
    struct config_reconstruction {
        char *tolerance;
    } reconstruction;
    struct config_flow {
        char *froude, *gravity, *density;
    } flow;
    struct config_solver {
        char *formulation, *refine, *elements_u, *elements_v, *degree, *line_term, *cutoff_angle,
            *cutoff_factor, *stem_limit, *stern_length, *stern_blend, *spectrum_limit, *tolerance;
    } solver;
    struct config_constraints {
        char *displacement, *breadth, *entrance, *pressure, *speeds;
    } constraints;
    struct config_search {
        char *initial, *iterations, *design, *strategy, *seed;
    } search;
    struct config_verification {
        char *refine;
        char **froude;
        unsigned froude_count;
    } verification;
    struct config_waves {
        char *along, *across;
    } waves;
};

/* On failure prints the sentence and returns false. */
bool config_file_load(const char *path, struct config_file **file);
void config_file_free(struct config_file *file);

#endif
