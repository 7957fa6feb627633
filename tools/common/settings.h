/* Settings as rows of a table. A row says how a setting is called in a file and on the command
 * line, what it may be, what it is by default, where its value goes and what it means; reading
 * YAML, options, canonical text, --help and with it the man page, and a report's rows follow from
 * it. */
#ifndef TOOLS_SETTINGS_H
#define TOOLS_SETTINGS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* What the target holds at the offset of a row. */
enum setting_type {
    SETTING_HEADING, /* nothing: the sentence stands above the rows that follow in the help */
    SETTING_NUMBER,  /* double */
    SETTING_COUNT,   /* size_t or uint64_t */
    SETTING_INTEGER, /* int */
    SETTING_SWITCH,  /* bool, or int when size says so; the options --x and --no-x take no value */
    SETTING_CHOICE,  /* int or an enumeration, one of the words */
    SETTING_TEXT,    /* char *, owned; settings_free() */
    SETTING_FILE,    /* the same; in a file relative to its folder; a regular file up to 1 GiB */
    SETTING_NUMBERS, /* double *, owned, and `count`: as many as there are, also a:b:step */
    SETTING_ROWS     /* element *, owned, and `count`: a list of mappings, read by `table` */
};

/* A word that stands for a value: a choice, or "none", "auto", "by rule" in place of a number. */
struct setting_word {
    const char *name; /* NULL ends the list */
    double value;
};

struct settings;

struct setting {
    const char *key;    /* in a file, "solver.tolerance"; NULL: not there */
    const char *option; /* "tolerance" for --tolerance, "HULL" for a word without dashes, or NULL */
    char letter;        /* 'o' for -o too */
    enum setting_type type;
    size_t offset;              /* of the value in the target */
    double least, most;         /* both 0: any; most INFINITY: no upper end */
    bool open_least, open_most; /* that end itself is not allowed */
    bool required;              /* in a file; of a row without key, on the command line */
    const char *otherwise;      /* the default as text; NULL: what stands in the target already */
    const struct setting_word *words;
    const char *(*choice)(int value); /* in place of words: value k has the k-th, then NULL */
    size_t n_least, n_most; /* n_most > 0: the target has an array of n_most such values; a word
                               alone stands for all of n_least */
    size_t count;           /* offset of a size_t for how many were given; 0: none */
    size_t given;           /* offset of a bool that becomes true when the setting is given; 0 */
    const struct settings *table; /* of the elements of SETTING_ROWS */
    size_t size;                  /* of one of them, or of a switch */
    const char *sentence;         /* what it means, with its unit */
};

/* Rows for short: .key, .type, .offset and .sentence, then what else there is. */
#define SETTING_ROW(part, name, kind, member, meaning, ...)                                        \
    {                                                                                              \
        .key = (name), .type = SETTING_##kind, .offset = offsetof(part, member),                   \
        .sentence = (meaning), __VA_ARGS__                                                         \
    }
#define SETTING_FROM(a, b)   .least = (a), .most = (b)
#define SETTING_INSIDE(a, b) SETTING_FROM(a, b), .open_least = true, .open_most = true
#define SETTING_ABOVE(a)     SETTING_FROM(a, INFINITY), .open_least = true

struct settings_source;

struct settings {
    size_t n;
    const struct setting *rows;
    /* What no row can say alone, by settings_complain(); called when every row is well. */
    void (*check)(struct settings_source *source, void *target);
    const char *usage; /* of a command line: the head of its --help */
};

/* Sets the defaults of the rows that have one; texts and lists without become NULL. */
void settings_start(const struct settings *table, void *target);
void settings_free(const struct settings *table, void *target);

/* Reads a YAML file over what stands in the target. All that is wrong is said at once, a sentence
 * "file:line: ..." a line. */
bool settings_read(const char *path, const struct settings *table, void *target);

/* Reads a command line, argv[0] skipped, over what stands in the target; --help, --version and
 * --threads are everybody's. Returns -1 to go on, else an exit code. Words beyond the rows' go to
 * words[n_words], with room for argc of them; NULL: there may be none. Where options replace what a
 * file says, it is called before the file is read and again after. */
int settings_options(int argc, char **argv, const struct settings *table, void *target,
                     size_t *n_words, char **words);

/* From a check: KEY (of a row, relative to the mapping that is checked; "": that one) is wrong, "is
 * ..., expected ...". The line is that of KEY in the file or, when it is not given, of its mapping.
 */
__attribute__((format(printf, 3, 4))) void
settings_complain(struct settings_source *source, const char *key, const char *format, ...);

/* The value of a row as a file would have it; the caller frees it. */
char *settings_value(const struct setting *row, const void *target);
/* "key = value" lines of all rows with a key, a file as its name and the digest of what is in it;
 * lists of mappings are left out. The caller frees it; NULL when a file cannot be read. */
char *settings_text(const struct settings *table, const void *target);
/* Reads such a text over what stands in the target; a file becomes its name with the digest. False
 * at a line that no row reads, which *line (from 1) tells, or, with 0, where a required row is
 * missing or the check of the table has something to say. */
bool settings_restore(const struct settings *table, const char *text, void *target, size_t *line);
/* A YAML file of the rows with a key, each with its sentence in a comment and what stands in the
 * target. */
void settings_template(const struct settings *table, const void *target, FILE *out);
/* The rows of the options, or of the keys, with sentence, range and default. */
void settings_help(const struct settings *table, const void *target, bool keys, FILE *out);

#endif
