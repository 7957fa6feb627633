/* Preloaded (LD_PRELOAD) into a program, makes its k-th call to the disk fail:
 *
 * - FAULT_AT=k: calls that write, sync, cut, make, rename or remove regular files are counted from
 *   the start of main(), also those of stdio and SQLite; the k-th answers with FAULT_ERROR: ENOSPC,
 *   EIO, EINTR, EROFS, or "short": a write of which half arrives. 0 or unset: none.
 * - FAULT_STAYS=1: so do all that follow, as a disk that is full.
 * - FAULT_TRACE=1 prints the calls that led to it on standard error.
 * - FAULT_COUNT=FILE receives the number of calls when the program ends.
 *
 * A filter of the kernel (seccomp) hands these calls to a handler here, which makes them itself.
 * Linux on x86-64 and AArch64; needs glibc. */
#include "start.h"

#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#ifdef __x86_64__
#define RESULT(c) (c)->uc_mcontext.gregs[REG_RAX]
#define ARGUMENT(c, k)                                                                             \
    (c)->uc_mcontext.gregs[(const int[]){REG_RDI, REG_RSI, REG_RDX, REG_R10, REG_R8}[k]]
#else
#define RESULT(c)      (c)->uc_mcontext.regs[0]
#define ARGUMENT(c, k) (c)->uc_mcontext.regs[k]
#endif

/* None of these calls has a sixth argument: it marks those made here. */
static const uint64_t OWN = 0x6661756c74646973;

/* And openat() that may make a file. */
static const int watched[] = {
    SYS_write,     SYS_pwrite64,  SYS_writev,   SYS_fsync,    SYS_fdatasync,
    SYS_ftruncate, SYS_renameat2, SYS_renameat, SYS_unlinkat, SYS_mkdirat,
#ifdef SYS_rename
    SYS_rename,    SYS_unlink,    SYS_mkdir,
#endif
};
enum { WATCHED = sizeof watched / sizeof *watched };

static int fault_error; /* 0: short */
static bool stays;

static bool is_write(int call)
{
    return call == SYS_write || call == SYS_pwrite64 || call == SYS_writev;
}

static bool removes(int call)
{
#ifdef SYS_unlink
    if (call == SYS_unlink)
        return true;
#endif
    return call == SYS_unlinkat || call == SYS_ftruncate;
}

/* Of regular files, standard error left out; what may fail so: a full disk lets remove, and only
 * writing and what waits for it are cut short or interrupted. */
static bool counts(int call, const ucontext_t *c)
{
    struct stat info;
    bool of_file = is_write(call) || call == SYS_fsync || call == SYS_fdatasync;
    if (of_file || call == SYS_ftruncate) {
        int saved = errno, file = (int)ARGUMENT(c, 0);
        bool regular = file != STDERR_FILENO && fstat(file, &info) == 0 && S_ISREG(info.st_mode);
        errno = saved;
        if (!regular)
            return false;
    }
    switch (fault_error) {
    case 0:
        return is_write(call);
    case EINTR:
        return of_file;
    case ENOSPC:
        return !removes(call);
    default:
        return true;
    }
}

static void handle(int signal, siginfo_t *info, void *context)
{
    ucontext_t *c = context;
    int call = info->si_syscall, saved = errno;
    (void)signal;
    if (atomic_load(&armed) && counts(call, c)) {
        unsigned long k = atomic_fetch_add(&count, 1) + 1;
        if (k == fault_at || (stays && fault_at && k > fault_at)) {
            if (k == fault_at)
                trace();
            if (fault_error) {
                RESULT(c) = -fault_error;
                errno = saved;
                return;
            }
            if (is_write(call) && call != SYS_writev && ARGUMENT(c, 2) > 1)
                ARGUMENT(c, 2) /= 2;
        }
    }
    long result = syscall(call, ARGUMENT(c, 0), ARGUMENT(c, 1), ARGUMENT(c, 2), ARGUMENT(c, 3),
                          ARGUMENT(c, 4), OWN);
    RESULT(c) = result < 0 ? -errno : result;
    errno = saved;
}

static void refuse_to_start(const char *what)
{
    perror(what);
    _exit(99);
}

/* A program that this one starts inherits the filter, so that it needs the handler as well. */
static void install(bool filter)
{
    const struct sigaction action = {.sa_sigaction = handle, .sa_flags = SA_SIGINFO | SA_NODEFER};
    struct sock_filter rules[2 * WATCHED + 12];
    unsigned short n;
    if (sigaction(SIGSYS, &action, NULL) != 0)
        refuse_to_start("sigaction");
    if (!filter)
        return;
    const size_t sixth = offsetof(struct seccomp_data, args[5]); /* its lower half first */
    const struct sock_filter own[] = {
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, (uint32_t)sixth),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)OWN, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, (uint32_t)sixth + 4),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)(OWN >> 32), 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, nr)),
    };
    memcpy(rules, own, sizeof own);
    n = sizeof own / sizeof *own;
    for (int k = 0; k < WATCHED; k++) {
        const struct sock_filter trap[] = {
            BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)watched[k], 0, 1),
            BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
        };
        memcpy(rules + n, trap, sizeof trap);
        n += 2;
    }
    /* What only reads is let through, as the loader of a program has no handler yet. */
    const struct sock_filter make[] = {
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, 3),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[2])),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, O_CREAT, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    memcpy(rules + n, make, sizeof make);
    n += sizeof make / sizeof *make;
    const struct sock_fprog program = {n, rules};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
        refuse_to_start("seccomp");
}

static int error_of(const char *name)
{
    static const struct {
        const char *name;
        int number;
    } errors[] = {
        {"ENOSPC", ENOSPC}, {"EIO", EIO}, {"EINTR", EINTR}, {"EROFS", EROFS}, {"short", 0}};
    for (size_t k = 0; k < sizeof errors / sizeof *errors; k++)
        if (strcmp(errors[k].name, name) == 0)
            return errors[k].number;
    fprintf(stderr, "FAULT_ERROR=%s is none of ENOSPC, EIO, EINTR, EROFS and short\n", name);
    _exit(99);
}

static void prepare(void)
{
    const char *error = getenv("FAULT_ERROR");
    fault_error = error_of(error ? error : "EIO");
    stays = getenv("FAULT_STAYS");
    install(!getenv("FAULT_STARTED"));
    if (getenv("FAULT_STARTED")) {
        unsetenv("FAULT_COUNT");
        fault_at = 0;
    }
    setenv("FAULT_STARTED", "1", 1); /* for what it starts, which is not under test */
}
