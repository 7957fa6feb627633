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
    plot_command;

/* Options every subcommand takes, at the end of its getopt_long table. */
#define COMMON_OPTIONS                                                                             \
    {"json", no_argument, NULL, 'J'},                                                              \
    {                                                                                              \
        "threads", required_argument, NULL, 'T'                                                    \
    }
#define END_OF_OPTIONS                                                                             \
    {                                                                                              \
        NULL, 0, NULL, 0                                                                           \
    }

/* Handles a letter of getopt_long that the subcommand does not know itself: CLI_OK, or the exit
 * code after a message. */
int common_option(int letter, char **argv, bool *json);

/* Options whose value is a number: CLI_OK or CLI_USAGE after a message. */
int number_option(const char *name, const char *text, double *value);
int length_option(const char *name, const char *text, double *value);

/* Checks that exactly n operands follow the options; `what` names them all. */
int operand_count(int argc, char **argv, int n, const char *what);

/* One JSON object on standard output; steals the reference. */
int print_json(json_t *object);

/* "nurbs: <last error>" on stderr; returns CLI_FAILED. */
int library_failure(void);

/* Reads a NURBS file of any format that is read. */
int load_patches(const char *path, nurbs_patches **patches);
int load_surface(const char *path, size_t index, nurbs_patches **patches,
                 const nurbs_surface **surface);

/* Writes one surface, or several patches, by extension, with the length and note of `from` (NULL:
 * none). */
int save_surface(const nurbs_surface *surface, const nurbs_patches *from, const char *path);

/* Largest distance from the grid to the surface at u x v. */
int grid_deviation(const nurbs_surface *surface, const nurbs_grid *grid, const double *u,
                   const double *v, double *worst);

#endif
