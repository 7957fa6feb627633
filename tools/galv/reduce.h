/* What `galv reduce` was asked to do. */
#ifndef GALV_TOOL_REDUCE_H
#define GALV_TOOL_REDUCE_H

#include <galv/galv.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct reduce_options {
    const char *hull, *shape, *samples, *output;
    size_t sections, girth; /* to sample a NURBS hull at; 0: its own design grid */
    size_t random;          /* 0: samples from the file */
    uint64_t seed;
    galv_options build;
    bool area_weights, json;
    bool moments;        /* append those of `set` (but for the size of its grid) */
    galv_moment_set set; /* orders and sections */
    const char *rows;    /* CSV of quantities to append, one line per sample; NULL: none */
    double share;        /* variance of all that is appended, relative to the points' */
    int threads;         /* 0: as the environment says */
};

/* Fills the options from the command line. Returns -1 to go on, else the exit code. */
int reduce_parse(int argc, char **argv, struct reduce_options *options);

/* One JSON object with the figures of the model on stdout. */
int reduce_print_json(const galv_model *model, const struct reduce_options *options,
                      double seconds);
/* The same for people. */
int reduce_print_text(const galv_model *model, const struct reduce_options *options,
                      double seconds);

#endif
