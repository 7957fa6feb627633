/* The command line of the commands that use a model: MODEL [OPTION]... */
#ifndef GALV_TOOL_USE_H
#define GALV_TOOL_USE_H

#include "model_file.h"

#include <stdbool.h>
#include <stddef.h>

struct use {
    struct model_file file;
    const char *hull, *parameters, *latent, *output, *samples;
    size_t modes, frames, random, seed;
    double scale, variance; /* variance 0: not given */
    bool json, seed_given;
};

/* Which options a command takes. */
enum use_options {
    USE_HULL = 1,
    USE_PARAMETERS = 2,
    USE_LATENT = 4,
    USE_OUTPUT = 8,
    USE_MODES = 16,
    USE_FRAMES = 32,
    USE_SAMPLES = 64, /* --random, --seed, --samples, --variance */
};

/* Parses and reads the model. Returns -1 to go on (then use_free()), else the exit code. */
int use_start(int argc, char **argv, const char *help, unsigned allowed, struct use *use);
void use_free(struct use *use);

#endif
