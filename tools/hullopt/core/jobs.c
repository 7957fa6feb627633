#include "core/jobs.h"

#include "cli.h"
#include "core/remote.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

struct job *jobs_create(size_t n, size_t modes)
{
    struct job *jobs = calloc(n, sizeof *jobs);
    double *u = jobs ? malloc(n * modes * sizeof *u) : NULL;
    for (size_t i = 0; i < n && u; i++)
        jobs[i] = (struct job){.u = u + i * modes, .slot = i};
    if (u)
        return jobs;
    free(jobs);
    return NULL;
}

static int reap(struct job *job)
{
    int status = 0;
    while (waitpid(job->process, &status, 0) < 0 && errno == EINTR)
        continue;
    close(job->pipe);
    job->process = 0;
    return status;
}

void jobs_free(struct job *jobs, size_t n)
{
    for (size_t i = 0; i < n && jobs; i++)
        if (jobs[i].process) {
            kill(jobs[i].process, SIGKILL);
            reap(&jobs[i]);
        }
    free(jobs ? jobs[0].u : NULL);
    free(jobs);
}

/* The parent's threads are not in a child: all that it solves takes one. */
static void use_one_thread(struct problem *problem)
{
    problem->solver.threads = 1;
    for (size_t i = 0; i < problem->speeds; i++)
        problem->speed[i].threads = 1;
}

static _Noreturn void become_job(struct problem *problem, struct evaluation *e, pid_t parent,
                                 int out)
{
    const char *bytes = (const char *)e;
    size_t written = 0;
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (getppid() != parent)
        _exit(1);
    signal(SIGINT, SIG_IGN); /* the run ends after the designs at hand */
    use_one_thread(problem);
    evaluate(problem, e, NULL, NULL);
    while (written < sizeof *e) {
        ssize_t n = write(out, bytes + written, sizeof *e - written);
        if (n < 0 && errno != EINTR)
            _exit(1);
        written += n > 0 ? (size_t)n : 0;
    }
    _exit(0);
}

bool jobs_start(struct problem *problem, struct job *job)
{
    int ends[2];
    pid_t parent = getpid();
    if (pipe(ends) != 0)
        return core_fail("starting a process: %s", strerror(errno));
    fflush(NULL);
    if (problem->remote)
        remote_choose(problem->remote, job->slot);
    job->start = cli_seconds();
    job->process = fork();
    if (job->process == 0) {
        close(ends[0]);
        become_job(problem, &job->evaluation, parent, ends[1]);
    }
    close(ends[1]);
    job->pipe = ends[0];
    if (job->process > 0)
        return true;
    close(ends[0]);
    job->process = 0;
    return core_fail("starting a process: %s", strerror(errno));
}

static void fail(struct job *job, int status, bool late)
{
    struct evaluation *e = &job->evaluation;
    evaluation_start(e->id, e->phase, e->u, e);
    e->failed = true;
    e->solve_seconds = cli_seconds() - job->start;
    if (late)
        snprintf(e->reason, sizeof e->reason, "process: not done after %.0f s", e->solve_seconds);
    else if (WIFSIGNALED(status))
        snprintf(e->reason, sizeof e->reason, "process: ended by signal %d (%s)", WTERMSIG(status),
                 strsignal(WTERMSIG(status)));
    else
        snprintf(e->reason, sizeof e->reason, "process: ended with status %d", WEXITSTATUS(status));
}

/* What the child made of the evaluation; its pointers hold in this process, which lent them. */
static void collect(struct job *job, bool late)
{
    struct evaluation answer;
    size_t size = 0;
    ssize_t n = 1;
    job->late = late;
    if (late)
        kill(job->process, SIGKILL);
    while (size < sizeof answer && n != 0) {
        n = read(job->pipe, (char *)&answer + size, sizeof answer - size);
        size += n > 0 ? (size_t)n : 0;
        if (n < 0 && errno != EINTR)
            break;
    }
    int status = reap(job);
    if (status == 0 && size == sizeof answer)
        job->evaluation = answer;
    else
        fail(job, status, late);
}

struct job *jobs_wait(struct job *jobs, size_t n, double most_seconds)
{
    enum { MOST = 64, SECOND = 1000 };
    for (;;) {
        struct pollfd ready[MOST];
        nfds_t at_work = 0;
        for (size_t i = 0; i < n; i++)
            if (jobs[i].process)
                ready[at_work++] = (struct pollfd){.fd = jobs[i].pipe, .events = POLLIN};
        if (at_work == 0)
            return NULL;
        poll(ready, at_work, most_seconds > 0 ? SECOND : -1);
        for (size_t i = 0, k = 0; i < n; i++) {
            if (!jobs[i].process)
                continue;
            bool late = most_seconds > 0 && cli_seconds() - jobs[i].start > most_seconds;
            if (ready[k++].revents || late) {
                collect(&jobs[i], late && !ready[k - 1].revents);
                return &jobs[i];
            }
        }
    }
}
