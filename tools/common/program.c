#include "program.h"

#include "cli.h"
#include "result.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* Of the program's last words in a reason. */
enum { MOST_WORDS = 200 };

bool program_folder(const char *parent, unsigned long long number, char *folder, size_t size)
{
    if (mkdir(parent, 0777) != 0 && errno != EEXIST)
        return false;
    int at = snprintf(folder, size, "%s/%06llu", parent, number);
    size_t left = at > 0 && (size_t)at < size ? size - (size_t)at : 0;
    bool made = false, ok = true;
    for (unsigned k = 2; ok && !made; k++) {
        if (left < 16) {
            errno = ENAMETOOLONG;
            ok = false;
        } else if (!(made = mkdir(folder, 0777) == 0)) {
            ok = errno == EEXIST && k < 1000000;
            snprintf(folder + at, left, ".%u", k);
        }
    }
    return ok;
}

/* Output files and no input, in the working folder. */
bool program_enter(const char *folder)
{
    if (chdir(folder) != 0)
        return false;
    int out = open("stdout", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    int err = open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0666);
    int in = open("/dev/null", O_RDONLY);
    return out >= 0 && err >= 0 && in >= 0 && dup2(in, 0) >= 0 && dup2(out, 1) >= 0 &&
           dup2(err, 2) >= 0;
}

static void kill_group(int signal_number)
{
    (void)signal_number;
    kill(0, SIGKILL);
}

/* In the child: a process group of its own, to be killed as one, and a signal when the driver dies.
 * Scripts that end with 'kill 0' mean their own children, so SIGTERM is not that signal. */
static void become_keeper(pid_t driver)
{
    setpgid(0, 0);
    signal(SIGUSR2, kill_group);
    signal(SIGTERM, SIG_IGN);
    signal(SIGINT, SIG_DFL);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGUSR2);
#endif
    if (getppid() != driver) /* it has died already */
        kill(0, SIGKILL);
}

pid_t program_fork(void)
{
    pid_t driver = getpid();
    fflush(NULL); /* a copy of what is not written yet would be written twice */
    pid_t process = fork();
    if (process == 0)
        become_keeper(driver);
    else if (process > 0)
        setpgid(process, process); /* in both, whichever comes first */
    return process;
}

void program_kill(pid_t process)
{
    kill(-process, SIGKILL);
}

/* Waits for the command and ends as it did. */
static void end_like(pid_t process)
{
    int status;
    while (waitpid(process, &status, 0) < 0)
        if (errno != EINTR)
            _exit(127);
    if (!WIFSIGNALED(status))
        _exit(WEXITSTATUS(status));
    struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
    signal(WTERMSIG(status), SIG_DFL);
    raise(WTERMSIG(status));
    _exit(128 + WTERMSIG(status));
}

_Noreturn void program_become(const char *folder, const char *command)
{
    pid_t process = program_enter(folder) ? fork() : -1;
    if (process > 0)
        end_like(process);
    if (process < 0)
        _exit(127);
    signal(SIGUSR2, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    execl("/bin/sh", "sh", "-c", command, (char *)NULL);
    _exit(127);
}

char *program_read(const char *folder, const char *name)
{
    char *path = malloc(strlen(folder) + strlen(name) + 2), *text = NULL;
    size_t length = 0;
    if (path) {
        sprintf(path, "%s/%s", folder, name);
        text = cli_read(path, &length);
    }
    for (size_t i = 0; text && i < length; i++)
        if (!text[i])
            text[i] = ' ';
    free(path);
    return text;
}

void program_add_words(const char *err, const char *out, char *reason, size_t size)
{
    size_t used = strlen(reason), length = 0;
    const char *line = err ? result_last_line(err, &length) : NULL;
    if (!length && out)
        line = result_last_line(out, &length);
    if (length)
        snprintf(reason + used, size - used, ": %.*s",
                 (int)(length < MOST_WORDS ? length : MOST_WORDS), line);
}

/* Waits, at last looking twenty times a second; *late: the time was up, and it was ended. */
static int wait_for(pid_t process, double seconds, bool *late)
{
    double start = cli_seconds();
    int status = 0;
    for (long pause = 1; waitpid(process, &status, WNOHANG) == 0; pause += pause < 50) {
        if (!*late && cli_seconds() - start > seconds) {
            *late = true;
            program_kill(process);
        }
        nanosleep(&(struct timespec){.tv_nsec = pause * 1000000}, NULL);
    }
    return status;
}

bool program_run(const char *folder, const char *command, double seconds, char *reason, size_t size)
{
    bool late = false;
    pid_t process = program_fork();
    if (process == 0)
        program_become(folder, command);
    if (process < 0) {
        snprintf(reason, size, "starting a process: %s", strerror(errno));
        return false;
    }
    int status = wait_for(process, seconds, &late);
    if (!late && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (late)
        snprintf(reason, size, "took longer than %g s", seconds);
    else if (WIFSIGNALED(status))
        snprintf(reason, size, "killed by signal %d", WTERMSIG(status));
    else
        snprintf(reason, size, "exit status %d", WEXITSTATUS(status));
    char *out = program_read(folder, "stdout"), *err = program_read(folder, "stderr");
    program_add_words(err, out, reason, size);
    free(out);
    free(err);
    return false;
}
