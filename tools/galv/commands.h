/* The subcommands of galv: each takes its own argument vector and returns the exit code. */
#ifndef GALV_TOOL_COMMANDS_H
#define GALV_TOOL_COMMANDS_H

int command_reduce(int argc, char **argv);
int command_extend(int argc, char **argv);
int command_info(int argc, char **argv);
int command_project(int argc, char **argv);
int command_reconstruct(int argc, char **argv);
int command_backmap(int argc, char **argv);
int command_plot(int argc, char **argv);
int command_animate(int argc, char **argv);

#endif
