/* The subcommands of igabem: each takes its own argument vector and returns the exit code. */
#ifndef IGABEM_TOOL_COMMANDS_H
#define IGABEM_TOOL_COMMANDS_H

int command_green(int argc, char **argv);
int command_hydrostatics(int argc, char **argv);
int command_check(int argc, char **argv);
int command_solve(int argc, char **argv);

#endif
