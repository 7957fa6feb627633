/* Between the files of the settings: values, files, command lines. */
#ifndef TOOLS_SETTINGS_INTERNAL_H
#define TOOLS_SETTINGS_INTERNAL_H

#include "settings.h"

/* What is wrong with a file or, path NULL, with a command line, in the order of the lines. */
struct settings_source {
    const char *path;
    size_t n;
    struct complaint {
        size_t line; /* 0: none */
        char *text;
    } * complaints;
    void *document;               /* yaml_document_t */
    const void *node;             /* the mapping being read, yaml_node_t */
    const char *prefix;           /* its name, "variables.2", or "" */
    const struct settings *table; /* of a command line */
};

__attribute__((format(printf, 3, 4))) void settings_add(struct settings_source *source, size_t line,
                                                        const char *format, ...);
/* Hands the complaints over, joined, or prints them through say; true when there were none. */
bool settings_close(struct settings_source *source, char **sentences);

/* Stores n texts as the value of a row. On failure complains by NAME, unless source is NULL. */
bool settings_set(struct settings_source *source, const struct setting *row, size_t line,
                  const char *name, size_t n, char *const *texts, void *target);
/* The same for one text with entries separated by commas (of whole numbers also by x or :). */
bool settings_set_text(struct settings_source *source, const struct setting *row, size_t line,
                       const char *name, const char *text, void *target);

void settings_print_expected(const struct setting *row, FILE *out);

/* Edits from one word to the other: letters inserted, dropped or replaced. */
size_t settings_distance(const char *a, const char *b);

#endif
