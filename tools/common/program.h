/* Programs of other people: a command in a folder of its own, with its output in files there. It
 * dies with the process that started it, and all that it has started in its process group too. */
#ifndef TOOLS_PROGRAM_H
#define TOOLS_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

/* Makes the folder PARENT/000017 of a number, and PARENT where there is none; is there one of that
 * number, a second number gets behind it. False with errno. */
bool program_folder(const char *parent, unsigned long long number, char *folder, size_t size);

/* Copies a process, as fork() does: the copy is a process group of its own, to be killed as one,
 * that ends when this process does. -1 with errno. */
pid_t program_fork(void);
/* In the copy: works in the folder, without input, its output in the files stdout and stderr. */
bool program_enter(const char *folder);
/* In the copy: becomes the command of the shell there. */
_Noreturn void program_become(const char *folder, const char *command);
/* Ends the group. */
void program_kill(pid_t process);

/* Adds ": " and the program's own last words, of stderr or else of stdout, to a reason. */
void program_add_words(const char *err, const char *out, char *reason, size_t size);
/* A file of a folder as a text without zeros; NULL with errno. The caller frees. */
char *program_read(const char *folder, const char *name);

/* Runs the command in the folder for at most so many seconds. False with the reason when it cannot
 * be started, ends otherwise than with status 0, or takes longer. */
bool program_run(const char *folder, const char *command, double seconds, char *reason,
                 size_t size);

#endif
