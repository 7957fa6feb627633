/* What every command of the suite does alike: exit codes, messages, options that all commands take,
 * number lists, progress on a terminal, and files that appear whole or not at all. */
#ifndef TOOLS_CLI_H
#define TOOLS_CLI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { CLI_OK = 0, CLI_FAILED = 1, CLI_USAGE = 2 };

/* All of main(): names the command, runs it, and makes of its success a failure when standard
 * output did not take what it printed. A reader that went away and a limit for files are errors
 * like a full disk, not a silent death; a standard stream that the caller closed does not become
 * the first file opened. */
int cli_main(const char *name, int (*run)(int, char **), int argc, char **argv);

/* A subcommand, as the help of its command shows it: "name operands", then the summary. */
struct cli_command {
    const char *name, *operands, *summary;
    int (*run)(int argc, char **argv);
};
/* Runs the subcommand that argv[1] names, with argv from there on, as "NAME SUBCOMMAND" in
 * messages; NAME --help lists them under the purpose. Returns the exit code. */
int cli_dispatch(const char *name, const char *purpose, size_t n,
                 const struct cli_command *commands, int argc, char **argv);

/* Flushes standard output: CLI_OK, or CLI_FAILED after the sentence with the reason, said once. */
int cli_printed(void);

/* Names the command in every message ("nurbs skin"). Borrowed: keep the string. */
void cli_set_name(const char *name);
const char *cli_name(void);

/* "name: message" on stderr; returns CLI_FAILED or CLI_USAGE so that callers write
 * return cli_fail("%s: ...", path). The usage form adds "try 'name --help'". */
__attribute__((format(printf, 1, 2))) int cli_fail(const char *format, ...);
__attribute__((format(printf, 1, 2))) int cli_usage(const char *format, ...);

/* The same message from a function that can fail: prints it and returns false, so that it ends with
 * return cli_refuse("%s: ...", path). Only the top function of a command makes an exit code of it.
 */
__attribute__((format(printf, 1, 2))) bool cli_refuse(const char *format, ...);

/* MEMORY, or the end of the command with "out of memory", which leaves no unfinished file. */
void *cli_needed(void *memory);

/* Prints help or version on stdout and returns as cli_printed(); NULL: there was no memory for it.
 */
int cli_print(const char *text);
int cli_version(void);

/* Applies --threads N to OpenMP and OpenBLAS alike. */
void cli_set_threads(int threads);
/* How many OpenMP uses. */
int cli_threads(void);

/* Strict numbers: the whole string, finite; false leaves *out alone. */
bool cli_parse_double(const char *text, double *out);
bool cli_parse_size(const char *text, size_t *out);
bool cli_parse_int(const char *text, int *out);

/* "0.3", "0.2,0.3,0.35" or "0.2:0.45:0.05" (both ends kept). Allocates *out, the caller frees it.
 * false: not such a list, or more than 100000 numbers. */
bool cli_parse_list(const char *text, double **out, size_t *n);

/* A progress line on stderr with an estimate of the time left: redrawn on a terminal. Elsewhere a
 * line of its own at the start, at each tenth and at the end; of work that is no run of hours,
 * those after the first seconds only. */
struct cli_progress {
    const char *label;
    double started, last_shown;
    bool is_terminal, is_run;
    int tenths; /* that were told */
};
void cli_progress_start(struct cli_progress *progress, const char *label);
void cli_progress_update(struct cli_progress *progress, double fraction, const char *detail);
void cli_progress_end(struct cli_progress *progress);

/* Seconds of a monotonic clock. */
double cli_seconds(void);

/* A file written beside PATH, or beside what the link PATH leads to, and renamed onto it once
 * complete and on disk; a device or FIFO is written as it is. Writing goes to file.stream. Commit
 * returns false with errno set and removes the temporary file. */
struct cli_file {
    FILE *stream;
    char *path, *temporary;
};
bool cli_file_open(struct cli_file *file, const char *path);
bool cli_file_commit(struct cli_file *file);
void cli_file_abandon(struct cli_file *file);
/* Removes what is unfinished, before the command ends. */
void cli_files_remove(void);

/* A whole file, with a zero behind it; NULL with errno, EFBIG beyond 256 MiB. The caller frees. */
char *cli_read(const char *path, size_t *length);

/* One line of a text without its end, of 16 MiB at most; start with zeros, free the text. */
struct cli_line {
    char *text;
    size_t room, number; /* number: from 1 */
};
/* Fills the next line; *end: there was none. False after the sentence, as of a line that is too
 * long or holds a zero byte. PATH is for the sentence. */
bool cli_line_read(FILE *stream, const char *path, struct cli_line *line, bool *end);

/* A CSV table of numbers with a header line; '#' lines are comments. Columns are found by name; of
 * a file whose first line is numbers alone the columns have no names. */
struct cli_table {
    size_t rows, columns;
    char **names;
    double *values; /* row by row */
    size_t *lines;  /* where each row stood in the file, from 1 */
};
/* PATH "-" reads stdin. On failure prints the sentence with the line at fault and returns false. */
bool cli_table_read(const char *path, struct cli_table *table);
void cli_table_free(struct cli_table *table);
/* Index of a column, or -1. */
int cli_table_column(const struct cli_table *table, const char *name);

#endif
