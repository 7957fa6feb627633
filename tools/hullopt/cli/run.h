/* hullopt run: all stages of an optimisation, from the configuration to the report. */
#ifndef HULLOPT_RUN_H
#define HULLOPT_RUN_H

#include "config.h"

struct run_options {
    const char *configuration, *out;
    struct config_overrides overrides;
    bool resume;
    bool json; /* the summary on standard output instead of the figures */
    int threads;
    double start; /* of the command, cli_seconds() */
};

/* Returns an exit code. */
int run_command(const struct run_options *options);

/* hullopt report: writes summary, hulls and report of a run folder again, into the folder `out` or,
 * when that is NULL, the run's own. Of a folder that may not be written the figures are printed. */
int report_command(const char *folder, const char *out, bool json);

#endif
