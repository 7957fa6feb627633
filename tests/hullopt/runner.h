/* Runs the hullopt command in a process of its own, with its output in files. */
#ifndef TESTS_HULLOPT_RUNNER_H
#define TESTS_HULLOPT_RUNNER_H

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

enum { RUNNER_TEXT = 65536, RUNNER_ARGUMENTS = 12 };

struct runner {
    char folder[120]; /* scratch, made by runner_open */
    char out[RUNNER_TEXT], err[RUNNER_TEXT];
};

static inline int runner_open(struct runner *runner)
{
    snprintf(runner->folder, sizeof runner->folder, "%s/hullopt_run_XXXXXX", check_scratch());
    return mkdtemp(runner->folder) != NULL;
}

static inline int runner_close(struct runner *runner)
{
    char command[160];
    snprintf(command, sizeof command, "rm -rf %s", runner->folder);
    return system(command);
}

static inline void runner_path(const struct runner *runner, const char *name, char *path, size_t n)
{
    snprintf(path, n, "%s/%s", runner->folder, name);
}

static inline void runner_write(const struct runner *runner, const char *name, const char *text)
{
    char path[200];
    runner_path(runner, name, path, sizeof path);
    FILE *file = fopen(path, "w");
    if (file) {
        fputs(text, file);
        fclose(file);
    }
}

static inline size_t runner_read(const char *path, char *text, size_t size)
{
    FILE *file = fopen(path, "r");
    size_t n = file ? fread(text, 1, size - 1, file) : 0;
    text[n] = '\0';
    if (file)
        fclose(file);
    return n;
}

/* Starts the command; arguments end with NULL. */
static inline pid_t runner_start(const struct runner *runner, const char *const *arguments)
{
    char out[160], err[160];
    const char *argv[RUNNER_ARGUMENTS + 2] = {HULLOPT_PATH};
    for (int k = 0; k < RUNNER_ARGUMENTS && arguments[k]; k++)
        argv[k + 1] = arguments[k];
    runner_path(runner, "stdout", out, sizeof out);
    runner_path(runner, "stderr", err, sizeof err);
    fflush(NULL);
    pid_t child = fork();
    if (child != 0)
        return child;
    int o = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    int e = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(o, STDOUT_FILENO);
    dup2(e, STDERR_FILENO);
    execv(HULLOPT_PATH, (char *const *)argv);
    _exit(127);
}

/* Exit code; -1 when a signal ended it. Reads what it printed. */
static inline int runner_wait(struct runner *runner, pid_t child)
{
    int status = -1;
    char path[160];
    waitpid(child, &status, 0);
    runner_path(runner, "stdout", path, sizeof path);
    runner_read(path, runner->out, sizeof runner->out);
    runner_path(runner, "stderr", path, sizeof path);
    runner_read(path, runner->err, sizeof runner->err);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static inline int runner_run(struct runner *runner, const char *const *arguments)
{
    return runner_wait(runner, runner_start(runner, arguments));
}

/* A run configuration over the shipped Wigley hull that needs no matrix: each evaluation takes
 * milliseconds. extra replaces nothing and is appended. */
static inline void runner_configuration(const struct runner *runner, const char *name,
                                        const char *hull, int initial, int iterations,
                                        const char *extra)
{
    char text[3000];
    snprintf(text, sizeof text,
             "name: small\nhull: %s\nshape: " EXAMPLES_DIR "/wigley_shape.yaml\n"
             "grid: {sections: 21, girth: 9}\n"
             "latent: {samples: 200, variance: 0.95}\n"
             "flow: {froude: 0.316}\n"
             "solver: {formulation: hogner, tolerance: 1e-3, surface_cells: 8}\n"
             "reconstruction: {tolerance: 1e-3}\n"
             "constraints: {displacement: 0.05}\n"
             "search: {initial: %d, iterations: %d}\n"
             "verification: {refine: 1}\n"
             "waves: {along: 6, across: 4}\n%s",
             hull, initial, iterations, extra);
    runner_write(runner, name, text);
}

#endif
