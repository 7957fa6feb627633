/* What the commands of galv are asked to do: each has a table of the members it takes. */
#ifndef GALV_TOOL_ARGUMENTS_H
#define GALV_TOOL_ARGUMENTS_H

#include "model_file.h"
#include "output.h"
#include "settings.h"

struct arguments {
    char *model;
    char *hull, *shape, *snapshots, *dataset, *samples, *rows, *parameters, *latent, *output;
    size_t grid[2];
    size_t random, modes, spectrum, workspace, frames;
    uint64_t seed;
    double variance, scale, share;
    size_t order;      /* of appended moments */
    size_t section[3]; /* of those of sections: order, first from 1, stride */
    size_t n_section, n_grid;
    galv_method method;
    int area; /* weights of the points by area */
    bool seed_given, order_given, centre, displacements, json;
    const struct settings *table;
    struct model_file file; /* of MODEL */
    struct warnings warnings;
};

#define OPTION(name, kind, member, ...)                                                            \
    {                                                                                              \
        .option = (name), .type = SETTING_##kind, .offset = offsetof(struct arguments, member),    \
        __VA_ARGS__                                                                                \
    }
/* Rows that several commands have. */
#define OPTION_MODEL OPTION("MODEL", TEXT, model, .required = true, .sentence = "a model file")
#define OPTION_JSON  OPTION("json", SWITCH, json, .sentence = "print one JSON object")
#define OPTION_SHOWN                                                                               \
    OPTION("modes", COUNT, modes, .least = 1, .most = 1000, .otherwise = "3",                      \
           .sentence = "how many of the leading modes")
#define OPTION_PICTURE                                                                             \
    OPTION("output", TEXT, output, .letter = 'o', .required = true,                                \
           .sentence = "the picture, .svg, .png or .pdf")
#define OPTION_WRITTEN                                                                             \
    OPTION("output", TEXT, output, .letter = 'o', .sentence = "write the model, HDF5")
#define OPTION_RANDOM                                                                              \
    OPTION("random", COUNT, random, .least = 1, .most = 1e9,                                       \
           .sentence = "so many uniform draws within the bounds of the modification")
#define OPTION_SAMPLES                                                                             \
    OPTION("samples", TEXT, samples,                                                               \
           .sentence = "parameter vectors instead, CSV, a column per parameter, in order")
#define OPTION_VARIANCE                                                                            \
    OPTION("variance", NUMBER, variance, .least = 0, .most = 1, .open_least = true,                \
           .otherwise = "0.95", .sentence = "share of the variance to retain")
#define OPTION_KEPT                                                                                \
    OPTION("modes", COUNT, modes, .least = 1, .most = 1e6, .sentence = "keep so many instead")
#define OPTION_PARAMETERS                                                                          \
    OPTION("parameters", TEXT, parameters,                                                         \
           .sentence = "x1,x2,... (numbers left out are 0), or a CSV file")
#define OPTION_LATENT                                                                              \
    OPTION("latent", TEXT, latent, .sentence = "u1,u2,... (numbers left out are 0), or a CSV file")

/* Reads the command line, and the model where the table has one. Returns -1 to go on (then
 * arguments_free()), else the exit code. */
int arguments_read(int argc, char **argv, const struct settings *table,
                   struct arguments *arguments);
void arguments_free(struct arguments *arguments);
/* Whether the model has parameters; one of snapshots has none, which is printed. */
bool arguments_have_parameters(const struct arguments *arguments);

/* For a check: exactly one of two members is given. */
void arguments_either(struct settings_source *source, const char *one, bool has_one,
                      const char *other, bool has_other);

/* A command that draws one picture into a file and tells of it. Returns the exit code. */
int picture_command(int argc, char **argv, const struct settings *table,
                    bool (*draw)(const struct arguments *));

/* Rows of numbers that commands take. */
struct rows {
    size_t count, width;
    double *values;
};

/* TEXT is "u1,u2,..." or the path of a CSV file with `width` columns: in order, or named PREFIX1,
 * PREFIX2, ..., with or without a header line. Fewer numbers on the command line are completed by
 * zeros. Prints why on failure. */
bool rows_read(const char *text, size_t width, const char *prefix, struct rows *rows);
void rows_free(struct rows *rows);
/* Warns of parameters outside of the bounds of the modification, and names the first. */
void rows_check_bounds(const struct rows *rows, const char *text,
                       const struct shape_definition *shape, struct warnings *warnings);

#endif
