/* The subcommands of bayesopt: each takes its own argument vector and returns the exit code. */
#ifndef BAYESOPT_TOOL_COMMANDS_H
#define BAYESOPT_TOOL_COMMANDS_H

#include "settings.h"

/* A row of the options of a command, whose target is its struct arguments. */
#define OPTION(name, kind, member, ...)                                                            \
    {                                                                                              \
        .option = (name), .type = SETTING_##kind, .offset = offsetof(struct arguments, member),    \
        __VA_ARGS__                                                                                \
    }

#define OPTION_JSON OPTION("json", SWITCH, json, .sentence = "one JSON object")

int command_run(int argc, char **argv);
int command_ask(int argc, char **argv);
int command_tell(int argc, char **argv);
int command_release(int argc, char **argv);
int command_heartbeat(int argc, char **argv);
int command_predict(int argc, char **argv);
int command_best(int argc, char **argv);
int command_status(int argc, char **argv);
int command_plot(int argc, char **argv);
int command_report(int argc, char **argv);
int command_design(int argc, char **argv);
int command_export(int argc, char **argv);

struct names;
typedef struct bayesopt bayesopt;
/* The Pareto set of a store with several objectives, as CSV or JSON; false after a sentence. */
bool print_front(bayesopt *bo, const struct names *names, bool json);
/* What a command that writes a file tells of it as JSON: its name, and of how many evaluations it
 * is. */
bool print_file(const char *path, const bayesopt *bo);

#endif
