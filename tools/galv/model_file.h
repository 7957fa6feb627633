/* Model files: HDF5 with everything that makes a latent space usable later (docs/galv.md lists the
 * datasets). */
#ifndef GALV_TOOL_MODEL_FILE_H
#define GALV_TOOL_MODEL_FILE_H

#include "shape_yaml.h"

#include <galv/galv.h>

#include <stdbool.h>
#include <stddef.h>

struct model_file {
    galv_model *model;
    struct shape_definition shape; /* of no parameters: the samples are snapshots */
    size_t sections, girth;        /* of the grid, 0 when the points are no grid */
    bool uniform; /* samples from the stream of `seed` (from 0 on) or from a file */
    size_t seed;
    size_t drawn;        /* samples from the start of the stream of `seed` that the model has */
    bool moments;        /* those of `set` are appended */
    galv_moment_set set; /* sections and girth as above */
    size_t rows;         /* quantities given per sample that are appended behind them */
    char hull[512];      /* where the parent came from */
};

/* Both print why on failure. Writing takes nothing over. */
bool model_file_write(const char *path, const struct model_file *file);
bool model_file_read(const char *path, struct model_file *file);
void model_file_free(struct model_file *file);

/* The appended quantities of the model, without values of those given per sample; count 0 without.
 * set: filled, must outlive extra. */
void model_file_extra(const struct model_file *file, galv_moment_set *set, galv_extra *extra);

const char *method_name(galv_method method);

#endif
