/* The subcommands of galv: each takes its own argument vector and returns the exit code. */
#ifndef GALV_TOOL_COMMANDS_H
#define GALV_TOOL_COMMANDS_H

int command_reduce(int argc, char **argv);

#endif
