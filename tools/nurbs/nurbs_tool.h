/* What the subcommands of `nurbs` share. Each cmd_*.c is one subcommand (or a close family). */
#ifndef NURBS_TOOL_H
#define NURBS_TOOL_H

#include "cli.h"

#include <nurbs/nurbs.h>

#include <getopt.h>
#include <jansson.h>

/* One subcommand: its options are documented in `help`, printed for --help. */
typedef struct subcommand {
    const char *name, *summary;
    int (*run)(int argc, char **argv);
    const char *help;
} subcommand;

extern const subcommand make_command, info_command, eval_command, skin_command, fit_command,
    grid_command, simplify_command, wetted_command, hydrostatics_command, convert_command,
    plot_command, edit_command, closest_command, cut_command, moments_command, clean_command,
    sections_command;

/* What the value of an option is, and where it goes. */
typedef enum option_kind {
    OPTION_NUMBER, /* double */
    OPTION_LENGTH, /* double > 0, metres */
    OPTION_COUNT,  /* size_t from least to most */
    OPTION_TEXT,   /* const char * */
    OPTION_OUTPUT, /* const char *, also -o; must be given */
    OPTION_FLAG    /* bool, no value */
} option_kind;

typedef struct tool_option {
    const char *name;
    option_kind kind;
    void *value;
    size_t least, most; /* of a count */
} tool_option;

#define OPTION_COUNT_OF(options) (sizeof(options) / sizeof((options)[0]))

/* The option --patch K. */
#define PATCH_OPTION(value)                                                                        \
    {                                                                                              \
        "patch", OPTION_COUNT, value, 0, 1000000                                                   \
    }

/* How many operands follow the options; `what` names them all. */
typedef struct operands {
    int least, most;
    const char *what;
} operands;

static const operands one_file = {1, 1, "one NURBS file"};

/* Reads the options of a subcommand and those of every one (--json, --threads N), checks the
 * operands and that the output file is named: CLI_OK, or CLI_USAGE after a message. The operands
 * begin at argv[optind]. */
int parse_options(int argc, char **argv, size_t n, const tool_option *own, operands wanted,
                  bool *json);

/* One JSON object on standard output; steals the reference. */
int print_json(json_t *object);

/* "nurbs: <last error>" on stderr; returns CLI_FAILED. */
int library_failure(void);

/* Whether a file holds triangles, offsets, stations or a grid, which are read as the one surface
 * through them. */
bool is_skinned(const char *path);

/* Reads a NURBS file of any format that is read. */
int load_patches(const char *path, nurbs_patches **patches);
int load_surface(const char *path, size_t index, nurbs_patches **patches,
                 const nurbs_surface **surface);

/* Reads a hull and tells on stderr what was done to the file. */
int load_hull(const char *path, const nurbs_hull_options *options, nurbs_hull **hull);

/* A new array of these sentences: "warnings" of JSON results. */
json_t *hull_steps(const nurbs_hull *hull);

/* Creates an empty set of patches with the length and note of `from` (NULL: none). */
nurbs_status start_patches(const nurbs_patches *from, nurbs_patches **patches);

/* Adds a surface that stands for patch `index` of `from`, with its design grid's parameters. */
nurbs_status add_with_parameters(const nurbs_surface *surface, const nurbs_patches *from,
                                 size_t index, nurbs_patches *patches);

/* Writes one surface by extension, with the length and note of `from` (NULL: none). */
int save_surface(const nurbs_surface *surface, const nurbs_patches *from, const char *path);

/* Largest distance from the grid to the surface at u x v. */
int grid_deviation(const nurbs_surface *surface, const nurbs_grid *grid, const double *u,
                   const double *v, double *worst);

#endif
