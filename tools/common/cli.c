#include "cli.h"

#include <cblas.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

static const char *command_name = "?";

void cli_set_name(const char *name)
{
    command_name = name;
}

const char *cli_name(void)
{
    return command_name;
}

static void print_message(const char *format, va_list args)
{
    fprintf(stderr, "%s: ", command_name);
    vfprintf(stderr, format, args);
}

int cli_fail(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    print_message(format, args);
    va_end(args);
    fputc('\n', stderr);
    return CLI_FAILED;
}

bool cli_refuse(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    print_message(format, args);
    va_end(args);
    fputc('\n', stderr);
    return false;
}

void *cli_needed(void *memory)
{
    if (!memory) {
        cli_files_remove();
        exit(cli_fail("out of memory"));
    }
    return memory;
}

int cli_usage(const char *format, ...)
{
    va_list args;
    va_start(args, format);
    print_message(format, args);
    va_end(args);
    fprintf(stderr, " (try '%s --help')\n", command_name);
    return CLI_USAGE;
}

static void ignore_signal(int number)
{
    (void)number;
}

/* Descriptors 0 to 2 that the caller closed: taken by what cannot be read or written. */
static bool fill_standard_streams(void)
{
    for (int k = STDIN_FILENO; k <= STDERR_FILENO; k++)
        if (fcntl(k, F_GETFD) < 0 &&
            open("/dev/null", k == STDIN_FILENO ? O_WRONLY : O_RDONLY) != k)
            return false;
    return true;
}

int cli_main(const char *name, int (*run)(int, char **), int argc, char **argv)
{
    cli_set_name(name);
    if (!fill_standard_streams())
        return CLI_FAILED;
    /* A handler, unlike SIG_IGN, is not handed on to the programs that a command starts. */
    struct sigaction action = {.sa_handler = ignore_signal, .sa_flags = SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGPIPE, &action, NULL);
    sigaction(SIGXFSZ, &action, NULL); /* a limit of the shell for files is like a full disk */
    int code = run(argc, argv), printed = cli_printed();
    return code == CLI_OK ? printed : code;
}

static int print_commands(const char *name, const char *purpose, size_t n,
                          const struct cli_command *commands)
{
    char words[60];
    int widest = 0;
    printf("usage: %s COMMAND [OPTION]...\n\n%s\n\n", name, purpose);
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < n; k++) {
            int length = snprintf(words, sizeof words, "%s%s%s", commands[k].name,
                                  *commands[k].operands ? " " : "", commands[k].operands);
            if (pass)
                printf("  %-*s  %s\n", widest, words, commands[k].summary);
            widest = length > widest ? length : widest;
        }
    printf("\n  %-*s  this text, or with a command its own\n  %-*s  version\n", widest, "--help",
           widest, "--version");
    return cli_print("\nExit status: 0 success, 1 failure, 2 wrong usage.\n");
}

int cli_dispatch(const char *name, const char *purpose, size_t n,
                 const struct cli_command *commands, int argc, char **argv)
{
    static char title[60];
    if (argc < 2)
        return cli_usage("a command is missing");
    if (strcmp(argv[1], "--help") == 0)
        return print_commands(name, purpose, n, commands);
    if (strcmp(argv[1], "--version") == 0)
        return cli_version();
    for (size_t k = 0; k < n; k++)
        if (strcmp(argv[1], commands[k].name) == 0) {
            snprintf(title, sizeof title, "%s %s", name, commands[k].name);
            cli_set_name(title);
            return commands[k].run(argc - 1, argv + 1);
        }
    char list[400] = "";
    for (size_t k = 0, at = 0; k < n && at < sizeof list; k++)
        at += (size_t)snprintf(list + at, sizeof list - at, "%s%s",
                               k == 0      ? ""
                               : k + 1 < n ? ", "
                                           : " or ",
                               commands[k].name);
    return cli_usage("unknown command '%s', expected %s", argv[1], list);
}

int cli_printed(void)
{
    static bool told;
    bool lost = ferror(stdout), failed = fflush(stdout) == EOF;
    if (!lost && !failed)
        return CLI_OK;
    /* What failed while the buffer was filled has left no reason; one more byte asks for it. */
    if (!failed && write(STDOUT_FILENO, "\n", 1) == 1)
        errno = EIO;
    if (!told)
        cli_fail("standard output cannot be written: %s", strerror(errno));
    told = true;
    return CLI_FAILED;
}

int cli_print(const char *text)
{
    if (!text)
        return cli_fail("out of memory");
    fputs(text, stdout);
    return cli_printed();
}

int cli_version(void)
{
    size_t length = strcspn(command_name, " ");
    printf("%.*s %s\n", (int)length, command_name, TOOL_VERSION);
    printf("%s, kernels for %s\n", openblas_get_config(), openblas_get_corename());
    return cli_printed();
}

void cli_set_threads(int threads)
{
#ifdef _OPENMP
    omp_set_num_threads(threads);
#endif
    openblas_set_num_threads(threads);
}

int cli_threads(void)
{
#ifdef _OPENMP
    return omp_get_max_threads();
#else
    return 1;
#endif
}

bool cli_parse_double(const char *text, double *out)
{
    char *end;
    errno = 0;
    double value = strtod(text, &end);
    if (end == text || *end || !isfinite(value))
        return false;
    *out = value;
    return true;
}

bool cli_parse_size(const char *text, size_t *out)
{
    if (*text < '0' || *text > '9')
        return false;
    char *end;
    errno = 0;
    unsigned long long value = strtoull(text, &end, 10);
    if (*end || errno)
        return false;
    *out = (size_t)value;
    return true;
}

bool cli_parse_int(const char *text, int *out)
{
    char *end;
    errno = 0;
    long value = strtol(text, &end, 10);
    if (end == text || *end || errno || value < -2147483647 || value > 2147483647)
        return false;
    *out = (int)value;
    return true;
}

enum { MOST_NUMBERS = 100000 };

static bool parse_range(char *copy, double **out, size_t *n)
{
    double part[3];
    char *state = NULL, *token = strtok_r(copy, ":", &state);
    int count = 0;
    for (; token && count < 3; token = strtok_r(NULL, ":", &state))
        if (!cli_parse_double(token, &part[count++]))
            return false;
    if (count != 3 || token || part[2] == 0 || (part[1] - part[0]) / part[2] < 0)
        return false;
    /* Half a step in a million forgives the rounding of 0.2:0.45:0.05. */
    double steps = floor((part[1] - part[0]) / part[2] + 1e-6);
    if (!(steps < MOST_NUMBERS))
        return false;
    *n = (size_t)steps + 1;
    *out = cli_needed(malloc(*n * sizeof **out));
    for (size_t i = 0; i < *n; i++)
        (*out)[i] = part[0] + (double)i * part[2];
    return true;
}

static bool parse_commas(char *copy, double **out, size_t *n)
{
    size_t most = 1;
    for (const char *c = copy; *c; c++)
        most += *c == ',';
    if (most > MOST_NUMBERS)
        return false;
    *out = cli_needed(malloc(most * sizeof **out));
    *n = 0;
    for (char *start = copy; start;) {
        char *comma = strchr(start, ',');
        if (comma)
            *comma = '\0';
        if (!cli_parse_double(start, &(*out)[(*n)++])) {
            free(*out);
            *out = NULL;
            return false;
        }
        start = comma ? comma + 1 : NULL;
    }
    return true;
}

bool cli_parse_list(const char *text, double **out, size_t *n)
{
    char *copy = cli_needed(strdup(text));
    bool ok = strchr(text, ':') ? parse_range(copy, out, n) : parse_commas(copy, out, n);
    free(copy);
    return ok;
}

double cli_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void cli_progress_start(struct cli_progress *progress, const char *label)
{
    *progress = (struct cli_progress){.label = label,
                                      .started = cli_seconds(),
                                      .is_terminal = isatty(STDERR_FILENO) == 1,
                                      .tenths = -1};
}

static void print_duration(double seconds)
{
    if (seconds < 90)
        fprintf(stderr, "%.0f s", seconds);
    else
        fprintf(stderr, "%.0f min %02d s", floor(seconds / 60), (int)fmod(seconds, 60));
}

/* Whether a fraction is news. */
static bool is_due(struct cli_progress *progress, double fraction, double now)
{
    static const double redrawn = 0.2, first_seconds = 5;
    if (progress->is_terminal)
        return now - progress->last_shown >= redrawn || fraction >= 1;
    int tenths = (int)floor(10 * fraction);
    bool due =
        tenths > progress->tenths && (progress->is_run || now - progress->started >= first_seconds);
    progress->tenths = due ? tenths : progress->tenths;
    return due;
}

void cli_progress_update(struct cli_progress *progress, double fraction, const char *detail)
{
    double now = cli_seconds();
    if (!progress->label || !is_due(progress, fraction, now))
        return;
    progress->last_shown = now;
    if (progress->is_terminal)
        fputs("\r\033[K", stderr);
    else
        fprintf(stderr, "%s: ", cli_name());
    fprintf(stderr, "%s: %3.0f %%", progress->label, 100 * fraction);
    double since = now - progress->started;
    if (since > 10 || (since > 0.5 && fraction > 0.02)) {
        fputs(", ", stderr);
        print_duration(fraction > 0 ? since * (1 - fraction) / fraction : 0);
        fputs(" left", stderr);
    }
    if (detail && *detail)
        fprintf(stderr, ", %s", detail);
    if (!progress->is_terminal)
        fputc('\n', stderr);
    fflush(stderr);
}

void cli_progress_end(struct cli_progress *progress)
{
    if (progress->label && progress->last_shown > 0 && progress->is_terminal) {
        fputs("\r\033[K", stderr);
    } else if (progress->label && progress->last_shown > 0) {
        fprintf(stderr, "%s: %s: ended after ", cli_name(), progress->label);
        print_duration(cli_seconds() - progress->started);
        fputc('\n', stderr);
    }
    progress->label = NULL;
}
