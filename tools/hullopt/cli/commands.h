/* The commands of hullopt; each returns an exit code. */
#ifndef HULLOPT_COMMANDS_H
#define HULLOPT_COMMANDS_H

#include "config.h"

struct options {
    char *path, *shape, *out; /* configuration, hull or folder of a run; shape file */
    double froude;            /* NAN: not given */
    struct config_overrides overrides;
    bool resume;
    char *servers; /* of a run, "URL,URL"; NULL: none */
    char *address; /* of a server, and its port */
    int port, jobs;
    double timeout;              /* of one of several designs at once, s */
    double *latent, *parameters; /* of one design */
    size_t n_latent, n_parameters;
    char **folders; /* of the words, for a command that takes any number */
    size_t n_folders;
    size_t design; /* that a report is about; 0: the best */
    bool json;     /* the result on standard output instead of the figures */
    double start;  /* of the command, cli_seconds() */
};

/* One design, for an optimiser of one's own. */
int evaluate_command(const struct options *options);
/* Runs of one problem beside each other. */
int compare_command(const struct options *options);
/* What a run may gain and what each constraint costs. */
int forecast_command(const struct options *options);
/* All stages of an optimisation, from the configuration to the report. */
int run_command(const struct options *options);
/* Writes summary, hulls and report of a run folder again, into the folder `out` or, when that is
 * NULL, the run's own. Of a folder that may not be written the figures are printed. */
int report_command(const struct options *options);
/* A configuration with every key, its meaning and its default. */
int init_command(const struct options *options);
/* Reads all that a run reads, evaluates the parent, tells what would be done. */
int check_command(const struct options *options);
/* Where a run stands, also while it is at work. Writes nothing. */
int status_command(const struct options *options);
/* Offers the problem as a model of UM-Bridge until it is told to stop. */
int serve_command(const struct options *options);

#endif
